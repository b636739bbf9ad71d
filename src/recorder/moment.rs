//! Timelines, and places on them.

use std::time::SystemTime;

use rerun::log::Chunk;
use rerun::time::TimePoint;
use rerun::{TimeCell, TimeColumn};

use asperity_engine::sim::Frame;

/// Timelines of every frame.
pub(crate) const STEP: &str = "step";
/// Simulated time since the start of the passage.
pub(crate) const SIMULATED_TIME: &str = "simulated_time";
/// Lengths of 4 a travelled at U, in thousandths (a timeline holds no fractions).
pub(crate) const PASSAGE: &str = "passage_x1000";

/// Loading cycles that the surfaces of a picture are of, where they age.
pub(crate) const CYCLES: &str = "cycles";

/// Whether the clock shows a time that a recording can begin at: the library panics before 1970.
pub(crate) fn check_clock() -> Result<(), String> {
    let since_1970 = SystemTime::now().duration_since(SystemTime::UNIX_EPOCH);
    since_1970.map(drop).map_err(|_| {
        "the system's clock stands before 1970, where no recording can begin; set it".to_owned()
    })
}

/// A place on all timelines.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub(crate) struct Moment {
    step: i64,
    nanos: i64,
    passage: i64,
    cycles: Option<i64>,
}

impl Moment {
    /// After so many steps, seconds and passages.
    pub(crate) fn new(step: u64, time_s: f64, passages: f64) -> Self {
        Self {
            step: i64::try_from(step).unwrap_or(i64::MAX),
            nanos: (time_s * 1e9).round() as i64,
            passage: (passages * 1000.0).round() as i64,
            cycles: None,
        }
    }

    /// Of a frame.
    pub(crate) fn of_frame(frame: &Frame) -> Self {
        Self::new(frame.step, frame.time_s, frame.passages).after_cycles(frame.cycles)
    }

    /// The same after so many loading cycles; `None`: surfaces stay new.
    pub(crate) fn after_cycles(self, cycles: Option<f64>) -> Self {
        let cycles = cycles.map(|cycles| cycles.round() as i64);
        Self { cycles, ..self }
    }

    /// Of a row of a chunk; `None`: it has another time.
    pub(crate) fn of(chunk: &Chunk, row: usize) -> Option<Self> {
        let at = |timeline: &'static str| {
            let column = chunk.timelines().get(&timeline.into())?;
            column.times_raw().get(row).copied()
        };
        Some(Self {
            step: at(STEP)?,
            nanos: at(SIMULATED_TIME)?,
            passage: at(PASSAGE)?,
            cycles: at(CYCLES),
        })
    }

    /// As the library has it.
    pub(crate) fn timepoint(self) -> TimePoint {
        let at = TimePoint::default()
            .with_index(STEP, TimeCell::from_sequence(self.step))
            .with_index(SIMULATED_TIME, TimeCell::from_duration_nanos(self.nanos))
            .with_index(PASSAGE, TimeCell::from_sequence(self.passage));
        match self.cycles {
            Some(cycles) => at.with_index(CYCLES, TimeCell::from_sequence(cycles)),
            None => at,
        }
    }
}

/// The timelines of so many rows, but for `cycles`: what is written by columns does not hang on them.
pub(crate) fn time_columns(moments: &[Moment]) -> [TimeColumn; 3] {
    let of = |part: fn(&Moment) -> i64| moments.iter().map(part);
    [
        TimeColumn::new_sequence(STEP, of(|at| at.step)),
        TimeColumn::new_duration_nanos(SIMULATED_TIME, of(|at| at.nanos)),
        TimeColumn::new_sequence(PASSAGE, of(|at| at.passage)),
    ]
}
