//! `[life]`: model, exponents, cycle basis, calibration.

use serde::{Deserialize, Serialize};

use super::error::SceneError;
use crate::closed_set;
use crate::physics::fatigue::LifeLaw;
use crate::physics::life_models::LifeEquation;

closed_set! {
    /// Life model; equations and sources: [`crate::physics::life_models`].
    pub enum LifeModel {
        /// Zaretsky 1987: `ln(1/Ps) = C M^e int sigma^(c e) dV`.
        Zaretsky = "zaretsky" "Zaretsky",
        /// Lundberg and Palmgren 1947: maximum orthogonal shear and its depth.
        LundbergPalmgren = "lundberg_palmgren" "Lundberg-Palmgren",
        /// Ioannides and Harris 1985: what exceeds a limit, over z^h.
        IoannidesHarris = "ioannides_harris" "Ioannides-Harris",
        /// Dang Van: mesoscopic shear and hydrostatic stress; no volume effect.
        DangVan = "dang_van" "Dang Van",
        /// Findley: critical plane; no volume effect.
        Findley = "findley" "Findley",
    }
}

closed_set! {
    /// How cycles enter the life.
    pub enum CycleBasis {
        /// Counted by depth, each cycle by the damage it does, in loading cycles of the faster body.
        Damage = "damage" "counted by damage",
        /// One global n for the whole volume (the form of Pu, Zhu, Wang & Wang 2016).
        Global = "global" "the paper's count",
        /// Counted by depth; a cycle of effective stress counts by its peak.
        Peaks = "peaks" "counted by peaks",
    }
}

impl LifeModel {
    /// Whether it integrates stress over the volume; the others look at one depth.
    pub fn integrates(self) -> bool {
        match self {
            Self::Zaretsky | Self::IoannidesHarris => true,
            Self::LundbergPalmgren | Self::DangVan | Self::Findley => false,
        }
    }
}

impl CycleBasis {
    /// Of whose loading cycles its lives are.
    pub fn unit(self) -> &'static str {
        match self {
            Self::Damage => "loading cycles of the faster body",
            Self::Global | Self::Peaks => "own loading cycles",
        }
    }
}

closed_set! {
    /// Whose life is the scene's.
    pub enum BodyChoice {
        /// The body with the shorter life in own loading cycles.
        Weaker = "weaker",
        /// Body 1.
        Body1 = "body_1",
        /// Body 2.
        Body2 = "body_2",
    }
}

closed_set! {
    /// How far the spread over the choice of model reaches.
    pub enum Spread {
        /// No spread.
        Off = "off",
        /// Over the cycle bases, with the scene's model: costs nothing more.
        Cycles = "cycles",
        /// Over all models too.
        Models = "models",
    }
}

closed_set! {
    /// Bodies for which damage is mapped.
    pub enum DamageMaps {
        /// None.
        Off = "off",
        /// Body 1.
        Body1 = "body_1",
        /// Body 2.
        Body2 = "body_2",
        /// Both.
        Both = "both",
    }
}

/// `[life]`
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields, default)]
pub struct Life {
    /// Model.
    pub model: LifeModel,
    /// Stress exponent c (assumption, not from the paper).
    pub stress_exponent: f64,
    /// Weibull slope e (assumption, not from the paper).
    pub weibull_slope: f64,
    /// Probability of survival.
    pub survival: f64,
    /// Cycle basis.
    pub cycles: CycleBasis,
    /// Whose life it is.
    pub body: BodyChoice,
    /// h of Lundberg-Palmgren and Ioannides-Harris.
    pub depth_exponent: f64,
    /// Depth above which z^-h no longer grows, in a.
    pub cut_off_a: f64,
    /// Fatigue limit of the effective stress, Pa; 0: none (Ioannides-Harris).
    pub limit_pa: f64,
    /// Weight of the hydrostatic (Dang Van) or normal (Findley) stress.
    pub normal_weight: f64,
    /// Spread over the choice of model.
    pub spread: Spread,
    /// Damage maps.
    pub damage_map: DamageMaps,
    /// Loading cycles that the smooth, frictionless contact lives at `calibration_pressure_pa`.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub calibration_cycles: Option<f64>,
    /// Hertz pressure of the calibration point, Pa.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub calibration_pressure_pa: Option<f64>,
    /// Probability of survival of the calibration point.
    pub calibration_survival: f64,
    /// `e_C C_u/P` of ISO 281, for a_ISO beside the result.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub iso_load_ratio: Option<f64>,
}

impl Default for Life {
    fn default() -> Self {
        Self {
            model: LifeModel::Zaretsky,
            stress_exponent: 31.0 / 3.0,
            weibull_slope: 10.0 / 9.0,
            survival: 0.5,
            cycles: CycleBasis::Damage,
            body: BodyChoice::Weaker,
            depth_exponent: 7.0 / 3.0,
            cut_off_a: 0.05,
            limit_pa: 0.0,
            normal_weight: 0.3,
            spread: Spread::Cycles,
            damage_map: DamageMaps::Both,
            calibration_cycles: None,
            calibration_pressure_pa: None,
            calibration_survival: 0.9,
            iso_load_ratio: None,
        }
    }
}

impl Life {
    /// A model with this scene's numbers, the limit over the Hertz pressure.
    pub fn equation(&self, model: LifeModel, p_hertz_pa: f64) -> LifeEquation {
        match model {
            LifeModel::Zaretsky => LifeEquation::Zaretsky,
            LifeModel::LundbergPalmgren => LifeEquation::LundbergPalmgren {
                depth_exponent: self.depth_exponent,
                cut_off: self.cut_off_a,
            },
            LifeModel::IoannidesHarris => LifeEquation::IoannidesHarris {
                depth_exponent: self.depth_exponent,
                cut_off: self.cut_off_a,
                limit: self.limit_pa / p_hertz_pa,
            },
            LifeModel::DangVan => LifeEquation::DangVan {
                hydrostatic: self.normal_weight,
            },
            LifeModel::Findley => LifeEquation::Findley {
                normal: self.normal_weight,
            },
        }
    }

    /// c and e.
    pub fn law(&self) -> LifeLaw {
        LifeLaw {
            stress_exponent: self.stress_exponent,
            weibull_slope: self.weibull_slope,
        }
    }

    /// Exponent m of life against stress, N ∝ σ^−m, by the model's own equation; with a fatigue limit that of stress far above it.
    pub fn exponent(&self) -> f64 {
        // What a limit is in units of pressure is nothing to the exponent.
        self.equation(self.model, 1.0).life_exponent(self.law())
    }

    /// Cycles and Hertz pressure (Pa) of the calibration point.
    pub fn calibration(&self) -> Option<(f64, f64)> {
        self.calibration_cycles.zip(self.calibration_pressure_pa)
    }

    /// Whether damage is mapped for body 1 and body 2.
    pub fn maps(&self) -> [bool; 2] {
        match self.damage_map {
            DamageMaps::Off => [false, false],
            DamageMaps::Body1 => [true, false],
            DamageMaps::Body2 => [false, true],
            DamageMaps::Both => [true, true],
        }
    }
}

/// A calibration point needs both its numbers.
pub(super) fn check_calibration(life: &Life) -> Result<(), SceneError> {
    let missing = match (life.calibration_cycles, life.calibration_pressure_pa) {
        (Some(_), None) => "calibration_pressure_pa",
        (None, Some(_)) => "calibration_cycles",
        (None, None) | (Some(_), Some(_)) => return Ok(()),
    };
    Err(SceneError::Missing {
        key: format!("life.{missing}"),
        allowed: "a calibration point has cycles and a pressure; leave both out for relative lives"
            .to_owned(),
    })
}
