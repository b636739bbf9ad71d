//! A page computes no heat: it is loaded over a line, and has no room for what it would not show. Part of `heat_stage.rs`.

use serde::{Deserialize, Serialize};

use super::scaling::Scaling;
use crate::math::grid::Grid;
use crate::saved::Saved;
use crate::scene::Scene;
use crate::solve::reynolds::Reynolds;
use crate::solve::traction::TractionLaw;

/// There is none.
pub(super) enum HeatStage {}

/// There is none.
#[derive(Debug, Clone, Serialize, Deserialize)]
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
    pub(super) film_k: f64,
    pub(super) mean_k: f64,
    pub(super) share_1: f64,
}

/// See `heat_stage.rs`.
#[expect(dead_code, reason = "nobody reads it here")]
pub(super) struct SolvedStep<'a> {
    pub(super) grid: &'a Grid,
    pub(super) scaling: &'a Scaling,
    pub(super) law: &'a TractionLaw,
    pub(super) pressure: &'a [f64],
    pub(super) film: &'a [f64],
    pub(super) flow: Option<&'a Reynolds>,
    pub(super) entrainment_m_s: f64,
    pub(super) sliding_m_s: f64,
}

/// See `heat_stage.rs`.
#[derive(Clone, Copy)]
#[expect(dead_code, reason = "nobody reads it here")]
pub(super) struct Times {
    pub(super) dt_s: f64,
    pub(super) speeds_m_s: [f64; 2],
}

impl HeatStage {
    pub(super) fn new(_: &Scene, _: &Grid, _: f64) -> Option<Self> {
        None
    }

    pub(super) fn cold(&self) -> Warmth {
        match *self {}
    }

    pub(super) fn feeds_back(&self) -> bool {
        match *self {}
    }

    pub(super) fn thinner(&self) -> Option<(&[f64], f64)> {
        match *self {}
    }

    pub(super) fn shift(&self) -> &[f64] {
        match *self {}
    }

    pub(super) fn greatest_k(&self) -> f64 {
        match *self {}
    }

    pub(super) fn rises(&self) -> [&[f64]; 2] {
        match *self {}
    }

    pub(super) fn film_rise(&self) -> &[f64] {
        match *self {}
    }

    pub(super) fn begin(&mut self, _: &mut Warmth, _: Times) {
        match *self {}
    }

    pub(super) fn find(&mut self, _: &SolvedStep) {
        match *self {}
    }

    pub(super) fn commit(&mut self, _: &mut Warmth) {
        match *self {}
    }

    pub(super) fn soak(&mut self, _: &mut Warmth, _: Times, _: &SolvedStep) {
        match *self {}
    }

    pub(super) fn step(&mut self, _: &mut Warmth, _: Times, _: &SolvedStep) {
        match *self {}
    }

    pub(super) fn count(&self, _: &mut Warmth, _: &Grid, _: (f64, f64)) {
        match *self {}
    }
}

impl Warmth {
    pub(super) fn shift(&self) -> &[f64] {
        match *self {}
    }

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
