//! Runs by their keys, and the pressure of one less that of another.

use crate::frames::RecordedFrames;
use asperity_engine::sim::Frame;

/// What is equal where runs are shown together.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum ComparedBy {
    /// Simulated time since the start of the passage.
    Time,
    /// The distance that body 1, and a crest on it, has gone.
    Place,
}

/// One of the runs.
pub struct RunBeside {
    /// What tells it from the others.
    pub name: String,
    /// Its frames.
    pub frames: RecordedFrames,
}

/// A run with the keys of its steps.
pub(crate) struct KeyedRun<'a> {
    pub(crate) run: &'a RunBeside,
    pub(crate) steps: Vec<Frame>,
    pub(crate) keys: Vec<f64>,
    /// Places in `steps` that have pictures.
    pub(crate) shown: Vec<usize>,
}

impl<'a> KeyedRun<'a> {
    pub(crate) fn new(run: &'a RunBeside, by: ComparedBy) -> Result<Self, String> {
        let steps: Vec<Frame> = run.frames.steps().collect();
        let keys = keys(&steps, by);
        if keys.windows(2).any(|pair| pair[0] >= pair[1]) {
            return Err(format!(
                "{}: body 1 stands or turns back, so its crests have no place to compare by; compare by time",
                run.name
            ));
        }
        let numbers: Vec<u64> = steps.iter().map(|frame| frame.step).collect();
        let shown = run.frames.shown().into_iter();
        let shown = shown.filter_map(|step| numbers.binary_search(&step).ok());
        Ok(Self {
            run,
            shown: shown.collect(),
            steps,
            keys,
        })
    }

    pub(crate) fn last_key(&self) -> f64 {
        self.shown.last().map_or(0.0, |&at| self.keys[at])
    }

    /// The picture nearest to a key: its place among the steps.
    pub(crate) fn nearest(&self, key: f64) -> usize {
        let after = self.shown.partition_point(|&at| self.keys[at] < key);
        let near = [after.checked_sub(1), Some(after)];
        let near = near.into_iter().flatten().filter_map(|k| self.shown.get(k));
        let off = |at: usize| (self.keys[at] - key).abs();
        near.copied()
            .min_by(|one, two| off(*one).total_cmp(&off(*two)))
            .unwrap_or(0)
    }

    /// How far a step is from a key, in steps.
    pub(crate) fn apart(&self, at: usize, key: f64) -> f64 {
        let span = self.keys.last().unwrap_or(&0.0) - self.keys[0];
        let first = self.steps.first().map_or(0, |frame| frame.step);
        let steps = self.steps.last().map_or(0, |frame| frame.step) - first;
        (self.keys[at] - key).abs() * steps as f64 / span.max(f64::MIN_POSITIVE)
    }

    /// The moment of this run at a key, between two steps in proportion.
    pub(crate) fn moment(&self, key: f64) -> (f64, f64, f64) {
        let after = self.keys.partition_point(|&own| own <= key);
        let at = after.clamp(1, self.keys.len().saturating_sub(1).max(1)) - 1;
        let one = &self.steps[at];
        let two = self.steps.get(at + 1).unwrap_or(one);
        let span = self
            .keys
            .get(at + 1)
            .map_or(1.0, |next| next - self.keys[at]);
        let share = ((key - self.keys[at]) / span).clamp(0.0, 1.0);
        let between = |from: f64, to: f64| {
            if share == 1.0 {
                to
            } else {
                from + share * (to - from)
            }
        };
        (
            between(one.step as f64, two.step as f64),
            between(one.time_s, two.time_s),
            between(one.passages, two.passages),
        )
    }
}

/// Where on the common axis the steps are.
fn keys(steps: &[Frame], by: ComparedBy) -> Vec<f64> {
    if by == ComparedBy::Time {
        return steps.iter().map(|frame| frame.time_s).collect();
    }
    let speed =
        |frame: &Frame| frame.metrics.entrainment_m_s * (1.0 - 0.5 * frame.metrics.slide_roll);
    let (mut place, mut before) = (0.0, None);
    let mut key = |frame: &Frame| {
        let (time_s, now) = (frame.time_s, speed(frame));
        let (from_s, then) = before.replace((time_s, now)).unwrap_or((0.0, now));
        place += 0.5 * (now + then) * (time_s - from_s);
        place
    };
    steps.iter().map(&mut key).collect()
}

/// Pressure of a frame less that of another, on the other's nodes.
pub(crate) fn less(frame: &Frame, other: &Frame) -> Vec<f32> {
    let is_alike = (frame.nx, frame.ny) == (other.nx, other.ny)
        && [frame.x_min_m, frame.dx_m, frame.y_min_m, frame.dy_m]
            == [other.x_min_m, other.dx_m, other.y_min_m, other.dy_m];
    if is_alike {
        let pairs = frame.pressure_pa.iter().zip(&other.pressure_pa);
        return pairs.map(|(one, two)| one - two).collect();
    }
    let place = |at: f64, first: f64, step: f64, nodes: usize| {
        let place = (at - first) / step;
        (0.0..=(nodes - 1) as f64).contains(&place).then(|| {
            let low = (place as usize).min(nodes.saturating_sub(2));
            (low, place - low as f64)
        })
    };
    let mut values = Vec::with_capacity(other.pressure_pa.len());
    for (k, own) in other.pressure_pa.iter().enumerate() {
        let (i, j) = (k % other.nx, k / other.nx);
        let x = place(
            other.x_min_m + other.dx_m * i as f64,
            frame.x_min_m,
            frame.dx_m,
            frame.nx,
        );
        let y = place(
            other.y_min_m + other.dy_m * j as f64,
            frame.y_min_m,
            frame.dy_m,
            frame.ny,
        );
        // Beyond its edge there is no pressure.
        let value = x.zip(y).map_or(0.0, |((i, u), (j, v))| {
            let at = |i: usize, j: usize| {
                let (i, j) = (i.min(frame.nx - 1), j.min(frame.ny - 1));
                f64::from(frame.pressure_pa[j * frame.nx + i])
            };
            let row = |j: usize| at(i, j) * (1.0 - u) + at(i + 1, j) * u;
            row(j) * (1.0 - v) + row(j + 1) * v
        });
        values.push(value as f32 - own);
    }
    values
}
