//! What can be wrong with a scene: which key, which value, what is allowed.

use thiserror::Error;

/// A scene that was refused.
#[derive(Debug, Clone, PartialEq, Error)]
pub enum SceneError {
    /// A value outside of what its key allows.
    #[error("{key} = {value} is refused; allowed: {allowed}")]
    Value {
        /// Key in full, such as `motion.slide_roll`.
        key: String,
        /// The value as written.
        value: String,
        /// What is allowed, with unit.
        allowed: String,
    },
    /// A key that no scene has.
    #[error("{key} is not a key of a scene{}", suggestion(nearest.as_deref()))]
    UnknownKey {
        /// Key in full.
        key: String,
        /// The valid key that is spelled most alike.
        nearest: Option<String>,
    },
    /// A key that every scene must have.
    #[error("{key} is missing; allowed: {allowed}")]
    Missing {
        /// Key in full.
        key: String,
        /// What is allowed, with unit.
        allowed: String,
    },
    /// `--set` without a key or a value.
    #[error("--set {text}: write KEY=VALUE, as in --set motion.slide_roll=0.5")]
    Override {
        /// What was given.
        text: String,
    },
    /// Not TOML.
    #[error("{origin} is not valid TOML\n{reason}")]
    Syntax {
        /// File or preset.
        origin: String,
        /// Line, column and what was expected there.
        reason: String,
    },
    /// The file cannot be read.
    #[error("cannot read the scene {path}: {reason}")]
    Read {
        /// Path.
        path: String,
        /// What the system said.
        reason: String,
    },
    /// Neither a preset nor a file.
    #[error("{name} is neither a preset nor a scene file{}; presets: {presets}", suggestion(nearest.as_deref()))]
    UnknownScene {
        /// What was asked for.
        name: String,
        /// The preset that is spelled most alike.
        nearest: Option<String>,
        /// All presets.
        presets: String,
    },
}

impl SceneError {
    /// A value that is refused. `value` is shortened: a hostile file must not fill the screen.
    pub fn value(
        key: impl Into<String>,
        value: impl std::fmt::Display,
        allowed: impl Into<String>,
    ) -> Self {
        Self::Value {
            key: key.into(),
            value: shortened(&value.to_string()),
            allowed: allowed.into(),
        }
    }
}

impl SceneError {
    /// A key of another kind of file that is none of the few that it may have.
    pub fn unknown_among(key: &str, known: &[&str]) -> Self {
        let last = key.rsplit('.').next().unwrap_or(key);
        let guess = nearest(last, known.iter().copied());
        Self::value(
            shortened(key),
            "given",
            format!("only the keys {}{}", known.join(", "), suggestion(guess)),
        )
    }

    /// A file that is refused: `found` is at most a path and a reason, both shortened already.
    pub(super) fn map(key: String, found: String, allowed: String) -> Self {
        Self::Value {
            key,
            value: found,
            allowed,
        }
    }
}

fn suggestion(nearest: Option<&str>) -> String {
    nearest.map_or_else(String::new, |key| format!("; did you mean {key}?"))
}

/// Whether a character controls a terminal, breaks a line, or turns the direction of what is written after it.
pub fn drives_a_terminal(c: char) -> bool {
    c.is_control()
        || matches!(
            c,
            '\u{61c}'
                | '\u{200e}'
                | '\u{200f}'
                | '\u{2028}'..='\u{202e}'
                | '\u{2066}'..='\u{2069}'
                | '\u{feff}'
        )
}

/// At most 60 characters of a text, control characters escaped.
pub(crate) fn shortened(text: &str) -> String {
    const LONGEST: usize = 60;
    let clean: String = text
        .chars()
        .take(LONGEST + 1)
        .map(|c| if drives_a_terminal(c) { ' ' } else { c })
        .collect();
    if clean.chars().count() > LONGEST {
        let head: String = clean.chars().take(LONGEST).collect();
        format!("{head}...")
    } else {
        clean
    }
}

/// The candidate that is spelled most like `word`, if one is near enough to be a slip of the pen.
pub(crate) fn nearest<'a>(
    word: &str,
    candidates: impl IntoIterator<Item = &'a str>,
) -> Option<&'a str> {
    // Edit distance is quadratic in the length, which a hostile file chooses.
    let word = shortened(word);
    let last = |key: &str| key.rsplit('.').next().unwrap_or(key).to_owned();
    candidates
        .into_iter()
        .map(|candidate| {
            // A key in the wrong table or without one is as good a guess as a misspelled one.
            let whole = strsim::normalized_damerau_levenshtein(&word, candidate);
            let leaf = strsim::normalized_damerau_levenshtein(&last(&word), &last(candidate));
            (whole.max(0.95 * leaf), candidate)
        })
        .filter(|(likeness, _)| *likeness > 0.6)
        .max_by(|one, two| one.0.total_cmp(&two.0))
        .map(|(_, candidate)| candidate)
}
