//! Whether a saved state fits a simulation: a state comes from a file, and a file may come from anywhere.
//!
//! Checked before anything of it is used: that every field is as long as this scene's, that what follows from the scene
//! is what it says (so that no size is taken from the file), and that values lie where a run can bring them. Numbers
//! are finite already: the file's format has no others.

use super::Simulation;
use crate::sim::smooth::LoadAndSpeed;
use crate::sim::state::Phase;
use crate::sim::stress_stage::StressStage;
use crate::sim::{Knob, SimError, State, Stats};

/// Steps that no run makes.
const MOST_STEPS: u64 = 1 << 52;
/// Steps, in units of this scene's start-up, that settling in a neighbour's wake never takes.
const LONGEST_SETTLING: u64 = 1000;

fn refuse(what: &str) -> SimError {
    SimError::State(what.to_owned())
}

fn demand(holds: bool, what: &str) -> Result<(), SimError> {
    if holds { Ok(()) } else { Err(refuse(what)) }
}

impl Simulation {
    /// Whether the state is one of this scene's contact: its fields, its stages.
    pub(super) fn check(&self, state: &State) -> Result<(), SimError> {
        demand(
            self.plan.climb().any(|n| n == state.nodes),
            "its grid is not this scene's",
        )?;
        let grid = |nodes| self.plan.grid(nodes);
        let unlike = self.work.solver.is_unlike();
        demand(
            state.contact.fits(grid(state.nodes).len(), unlike),
            "its fields do not fill the grid",
        )?;
        demand(state.contact.is_sound(), "its pressures are below zero")?;
        if let Some(smooth) = &state.smooth {
            let known = self.plan.climb().any(|n| n == smooth.nodes);
            demand(
                known && smooth.fits(grid(smooth.nodes).len(), unlike),
                "its smooth contact does not fill a grid",
            )?;
        }
        demand(
            state.orbit.fits(self.plan.finest().len()),
            "its repeating period is damaged",
        )?;
        demand(
            state.counting.is_some() == self.state.counting.is_some()
                && state.life.is_some() == self.state.life.is_some(),
            "it was saved with other settings for stress and life",
        )?;
        let depths = self
            .work
            .stress
            .as_ref()
            .map_or(0, StressStage::depth_count);
        let yielded_fits = match (&self.state.yielded, &state.yielded) {
            (None, None) => true,
            (Some(own), Some(saved)) => own.fits(saved),
            _ => false,
        };
        demand(yielded_fits, "its yielded surfaces belong to other bodies")?;
        if let (Some(own), Some(saved)) = (&self.state.counting, &state.counting) {
            demand(own.fits(saved, depths), "its cycle counts are damaged")?;
        }
        if let (Some(own), Some(saved)) = (&self.state.life, &state.life) {
            demand(own.fits(saved), "its life was computed in another way")?;
        }
        Ok(())
    }

    /// Whether a run can have counted so much.
    pub(super) fn check_stats(stats: &Stats) -> Result<(), SimError> {
        let counted = stats.all().into_iter().all(|n| n <= MOST_STEPS);
        demand(counted, "its work counters are not valid")
    }

    /// Whether a run of this scene can have come there.
    pub(super) fn check_course(&self, state: &State) -> Result<(), SimError> {
        let start_up = self.plan.start_up_steps().max(1);
        let on_finest = state.nodes == self.plan.decided.domain.nodes;
        let phase_fits = match state.phase {
            Phase::Smooth { left } => {
                left <= self
                    .plan
                    .smooth_steps(state.nodes, self.plan.decided.has_flow())
            }
            Phase::Settle { coarse, fine } => {
                on_finest && coarse.max(fine) <= LONGEST_SETTLING * start_up
            }
            Phase::Develop { left } => on_finest && left <= start_up,
            Phase::Passage => on_finest,
        };
        demand(phase_fits, "its start-up is not this scene's")?;
        let steps = [state.step, state.start_up_steps.0, state.start_up_steps.1];
        demand(
            steps.into_iter().all(|n| n <= MOST_STEPS)
                && state.distance >= 0.0
                && state.time_s >= 0.0,
            "its steps or times are not valid",
        )?;
        demand(
            state.motion.is_sound() && state.pace.is_sound(),
            "its motion does not fit the scene",
        )?;
        let smooth = state.smooth.as_ref();
        demand(
            smooth.is_none_or(|smooth| {
                smooth.left <= self.plan.smooth_steps(smooth.nodes, true) && self.can_be(smooth.at)
            }),
            "its smooth contact is not this scene's",
        )?;
        for drive in [&state.drive, &state.targets]
            .into_iter()
            .chain(smooth.map(|smooth| &smooth.drive))
        {
            for knob in Knob::ALL {
                let (own, saved) = (self.state.drive.get(knob), drive.get(knob));
                let both = [saved.now, saved.target];
                demand(
                    own.rate == saved.rate && both.into_iter().all(|v| self.can_stand_at(knob, v)),
                    &format!("{} is out of its range", knob.key()),
                )?;
            }
        }
        Ok(())
    }

    fn can_be(&self, at: LoadAndSpeed) -> bool {
        self.can_stand_at(self.plan.scaling.load_knob(), at.load)
            && self.can_stand_at(Knob::EntrainmentMS, at.speed_m_s)
    }

    /// Whether a knob can stand there, on its way too.
    fn can_stand_at(&self, knob: Knob, value: f64) -> bool {
        match knob {
            Knob::SlideRoll => knob.takes(value),
            Knob::ForceN | Knob::ForceNPerM => {
                let most = self.plan.decided.maximum_force_n() * (1.0 + 1e-9);
                value > 0.0 && (knob != self.plan.scaling.load_knob() || value <= most)
            }
            Knob::Amplitude1M => value >= 0.0 && (value == 0.0 || self.work.roughness.is_rough(0)),
            Knob::Amplitude2M => value >= 0.0 && (value == 0.0 || self.work.roughness.is_rough(1)),
            Knob::EntrainmentMS => value > 0.0,
        }
    }
}
