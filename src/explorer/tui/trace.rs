//! The history of a material point while it crosses the contact: kept from the frames that the screen
//! took, or, once a passage repeats, read out of one period for any point of either body.
//!
//! ```text
//! x(t) = x_in + (place + U_b t) mod L       p(t) = P(x(t), y = 0; t mod T)       the same of the stress at z
//! ```

use asperity_engine::physics::rainflow::{HistoryEnds, Rainflow};
use asperity_engine::physics::turning::Peaks;
use asperity_engine::sim::{Frame, MaterialPoint, StressSlice};
use asperity_session::run::Settled;

/// Maximum number of samples of one crossing.
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
    /// Peaks of the pressure passed so far.
    pub cycles: f64,
}

/// A peak of the pressure that has passed, and which of the crossing it is, from 1.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Tick {
    /// Where it was, m.
    pub x_m: f64,
    /// Its number.
    pub number: u32,
}

impl TraceSample {
    /// What a frame's point feels.
    pub fn of(point: &MaterialPoint) -> Self {
        Self {
            x_m: point.x_m,
            pressure_pa: point.pressure_pa,
            effective_pa: point.effective_pa,
            tau_xz_pa: point.tau_xz_pa,
            cycles: point.cycles_counted,
        }
    }
}

/// This crossing and the one before it.
#[derive(Debug, Clone, Default)]
pub struct Trace {
    body: u8,
    depth_m: f64,
    current: Vec<TraceSample>,
    before: Vec<TraceSample>,
    /// Peaks of this crossing that have passed.
    ticks: Vec<Tick>,
    counted: Option<f64>,
}

/// A point of a body that is replayed.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Chosen {
    /// Body: 1 or 2.
    pub body: u8,
    /// Index of the depth.
    pub depth: usize,
    /// Where on the body: way from the inlet edge at the beginning of the replay, m.
    pub place_m: f64,
}

impl Default for Chosen {
    fn default() -> Self {
        Self {
            body: 1,
            depth: 0,
            place_m: 0.0,
        }
    }
}

/// The pressure of one crossing: its peaks, and its cycles, as the simulation counts them.
struct Counter {
    peaks: Peaks,
    flow: Rainflow,
    closed: f64,
}

impl Counter {
    fn new(gate_pa: f64) -> Self {
        let mut flow = Rainflow::new(HistoryEnds::Repeating, gate_pa, 512);
        flow.push(0.0, &mut |_| {});
        Self {
            peaks: Peaks::new(gate_pa),
            flow,
            closed: 0.0,
        }
    }

    /// The peak that the sample shows to have passed.
    fn push(&mut self, sample: &TraceSample) -> Option<Tick> {
        let closed = &mut self.closed;
        let pressure_pa = sample.pressure_pa;
        self.flow
            .push(pressure_pa, &mut |cycle| *closed += cycle.count);
        let peak = self.peaks.push(sample.x_m, pressure_pa)?;
        Some(Tick {
            x_m: peak.x,
            number: self.peaks.passed(),
        })
    }

    /// Closed cycles of the whole crossing.
    fn finish(mut self) -> f64 {
        let closed = &mut self.closed;
        self.flow.push(0.0, &mut |cycle| *closed += cycle.count);
        self.flow.finish(&mut |cycle| *closed += cycle.count);
        self.closed
    }
}

fn slice_of(frame: &Frame, body: u8) -> Option<&StressSlice> {
    if body == 2 {
        frame.slice_2.as_ref()
    } else {
        frame.slice.as_ref()
    }
}

fn depth_of(frame: &Frame, point: Chosen) -> f64 {
    slice_of(frame, point.body)
        .and_then(|slice| slice.depths_m.get(point.depth).copied())
        .unwrap_or(0.0)
}

/// Values of a frame at x, between the nodes of y = 0.
fn sample(frame: &Frame, point: Chosen, x_m: f64) -> TraceSample {
    let last = frame.nx.saturating_sub(2);
    let along = ((x_m - frame.x_min_m) / frame.dx_m).clamp(0.0, last as f64);
    let (i, part) = (along as usize, along.fract());
    let between = |field: &[f32], start: usize| {
        let at = |n: usize| f64::from(field.get(start + n).copied().unwrap_or(0.0));
        at(i) * (1.0 - part) + at(i + 1) * part
    };
    let slice = slice_of(frame, point.body);
    let row = point.depth * frame.nx;
    let below = |field: fn(&StressSlice) -> &[f32]| slice.map_or(0.0, |s| between(field(s), row));
    TraceSample {
        x_m,
        pressure_pa: between(frame.centre_line(&frame.pressure_pa), 0),
        effective_pa: below(|slice| &slice.effective_pa),
        tau_xz_pa: below(|slice| &slice.tau_xz_pa),
        cycles: 0.0,
    }
}

impl Trace {
    /// The crossing that a point is on at `at_s`: all of it as the one before, the part done as the present
    /// one. `None` where its body stands or nothing repeats.
    pub fn replayed(settled: &Settled, point: Chosen, at_s: f64) -> Option<Self> {
        let first = settled.frames.first()?;
        let own = if point.body == 2 { 0.5 } else { -0.5 };
        let speed = first.metrics.entrainment_m_s * (1.0 + own * first.metrics.slide_roll);
        let length = first.dx_m * first.nx.saturating_sub(1) as f64;
        if speed.abs() < 1e-9 || length <= 0.0 || settled.period_s <= 0.0 {
            return None;
        }
        let way = (point.place_m + speed.abs() * at_s).rem_euclid(length);
        let entered_s = at_s - way / speed.abs();
        let x_in = if speed > 0.0 {
            first.x_min_m
        } else {
            first.x_min_m + length
        };
        // At the frames' own times: a period is no whole number of steps, and a crossing that is a part of a step
        // out of phase has teeth that nobody computed.
        let frames = settled.frames.len() as i64;
        let of_period = |n: i64| &settled.frames[n.rem_euclid(frames) as usize];
        let time_of = |n: i64| {
            let since = of_period(n).time_s - first.time_s;
            settled.period_s * n.div_euclid(frames) as f64 + since
        };
        let mut counter = Counter::new(0.05 * first.p_hertz_pa);
        let mut trace = Self {
            body: point.body,
            depth_m: depth_of(first, point),
            ..Self::default()
        };
        let mut n = (entered_s / settled.period_s).floor() as i64 * frames;
        while time_of(n) < entered_s {
            n += 1;
        }
        loop {
            let t = time_of(n);
            let x_m = x_in + speed * (t - entered_s);
            if (x_m - x_in).abs() > length || trace.before.len() == CAPACITY {
                break;
            }
            let mut sample = sample(of_period(n), point, x_m);
            let tick = counter.push(&sample);
            sample.cycles = f64::from(counter.peaks.passed());
            trace.before.push(sample);
            if t <= at_s {
                trace.current.push(sample);
                trace.ticks.extend(tick);
            }
            n += 1;
        }
        trace.counted = Some(counter.finish());
        Some(trace)
    }

    /// Cycles of the whole crossing, where all of it is known.
    pub fn counted(&self) -> Option<f64> {
        self.counted
    }

    /// Body and depth of the point, m.
    pub fn point(&self) -> (u8, f64) {
        (self.body, self.depth_m)
    }

    /// Adds the point of a newer frame; a point that jumped back began another crossing.
    pub fn push(&mut self, point: &MaterialPoint, half_width_m: f64) {
        let sample = TraceSample::of(point);
        let other_point = point.body != self.body || point.depth_m != self.depth_m;
        if other_point {
            self.current.clear();
            self.before.clear();
            self.ticks.clear();
            self.body = point.body;
            self.depth_m = point.depth_m;
        }
        if self.current.last() == Some(&sample) {
            return;
        }
        if let Some(last) = self.current.last() {
            let jumped = (sample.x_m - last.x_m).abs() > half_width_m;
            if jumped || sample.cycles < last.cycles {
                std::mem::swap(&mut self.before, &mut self.current);
                self.current.clear();
                self.ticks.clear();
            }
        }
        let ticked = self.ticks.last().map_or(0, |tick| tick.number);
        let number = point.cycles_counted as u32;
        if let Some(peak) = point.last_peak.filter(|_| number > ticked) {
            self.ticks.push(Tick {
                x_m: peak.x_m,
                number,
            });
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

    /// Peaks of this crossing that have passed.
    pub fn ticks(&self) -> &[Tick] {
        &self.ticks
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use asperity_engine::sim::PassedPeak;

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
    fn a_tick_stands_at_its_peak_until_the_point_has_left() {
        let mut trace = Trace::default();
        let passed = |x_m: f64, peak_m: f64, number: f64| MaterialPoint {
            last_peak: (number > 0.0).then_some(PassedPeak {
                x_m: peak_m,
                pressure_pa: 1e9,
            }),
            ..at(x_m, number)
        };
        for (x, peak, number) in [
            (0.0, 0.0, 0.0),
            (2e-5, 1e-5, 1.0),
            (3e-5, 1e-5, 1.0),
            // Steps that the screen missed: the second peak is not known, the third is.
            (6e-5, 5e-5, 3.0),
        ] {
            trace.push(&passed(x, peak, number), 1e-4);
        }
        let ticks: Vec<_> = trace.ticks().iter().map(|t| (t.x_m, t.number)).collect();
        assert_eq!(ticks, [(1e-5, 1), (5e-5, 3)]);
        trace.push(&at(-2e-4, 0.0), 1e-4);
        assert_eq!(trace.ticks(), []);
    }

    /// One period, in so many steps, of a ripple that stands on body 2 under a dome.
    fn ripple(slide_roll: f64, steps: u32) -> Settled {
        let speed = 1.0 + 0.5 * slide_roll;
        let period_s = 1.0 / speed;
        let step_s = period_s / (f64::from(steps) - 0.2);
        let frame = |k: u32| {
            let t = step_s * f64::from(k);
            let pressure = |i: usize| {
                let x = -2.0 + 4.0 * i as f64 / 256.0;
                let dome = (1.0 - x * x).max(0.0).sqrt();
                let crest = 1.0 + (std::f64::consts::TAU * (x - speed * t)).cos();
                (1e9 * dome * crest) as f32
            };
            std::sync::Arc::new(Frame {
                nx: 257,
                ny: 1,
                x_min_m: -2.0,
                dx_m: 4.0 / 256.0,
                a_m: 1.0,
                p_hertz_pa: 1e9,
                time_s: 3.0 + t,
                pressure_pa: (0..257).map(pressure).collect(),
                metrics: asperity_engine::sim::Metrics {
                    slide_roll,
                    entrainment_m_s: 1.0,
                    ..asperity_engine::sim::Metrics::default()
                },
                ..Frame::default()
            })
        };
        Settled {
            frames: (0..steps).map(frame).collect(),
            period_s,
            state: None,
            is_last: true,
            ground: None,
        }
    }

    /// A period is no whole number of steps: a point that rolls with its crest still feels one hump.
    #[test]
    fn few_frames_a_period_add_no_teeth() {
        let settled = ripple(0.0, 7);
        for place_m in [0.0, 0.1, 0.2, 0.7] {
            for at_s in [0.0, 0.4, 3.3] {
                let point = Chosen {
                    place_m,
                    ..Chosen::default()
                };
                let trace = Trace::replayed(&settled, point, at_s).expect("a crossing");
                assert!(trace.counted().is_some_and(|count| count <= 1.0));
            }
        }
    }

    /// S = 0.5: body 1 is overtaken by its crests.
    #[test]
    fn a_replayed_crossing_counts_the_crests_of_the_mate() {
        let settled = ripple(0.5, 200);
        // f δ = 2 · 0.5/0.75 crests of body 2 in the zone for body 1; none of its own for body 2.
        let f_delta = 4.0 / 3.0;
        for place_m in [0.0, 0.3, 0.9] {
            let point = Chosen {
                place_m,
                ..Chosen::default()
            };
            let trace = Trace::replayed(&settled, point, 2.0).expect("a crossing");
            let count = trace.counted().expect("whole");
            assert!((count - f_delta).abs() <= 1.0, "{count}");
            assert!(trace.current().len() <= trace.before().len());
            assert!(trace.ticks().len() as f64 <= count);
            let mate = Chosen { body: 2, ..point };
            let mate = Trace::replayed(&settled, mate, 2.0).expect("a crossing");
            // Its own crest stays the same crest, or its own trough is never loaded.
            assert!(mate.counted().is_some_and(|count| count <= 1.0));
        }
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
