//! The stress engine against the closed forms, against itself on other grids and threads.
//! Every test prints the numbers that it asserts.

use super::patch::rectangle_harmonics;
use asperity_engine::physics::invariants::Stress6;
use asperity_engine::physics::stress_exact::hertz_sliding;
use asperity_engine::scene::StressMeasure;
use asperity_engine::solve::stress::{SliceOut, StressEngine, StressSpec, Symmetry};

const NU: f64 = 0.3;

/// A surface on [x0, x0 + size]² with `n` intervals a side.
struct Surface {
    n: usize,
    x0: f64,
    size: f64,
}

impl Surface {
    fn new(n: usize) -> Self {
        Self {
            n,
            x0: -2.0,
            size: 4.0,
        }
    }

    fn spec(&self, symmetry: Symmetry, depths: (usize, f64)) -> StressSpec {
        let d = self.size / self.n as f64;
        let ny = match symmetry {
            Symmetry::MirrorY => self.n / 2 + 1,
            Symmetry::General | Symmetry::Line => self.n + 1,
        };
        let mut spec = StressSpec::new((self.n + 1, ny), (d, d), NU, depths, symmetry);
        spec.x_first = self.x0;
        spec
    }
}

/// A field of (x, y) on the rows of a specification.
fn field(spec: &StressSpec, f: impl Fn(f64, f64) -> f64) -> Vec<f32> {
    let axis = match spec.symmetry {
        Symmetry::MirrorY => 0,
        Symmetry::General | Symmetry::Line => spec.ny / 2,
    };
    let mut out = vec![0.0; spec.nx * spec.ny];
    for j in 0..spec.ny {
        for i in 0..spec.nx {
            let (x, y) = (
                spec.x_first + spec.dx * i as f64,
                spec.dy * (j as f64 - axis as f64),
            );
            out[j * spec.nx + i] = f(x, y) as f32;
        }
    }
    out
}

fn hertz(x: f64, y: f64) -> f64 {
    (1.0 - x * x - y * y).max(0.0).sqrt()
}

/// Greatest error of the slice's components at |x| < reach, per depth.
fn slice_errors(n: usize, depths: &[f64], friction: f64, reach: f64) -> Vec<f64> {
    let surface = Surface::new(n);
    let mut spec = surface.spec(Symmetry::MirrorY, (depths.len(), 3.0));
    spec.depths = depths.to_vec();
    let p = field(&spec, hertz);
    let q: Vec<f32> = p.iter().map(|p| p * friction as f32).collect();
    let mut engine = StressEngine::new(&spec).expect("valid");
    let mut out = SliceOut::new(&spec);
    engine.load(&p, (friction > 0.0).then_some(&q));
    engine.slice(&mut out);
    let error = |k: usize, i: usize| {
        let x = spec.x_first + spec.dx * i as f64;
        let s = hertz_sliding(x, 0.0, depths[k], NU, friction);
        let at = k * spec.nx + i;
        [
            (s.xx, out.sxx[at]),
            (s.yy, out.syy[at]),
            (s.zz, out.szz[at]),
            (s.xz, out.sxz[at]),
            (s.von_mises(), out.effective[at]),
        ]
        .into_iter()
        .fold(0.0_f64, |worst, (a, b)| worst.max((a - f64::from(b)).abs()))
    };
    (0..depths.len())
        .map(|k| {
            (0..spec.nx)
                .filter(|i| (spec.x_first + spec.dx * *i as f64).abs() < reach)
                .fold(0.0, |worst: f64, i| worst.max(error(k, i)))
        })
        .collect()
}

#[test]
fn slice_matches_hertz_at_every_depth() {
    let depths = [0.1, 0.5, 1.0, 3.0];
    for friction in [0.0, 0.2] {
        println!("greatest error of the slice in |x| < a, p0, mu = {friction}; z = {depths:?} a");
        let mut last = Vec::new();
        for n in [64, 128, 256] {
            last = slice_errors(n, &depths, friction, 1.0);
            let text: Vec<_> = last.iter().map(|e| format!("{e:.1e}")).collect();
            println!("  N = {n:3}: {}", text.join("  "));
        }
        // The edge of the Hertz pressure is a square root, sampled: 2.5e-3 and 1.2e-4 are the
        // errors of any kernel at N = 256 (design table).
        assert!(last[0] < 3e-3 && last[1] < 2e-4 && last[2] < 1e-4 && last[3] < 5e-5);
    }
}

#[test]
fn peak_between_nodes_is_the_published_one() {
    for (friction, value, x, z) in [
        (0.0, 0.620041, 0.0, 0.4809),
        (0.1, 0.624444, 0.1116, 0.4749),
    ] {
        let spec = Surface::new(128).spec(Symmetry::MirrorY, (32, 3.0));
        let p = field(&spec, hertz);
        let q: Vec<f32> = p.iter().map(|p| p * friction as f32).collect();
        let mut engine = StressEngine::new(&spec).expect("valid");
        let mut out = SliceOut::new(&spec);
        engine.load(&p, (friction > 0.0).then_some(&q));
        engine.slice(&mut out);
        let peak = out.peak;
        let sampled = out.effective.iter().fold(0.0_f32, |a, b| a.max(*b));
        println!(
            "mu {friction}: {:.5} p0 at x = {:.4}, z = {:.4} a (greatest sample {sampled:.5}; \
             exact {value} at {x}, {z})",
            peak.value, peak.x, peak.z
        );
        assert!((peak.value / value - 1.0).abs() < 2e-4, "0.02 %");
        assert!((peak.x - x).abs() < 2e-3 && (peak.z - z).abs() < 2e-3);
    }
}

#[test]
fn images_do_not_reach_the_contact() {
    // Against four times the domain: the difference is the images' alone, for at z = 0.3 a
    // the waves next to Nyquist, which fall otherwise on another period, are gone.
    let mut spec = Surface::new(64).spec(Symmetry::MirrorY, (6, 3.0));
    spec.depths = vec![0.3, 0.5, 0.7, 1.0, 2.0, 3.0];
    let p = field(&spec, hertz);
    let q: Vec<f32> = p.iter().map(|p| p * 0.2).collect();
    let solve = |pad: f64| {
        let mut spec = spec.clone();
        (spec.pad, spec.decay) = (pad, 1e-8);
        let mut engine = StressEngine::new(&spec).expect("valid");
        let mut out = SliceOut::new(&spec);
        engine.load(&p, Some(&q));
        engine.slice(&mut out);
        out
    };
    let (near, far) = (solve(StressSpec::PAD), solve(4.0));
    for (reach, allowed) in [(1.01, 1e-5), (1.51, 5e-5), (2.01, 3e-3)] {
        let mut worst: f32 = 0.0;
        for (a, b) in [
            (&near.sxx, &far.sxx),
            (&near.szz, &far.szz),
            (&near.sxz, &far.sxz),
        ] {
            for (at, (a, b)) in a.iter().zip(b).enumerate() {
                let x = spec.x_first + spec.dx * (at % spec.nx) as f64;
                if x.abs() < reach {
                    worst = worst.max((a - b).abs());
                }
            }
        }
        println!("image error in |x| < {reach} a: {worst:.1e} p0");
        assert!(f64::from(worst) < allowed);
    }
}

#[test]
fn general_surface_equals_mirror_surface() {
    let surface = Surface::new(64);
    let (mirror, general) = (
        surface.spec(Symmetry::MirrorY, (12, 3.0)),
        surface.spec(Symmetry::General, (12, 3.0)),
    );
    // Off centre in x, rippled, with a traction of another shape.
    let pressure =
        |x: f64, y: f64| hertz(x - 0.2, y) * (1.0 + 0.5 * (9.0 * x).cos() * (7.0 * y).cos());
    let traction = |x: f64, y: f64| 0.3 * hertz(x - 0.1, 1.2 * y) * (1.0 + x);
    let solve = |spec: &StressSpec| {
        let mut engine = StressEngine::new(spec).expect("valid");
        let mut out = SliceOut::new(spec);
        let (p, q) = (field(spec, pressure), field(spec, traction));
        engine.load(&p, Some(&q));
        engine.slice(&mut out);
        (out, engine.volume(11.481))
    };
    let ((a, va), (b, vb)) = (solve(&mirror), solve(&general));
    let worst = |a: &[f32], b: &[f32]| {
        assert_eq!(a.len(), b.len());
        a.iter()
            .zip(b)
            .fold(0.0_f32, |w, (a, b)| w.max((a - b).abs()))
    };
    let components = [
        worst(&a.sxx, &b.sxx),
        worst(&a.syy, &b.syy),
        worst(&a.szz, &b.szz),
        worst(&a.sxz, &b.sxz),
        worst(&a.effective, &b.effective),
        b.sxy
            .iter()
            .chain(&b.syz)
            .fold(0.0, |w: f32, v| w.max(v.abs())),
    ];
    println!("general against mirror, slice: {components:?}");
    println!(
        "ln I: {:.8} {:.8}; {:.8} {:.8}",
        va.normal.ln, vb.normal.ln, va.full.ln, vb.full.ln
    );
    assert!(components.iter().all(|w| *w < 3e-6));
    assert!((va.normal.ln - vb.normal.ln).abs() < 1e-5 && (va.full.ln - vb.full.ln).abs() < 1e-5);
    assert!((va.full.peak.value - vb.full.peak.value).abs() < 1e-5);
}

#[test]
fn unsymmetric_shears_match_hertz() {
    // A contact half-way up the domain: in the plane y = 0 its chord at y = −0.4 shows σxy and σyz.
    let spec = Surface::new(128).spec(Symmetry::General, (12, 3.0));
    let p = field(&spec, |x, y| hertz(x, y - 0.4));
    let q: Vec<f32> = p.iter().map(|p| p * 0.2).collect();
    let mut engine = StressEngine::new(&spec).expect("valid");
    let mut out = SliceOut::new(&spec);
    engine.load(&p, Some(&q));
    engine.slice(&mut out);
    let mut worst: f64 = 0.0;
    for (k, z) in spec.depths.iter().enumerate().filter(|(_, z)| **z > 0.4) {
        for i in (0..spec.nx).filter(|i| (spec.dx * *i as f64 - 2.0).abs() < 1.0) {
            let s = hertz_sliding(spec.dx * i as f64 - 2.0, -0.4, *z, NU, 0.2);
            let at = k * spec.nx + i;
            for (a, b) in [
                (s.xy, out.sxy[at]),
                (s.yz, out.syz[at]),
                (s.xx, out.sxx[at]),
            ] {
                worst = worst.max((a - f64::from(b)).abs());
            }
        }
    }
    println!("sxy, syz, sxx off the axis, z > 0.4 a: {worst:.1e} p0");
    assert!(worst < 5e-4);
}

#[test]
fn threads_do_not_change_a_bit() {
    let spec = Surface::new(64).spec(Symmetry::MirrorY, (16, 3.0));
    let p = field(&spec, |x, y| hertz(x, y) * (1.0 + 0.8 * (12.0 * x).cos()));
    let q: Vec<f32> = p.iter().map(|p| p * 0.1).collect();
    let solve = |threads: usize| {
        let pool = rayon::ThreadPoolBuilder::new()
            .num_threads(threads)
            .build()
            .expect("pool");
        pool.install(|| {
            let mut engine = StressEngine::new(&spec).expect("valid");
            let mut out = SliceOut::new(&spec);
            engine.load(&p, Some(&q));
            engine.slice(&mut out);
            (engine.volume(11.481), out.effective)
        })
    };
    let (one, two, three) = (solve(1), solve(2), solve(3));
    println!(
        "ln I, 1, 2, 3 threads: {:?}",
        [one.0.full.ln, two.0.full.ln, three.0.full.ln]
    );
    assert!(one == two && one == three);
}

#[test]
fn a_warm_engine_forgets_the_last_surface() {
    let spec = Surface::new(64).spec(Symmetry::General, (8, 3.0));
    let p = field(&spec, hertz);
    let q: Vec<f32> = p.iter().map(|p| p * 0.3).collect();
    let tilted = field(&spec, |x, y| hertz(x, y) * (1.0 + 0.3 * (5.0 * y).sin()));
    let result = |engine: &mut StressEngine| {
        let mut out = SliceOut::new(&spec);
        engine.load(&p, None);
        engine.slice(&mut out);
        (out.sxx, out.sxy, engine.volume(10.0))
    };
    let mut fresh = StressEngine::new(&spec).expect("valid");
    let mut used = StressEngine::new(&spec).expect("valid");
    used.load(&tilted, Some(&q));
    used.slice(&mut SliceOut::new(&spec));
    let sheared = used.volume(10.0);
    assert_ne!(sheared.full.ln, sheared.normal.ln);
    assert!(
        result(&mut fresh) == result(&mut used),
        "state leaks from call to call"
    );
    let quiet = vec![0.0; p.len()];
    used.load(&quiet, None);
    let nothing = used.volume(10.0);
    assert_eq!(nothing.normal.ln, f64::NEG_INFINITY);
    assert_eq!(nothing.normal.peak.value, 0.0);
}

#[test]
fn bad_specifications_name_their_entry() {
    type Spoil = fn(&mut StressSpec);
    let good = Surface::new(64).spec(Symmetry::General, (8, 3.0));
    let cases: [(&str, Spoil); 6] = [
        ("nx", |s| s.nx = 3),
        ("ny", |s| s.ny = 64),
        ("dx", |s| s.dx = f64::NAN),
        ("nu", |s| s.nu = 0.7),
        ("depths", |s| s.depths[0] = -1.0),
        ("pad", |s| s.pad = 0.5),
    ];
    for (key, spoil) in cases {
        let mut spec = good.clone();
        spoil(&mut spec);
        let error = StressEngine::new(&spec).err().map(|e| e.key);
        assert_eq!(error, Some(key));
    }
}

#[test]
fn long_ellipse_matches_summed_patches() {
    // b = 5 a on a grid with dy = 5 dx: the window is stretched with the domain. Against the sum of
    // uniform patches at the nodes, whose own staircase error is of second order: 1e-4 at z = 0.5 a.
    let (n, b) = (128, 5.0);
    let d = 4.0 / n as f64;
    let mut spec = StressSpec::new(
        (n + 1, n / 2 + 1),
        (d, b * d),
        NU,
        (8, 3.0),
        Symmetry::MirrorY,
    );
    spec.x_first = -2.0;
    spec.depths = vec![0.3, 0.5, 0.7, 1.0, 1.5, 2.0, 2.5, 3.0];
    let p = field(&spec, |x, y| hertz(x, y / b));
    let q: Vec<f32> = p.iter().map(|p| 0.2 * p).collect();
    let mut engine = StressEngine::new(&spec).expect("valid");
    let mut out = SliceOut::new(&spec);
    engine.load(&p, Some(&q));
    engine.slice(&mut out);
    let patches = |x: f64, z: f64| {
        let mut sum = Stress6::default();
        for j in -64_i32..=64 {
            for i in 0..=n {
                let p = f64::from(p[j.unsigned_abs() as usize * spec.nx + i]);
                let (dx, dy) = (x - (d * i as f64 - 2.0), b * d * f64::from(j));
                if p > 0.0 {
                    let h = rectangle_harmonics(dx, dy, z, d / 2.0, b * d / 2.0);
                    let s = h.normal(NU).plus(h.tangential_x(NU).times(0.2));
                    sum = sum.plus(s.times(p));
                }
            }
        }
        sum
    };
    for k in [1, 3, 5, 7] {
        let mut worst: f64 = 0.0;
        for i in [34, 52, 64, 90] {
            let s = patches(d * i as f64 - 2.0, spec.depths[k]);
            let at = k * spec.nx + i;
            for (a, b) in [(s.xx, out.sxx[at]), (s.yy, out.syy[at])] {
                worst = worst.max((a - f64::from(b)).abs());
            }
            for (a, b) in [(s.zz, out.szz[at]), (s.xz, out.sxz[at])] {
                worst = worst.max((a - f64::from(b)).abs());
            }
        }
        println!("ellipse b = 5 a, z = {} a: {worst:.1e} p0", spec.depths[k]);
        assert!(worst < 3e-4);
    }
    println!("greatest von Mises {:?}", out.peak);
}

#[test]
fn every_measure_finds_its_hertz_maximum() {
    // τ_max: half of von Mises on the axis, where two principal stresses are equal.
    for (measure, exact) in [
        (StressMeasure::VonMises, 0.620041),
        (StressMeasure::MaxShear, 0.310020),
        (StressMeasure::Octahedral, 0.292290),
    ] {
        let mut spec = Surface::new(128).spec(Symmetry::MirrorY, (24, 3.0));
        spec.measure = measure;
        let p = field(&spec, hertz);
        let mut engine = StressEngine::new(&spec).expect("valid");
        let mut out = SliceOut::new(&spec);
        engine.load(&p, None);
        engine.slice(&mut out);
        let sampled = engine.volume(10.0).normal.peak.value;
        println!(
            "{measure:?}: slice {:.6}, volume's greatest sample {sampled:.6}, exact {exact}",
            out.peak.value
        );
        assert!((out.peak.value / exact - 1.0).abs() < 2e-4, "0.02 %");
        assert!((sampled / exact - 1.0).abs() < 1e-2);
    }
}
