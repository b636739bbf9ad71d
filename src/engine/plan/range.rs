//! What the equations hold for: bodies that are half-spaces, and films that are thin.
//!
//! ```text
//! contact   a ≤ R/2,  b ≤ R_y/2      the slope of the undeformed gap at the contact's edge
//! film      h_c ≤ Rx/8               the slope √(2 h_c/Rx) of the wedge that carries the load, at its length √(2 Rx h_c)
//! ```
//! Both slopes are at most 1/2, as of roughness (`scene`): the paraboloid is no roller or ball beyond, Hertz's half-space
//! no body, and Reynolds' film not thin. Without the second a light load at a great speed asks for films thicker than the
//! bodies.

use super::{FilmPlan, PlanError};
use crate::math::number::apart;
use crate::physics::hertz::Hertz;
use crate::scene::{ContactKind, Knob, Scene};

/// Steepest slope.
const SLOPE_MAX: f64 = 0.5;

/// Refuses scenes that the equations do not hold for.
pub(super) fn check(
    scene: &Scene,
    hertz: &Hertz,
    film: Option<&FilmPlan>,
) -> Result<(), PlanError> {
    let rx_m = scene.contact.rx_m;
    let across = match scene.kind() {
        ContactKind::Point => hertz.b_m / scene.ry_m(),
        ContactKind::Line => 0.0,
    };
    let slope = (hertz.a_m / rx_m).max(across);
    // Not a number is beyond, too.
    if slope.is_nan() || slope > SLOPE_MAX {
        return Err(too_large(scene, slope));
    }
    match film {
        Some(film) if film.central_m * 2.0 > SLOPE_MAX * SLOPE_MAX * rx_m => {
            Err(too_thick(scene, film))
        }
        _ => Ok(()),
    }
}

fn too_large(scene: &Scene, slope: f64) -> PlanError {
    let order = scene.kind().order();
    let ratio = SLOPE_MAX / slope;
    let (key, value, most, unit) = match (scene.load.hertz_pressure_pa, scene.kind()) {
        (Some(p_pa), _) => ("load.hertz_pressure_pa", p_pa, p_pa * ratio, "Pa"),
        (None, kind) => {
            let load = Knob::of_load(kind);
            let most = scene.force_n() * ratio.powi(order);
            (load.key(), scene.force_n(), most, load.unit())
        }
    };
    PlanError::Refused {
        key: key.to_owned(),
        value: format!("{} {unit}", beyond(value, most)),
        allowed: format!(
            "at most {most:.3e} {unit} with these bodies (a contact of half the radius in half-width; this one has {slope:.2e} of it: no half-space)"
        ),
    }
}

/// A bound as it is printed with so many digits after the first.
fn rounded(bound: f64, digits: usize) -> f64 {
    format!("{bound:.digits$e}").parse().unwrap_or(bound)
}

/// A value beyond a bound that is printed with four figures.
fn beyond(value: f64, bound: f64) -> String {
    let bound = rounded(bound, 3);
    apart(value, bound, 4, |value, digits| {
        format!("{value:.digits$e}")
    })
}

fn too_thick(scene: &Scene, film: &FilmPlan) -> PlanError {
    let rx_m = scene.contact.rx_m;
    let most_m = 0.5 * SLOPE_MAX * SLOPE_MAX * rx_m;
    let speed_m_s = scene.motion.entrainment_m_s;
    // The film grows with the speed; its exponent changes on the way.
    let (mut low, mut high) = (-30.0_f64, 0.0_f64);
    for _ in 0..60 {
        let middle = 0.5 * (low + high);
        if film.at(middle.exp(), 1.0).central_m > most_m {
            high = middle;
        } else {
            low = middle;
        }
    }
    let most_m_s = speed_m_s.abs() * low.exp();
    PlanError::Refused {
        key: Knob::EntrainmentMS.key().to_owned(),
        value: format!("{} m/s", beyond(speed_m_s, most_m_s.copysign(speed_m_s))),
        allowed: format!(
            "at most {most_m_s:.3e} m/s with this oil, load and radius (a central film of Rx/8 = {most_m:.2e} m by formula; this one is {} m: no thin film), or a higher load",
            apart(film.central_m, rounded(most_m, 2), 2, |m, digits| format!(
                "{m:.digits$e}"
            ))
        ),
    }
}
