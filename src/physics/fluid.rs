//! Viscosity, density and shear laws of the film, over dimensionless pressure `P = p/p_h`.
//!
//! ```text
//! Barus      ln η̄ = α p
//! Roelands   ln η̄ = (ln η0 + 9.67) [(1 + p/p0)^z − 1],   p0 = 1.962e8 Pa,  z = α p0/(ln η0 + 9.67)
//! density    ρ̄ = 1 + 0.6e-9 p/(1 + 1.7e-9 p)
//! Ree-Eyring ζ = Z η̄/H,   Z = η0 |U2−U1| Rx/(τ0 a²):   the film shears at τ_m = τ0 asinh ζ
//!   secant   1/η̄* = (1/η̄) ζ/asinh ζ                              for the pressure's flow in every direction
//!   along    1/η̄_x = (1/η̄) cosh σ,    σ = τ_m/τ0                  tangent: a small flow rides on a large shear
//!   across   1/η̄_y = (1/η̄) sinh σ/σ                              secant: the shear turns by a small angle
//!   limit    σ = min(asinh ζ, ℓ P),   ℓ = γ p_h/τ0                the stress that the traction has
//! ```
//! | symbol | meaning | unit |
//! |---|---|---|
//! | η̄, ρ̄ | viscosity, density over their values at p = 0 | 1 |
//! | H | film h Rx/a² | 1 |
//! | Z | sliding over Eyring stress; 0: Newtonian | 1 |
//! | γ | limiting shear stress over pressure | 1 |
//!
//! Sources: Barus (1893); Roelands (1966), slope matched to α at p = 0; Dowson and Higginson (1966);
//! Eyring (1936); one effective viscosity for both directions as in Zhu and Hu's codes; along and across the sliding:
//! Ehret, Dowson and Taylor (1998), Proc. R. Soc. A 454, 763-787. Across is the secant form itself; along, oil flows the
//! more easily by σ/tanh σ, 10 to 17 times in gears. With γ̇ = (τ0/η) sinh(τ/τ0) and τ = τ_m + z ∂p/∂x over the film,
//! both follow for small ε = h ∂p/∂x/(2τ0). At any ε the flow along is that of ε → 0 times 3(ε coth ε − 1)/ε² as long as
//! the sliding rules, ζ ≫ sinh ε/ε (Conry, Wang and Cusano 1987): 0.94 at ε = 1, 0.27 at 10, where crests are steep; left
//! out.
//!
//! Where the limit binds, the film carries γp and no more: the oil shears at that stress and what is left of the sliding
//! happens in a plane (at a wall or within) that lets no further oil pass. So the flow's σ is the traction's. Without
//! the limit the flow of such oil would see a stress that its traction denies; with a limit on the traction curve instead
//! (tangent 0) it would have no resistance at all. Near p = 0 the law γp leaves Newtonian oil, which it is there anyway.
//! Free of branches on values, so that loops over nodes become vector code.
//! The exponent is capped at 300 so that a trial pressure cannot overflow; nothing else is clamped.

use crate::math::elementary::{exp, ln};

/// Greatest exponent used for the viscosity.
const EXPONENT_CAP: f64 = 300.0;
/// Roelands' pressure constant, Pa.
const ROELANDS_P0_PA: f64 = 1.962e8;
/// Roelands' constant: -ln of 6.315e-5 Pa s.
const ROELANDS_LN: f64 = 9.67;

/// Viscosity law with its constants made dimensionless.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Viscosity {
    /// `ln η̄ = alpha_p P`.
    Barus {
        /// α p_h.
        alpha_p: f64,
    },
    /// Roelands.
    Roelands {
        /// ln η0 + 9.67 (η0 in Pa s).
        scale: f64,
        /// p_h/p0.
        p_ratio: f64,
        /// z.
        z: f64,
    },
}

impl Viscosity {
    /// Barus' law.
    pub fn barus(alpha_per_pa: f64, p_hertz_pa: f64) -> Self {
        Self::Barus {
            alpha_p: alpha_per_pa * p_hertz_pa,
        }
    }

    /// Roelands' law with slope `alpha_per_pa` at p = 0.
    pub fn roelands(viscosity_pa_s: f64, alpha_per_pa: f64, p_hertz_pa: f64) -> Self {
        let scale = viscosity_pa_s.ln() + ROELANDS_LN;
        Self::Roelands {
            scale,
            p_ratio: p_hertz_pa / ROELANDS_P0_PA,
            z: alpha_per_pa * ROELANDS_P0_PA / scale,
        }
    }

    /// `ln η̄` and its derivative with respect to P.
    #[inline(always)]
    pub fn ln_eta(self, p: f64) -> (f64, f64) {
        let (value, slope) = match self {
            Self::Barus { alpha_p } => (alpha_p * p, alpha_p),
            Self::Roelands { scale, p_ratio, z } => {
                let base = 1.0 + p_ratio * p.max(0.0);
                let power = exp(z * ln(base));
                (scale * (power - 1.0), scale * z * p_ratio * power / base)
            }
        };
        if value > EXPONENT_CAP {
            (EXPONENT_CAP, 0.0)
        } else {
            (value, slope)
        }
    }
}

/// Density law.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Density {
    /// ρ̄ = 1.
    Incompressible,
    /// Dowson-Higginson, ρ̄ = 1 + 0.6 p/(1 + 1.7 p) with p in GPa. Source: Dowson and Higginson (1977).
    DowsonHigginson {
        /// p_h in GPa.
        p_hertz_gpa: f64,
    },
    /// The same law in other round numbers, ρ̄ = (0.59 + 1.34 p)/(0.59 + p): 0.7 % less at 1 GPa. Source: Venner and
    /// Lubrecht, Multilevel Methods in Lubrication (2000).
    VennerLubrecht {
        /// p_h in GPa.
        p_hertz_gpa: f64,
    },
}

impl Density {
    /// ρ̄ and its derivative with respect to P.
    #[inline(always)]
    pub fn rho(self, p: f64) -> (f64, f64) {
        let (rise, stiffness, p_hertz_gpa) = match self {
            Self::Incompressible => return (1.0, 0.0),
            Self::DowsonHigginson { p_hertz_gpa } => (0.6, 1.7, p_hertz_gpa),
            Self::VennerLubrecht { p_hertz_gpa } => (0.34 / 0.59, 1.0 / 0.59, p_hertz_gpa),
        };
        let s = p_hertz_gpa * p.max(0.0);
        let d = 1.0 + stiffness * s;
        (1.0 + rise * s / d, rise * p_hertz_gpa / (d * d))
    }
}

/// How the pressure's flow sees oil that is sheared.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum ShearedFlow {
    /// One effective viscosity in both directions, the secant of Eyring's law.
    Secant,
    /// Its tangent along the sliding, its secant across.
    AlongAcross {
        /// ℓ = γ p_h/τ0: limiting shear stress at P = 1 over the Eyring stress.
        limit: f64,
    },
}

/// `ln cosh σ` and its derivative.
#[inline(always)]
pub fn eyring_along(sigma: f64) -> (f64, f64) {
    let falling = exp(-2.0 * sigma);
    let sum = 1.0 + falling;
    (sigma + ln(0.5 * sum), (1.0 - falling) / sum)
}

/// `ln(sinh σ/σ)` and its derivative.
#[inline(always)]
pub fn eyring_across(sigma: f64) -> (f64, f64) {
    // Next terms below 1e-15 for σ < 0.01.
    let small = sigma.min(1e-2);
    let square = small * small;
    let series = (
        square * (1.0 / 6.0 - square / 180.0),
        small * (1.0 / 3.0 - square * (1.0 / 45.0 - square * 2.0 / 945.0)),
    );
    let large = sigma.max(1e-2);
    let falling = exp(-2.0 * large);
    let difference = 1.0 - falling;
    let closed = (
        large + ln(0.5 * difference / large),
        (1.0 + falling) / difference - 1.0 / large,
    );
    if sigma < 1e-2 { series } else { closed }
}

/// `ln(ζ/asinh ζ)` and its derivative with respect to ln ζ: 0 for ζ → 0, 1 for ζ → ∞.
#[inline(always)]
pub fn eyring_ln_factor(zeta: f64) -> (f64, f64) {
    // ζ/asinh ζ = 1 + ζ²/6 − 17 ζ⁴/360: next term below 1e-13 for ζ < 0.01.
    let z2 = zeta.min(1e-2).powi(2);
    let series = (
        z2 / 6.0 - 11.0 * z2 * z2 / 180.0,
        z2 / 3.0 - 11.0 * z2 * z2 / 45.0,
    );
    // asinh ζ = ln(ζ + √(1+ζ²)); beyond 1e8 the root is ζ to rounding and its square might overflow.
    let root = (1.0 + zeta.min(1e8).powi(2)).sqrt();
    let asinh = if zeta < 1e8 {
        ln(zeta + root)
    } else {
        ln(zeta) + std::f64::consts::LN_2
    };
    let asinh = asinh.max(f64::MIN_POSITIVE);
    let closed = (ln(zeta) - ln(asinh), 1.0 - zeta.min(1e8) / (asinh * root));
    if zeta < 1e-2 { series } else { closed }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn slopes_are_the_derivatives() {
        let laws = [
            Viscosity::barus(2e-8, 1e9),
            Viscosity::roelands(0.04, 2.2e-8, 1e9),
        ];
        for law in laws {
            for p in [0.0, 0.3, 1.0, 1.7] {
                let h = 1e-6;
                let d = (law.ln_eta(p + h).0 - law.ln_eta(p).0) / h;
                assert!((d / law.ln_eta(p).1 - 1.0).abs() < 1e-4, "{law:?} {p}");
            }
        }
        for zeta in [1e-3, 0.9e-2, 1.1e-2, 0.5, 30.0, 1e6] {
            let h: f64 = 1e-6;
            let d = (eyring_ln_factor(zeta * h.exp()).0 - eyring_ln_factor(zeta * (-h).exp()).0)
                / (2.0 * h);
            let slope = eyring_ln_factor(zeta).1;
            assert!((d - slope).abs() < 1e-8, "{zeta}: {d} {slope}");
        }
    }

    #[test]
    fn along_is_the_tangent_and_across_the_secant_of_eyrings_law() {
        for zeta in [
            0.0_f64, 1e-9, 1e-3, 0.9e-2, 1.1e-2, 0.5, 3.0, 1e3, 1e6, 1e30,
        ] {
            let sigma = zeta.asinh();
            // Tangent of σ = asinh ζ: dζ/dσ = √(1 + ζ²).
            let tangent = 0.5 * (zeta * zeta).ln_1p();
            let tangent = if zeta > 1e9 { zeta.ln() } else { tangent };
            let along = eyring_along(sigma).0;
            assert!(
                (along - tangent).abs() < 1e-13 * (1.0 + tangent),
                "{zeta}: {along} {tangent}"
            );
            let secant = if zeta > 0.0 {
                eyring_ln_factor(zeta).0
            } else {
                0.0
            };
            let across = eyring_across(sigma).0;
            assert!(
                (across - secant).abs() < 1e-13 * (1.0 + secant),
                "{zeta}: {across} {secant}"
            );
        }
        for sigma in [1e-3, 0.99e-2, 1.01e-2, 0.5, 10.0, 50.0] {
            for law in [eyring_along, eyring_across] {
                let h = 1e-5;
                let d = (law(sigma + h).0 - law(sigma - h).0) / (2.0 * h);
                assert!(
                    (d - law(sigma).1).abs() < 1e-9,
                    "{sigma}: {d} {}",
                    law(sigma).1
                );
            }
        }
        // Far beyond any stress: finite.
        assert!(eyring_along(1e6).0.is_finite() && eyring_across(1e6).0.is_finite());
    }

    #[test]
    fn both_forms_of_the_density_law_are_what_their_sources_print() {
        let (p_hertz_gpa, share) = (1.6, 0.7);
        let p = p_hertz_gpa * share;
        let laws = [
            (
                Density::DowsonHigginson { p_hertz_gpa },
                1.0 + 0.6 * p / (1.0 + 1.7 * p),
            ),
            (
                Density::VennerLubrecht { p_hertz_gpa },
                (0.59 + 1.34 * p) / (0.59 + p),
            ),
        ];
        for (law, printed) in laws {
            let (rho, slope) = law.rho(share);
            assert!((rho - printed).abs() < 1e-14, "{law:?}: {rho} {printed}");
            let h = 1e-6;
            let difference = (law.rho(share + h).0 - law.rho(share - h).0) / (2.0 * h);
            assert!((slope - difference).abs() < 1e-9, "{law:?}");
            assert!(law.rho(-1.0).0 == 1.0);
        }
    }

    #[test]
    fn roelands_has_the_barus_slope_at_zero() {
        let slope = Viscosity::roelands(0.04, 2.2e-8, 1e9).ln_eta(0.0).1;
        assert!((slope / 22.0 - 1.0).abs() < 1e-12);
    }
}
