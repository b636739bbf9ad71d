//! The oil between the surfaces, as the equations see it.
//!
//! Ours: no equation; the laws are those of `physics/fluid.rs`, with the scales of `reynolds.rs`.

use crate::physics::fluid::{Density, ShearedFlow, Viscosity};

/// The fluid, dimensionless.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Medium {
    /// Viscosity law.
    pub viscosity: Viscosity,
    /// Density law.
    pub density: Density,
    /// λ.
    pub lambda: f64,
    /// Z = η0 |U2−U1| Rx/(τ0 a²); 0: Newtonian.
    pub sliding: f64,
    /// How the pressure's flow sees oil that is sheared.
    pub sheared: ShearedFlow,
}
