//! Pressures of the last period, as first guess of the steps of the next one.
//!
//! ```text
//! P(w) ≈ P(w − mT)            T, and m with which mT is a whole number of fixed steps: orbit.rs; else between steps a cubic
//!                             through four of them, m as many periods as that takes
//! ```
//! Where a passage repeats, a step has been solved a period ago. Whether that is nearer to the solution than the pressure
//! extrapolated along characteristics is seen from the last step, which is compared with both of its guesses. A guess
//! changes what a step costs, not what it is solved to: the steps of the default scene at 257² take 3.0 Newton
//! iterations in the first period, 2.0 in the second and 1.1 to 1.3 in the others.
//!
//! Kept in single precision. Half of that was tried, as the fourth root of the pressure over its maximum, and is as good a
//! guess; but what it rounds is what a page and the terminal program, whose sums differ in the last bits, then differ by:
//! 6e-4 of a film in place of 1e-6.

use serde::{Deserialize, Serialize};

use super::orbit::lagrange;
use crate::saved::saved;

/// Pressures, and steps, that are kept at most; longer periods give no guess.
const MOST: usize = 8 << 20;
const MOST_STEPS: usize = 1024;
/// Steps that no run makes.
const MOST_TAKEN: u64 = 1 << 52;
/// Steps that the interpolation between them takes; six were tried and save half a percent.
const POINTS: usize = 4;
/// Those of them that lie before its place.
const BEFORE: usize = POINTS / 2;

/// One step that was made.
#[derive(Debug, Clone, Copy, PartialEq, Default, Serialize, Deserialize)]
struct PastStep {
    /// Where it ended, in a.
    distance: f64,
    h0: f64,
}

/// The steps of a period, the oldest overwritten first.
#[derive(Debug, Clone, Serialize, Deserialize)]
pub(super) struct LastPeriod {
    len: usize,
    /// Steps of a period and of the interpolation; 0: there is no memory for so many.
    kept: usize,
    taken: u64,
    steps: Vec<PastStep>,
    pressures: Vec<f32>,
    /// Whether the guess of the last step was nearer than the extrapolated one.
    is_better: bool,
}

saved! {
    LastPeriod {
        same: len;
        free: kept, taken, steps, pressures, is_better;
    }
    holds |own, saved| saved.kept <= most(own.len)
        && (saved.kept > 0 || saved.taken == 0)
        && saved.taken <= MOST_TAKEN
        && saved.steps.len() as u64 == saved.taken.min(saved.kept as u64)
        && saved.pressures.len() == saved.steps.len() * own.len
}

impl LastPeriod {
    /// For steps of `len` nodes; its memory is made when the first one comes.
    pub(super) fn new(len: usize) -> Self {
        Self {
            len,
            kept: 0,
            taken: 0,
            steps: Vec::new(),
            pressures: Vec::new(),
            is_better: false,
        }
    }

    /// Begins anew.
    pub(super) fn restart(&mut self) {
        (self.taken, self.is_better) = (0, false);
        self.steps.clear();
        self.pressures.clear();
    }

    /// Whether its guess is the one to begin with.
    pub(super) fn is_better(&self) -> bool {
        self.is_better
    }

    /// Compares what a step became with its guess from here and with the extrapolated one.
    pub(super) fn judge(&mut self, became: &[f64], own: &[f64], extrapolated: &[f64]) {
        let off = |guess: &[f64]| -> f64 {
            let pairs = became.iter().zip(guess);
            pairs.map(|(p, guess)| (p - guess).abs()).sum()
        };
        self.is_better = off(own) < off(extrapolated);
    }

    /// Takes a step of length `step` that ended at `distance`.
    pub(super) fn push(
        &mut self,
        distance: f64,
        step: f64,
        period: f64,
        h0: f64,
        pressure: &[f64],
    ) {
        if self.taken == 0 {
            let kept = (back(period, step) / step).ceil() as usize + POINTS;
            self.kept = if kept <= most(self.len) { kept } else { 0 };
            self.steps.reserve_exact(self.kept);
            self.pressures.reserve_exact(self.kept * self.len);
        }
        if self.kept == 0 {
            return;
        }
        let step = PastStep { distance, h0 };
        let stored = pressure.iter().map(|p| *p as f32);
        if self.steps.len() < self.kept {
            self.steps.push(step);
            self.pressures.extend(stored);
        } else {
            let slot = self.slot(self.taken);
            self.steps[slot] = step;
            let room = &mut self.pressures[slot * self.len..(slot + 1) * self.len];
            for (to, p) in room.iter_mut().zip(stored) {
                *to = p;
            }
        }
        self.taken += 1;
    }

    fn slot(&self, n: u64) -> usize {
        (n % self.kept as u64) as usize
    }

    /// Writes the pressure a period before `distance`, where a step is to end, into `guess` and gives H0; `None`: it is not
    /// known.
    pub(super) fn guess(&self, distance: f64, period: f64, guess: &mut [f64]) -> Option<f64> {
        /// Ends of steps that are as good as the same, in a.
        const SAME: f64 = 1e-9;
        let newest = self.taken.checked_sub(1)?;
        let step = distance - self.steps[self.slot(newest)].distance;
        let target = distance - back(period, step);
        let first = self.taken - self.steps.len() as u64;
        let is_before = |n: &u64| self.steps[self.slot(*n)].distance <= target + SAME;
        let before = (first..self.taken).rev().find(is_before)?;
        let from = before.checked_sub(BEFORE as u64 - 1)?;
        if from < first || from + POINTS as u64 > self.taken {
            return None;
        }
        let slots: [usize; POINTS] = std::array::from_fn(|k| self.slot(from + k as u64));
        let at = slots.map(|slot| self.steps[slot].distance);
        let weights = lagrange(at, target);
        let mut h0 = 0.0;
        guess.fill(0.0);
        for (slot, weight) in slots.into_iter().zip(weights) {
            h0 += weight * self.steps[slot].h0;
            let from = &self.pressures[slot * self.len..(slot + 1) * self.len];
            for (to, &p) in guess.iter_mut().zip(from) {
                *to += weight * f64::from(p);
            }
        }
        for p in guess.iter_mut() {
            *p = p.max(0.0);
        }
        Some(h0)
    }
}

/// Steps of so many nodes that may be kept.
fn most(len: usize) -> usize {
    (MOST / len.max(1)).min(MOST_STEPS)
}

/// The multiple of a period that lies so many steps back that as many of them follow as the interpolation takes.
fn back(period: f64, step: f64) -> f64 {
    period * ((BEFORE + 1) as f64 * step / period).ceil().max(1.0)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::saved::Saved as _;

    /// A crest that passes a node every `period`.
    fn pressure(distance: f64, period: f64) -> f64 {
        1.0 + 0.5 * (std::f64::consts::TAU * distance / period).cos()
    }

    #[test]
    fn a_step_is_guessed_from_a_period_ago_or_from_several() {
        // Whole steps, steps between them, a period shorter than the interpolation is long, steps that change.
        for (period, lengths) in [
            (1.0, [0.05; 2]),
            (1.03, [0.05; 2]),
            (0.51, [0.03; 2]),
            (0.9, [0.03, 0.05]),
        ] {
            let mut kept = LastPeriod::new(1);
            let (mut distance, mut guessed) = (0.0, 0);
            for n in 0..120 {
                distance += lengths[n % 2];
                let mut guess = [0.0];
                if let Some(h0) = kept.guess(distance, period, &mut guess) {
                    let exact = pressure(distance, period);
                    assert!(
                        (guess[0] - exact).abs() < 3e-3,
                        "{period}: {guess:?}, {exact}"
                    );
                    assert!((h0 + guess[0]).abs() < 1e-6);
                    guessed += 1;
                }
                let p = pressure(distance, period);
                kept.push(distance, lengths[n % 2], period, -p, &[p]);
            }
            assert!(guessed > 90, "{guessed}");
        }
    }

    #[test]
    fn a_state_that_no_run_leaves_is_refused() {
        let own = LastPeriod::new(1);
        let no_room = LastPeriod {
            taken: 5,
            ..own.clone()
        };
        let endless = LastPeriod {
            kept: 1,
            taken: u64::MAX,
            steps: vec![PastStep::default()],
            pressures: vec![0.0],
            ..own.clone()
        };
        assert!(own.check(&no_room).is_err() && own.check(&endless).is_err());
        assert!(own.check(&own).is_ok());
    }

    #[test]
    fn a_period_longer_than_what_may_be_kept_gives_no_guess() {
        let mut kept = LastPeriod::new(1);
        for n in 0..3000 {
            let distance = 0.1 * f64::from(n);
            assert_eq!(kept.guess(distance, 110.0, &mut [0.0]), None);
            kept.push(distance, 0.1, 110.0, 0.0, &[1.0]);
        }
        assert!(kept.steps.is_empty());
    }
}
