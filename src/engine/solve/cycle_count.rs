//! Cycles of one history as it runs, and the damage they do by Miner's rule.
//!
//! ```text
//! D = Σ count · s^m         s: range of the cycle, or its peak (mean + range/2), in p_h
//! ```
//!
//! Sources: Miner (1945), J. Appl. Mech. 12, A159-A164; ASTM E1049-85 (1985), §5.4.4, for the count.

use serde::{Deserialize, Serialize};

use crate::physics::rainflow::{Cycle, HistoryEnds, Rainflow};
use crate::saved::saved;

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

/// One history: its counter and what it has counted.
#[derive(Debug, Clone, Serialize, Deserialize)]
pub(super) struct CrossingHistory {
    flow: Rainflow,
    basis: DamageBasis,
    #[serde(rename = "tally")]
    pub(super) cycles: CycleCount,
    /// CycleCount of the last whole crossing.
    pub(super) last: Option<CycleCount>,
}

saved! {
    CrossingHistory { same: basis; parts: flow; free: cycles, last; }
}

impl CrossingHistory {
    /// Open reversals of a crossing's pressure: far more than the crests of any contact that a grid resolves.
    pub(super) const OPEN: usize = 512;
    /// Same at a depth, where there are many histories: twice the crests on the rising side of a contact
    /// with 100 of them.
    pub(super) const OPEN_BELOW: usize = 100;

    pub(super) fn new(gate: f64, basis: DamageBasis, open: usize) -> Self {
        Self {
            flow: Rainflow::new(HistoryEnds::Repeating, gate, open),
            basis,
            cycles: CycleCount::default(),
            last: None,
        }
    }

    pub(super) fn push(&mut self, value: f64, exponent: f64) {
        let Self {
            flow,
            cycles,
            basis,
            ..
        } = self;
        flow.push(value, &mut |cycle| cycles.add(cycle, *basis, exponent));
    }

    /// Minimum and maximum value so far.
    pub(super) fn ends(&self) -> (f64, f64) {
        self.flow.open_ends()
    }

    /// Starts a crossing at zero stress.
    pub(super) fn start(&mut self, exponent: f64) {
        self.flow.reset();
        self.cycles = CycleCount::default();
        self.push(0.0, exponent);
    }

    /// Ends it at zero stress.
    pub(super) fn end(&mut self, exponent: f64, crossing: Crossing) {
        self.push(0.0, exponent);
        let Self {
            flow,
            basis,
            cycles,
            last,
        } = self;
        flow.finish(&mut |cycle| cycles.add(cycle, *basis, exponent));
        if crossing == Crossing::Whole {
            *last = Some(*cycles);
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
