//! `[lubricant]` and `[friction]`: what separates the surfaces, and what remains where nothing does.

use serde::{Deserialize, Serialize};

use crate::closed_set;
pub use crate::physics::fluid::{DensityLaw, Rheology, ViscosityLaw};

closed_set! {
    /// How the pressure's flow sees an Eyring oil that is sheared.
    #[derive(Default)]
    pub enum EyringFlow {
        /// Along the sliding the law's own flow at any slope of the pressure (Conry, Wang and Cusano 1987), across its
        /// secant (Ehret, Dowson and Taylor 1998). What is left of ridges that were measured under sliding
        /// (Šperka, Křupka and Hartl 2016) depends on the sliding no more than it does with this form.
        #[default]
        AlongAcross = "along_across",
        /// One effective viscosity in both directions, the secant of the law: as in Zhu and Hu's codes.
        Secant = "secant",
    }
}

closed_set! {
    /// How the film ruptures.
    #[derive(Default)]
    pub enum Cavitation {
        /// p >= 0, the gap behind the contact counted as full.
        #[default]
        Reynolds = "reynolds",
        /// Mass-conserving (Jakobsson-Floberg-Olsson).
        Jfo = "jfo",
    }
}

/// `[lubricant]`
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Lubricant {
    /// Viscosity at ambient pressure, Pa s.
    pub viscosity_pa_s: f64,
    /// Pressure-viscosity coefficient, 1/Pa.
    pub pressure_viscosity_per_pa: f64,
    /// Viscosity law.
    #[serde(default)]
    pub viscosity_law: ViscosityLaw,
    /// Density law.
    #[serde(default)]
    pub density_law: DensityLaw,
    /// Shear law.
    #[serde(default)]
    pub rheology: Rheology,
    /// Eyring stress tau0, Pa (rheology = "eyring").
    #[serde(default = "eyring_stress")]
    pub eyring_stress_pa: f64,
    /// How the pressure's flow sees the sheared oil (rheology = "eyring").
    #[serde(default)]
    pub eyring_flow: EyringFlow,
    /// Limiting shear stress as a fraction of the pressure.
    #[serde(default = "limiting_shear")]
    pub limiting_shear_ratio: f64,
    /// How the film ruptures.
    #[serde(default)]
    pub cavitation: Cavitation,
}

fn eyring_stress() -> f64 {
    5.0e6
}
fn limiting_shear() -> f64 {
    0.08
}

/// `[friction]`
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields, default)]
pub struct Friction {
    /// Friction coefficient where the film is gone.
    pub boundary: f64,
    /// Film thickness at or below which a spot counts as contact, m (a few molecules of oil).
    pub contact_film_m: f64,
}

impl Default for Friction {
    fn default() -> Self {
        Self {
            boundary: 0.10,
            contact_film_m: 5.0e-9,
        }
    }
}
