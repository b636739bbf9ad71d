//! Stress under a Hertz pressure: slice, volume, life integral.
//!
//! Closed forms: the whole field under a sliding Hertz pressure ([`hertz_sliding`]), the greatest von Mises stress on
//! the axis ([`hertz_axis_maximum`]), and ∫ σ^10 dV = 2.878184e-3 p_h^10 a³ (ν = 0.3, by quadrature of the closed
//! field). The stress engine works in single precision.

use super::row::{AccuracyRow, Against, StudiedPart, Timed, Varied, timed};
use asperity_engine::physics::stress_exact::{hertz_axis_maximum, hertz_sliding};
use asperity_engine::solve::stress::{SliceOut, StressEngine, StressSpec, Symmetry};

const POISSON: f64 = 0.3;
const FRICTION: f64 = 0.1;
const EXPONENT: f64 = 10.0;
const INTEGRAL: f64 = 2.878184e-3;
/// Half of the domain, a.
const HALF: f64 = 2.0;
/// Depths from which the slice is compared: above them the edge of the sampled pressure rules.
const FROM_DEPTH: f64 = 0.25;

/// What an engine is made for.
#[derive(Debug, Clone, Copy)]
struct EngineSetting {
    n: usize,
    depths: usize,
    decay: f64,
}

const USUAL: EngineSetting = EngineSetting {
    n: 128,
    depths: 32,
    decay: StressSpec::DECAY,
};

struct LoadedCase {
    engine: StressEngine,
    p: Vec<f32>,
    q: Vec<f32>,
}

fn loaded(setting: EngineSetting) -> Result<LoadedCase, String> {
    let d = 2.0 * HALF / setting.n as f64;
    let shape = (setting.n + 1, setting.n / 2 + 1);
    let mut spec = StressSpec::new(
        shape,
        (d, d),
        POISSON,
        (setting.depths, 3.0),
        Symmetry::MirrorY,
    );
    (spec.x_first, spec.decay) = (-HALF, setting.decay);
    let p: Vec<f32> = (0..spec.nx * spec.ny)
        .map(|at| {
            let x = spec.x_first + d * (at % spec.nx) as f64;
            let y = d * (at / spec.nx) as f64;
            (1.0 - x * x - y * y).max(0.0).sqrt() as f32
        })
        .collect();
    let q = p.iter().map(|p| p * FRICTION as f32).collect();
    let engine = StressEngine::new(&spec).map_err(|error| error.to_string())?;
    Ok(LoadedCase { engine, p, q })
}

fn row(
    (part, quantity): (StudiedPart, &'static str),
    (varied, value): (Varied, f64),
    setting: EngineSetting,
    engine: &StressEngine,
    (error, time): (f64, Timed),
) -> AccuracyRow {
    let [n, depths, decay] = [
        format!("N {}", setting.n),
        format!("{} depths", setting.depths),
        format!("epsilon {:e}", setting.decay),
    ];
    let fixed = match varied {
        Varied::Nodes => [depths, decay],
        Varied::Depths => [n, decay],
        Varied::Decay | Varied::Step | Varied::Tolerance | Varied::Samples | Varied::Precision => {
            [n, depths]
        }
    };
    AccuracyRow {
        part,
        quantity,
        varied,
        setting: value,
        fixed: fixed.join(", "),
        value: None,
        error,
        against: Against::ClosedForm,
        order: None,
        seconds: time.seconds,
        runs: time.runs,
        threads: rayon::current_num_threads(),
        work: (setting.depths * setting.n * setting.n) as u64,
        work_unit: "node depths",
        bytes: Some(engine.bytes() as u64),
        front: false,
    }
}

/// Worst error of any component in the plane y = 0 from a quarter of a half-width down.
fn slice(setting: EngineSetting, varied: (Varied, f64)) -> Result<AccuracyRow, String> {
    let LoadedCase { mut engine, p, q } = loaded(setting)?;
    let mut out = SliceOut::new(engine.spec());
    let ((), time) = timed(|| {
        engine.load(&p, Some(&q));
        engine.slice(&mut out);
    });
    let spec = engine.spec();
    let mut worst: f64 = 0.0;
    for (k, &z) in spec
        .depths
        .iter()
        .enumerate()
        .filter(|(_, z)| **z >= FROM_DEPTH)
    {
        for i in 0..spec.nx {
            let x = spec.x_first + spec.dx * i as f64;
            if x.abs() <= 1.5 {
                let exact = hertz_sliding(x, 0.0, z, POISSON, FRICTION);
                worst = worst.max(exact.distance(out.state(k * spec.nx + i)));
            }
        }
    }
    let what = (StudiedPart::Slice, "worst component, z > a/4");
    Ok(row(what, varied, setting, &engine, (worst, time)))
}

/// The greatest von Mises stress and the life integral, from one volume.
fn volume(setting: EngineSetting, varied: (Varied, f64)) -> Result<[AccuracyRow; 2], String> {
    let LoadedCase { mut engine, p, .. } = loaded(setting)?;
    let (out, time) = timed(|| {
        engine.load(&p, None);
        engine.volume(EXPONENT)
    });
    // Of a volume the greatest is that of its samples, which no sum looks at; the refined one is the slice's.
    let mut slice = SliceOut::new(engine.spec());
    engine.slice(&mut slice);
    let (_, greatest) = hertz_axis_maximum(POISSON);
    let peak = (slice.peak.value / greatest - 1.0).abs();
    let integral = (out.normal.ln.exp() / INTEGRAL - 1.0).abs();
    Ok([
        row(
            (StudiedPart::Volume, "greatest von Mises"),
            varied,
            setting,
            &engine,
            (peak, time),
        ),
        row(
            (StudiedPart::LifeIntegral, "integral, m = 10"),
            varied,
            setting,
            &engine,
            (integral, time),
        ),
    ])
}

/// All three over nodes, depths and ε.
pub(super) fn stress(
    sizes: &[usize],
    depths: &[usize],
    decays: &[f64],
) -> Result<Vec<AccuracyRow>, String> {
    let mut settings = Vec::new();
    for &n in sizes {
        settings.push((
            EngineSetting { n, ..USUAL },
            (Varied::Nodes, (n + 1) as f64),
        ));
    }
    for &depths in depths {
        settings.push((
            EngineSetting { depths, ..USUAL },
            (Varied::Depths, depths as f64),
        ));
    }
    for &decay in decays {
        settings.push((EngineSetting { decay, ..USUAL }, (Varied::Decay, decay)));
    }
    let (mut slices, mut peaks, mut integrals) = (Vec::new(), Vec::new(), Vec::new());
    for (setting, varied) in settings {
        if varied.0 != Varied::Depths {
            slices.push(slice(setting, varied)?);
        }
        let [peak, integral] = volume(setting, varied)?;
        peaks.push(peak);
        integrals.push(integral);
    }
    slices.extend(peaks);
    slices.extend(integrals);
    Ok(slices)
}
