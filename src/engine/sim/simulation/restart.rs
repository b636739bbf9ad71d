//! Saving and restoring the state, and the workspace thrown away between.

use std::sync::Arc;

use super::Simulation;
use crate::saved::Saved as _;
use crate::sim::measure::Measured;
use crate::sim::state::Phase;
use crate::sim::stepping::place_surfaces;
use crate::sim::work::Work;
use crate::sim::{SimError, State, Stats};

impl Simulation {
    /// What a restart needs, as it is between two steps.
    pub fn save(&self) -> State {
        self.state.clone()
    }

    /// Goes on from `state`, saved by a simulation of the same scene. Work is counted as before
    /// ([`Simulation::count_from`]).
    ///
    /// # Errors
    /// [`SimError::State`] when the state does not fit the scene; the simulation is as it was.
    pub fn restore(&mut self, state: &State) -> Result<(), SimError> {
        self.check(state)?;
        self.check_course(state)?;
        self.state.restore(state);
        self.work.solve_on(&self.plan, self.state.nodes);
        self.see_again();
        Ok(())
    }

    /// Counts on from the work of the run that a restored state is from.
    ///
    /// # Errors
    /// [`SimError::State`] when no run does so much.
    pub fn count_from(&mut self, stats: Stats) -> Result<(), SimError> {
        Self::check_stats(&stats)?;
        self.stats = stats;
        Ok(())
    }

    /// Throws the workspace away and makes it anew, which may be done between any two steps: no result changes by a bit.
    ///
    /// # Errors
    /// As [`Simulation::new`], which has made one like it.
    pub fn renew_work(&mut self) -> Result<(), SimError> {
        let pool = Arc::clone(&self.work.pool);
        self.work = Work::new(&self.plan, self.state.nodes, pool)?;
        self.see_again();
        Ok(())
    }

    /// Takes over what a neighbour leaves to [`Simulation::follow`]: its contact and its references.
    ///
    /// # Errors
    /// As [`Simulation::restore`].
    pub(super) fn take_over(&mut self, neighbour: &State) -> Result<(), SimError> {
        self.check(neighbour)?;
        if neighbour.nodes != self.plan.decided.domain.nodes || neighbour.phase != Phase::Passage {
            let early = "its passage has not begun".to_owned();
            return Err(SimError::State(early));
        }
        self.work.solve_on(&self.plan, neighbour.nodes);
        let state = &mut self.state;
        state.nodes = neighbour.nodes;
        state.contact.clone_from(&neighbour.contact);
        if let (Some(own), Some(other)) = (&mut state.life, &neighbour.life) {
            own.take_base(other, self.plan.base());
        }
        if let (Some(own), Some(other)) = (&mut state.counting, &neighbour.counting) {
            own.take_reference(other);
        }
        (state.coarser, state.mesh_errors) = (neighbour.coarser, neighbour.mesh_errors);
        state.motion.travelled = neighbour.motion.travelled;
        Ok(())
    }

    /// Roughness, traction and slice of the state's step, which follow from it.
    pub(super) fn see_again(&mut self) -> Measured {
        let Work {
            solver, roughness, ..
        } = &mut self.work;
        let state = &self.state;
        if !matches!(state.phase, Phase::Smooth { .. }) {
            solver.yield_at(self.plan.hardness);
        }
        let places = (&state.drive, &state.motion);
        place_surfaces(
            solver,
            roughness,
            &self.plan.scaling,
            places,
            state.yielded.as_ref(),
        );
        self.slice_again()
    }

    /// The slices below the run's own contact.
    pub(super) fn slice_again(&mut self) -> Measured {
        let measured = self.measure();
        let on_fine = self.state.nodes == self.plan.decided.domain.nodes;
        if on_fine && self.stage_has_stress() {
            let (p, q) = (&self.state.contact.pressure, &self.work.traction);
            if let Some(stress) = &mut self.work.stress {
                self.work
                    .pool
                    .install(|| stress.slice(p, q, measured.friction));
            }
        }
        measured
    }
}
