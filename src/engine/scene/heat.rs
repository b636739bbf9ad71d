//! `[heat]`, `[body_1.heat]`, `[body_2.heat]`: what is needed to say how warm surfaces become.

use serde::{Deserialize, Serialize};

use super::lubricant::Lubricant;

/// `[heat]`: the bulk, and the oil.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields, default)]
pub struct Heat {
    /// Temperature of both bodies and of the oil that enters, K.
    pub bulk_k: f64,
    /// Conductivity of the oil, W/(m K).
    pub thermal_conductivity_w_mk: f64,
    /// Density of the oil, kg/m³.
    pub density_kg_m3: f64,
    /// Heat capacity of the oil, J/(kg K).
    pub heat_capacity_j_kgk: f64,
    /// β: how fast the viscosity falls, −d ln η/dT, 1/K; `None`: by the oil's grade, where the scene has one.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub viscosity_temperature_per_k: Option<f64>,
}

impl Default for Heat {
    fn default() -> Self {
        Self {
            bulk_k: 353.15,
            thermal_conductivity_w_mk: 0.14,
            density_kg_m3: 870.0,
            heat_capacity_j_kgk: 2000.0,
            viscosity_temperature_per_k: None,
        }
    }
}

impl Heat {
    /// Diffusivity of the oil, m²/s.
    pub fn oil_diffusivity_m2_s(&self) -> f64 {
        self.thermal_conductivity_w_mk / (self.density_kg_m3 * self.heat_capacity_j_kgk)
    }

    /// β, 1/K; `None`: it is neither given nor does the oil have a grade.
    pub fn beta_per_k(&self, oil: &Lubricant) -> Option<f64> {
        self.viscosity_temperature_per_k.or_else(|| {
            let celsius = oil.temperature_c?;
            let at = |celsius: f64| {
                let warm = Lubricant {
                    temperature_c: Some(celsius),
                    ..oil.clone()
                };
                warm.viscosity_pa_s()
            };
            Some((at(celsius - 1.0) / at(celsius + 1.0)).ln() / 2.0)
        })
    }
}

/// `[body_1.heat]`: of a body; the defaults are those of bearing steel.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields, default)]
pub struct BodyHeat {
    /// Conductivity, W/(m K).
    pub thermal_conductivity_w_mk: f64,
    /// Density, kg/m³.
    pub density_kg_m3: f64,
    /// Heat capacity, J/(kg K).
    pub heat_capacity_j_kgk: f64,
}

impl Default for BodyHeat {
    fn default() -> Self {
        Self {
            thermal_conductivity_w_mk: 46.0,
            density_kg_m3: 7850.0,
            heat_capacity_j_kgk: 470.0,
        }
    }
}

impl BodyHeat {
    /// κ, m²/s.
    pub fn diffusivity_m2_s(&self) -> f64 {
        self.thermal_conductivity_w_mk / (self.density_kg_m3 * self.heat_capacity_j_kgk)
    }
}
