//! How a run is commanded and watched from outside of its loop.

use std::sync::mpsc::{Receiver, Sender, channel};
use std::sync::{Arc, Mutex, MutexGuard, PoisonError, Weak};

use super::command::Command;
use super::outputs::WatcherStatus;
use super::settled::Settled;
use crate::Latest;
use asperity_engine::sim::{Rung, Stage};

/// Where a session is.
#[derive(Debug, Clone, Default)]
pub struct Status {
    /// Part of the run.
    pub stage: Stage,
    /// How much is done, 0 to 1.
    pub progress: f64,
    /// Nodes per side of the mesh that it is on; 0: it has none but the scene's.
    pub nodes: usize,
    /// The meshes that are done, where it climbs several.
    pub rungs: Vec<Rung>,
    /// Whether it climbs several.
    pub climbs: bool,
    /// The finer mesh that is under way, nodes per side, and how much of it is done, 0 to 1; `None`: on the first, or nothing
    /// more is to be found on the last.
    pub finer: Option<(usize, f64)>,
    /// Time steps after the start-up, on the scene's own mesh.
    pub steps: u64,
    /// Steps that did not converge.
    pub n_unconverged: u64,
    /// Outputs.
    pub outputs: Vec<WatcherStatus>,
    /// What went wrong, once the run has ended by a failure.
    pub failure: Option<String>,
}

/// What the loop shares with who watches it.
#[derive(Debug, Default)]
pub(super) struct SharedStatus {
    pub(super) status: Status,
    pub(super) settled: Option<Arc<Settled>>,
    /// Who asks the run to wait.
    held: Weak<()>,
}

impl SharedStatus {
    pub(super) fn is_held(&self) -> bool {
        self.held.strong_count() > 0
    }
}

/// As long as it, or a copy, is there, the run waits before the third mesh that it climbs to, and before all after it.
#[derive(Debug, Clone)]
pub struct Hold {
    _held: Arc<()>,
}

/// Where commands go in and what is known of a run comes out.
#[derive(Debug, Clone)]
pub struct RunHandle {
    commands: Sender<Command>,
    latest: Latest,
    shared: Arc<Mutex<SharedStatus>>,
}

/// The loop's side of a handle.
pub(super) struct RunLink {
    pub(super) inbox: Receiver<Command>,
    pub(super) latest: Latest,
    shared: Arc<Mutex<SharedStatus>>,
}

fn lock(shared: &Mutex<SharedStatus>) -> MutexGuard<'_, SharedStatus> {
    // Every write leaves the value whole, so a panic elsewhere does not spoil it.
    shared.lock().unwrap_or_else(PoisonError::into_inner)
}

/// Both sides of a run that has not begun.
pub(super) fn wired() -> (RunHandle, RunLink) {
    let (commands, inbox) = channel();
    let latest = Latest::default();
    let shared = Arc::new(Mutex::new(SharedStatus::default()));
    let handle = RunHandle {
        commands,
        latest: latest.clone(),
        shared: Arc::clone(&shared),
    };
    let end = RunLink {
        inbox,
        latest,
        shared,
    };
    (handle, end)
}

impl RunLink {
    pub(super) fn lock(&self) -> MutexGuard<'_, SharedStatus> {
        lock(&self.shared)
    }
}

impl RunHandle {
    /// Asks for something. A session that has ended hears nothing, which is no error.
    pub fn send(&self, command: Command) {
        let _ = self.commands.send(command);
    }

    /// A sender for others (a signal handler, a screen).
    pub fn commands(&self) -> Sender<Command> {
        self.commands.clone()
    }

    /// Asks for the cores for something shorter than a fine mesh; a knob that is turned is obeyed all the same.
    pub fn hold(&self) -> Hold {
        let mut shared = lock(&self.shared);
        let held = shared.held.upgrade().unwrap_or_default();
        shared.held = Arc::downgrade(&held);
        Hold { _held: held }
    }

    /// The newest frame.
    pub fn latest(&self) -> Latest {
        self.latest.clone()
    }

    /// Where the run is.
    pub fn status(&self) -> Status {
        lock(&self.shared).status.clone()
    }

    /// The period of a passage that repeats: there in live sessions ([`super::Ending::OnStop`]), gone when a knob is
    /// turned.
    pub fn settled(&self) -> Option<Arc<Settled>> {
        lock(&self.shared).settled.clone()
    }
}
