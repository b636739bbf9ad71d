//! The cycles that one history, pressure or shear, has gone through in a crossing of the contact.
//!
//! ```text
//! count = Σ n_k,   damage = Σ n_k r_k^m,   equivalent = damage / r_max^m        over the rainflow cycles (n_k, r_k)
//! ```

use serde::{Deserialize, Serialize};

use crate::physics::rainflow::{Cycle, Ends, Rainflow};

/// Cycles of one history.
#[derive(Debug, Clone, Copy, PartialEq, Default, Serialize, Deserialize)]
pub struct Tally {
    /// Cycles with a range above the gate.
    pub count: f64,
    /// Σ count · range^m.
    pub(super) damage: f64,
    /// Greatest range.
    pub range: f64,
    /// `Σ count · (range/greatest)^m`: as many cycles of the greatest range do the same damage.
    pub equivalent: f64,
}

impl Tally {
    fn add(&mut self, cycle: Cycle, exponent: f64) {
        self.count += cycle.count;
        self.damage += cycle.count * cycle.range.powf(exponent);
        self.range = self.range.max(cycle.range);
        self.equivalent = self.damage / self.range.powf(exponent);
    }
}

/// One history: its counter and tally.
#[derive(Debug, Clone, Serialize, Deserialize)]
pub(super) struct History {
    pub(super) flow: Rainflow,
    /// Tally of the crossing under way.
    pub(super) tally: Tally,
    /// Tally of the last whole crossing.
    pub(super) last: Option<Tally>,
}

impl History {
    /// Open reversals of a crossing: far more than the crests of any contact that a grid resolves.
    const OPEN: usize = 512;

    pub(super) fn new(gate: f64) -> Self {
        Self {
            flow: Rainflow::new(Ends::Repeating, gate, Self::OPEN),
            tally: Tally::default(),
            last: None,
        }
    }

    pub(super) fn push(&mut self, value: f64, exponent: f64) {
        let Self { flow, tally, .. } = self;
        flow.push(value, &mut |cycle| tally.add(cycle, exponent));
    }

    /// Starts a crossing at zero stress.
    pub(super) fn start(&mut self, exponent: f64) {
        self.flow.reset();
        self.tally = Tally::default();
        self.push(0.0, exponent);
    }

    /// Ends it at zero stress.
    pub(super) fn end(&mut self, exponent: f64, crossing: Crossing) {
        self.push(0.0, exponent);
        let Self { flow, tally, last } = self;
        flow.finish(&mut |cycle| tally.add(cycle, exponent));
        if crossing == Crossing::Whole {
            *last = Some(*tally);
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
}
