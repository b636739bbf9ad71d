//! Fourier transform of an even sequence at half the cost.
//!
//! ```text
//! X_k = x_0 + (−1)^k x_M + 2 Σ_{j=1}^{M−1} x_j cos(πjk/M),   k = 0..M      (type-I cosine transform)
//! y_j = (x_j + x_{M−j}) − 2 sin(πj/M)(x_j − x_{M−j}),   Y = FFT_M(y)
//! X_2k = (Y_k + Y_{M−k})/2,   X_{2k+1} = X_{2k−1} + i(Y_k − Y_{M−k})/2
//! ```
//! This is the transform of length 2M of the sequence continued evenly, by one complex transform of length M;
//! complex data are two real sequences at once, because every step is linear. Applied twice it is 2M times the
//! identity. Two type-I cosine transforms of `rustdct` take 3.0 to 3.4 times as long (M = 128 to 1024), `rustfft` of length
//! 2M 1.6 to 1.75 times. The running sum costs a rounding error of about √M units. M is even. For fields that really repeat: where
//! they need not, `quarter_wave.rs` is faster.
//! Source: Cooley, Lewis and Welch (1970); Makhoul (1980) for its use with FFTs.

use std::f64::consts::PI;
use std::sync::Arc;

use realfft::num_complex::Complex;
use rustfft::{Fft, FftNum, FftPlanner};

use super::table;

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
        let angle = |j: usize| PI * j as f64 / m as f64;
        Self {
            m,
            fft: FftPlanner::new().plan_fft_forward(m),
            sine: table(m, |j| 2.0 * angle(j).sin()),
            cosine: table(m, |j| 2.0 * angle(j).cos()),
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

/// Values side by side.
const LANES: usize = 8;

dispatched! {
/// y, and X_1. Nodes j and M−j together: they share the sum, the difference and both tables.
fn fold<T: FftNum>(
    x: &[Complex<T>],
    sine: &[T],
    cosine: &[T],
    y: &mut [Complex<T>],
) -> Complex<T> {
    let m = y.len();
    let (x, sine, cosine) = (&x[..=m], &sine[..m], &cosine[..m]);
    let zero = Complex::new(T::zero(), T::zero());
    let mut first = [zero; LANES];
    let (low, high) = y.split_at_mut(m / 2);
    // Of the low half y_1 .., of the high half y_(M−1) .. downwards.
    let blocks = (m / 2 - 1) / LANES;
    for block in 0..blocks {
        let j = 1 + block * LANES;
        let a: &[Complex<T>; LANES] = x[j..].first_chunk().expect("within the half");
        let b: &[Complex<T>; LANES] = x[..=m - j].last_chunk().expect("within the half");
        let sine: &[T; LANES] = sine[j..].first_chunk().expect("within the half");
        let cosine: &[T; LANES] = cosine[j..].first_chunk().expect("within the half");
        let up: &mut [Complex<T>; LANES] = low[j..].first_chunk_mut().expect("within the half");
        let end = high.len() - (j - 1);
        let down: &mut [Complex<T>; LANES] =
            high[..end].last_chunk_mut().expect("within the half");
        for k in 0..LANES {
            let (sum, difference) = (a[k] + b[LANES - 1 - k], a[k] - b[LANES - 1 - k]);
            let turned = difference * sine[k];
            up[k] = sum - turned;
            down[LANES - 1 - k] = sum + turned;
            first[k] = first[k] + difference * cosine[k];
        }
    }
    for j in 1 + blocks * LANES..m / 2 {
        let (sum, difference) = (x[j] + x[m - j], x[j] - x[m - j]);
        let turned = difference * sine[j];
        low[j] = sum - turned;
        high[m / 2 - j] = sum + turned;
        first[0] = first[0] + difference * cosine[j];
    }
    low[0] = x[0] + x[m];
    // sin(π/2) = 1, and the table holds twice the sine.
    high[0] = x[m / 2] + x[m / 2];
    first.iter().fold(x[0] - x[m], |sum, &v| sum + v)
}
}

dispatched! {
/// X from Y and X_1. The running sum takes an addition's time a node; sums of parts side by side were no faster.
fn unfold<T: FftNum>(y: &[Complex<T>], first: Complex<T>, x: &mut [Complex<T>]) {
    let m = y.len();
    let (y, x) = (&y[..m], &mut x[..=m]);
    let half = T::one() / (T::one() + T::one());
    let mut odd = first;
    x[0] = y[0];
    x[1] = odd;
    let (up, down) = (&y[1..m / 2], &y[m / 2 + 1..]);
    for ((pair, &a), &b) in x[2..m].chunks_exact_mut(2).zip(up).zip(down.iter().rev()) {
        let d = (a - b) * half;
        odd = odd + Complex::new(-d.im, d.re);
        pair[0] = (a + b) * half;
        pair[1] = odd;
    }
    x[m] = y[m / 2];
}
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn it_is_the_cosine_sum_and_its_own_inverse() {
        for m in [2, 4, 16, 64, 90] {
            check(m);
        }
    }

    fn check(m: usize) {
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
            assert!((got - sum).norm() < 1e-11, "{k}: {got} {sum}");
        }
        transform.process(&mut out, &mut work, &mut scratch);
        for (&back, &x) in out.iter().zip(&x) {
            assert!((back / (2 * m) as f64 - x).norm() < 1e-13);
        }
    }
}
