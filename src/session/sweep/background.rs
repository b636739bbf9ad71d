//! Lives at other S, friction at other speeds, lives with what a scene must assume assumed otherwise, computed beside a run that has settled: the cases of a sweep
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

use super::case::{Case, CaseEnd, CaseRecord, CaseStart, Neighbour, RunningCase, Until};
use super::spec::ChainKeys;
use crate::run::{Assumed, Hold, Settled};
use asperity_engine::scene::{CycleBasis, Scene};
use asperity_engine::sim::State;

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

/// What a sweep varies.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Varied {
    /// What a curve is drawn along.
    Along(Along),
    /// A choice by its number, 0 the scene's own.
    Assumed(Assumed),
}

impl Varied {
    fn of(self, scene: &Scene) -> f64 {
        match self {
            Self::Along(along) => along.of(scene),
            Self::Assumed(_) => 0.0,
        }
    }

    fn put(self, scene: &mut Scene, value: f64) {
        match self {
            Self::Along(along) => along.put(scene, value),
            Self::Assumed(what) => what.choose(self.choice(value), scene),
        }
    }

    fn choice(self, value: f64) -> usize {
        match self {
            Self::Along(_) => 0,
            Self::Assumed(_) => value as usize,
        }
    }
}

/// What to compute.
#[derive(Debug, Clone, PartialEq)]
pub struct CurveOrder {
    /// What varies.
    pub varied: Varied,
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

impl Ground {
    /// The first mesh of a run of `scene` that has settled, where it has one; else its own.
    pub fn of(scene: &Arc<Scene>, settled: &Settled) -> Option<Self> {
        if let Some((scene, state)) = settled.ground.clone() {
            return Some(Self { scene, state });
        }
        Some(Self {
            scene: Arc::clone(scene),
            state: settled.state.clone()?,
        })
    }

    /// Another scene on the mesh of this one.
    fn carry(&self, scene: &mut Scene) {
        scene.grid.clone_from(&self.scene.grid);
        scene.time.tolerance = self.scene.time.tolerance;
        scene.numerics.order = self.scene.numerics.order;
    }

    /// Where a case may start from; `None` where the scene is none.
    fn start(&self) -> Option<Neighbour> {
        let case = Case::new(0, (*self.scene).clone(), CHAIN).ok()?;
        Some(Neighbour {
            scene: case.scene,
            state: self.state.clone(),
        })
    }
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
    /// Which choice of what is assumed; 0: the scene's own.
    pub choice: usize,
    /// From Hertz, or from a neighbour.
    pub began: CaseStart,
    /// Relative life with its band: low, value, high. `None`: the scene computes none.
    pub life: Option<[f64; 3]>,
    /// The same by the count that is not the scene's: the paper's, or by damage.
    pub other: Option<f64>,
    /// Life of the smooth contact there, which lives at different loads are compared by
    /// ([`asperity_engine::sim::Summary::life_smooth`]); `None`: not known.
    pub smooth: Option<f64>,
    /// Friction coefficient.
    pub friction: f64,
    /// λ: smooth central film by formula over the composite roughness; `None` for smooth surfaces.
    pub lambda: Option<f64>,
}

/// A sweep beside a run.
#[derive(Debug)]
pub struct Background {
    /// Each worker holds it too.
    work: Arc<SharedWork>,
    found: Receiver<Found>,
    all: usize,
}

impl Background {
    /// Starts `workers` threads, which keep the `hold` as long as they work; values next to the run's own come first.
    pub fn start(ground: Ground, order: CurveOrder, workers: usize, hold: Option<&Hold>) -> Self {
        let (this, workers) = Self::manned(ground, order, workers.max(1));
        for mut worker in workers {
            let hold = hold.cloned();
            // Without a thread those values stay open; nothing else is lost.
            let _ = std::thread::Builder::new()
                .name("sweep".to_owned())
                .spawn(move || {
                    while worker.turn() {}
                    drop(hold);
                });
        }
        this
    }

    /// Same where there are no threads: with one worker, whose turns its owner makes.
    pub fn cooperative(ground: Ground, order: CurveOrder) -> (Self, Option<SweepWorker>) {
        let (this, mut workers) = Self::manned(ground, order, 1);
        (this, workers.pop())
    }

    fn manned(ground: Ground, order: CurveOrder, workers: usize) -> (Self, Vec<SweepWorker>) {
        let CurveOrder {
            varied,
            mut values,
            mut scene,
        } = order;
        ground.carry(&mut scene);
        let near = varied.of(&scene);
        values.sort_by(|one, two| (one - near).abs().total_cmp(&(two - near).abs()));
        let all = values.len();
        let (sender, found) = channel();
        let (up, down) = values.into_iter().partition(|value| *value >= near);
        let work = Arc::new(SharedWork {
            varied,
            scene,
            ground,
            sides: Mutex::new([up, down]),
            stop: AtomicBool::new(false),
            done: AtomicUsize::new(0),
        });
        let worker = |place: usize| SweepWorker {
            work: Arc::clone(&work),
            side: place % 2,
            found: sender.clone(),
            last_side: None,
            before: None,
            under_way: None,
        };
        let workers = (0..workers).map(worker).collect();
        (Self { work, found, all }, workers)
    }

    /// What is new since the last call.
    pub fn take(&self) -> Vec<Found> {
        self.found.try_iter().collect()
    }

    /// Values done and values in all; `None` once no worker is left.
    pub fn progress(&self) -> Option<(usize, usize)> {
        let works = Arc::strong_count(&self.work) > 1;
        works.then(|| (self.work.done.load(Ordering::Relaxed), self.all))
    }

    /// Ends it after the present steps.
    pub fn call_off(&self) {
        self.work.stop.store(true, Ordering::Relaxed);
    }
}

impl Drop for Background {
    fn drop(&mut self) {
        self.call_off();
    }
}

/// Values above and below the one that it begins at, the nearest first.
type Sides = [VecDeque<f64>; 2];

/// The next value for a worker at home on `side`, and its side: neighbours stay near as long as there are values on it.
fn take_next(sides: &mut Sides, side: usize) -> Option<(usize, f64)> {
    let mut of = |side: usize| Some((side, sides[side].pop_front()?));
    of(side).or_else(|| of(1 - side))
}

/// What the workers share.
#[derive(Debug)]
struct SharedWork {
    varied: Varied,
    scene: Scene,
    ground: Ground,
    sides: Mutex<Sides>,
    stop: AtomicBool,
    /// Values done, with and without a result.
    done: AtomicUsize,
}

/// Works through the values of a sweep, one step of a case after another.
pub struct SweepWorker {
    work: Arc<SharedWork>,
    /// Where it is at home, and of which side its last value was.
    side: usize,
    last_side: Option<usize>,
    found: Sender<Found>,
    /// The run itself, or the case before.
    before: Option<Neighbour>,
    under_way: Option<ValueCase>,
}

/// The case of one value.
struct ValueCase {
    case: Case,
    choice: usize,
    running: RunningCase,
    /// Whether it is tried a second time, from Hertz.
    is_second: bool,
}

impl SweepWorker {
    /// One step, or the beginning of the next case; false once nothing is left to do, or nobody waits for it.
    pub fn turn(&mut self) -> bool {
        if self.work.stop.load(Ordering::Relaxed) {
            return false;
        }
        match self.under_way.take() {
            None => self.begin_next(),
            Some(mut value) => {
                if !value.running.step() {
                    return self.ended(value);
                }
                self.under_way = Some(value);
                true
            }
        }
    }

    fn begin_next(&mut self) -> bool {
        let Some((side, value)) = self.next() else {
            return false;
        };
        // Both sides begin at the run, however many workers there are.
        if self.last_side.replace(side) != Some(side) {
            self.before = self.work.ground.start();
        }
        let mut scene = self.work.scene.clone();
        self.work.varied.put(&mut scene, value);
        match Case::new(0, scene, CHAIN) {
            Ok(case) => self.begin(case, self.work.varied.choice(value), false),
            // What is no scene has no life; the next value may be one.
            Err(_) => drop(self.work.done.fetch_add(1, Ordering::Relaxed)),
        }
        true
    }

    fn begin(&mut self, case: Case, choice: usize, is_second: bool) {
        let before = self.before.as_ref().filter(|_| !is_second);
        self.under_way = Some(ValueCase {
            running: RunningCase::begin(&case, before, Until::Settled(MOST), 1),
            case,
            choice,
            is_second,
        });
    }

    fn ended(&mut self, value: ValueCase) -> bool {
        let (record, state) = value.running.end();
        // A live run's grid need not be that of a scene with its knobs turned.
        if record.end == CaseEnd::Stalled && self.before.is_some() && !value.is_second {
            self.begin(value.case, value.choice, true);
            return true;
        }
        let scene = value.case.scene;
        let converged = record.end == CaseEnd::Converged;
        if converged
            && self
                .found
                .send(found(&scene, &record, value.choice))
                .is_err()
        {
            return false;
        }
        // A case in trouble is no start; the run itself is one.
        let own = || self.work.ground.start();
        let next = state.map(|state| Neighbour { scene, state });
        self.before = next.or_else(own);
        self.work.done.fetch_add(1, Ordering::Relaxed);
        true
    }

    fn next(&self) -> Option<(usize, f64)> {
        let sides = self.work.sides.lock();
        take_next(
            &mut sides.unwrap_or_else(PoisonError::into_inner),
            self.side,
        )
    }
}

fn found(scene: &Scene, record: &CaseRecord, choice: usize) -> Found {
    let summary = &record.summary;
    let band = summary.life_relative_low.zip(summary.life_relative_high);
    Found {
        at: CurvePoint {
            slide_roll: scene.motion.slide_roll,
            entrainment_m_s: scene.motion.entrainment_m_s,
            load_n: summary.load_n,
            amplitude_m: [&scene.body_1, &scene.body_2].map(|body| body.surface.amplitude_m()),
        },
        choice,
        began: record.began,
        life: summary
            .life_relative
            .zip(band)
            .map(|(life, (low, high))| [low, life, high]),
        other: match scene.life.as_ref().map(|life| life.cycles) {
            Some(CycleBasis::Damage) => summary.life_global,
            Some(CycleBasis::Global | CycleBasis::Peaks) => summary.life_damage,
            None => None,
        },
        smooth: summary.life_smooth,
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
                Some((0, 0.5)),
                Some((1, 0.25)),
                Some((0, 0.75)),
                Some((1, 0.0)),
                Some((1, -0.25)),
                None
            ]
        );
    }
}
