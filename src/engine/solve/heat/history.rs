//! What heat of the steps before does at the end of a step. Part of `heat.rs`.
//!
//! ```text
//! u_j ← e^{−(λ_j + μ)Δt} u_j + what q of the last step and of the last but one adds,     H = Σ_j u_j + (√κ/k_c) E_1 q
//! ```
//! The sum of exponentials of `symbols.rs` (Carslaw and Jaeger 1959, by waves).

use rayon::prelude::*;
use rustfft::num_complex::Complex;

use super::symbols::{EXPONENTIALS, Symbols};
use super::{BLOCK, Past};

/// The modes at the end of the step, and the waves of what all heat before it does then.
pub(super) fn history(
    table: &Symbols,
    past: &Past,
    next: &mut [Complex<f32>],
    out: &mut [Complex<f32>],
) {
    let n = EXPONENTIALS.len();
    let old = past
        .last
        .0
        .par_chunks(BLOCK)
        .zip(past.before.0.par_chunks(BLOCK));
    (out.par_chunks_mut(BLOCK)
        .zip(next.par_chunks_mut(BLOCK * n)))
    .zip(past.modes.0.par_chunks(BLOCK * n))
    .zip((table.modes.par_chunks(3 * BLOCK * n)).zip(table.lives.par_chunks(n)))
    .zip(table.last.par_chunks(BLOCK))
    .zip(old)
    .for_each(
        |(((((out, next), modes), (factors, lives)), by_last), (last, before))| {
            let width = out.len();
            for ((out, by_last), last) in out.iter_mut().zip(by_last).zip(last) {
                *out = by_last * last;
            }
            let lines = (next.chunks_exact_mut(width).zip(modes.chunks_exact(width)))
                .zip(factors.chunks_exact(3 * width).zip(lives));
            for ((next, modes), (factors, lives)) in lines {
                if *lives {
                    of_mode(next, modes, factors, [last, before], out);
                } else {
                    next.fill(Complex::default());
                }
            }
        },
    );
}

dispatched! {
/// A mode of a block at the end of the step, added to the `sums` of all: what is left of it, and what the heat of the last step
/// and of the last but one adds.
fn of_mode(
    next: &mut [Complex<f32>],
    modes: &[Complex<f32>],
    factors: &[Complex<f32>],
    heat: [&[Complex<f32>]; 2],
    sums: &mut [Complex<f32>],
) {
    let n = next.len();
    let (decay, adds) = factors.split_at(n);
    let (here, there) = adds.split_at(n);
    let (modes, sums, there) = (&modes[..n], &mut sums[..n], &there[..n]);
    let [last, before] = [&heat[0][..n], &heat[1][..n]];
    for k in 0..n {
        let now = modes[k] * decay[k] + last[k] * here[k] + before[k] * there[k];
        next[k] = now;
        sums[k] += now;
    }
}
}
