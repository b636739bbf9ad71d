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

/// The stress of a point while a contact passes over it, unloaded before; memory is made once.
pub struct StressPath {
    states: Vec<Stress6>,
    /// Their deviators by component.
    deviators: [Vec<f64>; 5],
    /// One number a state.
    scratch: Vec<f64>,
}

impl StressPath {
    /// Memory for a path of so many states.
    pub fn new(states: usize) -> Self {
        let room = || Vec::with_capacity(states + 1);
        Self {
            states: Vec::with_capacity(states + 1),
            deviators: std::array::from_fn(|_| room()),
            scratch: room(),
        }
    }

    /// Takes a path.
    pub fn take(&mut self, history: impl Iterator<Item = Stress6>) {
        self.states.clear();
        self.states.push(Stress6::default());
        self.states.extend(history);
        let rows = self.deviators.iter_mut();
        for row in rows.chain([&mut self.scratch]) {
            row.resize(self.states.len(), 0.0);
        }
        for (at, state) in self.states.iter().enumerate() {
            for (row, component) in self.deviators.iter_mut().zip(deviator(*state)) {
                row[at] = component;
            }
        }
    }

    fn deviator(&self, at: usize) -> Deviator {
        std::array::from_fn(|c| self.deviators[c][at])
    }

    /// The state farthest from `centre`; squares of the distances of all are left in the scratch.
    fn farthest(&mut self, centre: &Deviator) -> Deviator {
        distances(&self.deviators, centre, &mut self.scratch);
        self.deviator(greatest(&self.scratch))
    }

    /// Centre of the smallest sphere that holds it.
    fn centre(&mut self) -> Deviator {
        let a = self.farthest(&[0.0; 5]);
        let b = self.farthest(&a);
        let mut centre: Deviator = std::array::from_fn(|c| 0.5 * (a[c] + b[c]));
        for step in 0..WALK {
            let far = self.farthest(&centre);
            let part = 1.0 / (step as f64 + 3.0);
            for (c, f) in centre.iter_mut().zip(far) {
                *c += part * (f - *c);
            }
        }
        centre
    }

    /// Dang Van's risk with weight `alpha` of the hydrostatic stress.
    pub fn dang_van(&mut self, alpha: f64) -> f64 {
        let centre = self.centre();
        let minus_centre = from_deviator(centre).times(-1.0);
        // Maximum shear is √J2 at most: where that is too little, no angle need be known.
        distances(&self.deviators, &centre, &mut self.scratch);
        for (bound, state) in self.scratch.iter_mut().zip(&self.states) {
            *bound = (0.5 * *bound).sqrt() * (1.0 + 1e-12) + alpha * state.mean();
        }
        let risk = |at: usize| {
            let deviator = from_deviator(self.deviator(at));
            deviator.plus(minus_centre).max_shear() + alpha * self.states[at].mean()
        };
        let most = risk(greatest(&self.scratch));
        (0..self.states.len()).fold(most, |most, at| {
            if self.scratch[at] > most {
                most.max(risk(at))
            } else {
                most
            }
        })
    }

    /// Findley's risk with weight `k` of the normal stress, and the angle of the worst plane's normal from x
    /// towards z, rad.
    pub fn findley(&self, k: f64) -> (f64, f64) {
        let angle = |plane: usize| std::f64::consts::PI * plane as f64 / PLANES as f64;
        let normals = std::array::from_fn(|plane| angle(plane).sin_cos());
        let planes = along_planes(&self.states, &normals);
        let risks = planes.low.iter().zip(&planes.high).zip(&planes.pull);
        let risks = risks.map(|((low, high), pull)| 0.5 * (high - low) + k * pull);
        risks.enumerate().fold((0.0, 0.0), |worst, (plane, risk)| {
            if risk > worst.0 {
                (risk, angle(plane))
            } else {
                worst
            }
        })
    }
}

/// Least and greatest shear on each of Findley's planes, and the greatest normal stress.
struct OnPlanes {
    low: [f64; PLANES],
    high: [f64; PLANES],
    pull: [f64; PLANES],
}

dispatched! {
/// Squares of the distances of all states from `centre`.
fn distances(deviators: &[Vec<f64>; 5], centre: &Deviator, out: &mut [f64]) {
    let n = out.len();
    let [a, b, c, d, e] = deviators;
    let (a, b, c, d, e) = (&a[..n], &b[..n], &c[..n], &d[..n], &e[..n]);
    for (i, out) in out.iter_mut().enumerate() {
        *out = distance_2(&[a[i], b[i], c[i], d[i], e[i]], centre);
    }
}
}

/// Of numbers: a maximum in one instruction.
fn greater(a: f64, b: f64) -> f64 {
    if a > b { a } else { b }
}

dispatched! {
/// Where the first of the greatest stands.
fn greatest(values: &[f64]) -> usize {
    let (eights, rest) = values.as_chunks::<8>();
    let mut lanes = [f64::NEG_INFINITY; 8];
    for eight in eights {
        for (most, value) in lanes.iter_mut().zip(eight) {
            *most = greater(*value, *most);
        }
    }
    let most = lanes.iter().chain(rest).fold(f64::NEG_INFINITY, |most, value| greater(*value, most));
    let holds = |eight: &[f64; 8]| eight.iter().map(|value| u8::from(*value == most)).sum::<u8>() > 0;
    let before = 8 * eights.iter().position(holds).unwrap_or(eights.len());
    let place = values[before..].iter().position(|value| *value == most);
    place.map_or(0, |place| before + place)
}
}

dispatched! {
/// What all `states` do on the planes of these normals (sine and cosine).
fn along_planes(states: &[Stress6], normals: &[(f64, f64); PLANES]) -> OnPlanes {
    let mut on = OnPlanes { low: [0.0; PLANES], high: [0.0; PLANES], pull: [0.0; PLANES] };
    let (sines, cosines) = (normals.map(|of| of.0), normals.map(|of| of.1));
    for s in states {
        for plane in 0..PLANES {
            let (sin, cos) = (sines[plane], cosines[plane]);
            let normal = s.xx * cos * cos + s.zz * sin * sin + 2.0 * s.xz * sin * cos;
            let shear = (s.zz - s.xx) * sin * cos + s.xz * (cos * cos - sin * sin);
            on.low[plane] = -greater(-shear, -on.low[plane]);
            on.high[plane] = greater(shear, on.high[plane]);
            on.pull[plane] = greater(normal, on.pull[plane]);
        }
    }
    on
}
}

#[cfg(test)]
mod tests {
    use super::*;
    use approx::assert_relative_eq;
    use proptest::prelude::*;

    fn path(state: impl Fn(f64) -> Stress6) -> StressPath {
        let mut path = StressPath::new(0);
        path.take((0..=200).map(|i| state(f64::from(i) / 200.0)));
        path
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
        let mut history = path(|t| Stress6 {
            xz: (std::f64::consts::TAU * t).sin(),
            ..Stress6::default()
        });
        let risk = history.dang_van(0.3);
        let (findley, angle) = history.findley(0.0);
        println!("shear ±1: Dang Van {risk:.4}, Findley {findley:.4} at {angle:.2}");
        assert!((risk - 1.0).abs() < 5e-3 && (findley - 1.0).abs() < 1e-3);
    }

    #[test]
    fn pulsating_pull_and_push() {
        // 0 → 1 → 0 along x: shear of half the amplitude ½·½, hydrostatic ⅓ of the stress.
        let mut pull = path(|t| Stress6 {
            xx: 1.0 - (2.0 * t - 1.0).abs(),
            ..Stress6::default()
        });
        let risk = pull.dang_van(0.3);
        assert!((risk - (0.25 + 0.1)).abs() < 2e-3, "{risk}");
        let mut push = StressPath::new(0);
        push.take(pull.states.iter().map(|s| s.times(-1.0)));
        let risk = push.dang_van(0.3);
        // Pressure helps only while it lasts: the unloaded state has the same shear and none of it.
        assert!((risk - 0.25).abs() < 2e-3, "{risk}");
        let (f, _) = pull.findley(0.3);
        // max over angles of ½ sin 2φ · ½ + 0.3 cos²φ = ¼ (sin 2φ + 0.6 cos 2φ) + 0.15.
        let exact = 0.25 * (1.0_f64 + 0.36).sqrt() + 0.15;
        println!("pulsating pull: Findley {f:.4}, exact {exact:.4}");
        assert!((f - exact).abs() < 2e-3);
    }

    #[test]
    fn a_circle_of_shears_has_its_radius() {
        let mut history = path(|t| {
            let (sin, cos) = (std::f64::consts::TAU * t).sin_cos();
            Stress6 {
                xz: 0.5 + cos,
                yz: sin,
                ..Stress6::default()
            }
        });
        // The zero state lies inside the circle; its centre is (0.5, 0).
        let risk = history.dang_van(0.0);
        println!("circle of radius 1: {risk:.4}");
        assert!((risk - 1.0).abs() < 1e-2);
    }

    proptest! {
        #[test]
        fn no_state_that_is_skipped_is_worse(
            states in proptest::collection::vec(proptest::array::uniform6(-1.0..1.0), 1..40),
            alpha in -0.5..0.5,
        ) {
            let mut path = StressPath::new(0);
            path.take(states.iter().map(|state| Stress6::of(*state)));
            let risk = path.dang_van(alpha);
            let centre = from_deviator(path.centre());
            let all = path.states.iter().map(|state| {
                let mean = state.mean();
                let apart = state.plus(centre.times(-1.0));
                apart.max_shear() + alpha * mean
            });
            let most = all.fold(f64::NEG_INFINITY, f64::max);
            prop_assert!((risk - most).abs() < 1e-9, "{risk} {most}");
        }
    }
}
