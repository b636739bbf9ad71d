//! `[wear]` and `[age]`: what surfaces lose, and over how many loading cycles.

use serde::{Deserialize, Serialize};

use super::error::SceneError;
use super::model::{MapEdge, Scene, Surface};

/// `[wear]`: Archard's law where boundary contacts carry.
#[derive(Debug, Clone, Copy, PartialEq, Default, Serialize, Deserialize)]
#[serde(deny_unknown_fields, default)]
pub struct Wear {
    /// Depth of body 1 that is worn, over pressure and distance slid, 1/Pa.
    pub coefficient_1_per_pa: f64,
    /// Same of body 2.
    pub coefficient_2_per_pa: f64,
    /// Films thinner than this wear, too, by a share that grows from nothing there to one in contact, m.
    pub thin_film_m: f64,
}

/// `[age]`: loading cycles beyond the passages that are simulated.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields, default)]
pub struct Age {
    /// Loading cycles of each body.
    pub cycles: f64,
    /// Error of the heights that a jump may make, over the composite roughness (of smooth surfaces over what is worn).
    pub tolerance: f64,
}

impl Default for Age {
    fn default() -> Self {
        Self {
            cycles: 1e6,
            tolerance: 0.02,
        }
    }
}

impl Wear {
    /// Of body 1 and 2, 1/Pa.
    pub fn coefficients_per_pa(&self) -> [f64; 2] {
        [self.coefficient_1_per_pa, self.coefficient_2_per_pa]
    }
}

impl Scene {
    /// One passage of new surfaces: without wear and ageing.
    #[must_use]
    pub fn with_new_surfaces(mut self) -> Self {
        (self.wear, self.age) = (None, None);
        self
    }

    /// Whether the wear that is asked for can be followed.
    ///
    /// # Errors
    /// [`SceneError::Value`] that names the key.
    pub(super) fn check_wear(&self) -> Result<(), SceneError> {
        if self.age.is_some() && self.wear.is_none() {
            return Err(SceneError::value(
                "age",
                "without [wear]",
                "a table [age] beside a table [wear]: nothing else ages a surface here",
            ));
        }
        let coefficients = self.wear.unwrap_or_default().coefficients_per_pa();
        for (body, (speed, coefficient)) in
            (1..).zip(self.speeds_m_s().into_iter().zip(coefficients))
        {
            if coefficient > 0.0 && speed == 0.0 {
                return Err(SceneError::value(
                    format!("wear.coefficient_{body}_per_pa"),
                    format!("{coefficient:e}"),
                    format!(
                        "0 at motion.slide_roll = {}: body {body} stands in the contact and has no loading cycles",
                        self.motion.slide_roll
                    ),
                ));
            }
        }
        for (body, (surface, coefficient)) in
            (1..).zip(self.surfaces().into_iter().zip(coefficients))
        {
            let (repeats, instead) = match surface {
                Surface::Smooth {} | Surface::Random(_) => continue,
                Surface::Sinusoid {
                    wavelength_x_m,
                    wavelength_y_m,
                    angle_deg,
                    ..
                } => {
                    let crossed = wavelength_x_m.is_finite() && wavelength_y_m.is_finite();
                    (
                        !crossed || angle_deg.rem_euclid(90.0) == 0.0,
                        "two waves that cross obliquely do not come again along x",
                    )
                }
                Surface::HeightMap { edge, .. } => (
                    *edge == MapEdge::Periodic,
                    "a map that stands once does not come again",
                ),
            };
            if coefficient > 0.0 && !repeats {
                return Err(SceneError::value(
                    format!("wear.coefficient_{body}_per_pa"),
                    format!("{coefficient:e}"),
                    format!(
                        "0 with body {body}'s surface, whose material must come again: {instead}"
                    ),
                ));
            }
        }
        Ok(())
    }
}
