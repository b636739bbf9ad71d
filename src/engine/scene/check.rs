//! The strict check of a scene: every key known, of the right kind and within its range, and the rules
//! that tie keys together. It reads plain TOML tables, so that the error names what was written.

use toml::{Table, Value};

use super::Knob;
use super::error::drives_a_terminal;
use super::error::{SceneError, nearest};
use super::keys::{self, EVENT_KEYS, Key, Kind, Need, SECTIONS, Section, joined, short};
use super::lubricant::Lubricant;
use super::model::{Event, Scene, Surface, SurfaceKind};
use super::shape::{check_carried, check_force, check_hardness, check_load, check_shape};
use super::wrong::refusal;
use crate::math::number::{apart, trimmed};
use crate::physics::gear::GearTeeth;

/// Checks a whole table against the keys, whole numbers turned into floats where floats are meant.
pub(super) fn check_table(table: &mut Table) -> Result<(), SceneError> {
    check_section("", table)?;
    for section in SECTIONS {
        check_presence(section, table)?;
    }
    Ok(())
}

fn check_section(path: &str, table: &mut Table) -> Result<(), SceneError> {
    let kind = kind_of(table);
    for (name, value) in table.iter_mut() {
        let full = joined(path, name);
        if path.is_empty() && name == "event" {
            check_events(value)?;
        } else if let Some(key) = keys::find(&full) {
            check_value(&full, key, value)?;
            if key.need_in(path, kind.as_deref()).is_none() {
                return Err(SceneError::value(
                    full,
                    shown(value),
                    format!("only with {path}.kind = {}", key.kinds()),
                ));
            }
        } else if keys::section(&full).is_some() {
            match value {
                Value::Table(inner) => check_section(&full, inner)?,
                other => {
                    return Err(SceneError::value(
                        &full,
                        shown(other),
                        format!("a table [{full}]"),
                    ));
                }
            }
        } else {
            return Err(unknown(&full));
        }
    }
    Ok(())
}

/// The word that says which kind of thing a table is.
fn kind_of(table: &Table) -> Option<String> {
    table.get("kind").and_then(Value::as_str).map(str::to_owned)
}

impl SceneError {
    /// A key that no scene has.
    pub fn unknown_key(key: &str) -> Self {
        unknown(key)
    }
}

/// The error for a key that no scene has.
pub(super) fn unknown(full: &str) -> SceneError {
    if full.split(['.', '[']).next() == Some("event") {
        let key = super::error::shortened(full);
        return SceneError::value(key, "a setting", "tables [[event]] in a scene file");
    }
    if full == "life.volume" {
        let instead = "nothing; life.cycles = \"damage\", \"global\" or \"peaks\" brings the integral that belongs to it";
        return SceneError::value(full, "a setting", instead);
    }
    let paths: Vec<String> = keys::all_paths()
        .chain(SECTIONS.iter().map(|section| section.path.to_owned()))
        .chain(super::drawing::drawn_keys().map(|(path, _)| path))
        .chain(["event".to_owned()])
        .collect();
    SceneError::UnknownKey {
        key: super::error::shortened(full),
        nearest: nearest(full, paths.iter().map(String::as_str)).map(str::to_owned),
    }
}

fn check_presence(section: &Section, root: &Table) -> Result<(), SceneError> {
    let table = lookup(root, section.path);
    let Some(table) = table else {
        return if section.need == Need::Required {
            Err(SceneError::Missing {
                key: format!("[{}]", section.path),
                allowed: section.doc.to_owned(),
            })
        } else {
            Ok(())
        };
    };
    let kind = kind_of(table);
    let missing = section
        .keys
        .iter()
        .filter(|key| key.need_in(section.path, kind.as_deref()) == Some(Need::Required))
        .find(|key| !table.contains_key(key.name));
    match missing {
        Some(key) => Err(SceneError::Missing {
            key: section.path_of(key.name),
            allowed: key.allowed(),
        }),
        None => Ok(()),
    }
}

/// The table at a dotted path.
pub(super) fn lookup<'a>(root: &'a Table, path: &str) -> Option<&'a Table> {
    if path.is_empty() {
        return Some(root);
    }
    path.split('.')
        .try_fold(root, |table, name| table.get(name)?.as_table())
}

fn check_events(value: &mut Value) -> Result<(), SceneError> {
    let refused =
        |value: &Value| SceneError::value("event", shown(value), "tables, each [[event]]");
    let Value::Array(events) = value else {
        return Err(refused(value));
    };
    for (index, event) in events.iter_mut().enumerate() {
        let Value::Table(table) = event else {
            return Err(refused(event));
        };
        let path = format!("event[{index}]");
        for (name, value) in table.iter_mut() {
            let full = joined(&path, name);
            if name == "set" {
                check_settings(&full, value)?;
            } else if let Some(key) = EVENT_KEYS.iter().find(|key| key.name == name) {
                check_value(&full, key, value)?;
            } else {
                return Err(SceneError::UnknownKey {
                    key: super::error::shortened(&full),
                    nearest: nearest(name, ["at_s", "caption", "set"]).map(str::to_owned),
                });
            }
        }
        if !table.contains_key("at_s") {
            return Err(SceneError::Missing {
                key: joined(&path, "at_s"),
                allowed: EVENT_KEYS[0].allowed(),
            });
        }
    }
    Ok(())
}

/// `set` of an event: knobs and values within the range of their keys.
fn check_settings(path: &str, value: &mut Value) -> Result<(), SceneError> {
    let Value::Table(settings) = value else {
        return Err(SceneError::value(
            path,
            shown(value),
            "a table such as { \"motion.slide_roll\" = 1.0 }",
        ));
    };
    for (name, value) in settings.iter_mut() {
        let full = format!("{path}.\"{}\"", super::error::shortened(name));
        match Knob::from_key(name).and_then(Knob::scene_key) {
            Some(key) => check_value(&full, key, value)?,
            None => {
                return Err(SceneError::value(
                    full,
                    shown(value),
                    format!("a knob: {}", Knob::keys()),
                ));
            }
        }
    }
    Ok(())
}

fn check_value(full: &str, key: &Key, value: &mut Value) -> Result<(), SceneError> {
    let fits = match key.kind {
        Kind::Text(longest) => (value.as_str()).is_some_and(|text| text.chars().count() <= longest),
        Kind::Line(longest) => (value.as_str()).is_some_and(|text| {
            text.chars().count() <= longest && !text.chars().any(drives_a_terminal)
        }),
        Kind::Number(..) | Kind::EitherSign(..) | Kind::NumberOrInf(..) => {
            if let Value::Integer(whole) = *value {
                *value = Value::Float(whole as f64);
            }
            value
                .as_float()
                .is_some_and(|number| key.kind.takes(number))
        }
        Kind::Integer(min, max) => {
            (value.as_integer()).is_some_and(|whole| (min..=max).contains(&whole))
        }
        Kind::IntegerOf(values) => {
            (value.as_integer()).is_some_and(|whole| values.contains(&whole))
        }
        Kind::Choice(words) => value.as_str().is_some_and(|text| words.contains(&text)),
        Kind::Switch => value.is_bool(),
    };
    if fits {
        Ok(())
    } else {
        Err(refusal(full, key, value))
    }
}

/// A value as a user would write it.
pub(super) fn shown(value: &Value) -> String {
    match value {
        Value::Float(number) => short(*number),
        Value::Table(_) => "a table".to_owned(),
        Value::Array(_) => "a list".to_owned(),
        other => other.to_string(),
    }
}

/// Steepest slope for which half-space elasticity means anything.
const SLOPE_MAX: f64 = 0.5;

/// A slope that is too steep, with as many figures as say so.
fn beyond(slope: f64) -> String {
    apart(slope, SLOPE_MAX, 2, |slope, digits| {
        format!("{slope:.digits$}")
    })
}

/// The rules that tie keys together.
pub(super) fn check_rules(scene: &Scene) -> Result<(), SceneError> {
    check_shape(scene)?;
    scene.check_wear()?;
    check_load(scene)?;
    check_hardness(scene)?;
    scene.lubricant.as_ref().map_or(Ok(()), Lubricant::check)?;
    check_surface("body_1.surface", &scene.body_1.surface)?;
    check_surface("body_2.surface", &scene.body_2.surface)?;
    if scene.life.is_some() && scene.stress.is_none() {
        return Err(SceneError::value(
            "life",
            "a table",
            "only with a [stress] table; omit both, or --set life=none",
        ));
    }
    if let Some(life) = &scene.life {
        super::life::check_calibration(life)?;
    }
    if let Some(tooth) = &scene.tooth
        && tooth.gears().line_of_action().is_none()
    {
        return Err(SceneError::value(
            "tooth.centre_distance_m",
            format!("{} m", short(tooth.centre_distance_m)),
            GearTeeth::MESHING,
        ));
    }
    scene
        .events
        .iter()
        .enumerate()
        .try_for_each(|(index, event)| check_event_fits(scene, index, event))
}

fn check_surface(path: &str, surface: &Surface) -> Result<(), SceneError> {
    let amplitude_m = surface.amplitude_m();
    let shortest = match *surface {
        Surface::Smooth {} => return Ok(()),
        Surface::Sinusoid {
            wavelength_x_m,
            wavelength_y_m,
            ..
        } => wavelength_x_m.min(wavelength_y_m),
        Surface::Random(_) | Surface::HeightMap { .. } => return check_relief(path, surface),
    };
    if shortest == f64::INFINITY {
        return Err(SceneError::value(
            joined(path, "wavelength_x_m"),
            "inf",
            "a length in m, when wavelength_y_m is inf too (or kind = \"smooth\")",
        ));
    }
    let slope = std::f64::consts::TAU * amplitude_m / shortest;
    if slope > SLOPE_MAX {
        return Err(SceneError::value(
            joined(path, "amplitude_m"),
            format!("{} m", short(amplitude_m)),
            format!(
                "a slope 2 pi A/W of at most {SLOPE_MAX}; this one is {} at W = {} m",
                beyond(slope),
                short(shortest)
            ),
        ));
    }
    Ok(())
}

/// Heights made or read: the steepest significant wave of a map is lower than its largest height, so the bound is generous.
fn check_relief(path: &str, surface: &Surface) -> Result<(), SceneError> {
    if surface.relief().is_none() {
        return Err(SceneError::Missing {
            key: joined(path, "kind"),
            allowed: "heights that have been made or read (Scene::read_maps)".to_owned(),
        });
    }
    let steepness = |[k_x, k_y]: [f64; 2]| surface.rq_m() * std::f64::consts::TAU * k_x.max(k_y);
    let slope = steepness(surface.wavenumbers_per_m());
    if slope <= SLOPE_MAX {
        return Ok(());
    }
    let blame = surface.blame(|waves| steepness(waves) <= SLOPE_MAX);
    let (key, value_m) = match surface.kind() {
        SurfaceKind::Random => ("rq_m", surface.rq_m()),
        SurfaceKind::Smooth | SurfaceKind::Sinusoid | SurfaceKind::HeightMap => {
            ("amplitude_m", surface.amplitude_m())
        }
    };
    Err(SceneError::value(
        joined(path, key),
        format!("{} m", trimmed(value_m, 4)),
        format!(
            "a slope 2 pi Rq/W of at most {SLOPE_MAX}; this one is {}, W the shortest significant wave{}",
            beyond(slope),
            blame.map_or_else(String::new, |cause| format!("; {cause}"))
        ),
    ))
}

/// An event's load must be the one that the kind of contact takes.
fn check_event_load(scene: &Scene, full: &str, name: &str, value: f64) -> Result<(), SceneError> {
    let own = Knob::of_load(scene.contact.kind).key();
    if name == own {
        check_force(scene, full, value)?;
        check_carried(scene, full, value)
    } else {
        Err(SceneError::value(
            full,
            short(value),
            format!("{own} in this kind of contact"),
        ))
    }
}

/// An event's knobs must act on something that the scene has.
fn check_event_fits(scene: &Scene, index: usize, event: &Event) -> Result<(), SceneError> {
    for (name, &value) in &event.set {
        let full = format!("event[{index}].set.\"{name}\"");
        let Some(knob) = Knob::from_key(name) else {
            continue;
        };
        if knob.is_load() {
            check_event_load(scene, &full, name, value)?;
        }
        let refused = if knob.surface(scene).is_some_and(Surface::is_smooth) {
            "only on a body whose surface is not smooth"
        } else if knob == Knob::EntrainmentMS && value * scene.motion.entrainment_m_s < 0.0 {
            "a speed of the scene's own sign: to turn the flow round is another run"
        } else {
            continue;
        };
        return Err(SceneError::value(full, short(value), refused));
    }
    Ok(())
}
