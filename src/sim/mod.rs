//! The simulation loop: `step`, `set`, `fill`; state, workspace, drive, frames, work counters.

mod door;
mod drive;
mod error;
mod fill;
mod frame;
mod knob;
mod life_stage;
mod measure;
mod motion;
mod simulation;
mod stats;
mod stepping;
mod stress_stage;
mod summary;
mod terrain;
mod totals;

pub use error::{SimError, StepError};
pub use frame::{Frame, LifeEstimate, MaterialPoint, Metrics, Stage, StressSlice};
pub use knob::Knob;
pub use simulation::Simulation;
pub use stats::Stats;
pub use summary::Summary;
