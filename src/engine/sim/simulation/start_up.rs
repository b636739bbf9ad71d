//! From Hertz to the developed rough contact.

use super::Simulation;
use crate::sim::sim_plan::DEVELOP;
use crate::sim::state::Phase;
use crate::sim::{Knob, MeshErrors, StepError};

/// What a coarser grid's value is off a finer one's; all of it, where that is nothing: bodies that touch.
fn off(coarser: f64, finer: f64) -> f64 {
    if finer > 0.0 {
        (coarser / finer - 1.0).abs()
    } else {
        1.0
    }
}

impl Simulation {
    /// The next finer grid, or the reference and the development.
    pub(super) fn refine_or_develop(&mut self) -> Result<(), StepError> {
        let nx = self.work.solver.grid.nx;
        if nx < self.plan.decided.domain.nodes {
            let next = 2 * (nx - 1) + 1;
            self.state.coarser = Some(self.measure());
            let grid = self.plan.grid(next);
            self.state.contact = self.state.contact.refined(&self.work.solver.grid, &grid);
            self.state.nodes = next;
            self.work.solve_on(&self.plan, next);
            self.state.phase = Phase::Smooth {
                left: self.plan.smooth_steps(next, self.plan.decided.has_flow()),
            };
            return self.step_within();
        }
        let measured = self.measure();
        self.state.mesh_errors = self.state.coarser.map(|coarser| MeshErrors {
            h_central: off(coarser.h_central, measured.h_central),
            h_min: off(coarser.h_min, measured.h_min),
            p_max: off(coarser.p_max, measured.p_max) + self.plan.stress_error([1.0; 2]),
        });
        let base = self.plan.base();
        if let (Some(stress), Some(life)) = (&mut self.work.stress, &mut self.state.life) {
            let (p, q) = (&self.state.contact.pressure, &self.work.traction);
            self.work.pool.install(|| {
                stress.slice(p, q, 0.0);
                life.set_reference(stress, base);
                if let Some(counting) = &mut self.state.counting {
                    counting.set_reference(stress, 1.0);
                }
            });
        }
        for knob in Knob::ALL {
            self.state
                .drive
                .aim(knob, self.state.targets.get(knob).target);
        }
        let developing = self.develops();
        let left = if developing {
            self.plan.steps_of(DEVELOP)
        } else {
            0
        };
        self.state.motion.flush();
        if developing {
            self.state.motion.disturb(DEVELOP);
        }
        self.state.phase = Phase::Develop { left };
        self.step_within()
    }

    fn step_within(&mut self) -> Result<(), StepError> {
        self.stats.steps -= 1;
        self.step()
    }

    /// Whether sliding or roughness come up after the smooth contact.
    pub(super) fn develops(&self) -> bool {
        let is_rough = |body| self.work.roughness.is_rough(body);
        let sliding = self.state.targets.get(Knob::SlideRoll).target;
        is_rough(0) || is_rough(1) || sliding != 0.0
    }
}
