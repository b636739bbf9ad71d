//! From the scene to what the closed-form estimate needs.

use std::f64::consts::{SQRT_2, TAU};

use crate::tui::wiring::Setup;
use asperity_engine::physics::estimate::{
    Count, EstimateBasis, FilmBasis, OilBasis, SurfaceWave, ln_tractions,
};
use asperity_engine::physics::hertz::ContactKind;
use asperity_engine::physics::waviness::Waviness;
use asperity_engine::scene::{CycleBasis, Scene, Surface};

/// Ellipses from this b/a on are taken for lines.
const WIDE: f64 = 2.0;

/// The fixed part of the estimate for a scene.
pub fn basis(setup: &Setup) -> EstimateBasis {
    let scene = &setup.scene;
    let life = scene.life.clone().unwrap_or_default();
    let (law, equation) = (life.law(), life.equation(life.model, setup.p_hertz_pa));
    let (shape, hertz) = (scene.kind(), scene.hertz());
    let section = if hertz.b_m >= WIDE * hertz.a_m {
        ContactKind::Line
    } else {
        shape
    };
    let poisson = scene.body_1.poisson;
    let [one, two] = scene.surfaces();
    EstimateBasis {
        crests_1_per_m: one.crests_per_m(),
        crests_2_per_m: two.crests_per_m(),
        shape,
        section,
        load_n: setup.load_n,
        half_width_m: setup.half_width_m,
        p_hertz_pa: setup.p_hertz_pa,
        waves: [waves(one), waves(two)],
        e_prime_pa: scene.e_prime_pa(),
        poisson,
        law,
        equation,
        count: match life.cycles {
            CycleBasis::Damage => Count::Damage,
            CycleBasis::Global | CycleBasis::Peaks => Count::Contacts,
        },
        oil: oil(scene),
        boundary: scene.friction.boundary,
        ln_traction: ln_tractions(section, poisson, equation.over_stress(law)),
    }
}

fn oil(scene: &Scene) -> Option<OilBasis> {
    let oil = scene.lubricant.as_ref()?;
    let point = scene.operating_point().map(FilmBasis::Point);
    Some(OilBasis {
        film: point.or_else(|| scene.line_point().map(FilmBasis::Line))?,
        viscosity_law: oil.viscosity_law,
        rheology: oil.rheology,
        eyring_pa: oil.eyring_stress_pa,
        limit: oil.limiting_shear_ratio,
        contact_film_m: scene.friction.contact_film_m,
    })
}

/// The plane waves that a surface is made of: a product of two is two of half its height; a measured surface is taken
/// for one transverse wave of its rms height and its crests.
fn waves(surface: &Surface) -> [SurfaceWave; 2] {
    let none = SurfaceWave::default();
    match *surface {
        Surface::Smooth {} => [none; 2],
        Surface::Sinusoid {
            wavelength_x_m,
            wavelength_y_m,
            angle_deg,
            phase_deg,
            ..
        } => {
            let (angle, phase) = (angle_deg.to_radians(), phase_deg.to_radians());
            let wave = Waviness::new(wavelength_x_m, wavelength_y_m, angle, phase);
            let (cos, sin) = wave.direction;
            let turned = |across: f64, share: f64| SurfaceWave {
                wavenumber_per_m: [wave.kx * cos - across * sin, wave.kx * sin + across * cos],
                share,
            };
            if wave.kx > 0.0 && wave.ky > 0.0 {
                [turned(wave.ky, 0.5), turned(-wave.ky, 0.5)]
            } else {
                [turned(wave.ky, 1.0), none]
            }
        }
        Surface::Random(_) | Surface::HeightMap { .. } => {
            let (rms_m, amplitude_m) = (surface.rq_m(), surface.amplitude_m());
            if amplitude_m <= 0.0 {
                return [none; 2];
            }
            let one = SurfaceWave {
                wavenumber_per_m: [TAU * surface.crests_per_m(), 0.0],
                share: SQRT_2 * rms_m / amplitude_m,
            };
            [one, none]
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
    fn plane_waves_add_up_to_the_surface() {
        for (x_m, y_m, angle_deg) in [
            (1e-4, f64::INFINITY, 0.0_f64),
            (1e-4, 2e-4, 0.0),
            (1e-4, 3e-4, 25.0),
            (f64::INFINITY, 1e-4, 10.0),
        ] {
            let whole = Waviness::new(x_m, y_m, angle_deg.to_radians(), 0.0).shape(3.1e-5, 1.7e-5);
            let sum: f64 = waves(&wave(x_m, y_m, angle_deg))
                .iter()
                .map(|one| {
                    let [x, y] = one.wavenumber_per_m;
                    one.share * (3.1e-5 * x + 1.7e-5 * y).cos()
                })
                .sum();
            assert_relative_eq!(whole, sum, epsilon = 1e-9);
        }
    }
}
