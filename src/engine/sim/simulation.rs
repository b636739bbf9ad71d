//! The simulation of one scene: start-up from Hertz, development of the rough contact, passage.
//!
//! ```text
//! smooth    S = 0, frictionless, from Hertz on 65², marched to steady, refined to the scene's grid
//! reference the smooth pressure's life integral
//! develop   sliding and roughness ramp up, the contact is flushed once
//! passage   every number counts
//! ```

mod fill;
mod fitness;
mod follow;
mod present;
mod restart;
mod smooth_reference;
mod start_up;
mod summary;
mod watching;

use std::sync::Arc;

use super::sim_plan::{DEVELOP, SimPlan};
use super::state::{Phase, State};
use super::stepping::{Attempted, Mover};
use super::work::{Work, thread_pool};
use super::{Frame, Knob, Metrics, SimError, Stage, Stats, StepError};
use crate::plan::{Plan, TimeDependence};
use crate::scene::Scene;
use crate::sim::pace::Stepping;

/// The simulation of one scene.
pub struct Simulation {
    /// What follows from the scene.
    plan: SimPlan,
    /// What a restart needs.
    state: State,
    /// What steps are solved with.
    work: Work,
    /// Work done so far.
    stats: Stats,
}

impl Simulation {
    /// Makes all memory for `scene` by `plan`; `threads` workers of its own.
    ///
    /// # Errors
    /// [`SimError`] when the workers cannot be started or the stress engine refuses the plan.
    pub fn new(scene: &Scene, plan: Plan, threads: usize) -> Result<Self, SimError> {
        let pool = thread_pool(threads)?;
        let plan = SimPlan::new(scene, plan);
        let mut work = Work::new(&plan, plan.first_nodes(), pool)?;
        let state = State::new(&plan, &mut work);
        let stats = Stats::default();
        let mut this = Self {
            plan,
            state,
            work,
            stats,
        };
        this.make_room();
        let measured = this.see_again();
        this.publish(&Attempted::default(), &measured);
        Ok(this)
    }

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
        let pool = Arc::clone(&self.work.pool);
        pool.install(|| work(self))
    }

    fn step_inside(&mut self) -> Result<(), StepError> {
        self.stats.steps += 1;
        match self.state.phase {
            Phase::Smooth { left: 0 } => self.refine_or_develop(),
            Phase::Smooth { left } => {
                self.advance()?;
                self.state.phase = Phase::Smooth { left: left - 1 };
                self.state.start_up_steps.0 += 1;
                Ok(())
            }
            Phase::Settle { coarse: 0, fine: 0 } => {
                self.state.phase = Phase::Develop { left: 0 };
                self.stats.steps -= 1;
                self.step_inside()
            }
            Phase::Settle { coarse, fine } => {
                self.advance()?;
                self.state.phase = Phase::Settle {
                    coarse: coarse.saturating_sub(1),
                    fine: fine - u64::from(coarse == 0),
                };
                self.state.start_up_steps.0 += 1;
                Ok(())
            }
            Phase::Develop { left: 0 } => {
                self.state.phase = Phase::Passage;
                (self.state.time_s, self.state.distance) = (0.0, 0.0);
                self.state.motion.launch();
                self.forget_passage();
                self.passage_step()
            }
            Phase::Develop { left } => {
                self.step_smooth()?;
                self.advance()?;
                self.state.phase = Phase::Develop { left: left - 1 };
                self.state.start_up_steps.0 += 1;
                Ok(())
            }
            Phase::Passage => self.passage_step(),
        }
    }

    /// Counts and phases seen so far belong to other conditions. The next step is looked at.
    fn forget_passage(&mut self) {
        self.state.orbit.restart();
        let window = self.state.orbit.life_window(self.plan.decided.passage_a);
        if let Some(life) = &mut self.state.life {
            life.restart(window);
        }
        self.state.next_volume = self.state.distance;
        if let Some(counting) = &mut self.state.counting {
            counting.restart(self.state.watched);
        }
    }

    /// What a step of the passage leaves to be averaged: while a knob walks, and until what entered meanwhile has
    /// left the contact, nothing. What was seen of it so far is shown as under way, and forgotten here.
    fn count_from_here(&mut self, walked: bool, was_flushed: bool) {
        if self.state.phase != Phase::Passage {
            return;
        }
        if walked {
            self.state.motion.disturb(DEVELOP);
        } else if !was_flushed && self.state.motion.is_flushed() {
            self.forget_passage();
            self.state.totals.restart();
        }
    }

    fn passage_step(&mut self) -> Result<(), StepError> {
        self.step_smooth()?;
        let before = self.state.distance;
        // Where a body yields at rest, what enters is flattened anew.
        let held = matches!(
            self.plan.decided.time_dependence,
            TimeDependence::Steady { .. }
        ) && self.state.motion.is_flushed()
            && self.plan.scaling.p_from_pa(self.state.metrics.p_max_pa)
                < self.plan.hardness * (1.0 - 1e-9);
        if held {
            let speed = self.state.drive.get(Knob::EntrainmentMS).now;
            self.state.time_s +=
                self.plan.stepping.usual() * self.work.solver.grid.dx * self.plan.scaling.a_m
                    / speed;
            let held = Attempted::held(&self.state.metrics, self.plan.stepping.usual());
            // The contact rests, the bodies do not: material points cross it.
            let s = self.state.drive.get(Knob::SlideRoll).now;
            let grid = &self.work.solver.grid;
            self.state.motion.travel(grid, held.nodes, s);
            self.watch(&held);
            self.state.distance += held.nodes * self.work.solver.grid.dx;
        } else {
            self.advance()?;
        }
        self.state.step += 1;
        self.look_for_orbit(before);
        self.state
            .totals
            .push(&self.state.metrics, self.state.distance, self.averaged());
        Ok(())
    }

    /// One time step: solved, committed, measured.
    fn advance(&mut self) -> Result<(), StepError> {
        let (stepping, nodes) = self.next_step();
        let (walked, was_flushed) = (
            self.state.drive.is_walking(),
            self.state.motion.is_flushed(),
        );
        let transforms = self.work.solver.transforms();
        // The smooth contact that all lives are compared with is elastic.
        let is_smooth = matches!(self.state.phase, Phase::Smooth { .. });
        let yielded = self.state.yielded.as_mut().filter(|_| !is_smooth);
        let attempted = self.work.pool.install(|| {
            Mover {
                state: &mut self.state.contact,
                solver: &mut self.work.solver,
                roughness: &mut self.work.roughness,
                drive: &mut self.state.drive,
                motion: &mut self.state.motion,
                plan: &self.plan,
                stepping,
                yielded,
            }
            .advance(nodes)
        });
        let made = self.work.solver.transforms() - transforms;
        self.stats.add(&attempted, made);
        if let Some(error) = attempted.fatal(self.state.time_s) {
            return Err(error);
        }
        self.state.time_s += attempted.dt_s;
        self.count_from_here(walked, was_flushed);
        self.watch(&attempted);
        let dx = self.work.solver.grid.dx;
        self.state.distance += attempted.nodes * dx;
        self.state
            .pace
            .learn(stepping, attempted.path_error, attempted.nodes);
        Ok(())
    }

    /// How the next step is chosen, and its length in nodes: the start-up keeps to the usual one.
    fn next_step(&self) -> (Stepping, f64) {
        if let Phase::Settle { coarse: 1.., .. } = self.state.phase {
            let nodes = follow::COARSE * self.plan.stepping.usual();
            return (Stepping::Fixed(nodes), nodes);
        }
        if self.state.phase != Phase::Passage {
            return (
                Stepping::Fixed(self.plan.stepping.usual()),
                self.plan.stepping.usual(),
            );
        }
        let crests = self
            .plan
            .decided
            .waves
            .iter()
            .flatten()
            .map(|wave| wave.crests_per_m);
        let sliding = self.state.drive.get(Knob::SlideRoll).now.abs();
        let crest = match &self.state.counting {
            Some(_) => 1.0 / (crests.fold(0.0, f64::max) * sliding * self.plan.decided.dx_m),
            None => f64::INFINITY,
        };
        (
            self.plan.stepping,
            self.state.pace.next(self.plan.stepping, crest),
        )
    }

    /// Distance over which the summary averages, in a.
    fn averaged(&self) -> f64 {
        self.state.orbit.window(self.plan.decided.passage_a)
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
        if let Some(key) = knob.scene_key()
            && !key.kind.takes(value)
        {
            return Err(refuse(key.allowed()));
        }
        if knob.is_load() && knob != self.plan.scaling.load_knob() {
            return Err(refuse(format!(
                "{} in this kind of contact",
                self.plan.scaling.load_knob().key()
            )));
        }
        let mut value = value;
        if knob == Knob::EntrainmentMS {
            value *= self.plan.scaling.heading.sign();
            if value < 0.0 {
                return Err(refuse(
                    "a speed of the sign that the run began with: to turn the flow round is another run"
                        .to_owned(),
                ));
            }
        }
        let most = self.plan.decided.maximum_force_n();
        if knob == self.plan.scaling.load_knob() && value > most * (1.0 + 1e-9) {
            if self.plan.decided.carried_force_n() <= most {
                return Err(refuse(format!(
                    "at most {most:.4e}, which makes a Hertz pressure of twice the hardness of the softer body: with more it yields as a whole and not by its asperities"
                )));
            }
            return Err(refuse(format!(
                "at most {most:.4e} in this domain: a greater contact would reach its edge (grid.x_min_a, grid.x_max_a and grid.y_half_a widen it; a load that an event of the scene sets is foreseen)"
            )));
        }
        if knob
            .body()
            .is_some_and(|body| !self.work.roughness.is_rough(body))
        {
            return Err(refuse(
                "this body is smooth: give it a surface in the scene".to_owned(),
            ));
        }
        self.state.targets.aim(knob, value);
        if !matches!(self.state.phase, Phase::Smooth { .. }) {
            self.state.drive.aim(knob, value);
            self.state.motion.disturb(DEVELOP);
            self.forget_passage();
        }
        Ok(())
    }

    /// Part of the run that the last step belongs to.
    pub fn stage(&self) -> Stage {
        if self.state.phase == Phase::Passage && self.state.step > 0 {
            Stage::Passage
        } else {
            Stage::StartUp
        }
    }

    /// How much of the run is done, 0 to 1, start-up included.
    pub fn progress(&self) -> f64 {
        let (done, all) = self.state.start_up_steps;
        let steps = self.plan.decided.steps as f64;
        let passed = match self.plan.stepping {
            Stepping::Fixed(_) => self.state.step as f64,
            Stepping::Adaptive { .. } => steps * self.state.distance / self.plan.decided.length_a,
        };
        ((done as f64 + passed) / (all as f64 + steps).max(1.0)).min(1.0)
    }

    /// How much of the start-up is done, 0 to 1.
    pub fn start_up_progress(&self) -> f64 {
        let (done, all) = self.state.start_up_steps;
        match self.stage() {
            Stage::Passage => 1.0,
            Stage::StartUp => (done as f64 / all.max(1) as f64).min(1.0),
        }
    }

    /// Time steps since the start-up.
    pub fn passage_steps(&self) -> u64 {
        self.state.step
    }

    /// Simulated time since the start-up, s.
    pub fn time_s(&self) -> f64 {
        if self.state.phase == Phase::Passage {
            self.state.time_s
        } else {
            0.0
        }
    }

    /// Whether the passages that the scene asks for are done.
    pub fn is_done(&self) -> bool {
        let steady = matches!(
            self.plan.decided.time_dependence,
            TimeDependence::Steady { .. }
        );
        let enough = match self.plan.stepping {
            Stepping::Adaptive { .. } if !steady => {
                self.state.distance >= self.plan.decided.length_a * (1.0 - 1e-9)
            }
            _ => self.state.step >= self.plan.decided.steps,
        };
        self.state.phase == Phase::Passage && enough
    }

    /// Scalars of the last step.
    pub fn metrics(&self) -> &Metrics {
        &self.state.metrics
    }

    /// Work done so far.
    pub fn stats(&self) -> &Stats {
        &self.stats
    }

    fn contact_film_m(&self) -> f64 {
        self.plan.scaling.m_from_h(self.plan.law.contact_film)
    }

    /// Writes the last step's fields and scalars into `frame`.
    pub fn fill(&self, frame: &mut Frame) {
        fill::fill(self, frame);
    }
}
