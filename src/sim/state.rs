//! What a restart needs. Everything else of a [`Simulation`] is scratch or follows from the scene.
//!
//! ```text
//! Simulation = scene, plan (given again) + State (saved) + Work (made again, or measured again)
//! ```
//! [`Simulation::save`] is a copy of the state, [`Simulation::restore`] an assignment after a check. A run that goes on
//! from a saved state equals the uninterrupted one bit for bit, in every field of every frame, even when its workspace is
//! thrown away before every step (`tests/records/restart.rs`).

use serde::{Deserialize, Serialize};

use super::counting::Counting;
use super::drive::Drive;
use super::fatigue_stage::LifeStage;
use super::measure::{Measured, RowSums};
use super::motion::Motion;
use super::orbit::Orbit;
use super::pace::Pace;
use super::setup::grid_of;
use super::simulation::{Phase, Simulation};
use super::smooth::{Smooth, SmoothWork};
use super::stepping::place_surfaces;
use super::stress_stage::StressStage;
use super::terrain::Terrain;
use super::totals::Totals;
use super::yielded::Yielded;
use super::{MeshErrors, Metrics, SimError, Stats};
use crate::solve::march::{self, Solver};

/// State of a simulation; opaque, made by [`Simulation::save`].
#[derive(Debug, Clone, Serialize, Deserialize)]
pub struct State {
    /// Nodes per side of the grid that the contact is on: the start-up climbs through several.
    pub(super) nodes: usize,
    pub(super) contact: march::State,
    pub(super) drive: Drive,
    /// The knobs as they were asked for; in the smooth start-up the drive does not follow yet.
    pub(super) wanted: Drive,
    pub(super) motion: Motion,
    /// What both bodies have yielded; `None`: they are elastic.
    #[serde(default)]
    pub(super) yielded: Option<Yielded>,
    /// Where both bodies were when they were looked at last, in a.
    pub(super) watched: [f64; 2],
    pub(super) counting: Option<Counting>,
    pub(super) life: Option<LifeStage>,
    /// On its way to the reference of now; `None`: that is known.
    pub(super) smooth: Option<Smooth>,
    pub(super) phase: Phase,
    pub(super) metrics: Metrics,
    pub(super) stats: Stats,
    pub(super) totals: Totals,
    /// The smooth contact on the last but one grid.
    pub(super) coarser: Option<Measured>,
    /// Errors by the mesh of the smooth contact at the scene's speed and load.
    pub(super) mesh_errors: Option<MeshErrors>,
    pub(super) orbit: Orbit,
    pub(super) pace: Pace,
    /// Way at U since the start-up, in a.
    pub(super) way: f64,
    /// Way at which the next volume integral is due, in a.
    pub(super) next_volume: f64,
    pub(super) step: u64,
    pub(super) time_s: f64,
    /// Steps of the start-up: made, and in all.
    pub(super) start_up_steps: (u64, u64),
}

/// What may be dropped between two steps.
pub(super) struct Work {
    pub(super) solver: Solver,
    pub(super) terrain: Terrain,
    pub(super) stress: Option<StressStage>,
    pub(super) traction: Vec<f64>,
    pub(super) row_sums: Vec<RowSums>,
    pub(super) smooth: Option<SmoothWork>,
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
        self.state.clone()
    }

    /// Goes on from `state`, saved by a simulation of the same scene.
    ///
    /// # Errors
    /// [`SimError::State`] when the state does not fit the scene; the simulation is as it was.
    pub fn restore(&mut self, state: State) -> Result<(), SimError> {
        self.check(&state)?;
        self.check_course(&state)?;
        self.solve_on(state.nodes);
        self.state = state;
        self.make_room();
        self.see_again();
        Ok(())
    }

    /// Makes the solver for a grid of so many nodes per side, if it is for another one.
    pub(super) fn solve_on(&mut self, nodes: usize) {
        if nodes != self.work.solver.grid.nx {
            let grid = grid_of(&self.plan, nodes, self.door.b_over_a);
            let usual = self.stepping.usual();
            let (shape, flow) = (&self.shape, self.flow);
            self.work.solver = self.pool.install(|| Solver::new(grid, shape, usual, flow));
        }
    }

    /// Makes the room again that a copy or a file does not keep: a warm step allocates nothing.
    pub(super) fn make_room(&mut self) {
        let state = &mut self.state;
        state.totals.make_room(self.most_steps);
        if let Some(counting) = &mut state.counting {
            counting.make_room();
        }
        if let Some(life) = &mut state.life {
            life.make_room();
        }
        if !matches!(state.phase, Phase::Smooth { .. }) {
            self.work.solver.yield_at(self.hardness);
        }
    }

    /// Takes over what a neighbour leaves to [`Simulation::follow`]: its contact and its references.
    ///
    /// # Errors
    /// As [`Simulation::restore`].
    pub(super) fn take_over(&mut self, neighbour: &State) -> Result<(), SimError> {
        self.check(neighbour)?;
        if neighbour.nodes != self.plan.domain.nodes || neighbour.phase != Phase::Passage {
            let early = "its passage has not begun".to_owned();
            return Err(SimError::State(early));
        }
        self.solve_on(neighbour.nodes);
        let state = &mut self.state;
        state.nodes = neighbour.nodes;
        state.contact.clone_from(&neighbour.contact);
        if let (Some(own), Some(other)) = (&mut state.life, &neighbour.life) {
            own.take_base(other, self.regime.base());
        }
        if let (Some(own), Some(other)) = (&mut state.counting, &neighbour.counting) {
            own.take_reference(other);
        }
        (state.coarser, state.mesh_errors) = (neighbour.coarser, neighbour.mesh_errors);
        state.motion.travelled = neighbour.motion.travelled;
        Ok(())
    }

    /// Roughness, traction and slice of the restored step, which follow from the state.
    pub(super) fn see_again(&mut self) {
        place_surfaces(
            &mut self.work.solver,
            &mut self.work.terrain,
            &self.state.drive,
            &self.state.motion,
            &self.door,
            self.state.yielded.as_ref(),
        );
        self.slice_again();
    }

    /// The slices below the run's own contact.
    pub(super) fn slice_again(&mut self) {
        let measured = self.measure();
        let on_fine = self.state.nodes == self.plan.domain.nodes;
        if on_fine && self.stage_has_stress() {
            let (p, q) = (&self.state.contact.pressure, &self.work.traction);
            if let Some(stress) = &mut self.work.stress {
                self.pool.install(|| stress.slice(p, q, measured.friction));
            }
        }
    }
}
