//! What is asked for when a run is started.

use std::sync::Arc;

use super::outputs::Watcher;
use asperity_engine::observe::{Began, RunContext};
use asperity_engine::plan::Plan;
use asperity_engine::scene::Scene;

/// What to run.
#[derive(Debug)]
pub struct Request {
    /// Preset or file, for the summary.
    pub name: String,
    /// The scene.
    pub scene: Arc<Scene>,
    /// Its plan.
    pub plan: Plan,
    /// Worker threads of the solver.
    pub threads: usize,
    /// Outputs.
    pub watchers: Vec<Watcher>,
    /// When to end.
    pub ending: Ending,
}

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

impl Request {
    /// What outputs are told before the first frame.
    pub(super) fn context(&self, began: Began) -> RunContext {
        RunContext {
            scene_toml: self.scene.to_toml(),
            plan_text: self.plan.to_string(),
            program: crate::program::PROGRAM.to_owned(),
            began,
            scene: Arc::clone(&self.scene),
        }
    }
}
