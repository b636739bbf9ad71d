//! `[lubricant]` and `[friction]`: what separates the surfaces, and what remains where nothing does.

use serde::{Deserialize, Serialize};

use super::error::SceneError;
use super::keys::{self, joined, short};
use crate::closed_set;
use crate::math::number::sig;
pub use crate::physics::fluid::{DensityLaw, Rheology, ViscosityLaw};
use crate::physics::oil_grade::{self, OilGrade, USUAL_INDEX};

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
    /// Viscosity at ambient pressure, Pa s; `None`: that of the grade.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub viscosity_pa_s: Option<f64>,
    /// Pressure-viscosity coefficient, 1/Pa; `None`: that of the grade.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub pressure_viscosity_per_pa: Option<f64>,
    /// ISO viscosity grade, mm²/s at 40 °C, in place of the viscosity.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub vg: Option<f64>,
    /// Temperature of the oil in the inlet, °C, with the grade.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub temperature_c: Option<f64>,
    /// Viscosity index, with the grade; `None`: 95.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub viscosity_index: Option<f64>,
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

impl Lubricant {
    fn grade(&self) -> Option<OilGrade> {
        Some(OilGrade {
            vg: self.vg?,
            viscosity_index: self.viscosity_index.unwrap_or(USUAL_INDEX),
        })
    }

    /// Viscosity at ambient pressure, Pa s; NaN would show a lubricant without one, which does not validate.
    pub fn viscosity_pa_s(&self) -> f64 {
        let by_grade = || self.grade()?.viscosity_pa_s(self.temperature_c?);
        (self.viscosity_pa_s).or_else(by_grade).unwrap_or(f64::NAN)
    }

    /// Pressure-viscosity coefficient, 1/Pa; NaN as of the viscosity.
    pub fn pressure_viscosity_per_pa(&self) -> f64 {
        let by_grade = || oil_grade::pressure_coefficient_per_pa(self.viscosity_pa_s());
        let by_grade = self.vg.map(|_| by_grade());
        (self.pressure_viscosity_per_pa)
            .or(by_grade)
            .unwrap_or(f64::NAN)
    }

    /// How grade and temperature became viscosity and coefficient, in words; `None`: the scene gives those.
    pub fn conversion(&self) -> Option<String> {
        let grade = self.grade()?;
        let temperature_c = self.temperature_c?;
        let density = oil_grade::density_kg_m3(temperature_c);
        let alpha = match self.pressure_viscosity_per_pa {
            Some(_) => "as the scene gives it",
            None => "AGMA 925, mineral oil; measured ones are 1.1 to 1.6 times as large",
        };
        Some(format!(
            "ISO VG {}, VI {}, {} °C: {} mm²/s (ASTM D2270, D341) x {} kg/m³ = {} Pa s; pressure coefficient {} 1/Pa ({alpha})",
            short(grade.vg),
            short(grade.viscosity_index),
            short(temperature_c),
            sig(1e6 * self.viscosity_pa_s() / density, 4),
            sig(density, 4),
            sig(self.viscosity_pa_s(), 4),
            short(
                sig(self.pressure_viscosity_per_pa(), 3)
                    .parse()
                    .unwrap_or(f64::NAN)
            ),
        ))
    }

    /// The rules that tie the ways of giving the oil together.
    pub(super) fn check(&self) -> Result<(), SceneError> {
        let with_grade = [
            ("temperature_c", self.temperature_c, "°C"),
            ("viscosity_index", self.viscosity_index, ""),
        ];
        let only = |key: &str, value: f64, unit: &str, allowed: &str| {
            let value = format!("{} {unit}", short(value));
            SceneError::value(joined("lubricant", key), value.trim_end(), allowed)
        };
        let Some(grade) = self.grade() else {
            for (key, value, unit) in with_grade {
                if let Some(value) = value {
                    return Err(only(key, value, unit, "only with lubricant.vg"));
                }
            }
            let needed = [
                ("viscosity_pa_s", self.viscosity_pa_s),
                ("pressure_viscosity_per_pa", self.pressure_viscosity_per_pa),
            ];
            for (name, value) in needed {
                if value.is_none() {
                    let key = joined("lubricant", name);
                    let allowed = keys::find(&key).map_or_else(String::new, keys::Key::allowed);
                    return Err(SceneError::Missing {
                        key,
                        allowed: format!("{allowed}; or the oil's lubricant.vg and temperature_c"),
                    });
                }
            }
            return Ok(());
        };
        if let Some(viscosity_pa_s) = self.viscosity_pa_s {
            let allowed = "either this or lubricant.vg and temperature_c";
            return Err(only("viscosity_pa_s", viscosity_pa_s, "Pa s", allowed));
        }
        let Some(temperature_c) = self.temperature_c else {
            let key = joined("lubricant", "temperature_c");
            let allowed = keys::find(&key).map_or_else(String::new, keys::Key::allowed);
            return Err(SceneError::Missing { key, allowed });
        };
        if grade.kinematic(temperature_c).is_none() {
            let allowed = "a grade and an index with 2 mm²/s or more at 100 °C, below which no index is defined";
            return Err(only("vg", grade.vg, "", allowed));
        }
        Ok(())
    }
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
