//! Words of studies.

use std::path::PathBuf;

use clap::Args;

/// What to study.
#[derive(Debug, Args)]
pub(crate) struct StudyArgs {
    /// Which study
    #[arg(value_enum)]
    pub(crate) kind: StudyKind,
    /// The smallest set of cases
    #[arg(long, conflicts_with = "full")]
    pub(crate) quick: bool,
    /// The largest set of cases
    #[arg(long)]
    pub(crate) full: bool,
    /// Folder for the report's files; created if missing
    #[arg(long, value_name = "FOLDER")]
    pub(crate) out: Option<PathBuf>,
    /// Only cases whose name or group contains this text (stability, scaling, evidence; of accuracy only: default)
    #[arg(long, value_name = "TEXT")]
    pub(crate) only: Option<String>,
    /// Cores to use [default: all]
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u16).range(1..=256))]
    pub(crate) threads: Option<u16>,
}

impl StudyArgs {
    /// Cores to use.
    pub(crate) fn threads(&self) -> usize {
        super::threads(self.threads)
    }
}

/// The studies.
#[derive(Debug, Clone, Copy, PartialEq, Eq, clap::ValueEnum)]
pub(crate) enum StudyKind {
    /// Error against run time, part by part
    Accuracy,
    /// Stiff and extreme cases: each converges or is named
    Stability,
    /// Cost of a step by grid, symmetry, threads and regime
    Scaling,
    /// Published tables and experiments beside what is found here; each row is a scene: asperity run evidence/NAME
    Evidence,
}
