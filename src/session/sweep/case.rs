//! One case: from its scene to a row.
//!
//! A case starts cold (Hertz, smooth reference, develop) or follows its neighbour ([`Simulation::follow`]),
//! then runs its passages. A step that stalls ends it; what is known of it stays in the row, named.

use serde::{Deserialize, Serialize};

use super::spec::ChainKeys;
use crate::run::Clock;
use asperity_engine::plan::{OtherFilms, Plan};
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

/// How a case ended.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
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

/// Whether the loop goes on.
pub(super) trait Watch {
    /// Called after each step with how much of the case is done, 0 to 1; false: stop.
    fn step(&mut self, done: f64) -> bool;
}

/// A case that was run: its record, and the state that the next one may start from. `None`: stopped.
pub(super) type Ran = Option<(CaseRecord, Option<State>)>;

/// How long a case is.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Length {
    /// What the sweep says, the last passage as long as its window.
    Windowed,
    /// What the scene says.
    Asked,
}

/// When a case has ended.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Until {
    /// After its passages.
    Passages,
    /// Not before its life has settled, as the explorer's own has: after so many times its passages it has not
    /// converged.
    Settled(u64),
}

impl Until {
    fn is_met(self, sim: &Simulation, steps: u64) -> bool {
        let Self::Settled(times) = self else {
            return sim.is_done();
        };
        sim.is_done() && (has_settled(sim) || sim.passage_steps() >= times * steps)
    }
}

fn has_settled(sim: &Simulation) -> bool {
    sim.metrics().life.is_none_or(|life| life.settled)
}

/// The scene of a case with the passages that the sweep gives it.
pub(super) fn shortened(mut scene: Scene, chain: ChainKeys) -> (Scene, Length) {
    let points_cross = scene.life.as_ref().is_some_and(|life| {
        let counted = match life.cycles {
            CycleBasis::Damage | CycleBasis::Peaks => true,
            CycleBasis::Global => false,
        };
        counted || life.maps() != [false; 2]
    });
    match chain.passages {
        Some(passages) => scene.time.passages = passages,
        None if !points_cross => scene.time.passages = scene.time.passages.min(1.0),
        None => return (scene, Length::Asked),
    }
    (scene, Length::Windowed)
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
    let drawn = |surface: &&Surface| matches!(surface, Surface::HeightMap { .. });
    stripped(before) == stripped(scene) && !scene.surfaces().iter().any(drawn)
}

/// Runs a case after another one: from its end, where it may follow it, else from Hertz.
pub(super) fn after(
    before: Option<&(Scene, State)>,
    index: usize,
    scene: &Scene,
    plan: &Plan,
    until: Until,
    threads: usize,
    watch: &mut dyn Watch,
) -> Ran {
    let from = (neighbour(before, scene), until);
    run(index, scene, plan, from, threads, watch)
}

/// The end of the case before, where another may start from it.
pub(super) fn neighbour<'a>(
    before: Option<&'a (Scene, State)>,
    scene: &Scene,
) -> Option<&'a State> {
    let (before, state) = before?;
    may_follow(before, scene).then_some(state)
}

/// Runs a case, from the end of its neighbour where there is one.
pub(super) fn run(
    index: usize,
    scene: &Scene,
    plan: &Plan,
    from: (Option<&State>, Until),
    threads: usize,
    watch: &mut dyn Watch,
) -> Ran {
    let mut case = match RunningCase::begin(index, scene, plan, from, threads) {
        Ok(case) => case,
        Err(record) => return Some((*record, None)),
    };
    while case.step() {
        if !watch.step(case.sim.progress()) {
            return None;
        }
    }
    Some(case.end())
}

/// A case under way, for who makes its steps.
pub(super) struct RunningCase {
    sim: Simulation,
    until: Until,
    /// Steps of the plan.
    steps: u64,
    record: CaseRecord,
    failure: Option<String>,
    started: Clock,
}

impl RunningCase {
    /// Makes it; the record of one that cannot be made says why not.
    pub(super) fn begin(
        index: usize,
        scene: &Scene,
        plan: &Plan,
        (neighbour, until): (Option<&State>, Until),
        threads: usize,
    ) -> Result<Self, Box<CaseRecord>> {
        let started = Clock::start();
        let mut record = blank(index, plan);
        match begin(scene, plan, neighbour, threads) {
            Ok((sim, began)) => {
                record.began = began;
                Ok(Self {
                    sim,
                    until,
                    steps: plan.steps,
                    record,
                    failure: None,
                    started,
                })
            }
            Err(error) => {
                record.end = CaseEnd::Stalled;
                record.failure = Some(error.to_string());
                Err(Box::new(record))
            }
        }
    }

    /// One step; false: there is none to make any more.
    pub(super) fn step(&mut self) -> bool {
        if self.failure.is_some() || self.until.is_met(&self.sim, self.steps) {
            return false;
        }
        if let Err(error) = self.sim.step() {
            self.failure = Some(error.to_string());
            return false;
        }
        if self.sim.passage_steps() == 0 && !self.sim.metrics().converged {
            self.record.start_up_not_converged += 1;
        }
        true
    }

    /// What it leaves.
    pub(super) fn end(self) -> (CaseRecord, Option<State>) {
        let (sim, mut record) = (self.sim, self.record);
        if sim.passage_steps() > 0 {
            record.summary = sim.summary();
            record.lambda_ratio = sim.metrics().lambda_ratio;
        }
        let unconverged = record.start_up_not_converged + record.summary.steps_not_converged;
        let is_awaited = self.failure.is_none() && matches!(self.until, Until::Settled(_));
        if is_awaited && !has_settled(&sim) {
            record.failure = Some("the average of the life has not settled".to_owned());
        }
        record.end = match (&self.failure, unconverged) {
            (Some(_), _) => CaseEnd::Stalled,
            (None, 0) if record.failure.is_none() => CaseEnd::Converged,
            (None, _) => CaseEnd::NotConverged,
        };
        record.summary.converged = record.end == CaseEnd::Converged;
        // A neighbour in trouble is no start: the next case begins cold.
        let state = (record.end == CaseEnd::Converged).then(|| sim.save());
        record.failure = self.failure.or(record.failure);
        record.seconds = self.started.elapsed_s();
        (record, state)
    }
}

fn begin(
    scene: &Scene,
    plan: &Plan,
    neighbour: Option<&State>,
    threads: usize,
) -> Result<(Simulation, CaseStart), SimError> {
    let mut sim = Simulation::new(scene, plan.clone(), threads)?;
    let Some(neighbour) = neighbour else {
        return Ok((sim, CaseStart::Cold));
    };
    sim.follow(neighbour)?;
    Ok((sim, CaseStart::Warm))
}

fn blank(index: usize, plan: &Plan) -> CaseRecord {
    let film = plan.film.as_ref();
    CaseRecord {
        index,
        began: CaseStart::Cold,
        end: CaseEnd::Converged,
        failure: None,
        seconds: 0.0,
        summary: Summary::default(),
        lambda_ratio: None,
        h_regression_m: film.map(|film| match film.others {
            OtherFilms::HamrockDowson { central_m, .. } => central_m,
            OtherFilms::DowsonHigginson { .. } => film.central_m,
        }),
        h_min_regression_m: film.map(|film| match film.others {
            OtherFilms::HamrockDowson { minimum_m, .. }
            | OtherFilms::DowsonHigginson { minimum_m } => minimum_m,
        }),
        start_up_not_converged: 0,
    }
}
