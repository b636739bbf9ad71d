//! Studies: what results cost, and what they are worth. Every number is measured in the run that prints it.

pub mod accuracy;
pub mod evidence;
mod machine;
mod scaling;
pub mod stability;
mod table;

pub use machine::machine;
pub use scaling::{ScalingRow, scaling, scaling_text};
pub use table::{MarkdownTable, figure};

use thiserror::Error;

/// How much to measure.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Extent {
    /// The least that shows every part: within about a minute.
    Quick,
    /// Some minutes.
    Usual,
    /// Everything.
    Full,
}

/// Hears the name of what is done next, how many are done, and how many there are.
pub type StudyProgress<'a> = dyn FnMut(&str, usize, usize) + 'a;

/// A study that could not be done.
#[derive(Debug, Clone, Error)]
pub enum StudyError {
    /// A scene of the study is not accepted: a fault of the study.
    #[error("the study's own scene is refused: {0}")]
    Scene(String),
    /// A picture could not be drawn.
    #[error("a plot could not be drawn: {0}")]
    Plot(String),
    /// Cases were asked for by a text that none has in its name.
    #[error("--only {0}: no case of this study has that in its name")]
    NoCase(String),
    /// A run of the study failed.
    #[error("{case}: {reason}")]
    Run {
        /// Which case.
        case: String,
        /// What went wrong.
        reason: String,
    },
}

/// Refuses a choice of cases that leaves nothing.
fn refuse_nothing(only: Option<&str>, is_empty: bool) -> Result<(), StudyError> {
    match only {
        Some(part) if is_empty => Err(StudyError::NoCase(part.to_owned())),
        _ => Ok(()),
    }
}
