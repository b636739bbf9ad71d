//! What is followed of a body, and by which gates.
//!
//! Part of `material.rs`.

use serde::{Deserialize, Serialize};

use crate::solve::damage::BlockSpec;

/// What is followed.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub struct TrackerSpec {
    /// Points, staggered over the track; at least 8 for a mean over phases.
    pub points: usize,
    /// Ends of the track: the domain's edges along x, where the pressure is zero, a.
    pub x_first: f64,
    /// Other end, a.
    pub x_last: f64,
    /// Least range of pressure that counts, p_h.
    pub pressure_gate: f64,
    /// Least range of shear that counts, p_h.
    pub shear_gate: f64,
    /// Least range of effective stress that counts, p_h.
    pub effective_gate: f64,
    /// Depths at which shear is followed (0: pressure alone); the slice's own depths.
    pub depths: usize,
    /// Depth of the point that is shown, an index below `depths`.
    pub shown_depth: usize,
    /// Exponent of Miner's sum of ranges.
    pub damage_exponent: f64,
    /// Samples kept of the shown point's crossing.
    pub trace: usize,
    /// Damage map of a block of the surface; `None`: not kept.
    pub map: Option<BlockSpec>,
}

impl TrackerSpec {
    /// Gate on the pressure's ranges, p_h. Chosen: what 5 % does to the count is in `material.rs`.
    pub const PRESSURE_GATE: f64 = 0.05;
    /// Gate on the shear's ranges, p_h: the same part of its own scale (τ_xz of Hertz swings by 0.5 p_h).
    pub const SHEAR_GATE: f64 = 0.02;
    /// Gate on the effective stress's ranges, p_h: the same part of its scale (0.62 p_h under Hertz).
    pub const EFFECTIVE_GATE: f64 = 0.03;
    /// Points where a damage map is kept: those of three waves of .43 a fill its 24 columns.
    pub const MAP_POINTS: usize = 128;

    /// Sixteen points, default gates.
    pub fn new((x_first, x_last): (f64, f64), depths: usize, damage_exponent: f64) -> Self {
        Self {
            points: 16,
            x_first,
            x_last,
            pressure_gate: Self::PRESSURE_GATE,
            shear_gate: Self::SHEAR_GATE,
            effective_gate: Self::EFFECTIVE_GATE,
            depths,
            shown_depth: 0,
            damage_exponent,
            trace: 2048,
            map: None,
        }
    }
}
