//! Power of lines by wavenumber: `P_k = mean over the lines of |F_k|²`, one-sided.
//!
//! ```text
//! F_k = Σ_i z_i e^{−2πi k i/n},   k = 0 .. n/2,   Σ_k w_k P_k = n² ⟨z²⟩   (w = 1 at k = 0 and n/2, else 2)
//! ```

use realfft::RealFftPlanner;

/// Mean power of lines of `n` values each; `line(j)` yields the values of line `j`. Lines of fewer than
/// two values have no waves: the result is then empty.
pub fn mean_power<I: Iterator<Item = f64>>(
    n: usize,
    lines: usize,
    line: impl Fn(usize) -> I,
) -> Vec<f64> {
    if n < 2 || lines == 0 {
        return Vec::new();
    }
    let plan = RealFftPlanner::<f64>::new().plan_fft_forward(n);
    let (mut values, mut spectrum) = (plan.make_input_vec(), plan.make_output_vec());
    let mut scratch = plan.make_scratch_vec();
    let mut power = vec![0.0; n / 2 + 1];
    for j in 0..lines {
        for (to, from) in values.iter_mut().zip(line(j)) {
            *to = from;
        }
        plan.process_with_scratch(&mut values, &mut spectrum, &mut scratch)
            .expect("buffer lengths were made for this plan");
        for (k, (p, f)) in power.iter_mut().zip(&spectrum).enumerate() {
            let both = if k == 0 || 2 * k == n { 1.0 } else { 2.0 };
            *p += both * f.norm_sqr() / lines as f64;
        }
    }
    power
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_wave_has_one_line_and_parseval_holds() {
        for n in [32, 45] {
            let wave = |i: usize| (std::f64::consts::TAU * 3.0 * i as f64 / n as f64).cos();
            let power = mean_power(n, 2, |_| (0..n).map(wave));
            let total: f64 = power.iter().sum();
            let square: f64 = (0..n).map(|i| wave(i).powi(2)).sum();
            assert!((total / (n as f64 * square) - 1.0).abs() < 1e-12);
            assert!((power[3] / total - 1.0).abs() < 1e-12);
        }
        assert!(mean_power(1, 4, |_| [0.0].into_iter()).is_empty());
    }
}
