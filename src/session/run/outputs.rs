//! The outputs of a run: how often each gets a frame, whether it is switched on, what became of it.

use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};

use asperity_engine::observe::{ObserveError, Observer, ObserverReport, RunContext, RunEvent};
use asperity_engine::sim::Frame;

/// Turns a watcher on and off from another thread. What it does not see is not computed differently: a
/// switch never changes the run.
#[derive(Debug, Clone)]
pub struct Switch(Arc<AtomicBool>);

impl Default for Switch {
    fn default() -> Self {
        Self(Arc::new(AtomicBool::new(true)))
    }
}

impl Switch {
    /// Whether frames go to the watcher.
    pub fn is_on(&self) -> bool {
        self.0.load(Ordering::Relaxed)
    }

    /// Turns it round and says whether it is on now.
    pub fn toggle(&self) -> bool {
        !self.0.fetch_xor(true, Ordering::Relaxed)
    }
}

/// Whether a watcher takes frames.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum Activity {
    /// It does.
    #[default]
    On,
    /// It is switched off.
    Off,
    /// It failed.
    Failed,
}

/// A watcher seen from outside.
#[derive(Debug, Clone, PartialEq, Eq, Default)]
pub struct WatcherStatus {
    /// Name of the output.
    pub output: String,
    /// Whether it takes frames.
    pub activity: Activity,
    /// Frames that it kept, or, where it does not say, that were handed to it.
    pub frames: u64,
    /// Frames that it could not keep up with, so far.
    pub skipped: u64,
}

/// An observer with its cadence and switch.
pub struct Watcher {
    observer: Box<dyn Observer>,
    every_steps: u64,
    switch: Switch,
    status: WatcherStatus,
}

impl std::fmt::Debug for Watcher {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.debug_struct("Watcher")
            .field("every_steps", &self.every_steps)
            .field("status", &self.status)
            .finish_non_exhaustive()
    }
}

impl Watcher {
    /// An observer named `output` in messages that gets every `every_steps`-th frame.
    pub fn new(output: impl Into<String>, observer: Box<dyn Observer>, every_steps: u64) -> Self {
        Self {
            observer,
            every_steps: every_steps.max(1),
            switch: Switch::default(),
            status: WatcherStatus {
                output: output.into(),
                ..WatcherStatus::default()
            },
        }
    }

    /// Its switch.
    pub fn switch(&self) -> Switch {
        self.switch.clone()
    }

    fn status(&self) -> WatcherStatus {
        let mut status = self.status.clone();
        status.skipped = self.observer.skipped();
        status.frames = self.observer.kept().unwrap_or(status.frames);
        if status.activity != Activity::Failed && !self.switch.is_on() {
            status.activity = Activity::Off;
        }
        status
    }

    /// Hands it a frame that is due, unless it is switched off.
    fn frame(&mut self, frame: &Arc<Frame>) -> Result<(), ObserveError> {
        if !frame.step.is_multiple_of(self.every_steps) || !self.switch.is_on() {
            return Ok(());
        }
        self.status.frames += 1;
        self.observer.frame(frame)
    }

    fn has_failed(&self) -> bool {
        self.status.activity == Activity::Failed
    }
}

/// All outputs of a run, and what went wrong with them.
#[derive(Debug)]
pub(super) struct Outputs {
    watchers: Vec<Watcher>,
    pub(super) errors: Vec<ObserveError>,
}

impl Outputs {
    pub(super) fn new(watchers: Vec<Watcher>) -> Self {
        Self {
            watchers,
            errors: Vec::new(),
        }
    }

    pub(super) fn begin(&mut self, context: &RunContext) {
        self.each(|watcher| watcher.observer.begin(context));
    }

    pub(super) fn frame(&mut self, frame: &Arc<Frame>) {
        self.each(|watcher| watcher.frame(frame));
    }

    pub(super) fn event(&mut self, event: &RunEvent) {
        self.each(|watcher| watcher.observer.event(event));
    }

    /// Calls all that have not failed.
    fn each(&mut self, call: impl Fn(&mut Watcher) -> Result<(), ObserveError>) {
        for watcher in self.watchers.iter_mut().filter(|w| !w.has_failed()) {
            if let Err(error) = call(watcher) {
                watcher.status.activity = Activity::Failed;
                self.errors.push(error);
            }
        }
    }

    pub(super) fn statuses(&self) -> impl Iterator<Item = WatcherStatus> {
        self.watchers.iter().map(Watcher::status)
    }

    /// Closes all of them.
    pub(super) fn finish(&mut self) -> Vec<ObserverReport> {
        let mut reports = Vec::new();
        for watcher in &mut self.watchers {
            match watcher.observer.finish() {
                Ok(report) => reports.push(report),
                // It has said so already.
                Err(_) if watcher.has_failed() => {}
                Err(error) => self.errors.push(error),
            }
        }
        reports
    }
}
