//! The loop on a ladder of meshes: one simulation after the other, each going on from where the one below was launched.

use std::sync::Arc;

use super::driver::{Driver, script_of};
use super::errors::set_errors;
use super::ladder::{Ladder, Mesh};
use super::outcome::End;
use asperity_engine::scene::{ErrorSource, Scene};
use asperity_engine::sim::{Rung, SimError, Simulation, Stage, Stats, Summary};

impl Driver {
    /// Whether the run is on the scene's own mesh.
    pub(super) fn is_on_top(&self) -> bool {
        let ladder = self.ladder.as_ref();
        ladder.is_none_or(|ladder| ladder.top() == self.climb.nodes)
    }

    /// One mesh after the other; `make` gives the simulation of a run that is taken up in the middle.
    pub(super) fn go_up(
        &mut self,
        ladder: &Ladder,
        make: impl FnOnce(&Scene) -> Result<Simulation, SimError>,
    ) -> (End, Option<Simulation>) {
        let mut saved = (self.climb.nodes != 0).then_some(make);
        let mut stats = Stats::default();
        let (meshes, from) = (ladder.meshes().iter(), self.climb.nodes);
        for mesh in meshes.skip_while(|mesh| mesh.plan.domain.nodes < from) {
            let made = match saved.take() {
                Some(make) => make(&self.context.scene),
                None => self.begin_mesh(ladder, mesh, stats),
            };
            let mut sim = match made {
                Ok(sim) => sim,
                Err(error) => return (End::NotStarted(error), None),
            };
            let mut end = sim.inside(|sim| self.drive(sim));
            if matches!(end, End::Stalled(_)) && self.climb.below.is_some() && !has_begun(&sim) {
                // The start-up of the mesh alone may find what the way from the coarser one did not.
                (self.climb.launch, self.climb.below) = (None, None);
                let cold = self.begin_mesh(ladder, mesh, *sim.stats());
                if let Ok(cold) = cold {
                    sim = cold;
                    end = sim.inside(|sim| self.drive(sim));
                }
            }
            stats = *sim.stats();
            match end {
                End::Done if !self.is_on_top() => self.finish_mesh(&sim, mesh),
                End::Stalled(_) if !self.is_on_top() => {
                    (self.climb.launch, self.climb.below) = (None, None);
                }
                end => return (end, Some(sim)),
            }
        }
        (End::Done, None)
    }

    fn begin_mesh(
        &mut self,
        ladder: &Ladder,
        mesh: &Mesh,
        stats: Stats,
    ) -> Result<Simulation, SimError> {
        self.climb.nodes = mesh.plan.domain.nodes;
        self.restart_script(script_of(&mesh.scene, 0));
        let lower = self.climb.launch.take();
        let mut sim = ladder.simulation(mesh, lower.as_ref(), self.threads)?;
        sim.count_from(stats)?;
        Ok(sim)
    }

    /// Keeps where the passage began, on a mesh that is not the last.
    pub(super) fn keep_launch(&mut self, sim: &Simulation) {
        if self.climb.launch.is_none() && !self.is_on_top() && has_begun(sim) {
            self.climb.launch = Some(sim.save());
        }
    }

    fn finish_mesh(&mut self, sim: &Simulation, mesh: &Mesh) {
        let mut summary = sim.summary();
        self.compare(&mut summary, mesh);
        self.push_rung(&summary);
        self.climb.below = Some(summary);
    }

    /// The errors by what the mesh below came to.
    fn compare(&self, summary: &mut Summary, mesh: &Mesh) {
        let is_asked = mesh.scene.numerics.error_estimate == ErrorSource::Companion;
        if let Some(below) = self.climb.below.as_ref().filter(|_| is_asked) {
            set_errors(summary, below, &mesh.plan);
        }
    }

    fn push_rung(&mut self, summary: &Summary) {
        let rung = Rung {
            nodes: self.climb.nodes,
            life_relative: summary.life_relative,
            life_relative_low: summary.life_relative_low,
            life_relative_high: summary.life_relative_high,
            seconds: self.started.elapsed_s(),
        };
        self.climb.rungs.push(rung);
        self.publish_rungs();
    }

    /// What the ladder adds to the summary of the last mesh.
    pub(super) fn sum_up(&mut self, summary: &mut Summary, end: &End) {
        let Some(ladder) = self.ladder.clone().filter(|ladder| ladder.climbs()) else {
            return;
        };
        if let (End::Done, Some(mesh)) = (end, ladder.meshes().last()) {
            self.compare(summary, mesh);
            self.push_rung(summary);
        }
        summary.rungs.clone_from(&self.climb.rungs);
        let lives = |rung: &&Rung| rung.life_relative.is_some();
        summary.first_life_s = summary.rungs.iter().find(lives).map(|rung| rung.seconds);
    }
}

fn has_begun(sim: &Simulation) -> bool {
    sim.stage() == Stage::Passage
}

/// The ladder of a run that goes by itself.
pub(super) fn ladder_of(scene: &Arc<Scene>, plan: &asperity_engine::plan::Plan) -> Option<Arc<Ladder>> {
    let ladder = Ladder::of(scene, plan);
    ladder.climbs().then(|| Arc::new(ladder))
}
