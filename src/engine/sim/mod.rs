//! The simulation loop: `step`, `set`, `fill`; state, workspace, drive, frames, work counters.

mod caution;
mod counting;
mod counting_spec;
mod damage_count;
mod drive;
mod error;
mod estimates;
mod fatigue_stage;
mod fields;
mod frame;
mod grounds;
mod headline;
#[cfg(not(target_arch = "wasm32"))]
mod heat_stage;
#[cfg(target_arch = "wasm32")]
#[path = "no_heat.rs"]
mod heat_stage;
mod knob;
mod last_period;
mod lubrication;
mod measure;
mod motion;
mod orbit;
mod pace;
mod pits;
mod regime;
mod roughness;
mod scaling;
mod settling;
mod sim_plan;
mod simulation;
mod smooth;
mod state;
mod stats;
mod stepping;
mod stress_stage;
mod summary;
mod totals;
mod variant;
mod work;
mod worn;
mod yielded;

pub use crate::scene::Knob;
pub use caution::{Caution, CautionCode};
pub use error::{SimError, StepError, Unsolved};
pub use estimates::{LifeDetail, LifeEstimate, MeshErrors, Repeat, Rhythm};
pub use fields::{DamageBlock, Follow, MaterialPoint, PassedPeak, StressPlane, StressSlice};
pub use frame::{CATALOGUE, Dimension, Frame, Metrics, Over, Quantity, Reading, Stage, named};
pub use grounds::{Beside, Grounds};
pub use headline::{Cause, Headline};
pub use lubrication::LubricationRegime;
pub use simulation::{Simulation, head_start};
pub use state::State;
pub use stats::Stats;
pub use summary::{AgePoint, PitHistory, PitStart, Rung, Summary};
