//! How a run ended.

use super::checkpoint::Checkpoint;
use super::command::AppliedCommand;
use asperity_engine::observe::{ObserveError, ObserverReport};
use asperity_engine::sim::{SimError, StepError, Summary, Unsolved};

/// A step that did not converge but was kept.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Unconverged {
    /// Time step.
    pub step: u64,
    /// Simulated time, s.
    pub time_s: f64,
    /// What is left of its equations, and what was asked.
    pub unsolved: Unsolved,
    /// Deepest overlap of the surfaces, m.
    pub overlap_m: f64,
}

/// Why a run ended.
#[derive(Debug, Clone)]
pub enum End {
    /// All that was asked for was done.
    Done,
    /// Somebody said stop.
    Stopped,
    /// A step failed beyond repair.
    Stalled(StepError),
    /// The simulation could not be made or started.
    NotStarted(SimError),
    /// An output failed ([`Outcome::output_errors`]).
    OutputFailed,
}

/// What a run leaves.
#[derive(Debug, Clone)]
pub struct Outcome {
    /// Why it ended.
    pub end: End,
    /// Results so far; `None` when the passage never began.
    pub summary: Option<Summary>,
    /// Whether somebody ended it before it had done all that was asked for; a run without an end of its own
    /// ([`Ending::OnStop`](crate::run::Ending)) is never cut short.
    pub stopped: bool,
    /// Time steps after the start-up.
    pub steps: u64,
    /// How many the whole run has by its plan, or had once its life had settled; `None`: it has no end of its own.
    pub steps_planned: Option<u64>,
    /// Whether more steps would only repeat what has been seen, of a scene that does not say how many passages it makes.
    pub settled: bool,
    /// The first steps that did not converge, at most [`Outcome::UNCONVERGED_KEPT`].
    pub unconverged: Vec<Unconverged>,
    /// How many did not in all.
    pub n_unconverged: u64,
    /// Commands that took effect, scripted ones included.
    pub applied: Vec<AppliedCommand>,
    /// What the outputs hold.
    pub reports: Vec<ObserverReport>,
    /// Outputs that failed.
    pub output_errors: Vec<ObserveError>,
    /// What a continuation needs; `None`: the simulation never began, or cannot go on.
    pub checkpoint: Option<Box<Checkpoint>>,
    /// Time taken, s.
    pub wall_s: f64,
    /// Steps a second in the passage, outputs included; `None` with fewer than two steps.
    pub steps_per_s: Option<f64>,
}

impl Outcome {
    /// The run that it repeats went on: what there was of it has been done, and that is not all.
    pub fn cut_short(&mut self) {
        self.stopped = true;
        if let Some(summary) = &mut self.summary {
            (summary.stopped, summary.converged) = (true, false);
        }
    }

    /// Most unconverged steps that are listed one by one.
    pub const UNCONVERGED_KEPT: usize = 100;

    /// Exit code of the command line: 0 converged, 1 a state that does not fit, 2 some steps did not converge, 3 stalled
    /// or not started, 4 an output failed, 5 stopped before its end. A failed solution weighs more than a failed output,
    /// and that more than a stop, which weighs more than steps that did not converge.
    pub fn exit_code(&self) -> u8 {
        match self.end {
            End::NotStarted(SimError::State(_)) => 1,
            End::Stalled(_) | End::NotStarted(_) => 3,
            End::OutputFailed => 4,
            End::Done | End::Stopped if !self.output_errors.is_empty() => 4,
            End::Done | End::Stopped if self.stopped => 5,
            End::Done | End::Stopped if self.n_unconverged > 0 => 2,
            End::Done | End::Stopped => 0,
        }
    }
}
