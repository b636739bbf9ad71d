//! The film of a gear's flank as its standard has it, for its ratio λ_GF: a side comparison, no film of ours.
//!
//! ```text
//! h = 1600 ρ G^0.6 U^0.7 W^−0.13 S^0.22  (h in µm, ρ in mm),     λ_GF = h/Ra,   Ra = (Ra1 + Ra2)/2
//! G = α E_r,   U = η v_Σ/(2 E_r ρ),   W = 2π p²/E_r²,   S = (αη of the contact)/(αη of the bulk)
//! ```
//! | symbol | meaning | unit |
//! |---|---|---|
//! | ρ, E_r | equivalent radius, reduced modulus: R and E' of this program | m, Pa |
//! | α, η | pressure-viscosity coefficient and viscosity of the bulk's oil | 1/Pa, Pa s |
//! | v_Σ | sum of both speeds, 2U | m/s |
//! | p | Hertz pressure, without the standard's factors of dynamics and application | Pa |
//!
//! The contact's oil is that of the bulk warmed by the flash temperature after Blok. α is taken as that of the bulk: how it
//! falls with temperature the standard says for its own oils. Isothermal scenes have S = 1.
//! Source: ISO/TS 6336-22, as quoted in Procedia Struct. Integrity 57 (2024) 199.

use std::f64::consts::PI;

use super::line::LinePoint;

/// Film h, m; `thinner`: viscosity of the contact over that of the bulk, 0 to 1.
pub fn gear_film_m(line: &LinePoint, thinner: f64) -> f64 {
    let modulus = line.e_prime_pa;
    let material = line.alpha_per_pa * modulus;
    let speed = line.viscosity_pa_s * line.entrainment_m_s / (modulus * line.rx_m);
    let load = 2.0 * PI * (line.hertz().p_max_pa / modulus).powi(2);
    1.6 * line.rx_m * material.powf(0.6) * speed.powf(0.7) * load.powf(-0.13) * thinner.powf(0.22)
}

#[cfg(test)]
mod tests {
    use super::*;
    use approx::assert_relative_eq;

    /// By hand: ρ = 8.38 mm, E_r = 226 GPa, α = 20/GPa, η = 10 mPa s, v_Σ = 4 m/s, p = 1000 MPa. G = 4520, G^.6 = 155.98;
    /// U = 1.0560e-11, U^.7 = 2.0729e-8; W = 2π/226² = 1.2302e-4, W^−.13 = 3.2233; h = 1600·8.38·155.98·2.0729e-8·3.2233 =
    /// .13974 µm.
    #[test]
    fn a_film_worked_out_by_hand() {
        let mut line = LinePoint {
            rx_m: 8.38e-3,
            e_prime_pa: 2.26e11,
            viscosity_pa_s: 0.01,
            alpha_per_pa: 2.0e-8,
            entrainment_m_s: 2.0,
            load_n_per_m: 0.0,
        };
        // p² = w E'/(2πR)
        line.load_n_per_m = 2.0 * PI * line.rx_m * 1e18 / line.e_prime_pa;
        assert_relative_eq!(gear_film_m(&line, 1.0), 1.3974e-7, max_relative = 1e-4);
        assert_relative_eq!(
            gear_film_m(&line, 0.5) / gear_film_m(&line, 1.0),
            0.8586,
            max_relative = 1e-4
        );
    }
}
