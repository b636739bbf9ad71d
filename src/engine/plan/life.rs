//! What the plan tells about fatigue life.

use super::Plan;
use crate::scene::{ContactKind, CycleBasis, Life, LifeModel, Spread, StressMeasure};

/// Volume integrals that a length of 4 a wants at least: every step of 129 nodes. Fewer save 4 % of a run and
/// miss crests that meet: against all phases 32 err by 0.3 % of the life in the default scene, by 8 % in the twin
/// discs, whose rough bodies beat (`tests/engine/pruning`).
const PHASES: u64 = 128;
/// Same for a line, where it is cheap: crests that meet are rare and weigh most (16 phases erred by 10⁵).
const LINE_PHASES: u64 = 256;

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
        match self.spread {
            Spread::Models => true,
            Spread::Off | Spread::Cycles => self.model.integrates(),
        }
    }
}

impl Plan {
    /// Volume integrals at least [`PHASES`] times in 4 a, at the longest interval that meets every wave in
    /// all of its phases; an interval that fits a whole number of times into a wave would miss most.
    pub(super) fn life_plan(&self, life: &Life, measure: StressMeasure) -> LifePlan {
        /// Widest gap between the phases met, in waves; 16 even ones leave 0.06.
        const GAP: f64 = 0.07;
        let phases = match self.kind {
            ContactKind::Point => PHASES,
            ContactKind::Line => LINE_PHASES,
        };
        let longest = (self.steps_per_passage / phases).max(1);
        let widest = |every: u64| {
            let n = self.steps_per_passage / every;
            let waves = self.waves.iter().flatten();
            waves
                .map(|wave| wave.widest_gap(every, n))
                .fold(0.0, f64::max)
        };
        let intervals = (1..=longest).rev();
        let every = intervals
            .clone()
            .find(|every| widest(*every) <= GAP)
            .or_else(|| intervals.min_by(|one, two| widest(*one).total_cmp(&widest(*two))))
            .unwrap_or(1);
        LifePlan {
            asked: LifeAsked {
                model: life.model,
                measure,
                cycles: life.cycles,
                spread: life.spread,
                maps: life.maps(),
                calibration: life.calibration(),
            },
            volume_every_steps: every,
            phases_per_passage: self.steps_per_passage / every,
        }
    }
}
