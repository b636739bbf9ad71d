//! The simulation of one scene: start-up from Hertz, development of the rough contact, passage.
//!
//! ```text
//! smooth    S = 0, frictionless, from Hertz on 65², marched to steady, refined to the scene's grid
//! reference the smooth pressure's life integral
//! develop   sliding and roughness ramp up, the contact is flushed once
//! passage   every number counts
//! ```

mod ageing;
mod fill;
mod follow;
mod present;
mod rung;
mod smooth_reference;
mod start_up;
mod state_check;
mod step;
mod summary;
mod view;
mod watching;

use std::sync::Arc;

use super::counting::Counting;
use super::estimates::Rhythm;
use super::sim_plan::SimPlan;
use super::state::{Phase, State};
use super::stepping::Attempted;
use super::work::{Work, thread_pool};
use super::worn::Worn;
use super::{Follow, Frame, Knob, Metrics, SimError, Stage, Stats, StepError, Summary};
use crate::physics::cycles::BodyId;
use crate::plan::{Plan, TimeDependence};
use crate::saved::Saved as _;
use crate::scene::Scene;
use crate::sim::pace::Stepping;
use follow::cold_distances;
pub use rung::climb_distances;
use state_check::{check, check_course, check_stats};
use step::{forget_passage, step};
use view::View;
use watching::{publish, see_again};

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
        let mut state = State::new(&plan, &mut work);
        // Surfaces stand as the scene says when the passage begins.
        let develops = start_up::develops(&state, &work);
        let ahead = cold_distances(&plan, &state.targets, develops, plan.usual_dt());
        state.motion.travelled = ahead.map(|distance| -distance);
        state.watched = state.motion.travelled;
        let stats = Stats::default();
        let mut this = Self {
            plan,
            state,
            work,
            stats,
        };
        let measured = see_again(&this.plan, &this.state, &mut this.work);
        let untried = Attempted::default();
        publish(&this.plan, &mut this.state, &this.work, &untried, &measured);
        Ok(this)
    }

    /// One step, of the start-up first and then of the passage.
    ///
    /// # Errors
    /// [`StepError`] when the step failed; nothing of it was kept.
    pub fn step(&mut self) -> Result<(), StepError> {
        self.inside(|sim| step(&sim.plan, &mut sim.state, &mut sim.work, &mut sim.stats))
    }

    /// Does something on a thread of the simulation's pool. Handing work over to a pool takes a wake-up, and room in
    /// its queue now and then: who makes many steps makes them all inside.
    pub fn inside<R: Send>(&mut self, work: impl FnOnce(&mut Self) -> R + Send) -> R {
        let pool = Arc::clone(&self.work.pool);
        pool.install(|| work(self))
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
            self.state.motion.disturb(self.plan.develop());
            forget_passage(&self.plan, &mut self.state);
        }
        Ok(())
    }

    /// How much of the run is done, 0 to 1, start-up included.
    pub fn progress(&self) -> f64 {
        let (done, all) = self.state.start_up_steps;
        let steps = self.plan.decided.steps as f64;
        let passed = match self.plan.stepping {
            Stepping::Fixed(_) => self.state.step as f64,
            Stepping::Adaptive { .. } => steps * self.state.distance / self.plan.decided.length_a,
        };
        let run = ((done as f64 + passed) / (all as f64 + steps).max(1.0)).min(1.0);
        match &self.state.worn {
            Some(worn) => run.min(0.05 + 0.95 * worn.progress()),
            None => run,
        }
    }

    /// Lengths of 4 a at U since the start-up.
    pub fn passages(&self) -> f64 {
        self.state.passages(self.plan.decided.passage_a)
    }

    /// Time steps since the start-up.
    pub fn passage_steps(&self) -> u64 {
        self.state.step
    }

    /// Whether surfaces age, and have cycles left to do so.
    pub fn is_ageing(&self) -> bool {
        self.state.worn.as_ref().is_some_and(|worn| !worn.is_done())
    }

    /// Whether the life of waves that pass with a common period has settled ([`Plan::may_settle`]).
    pub fn has_settled(&self) -> bool {
        if !self.plan.decided.may_settle {
            return false;
        }
        let metrics = &self.state.metrics;
        let comes_back = (metrics.repeat).is_some_and(|repeat| repeat.rhythm == Rhythm::Orbit);
        let settled = metrics.life.is_some_and(|life| life.settled);
        self.state.phase == Phase::Passage && metrics.converged && comes_back && settled
    }

    /// Whether the run may end before its last step: more would only repeat what has been seen, as the life has settled, the
    /// fields come back, means are over a whole passage, and every place of the damage maps has crossed.
    pub fn ends_settled(&self) -> bool {
        let repeats = (self.state.metrics.repeat).is_some_and(|repeat| repeat.repeats);
        let drawn = (self.state.counting.as_ref()).is_none_or(Counting::has_whole_maps);
        let asked = self.plan.decided.until_settled;
        asked && repeats && drawn && self.has_settled() && self.passages() >= 1.0 - 1e-9
    }

    /// Whether the passages that the scene asks for are done, or as many as its life needs.
    pub fn is_done(&self) -> bool {
        if self.ends_settled() {
            return true;
        }
        let steady = matches!(
            self.plan.decided.time_dependence,
            TimeDependence::Steady { .. }
        );
        let enough = match self.plan.stepping {
            Stepping::Adaptive { .. } if !steady => {
                self.state.distance >= self.plan.decided.length_a * (1.0 - 1e-9)
            }
            Stepping::Adaptive { .. } | Stepping::Fixed(_) => {
                self.state.step >= self.plan.decided.steps
            }
        };
        let aged = self.state.worn.as_ref().is_none_or(Worn::is_done);
        self.state.phase == Phase::Passage && enough && aged
    }

    /// Scalars of the last step.
    pub fn metrics(&self) -> &Metrics {
        &self.state.metrics
    }

    /// Work done so far.
    pub fn stats(&self) -> &Stats {
        &self.stats
    }

    /// Part of the run that the last step belongs to.
    pub fn stage(&self) -> Stage {
        self.state.stage()
    }

    /// How much of the start-up is done, 0 to 1.
    pub fn start_up_progress(&self) -> f64 {
        self.state.start_up_progress()
    }

    /// Whether the start-up is over and no step made since: t = 0.
    pub fn is_launched(&self) -> bool {
        self.state.phase == Phase::Passage && self.state.step == 0
    }

    /// Simulated time since the start-up, s.
    pub fn time_s(&self) -> f64 {
        self.state.time_of_passage_s()
    }

    fn view(&self) -> View<'_> {
        View {
            plan: &self.plan,
            state: &self.state,
            work: &self.work,
        }
    }

    /// Writes the last step's fields and scalars into `frame`.
    pub fn fill(&self, frame: &mut Frame) {
        fill::fill(self.view(), frame);
    }

    /// Result so far. What only its run knows (name, clock, steps planned, discretisation error) is left out.
    pub fn summary(&self) -> Summary {
        summary::summary(self.view(), &self.stats)
    }

    /// Life of the smooth contact as [`Summary::life_smooth`] has it; `None`: the start-up has not come to it yet, or the scene
    /// has no life.
    pub fn life_smooth(&self) -> Option<f64> {
        summary::life_smooth(self.view())
    }

    /// Loading cycles of the smooth contact at the load and speed of now, by the scene's calibration point; `None` as
    /// [`Simulation::life_smooth`], or there is no such point.
    pub fn smooth_cycles(&self) -> Option<f64> {
        let size = self.plan.size_now(&self.state.drive);
        self.state.life.as_ref()?.smooth_cycles(size)
    }

    /// Shows another material point; nothing that is computed changes.
    pub fn show_point(&mut self, follow: Follow) {
        let Some(counting) = &mut self.state.counting else {
            return;
        };
        let depths = self.work.stress.as_ref().map_or(&[][..], |s| s.depths());
        let away = |k: usize| (self.plan.scaling.m_from_x(depths[k]) - follow.depth_m).abs();
        let nearest = (0..depths.len()).min_by(|&one, &two| away(one).total_cmp(&away(two)));
        let body = BodyId::of(follow.body).unwrap_or_default();
        let x = follow
            .x_m
            .map(|x_m| self.plan.scaling.heading.sign() * x_m / self.plan.scaling.a_m);
        counting.look_at(body, x, nearest.unwrap_or(0));
    }

    /// Shows a material point of body 1 or 2 from the beginning on, as a run on a coarser mesh has found that it governs; one
    /// that somebody has chosen stays.
    pub fn expect_governing(&mut self, body: u8) {
        if let (Some(body), Some(counting)) = (BodyId::of(body), &mut self.state.counting) {
            counting.begin_with(body);
        }
    }

    /// Starts from the end of `neighbour`, a run of the same scene but for the slide-to-roll ratio and the
    /// amplitudes, in place of the start-up.
    ///
    /// # Errors
    /// [`SimError::State`] when the neighbour's passage had not begun or its fields do not fit; the simulation
    /// is as it was.
    pub fn follow(&mut self, neighbour: &State) -> Result<(), SimError> {
        follow::follow(&self.plan, &mut self.state, &mut self.work, neighbour)
    }

    /// Keeps from now on what a run on a finer mesh needs ([`Simulation::climb`]).
    pub fn hand_on(&mut self) {
        self.plan.hands_on = true;
    }

    /// Goes on from `lower`, a run of the same scene on half the intervals that [hands on](Self::hand_on), in place of the
    /// start-up.
    ///
    /// # Errors
    /// [`SimError::State`] when it is none, or when its passage has not begun; the simulation is as it was.
    pub fn climb(&mut self, lower: &State) -> Result<(), SimError> {
        rung::climb(&self.plan, &mut self.state, &mut self.work, lower)
    }

    /// Holds both surfaces back, before the first step, by so much (in a): see [`climb_distances`].
    pub fn hold_back(&mut self, distances: [f64; 2]) {
        let travelled = &mut self.state.motion.travelled;
        for (travelled, distance) in travelled.iter_mut().zip(distances) {
            *travelled -= distance;
        }
        self.state.watched = self.state.motion.travelled;
    }

    /// What a restart needs, as it is between two steps.
    pub fn save(&self) -> State {
        self.state.clone()
    }

    /// Whether a simulation of this scene can have left that state.
    ///
    /// # Errors
    /// [`SimError::State`] when it cannot.
    pub fn check(&self, state: &State) -> Result<(), SimError> {
        check(&self.plan, &self.state, &self.work, state)?;
        check_course(&self.plan, &self.state, &self.work, state)
    }

    /// Goes on from `state`, saved by a simulation of the same scene. Work is counted as before
    /// ([`Simulation::count_from`]).
    ///
    /// # Errors
    /// [`SimError::State`] when the state does not fit the scene; the simulation is as it was.
    pub fn restore(&mut self, state: &State) -> Result<(), SimError> {
        self.check(state)?;
        self.state.restore(state);
        self.work.solve_on(&self.plan, self.state.nodes);
        see_again(&self.plan, &self.state, &mut self.work);
        Ok(())
    }

    /// Counts on from the work of the run that a restored state is from.
    ///
    /// # Errors
    /// [`SimError::State`] when no run does so much.
    pub fn count_from(&mut self, stats: Stats) -> Result<(), SimError> {
        check_stats(&stats)?;
        self.stats = stats;
        Ok(())
    }
}
