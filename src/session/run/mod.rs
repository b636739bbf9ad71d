//! The loop around a simulation: commands in, frames out, an outcome at the end.
//!
//! ```text
//! main thread                          thread "sim"
//! Session::start ────────────────────> observers begin, simulation made
//!    handle.send(Command) ───────────> drained between steps, each logged with its step
//!    handle.latest().take() <───────── newest frame          every frame ──> observers
//!    handle.status() <──────────────── stage, progress, outputs, what happened
//!    handle.settled() <─────────────── one period of a passage that repeats, for replay and sweep
//! Session::join <───────────────────── Outcome
//! ```
//! Without threads the owner makes the turns of the same loop itself: [`Cooperative`].

mod assumed;
mod checkpoint;
mod climbing;
mod clock;
mod command;
mod companion;
mod cooperative;
mod crew;
mod driver;
mod errors;
mod handle;
mod ladder;
mod outcome;
mod outputs;
mod request;
mod session;
mod settled;

pub use assumed::{Assumed, AssumedRange};
pub use checkpoint::{Checkpoint, CheckpointError};
pub use clock::Clock;
pub use command::{AppliedCommand, Command, HandTurn};
pub use companion::Companion;
pub use cooperative::Cooperative;
pub use crew::share_out;
pub use driver::LoopTurn;
pub use errors::NoEstimate;
pub use handle::{Hold, RunHandle, Status};
pub use ladder::{Climb, Ladder, Mesh};
pub use outcome::{End, Outcome, Unconverged};
pub use outputs::{Activity, Switch, Watcher, WatcherStatus};
pub use request::{Ending, Request};
pub use session::{RunError, Session};
pub use settled::Settled;
