//! Viscosity, density and shear laws of the film, over dimensionless pressure `P = p/p_h`.
//!
//! ```text
//! Barus      ln η̄ = α p
//! Roelands   ln η̄ = (ln η0 + 9.67) [(1 + p/p0)^z − 1],   p0 = 1.962e8 Pa,  z = α p0/(ln η0 + 9.67)
//! density    ρ̄ = 1 + 0.6e-9 p/(1 + 1.7e-9 p)
//! Ree-Eyring ζ = Z η̄/H,   Z = η0 |U2−U1| Rx/(τ0 a²):   the film shears at τ_m = τ0 asinh ζ
//!   secant   1/η̄* = (1/η̄) ζ/asinh ζ                              for the pressure's flow in every direction
//!   along    1/η̄_x = (1/η̄) Φ(ε) cosh σ,    σ = τ_m/τ0            exact along the sliding (`eyring.rs`)
//!   across   1/η̄_y = (1/η̄) sinh σ/σ                              secant: the shear turns by a small angle
//!   slope    ε = h ∂p/∂x/(2τ0) = G H ∂P/∂X,   G = a p_h/(2 Rx τ0)
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
//! those of `eyring.rs`. Across is the secant form itself; along, oil flows the more easily by σ/tanh σ, 10 to 17 times
//! in gears.
//!
//! Where the limit binds, the film carries γp and no more: the oil shears at that stress and what is left of the sliding
//! happens in a plane (at a wall or within) that lets no further oil pass. So the flow's σ is the traction's, and the
//! oil's own share of the sliding, sinh σ, stays what it is where the pressure is steep. Without
//! the limit the flow of such oil would see a stress that its traction denies; with a limit on the traction curve instead
//! (tangent 0) it would have no resistance at all. Near p = 0 the law γp leaves Newtonian oil, which it is there anyway.
//! Free of branches on values, so that loops over nodes become vector code.
//! The exponent is capped at 300 so that a trial pressure cannot overflow; nothing else is clamped.

use crate::math::elementary::{exp, ln};

/// Maximum exponent used for the viscosity.
const EXPONENT_CAP: f64 = 300.0;
/// Roelands' pressure constant, Pa.
const ROELANDS_P0_PA: f64 = 1.962e8;
/// Roelands' constant: -ln of 6.315e-5 Pa s.
pub(crate) const ROELANDS_LN: f64 = 9.67;

crate::closed_set! {
    /// Viscosity law.
    #[derive(Default)]
    pub enum ViscosityLaw {
        /// `eta0 exp(alpha p)`.
        Barus = "barus",
        /// Roelands with the same slope at p = 0.
        #[default]
        Roelands = "roelands",
    }
}

impl ViscosityLaw {
    /// The law for pressures over `p_hertz_pa`, Pa, of an oil of `viscosity_pa_s`, Pa s, and slope `alpha_per_pa`, 1/Pa, at
    /// p = 0.
    pub fn scaled(self, viscosity_pa_s: f64, alpha_per_pa: f64, p_hertz_pa: f64) -> Viscosity {
        match self {
            Self::Barus => Viscosity::barus(alpha_per_pa, p_hertz_pa),
            Self::Roelands => Viscosity::roelands(viscosity_pa_s, alpha_per_pa, p_hertz_pa),
        }
    }
}

crate::closed_set! {
    /// Density law.
    #[derive(Default)]
    pub enum DensityLaw {
        /// Constant.
        Incompressible = "incompressible",
        /// `1 + 0.6e-9 p/(1 + 1.7e-9 p)`.
        #[default]
        DowsonHigginson = "dowson_higginson",
        /// `(0.59e9 + 1.34 p)/(0.59e9 + p)`: the same law in other round numbers.
        VennerLubrecht = "venner_lubrecht",
    }
}

impl DensityLaw {
    /// The law for pressures over `p_hertz_pa`, Pa.
    pub fn scaled(self, p_hertz_pa: f64) -> Density {
        let p_hertz_gpa = p_hertz_pa * 1e-9;
        match self {
            Self::Incompressible => Density::Incompressible,
            Self::DowsonHigginson => Density::DowsonHigginson { p_hertz_gpa },
            Self::VennerLubrecht => Density::VennerLubrecht { p_hertz_gpa },
        }
    }
}

crate::closed_set! {
    /// Shear law of the film.
    #[derive(Default)]
    pub enum Rheology {
        /// Shear stress proportional to shear rate.
        #[default]
        Newtonian = "newtonian",
        /// Ree-Eyring: `tau0 asinh(eta gamma/tau0)`.
        Eyring = "eyring",
    }
}

impl Rheology {
    /// Shear stress, Pa, where Newtonian oil would have `newtonian_pa`, of an oil with that Eyring stress, Pa.
    pub fn shear_pa(self, newtonian_pa: f64, eyring_pa: f64) -> f64 {
        match self {
            Self::Newtonian => newtonian_pa,
            Self::Eyring => eyring_pa * (newtonian_pa / eyring_pa).asinh(),
        }
    }
}

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
    /// The flow along the sliding as it is, the secant across.
    AlongAcross {
        /// ℓ = γ p_h/τ0: limiting shear stress at P = 1 over the Eyring stress.
        limit: f64,
        /// G = a p_h/(2 Rx τ0): ε of H ∂P/∂X = 1.
        steepness: f64,
    },
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
