//! What may be asked of a run, and what was.

use asperity_engine::observe::SetBy;
use asperity_engine::sim::{Follow, Knob};

/// What may be asked of a running session; taken between time steps only.
#[derive(Debug, Clone, PartialEq)]
pub enum Command {
    /// Moves a knob's target, SI.
    Set(Knob, f64),
    /// Stops stepping until the next `Pause` or `StepOnce`.
    Pause,
    /// Makes one step while paused.
    StepOnce,
    /// Shows another material point. No result depends on it.
    Follow(Follow),
    /// Words for the outputs: a caption.
    Say(String),
    /// Ends the run: outputs are closed, the outcome is returned.
    Stop,
}

/// A command that took effect, with the step before which it did: scene and log replay the run.
#[derive(Debug, Clone, PartialEq)]
pub struct AppliedCommand {
    /// Time steps made since the start-up when it took effect.
    pub step: u64,
    /// Simulated time, s.
    pub time_s: f64,
    /// Steps made by then, those of the start-up too.
    pub steps_made: u64,
    /// By whom.
    pub by: SetBy,
    /// The command.
    pub command: Command,
}

impl AppliedCommand {
    /// What a run that repeats this one is given; `None`: the scene's own script does it again.
    pub fn to_repeat(&self) -> Option<HandTurn> {
        (self.by == SetBy::Hand).then(|| HandTurn {
            steps_made: self.steps_made,
            command: self.command.clone(),
        })
    }
}

/// Something done by hand in the run that is repeated.
#[derive(Debug, Clone, PartialEq)]
pub struct HandTurn {
    /// Steps that the run had made, those of the start-up too.
    pub steps_made: u64,
    /// What was done; the pace ([`Command::Pause`], [`Command::StepOnce`], [`Command::Stop`]) is not repeated.
    pub command: Command,
}
