//! Life integrals and the factors of life against published and computed values.
//! Every test prints the numbers that it asserts.

use asperity::solve::stress::{StressEngine, StressSpec, Symmetry, VolumeOut};

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
