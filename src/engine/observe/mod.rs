//! What watches a run. An observer gets every frame that the run hands out and never slows the
//! solver beyond what its queue says.

mod placed;
mod queue_stats;

use std::sync::Arc;

use serde::{Deserialize, Serialize};
use thiserror::Error;

pub use placed::{Claim, Left, Overwrite, Placed, is_free, leftovers, stopped_of};
pub use queue_stats::QueueStats;

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
    /// What the first step goes on from.
    pub began: Began,
}

/// What a run begins with.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Began {
    /// The scene alone.
    #[default]
    FromScene,
    /// The saved state of another run, which the scene alone does not give back.
    FromState,
}

/// Who turned a knob.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum SetBy {
    /// A command from outside.
    Hand,
    /// The scene's own script.
    Script,
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
        /// By whom.
        by: SetBy,
        /// Steps that the run had made, those of the start-up too: with them the run can be repeated.
        steps_made: u64,
    },
    /// A caption of a scripted scene.
    Caption(String),
    /// A step that did not converge.
    NotConverged {
        /// Residual.
        residual: f64,
    },
    /// The run ends before its time: a file that was to be replaced stays, and what there is lies beside it.
    CutShort,
}

/// An output that failed.
#[derive(Debug, Clone, PartialEq, Eq, Error)]
#[error("{output}: {reason}")]
pub struct ObserveError {
    /// Which output (a path).
    pub output: String,
    /// What went wrong and what to do about it.
    pub reason: String,
}

impl ObserveError {
    /// An error of the output with that name.
    pub fn new(output: impl Into<String>, reason: impl Into<String>) -> Self {
        Self {
            output: output.into(),
            reason: reason.into(),
        }
    }
}

/// Said of a file that no step came for.
pub const NOTHING_CAME: &str = "no step of the finest mesh came, so it was not written";

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
    /// What else is to be said, such as that a viewer was closed.
    pub note: String,
    /// How the queue before it was used, if there was one.
    pub queue: Option<QueueStats>,
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
    /// Frames that it could not keep up with so far.
    fn skipped(&self) -> u64 {
        0
    }
    /// Frames whose pictures it has kept, where that is fewer than it was given.
    fn kept(&self) -> Option<u64> {
        None
    }
    /// Nothing has come for a second (a queue calls it): what is held back may go on.
    ///
    /// # Errors
    /// When the output failed.
    fn idle(&mut self) -> Result<(), ObserveError> {
        Ok(())
    }
    /// After the last frame: flush and close.
    ///
    /// # Errors
    /// When the output could not be completed.
    fn finish(&mut self) -> Result<ObserverReport, ObserveError>;
}
