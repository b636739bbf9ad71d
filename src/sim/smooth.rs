//! The smooth, frictionless contact at S = 0 beside a run whose knobs have left the load or the speed of its reference.
//!
//! ```text
//! knobs' targets ≠ load, speed of the reference  ──>  Hertz there, on 65²  ──>  steady  ──>  next grid  ──> ... ──>
//! its integrals are the reference of now; one step of it a step of the run
//! ```
//! It is the start-up's own way to the reference (`start_up.rs`), at the load and speed that the knobs go to: what a run
//! that begins there has, on this run's grid. A run whose load and speed stay as they are makes none of these steps. Until
//! it is done the last reference grows as Hertz contacts do (`reference.rs`), which is 0.7 % of the integral off between
//! 800 and 2376 N of the default scene, but 4 % for five times its speed, whose film is no small part of the contact any
//! more (129²; `asperity run demonstration` with smooth bodies, S = 0 and `load.force_n` or `motion.entrainment_m_s` set).
//! Knobs that turn all the time (a ride along a gear tooth) have the reference of where they were going when it began.

use serde::{Deserialize, Serialize};

use super::drive::Drive;
use super::motion::Motion;
use super::setup::{COARSEST, grid_of};
use super::simulation::Simulation;
use super::stepping::Mover;
use super::terrain::Terrain;
use super::{Knob, StepError};
use crate::math::grid::Grid;
use crate::plan::Plan;
use crate::scene::Surface;
use crate::solve::march::{self, March};

/// Load (N, of a line N/m) and entrainment speed (m/s).
#[derive(Debug, Clone, Copy, PartialEq, Default, Serialize, Deserialize)]
pub(super) struct Conditions {
    pub(super) load: f64,
    pub(super) speed_m_s: f64,
}

/// A smooth contact on its way to rest.
pub(super) struct Smooth {
    march: March,
    terrain: Terrain,
    drive: Drive,
    motion: Motion,
    at: Conditions,
    left: u64,
}

/// What a restart needs of it.
#[derive(Debug, Clone, Serialize, Deserialize)]
pub(super) struct State {
    nodes: usize,
    contact: march::State,
    drive: Drive,
    motion: Motion,
    at: Conditions,
    left: u64,
}

impl State {
    /// Whether its fields are those of one of the plan's grids.
    pub(super) fn fits(&self, plan: &Plan, b_over_a: f64) -> bool {
        let finest = plan.domain.nodes;
        let grids = std::iter::successors(Some(COARSEST.min(finest)), |n| Some(2 * (n - 1) + 1));
        let known = grids.take_while(|n| *n <= finest).any(|n| n == self.nodes);
        known && self.contact.fits(grid_of(plan, self.nodes, b_over_a).len())
    }
}

impl Smooth {
    fn on(march: March, sim: &Simulation, at: Conditions, left: u64) -> Self {
        let mut drive = sim.wanted.clone();
        for knob in [Knob::SlideRoll, Knob::Amplitude1M, Knob::Amplitude2M] {
            drive.jump(knob, 0.0);
        }
        drive.jump(sim.door.load_knob(), at.load);
        drive.jump(Knob::EntrainmentMS, at.speed_m_s);
        Self {
            terrain: smooth_terrain(&march.grid, sim),
            march,
            drive,
            motion: Motion::new(sim.motion.nodes),
            at,
            left,
        }
    }

    /// What a restart needs.
    pub(super) fn save(&self) -> State {
        State {
            nodes: self.march.grid.nx,
            contact: self.march.state.clone(),
            drive: self.drive.clone(),
            motion: self.motion.clone(),
            at: self.at,
            left: self.left,
        }
    }
}

fn smooth_terrain(grid: &Grid, sim: &Simulation) -> Terrain {
    let smooth = Surface::Smooth {};
    Terrain::new(grid, [&smooth, &smooth], sim.door.a_m, sim.door.heading)
}

impl Simulation {
    /// Load and speed that the knobs go to.
    fn conditions(&self) -> Conditions {
        Conditions {
            load: self.drive.get(self.door.load_knob()).target,
            speed_m_s: self.drive.get(Knob::EntrainmentMS).target,
        }
    }

    /// Load and speed that the scene begins with.
    pub(super) fn base(&self) -> Conditions {
        self.regime.base()
    }

    /// Whether the reference is that of the load and speed that the knobs go to.
    pub(super) fn has_reference_of_now(&self) -> bool {
        self.life
            .as_ref()
            .is_none_or(|life| life.reference_at == self.conditions())
    }

    /// One step of the smooth contact, where the reference is another one's.
    ///
    /// # Errors
    /// [`StepError`] as of the run's own steps.
    pub(super) fn step_smooth(&mut self) -> Result<(), StepError> {
        let mut smooth = match self.smooth.take() {
            Some(smooth) => smooth,
            None if self.has_reference_of_now() => return Ok(()),
            None => Box::new(self.begin_smooth(self.conditions())),
        };
        if smooth.left == 0 {
            let nx = smooth.march.grid.nx;
            if nx == self.plan.domain.nodes {
                self.take_smooth(&smooth);
                return Ok(());
            }
            self.refine_smooth(&mut smooth, 2 * (nx - 1) + 1);
        }
        self.advance_smooth(&mut smooth)?;
        smooth.left -= 1;
        self.smooth = Some(smooth);
        Ok(())
    }

    fn flows_at(&self, at: Conditions) -> bool {
        self.regime.film_at(at).is_some_and(|film| film.flows())
    }

    /// A Hertz contact of that load on the coarsest grid.
    fn begin_smooth(&self, at: Conditions) -> Smooth {
        let nodes = COARSEST.min(self.plan.domain.nodes);
        let grid = grid_of(&self.plan, nodes, self.door.b_over_a);
        let load = at.load / self.plan.force_n;
        let size = self.door.size_ratio(load);
        let film = self.regime.film_at(at);
        let central = film.map_or(0.0, |film| self.door.h_from_m(film.central_m));
        let march = self.pool.install(|| {
            March::from_hertz_of_size(
                grid,
                &self.shape,
                (size, central),
                self.motion.nodes,
                self.flow,
            )
        });
        let left = self.smooth_steps(nodes, self.flows_at(at));
        Smooth::on(march, self, at, left)
    }

    fn refine_smooth(&self, smooth: &mut Smooth, nodes: usize) {
        let grid = grid_of(&self.plan, nodes, self.door.b_over_a);
        let usual = self.motion.nodes;
        smooth.march = self
            .pool
            .install(|| March::refined(&smooth.march, grid, &self.shape, usual, self.flow));
        smooth.terrain = smooth_terrain(&smooth.march.grid, self);
        smooth.left = self.smooth_steps(nodes, self.flows_at(smooth.at));
    }

    fn advance_smooth(&mut self, smooth: &mut Smooth) -> Result<(), StepError> {
        let mut law = self.law;
        law.direction = 0.0;
        let usual = self.motion.nodes;
        let attempted = self.pool.install(|| {
            Mover {
                march: &mut smooth.march,
                terrain: &mut smooth.terrain,
                drive: &mut smooth.drive,
                motion: &mut smooth.motion,
                door: &self.door,
                law,
                regime: self.regime,
                stepping: super::pace::Stepping::Fixed(usual),
            }
            .advance(usual)
        });
        self.count(&attempted);
        let tolerance = self.regime.tolerance(smooth.march.flow).pressure;
        attempted.fatal(self.time_s, tolerance).map_or(Ok(()), Err)
    }

    /// Its integrals become the reference of now; the slices below the run's own contact are made again.
    fn take_smooth(&mut self, smooth: &Smooth) {
        let size = self.door.size_ratio(smooth.at.load / self.plan.force_n);
        if let (Some(stress), Some(life)) = (&mut self.stress, &mut self.life) {
            self.pool.install(|| {
                stress.slice(&smooth.march.state.pressure, &[], 0.0);
                life.move_reference(stress, size, smooth.at);
                self.stats.stress_volumes += u64::from(life.integrates());
                if let Some(counting) = &mut self.counting {
                    counting.set_reference(stress, size);
                }
            });
        }
        if self.stage_has_stress() {
            self.slice_again();
        }
    }

    /// Goes on with a saved one.
    pub(super) fn restore_smooth(&mut self, saved: Option<State>) {
        self.smooth = saved.map(|saved| {
            let grid = grid_of(&self.plan, saved.nodes, self.door.b_over_a);
            let mut march = self.pool.install(|| {
                March::from_hertz(grid, &self.shape, 0.0, self.motion.nodes, self.flow)
            });
            march.state = saved.contact;
            let mut smooth = Smooth::on(march, self, saved.at, saved.left);
            (smooth.drive, smooth.motion) = (saved.drive, saved.motion);
            Box::new(smooth)
        });
    }
}
