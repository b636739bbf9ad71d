//! What a key of a scene is: unit, range, need and meaning, and how its range reads in words. The table of all
//! keys is `key_table.rs`; the strict check, the errors, the printed scenes and the help all read it, so
//! that none of them can drift from the others.

pub use super::key_table::{EVENT_KEYS, KNOB_KEYS, SECTIONS};

use Kind::{Choice, EitherSign, Integer, IntegerOf, Number, NumberOrInf, Text};
use Need::{Optional, Required};

/// What a key takes.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Kind {
    /// Text of at most so many characters.
    Text(usize),
    /// A finite number between two bounds, both included.
    Number(f64, f64),
    /// A finite number of either sign whose size lies between two bounds, both included and above 0.
    EitherSign(f64, f64),
    /// A finite number between two bounds, or `inf`.
    NumberOrInf(f64, f64),
    /// A whole number between two bounds, both included.
    Integer(i64, i64),
    /// One of a few whole numbers.
    IntegerOf(&'static [i64]),
    /// One of a few words.
    Choice(&'static [&'static str]),
}

/// Whether a key or a table may be left out.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Need {
    /// It must be there.
    Required,
    /// Left out, it takes its default, which printed scenes show.
    Defaulted,
    /// Left out means something of its own; the text says what.
    Optional(&'static str),
}

/// One key.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Key {
    /// Name within its table.
    pub name: &'static str,
    /// Unit, empty for pure numbers and words.
    pub unit: &'static str,
    /// What it takes.
    pub kind: Kind,
    /// Whether it may be left out.
    pub need: Need,
    /// What it means.
    pub doc: &'static str,
}

/// One table of a scene file.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Section {
    /// Its path, such as `body_1.surface`; empty for the top of the file.
    pub path: &'static str,
    /// Whether it may be left out.
    pub need: Need,
    /// What it holds.
    pub doc: &'static str,
    /// Its keys in the order in which they are printed.
    pub keys: &'static [Key],
}

pub(super) const fn key(
    name: &'static str,
    unit: &'static str,
    kind: Kind,
    need: Need,
    doc: &'static str,
) -> Key {
    Key {
        name,
        unit,
        kind,
        need,
        doc,
    }
}

impl Kind {
    /// Whether it takes that number.
    pub fn takes(&self, number: f64) -> bool {
        match *self {
            Number(min, max) => (min..=max).contains(&number),
            EitherSign(min, max) => (min..=max).contains(&number.abs()),
            NumberOrInf(min, max) => (min..=max).contains(&number) || number == f64::INFINITY,
            Text(_) | Integer(..) | IntegerOf(_) | Choice(_) => false,
        }
    }
}

impl Key {
    /// What the key takes, in words, with its unit.
    pub fn allowed(&self) -> String {
        let unit = if self.unit.is_empty() {
            String::new()
        } else {
            format!(" {}", self.unit)
        };
        match self.kind {
            Text(longest) => format!("a text of at most {longest} characters"),
            Number(min, max) => format!("{} to {}{unit}", short(min), short(max)),
            EitherSign(min, max) => format!(
                "{} to {}{unit}, or {} to {}{unit}; never 0",
                short(min),
                short(max),
                short(-max),
                short(-min)
            ),
            NumberOrInf(min, max) => format!("{} to {}{unit}, or inf", short(min), short(max)),
            Integer(min, max) => format!("a whole number, {min} to {max}{unit}"),
            IntegerOf(values) => {
                let list: Vec<_> = values.iter().map(i64::to_string).collect();
                format!("one of {}", list.join(", "))
            }
            Choice(words) => {
                let list: Vec<_> = words.iter().map(|word| format!("\"{word}\"")).collect();
                if list.len() == 1 {
                    format!("{} (more in later versions)", list[0])
                } else {
                    list.join(" or ")
                }
            }
        }
    }
}

impl Key {
    /// Whether the key may be left out of a `table` of that `kind` (its key `kind`); `None`: it has no
    /// place there.
    pub fn need_in(&self, table: &str, kind: Option<&str>) -> Option<Need> {
        if (table, kind, self.name) == ("contact", Some("point"), "ry_m") {
            return Some(Required);
        }
        if !table.ends_with(".surface") || self.name == "kind" {
            return Some(self.need);
        }
        let of_map = matches!(
            self.name,
            "file" | "pixel_m" | "edge" | "unit_m" | "start_x_m"
        );
        match (kind, self.name) {
            (Some("smooth"), _) => None,
            (Some("height_map"), "amplitude_m") => Some(Optional("as in the file")),
            (Some("height_map"), _) => of_map.then_some(self.need),
            _ => (!of_map).then_some(self.need),
        }
    }

    /// The kinds of surface that take the key, for messages.
    pub(super) fn kinds(&self) -> &'static str {
        match (
            self.need_in(".surface", Some("sinusoid")),
            self.need_in(".surface", Some("height_map")),
        ) {
            (Some(_), None) => "\"sinusoid\"",
            (None, Some(_)) => "\"height_map\"",
            _ => "\"sinusoid\" or \"height_map\"",
        }
    }
}

impl Section {
    /// A key's path in full.
    pub fn path_of(&self, name: &str) -> String {
        joined(self.path, name)
    }

    /// The key of that name.
    pub fn key(&self, name: &str) -> Option<&'static Key> {
        self.keys.iter().find(|key| key.name == name)
    }
}

/// The table at that path.
pub fn section(path: &str) -> Option<&'static Section> {
    SECTIONS.iter().find(|section| section.path == path)
}

/// The key with that full path, such as `motion.slide_roll`.
pub fn find(path: &str) -> Option<&'static Key> {
    let (table, name) = path.rsplit_once('.').unwrap_or(("", path));
    section(table)?.key(name)
}

/// Every key in full, in printed order.
pub fn all_paths() -> impl Iterator<Item = String> {
    SECTIONS
        .iter()
        .flat_map(|section| section.keys.iter().map(|key| section.path_of(key.name)))
}

pub(crate) fn joined(table: &str, name: &str) -> String {
    if table.is_empty() {
        name.to_owned()
    } else {
        format!("{table}.{name}")
    }
}

/// A number in the fewest characters that read well: 0.3, 1e-6, 2.1e11.
pub(crate) fn short(value: f64) -> String {
    let size = value.abs();
    if value == 0.0 || (1e-3..1e5).contains(&size) {
        format!("{value}")
    } else {
        format!("{value:e}")
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn keys_are_unique_and_documented() {
        let mut paths: Vec<_> = all_paths().collect();
        let n_all = paths.len();
        paths.sort();
        paths.dedup();
        assert_eq!(paths.len(), n_all);
        for section in SECTIONS {
            for key in section.keys {
                assert!(!key.doc.is_empty(), "{}", key.name);
                assert!(find(&section.path_of(key.name)).is_some());
            }
        }
    }

    #[test]
    fn units_agree_with_the_names() {
        for section in SECTIONS {
            for key in section.keys {
                for (suffix, unit) in [
                    ("_m_s", "m/s"),
                    ("_pa_s", "Pa s"),
                    ("_per_pa", "1/Pa"),
                    ("_deg", "degrees"),
                    ("_mb", "MB"),
                ] {
                    assert!(
                        !key.name.ends_with(suffix) || key.unit == unit,
                        "{} is in {unit}",
                        key.name
                    );
                }
            }
        }
    }

    #[test]
    fn what_is_allowed_reads_well() {
        let allowed = |path| find(path).map(Key::allowed);
        assert_eq!(
            allowed("load.hertz_pressure_pa").as_deref(),
            Some("1e6 to 1e10 Pa")
        );
        assert_eq!(
            allowed("lubricant.rheology").as_deref(),
            Some("\"newtonian\" or \"eyring\"")
        );
        assert_eq!(
            allowed("body_2.surface.wavelength_x_m").as_deref(),
            Some("1e-7 to 1 m, or inf")
        );
    }
}
