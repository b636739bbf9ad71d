//! Turning points of a history, by a gate: the peaks that are seen as they pass, and the reversals that
//! rainflow counts ([`super::rainflow`]).
//!
//! A reversal counts only once the value has come back from it by the gate; smaller wiggles never enter.
//! A history that begins and ends at its least value has as many closed cycles as it has peaks.

use serde::{Deserialize, Serialize};

use crate::saved::saved;

/// A history as it runs.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub struct Turning {
    gate: f64,
    /// Extreme since the last reversal, and the direction that led to it.
    candidate: f64,
    heading: Trend,
}

saved! {
    Turning { same: gate; free: candidate, heading; }
}

#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
enum Trend {
    /// No value yet.
    Empty,
    /// One level so far.
    Level,
    Up,
    Down,
}

/// What a value turned out to be.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Turn {
    /// The history begins with it.
    First(f64),
    /// Nothing turned.
    None,
    /// It has fallen from this peak by the gate.
    Peak(f64),
    /// It has risen from this trough by the gate.
    Trough(f64),
}

impl Turn {
    /// The reversal, the first value among them.
    pub fn reversal(self) -> Option<f64> {
        match self {
            Self::First(value) | Self::Peak(value) | Self::Trough(value) => Some(value),
            Self::None => None,
        }
    }
}

impl Turning {
    /// Sees reversals of at least `gate`.
    pub fn new(gate: f64) -> Self {
        Self {
            gate: gate.max(0.0),
            candidate: 0.0,
            heading: Trend::Empty,
        }
    }

    /// Starts a new history.
    pub fn reset(&mut self) {
        self.heading = Trend::Empty;
    }

    /// Next value.
    pub fn push(&mut self, value: f64) -> Turn {
        let before = self.candidate;
        let comes_back = (value - before).abs() >= self.gate;
        match self.heading {
            Trend::Empty => {
                self.candidate = value;
                self.heading = Trend::Level;
                return Turn::First(value);
            }
            Trend::Level if comes_back && value != before => {
                self.candidate = value;
                self.heading = if value > before {
                    Trend::Up
                } else {
                    Trend::Down
                };
            }
            Trend::Up if value >= before => self.candidate = value,
            Trend::Down if value <= before => self.candidate = value,
            Trend::Up if comes_back => {
                (self.candidate, self.heading) = (value, Trend::Down);
                return Turn::Peak(before);
            }
            Trend::Down if comes_back => {
                (self.candidate, self.heading) = (value, Trend::Up);
                return Turn::Trough(before);
            }
            Trend::Level | Trend::Up | Trend::Down => {}
        }
        Turn::None
    }

    /// Extreme since the last reversal; `None` while the history is level.
    pub fn extreme(&self) -> Option<f64> {
        matches!(self.heading, Trend::Up | Trend::Down).then_some(self.candidate)
    }

    /// Whether `value`, the last one, is the highest since the last trough.
    fn is_summit(&self, value: f64) -> bool {
        self.heading == Trend::Up && self.candidate == value
    }
}

/// A peak that has passed.
#[derive(Debug, Clone, Copy, PartialEq, Default, Serialize, Deserialize)]
pub struct PassedMaximum {
    /// Where.
    pub x: f64,
    /// How high.
    pub value: f64,
}

/// The peaks of one history, each counted as it passes.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub struct Peaks {
    turning: Turning,
    /// Maximum value since the last trough.
    summit: PassedMaximum,
    passed: u32,
    last: Option<PassedMaximum>,
}

saved! {
    Peaks { parts: turning; free: summit, passed, last; }
}

impl Peaks {
    /// Counts peaks from which the value falls by `gate`; the history begins at zero.
    pub fn new(gate: f64) -> Self {
        let mut peaks = Self {
            turning: Turning::new(gate),
            summit: PassedMaximum::default(),
            passed: 0,
            last: None,
        };
        peaks.start();
        peaks
    }

    /// Starts a new history, at zero.
    pub fn start(&mut self) {
        self.turning.reset();
        self.turning.push(0.0);
        (self.passed, self.last) = (0, None);
    }

    /// Next value, at `x`; the peak that it shows to have passed.
    pub fn push(&mut self, x: f64, value: f64) -> Option<PassedMaximum> {
        let turn = self.turning.push(value);
        if let Turn::Peak(_) = turn {
            self.passed += 1;
            self.last = Some(self.summit);
            return self.last;
        }
        if self.turning.is_summit(value) {
            self.summit = PassedMaximum { x, value };
        }
        None
    }

    /// Peaks passed so far.
    pub fn passed(&self) -> u32 {
        self.passed
    }

    /// The last of them.
    pub fn last(&self) -> Option<PassedMaximum> {
        self.last
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::physics::rainflow::{HistoryEnds, Rainflow};
    use proptest::prelude::*;

    const GATE: f64 = 0.05;

    /// Peaks as they pass: place and height.
    fn passed(gate: f64, history: &[f64]) -> Vec<(f64, f64)> {
        let mut peaks = Peaks::new(gate);
        let each = history.iter().enumerate();
        let found: Vec<_> = each
            .filter_map(|(i, value)| peaks.push(i as f64, *value))
            .map(|peak| (peak.x, peak.value))
            .collect();
        assert_eq!(found.len(), peaks.passed() as usize);
        found
    }

    /// Closed cycles of the same history, between zeros.
    fn closed(gate: f64, history: &[f64]) -> f64 {
        let mut flow = Rainflow::new(HistoryEnds::Repeating, gate, 512);
        let mut count = 0.0;
        for value in [0.0].iter().chain(history).chain(&[0.0]) {
            flow.push(*value, &mut |cycle| count += cycle.count);
        }
        flow.finish(&mut |cycle| count += cycle.count);
        count
    }

    #[test]
    fn no_load_no_peak_one_dome_one_peak() {
        assert_eq!(passed(GATE, &[0.0; 20]), []);
        // Wiggles below the gate, also while nothing else happens.
        assert_eq!(passed(GATE, &[0.0, 0.04, 0.0, 0.03, 0.0]), []);
        let dome: Vec<f64> = (0..=40)
            .map(|i| 1.0 - (f64::from(i) / 20.0 - 1.0).powi(2))
            .collect();
        assert_eq!(passed(GATE, &dome), [(20.0, 1.0)]);
        // It counts once the value has fallen by the gate, not before.
        assert_eq!(passed(GATE, &dome[..24]), []);
        assert_eq!(passed(GATE, &dome[..26]).len(), 1);
    }

    #[test]
    fn three_crests_are_three_peaks_where_they_stand() {
        let history = [0.2, 0.9, 0.3, 0.5, 1.2, 1.2, 0.8, 0.86, 0.6, 0.7, 0.1, 0.0];
        // Of a plateau it is the end that counts.
        let found = passed(GATE, &history);
        assert_eq!(found, [(1.0, 0.9), (5.0, 1.2), (7.0, 0.86), (9.0, 0.7)]);
        assert_eq!(passed(0.07, &history).len(), 3);
        assert_eq!(closed(0.07, &history), 3.0);
    }

    #[test]
    fn the_standards_example_has_the_peaks_of_its_closed_cycles() {
        // ASTM E1049-85, fig. 6: peaks 1, 5, 3 and 4.
        let history = [-2.0, 1.0, -3.0, 5.0, -1.0, 3.0, -4.0, 4.0, -2.0];
        let heights: Vec<f64> = passed(0.0, &history).iter().map(|peak| peak.1).collect();
        assert_eq!(heights, [1.0, 5.0, 3.0, 4.0]);
    }

    proptest! {
        /// What is ticked while it passes is what rainflow closes when the point has left.
        #[test]
        fn peaks_are_closed_cycles(history in proptest::collection::vec(0.0_f64..1.0, 0..80)) {
            let mut all = history.clone();
            all.push(0.0);
            prop_assert_eq!(passed(GATE, &all).len() as f64, closed(GATE, &history));
        }
    }
}
