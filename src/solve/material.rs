//! Material points of one body on the line y = 0, carried through the contact, and the cycles they see.
//!
//! ```text
//! x_p ← x_p + U_i Δt     (no grid node: values are interpolated along x)
//! history of a crossing of −a ≤ x ≤ a: 0, p(x_p, t), ..., 0;   the same of signed τ_xz at each depth
//! rainflow (ASTM E1049) with a gate → cycles per crossing; mean over points of different phase
//! ```
//! A point that leaves the zone enters it again; the crossing in which it was at the start does not
//! count. A point of the body crosses at every turn, so its history counts as one that repeats
//! ([`Ends::Repeating`]): every cycle closes. The points stand a golden section apart: with even spacing
//! all of them would meet the ripples in the same phase whenever the spacing is a multiple of the
//! wavelength, and the mean would be off by up to one.
//!
//! *What the count is compared with.* The pressure of ripples that unload fully returns to zero between
//! crests, so its cycles are the crests that a point meets: `f δ` within the zone, and the crest that the
//! zone's edge cuts whenever what is left of it passes the gate: 0.6 times in a crossing of a Hertz
//! contact at a gate of 5 %. The mean count therefore lies between `f δ` and the formula's `n = 1 + f δ`.
//! The signed shear of a shallow point counts the same crests (8.3 to 8.6 where f δ = 8); from one wavelength
//! down one cycle is left. Accepted is `|mean − f δ| ≤ 1` for the pressure, and from `f δ = 10` on 5 % of
//! `f δ` or of n (`tests/life.rs`), with at least 8 points and 16 samples a crest,
//! `Δt ≤ W/(16 |U_2 − U_1|)`.
//!
//! Lengths in a, stress in p_h. Memory is made once; steps allocate nothing.

use crate::physics::rainflow::{Cycle, Ends, Rainflow};

/// Ranges of pressure below this part of p_h are not counted.
pub const GATE: f64 = 0.05;
/// Ranges of shear below this part of p_h are not counted: the same part of its own scale (the τ_xz of
/// Hertz swings by 0.43 to 0.5 p_h).
pub const SHEAR_GATE: f64 = 0.02;
/// Half of the zone.
const HALF: f64 = 1.0;
/// Open reversals of a crossing: far more than the crests of any contact that a grid resolves.
const OPEN: usize = 512;
/// Fraction of the golden section: multiples of it, modulo 1, spread evenly and fall into step with nothing.
const GOLDEN: f64 = 0.618_033_988_749_894_9;

/// What is followed.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct TrackSpec {
    /// Points, at least 8 for a mean over phases.
    pub points: usize,
    /// Depths at which shear is followed (0: pressure alone).
    pub depths: usize,
    /// Exponent of Miner's sum of ranges.
    pub damage_exponent: f64,
    /// Samples kept of the shown point's crossing (0: none).
    pub trace: usize,
}

impl Default for TrackSpec {
    /// Sixteen points, pressure alone, Lundberg-Palmgren's exponent of 9.3 on stress, no trace.
    fn default() -> Self {
        Self {
            points: 16,
            depths: 0,
            damage_exponent: 9.3,
            trace: 0,
        }
    }
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
        self.place(x).map_or(0.0, |(i, t)| {
            self.values[i] * (1.0 - t) + self.values[i + 1] * t
        })
    }

    /// Same in row `k` of another field on the same nodes.
    fn at_depth(&self, field: &[f32], k: usize, x: f64) -> f64 {
        let first = k * self.values.len();
        self.place(x).map_or(0.0, |(i, t)| {
            let number = |i: usize| field.get(first + i).map_or(0.0, |v| f64::from(*v));
            number(i) * (1.0 - t) + number(i + 1) * t
        })
    }

    /// Node to the left and part of the way to the next.
    fn place(&self, x: f64) -> Option<(usize, f64)> {
        let position = (x - self.x_min) / self.dx;
        if position.is_nan() || position < 0.0 {
            return None;
        }
        let i = position as usize;
        (i + 1 < self.values.len()).then_some((i, position - i as f64))
    }
}

/// Cycles of one history.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct Tally {
    /// Cycles with a range above the gate.
    pub count: f64,
    /// `Σ count · (range/greatest)^m`: as many cycles of the greatest range do the same damage.
    pub equivalent: f64,
    /// Greatest range.
    pub range: f64,
    /// Σ count · range^m.
    damage: f64,
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
#[derive(Debug, Clone)]
struct History {
    flow: Rainflow,
    tally: Tally,
    /// Tally of the last whole crossing.
    last: Option<Tally>,
}

impl History {
    fn new(gate: f64) -> Self {
        let mut history = Self {
            flow: Rainflow::new(Ends::Repeating, gate, OPEN),
            tally: Tally::default(),
            last: None,
        };
        history.start();
        history
    }

    fn push(&mut self, value: f64, exponent: f64) {
        let Self { flow, tally, .. } = self;
        flow.push(value, &mut |cycle| tally.add(cycle, exponent));
    }

    /// Starts a crossing at zero stress.
    fn start(&mut self) {
        self.flow.reset();
        self.flow.push(0.0, &mut |_| {});
        self.tally = Tally::default();
    }

    /// Ends it at zero stress.
    fn end(&mut self, exponent: f64, crossing: Crossing) {
        self.push(0.0, exponent);
        let Self { flow, tally, last } = self;
        flow.finish(&mut |cycle| tally.add(cycle, exponent));
        if crossing == Crossing::Whole {
            *last = Some(*tally);
        }
        self.start();
    }
}

/// Whether a point's crossing has been followed from its start.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Crossing {
    Whole,
    Part,
}

#[derive(Debug, Clone)]
struct Point {
    x: f64,
    crossing: Crossing,
    pressure: History,
    shear: Vec<History>,
}

impl Point {
    fn histories(&mut self) -> impl Iterator<Item = &mut History> {
        std::iter::once(&mut self.pressure).chain(&mut self.shear)
    }

    /// Moves the point; true when it left the zone and entered it anew.
    fn advance(&mut self, travel: f64, exponent: f64) -> bool {
        self.x += travel;
        let left = self.x.abs() > HALF;
        if left {
            self.x = (self.x + HALF).rem_euclid(2.0 * HALF) - HALF;
            let crossing = self.crossing;
            for history in self.histories() {
                history.end(exponent, crossing);
            }
        }
        left
    }
}

/// A sample of the shown point.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct Sample {
    /// Where it is.
    pub x: f64,
    /// Pressure above it.
    pub pressure: f64,
    /// Pressure cycles closed in this crossing so far.
    pub cycles: f64,
}

/// The points of one body.
#[derive(Debug, Clone)]
pub struct Track {
    spec: TrackSpec,
    points: Vec<Point>,
    crossings: u64,
    /// Samples of the shown point's crossing, oldest first from `oldest` on.
    trace: Vec<Sample>,
    oldest: usize,
}

impl Default for Track {
    fn default() -> Self {
        Self::new()
    }
}

impl Track {
    /// Points by the default [`TrackSpec`].
    pub fn new() -> Self {
        Self::with(TrackSpec::default())
    }

    /// Points spread over the zone; at least one.
    pub fn with(spec: TrackSpec) -> Self {
        let point = |i: usize| Point {
            x: HALF * (2.0 * (GOLDEN * (i as f64 + 0.5)).fract() - 1.0),
            crossing: Crossing::Part,
            pressure: History::new(GATE),
            shear: vec![History::new(SHEAR_GATE); spec.depths],
        };
        Self {
            points: (0..spec.points.max(1)).map(point).collect(),
            crossings: 0,
            trace: Vec::with_capacity(spec.trace),
            oldest: 0,
            spec,
        }
    }

    /// Forgets the counts (after a change of speeds, load or roughness); the points stay where they are.
    pub fn restart(&mut self) {
        for point in &mut self.points {
            point.crossing = Crossing::Part;
            for history in point.histories() {
                history.start();
                history.last = None;
            }
        }
        self.crossings = 0;
        self.clear_trace();
    }

    /// Moves the points by `travel = U_i Δt` (either sign) and samples the pressure.
    pub fn push(&mut self, row: &Row, travel: f64) {
        self.push_with_shear(row, &[], travel);
    }

    /// Same, with the signed shear below the row, `[k·nx + i]`, k over the followed depths.
    pub fn push_with_shear(&mut self, row: &Row, tau_xz: &[f32], travel: f64) {
        let exponent = self.spec.damage_exponent;
        let mut shown_left = false;
        for (i, point) in self.points.iter_mut().enumerate() {
            if point.advance(travel, exponent) {
                self.crossings += u64::from(point.crossing == Crossing::Whole);
                point.crossing = Crossing::Whole;
                shown_left |= i == 0;
            }
            point.pressure.push(row.at(point.x), exponent);
            for (k, history) in point.shear.iter_mut().enumerate() {
                history.push(row.at_depth(tau_xz, k, point.x), exponent);
            }
        }
        if shown_left {
            self.clear_trace();
        }
        self.keep_sample(row);
    }

    fn clear_trace(&mut self) {
        self.trace.clear();
        self.oldest = 0;
    }

    fn keep_sample(&mut self, row: &Row) {
        let (x, cycles) = self.shown();
        let sample = Sample {
            x,
            pressure: row.at(x),
            cycles,
        };
        if self.trace.len() < self.spec.trace {
            self.trace.push(sample);
        } else if self.spec.trace > 0 {
            self.trace[self.oldest] = sample;
            self.oldest = (self.oldest + 1) % self.trace.len();
        }
    }

    /// Place and cycles so far of the first point.
    pub fn shown(&self) -> (f64, f64) {
        (self.points[0].x, self.points[0].pressure.tally.count)
    }

    /// Samples of the first point's present crossing, oldest first.
    pub fn trace(&self) -> impl Iterator<Item = &Sample> {
        let (late, early) = self.trace.split_at(self.oldest);
        early.iter().chain(late)
    }

    /// Whole crossings since the start.
    pub fn crossings(&self) -> u64 {
        self.crossings
    }

    /// Mean cycles of the pressure in a crossing; `None` before all points have crossed once.
    pub fn mean_cycles(&self) -> Option<f64> {
        self.pressure_cycles().map(|tally| tally.count)
    }

    /// Mean tally of the pressure over the points' last crossings; `None` before all have crossed once.
    pub fn pressure_cycles(&self) -> Option<Tally> {
        self.mean(|point| point.pressure.last)
    }

    /// Same of the signed shear at depth `k`.
    pub fn shear_cycles(&self, k: usize) -> Option<Tally> {
        self.mean(|point| point.shear.get(k)?.last)
    }

    /// Mean cycles of pressure in the present crossings so far: for a body that stands, whose crossing
    /// never ends, this over the time is its rate.
    pub fn open_cycles(&self) -> f64 {
        let sum: f64 = self.points.iter().map(|p| p.pressure.tally.count).sum();
        sum / self.points.len() as f64
    }

    fn mean(&self, last: impl Fn(&Point) -> Option<Tally>) -> Option<Tally> {
        let count = self.points.len() as f64;
        self.points.iter().try_fold(Tally::default(), |sum, point| {
            let tally = last(point)?;
            Some(Tally {
                count: sum.count + tally.count / count,
                equivalent: sum.equivalent + tally.equivalent / count,
                range: sum.range.max(tally.range),
                damage: sum.damage + tally.damage / count,
            })
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A smooth bump over [−1, 1] on 201 nodes of [−2, 2].
    fn bump() -> Vec<f64> {
        (0..201)
            .map(|i| -2.0 + 0.02 * f64::from(i))
            .map(|x: f64| (1.0 - x * x).max(0.0).sqrt())
            .collect()
    }

    fn row(values: &[f64]) -> Row<'_> {
        Row {
            values,
            x_min: -2.0,
            dx: 0.02,
        }
    }

    #[test]
    fn smooth_passage_is_one_cycle_in_both_directions() {
        let values = bump();
        for travel in [0.03, -0.03] {
            let mut track = Track::new();
            for _ in 0..140 {
                track.push(&row(&values), travel);
            }
            let tally = track.pressure_cycles().expect("all crossed");
            assert_eq!(tally.count, 1.0);
            assert!((tally.equivalent - 1.0).abs() < 1e-12 && (tally.range - 1.0).abs() < 1e-3);
        }
    }

    #[test]
    fn the_crossing_at_the_start_does_not_count() {
        let values = bump();
        let mut track = Track::new();
        for _ in 0..101 {
            track.push(&row(&values), 0.02);
        }
        assert_eq!(track.crossings(), 0, "every point has left once");
        assert!(track.mean_cycles().is_none());
        for _ in 0..101 {
            track.push(&row(&values), 0.02);
        }
        assert_eq!((track.crossings(), track.mean_cycles()), (16, Some(1.0)));
        track.restart();
        assert_eq!((track.crossings(), track.mean_cycles()), (0, None));
    }

    #[test]
    fn a_standing_body_counts_by_time() {
        let mut track = Track::new();
        for step in 0..1600 {
            let wave = (std::f64::consts::TAU * f64::from(step) / 16.0).cos();
            track.push(&row(&[1.0 + wave; 201]), 0.0);
        }
        println!("100 crests over a standing body: {}", track.open_cycles());
        assert!(track.mean_cycles().is_none());
        assert!((track.open_cycles() - 100.0).abs() <= 1.5);
    }

    #[test]
    fn pure_rolling_is_one_cycle() {
        // Full ripples that move with the point: one cycle, unless the point sits in a valley that
        // never passes the gate (a tenth of the phases at 5 %).
        let mut track = Track::with(TrackSpec {
            points: 64,
            ..TrackSpec::default()
        });
        let mut values = bump();
        for step in 0..300 {
            for (i, (value, smooth)) in values.iter_mut().zip(bump()).enumerate() {
                let x = -2.0 + 0.02 * i as f64 - 0.02 * f64::from(step);
                *value = smooth * (1.0 + (std::f64::consts::TAU * x / 0.25).cos());
            }
            track.push(&row(&values), 0.02);
        }
        let count = track.mean_cycles().expect("all crossed");
        println!("pure rolling: {count:.3} cycles");
        assert!(count <= 1.0 && count > 0.8);
    }

    #[test]
    fn the_trace_is_bounded_and_in_order() {
        let values = bump();
        let mut track = Track::with(TrackSpec {
            trace: 10,
            ..TrackSpec::default()
        });
        for _ in 0..60 {
            track.push(&row(&values), 0.02);
        }
        let xs: Vec<f64> = track.trace().map(|s| s.x).collect();
        assert_eq!(xs.len(), 10);
        assert!(xs.windows(2).all(|pair| pair[1] > pair[0]));
        assert_eq!(xs[9], track.shown().0);
    }
}
