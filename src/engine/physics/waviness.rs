//! Sinusoidal roughness that moves with its body.
//!
//! ```text
//! z(x, y, t) = A cos(2π x'/Wx + φ) cos(2π y'/Wy)
//! x' =  (x − U t) cos θ + y sin θ,   y' = −(x − U t) sin θ + y cos θ
//! ```
//! A is the amplitude (peak to valley is 2A), positive z towards the mating body: the film is
//! `h = ... − z1 − z2`. An infinite wavelength switches that factor off (ridges). Lengths in any one
//! unit; φ and θ in radians.

use std::f64::consts::TAU;

/// A sinusoidal surface.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Waviness {
    /// Wavenumber 2π/Wx (0: infinite).
    pub kx: f64,
    /// Wavenumber 2π/Wy.
    pub ky: f64,
    /// cos θ, sin θ.
    pub direction: (f64, f64),
    /// φ.
    pub phase: f64,
}

impl Waviness {
    /// A surface with wavelengths `wx`, `wy` (either may be infinite).
    pub fn new(wx: f64, wy: f64, angle: f64, phase: f64) -> Self {
        Self {
            kx: TAU / wx,
            ky: TAU / wy,
            direction: (angle.cos(), angle.sin()),
            phase,
        }
    }

    /// z/A at `x − U t`, `y`.
    #[inline]
    pub fn shape(&self, x: f64, y: f64) -> f64 {
        let (c, s) = self.direction;
        (self.kx * (x * c + y * s) + self.phase).cos() * (self.ky * (y * c - x * s)).cos()
    }

    /// Root mean square of z/A.
    pub fn rms(&self) -> f64 {
        let factor = |k: f64| if k > 0.0 { 0.5_f64.sqrt() } else { 1.0 };
        factor(self.kx) * factor(self.ky)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn ridges_and_products() {
        let transverse = Waviness::new(0.5, f64::INFINITY, 0.0, 0.0);
        assert!((transverse.shape(0.5, 3.0) - 1.0).abs() < 1e-12);
        assert!((transverse.shape(0.25, 3.0) + 1.0).abs() < 1e-12);
        assert!((transverse.rms() - 0.5_f64.sqrt()).abs() < 1e-15);
        let product = Waviness::new(0.5, 0.25, 0.0, 0.0);
        assert!((product.rms() - 0.5).abs() < 1e-15);
    }
}
