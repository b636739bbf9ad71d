//! Material points of one body on the line y = 0, carried through the contact, and the cycles they see.
//!
//! ```text
//! x_p ← x_p + U_i Δt      (no grid node: values are interpolated along x)
//! history of a crossing: 0, p(x_p, t), ..., 0      and the same of signed τ_xz at each depth
//! rainflow (ASTM E1049) with a gate → cycles per crossing; mean over points that are staggered in phase
//! ```
//! A point crosses at every turn of its body, so the history counts as one that repeats
//! ([`crate::physics::rainflow::Ends::Repeating`]): every cycle closes.
//!
//! *What the count is compared with.* The pressure of ripples that unload fully returns to zero between
//! crests, so its cycles are the crests that a point meets: `f δ` within the zone, and the crest that the
//! zone's edge cuts whenever what is left of it passes the gate: 0.6 times in a crossing of a Hertz
//! contact at a gate of 5 %. The mean count therefore lies between `f δ` and the formula's `n = 1 + f δ`.
//! The signed shear of a shallow point counts the same crests (8.3 to 9.4 where n = 9); from one wavelength
//! down one cycle is left. Accepted is `|mean − f δ| ≤ 1` for the pressure, and from `f δ = 10` on 5 % of
//! `f δ` or of n (`tests/life.rs`), with at least 8 points and 16 samples a crest,
//! `Δt ≤ W/(16 |U_2 − U_1|)`.
//!
//! Lengths in a, stress in p_h. Memory is made once; steps allocate nothing.

use serde::{Deserialize, Serialize};

pub use super::tally::Tally;
use super::tally::{Crossing, History};

/// Fraction of the golden section: multiples of it, modulo 1, spread evenly and never fall into step with
/// the ripples, as equal spacing may.
const GOLDEN: f64 = 0.618_033_988_749_894_9;

/// What is followed.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub struct TrackerSpec {
    /// Points, staggered over the track; at least 8 for a mean over phases.
    pub points: usize,
    /// Ends of the track: the domain's edges along x, where the pressure is zero, a.
    pub x_first: f64,
    /// Other end, a.
    pub x_last: f64,
    /// Least range of pressure that counts, p_h.
    pub pressure_gate: f64,
    /// Least range of shear that counts, p_h.
    pub shear_gate: f64,
    /// Depths at which shear is followed (0: pressure alone); the slice's own depths.
    pub depths: usize,
    /// Depth of the point that is shown, an index below `depths`.
    pub shown_depth: usize,
    /// Exponent of Miner's sum of ranges.
    pub damage_exponent: f64,
    /// Samples kept of the shown point's crossing.
    pub trace: usize,
}

impl TrackerSpec {
    /// Gate on the pressure's ranges, p_h.
    pub const PRESSURE_GATE: f64 = 0.05;
    /// Gate on the shear's ranges, p_h: the same part of its own scale (τ_xz of Hertz swings by 0.5 p_h).
    pub const SHEAR_GATE: f64 = 0.02;

    /// Sixteen points, default gates.
    pub fn new((x_first, x_last): (f64, f64), depths: usize, damage_exponent: f64) -> Self {
        Self {
            points: 16,
            x_first,
            x_last,
            pressure_gate: Self::PRESSURE_GATE,
            shear_gate: Self::SHEAR_GATE,
            depths,
            shown_depth: 0,
            damage_exponent,
            trace: 2048,
        }
    }
}

/// The line y = 0 at one instant.
#[derive(Debug, Clone, Copy)]
pub struct Line<'a> {
    /// Coordinate of the first node, a.
    pub x_first: f64,
    /// Node spacing, a.
    pub dx: f64,
    /// Pressure at the nodes, p_h.
    pub pressure: &'a [f32],
    /// Signed orthogonal shear below the nodes, `[k·nx + i]`; `None`: not known.
    pub tau_xz: Option<&'a [f32]>,
}

impl Line<'_> {
    /// Linear interpolation in one row of nodes; 0 outside.
    fn at(&self, row: &[f32], x: f64) -> f64 {
        let place = (x - self.x_first) / self.dx;
        if place < 0.0 || place > (row.len() - 1) as f64 {
            return 0.0;
        }
        let i = (place as usize).min(row.len().saturating_sub(2));
        let part = place - i as f64;
        f64::from(row[i]) * (1.0 - part) + f64::from(row[i + 1]) * part
    }

    fn pressure_at(&self, x: f64) -> f64 {
        self.at(self.pressure, x)
    }

    fn shear_at(&self, k: usize, x: f64) -> f64 {
        let nx = self.pressure.len();
        self.tau_xz
            .and_then(|tau| tau.get(k * nx..(k + 1) * nx))
            .map_or(0.0, |row| self.at(row, x))
    }
}

#[derive(Debug, Clone, Serialize, Deserialize)]
struct Point {
    x: f64,
    crossing: Crossing,
    pressure: History,
    shear: Vec<History>,
}

/// A sample of the shown point.
#[derive(Debug, Clone, Copy, PartialEq, Default, Serialize, Deserialize)]
pub struct Sample {
    /// Where it is, a.
    pub x: f64,
    /// Pressure above it, p_h.
    pub pressure: f64,
    /// Signed orthogonal shear at the shown depth, p_h.
    pub tau_xz: f64,
    /// Pressure cycles of this crossing so far.
    pub counted: f64,
}

/// Points of one body under way.
#[derive(Debug, Clone, Serialize, Deserialize)]
pub struct MaterialTracker {
    spec: TrackerSpec,
    points: Vec<Point>,
    crossings: u64,
    /// Samples of the shown point's crossing, oldest first from `oldest` on.
    trace: Vec<Sample>,
    oldest: usize,
}

impl MaterialTracker {
    /// Points spread over the track; at least one.
    pub fn new(spec: TrackerSpec) -> Self {
        let length = spec.x_last - spec.x_first;
        let count = spec.points.max(1);
        let point = |i: usize| Point {
            x: spec.x_first + length * (GOLDEN * i as f64).fract(),
            crossing: Crossing::New,
            pressure: History::new(spec.pressure_gate),
            // Each made anew: a clone would not have the room.
            shear: (0..spec.depths)
                .map(|_| History::new(spec.shear_gate))
                .collect(),
        };
        let mut tracker = Self {
            spec,
            points: (0..count).map(point).collect(),
            crossings: 0,
            trace: Vec::with_capacity(spec.trace.max(1)),
            oldest: 0,
        };
        tracker.restart();
        tracker
    }

    /// Makes the room again that a copy or a file does not keep.
    pub fn make_room(&mut self) {
        for point in &mut self.points {
            for history in std::iter::once(&mut point.pressure).chain(&mut point.shear) {
                history.flow.make_room();
            }
        }
        let room = self.spec.trace.max(1).saturating_sub(self.trace.len());
        self.trace.reserve_exact(room);
    }

    /// Whether a tracker that was read from a file can be used.
    pub fn is_sound(&self) -> bool {
        let depths = |point: &Point| point.shear.len() == self.spec.depths;
        !self.points.is_empty()
            && self.points.iter().all(depths)
            && self.oldest < self.trace.len().max(1)
    }

    /// Forgets all counts (after a change of speeds, load or roughness); points stay where they are.
    pub fn restart(&mut self) {
        let exponent = self.spec.damage_exponent;
        for point in &mut self.points {
            point.crossing = Crossing::New;
            for history in std::iter::once(&mut point.pressure).chain(&mut point.shear) {
                history.start(exponent);
                history.last = None;
            }
        }
        self.crossings = 0;
        self.trace.clear();
        self.oldest = 0;
    }

    /// Moves every point by `travel = U_i Δt` (in a, signed) and samples the line there.
    pub fn step(&mut self, travel: f64, line: &Line) {
        for i in 0..self.points.len() {
            if self.advance(i, travel) {
                self.crossings += u64::from(self.points[i].crossing == Crossing::Whole);
                self.points[i].crossing = Crossing::Whole;
                if i == 0 {
                    self.trace.clear();
                    self.oldest = 0;
                }
            }
            self.sample(i, travel, line);
        }
        let shown = self.shown(line);
        if self.trace.len() < self.spec.trace.max(1) {
            self.trace.push(shown);
        } else {
            self.trace[self.oldest] = shown;
            self.oldest = (self.oldest + 1) % self.trace.len();
        }
    }

    /// Moves a point; true when it left the track and entered it anew.
    fn advance(&mut self, i: usize, travel: f64) -> bool {
        let (first, last) = (self.spec.x_first, self.spec.x_last);
        let exponent = self.spec.damage_exponent;
        let point = &mut self.points[i];
        point.x += travel;
        let left = if travel > 0.0 {
            point.x >= last
        } else {
            travel < 0.0 && point.x <= first
        };
        if left {
            point.x = first + (point.x - first).rem_euclid(last - first);
            let crossing = point.crossing;
            for history in std::iter::once(&mut point.pressure).chain(&mut point.shear) {
                history.end(exponent, crossing);
                history.start(exponent);
            }
        }
        left
    }

    fn sample(&mut self, i: usize, travel: f64, line: &Line) {
        let (gate, exponent) = (self.spec.pressure_gate, self.spec.damage_exponent);
        let point = &mut self.points[i];
        let pressure = line.pressure_at(point.x);
        if point.crossing == Crossing::New && travel != 0.0 {
            // Followed from the start only if it is still ahead of the contact and unloaded.
            let ahead = point.x * travel < 0.0 && pressure < gate;
            point.crossing = if ahead {
                Crossing::Whole
            } else {
                Crossing::Part
            };
        }
        point.pressure.push(pressure, exponent);
        if line.tau_xz.is_some() {
            for (k, history) in point.shear.iter_mut().enumerate() {
                history.push(line.shear_at(k, point.x), exponent);
            }
        }
    }

    /// The point on the screen, as the line now is.
    pub fn shown(&self, line: &Line) -> Sample {
        let point = &self.points[0];
        Sample {
            x: point.x,
            pressure: line.pressure_at(point.x),
            tau_xz: line.shear_at(self.spec.shown_depth, point.x),
            counted: point.pressure.tally.count,
        }
    }

    /// Samples of the shown point's present crossing, oldest first.
    pub fn trace(&self) -> impl Iterator<Item = &Sample> {
        self.trace[self.oldest..]
            .iter()
            .chain(&self.trace[..self.oldest])
    }

    /// Whole crossings finished since the start.
    pub fn crossings(&self) -> u64 {
        self.crossings
    }

    /// Mean over the points' last whole crossings of the pressure's cycles; `None` until one is finished.
    pub fn pressure_cycles(&self) -> Option<Tally> {
        mean(self.points.iter().filter_map(|p| p.pressure.last))
    }

    /// Same of the signed shear at depth `k`.
    pub fn shear_cycles(&self, k: usize) -> Option<Tally> {
        mean(self.points.iter().filter_map(|p| p.shear.get(k)?.last))
    }

    /// Points whose last whole crossing is in the mean.
    pub fn phases(&self) -> usize {
        self.points
            .iter()
            .filter(|p| p.pressure.last.is_some())
            .count()
    }

    /// Mean cycles of pressure that the points have seen so far in their present crossing: for a body
    /// that stands, whose crossing never ends, this over the time is its rate.
    pub fn open_cycles(&self) -> f64 {
        let sum: f64 = self.points.iter().map(|p| p.pressure.tally.count).sum();
        sum / self.points.len() as f64
    }
}

fn mean(tallies: impl Iterator<Item = Tally>) -> Option<Tally> {
    let (mut sum, mut count) = (Tally::default(), 0.0);
    for tally in tallies {
        sum.count += tally.count;
        sum.damage += tally.damage;
        sum.equivalent += tally.equivalent;
        sum.range = sum.range.max(tally.range);
        count += 1.0;
    }
    (count > 0.0).then(|| Tally {
        count: sum.count / count,
        damage: sum.damage / count,
        equivalent: sum.equivalent / count,
        range: sum.range,
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A smooth bump over [−1, 1] on 201 nodes of [−2, 2].
    fn bump() -> Vec<f32> {
        (0..201)
            .map(|i| {
                let x = -2.0 + 0.02 * f64::from(i);
                (1.0 - x * x).max(0.0).sqrt() as f32
            })
            .collect()
    }

    #[test]
    fn smooth_passage_is_one_cycle_in_both_directions() {
        let pressure = bump();
        let line = Line {
            x_first: -2.0,
            dx: 0.02,
            pressure: &pressure,
            tau_xz: None,
        };
        for travel in [0.03, -0.03] {
            let mut tracker = MaterialTracker::new(TrackerSpec::new((-2.0, 2.0), 0, 10.0));
            for _ in 0..400 {
                tracker.step(travel, &line);
            }
            let tally = tracker.pressure_cycles().expect("crossings finished");
            assert_eq!((tally.count, tracker.phases()), (1.0, 16));
            assert!((tally.equivalent - 1.0).abs() < 1e-12);
        }
    }

    #[test]
    fn a_crossing_seen_from_its_middle_does_not_count() {
        let pressure = bump();
        let line = Line {
            x_first: -2.0,
            dx: 0.02,
            pressure: &pressure,
            tau_xz: None,
        };
        let mut spec = TrackerSpec::new((-2.0, 2.0), 0, 10.0);
        spec.points = 4; // at −2, 0.47, −1.06 and 1.42
        let mut tracker = MaterialTracker::new(spec);
        for _ in 0..104 {
            tracker.step(0.02, &line);
        }
        // The points from inside and from behind the contact have left.
        assert_eq!(tracker.crossings(), 0);
        assert!(tracker.pressure_cycles().is_none());
        for _ in 0..104 {
            tracker.step(0.02, &line);
        }
        assert_eq!(tracker.crossings(), 2);
    }

    #[test]
    fn a_standing_body_counts_by_time() {
        let mut tracker = MaterialTracker::new(TrackerSpec::new((-1.0, 1.0), 0, 10.0));
        for step in 0..1600 {
            let wave = (std::f64::consts::TAU * f64::from(step) / 16.0).cos();
            let pressure = [(1.0 + wave) as f32; 5];
            let line = Line {
                x_first: -1.0,
                dx: 0.5,
                pressure: &pressure,
                tau_xz: None,
            };
            tracker.step(0.0, &line);
        }
        println!("100 crests over a standing body: {}", tracker.open_cycles());
        assert!(tracker.pressure_cycles().is_none());
        assert!((tracker.open_cycles() - 100.0).abs() <= 1.5);
    }

    #[test]
    fn the_trace_is_bounded_and_in_order() {
        let pressure = bump();
        let line = Line {
            x_first: -2.0,
            dx: 0.02,
            pressure: &pressure,
            tau_xz: None,
        };
        let mut spec = TrackerSpec::new((-2.0, 2.0), 0, 10.0);
        spec.trace = 10;
        let mut tracker = MaterialTracker::new(spec);
        for _ in 0..57 {
            tracker.step(0.02, &line);
        }
        let xs: Vec<f64> = tracker.trace().map(|s| s.x).collect();
        assert_eq!(xs.len(), 10);
        assert!(xs.windows(2).all(|pair| pair[1] > pair[0]));
        assert!((xs[9] - (-2.0 + 57.0 * 0.02)).abs() < 1e-9);
    }
}
