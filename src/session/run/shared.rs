//! What the simulation's thread and the session that watches it share.

use std::sync::{Arc, Mutex, MutexGuard, PoisonError};

use super::settled::Settled;
use super::watcher::WatcherStatus;
use asperity_engine::sim::Stage;

/// When a session ends by itself.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Ending {
    /// After the passages that the scene asks for, or when an output fails.
    Passages,
    /// After so many steps of the passage, or when an output fails.
    Steps(u64),
    /// Never: only when told to stop (the explorer). An output that fails is reported and left out.
    OnStop,
}

/// Where a session is.
#[derive(Debug, Clone, Default)]
pub struct Status {
    /// Part of the run.
    pub stage: Stage,
    /// How much is done, 0 to 1.
    pub progress: f64,
    /// Time steps after the start-up.
    pub steps: u64,
    /// Steps that did not converge.
    pub n_unconverged: u64,
    /// Outputs.
    pub outputs: Vec<WatcherStatus>,
    /// What went wrong, once the run has ended by a failure.
    pub failure: Option<String>,
}

#[derive(Debug, Default)]
pub(super) struct SharedStatus {
    pub(super) status: Status,
    pub(super) settled: Option<Arc<Settled>>,
}

pub(super) fn lock(shared: &Mutex<SharedStatus>) -> MutexGuard<'_, SharedStatus> {
    // Every write leaves the value whole, so a panic elsewhere does not spoil it.
    shared.lock().unwrap_or_else(PoisonError::into_inner)
}
