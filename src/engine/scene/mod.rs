//! What the user asked for, in SI units, parsed strictly and validated.
//!
//! A scene comes from a preset, a TOML file or code. Whatever its source, it passes the same check: every
//! key is known, of the right kind and within its range ([`keys`]), and the keys fit together. A refusal
//! names the key, the value and what is allowed ([`SceneError`]).

mod check;
mod derived;
mod drawing;
mod emit;
mod error;
mod finish;
mod heat;
mod height_map;
mod key;
pub mod keys;
mod knob;
mod life;
mod life_keys;
mod load;
mod lubricant;
mod map_report;
mod model;
mod numerics;
pub mod presets;
mod random;
mod shape;
mod tooth;
mod wear;
mod wrong;

pub use error::{SceneError, drives_a_terminal};
pub use heat::{BodyHeat, Heat, Warming};
pub use knob::{Knob, KnobLine, RampRate, Reach, Steps};
pub use life::{BodyChoice, CycleBasis, DamageMaps, Life, LifeModel, Spread};
pub use load::Override;
pub use lubricant::{
    Cavitation, DensityLaw, EyringFlow, Friction, Lubricant, Rheology, ViscosityLaw,
};
pub use map_report::{Doubt, MapReport};
pub use model::{
    Body, Contact, ContactKind, Event, GridAsked, Load, MapEdge, MapLevel, MapOutliers, Motion,
    Record, Scene, Stress, StressMeasure, Surface, SurfaceKind,
};
pub use numerics::{ErrorSource, Numerics, Order, OrderAsked, Time};
pub use random::RandomSurface;
pub use shape::MINIMUM_HARDNESS;
pub use tooth::Tooth;
pub use wear::{Age, Wear};
pub(crate) use wrong::unusual;
