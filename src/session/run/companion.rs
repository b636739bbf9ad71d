//! The run on half the nodes that gives the error estimate of a run without a ladder ([`super::errors`]), after it.

use std::sync::Arc;

use super::errors::{NoEstimate, coarser, set_errors};
use super::outcome::{End, Outcome};
use super::request::{Ending, Request};
use super::session::Session;
use asperity_engine::plan::Plan;
use asperity_engine::scene::{ErrorSource, Scene};
use asperity_engine::sim::Summary;

/// A companion under way.
#[derive(Debug)]
pub struct Companion {
    /// Its run.
    pub session: Session,
    /// Its nodes per side.
    pub nodes: usize,
    /// Of the run that it goes with.
    scene: Scene,
    plan: Plan,
}

impl Companion {
    /// Starts the companion of a run of `scene` by `plan`.
    ///
    /// # Errors
    /// [`NoEstimate`] says why there is none.
    pub fn start(scene: &Scene, plan: &Plan, threads: usize) -> Result<Self, NoEstimate> {
        if scene.numerics.error_estimate == ErrorSource::None {
            return Err(NoEstimate::NotAsked);
        }
        let mut coarse = coarser(scene, plan)?;
        coarse.numerics.ladder = false;
        let coarse_plan = Plan::new(&coarse)?;
        let nodes = coarse.grid.nodes;
        let session = Session::start(Request {
            name: String::new(),
            scene: Arc::new(coarse),
            plan: coarse_plan,
            threads,
            watchers: Vec::new(),
            ending: Ending::Passages,
        })?;
        Ok(Self {
            session,
            nodes,
            scene: scene.clone(),
            plan: plan.clone(),
        })
    }

    /// Waits for it and writes the errors into the summary of the run; the band of life becomes theirs.
    ///
    /// # Errors
    /// [`NoEstimate`] when the companion did not get through; the summary is as it was.
    pub fn compare(self, summary: &mut Summary) -> Result<Outcome, NoEstimate> {
        let outcome = self.session.join()?;
        let Some(coarse) = outcome
            .summary
            .as_ref()
            .filter(|_| matches!(outcome.end, End::Done))
        else {
            return Err(NoEstimate::Unfinished);
        };
        set_errors(summary, coarse, &self.scene, &self.plan);
        Ok(outcome)
    }
}
