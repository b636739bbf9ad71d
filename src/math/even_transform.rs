//! Fourier transform of an even sequence at half the cost.
//!
//! ```text
//! X_k = x_0 + (−1)^k x_M + 2 Σ_{j=1}^{M−1} x_j cos(πjk/M),   k = 0..M      (type-I cosine transform)
//! y_j = (x_j + x_{M−j}) − 2 sin(πj/M)(x_j − x_{M−j}),   Y = FFT_M(y)
//! X_2k = (Y_k + Y_{M−k})/2,   X_{2k+1} = X_{2k−1} + i(Y_k − Y_{M−k})/2
//! ```
//! This is the transform of length 2M of the sequence continued evenly, by one complex transform of length M;
//! complex data are two real sequences at once, because every step is linear. Applied twice it is 2M times the
//! identity. The running sum costs a rounding error of about √M units. M is even.
//! Source: Cooley, Lewis and Welch (1970); Makhoul (1980) for its use with FFTs.

use std::f64::consts::PI;
use std::sync::Arc;

use realfft::num_complex::Complex;
use rustfft::{Fft, FftNum, FftPlanner};

/// A planned transform of `M + 1` values.
pub(super) struct EvenTransform<T: FftNum> {
    m: usize,
    fft: Arc<dyn Fft<T>>,
    /// 2 sin(πj/M) and 2 cos(πj/M).
    sine: Vec<T>,
    cosine: Vec<T>,
}

impl<T: FftNum> EvenTransform<T> {
    /// Plans for `m` intervals (even).
    pub(super) fn new(m: usize) -> Self {
        let table = |f: fn(f64) -> f64| {
            (0..m)
                .map(|j| T::from_f64(2.0 * f(PI * j as f64 / m as f64)).unwrap_or_else(T::zero))
                .collect()
        };
        Self {
            m,
            fft: FftPlanner::new().plan_fft_forward(m),
            sine: table(f64::sin),
            cosine: table(f64::cos),
        }
    }

    /// Length of the scratch that [`EvenTransform::process`] needs besides `M` values.
    pub(super) fn scratch_len(&self) -> usize {
        self.fft.get_inplace_scratch_len()
    }

    /// Transforms `x` (`M + 1` values) in place; `work` has `M` values.
    pub(super) fn process(
        &self,
        x: &mut [Complex<T>],
        work: &mut [Complex<T>],
        scratch: &mut [Complex<T>],
    ) {
        let work = &mut work[..self.m];
        let first = fold(x, &self.sine, &self.cosine, work);
        self.fft.process_with_scratch(work, scratch);
        unfold(work, first, x);
    }
}

dispatched! {
/// y, and X_1.
fn fold<T: FftNum>(
    x: &[Complex<T>],
    sine: &[T],
    cosine: &[T],
    y: &mut [Complex<T>],
) -> Complex<T> {
    let m = y.len();
    let (forward, sine, cosine) = (&x[..m], &sine[..m], &cosine[..m]);
    let backward = &x[1..=m];
    let mut first = [Complex::new(T::zero(), T::zero()); 4];
    first[0] = x[0] - x[m] - forward[0] * cosine[0];
    for j in 0..m {
        let (a, b) = (forward[j], backward[m - 1 - j]);
        y[j] = (a + b) - (a - b) * sine[j];
        first[j % 4] = first[j % 4] + a * cosine[j];
    }
    (first[0] + first[1]) + (first[2] + first[3])
}
}

dispatched! {
/// X from Y and X_1.
fn unfold<T: FftNum>(y: &[Complex<T>], first: Complex<T>, x: &mut [Complex<T>]) {
    let m = y.len();
    let half = T::one() / (T::one() + T::one());
    let mut odd = first;
    x[0] = y[0];
    x[1] = odd;
    for k in 1..m / 2 {
        let (a, b) = (y[k], y[m - k]);
        x[2 * k] = (a + b) * half;
        let d = (a - b) * half;
        odd = odd + Complex::new(-d.im, d.re);
        x[2 * k + 1] = odd;
    }
    x[m] = y[m / 2];
}
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn it_is_the_cosine_sum_and_its_own_inverse() {
        let m = 16;
        let x: Vec<Complex<f64>> = (0..=m)
            .map(|j| Complex::new((0.7 * j as f64).sin() + 0.2, (1.3 * j as f64).cos()))
            .collect();
        let transform = EvenTransform::<f64>::new(m);
        let zero = Complex::new(0.0, 0.0);
        let (mut out, mut work) = (x.clone(), vec![zero; m]);
        let mut scratch = vec![zero; transform.scratch_len()];
        transform.process(&mut out, &mut work, &mut scratch);
        for (k, &got) in out.iter().enumerate() {
            let mut sum = zero;
            for j in 0..2 * m {
                let value = x[j.min(2 * m - j)];
                sum += value * (PI * (j * k) as f64 / m as f64).cos();
            }
            assert!((got - sum).norm() < 1e-12, "{k}: {got} {sum}");
        }
        transform.process(&mut out, &mut work, &mut scratch);
        for (&back, &x) in out.iter().zip(&x) {
            assert!((back / (2 * m) as f64 - x).norm() < 1e-13);
        }
    }
}
