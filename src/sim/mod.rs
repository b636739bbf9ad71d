//! The simulation loop: `step`, `set`, `fill`; state, workspace, drive, frames, work counters.

mod error;
mod frame;
mod knob;

pub use error::{SimError, StepError};
pub use frame::{Frame, LifeEstimate, MaterialPoint, Metrics, Stage, StressSlice};
pub use knob::Knob;
