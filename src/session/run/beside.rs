//! Lives of scenes beside the one that was run, on the coarsest mesh that carries its waves: what a choice that nobody can
//! make does to a life, as a ratio of two runs on one mesh.

use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};

use super::crew::share_out;
use super::ladder::Ladder;
use asperity_engine::plan::Plan;
use asperity_engine::scene::Scene;
use asperity_engine::sim::Simulation;

/// The scene of the run on that mesh.
pub(super) fn coarsest(scene: &Arc<Scene>, plan: &Plan) -> Scene {
    (*Ladder::of(scene, plan).meshes()[0].scene).clone()
}

/// Their lives; `None`: not all of them get through, or somebody said stop.
pub(super) fn lives(scenes: &[Scene], threads: usize, stop: &AtomicBool) -> Option<Vec<f64>> {
    let lives = share_out(scenes, threads, |scene| life(scene, stop), &mut |_, _| {});
    lives.into_iter().collect()
}

fn life(scene: &Scene, stop: &AtomicBool) -> Option<f64> {
    let mut sim = Simulation::new(scene, Plan::new(scene).ok()?, 1).ok()?;
    while !sim.is_done() {
        sim.step().ok()?;
        if stop.load(Ordering::Relaxed) {
            return None;
        }
    }
    sim.summary().life_relative
}
