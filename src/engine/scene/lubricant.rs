//! `[lubricant]` and `[friction]`: what separates the surfaces, and what remains where nothing does.

use serde::{Deserialize, Serialize};

/// Viscosity law.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum ViscosityLaw {
    /// `eta0 exp(alpha p)`.
    Barus,
    /// Roelands with the same slope at p = 0.
    Roelands,
}

/// Density law.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum DensityLaw {
    /// Constant.
    Incompressible,
    /// `1 + 0.6e-9 p/(1 + 1.7e-9 p)`.
    DowsonHigginson,
    /// `(0.59e9 + 1.34 p)/(0.59e9 + p)`: the same law in other round numbers.
    VennerLubrecht,
}

/// Shear law of the film.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Rheology {
    /// Shear stress proportional to shear rate.
    Newtonian,
    /// Ree-Eyring: `tau0 asinh(eta gamma/tau0)`.
    Eyring,
}

/// How the pressure's flow sees an Eyring oil that is sheared.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum EyringFlow {
    /// One effective viscosity in both directions, the secant of the law: as in Zhu and Hu's codes.
    Secant,
    /// Along the sliding the law's own flow at any slope of the pressure (Conry, Wang and Cusano 1987), across its secant
    /// (Ehret, Dowson and Taylor 1998). What is left of ridges that were measured under sliding
    /// (Šperka, Křupka and Hartl 2016) depends on the sliding no more than it does with this form.
    AlongAcross,
}

/// How the film ruptures.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Cavitation {
    /// p >= 0, the gap behind the contact counted as full.
    Reynolds,
    /// Mass-conserving (Jakobsson-Floberg-Olsson).
    Jfo,
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
    #[serde(default = "roelands")]
    pub viscosity_law: ViscosityLaw,
    /// Density law.
    #[serde(default = "dowson_higginson")]
    pub density_law: DensityLaw,
    /// Shear law.
    #[serde(default = "newtonian")]
    pub rheology: Rheology,
    /// Eyring stress tau0, Pa (rheology = "eyring").
    #[serde(default = "eyring_stress")]
    pub eyring_stress_pa: f64,
    /// How the pressure's flow sees the sheared oil (rheology = "eyring").
    #[serde(default = "along_across")]
    pub eyring_flow: EyringFlow,
    /// Limiting shear stress as a fraction of the pressure.
    #[serde(default = "limiting_shear")]
    pub limiting_shear_ratio: f64,
    /// How the film ruptures.
    #[serde(default = "reynolds")]
    pub cavitation: Cavitation,
}

fn roelands() -> ViscosityLaw {
    ViscosityLaw::Roelands
}
fn dowson_higginson() -> DensityLaw {
    DensityLaw::DowsonHigginson
}
fn newtonian() -> Rheology {
    Rheology::Newtonian
}
fn along_across() -> EyringFlow {
    EyringFlow::AlongAcross
}
fn reynolds() -> Cavitation {
    Cavitation::Reynolds
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
