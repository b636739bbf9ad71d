//! What heat goes across the film in a step. Part of `heat.rs`.
//!
//! ```text
//! (h/k_f + A_1 + A_2) d = H_2 − H_1 + (A_2 − A_1) Q/2,     unknown: d (h/k_f + Ā),  Ā the mean of A_1 + A_2 over all waves
//! ```
//! BiCGStab (van der Vorst 1992) from the last guess on, on the plane of the step by itself.

use rayon::prelude::*;

use super::symbols::Own;
use super::{BLOCK, Heat};

/// Relative residual of d, and most iterations.
const RESIDUAL: f64 = 1e-4;
const MOST_ITERATIONS: usize = 60;

impl Heat {
    /// d of this step, by BiCGStab preconditioned by the diagonal, from the last guess on.
    pub(super) fn solve(&mut self, made: &[f64], resistance: &[f64], own: &Own) {
        // Fields: 0 x, 2 r, 3 r0, 4 p, 5 v, 6 s or its preconditioned one, 7 t.
        let diagonal = own.mean;
        // Right-hand side less the operator on the first guess: H2 − H1 + (A2 − A1) Q/2 − (A1 + A2 + h/k) d.
        self.brief.forward(made, &mut self.made);
        if !self.is_known {
            self.brief.forward(&self.exchange, &mut self.crossing);
            self.is_known = true;
        }
        let [one, two] = &own.of;
        (self.brief_waves.par_iter_mut())
            .zip(self.made.par_iter().zip(&self.crossing))
            .zip(one.par_iter().zip(two))
            .with_min_len(BLOCK)
            .for_each(|((to, (made, d)), (a1, a2))| {
                *to = made * 0.5 * (a2 - a1) - d * (a1 + a2);
            });
        self.brief.back(&self.brief_waves, &mut self.fields[2]);
        let [first, second] = &self.past;
        for (apart, (first, second)) in self.fields[2].iter_mut().zip(first.iter().zip(second)) {
            *apart += second - first;
        }
        let goal = RESIDUAL * dot(made, made).sqrt() * diagonal;
        self.fields[0].clone_from(&self.exchange);
        for (n, across) in resistance.iter().enumerate() {
            self.fields[2][n] -= across * self.fields[0][n];
        }
        let (low, high) = self.fields.split_at_mut(3);
        high[0].clone_from(&low[2]);
        self.fields[4].fill(0.0);
        self.fields[5].fill(0.0);
        let (mut rho, mut alpha, mut omega) = (1.0, 1.0, 1.0);
        for _ in 0..MOST_ITERATIONS {
            if dot(&self.fields[2], &self.fields[2]).sqrt() <= goal {
                break;
            }
            let next = dot(&self.fields[3], &self.fields[2]);
            let beta = next / rho * (alpha / omega);
            rho = next;
            for n in 0..self.fields[4].len() {
                self.fields[4][n] =
                    self.fields[2][n] + beta * (self.fields[4][n] - omega * self.fields[5][n]);
            }
            self.apply(own, resistance, diagonal, 4, 5);
            alpha = rho / dot(&self.fields[3], &self.fields[5]);
            for (n, across) in resistance.iter().enumerate() {
                self.fields[0][n] += alpha * self.fields[4][n] / (across + diagonal);
                self.fields[2][n] -= alpha * self.fields[5][n];
            }
            self.add(alpha);
            if dot(&self.fields[2], &self.fields[2]).sqrt() <= goal {
                break;
            }
            self.apply(own, resistance, diagonal, 2, 7);
            omega = dot(&self.fields[7], &self.fields[2])
                / dot(&self.fields[7], &self.fields[7]).max(f64::MIN_POSITIVE);
            for (n, across) in resistance.iter().enumerate() {
                self.fields[0][n] += omega * self.fields[2][n] / (across + diagonal);
                self.fields[2][n] -= omega * self.fields[7][n];
            }
            self.add(omega);
        }
        self.exchange.clone_from(&self.fields[0]);
    }

    /// Adds to the waves of d what has been added to it: what the operator was last applied to, so many times.
    fn add(&mut self, times: f64) {
        let times = times as f32;
        (self.crossing.par_iter_mut().zip(&self.added))
            .with_min_len(BLOCK)
            .for_each(|(d, added)| *d += added * times);
    }

    /// The preconditioned operator on field `x`; the waves of the preconditioned one stay in `added`.
    fn apply(&mut self, own: &Own, resistance: &[f64], diagonal: f64, x: usize, to: usize) {
        for (n, across) in resistance.iter().enumerate() {
            self.fields[6][n] = self.fields[x][n] / (across + diagonal);
        }
        let [one, two] = &own.of;
        self.brief.forward(&self.fields[6], &mut self.added);
        (self.brief_waves.par_iter_mut().zip(&self.added))
            .zip(one.par_iter().zip(two))
            .with_min_len(BLOCK)
            .for_each(|((wave, added), (one, two))| *wave = added * (one + two));
        self.brief.back(&self.brief_waves, &mut self.fields[to]);
        for (n, across) in resistance.iter().enumerate() {
            self.fields[to][n] += across * self.fields[6][n];
        }
    }
}

fn dot(one: &[f64], two: &[f64]) -> f64 {
    one.iter().zip(two).map(|(a, b)| a * b).sum()
}
