//! Complete elliptic integrals by the arithmetic-geometric mean.
//!
//! ```text
//! K = ∫₀^{π/2} (1 − m sin²θ)^{−1/2} dθ      E = ∫₀^{π/2} (1 − m sin²θ)^{1/2} dθ
//! D = (K − E)/m                             B = (E − (1 − m) K)/m = K − D
//!
//! a₀ = 1, b₀ = k';  a ← (a + b)/2, b ← √(ab), c_{n+1} = c_n²/(4 a_{n+1});  K = π/(2a),
//! (K − E)/K = ½ Σ 2ⁿ cₙ²
//! ```
//!
//! | symbol | meaning |
//! |---|---|
//! | m | parameter, k² = 1 − k'² |
//! | k' | complementary modulus, in (0, 1] |
//!
//! D and B are summed without forming K − E, so that they stay exact to rounding as m → 0 (circular
//! contact), where both differences vanish.
//!
//! Source: Abramowitz & Stegun 17.6 (AGM); Carlson's and Bulirsch's D and B.

use std::f64::consts::{FRAC_PI_2, FRAC_PI_4};

/// The four complete integrals of one modulus.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Complete {
    /// First kind, K.
    pub k: f64,
    /// Second kind, E.
    pub e: f64,
    /// D = (K − E)/m.
    pub d: f64,
    /// B = (E − (1 − m) K)/m.
    pub b: f64,
}

/// The complete integrals for the complementary modulus `k_prime` = √(1 − m), in (0, 1].
///
/// Converges quadratically: at most a dozen turns even for `k_prime` = 1e-150. NaN outside (0, 1].
pub fn complete(k_prime: f64) -> Complete {
    let inside = k_prime > 0.0 && k_prime <= 1.0;
    if !inside {
        return Complete {
            k: f64::NAN,
            e: f64::NAN,
            d: f64::NAN,
            b: f64::NAN,
        };
    }
    let m = (1.0 - k_prime) * (1.0 + k_prime);
    let mut arithmetic = 0.5 * (1.0 + k_prime);
    let mut geometric = k_prime.sqrt();
    // c₁²/m, which tends to 0 with m without a difference of like numbers.
    let mut c_squared_over_m = m / (16.0 * arithmetic * arithmetic);
    let mut power = 1.0;
    let mut sum = 0.5;
    // A relative gap of 1e-8 leaves 1e-16 after the next turn, which the sum no longer sees.
    while power < 1e5 {
        sum += power * c_squared_over_m;
        if (arithmetic - geometric).abs() <= 1e-9 * arithmetic {
            break;
        }
        let next = 0.5 * (arithmetic + geometric);
        geometric = (arithmetic * geometric).sqrt();
        let c = m * c_squared_over_m;
        c_squared_over_m = c_squared_over_m * c / (16.0 * next * next);
        arithmetic = next;
        power *= 2.0;
    }
    let k = FRAC_PI_2 / (0.5 * (arithmetic + geometric));
    let d = if m == 0.0 { FRAC_PI_4 } else { k * sum };
    Complete {
        k,
        e: k - m * d,
        d,
        b: k - d,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn tabulated_values() {
        // Abramowitz & Stegun, table 17.1: m, K, E.
        for (m, k, e) in [
            (0.0, FRAC_PI_2, FRAC_PI_2),
            (0.5, 1.854074677301372, 1.350643881047675),
            (0.9, 2.578092113348173, 1.104774732704073),
            (0.99, 3.695637362989875, 1.015993545025224),
        ] {
            let got = complete((1.0_f64 - m).sqrt());
            assert!((got.k - k).abs() < 4e-15 * k, "K({m}) = {}", got.k);
            assert!((got.e - e).abs() < 4e-15, "E({m}) = {}", got.e);
        }
    }

    #[test]
    fn agrees_with_the_defining_integrals() {
        // The trapezoidal rule converges exponentially on these periodic integrands.
        for k_prime in [0.999_999, 0.9, 0.5, 0.2, 0.05] {
            let m = 1.0 - k_prime * k_prime;
            let n = 2000;
            let (mut k, mut d, mut b) = (0.0, 0.0, 0.0);
            for i in 0..n {
                let theta = (i as f64 + 0.5) * FRAC_PI_2 / n as f64;
                let root = (1.0 - m * theta.sin().powi(2)).sqrt();
                k += FRAC_PI_2 / n as f64 / root;
                d += FRAC_PI_2 / n as f64 * theta.sin().powi(2) / root;
                b += FRAC_PI_2 / n as f64 * theta.cos().powi(2) / root;
            }
            let got = complete(k_prime);
            assert!((got.k / k - 1.0).abs() < 1e-13, "K {k_prime}");
            assert!((got.d / d - 1.0).abs() < 1e-13, "D {k_prime}");
            assert!((got.b / b - 1.0).abs() < 1e-12, "B {k_prime}");
        }
    }

    #[test]
    fn legendres_relation() {
        for k_prime in [0.1, 0.3, 0.7, 0.95_f64] {
            let one = complete(k_prime);
            let two = complete((1.0 - k_prime * k_prime).sqrt());
            let left = one.e * two.k + two.e * one.k - one.k * two.k;
            assert!((left - FRAC_PI_2).abs() < 1e-14, "{left}");
        }
    }

    #[test]
    fn outside_the_range_is_nan() {
        assert!(complete(0.0).k.is_nan());
        assert!(complete(1.1).e.is_nan());
        assert!(complete(f64::NAN).d.is_nan());
    }
}
