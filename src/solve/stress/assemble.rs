//! Spectra of the five stresses that the invariants need, sixteen kx at a time.
//!
//! ```text
//! d1 = σxx − σyy = E [2Q − (nx² − ny²) A]          d2 = σyy − σzz = E [p̂ + kz D − 2νD − ny² A]
//! σxy = E (i ny q̂ − nx ny A)    σxz = E (−q̂ + i nx kz D)    σyz = E i ny kz D
//! ```
//! For a mode −ky, `ny` changes sign: d1, d2, σxz keep their factors, those of σxy and σyz turn.

use super::fft::Lanes;
use super::lanes::{LANES, V};
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

/// One lane's complex number.
type Z = (f32, f32);

/// d1, d2, xy, xz, yz of one lane.
type Five = [Z; 5];

/// 2ν and 1 − 2ν.
#[derive(Clone, Copy)]
struct Elastic {
    two_nu: f32,
    one_less_two_nu: f32,
}

/// One lane's e^{−kz}, kz and direction.
#[derive(Clone, Copy)]
struct Mode {
    e: f32,
    kz: f32,
    nx: f32,
    ny: f32,
}

#[inline(always)]
fn normal(m: Mode, s: Elastic, (re, im): Z) -> Five {
    let Mode { e, kz, nx, ny } = m;
    let a = (s.one_less_two_nu - kz) * e;
    let e_kz = e * kz;
    let f1 = (ny * ny - nx * nx) * a;
    let f2 = s.one_less_two_nu * e + e_kz - ny * ny * a;
    let (fxy, fxz, fyz) = (-nx * ny * a, nx * e_kz, ny * e_kz);
    [
        (f1 * re, f1 * im),
        (f2 * re, f2 * im),
        (fxy * re, fxy * im),
        (-fxz * im, fxz * re),
        (-fyz * im, fyz * re),
    ]
}

#[inline(always)]
fn both(m: Mode, s: Elastic, p: Z, x: Z) -> Five {
    let Mode { e, kz, nx, ny } = m;
    let q = (-nx * x.1, nx * x.0);
    let d = (p.0 - q.0, p.1 - q.1);
    let a0 = s.one_less_two_nu * p.0 + s.two_nu * q.0 - kz * d.0;
    let a1 = s.one_less_two_nu * p.1 + s.two_nu * q.1 - kz * d.1;
    let (f1, f2, fxy) = (ny * ny - nx * nx, kz - s.two_nu, nx * ny);
    let (fxz, fyz) = (nx * kz, ny * kz);
    [
        (e * (2.0 * q.0 + f1 * a0), e * (2.0 * q.1 + f1 * a1)),
        (
            e * (p.0 + f2 * d.0 - ny * ny * a0),
            e * (p.1 + f2 * d.1 - ny * ny * a1),
        ),
        (e * (-ny * x.1 - fxy * a0), e * (ny * x.0 - fxy * a1)),
        (e * (-x.0 - fxz * d.1), e * (fxz * d.0 - x.1)),
        (-e * fyz * d.1, e * fyz * d.0),
    ]
}

/// A windowed mode; `ny` is the sign of ky. Without traction `x` is zero.
#[inline(always)]
fn low(row: &LowRow, l: usize, ny: f32, p: Z, x: Z) -> Five {
    let t = |i: usize| row.p[i].0[l];
    let u = |i: usize| row.q[i].0[l];
    let (txy, tyz, uxy, uyz) = (ny * t(3), ny * t(5), ny * u(3), ny * u(5));
    [
        (t(0) * p.0 - u(0) * x.1, t(0) * p.1 + u(0) * x.0),
        (t(1) * p.0 - u(1) * x.1, t(1) * p.1 + u(1) * x.0),
        (txy * p.0 - uxy * x.1, txy * p.1 + uxy * x.0),
        (u(4) * x.0 - t(4) * p.1, u(4) * x.1 + t(4) * p.0),
        (uyz * x.0 - tyz * p.1, uyz * x.1 + tyz * p.0),
    ]
}

/// What a mirror surface transforms: even and odd parts packed, at ky and at −ky.
#[inline(always)]
fn folded([d1, d2, xy, xz, yz]: Five) -> Five {
    [
        (d1.0 + xy.0, d1.1 + xy.1),
        (d2.0 + yz.0, d2.1 + yz.1),
        xz,
        (d1.0 - xy.0, d1.1 - xy.1),
        (d2.0 - yz.0, d2.1 - yz.1),
    ]
}

/// What a general surface transforms.
#[inline(always)]
fn plain(five: Five) -> Five {
    five
}

/// Sixteen lanes of a five. One loop with a long body of scalars and an array for every result: only
/// then does the compiler make vectors of it (a two-dimensional array, or a chain of operations on whole
/// vectors, ends as scalars).
macro_rules! in_lanes {
    ($l:ident => $shape:ident($five:expr)) => {{
        let zero = [0.0_f32; LANES];
        let (mut a_re, mut a_im, mut b_re, mut b_im, mut c_re) = (zero, zero, zero, zero, zero);
        let (mut c_im, mut d_re, mut d_im, mut e_re, mut e_im) = (zero, zero, zero, zero, zero);
        for $l in 0..LANES {
            let [a, b, c, d, e] = $shape($five);
            (a_re[$l], a_im[$l]) = a;
            (b_re[$l], b_im[$l]) = b;
            (c_re[$l], c_im[$l]) = c;
            (d_re[$l], d_im[$l]) = d;
            (e_re[$l], e_im[$l]) = e;
        }
        [
            (V(a_re), V(a_im)),
            (V(b_re), V(b_im)),
            (V(c_re), V(c_im)),
            (V(d_re), V(d_im)),
            (V(e_re), V(e_im)),
        ]
    }};
}

/// Every lane of a row of modes.
#[derive(Clone, Copy)]
struct Row<'a> {
    e: &'a V,
    k: &'a V,
    nx: &'a V,
    ny: &'a V,
    p: (&'a V, &'a V),
    x: (&'a V, &'a V),
    z: f32,
    /// Sign of ky.
    sign: f32,
}

impl Row<'_> {
    #[inline(always)]
    fn mode(&self, l: usize) -> Mode {
        Mode {
            e: self.e.0[l],
            kz: self.k.0[l] * self.z,
            nx: self.nx.0[l],
            ny: self.sign * self.ny.0[l],
        }
    }

    #[inline(always)]
    fn p(&self, l: usize) -> Z {
        (self.p.0.0[l], self.p.1.0[l])
    }

    #[inline(always)]
    fn x(&self, l: usize) -> Z {
        (self.x.0.0[l], self.x.1.0[l])
    }
}

#[inline(always)]
fn row_of<'a>(
    layer: &'a Layer,
    waves: &'a Waves,
    half: &'a Half,
    (block, y): (usize, usize),
    sign: f32,
) -> Row<'a> {
    let i = block * waves.modes_y + y;
    Row {
        e: &layer.e[block * layer.rows + y],
        k: &waves.k[i],
        nx: &waves.nx[i],
        ny: &waves.ny[i],
        p: (&half.p.re[i], &half.p.im[i]),
        x: (&half.q.re[i], &half.q.im[i]),
        z: layer.z as f32,
        sign,
    }
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
        two_nu: (2.0 * nu) as f32,
        one_less_two_nu: (1.0 - 2.0 * nu) as f32,
    };
    match &spectrum.minus {
        None => mirror_inputs(layer, block, waves, &spectrum.plus, elastic, loads, out),
        Some(minus) => {
            let plus = &spectrum.plus;
            general_inputs(layer, block, waves, plus, 1.0, elastic, loads, out);
            general_inputs(layer, block, waves, minus, -1.0, elastic, loads, out);
        }
    }
    let (n, rows) = (layer.n_y, layer.rows);
    for buffer in out {
        buffer.re[rows..=n - rows].fill(V::ZERO);
        buffer.im[rows..=n - rows].fill(V::ZERO);
    }
}

/// Rows of this block that are tabulated.
#[inline(always)]
fn tabulated_rows(block: usize) -> usize {
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
    out: &mut [Lanes],
) {
    let n = layer.n_y;
    for y in 0..layer.rows {
        let r = row_of(layer, waves, half, (block, y), 1.0);
        let t = &layer.low[y.min(LOW - 1)];
        let five = match (loads, y < tabulated_rows(block)) {
            (Loads::Normal, false) => in_lanes!(l => folded(normal(r.mode(l), elastic, r.p(l)))),
            (Loads::Both, false) => in_lanes!(l => folded(both(r.mode(l), elastic, r.p(l), r.x(l)))),
            (Loads::Normal, true) => in_lanes!(l => folded(low(t, l, 1.0, r.p(l), (0.0, 0.0)))),
            (Loads::Both, true) => in_lanes!(l => folded(low(t, l, 1.0, r.p(l), r.x(l)))),
        };
        let minus = (n - y) % n;
        for (buffer, (plus, at_minus)) in out.iter_mut().zip([(0, 3), (1, 4), (2, 2)]) {
            (buffer.re[minus], buffer.im[minus]) = five[at_minus];
            (buffer.re[y], buffer.im[y]) = five[plus];
        }
    }
}
}

dispatched! {
fn general_inputs(
    layer: &Layer,
    block: usize,
    waves: &Waves,
    half: &Half,
    sign: f32,
    elastic: Elastic,
    loads: Loads,
    out: &mut [Lanes],
) {
    let n = layer.n_y;
    for y in 0..layer.rows {
        let r = row_of(layer, waves, half, (block, y), sign);
        let t = &layer.low[y.min(LOW - 1)];
        let five = match (loads, y < tabulated_rows(block)) {
            (Loads::Normal, false) => in_lanes!(l => plain(normal(r.mode(l), elastic, r.p(l)))),
            (Loads::Both, false) => in_lanes!(l => plain(both(r.mode(l), elastic, r.p(l), r.x(l)))),
            (Loads::Normal, true) => in_lanes!(l => plain(low(t, l, sign, r.p(l), (0.0, 0.0)))),
            (Loads::Both, true) => in_lanes!(l => plain(low(t, l, sign, r.p(l), r.x(l)))),
        };
        let i = if sign > 0.0 { y } else { (n - y) % n };
        for (buffer, five) in out.iter_mut().zip(five) {
            (buffer.re[i], buffer.im[i]) = five;
        }
    }
}
}
