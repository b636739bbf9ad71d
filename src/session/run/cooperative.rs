//! A run whose owner makes its turns, where there are no threads: in a page. The loop is that of [`super::Session`], so
//! that every frame is the same.

use std::sync::Arc;

use super::climbing::ladder_of;
use super::driver::{Driver, Leg, LoopTurn, PausedWait, Start};
use super::handle::{RunHandle, wired};
use super::ladder::Ladder;
use super::outcome::End;
use super::request::Request;
use asperity_engine::sim::{SimError, Simulation, Stats};

/// A run that steps when it is told to.
pub struct Cooperative {
    /// Where it is commanded and watched.
    pub handle: RunHandle,
    driver: Driver,
    /// `None`: a finer mesh could not be made, and the run has ended.
    sim: Option<Simulation>,
    ladder: Option<Arc<Ladder>>,
    has_ended: bool,
}

impl Cooperative {
    /// Makes the scene's simulation; its outputs begin.
    ///
    /// # Errors
    /// When the simulation cannot be made.
    pub fn start(request: Request) -> Result<Self, SimError> {
        let (handle, end) = wired();
        let ladder = ladder_of(&request.scene, &request.plan);
        let start = Start {
            ladder: ladder.clone(),
            ..Start::default()
        };
        let (scene, plan, threads) = (
            Arc::clone(&request.scene),
            request.plan.clone(),
            request.threads,
        );
        let mut driver = Driver::new(request, start, end);
        let sim = match &ladder {
            Some(ladder) => driver.first_mesh(ladder)?,
            None => Simulation::new(&scene, plan, threads)?,
        };
        driver.begin_outputs();
        Ok(Self {
            handle,
            driver,
            sim: Some(sim),
            ladder,
            has_ended: false,
        })
    }

    /// Commands, then one step unless it is paused or has ended; or the way to another mesh.
    pub fn turn(&mut self) -> LoopTurn {
        let Some(sim) = self.sim.as_mut().filter(|_| !self.has_ended) else {
            return LoopTurn::Waited;
        };
        let leg = match self.driver.turn(sim, PausedWait::Never) {
            LoopTurn::Stepped => return LoopTurn::Stepped,
            LoopTurn::Waited => return LoopTurn::Waited,
            LoopTurn::Up => Leg::Up,
            LoopTurn::Down => Leg::Down,
            LoopTurn::Ended(end) => Leg::Ended(end),
        };
        match self.change(leg) {
            None => LoopTurn::Stepped,
            Some(end) => {
                self.has_ended = true;
                self.driver.publish_failure(&end);
                LoopTurn::Ended(end)
            }
        }
    }

    /// Goes to another mesh; `Some`: the run has ended.
    fn change(&mut self, leg: Leg) -> Option<End> {
        let Some(ladder) = self.ladder.clone() else {
            return match leg {
                Leg::Ended(end) => Some(end),
                // There is no other.
                Leg::Up | Leg::Down => None,
            };
        };
        let sim = self.sim.take()?;
        match self.driver.change(&ladder, sim, leg) {
            Ok(sim) => {
                self.sim = Some(sim);
                None
            }
            Err(ended) => {
                let (end, sim) = *ended;
                self.sim = sim;
                Some(end)
            }
        }
    }

    /// Work done so far.
    pub fn stats(&self) -> Stats {
        self.sim
            .as_ref()
            .map_or(Stats::default(), |sim| *sim.stats())
    }
}
