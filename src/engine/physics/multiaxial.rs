//! Multiaxial fatigue criteria on the stress history of a point: Dang Van and Findley.
//!
//! ```text
//! Dang Van   r = max_t [τ(t) + α σ_H(t)]     τ: maximum shear of s(t) − s*,  σ_H = tr σ/3
//!            s*: centre of the smallest sphere that holds the path of the deviator s(t)
//! Findley    r = max over planes [τ_a + k σ_n,max]
//!            τ_a: half of the range of the shear on the plane; σ_n,max: its maximum normal stress
//! ```
//! | symbol | meaning |
//! |---|---|
//! | σ(t) | history, tension positive, unloaded at both ends (the zero state belongs to every history here) |
//! | r | risk, in the unit of stress; the limit is the fatigue strength in shear |
//!
//! The sphere is found in the five dimensions of the deviator (norm of von Mises) by Bădoiu and Clarkson's
//! walk towards the farthest state, from the middle of a far pair: 2e-3 of its radius after 64 steps. Findley's
//! planes have their normal in the plane x z every 5°, which holds the worst plane below the line y = 0 of a
//! contact that is even in y (there σxy = σyz = 0). Sources: see [`super::life_models`]; Bădoiu, M. &
//! Clarkson, K.L. (2003), SODA '03, 801-802.

use super::invariants::Stress6;

/// Steps towards the centre of the smallest sphere.
const WALK: usize = 64;
/// Planes in half a turn.
const PLANES: usize = 36;

/// Deviator in an orthonormal basis: lengths are those of √(s:s).
type Deviator = [f64; 5];

fn deviator(s: Stress6) -> Deviator {
    let m = s.mean();
    let root = std::f64::consts::SQRT_2;
    [
        1.5_f64.sqrt() * (s.xx - m),
        (s.yy - s.zz) / root,
        root * s.xy,
        root * s.xz,
        root * s.yz,
    ]
}

fn from_deviator([a, b, c, d, e]: Deviator) -> Stress6 {
    let root = std::f64::consts::SQRT_2;
    let xx = a / 1.5_f64.sqrt();
    Stress6 {
        xx,
        yy: -0.5 * xx + b / root,
        zz: -0.5 * xx - b / root,
        xy: c / root,
        xz: d / root,
        yz: e / root,
    }
}

fn distance_2(a: &Deviator, b: &Deviator) -> f64 {
    a.iter().zip(b).map(|(a, b)| (a - b) * (a - b)).sum()
}

/// The state farthest from `centre`, the zero state among them.
fn farthest(history: impl Iterator<Item = Stress6>, centre: &Deviator) -> Deviator {
    let (mut best, mut far) = ([0.0; 5], distance_2(&[0.0; 5], centre));
    for state in history {
        let s = deviator(state);
        let d = distance_2(&s, centre);
        if d > far {
            (best, far) = (s, d);
        }
    }
    best
}

/// Dang Van's risk with weight `alpha` of the hydrostatic stress.
pub fn dang_van(history: impl Iterator<Item = Stress6> + Clone, alpha: f64) -> f64 {
    let a = farthest(history.clone(), &[0.0; 5]);
    let b = farthest(history.clone(), &a);
    let mut centre: Deviator = [0, 1, 2, 3, 4].map(|i: usize| 0.5 * (a[i] + b[i]));
    for step in 0..WALK {
        let far = farthest(history.clone(), &centre);
        let part = 1.0 / (step as f64 + 3.0);
        for (c, f) in centre.iter_mut().zip(far) {
            *c += part * (f - *c);
        }
    }
    let minus_centre = from_deviator(centre).times(-1.0);
    let risk = |state: Stress6| {
        let deviator = from_deviator(deviator(state));
        deviator.plus(minus_centre).max_shear() + alpha * state.mean()
    };
    history.map(risk).fold(risk(Stress6::default()), f64::max)
}

/// Findley's risk with weight `k` of the normal stress, and the angle of the worst plane's normal from x
/// towards z, rad.
pub fn findley(history: &(impl Iterator<Item = Stress6> + Clone), k: f64) -> (f64, f64) {
    let mut worst = (0.0, 0.0);
    for plane in 0..PLANES {
        let angle = std::f64::consts::PI * plane as f64 / PLANES as f64;
        let (sin, cos) = angle.sin_cos();
        let (mut low, mut high, mut pull) = (0.0_f64, 0.0_f64, 0.0_f64);
        for s in history.clone() {
            let normal = s.xx * cos * cos + s.zz * sin * sin + 2.0 * s.xz * sin * cos;
            let shear = (s.zz - s.xx) * sin * cos + s.xz * (cos * cos - sin * sin);
            (low, high, pull) = (low.min(shear), high.max(shear), pull.max(normal));
        }
        let risk = 0.5 * (high - low) + k * pull;
        if risk > worst.0 {
            worst = (risk, angle);
        }
    }
    worst
}

#[cfg(test)]
mod tests {
    use super::*;
    use approx::assert_relative_eq;

    fn path(state: impl Fn(f64) -> Stress6) -> Vec<Stress6> {
        (0..=200).map(|i| state(f64::from(i) / 200.0)).collect()
    }

    #[test]
    fn the_basis_keeps_the_state() {
        let s = Stress6::of([1.0, -2.0, 0.5, 0.7, -1.1, 0.3]);
        let back = from_deviator(deviator(s));
        let d = s.mean();
        assert_relative_eq!(back.xx, s.xx - d, max_relative = 1e-12);
        assert_relative_eq!(back.yy, s.yy - d, max_relative = 1e-12);
        assert_relative_eq!(back.zz, s.zz - d, max_relative = 1e-12);
        assert_relative_eq!(
            distance_2(&deviator(s), &[0.0; 5]),
            2.0 * s.j2(),
            max_relative = 1e-12
        );
    }

    #[test]
    fn alternating_shear_risks_its_amplitude() {
        let history = path(|t| Stress6 {
            xz: (std::f64::consts::TAU * t).sin(),
            ..Stress6::default()
        });
        let risk = dang_van(history.iter().copied(), 0.3);
        let (findley, angle) = findley(&history.iter().copied(), 0.0);
        println!("shear ±1: Dang Van {risk:.4}, Findley {findley:.4} at {angle:.2}");
        assert!((risk - 1.0).abs() < 5e-3 && (findley - 1.0).abs() < 1e-3);
    }

    #[test]
    fn pulsating_pull_and_push() {
        // 0 → 1 → 0 along x: shear of half the amplitude ½·½, hydrostatic ⅓ of the stress.
        let pull = path(|t| Stress6 {
            xx: 1.0 - (2.0 * t - 1.0).abs(),
            ..Stress6::default()
        });
        let risk = dang_van(pull.iter().copied(), 0.3);
        assert!((risk - (0.25 + 0.1)).abs() < 2e-3, "{risk}");
        let push: Vec<Stress6> = pull.iter().map(|s| s.times(-1.0)).collect();
        let risk = dang_van(push.iter().copied(), 0.3);
        // Pressure helps only while it lasts: the unloaded state has the same shear and none of it.
        assert!((risk - 0.25).abs() < 2e-3, "{risk}");
        let (f, _) = findley(&pull.iter().copied(), 0.3);
        // max over angles of ½ sin 2φ · ½ + 0.3 cos²φ = ¼ (sin 2φ + 0.6 cos 2φ) + 0.15.
        let exact = 0.25 * (1.0_f64 + 0.36).sqrt() + 0.15;
        println!("pulsating pull: Findley {f:.4}, exact {exact:.4}");
        assert!((f - exact).abs() < 2e-3);
    }

    #[test]
    fn a_circle_of_shears_has_its_radius() {
        let history = path(|t| {
            let (sin, cos) = (std::f64::consts::TAU * t).sin_cos();
            Stress6 {
                xz: 0.5 + cos,
                yz: sin,
                ..Stress6::default()
            }
        });
        // The zero state lies inside the circle; its centre is (0.5, 0).
        let risk = dang_van(history.iter().copied(), 0.0);
        println!("circle of radius 1: {risk:.4}");
        assert!((risk - 1.0).abs() < 1e-2);
    }
}
