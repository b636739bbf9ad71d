//! Studies: what results cost, and what they are worth. Every number is measured in the run that prints it.

mod scaling;
pub mod sweep;

pub use scaling::{Extent, ScalingRow, scaling, scaling_text};

use thiserror::Error;

/// A study that could not be done.
#[derive(Debug, Clone, Error)]
pub enum StudyError {
    /// A scene of the study is not accepted: a fault of the study.
    #[error("the study's own scene is refused: {0}")]
    Scene(String),
    /// A run of the study failed.
    #[error("{case}: {reason}")]
    Run {
        /// Which case.
        case: String,
        /// What went wrong.
        reason: String,
    },
}
