//! The file that is recorded to: opening, logging, flushing, closing, and the errors of each.
//!
//! The library's `log` returns `Ok` on a full disk; only a flush tells. So the stream is flushed
//! whenever [`FLUSH_BYTES`] have been logged or [`FLUSH_EVERY`] has passed, which also bounds what
//! waits in memory and what a killed process loses.

use std::path::{Path, PathBuf};
use std::time::{Duration, Instant};

use rerun::log::ChunkBatcherConfig;
use rerun::{AsComponents, RecordingStream, RecordingStreamBuilder};

use crate::observe::{ObserveError, Overwrite};

/// Name under which viewers group recordings and remember layouts.
pub(super) const APPLICATION: &str = "asperity";
/// Most bytes that wait unflushed.
const FLUSH_BYTES: u64 = 20_000_000;
/// Longest time between flushes.
const FLUSH_EVERY: Duration = Duration::from_secs(5);
/// Longest wait for a flush; a disk that needs longer has failed.
const FLUSH_TIMEOUT: Duration = Duration::from_secs(60);
/// What is logged reaches the file's writer at least this often: what `kill -9` may lose.
const TICK: Duration = Duration::from_secs(1);

/// Timelines of every frame.
pub(super) const STEP: &str = "step";
/// Simulated time since the start of the passage.
pub(super) const SIMULATED_TIME: &str = "simulated_time";
/// Lengths of 4 a travelled at U, in thousandths (a timeline holds no fractions).
pub(super) const PASSAGE: &str = "passage_x1000";

/// A recording that is being written.
pub(super) struct Stream {
    recording: RecordingStream,
    path: PathBuf,
    waiting_bytes: u64,
    flushed_at: Instant,
    closed: bool,
}

impl Stream {
    /// Opens the file.
    pub(super) fn create(path: &Path, overwrite: Overwrite) -> Result<Self, ObserveError> {
        // The library truncates without asking, so the file is claimed first.
        drop(overwrite.create(path)?);
        let batching = ChunkBatcherConfig {
            flush_tick: TICK,
            flush_num_bytes: 4 * 1024 * 1024,
            ..ChunkBatcherConfig::DEFAULT
        };
        // `enabled` is set because the variable RERUN=off would make a silent no-op of a recording
        // that the user asked for.
        let recording = RecordingStreamBuilder::new(APPLICATION)
            .enabled(true)
            .batcher_config(batching)
            .save(path)
            .map_err(|error| {
                let reason = format!("the recording could not be started: {error}");
                ObserveError::new(path.display().to_string(), reason)
            })?;
        // Wall-clock time says nothing about the physics and makes every file differ.
        recording.set_log_time_enabled(false);
        recording.set_log_tick_enabled(false);
        Ok(Self {
            recording,
            path: path.to_owned(),
            waiting_bytes: 0,
            flushed_at: Instant::now(),
            closed: false,
        })
    }

    /// The path as text.
    pub(super) fn output(&self) -> String {
        self.path.display().to_string()
    }

    /// The library's stream, for the layout.
    pub(super) fn recording(&self) -> &RecordingStream {
        &self.recording
    }

    /// Logs at the time that was set last.
    pub(super) fn log(
        &self,
        entity: &str,
        data: &(impl AsComponents + ?Sized),
    ) -> Result<(), ObserveError> {
        self.recording
            .log(entity, data)
            .map_err(|error| self.failed(&error.to_string()))
    }

    /// Logs what holds for the whole recording.
    pub(super) fn log_static(
        &self,
        entity: &str,
        data: &(impl AsComponents + ?Sized),
    ) -> Result<(), ObserveError> {
        self.recording
            .log_static(entity, data)
            .map_err(|error| self.failed(&error.to_string()))
    }

    /// Sets the time of what is logged next. Timelines belong to the thread that sets them.
    pub(super) fn set_time(&self, step: u64, time_s: f64, passages: f64) {
        self.recording
            .set_time_sequence(STEP, i64::try_from(step).unwrap_or(i64::MAX));
        self.recording.set_duration_secs(SIMULATED_TIME, time_s);
        self.recording
            .set_time_sequence(PASSAGE, (passages * 1000.0).round() as i64);
    }

    /// Says that about `bytes` were logged; flushes when it is due.
    pub(super) fn logged(&mut self, bytes: u64) -> Result<(), ObserveError> {
        self.waiting_bytes += bytes;
        if self.waiting_bytes < FLUSH_BYTES && self.flushed_at.elapsed() < FLUSH_EVERY {
            return Ok(());
        }
        self.flush()
    }

    fn flush(&mut self) -> Result<(), ObserveError> {
        self.waiting_bytes = 0;
        self.flushed_at = Instant::now();
        self.recording
            .flush_with_timeout(FLUSH_TIMEOUT)
            .map_err(|error| self.failed(&error.to_string()))
    }

    /// Bytes in the file by now.
    pub(super) fn bytes(&self) -> u64 {
        std::fs::metadata(&self.path).map_or(0, |data| data.len())
    }

    /// Writes what waits and the footer.
    pub(super) fn close(&mut self) -> Result<(), ObserveError> {
        if self.closed {
            return Ok(());
        }
        self.closed = true;
        let flushed = self.flush();
        self.recording.finalize_deferred_sinks();
        flushed
    }

    fn failed(&self, reason: &str) -> ObserveError {
        ObserveError::new(
            self.output(),
            format!(
                "the recording could not be written ({reason}); what was flushed before stays \
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
