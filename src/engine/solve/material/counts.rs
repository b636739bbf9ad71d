//! What the points of a body have counted: means over their crossings.
//!
//! Part of `material.rs`.

use super::{CycleCount, MaterialTracker, TrackedPoint};
use crate::solve::cycle_count::mean;

impl MaterialTracker {
    /// Mean over the points' last whole crossings of the pressure's cycles; `None` until one is finished.
    pub fn pressure_cycles(&self) -> Option<CycleCount> {
        mean(self.points.iter().filter_map(TrackedPoint::crossed))
    }

    /// Same of the signed shear at depth `k`.
    pub fn shear_cycles(&self, k: usize) -> Option<CycleCount> {
        mean((self.points.iter()).filter_map(|point| *point.shear.last.get(k)?))
    }

    /// Same of the effective stress at depth `k`; sizes are peaks.
    pub fn effective_cycles(&self, k: usize) -> Option<CycleCount> {
        mean((self.points.iter()).filter_map(|point| *point.effective.last.get(k)?))
    }

    /// Mean counts of the signed shear's cycles of every depth into `shear`, and of the effective stress's cycles, each by
    /// its peak in cycles of the maximum, into `by_peaks`; false until a crossing is finished.
    pub fn cycles_by_depth(&self, shear: &mut [f64], by_peaks: &mut [f64]) -> bool {
        let mut known = !shear.is_empty();
        for (k, (shear, by_peaks)) in shear.iter_mut().zip(by_peaks).enumerate() {
            let (ranges, peaks) = (self.shear_cycles(k), self.effective_cycles(k));
            known &= ranges.is_some() && peaks.is_some();
            // What never passes the gate is one loading cycle all the same.
            *shear = ranges.unwrap_or_default().count.max(1.0);
            *by_peaks = peaks.unwrap_or_default().equivalent.max(1.0);
        }
        known
    }

    /// Equivalent cycles of every depth in a loading cycle of the faster body, which has moved by `fastest` (in a) while
    /// this one moved by `own` (both in size, since the last restart):
    ///
    /// ```text
    /// n(z) = U_i/U_fast + (Z/N d) Σ_small range^c / <maximum range^c>        Z: track, N: points, d: distance
    /// ```
    /// Cycles count as they close, wherever the points then are, and so also for a body that hardly moves or stands;
    /// the largest of each crossing is the crossing's own; crossings that finished weigh by their `share` of
    /// those that make a mean. A depth without shear (a frictionless surface) takes the
    /// count below it. False before anything moved.
    pub fn damage_cycles(&self, (own, fastest): (f64, f64), share: f64, out: &mut [f64]) -> bool {
        if fastest <= 0.0 || self.spec.depths == 0 {
            return false;
        }
        let track = self.spec.x_last - self.spec.x_first;
        let passages = fastest * self.points.len() as f64 / track;
        out.fill(0.0);
        for point in &self.points {
            for (open, cycles) in out.iter_mut().zip(&point.shear.cycles) {
                *open += cycles.damage;
            }
        }
        let mut below = own / fastest;
        for k in (0..self.spec.depths).rev() {
            let greatest = self.greatest_damage(k, share);
            if greatest > 0.0 {
                below = own / fastest + (self.ended[k] + out[k]) / (passages * greatest);
            }
            out[k] = below;
        }
        true
    }

    /// Mean damage of the largest cycle of a crossing at depth `k`: of all whole crossings, not of each point's last, which are
    /// milder where surfaces run in. As long as these are a `share` of those that make a mean, what all points together saw stands
    /// for the rest: those in the valleys of their own surface alone would be milder than the crests by orders of magnitude to the power of c.
    fn greatest_damage(&self, k: usize, share: f64) -> f64 {
        let finished = match self.crossings {
            0 => 0.0,
            n => self.greatest[k] / n as f64,
        };
        if share >= 1.0 {
            return finished;
        }
        let spans = self.points.iter().map(|point| point.shear.spans[k]);
        let (low, high) = spans.fold((0.0_f64, 0.0_f64), |(low, high), span| {
            (low.min(span[0]), high.max(span[1]))
        });
        share * finished + (1.0 - share) * (high - low).powf(self.spec.damage_exponent)
    }
}
