//! What a restart needs. Everything else of a [`Simulation`] is scratch or follows from the scene.
//!
//! ```text
//! Simulation = scene, plan (given again) + State (saved) + workspace (made again, or measured again)
//! ```
//! A run that goes on from a saved state equals the uninterrupted one bit for bit, in every field of
//! every frame (`tests/restart.rs`). Both directions take the structures apart field by field, so that a
//! new field must be sorted as state or as workspace before this compiles.

use serde::{Deserialize, Serialize};

use super::counting::Counting;
use super::drive::Drive;
use super::fatigue_stage::LifeStage;
use super::measure::Measured;
use super::motion::Motion;
use super::orbit::Orbit;
use super::pace::Pace;
use super::setup::{COARSEST, grid_of};
use super::simulation::{Phase, Simulation};
use super::smooth::{self, Smooth};
use super::stepping::place_surfaces;
use super::stress_stage::StressStage;
use super::totals::Totals;
use super::{MeshErrors, Metrics, SimError, Stats};
use crate::solve::march::{self, March};

/// State of a simulation; opaque, made by [`Simulation::save`].
#[derive(Debug, Clone, Serialize, Deserialize)]
pub struct State {
    /// Nodes per side of the grid that the contact is on: the start-up climbs through several.
    nodes: usize,
    contact: march::State,
    drive: Drive,
    wanted: Drive,
    motion: Motion,
    watched: [f64; 2],
    counting: Option<Counting>,
    life: Option<LifeStage>,
    smooth: Option<smooth::State>,
    phase: Phase,
    metrics: Metrics,
    stats: Stats,
    totals: Totals,
    coarser: Option<Measured>,
    mesh_errors: Option<MeshErrors>,
    orbit: Orbit,
    pace: Pace,
    way: f64,
    next_volume: f64,
    step: u64,
    time_s: f64,
    start_up_steps: (u64, u64),
}

/// What a neighbour leaves to the run that follows it.
pub(super) struct HandedOver {
    /// Its contact on the finest grid.
    pub(super) march: March,
    /// Its knobs.
    pub(super) drive: Drive,
    /// Ways of both bodies, in a.
    pub(super) travelled: [f64; 2],
}

impl State {
    /// Time steps since the start-up.
    pub fn passage_steps(&self) -> u64 {
        self.step
    }
}

impl Simulation {
    /// What a restart needs, as it is between two steps.
    pub fn save(&self) -> State {
        let Self {
            plan: _,
            door: _,
            march,
            terrain: _,
            drive,
            motion,
            watched,
            stress: _,
            cuts: _,
            iso_load_ratio: _,
            traction: _,
            row_sums: _,
            counting,
            life,
            smooth,
            stress_error: _,
            law: _,
            shape: _,
            flow: _,
            regime: _,
            pool: _,
            phase,
            wanted,
            metrics,
            stats,
            totals,
            coarser,
            mesh_errors,
            grounds: _,
            composite: _,
            stepping: _,
            orbit,
            pace,
            way,
            next_volume,
            step,
            time_s,
            start_up_steps,
        } = self;
        State {
            nodes: march.grid.nx,
            contact: march.state.clone(),
            drive: drive.clone(),
            wanted: wanted.clone(),
            motion: motion.clone(),
            watched: *watched,
            counting: counting.clone(),
            life: life.clone(),
            smooth: smooth.as_deref().map(Smooth::save),
            phase: *phase,
            metrics: metrics.clone(),
            stats: *stats,
            totals: totals.clone(),
            coarser: *coarser,
            mesh_errors: *mesh_errors,
            orbit: orbit.clone(),
            pace: *pace,
            way: *way,
            next_volume: *next_volume,
            step: *step,
            time_s: *time_s,
            start_up_steps: *start_up_steps,
        }
    }

    /// Goes on from `state`, saved by a simulation of the same scene.
    ///
    /// # Errors
    /// [`SimError::State`] when the state does not fit the scene; the simulation is as it was.
    pub fn restore(&mut self, state: State) -> Result<(), SimError> {
        self.check(&state)?;
        let State {
            nodes,
            contact,
            drive,
            wanted,
            motion,
            watched,
            counting,
            life,
            smooth,
            phase,
            metrics,
            stats,
            totals,
            coarser,
            mesh_errors,
            orbit,
            pace,
            way,
            next_volume,
            step,
            time_s,
            start_up_steps,
        } = state;
        if nodes != self.march.grid.nx {
            let grid = grid_of(&self.plan, nodes, self.door.b_over_a);
            self.march = self
                .pool
                .install(|| March::from_hertz(grid, &self.shape, 0.0, motion.nodes, self.flow));
        }
        self.march.state = contact;
        (self.drive, self.wanted, self.motion) = (drive, wanted, motion);
        (self.counting, self.life) = (counting, life);
        self.watched = watched;
        self.phase = phase;
        (self.metrics, self.stats) = (metrics, stats);
        self.totals.take(totals);
        if let Some(counting) = &mut self.counting {
            counting.make_room();
        }
        if let Some(life) = &mut self.life {
            life.make_room();
        }
        (self.coarser, self.mesh_errors) = (coarser, mesh_errors);
        self.orbit = orbit;
        (self.pace, self.way, self.next_volume) = (pace, way, next_volume);
        (self.step, self.time_s) = (step, time_s);
        self.start_up_steps = start_up_steps;
        self.restore_smooth(smooth);
        self.see_again();
        Ok(())
    }

    /// What a neighbour hands over to [`Simulation::follow`]; its reference is taken over at once.
    ///
    /// # Errors
    /// As [`Simulation::restore`].
    pub(super) fn handed_over(&mut self, neighbour: &State) -> Result<HandedOver, SimError> {
        self.check(neighbour)?;
        let State {
            nodes,
            contact,
            drive,
            wanted: _,
            motion,
            watched: _,
            counting,
            life,
            smooth: _,
            phase,
            metrics: _,
            stats: _,
            totals: _,
            coarser,
            mesh_errors,
            orbit: _,
            pace: _,
            way: _,
            next_volume: _,
            step: _,
            time_s: _,
            start_up_steps: _,
        } = neighbour;
        if *nodes != self.plan.domain.nodes || *phase != Phase::Passage {
            let early = "its passage has not begun".to_owned();
            return Err(SimError::State(early));
        }
        let grid = grid_of(&self.plan, *nodes, self.door.b_over_a);
        let mut march = self
            .pool
            .install(|| March::from_hertz(grid, &self.shape, 0.0, motion.nodes, self.flow));
        march.state = contact.clone();
        if let (Some(own), Some(other)) = (&mut self.life, life) {
            own.take_base(other, self.regime.base());
        }
        if let (Some(own), Some(other)) = (&mut self.counting, counting) {
            own.take_reference(other);
        }
        (self.coarser, self.mesh_errors) = (*coarser, *mesh_errors);
        Ok(HandedOver {
            march,
            drive: drive.clone(),
            travelled: motion.travelled,
        })
    }

    /// Roughness, traction and slice of the restored step, which follow from the state.
    pub(super) fn see_again(&mut self) {
        place_surfaces(
            &mut self.march,
            &mut self.terrain,
            &self.drive,
            &self.motion,
            &self.door,
        );
        self.slice_again();
    }

    /// The slices below the run's own contact.
    pub(super) fn slice_again(&mut self) {
        let measured = self.measure();
        let on_fine = self.march.grid.nx == self.plan.domain.nodes;
        if on_fine && self.stage_has_stress() {
            let (p, q) = (&self.march.state.pressure, &self.traction);
            if let Some(stress) = &mut self.stress {
                self.pool.install(|| stress.slice(p, q, measured.friction));
            }
        }
    }

    /// A state comes from a file, and a file may come from anywhere.
    fn check(&self, state: &State) -> Result<(), SimError> {
        let refuse = |what: &str| Err(SimError::State(what.to_owned()));
        let finest = self.plan.domain.nodes;
        let first = COARSEST.min(finest);
        let climbs = std::iter::successors(Some(first), |n| Some(2 * (n - 1) + 1));
        if !climbs
            .take_while(|n| *n <= finest)
            .any(|n| n == state.nodes)
        {
            return refuse("its grid is none of this scene's");
        }
        let len = grid_of(&self.plan, state.nodes, self.door.b_over_a).len();
        if !state.contact.fits(len) {
            return refuse("its fields do not fill the grid");
        }
        let fine = grid_of(&self.plan, finest, self.door.b_over_a);
        if !state.orbit.fits(fine.len()) {
            return refuse("its orbit is spoiled");
        }
        let depths = self.stress.as_ref().map_or(0, StressStage::depth_count);
        if state
            .counting
            .as_ref()
            .is_some_and(|c| !c.fits(&fine, depths))
        {
            return refuse("its counts are spoiled");
        }
        if state.counting.is_some() != self.counting.is_some()
            || state.life.is_some() != self.life.is_some()
        {
            return refuse("it was saved with other stages for stress and life");
        }
        if let Some(smooth) = &state.smooth
            && !smooth.fits(&self.plan, self.door.b_over_a)
        {
            return refuse("its smooth contact does not fill a grid");
        }
        if let (Some(own), Some(saved)) = (&self.life, &state.life)
            && !own.fits(saved)
        {
            return refuse("its life is of another make");
        }
        Ok(())
    }
}
