//! Asperity contacts and stress cycles per loading cycle, from kinematics.
//!
//! ```text
//! Δt_i = L/|U_i|                          time of a material point of body i in the zone
//! δ_i  = |U_2 − U_1| Δt_i                 length of mating surface that slides past it
//! n_i  = 1 + f_j δ_i                      contacts per loading cycle: the passage and f_j δ_i crests
//! ṅ_i  = f_j |U_2 − U_1|                  crests per unit time
//! M_i  = n_i N_i                          stress cycles in N_i loading cycles
//! ```
//! | symbol | meaning | unit |
//! |---|---|---|
//! | L | length of the zone, fixed in space (default 2a) | m, or a |
//! | U_1, U_2 | surface speeds | m/s |
//! | f_j | crests of the **mating** body per length (1/Wx; 0: smooth or longitudinal) | 1/m, or 1/a |
//!
//! The mating surface imposes the micro-cycles. Speeds enter as U_1 and U_2, never as the slide-to-roll
//! ratio, so `U_1 = −U_2` stays finite. A body that stands still (`U_i = 0`) never ends a loading cycle:
//! then crests are counted by time ([`ContactCount::Standing`]).
//! Source: Pu, Zhu, Wang & Wang (2016), Int. J. Fatigue 90, 57-68 (definition of n).

/// Speed below which a body counts as standing, as a part of the other's.
const STANDING: f64 = 1e-9;

/// Contacts that a material point of one body meets.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum ContactCount {
    /// n per loading cycle.
    PerCycle(f64),
    /// The body stands: a point in the zone meets so many crests per unit time.
    Standing {
        /// Crests per unit time.
        rate: f64,
    },
}

impl ContactCount {
    /// n, where the body moves.
    pub fn per_cycle(self) -> Option<f64> {
        match self {
            Self::PerCycle(n) => Some(n),
            Self::Standing { .. } => None,
        }
    }
}

/// Speeds of both bodies and the length of the zone.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Kinematics {
    /// Speed of body 1.
    pub u_1: f64,
    /// Speed of body 2.
    pub u_2: f64,
    /// Length of the zone.
    pub zone: f64,
}

/// One of the two bodies.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, serde::Serialize, serde::Deserialize)]
pub enum BodyId {
    /// The body below.
    #[default]
    One,
    /// The body above.
    Two,
}

impl BodyId {
    /// Both.
    pub const BOTH: [Self; 2] = [Self::One, Self::Two];

    /// Body 1 or 2, as files and screens have it; `None`: there is no such body.
    pub fn of(number: u8) -> Option<Self> {
        Self::BOTH
            .into_iter()
            .find(|body| body.index() + 1 == usize::from(number))
    }

    /// 0 or 1.
    pub fn index(self) -> usize {
        match self {
            Self::One => 0,
            Self::Two => 1,
        }
    }

    /// The body that it runs against.
    #[must_use]
    pub fn mate(self) -> Self {
        match self {
            Self::One => Self::Two,
            Self::Two => Self::One,
        }
    }
}

/// Surface speeds in units of the entrainment speed, `[1 − S/2, 1 + S/2]`: S = (U_2 − U_1)/U.
pub fn speed_ratios(slide_roll: f64) -> [f64; 2] {
    [1.0 - 0.5 * slide_roll, 1.0 + 0.5 * slide_roll]
}

impl Kinematics {
    /// From entrainment speed and slide-to-roll ratio `S = (U_2 − U_1)/U`.
    pub fn from_slide_roll(entrainment: f64, slide_roll: f64, zone: f64) -> Self {
        let [u_1, u_2] = speed_ratios(slide_roll).map(|ratio| entrainment * ratio);
        Self { u_1, u_2, zone }
    }

    /// Speed of a body.
    pub fn speed(&self, body: BodyId) -> f64 {
        match body {
            BodyId::One => self.u_1,
            BodyId::Two => self.u_2,
        }
    }

    /// Sliding speed, |U_2 − U_1|.
    pub fn sliding(&self) -> f64 {
        (self.u_2 - self.u_1).abs()
    }

    /// Time in the zone; `None` for a body that stands.
    pub fn time_in_zone(&self, body: BodyId) -> Option<f64> {
        let own = self.speed(body).abs();
        let fastest = self.u_1.abs().max(self.u_2.abs());
        (own > STANDING * fastest && own > 0.0).then(|| self.zone / own)
    }

    /// Length of mating surface that slides past a point of `body` in one crossing; `None`: it stands.
    pub fn relative_sliding(&self, body: BodyId) -> Option<f64> {
        self.time_in_zone(body).map(|time| self.sliding() * time)
    }

    /// Contacts of `body` against a mate with `mate_density` crests per length.
    pub fn contacts(&self, body: BodyId, mate_density: f64) -> ContactCount {
        match self.relative_sliding(body) {
            Some(length) => ContactCount::PerCycle(1.0 + mate_density * length),
            None => ContactCount::Standing {
                rate: mate_density * self.sliding(),
            },
        }
    }
}

/// Part of full-amplitude crests' damage by Miner's rule: cycles of all heights under a half-ellipse of
/// pressure, relative to as many at full height.
///
/// ```text
/// φ(m) = ½ ∫_{−1}^{1} (1 − x²)^{m/2} dx = (√π/2) Γ(m/2 + 1)/Γ(m/2 + 3/2)
/// ```
/// `f δ φ(m)` equivalent cycles for full ripples; φ(9.3) = 0.381.
pub fn miner_part(m: f64) -> f64 {
    let half = 0.5 * m;
    0.5 * std::f64::consts::PI.sqrt() * (ln_gamma(half + 1.0) - ln_gamma(half + 1.5)).exp()
}

/// ln Γ(x), x > 0, by Stirling's series after a shift to x > 12; 1e-13.
pub fn ln_gamma(x: f64) -> f64 {
    let (mut x, mut shift) = (x, 0.0);
    while x < 12.0 {
        shift -= x.ln();
        x += 1.0;
    }
    let x2 = 1.0 / (x * x);
    let series = (1.0 / 12.0 - x2 * (1.0 / 360.0 - x2 * (1.0 / 1260.0 - x2 / 1680.0))) / x;
    shift + (x - 0.5) * x.ln() - x + 0.5 * std::f64::consts::TAU.ln() + series
}

#[cfg(test)]
mod tests {
    use super::*;
    use approx::assert_relative_eq;

    #[test]
    fn worked_values_of_n() {
        // f L = 20.
        for (s, n_1, n_2) in [
            (0.0, 1.0, 1.0),
            (0.05, 2.03, 1.98),
            (0.10, 3.11, 2.90),
            (0.25, 6.71, 5.44),
            (0.50, 14.33, 9.00),
        ] {
            let k = Kinematics::from_slide_roll(3.0, s, 2.0);
            let n = |body| k.contacts(body, 10.0).per_cycle().unwrap_or(f64::NAN);
            println!(
                "S = {s}: n1 = {:.2}, n2 = {:.2}",
                n(BodyId::One),
                n(BodyId::Two)
            );
            assert!((n(BodyId::One) - n_1).abs() < 5.1e-3);
            assert!((n(BodyId::Two) - n_2).abs() < 5.1e-3);
        }
    }

    #[test]
    fn extremes_of_a_gear_set() {
        // Sliding over zone length: S/(1 ∓ S/2) in size.
        let k = Kinematics::from_slide_roll(2.0, 1.3, 1.0);
        let specific = k.relative_sliding(BodyId::One).unwrap_or(f64::NAN);
        assert_relative_eq!(specific, 1.3 / 0.35, max_relative = 1e-12);
    }

    #[test]
    fn standing_and_counter_rotating_bodies_stay_finite() {
        let standing = Kinematics {
            u_1: 0.0,
            u_2: 3.0,
            zone: 2.0,
        };
        let count = standing.contacts(BodyId::One, 5.0);
        assert_eq!(count, ContactCount::Standing { rate: 15.0 });
        assert_eq!(count.per_cycle(), None);
        assert_eq!(
            standing.contacts(BodyId::Two, 5.0),
            ContactCount::PerCycle(11.0)
        );
        let opposed = Kinematics {
            u_1: -2.0,
            u_2: 2.0,
            zone: 2.0,
        };
        assert_eq!(
            opposed.contacts(BodyId::One, 5.0),
            ContactCount::PerCycle(21.0)
        );
        assert_eq!(
            standing.contacts(BodyId::Two, 0.0),
            ContactCount::PerCycle(1.0)
        );
    }

    #[test]
    fn miner_part_has_its_known_values() {
        println!("phi(9.3) = {:.4}", miner_part(9.3));
        assert!((miner_part(9.3) - 0.381).abs() < 5e-4);
        assert_relative_eq!(miner_part(0.0), 1.0, max_relative = 1e-12);
        assert_relative_eq!(miner_part(2.0), 2.0 / 3.0, max_relative = 1e-12);
        assert_relative_eq!(ln_gamma(5.0), 24.0_f64.ln(), max_relative = 1e-13);
        assert_relative_eq!(
            ln_gamma(0.5),
            std::f64::consts::PI.sqrt().ln(),
            max_relative = 1e-12
        );
    }
}
