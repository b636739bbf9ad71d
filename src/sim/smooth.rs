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
use super::pace::Stepping;
use super::setup::{COARSEST, grid_of};
use super::simulation::Simulation;
use super::stepping::Mover;
use super::terrain::Terrain;
use super::{Knob, StepError};
use crate::scene::Surface;
use crate::solve::march::{Solver, State};

/// Load (N, of a line N/m) and entrainment speed (m/s).
#[derive(Debug, Clone, Copy, PartialEq, Default, Serialize, Deserialize)]
pub(super) struct Conditions {
    pub(super) load: f64,
    pub(super) speed_m_s: f64,
}

/// A smooth contact on its way to rest: state.
#[derive(Debug, Clone, Serialize, Deserialize)]
pub(super) struct Smooth {
    /// Nodes per side of its grid.
    pub(super) nodes: usize,
    contact: State,
    pub(super) drive: Drive,
    motion: Motion,
    pub(super) at: Conditions,
    /// Steps to go on this grid.
    pub(super) left: u64,
}

/// What solves it: workspace.
pub(super) struct SmoothWork {
    solver: Solver,
    terrain: Terrain,
}

impl Smooth {
    /// Whether its fields have `len` nodes; `unlike`: with deflection by traction.
    pub(super) fn fits(&self, len: usize, unlike: bool) -> bool {
        self.contact.fits(len, unlike) && self.contact.is_sound()
    }
}

impl Simulation {
    /// Load and speed that the knobs go to.
    fn conditions(&self) -> Conditions {
        let target = |knob| self.state.drive.get(knob).target;
        Conditions {
            load: target(self.door.load_knob()),
            speed_m_s: target(Knob::EntrainmentMS),
        }
    }

    /// Whether the reference is that of the load and speed that the knobs go to.
    pub(super) fn has_reference_of_now(&self) -> bool {
        let life = self.state.life.as_ref();
        life.is_none_or(|life| life.reference_at == self.conditions())
    }

    /// One step of the smooth contact, where the reference is another one's.
    ///
    /// # Errors
    /// [`StepError`] as of the run's own steps.
    pub(super) fn step_smooth(&mut self) -> Result<(), StepError> {
        let mut smooth = match self.state.smooth.take() {
            Some(smooth) => smooth,
            None if self.has_reference_of_now() => return Ok(()),
            None => self.begin_smooth(self.conditions()),
        };
        if smooth.left == 0 {
            if smooth.nodes == self.plan.domain.nodes {
                self.work.smooth = None;
                self.take_smooth(&smooth);
                return Ok(());
            }
            self.refine_smooth(&mut smooth);
        }
        self.advance_smooth(&mut smooth)?;
        smooth.left -= 1;
        self.state.smooth = Some(smooth);
        Ok(())
    }

    /// A Hertz contact of that load on the coarsest grid.
    fn begin_smooth(&mut self, at: Conditions) -> Smooth {
        let nodes = COARSEST.min(self.plan.domain.nodes);
        let size = self.door.size_ratio(at.load / self.plan.force_n);
        let film = self.regime.film_at(at);
        let central = film.map_or(0.0, |film| self.door.h_from_m(film.central_m));
        let mut drive = self.state.wanted.clone();
        for knob in Knob::OF_ROUGHNESS_AND_SLIDING {
            drive.jump(knob, 0.0);
        }
        drive.jump(self.door.load_knob(), at.load);
        drive.jump(Knob::EntrainmentMS, at.speed_m_s);
        let mut work = self.smooth_work(nodes);
        let hertz = || work.solver.hertz_of_size(&self.shape, (size, central));
        let contact = self.pool.install(hertz);
        self.work.smooth = Some(work);
        Smooth {
            nodes,
            contact,
            drive,
            motion: Motion::new(),
            at,
            left: self.smooth_steps(nodes, self.flows_at(at)),
        }
    }

    fn flows_at(&self, at: Conditions) -> bool {
        self.regime.film_at(at).is_some_and(|film| film.flows())
    }

    /// The solver for a grid of so many nodes per side, made where there is none.
    fn smooth_work(&mut self, nodes: usize) -> SmoothWork {
        let there = self.work.smooth.take();
        if let Some(work) = there.filter(|work| work.solver.grid.nx == nodes) {
            return work;
        }
        let grid = grid_of(&self.plan, nodes, self.door.b_over_a);
        let smooth = Surface::Smooth {};
        let terrain = Terrain::new(&grid, [&smooth, &smooth], self.door.a_m, self.door.heading);
        let usual = self.stepping.usual();
        let (shape, flow) = (&self.shape, self.flow);
        let solver = self.pool.install(|| Solver::new(grid, shape, usual, flow));
        SmoothWork { solver, terrain }
    }

    fn refine_smooth(&self, smooth: &mut Smooth) {
        let grid = |nodes| grid_of(&self.plan, nodes, self.door.b_over_a);
        let next = 2 * (smooth.nodes - 1) + 1;
        smooth.contact = smooth.contact.refined(&grid(smooth.nodes), &grid(next));
        smooth.nodes = next;
        smooth.left = self.smooth_steps(next, self.flows_at(smooth.at));
    }

    fn advance_smooth(&mut self, smooth: &mut Smooth) -> Result<(), StepError> {
        let mut work = self.smooth_work(smooth.nodes);
        let usual = self.stepping.usual();
        let before = work.solver.transforms();
        let attempted = self.pool.install(|| {
            Mover {
                state: &mut smooth.contact,
                solver: &mut work.solver,
                terrain: &mut work.terrain,
                drive: &mut smooth.drive,
                motion: &mut smooth.motion,
                door: &self.door,
                law: &self.law,
                regime: self.regime,
                stepping: Stepping::Fixed(usual),
                yielding: None,
            }
            .advance(usual)
        });
        let made = work.solver.transforms() - before;
        self.work.smooth = Some(work);
        self.state.stats.add(&attempted, made);
        attempted.fatal(self.state.time_s).map_or(Ok(()), Err)
    }

    /// Its integrals become the reference of now; the slices below the run's own contact are made again.
    fn take_smooth(&mut self, smooth: &Smooth) {
        let size = self.door.size_ratio(smooth.at.load / self.plan.force_n);
        let state = &mut self.state;
        if let (Some(stress), Some(life)) = (&mut self.work.stress, &mut state.life) {
            self.pool.install(|| {
                stress.slice(&smooth.contact.pressure, &[], 0.0);
                life.move_reference(stress, size, smooth.at);
                state.stats.stress_volumes += u64::from(life.integrates());
                if let Some(counting) = &mut state.counting {
                    counting.set_reference(stress, size);
                }
            });
        }
        self.slice_again();
    }
}
