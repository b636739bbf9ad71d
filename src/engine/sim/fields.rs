//! Stress, damage and the material point of a frame: SI, plain data, `f32` fields.

use std::sync::Arc;

/// Stress of body 1 in a plane: index `row * width + i`.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct StressPlane {
    /// Axis that the plane is normal to: `'x'`, `'y'` or `'z'`.
    pub normal: char,
    /// Where it cuts that axis, m.
    pub at_m: f64,
    /// Points along a row: along y for x = const, else along x.
    pub width: usize,
    /// Rows: depths as in the slice, but along y for z = const.
    pub rows: usize,
    /// First coordinate along a row, m.
    pub first_m: f64,
    /// Spacing along a row, m.
    pub step_m: f64,
    /// Effective stress, Pa.
    pub effective_pa: Vec<f32>,
    /// Principal stresses, greatest (most tensile) first, Pa.
    pub principal_pa: [Vec<f32>; 3],
}

/// Damage of a block of one surface that moves with its body: index `column * depths + k`.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct DamageBlock {
    /// Length of the block along the surface, m: one wavelength, or the whole track of a smooth body. Columns
    /// divide it evenly; place 0 is a crest.
    pub length_m: f64,
    /// Columns.
    pub columns: usize,
    /// Depths below the surface, m, increasing.
    pub depths_m: Arc<[f64]>,
    /// Damage of one crossing by Miner's rule over that of the worst point of the smooth contact; 0 where no
    /// material point has crossed yet. Of all cycles ([`super::Frame::suffered`]): that of them, 1 at a pit; 0 where the
    /// material is worn off.
    pub damage: Vec<f32>,
    /// Columns that have been crossed.
    pub filled: usize,
    /// Middle of the worst column, distance from a crest, m.
    pub pit_place_m: f64,
    /// Depth of the worst point, m.
    pub pit_depth_m: f64,
    /// Its damage.
    pub pit_damage: f64,
}

/// Stress in the plane y = 0 below a body's surface: index `k * nx + i`, `k` over depths.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct StressSlice {
    /// Depths below the surface, m, increasing.
    pub depths_m: Arc<[f64]>,
    /// Effective stress by the scene's measure (von Mises by default), Pa.
    pub effective_pa: Vec<f32>,
    /// Signed orthogonal shear, Pa.
    pub tau_xz_pa: Vec<f32>,
}

/// Which material point is shown. It changes no result.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Follow {
    /// Body: 1 or 2.
    pub body: u8,
    /// The nearest depth that is computed, m.
    pub depth_m: f64,
    /// The nearest of the points that are counted, m; `None`: the one that is shown.
    pub x_m: Option<f64>,
}

/// A point of body 1 or 2 that crosses the contact at its body's speed.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct MaterialPoint {
    /// Body: 1 or 2.
    pub body: u8,
    /// Where it is now, m.
    pub x_m: f64,
    /// Depth at which its stress is given, m.
    pub depth_m: f64,
    /// Pressure on the surface above it, Pa.
    pub pressure_pa: f64,
    /// Effective stress at the point, Pa.
    pub effective_pa: f64,
    /// Signed orthogonal shear at the point, Pa.
    pub tau_xz_pa: f64,
    /// Peaks of the pressure passed so far in this crossing, each of which closes one cycle (a peak has passed
    /// when the pressure has fallen from it by rainflow's gate, 5 % of p_h).
    pub cycles_counted: f64,
    /// The last of them.
    pub last_peak: Option<PassedPeak>,
    /// Cycles that rainflow closed in the point's last whole crossing.
    pub cycles_before: Option<f64>,
}

/// A peak of the pressure on a material point.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct PassedPeak {
    /// Where, m.
    pub x_m: f64,
    /// How high, Pa.
    pub pressure_pa: f64,
}
