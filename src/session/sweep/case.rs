//! One case: from its scene to a row.
//!
//! A case starts cold (Hertz, smooth reference, develop) or follows its neighbour ([`Simulation::follow`]),
//! then runs its passages. A step that stalls ends it; what is known of it stays in the row, named.

use std::sync::Arc;
use std::sync::atomic::AtomicBool;

use serde::{Deserialize, Serialize};

use super::error::SweepError;
use super::spec::{ChainKeys, Sweep};
use super::window::window;
use crate::run::{Assumed, Clock};
use asperity_engine::plan::{OtherFilms, Plan, PlanError, TimeDependence};
use asperity_engine::scene::{CycleBasis, Scene, Surface};
use asperity_engine::sim::{SimError, Simulation, State, Summary};

/// How a case began.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum CaseStart {
    /// From Hertz.
    Cold,
    /// From the end of the case before.
    Warm,
}

/// How a case ended, from good to bad.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum CaseEnd {
    /// Every step converged.
    Converged,
    /// Some steps did not converge.
    NotConverged,
    /// A step failed beyond repair, or the case could not be made.
    Stalled,
}

/// What a case leaves; all of it but the seconds is the same on every machine of one kind.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct CaseRecord {
    /// Number of the case, from 0.
    pub index: usize,
    /// How it began.
    pub began: CaseStart,
    /// How it ended.
    pub end: CaseEnd,
    /// What went wrong, in words.
    pub failure: Option<String>,
    /// Time that it took, s.
    pub seconds: f64,
    /// Means over the last passage or period.
    pub summary: Summary,
    /// λ: smooth central film by formula over the composite roughness.
    pub lambda_ratio: Option<f64>,
    /// Smooth central film by regression, m.
    pub h_regression_m: Option<f64>,
    /// Smooth minimum film by regression, m.
    pub h_min_regression_m: Option<f64>,
    /// Steps of the start-up or of settling that did not converge.
    pub start_up_not_converged: u64,
}

/// A scene as a case of a sweep, with its plan.
pub(super) struct Case {
    pub(super) index: usize,
    pub(super) scene: Scene,
    pub(super) plan: Plan,
}

/// The end of a case that the next one may start from.
#[derive(Clone)]
pub(super) struct Neighbour {
    pub(super) scene: Scene,
    pub(super) state: State,
}

impl Case {
    /// With the passages that the sweep gives it, the last one as long as its window; with those of the scene where material
    /// points must cross.
    pub(super) fn new(index: usize, mut scene: Scene, chain: ChainKeys) -> Result<Self, PlanError> {
        let points_cross = scene.life.as_ref().is_some_and(|life| {
            let counts_points = match life.cycles {
                CycleBasis::Damage | CycleBasis::Peaks => true,
                CycleBasis::Global => false,
            };
            counts_points || life.maps() != [false; 2]
        });
        let usual = || (!points_cross).then(|| scene.time.most_passages().min(1.0));
        let Some(passages) = chain.passages.or_else(usual) else {
            return Self::as_asked(index, scene);
        };
        scene.time.passages = Some(passages);
        let mut case = Self::as_asked(index, scene)?;
        fit_window(&mut case.plan);
        Ok(case)
    }

    /// As long as the scene says.
    pub(super) fn as_asked(index: usize, scene: Scene) -> Result<Self, PlanError> {
        let plan = Plan::new(&scene)?;
        Ok(Self { index, scene, plan })
    }

    /// Runs it from the end of its neighbour, where it may follow it, else from Hertz; gives its record, and the state that the
    /// next one may start from. `go_on` is called after each step with how much of it is done, 0 to 1; `None`: it said stop.
    pub(super) fn run(
        &self,
        before: Option<&Neighbour>,
        threads: usize,
        mut go_on: impl FnMut(f64) -> bool,
    ) -> Option<(CaseRecord, Option<State>)> {
        let mut running = RunningCase::begin(self, before, Until::Passages, threads);
        while running.step() {
            if !go_on(running.progress()) {
                return None;
            }
        }
        Some(running.end())
    }

    /// Where crests of both bodies do not meet in all ways, its band holds all of them, as that of a run alone does.
    pub(super) fn band_over_phases(
        &self,
        record: &mut CaseRecord,
        threads: usize,
        stop: &AtomicBool,
    ) {
        if record.end != CaseEnd::Converged {
            return;
        }
        let began = Clock::start();
        let scene = Arc::new(self.scene.clone());
        let range = Assumed::Phase.vary(&scene, &self.plan, threads, &mut record.summary, stop);
        if range.is_some() {
            record.seconds += began.elapsed_s();
        }
    }

    /// Smooth films by regression: central and minimum, m; `None`: dry.
    pub(super) fn regressions_m(&self) -> Option<[f64; 2]> {
        let film = self.plan.film.as_ref()?;
        Some(match film.others {
            OtherFilms::HamrockDowson {
                central_m,
                minimum_m,
            } => [central_m, minimum_m],
            OtherFilms::DowsonHigginson { minimum_m } => [film.central_m, minimum_m],
        })
    }
}

impl Sweep {
    /// A case with its plan.
    ///
    /// # Errors
    /// [`SweepError`] when it is no scene or cannot be planned.
    pub(super) fn case(&self, index: usize) -> Result<Case, SweepError> {
        let case = Case::new(index, self.scene(index)?, self.chain);
        case.map_err(|source| self.not_planned(index, source))
    }

    pub(super) fn not_planned(&self, index: usize, source: PlanError) -> SweepError {
        SweepError::Plan {
            index,
            at: self.at(index),
            source,
        }
    }
}

/// Makes the last passage of a plan as long as its window.
fn fit_window(plan: &mut Plan) {
    if plan.time_dependence != TimeDependence::Transient {
        return;
    }
    let run_in = (plan.length_a - plan.passage_a).max(0.0);
    let averaged = window(plan, plan.length_a - run_in);
    (plan.passage_a, plan.length_a) = (averaged, run_in + averaged);
    let step_a = 4.0 / plan.steps_per_passage as f64;
    plan.steps = (plan.length_a / step_a).ceil() as u64;
}

/// When a case has ended.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Until {
    /// After its passages.
    Passages,
    /// Once its life has settled, as the explorer's own does on a coarse mesh; without a period not before its passages. After so
    /// many times these it has not converged.
    Settled(u64),
}

impl Until {
    fn is_met(self, sim: &Simulation, steps: u64) -> bool {
        let Self::Settled(times) = self else {
            return sim.is_done();
        };
        let given_up = || sim.passage_steps() >= times * steps;
        sim.has_settled() || (sim.is_done() && (has_settled(sim) || given_up()))
    }
}

fn has_settled(sim: &Simulation) -> bool {
    sim.metrics().life.is_none_or(|life| life.settled)
}

/// Whether a case may start from the end of another: they differ in S and amplitudes alone, and no height
/// map has to be brought back to its place.
pub(super) fn may_follow(before: &Scene, scene: &Scene) -> bool {
    let stripped = |scene: &Scene| {
        let mut scene = scene.clone();
        scene.motion.slide_roll = 0.0;
        scene.body_1.surface.set_amplitude_m(0.0);
        scene.body_2.surface.set_amplitude_m(0.0);
        scene
    };
    let is_map = |surface: &&Surface| match surface {
        Surface::Random(_) | Surface::HeightMap { .. } => true,
        Surface::Smooth {} | Surface::Sinusoid { .. } => false,
    };
    stripped(before) == stripped(scene) && !scene.surfaces().iter().any(is_map)
}

/// A case under way, for who makes its steps.
pub(super) struct RunningCase {
    /// `None`: it could not be made.
    sim: Option<Simulation>,
    until: Until,
    /// Steps of the plan.
    steps: u64,
    record: CaseRecord,
    failure: Option<String>,
    started: Clock,
}

impl RunningCase {
    /// Makes it, from the end of its neighbour where it may follow it. One that cannot be made makes no step.
    pub(super) fn begin(
        case: &Case,
        before: Option<&Neighbour>,
        until: Until,
        threads: usize,
    ) -> Self {
        let started = Clock::start();
        let before = before.filter(|before| may_follow(&before.scene, &case.scene));
        let made = made(case, before, threads);
        Self {
            until,
            steps: case.plan.steps,
            record: CaseRecord {
                index: case.index,
                began: match (&made, before) {
                    (Ok(_), Some(_)) => CaseStart::Warm,
                    (Ok(_), None) | (Err(_), _) => CaseStart::Cold,
                },
                end: CaseEnd::Stalled,
                failure: None,
                seconds: 0.0,
                summary: Summary::default(),
                lambda_ratio: None,
                h_regression_m: case.regressions_m().map(|[central, _]| central),
                h_min_regression_m: case.regressions_m().map(|[_, minimum]| minimum),
                start_up_not_converged: 0,
            },
            failure: made.as_ref().err().map(ToString::to_string),
            sim: made.ok(),
            started,
        }
    }

    /// One step; false: there is none to make any more.
    pub(super) fn step(&mut self) -> bool {
        let Some(sim) = &mut self.sim else {
            return false;
        };
        if self.failure.is_some() || self.until.is_met(sim, self.steps) {
            return false;
        }
        if let Err(error) = sim.step() {
            self.failure = Some(error.to_string());
            return false;
        }
        if sim.passage_steps() == 0 && !sim.metrics().converged {
            self.record.start_up_not_converged += 1;
        }
        true
    }

    /// How much is done, 0 to 1.
    fn progress(&self) -> f64 {
        self.sim.as_ref().map_or(1.0, Simulation::progress)
    }

    /// What it leaves, and the state that the next one may start from: a case in trouble is no start.
    pub(super) fn end(self) -> (CaseRecord, Option<State>) {
        let mut record = self.record;
        record.failure = self.failure;
        let Some(sim) = self.sim else {
            return (record, None);
        };
        if sim.passage_steps() > 0 {
            record.summary = sim.summary();
            record.lambda_ratio = sim.metrics().lambda_ratio;
        }
        let unconverged = record.start_up_not_converged + record.summary.steps_not_converged;
        record.end = match (&record.failure, self.until) {
            (Some(_), _) => CaseEnd::Stalled,
            (None, Until::Settled(_)) if !has_settled(&sim) => {
                record.failure = Some("the average of the life has not settled".to_owned());
                CaseEnd::NotConverged
            }
            (None, _) if unconverged > 0 => CaseEnd::NotConverged,
            (None, Until::Settled(_) | Until::Passages) => CaseEnd::Converged,
        };
        let has_converged = record.end == CaseEnd::Converged;
        record.summary.converged = has_converged;
        record.seconds = self.started.elapsed_s();
        (record, has_converged.then(|| sim.save().for_neighbour()))
    }
}

fn made(case: &Case, before: Option<&Neighbour>, threads: usize) -> Result<Simulation, SimError> {
    let mut sim = Simulation::new(&case.scene, case.plan.clone(), threads)?;
    if let Some(before) = before {
        sim.follow(&before.state)?;
    }
    Ok(sim)
}
