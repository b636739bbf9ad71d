//! What is asked for when a run is started.

use std::sync::Arc;

use super::shared::Ending;
use super::watcher::Watcher;
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

/// What outputs are told before the first frame.
pub(super) fn context_of(request: &Request, began: Began) -> RunContext {
    RunContext {
        scene_toml: request.scene.to_toml(),
        plan_text: request.plan.to_string(),
        program: crate::program::PROGRAM.to_owned(),
        began,
        scene: Arc::clone(&request.scene),
    }
}
