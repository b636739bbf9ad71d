//! What the user asked for, in SI units, parsed strictly and validated.

mod model;

pub use model::{
    Body, Cavitation, Contact, ContactKind, CycleBasis, DensityLaw, Event, Friction, Grid, Life,
    LifeModel, Load, Lubricant, Motion, Numerics, Record, Rheology, Scene, Stress, StressMeasure,
    Surface, Time, ViscosityLaw, VolumeIntegral,
};
