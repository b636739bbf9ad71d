//! `[life]`: model, exponents, cycle basis, calibration.

use serde::{Deserialize, Serialize};

use super::error::SceneError;

/// Life model; equations and sources: [`crate::physics::life_models`].
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum LifeModel {
    /// Zaretsky 1987: `ln(1/Ps) = C M^e int sigma^(c e) dV`.
    Zaretsky,
    /// Lundberg and Palmgren 1947: greatest orthogonal shear and its depth.
    LundbergPalmgren,
    /// Ioannides and Harris 1985: what exceeds a limit, over z^h.
    IoannidesHarris,
    /// Dang Van: mesoscopic shear and hydrostatic stress; no volume effect.
    DangVan,
    /// Findley: critical plane; no volume effect.
    Findley,
}

impl LifeModel {
    /// Every model.
    pub const ALL: [Self; 5] = [
        Self::Zaretsky,
        Self::LundbergPalmgren,
        Self::IoannidesHarris,
        Self::DangVan,
        Self::Findley,
    ];

    /// Name for people.
    pub fn name(self) -> &'static str {
        match self {
            Self::Zaretsky => "Zaretsky",
            Self::LundbergPalmgren => "Lundberg-Palmgren",
            Self::IoannidesHarris => "Ioannides-Harris",
            Self::DangVan => "Dang Van",
            Self::Findley => "Findley",
        }
    }
}

/// How cycles enter the life.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum CycleBasis {
    /// Counted by depth, each cycle by the damage it does, in loading cycles of the faster body.
    Damage,
    /// One global n for the whole volume (the paper's form; an upper bound on damage).
    Global,
    /// Counted by depth; a cycle of effective stress counts by its peak.
    Peaks,
}

impl CycleBasis {
    /// Every basis.
    pub const ALL: [Self; 3] = [Self::Damage, Self::Global, Self::Peaks];

    /// Of whose loading cycles its lives are.
    pub fn unit(self) -> &'static str {
        match self {
            Self::Damage => "loading cycles of the faster body",
            Self::Global | Self::Peaks => "own loading cycles",
        }
    }

    /// Name for people.
    pub fn name(self) -> &'static str {
        match self {
            Self::Damage => "counted by damage",
            Self::Global => "the paper's count",
            Self::Peaks => "counted by peaks",
        }
    }
}

/// Whose life is the scene's.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum BodyChoice {
    /// The body with the shorter life in own loading cycles.
    Weaker,
    /// Body 1.
    #[serde(rename = "body_1")]
    Body1,
    /// Body 2.
    #[serde(rename = "body_2")]
    Body2,
}

/// How far the spread over the choice of model reaches.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Spread {
    /// No spread.
    Off,
    /// Over the cycle bases, with the scene's model: costs nothing more.
    Cycles,
    /// Over all models too.
    Models,
}

/// Bodies for which damage is mapped.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum DamageMaps {
    /// None.
    Off,
    /// Body 1.
    #[serde(rename = "body_1")]
    Body1,
    /// Body 2.
    #[serde(rename = "body_2")]
    Body2,
    /// Both.
    Both,
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
    /// Cycles and Hertz pressure (Pa) of the calibration point.
    pub fn calibration(&self) -> Option<(f64, f64)> {
        self.calibration_cycles.zip(self.calibration_pressure_pa)
    }

    /// Whether damage is mapped for body 1 and body 2.
    pub fn maps(&self) -> [bool; 2] {
        let one = matches!(self.damage_map, DamageMaps::Body1 | DamageMaps::Both);
        let two = matches!(self.damage_map, DamageMaps::Body2 | DamageMaps::Both);
        [one, two]
    }
}

/// A calibration point needs both its numbers.
pub(super) fn check_calibration(life: &Life) -> Result<(), SceneError> {
    let missing = match (life.calibration_cycles, life.calibration_pressure_pa) {
        (Some(_), None) => "calibration_pressure_pa",
        (None, Some(_)) => "calibration_cycles",
        _ => return Ok(()),
    };
    Err(SceneError::Missing {
        key: format!("life.{missing}"),
        allowed: "a calibration point has cycles and a pressure; leave both out for relative lives"
            .to_owned(),
    })
}
