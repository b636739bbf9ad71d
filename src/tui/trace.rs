//! The history of a material point while it crosses the contact, kept from the frames that the
//! screen took.

use crate::sim::MaterialPoint;

/// Most samples of one crossing that are kept.
const CAPACITY: usize = 4096;

/// One moment of the point.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct TraceSample {
    /// Where, m.
    pub x_m: f64,
    /// Pressure above it, Pa.
    pub pressure_pa: f64,
    /// Effective stress, Pa.
    pub effective_pa: f64,
    /// Signed orthogonal shear, Pa.
    pub tau_xz_pa: f64,
    /// Cycles counted so far.
    pub cycles: f64,
}

/// This crossing and the one before it.
#[derive(Debug, Clone, Default)]
pub struct Trace {
    body: u8,
    depth_m: f64,
    current: Vec<TraceSample>,
    before: Vec<TraceSample>,
}

impl Trace {
    /// Adds the point of a newer frame; a point that jumped back began another crossing.
    pub fn push(&mut self, point: &MaterialPoint, half_width_m: f64) {
        let sample = TraceSample {
            x_m: point.x_m,
            pressure_pa: point.pressure_pa,
            effective_pa: point.effective_pa,
            tau_xz_pa: point.tau_xz_pa,
            cycles: point.cycles_counted,
        };
        let other_point = point.body != self.body || point.depth_m != self.depth_m;
        if other_point {
            self.current.clear();
            self.before.clear();
            self.body = point.body;
            self.depth_m = point.depth_m;
        }
        if let Some(last) = self.current.last() {
            let jumped = (sample.x_m - last.x_m).abs() > half_width_m;
            if jumped || sample.cycles < last.cycles {
                std::mem::swap(&mut self.before, &mut self.current);
                self.current.clear();
            }
        }
        if self.current.len() < CAPACITY {
            self.current.push(sample);
        }
    }

    /// This crossing so far.
    pub fn current(&self) -> &[TraceSample] {
        &self.current
    }

    /// The whole crossing before.
    pub fn before(&self) -> &[TraceSample] {
        &self.before
    }

    /// Places where the count of this crossing went up by one, m.
    pub fn ticks(&self) -> impl Iterator<Item = f64> + '_ {
        self.current.windows(2).filter_map(|pair| {
            let [first, second] = pair else { return None };
            (second.cycles.floor() > first.cycles.floor()).then_some(second.x_m)
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn at(x_m: f64, cycles_counted: f64) -> MaterialPoint {
        MaterialPoint {
            body: 1,
            x_m,
            cycles_counted,
            ..MaterialPoint::default()
        }
    }

    #[test]
    fn a_jump_back_begins_another_crossing() {
        let mut trace = Trace::default();
        for i in 0..10 {
            trace.push(&at(-2e-4 + 4e-5 * f64::from(i), 0.0), 1e-4);
        }
        trace.push(&at(-2e-4, 0.0), 1e-4);
        assert_eq!((trace.current().len(), trace.before().len()), (1, 10));
    }

    #[test]
    fn ticks_stand_where_the_count_rose() {
        let mut trace = Trace::default();
        for (x, cycles) in [
            (0.0, 0.0),
            (1e-5, 0.5),
            (2e-5, 1.0),
            (3e-5, 1.5),
            (4e-5, 2.5),
        ] {
            trace.push(&at(x, cycles), 1e-4);
        }
        let ticks: Vec<f64> = trace.ticks().collect();
        assert_eq!(ticks, [2e-5, 4e-5]);
    }

    #[test]
    fn another_body_or_depth_starts_afresh() {
        let mut trace = Trace::default();
        trace.push(&at(0.0, 1.0), 1e-4);
        let mut other = at(1e-5, 1.0);
        other.body = 2;
        trace.push(&other, 1e-4);
        assert_eq!((trace.current().len(), trace.before().len()), (1, 0));
    }
}
