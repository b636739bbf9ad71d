//! A scene as TOML with a comment beside every key: meaning, unit and range.

use std::fmt::Write as _;

use toml::{Table, Value};

use super::Knob;
use super::check::lookup;
use super::drawing::drawn_keys;
use super::keys::{EVENT_KEYS, Key, Need, SECTIONS, Section};
use super::model::Scene;

/// Column at which comments start.
const COMMENT_COLUMN: usize = 36;

impl Scene {
    /// The scene as TOML, every key documented; reading it back gives the same scene.
    pub fn to_toml(&self) -> String {
        // Serialising plain data into a table fails for no scene; an empty text would show in tests.
        let table = Table::try_from(self).unwrap_or_default();
        let mut text = String::from(
            "# A scene of asperity. SI units, named in the keys; each key with its meaning, unit and range.\n\
             # Keys that are omitted take the values that `asperity scenes demonstration` shows.\n\n",
        );
        for section in SECTIONS {
            push_section(&mut text, section, lookup(&table, section.path));
        }
        push_events(&mut text, table.get("event"));
        text
    }
}

fn push_section(text: &mut String, section: &Section, table: Option<&Table>) {
    let Some(table) = table else {
        if let Need::Optional(meaning) = section.need {
            push_omitted_section(text, section, meaning);
        }
        return;
    };
    if !section.path.is_empty() {
        if section.doc.is_empty() {
            push(text, format_args!("[{}]\n", section.path));
        } else {
            push(
                text,
                format_args!("\n# {}\n[{}]\n", section.doc, section.path),
            );
        }
    }
    let kind = table.get("kind").and_then(Value::as_str);
    for key in section.keys {
        if let Some(value) = table.get(key.name) {
            push_key(text, key, value);
            continue;
        }
        let need = key.need_in(section.path, kind);
        push_left_out(text, key, need);
        // The keys of other surfaces are told once.
        if need.is_none() && section.path == "body_1.surface" {
            push_of_other_kind(text, key);
        }
    }
    // Those of drawings, too, are told once.
    let drawn = drawn_keys().filter(|(path, _)| {
        section.path != "body_2.surface" && *path == section.path_of(own(path))
    });
    for (_, key) in drawn {
        let setting = format!("# {} =", key.name);
        push(
            text,
            format_args!("{setting:<COMMENT_COLUMN$}# {}\n", comment(key)),
        );
    }
}

/// The last name of a path.
fn own(path: &str) -> &str {
    path.rsplit('.').next().unwrap_or(path)
}

fn push_omitted_section(text: &mut String, section: &Section, meaning: &str) {
    push(
        text,
        format_args!(
            "\n# {}\n# [{}]    # omitted: {meaning}\n",
            section.doc, section.path
        ),
    );
    for key in section.keys {
        let setting = format!("# {} =", key.name);
        push(
            text,
            format_args!("{setting:<COMMENT_COLUMN$}# {}\n", comment(key)),
        );
    }
}

fn push_key(text: &mut String, key: &Key, value: &Value) {
    let setting = format!("{} = {}", key.name, toml_value(value));
    if setting.len() > COMMENT_COLUMN {
        push(text, format_args!("# {}\n{setting}\n", comment(key)));
    } else {
        push(
            text,
            format_args!("{setting:<COMMENT_COLUMN$}# {}\n", comment(key)),
        );
    }
}

fn push_left_out(text: &mut String, key: &Key, need: Option<Need>) {
    if let Some(Need::Optional(meaning)) = need {
        let setting = format!("# {} =", key.name);
        push(
            text,
            format_args!(
                "{setting:<COMMENT_COLUMN$}# {}; omitted: {meaning}\n",
                comment(key)
            ),
        );
    }
}

fn push_of_other_kind(text: &mut String, key: &Key) {
    let setting = format!("# {} =", key.name);
    push(
        text,
        format_args!(
            "{setting:<COMMENT_COLUMN$}# {}; only with kind = {}\n",
            comment(key),
            key.kinds()
        ),
    );
}

fn comment(key: &Key) -> String {
    format!("{}; {}", key.doc, key.allowed())
}

fn push_events(text: &mut String, events: Option<&Value>) {
    push(
        text,
        format_args!(
            "\n# Scripted changes, any number of [[event]]: at_s ({}), caption, and\n\
             # set = {{ \"motion.slide_roll\" = 1.0 }} with any of {}.\n",
            EVENT_KEYS[0].doc,
            Knob::keys()
        ),
    );
    for event in events.and_then(Value::as_array).into_iter().flatten() {
        text.push_str("[[event]]\n");
        for (name, value) in event.as_table().into_iter().flatten() {
            push(text, format_args!("{name} = {}\n", toml_value(value)));
        }
    }
}

/// A value on one line, floats in their shortest form that reads back exactly.
fn toml_value(value: &Value) -> String {
    match value {
        Value::Float(number) => toml_float(*number),
        Value::Table(table) => {
            let entries: Vec<_> = table
                .iter()
                .map(|(key, value)| format!("{key:?} = {}", toml_value(value)))
                .collect();
            if entries.is_empty() {
                "{}".to_owned()
            } else {
                format!("{{ {} }}", entries.join(", "))
            }
        }
        other => other.to_string(),
    }
}

fn toml_float(number: f64) -> String {
    let size = number.abs();
    if number == 0.0 || !number.is_finite() || (1e-3..1e5).contains(&size) {
        return format!("{number:?}");
    }
    let text = format!("{number:e}");
    match text.split_once('e') {
        Some((mantissa, exponent)) if !mantissa.contains('.') => format!("{mantissa}.0e{exponent}"),
        _ => text,
    }
}

fn push(text: &mut String, what: std::fmt::Arguments<'_>) {
    // Writing to a String cannot fail.
    let _ = text.write_fmt(what);
}
