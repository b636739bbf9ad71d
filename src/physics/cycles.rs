//! Stress cycles per loading cycle, from kinematics.
//!
//! ```text
//! Δt_i = L/|U_i|     δ_i = |U2 − U1| Δt_i     n_i = 1 + f_j δ_i
//! ```
//! | symbol | meaning | unit |
//! |---|---|---|
//! | L | length of the contact zone along x | m |
//! | δ_i | sliding of the mating surface over a point of body i in one loading cycle | m |
//! | f_j | crests per length of the *mating* surface: it is that one which imposes the micro-cycles | 1/m |
//!
//! Computed from both speeds, never from S: U1 = −U2 stays finite. A body at rest never ends its
//! loading cycle: for it only the rate `f_j |U2 − U1|` (contacts per second) has a meaning.
//! Source: Pu, Zhu, Wang and Wang (2016), kinematics of section 2 as restated in the abstract.

/// Cycles of a point of one body.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Contacts {
    /// n: stress cycles in one loading cycle.
    PerLoadingCycle(f64),
    /// The body rests: contacts per second of a point that stays in the zone.
    PerSecond(f64),
}

impl Contacts {
    /// n, where there is a loading cycle.
    pub fn per_loading_cycle(self) -> Option<f64> {
        match self {
            Self::PerLoadingCycle(n) => Some(n),
            Self::PerSecond(_) => None,
        }
    }
}

/// Contacts of a point of the body that moves at `own_m_s` while the other moves at `mating_m_s` with
/// `mating_crests_per_m`, in a zone of length `zone_m`.
pub fn contacts(own_m_s: f64, mating_m_s: f64, mating_crests_per_m: f64, zone_m: f64) -> Contacts {
    let rate = mating_crests_per_m * (mating_m_s - own_m_s).abs();
    if own_m_s == 0.0 {
        Contacts::PerSecond(rate)
    } else {
        Contacts::PerLoadingCycle(1.0 + rate * zone_m / own_m_s.abs())
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn worked_values() {
        // f L = 20: n of the slower and of the faster body.
        for (s, slow, fast) in [
            (0.0, 1.0, 1.0),
            (0.05, 2.03, 1.98),
            (0.10, 3.11, 2.90),
            (0.25, 6.71, 5.44),
            (0.50, 14.33, 9.00),
        ] {
            let (one, two) = (1.0 - 0.5 * s, 1.0 + 0.5 * s);
            let n = |own, mating| {
                contacts(own, mating, 20.0, 1.0)
                    .per_loading_cycle()
                    .expect("the body moves")
            };
            assert!((n(one, two) - slow).abs() < 5e-3, "S = {s}");
            assert!((n(two, one) - fast).abs() < 5e-3, "S = {s}");
        }
    }

    #[test]
    fn opposite_speeds_are_finite_and_rest_is_a_rate() {
        assert_eq!(
            contacts(1.0, -1.0, 10.0, 1.0),
            Contacts::PerLoadingCycle(21.0)
        );
        assert_eq!(contacts(0.0, 2.0, 10.0, 1.0), Contacts::PerSecond(20.0));
    }
}
