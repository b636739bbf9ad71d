//! A gear's tooth while the contact rides along it: what stands over the path of contact, and where on the gears that is.

use asperity_engine::math::number::{GPA, MM};
use asperity_engine::physics::gear::LineOfAction;
use asperity_engine::physics::line::hertz_from_load;
use asperity_engine::scene::{Scene, Tooth};

/// Width and height of a picture of the gears, in modules.
pub const PICTURE: [f64; 2] = [7.2, 5.0];

/// A curve over the path: mm from A, value.
pub type PathValues = Vec<[f64; 2]>;

/// What the run has, and what it stands for where that is another.
#[derive(Debug, Clone, PartialEq)]
pub struct PathLines {
    /// In steps where the script changes it in steps.
    pub run: PathValues,
    /// Of the tooth itself; empty where it is the same.
    pub tooth: PathValues,
}

impl PathLines {
    /// Hertz pressure, GPa, and sliding by the script, which changes them in steps; sliding and radius, mm, of the tooth
    /// itself.
    pub fn of(scene: &Scene, tooth: &Tooth, line: &LineOfAction) -> [Self; 3] {
        let e_prime_pa = scene.e_prime_pa();
        let scripted = |key: &str, value: &dyn Fn(f64) -> f64| {
            let set = scene.events.iter().filter_map(|event| {
                let place_mm = (tooth.place_m(line, event.at_s) - line.a) * MM;
                Some([place_mm, value(*event.set.get(key)?)])
            });
            in_steps(set, (line.e - line.a) * MM)
        };
        let gears = tooth.gears();
        let over = |value: &dyn Fn(f64) -> f64| -> PathValues {
            (0..=48)
                .map(|k| line.a + (line.e - line.a) * f64::from(k) / 48.0)
                .map(|place_m| [(place_m - line.a) * MM, value(place_m)])
                .collect()
        };
        // U2/U1 = ω2 ρ2/(ω1 ρ1).
        let ratio = f64::from(gears.teeth[0]) / f64::from(gears.teeth[1]);
        let sliding = over(&|s| {
            let (one, two) = (s, ratio * (line.length - s));
            2.0 * (two - one) / (two + one)
        });
        let pressure = |load: f64| {
            let hertz = hertz_from_load(scene.contact.rx_m, e_prime_pa, load);
            GPA.of(hertz.p_max_pa)
        };
        [
            PathLines {
                run: scripted("load.force_n_per_m", &pressure),
                tooth: Vec::new(),
            },
            PathLines {
                run: scripted("motion.slide_roll", &|slide_roll| slide_roll),
                tooth: sliding,
            },
            PathLines {
                run: over(&|s| MM * s * (line.length - s) / line.length),
                tooth: Vec::new(),
            },
        ]
    }
}

/// Values that hold from their place to the next, or to the end.
fn in_steps(set: impl Iterator<Item = [f64; 2]>, end: f64) -> PathValues {
    let mut steps: PathValues = Vec::new();
    for [place, value] in set.filter(|[place, _]| *place < end) {
        if let Some([_, before]) = steps.last().copied() {
            steps.push([place, before]);
        }
        steps.push([place, value]);
    }
    let last = steps.last().map(|[_, value]| [end, *value]);
    steps.extend(last);
    steps
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_a_script_sets_holds_until_it_is_set_again() {
        let set = [[0.0, 1.0], [2.0, 3.0], [9.0, 7.0]].into_iter();
        let steps = in_steps(set, 5.0);
        assert_eq!(steps, [[0.0, 1.0], [2.0, 1.0], [2.0, 3.0], [5.0, 3.0]]);
        assert!(in_steps(std::iter::empty(), 5.0).is_empty());
    }
}
