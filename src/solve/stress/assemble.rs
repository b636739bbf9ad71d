//! Spectra of the five stresses that the invariants need, sixteen kx at a time.
//!
//! ```text
//! d1 = σxx − σyy = E [2Q − (nx² − ny²) A]          d2 = σyy − σzz = E [p̂ + kz D − 2νD − ny² A]
//! σxy = E (i ny q̂ − nx ny A)    σxz = E (−q̂ + i nx kz D)    σyz = E i ny kz D
//! ```
//! For a mode −ky, `ny` changes sign: d1, d2, σxz keep their factors, those of σxy and σyz turn.

use super::fft::Lanes;
use super::lanes::{C, V};
use super::layer::{Layer, LowRow, Waves};
use super::load::{Half, Spectrum};
use super::window::LOW;

/// Which loads act.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Loads {
    /// Pressure alone.
    Normal,
    /// Pressure and traction.
    Both,
}

/// d1, d2, xy, xz, yz.
type Five = [C; 5];

/// Factors of a mode.
#[derive(Clone, Copy)]
struct Mode {
    e: V,
    kz: V,
    nx: V,
    ny: V,
}

/// Poisson's ratio as lanes.
#[derive(Clone, Copy)]
struct Elastic {
    two_nu: V,
    one_less_two_nu: V,
}

#[inline(always)]
fn normal(m: Mode, s: Elastic, p: C) -> Five {
    let (nx2, ny2) = (m.nx * m.nx, m.ny * m.ny);
    let a = (s.one_less_two_nu - m.kz) * m.e;
    let e_kz = m.e * m.kz;
    [
        p.scale((ny2 - nx2) * a),
        p.scale(ny2.fnma(a, s.one_less_two_nu.fma(m.e, e_kz))),
        p.scale(-(m.nx * m.ny * a)),
        p.scale_i(m.nx * e_kz),
        p.scale_i(m.ny * e_kz),
    ]
}

#[inline(always)]
fn both(m: Mode, s: Elastic, p: C, x: C) -> Five {
    let (nx2, ny2) = (m.nx * m.nx, m.ny * m.ny);
    let q = x.scale_i(m.nx);
    let d = p.minus(q);
    let a = d.fma(-m.kz, q.fma(s.two_nu, p.scale(s.one_less_two_nu)));
    let d1 = a.fma(ny2 - nx2, q.plus(q));
    let d2 = a.fma(-ny2, d.fma(m.kz - s.two_nu, p));
    let xy = a.fma(-(m.nx * m.ny), x.scale_i(m.ny));
    let xz = d.scale_i(m.nx * m.kz).minus(x);
    let yz = d.scale_i(m.ny * m.kz);
    [d1, d2, xy, xz, yz].map_scale(m.e)
}

trait MapScale {
    fn map_scale(self, a: V) -> Self;
}

impl MapScale for Five {
    #[inline(always)]
    fn map_scale(self, a: V) -> Self {
        [
            self[0].scale(a),
            self[1].scale(a),
            self[2].scale(a),
            self[3].scale(a),
            self[4].scale(a),
        ]
    }
}

/// The windowed modes; `ny` is the sign of ky.
#[inline(always)]
fn low(row: &LowRow, ny: V, p: C, x: C, loads: Loads) -> Five {
    let [t1, t2, _, txy, txz, tyz] = row.p;
    let five = [
        p.scale(t1),
        p.scale(t2),
        p.scale(txy * ny),
        p.scale_i(txz),
        p.scale_i(tyz * ny),
    ];
    if loads == Loads::Normal {
        return five;
    }
    let [t1, t2, _, txy, txz, tyz] = row.q;
    [
        x.fma_i(t1, five[0]),
        x.fma_i(t2, five[1]),
        x.fma_i(txy * ny, five[2]),
        x.fma(txz, five[3]),
        x.fma(tyz * ny, five[4]),
    ]
}

#[inline(always)]
fn at(lanes: &Lanes, i: usize) -> C {
    C {
        re: lanes.re[i],
        im: lanes.im[i],
    }
}

#[inline(always)]
fn put(lanes: &mut Lanes, i: usize, c: C) {
    lanes.re[i] = c.re;
    lanes.im[i] = c.im;
}

/// Fills the inputs of the transforms along y of one block.
///
/// Mirror: three buffers d1 + xy, d2 + yz, xz (an even and an odd one share a transform).
/// General: five buffers, one each.
pub(super) fn block_inputs(
    layer: &Layer,
    block: usize,
    waves: &Waves,
    spectrum: &Spectrum,
    nu: f64,
    loads: Loads,
    out: &mut [Lanes],
) {
    let elastic = Elastic {
        two_nu: V::splat((2.0 * nu) as f32),
        one_less_two_nu: V::splat((1.0 - 2.0 * nu) as f32),
    };
    match (&spectrum.minus, out) {
        (None, [a, b, c, ..]) => {
            mirror_inputs(
                layer,
                block,
                waves,
                &spectrum.plus,
                elastic,
                loads,
                [a, b, c],
            );
        }
        (Some(minus), [a, b, c, d, e]) => {
            let halves = [&spectrum.plus, minus];
            general_inputs(layer, block, waves, halves, elastic, loads, [a, b, c, d, e]);
        }
        _ => debug_assert!(false, "five buffers for a general surface"),
    }
}

#[inline(always)]
fn mode(layer: &Layer, block: usize, waves: &Waves, y: usize, z: V) -> Mode {
    let w = block * waves.modes_y + y;
    Mode {
        e: layer.e[block * layer.rows + y],
        kz: waves.k[w] * z,
        nx: waves.nx[w],
        ny: waves.ny[w],
    }
}

#[inline(always)]
fn first_analytic_row(block: usize) -> usize {
    if block == 0 { LOW } else { 0 }
}

dispatched! {
fn mirror_inputs(
    layer: &Layer,
    block: usize,
    waves: &Waves,
    half: &Half,
    elastic: Elastic,
    loads: Loads,
    out: [&mut Lanes; 3],
) {
    let [a, b, c] = out;
    let (n, rows, z) = (layer.n_y, layer.rows, V::splat(layer.z as f32));
    let start = block * waves.modes_y;
    let first = first_analytic_row(block);
    for y in 0..first {
        let (p, x) = (at(&half.p, start + y), at(&half.q, start + y));
        store_mirror(low(&layer.low[y], V::splat(1.0), p, x, loads), y, n, a, b, c);
    }
    match loads {
        Loads::Normal => {
            for y in first..rows {
                let m = mode(layer, block, waves, y, z);
                store_mirror(normal(m, elastic, at(&half.p, start + y)), y, n, a, b, c);
            }
        }
        Loads::Both => {
            for y in first..rows {
                let m = mode(layer, block, waves, y, z);
                let (p, x) = (at(&half.p, start + y), at(&half.q, start + y));
                store_mirror(both(m, elastic, p, x), y, n, a, b, c);
            }
        }
    }
    for buffer in [a, b, c] {
        clear(buffer, rows, n);
    }
}
}

#[inline(always)]
fn store_mirror(five: Five, y: usize, n: usize, a: &mut Lanes, b: &mut Lanes, c: &mut Lanes) {
    let [d1, d2, xy, xz, yz] = five;
    put(a, y, d1.plus(xy));
    put(b, y, d2.plus(yz));
    put(c, y, xz);
    if y > 0 {
        put(a, n - y, d1.minus(xy));
        put(b, n - y, d2.minus(yz));
        put(c, n - y, xz);
    }
}

#[inline(always)]
fn clear(buffer: &mut Lanes, rows: usize, n: usize) {
    buffer.re[rows..=n - rows].fill(V::ZERO);
    buffer.im[rows..=n - rows].fill(V::ZERO);
}

dispatched! {
fn general_inputs(
    layer: &Layer,
    block: usize,
    waves: &Waves,
    halves: [&Half; 2],
    elastic: Elastic,
    loads: Loads,
    out: [&mut Lanes; 5],
) {
    let (n, rows, z) = (layer.n_y, layer.rows, V::splat(layer.z as f32));
    let start = block * waves.modes_y;
    let first = first_analytic_row(block);
    let [a, b, c, d, e] = out;
    for (sign, half) in [1.0, -1.0].into_iter().zip(halves) {
        let sign = V::splat(sign);
        for y in 0..rows {
            let (p, x) = (at(&half.p, start + y), at(&half.q, start + y));
            let five = if y < first {
                low(&layer.low[y], sign, p, x, loads)
            } else {
                let mut m = mode(layer, block, waves, y, z);
                m.ny = m.ny * sign;
                match loads {
                    Loads::Normal => normal(m, elastic, p),
                    Loads::Both => both(m, elastic, p, x),
                }
            };
            let i = if sign.0[0] > 0.0 || y == 0 { y } else { n - y };
            put(a, i, five[0]);
            put(b, i, five[1]);
            put(c, i, five[2]);
            put(d, i, five[3]);
            put(e, i, five[4]);
        }
    }
    for buffer in [a, b, c, d, e] {
        clear(buffer, rows, n);
    }
}
}
