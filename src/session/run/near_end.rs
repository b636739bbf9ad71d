//! The near end of a run, for who commands and watches it.

use std::sync::mpsc::{Sender, channel};
use std::sync::{Arc, Mutex};

use super::Command;
use super::driver::Driver;
use super::request::Request;
use super::settled::Settled;
use super::shared::{SharedStatus, Status, lock};
use crate::Latest;

/// Where commands go in and what is known of a run comes out.
#[derive(Debug, Clone)]
pub struct NearEnd {
    commands: Sender<Command>,
    latest: Latest,
    shared: Arc<Mutex<SharedStatus>>,
}

/// A loop that has not begun, and its near end.
pub(super) fn wired(request: Request) -> (Driver, NearEnd) {
    let (commands, inbox) = channel();
    let latest = Latest::default();
    let shared = Arc::new(Mutex::new(SharedStatus::default()));
    let driver = Driver::new(
        request.ending,
        request.watchers,
        &request.scene.events,
        inbox,
        latest.clone(),
        Arc::clone(&shared),
    )
    .planned(request.plan.steps);
    let near = NearEnd {
        commands,
        latest,
        shared,
    };
    (driver, near)
}

impl NearEnd {
    /// Asks for something. A session that has ended hears nothing, which is no error.
    pub fn send(&self, command: Command) {
        let _ = self.commands.send(command);
    }

    /// A sender for others (a signal handler, a screen).
    pub fn commands(&self) -> Sender<Command> {
        self.commands.clone()
    }

    /// The newest frame.
    pub fn latest(&self) -> Latest {
        self.latest.clone()
    }

    /// Where the run is.
    pub fn status(&self) -> Status {
        lock(&self.shared).status.clone()
    }

    /// A way to ask for the status from elsewhere, once the session itself is given away.
    pub fn status_reader(&self) -> impl Fn() -> Status + Send + 'static {
        let shared = Arc::clone(&self.shared);
        move || lock(&shared).status.clone()
    }

    /// A way to ask, from elsewhere, for the period of a passage that repeats: filled in live sessions
    /// ([`Ending::OnStop`]), emptied when a knob is turned.
    pub fn settled_reader(&self) -> impl Fn() -> Option<Arc<Settled>> + Send + 'static {
        let shared = Arc::clone(&self.shared);
        move || lock(&shared).settled.clone()
    }
}
