//! Material points of one body on the line y = 0, carried through the contact, and the cycles they see.
//!
//! ```text
//! x_p ← x_p + U_i Δt      (no grid node: values are interpolated along x)
//! history of a crossing: 0, p(x_p, t), ..., 0      and the same of signed τ_xz at each depth
//! rainflow (ASTM E1049) with a gate → cycles per crossing; mean over points that are staggered in phase
//! ```
//! A point crosses at every turn of its body, so the history counts as one that repeats
//! ([`Ends::Repeating`]): every cycle closes.
//!
//! *What the count is compared with.* The pressure of ripples that unload fully returns to zero between
//! crests, so its cycles are the crests that a point meets: `f δ` within the zone, and the crest that the
//! zone's edge cuts whenever what is left of it passes the gate: 0.6 times in a crossing of a Hertz
//! contact at a gate of 5 %. The mean count therefore lies between `f δ` and the formula's `n = 1 + f δ`, both over the
//! zone in which the maximum pressure passes the gate: crests that stand apart make a contact longer than Hertz's. In
//! every preset it lies between n − 1.1 over Hertz's width and that n + 0.5: the oil adds small cycles of its own (in pure
//! rolling 1.4 where 1.0 is counted dry). Crests steeper than steel carries press each a contact of a few nodes: there
//! reading between the nodes wiggles by more than the gate (finer meshes end it) and the oil's own cycles, a few per
//! cent of the peaks, are many (89 counted where n = 59; dry 70). In damage they are nothing: as many cycles of the
//! maximum range are fewer than n by Miner's rule in all of them (`tests/life/counts.rs`).
//! The signed shear of a shallow point counts the same crests (8.3 to 9.4 where n = 9); from one wavelength
//! down one cycle is left. Accepted is `|mean − f δ| ≤ 1` for the pressure, and from `f δ = 10` on 5 % of
//! `f δ` or of n (`tests/life/integrals.rs`), with at least 8 points and 16 samples a crest,
//! `Δt ≤ W/(16 |U_2 − U_1|)`.
//!
//! *Two histories a depth.* The signed shear tells cycles by their ranges; the effective stress, which does
//! not return to zero between crests, tells them by their peaks:
//! ```text
//! ranges   n_r(z) = Σ count (range/maximum range)^c         of τ_xz
//! peaks    n_p(z) = Σ count (peak/maximum peak)^c           of the effective stress
//! ```
//! Each is the number of largest cycles that do the same damage by Miner's rule. The same sums, not
//! divided, make the map of damage ([`super::damage`]) in coordinates that move with the body.
//!
//! Lengths in a, stress in p_h. Memory is made once; steps allocate nothing.
//!
//! Sources: ASTM E1049-85 (1985), §5.4.4, for rainflow; Miner (1945) for the sums; Pu, Zhu, Wang and Wang (2016) for n. Ours: the
//! equivalent counts, from Miner's rule with the maximum range as the unit.

mod counts;
mod spec;

use serde::{Deserialize, Serialize};

pub use self::spec::TrackerSpec;
pub use super::axis::Line;
pub use super::cycle_count::CycleCount;
use super::cycle_count::DamageBasis;
use super::cycle_count::{Crossing, CrossingHistories};
use super::damage::DamageMap;
use crate::physics::turning::{PassedMaximum, Peaks};
use crate::saved::saved;

/// Fraction of the golden section: multiples of it, modulo 1, spread evenly and never fall into step with
/// the ripples, as equal spacing may.
const GOLDEN: f64 = 0.618_033_988_749_894_9;

#[derive(Debug, Clone, Serialize, Deserialize)]
struct TrackedPoint {
    x: f64,
    crossing: Crossing,
    /// Place on the body, a: does not change during a crossing.
    place: f64,
    /// Of one depth.
    pressure: CrossingHistories,
    /// Of the pressure, as they pass.
    peaks: Peaks,
    shear: CrossingHistories,
    effective: CrossingHistories,
}

saved! {
    TrackedPoint {
        parts: pressure, peaks, shear, effective;
        free: x, crossing, place;
    }
}

impl TrackedPoint {
    fn histories(&mut self) -> [&mut CrossingHistories; 3] {
        [&mut self.pressure, &mut self.shear, &mut self.effective]
    }

    /// The pressure's cycles in the last whole crossing.
    fn crossed(&self) -> Option<CycleCount> {
        self.pressure.last[0]
    }
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
    /// Peaks of the pressure passed so far in this crossing: each closes one cycle.
    pub peaks: u32,
    /// The last of them.
    pub last_peak: Option<PassedMaximum>,
    /// Closed cycles of the pressure in its last whole crossing.
    pub closed_before: Option<f64>,
}

/// Points of one body.
#[derive(Debug, Clone, Serialize, Deserialize)]
pub struct MaterialTracker {
    spec: TrackerSpec,
    points: Vec<TrackedPoint>,
    crossings: u64,
    /// Damage of all ended crossings' shear by depth, each without its largest cycle.
    ended: Vec<f64>,
    /// Damage of the largest cycles of all whole crossings' shear by depth.
    greatest: Vec<f64>,
    /// Samples of the shown point's crossing, oldest first from `oldest` on.
    trace: Vec<Sample>,
    oldest: usize,
    /// Which point is shown.
    #[serde(default)]
    shown: usize,
    /// Distance that the body has travelled, a.
    #[serde(rename = "way")]
    distance: f64,
    map: Option<DamageMap>,
}

saved! {
    MaterialTracker {
        parts: points, ended, greatest, map;
        room: trace;
        free: spec, crossings, oldest, shown, distance;
    }
    holds |own, saved| {
        let spec = TrackerSpec { shown_depth: saved.spec.shown_depth, ..own.spec };
        spec == saved.spec
            && spec.shown_depth < spec.depths.max(1)
            && saved.trace.len() <= spec.trace.max(1)
            && saved.oldest < saved.trace.len().max(1)
            && saved.shown < saved.points.len()
    }
}

impl MaterialTracker {
    /// Points spread over the track; at least one.
    pub fn new(spec: TrackerSpec) -> Self {
        let length = spec.x_last - spec.x_first;
        let count = spec.points.max(1);
        let below = |gate: f64, basis: DamageBasis| {
            CrossingHistories::new(spec.depths, gate, basis, CrossingHistories::OPEN_BELOW)
        };
        let point = |i: usize| TrackedPoint {
            x: spec.x_first + length * (GOLDEN * i as f64).fract(),
            crossing: Crossing::New,
            place: 0.0,
            pressure: CrossingHistories::new(
                1,
                spec.pressure_gate,
                DamageBasis::Ranges,
                CrossingHistories::OPEN,
            ),
            peaks: Peaks::new(spec.pressure_gate),
            shear: below(spec.shear_gate, DamageBasis::Ranges),
            effective: below(spec.effective_gate, DamageBasis::Peaks),
        };
        let mut tracker = Self {
            spec,
            points: (0..count).map(point).collect(),
            crossings: 0,
            ended: vec![0.0; spec.depths],
            greatest: vec![0.0; spec.depths],
            trace: Vec::with_capacity(spec.trace.max(1)),
            oldest: 0,
            shown: 0,
            distance: 0.0,
            map: spec.map.map(DamageMap::new),
        };
        tracker.restart(0.0);
        tracker
    }

    /// Forgets all counts (after a change of speeds, load or roughness); points stay where they are, and the
    /// body has moved by `distance` (in a) since its origin.
    pub fn restart(&mut self, distance: f64) {
        let exponent = self.spec.damage_exponent;
        self.distance = distance;
        for point in &mut self.points {
            point.crossing = Crossing::New;
            point.place = point.x - distance;
            for histories in point.histories() {
                histories.start(exponent);
                histories.last.fill(None);
            }
            point.peaks.start();
        }
        if let Some(map) = &mut self.map {
            map.clear();
        }
        self.crossings = 0;
        self.ended.fill(0.0);
        self.greatest.fill(0.0);
        self.trace.clear();
        self.oldest = 0;
    }

    /// Moves every point by `travel = U_i Δt` (in a, signed) and samples the line there; a crossing ends `behind` the
    /// contact's middle (in a), or where the track ends.
    pub fn step(&mut self, travel: f64, behind: f64, line: &Line) {
        self.distance += travel;
        for i in 0..self.points.len() {
            if self.advance(i, travel, behind) && i == self.shown {
                self.trace.clear();
                self.oldest = 0;
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
    fn advance(&mut self, i: usize, travel: f64, behind: f64) -> bool {
        let (first, last) = (self.spec.x_first, self.spec.x_last);
        let point = &mut self.points[i];
        point.x += travel;
        let left = if travel > 0.0 {
            point.x >= last
        } else {
            travel < 0.0 && point.x <= first
        };
        let is_behind = travel != 0.0 && point.x * travel.signum() >= behind;
        match point.crossing {
            Crossing::Whole if is_behind || left => self.finish(i),
            Crossing::Part if left => self.end(i),
            Crossing::New | Crossing::Whole | Crossing::Part | Crossing::Done => {}
        }
        if left {
            self.enter(i);
        }
        left
    }

    /// A point's crossing has ended, and its cycles count.
    fn end(&mut self, i: usize) {
        let exponent = self.spec.damage_exponent;
        let point = &mut self.points[i];
        let crossing = point.crossing;
        for histories in point.histories() {
            histories.end(exponent, crossing);
        }
        for (ended, cycles) in self.ended.iter_mut().zip(&point.shear.cycles) {
            *ended += cycles.small_damage(exponent);
        }
        for histories in point.histories() {
            histories.start(exponent);
        }
    }

    /// The same of one that has been followed from before the contact.
    fn finish(&mut self, i: usize) {
        self.end(i);
        let exponent = self.spec.damage_exponent;
        let point = &mut self.points[i];
        point.crossing = Crossing::Done;
        self.crossings += 1;
        for (greatest, last) in self.greatest.iter_mut().zip(&point.shear.last) {
            *greatest += last.map_or(0.0, |cycles| cycles.range.powf(exponent));
        }
        if let Some(map) = &mut self.map {
            let last = point.effective.last.iter();
            let damage = last.filter_map(|last| Some((*last)?.damage));
            map.add(point.place, damage);
        }
    }

    /// A point that has left the track enters it at the other end.
    fn enter(&mut self, i: usize) {
        let (first, last) = (self.spec.x_first, self.spec.x_last);
        let point = &mut self.points[i];
        point.x = first + (point.x - first).rem_euclid(last - first);
        point.place = point.x - self.distance;
        point.peaks.start();
        point.crossing = Crossing::Whole;
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
        if point.crossing == Crossing::Done {
            return;
        }
        (point.pressure).push(std::iter::once(pressure), exponent);
        point.peaks.push(point.x, pressure);
        if let Some(field) = line.tau_xz {
            point.shear.push(line.below(field, point.x), exponent);
        }
        if let Some(field) = line.effective {
            point.effective.push(line.below(field, point.x), exponent);
        }
    }

    /// Shows the point nearest to `x` (in a; `None`: the same as before) at depth `k`. What is counted stays
    /// as it is.
    pub fn look_at(&mut self, x: Option<f64>, k: usize) {
        if let Some(x) = x {
            let away = |i: usize| (self.points[i].x - x).abs();
            let all = 0..self.points.len();
            self.shown = all
                .min_by(|&one, &two| away(one).total_cmp(&away(two)))
                .unwrap_or(0);
        }
        self.spec.shown_depth = k.min(self.spec.depths.saturating_sub(1));
        self.trace.clear();
        self.oldest = 0;
    }

    /// The point on the screen, as the line now is.
    pub fn shown(&self, line: &Line) -> Sample {
        let point = &self.points[self.shown];
        Sample {
            x: point.x,
            pressure: line.pressure_at(point.x),
            tau_xz: line.shear_at(self.spec.shown_depth, point.x),
            peaks: point.peaks.passed(),
            last_peak: point.peaks.last(),
            closed_before: point.crossed().map(|cycles| cycles.count),
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

    /// Distance of the body, a, of which points have finished their crossing.
    pub fn finished(&self) -> f64 {
        let track = self.spec.x_last - self.spec.x_first;
        self.crossings as f64 * track / self.points.len().max(1) as f64
    }

    /// Damage of the block so far.
    pub fn map(&self) -> Option<&DamageMap> {
        self.map.as_ref()
    }

    /// Points whose last whole crossing is in the mean.
    pub fn phases(&self) -> usize {
        self.points
            .iter()
            .filter(|point| point.crossed().is_some())
            .count()
    }
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

    fn line(pressure: &[f32]) -> Line<'_> {
        Line {
            x_first: -2.0,
            dx: 0.02,
            pressure,
            tau_xz: None,
            effective: None,
        }
    }

    #[test]
    fn smooth_passage_is_one_cycle_in_both_directions() {
        let pressure = bump();
        let line = line(&pressure);
        for travel in [0.03, -0.03] {
            let mut tracker = MaterialTracker::new(TrackerSpec::new((-2.0, 2.0), 0, 10.0));
            for _ in 0..400 {
                tracker.step(travel, 1.2, &line);
            }
            let cycles = tracker.pressure_cycles().expect("crossings finished");
            assert_eq!((cycles.count, tracker.phases()), (1.0, 16));
            assert!((cycles.equivalent - 1.0).abs() < 1e-12);
        }
    }

    #[test]
    fn a_crossing_seen_from_its_middle_does_not_count() {
        let pressure = bump();
        let line = line(&pressure);
        let mut spec = TrackerSpec::new((-2.0, 2.0), 0, 10.0);
        spec.points = 4; // at −2, 0.47, −1.06 and 1.42
        for (behind, finished) in [(f64::INFINITY, 2), (1.2, 3)] {
            let mut tracker = MaterialTracker::new(spec);
            for _ in 0..104 {
                tracker.step(0.02, behind, &line);
            }
            // The points from inside and from behind the contact have left.
            assert_eq!(tracker.crossings(), 0);
            assert!(tracker.pressure_cycles().is_none());
            for _ in 0..104 {
                tracker.step(0.02, behind, &line);
            }
            // The last of the three has only just left the contact.
            assert_eq!(tracker.crossings(), finished);
            assert_eq!(tracker.finished(), finished as f64);
            assert_eq!(tracker.pressure_cycles().expect("crossed").count, 1.0);
        }
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
                effective: None,
            };
            tracker.step(0.0, 1.2, &line);
        }
        // Mean cycles of pressure so far in the present crossing, which never ends.
        let counts = (tracker.points.iter()).map(|point| point.pressure.cycles[0].count);
        let open = counts.sum::<f64>() / tracker.points.len() as f64;
        println!("100 crests over a standing body: {open}");
        assert!(tracker.pressure_cycles().is_none());
        assert!((open - 100.0).abs() <= 1.5);
    }

    #[test]
    fn the_trace_is_bounded_and_in_order() {
        let pressure = bump();
        let line = line(&pressure);
        let mut spec = TrackerSpec::new((-2.0, 2.0), 0, 10.0);
        spec.trace = 10;
        let mut tracker = MaterialTracker::new(spec);
        for _ in 0..57 {
            tracker.step(0.02, 1.2, &line);
        }
        let xs: Vec<f64> = tracker.trace().map(|s| s.x).collect();
        assert_eq!(xs.len(), 10);
        assert!(xs.windows(2).all(|pair| pair[1] > pair[0]));
        assert!((xs[9] - (-2.0 + 57.0 * 0.02)).abs() < 1e-9);
    }
}
