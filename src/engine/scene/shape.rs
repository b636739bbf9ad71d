//! The rules that go with the kind of contact: a point has a radius across and a force, a line neither, but a
//! force per length and surfaces that are the same at every y.

use super::Knob;
use super::error::SceneError;
use super::keys::{joined, short};
use super::model::{ContactKind, Scene, Surface};
use crate::math::number::apart;

/// Highest Hertz pressure that any material stands, Pa.
const P_HERTZ_MAX_PA: f64 = 1e10;

/// A radius across belongs to a point contact; what varies along y does not belong to a line.
pub(super) fn check_shape(scene: &Scene) -> Result<(), SceneError> {
    match (scene.contact.kind, scene.contact.ry_m) {
        (ContactKind::Line, Some(ry_m)) => Err(SceneError::value(
            "contact.ry_m",
            format!("{} m", short(ry_m)),
            "only with contact.kind = \"point\"; leave it out for a line",
        )),
        (ContactKind::Line, None) => scene
            .surfaces()
            .into_iter()
            .zip(["body_1.surface", "body_2.surface"])
            .try_for_each(|(surface, path)| check_transverse(path, surface)),
        // That a point has one is checked with the keys that are missing.
        (ContactKind::Point, _) => Ok(()),
    }
}

/// A line's surfaces must not vary along y.
fn check_transverse(path: &str, surface: &Surface) -> Result<(), SceneError> {
    if surface.wavenumbers_per_m()[1] == 0.0 {
        return Ok(());
    }
    let uniform = "a line contact is the same at every y, so its ridges must lie across";
    let refused = |key: &str, value: &str, allowed: &str| {
        SceneError::value(joined(path, key), value, format!("{allowed}: {uniform}"))
    };
    let (wavelength_x_m, wavelength_y_m, angle_deg) = match *surface {
        Surface::Smooth {} => return Ok(()),
        Surface::HeightMap { .. } => {
            let allowed = "a map whose rows are all alike, \"random\", \"sinusoid\" or \"smooth\"";
            return Err(refused("kind", "\"height_map\"", allowed));
        }
        Surface::Random(ref random) => {
            let y_m = random.correlation_m()[1];
            return Err(refused(
                "correlation_y_m",
                &format!("{} m", short(y_m)),
                "inf",
            ));
        }
        Surface::Sinusoid {
            wavelength_x_m,
            wavelength_y_m,
            angle_deg,
            ..
        } => (wavelength_x_m, wavelength_y_m, angle_deg),
    };
    Err(
        if wavelength_y_m.is_finite() && wavelength_x_m.is_finite() {
            SceneError::value(
                joined(path, "wavelength_y_m"),
                format!("{} m", short(wavelength_y_m)),
                format!("inf: {uniform}"),
            )
        } else if angle_deg.rem_euclid(180.0) == 0.0 {
            SceneError::value(
                joined(path, "wavelength_x_m"),
                "inf",
                format!("a length in m, with wavelength_y_m = inf: {uniform}"),
            )
        } else {
            SceneError::value(
                joined(path, "angle_deg"),
                short(angle_deg),
                format!("0 with wavelength_y_m = inf: {uniform}"),
            )
        },
    )
}

/// Least hardness over the Hertz pressure: the contact is then at most 4/3 (a line: π/2) of Hertz's, which its domain holds.
pub const MINIMUM_HARDNESS: f64 = 0.5;

/// A body that is too soft for the load would give way as a whole.
pub(super) fn check_hardness(scene: &Scene) -> Result<(), SceneError> {
    let least_pa = MINIMUM_HARDNESS * scene.hertz().p_max_pa;
    let bodies = [
        ("body_1.hardness_pa", &scene.body_1),
        ("body_2.hardness_pa", &scene.body_2),
    ];
    for (key, body) in bodies {
        let Some(hardness_pa) = body.hardness_pa.filter(|pa| *pa < least_pa) else {
            continue;
        };
        return Err(SceneError::value(
            key,
            format!("{} Pa", short(hardness_pa)),
            format!(
                "at least {} Pa, half the Hertz pressure: a softer body yields as a whole and not by its asperities",
                short(least_pa)
            ),
        ));
    }
    Ok(())
}

/// A load that an event sets is carried as the scene's own is.
pub(super) fn check_carried(scene: &Scene, key: &str, force: f64) -> Result<(), SceneError> {
    let p_max_pa = scene.hertz_at(force).p_max_pa;
    let unit = Knob::of_load(scene.contact.kind).unit();
    match scene.hardness_pa() {
        Some(hardness_pa) if hardness_pa < MINIMUM_HARDNESS * p_max_pa => Err(SceneError::value(
            key,
            format!("{} {unit}", short(force)),
            format!(
                "a Hertz pressure of at most {} Pa, twice the hardness of the softer body; this load makes {} Pa: the body yields as a whole and not by its asperities",
                short(hardness_pa / MINIMUM_HARDNESS),
                short(p_max_pa)
            ),
        )),
        _ => Ok(()),
    }
}

/// Exactly one load, of the kind that the contact takes.
pub(super) fn check_load(scene: &Scene) -> Result<(), SceneError> {
    let load = &scene.load;
    let (own, other) = match scene.contact.kind {
        ContactKind::Point => (
            ("load.force_n", "N", load.force_n),
            ("load.force_n_per_m", "N/m", load.force_n_per_m),
        ),
        ContactKind::Line => (
            ("load.force_n_per_m", "N/m", load.force_n_per_m),
            ("load.force_n", "N", load.force_n),
        ),
    };
    let (key, unit, force) = own;
    if let (other, unit, Some(force)) = other {
        let only = match scene.contact.kind {
            ContactKind::Point => "line",
            ContactKind::Line => "point",
        };
        return Err(SceneError::value(
            other,
            format!("{} {unit}", short(force)),
            format!("only with contact.kind = \"{only}\"; here {key} or load.hertz_pressure_pa"),
        ));
    }
    match (force, load.hertz_pressure_pa) {
        (Some(_), Some(_)) => Err(SceneError::value(
            "load",
            format!("{} and hertz_pressure_pa", key.trim_start_matches("load.")),
            "exactly one of the two",
        )),
        (None, None) => Err(SceneError::Missing {
            key: key.to_owned(),
            allowed: format!(
                "exactly one of {key} ({unit}) and load.hertz_pressure_pa (1e6 to 1e10 Pa)"
            ),
        }),
        (Some(force), None) => check_force(scene, key, force),
        (None, Some(_)) => Ok(()),
    }
}

/// A force may be anything whose Hertz pressure is possible.
pub(super) fn check_force(scene: &Scene, key: &str, force_n: f64) -> Result<(), SceneError> {
    let p_max_pa = scene.hertz_at(force_n).p_max_pa;
    if p_max_pa <= P_HERTZ_MAX_PA {
        return Ok(());
    }
    let allowed = format!(
        "a Hertz pressure of at most 10 GPa; this force makes {} GPa",
        apart(p_max_pa * 1e-9, P_HERTZ_MAX_PA * 1e-9, 3, |gpa, digits| {
            format!("{gpa:.digits$}")
        })
    );
    Err(SceneError::value(
        key,
        match scene.contact.kind {
            ContactKind::Point => format!("{} N", short(force_n)),
            ContactKind::Line => format!("{} N/m", short(force_n)),
        },
        allowed,
    ))
}
