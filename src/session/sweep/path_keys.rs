//! The keys of a path's table, one by one, each with its range.

use toml::Table;

use super::axis::{number, shown};
use asperity_engine::scene::SceneError;

/// Most points of a path.
const MOST_POINTS: i64 = 10_000;

/// A table whose keys are read one by one.
pub(super) struct Keys<'a> {
    pub(super) kind: &'a str,
    pub(super) table: &'a Table,
}

impl Keys<'_> {
    fn full(&self, name: &str) -> String {
        format!("{}.{name}", self.kind)
    }

    /// Refuses every other key.
    pub(super) fn known(&self, names: &[&str]) -> Result<(), SceneError> {
        match self.table.keys().find(|key| !names.contains(&key.as_str())) {
            Some(key) => Err(SceneError::unknown_among(&self.full(key), names)),
            None => Ok(()),
        }
    }

    /// A number within a range, if it is given.
    pub(super) fn maybe(
        &self,
        name: &str,
        range: (f64, f64),
        unit: &str,
    ) -> Result<Option<f64>, SceneError> {
        let Some(value) = self.table.get(name) else {
            return Ok(None);
        };
        let (least, most) = range;
        number(value)
            .filter(|v| (least..=most).contains(v))
            .map(Some)
            .ok_or_else(|| {
                let allowed = format!("{least} to {most} {unit}");
                SceneError::value(self.full(name), shown(value), allowed.trim_end())
            })
    }

    /// A number within a range.
    pub(super) fn number(
        &self,
        name: &str,
        range: (f64, f64),
        unit: &str,
    ) -> Result<f64, SceneError> {
        self.maybe(name, range, unit)?
            .ok_or_else(|| SceneError::Missing {
                key: self.full(name),
                allowed: format!("{} to {} {unit}", range.0, range.1),
            })
    }

    /// Two numbers within a range, if they are given.
    pub(super) fn pair(
        &self,
        name: &str,
        range: (f64, f64),
        unit: &str,
    ) -> Result<Option<[f64; 2]>, SceneError> {
        let Some(value) = self.table.get(name) else {
            return Ok(None);
        };
        let list: Option<Vec<f64>> = value
            .as_array()
            .and_then(|list| list.iter().map(number).collect());
        match list.as_deref() {
            Some([one, two]) if [*one, *two].iter().all(|v| (range.0..=range.1).contains(v)) => {
                Ok(Some([*one, *two]))
            }
            _ => Err(SceneError::value(
                self.full(name),
                shown(value),
                format!("two numbers, {} to {} {unit}", range.0, range.1),
            )),
        }
    }

    /// `points`, or the usual number of them.
    pub(super) fn points(&self, usual: i64) -> Result<usize, SceneError> {
        let Some(value) = self.table.get("points") else {
            return Ok(usual as usize);
        };
        let n = value.as_integer().filter(|n| (2..=MOST_POINTS).contains(n));
        n.map(|n| n as usize).ok_or_else(|| {
            let allowed = format!("a whole number, 2 to {MOST_POINTS}");
            SceneError::value(self.full("points"), shown(value), allowed)
        })
    }
}
