//! Spectra of the five stresses that the invariants need, sixteen kx at a time.
//!
//! ```text
//! d1 = σxx − σyy = E [2Q − (nx² − ny²) A]          d2 = σyy − σzz = E [p̂ + kz D − 2νD − ny² A]
//! σxy = E (i ny q̂ − nx ny A)    σxz = E (−q̂ + i nx kz D)    σyz = E i ny kz D
//! ```
//! For a mode −ky, `ny` changes sign: d1, d2, σxz keep their factors, those of σxy and σyz turn.
//! Pressure and traction are formed apart: both bodies, with and without traction, are sums and differences
//! of the two. Without pressure, with `B = 2ν + kz`:
//! ```text
//! q_x:  d1 = i nx E [2 − (nx² − ny²) B] q̂x      d2 = i nx E [2ν − kz − ny² B] q̂x
//!       σxy = i ny E [1 − nx² B] q̂x    σxz = E [nx² kz − 1] q̂x    σyz = E nx ny kz q̂x
//! ```
//!
//! Part of `stress/mod.rs`: its responses, added and subtracted.

use super::layer::{Layer, LowRow, Waves};
use super::load::{Half, Spectrum};
use super::window::LOW;
use crate::math::lane_fft::Lanes;
use crate::math::lanes::{LANES, V};

/// The part of the load whose stress is formed: the effective stress of several loadings is reduced from the
/// fields of these two.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Part {
    /// Pressure.
    Normal,
    /// Traction along x.
    AlongX,
}

/// One lane's complex number.
type ComplexLane = (f32, f32);

/// d1, d2, xy, xz, yz of one lane.
type DeviatorLane = [ComplexLane; 5];

/// 2ν and 1 − 2ν.
#[derive(Clone, Copy)]
struct PoissonTerms {
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
fn normal(m: Mode, s: PoissonTerms, (re, im): ComplexLane) -> DeviatorLane {
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

/// Times i.
#[inline(always)]
fn turned(factor: f32, (re, im): ComplexLane) -> ComplexLane {
    (-factor * im, factor * re)
}

#[inline(always)]
fn along_x(m: Mode, s: PoissonTerms, x: ComplexLane) -> DeviatorLane {
    let Mode { e, kz, nx, ny } = m;
    let b = s.two_nu + kz;
    let (e_x, e_y) = (e * nx, e * ny);
    let (fxz, fyz) = (e * (nx * nx * kz - 1.0), e_x * ny * kz);
    [
        turned(e_x * (2.0 - (nx * nx - ny * ny) * b), x),
        turned(e_x * (s.two_nu - kz - ny * ny * b), x),
        turned(e_y * (1.0 - nx * nx * b), x),
        (fxz * x.0, fxz * x.1),
        (fyz * x.0, fyz * x.1),
    ]
}

/// A windowed mode under pressure; `ny` is the sign of ky.
#[inline(always)]
fn low_normal(row: &LowRow, l: usize, ny: f32, p: ComplexLane) -> DeviatorLane {
    let t = |i: usize| row.p[i].0[l];
    let xy = ny * t(3);
    [
        (t(0) * p.0, t(0) * p.1),
        (t(1) * p.0, t(1) * p.1),
        (xy * p.0, xy * p.1),
        turned(t(4), p),
        turned(ny * t(5), p),
    ]
}

/// Same under traction along x.
#[inline(always)]
fn low_along_x(row: &LowRow, l: usize, ny: f32, x: ComplexLane) -> DeviatorLane {
    let t = |i: usize| row.x[i].0[l];
    let yz = ny * t(5);
    [
        turned(t(0), x),
        turned(t(1), x),
        turned(ny * t(3), x),
        (t(4) * x.0, t(4) * x.1),
        (yz * x.0, yz * x.1),
    ]
}

/// What a mirror surface transforms: even and odd parts packed, at ky and at −ky.
#[inline(always)]
fn folded([d1, d2, xy, xz, yz]: DeviatorLane) -> DeviatorLane {
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
fn plain(five: DeviatorLane) -> DeviatorLane {
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
struct ModeRow<'a> {
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

impl ModeRow<'_> {
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
    fn p(&self, l: usize) -> ComplexLane {
        (self.p.0.0[l], self.p.1.0[l])
    }

    #[inline(always)]
    fn x(&self, l: usize) -> ComplexLane {
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
) -> ModeRow<'a> {
    let i = block * waves.modes_y + y;
    ModeRow {
        e: &layer.e[block * layer.rows + y],
        k: &waves.k[i],
        nx: &waves.nx[i],
        ny: &waves.ny[i],
        p: (&half.p.re[i], &half.p.im[i]),
        x: (&half.x.re[i], &half.x.im[i]),
        z: layer.z as f32,
        sign,
    }
}

/// Fills the inputs of the transforms along y of one block, for the material of table `material` with
/// Poisson's ratio `nu`.
///
/// Mirror: three buffers d1 + xy, d2 + yz, xz (an even and an odd one share a transform).
/// General: five buffers, one each.
pub(super) fn block_inputs(
    layer: &Layer,
    block: usize,
    waves: &Waves,
    spectrum: &Spectrum,
    (material, nu): (usize, f64),
    part: Part,
    out: &mut [Lanes],
) {
    let elastic = PoissonTerms {
        two_nu: (2.0 * nu) as f32,
        one_less_two_nu: (1.0 - 2.0 * nu) as f32,
    };
    let low = &layer.low[material];
    match &spectrum.minus {
        None => mirror_inputs(layer, low, block, waves, &spectrum.plus, elastic, part, out),
        Some(minus) => {
            let plus = &spectrum.plus;
            general_inputs(layer, low, block, waves, plus, 1.0, elastic, part, out);
            general_inputs(layer, low, block, waves, minus, -1.0, elastic, part, out);
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

/// Sixteen lanes of one row: windowed below [`tabulated_rows`], the kernel's own spectrum beyond.
macro_rules! five_of {
    ($shape:ident, $part:expr, $windowed:expr, $r:ident, $t:ident, $sign:expr, $s:ident) => {
        match ($part, $windowed) {
            (Part::Normal, false) => in_lanes!(l => $shape(normal($r.mode(l), $s, $r.p(l)))),
            (Part::Normal, true) => in_lanes!(l => $shape(low_normal($t, l, $sign, $r.p(l)))),
            (Part::AlongX, false) => in_lanes!(l => $shape(along_x($r.mode(l), $s, $r.x(l)))),
            (Part::AlongX, true) => in_lanes!(l => $shape(low_along_x($t, l, $sign, $r.x(l)))),
        }
    };
}

dispatched! {
fn mirror_inputs(
    layer: &Layer,
    low: &[LowRow],
    block: usize,
    waves: &Waves,
    half: &Half,
    elastic: PoissonTerms,
    part: Part,
    out: &mut [Lanes],
) {
    let n = layer.n_y;
    for y in 0..layer.rows {
        let r = row_of(layer, waves, half, (block, y), 1.0);
        let t = &low[y.min(LOW - 1)];
        let five = five_of!(folded, part, y < tabulated_rows(block), r, t, 1.0, elastic);
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
    low: &[LowRow],
    block: usize,
    waves: &Waves,
    half: &Half,
    sign: f32,
    elastic: PoissonTerms,
    part: Part,
    out: &mut [Lanes],
) {
    let n = layer.n_y;
    for y in 0..layer.rows {
        let r = row_of(layer, waves, half, (block, y), sign);
        let t = &low[y.min(LOW - 1)];
        let five = five_of!(plain, part, y < tabulated_rows(block), r, t, sign, elastic);
        let i = if sign > 0.0 { y } else { (n - y) % n };
        for (buffer, five) in out.iter_mut().zip(five) {
            (buffer.re[i], buffer.im[i]) = five;
        }
    }
}
}
