//! Closed forms of heat in a contact: what is quick to know, and what a simulation is compared with.
//!
//! ```text
//! flash temperature, Blok 1937    T = 1.1115 Q'/(√(2a) (√(k₁ρ₁c₁U₁) + √(k₂ρ₂c₂U₂))),   Q' = μ (π/2) p_h a |U2 − U1|
//! inlet, Wilson & Sheu 1983       C = 1/(1 + 0.241 (1 + 14.8 Z^0.83) L_T^0.64),   Z = |S|/2,   L_T = β η0 U²/k_f
//! inlet, Gupta et al. 1992        C = (1 − 13.2 (p_h/E') L_T^0.42)/(1 + 0.213 (1 + 2.23 |S|^0.83) L_T^0.64)
//! ```
//! | symbol | meaning | unit |
//! |---|---|---|
//! | T | greatest rise of both surfaces | K |
//! | Q' | heat made on a strip along the motion, a length across | W/m |
//! | a, p_h | Hertz half-width along the motion, pressure | m, Pa |
//! | k, ρ, c | conductivity, density, heat capacity of a body | W/(m K), kg/m³, J/(kg K) |
//! | C | film over that of the isothermal formula | |
//! | β, η0, k_f | −d ln η/dT, viscosity, conductivity of the oil | 1/K, Pa s, W/(m K) |
//!
//! Blok's formula is that of an elliptic band at high Péclet numbers: to .4 % above 10, 10 to 13 % low for opposed motion; on
//! the centre line of a point it leaves out what flows sideways. Both factors for the inlet differ by as much as they correct: neither
//! is a measure for what is simulated. That of Gupta, Cheng, Zhu, Forster & Schrand (Tribol. Trans. 35, 269) is as later authors
//! quote it.

/// Blok's coefficient of an elliptic band.
const BLOK: f64 = 1.1115;

/// T; `effusivities`: √(kρc) of both bodies, W √s/(m² K).
pub fn blok_k(
    heat_w_m: f64,
    half_width_m: f64,
    effusivities: [f64; 2],
    speeds_m_s: [f64; 2],
) -> f64 {
    let carried: f64 = (effusivities.iter().zip(speeds_m_s))
        .map(|(e, u)| e * u.abs().sqrt())
        .sum();
    BLOK * heat_w_m / ((2.0 * half_width_m).sqrt() * carried)
}

/// C.
pub fn inlet_factor(slide_roll: f64, loading: f64) -> f64 {
    let sliding = 1.0 + 14.8 * (0.5 * slide_roll.abs()).powf(0.83);
    1.0 / (1.0 + 0.241 * sliding * loading.powf(0.64))
}

/// C after Gupta et al.; `strain`: p_h/E'.
pub fn inlet_factor_gupta(slide_roll: f64, loading: f64, strain: f64) -> f64 {
    let sliding = 1.0 + 2.23 * slide_roll.abs().powf(0.83);
    (1.0 - 13.2 * strain * loading.powf(0.42)) / (1.0 + 0.213 * sliding * loading.powf(0.64))
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The published table: L_T .1, .5, 1 at S = 0, .5, 1, 2.
    #[test]
    fn the_inlet_factor_is_that_of_its_table() {
        for (loading, theirs) in [
            (0.1, [0.9477, 0.7612, 0.6601, 0.5341]),
            (0.5, [0.8661, 0.5322, 0.4095, 0.2904]),
            (1.0, [0.8058, 0.4220, 0.3079, 0.2080]),
        ] {
            for (s, theirs) in [0.0, 0.5, 1.0, 2.0].into_iter().zip(theirs) {
                let found = inlet_factor(s, loading);
                assert!((found - theirs).abs() < 1e-4, "{loading} {s}: {found}");
            }
        }
    }

    /// By hand: L_T = .1, S = .5, p_h/E' = .005: (1 − 13.2·.005·.3802)/(1 + .213·2.2544·.2291) = .9749/1.1100.
    #[test]
    fn the_other_inlet_factor_is_worked_out_by_hand() {
        let found = inlet_factor_gupta(-0.5, 0.1, 0.005);
        assert!((found - 0.8783).abs() < 1e-4, "{found}");
        assert_eq!(inlet_factor_gupta(0.0, 0.0, 0.005), 1.0);
    }

    /// Elliptic band at Pe 100 and 25 of equal bodies: .08229 q0 a/k by the integrals; Blok's is within .1 %.
    #[test]
    fn blok_is_the_limit_of_fast_bodies() {
        // q0 = k = a = 1, κ = 1/100 for the faster: speeds 1 and 1/4, effusivity √(k/κ)·√k = 10.
        let heat = std::f64::consts::FRAC_PI_2;
        let found = blok_k(heat, 1.0, [10.0; 2], [1.0, 0.25]);
        assert!((found / 0.08229 - 1.0).abs() < 1e-3, "{found}");
    }
}
