//! Material points that cross the contact with their body, and the cycles that they see.
//!
//! ```text
//! x_k ← x_k + U_i Δt,   history p(x_k(t), 0, t) for −L/2 ≤ x_k ≤ L/2, zero before and after
//! ```
//! Eight points of each body, an eighth of the zone apart, so that the count is a mean over phases.
//! A point that leaves the zone enters it again as a new one; the crossing in which it was at the
//! start does not count. The pressure history is counted by rainflow with a gate of 5 % of p_h. For a
//! comb of full ripples the count is f δ to within one; n of the formula is 1 + f δ.
//! Lengths in a, pressure in p_h.

use crate::physics::rainflow::Rainflow;

/// Points of a body.
const POINTS: usize = 8;
/// Ranges below this part of p_h are not counted.
pub const GATE: f64 = 0.05;
/// Half of the zone.
const HALF: f64 = 1.0;

/// One material point.
#[derive(Debug, Clone)]
struct Point {
    x: f64,
    flow: Rainflow,
    /// Whether the crossing was seen from its beginning.
    whole: bool,
}

/// The points of one body.
#[derive(Debug, Clone)]
pub struct Track {
    points: Vec<Point>,
    crossings: u64,
    cycles: f64,
}

/// One row of pressure along x.
#[derive(Debug, Clone, Copy)]
pub struct Row<'a> {
    /// Values.
    pub values: &'a [f64],
    /// First node.
    pub x_min: f64,
    /// Spacing.
    pub dx: f64,
}

impl Row<'_> {
    /// Value at `x`, linear between nodes, zero outside.
    pub fn at(&self, x: f64) -> f64 {
        let position = (x - self.x_min) / self.dx;
        if position < 0.0 {
            return 0.0;
        }
        let i = position as usize;
        if i + 1 >= self.values.len() {
            return 0.0;
        }
        let t = position - i as f64;
        self.values[i] * (1.0 - t) + self.values[i + 1] * t
    }
}

impl Default for Track {
    fn default() -> Self {
        Self::new()
    }
}

impl Track {
    /// Points spread over the zone.
    pub fn new() -> Self {
        let spacing = 2.0 * HALF / POINTS as f64;
        Self {
            points: (0..POINTS)
                .map(|k| Point {
                    x: -HALF + (k as f64 + 0.5) * spacing,
                    flow: Rainflow::new(GATE),
                    whole: false,
                })
                .collect(),
            crossings: 0,
            cycles: 0.0,
        }
    }

    /// Forgets the counts; the points stay where they are.
    pub fn restart(&mut self) {
        (self.crossings, self.cycles) = (0, 0.0);
        for point in &mut self.points {
            point.whole = false;
            point.flow.reset();
        }
    }

    /// Moves the points by `travel` (either sign) and samples the pressure.
    pub fn push(&mut self, row: &Row, travel: f64) {
        for point in &mut self.points {
            point.x += travel;
            if point.x.abs() > HALF {
                point.flow.push(0.0, &mut |_, _| {});
                let cycles = point.flow.finish(&mut |_, _| {});
                if point.whole {
                    self.crossings += 1;
                    self.cycles += cycles;
                }
                point.x -= 2.0 * HALF * point.x.signum();
                point.whole = true;
                point.flow.push(0.0, &mut |_, _| {});
            }
            point.flow.push(row.at(point.x), &mut |_, _| {});
        }
    }

    /// Mean cycles of a crossing; `None` before all points have crossed once.
    pub fn mean_cycles(&self) -> Option<f64> {
        (self.crossings >= POINTS as u64).then(|| self.cycles / self.crossings as f64)
    }

    /// Place and cycles so far of the first point.
    pub fn shown(&self) -> (f64, f64) {
        (self.points[0].x, self.points[0].flow.cycles())
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Full ripples of wavelength `w` that move with the mating body over a Hertz profile.
    fn counted(own: f64, mating: f64, w: f64) -> f64 {
        let n = 2001;
        let dx = 3.0 / (n - 1) as f64;
        let mut values = vec![0.0; n];
        let mut track = Track::new();
        let dt = (w / (24.0 * (mating - own).abs())).min(0.01);
        let mut t = 0.0;
        while t < 12.0 {
            for (i, v) in values.iter_mut().enumerate() {
                let x = -1.5 + i as f64 * dx;
                let ripple = 1.0 + (std::f64::consts::TAU * (x - mating * t) / w).cos();
                *v = (1.0 - x * x).max(0.0).sqrt() * ripple;
            }
            let row = Row {
                values: &values,
                x_min: -1.5,
                dx,
            };
            track.push(&row, own * dt);
            t += dt;
        }
        track.mean_cycles().expect("all points crossed")
    }

    #[test]
    fn a_comb_of_full_ripples_is_counted() {
        for (s, w) in [(0.1_f64, 0.1), (0.25, 0.25), (0.5, 0.1), (0.5, 0.25), (1.0, 0.1), (1.0, 0.4)] {
            for (own, mating) in [(1.0 - 0.5 * s, 1.0 + 0.5 * s), (1.0 + 0.5 * s, 1.0 - 0.5 * s)] {
                let expected = (mating - own).abs() / own * 2.0 / w;
                let count = counted(own, mating, w);
                let error = (count - expected).abs();
                println!("S {s} W {w}a own {own}: counted {count:.2}, f delta {expected:.2}");
                assert!(error <= 1.0, "{count} {expected}");
                assert!(expected < 10.0 || error <= 0.05 * expected, "{count} {expected}");
            }
        }
    }

    #[test]
    fn pure_rolling_is_one_cycle() {
        let count = counted(1.0, 1.0 + 1e-9, 0.25);
        assert!((count - 1.0).abs() < 0.13, "{count}");
    }
}
