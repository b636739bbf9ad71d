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

impl Medium {
    /// No oil at all.
    pub const DRY: Self = Self {
        viscosity: Viscosity::Barus { alpha_p: 0.0 },
        density: Density::Incompressible,
        lambda: f64::INFINITY,
        sliding: 0.0,
        sheared: ShearedFlow::Secant,
    };

    /// An oil that does not slide, or whose viscosity does not feel it.
    pub fn newtonian(viscosity: Viscosity, density: Density, lambda: f64) -> Self {
        Self {
            viscosity,
            density,
            lambda,
            ..Self::DRY
        }
    }
}
