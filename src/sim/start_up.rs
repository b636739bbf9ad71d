//! From Hertz to the developed rough contact.

use super::fitness::climb;
use super::setup::{COARSEST, grid_of};
use super::simulation::{DEVELOP, Phase, Simulation};
use super::{Knob, MeshErrors, StepError};

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
        if nx < self.plan.domain.nodes {
            let next = 2 * (nx - 1) + 1;
            self.state.coarser = Some(self.measure());
            let grid = grid_of(&self.plan, next, self.door.b_over_a);
            self.state.contact = self.state.contact.refined(&self.work.solver.grid, &grid);
            self.state.nodes = next;
            self.solve_on(next);
            self.state.phase = Phase::Smooth {
                left: self.smooth_steps(next, self.plan.has_flow()),
            };
            return self.step_within();
        }
        let measured = self.measure();
        self.state.mesh_errors = self.state.coarser.map(|coarser| MeshErrors {
            h_central: off(coarser.h_central, measured.h_central),
            h_min: off(coarser.h_min, measured.h_min),
            p_max: off(coarser.p_max, measured.p_max) + self.stress_error,
        });
        let base = self.regime.base();
        if let (Some(stress), Some(life)) = (&mut self.work.stress, &mut self.state.life) {
            let (p, q) = (&self.state.contact.pressure, &self.work.traction);
            self.pool.install(|| {
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
                .aim(knob, self.state.wanted.get(knob).target);
        }
        let developing = self.work.terrain.is_rough(0)
            || self.work.terrain.is_rough(1)
            || self.state.wanted.get(Knob::SlideRoll).target != 0.0;
        let left = if developing {
            self.steps_of(DEVELOP)
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
        self.state.stats.steps -= 1;
        self.step()
    }

    fn steps_of(&self, time: f64) -> u64 {
        (time / (self.stepping.usual() * self.work.solver.grid.dx)).ceil() as u64
    }

    /// Smooth steps on a grid of `nodes` per side: the first grid is flushed from inlet to outlet, the
    /// finer ones lose the error of interpolation. Without flow one solve is enough.
    pub(super) fn smooth_steps(&self, nodes: usize, flows: bool) -> u64 {
        if !flows {
            return 2;
        }
        let length = self.plan.domain.x_max_a - self.plan.domain.x_min_a;
        let share = if nodes == COARSEST.min(self.plan.domain.nodes) {
            1.0
        } else {
            0.75
        };
        let dx = length / (nodes - 1) as f64;
        (share * length / (self.stepping.usual() * dx)).ceil() as u64
    }

    /// Way of both bodies, in a, in the smooth part of the start-up.
    pub(super) fn smooth_way(&self) -> f64 {
        let length = self.plan.domain.x_max_a - self.plan.domain.x_min_a;
        climb(&self.plan)
            .map(|nodes| {
                let dx = length / (nodes - 1) as f64;
                self.smooth_steps(nodes, self.plan.has_flow()) as f64 * self.stepping.usual() * dx
            })
            .sum()
    }

    pub(super) fn all_start_up_steps(&self) -> u64 {
        let smooth: u64 = climb(&self.plan)
            .map(|nodes| self.smooth_steps(nodes, self.plan.has_flow()))
            .sum();
        let dx = self.plan.domain.dx_a();
        smooth + (DEVELOP / (self.stepping.usual() * dx)).ceil() as u64
    }
}
