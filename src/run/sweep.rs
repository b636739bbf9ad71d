//! Life at other S, computed beside a run that has settled.
//!
//! ```text
//! state of the run ──> a simulation of one thread per worker ──> S moves to the next value (a physical ramp)
//!                      flushed (4 a) ──> means over a window ──> SweepPoint
//! ```
//! Each worker goes on from where it was, so the next value starts warm. Values near the run's own S come
//! first. Dropping the [`Sweep`] ends the workers after their present step.

use std::collections::VecDeque;
use std::sync::atomic::{AtomicBool, AtomicUsize, Ordering};
use std::sync::mpsc::{Receiver, Sender, channel};
use std::sync::{Arc, Mutex, PoisonError};

use thiserror::Error;

use crate::plan::Plan;
use crate::scene::Scene;
use crate::sim::{Knob, LifeEstimate, SimError, Simulation, State, StepError};

/// Longest wait for a life to settle after S has arrived, in passages of 4 a.
const PATIENCE: f64 = 4.0;
/// Passages of 4 a after which the contact has forgotten the ramp.
const FLUSHED: f64 = 1.0;

/// What a sweep stands on.
#[derive(Debug, Clone)]
pub struct Ground {
    /// The scene of the run.
    pub scene: Arc<Scene>,
    /// Its plan.
    pub plan: Plan,
    /// A state of the run to start from, with the knobs as they are.
    pub state: State,
}

/// Life at one S.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct SweepPoint {
    /// S.
    pub slide_roll: f64,
    /// Life with its band.
    pub life: LifeEstimate,
    /// Friction coefficient, mean over the last passage.
    pub friction: f64,
}

/// Why there is no life at an S.
#[derive(Debug, Clone, Error)]
pub enum NotSettled {
    /// The simulation could not be made, or the value is out of range.
    #[error(transparent)]
    Sim(#[from] SimError),
    /// A step failed.
    #[error(transparent)]
    Step(#[from] StepError),
    /// It was called off.
    #[error("called off")]
    Stopped,
    /// The life did not settle, or the scene computes none.
    #[error("no settled life at S = {0}")]
    NoLife(f64),
}

/// Life of `sim` at another S: S moves there as a knob does, the contact is flushed, and the life is taken
/// once it has settled. `stop` calls it off between two steps.
///
/// # Errors
/// [`NotSettled`] says why there is none.
pub fn life_at(
    sim: &mut Simulation,
    plan: &Plan,
    slide_roll: f64,
    stop: &AtomicBool,
) -> Result<SweepPoint, NotSettled> {
    sim.set(Knob::SlideRoll, slide_roll)?;
    let passage_s = |sim: &Simulation| {
        plan.passage_a * plan.hertz.a_m / sim.metrics().entrainment_m_s.abs().max(1e-12)
    };
    let (mut arrived_s, mut friction, mut n) = (None, 0.0, 0.0);
    loop {
        if stop.load(Ordering::Relaxed) {
            return Err(NotSettled::Stopped);
        }
        sim.step()?;
        let metrics = sim.metrics();
        if metrics.slide_roll != slide_roll {
            continue;
        }
        let since = sim.time_s() - *arrived_s.get_or_insert(sim.time_s());
        let passages = since / passage_s(sim);
        if passages < FLUSHED {
            continue;
        }
        (friction, n) = (friction + metrics.friction_coefficient, n + 1.0);
        let settled = metrics.life.filter(|life| life.settled);
        // A window of means after the ramp was forgotten.
        if let Some(life) = settled.filter(|_| passages >= 2.0 * FLUSHED) {
            return Ok(SweepPoint {
                slide_roll,
                life,
                friction: friction / n,
            });
        }
        if passages > PATIENCE {
            return Err(NotSettled::NoLife(slide_roll));
        }
    }
}

/// A sweep under way.
#[derive(Debug)]
pub struct Sweep {
    stop: Arc<AtomicBool>,
    points: Receiver<SweepPoint>,
    /// Values done, with and without a life.
    done: Arc<AtomicUsize>,
    all: usize,
}

impl Sweep {
    /// Starts `workers` threads on `values` of S; those nearest to the state's own S come first.
    pub fn start(ground: Ground, mut values: Vec<f64>, near: f64, workers: usize) -> Self {
        values.sort_by(|one, two| (one - near).abs().total_cmp(&(two - near).abs()));
        let all = values.len();
        let stop = Arc::new(AtomicBool::new(false));
        let done = Arc::new(AtomicUsize::new(0));
        let (sender, points) = channel();
        let ground = Arc::new(ground);
        let (up, down) = values.into_iter().partition(|s| *s >= near);
        let values = Arc::new(Mutex::new([up, down]));
        for worker in 0..workers.max(1) {
            let worker = Worker {
                ground: Arc::clone(&ground),
                values: Arc::clone(&values),
                side: worker % 2,
                stop: Arc::clone(&stop),
                done: Arc::clone(&done),
                points: sender.clone(),
            };
            // Without a thread those values stay open; nothing else is lost.
            let _ = std::thread::Builder::new()
                .name("sweep".to_owned())
                .spawn(move || worker.work());
        }
        Self {
            stop,
            points,
            done,
            all,
        }
    }

    /// Points that are new since the last call.
    pub fn take(&self) -> Vec<SweepPoint> {
        self.points.try_iter().collect()
    }

    /// Values done and values in all.
    pub fn progress(&self) -> (usize, usize) {
        (self.done.load(Ordering::Relaxed), self.all)
    }
}

impl Drop for Sweep {
    fn drop(&mut self) {
        self.stop.store(true, Ordering::Relaxed);
    }
}

/// Values above and below the S that the sweep begins at, the nearest first.
type Sides = [VecDeque<f64>; 2];

/// The next value for a worker at home on `side`: ramps stay short as long as there are values on it.
fn take_next(sides: &mut Sides, side: usize) -> Option<f64> {
    let other = 1 - side;
    sides[side].pop_front().or_else(|| sides[other].pop_front())
}

struct Worker {
    ground: Arc<Ground>,
    values: Arc<Mutex<Sides>>,
    side: usize,
    stop: Arc<AtomicBool>,
    done: Arc<AtomicUsize>,
    points: Sender<SweepPoint>,
}

impl Worker {
    fn work(self) {
        let Ground { scene, plan, state } = &*self.ground;
        let Ok(mut sim) = Simulation::new(scene, plan.clone(), 1) else {
            return;
        };
        if sim.restore(state.clone()).is_err() {
            return;
        }
        while let Some(value) = self.next() {
            match life_at(&mut sim, plan, value, &self.stop) {
                Ok(point) => {
                    if self.points.send(point).is_err() {
                        return;
                    }
                }
                Err(NotSettled::Stopped) => return,
                // This S has no life; the next one starts from the last good state.
                Err(_) => {
                    if sim.restore(state.clone()).is_err() {
                        return;
                    }
                }
            }
            self.done.fetch_add(1, Ordering::Relaxed);
        }
    }

    fn next(&self) -> Option<f64> {
        let mut sides = self.values.lock().unwrap_or_else(PoisonError::into_inner);
        take_next(&mut sides, self.side)
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
