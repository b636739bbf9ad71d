//! The loop on a ladder of meshes: one simulation after the other, each going on from where the one below was launched.
//!
//! ```text
//! Passages   each mesh makes the passages of the scene                      up when they are done, or a life of waves has settled
//! live       each mesh goes on until its life has settled                   up; a knob that is turned: down to the first
//! ```
//! The last mesh does the same in both, so a live run whose knobs nobody turns gives the frames of a run by itself. After a
//! turn each mesh goes on from where the one below has settled. The first mesh of a live run is kept: it answers within a
//! second.

use std::sync::Arc;

use super::driver::{Driver, Leg, script_of};
use super::errors::{life_error, set_errors};
use super::ladder::{Ladder, Mesh};
use super::outcome::End;
use super::request::Ending;
use asperity_engine::scene::{ErrorSource, Scene};
use asperity_engine::sim::{LifeEstimate, Rung, SimError, Simulation, Stage, Stats, Summary};

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
        let made = if self.climb.nodes == 0 {
            self.first_mesh(ladder)
        } else {
            make(&self.context.scene)
        };
        let mut sim = match made {
            Ok(sim) => sim,
            Err(error) => return (End::NotStarted(error), None),
        };
        loop {
            let leg = sim.inside(|sim| self.drive(sim));
            sim = match self.change(ladder, sim, leg) {
                Ok(sim) => sim,
                Err(ended) => return *ended,
            };
        }
    }

    /// The simulation that goes on after a mesh.
    ///
    /// # Errors
    /// When none does: how the run ended, and where.
    pub(super) fn change(
        &mut self,
        ladder: &Ladder,
        sim: Simulation,
        leg: Leg,
    ) -> Result<Simulation, Box<(End, Option<Simulation>)>> {
        let next = match leg {
            Leg::Up => self.up(ladder, sim),
            Leg::Down => self.down(ladder, sim),
            Leg::Ended(End::Stalled(error)) => match self.not_by_this_way(ladder, &sim) {
                Some(other) => other,
                None => return Err(Box::new((End::Stalled(error), Some(sim)))),
            },
            Leg::Ended(end) => return Err(Box::new((end, Some(sim)))),
        };
        next.map_err(|error| Box::new((End::NotStarted(error), None)))
    }

    pub(super) fn first_mesh(&mut self, ladder: &Ladder) -> Result<Simulation, SimError> {
        self.begin_mesh(ladder, &ladder.meshes()[0], Stats::default())
    }

    /// A mesh stalled: its own start-up where it was climbed to, else that of the next; `None`: nothing is left to try.
    fn not_by_this_way(
        &mut self,
        ladder: &Ladder,
        sim: &Simulation,
    ) -> Option<Result<Simulation, SimError>> {
        let (mesh, finer) = ladder.mesh(self.climb.nodes)?;
        // The start-up of the mesh alone may find what the way from the coarser one did not.
        let climbed = self.climb.below.take().is_some() && !has_begun(sim);
        let mesh = if climbed { mesh } else { finer? };
        self.climb.launch = None;
        Some(self.begin_mesh(ladder, mesh, *sim.stats()))
    }

    /// The next finer mesh goes on.
    fn up(&mut self, ladder: &Ladder, sim: Simulation) -> Result<Simulation, SimError> {
        let nodes = self.climb.nodes;
        let Some((mesh, Some(finer))) = ladder.mesh(nodes) else {
            return Ok(sim);
        };
        self.finish_mesh(&sim, mesh);
        if self.climb.launch.is_none() && has_begun(&sim) {
            self.climb.launch = Some(sim.save());
        }
        let next = self.begin_mesh(ladder, finer, *sim.stats())?;
        let is_first = nodes == ladder.meshes()[0].plan.domain.nodes;
        if is_first && self.ending != Ending::Passages {
            self.ground = Some(sim);
        }
        Ok(next)
    }

    /// The first mesh goes on, with what was turned.
    fn down(&mut self, ladder: &Ladder, sim: Simulation) -> Result<Simulation, SimError> {
        self.leave_top(&sim);
        let stats = *sim.stats();
        let mut ground = self.ground.take().unwrap_or(sim);
        ground.count_from(stats)?;
        self.climb.nodes = ladder.meshes()[0].plan.domain.nodes;
        (self.climb.launch, self.climb.below) = (None, None);
        self.climb.widest = 0.0;
        self.climb.rungs.clear();
        self.publish_rungs();
        for command in std::mem::take(&mut self.pending) {
            self.carry_out(&mut ground, command);
        }
        Ok(ground)
    }

    fn begin_mesh(
        &mut self,
        ladder: &Ladder,
        mesh: &Mesh,
        stats: Stats,
    ) -> Result<Simulation, SimError> {
        (self.climb.nodes, self.climb.widest) = (mesh.plan.domain.nodes, 0.0);
        if self.ending == Ending::Passages {
            self.restart_script(script_of(&mesh.scene, 0));
        }
        self.begin_gathering();
        let lower = self.climb.launch.take();
        let mut sim = ladder.simulation(mesh, lower.as_ref(), self.threads)?;
        sim.count_from(stats)?;
        let governs = self.climb.below.as_ref().and_then(|below| below.life_body);
        sim.expect_governing(governs.unwrap_or(0));
        Ok(sim)
    }

    /// Keeps where the passage began, on a mesh that is not the last.
    pub(super) fn keep_launch(&mut self, sim: &Simulation) {
        if sim.is_launched() && !self.is_on_top() {
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
            set_errors(summary, below, &mesh.scene, &mesh.plan);
        }
    }

    /// Gives a life the band that the mesh below says: of a settled one the widest so far, as a mean that moves within its
    /// period comes near the other mesh's now and then, and is no surer for it.
    pub(super) fn widen(&mut self, life: &mut LifeEstimate) {
        let is_asked = self.context.scene.numerics.error_estimate == ErrorSource::Companion;
        let below = self.climb.below.as_ref().filter(|_| is_asked);
        let ladder = self.ladder.as_ref();
        let mesh = ladder.and_then(|ladder| ladder.mesh(self.climb.nodes));
        if let (Some(below), Some((mesh, _))) = (below.and_then(|one| one.life_relative), mesh) {
            let error = life_error(life.life_relative, below, &mesh.scene, &mesh.plan);
            if error.is_finite() {
                let mut error = error;
                if life.settled {
                    error = error.max(self.climb.widest);
                    self.climb.widest = error;
                }
                error += life.detail.unsettled;
                life.life_relative_low = life.life_relative * (-error).exp();
                life.life_relative_high = life.life_relative * error.exp();
            }
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
pub(super) fn ladder_of(
    scene: &Arc<Scene>,
    plan: &asperity_engine::plan::Plan,
) -> Option<Arc<Ladder>> {
    let ladder = Ladder::of(scene, plan);
    ladder.climbs().then(|| Arc::new(ladder))
}
