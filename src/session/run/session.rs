//! A run on a thread of its own.

use std::thread::JoinHandle;

use thiserror::Error;

use super::checkpoint::Checkpoint;
use super::climbing::ladder_of;
use super::command::HandTurn;
use super::driver::{Driver, Start};
use super::handle::{RunHandle, wired};
use super::outcome::Outcome;
use super::request::Request;
use asperity_engine::observe::Began;
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

/// A running session.
#[derive(Debug)]
pub struct Session {
    /// Where it is commanded and watched.
    pub handle: RunHandle,
    thread: JoinHandle<Outcome>,
}

impl Session {
    /// Starts the scene's simulation on its own thread.
    ///
    /// # Errors
    /// [`RunError::NoThread`] when the system gives no thread.
    pub fn start(request: Request) -> Result<Self, RunError> {
        Self::repeat(request, Vec::new())
    }

    /// Same, going on from a saved state. A state that does not fit ends the run before it starts
    /// ([`super::End::NotStarted`]).
    ///
    /// # Errors
    /// [`RunError::NoThread`] when the system gives no thread.
    pub fn resume(request: Request, checkpoint: Checkpoint) -> Result<Self, RunError> {
        let threads = request.threads;
        let plan = request.plan.clone();
        let start = Start {
            began: Began::FromState,
            n_events_played: checkpoint.n_events_played,
            n_turned_by_hand: checkpoint.n_turned_by_hand,
            n_unconverged: checkpoint.n_unconverged,
            ladder: ladder_of(&request.scene, &plan).filter(|_| checkpoint.climb.nodes != 0),
            climb: checkpoint.climb.clone(),
            ..Start::default()
        };
        let nodes = checkpoint.climb.nodes;
        let ladder = start.ladder.clone();
        Self::spawn(request, start, move |scene| {
            checkpoint
                .fits(scene)
                .map_err(|error| SimError::State(error.to_string()))?;
            let mesh = match &ladder {
                Some(ladder) => Some(ladder.mesh(nodes).ok_or_else(no_such_mesh)?.0),
                None => None,
            };
            let mut sim = match mesh {
                Some(mesh) => Simulation::new(&mesh.scene, mesh.plan.clone(), threads)?,
                None => Simulation::new(scene, plan, threads)?,
            };
            if !checkpoint.is_on_top(scene) {
                sim.hand_on();
            }
            sim.restore(&checkpoint.sim)?;
            if let Some(launch) = &checkpoint.climb.launch {
                sim.check(launch)?;
            }
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

    /// Same as [`Session::start`], doing what was done by hand in another run of the same scene at the same steps: every
    /// frame is the same, bit for bit. What the scene's script did the scene does itself.
    ///
    /// # Errors
    /// [`RunError::NoThread`] when the system gives no thread.
    pub fn repeat(request: Request, turns: Vec<HandTurn>) -> Result<Self, RunError> {
        let threads = request.threads;
        let plan = request.plan.clone();
        let start = Start {
            turns,
            ladder: ladder_of(&request.scene, &plan),
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
        let (handle, end) = wired();
        let driver = Driver::new(request, start, end);
        let thread = std::thread::Builder::new()
            .name("sim".to_owned())
            .spawn(move || driver.run(make))
            .map_err(|error| RunError::NoThread(error.to_string()))?;
        Ok(Self { handle, thread })
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

fn no_such_mesh() -> SimError {
    SimError::State("the run climbs no mesh of its nodes".to_owned())
}
