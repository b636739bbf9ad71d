//! Rainflow counting as the history arrives (ASTM E1049-85).
//!
//! ```text
//! once (§5.4.4):     X = last range, Y = the one before.  X < Y: wait.
//!                    Y starts the history: count ½ for Y, drop its first point;  else count 1, drop its two.
//!                    At the end: ½ for every range that is left.
//! repeating (§5.4.5): a range that is no greater than both neighbours closes: count 1, drop its two points.
//!                    At the end the ranges left are read as a ring from the maximum value, and all close.
//! ```
//! A history that happens once leaves half cycles; one that is repeated again and again (a material point
//! that crosses the contact at every turn) closes every cycle.
//!
//! *Gate*: a reversal counts only once the value has come back by the gate ([`super::turning`]); smaller
//! wiggles never enter. With gate 0 this is the standard to the letter.
//!
//! Memory is bounded: should a history keep more open reversals than the capacity, the oldest range is
//! counted as a half cycle, and [`Rainflow::forced`] says how often.
//!
//! A material point's history must begin and end at zero stress: without those ends most of the damage is
//! lost.

use serde::{Deserialize, Serialize};

use super::turning::{Turn, Turning};
use crate::saved::saved;

/// A counted cycle.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Cycle {
    /// Maximum minus minimum value.
    pub range: f64,
    /// Mean of the two.
    pub mean: f64,
    /// 1, or ½ for a half cycle.
    pub count: f64,
}

/// How often a history happens.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
pub enum HistoryEnds {
    /// Once: half cycles are left over.
    Once,
    /// Again and again: every cycle closes.
    Repeating,
}

/// A history as it runs.
#[derive(Debug, Clone, Serialize, Deserialize)]
pub struct Rainflow {
    turning: Turning,
    open: OpenReversals,
}

saved! {
    Rainflow { parts: turning, open; }
}

impl Rainflow {
    /// Counter of cycles with a range of at least `gate`, with memory for `capacity` open reversals
    /// (at least 4).
    pub fn new(ends: HistoryEnds, gate: f64, capacity: usize) -> Self {
        Self {
            turning: Turning::new(gate),
            open: OpenReversals::new(ends, capacity),
        }
    }

    /// Half cycles that were counted early for want of memory.
    pub fn forced(&self) -> u64 {
        self.open.forced
    }

    /// Next value of the history; gives every cycle that it closes to `sink`.
    pub fn push(&mut self, value: f64, sink: &mut impl FnMut(Cycle)) {
        self.open.push(self.turning.push(value), sink);
    }

    /// Ends the history; the next value starts a new one.
    pub fn finish(&mut self, sink: &mut impl FnMut(Cycle)) {
        self.open.finish(self.turning.extreme(), sink);
        self.turning.reset();
    }
}

/// Reversals of a history that are not counted yet. Where histories are many, what sees the reversals ([`Turning`]) lies
/// elsewhere: each value is a matter of that, and few are one of these.
#[derive(Debug, Clone, Serialize, Deserialize)]
pub struct OpenReversals {
    ends: HistoryEnds,
    stack: Vec<f64>,
    capacity: usize,
    forced: u64,
}

saved! {
    OpenReversals { same: ends, capacity; room: stack; free: forced; }
}

impl OpenReversals {
    /// Memory for `capacity` of them (at least 4).
    pub fn new(ends: HistoryEnds, capacity: usize) -> Self {
        let capacity = capacity.max(4);
        Self {
            ends,
            stack: Vec::with_capacity(capacity + 3),
            capacity,
            forced: 0,
        }
    }

    /// Starts a new history.
    pub fn reset(&mut self) {
        self.stack.clear();
    }

    /// What the next value of the history turned out to be; gives every cycle that it closes to `sink`.
    pub fn push(&mut self, turn: Turn, sink: &mut impl FnMut(Cycle)) {
        match turn {
            Turn::First(value) => self.stack.push(value),
            Turn::Peak(extreme) | Turn::Trough(extreme) => self.reversal(extreme, sink),
            Turn::None => {}
        }
    }

    /// Ends the history with the extreme since the last reversal; the next one starts a new one.
    pub fn finish(&mut self, extreme: Option<f64>, sink: &mut impl FnMut(Cycle)) {
        if let Some(extreme) = extreme {
            self.stack.push(extreme);
            self.close(sink);
        }
        match self.ends {
            HistoryEnds::Once => {
                for pair in self.stack.windows(2) {
                    sink(cycle(pair[0], pair[1], 0.5));
                }
            }
            HistoryEnds::Repeating => self.close_ring(sink),
        }
        self.reset();
    }

    /// Closes what is left as a ring, from its maximum value round to the same: every range in between
    /// finds its partner.
    fn close_ring(&mut self, sink: &mut impl FnMut(Cycle)) {
        self.open_ring();
        let n = self.stack.len();
        if n < 2 {
            return;
        }
        let greatest = (0..n).fold(0, |g, i| if self.stack[i] > self.stack[g] { i } else { g });
        self.stack.rotate_left(greatest);
        self.stack.push(self.stack[0]);
        // What has not found its partner lies before `kept`.
        let mut kept = 0;
        for i in 0..=n {
            self.stack[kept] = self.stack[i];
            kept += 1;
            while let [.., a, b, c] = self.stack[..kept] {
                if (c - b).abs() < (b - a).abs() {
                    break;
                }
                sink(cycle(a, b, 1.0));
                kept -= 2;
                self.stack[kept - 1] = c;
            }
        }
    }

    /// Drops the end points that are no reversals where the history meets its own beginning.
    fn open_ring(&mut self) {
        if let [first, .., before, last] = self.stack[..]
            && (last - before) * (first - last) >= 0.0
        {
            self.stack.pop();
        }
        if let [first, next, .., last] = self.stack[..]
            && (first - last) * (next - first) >= 0.0
        {
            self.stack.remove(0);
        }
    }

    fn reversal(&mut self, value: f64, sink: &mut impl FnMut(Cycle)) {
        self.stack.push(value);
        self.close(sink);
        if self.stack.len() > self.capacity {
            sink(cycle(self.stack[0], self.stack[1], 0.5));
            self.stack.remove(0);
            self.forced += 1;
        }
    }

    /// Counts and drops what the newest reversal closes.
    fn close(&mut self, sink: &mut impl FnMut(Cycle)) {
        match self.ends {
            HistoryEnds::Once => self.close_once(sink),
            HistoryEnds::Repeating => self.close_repeating(sink),
        }
    }

    fn close_once(&mut self, sink: &mut impl FnMut(Cycle)) {
        while let [.., a, b, c] = self.stack[..] {
            if (c - b).abs() < (b - a).abs() {
                break;
            }
            let n = self.stack.len();
            if n == 3 {
                sink(cycle(a, b, 0.5));
                self.stack.remove(0);
            } else {
                sink(cycle(a, b, 1.0));
                self.stack.drain(n - 3..n - 1);
            }
        }
    }

    fn close_repeating(&mut self, sink: &mut impl FnMut(Cycle)) {
        while let [.., a, b, c, d] = self.stack[..] {
            let inner = (c - b).abs();
            if inner > (b - a).abs() || inner > (d - c).abs() {
                break;
            }
            sink(cycle(b, c, 1.0));
            let n = self.stack.len();
            self.stack.drain(n - 3..n - 1);
        }
    }
}

fn cycle(a: f64, b: f64, count: f64) -> Cycle {
    Cycle {
        range: (b - a).abs(),
        mean: 0.5 * (a + b),
        count,
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;
    use std::collections::BTreeMap;

    fn count(history: &[f64], gate: f64, capacity: usize) -> (Vec<Cycle>, u64) {
        count_as(HistoryEnds::Once, history, gate, capacity)
    }

    fn count_as(
        ends: HistoryEnds,
        history: &[f64],
        gate: f64,
        capacity: usize,
    ) -> (Vec<Cycle>, u64) {
        let mut flow = Rainflow::new(ends, gate, capacity);
        let mut cycles = Vec::new();
        for value in history {
            flow.push(*value, &mut |c| cycles.push(c));
        }
        flow.finish(&mut |c| cycles.push(c));
        (cycles, flow.forced())
    }

    fn by_range(cycles: &[Cycle]) -> BTreeMap<i64, f64> {
        let mut table = BTreeMap::new();
        for c in cycles {
            *table
                .entry((c.range * 1000.0).round() as i64)
                .or_insert(0.0) += c.count;
        }
        table
    }

    #[test]
    fn standards_example() {
        let history = [-2.0, 1.0, -3.0, 5.0, -1.0, 3.0, -4.0, 4.0, -2.0];
        let (cycles, _) = count(&history, 0.0, 64);
        let table = by_range(&cycles);
        println!("{table:?}");
        let expected = [
            (3000, 0.5),
            (4000, 1.5),
            (6000, 0.5),
            (8000, 1.0),
            (9000, 0.5),
        ];
        assert_eq!(table, BTreeMap::from(expected));
    }

    #[test]
    fn a_repeated_history_closes_every_cycle() {
        let cycles =
            |history: &[f64]| by_range(&count_as(HistoryEnds::Repeating, history, 0.0, 64).0);
        // The signed shear of one passage: up, down, back to zero.
        assert_eq!(
            cycles(&[0.0, 1.0, -1.0, 0.0]),
            BTreeMap::from([(2000, 1.0)])
        );
        // Two crests that unload in between.
        assert_eq!(
            cycles(&[0.0, 1.0, 0.0, 2.0, 0.0]),
            BTreeMap::from([(1000, 1.0), (2000, 1.0)])
        );
        assert_eq!(cycles(&[0.0, 1.0]), BTreeMap::from([(1000, 1.0)]));
        assert!(cycles(&[0.0]).is_empty() && cycles(&[3.0, 3.0]).is_empty());
        // The standard's example begins and ends at −2: the ranges 9, 8 and the three small ones close.
        let history = [-2.0, 1.0, -3.0, 5.0, -1.0, 3.0, -4.0, 4.0, -2.0];
        let expected = [(3000, 1.0), (4000, 1.0), (7000, 1.0), (9000, 1.0)];
        assert_eq!(cycles(&history), BTreeMap::from(expected));
    }

    #[test]
    fn values_between_reversals_change_nothing() {
        let history = [0.0, 1.0, 2.0, 2.0, 1.0, 0.5, 3.0, 2.9, 0.0];
        let reversals = [0.0, 2.0, 0.5, 3.0, 0.0];
        assert_eq!(count(&history, 0.0, 64).0, count(&reversals, 0.0, 64).0);
    }

    #[test]
    fn gate_hides_small_wiggles_only() {
        // Ten full crests with a 2 % wiggle on each flank.
        let mut history = vec![0.0];
        for _ in 0..10 {
            history.extend([0.5, 0.48, 1.0, 0.5, 0.52, 0.0]);
        }
        let total = |gate| -> f64 { count(&history, gate, 64).0.iter().map(|c| c.count).sum() };
        assert!((total(0.05) - 10.0).abs() < 1e-12, "{}", total(0.05));
        assert!((total(0.0) - 30.0).abs() < 1e-12);
    }

    #[test]
    fn full_memory_counts_the_oldest_as_half() {
        let history: Vec<f64> = (0..40)
            .map(|i| (1.0 - 0.01 * i as f64) * if i % 2 == 0 { 1.0 } else { -1.0 })
            .collect();
        let (cycles, forced) = count(&history, 0.0, 8);
        assert!(forced > 0);
        // A shrinking history is all half cycles, early or late.
        assert_eq!(cycles, count(&history, 0.0, 64).0);
    }

    proptest! {
        #[test]
        fn half_ranges_are_conserved(history in proptest::collection::vec(-5_i32..=5, 2..60)) {
            // Every counted cycle uses up two reversal-to-reversal ranges, every half cycle one.
            let values: Vec<f64> = history.iter().map(|v| f64::from(*v)).collect();
            let mut reversals: Vec<f64> = Vec::new();
            for v in &values {
                if reversals.last() == Some(v) { continue; }
                let n = reversals.len();
                if n >= 2 && (reversals[n - 1] - reversals[n - 2]) * (v - reversals[n - 1]) > 0.0 {
                    reversals[n - 1] = *v;
                } else {
                    reversals.push(*v);
                }
            }
            let total: f64 = count(&values, 0.0, 256).0.iter().map(|c| c.count).sum();
            prop_assert!((total - 0.5 * (reversals.len().saturating_sub(1)) as f64).abs() < 1e-9);
        }

        #[test]
        fn a_repeated_history_may_start_anywhere(
            history in proptest::collection::vec(-5_i32..=5, 2..40), turn in 0_usize..40
        ) {
            let values: Vec<f64> = history.iter().map(|v| f64::from(*v)).collect();
            let mut turned = values.clone();
            turned.rotate_left(turn % values.len());
            let cycles = |v: &[f64]| by_range(&count_as(HistoryEnds::Repeating, v, 0.0, 256).0);
            prop_assert_eq!(cycles(&values), cycles(&turned));
        }

        #[test]
        fn greatest_range_is_found(history in proptest::collection::vec(-5.0_f64..5.0, 3..60)) {
            let cycles = count(&history, 0.0, 256).0;
            let span = history.iter().fold(f64::MIN, |a, b| a.max(*b))
                - history.iter().fold(f64::MAX, |a, b| a.min(*b));
            let most = cycles.iter().fold(0.0_f64, |a, c| a.max(c.range));
            prop_assert!((most - span).abs() < 1e-12);
        }
    }
}
