//! Rows of a layer between its two passes, and their reduction to one measure.
//!
//! Part of `stress/engine/volume.rs`.

use super::layer::Layer;
use super::measure::{power_sum, squared};
use crate::math::fused::Fused as _;
use crate::math::lane_fft::Lanes;
use crate::math::lanes::{LANES, TILE, V, transpose_tile};
use crate::scene::StressMeasure;

/// Index of a layer's row (may be below the axis) in its period.
#[inline(always)]
fn wrapped(layer: &Layer, row: usize) -> usize {
    (layer.first_row + row as isize).rem_euclid(layer.n_y as isize) as usize
}

#[inline(always)]
fn store(fields: &mut [V], layer: &Layer, block: usize, slot: usize, tile: &mut [f32; TILE]) {
    transpose_tile(tile);
    let o = slot * layer.blocks * LANES + block * LANES;
    for (v, row) in fields[o..o + LANES]
        .iter_mut()
        .zip(tile.chunks_exact(LANES))
    {
        v.0.copy_from_slice(row);
    }
}

dispatched! {
/// Even and odd field of buffer `which` at y ≥ 0 apart, rows into the lanes.
pub(super) fn unfold_rows(layer: &Layer, block: usize, which: usize, z: &Lanes, fields: &mut Lanes) {
    let n = layer.n_y;
    // Buffers hold d1 + xy, d2 + yz, xz; fields are d1, d2, xy, xz, yz.
    let (even_field, odd_field) = [(0, Some(2)), (1, Some(4)), (3, None)][which];
    let blocks = layer.row_blocks();
    for row_block in 0..blocks {
        for (from, to) in [(&z.re, &mut fields.re), (&z.im, &mut fields.im)] {
            let (mut even, mut odd) = ([0.0; TILE], [0.0; TILE]);
            for l in 0..LANES {
                let y = (row_block * LANES + l) % n;
                let o = l * LANES;
                even[o..o + LANES].copy_from_slice(&from[y].0);
                odd[o..o + LANES].copy_from_slice(&from[(n - y) % n].0);
            }
            for i in 0..TILE {
                let (a, b) = (even[i], odd[i]);
                even[i] = 0.5 * (a + b);
                odd[i] = 0.5 * (a - b);
            }
            store(to, layer, block, even_field * blocks + row_block, &mut even);
            if let Some(field) = odd_field {
                store(to, layer, block, field * blocks + row_block, &mut odd);
            }
        }
    }
}
}

dispatched! {
/// Field `which`, rows into the lanes.
pub(super) fn turn_rows(layer: &Layer, block: usize, which: usize, z: &Lanes, fields: &mut Lanes) {
    let blocks = layer.row_blocks();
    for row_block in 0..blocks {
        for (from, to) in [(&z.re, &mut fields.re), (&z.im, &mut fields.im)] {
            let mut rows = [0.0; TILE];
            for (l, row) in rows.chunks_exact_mut(LANES).enumerate() {
                row.copy_from_slice(&from[wrapped(layer, row_block * LANES + l)].0);
            }
            store(to, layer, block, which * blocks + row_block, &mut rows);
        }
    }
}
}

dispatched! {
/// Squares of the measure under pressure and `sign` times the traction, and the greatest of every lane.
pub(super) fn squares_of(
    measure: StressMeasure,
    normal: &[Lanes; 3],
    tangential: Option<(&[Lanes; 3], f32)>,
    weights: V,
    squares: &mut [V],
) -> V {
    let [a, b, c] = normal;
    let inside = weights.0.map(|w| if w > 0.0 { 1.0 } else { 0.0 });
    let mut top = [0.0_f32; LANES];
    match tangential {
        None => {
            for (i, square) in squares.iter_mut().enumerate() {
                let five = [a.re[i], a.im[i], b.re[i], b.im[i], c.re[i]];
                squared(measure, five, &inside, square, &mut top);
            }
        }
        Some(([d, e, f], sign)) => {
            for (i, square) in squares.iter_mut().enumerate() {
                let sum = |n: &[V], t: &[V]| signed_sum(n[i], t[i], sign);
                let five = [
                    sum(&a.re, &d.re),
                    sum(&a.im, &d.im),
                    sum(&b.re, &e.re),
                    sum(&b.im, &e.im),
                    sum(&c.re, &f.re),
                ];
                squared(measure, five, &inside, square, &mut top);
            }
        }
    }
    V(top)
}
}

#[inline(always)]
fn signed_sum(n: V, t: V, sign: f32) -> V {
    let mut out = n;
    for l in 0..LANES {
        out.0[l] = t.0[l].fused(sign, n.0[l]);
    }
    out
}

dispatched! {
/// `Σ weight (square/greatest)^half_exponent`.
pub(super) fn weighted_sum(squares: &[V], top: f32, half_exponent: f32, weights: V) -> f64 {
    let lanes = power_sum(squares, top, half_exponent);
    lanes.0.iter().zip(weights.0).map(|(s, w)| f64::from(*s) * f64::from(w)).sum()
}
}
