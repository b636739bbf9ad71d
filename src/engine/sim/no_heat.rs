//! A page computes no heat: it is loaded over a line, and has no room for what it would not show. Part of `heat_stage.rs`.

use serde::{Deserialize, Serialize};

use super::sim_plan::SimPlan;
use crate::math::grid::Grid;
use crate::saved::Saved;
use crate::scene::Scene;

/// There is none.
pub(super) enum HeatStage {}

/// There is none.
#[derive(Debug, Clone, Copy, Serialize, Deserialize)]
pub(super) enum Warmth {}

impl Saved for Warmth {
    fn check(&self, _: &Self) -> Result<(), String> {
        match *self {}
    }

    fn restore(&mut self, _: &Self) {
        match *self {}
    }
}

/// See `heat_stage.rs`.
pub(super) struct Warmed {
    pub(super) greatest_k: f64,
    pub(super) mean_k: f64,
    pub(super) share_1: f64,
}

/// See `heat_stage.rs`.
#[expect(dead_code, reason = "nobody reads it here")]
pub(super) struct Heating<'a> {
    pub(super) grid: &'a Grid,
    pub(super) pressure: &'a [f64],
    pub(super) film: &'a [f64],
    pub(super) traction: &'a [f64],
    pub(super) dt_s: f64,
    pub(super) speeds_m_s: [f64; 2],
    pub(super) ellipse: (f64, f64),
    pub(super) steady: bool,
}

impl HeatStage {
    pub(super) fn new(_: &Scene, _: &Grid, _: f64) -> Option<Self> {
        None
    }

    pub(super) fn cold(&self) -> Warmth {
        match *self {}
    }

    pub(super) fn advance(&mut self, _: &SimPlan, _: &mut Warmth, _: &Heating) {
        match *self {}
    }
}

#[expect(clippy::trivially_copy_pass_by_ref, reason = "as in heat_stage.rs")]
impl Warmth {
    pub(super) fn forget(&mut self) {
        match *self {}
    }

    pub(super) fn warmed(&self) -> Option<Warmed> {
        match *self {}
    }
}

pub(super) fn blok(_: &Scene, _: f64, _: f64, _: f64) -> f64 {
    f64::NAN
}

pub(super) fn inlet(_: &Scene) -> Option<f64> {
    None
}
