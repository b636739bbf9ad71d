//! Runs of the engine: threads, commands and outcome; sweeps over many scenes; what watches a run without drawing.
//!
//! * [`run`]: a session: threads, commands, outcome, checkpoints.
//! * [`sweep`]: life maps and operating paths over many scenes, cases run beside the explorer.
//! * [`Latest`]: one slot with the newest frame, for screens.
//! * [`FramePool`]: frames that are filled, shared and filled again without allocating.
//! * [`Queue`]: runs an observer that may block on a thread of its own.
//! * [`Table`]: every scalar of every step as CSV.
//! * [`program`]: which program wrote a file.

pub mod cells;
mod latest;
mod pool;
pub mod program;
mod queue;
pub mod run;
pub mod sweep;
mod table;

pub use latest::Latest;
pub use pool::FramePool;
pub use queue::{Queue, WhenFull};
pub use table::Table;
