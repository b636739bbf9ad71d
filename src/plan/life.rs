//! What the plan tells about fatigue life.

use crate::scene::{CycleBasis, LifeModel, Spread, StressMeasure, VolumeIntegral};

/// Fatigue life.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct LifePlan {
    /// What the scene asks for.
    pub asked: LifeAsked,
    /// Time steps between two volume integrals.
    pub volume_every_steps: u64,
    /// Volume integrals in one length of 4 a at U.
    pub phases_per_passage: u64,
}

/// The choices of a scene's `[life]` that the plan tells.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct LifeAsked {
    /// Model.
    pub model: LifeModel,
    /// Effective stress.
    pub measure: StressMeasure,
    /// Cycle basis.
    pub cycles: CycleBasis,
    /// Volume integral.
    pub volume: VolumeIntegral,
    /// Spread over models.
    pub spread: Spread,
    /// Damage maps of body 1 and body 2.
    pub maps: [bool; 2],
    /// Whether a calibration point makes lives absolute.
    pub calibration: Option<(f64, f64)>,
}

impl LifeAsked {
    /// Whether a model integrates stress over the volume.
    pub fn volumes(&self) -> bool {
        let integrates = matches!(self.model, LifeModel::Zaretsky | LifeModel::IoannidesHarris);
        integrates || self.spread == Spread::Models
    }
}
