//! The simulation loop: `step`, `set`, `fill`; state, workspace, drive, frames, work counters.

mod caution;
mod counting;
mod counting_spec;
mod damage_count;
mod door;
mod drive;
mod error;
mod fatigue_stage;
mod fill;
mod fitness;
mod follow;
mod frame;
mod knob;
mod lives;
mod lubrication;
mod measure;
mod motion;
mod orbit;
mod pace;
mod present;
mod reference;
mod regime;
mod settling;
mod setup;
mod simulation;
mod smooth;
mod start_up;
mod state;
mod stats;
mod stepping;
mod stress_stage;
mod summary;
mod terrain;
mod totals;
mod variant;
mod watching;
mod yielded;

pub use caution::{Caution, CautionCode, Grounds};
pub use error::{SimError, StepError, Unsolved};
pub use frame::{
    DamageBlock, Follow, Frame, LifeDetail, LifeEstimate, MaterialPoint, MeshErrors, Metrics,
    PassedPeak, Repeat, Rhythm, Stage, StressPlane, StressSlice,
};
pub use knob::Knob;
pub use lubrication::LubricationRegime;
pub use simulation::Simulation;
pub use state::State;
pub use stats::Stats;
pub use summary::{PitStart, Summary};
