//! What can be wrong with a sweep.

use thiserror::Error;

use asperity_engine::plan::PlanError;
use asperity_engine::scene::SceneError;

/// A sweep that was refused or came to grief.
#[derive(Debug, Clone, Error)]
pub enum SweepError {
    /// The sweep file: which key, which value, what is allowed.
    #[error("{origin}: {source}")]
    File {
        /// File or built-in sweep.
        origin: String,
        /// What is wrong.
        source: SceneError,
    },
    /// The sweep file cannot be read.
    #[error("cannot read the sweep {path}: {reason}")]
    Read {
        /// Path.
        path: String,
        /// What is wrong.
        reason: String,
    },
    /// One of its cases is no scene.
    #[error("case {index} ({at}): {source}")]
    Case {
        /// Number of the case, from 0.
        index: usize,
        /// Its values.
        at: String,
        /// What is wrong.
        source: SceneError,
    },
    /// One of its cases cannot be computed.
    #[error("case {index} ({at}): {source}")]
    Plan {
        /// Number of the case, from 0.
        index: usize,
        /// Its values.
        at: String,
        /// What is wrong.
        source: PlanError,
    },
    /// A chain that the sweep does not have.
    #[error("--chain {asked}: the sweep has chains 0 to {last}")]
    Chain {
        /// Its number.
        asked: usize,
        /// The last one's.
        last: usize,
    },
    /// A folder or a file in it.
    #[error("{path}: {reason}")]
    Folder {
        /// Path.
        path: String,
        /// What is wrong.
        reason: String,
    },
    /// Cases are missing.
    #[error("{missing} of {all} cases are missing: {list}")]
    Incomplete {
        /// How many.
        missing: usize,
        /// Of how many.
        all: usize,
        /// The chains that lack them.
        list: String,
    },
}

impl SweepError {
    /// A folder or file that fails.
    pub(super) fn folder(path: &std::path::Path, reason: impl std::fmt::Display) -> Self {
        Self::Folder {
            path: path.display().to_string(),
            reason: reason.to_string(),
        }
    }
}
