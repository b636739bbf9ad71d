//! Grids, fixed-order sums, planned FFTs, roots, elliptic integrals. No contact words here.

pub mod elementary;
pub mod elliptic;
mod even_transform;
pub mod filter;
pub(crate) mod fused;
pub mod grid;
mod halfway;
pub mod kernel_symbol;
pub(crate) mod lane_fft;
pub(crate) mod lanes;
pub mod ln_sum;
pub mod number;
pub mod quadrature;
mod quarter_wave;
pub mod root;
pub mod spectrum;
mod turned;

use rustfft::FftNum;

/// `n` values of `f` in the precision of a transform.
fn table<T: FftNum>(n: usize, f: impl Fn(usize) -> f64) -> Vec<T> {
    (0..n)
        .map(|j| T::from_f64(f(j)).unwrap_or_else(T::zero))
        .collect()
}
