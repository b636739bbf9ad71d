//! The simulation of one scene: start-up from Hertz, development of the rough contact, passage.
//!
//! ```text
//! smooth    S = 0, frictionless, from Hertz on 65², marched to steady, refined to the scene's grid
//! reference the smooth pressure's life integral
//! develop   sliding and roughness ramp up, the contact is flushed once
//! passage   every number counts
//! ```

use std::sync::Arc;

use rayon::ThreadPool;
use serde::{Deserialize, Serialize};

use super::counting::Counting;
use super::door::Door;
use super::drive::Drive;
use super::fatigue_stage::LifeStage;
use super::measure::{Measured, RowSums};
use super::motion::Motion;
use super::orbit::Orbit;
use super::pace::{Pace, Stepping};
use super::regime::Regime;
use super::smooth::Smooth;
use super::stepping::{Attempted, Mover};
use super::stress_stage::StressStage;
use super::terrain::Terrain;
use super::{
    Frame, Grounds, Knob, MeshErrors, Metrics, SimError, Stage, Stats, StepError, Summary,
};
use crate::plan::{March as Marching, Plan};
use crate::solve::march::{Flow, March, Shape};
use crate::solve::stress::Cut;
use crate::solve::traction::TractionLaw;

/// Time (a/U) to ramp sliding and roughness and to flush the contact once; also what a steady contact
/// takes to be steady again after a knob moved.
pub(super) const DEVELOP: f64 = 4.0;

/// Where the run is.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
pub(super) enum Phase {
    /// Smooth, with this many steps to go on the present grid.
    Smooth { left: u64 },
    /// In the wake of a neighbour: this many long steps, then so many of the usual length.
    Settle { coarse: u64, fine: u64 },
    /// Sliding and roughness come up.
    Develop { left: u64 },
    /// The passage.
    Passage,
}

/// The simulation of one scene.
pub struct Simulation {
    pub(super) plan: Plan,
    pub(super) door: Door,
    pub(super) march: March,
    pub(super) terrain: Terrain,
    pub(super) drive: Drive,
    pub(super) motion: Motion,
    pub(super) watched: [f64; 2],
    pub(super) stress: Option<StressStage>,
    pub(super) traction: Vec<f64>,
    pub(super) row_sums: Vec<RowSums>,
    pub(super) counting: Option<Counting>,
    pub(super) cuts: Vec<Cut>,
    pub(super) iso_load_ratio: Option<f64>,
    pub(super) life: Option<LifeStage>,
    /// On its way to the reference of now; `None`: that is known.
    pub(super) smooth: Option<Box<Smooth>>,
    pub(super) stress_error: f64,
    pub(super) law: TractionLaw,
    pub(super) shape: Shape,
    pub(super) flow: Flow,
    pub(super) regime: Regime,
    pub(super) pool: Arc<ThreadPool>,
    pub(super) phase: Phase,
    pub(super) wanted: Drive,
    pub(super) metrics: Metrics,
    pub(super) stats: Stats,
    pub(super) totals: super::totals::Totals,
    /// The smooth contact on the last but one grid.
    pub(super) coarser: Option<Measured>,
    /// Errors by the mesh of the smooth contact at the scene's speed and load.
    pub(super) mesh_errors: Option<MeshErrors>,
    /// What cautions rest on, as far as the scene gives it.
    pub(super) grounds: Grounds,
    pub(super) composite: [f64; 2],
    pub(super) orbit: Orbit,
    pub(super) stepping: Stepping,
    pub(super) pace: Pace,
    /// Way at U since the start-up, in a.
    pub(super) way: f64,
    /// Way at which the next volume integral is due, in a.
    pub(super) next_volume: f64,
    pub(super) step: u64,
    pub(super) time_s: f64,
    pub(super) start_up_steps: (u64, u64),
}

impl Simulation {
    /// One step, of the start-up first and then of the passage.
    ///
    /// # Errors
    /// [`StepError`] when the step failed; nothing of it was kept.
    pub fn step(&mut self) -> Result<(), StepError> {
        self.inside(Self::step_inside)
    }

    /// Does something on a thread of the simulation's pool. Handing work over to a pool takes a wake-up, and room in
    /// its queue now and then: who makes many steps makes them all inside.
    pub fn inside<R: Send>(&mut self, work: impl FnOnce(&mut Self) -> R + Send) -> R {
        let pool = Arc::clone(&self.pool);
        pool.install(|| work(self))
    }

    fn step_inside(&mut self) -> Result<(), StepError> {
        self.stats.steps += 1;
        match self.phase {
            Phase::Smooth { left: 0 } => self.refine_or_develop(),
            Phase::Smooth { left } => {
                self.advance()?;
                self.phase = Phase::Smooth { left: left - 1 };
                self.start_up_steps.0 += 1;
                Ok(())
            }
            Phase::Settle { coarse: 0, fine: 0 } => {
                self.phase = Phase::Develop { left: 0 };
                self.stats.steps -= 1;
                self.step_inside()
            }
            Phase::Settle { coarse, fine } => {
                self.advance()?;
                self.phase = Phase::Settle {
                    coarse: coarse.saturating_sub(1),
                    fine: fine - u64::from(coarse == 0),
                };
                self.start_up_steps.0 += 1;
                Ok(())
            }
            Phase::Develop { left: 0 } => {
                self.phase = Phase::Passage;
                (self.time_s, self.way) = (0.0, 0.0);
                self.motion.launch();
                self.forget_passage();
                self.passage_step()
            }
            Phase::Develop { left } => {
                self.step_smooth()?;
                self.advance()?;
                self.phase = Phase::Develop { left: left - 1 };
                self.start_up_steps.0 += 1;
                Ok(())
            }
            Phase::Passage => self.passage_step(),
        }
    }

    /// Counts and phases seen so far belong to other conditions.
    fn forget_passage(&mut self) {
        self.orbit.restart();
        let window = self.averaged();
        if let Some(life) = &mut self.life {
            life.restart(window);
        }
        if let Some(counting) = &mut self.counting {
            counting.restart(self.motion.travelled);
        }
    }

    fn passage_step(&mut self) -> Result<(), StepError> {
        self.step_smooth()?;
        let before = self.way;
        let held = matches!(self.plan.march, Marching::Steady { .. }) && self.motion.is_flushed();
        if held {
            self.time_s += self.motion.dt_s(&self.march.grid, &self.door, &self.drive);
            let held = Attempted::held(&self.metrics, self.motion.nodes);
            self.watch(&held);
            self.way += held.nodes * self.march.grid.dx;
        } else {
            self.advance()?;
        }
        self.step += 1;
        self.look_for_orbit(before);
        self.totals.push(&self.metrics, self.way, self.averaged());
        Ok(())
    }

    /// One time step: solved, committed, measured.
    pub(super) fn advance(&mut self) -> Result<(), StepError> {
        let law = self.law_of_oil();
        let (stepping, nodes) = self.next_step();
        let attempted = self.pool.install(|| {
            Mover {
                march: &mut self.march,
                terrain: &mut self.terrain,
                drive: &mut self.drive,
                motion: &mut self.motion,
                door: &self.door,
                law,
                regime: self.regime,
                stepping,
            }
            .advance(nodes)
        });
        self.count(&attempted);
        if let Some(error) =
            attempted.fatal(self.time_s, self.regime.tolerance(self.march.flow).pressure)
        {
            return Err(error);
        }
        self.time_s += attempted.dt_s;
        self.watch(&attempted);
        let dx = self.march.grid.dx;
        self.way += attempted.nodes * dx;
        self.pace
            .learn(stepping, attempted.path_error, attempted.nodes);
        Ok(())
    }

    /// Adds up the work of a step.
    pub(super) fn count(&mut self, attempted: &Attempted) {
        self.stats.newton_iterations += u64::from(attempted.newton);
        self.stats.linear_iterations += u64::from(attempted.linear);
        self.stats.ffts += attempted.ffts;
        self.stats.retries += u64::from(attempted.retries);
        self.stats.halved += u64::from(attempted.halvings > 0);
        self.stats.safer += u64::from(attempted.safer);
        self.stats.rejected += u64::from(attempted.rejected);
    }

    /// How the next step is chosen, and its length in nodes: the start-up keeps to the usual one.
    fn next_step(&self) -> (Stepping, f64) {
        if let Phase::Settle { coarse: 1.., .. } = self.phase {
            let nodes = super::follow::COARSE * self.motion.nodes;
            return (Stepping::Fixed(nodes), nodes);
        }
        if self.phase != Phase::Passage {
            return (Stepping::Fixed(self.motion.nodes), self.motion.nodes);
        }
        let crests = self
            .plan
            .waves
            .iter()
            .flatten()
            .map(|wave| wave.crests_per_m);
        let sliding = self.drive.get(Knob::SlideRoll).now.abs();
        let crest = match &self.counting {
            Some(_) => 1.0 / (crests.fold(0.0, f64::max) * sliding * self.plan.dx_m),
            None => f64::INFINITY,
        };
        (self.stepping, self.pace.next(self.stepping, crest))
    }

    /// Way over which the summary averages, in a.
    pub(super) fn averaged(&self) -> f64 {
        self.orbit.window(self.plan.passage_a)
    }

    /// Moves a knob's target.
    ///
    /// # Errors
    /// [`SimError::Knob`] when the value is out of range or the scene has nothing for that knob to turn.
    pub fn set(&mut self, knob: Knob, value: f64) -> Result<(), SimError> {
        let refuse = |allowed: String| SimError::Knob {
            key: knob.key(),
            value,
            allowed,
        };
        if let Some(key) = crate::scene::keys::find(knob.key())
            && !key.kind.takes(value)
        {
            return Err(refuse(key.allowed()));
        }
        if matches!(knob, Knob::ForceN | Knob::ForceNPerM) && knob != self.door.load_knob() {
            return Err(refuse(format!(
                "{} in this kind of contact",
                self.door.load_knob().key()
            )));
        }
        let mut value = value;
        if knob == Knob::EntrainmentMS {
            value *= self.door.heading.sign();
            if value < 0.0 {
                return Err(refuse(
                    "a speed of the sign that the run began with: to turn the flow round is another run"
                        .to_owned(),
                ));
            }
        }
        let most = self.plan.most_force_n();
        if knob == self.door.load_knob() && value > most * (1.0 + 1e-9) {
            return Err(refuse(format!(
                "at most {most:.4e} in this domain: a greater contact would reach its edge (grid.x_min_a, grid.x_max_a and grid.y_half_a widen it; a load that an event of the scene sets is foreseen)"
            )));
        }
        let body = match knob {
            Knob::Amplitude1M => Some(0),
            Knob::Amplitude2M => Some(1),
            _ => None,
        };
        if body.is_some_and(|body| !self.terrain.is_rough(body)) {
            return Err(refuse(
                "this body is smooth: give it a surface in the scene".to_owned(),
            ));
        }
        self.wanted.aim(knob, value);
        if !matches!(self.phase, Phase::Smooth { .. }) {
            self.drive.aim(knob, value);
            self.motion.disturb(DEVELOP);
            self.forget_passage();
        }
        Ok(())
    }

    /// Part of the run that the last step belongs to.
    pub fn stage(&self) -> Stage {
        if self.phase == Phase::Passage && self.step > 0 {
            Stage::Passage
        } else {
            Stage::StartUp
        }
    }

    /// How much of the run is done, 0 to 1, start-up included.
    pub fn progress(&self) -> f64 {
        let (done, all) = self.start_up_steps;
        let steps = self.plan.steps as f64;
        let passed = match self.stepping {
            Stepping::Fixed(_) => self.step as f64,
            Stepping::Adaptive { .. } => steps * self.way / self.plan.length_a,
        };
        ((done as f64 + passed) / (all as f64 + steps).max(1.0)).min(1.0)
    }

    /// Time steps since the start-up.
    pub fn passage_steps(&self) -> u64 {
        self.step
    }

    /// Simulated time since the start-up, s.
    pub fn time_s(&self) -> f64 {
        if self.phase == Phase::Passage {
            self.time_s
        } else {
            0.0
        }
    }

    /// Whether the passages that the scene asks for are done.
    pub fn is_done(&self) -> bool {
        let steady = matches!(self.plan.march, Marching::Steady { .. });
        let enough = match self.stepping {
            Stepping::Adaptive { .. } if !steady => self.way >= self.plan.length_a * (1.0 - 1e-9),
            _ => self.step >= self.plan.steps,
        };
        self.phase == Phase::Passage && enough
    }

    /// Scalars of the last step.
    pub fn metrics(&self) -> &Metrics {
        &self.metrics
    }

    /// Work done so far.
    pub fn stats(&self) -> &Stats {
        &self.stats
    }

    /// Result so far.
    pub fn summary(&self) -> Summary {
        super::totals::summary(
            self,
            &self.totals,
            self.life_estimate().as_ref(),
            self.stats,
        )
    }

    pub(super) fn contact_film_m(&self) -> f64 {
        self.door.m_from_h(self.law.contact_film)
    }

    /// Writes the last step's fields and scalars into `frame`.
    pub fn fill(&self, frame: &mut Frame) {
        super::fill::fill(self, frame);
    }
}
