//! Depths at which stress is computed, with the weights that integrate over depth.
//!
//! ```text
//! z = z0 (e^{Cs} − 1),  s in [0, 1],  C = ln(1 + z_max/z0),  ∫ f dz = Σ w_k f(z_k)
//! ```
//! Gauss-Legendre in s: nodes crowd at the surface, where ripples live, and 24 of them integrate a
//! Hertz life integral to rounding.
//!
//! Source: Abramowitz and Stegun (1964), 25.4.29, for Gauss's rule. Ours: the map, whose dz/ds = C (z + z0) makes the spacing even in
//! ln(z + z0).

use std::f64::consts::PI;

/// Length over which the nodes change from linear to geometric spacing, in a: 1/k of
/// ripples of 0.3 a, where they shear most.
pub const DEPTH_SCALE_A: f64 = 0.05;

/// Nodes and weights of Gauss-Legendre on [0, 1], ascending.
pub fn gauss_legendre(n: usize) -> (Vec<f64>, Vec<f64>) {
    let (mut nodes, mut weights) = (vec![0.0; n], vec![0.0; n]);
    for i in 0..n {
        // Tricomi's first guess; Newton doubles the digits each time.
        let mut x = (PI * (i as f64 + 0.75) / (n as f64 + 0.5)).cos();
        let mut slope = 1.0;
        for _ in 0..8 {
            let (value, derivative) = legendre(n, x);
            slope = derivative;
            x -= value / derivative;
        }
        nodes[n - 1 - i] = 0.5 * (1.0 + x);
        weights[n - 1 - i] = 1.0 / ((1.0 - x * x) * slope * slope);
    }
    (nodes, weights)
}

/// Legendre polynomial and its slope, |x| < 1.
fn legendre(n: usize, x: f64) -> (f64, f64) {
    let (mut before, mut value) = (0.0, 1.0);
    for k in 1..=n {
        let k = k as f64;
        let next = ((2.0 * k - 1.0) * x * value - (k - 1.0) * before) / k;
        before = value;
        value = next;
    }
    (value, n as f64 * (x * value - before) / (x * x - 1.0))
}

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
    fn gauss_legendre_is_exact_for_polynomials() {
        let (x, w) = gauss_legendre(5);
        for power in 0..10 {
            let sum: f64 = x.iter().zip(&w).map(|(x, w)| w * x.powi(power)).sum();
            assert_relative_eq!(sum, 1.0 / f64::from(power + 1), max_relative = 1e-13);
        }
        assert!(x.windows(2).all(|pair| pair[0] < pair[1]));
    }

    #[test]
    fn depth_rule_integrates_a_decaying_ripple() {
        let (z, w) = depth_rule(32, 3.0);
        let sum: f64 = z.iter().zip(&w).map(|(z, w)| w * (-20.0 * z).exp()).sum();
        assert_relative_eq!(sum, (1.0 - (-60.0_f64).exp()) / 20.0, max_relative = 1e-10);
        assert!(z[0] > 0.0 && z[31] < 3.0);
        assert_relative_eq!(unstretched(stretched(0.7)), 0.7, max_relative = 1e-14);
    }
}
