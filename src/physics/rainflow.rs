//! Rainflow counting, streaming.
//!
//! ```text
//! X = range of the newest pair of reversals, Y = range of the pair before it
//! X < Y: wait.   X >= Y: Y is a full cycle and leaves, or a half cycle if it starts the record
//! at the end every range that is left is a half cycle
//! ```
//! Source: ASTM E1049-85, section 5.4.4. Ranges below the gate are not counted. Memory is bounded:
//! when the stack of open reversals is full, the oldest leaves as a half cycle (1024 open reversals
//! need a record whose ranges shrink a thousand times in a row).

/// Most open reversals.
const CAPACITY: usize = 1024;

/// A counter of one record.
#[derive(Debug, Clone)]
pub struct Rainflow {
    gate: f64,
    stack: Vec<f64>,
    /// Last value, and whether it came from below (`None`: no direction yet).
    last: Option<f64>,
    rising: Option<bool>,
    cycles: f64,
}

impl Rainflow {
    /// A counter that ignores ranges below `gate`.
    pub fn new(gate: f64) -> Self {
        Self {
            gate,
            stack: Vec::with_capacity(CAPACITY),
            last: None,
            rising: None,
            cycles: 0.0,
        }
    }

    /// Forgets the record.
    pub fn reset(&mut self) {
        self.stack.clear();
        (self.last, self.rising, self.cycles) = (None, None, 0.0);
    }

    /// Takes the next value; `count(range, cycles)` is called for what closes.
    pub fn push(&mut self, value: f64, count: &mut impl FnMut(f64, f64)) {
        let Some(last) = self.last else {
            self.last = Some(value);
            return;
        };
        if value == last {
            return;
        }
        let rising = value > last;
        if self.rising != Some(rising) {
            self.reversal(last, count);
            self.rising = Some(rising);
        }
        self.last = Some(value);
    }

    /// Ends the record; returns all cycles counted, halves included.
    pub fn finish(&mut self, count: &mut impl FnMut(f64, f64)) -> f64 {
        if let Some(last) = self.last.take() {
            self.reversal(last, count);
        }
        for k in 1..self.stack.len() {
            let range = (self.stack[k] - self.stack[k - 1]).abs();
            self.close(range, 0.5, count);
        }
        let cycles = self.cycles;
        self.reset();
        cycles
    }

    /// Cycles closed so far.
    pub fn cycles(&self) -> f64 {
        self.cycles
    }

    fn close(&mut self, range: f64, cycles: f64, count: &mut impl FnMut(f64, f64)) {
        if range >= self.gate {
            self.cycles += cycles;
            count(range, cycles);
        }
    }

    fn reversal(&mut self, value: f64, count: &mut impl FnMut(f64, f64)) {
        if self.stack.len() == CAPACITY {
            let range = (self.stack[1] - self.stack[0]).abs();
            self.close(range, 0.5, count);
            self.stack.remove(0);
        }
        self.stack.push(value);
        while let [.., a, b, c] = self.stack[..] {
            let (newest, before) = ((c - b).abs(), (b - a).abs());
            if newest < before {
                break;
            }
            if self.stack.len() == 3 {
                self.close(before, 0.5, count);
                self.stack.remove(0);
            } else {
                self.close(before, 1.0, count);
                self.stack.truncate(self.stack.len() - 3);
                self.stack.push(c);
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn counts(values: &[f64], gate: f64) -> (Vec<(f64, f64)>, f64) {
        let mut flow = Rainflow::new(gate);
        let mut table: Vec<(f64, f64)> = Vec::new();
        let mut add = |range: f64, cycles: f64| {
            match table.iter_mut().find(|row| row.0 == range) {
                Some(row) => row.1 += cycles,
                None => table.push((range, cycles)),
            }
        };
        for &value in values {
            flow.push(value, &mut add);
        }
        let total = flow.finish(&mut add);
        table.sort_by(|a, b| a.0.total_cmp(&b.0));
        (table, total)
    }

    #[test]
    fn the_example_of_the_standard() {
        let record = [-2.0, 1.0, -3.0, 5.0, -1.0, 3.0, -4.0, 4.0, -2.0];
        let (table, total) = counts(&record, 0.0);
        assert_eq!(
            table,
            [(3.0, 0.5), (4.0, 1.5), (6.0, 0.5), (8.0, 1.0), (9.0, 0.5)]
        );
        assert_eq!(total, 4.0);
    }

    #[test]
    fn a_gate_hides_small_ranges_and_a_pulse_is_one_cycle() {
        let record = [0.0, 1.0, 0.98, 1.0, 0.0];
        assert_eq!(counts(&record, 0.05).1, 1.0);
        assert_eq!(counts(&record, 0.0).1, 2.0);
        assert_eq!(counts(&[0.0, 0.0, 0.0], 0.0).1, 0.0);
    }

    #[test]
    fn memory_stays_bounded() {
        let mut flow = Rainflow::new(0.0);
        for k in 0..5000 {
            let size = 1.0 / f64::from(k + 1);
            flow.push(if k % 2 == 0 { size } else { -size }, &mut |_, _| {});
        }
        assert!(flow.stack.len() <= CAPACITY);
    }
}
