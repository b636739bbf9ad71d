//! Depths at which stress is computed, with the weights that integrate over depth.
//!
//! ```text
//! z = z0 (e^{Cs} − 1),  s in [0, 1],  C = ln(1 + z_max/z0),  ∫ f dz = Σ w_k f(z_k)
//! ```
//! Gauss-Legendre in s: nodes crowd at the surface, where ripples live, and 24 of them integrate a
//! Hertz life integral to rounding.
//!
//! Ours: the map, whose dz/ds = C (z + z0) makes the spacing even in
//! ln(z + z0).

use crate::math::quadrature::gauss_legendre;

/// Length over which the nodes change from linear to geometric spacing, in a: 1/k of
/// ripples of 0.3 a, where they shear most.
pub const DEPTH_SCALE_A: f64 = 0.05;

/// Depths (ascending, in a) and weights for `n` depths down to `z_max` (in a).
pub fn depth_rule(n: usize, z_max: f64) -> (Vec<f64>, Vec<f64>) {
    let c = (1.0 + z_max / DEPTH_SCALE_A).ln();
    let (s, w) = gauss_legendre(n);
    let depths: Vec<f64> = s.iter().map(|s| depth_of(*s, c)).collect();
    let weights = depths
        .iter()
        .zip(w)
        .map(|(z, w)| w * c * (z + DEPTH_SCALE_A))
        .collect();
    (depths, weights)
}

fn depth_of(s: f64, c: f64) -> f64 {
    DEPTH_SCALE_A * ((c * s).exp() - 1.0)
}

/// The coordinate in which the depths of [`depth_rule`] lie evenly (up to scale): `ln(1 + z/z0)`.
pub(super) fn stretched(z: f64) -> f64 {
    (1.0 + z / DEPTH_SCALE_A).ln()
}

/// Depth of a [`stretched`] coordinate.
pub(super) fn unstretched(t: f64) -> f64 {
    DEPTH_SCALE_A * (t.exp() - 1.0)
}

#[cfg(test)]
mod tests {
    use super::*;
    use approx::assert_relative_eq;

    #[test]
    fn depth_rule_integrates_a_decaying_ripple() {
        let (z, w) = depth_rule(32, 3.0);
        let sum: f64 = z.iter().zip(&w).map(|(z, w)| w * (-20.0 * z).exp()).sum();
        assert_relative_eq!(sum, (1.0 - (-60.0_f64).exp()) / 20.0, max_relative = 1e-10);
        assert!(z[0] > 0.0 && z[31] < 3.0);
        assert_relative_eq!(unstretched(stretched(0.7)), 0.7, max_relative = 1e-14);
    }
}
