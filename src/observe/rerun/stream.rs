//! The stream that is recorded to: opening, logging, closing, and the errors of each.

use std::cell::RefCell;
use std::path::Path;
use std::time::{Duration, Instant};

use rerun::log::ChunkBatcherConfig;
use rerun::time::TimePoint;
use rerun::{
    AsComponents, EntityPath, RecordingStream, RecordingStreamBuilder, Scalars, TimeCell,
    TimeColumn,
};

use super::file::RecordingFile;
use super::live::{self, Link, Live};
use super::waiting::Waiting;
use crate::observe::{ObserveError, Overwrite};

/// Name under which viewers group recordings and remember layouts.
pub(super) const APPLICATION: &str = "asperity";
/// Most bytes that wait for the disk; logging waits when there are more.
const WAITING_BYTES: u64 = 32 * 1024 * 1024;
/// How often a live stream sends what waits.
const LIVE_TICK: Duration = Duration::from_millis(50);
/// Longest wait for a viewer to take the last bytes.
const LIVE_CLOSE_TIMEOUT: Duration = Duration::from_secs(3);
/// Longest wait for the last bytes on closing.
const CLOSE_TIMEOUT: Duration = Duration::from_mins(1);
/// What is logged reaches the file's writer at least this often: with the writing itself, `kill -9` loses less than
/// a second.
const TICK: Duration = Duration::from_millis(800);

/// Timelines of every frame.
pub(super) const STEP: &str = "step";
/// Simulated time since the start of the passage.
pub(super) const SIMULATED_TIME: &str = "simulated_time";
/// Lengths of 4 a travelled at U, in thousandths (a timeline holds no fractions).
pub(super) const PASSAGE: &str = "passage_x1000";

/// A place on all three timelines.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) struct Moment {
    step: i64,
    nanos: i64,
    passage: i64,
}

impl Moment {
    /// After so many steps, seconds and passages.
    pub(super) fn new(step: u64, time_s: f64, passages: f64) -> Self {
        Self {
            step: i64::try_from(step).unwrap_or(i64::MAX),
            nanos: (time_s * 1e9).round() as i64,
            passage: (passages * 1000.0).round() as i64,
        }
    }
}

/// `enabled` is set because the variable RERUN=off would make a silent no-op of a recording that the user
/// asked for.
fn builder(batching: ChunkBatcherConfig) -> RecordingStreamBuilder {
    RecordingStreamBuilder::new(APPLICATION)
        .enabled(true)
        .batcher_config(batching)
}

/// A recording that is being written.
pub(super) struct Stream {
    recording: RecordingStream,
    to: Destination,
    output: String,
    closed: bool,
    sent: Instant,
    now: RefCell<TimePoint>,
    waiting: RefCell<Waiting>,
}

enum Destination {
    File(RecordingFile),
    Live(Link),
}

impl Stream {
    /// Opens the file.
    pub(super) fn create(path: &Path, overwrite: Overwrite) -> Result<Self, ObserveError> {
        let failed = |reason: String| {
            let reason = format!("the recording could not be started: {reason}");
            ObserveError::new(path.display().to_string(), reason)
        };
        let file = RecordingFile::start(overwrite.create(path)?).map_err(failed)?;
        let batching = ChunkBatcherConfig {
            flush_tick: TICK,
            flush_num_bytes: 4 * 1024 * 1024,
            max_bytes_in_flight: WAITING_BYTES,
            ..ChunkBatcherConfig::DEFAULT
        };
        let recording = builder(batching)
            .buffered()
            .map_err(|error| failed(error.to_string()))?;
        recording.set_sink(Box::new(file.clone()));
        let output = path.display().to_string();
        Ok(Self::over(recording, Destination::File(file), output))
    }

    /// Opens a connection to a viewer, or for viewers.
    pub(super) fn live(live: Live) -> Result<Self, ObserveError> {
        let batching = ChunkBatcherConfig {
            flush_tick: LIVE_TICK,
            max_bytes_in_flight: WAITING_BYTES,
            ..ChunkBatcherConfig::DEFAULT
        };
        let (recording, link) = live::open(live, builder(batching))?;
        Ok(Self::over(
            recording,
            Destination::Live(link),
            live.to_string(),
        ))
    }

    fn over(recording: RecordingStream, to: Destination, output: String) -> Self {
        // Wall-clock time says nothing about the physics and makes every file differ.
        recording.set_log_time_enabled(false);
        recording.set_log_tick_enabled(false);
        Self {
            recording,
            to,
            output,
            closed: false,
            sent: Instant::now(),
            now: RefCell::default(),
            waiting: RefCell::default(),
        }
    }

    /// The path, or which viewer.
    pub(super) fn output(&self) -> String {
        self.output.clone()
    }

    /// Whether a viewer has been closed: nobody reads any more.
    pub(super) fn is_gone(&self) -> bool {
        match &self.to {
            Destination::File(_) => false,
            Destination::Live(link) => link.is_gone(),
        }
    }

    /// The library's stream, for the layout.
    pub(super) fn recording(&self) -> &RecordingStream {
        &self.recording
    }

    /// Logs at the time that was set last.
    pub(super) fn log(
        &self,
        entity: impl Into<EntityPath>,
        data: &(impl AsComponents + ?Sized),
    ) -> Result<(), ObserveError> {
        let now = self.now.borrow().clone();
        let mut waiting = self.waiting.borrow_mut();
        waiting.push(entity.into(), now, data);
        if waiting.is_full() {
            drop(waiting);
            self.send_rows()?;
        }
        Ok(())
    }

    fn send_rows(&self) -> Result<(), ObserveError> {
        let chunks = self.waiting.borrow_mut().take();
        for chunk in chunks.map_err(|error| self.failed(&error.to_string()))? {
            self.recording.send_chunk(chunk);
        }
        Ok(())
    }

    /// Logs what holds for the whole recording.
    pub(super) fn log_static(
        &self,
        entity: impl Into<EntityPath>,
        data: &(impl AsComponents + ?Sized),
    ) -> Result<(), ObserveError> {
        self.recording
            .log_static(entity, data)
            .map_err(|error| self.failed(&error.to_string()))
    }

    /// Sets the time of what is logged next.
    pub(super) fn set_time(&self, now: Moment) {
        *self.now.borrow_mut() = TimePoint::default()
            .with_index(STEP, TimeCell::from_sequence(now.step))
            .with_index(SIMULATED_TIME, TimeCell::from_duration_nanos(now.nanos))
            .with_index(PASSAGE, TimeCell::from_sequence(now.passage));
    }

    /// Sends the scalars of many steps at once: `width` of each.
    pub(super) fn log_columns(
        &self,
        entity: EntityPath,
        moments: &[Moment],
        values: &[f64],
        width: usize,
    ) -> Result<(), ObserveError> {
        let of = |part: fn(&Moment) -> i64| moments.iter().map(part);
        let times = [
            TimeColumn::new_sequence(STEP, of(|at| at.step)),
            TimeColumn::new_duration_nanos(SIMULATED_TIME, of(|at| at.nanos)),
            TimeColumn::new_sequence(PASSAGE, of(|at| at.passage)),
        ];
        let lengths = std::iter::repeat_n(width, moments.len());
        let columns = Scalars::new(values.iter().copied())
            .columns(lengths)
            .map_err(|error| self.failed(&error.to_string()))?;
        self.recording
            .send_columns(entity, times, columns)
            .map_err(|error| self.failed(&error.to_string()))
    }

    /// Sends what waits on to the file now.
    pub(super) fn send_on(&mut self) -> Result<(), ObserveError> {
        self.sent = Instant::now();
        self.send_rows()?;
        // Errors of the file are kept in it, for `check`.
        drop(self.recording.flush_async());
        Ok(())
    }

    /// Whether a tick has passed since. The library's own tick is left out whenever some entity has filled a
    /// batch, so that in a fast run the rest would wait for as long as images keep coming.
    pub(super) fn is_due(&self) -> bool {
        let tick = match &self.to {
            Destination::File(_) => TICK,
            Destination::Live(_) => LIVE_TICK,
        };
        self.sent.elapsed() >= tick
    }

    /// An error if the file has failed since.
    pub(super) fn check(&self) -> Result<(), ObserveError> {
        let Destination::File(file) = &self.to else {
            return Ok(());
        };
        file.error()
            .map_or(Ok(()), |reason| Err(self.failed(&reason)))
    }

    /// Bytes in the file by now; a viewer has its own limit and forgets the oldest, so nothing is counted.
    pub(super) fn bytes(&self) -> u64 {
        match &self.to {
            Destination::File(file) => file.bytes(),
            Destination::Live(_) => 0,
        }
    }

    /// Writes what waits and the footer.
    pub(super) fn close(&mut self) -> Result<(), ObserveError> {
        if self.closed {
            return self.check();
        }
        self.closed = true;
        let sent = self.send_rows();
        let Destination::File(file) = &self.to else {
            // What a viewer does not take in time it does not get: nobody waits for it.
            drop(self.recording.flush_with_timeout(LIVE_CLOSE_TIMEOUT));
            return Ok(());
        };
        let flushed = self.recording.flush_with_timeout(CLOSE_TIMEOUT);
        file.finish().map_err(|reason| self.failed(&reason))?;
        sent?;
        flushed.map_err(|error| self.failed(&error.to_string()))
    }

    fn failed(&self, reason: &str) -> ObserveError {
        ObserveError::new(
            self.output(),
            format!(
                "the recording could not be written ({reason}); what was written before stays \
                 readable. Is the disk full?"
            ),
        )
    }
}

impl Drop for Stream {
    /// A recording that nobody finished is still closed: it opens like any other.
    fn drop(&mut self) {
        // Nobody is left to tell; `close` was the place to see errors.
        drop(self.close());
    }
}
