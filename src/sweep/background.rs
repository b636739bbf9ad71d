//! Lives at other S, or friction at other speeds, computed beside a run that has settled: the cases of a sweep
//! ([`super::case`]), started from the run instead of from a file.
//!
//! ```text
//! state of the run ──> case at the nearest S ──> case at the next S ──> ...        upwards and downwards at once
//! ```
//! A case follows the one before where a sweep's would (S and amplitudes alone differ), else it starts cold: the
//! speeds always do. Dropping the [`Background`] ends its workers after their present step.

use std::collections::VecDeque;
use std::sync::atomic::{AtomicBool, AtomicUsize, Ordering};
use std::sync::mpsc::{Receiver, Sender, channel};
use std::sync::{Arc, Mutex, PoisonError};

use super::case::{self, CaseEnd, CaseRecord, CaseStart, Ran, Watch};
use super::run::case_of;
use super::spec::ChainKeys;
use crate::plan::Plan;
use crate::scene::Scene;
use crate::sim::State;

/// Passages as a sweep's; workers go on as far as there are values.
const CHAIN: ChainKeys = ChainKeys {
    longest: usize::MAX,
    passages: None,
};

/// Times its passages after which a life that has not settled is given up.
const MOST: u64 = 6;

/// What varies.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum Along {
    /// S.
    #[default]
    SlideRoll,
    /// The entrainment speed, m/s.
    Entrainment,
}

impl Along {
    /// The value of a scene.
    pub fn of(self, scene: &Scene) -> f64 {
        match self {
            Self::SlideRoll => scene.motion.slide_roll,
            Self::Entrainment => scene.motion.entrainment_m_s,
        }
    }

    fn put(self, scene: &mut Scene, value: f64) {
        match self {
            Self::SlideRoll => scene.motion.slide_roll = value,
            Self::Entrainment => scene.motion.entrainment_m_s = value,
        }
    }
}

/// What to compute.
#[derive(Debug, Clone, PartialEq)]
pub struct CurveOrder {
    /// What varies.
    pub along: Along,
    /// Its values, in any order.
    pub values: Vec<f64>,
    /// All else: the scene with its knobs where they are now.
    pub scene: Scene,
}

/// What it stands on.
#[derive(Debug, Clone)]
pub struct Ground {
    /// The scene that the run was made of.
    pub scene: Arc<Scene>,
    /// A state of its passage.
    pub state: State,
}

/// Where a life, a friction coefficient belongs.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct CurvePoint {
    /// S.
    pub slide_roll: f64,
    /// Entrainment speed, m/s.
    pub entrainment_m_s: f64,
    /// Load, N; of a line N/m.
    pub load_n: f64,
    /// Amplitudes of both bodies' roughness, m.
    pub amplitude_m: [f64; 2],
}

/// What was found there: means over a case's last period, settled as the run's own.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Found {
    /// Where.
    pub at: CurvePoint,
    /// From Hertz, or from a neighbour.
    pub began: CaseStart,
    /// Relative life with its band: low, value, high. `None`: the scene computes none.
    pub life: Option<[f64; 3]>,
    /// Friction coefficient.
    pub friction: f64,
    /// λ: smooth central film by formula over the composite roughness; `None` for smooth surfaces.
    pub lambda: Option<f64>,
}

/// A sweep beside a run.
#[derive(Debug)]
pub struct Background {
    stop: Arc<AtomicBool>,
    found: Receiver<Found>,
    /// Values done, with and without a result. Each worker holds it too.
    done: Arc<AtomicUsize>,
    all: usize,
}

impl Background {
    /// Starts `workers` threads; values next to the run's own come first.
    pub fn start(ground: Ground, order: CurveOrder, workers: usize) -> Self {
        let CurveOrder {
            along,
            mut values,
            scene,
        } = order;
        let near = along.of(&scene);
        values.sort_by(|one, two| (one - near).abs().total_cmp(&(two - near).abs()));
        let all = values.len();
        let stop = Arc::new(AtomicBool::new(false));
        let done = Arc::new(AtomicUsize::new(0));
        let (sender, found) = channel();
        let (up, down) = values.into_iter().partition(|value| *value >= near);
        let shared = Arc::new(SharedWork {
            along,
            scene,
            ground,
            sides: Mutex::new([up, down]),
        });
        for worker in 0..workers.max(1) {
            let worker = SweepWorker {
                work: Arc::clone(&shared),
                side: worker % 2,
                stop: Arc::clone(&stop),
                done: Arc::clone(&done),
                found: sender.clone(),
            };
            // Without a thread those values stay open; nothing else is lost.
            let _ = std::thread::Builder::new()
                .name("sweep".to_owned())
                .spawn(move || worker.work());
        }
        Self {
            stop,
            found,
            done,
            all,
        }
    }

    /// What is new since the last call.
    pub fn take(&self) -> Vec<Found> {
        self.found.try_iter().collect()
    }

    /// Values done and values in all; `None` once no worker is left.
    pub fn progress(&self) -> Option<(usize, usize)> {
        let works = Arc::strong_count(&self.done) > 1;
        works.then(|| (self.done.load(Ordering::Relaxed), self.all))
    }

    /// Ends it after the present steps.
    pub fn call_off(&self) {
        self.stop.store(true, Ordering::Relaxed);
    }
}

impl Drop for Background {
    fn drop(&mut self) {
        self.call_off();
    }
}

/// Values above and below the one that it begins at, the nearest first.
type Sides = [VecDeque<f64>; 2];

/// The next value for a worker at home on `side`: neighbours stay near as long as there are values on it.
fn take_next(sides: &mut Sides, side: usize) -> Option<f64> {
    let other = 1 - side;
    sides[side].pop_front().or_else(|| sides[other].pop_front())
}

/// What the workers share.
struct SharedWork {
    along: Along,
    scene: Scene,
    ground: Ground,
    sides: Mutex<Sides>,
}

struct SweepWorker {
    work: Arc<SharedWork>,
    side: usize,
    stop: Arc<AtomicBool>,
    done: Arc<AtomicUsize>,
    found: Sender<Found>,
}

struct StopFlag<'a>(&'a AtomicBool);

impl Watch for StopFlag<'_> {
    fn step(&mut self, _done: f64) -> bool {
        !self.0.load(Ordering::Relaxed)
    }
}

impl SweepWorker {
    fn work(self) {
        let ground = &self.work.ground;
        let begin = || {
            let (scene, _) = case_of((*ground.scene).clone(), CHAIN).ok()?;
            Some((scene, ground.state.clone()))
        };
        let mut before = begin();
        while let Some(value) = self.next() {
            let mut scene = self.work.scene.clone();
            self.work.along.put(&mut scene, value);
            // What is no scene has no life; the next value may be one.
            if let Ok((scene, plan)) = case_of(scene, CHAIN) {
                let Some((record, state)) = self.case(before.as_ref(), &scene, &plan) else {
                    return;
                };
                let converged = record.end == CaseEnd::Converged;
                if converged && self.found.send(found(&scene, &record)).is_err() {
                    return;
                }
                // A case in trouble is no start; the run itself is one.
                before = state.map(|state| (scene, state)).or_else(begin);
            }
            self.done.fetch_add(1, Ordering::Relaxed);
        }
    }

    fn case(&self, before: Option<&(Scene, State)>, scene: &Scene, plan: &Plan) -> Ran {
        let until = case::Until::Settled(MOST);
        let run = |before| case::after(before, 0, scene, plan, until, 1, &mut StopFlag(&self.stop));
        match run(before) {
            // A live run's grid need not be that of a scene with its knobs turned.
            Some((record, _)) if record.end == CaseEnd::Stalled && before.is_some() => run(None),
            ran => ran,
        }
    }

    fn next(&self) -> Option<f64> {
        let sides = self.work.sides.lock();
        take_next(
            &mut sides.unwrap_or_else(PoisonError::into_inner),
            self.side,
        )
    }
}

fn found(scene: &Scene, record: &CaseRecord) -> Found {
    let summary = &record.summary;
    let band = summary.life_relative_low.zip(summary.life_relative_high);
    Found {
        at: CurvePoint {
            slide_roll: scene.motion.slide_roll,
            entrainment_m_s: scene.motion.entrainment_m_s,
            load_n: summary.load_n,
            amplitude_m: [&scene.body_1, &scene.body_2].map(|body| body.surface.amplitude_m()),
        },
        began: record.began,
        life: summary
            .life_relative
            .zip(band)
            .map(|(life, (low, high))| [low, life, high]),
        friction: summary.friction_coefficient,
        lambda: record.lambda_ratio,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn each_side_goes_outwards_and_helps_the_other() {
        let mut sides: Sides = [[0.5, 0.75].into(), [0.25, 0.0, -0.25].into()];
        let taken = [0, 1, 0, 0, 1, 1].map(|side| take_next(&mut sides, side));
        assert_eq!(
            taken,
            [
                Some(0.5),
                Some(0.25),
                Some(0.75),
                Some(0.0),
                Some(-0.25),
                None
            ]
        );
    }
}
