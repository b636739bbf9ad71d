//! Gauss's rule for integrals over an interval.
//!
//! Source: Abramowitz and Stegun (1964), 25.4.29.

use std::f64::consts::PI;

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
}
