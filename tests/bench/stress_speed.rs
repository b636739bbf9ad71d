//! Time of the stress engine in units of one padded single-precision transform of the same surface.
//! Timings belong to no gate: `cargo bench --bench stress_speed`.

use std::time::Instant;

use asperity_engine::physics::cycles::BodyId;
use asperity_engine::solve::stress::{SliceOut, StressEngine, StressLaw, StressSpec, Symmetry};
use rustfft::FftPlanner;
use rustfft::num_complex::Complex;

/// Best of many runs, ms.
fn best(mut run: impl FnMut()) -> f64 {
    let mut best = f64::INFINITY;
    for _ in 0..12 {
        let start = Instant::now();
        run();
        best = best.min(start.elapsed().as_secs_f64() * 1e3);
    }
    best
}

/// One forward transform of `n × n` complex f32 numbers by rustfft, ms.
fn transform(n: usize) -> f64 {
    let fft = FftPlanner::<f32>::new().plan_fft_forward(n);
    let mut field = vec![Complex::new(0.5_f32, 0.25); n * n];
    let mut turned = field.clone();
    let mut scratch = vec![Complex::default(); fft.get_inplace_scratch_len()];
    best(|| {
        fft.process_with_scratch(&mut field, &mut scratch);
        for i in 0..n {
            for j in 0..n {
                turned[j * n + i] = field[i * n + j] * (1.0 / n as f32);
            }
        }
        fft.process_with_scratch(&mut turned, &mut scratch);
        std::mem::swap(&mut field, &mut turned);
    })
}

fn main() {
    // Not by `cargo bench`: nothing to test.
    if std::env::args().any(|argument| argument == "--bench") {
        volume_and_slice_in_units_of_one_padded_transform();
    }
}

fn volume_and_slice_in_units_of_one_padded_transform() {
    let one = rayon::ThreadPoolBuilder::new()
        .num_threads(1)
        .build()
        .expect("pool");
    let two = rayon::ThreadPoolBuilder::new()
        .num_threads(2)
        .build()
        .expect("pool");
    for n in [64, 128, 256] {
        let unit = transform(3 * n / 2);
        println!(
            "N = {n}: one padded complex f32 transform ({0} x {0}): {unit:.3} ms",
            3 * n / 2
        );
        for symmetry in [Symmetry::MirrorY, Symmetry::General] {
            let d = 4.0 / n as f64;
            let ny = if symmetry == Symmetry::General {
                n + 1
            } else {
                n / 2 + 1
            };
            let spec = StressSpec::new((n + 1, ny), (d, d), 0.3, (32, 3.0), symmetry);
            let axis = if symmetry == Symmetry::General {
                n / 2
            } else {
                0
            };
            let p: Vec<f32> = (0..spec.nx * spec.ny)
                .map(|at| {
                    let (x, y) = (
                        d * (at % spec.nx) as f64 - 2.0,
                        d * ((at / spec.nx) as f64 - axis as f64),
                    );
                    (1.0 - x * x - y * y).max(0.0).sqrt() as f32
                })
                .collect();
            let q: Vec<f32> = p.iter().map(|p| 0.1 * p).collect();
            let law = [StressLaw::power(11.481)];
            let mut engine = one.install(|| StressEngine::new(&spec).expect("valid"));
            engine.load(&p, None);
            let normal = one.install(|| {
                best(|| {
                    engine.volume_under(&law, &[BodyId::One]);
                })
            });
            engine.load(&p, Some(&q));
            let both = one.install(|| {
                best(|| {
                    engine.volume_under(&law, &BodyId::BOTH);
                })
            });
            let mut slice = SliceOut::new(&spec);
            let sliced = best(|| {
                engine.load(&p, Some(&q));
                engine.slice(&mut slice);
            });
            let mut engine_2 = two.install(|| StressEngine::new(&spec).expect("valid"));
            engine_2.load(&p, None);
            let normal_2 = two.install(|| {
                best(|| {
                    engine_2.volume_under(&law, &[BodyId::One]);
                })
            });
            println!(
                "  {symmetry:?}: volume, 32 depths, one loading {normal:.2} ms = {:.1} units (2 threads {:.2}x); \
                 two bodies with traction {both:.2} ms; load and slice {sliced:.2} ms; memory {:.1} MB",
                normal / unit,
                normal / normal_2,
                engine.bytes() as f64 * 1e-6
            );
        }
    }
}
