//! One key that a sweep varies, and its values.
//!
//! ```text
//! linear   v_k = from + (to − from) k/(n − 1)            log   v_k = from (to/from)^{k/(n − 1)}
//! ```
//! The last value is `to` itself, not what the formula rounds to.

use toml::Value;

use super::reader::{TableReader, number, shown, whole_within, whole_words};
use asperity_engine::scene::{Knob, SceneError, keys};

/// Most cases of one sweep.
pub const MOST_CASES: usize = 1_000_000;

/// A varied key.
#[derive(Debug, Clone, PartialEq)]
pub struct VariedKey {
    /// Key of the scene, such as `motion.slide_roll`.
    pub key: String,
    /// Its values in the order of the cases.
    pub values: Vec<Value>,
}

/// Knobs in which neighbouring cases may differ for one to start from the other's end.
pub const WARM: [Knob; 3] = Knob::OF_ROUGHNESS_AND_SLIDING;

impl VariedKey {
    /// The key's unit, empty for pure numbers and words.
    pub fn unit(&self) -> &'static str {
        keys::find(&self.key).map_or("", |key| key.unit)
    }

    /// The last part of the key with its unit, as an axis of a plot says it.
    pub fn label(&self) -> String {
        match self.unit() {
            "" => self.key.clone(),
            unit => format!("{}, {unit}", self.key),
        }
    }

    /// The values as numbers; `None` where one is a word.
    pub fn numbers(&self) -> Option<Vec<f64>> {
        self.values.iter().map(number).collect()
    }

    /// Whether neighbours along this axis may start from each other.
    pub fn is_warm(&self) -> bool {
        WARM.iter().any(|knob| knob.key() == self.key)
    }

    /// Reads what stands under `[vary]` for a key.
    pub(super) fn read(key: &str, value: &Value) -> Result<Self, SceneError> {
        let values = match value {
            Value::Array(list) => read_list(key, list)?,
            Value::Table(table) => read_range(key, table)?,
            other => {
                return Err(SceneError::value(
                    format!("vary.{key}"),
                    shown(other),
                    "a list, or { from = .., to = .., n = .., spacing = \"linear\" or \"log\" }",
                ));
            }
        };
        Ok(Self {
            key: key.to_owned(),
            values,
        })
    }
}

fn read_list(key: &str, list: &[Value]) -> Result<Vec<Value>, SceneError> {
    let full = format!("vary.{key}");
    if list.is_empty() || list.len() > MOST_CASES {
        return Err(SceneError::value(
            full,
            format!("a list of {}", list.len()),
            format!("1 to {MOST_CASES} values"),
        ));
    }
    let nested = |value: &&Value| matches!(value, Value::Array(_) | Value::Table(_));
    match list.iter().find(nested) {
        Some(value) => Err(SceneError::value(
            full,
            shown(value),
            "numbers or words in the list",
        )),
        None => Ok(list.to_vec()),
    }
}

/// How the values of a range lie.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Spacing {
    Linear,
    Log,
}

const SPACINGS: [(&str, Spacing); 2] = [("linear", Spacing::Linear), ("log", Spacing::Log)];

fn read_range(key: &str, table: &toml::Table) -> Result<Vec<Value>, SceneError> {
    let mut range = TableReader::new(format!("vary.{key}"), table);
    let finite = |value: &Value| number(value).filter(|v| v.is_finite());
    let from = range.required("from", "a finite number", finite);
    let to = range.required("to", "a finite number", finite);
    let counts = 2..=MOST_CASES as i64;
    let n = range.required("n", whole_words(&counts), |n| whole_within(n, &counts));
    let spacing = range.choice("spacing", &SPACINGS);
    range.finish()?;
    let share = |k: usize| k as f64 / (n - 1) as f64;
    let at = |k: usize| match spacing {
        Spacing::Linear => from + (to - from) * share(k),
        Spacing::Log => from * (to / from).powf(share(k)),
    };
    if spacing == Spacing::Log && from * to <= 0.0 {
        return Err(SceneError::value(
            range.full("spacing"),
            "\"log\"",
            "from and to of one sign, neither 0",
        ));
    }
    // A step of S = 0.1 is meant as 0.1: fifteen digits take the rounding of the formula off again.
    let neat = |v: f64| format!("{v:.14e}").parse().unwrap_or(v);
    let mut values: Vec<f64> = (0..n).map(|k| neat(at(k))).collect();
    values[n - 1] = to;
    if keys::find(key).is_some_and(|key| takes_whole_numbers(key.kind)) {
        return values
            .into_iter()
            .map(|v| whole(&range.full("n"), v))
            .collect();
    }
    Ok(values.into_iter().map(Value::Float).collect())
}

fn takes_whole_numbers(kind: keys::Kind) -> bool {
    match kind {
        keys::Kind::Integer(..) | keys::Kind::IntegerOf(_) => true,
        keys::Kind::Text(_)
        | keys::Kind::Line(_)
        | keys::Kind::Number(..)
        | keys::Kind::EitherSign(..)
        | keys::Kind::NumberOrInf(..)
        | keys::Kind::Choice(_)
        | keys::Kind::Switch => false,
    }
}

/// A value of a key that takes whole numbers only.
fn whole(full: &str, value: f64) -> Result<Value, SceneError> {
    if value == value.round() {
        Ok(Value::Integer(value as i64))
    } else {
        Err(SceneError::value(
            full,
            format!("a step that meets {value}"),
            "a range that meets whole numbers only, or a list",
        ))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn axis(text: &str) -> Result<VariedKey, SceneError> {
        let table: toml::Table = format!("v = {text}").parse().expect("TOML");
        VariedKey::read("motion.slide_roll", &table["v"])
    }

    #[test]
    fn ranges_are_even_and_end_where_they_say() {
        let values = axis("{ from = 0, to = 2, n = 21 }")
            .expect("read")
            .numbers()
            .expect("numbers");
        assert_eq!(values.len(), 21);
        assert_eq!((values[0], values[3], values[20]), (0.0, 0.3, 2.0));
        let values = axis("{ from = 0.01, to = 10, n = 4, spacing = \"log\" }");
        assert_eq!(
            values.expect("read").numbers().expect("numbers"),
            [0.01, 0.1, 1.0, 10.0]
        );
        assert_eq!(
            axis("[1, 2.5]").expect("read").numbers().expect("numbers"),
            [1.0, 2.5]
        );
    }

    #[test]
    fn what_is_no_range_is_refused_by_name() {
        for (text, said) in [
            ("0.3", "a list, or"),
            ("[]", "1 to"),
            ("[[1]]", "in the list"),
            (
                "{ from = 0, n = 3 }",
                "vary.motion.slide_roll.to is missing",
            ),
            ("{ from = 0, to = nan, n = 3 }", "finite"),
            ("{ from = 0, to = 1, n = 1 }", "2 to"),
            ("{ from = 0, to = 1, n = 999999999 }", "2 to"),
            ("{ from = 0, to = 1, n = 2.5 }", "2 to"),
            (
                "{ from = 0, to = 1, n = 3, spacing = \"log\" }",
                "neither 0",
            ),
            (
                "{ from = 0, to = 1, n = 3, spacing = \"cubic\" }",
                "\"linear\" or",
            ),
            ("{ from = 0, to = 1, m = 3 }", "only the keys from"),
        ] {
            let error = axis(text).expect_err("refused").to_string();
            assert!(error.contains(said), "{text}: {error}");
        }
    }
}
