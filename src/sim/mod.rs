//! The simulation loop: `step`, `set`, `fill`; state, workspace, drive, frames, work counters.

mod error;
mod frame;
mod knob;
mod simulation;
mod stats;
mod summary;

pub use error::{SimError, StepError};
pub use frame::{Frame, LifeEstimate, MaterialPoint, Metrics, Stage, StressSlice};
pub use knob::Knob;
pub use simulation::Simulation;
pub use stats::Stats;
pub use summary::Summary;
