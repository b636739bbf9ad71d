//! A run on a thread of its own.

use std::ops::Deref;
use std::thread::JoinHandle;

use thiserror::Error;

use super::Command;
use super::checkpoint::Checkpoint;
use super::driver::{Done, MakeStep};
use super::near_end::{NearEnd, wired};
use super::outcome::{AppliedCommand, Outcome};
use super::replay::HandTurn;
use super::request::{Request, context_of};
use asperity_engine::observe::{Began, SetBy};
use asperity_engine::scene::Scene;
use asperity_engine::sim::{SimError, Simulation, StepError};

/// A session that could not be started or came to grief.
#[derive(Debug, Clone, Error)]
pub enum RunError {
    /// No thread.
    #[error("the simulation's thread could not be started: {0}")]
    NoThread(String),
    /// A programming error.
    #[error(
        "the simulation broke off by a programming error: {0}; what was recorded before is kept"
    )]
    Panicked(String),
}

/// What a run begins with.
#[derive(Default)]
struct Start {
    /// What had been done before.
    done: Done,
    began: Began,
    turns: Vec<(u64, Command)>,
    /// What makes a step, where it is not the simulation itself.
    make_step: Option<MakeStep>,
}

/// A running session.
#[derive(Debug)]
pub struct Session {
    near: NearEnd,
    thread: JoinHandle<Outcome>,
}

impl Session {
    /// Starts the scene's simulation on its own thread.
    ///
    /// # Errors
    /// [`RunError::NoThread`] when the system gives no thread.
    pub fn start(request: Request) -> Result<Self, RunError> {
        let threads = request.threads;
        let plan = request.plan.clone();
        Self::spawn(request, Start::default(), move |scene| {
            Simulation::new(scene, plan, threads)
        })
    }

    /// Same, going on from a saved state. A state that does not fit ends the run before it starts
    /// ([`super::End::NotStarted`]).
    ///
    /// # Errors
    /// [`RunError::NoThread`] when the system gives no thread.
    pub fn resume(request: Request, checkpoint: Checkpoint) -> Result<Self, RunError> {
        let threads = request.threads;
        let plan = request.plan.clone();
        let done = Done {
            events_played: checkpoint.n_events_played,
            turned_by_hand: checkpoint.n_turned_by_hand,
            unconverged: checkpoint.n_unconverged,
        };
        let start = Start {
            done,
            began: Began::FromState,
            ..Start::default()
        };
        Self::spawn(request, start, move |scene| {
            checkpoint
                .fits(scene)
                .map_err(|error| SimError::State(error.to_string()))?;
            let mut sim = Simulation::new(scene, plan, threads)?;
            sim.restore(&checkpoint.sim)?;
            sim.count_from(checkpoint.stats)?;
            Ok(sim)
        })
    }

    /// Same with a simulation made otherwise, on the thread that will own it, and steps made by `make_step`: how tests
    /// put in what fails.
    ///
    /// # Errors
    /// [`RunError::NoThread`] when the system gives no thread.
    pub fn start_with(
        request: Request,
        make: impl FnOnce(&Scene) -> Result<Simulation, SimError> + Send + 'static,
        make_step: impl FnMut(&mut Simulation) -> Result<(), StepError> + Send + 'static,
    ) -> Result<Self, RunError> {
        let start = Start {
            make_step: Some(Box::new(make_step)),
            ..Start::default()
        };
        Self::spawn(request, start, make)
    }

    /// Same as [`Session::start`], turning the knobs as they were turned in another run of the same scene.
    ///
    /// # Errors
    /// [`RunError::NoThread`] when the system gives no thread.
    pub fn repeat(request: Request, turns: Vec<HandTurn>) -> Result<Self, RunError> {
        let turn = |turn: HandTurn| (turn.steps_made, Command::Set(turn.knob, turn.value));
        Self::redo(request, turns.into_iter().map(turn).collect())
    }

    /// Same from a session's own log ([`Outcome::applied`]): what was done by hand is done again at the same
    /// steps, what the scene's script did the scene does itself. Every frame is the same, bit for bit.
    ///
    /// # Errors
    /// [`RunError::NoThread`] when the system gives no thread.
    pub fn replay(request: Request, log: &[AppliedCommand]) -> Result<Self, RunError> {
        let by_hand = log.iter().filter(|entry| entry.by == SetBy::Hand);
        let commands = by_hand.map(|entry| (entry.steps_made, entry.command.clone()));
        Self::redo(request, commands.collect())
    }

    fn redo(request: Request, turns: Vec<(u64, Command)>) -> Result<Self, RunError> {
        let threads = request.threads;
        let plan = request.plan.clone();
        let start = Start {
            turns,
            ..Start::default()
        };
        Self::spawn(request, start, move |scene| {
            Simulation::new(scene, plan, threads)
        })
    }

    fn spawn(
        request: Request,
        start: Start,
        make: impl FnOnce(&Scene) -> Result<Simulation, SimError> + Send + 'static,
    ) -> Result<Self, RunError> {
        let context = context_of(&request, start.began);
        let name = request.name.clone();
        let (driver, near) = wired(request);
        let mut driver = driver.after(start.done).repeating(start.turns);
        if let Some(make_step) = start.make_step {
            driver = driver.stepping_by(make_step);
        }
        let thread = std::thread::Builder::new()
            .name("sim".to_owned())
            .spawn(move || driver.run(&context, &name, make))
            .map_err(|error| RunError::NoThread(error.to_string()))?;
        Ok(Self { near, thread })
    }

    /// Whether the run has ended, so that `join` returns at once.
    pub fn is_finished(&self) -> bool {
        self.thread.is_finished()
    }

    /// Waits for the end.
    ///
    /// # Errors
    /// [`RunError::Panicked`] when the thread broke off.
    pub fn join(self) -> Result<Outcome, RunError> {
        self.thread.join().map_err(|cause| {
            let text = cause
                .downcast_ref::<String>()
                .cloned()
                .or_else(|| cause.downcast_ref::<&str>().map(|text| (*text).to_owned()));
            RunError::Panicked(text.unwrap_or_else(|| "no message".to_owned()))
        })
    }
}

impl Deref for Session {
    type Target = NearEnd;

    fn deref(&self) -> &NearEnd {
        &self.near
    }
}
