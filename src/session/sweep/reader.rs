//! Reads a table of a sweep file key by key: each is named once, with its range, and every other is refused.
//!
//! `serde` was tried in its place: of 12 faulty files it took 2 (a chain of 0, a range of one case) and of 3 said only that
//! no variant fits; no message would give the range, as those of scenes do.

use std::ops::RangeInclusive;

use toml::{Table, Value};

use asperity_engine::scene::{SceneError, keys};

/// A table that is being read. What is refused, or missing, is kept until [`TableReader::finish`], when all keys are known.
pub(super) struct TableReader<'a> {
    path: String,
    table: &'a Table,
    known: Vec<&'static str>,
    refused: Option<SceneError>,
}

impl<'a> TableReader<'a> {
    /// Of the table at a path within the file, empty for the file itself.
    pub(super) fn new(path: impl Into<String>, table: &'a Table) -> Self {
        Self {
            path: path.into(),
            table,
            known: Vec::new(),
            refused: None,
        }
    }

    /// A key in full.
    pub(super) fn full(&self, name: &str) -> String {
        keys::joined(&self.path, name)
    }

    /// A key's value as `of` takes it, if it is given.
    pub(super) fn optional<T>(
        &mut self,
        name: &'static str,
        allowed: impl Into<String>,
        of: impl FnOnce(&'a Value) -> Option<T>,
    ) -> Option<T> {
        self.known.push(name);
        let value = self.table.get(name)?;
        let read = of(value);
        if read.is_none() {
            let error = SceneError::value(self.full(name), shown(value), allowed);
            self.refused.get_or_insert(error);
        }
        read
    }

    /// Same of a key that must be given; `T`'s default in its place, where [`TableReader::finish`] will refuse the table.
    pub(super) fn required<T: Default>(
        &mut self,
        name: &'static str,
        allowed: impl Into<String>,
        of: impl FnOnce(&'a Value) -> Option<T>,
    ) -> T {
        let allowed = allowed.into();
        if !self.table.contains_key(name) {
            let key = self.full(name);
            let allowed = allowed.clone();
            self.refused
                .get_or_insert(SceneError::Missing { key, allowed });
        }
        self.optional(name, allowed, of).unwrap_or_default()
    }

    /// A number within a range that must be given.
    pub(super) fn number(
        &mut self,
        name: &'static str,
        range: RangeInclusive<f64>,
        unit: &str,
    ) -> f64 {
        self.required(name, words(&range, unit), |value| within(value, &range))
    }

    /// A number within a range, if it is given.
    pub(super) fn optional_number(
        &mut self,
        name: &'static str,
        range: RangeInclusive<f64>,
        unit: &str,
    ) -> Option<f64> {
        self.optional(name, words(&range, unit), |value| within(value, &range))
    }

    /// Two numbers within a range, if they are given.
    pub(super) fn pair(
        &mut self,
        name: &'static str,
        range: RangeInclusive<f64>,
        unit: &str,
    ) -> Option<[f64; 2]> {
        let allowed = format!("two numbers, {}", words(&range, unit));
        self.optional(name, allowed, |value| both(value, &range))
    }

    /// A whole number within a range, or what stands for it.
    pub(super) fn whole(
        &mut self,
        name: &'static str,
        range: RangeInclusive<i64>,
        usual: usize,
    ) -> usize {
        let allowed = whole_words(&range);
        let of = |value: &Value| whole_within(value, &range);
        self.optional(name, allowed, of).unwrap_or(usual)
    }

    /// What one of a few words stands for; the first where none is given.
    pub(super) fn choice<T: Copy>(
        &mut self,
        name: &'static str,
        choices: &'static [(&'static str, T)],
    ) -> T {
        let quoted: Vec<_> = choices.iter().map(|(w, _)| format!("{w:?}")).collect();
        let (last, others) = quoted.split_last().map_or(("", &[][..]), |(l, o)| (l, o));
        let allowed = format!("{} or {last}", others.join(", "));
        let of = |value: &Value| choices.iter().find(|(w, _)| value.as_str() == Some(w));
        self.optional(name, allowed, of).unwrap_or(&choices[0]).1
    }

    /// A table, if it is given.
    pub(super) fn table(&mut self, name: &'static str) -> Option<&'a Table> {
        self.optional(name, format!("a table [{name}]"), Value::as_table)
    }

    /// Once all keys have been asked for.
    ///
    /// # Errors
    /// [`SceneError`] of the first key that the table should not have, else of the first that was refused or is missing.
    pub(super) fn finish(&mut self) -> Result<(), SceneError> {
        let is_unknown = |key: &&String| !self.known.contains(&key.as_str());
        if let Some(key) = self.table.keys().find(is_unknown) {
            return Err(SceneError::unknown_among(&self.full(key), &self.known));
        }
        self.refused.take().map_or(Ok(()), Err)
    }
}

/// A range in words.
fn words(range: &RangeInclusive<f64>, unit: &str) -> String {
    let words = format!("{} to {} {unit}", range.start(), range.end());
    words.trim_end().to_owned()
}

/// A range of whole numbers in words.
pub(super) fn whole_words(range: &RangeInclusive<i64>) -> String {
    format!("a whole number, {} to {}", range.start(), range.end())
}

/// A whole number within a range.
pub(super) fn whole_within(value: &Value, range: &RangeInclusive<i64>) -> Option<usize> {
    let whole = value.as_integer().filter(|n| range.contains(n))?;
    usize::try_from(whole).ok()
}

fn within(value: &Value, range: &RangeInclusive<f64>) -> Option<f64> {
    number(value).filter(|v| range.contains(v))
}

/// Two numbers within a range.
pub(super) fn both(value: &Value, range: &RangeInclusive<f64>) -> Option<[f64; 2]> {
    match value.as_array()?.as_slice() {
        [one, two] => Some([within(one, range)?, within(two, range)?]),
        _ => None,
    }
}

/// A number, also where TOML has it as a whole one.
pub(super) fn number(value: &Value) -> Option<f64> {
    value.as_float().or(value.as_integer().map(|n| n as f64))
}

/// A value in few words.
pub(super) fn shown(value: &Value) -> String {
    match value {
        Value::Float(number) => keys::short(*number),
        Value::Table(_) => "a table".to_owned(),
        Value::Array(_) => "a list".to_owned(),
        other => other.to_string(),
    }
}
