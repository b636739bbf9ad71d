//! A run whose owner makes its turns, where there are no threads: in a page. The loop is that of [`super::Session`], so
//! that every frame is the same.

use std::ops::Deref;

use super::driver::{Driver, LoopTurn, PausedWait};
use super::near_end::{NearEnd, wired};
use super::request::{Request, context_of};
use asperity_engine::observe::Began;
use asperity_engine::sim::{SimError, Simulation};

/// A run that steps when it is told to.
pub struct Cooperative {
    near: NearEnd,
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
        let context = context_of(&request, Began::FromScene);
        let (mut driver, near) = wired(request);
        driver.begin_outputs(&context);
        Ok(Self {
            near,
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
            self.driver.tell_failure(end);
        }
        turn
    }

    /// The simulation, between two turns.
    pub fn sim(&self) -> &Simulation {
        &self.sim
    }
}

impl Deref for Cooperative {
    type Target = NearEnd;

    fn deref(&self) -> &NearEnd {
        &self.near
    }
}
