//! Transforms of kernels sampled at node offsets on a padded grid: the symbols of a [`super::filter::Filter`].
//!
//! Tested there: a filter with such a symbol is the direct sum.

use rustfft::FftPlanner;
use rustfft::num_complex::Complex;

/// The transform of a kernel `k(x, y)` that is even in both, sampled at node offsets, on the padded
/// grid: `[kx][ky]`, both to half the length, real.
pub fn even_kernel_symbol(lx: usize, ly: usize, kernel: impl Fn(usize, usize) -> f64) -> Vec<f64> {
    let sample = |i: usize, j: usize| kernel(i.min(lx - i), j);
    symbol(lx, ly, sample, |v| v.re)
}

/// The imaginary part of the transform of a kernel that is odd in x and even in y: `[kx][ky]`.
pub fn odd_kernel_symbol(lx: usize, ly: usize, kernel: impl Fn(usize, usize) -> f64) -> Vec<f64> {
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
    symbol(lx, ly, sample, |v| v.im)
}

/// Transforms of `sample(i, j)`, i over the whole period in x, j over half of it in y (even): of the x
/// transform the part that is not zero, of the y transform the real one.
fn symbol(
    lx: usize,
    ly: usize,
    sample: impl Fn(usize, usize) -> f64,
    part: fn(&Complex<f64>) -> f64,
) -> Vec<f64> {
    let (nkx, nky) = (lx / 2 + 1, ly / 2 + 1);
    let mut planner = FftPlanner::<f64>::new();
    let (fx, fy) = (planner.plan_fft_forward(lx), planner.plan_fft_forward(ly));
    let mut table = vec![0.0; nky * nkx];
    let mut line = vec![Complex::new(0.0, 0.0); lx];
    for (j, row) in table.chunks_exact_mut(nkx).enumerate() {
        for (i, v) in line.iter_mut().enumerate() {
            *v = Complex::new(sample(i, j), 0.0);
        }
        fx.process(&mut line);
        for (o, v) in row.iter_mut().zip(&line) {
            *o = part(v);
        }
    }
    let mut out = vec![0.0; nkx * nky];
    let mut column = vec![Complex::new(0.0, 0.0); ly];
    for kx in 0..nkx {
        for (j, v) in column.iter_mut().enumerate() {
            *v = Complex::new(table[j.min(ly - j) * nkx + kx], 0.0);
        }
        fy.process(&mut column);
        for (o, v) in out[kx * nky..(kx + 1) * nky].iter_mut().zip(&column) {
            *o = v.re;
        }
    }
    out
}
