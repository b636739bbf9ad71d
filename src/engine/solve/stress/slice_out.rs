//! The stress in the plane y = 0 as it is given out, and the passes that write it.
//!
//! Part of `stress/engine/slice.rs`.

use super::measure::squared;
use super::spec::{StressSpec, Symmetry};
use crate::math::lane_fft::Lanes;
use crate::math::lanes::{C, LANES, V, transpose};
use crate::physics::invariants::Stress6;
use crate::scene::StressMeasure;

/// A greatest effective stress and its place.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct Peak {
    /// Effective stress, p_h.
    pub value: f64,
    /// Along rolling, a.
    pub x: f64,
    /// Across, a.
    pub y: f64,
    /// Depth, a.
    pub z: f64,
}

/// Stress of a body in the plane y = 0: `[k·nx + i]`, k over depths; in p_h, tension positive.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct SliceOut {
    /// σxx.
    pub sxx: Vec<f32>,
    /// σyy.
    pub syy: Vec<f32>,
    /// σzz.
    pub szz: Vec<f32>,
    /// σxz, the signed orthogonal shear.
    pub sxz: Vec<f32>,
    /// σxy; empty for a mirror surface, where it is zero.
    pub sxy: Vec<f32>,
    /// σyz; empty for a mirror surface, where it is zero.
    pub syz: Vec<f32>,
    /// Effective stress by the engine's measure.
    pub effective: Vec<f32>,
    /// Greatest effective stress of the plane, refined between nodes and depths.
    pub peak: Peak,
}

impl SliceOut {
    /// Memory for an engine's slices.
    pub fn new(spec: &StressSpec) -> Self {
        let n = spec.nx * spec.depths.len();
        let odd = match spec.symmetry {
            Symmetry::MirrorY | Symmetry::Line => 0,
            Symmetry::General => n,
        };
        Self {
            sxx: vec![0.0; n],
            syy: vec![0.0; n],
            szz: vec![0.0; n],
            sxz: vec![0.0; n],
            sxy: vec![0.0; odd],
            syz: vec![0.0; odd],
            effective: vec![0.0; n],
            peak: Peak::default(),
        }
    }
}

impl SliceOut {
    /// The state at index `k·nx + i`.
    pub fn state(&self, at: usize) -> Stress6 {
        let fields = [
            &self.sxx, &self.syy, &self.szz, &self.sxy, &self.sxz, &self.syz,
        ];
        Stress6::of(fields.map(|field| field.get(at).map_or(0.0, |v| f64::from(*v))))
    }
}

dispatched! {
/// Depths into the lanes.
pub(super) fn turn_depths(sums: &[[C; LANES]; 6], o: usize, stride: usize, fields: &mut Lanes) {
    for (component, rows) in sums.iter().enumerate() {
        let (mut re, mut im) = ([V::ZERO; LANES], [V::ZERO; LANES]);
        for (l, c) in rows.iter().enumerate() {
            re[l] = c.re;
            im[l] = c.im;
        }
        let o = o + component * stride;
        fields.re[o..o + LANES].copy_from_slice(&transpose(&re));
        fields.im[o..o + LANES].copy_from_slice(&transpose(&im));
    }
}
}

dispatched! {
/// Components and effective stress of sixteen depths from `first` on.
pub(super) fn write_rows(spec: &StressSpec, first: usize, along_x: &mut [Lanes; 3], out: &mut SliceOut) {
    let [a, b, c] = along_x;
    if spec.symmetry == Symmetry::MirrorY {
        c.re.fill(V::ZERO);
        c.im.fill(V::ZERO);
    }
    let depths = (spec.depths.len() - first).min(LANES);
    let mut i = 0;
    while i < spec.nx {
        let count = LANES.min(spec.nx - i);
        let mut tile = [V::ZERO; LANES];
        for (l, slot) in tile.iter_mut().enumerate().take(count) {
            let j = i + l;
            *slot = effective(spec.measure, [a.re[j], a.im[j], b.re[j], b.im[j], c.re[j], c.im[j]]);
        }
        let part = |lanes: &[V]| {
            let mut tile = [V::ZERO; LANES];
            tile[..count].copy_from_slice(&lanes[i..i + count]);
            tile
        };
        let place = (first, depths, i, count, spec.nx);
        write_tile(&tile, place, &mut out.effective);
        write_tile(&part(&a.re), place, &mut out.sxx);
        write_tile(&part(&a.im), place, &mut out.syy);
        write_tile(&part(&b.re), place, &mut out.szz);
        write_tile(&part(&b.im), place, &mut out.sxz);
        if spec.symmetry == Symmetry::General {
            write_tile(&part(&c.re), place, &mut out.sxy);
            write_tile(&part(&c.im), place, &mut out.syz);
        }
        i += LANES;
    }
}
}

/// Effective stress of xx, yy, zz, xz, xy, yz.
#[inline(always)]
fn effective(measure: StressMeasure, [xx, yy, zz, xz, xy, yz]: [V; 6]) -> V {
    let (mut square, mut top) = (V::ZERO, [0.0; LANES]);
    squared(
        measure,
        [xx - yy, yy - zz, xy, xz, yz],
        &[1.0; LANES],
        &mut square,
        &mut top,
    );
    V(square.0.map(f32::sqrt))
}

#[inline(always)]
fn write_tile(
    tile: &[V; LANES],
    (first, depths, i, count, nx): (usize, usize, usize, usize, usize),
    out: &mut [f32],
) {
    let rows = transpose(tile);
    for (l, row) in rows.iter().enumerate().take(depths) {
        let o = (first + l) * nx + i;
        out[o..o + count].copy_from_slice(&row.0[..count]);
    }
}
