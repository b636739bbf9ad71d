//! How far a running mean has moved of late: its logarithm at marks an eighth of a period apart.
//!
//! Ours: a mean over a period that repeats does not move; how far it moves says how far it is from repeating.

use serde::{Deserialize, Serialize};

use crate::math::ln_sum::ln_list;
use crate::saved::saved;

/// Marks in a period; untuned.
const IN_PERIOD: f64 = 8.0;
/// Marks kept: those of two periods, and the one that they began with.
const KEPT: usize = 17;

/// Logarithms of one number a body, mark by mark.
#[derive(Debug, Clone, PartialEq, Default, Serialize, Deserialize)]
pub struct Marks {
    /// Distance at which the next mark is due.
    next: f64,
    /// Of body 1 and of body 2, the oldest first.
    #[serde(with = "ln_list")]
    list: Vec<f64>,
}

saved! {
    Marks { room: list; free: next; }
    holds |_, saved| saved.list.len() <= 2 * KEPT && saved.list.len().is_multiple_of(2)
}

impl Marks {
    /// None, with room for all that are kept.
    pub fn new() -> Self {
        Self {
            next: 0.0,
            list: Vec::with_capacity(2 * (KEPT + 1)),
        }
    }

    /// Forgets all.
    pub fn forget(&mut self) {
        self.list.clear();
        self.next = 0.0;
    }

    /// Whether a mark is due at `distance`.
    pub fn is_due(&self, distance: f64) -> bool {
        distance >= self.next * (1.0 - 1e-9)
    }

    /// Takes a mark at `distance` of means over a `period`.
    pub fn take(&mut self, distance: f64, period: f64, ln: [f64; 2]) {
        self.next = distance + period / IN_PERIOD;
        if self.list.len() == 2 * KEPT {
            self.list.drain(..2);
        }
        self.list.extend(ln);
    }

    /// Greatest change of either body's over the last so many `periods`, at most two; `None`: they are not marked yet.
    /// Shifted by whole periods the two ends of a mean meet the same phases.
    pub fn moved(&self, periods: f64) -> Option<f64> {
        let back = 2 * (IN_PERIOD * periods).round() as usize;
        let recent = self.list.get(self.list.len().checked_sub(back + 2)?..)?;
        Some(range(recent))
    }

    /// Same over all that are kept; 0 for none.
    pub fn wandered(&self) -> f64 {
        range(&self.list)
    }
}

/// Greatest difference between marks of one body, the greater of both bodies.
fn range(marks: &[f64]) -> f64 {
    let of = |body: usize| {
        let ln = marks.iter().skip(body).step_by(2);
        let (low, high) = ln.fold((f64::INFINITY, f64::NEG_INFINITY), |(low, high), ln| {
            (low.min(*ln), high.max(*ln))
        });
        // Nothing at any time has not moved.
        if low < high { high - low } else { 0.0 }
    };
    of(0).max(of(1))
}
