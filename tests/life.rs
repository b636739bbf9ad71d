//! Life integrals and the factors of life against published and computed values.
//! Every test prints the numbers that it asserts.

use asperity::physics::cycles::{BodyId, Kinematics, miner_part};
use asperity::solve::material::{Line, MaterialTracker, TrackerSpec};
use asperity::solve::stress::{SliceOut, StressEngine, StressSpec, Symmetry, VolumeOut};

const NU: f64 = 0.3;
/// Half of the domain, a.
const HALF: f64 = 2.0;

fn spec(n: usize, depths: usize, symmetry: Symmetry) -> StressSpec {
    let d = 2.0 * HALF / n as f64;
    let ny = match symmetry {
        Symmetry::MirrorY => n / 2 + 1,
        Symmetry::General => n + 1,
    };
    let mut spec = StressSpec::new((n + 1, ny), (d, d), NU, (depths, 3.0), symmetry);
    spec.x_first = -HALF;
    spec
}

/// Integrals under a pressure of (x, y) and a traction `friction · p`.
fn integral(
    n: usize,
    depths: usize,
    exponent: f64,
    friction: f64,
    p: impl Fn(f64, f64) -> f64,
) -> VolumeOut {
    let spec = spec(n, depths, Symmetry::MirrorY);
    let mut pressure = vec![0.0_f32; spec.nx * spec.ny];
    for j in 0..spec.ny {
        for i in 0..spec.nx {
            let (x, y) = (spec.x_first + spec.dx * i as f64, spec.dy * j as f64);
            pressure[j * spec.nx + i] = p(x, y) as f32;
        }
    }
    let traction: Vec<f32> = pressure.iter().map(|p| p * friction as f32).collect();
    let mut engine = StressEngine::new(&spec).expect("valid");
    engine.load(&pressure, (friction > 0.0).then_some(&traction));
    engine.volume(exponent)
}

fn hertz(x: f64, y: f64) -> f64 {
    (1.0 - x * x - y * y).max(0.0).sqrt()
}

#[test]
fn hertz_life_integrals() {
    for (m, exact) in [(10.0, 2.878184e-3), (13.5, 3.589723e-4)] {
        for (n, depths) in [(64, 24), (128, 16), (128, 24), (128, 32), (256, 24)] {
            let got = integral(n, depths, m, 0.0, hertz).normal.ln.exp();
            let error = got / exact - 1.0;
            println!("m = {m}, N = {n}, {depths} depths: {got:.6e}, error {error:.1e}");
            let allowed = match (n, depths) {
                (64, _) => 2e-3,
                (_, 16) => 1e-3,
                (256, _) => 2e-4,
                _ => 5e-4,
            };
            assert!(error.abs() < allowed);
        }
    }
}

#[test]
fn traction_raises_the_integral() {
    let m = 31.0 / 3.0 * 10.0 / 9.0;
    for (friction, exact) in [(0.0, 1.175e-3), (0.1, 1.279e-3), (0.2, 1.657e-3)] {
        let out = integral(128, 24, m, friction, hertz);
        let got = out.full.ln.exp();
        println!("mu = {friction}: J = {got:.4e} (table {exact:.3e})");
        assert!(
            (got / exact - 1.0).abs() < 1e-3,
            "three digits after the point in the table"
        );
        let smooth = out.normal.ln.exp();
        assert!(
            (smooth / 1.175e-3 - 1.0).abs() < 1e-3,
            "the normal part does not see the traction"
        );
    }
}

#[test]
fn rippled_contact_has_the_computed_life() {
    // p_H (1 + cos cos), W = 0.2 a: relative life 0.904, greatest von Mises 0.870 p_h, ±2 %.
    let (m, e) = (31.0 / 3.0 * 10.0 / 9.0, 10.0 / 9.0);
    let k = std::f64::consts::TAU / 0.2;
    let ripple = |x: f64, y: f64| hertz(x, y) * (1.0 + (k * x).cos() * (k * y).cos());
    for n in [128, 256] {
        let smooth = integral(n, 32, m, 0.0, hertz).normal;
        let rough = integral(n, 32, m, 0.0, ripple).normal;
        let life = ((smooth.ln - rough.ln) / e).exp();
        println!(
            "N = {n}: relative life {life:.4}, greatest von Mises {:?}",
            rough.peak
        );
        assert!((life / 0.904 - 1.0).abs() < 0.02);
        assert!((rough.peak.value / 0.870 - 1.0).abs() < 0.02);
    }
}

#[test]
fn strong_exponents_do_not_overflow() {
    // c = 12, e = 3: σ^36 overflows single precision in Pa, and at 8 p_h even in p_h.
    let out = integral(64, 16, 36.0, 0.0, |x, y| 30.0 * hertz(x, y)).normal;
    let one = integral(64, 16, 36.0, 0.0, hertz).normal;
    let step = out.ln - one.ln - 36.0 * 30.0_f64.ln();
    println!(
        "ln I at 30 p_h: {:.4}, difference from scaling {step:.1e}",
        out.ln
    );
    assert!(out.ln.is_finite() && step.abs() < 1e-4);
}

/// Speeds of body 1 (followed) and body 2 (rippled), and the ripple's wavelength, a.
struct Passage {
    u_1: f64,
    u_2: f64,
    wavelength: f64,
}

impl Passage {
    /// Crests that pass over a point of body 1 on its way through the contact, f δ.
    fn crests(&self) -> f64 {
        let kinematics = Kinematics {
            u_1: self.u_1,
            u_2: self.u_2,
            zone: 2.0,
        };
        let contacts = kinematics.contacts(BodyId::One, 1.0 / self.wavelength);
        contacts.per_cycle().expect("moving") - 1.0
    }

    /// Sixteen samples a crest.
    fn step(&self) -> f64 {
        self.wavelength / (16.0 * (self.u_2 - self.u_1).abs())
    }

    fn ripple(&self, x: f64, t: f64) -> f64 {
        1.0 + (std::f64::consts::TAU * (x - self.u_2 * t) / self.wavelength).cos()
    }
}

#[test]
fn counted_contacts_match_the_formula() {
    // Full ripples carried by body 2: the pressure's rainflow count is f δ, and part of the crest at the
    // edge of the zone.
    for (u_1, u_2, wavelength) in [
        (1.0, 2.0, 0.5),
        (1.0, 2.0, 0.25),
        (1.0, 2.0, 0.2),
        (1.0, 2.0, 0.1),
        (0.75, 1.25, 0.1),
        (1.25, 0.75, 0.1),
        (-0.5, 0.5, 0.25),
        (1.0, 3.0, 0.05),
    ] {
        let passage = Passage {
            u_1,
            u_2,
            wavelength,
        };
        let mut spec = TrackerSpec::new((-2.0, 2.0), 0, 9.3);
        spec.points = 64;
        let mut tracker = MaterialTracker::new(spec);
        let (nodes, dx) = (1025, 4.0 / 1024.0);
        let mut pressure = vec![0.0_f32; nodes];
        let steps = (2.2 * 4.0 / (u_1.abs() * passage.step())) as usize;
        for s in 0..steps {
            let t = s as f64 * passage.step();
            for (i, p) in pressure.iter_mut().enumerate() {
                let x = -2.0 + dx * i as f64;
                *p = (hertz(x, 0.0) * passage.ripple(x, t)) as f32;
            }
            let line = Line {
                x_first: -2.0,
                dx,
                pressure: &pressure,
                tau_xz: None,
                effective: None,
            };
            tracker.step(u_1 * passage.step(), &line);
        }
        let (tally, expected) = (
            tracker.pressure_cycles().expect("crossed"),
            passage.crests(),
        );
        println!(
            "U1 {u_1}, U2 {u_2}, W {wavelength}: f delta {expected:.2}, counted {:.2} over {} phases; \
             damage-equivalent {:.2}, f delta phi(9.3) {:.2}",
            tally.count,
            tracker.phases(),
            tally.equivalent,
            expected * miner_part(9.3)
        );
        assert!(tracker.phases() >= 8);
        // Between the crests that lie in the zone (f δ) and n = 1 + f δ: the crest that the zone's edge
        // cuts counts when what is left of it passes the gate, 0.6 times in a crossing of this contact.
        assert!((tally.count - expected).abs() <= 1.0);
        if expected >= 10.0 {
            let n = 1.0 + expected;
            let off = (tally.count / expected - 1.0)
                .abs()
                .min((tally.count / n - 1.0).abs());
            assert!(off <= 0.05);
        }
    }
}

#[test]
fn shear_counts_n_near_the_surface_and_one_below() {
    // Full ripples, W = 0.25 a, U2/U1 = 2: n = 1 + f δ = 9.
    let passage = Passage {
        u_1: 1.0,
        u_2: 2.0,
        wavelength: 0.25,
    };
    let n = 1.0 + passage.crests();
    let spec = spec(128, 16, Symmetry::MirrorY);
    let mut engine = StressEngine::new(&spec).expect("valid");
    let mut slice = SliceOut::new(&spec);
    let mut tracker = MaterialTracker::new(TrackerSpec::new((-HALF, HALF), 16, 9.3));
    let mut pressure = vec![0.0_f32; spec.nx * spec.ny];
    for s in 0..(2.1 * 4.0 / passage.step()) as usize {
        let t = s as f64 * passage.step();
        for j in 0..spec.ny {
            for i in 0..spec.nx {
                let x = spec.x_first + spec.dx * i as f64;
                let p = hertz(x, spec.dy * j as f64) * passage.ripple(x, t);
                pressure[j * spec.nx + i] = p as f32;
            }
        }
        engine.load(&pressure, None);
        engine.slice(&mut slice);
        let line = Line {
            x_first: spec.x_first,
            dx: spec.dx,
            pressure: &pressure[..spec.nx],
            tau_xz: Some(&slice.sxz),
            effective: Some(&slice.effective),
        };
        tracker.step(passage.u_1 * passage.step(), &line);
    }
    println!("n by formula {n:.1}");
    for (k, z) in spec.depths.iter().enumerate() {
        let tally = tracker.shear_cycles(k).expect("crossed");
        println!(
            "z = {z:.3} a: {:.2} shear cycles, equivalent {:.2}, range {:.3} p_h",
            tally.count, tally.equivalent, tally.range
        );
        if (0.02..passage.wavelength / 2.0).contains(z) {
            assert!((tally.count - n).abs() <= 0.1 * n, "near the surface: n");
        }
        if *z > 2.0 * passage.wavelength {
            assert!((tally.count - 1.0).abs() < 0.6, "below 2 W: the base cycle");
        }
    }
}
