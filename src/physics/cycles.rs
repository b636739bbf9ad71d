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
/// `mating_crests_per_m`, in a zone of length `zone_m`. (Any consistent units will do.)
pub fn contacts(own_m_s: f64, mating_m_s: f64, mating_crests_per_m: f64, zone_m: f64) -> Contacts {
    let rate = mating_crests_per_m * (mating_m_s - own_m_s).abs();
    if own_m_s == 0.0 {
        Contacts::PerSecond(rate)
    } else {
        Contacts::PerLoadingCycle(1.0 + rate * zone_m / own_m_s.abs())
    }
}

/// Damage of full-amplitude crests by Miner's rule, relative to as many at the greatest height, when their
/// heights follow a half-ellipse of pressure over the crossing.
///
/// ```text
/// φ(m) = ½ ∫_{−1}^{1} (1 − x²)^{m/2} dx = (√π/2) Γ(m/2 + 1)/Γ(m/2 + 3/2)
/// ```
/// `f δ φ(m)` equivalent cycles for ripples that unload fully; φ(9.3) = 0.381. For weak ripples (below half
/// of the pressure) the equivalent is about 1. `M = n N` at peak stress is thus an upper bound on damage.
pub fn miner_part(m: f64) -> f64 {
    let half = 0.5 * m;
    0.5 * std::f64::consts::PI.sqrt() * (ln_gamma(half + 1.0) - ln_gamma(half + 1.5)).exp()
}

/// ln Γ(x), x > 0, by Stirling's series after a shift to x > 12; 1e-13.
fn ln_gamma(x: f64) -> f64 {
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

    #[test]
    fn miner_part_has_its_known_values() {
        println!("phi(9.3) = {:.4}", miner_part(9.3));
        assert!((miner_part(9.3) - 0.381).abs() < 5e-4);
        assert!((miner_part(0.0) - 1.0).abs() < 1e-12);
        assert!((miner_part(2.0) - 2.0 / 3.0).abs() < 1e-12);
        assert!((ln_gamma(5.0) - 24.0_f64.ln()).abs() < 1e-12);
        assert!((ln_gamma(0.5) - std::f64::consts::PI.sqrt().ln()).abs() < 1e-12);
    }
}
