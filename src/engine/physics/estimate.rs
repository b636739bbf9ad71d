//! What a change of operating point does to the life, before any simulation of it: by closed forms, and scaled from
//! what was simulated.
//!
//! ```text
//! n_i      = 1 + f_j · 2a · |U2 − U1| / |U_i|          contacts per loading cycle of body i
//! a, p_h   ∝ F^(1/k)                                    Hertz, k = 3; of a line k = 2
//!
//! formula  cycles   = 1 / max(n1, n2)                  by contacts; by damage with
//!                     n_i = U_i/U_fast + f_j 2a |U2 − U1|/U_fast φ(c) w^c,   w = 2 δ_j/(1 + δ_1 + δ_2) <= 1
//!                     δ: pressure wave over p_h; φ: [`miner_part`]; at the surface, and so an upper bound
//!          peaks    = (J_waves/J_smooth)^(−1/e)         [`ripple::ln_peaks`], waves flattened by the film's M and L
//!          traction = (J(µ)/J(0))^(−1/e)                [`ripple::sliding_integral`]
//!          µ        = min(τ0 asinh(η |S| U/(h τ0)), γ p)/p      η at the mean Hertz pressure p, h by regression;
//!                     the boundary coefficient where h is below the contact film, or there is no oil
//!          load     = (p_h/p_h0)^−(c + k/e)             what the load itself costs
//! scaled   ln x     = ln x_0 · ln formula / ln formula_0        x: peaks, traction;  cycles in proportion
//! life     = cycles · peaks · traction                  reference at the same load
//! ```
//!
//! Subscript 0 is the *anchor*: a state that was simulated and has settled. `f_j` is the number of crests of the
//! mating surface per metre along x, `c` and `e` the stress exponent and Weibull slope of the Zaretsky life, of which
//! the load's line follows with `I ∝ p_h^(c e) a^k` and `N ∝ I^(−1/e)`. Scaling in the exponent meets the smooth
//! contact without sliding (every factor 1) and the anchor; beyond the anchor, where the two have nothing in common (one
//! raises life, the other lowers it, or they differ beyond [`ALIKE`]), factors are scaled in proportion.
//!
//! The formula never sees a simulation. How far it is off: `tests/screen/formula.rs`. `n_i` is [`contacts`]'s.
//!
//! [`contacts`]: EstimateBasis::contacts

mod count;
mod oil;

pub use count::Count;
pub use oil::{FilmBasis, OilBasis};

use crate::physics::cycles::{BodyId, Kinematics};
use crate::physics::fatigue::LifeLaw;
use crate::physics::hertz::ContactKind;
use crate::physics::life_models::LifeEquation;
use crate::physics::ripple::{PressureWave, amplitude_ratio, ln_peaks, sliding_integral};

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
    /// Entrainment speed, m/s.
    pub entrainment_m_s: f64,
}

/// A plane wave of a surface.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct SurfaceWave {
    /// Wavenumbers 2π/W along x and y, rad/m; (0, 0): none.
    pub wavenumber_per_m: [f64; 2],
    /// Its amplitude over the body's.
    pub share: f64,
}

/// What does not change while knobs are turned.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct EstimateBasis {
    /// Crests of body 1's surface per metre along x, 1/m (0: longitudinal ridges, or smooth).
    pub crests_1_per_m: f64,
    /// Same for body 2, 1/m.
    pub crests_2_per_m: f64,
    /// Point or line.
    pub shape: ContactKind,
    /// Section through the contact by which stress goes: that of a line for wide ellipses.
    pub section: ContactKind,
    /// A load, N (a line: N/m), at which the next two hold.
    pub load_n: f64,
    /// Hertz half-width along x at that load, m.
    pub half_width_m: f64,
    /// Maximum Hertz pressure at that load, Pa.
    pub p_hertz_pa: f64,
    /// Plane waves of both surfaces.
    pub waves: [[SurfaceWave; 2]; 2],
    /// E', Pa.
    pub e_prime_pa: f64,
    /// Poisson's ratio.
    pub poisson: f64,
    /// c and e.
    pub law: LifeLaw,
    /// The model, for its exponents: what is integrated is the volume of the effective stress (Zaretsky) whatever it says.
    pub equation: LifeEquation,
    /// How cycles enter.
    pub count: Count,
    /// Oil; `None`: dry.
    pub oil: Option<OilBasis>,
    /// Boundary friction.
    pub boundary: f64,
    /// ln J(µ)/J(0) at [`FRICTIONS`].
    pub ln_traction: [f64; FRICTIONS.len()],
}

/// Friction coefficients at which the sliding contact's integral is taken; straight lines between and beyond.
pub const FRICTIONS: [f64; 7] = [0.0, 0.04, 0.08, 0.12, 0.16, 0.2, 0.3];

/// Ratio of logarithms, and its inverse, up to which a simulated factor is scaled in the exponent.
pub const ALIKE: f64 = 4.0;

/// The factors of a life relative to the smooth contact in rolling.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Factors {
    /// Of cycles; `None`: a body stands, no loading cycle of it ends, and contacts are counted in its own.
    pub cycle: Option<f64>,
    /// Of pressure peaks.
    pub peak: f64,
    /// Of traction.
    pub traction: f64,
    /// What the load costs against that of the scene.
    pub load: f64,
}

impl Factors {
    /// Cycles, peaks and traction: relative life at the same load.
    pub fn life(&self) -> Option<f64> {
        self.cycle.map(|cycle| cycle * self.peak * self.traction)
    }
}

/// A simulated, settled state from which lives are scaled.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Anchor {
    /// The contact that was simulated.
    pub loaded: Loaded,
    /// What was found.
    pub simulated: Factors,
    /// The formula there.
    pub formula: Factors,
}

impl Anchor {
    /// What was simulated of a contact at a slide-to-roll ratio, and the formula there.
    pub fn new(basis: &EstimateBasis, loaded: Loaded, slide_roll: f64, simulated: Factors) -> Self {
        Self {
            loaded,
            simulated,
            formula: loaded.factors(basis, slide_roll),
        }
    }

    /// What was simulated, brought to where the formula says `now`.
    pub fn scaled(&self, now: &Factors) -> Factors {
        let (own, then) = (&self.simulated, &self.formula);
        Factors {
            cycle: own
                .cycle
                .zip(then.cycle)
                .zip(now.cycle)
                .map(|((own, then), now)| own * now / then),
            peak: brought(own.peak, then.peak, now.peak),
            traction: brought(own.traction, then.traction, now.traction),
            load: own.load * now.load / then.load,
        }
    }
}

/// `own`, simulated where the formula says `then`, to where it says `now`.
fn brought(own: f64, then: f64, now: f64) -> f64 {
    if then == now {
        return own;
    }
    if then == 1.0 {
        return own * now;
    }
    let part = now.ln() / then.ln();
    if (0.0..=1.0).contains(&part) || (1.0 / ALIKE..=ALIKE).contains(&(own.ln() / then.ln())) {
        // Between there and the smooth contact, which has a factor of 1, nothing else ends at both.
        own.powf(part)
    } else if part > 1.0 {
        own * now / then
    } else {
        now
    }
}

/// A contact as load, amplitudes and speed make it, whatever the sliding.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Loaded {
    at: OperatingPoint,
    /// Hertz half-width along x, m.
    pub half_width_m: f64,
    /// Maximum Hertz pressure, Pa.
    pub p_hertz_pa: f64,
    /// Central film by regression, m; 0: dry.
    pub film_m: f64,
    /// Peak factor.
    pub peak: f64,
    /// Pressure waves of both bodies over p_h.
    waves: [f64; 2],
}

impl Loaded {
    /// Whether it is the contact at a point, too.
    pub fn holds_at(&self, point: &OperatingPoint) -> bool {
        let slide_roll = self.at.slide_roll;
        self.at
            == OperatingPoint {
                slide_roll,
                ..*point
            }
    }

    /// The formula at a slide-to-roll ratio.
    pub fn factors(&self, basis: &EstimateBasis, slide_roll: f64) -> Factors {
        let point = OperatingPoint {
            slide_roll,
            ..self.at
        };
        let (n_1, n_2) = match basis.count {
            Count::Contacts => basis.contacts(&point),
            Count::Damage => {
                let [one, two] = basis.by_damage(&point, self.waves);
                (Some(one), Some(two))
            }
        };
        let friction = self.friction(basis, slide_roll);
        Factors {
            cycle: n_1.zip(n_2).map(|(first, second)| 1.0 / first.max(second)),
            peak: self.peak,
            traction: (-basis.ln_traction(friction) / basis.law.weibull_slope).exp(),
            load: load_factor(
                basis.shape,
                self.p_hertz_pa / basis.p_hertz_pa,
                (basis.equation, basis.law),
            ),
        }
    }

    /// Friction coefficient.
    pub fn friction(&self, basis: &EstimateBasis, slide_roll: f64) -> f64 {
        if slide_roll == 0.0 {
            return 0.0;
        }
        let sliding_m_s = (slide_roll * self.at.entrainment_m_s).abs();
        let film = basis.oil.filter(|oil| self.film_m > oil.contact_film_m);
        film.map_or(basis.boundary, |oil| {
            oil.friction(basis.shape, self.p_hertz_pa, self.film_m, sliding_m_s)
        })
    }
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
    /// By closed forms alone.
    pub formula: Factors,
    /// Scaled from the last simulated state; `None`: there is none.
    pub scaled: Option<Factors>,
}

impl Estimate {
    /// The better of the two: scaled where something was simulated.
    pub fn best(&self) -> Factors {
        self.scaled.unwrap_or(self.formula)
    }
}

/// What a load factor of 1 becomes when the Hertz pressure is multiplied by `pressure_ratio`: by Zaretsky's model
/// `r^−(c + k/e)`, k 3 for a point and 2 for a line; of a limit it is that without it.
pub fn load_factor(
    shape: ContactKind,
    pressure_ratio: f64,
    (equation, law): (LifeEquation, LifeLaw),
) -> f64 {
    let sides = f64::from(shape.order()) - 1.0;
    pressure_ratio.powf(-equation.unlimited_exponent(law, sides))
}

/// ln J(µ)/J(0) of a section at [`FRICTIONS`], over so high a power of stress.
pub fn ln_tractions(section: ContactKind, poisson: f64, exponent: f64) -> [f64; FRICTIONS.len()] {
    let integral = |friction| sliding_integral(section, poisson, exponent, friction).ln();
    let smooth = integral(0.0);
    FRICTIONS.map(|friction| integral(friction) - smooth)
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

    /// The contact at a point: film and peaks, some milliseconds.
    pub fn loaded(&self, point: &OperatingPoint) -> Loaded {
        let size = self.size_ratio(point.load_n);
        let (half_width_m, p_hertz_pa) = (self.half_width_m * size, self.p_hertz_pa * size);
        let speed_m_s = point.entrainment_m_s.abs();
        let flow = self.oil.map(|oil| oil.film.at(point.load_n, speed_m_s));
        let mut waves = [PressureWave::default(); 4];
        let amplitudes = [point.amplitude_1_m, point.amplitude_2_m];
        for (body, amplitude_m) in amplitudes.into_iter().enumerate() {
            for (k, wave) in self.waves[body].iter().enumerate() {
                let [x, y] = wave.wavenumber_per_m;
                let wavenumber = x.hypot(y);
                if wavenumber == 0.0 {
                    continue;
                }
                let length = std::f64::consts::TAU / (wavenumber * half_width_m);
                let kept = flow.map_or(0.0, |(_, m, l)| amplitude_ratio(self.shape, length, m, l));
                let flattened_m = amplitude_m * wave.share * (1.0 - kept);
                waves[2 * body + k] = PressureWave {
                    wavenumber: [x * half_width_m, y * half_width_m],
                    pressure: 0.25 * self.e_prime_pa * wavenumber * flattened_m / p_hertz_pa,
                    body,
                };
            }
        }
        let height = |body: usize| waves[2 * body].pressure + waves[2 * body + 1].pressure;
        let heights = [height(0), height(1)];
        let exponent = self.equation.over_stress(self.law);
        let ln = ln_peaks(self.section, self.poisson, exponent, &waves);
        Loaded {
            at: *point,
            half_width_m,
            p_hertz_pa,
            film_m: flow.map_or(0.0, |(film_m, _, _)| film_m),
            peak: (-ln / self.law.weibull_slope).exp(),
            waves: heights,
        }
    }

    /// The estimate at `point`, where the contact is `loaded`; scaled from `anchor`, where there is one.
    pub fn estimate(
        &self,
        loaded: &Loaded,
        anchor: Option<&Anchor>,
        point: &OperatingPoint,
    ) -> Estimate {
        let (n_body_1, n_body_2) = self.contacts(point);
        let formula = loaded.factors(self, point.slide_roll);
        Estimate {
            half_width_m: loaded.half_width_m,
            p_hertz_pa: loaded.p_hertz_pa,
            n_body_1,
            n_body_2,
            formula,
            scaled: anchor.map(|anchor| anchor.scaled(&formula)),
        }
    }

    fn ln_traction(&self, friction: f64) -> f64 {
        let last = FRICTIONS.len() - 2;
        let k = FRICTIONS
            .iter()
            .rposition(|known| *known <= friction)
            .map_or(0, |k| k.min(last));
        let part = (friction - FRICTIONS[k]) / (FRICTIONS[k + 1] - FRICTIONS[k]);
        self.ln_traction[k] + part * (self.ln_traction[k + 1] - self.ln_traction[k])
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

#[cfg(test)]
mod tests {
    #![expect(clippy::unwrap_used, reason = "tests")]
    use super::*;
    use crate::physics::fluid::{Rheology, ViscosityLaw};
    use crate::physics::groups;
    use approx::assert_relative_eq;

    /// f L = 20 on both bodies.
    fn basis() -> EstimateBasis {
        let law = LifeLaw::default();
        let wave = SurfaceWave {
            wavenumber_per_m: [std::f64::consts::TAU * 1e5, 0.0],
            share: 1.0,
        };
        EstimateBasis {
            crests_1_per_m: 1e5,
            crests_2_per_m: 1e5,
            shape: ContactKind::Point,
            section: ContactKind::Point,
            load_n: 800.0,
            half_width_m: 1e-4,
            p_hertz_pa: 1.7e9,
            waves: [[wave, SurfaceWave::default()]; 2],
            e_prime_pa: 2.2e11,
            poisson: 0.3,
            law,
            equation: LifeEquation::Zaretsky,
            count: Count::Contacts,
            oil: Some(OilBasis {
                film: FilmBasis::Point(groups::PointContact {
                    rx_m: 0.01,
                    ry_m: 0.01,
                    e_prime_pa: 2.2e11,
                    viscosity_pa_s: 0.05,
                    alpha_per_pa: 2e-8,
                    entrainment_m_s: 1.0,
                    force_n: 800.0,
                }),
                viscosity_law: ViscosityLaw::Roelands,
                rheology: Rheology::Eyring,
                eyring_pa: 5e6,
                limit: 0.08,
                contact_film_m: 1e-9,
            }),
            boundary: 0.1,
            ln_traction: ln_tractions(ContactKind::Point, 0.3, law.integral_exponent()),
        }
    }

    fn point(slide_roll: f64) -> OperatingPoint {
        OperatingPoint {
            slide_roll,
            load_n: 800.0,
            amplitude_1_m: 2e-8,
            amplitude_2_m: 2e-8,
            entrainment_m_s: 1.0,
        }
    }

    fn formula(at: &OperatingPoint) -> Factors {
        let basis = basis();
        basis.loaded(at).factors(&basis, at.slide_roll)
    }

    fn anchor() -> Anchor {
        let simulated = Factors {
            cycle: Some(1.0 / 14.333333333),
            peak: 0.4,
            traction: 0.9,
            load: 1.0,
        };
        let basis = basis();
        Anchor::new(&basis, basis.loaded(&point(0.5)), 0.5, simulated)
    }

    fn estimate(at: &OperatingPoint) -> Estimate {
        let basis = basis();
        basis.estimate(&basis.loaded(at), Some(&anchor()), at)
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
        let estimate = estimate(&point(2.0));
        assert_eq!((estimate.n_body_1, estimate.best().life()), (None, None));
        assert!(estimate.n_body_2.is_some());
    }

    #[test]
    fn the_anchor_gives_itself_back_and_the_formula_does_not() {
        let estimate = estimate(&point(0.5));
        let scaled = estimate.scaled.unwrap().life().unwrap();
        assert_relative_eq!(scaled, 0.4 * 0.9 / 14.333333333);
        assert_relative_eq!(estimate.p_hertz_pa, 1.7e9);
        assert_eq!(estimate.formula, formula(&point(0.5)));
        assert!(estimate.formula.peak != 0.4 && estimate.formula.traction != 0.9);
    }

    #[test]
    fn pure_rolling_of_smooth_bodies_is_the_reference() {
        let smooth = OperatingPoint {
            amplitude_1_m: 0.0,
            amplitude_2_m: 0.0,
            ..point(0.0)
        };
        for factors in [estimate(&smooth).best(), formula(&smooth)] {
            assert_relative_eq!(factors.life().unwrap(), 1.0, epsilon = 1e-9);
        }
    }

    #[test]
    fn every_knob_moves_the_formula() {
        let home = formula(&point(0.5)).life().unwrap();
        let turned = |turn: fn(&mut OperatingPoint)| {
            let mut at = point(0.5);
            turn(&mut at);
            formula(&at).life().unwrap()
        };
        for (name, life) in [
            ("S", turned(|at| at.slide_roll = 0.3)),
            ("load", turned(|at| at.load_n = 400.0)),
            ("A1", turned(|at| at.amplitude_1_m = 1e-7)),
            ("A2", turned(|at| at.amplitude_2_m = 1e-7)),
            ("U", turned(|at| at.entrainment_m_s = 4.0)),
        ] {
            println!("{name}: {:.3} of {home:.4}", life / home);
            assert!((life / home - 1.0).abs() > 1e-3, "{name}");
        }
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
        let estimate = estimate(&heavy);
        assert_relative_eq!(estimate.p_hertz_pa, 3.4e9, epsilon = 1.0);
        assert_relative_eq!(estimate.half_width_m, 2e-4, epsilon = 1e-12);
        // N ∝ F^−(c + 3/e)/3 = F^−4.344.
        let exponent = estimate.formula.load.ln() / 8.0_f64.ln();
        assert_relative_eq!(exponent, -(31.0 / 3.0 + 2.7) / 3.0, epsilon = 1e-12);
    }

    #[test]
    fn load_enters_by_the_model_of_the_scene() {
        // Lundberg and Palmgren (1947): N ∝ F^−3 in a point contact.
        let equation = LifeEquation::LundbergPalmgren {
            depth_exponent: 7.0 / 3.0,
            cut_off: 0.05,
        };
        let life = load_factor(ContactKind::Point, 2.0, (equation, LifeLaw::default()));
        assert_relative_eq!(life.ln() / 8.0_f64.ln(), -3.0, epsilon = 1e-12);
    }

    #[test]
    fn a_line_follows_the_square_root_of_its_load() {
        let size = ContactKind::Line.size_ratio(4.0);
        assert_relative_eq!(size, 2.0);
        // N ∝ F^−(c + 2/e)/2.
        let life = load_factor(
            ContactKind::Line,
            size,
            (LifeEquation::Zaretsky, LifeLaw::default()),
        );
        assert_relative_eq!(
            life.ln() / 4.0_f64.ln(),
            -0.5 * (31.0 / 3.0 + 1.8),
            epsilon = 1e-12
        );
    }

    #[test]
    fn from_a_smooth_anchor_the_formula_is_all_there_is() {
        let smooth = OperatingPoint {
            amplitude_1_m: 0.0,
            amplitude_2_m: 0.0,
            ..point(0.5)
        };
        let simulated = Factors {
            cycle: Some(1.0),
            peak: 1.0,
            traction: 0.9,
            load: 1.0,
        };
        let basis = basis();
        let anchor = Anchor::new(&basis, basis.loaded(&smooth), 0.5, simulated);
        let now = formula(&point(0.5));
        assert_relative_eq!(anchor.scaled(&now).peak, now.peak);
    }
}
