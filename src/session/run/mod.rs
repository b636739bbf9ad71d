//! The loop around a simulation: commands in, frames out, an outcome at the end.
//!
//! ```text
//! main thread                     thread "sim"
//! Session::start ───────────────> observers begin, simulation made
//!    send(Command) ──────────────> drained between steps, each logged with its step
//!    latest().take() <──────────── newest frame          every frame ──> observers
//!    status() <─────────────────── stage, progress, outputs, what happened
//!    settled() <────────────────── one period of a passage that repeats, for replay and sweep
//! Session::join <──────────────── Outcome
//! ```
//! Without threads the owner makes the turns of the same loop itself: [`Cooperative`].

mod checkpoint;
mod clock;
mod companion;
mod cooperative;
mod crew;
mod driver;
mod near_end;
mod outcome;
mod replay;
mod request;
mod session;
mod settled;
mod shared;
mod watcher;

pub use checkpoint::{Checkpoint, CheckpointError};
pub use clock::Clock;
pub use companion::{Companion, NoEstimate};
pub use cooperative::Cooperative;
pub use crew::share_out;
pub use driver::LoopTurn;
pub use near_end::NearEnd;
pub use outcome::{AppliedCommand, End, Outcome, Unconverged};
pub use replay::HandTurn;
pub use request::Request;
pub use session::{RunError, Session};
pub use settled::Settled;
pub use shared::{Ending, Status};
pub use watcher::{Activity, Switch, Watcher, WatcherStatus};

use asperity_engine::sim::{Follow, Knob};

/// What may be asked of a running session; taken between time steps only.
#[derive(Debug, Clone, PartialEq)]
pub enum Command {
    /// Moves a knob's target.
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
