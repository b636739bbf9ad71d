//! Life models as closed variants. Each turns stress into a number J whose life is `N ∝ J^{−1/e}`, so that
//! relative lives, factors and systems are computed alike for all.
//!
//! ```text
//! Zaretsky           ln(1/Ps) = C M^e ∫ σ^{c e} dV                         J = ∫ σ^{c e} dV
//! Lundberg-Palmgren  ln(1/Ps) = A τ0^c N^e V/z0^h,  V ∝ z0                 J = τ0^c z0^{1−h}
//! Ioannides-Harris   ln(1/Ps) = A N^e ∫ <σ − σ_u>^c / max(z, z_c)^h dV     J = ∫ <σ − σ_u>^c z^{−h} dV
//! Dang Van           risk r = max_t [τ(t) + α σ_H(t)]                      J = r^{c e}
//! Findley            risk r = max over planes [τ_a + k σ_n,max]            J = r^{c e}
//! ```
//! | symbol | meaning | default |
//! |---|---|---|
//! | τ0, z0 | maximum half range of the orthogonal shear along x, and its depth | |
//! | h | depth exponent | 7/3 |
//! | σ_u | fatigue limit of the effective stress | 0: none; ISO 281:2007 takes 900 MPa of von Mises |
//! | z_c | depth above which z^{−h} no longer grows: at a rough surface it would diverge | 0.05 a |
//! | α, k | weight of the hydrostatic, of the normal stress | 0.3 (assumption) |
//!
//! In Lundberg-Palmgren and Ioannides-Harris c acts directly on stress, so that `N ∝ σ^{−c/e}`; in Zaretsky's
//! form `N ∝ σ^{−c}`. Dang Van and Findley are limits, not lives: `N ∝ r^{−c}` is an **assumption**, made so
//! that they can stand beside the others. They have no volume effect.
//!
//! Sources: Zaretsky, E.V. (1987), J. Propul. Power 3, 76-83; Lundberg, G. & Palmgren, A. (1947), Acta Polytech.
//! Mech. Eng. 1 (3); Ioannides, E. & Harris, T.A. (1985), J. Tribol. 107, 367-378; Dang Van, K. et al. (1989),
//! in Biaxial and Multiaxial Fatigue, EGF 3; Findley, W.N. (1959), J. Eng. Ind. 81, 301-306.

use serde::{Deserialize, Serialize};

use super::fatigue::LifeLaw;

/// A life model with its parameters; stress in p_h, lengths in a.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub enum LifeEquation {
    /// Volume integral of σ^{c e}.
    Zaretsky,
    /// Maximum orthogonal shear and its depth.
    LundbergPalmgren {
        /// h.
        depth_exponent: f64,
        /// z_c, least z0.
        cut_off: f64,
    },
    /// Volume integral of what exceeds a limit.
    IoannidesHarris {
        /// h.
        depth_exponent: f64,
        /// z_c.
        cut_off: f64,
        /// σ_u.
        limit: f64,
    },
    /// Mesoscopic shear and hydrostatic stress.
    DangVan {
        /// α.
        hydrostatic: f64,
    },
    /// Shear amplitude and maximum normal stress of the worst plane.
    Findley {
        /// k.
        normal: f64,
    },
}

impl LifeEquation {
    /// Exponent of a volume integral over stress, and the limit; `None` for models without one.
    pub fn stress_law(self, law: LifeLaw) -> Option<(f64, f64)> {
        match self {
            Self::Zaretsky => Some((law.integral_exponent(), 0.0)),
            Self::IoannidesHarris { limit, .. } => Some((law.stress_exponent, limit)),
            Self::LundbergPalmgren { .. } | Self::DangVan { .. } | Self::Findley { .. } => None,
        }
    }

    /// ln of the weight of depth `z` in a volume integral.
    pub fn ln_depth_weight(self, z: f64) -> f64 {
        match self {
            Self::IoannidesHarris {
                depth_exponent,
                cut_off,
                ..
            } => -depth_exponent * z.max(cut_off).ln(),
            Self::Zaretsky
            | Self::LundbergPalmgren { .. }
            | Self::DangVan { .. }
            | Self::Findley { .. } => 0.0,
        }
    }

    /// ln J of a model that looks at one depth: `stress` is τ0 or the risk there.
    pub fn ln_at_depth(self, law: LifeLaw, stress: f64, z: f64) -> f64 {
        match self {
            Self::LundbergPalmgren {
                depth_exponent,
                cut_off,
            } => law.stress_exponent * stress.ln() + (1.0 - depth_exponent) * z.max(cut_off).ln(),
            Self::Zaretsky
            | Self::IoannidesHarris { .. }
            | Self::DangVan { .. }
            | Self::Findley { .. } => law.integral_exponent() * stress.ln(),
        }
    }

    /// Exponent g of J in fixed units against the size of a smooth contact with the same radii, whose pressure and
    /// widths grow alike: `J ∝ r^g` (of a limit it is the exponent without it). `sides` is the number of directions in
    /// which the contact grows with the pressure: 2 for a point, 1 for a line; `swept`: J of a length of track.
    pub fn growth(self, law: LifeLaw, sides: f64, swept: bool) -> f64 {
        let depth = 1.0;
        let lengths = if swept { sides } else { sides + depth };
        self.over_stress(law)
            + match self {
                Self::Zaretsky => lengths,
                Self::LundbergPalmgren { depth_exponent, .. } => depth - depth_exponent,
                Self::IoannidesHarris { depth_exponent, .. } => lengths - depth_exponent,
                Self::DangVan { .. } | Self::Findley { .. } => 0.0,
            }
    }

    /// Exponent of J over stress alone: the rest of [`LifeEquation::growth`] is over lengths.
    pub fn over_stress(self, law: LifeLaw) -> f64 {
        match self {
            Self::Zaretsky | Self::DangVan { .. } | Self::Findley { .. } => law.integral_exponent(),
            Self::LundbergPalmgren { .. } | Self::IoannidesHarris { .. } => law.stress_exponent,
        }
    }

    /// Exponent of the stressed volume's width, which cancels from relative lives at one load and is therefore not
    /// in J: Lundberg and Palmgren's V ∝ width · z0, and the length of the track does not change.
    pub fn width(self, sides: f64) -> f64 {
        match self {
            Self::LundbergPalmgren { .. } => sides - 1.0,
            Self::Zaretsky
            | Self::IoannidesHarris { .. }
            | Self::DangVan { .. }
            | Self::Findley { .. } => 0.0,
        }
    }

    /// Exponent s of life against the Hertz pressure of the smooth contact with the same radii, `N ∝ p_h^{−s}`;
    /// `None` where a limit breaks the power law. `sides` as in [`LifeEquation::growth`].
    pub fn pressure_exponent(self, law: LifeLaw, sides: f64) -> Option<f64> {
        let limited = match self {
            Self::IoannidesHarris { limit, .. } => limit != 0.0,
            Self::Zaretsky
            | Self::LundbergPalmgren { .. }
            | Self::DangVan { .. }
            | Self::Findley { .. } => false,
        };
        (!limited).then_some(self.unlimited_exponent(law, sides))
    }

    /// The same as if there were no limit.
    pub fn unlimited_exponent(self, law: LifeLaw, sides: f64) -> f64 {
        (self.growth(law, sides, false) + self.width(sides)) / law.weibull_slope
    }

    /// Exponent m of life against stress, `N ∝ σ^{−m}`: that of a cycle's damage, `1/N`.
    pub fn life_exponent(self, law: LifeLaw) -> f64 {
        self.over_stress(law) / law.weibull_slope
    }
}

/// How many stress cycles a loading cycle counts for, by depth.
///
/// ```text
/// global   n                                                  everywhere (Pu, Zhu, Wang & Wang 2016)
/// counted  n(z) from the histories of material points
/// ```
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum CycleProfile<'a> {
    /// One n.
    Global(f64),
    /// Counted at every depth.
    Counted(&'a [f64]),
}

impl CycleProfile<'_> {
    /// n at the `k`-th depth.
    pub fn at(&self, k: usize) -> f64 {
        match *self {
            Self::Global(n) => n,
            Self::Counted(n) => n.get(k).copied().unwrap_or(1.0),
        }
    }
}

/// Life by a calibration point: the smooth, frictionless contact lives `cycles` loading cycles at the Hertz
/// pressure `p_hertz` and the survival of the point.
///
/// `N_ref(p) = cycles (p_cal/p)^s` with s from [`LifeEquation::pressure_exponent`].
pub fn calibrated_reference(cycles: f64, p_calibration: f64, p_hertz: f64, exponent: f64) -> f64 {
    cycles * (p_calibration / p_hertz).powf(exponent)
}

#[cfg(test)]
mod tests {
    use super::*;
    use approx::assert_relative_eq;

    #[test]
    fn classical_exponents_of_load() {
        // Point contact, p ∝ load^{1/3}: Lundberg and Palmgren's life falls with the cube of the load,
        // (31/3 + 2 − 7/3)/(10/9)/3. Line contact, p ∝ load^{1/2}: with its fourth power.
        let law = LifeLaw::default();
        let model = LifeEquation::LundbergPalmgren {
            depth_exponent: 7.0 / 3.0,
            cut_off: 0.05,
        };
        let s = model.pressure_exponent(law, 2.0).unwrap_or(f64::NAN);
        println!("Lundberg-Palmgren: life falls with load^{:.4}", s / 3.0);
        assert_relative_eq!(s, 9.0, max_relative = 1e-12);
        let line = LifeLaw {
            weibull_slope: 1.125,
            ..law
        };
        let s = model.pressure_exponent(line, 1.0).unwrap_or(f64::NAN);
        assert_relative_eq!(s / 2.0, 4.0, max_relative = 1e-12);
        let zaretsky = LifeEquation::Zaretsky.pressure_exponent(law, 2.0);
        assert_relative_eq!(zaretsky.unwrap_or(f64::NAN), 31.0 / 3.0 + 2.7);
        let limited = LifeEquation::IoannidesHarris {
            depth_exponent: 7.0 / 3.0,
            cut_off: 0.05,
            limit: 0.4,
        };
        assert_eq!(limited.pressure_exponent(law, 2.0), None);
        assert_relative_eq!(calibrated_reference(1e6, 2e9, 1e9, 9.0), 512e6);
    }

    #[test]
    fn a_depth_that_was_not_counted_is_one_cycle() {
        assert_eq!(CycleProfile::Counted(&[3.0]).at(0), 3.0);
        assert_eq!(CycleProfile::Counted(&[3.0]).at(1), 1.0);
    }

    #[test]
    fn depth_weight_stops_at_the_cut_off() {
        let model = LifeEquation::IoannidesHarris {
            depth_exponent: 2.0,
            cut_off: 0.1,
            limit: 0.0,
        };
        assert_relative_eq!(model.ln_depth_weight(1e-9), 100.0_f64.ln());
        assert_relative_eq!(model.ln_depth_weight(0.5), 4.0_f64.ln());
        assert_eq!(LifeEquation::Zaretsky.ln_depth_weight(0.01), 0.0);
    }
}
