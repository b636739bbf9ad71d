//! From the scene to what the closed-form estimate needs.

use crate::physics::estimate::{EstimateBasis, load_factor};
use crate::physics::waviness::Waviness;
use crate::scene::Surface;
use crate::tui::app::Setup;

/// The fixed part of the estimate for a scene.
pub fn basis(setup: &Setup) -> EstimateBasis {
    EstimateBasis {
        crests_1_per_m: crests_per_m(&setup.scene.body_1.surface),
        crests_2_per_m: crests_per_m(&setup.scene.body_2.surface),
        shape: setup.scene.kind().hertz_shape(),
        load_n: setup.load_n,
        half_width_m: setup.half_width_m,
        p_hertz_pa: setup.p_hertz_pa,
    }
}

/// What a change of Hertz pressure by `ratio` does to life, by the scene's life model (or, where the
/// scene computes no life, by the default one).
pub fn life_at_pressure(setup: &Setup, ratio: f64) -> f64 {
    let life = setup.scene.life.clone().unwrap_or_default();
    let shape = setup.scene.kind().hertz_shape();
    load_factor(shape, ratio, life.stress_exponent, life.weibull_slope)
}

/// Crests that a streamline along x meets per metre.
fn crests_per_m(surface: &Surface) -> f64 {
    /// A wave turned by a right angle has no crests along x, not 1e-17 of them per wavelength.
    const NONE_PER_M: f64 = 1e-3;
    match *surface {
        Surface::Smooth {} => 0.0,
        Surface::HeightMap { .. } => surface.crests_per_m(),
        Surface::Sinusoid {
            wavelength_x_m,
            wavelength_y_m,
            angle_deg,
            phase_deg,
            ..
        } => {
            let (angle, phase) = (angle_deg.to_radians(), phase_deg.to_radians());
            let wave = Waviness::new(wavelength_x_m, wavelength_y_m, angle, phase);
            let crests = wave.crest_density_x();
            if crests < NONE_PER_M { 0.0 } else { crests }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use approx::assert_relative_eq;

    fn wave(wavelength_x_m: f64, wavelength_y_m: f64, angle_deg: f64) -> Surface {
        Surface::Sinusoid {
            amplitude_m: 1e-7,
            wavelength_x_m,
            wavelength_y_m,
            angle_deg,
            phase_deg: 0.0,
        }
    }

    #[test]
    fn crests_by_lay() {
        let inf = f64::INFINITY;
        assert_eq!(crests_per_m(&Surface::Smooth {}), 0.0);
        assert_relative_eq!(crests_per_m(&wave(1e-4, inf, 0.0)), 1e4);
        assert_eq!(crests_per_m(&wave(inf, 1e-4, 0.0)), 0.0);
        assert_eq!(crests_per_m(&wave(1e-4, inf, 90.0)), 0.0);
        assert_relative_eq!(crests_per_m(&wave(inf, 1e-4, 90.0)), 1e4);
        assert_relative_eq!(crests_per_m(&wave(1e-4, inf, 60.0)), 5e3, epsilon = 1e-8);
    }
}
