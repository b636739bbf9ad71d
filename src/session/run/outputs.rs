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

    fn begin(&mut self, context: &RunContext) -> Result<(), ObserveError> {
        let begun = self.observer.begin(context);
        self.judge(begun)
    }

    fn frame(&mut self, frame: &Arc<Frame>) -> Result<(), ObserveError> {
        let is_due = frame.step.is_multiple_of(self.every_steps);
        if !is_due || !self.switch.is_on() || self.has_failed() {
            return Ok(());
        }
        self.status.frames += 1;
        let written = self.observer.frame(frame);
        self.judge(written)
    }

    fn event(&mut self, event: &RunEvent) -> Result<(), ObserveError> {
        if self.has_failed() {
            return Ok(());
        }
        let written = self.observer.event(event);
        self.judge(written)
    }

    /// Closes the output; one that failed before has said so already.
    fn finish(&mut self) -> Result<Option<ObserverReport>, ObserveError> {
        let had_failed = self.has_failed();
        match self.observer.finish() {
            Ok(report) => Ok(Some(report)),
            Err(_) if had_failed => Ok(None),
            Err(error) => Err(error),
        }
    }

    fn has_failed(&self) -> bool {
        self.status.activity == Activity::Failed
    }

    fn judge(&mut self, result: Result<(), ObserveError>) -> Result<(), ObserveError> {
        if result.is_err() {
            self.status.activity = Activity::Failed;
        }
        result
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
        self.each(|watcher| watcher.begin(context));
    }

    pub(super) fn frame(&mut self, frame: &Arc<Frame>) {
        self.each(|watcher| watcher.frame(frame));
    }

    pub(super) fn event(&mut self, event: &RunEvent) {
        self.each(|watcher| watcher.event(event));
    }

    fn each(&mut self, call: impl Fn(&mut Watcher) -> Result<(), ObserveError>) {
        for watcher in &mut self.watchers {
            self.errors.extend(call(watcher).err());
        }
    }

    pub(super) fn statuses(&self) -> impl Iterator<Item = WatcherStatus> {
        self.watchers.iter().map(Watcher::status)
    }

    /// Closes all of them.
    pub(super) fn finish(&mut self) -> Vec<ObserverReport> {
        let mut reports = Vec::new();
        for watcher in &mut self.watchers {
            match watcher.finish() {
                Ok(report) => reports.extend(report),
                Err(error) => self.errors.push(error),
            }
        }
        reports
    }
}
