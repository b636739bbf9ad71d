//! Cycles of histories as they run, and the damage they do by Miner's rule.
//!
//! ```text
//! D = Σ count · s^m         s: range of the cycle, or its peak (mean + range/2), in p_h
//! ```
//!
//! Sources: Miner (1945), J. Appl. Mech. 12, A159-A164; ASTM E1049-85 (1985), §5.4.4, for the count.

use serde::{Deserialize, Serialize};

use crate::physics::rainflow::{Cycle, HistoryEnds, OpenReversals};
use crate::physics::turning::Turning;
use crate::saved::{any, saved};

/// What a cycle's damage is taken from.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
pub(super) enum DamageBasis {
    /// Ranges of the signed orthogonal shear.
    Ranges,
    /// Peaks of the effective stress.
    Peaks,
}

/// Cycles of one history.
#[derive(Debug, Clone, Copy, PartialEq, Default, Serialize, Deserialize)]
pub struct CycleCount {
    /// Cycles with a range above the gate.
    pub count: f64,
    /// Σ count · s^m, s the range (or, of effective stress, the peak) in p_h: damage by Miner's rule.
    pub damage: f64,
    /// Maximum range (peak).
    pub range: f64,
    /// `Σ count · (s/maximum)^m`: as many of the largest cycle do the same damage.
    pub equivalent: f64,
}

impl CycleCount {
    fn add(&mut self, cycle: Cycle, basis: DamageBasis, exponent: f64) {
        let size = match basis {
            DamageBasis::Ranges => cycle.range,
            DamageBasis::Peaks => cycle.mean + 0.5 * cycle.range,
        };
        self.count += cycle.count;
        self.damage += cycle.count * size.powf(exponent);
        self.range = self.range.max(size);
        self.equivalent = self.damage / self.range.powf(exponent);
    }

    /// Damage without that of one largest cycle.
    pub(super) fn small_damage(&self, exponent: f64) -> f64 {
        (self.damage - self.range.powf(exponent)).max(0.0)
    }
}

/// Histories of one kind of stress at one point, by depth: their counters and what these have counted.
///
/// What every value is held against lies side by side: with two thousand histories, counters between it are memory that each step
/// would wait for.
#[derive(Debug, Clone, Serialize, Deserialize)]
pub(super) struct CrossingHistories {
    basis: DamageBasis,
    turnings: Vec<Turning>,
    open: Vec<OpenReversals>,
    /// Minimum and maximum of the reversals since the crossing began, at zero.
    pub(super) spans: Vec<[f64; 2]>,
    #[serde(rename = "tally")]
    pub(super) cycles: Vec<CycleCount>,
    /// Of the last whole crossing.
    pub(super) last: Vec<Option<CycleCount>>,
}

any!(CycleCount);

saved! {
    CrossingHistories { same: basis; parts: turnings, open, spans, cycles; free: last; }
    holds |own, saved| own.last.len() == saved.last.len()
}

impl CrossingHistories {
    /// Open reversals of a crossing's pressure: far more than the crests of any contact that a grid resolves.
    pub(super) const OPEN: usize = 512;
    /// Same at a depth, where there are many histories: twice the crests on the rising side of a contact
    /// with 100 of them.
    pub(super) const OPEN_BELOW: usize = 100;

    /// At so many `depths`, with memory for so many `open` reversals each.
    pub(super) fn new(depths: usize, gate: f64, basis: DamageBasis, open: usize) -> Self {
        // Each made anew: a clone would not have the room.
        let open = |_| OpenReversals::new(HistoryEnds::Repeating, open);
        Self {
            basis,
            turnings: vec![Turning::new(gate); depths],
            open: (0..depths).map(open).collect(),
            spans: vec![[0.0; 2]; depths],
            cycles: vec![CycleCount::default(); depths],
            last: vec![None; depths],
        }
    }

    /// Next value of each.
    pub(super) fn push(&mut self, values: impl Iterator<Item = f64>, exponent: f64) {
        let basis = self.basis;
        for (k, (turning, value)) in self.turnings.iter_mut().zip(values).enumerate() {
            let turn = turning.push(value);
            if let Some(reversal) = turn.reversal() {
                let [low, high] = self.spans[k];
                self.spans[k] = [low.min(reversal), high.max(reversal)];
                let cycles = &mut self.cycles[k];
                self.open[k].push(turn, &mut |cycle| cycles.add(cycle, basis, exponent));
            }
        }
    }

    /// Starts a crossing at zero stress.
    pub(super) fn start(&mut self, exponent: f64) {
        self.turnings.iter_mut().for_each(Turning::reset);
        self.open.iter_mut().for_each(OpenReversals::reset);
        self.spans.fill([0.0; 2]);
        self.cycles.fill(CycleCount::default());
        self.push(std::iter::repeat(0.0), exponent);
    }

    /// Ends it at zero stress.
    pub(super) fn end(&mut self, exponent: f64, crossing: Crossing) {
        self.push(std::iter::repeat(0.0), exponent);
        let basis = self.basis;
        let counters = self.turnings.iter().zip(&mut self.open);
        for ((turning, open), cycles) in counters.zip(&mut self.cycles) {
            open.finish(turning.extreme(), &mut |cycle| {
                cycles.add(cycle, basis, exponent);
            });
        }
        if crossing == Crossing::Whole {
            for (last, cycles) in self.last.iter_mut().zip(&self.cycles) {
                *last = Some(*cycles);
            }
        }
    }
}

/// Whether a point's crossing has been followed from its start.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
pub(super) enum Crossing {
    /// Not sampled yet.
    New,
    /// From before the contact.
    Whole,
    /// From inside or behind the contact: not counted.
    Part,
    /// Counted: it is behind the contact.
    Done,
}

/// Mean of several crossings; `None` for none.
pub(super) fn mean(all: impl Iterator<Item = CycleCount>) -> Option<CycleCount> {
    let (mut sum, mut count) = (CycleCount::default(), 0.0);
    for cycles in all {
        sum.count += cycles.count;
        sum.damage += cycles.damage;
        sum.equivalent += cycles.equivalent;
        sum.range = sum.range.max(cycles.range);
        count += 1.0;
    }
    (count > 0.0).then(|| CycleCount {
        count: sum.count / count,
        damage: sum.damage / count,
        equivalent: sum.equivalent / count,
        range: sum.range,
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn each_crossing_has_a_span_of_its_own() {
        let mut histories = CrossingHistories::new(2, 0.1, DamageBasis::Ranges, 8);
        let mut cross = |values: &[f64]| {
            histories.start(10.0);
            for value in values {
                histories.push([*value, 0.5 * value].into_iter(), 10.0);
            }
            let spans = histories.spans.clone();
            histories.end(10.0, Crossing::Whole);
            spans
        };
        assert_eq!(cross(&[0.5, -0.7, 0.0]), [[-0.7, 0.5], [-0.35, 0.25]]);
        assert_eq!(cross(&[0.3, 0.0]), [[0.0, 0.3], [0.0, 0.15]]);
    }
}
