//! What watches a run. An observer gets every frame that the run hands out and never slows the
//! solver beyond what its queue says.

use std::sync::{Arc, Mutex};

use thiserror::Error;

use crate::scene::Scene;
use crate::sim::Frame;

/// What an observer is told before the first frame.
#[derive(Debug, Clone)]
pub struct RunContext {
    /// The scene that runs.
    pub scene: Arc<Scene>,
    /// The scene as TOML, with what was set on the command line.
    pub scene_toml: String,
    /// The plan as text.
    pub plan_text: String,
    /// Program name and version.
    pub program: String,
}

/// Something that happened between frames.
#[derive(Debug, Clone)]
pub struct RunEvent {
    /// Time step before which it happened.
    pub step: u64,
    /// Simulated time, s.
    pub time_s: f64,
    /// What.
    pub kind: RunEventKind,
}

/// Kinds of event.
#[derive(Debug, Clone)]
pub enum RunEventKind {
    /// A knob was set: scene key and SI value.
    Set {
        /// Scene key.
        key: String,
        /// SI value.
        value: f64,
    },
    /// A caption of a scripted scene.
    Caption(String),
    /// A step that did not converge.
    NotConverged {
        /// Residual.
        residual: f64,
    },
}

/// An output that failed.
#[derive(Debug, Error)]
#[error("{output}: {reason}")]
pub struct ObserveError {
    /// Which output (a path).
    pub output: String,
    /// What went wrong and what to do about it.
    pub reason: String,
}

/// What an observer did.
#[derive(Debug, Clone, Default)]
pub struct ObserverReport {
    /// Which output (a path or a name).
    pub output: String,
    /// Frames written.
    pub frames: u64,
    /// Frames skipped because the observer could not keep up.
    pub skipped: u64,
    /// Bytes written, where known.
    pub bytes: u64,
}

/// Watches a run. Called on the simulation's thread (wrap in a queue what may block).
pub trait Observer: Send {
    /// Before the first frame.
    ///
    /// # Errors
    /// When the output cannot be opened.
    fn begin(&mut self, context: &RunContext) -> Result<(), ObserveError>;
    /// One frame.
    ///
    /// # Errors
    /// When the output failed.
    fn frame(&mut self, frame: &Arc<Frame>) -> Result<(), ObserveError>;
    /// Something that happened between frames.
    ///
    /// # Errors
    /// When the output failed.
    fn event(&mut self, event: &RunEvent) -> Result<(), ObserveError>;
    /// After the last frame: flush and close.
    ///
    /// # Errors
    /// When the output could not be completed.
    fn finish(&mut self) -> Result<ObserverReport, ObserveError>;
}

/// One slot that holds the newest frame: a slow reader skips frames and never delays the run.
#[derive(Debug, Default, Clone)]
pub struct Latest {
    slot: Arc<Mutex<Option<Arc<Frame>>>>,
}

impl Latest {
    /// Puts a frame, replacing one that nobody took.
    pub fn put(&self, frame: Arc<Frame>) {
        if let Ok(mut slot) = self.slot.lock() {
            *slot = Some(frame);
        }
    }

    /// Takes the newest frame, if there is one that was not taken yet.
    pub fn take(&self) -> Option<Arc<Frame>> {
        self.slot.lock().ok().and_then(|mut slot| slot.take())
    }
}
