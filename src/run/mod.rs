//! The loop around a simulation: commands in, frames out, an outcome at the end.

use crate::sim::Knob;

/// What may be asked of a running session; taken between time steps only.
#[derive(Debug, Clone, PartialEq)]
pub enum Command {
    /// Moves a knob's target.
    Set(Knob, f64),
    /// Stops stepping until the next `Pause` or `StepOnce`.
    Pause,
    /// Makes one step while paused.
    StepOnce,
    /// Ends the run: outputs are closed, the outcome is returned.
    Stop,
}
