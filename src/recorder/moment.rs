//! Timelines, and places on them.

use std::time::SystemTime;

use rerun::log::Chunk;
use rerun::time::TimePoint;
use rerun::{TimeCell, TimeColumn};

/// Timelines of every frame.
pub(crate) const STEP: &str = "step";
/// Simulated time since the start of the passage.
pub(crate) const SIMULATED_TIME: &str = "simulated_time";
/// Lengths of 4 a travelled at U, in thousandths (a timeline holds no fractions).
pub(crate) const PASSAGE: &str = "passage_x1000";

/// Whether the clock shows a time that a recording can begin at: the library panics before 1970.
pub(crate) fn check_clock() -> Result<(), String> {
    let since_1970 = SystemTime::now().duration_since(SystemTime::UNIX_EPOCH);
    since_1970.map(drop).map_err(|_| {
        "the system's clock stands before 1970, where no recording can begin; set it".to_owned()
    })
}

/// A place on all three timelines.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub(crate) struct Moment {
    step: i64,
    nanos: i64,
    passage: i64,
}

impl Moment {
    /// After so many steps, seconds and passages.
    pub(crate) fn new(step: u64, time_s: f64, passages: f64) -> Self {
        Self {
            step: i64::try_from(step).unwrap_or(i64::MAX),
            nanos: (time_s * 1e9).round() as i64,
            passage: (passages * 1000.0).round() as i64,
        }
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
        })
    }

    /// As the library has it.
    pub(crate) fn timepoint(self) -> TimePoint {
        TimePoint::default()
            .with_index(STEP, TimeCell::from_sequence(self.step))
            .with_index(SIMULATED_TIME, TimeCell::from_duration_nanos(self.nanos))
            .with_index(PASSAGE, TimeCell::from_sequence(self.passage))
    }
}

/// The three timelines of so many rows.
pub(crate) fn time_columns(moments: &[Moment]) -> [TimeColumn; 3] {
    let of = |part: fn(&Moment) -> i64| moments.iter().map(part);
    [
        TimeColumn::new_sequence(STEP, of(|at| at.step)),
        TimeColumn::new_duration_nanos(SIMULATED_TIME, of(|at| at.nanos)),
        TimeColumn::new_sequence(PASSAGE, of(|at| at.passage)),
    ]
}
