//! A run whose owner makes its turns, where there are no threads: in a page. The loop is that of [`super::Session`], so
//! that every frame is the same.

use super::driver::{Driver, LoopTurn, PausedWait, Start};
use super::handle::{RunHandle, wired};
use super::request::Request;
use asperity_engine::sim::{SimError, Simulation};

/// A run that steps when it is told to.
pub struct Cooperative {
    /// Where it is commanded and watched.
    pub handle: RunHandle,
    driver: Driver,
    sim: Simulation,
    has_ended: bool,
}

impl Cooperative {
    /// Makes the scene's simulation; its outputs begin.
    ///
    /// # Errors
    /// When the simulation cannot be made.
    pub fn start(request: Request) -> Result<Self, SimError> {
        let sim = Simulation::new(&request.scene, request.plan.clone(), request.threads)?;
        let (handle, end) = wired();
        let mut driver = Driver::new(request, Start::default(), end);
        driver.begin_outputs();
        Ok(Self {
            handle,
            driver,
            sim,
            has_ended: false,
        })
    }

    /// Commands, then one step unless it is paused or has ended.
    pub fn turn(&mut self) -> LoopTurn {
        if self.has_ended {
            return LoopTurn::Waited;
        }
        let turn = self.driver.turn(&mut self.sim, PausedWait::Never);
        if let LoopTurn::Ended(end) = &turn {
            self.has_ended = true;
            self.driver.publish_failure(end);
        }
        turn
    }

    /// The simulation, between two turns.
    pub fn sim(&self) -> &Simulation {
        &self.sim
    }
}
