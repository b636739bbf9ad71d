//! Why a value is refused, in words that fit it. A range is shown only to what lies outside of it: to somebody who wrote
//! `"800 N"` a range that holds 800 says nothing. Lengths in mm and moduli in GPa are the usual slips, so what is usual is
//! kept beside what is allowed.

use toml::{Table, Value};

use super::check::lookup;
use super::error::SceneError;
use super::keys::{Key, Kind, SECTIONS, short};
use super::model::Scene;

/// What is usual in machines and on test rigs, by the key's name, in its unit; far less than what is allowed. Beyond it a
/// number is most often one in another unit.
const USUAL: [(&str, f64, f64); 22] = [
    ("rx_m", 1e-3, 0.5),
    ("ry_m", 1e-3, 2.0),
    ("young_pa", 1e9, 1.2e12),
    ("hardness_pa", 5e8, 3e10),
    ("pixel_m", 1e-8, 1e-4),
    ("amplitude_m", 1e-10, 1e-5),
    ("wavelength_x_m", 1e-6, 1e-2),
    ("wavelength_y_m", 1e-6, 1e-2),
    ("viscosity_pa_s", 5e-4, 10.0),
    ("pressure_viscosity_per_pa", 1e-9, 5e-8),
    ("eyring_stress_pa", 5e5, 5e7),
    ("contact_film_m", 1e-10, 1e-7),
    ("entrainment_m_s", 1e-3, 60.0),
    ("force_n", 1e-2, 1e5),
    ("force_n_per_m", 1e3, 1e7),
    ("hertz_pressure_pa", 5e7, 5e9),
    ("limit_pa", 1e8, 2e9),
    ("calibration_pressure_pa", 5e7, 5e9),
    ("module_m", 2e-4, 0.05),
    ("centre_distance_m", 5e-3, 3.0),
    ("pinion_tip_diameter_m", 5e-3, 3.0),
    ("wheel_tip_diameter_m", 5e-3, 6.0),
];

fn usual(key: &Key) -> Option<(f64, f64)> {
    let found = USUAL.iter().find(|(name, ..)| *name == key.name);
    found.map(|&(_, low, high)| (low, high))
}

/// The error for a value that its key does not take.
pub(super) fn refusal(full: &str, key: &Key, value: &Value) -> SceneError {
    SceneError::value(full, shown(key, value), allowed(key, value))
}

/// A value as it was written: 65.0 is not 65 where whole numbers are meant.
fn shown(key: &Key, value: &Value) -> String {
    match value {
        Value::Float(number) if key.is_whole() => format!("{number:?}"),
        Value::String(text) => match typed(text) {
            // Digits without end.
            Some(typed) if typed.unit.is_empty() && text.len() > 20 => short(typed.number),
            Some(_) | None => value.to_string(),
        },
        Value::Integer(_)
        | Value::Float(_)
        | Value::Boolean(_)
        | Value::Datetime(_)
        | Value::Array(_)
        | Value::Table(_) => super::check::shown(value),
    }
}

fn allowed(key: &Key, value: &Value) -> String {
    match (key.kind, value) {
        (Kind::Choice(_), _) | (Kind::Text(_) | Kind::Line(_), Value::String(_)) => key.allowed(),
        (Kind::Text(_) | Kind::Line(_), _) => format!("{}, in quotes", key.allowed()),
        (_, Value::Integer(number)) => beyond(key, *number as f64),
        (_, Value::Float(number)) => of_number(key, *number),
        (_, Value::String(text)) => of_text(key, text),
        (_, Value::Boolean(_) | Value::Datetime(_) | Value::Array(_) | Value::Table(_)) => {
            bare(key, "")
        }
    }
}

/// A number of the key's unit, with whatever is said of how it is written.
fn bare(key: &Key, how: &str) -> String {
    let noun = if key.is_whole() {
        "a whole number"
    } else {
        "a number"
    };
    match (how, key.is_whole()) {
        // A list of numbers says it all.
        ("", true) => key.allowed(),
        ("", false) => format!("{noun}, {}", key.allowed()),
        _ => format!("{noun}{how}"),
    }
}

/// What is allowed instead of a number that the key does not take.
fn of_number(key: &Key, number: f64) -> String {
    if key.is_whole() && key.takes(number) {
        return format!("a whole number, written without a point: {number}");
    }
    if matches!(key.kind, Kind::Integer(..)) && number.fract() != 0.0 && number.is_finite() {
        return bare(key, ", without a fraction");
    }
    beyond(key, number)
}

/// The range that a number lies outside of, and what it may have been meant to be.
fn beyond(key: &Key, number: f64) -> String {
    let meant = meant(key, number).map(|meant| format!("; did you mean {}?", short(meant)));
    format!("{}{}", key.allowed(), meant.unwrap_or_default())
}

/// What is allowed instead of a text, which says how the number was meant.
fn of_text(key: &Key, text: &str) -> String {
    let Some(typed) = typed(text) else {
        return bare(key, "");
    };
    let fits = key.takes(typed.number);
    let how = if typed.has_comma && key.is_whole() {
        ", without a comma"
    } else if typed.is_ambiguous {
        ", with a point and without marks of thousands"
    } else if typed.has_comma {
        ", with a point and not a comma"
    } else if typed.unit != key.unit && typed.unit.starts_with(|c: char| c.is_ascii_digit()) {
        ", without spaces in it"
    } else if !typed.unit.is_empty() {
        ", without a unit"
    } else {
        ", without quotes"
    };
    let how = match key.unit {
        "" => how.to_owned(),
        unit => format!("{how}, in {unit}"),
    };
    // In another unit it is another number.
    let is_own = typed.unit.is_empty() || typed.unit == key.unit;
    if fits && is_own && !typed.is_ambiguous {
        return bare(key, &format!("{how}: {}", short(typed.number)));
    }
    let is_fraction = key.is_whole() && typed.number.fract() != 0.0;
    if fits || typed.is_ambiguous || is_fraction {
        return bare(key, &how);
    }
    format!("{}; {}", bare(key, &how), key.allowed())
}

/// A number as people write it.
struct Typed<'a> {
    number: f64,
    has_comma: bool,
    /// One comma and three digits, or several marks: nobody knows which stands for what.
    is_ambiguous: bool,
    /// What follows.
    unit: &'a str,
}

/// The longest beginning of a text that is a number; a comma counts as a point.
fn typed(text: &str) -> Option<Typed<'_>> {
    const LONGEST: usize = 400;
    let text = text.trim();
    let ends = text.char_indices().map(|(at, c)| at + c.len_utf8());
    let read = |end: usize| {
        let head = &text[..end];
        let is_digits = head.ends_with(|c: char| c.is_ascii_digit() || c == '.');
        let number = head.replace(',', ".").replace('_', "");
        // Several marks: the digits alone, to know whether it is a number at all.
        let marks = number.matches('.').count();
        let number = if marks > 1 {
            number.replace('.', "")
        } else {
            number
        };
        let value = number.parse::<f64>().ok().filter(|_| is_digits)?;
        let after = head.split_once(',').map_or("", |(_, after)| after);
        let thousands = after.len() == 3 && !head.starts_with("0,");
        Some(Typed {
            number: value,
            has_comma: head.contains(','),
            is_ambiguous: marks > 1 || thousands,
            unit: text[end..].trim(),
        })
    };
    ends.take(LONGEST).filter_map(read).last()
}

/// What a line of a scene file, `KEY = VALUE`, should have said, if it is a number that TOML does not read.
pub(super) fn meant_in_line(line: &str) -> Option<String> {
    let (path, value) = line.split_once('=')?;
    let typed = typed(value.split('#').next()?)?;
    let how = if typed.has_comma {
        "a point, not a comma"
    } else if typed.unit.starts_with(char::is_alphabetic) {
        "without a unit"
    } else {
        return None;
    };
    let instead = if typed.is_ambiguous {
        String::new()
    } else {
        format!(": {}", short(typed.number))
    };
    Some(format!(
        "a number is written with {how}{instead} ({})",
        path.trim()
    ))
    .map(|words| words.replace("with without", "without"))
}

/// A number a thousand or a million times too large or small that is usual otherwise: mm, µm, MPa, mPa s, kN. Moduli are
/// in GPa, too.
fn meant(key: &Key, number: f64) -> Option<f64> {
    let (low, high) = usual(key)?;
    let giga = (key.unit == "Pa").then_some(1e9);
    let larger = [1e3, 1e6].into_iter().chain(giga).map(|by| number * by);
    let smaller = [1e3, 1e6].into_iter().map(|by| number / by);
    larger
        .chain(smaller)
        // As it would be typed.
        .filter_map(|meant| format!("{meant:.11e}").parse::<f64>().ok())
        .find(|meant| (low..=high).contains(&meant.abs()) && key.takes(*meant))
}

/// The key of a scene that is farthest from what is usual, in words. A refusal may name another key, which only suffers
/// from it: with a radius of 19.05 m all waves are too short.
pub(crate) fn unusual(scene: &Scene) -> Option<String> {
    let root = Table::try_from(scene).ok()?;
    let keys = SECTIONS
        .iter()
        .flat_map(|section| section.keys.iter().map(move |key| (section, key)));
    let far = keys.filter_map(|(section, key)| {
        let (low, high) = usual(key)?;
        let value = lookup(&root, section.path)?.get(key.name)?.as_float()?;
        let size = value.abs();
        let times = (size / high).max(low / size);
        (times.is_finite() && times > 1.0).then_some((times, section.path_of(key.name), key, value))
    });
    let (_, path, key, value) = far.max_by(|one, two| one.0.total_cmp(&two.0))?;
    let (low, high) = usual(key)?;
    let unit = key.unit;
    let meant = meant(key, value);
    let meant = meant.map(|meant| format!("; did you mean {} {unit}?", short(meant)));
    Some(format!(
        "{path} = {} {unit} is far from what is usual, {} to {} {unit}{}",
        short(value),
        short(low),
        short(high),
        meant.unwrap_or_default()
    ))
}

impl SceneError {
    /// The same with the key that is far from what is usual, if there is one.
    pub(super) fn beside_the_unusual(self, scene: &Scene) -> Self {
        match (self, unusual(scene)) {
            (
                Self::Value {
                    key,
                    value,
                    allowed,
                },
                Some(words),
            ) => Self::Value {
                key,
                value,
                allowed: format!("{allowed}; {words}"),
            },
            (error, _) => error,
        }
    }
}

impl Key {
    /// Whether it takes whole numbers alone.
    fn is_whole(&self) -> bool {
        match self.kind {
            Kind::Integer(..) | Kind::IntegerOf(_) => true,
            Kind::Text(_)
            | Kind::Line(_)
            | Kind::Number(..)
            | Kind::EitherSign(..)
            | Kind::NumberOrInf(..)
            | Kind::Choice(_)
            | Kind::Switch => false,
        }
    }

    /// Whether it takes that number, were it written as it should be.
    fn takes(&self, number: f64) -> bool {
        let whole = number as i64;
        match self.kind {
            Kind::Integer(min, max) => whole as f64 == number && (min..=max).contains(&whole),
            Kind::IntegerOf(values) => whole as f64 == number && values.contains(&whole),
            Kind::Text(_)
            | Kind::Line(_)
            | Kind::Number(..)
            | Kind::EitherSign(..)
            | Kind::NumberOrInf(..)
            | Kind::Choice(_)
            | Kind::Switch => self.kind.takes(number),
        }
    }
}

#[cfg(test)]
#[expect(clippy::unwrap_used, reason = "tests")]
mod tests {
    use super::*;
    use crate::scene::presets;

    #[test]
    fn numbers_are_read_as_people_write_them() {
        for (text, number, comma, ambiguous, unit) in [
            ("800 N", 800.0, false, false, "N"),
            ("1,5", 1.5, true, false, ""),
            ("-1,5e-3m", -1.5e-3, true, false, "m"),
            ("1,500", 1.5, true, true, ""),
            ("0,500", 0.5, true, false, ""),
            ("1.234,5 N", 12345.0, true, true, "N"),
            ("1 000", 1.0, false, false, "000"),
            (".5", 0.5, false, false, ""),
            ("2µm", 2.0, false, false, "µm"),
        ] {
            let typed = typed(text).unwrap();
            let found = (
                typed.number,
                typed.has_comma,
                typed.is_ambiguous,
                typed.unit,
            );
            assert_eq!(found, (number, comma, ambiguous, unit), "{text}");
        }
        for text in ["", "N", "fast", "−5", "e", ","] {
            assert!(typed(text).is_none(), "{text}");
        }
    }

    /// What is called usual is: of the scenes that come with the program no key is far from it.
    #[test]
    fn the_presets_are_usual() {
        for preset in presets::listed() {
            let scene = Scene::load(preset.name).unwrap();
            assert_eq!(unusual(&scene), None, "{}", preset.name);
        }
        for (name, low, high) in USUAL {
            let keys = SECTIONS.iter().flat_map(|section| section.keys);
            let key = keys.clone().find(|key| key.name == name).unwrap();
            assert!(key.takes(low) && key.takes(high), "{name}");
        }
    }
}
