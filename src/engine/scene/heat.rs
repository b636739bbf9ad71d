//! `[heat]`, `[body_1.heat]`, `[body_2.heat]`: what is needed to say how warm surfaces become.

use crate::physics::cycles::speed_ratios;
use serde::{Deserialize, Serialize};

use super::Scene;
use super::lubricant::Lubricant;
use crate::physics::fluid::ViscosityLaw;
use crate::physics::heat_estimate::blok_k;
use crate::physics::thinning::Thinning;

/// What of the heat a run follows.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum Warming {
    /// Nothing.
    #[default]
    None,
    /// How warm the surfaces become: dry, or nobody says how the oil thins.
    Surfaces,
    /// And how much thinner that makes the oil.
    SurfacesAndOil,
}

impl Warming {
    /// In a list of what the model is.
    pub fn words(self) -> &'static str {
        match self {
            Self::None => "isothermal",
            Self::Surfaces => "film and friction isothermal",
            Self::SurfacesAndOil => "oil carries no heat along",
        }
    }
}

impl Scene {
    /// What of the heat a run of this scene follows.
    pub fn warming(&self) -> Warming {
        let thins = |heat: &Heat| {
            let oil = self.lubricant.as_ref();
            oil.and_then(|oil| heat.thinning(oil)).is_some()
        };
        match &self.heat {
            None => Warming::None,
            Some(heat) if thins(heat) => Warming::SurfacesAndOil,
            Some(_) => Warming::Surfaces,
        }
    }
}

impl Scene {
    /// Viscosity of oil that is warmer than the bulk by `rise_k` over the bulk's; `None`: dry, or nobody says how it thins.
    pub fn thinner(&self, rise_k: f64) -> Option<f64> {
        let (heat, oil) = self.heat.zip(self.lubricant.as_ref())?;
        Some(heat.thinning(oil)?.at_rest(rise_k).exp())
    }

    /// Blok's flash temperature for a coefficient of friction and a Hertz contact at the scene's speed and `slide_roll`, K.
    pub fn flash_by_blok_k(
        &self,
        slide_roll: f64,
        friction: f64,
        half_width_m: f64,
        p_hertz_pa: f64,
    ) -> f64 {
        let effusivities = [&self.body_1, &self.body_2].map(|body| {
            let heat = body.heat.unwrap_or_default();
            let capacity = heat.density_kg_m3 * heat.heat_capacity_j_kgk;
            (heat.thermal_conductivity_w_mk * capacity).sqrt()
        });
        let speeds = speed_ratios(slide_roll).map(|ratio| self.motion.entrainment_m_s * ratio);
        let sliding = (speeds[1] - speeds[0]).abs();
        let heat = friction * std::f64::consts::FRAC_PI_2 * p_hertz_pa * half_width_m * sliding;
        blok_k(heat, half_width_m, effusivities, speeds)
    }
}

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
    /// β: how fast the viscosity falls, −d ln η/dT, 1/K, at any pressure; `None`: by the exponent or the oil's grade.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub viscosity_temperature_per_k: Option<f64>,
    /// S0 of Roelands' law, by which the viscosity falls the faster the higher the pressure; `None`: by the coefficient or the
    /// oil's grade.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub viscosity_temperature_exponent: Option<f64>,
}

impl Default for Heat {
    fn default() -> Self {
        Self {
            bulk_k: 353.15,
            thermal_conductivity_w_mk: 0.14,
            density_kg_m3: 870.0,
            heat_capacity_j_kgk: 2000.0,
            viscosity_temperature_per_k: None,
            viscosity_temperature_exponent: None,
        }
    }
}

impl Heat {
    /// Diffusivity of the oil, m²/s.
    pub fn oil_diffusivity_m2_s(&self) -> f64 {
        self.thermal_conductivity_w_mk / (self.density_kg_m3 * self.heat_capacity_j_kgk)
    }

    /// How the oil thins as it warms: by Roelands' exponent, by the coefficient, or by the oil's grade in the law of its
    /// pressure; `None`: none of them is there.
    pub fn thinning(&self, oil: &Lubricant) -> Option<Thinning> {
        let (eta, bulk) = (oil.viscosity_pa_s(), self.bulk_k);
        if let Some(exponent) = self.viscosity_temperature_exponent {
            return Some(Thinning::roelands(eta, exponent, bulk));
        }
        if let Some(per_k) = self.viscosity_temperature_per_k {
            return Some(Thinning::exponential(per_k));
        }
        let celsius = oil.temperature_c?;
        let at = |celsius: f64| {
            let warm = Lubricant {
                temperature_c: Some(celsius),
                ..oil.clone()
            };
            warm.viscosity_pa_s()
        };
        let per_k = (at(celsius - 1.0) / at(celsius + 1.0)).ln() / 2.0;
        Some(match oil.viscosity_law {
            ViscosityLaw::Barus => Thinning::exponential(per_k),
            ViscosityLaw::Roelands => Thinning::roelands_of_slope(eta, per_k, bulk),
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
