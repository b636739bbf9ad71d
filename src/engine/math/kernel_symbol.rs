//! Transforms of kernels sampled at node offsets on a padded grid: the symbols of a [`super::filter::Filter`].
//!
//! Tested there: a filter with such a symbol is the direct sum.

use std::cmp::Ordering;
use std::f64::consts::PI;

use rustfft::FftPlanner;
use rustfft::num_complex::Complex;

/// At which frequencies along an axis of length `l`.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum At {
    /// k = 0 .. l/2.
    Whole,
    /// k = ½, 3/2 .. below l/2: what lies beyond half the length counts with the other sign.
    Halfway,
}

/// Of a kernel that repeats.
pub const REPEATING: (At, At) = (At::Whole, At::Whole);

impl At {
    /// Frequencies for length `l`.
    pub fn len(self, l: usize) -> usize {
        match self {
            Self::Whole => l / 2 + 1,
            Self::Halfway => l / 2,
        }
    }
}

/// The transform of a kernel `k(x, y)` that is even in both, sampled at node offsets, on the padded
/// grid: `[kx][ky]`, both to half the length, real.
pub fn even_kernel_symbol(
    (lx, ly): (usize, usize),
    at: (At, At),
    kernel: impl Fn(usize, usize) -> f64,
) -> Vec<f64> {
    let sample = |i: usize, j: usize| kernel(i.min(lx - i), j);
    symbol((lx, ly), at, sample, |v| v.re)
}

/// The imaginary part of the transform of a kernel that is odd in x and even in y: `[kx][ky]`.
pub fn odd_kernel_symbol(
    (lx, ly): (usize, usize),
    at: (At, At),
    kernel: impl Fn(usize, usize) -> f64,
) -> Vec<f64> {
    let sample = |i: usize, j: usize| {
        // Zero where the period makes +L and −L the same offset.
        if i == 0 || 2 * i == lx {
            0.0
        } else if 2 * i < lx {
            kernel(i, j)
        } else {
            -kernel(lx - i, j)
        }
    };
    symbol((lx, ly), at, sample, |v| v.im)
}

/// Transforms of `sample(i, j)`, i over the whole period in x, j over half of it in y (even): of the x
/// transform the part that is not zero, of the y transform the real one.
fn symbol(
    (lx, ly): (usize, usize),
    (along_x, along_y): (At, At),
    sample: impl Fn(usize, usize) -> f64,
    part: fn(&Complex<f64>) -> f64,
) -> Vec<f64> {
    // Of the rows half the offsets along y are needed.
    let (nkx, nky) = (along_x.len(lx), ly / 2 + 1);
    let mut planner = FftPlanner::<f64>::new();
    let (fx, fy) = (planner.plan_fft_forward(lx), planner.plan_fft_forward(ly));
    let mut table = vec![0.0; nky * nkx];
    let mut line = vec![Complex::new(0.0, 0.0); lx];
    for (j, row) in table.chunks_exact_mut(nkx).enumerate() {
        for (i, v) in line.iter_mut().enumerate() {
            *v = sample(i, j) * turn(along_x, i, lx);
        }
        fx.process(&mut line);
        for (o, v) in row.iter_mut().zip(&line) {
            *o = part(v);
        }
    }
    let turns: Vec<Complex<f64>> = (0..ly).map(|j| turn(along_y, j, ly)).collect();
    let mut column = vec![Complex::new(0.0, 0.0); ly];
    let n_out = along_y.len(ly);
    let mut out = vec![0.0; nkx * n_out];
    for (kx, line) in out.chunks_exact_mut(n_out).enumerate() {
        for (j, (v, turn)) in column.iter_mut().zip(&turns).enumerate() {
            *v = table[j.min(ly - j) * nkx + kx] * turn;
        }
        fy.process(&mut column);
        for (o, v) in line.iter_mut().zip(&column) {
            *o = v.re;
        }
    }
    out
}

/// What a sample at offset `j` is multiplied with: e^{−iπj/l} shifts the frequencies by half, and beyond half the
/// length, where offsets are j − l, the sign turns.
fn turn(at: At, j: usize, l: usize) -> Complex<f64> {
    let sign = match (2 * j).cmp(&l) {
        Ordering::Less => 1.0,
        Ordering::Equal => 0.0,
        Ordering::Greater => -1.0,
    };
    match at {
        At::Whole => Complex::new(1.0, 0.0),
        At::Halfway => Complex::from_polar(sign, -PI * j as f64 / l as f64),
    }
}
