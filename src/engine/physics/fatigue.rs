//! Fatigue laws: survival, Weibull scatter, systems, and relative life by Zaretsky's volume integral.
//!
//! ```text
//! ln(1/Ps) = C M^e I,   I = ∫_V σ_eff^{c e} dV,   M = n N
//! N/N_ref  = (n_ref/n) (I_ref/I)^{1/e}            at the same Ps
//! L_P/L_Q  = [ln(1/P)/ln(1/Q)]^{1/e}              Weibull, survivals P and Q
//! L^{−e}   = Σ L_i^{−e}                           system of bodies
//! ```
//! | symbol | meaning |
//! |---|---|
//! | c | stress exponent (assumption: 31/3, Lundberg & Palmgren's value carried over) |
//! | e | Weibull slope (assumption: 10/9) |
//! | n | contacts per loading cycle ([`super::cycles`]) |
//!
//! Sources: Zaretsky, E.V. (1987), "Fatigue criterion to system design, life and reliability", J. Propul.
//! Power 3, 76-83; with mixed lubrication: Epstein et al. (2003), Trib. Trans. 46, 506-513. Integrals enter as
//! logarithms: `σ^{c e}` in pascals does not fit single precision in any real case, nor double precision
//! at c = 12, e = 3.
//!
//! Left out: wear, heat, plastic flow, crack growth. No absolute life without a calibration point.

use serde::{Deserialize, Serialize};

/// Exponents of the life law.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub struct LifeLaw {
    /// Stress exponent c.
    pub stress_exponent: f64,
    /// Weibull slope e.
    pub weibull_slope: f64,
}

impl Default for LifeLaw {
    /// c = 31/3, e = 10/9: assumptions, not measured here.
    fn default() -> Self {
        Self {
            stress_exponent: 31.0 / 3.0,
            weibull_slope: 10.0 / 9.0,
        }
    }
}

impl LifeLaw {
    /// Exponent on stress in the volume integral, `c e`.
    pub fn integral_exponent(self) -> f64 {
        self.stress_exponent * self.weibull_slope
    }

    /// `(I_ref/I)^{1/e}` from the integrals' logarithms.
    pub fn integral_factor(self, ln_reference: f64, ln_integral: f64) -> f64 {
        ((ln_reference - ln_integral) / self.weibull_slope).exp()
    }

    /// Life at survival `p` over life at survival `q`; both inside (0, 1).
    pub fn survival_ratio(self, p: f64, q: f64) -> f64 {
        ((1.0 / p).ln() / (1.0 / q).ln()).powf(1.0 / self.weibull_slope)
    }

    /// Life of two bodies that fail independently.
    pub fn system_life(self, life_1: f64, life_2: f64) -> f64 {
        let e = self.weibull_slope;
        (life_1.powf(-e) + life_2.powf(-e)).powf(-1.0 / e)
    }

    /// Factors of relative life.
    pub fn factors(self, n: CyclePair, ln: IntegralLogs) -> LifeFactors {
        let cycle = n.reference / n.scene;
        let peak = self.integral_factor(ln.reference, ln.normal);
        let traction = self.integral_factor(ln.normal, ln.full);
        LifeFactors {
            cycle,
            peak,
            traction,
            stress: peak * traction,
            relative: cycle * (peak * traction),
        }
    }
}

/// Contacts per loading cycle.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct CyclePair {
    /// In the reference (1 for a smooth one).
    pub reference: f64,
    /// In the scene.
    pub scene: f64,
}

/// Logarithms of life integrals, in the same unit of stress and length.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct IntegralLogs {
    /// Reference: smooth, frictionless, S = 0.
    pub reference: f64,
    /// The scene's pressure without traction.
    pub normal: f64,
    /// The scene's pressure and traction.
    pub full: f64,
}

/// Relative life and its factors: `relative = cycle · stress`, `stress = peak · traction`, exactly.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct LifeFactors {
    /// `n_ref/n`.
    pub cycle: f64,
    /// `(I_ref/I_normal)^{1/e}`: pressure peaks.
    pub peak: f64,
    /// `(I_normal/I)^{1/e}`: traction.
    pub traction: f64,
    /// Both.
    pub stress: f64,
    /// N/N_ref.
    pub relative: f64,
}

#[cfg(test)]
mod tests {
    use super::*;
    use approx::assert_relative_eq;

    #[test]
    fn median_over_ten_per_cent_life() {
        let ratio = |e| {
            LifeLaw {
                weibull_slope: e,
                ..LifeLaw::default()
            }
            .survival_ratio(0.5, 0.9)
        };
        println!(
            "L50/L10: {:.3} (e = 10/9), {:.3} (e = 9/8)",
            ratio(10.0 / 9.0),
            ratio(1.125)
        );
        assert!((ratio(10.0 / 9.0) - 5.449).abs() < 6e-4);
        assert!((ratio(1.125) - 5.336).abs() < 6e-4);
    }

    #[test]
    fn factors_multiply_to_the_life() {
        let law = LifeLaw::default();
        let n = CyclePair {
            reference: 1.0,
            scene: 14.33,
        };
        let ln = IntegralLogs {
            reference: -6.7,
            normal: -6.1,
            full: -5.9,
        };
        let f = law.factors(n, ln);
        assert_eq!(f.relative, f.cycle * f.stress);
        assert_eq!(f.stress, f.peak * f.traction);
        let direct = (1.0 / 14.33) * ((-6.7_f64 + 5.9) / law.weibull_slope).exp();
        assert_relative_eq!(f.relative, direct, max_relative = 1e-14);
        let same = law.factors(
            CyclePair {
                reference: 1.0,
                scene: 1.0,
            },
            IntegralLogs {
                reference: -6.7,
                normal: -6.7,
                full: -6.7,
            },
        );
        assert_eq!(
            same.relative, 1.0,
            "a smooth frictionless scene is its own reference"
        );
    }

    #[test]
    fn equal_bodies_share_the_life() {
        let law = LifeLaw::default();
        assert_relative_eq!(
            law.system_life(1.0, 1.0),
            2.0_f64.powf(-0.9),
            max_relative = 1e-14
        );
        assert_relative_eq!(law.system_life(1.0, 1e9), 1.0, max_relative = 1e-6);
    }
}
