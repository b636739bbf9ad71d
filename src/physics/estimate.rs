//! What a change of operating point does to the life, before any simulation of it:
//!
//! ```text
//! n_i      = 1 + f_j · 2a · |U2 − U1| / |U_i|          contacts per loading cycle of body i
//! a, p_h   ∝ F^(1/k)                                    Hertz, k = 3; of a line k = 2
//! cycles   = cycles_0 · max(n1, n2)_0 / max(n1, n2)
//! ln peaks = ln peaks_0 · (A1 + A2) / (A1 + A2)_0
//! life     = cycles · peaks · traction                  reference at the same load
//! load     = (p_h/p_h0)^−(c + k/e)                      what the load itself costs
//! ```
//!
//! Subscript 0 is the *anchor*: a state that was simulated and has settled. `f_j` is the number of
//! crests of the mating surface per metre along x, `c` and `e` the stress exponent and Weibull
//! slope of the Zaretsky life, of which the last line follows with `I ∝ p_h^(c e) a^k` and
//! `N ∝ I^(−1/e)`. The first two lines are exact; the peaks' line is an interpolation in the
//! exponent between the smooth contact (`A = 0`, factor 1) and the anchor, and stands in only
//! until the simulation has caught up. Traction keeps the anchor's factor, but no sliding leaves
//! no sliding traction.
//!
//! `n_i` is [`contacts`]'s.

use crate::physics::cycles::{BodyId, Kinematics};
use crate::physics::hertz::HertzShape;

/// An operating point. SI.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct OperatingPoint {
    /// S = (U2 − U1)/U.
    pub slide_roll: f64,
    /// Normal load, N; of a line N/m.
    pub load_n: f64,
    /// Amplitude of body 1's roughness, m.
    pub amplitude_1_m: f64,
    /// Amplitude of body 2's roughness, m.
    pub amplitude_2_m: f64,
}

/// What does not change while knobs are turned.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct EstimateBasis {
    /// Crests of body 1's surface per metre along x, 1/m (0: longitudinal ridges, or smooth).
    pub crests_1_per_m: f64,
    /// Same for body 2, 1/m.
    pub crests_2_per_m: f64,
    /// Point or line.
    pub shape: HertzShape,
    /// A load, N (a line: N/m), at which the next two hold.
    pub load_n: f64,
    /// Hertz half-width along x at that load, m.
    pub half_width_m: f64,
    /// Maximum Hertz pressure at that load, Pa.
    pub p_hertz_pa: f64,
}

/// A simulated, settled state from which the estimate scales.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Anchor {
    /// Where it was simulated.
    pub at: OperatingPoint,
    /// Its cycle factor.
    pub cycle_factor: f64,
    /// Its peak factor.
    pub peak_factor: f64,
    /// Its traction factor.
    pub traction_factor: f64,
}

/// The estimate. `None` where the formula has nothing to say.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Estimate {
    /// Hertz half-width along x, m.
    pub half_width_m: f64,
    /// Maximum Hertz pressure, Pa.
    pub p_hertz_pa: f64,
    /// Contacts per loading cycle, body 1; `None`: its loading cycle never ends.
    pub n_body_1: Option<f64>,
    /// Contacts per loading cycle, body 2.
    pub n_body_2: Option<f64>,
    /// Cycle factor.
    pub cycle_factor: Option<f64>,
    /// Peak factor; `None` where the anchor was smooth and this point is rough.
    pub peak_factor: Option<f64>,
    /// Traction factor.
    pub traction_factor: f64,
    /// Their product: relative life at the same load.
    pub life_relative: Option<f64>,
}

/// Surface speeds in units of the entrainment speed, `(1 − S/2, 1 + S/2)`.
pub fn speed_ratios(slide_roll: f64) -> (f64, f64) {
    (1.0 - 0.5 * slide_roll, 1.0 + 0.5 * slide_roll)
}

/// What a load factor of 1 becomes when the Hertz pressure is multiplied by `pressure_ratio`:
/// `r^−(c + k/e)`.
pub fn load_factor(
    shape: HertzShape,
    pressure_ratio: f64,
    stress_exponent: f64,
    weibull_slope: f64,
) -> f64 {
    let volume = f64::from(shape.order());
    pressure_ratio.powf(-(stress_exponent + volume / weibull_slope))
}

impl EstimateBasis {
    /// Contacts per loading cycle of both bodies at a point; the zone is 2a at its load.
    pub fn contacts(&self, point: &OperatingPoint) -> (Option<f64>, Option<f64>) {
        let zone_m = 2.0 * self.half_width_m * self.size_ratio(point.load_n);
        let kinematics = Kinematics::from_slide_roll(1.0, point.slide_roll, zone_m);
        let crests_1 = crests(self.crests_1_per_m, point.amplitude_1_m);
        let crests_2 = crests(self.crests_2_per_m, point.amplitude_2_m);
        (
            kinematics.contacts(BodyId::One, crests_2).per_cycle(),
            kinematics.contacts(BodyId::Two, crests_1).per_cycle(),
        )
    }

    /// The estimate at `point`, scaled from `anchor`.
    pub fn estimate(&self, anchor: &Anchor, point: &OperatingPoint) -> Estimate {
        let (n_body_1, n_body_2) = self.contacts(point);
        let cycle_factor = worst(n_body_1, n_body_2)
            .zip(worst_of(self.contacts(&anchor.at)))
            .map(|(now, then)| anchor.cycle_factor * then / now);
        let peak_factor = peaks(anchor, point);
        let traction_factor = if point.slide_roll == 0.0 {
            1.0
        } else {
            anchor.traction_factor
        };
        let size = self.size_ratio(point.load_n);
        Estimate {
            half_width_m: self.half_width_m * size,
            p_hertz_pa: self.p_hertz_pa * size,
            n_body_1,
            n_body_2,
            cycle_factor,
            peak_factor,
            traction_factor,
            life_relative: cycle_factor
                .zip(peak_factor)
                .map(|(cycles, peaks)| cycles * peaks * traction_factor),
        }
    }

    /// a/a_0 = p_h/p_h0 = (F/F_0)^(1/k).
    fn size_ratio(&self, load_n: f64) -> f64 {
        self.shape.size_ratio(load_n / self.load_n)
    }
}

/// A surface without amplitude has no crests.
fn crests(per_m: f64, amplitude_m: f64) -> f64 {
    if amplitude_m > 0.0 { per_m } else { 0.0 }
}

fn worst(n_1: Option<f64>, n_2: Option<f64>) -> Option<f64> {
    n_1.zip(n_2).map(|(first, second)| first.max(second))
}

fn worst_of(n: (Option<f64>, Option<f64>)) -> Option<f64> {
    worst(n.0, n.1)
}

/// `peaks_0^(A/A_0)`, A the sum of both amplitudes: crests that meet add up.
fn peaks(anchor: &Anchor, point: &OperatingPoint) -> Option<f64> {
    let amplitude = point.amplitude_1_m + point.amplitude_2_m;
    let anchored = anchor.at.amplitude_1_m + anchor.at.amplitude_2_m;
    if amplitude == anchored {
        Some(anchor.peak_factor)
    } else if anchored > 0.0 {
        Some(anchor.peak_factor.powf(amplitude / anchored))
    } else {
        None
    }
}

#[cfg(test)]
mod tests {
    #![expect(clippy::unwrap_used, reason = "tests")]
    use super::*;
    use approx::assert_relative_eq;

    /// f L = 20 on both bodies.
    fn basis() -> EstimateBasis {
        EstimateBasis {
            crests_1_per_m: 1e5,
            crests_2_per_m: 1e5,
            shape: HertzShape::Point,
            load_n: 800.0,
            half_width_m: 1e-4,
            p_hertz_pa: 1.7e9,
        }
    }

    fn point(slide_roll: f64) -> OperatingPoint {
        OperatingPoint {
            slide_roll,
            load_n: 800.0,
            amplitude_1_m: 2e-7,
            amplitude_2_m: 2e-7,
        }
    }

    fn anchor() -> Anchor {
        Anchor {
            at: point(0.5),
            cycle_factor: 1.0 / 14.333333333,
            peak_factor: 0.4,
            traction_factor: 0.9,
        }
    }

    #[test]
    fn counts_match_the_worked_values() {
        // life.md §1, f L = 20; given there to two decimals.
        let table = [
            (0.0, 1.0, 1.0),
            (0.05, 2.03, 1.98),
            (0.10, 3.11, 2.90),
            (0.25, 6.71, 5.44),
            (0.50, 14.33, 9.00),
        ];
        for (slide_roll, n_1, n_2) in table {
            let (first, second) = basis().contacts(&point(slide_roll));
            assert!(
                (first.unwrap() - n_1).abs() < 0.005,
                "n1 at S = {slide_roll}"
            );
            assert!(
                (second.unwrap() - n_2).abs() < 0.005,
                "n2 at S = {slide_roll}"
            );
        }
    }

    #[test]
    fn a_standing_body_has_no_count_and_no_life() {
        let estimate = basis().estimate(&anchor(), &point(2.0));
        assert_eq!((estimate.n_body_1, estimate.life_relative), (None, None));
        assert!(estimate.n_body_2.is_some());
    }

    #[test]
    fn the_anchor_gives_itself_back() {
        let estimate = basis().estimate(&anchor(), &anchor().at);
        assert_relative_eq!(estimate.life_relative.unwrap(), 0.4 * 0.9 / 14.333333333);
        assert_relative_eq!(estimate.p_hertz_pa, 1.7e9);
    }

    #[test]
    fn pure_rolling_of_smooth_bodies_is_the_reference() {
        let smooth = OperatingPoint {
            amplitude_1_m: 0.0,
            amplitude_2_m: 0.0,
            ..point(0.0)
        };
        let estimate = basis().estimate(&anchor(), &smooth);
        assert_relative_eq!(estimate.life_relative.unwrap(), 1.0, epsilon = 1e-9);
    }

    #[test]
    fn only_the_mating_surface_counts() {
        let one_rough = OperatingPoint {
            amplitude_2_m: 0.0,
            ..point(0.5)
        };
        let (n_1, n_2) = basis().contacts(&one_rough);
        assert_eq!(n_1, Some(1.0));
        assert_relative_eq!(n_2.unwrap(), 9.0, epsilon = 1e-12);
    }

    #[test]
    fn load_enters_by_its_cube_root_and_the_stressed_volume() {
        let heavy = OperatingPoint {
            load_n: 6400.0,
            ..point(0.5)
        };
        let estimate = basis().estimate(&anchor(), &heavy);
        assert_relative_eq!(estimate.p_hertz_pa, 3.4e9, epsilon = 1.0);
        assert_relative_eq!(estimate.half_width_m, 2e-4, epsilon = 1e-12);
        // N ∝ F^−(c + 3/e)/3 = F^−4.344.
        let life = load_factor(
            HertzShape::Point,
            estimate.p_hertz_pa / 1.7e9,
            31.0 / 3.0,
            10.0 / 9.0,
        );
        let exponent = life.ln() / 8.0_f64.ln();
        assert_relative_eq!(exponent, -(31.0 / 3.0 + 2.7) / 3.0, epsilon = 1e-12);
    }

    #[test]
    fn a_line_follows_the_square_root_of_its_load() {
        let line = EstimateBasis {
            shape: HertzShape::Line,
            ..basis()
        };
        let heavy = OperatingPoint {
            load_n: 3200.0,
            ..point(0.5)
        };
        let estimate = line.estimate(&anchor(), &heavy);
        assert_relative_eq!(estimate.p_hertz_pa, 3.4e9, epsilon = 1.0);
        // N ∝ F^−(c + 2/e)/2.
        let life = load_factor(HertzShape::Line, 2.0, 31.0 / 3.0, 10.0 / 9.0);
        assert_relative_eq!(
            life.ln() / 4.0_f64.ln(),
            -0.5 * (31.0 / 3.0 + 1.8),
            epsilon = 1e-12
        );
    }

    #[test]
    fn peaks_from_a_smooth_anchor_are_unknown() {
        let mut smooth = anchor();
        smooth.at.amplitude_1_m = 0.0;
        smooth.at.amplitude_2_m = 0.0;
        assert_eq!(basis().estimate(&smooth, &point(0.5)).peak_factor, None);
    }
}
