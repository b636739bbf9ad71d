//! The stream that is recorded to: opening, logging, closing, and the errors of each.

mod handles;

use std::cell::{Cell, RefCell};
use std::path::Path;
use std::time::{Duration, Instant};

use re_log_types::LogMsg;
use rerun::external::arrow::array::Array as _;
use rerun::log::{Chunk, ChunkBatcherConfig, PendingRow};
use rerun::sink::LogSink as _;
use rerun::time::TimePoint;
use rerun::{
    AsComponents, EntityPath, RecordingStream, RecordingStreamBuilder, Scalars,
    SerializedComponentBatch,
};

use super::destination::Destination;
use super::file::RecordingFile;
use super::gathered::chunk_of;
use super::live::{self, Live};
use super::moment::{Moment, check_clock};
use super::waiting::Waiting;
use super::weight::{MESSAGE, TEXT};
use asperity_engine::observe::{ObserveError, Overwrite};

/// Name under which viewers group recordings and remember layouts.
pub(super) const APPLICATION: &str = "asperity";
/// Most bytes that wait for a viewer; logging waits when there are more.
const WAITING_BYTES: u64 = 32 * 1024 * 1024;
/// How often a live stream sends what waits.
const LIVE_TICK: Duration = Duration::from_millis(50);
/// Longest wait for a viewer to take the last bytes.
const LIVE_CLOSE_TIMEOUT: Duration = Duration::from_secs(3);
/// Longest wait for the last bytes on closing.
const CLOSE_TIMEOUT: Duration = Duration::from_mins(1);
/// What is logged is written at least this often: with a frame that waits in the queue, `kill -9` loses less than a second.
const TICK: Duration = Duration::from_millis(700);

/// `enabled` is set because the variable RERUN=off would make a silent no-op of a recording that the user
/// asked for.
fn builder(batching: ChunkBatcherConfig) -> RecordingStreamBuilder {
    RecordingStreamBuilder::new(APPLICATION)
        .enabled(true)
        .batcher_config(batching)
}

/// For how long something that is logged holds. What holds always shadows what holds from some time on.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Holds {
    Always,
    FromNow,
}

/// A recording that is being written.
pub(super) struct Stream {
    recording: RecordingStream,
    to: Destination,
    output: String,
    closed: bool,
    sent: Instant,
    /// How long the sending took last: longer where other programs want the processors too.
    sending: Duration,
    now: Cell<Moment>,
    timepoint: RefCell<TimePoint>,
    waiting: RefCell<Waiting>,
    /// What holds always, in the finished file, bytes.
    always: Cell<f64>,
    /// Before the name of all that is logged: the run of several that it is of; empty: there is one.
    under: RefCell<String>,
}

impl Stream {
    /// Opens the file.
    pub(super) fn create(path: &Path, overwrite: Overwrite) -> Result<Self, ObserveError> {
        let failed = |reason: String| {
            let reason = format!("the recording could not be started: {reason}");
            ObserveError::new(path.display().to_string(), reason)
        };
        let (file, placed) = overwrite.open(path)?;
        let file = RecordingFile::start(file, placed).map_err(failed)?;
        check_clock().map_err(failed)?;
        let recording = builder(ChunkBatcherConfig::NEVER)
            .buffered()
            .map_err(|error| failed(error.to_string()))?;
        recording.set_sink(Box::new(file.clone()));
        // What the file is comes before what is in it.
        let begun = recording.flush_with_timeout(CLOSE_TIMEOUT);
        begun.map_err(|error| failed(error.to_string()))?;
        let store = recording
            .store_info()
            .map(|info| info.store_id)
            .ok_or_else(|| failed("it has no name".to_owned()))?;
        let output = path.display().to_string();
        let to = Destination::File { file, store };
        Ok(Self::over(recording, to, output))
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
            sending: Duration::ZERO,
            now: Cell::default(),
            timepoint: RefCell::default(),
            waiting: RefCell::default(),
            always: Cell::default(),
            under: RefCell::default(),
        }
    }

    /// What is set up or logged next is of that run.
    pub(super) fn go_under(&self, run: &str) {
        run.clone_into(&mut self.under.borrow_mut());
    }

    /// The whole path of an entity.
    fn path(&self, entity: impl Into<EntityPath>) -> EntityPath {
        let (under, entity) = (self.under.borrow(), entity.into());
        if under.is_empty() {
            return entity;
        }
        EntityPath::from(under.as_str()).join(&entity)
    }

    /// The path, or which viewer.
    pub(super) fn output(&self) -> String {
        self.output.clone()
    }

    /// Where it goes.
    pub(super) fn to(&self) -> &Destination {
        &self.to
    }

    /// Whether a viewer has been closed: nobody reads any more.
    pub(super) fn is_gone(&self) -> bool {
        self.to.is_gone()
    }

    /// Whether it goes to viewers, while the run goes on.
    pub(super) fn is_live(&self) -> bool {
        self.to.file().is_none()
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
        let now = self.timepoint.borrow().clone();
        let under = self.under.borrow();
        let mut waiting = self.waiting.borrow_mut();
        if under.is_empty() {
            waiting.push(entity, now, data);
        } else {
            waiting.push(&format!("{under}/{entity}"), now, data);
        }
        drop(waiting);
        self.send_if_full()
    }

    fn send_if_full(&self) -> Result<(), ObserveError> {
        if self.waiting.borrow().is_full() {
            self.send_rows()?;
        }
        Ok(())
    }

    fn send_rows(&self) -> Result<(), ObserveError> {
        let mut outcome = Ok(());
        self.waiting.borrow_mut().take(|chunk| {
            let sent = chunk
                .map_err(|error| self.failed(&error.to_string()))
                .and_then(|chunk| self.send(chunk));
            if outcome.is_ok() {
                outcome = sent;
            }
        });
        outcome
    }

    fn send(&self, chunk: Chunk) -> Result<(), ObserveError> {
        match &self.to {
            Destination::File { file, store } => {
                let message = chunk.to_arrow_msg();
                let message = message.map_err(|error| self.failed(&error.to_string()))?;
                // Errors of the file are kept in it, for `check`.
                file.send(LogMsg::ArrowMsg(store.clone(), message));
            }
            Destination::Live(_) => self.recording.send_chunk(chunk),
        }
        Ok(())
    }

    /// Logs what holds for the whole recording, or from the time that was set last.
    pub(super) fn log_that(
        &self,
        entity: &str,
        data: &(impl AsComponents + ?Sized),
        holds: Holds,
    ) -> Result<(), ObserveError> {
        match holds {
            Holds::Always => self.log_static(entity, data),
            Holds::FromNow => self.log(entity, data),
        }
    }

    /// Logs what holds for the whole recording.
    pub(super) fn log_static(
        &self,
        entity: impl Into<EntityPath>,
        data: &(impl AsComponents + ?Sized),
    ) -> Result<(), ObserveError> {
        let batches = data.as_serialized_batches();
        let bytes: usize = batches
            .iter()
            .map(|batch| batch.array.get_buffer_memory_size())
            .sum();
        self.always
            .update(|always| always + MESSAGE + TEXT * bytes as f64);
        self.log_for_now(entity, batches)
    }

    /// Logs what holds for the whole recording until it is logged again: the finished file has the last of them alone,
    /// which weighs nothing.
    pub(super) fn log_for_now(
        &self,
        entity: impl Into<EntityPath>,
        batches: Vec<SerializedComponentBatch>,
    ) -> Result<(), ObserveError> {
        let row = PendingRow::from_iter(TimePoint::default(), batches);
        let chunk = row.into_chunk(self.path(entity));
        self.send(chunk.map_err(|error| self.failed(&error.to_string()))?)
    }

    /// Sets the time of what is logged next.
    pub(super) fn set_time(&self, now: Moment) {
        self.now.set(now);
        *self.timepoint.borrow_mut() = now.timepoint();
    }

    /// Sends the scalars of many steps at once: `width` of each.
    pub(super) fn log_columns(
        &self,
        entity: EntityPath,
        moments: &[Moment],
        values: &[f64],
        width: usize,
    ) -> Result<(), ObserveError> {
        let lengths = std::iter::repeat_n(width, moments.len());
        let columns = Scalars::new(values.iter().copied())
            .columns(lengths)
            .map_err(|error| self.failed(&error.to_string()))?;
        let chunk = chunk_of(self.path(entity), moments, columns);
        self.send(chunk.map_err(|error| self.failed(&error.to_string()))?)
    }

    /// Sends what waits on to the file now.
    pub(super) fn send_on(&mut self) -> Result<(), ObserveError> {
        self.sent = Instant::now();
        self.send_rows()?;
        if let Destination::Live(_) = &self.to {
            // A viewer that takes nothing is seen by its queue.
            drop(self.recording.flush_async());
        }
        self.sending = self.sent.elapsed();
        Ok(())
    }

    /// Whether a tick has passed since, less the time that the sending takes: what it takes is not written yet.
    pub(super) fn is_due(&self) -> bool {
        let tick = match &self.to {
            Destination::File { .. } => TICK,
            Destination::Live(_) => LIVE_TICK,
        };
        self.sent.elapsed() >= tick.saturating_sub(2 * self.sending).max(tick / 2)
    }

    /// An error if the file has failed since.
    pub(super) fn check(&self) -> Result<(), ObserveError> {
        let error = self.to.file().and_then(RecordingFile::error);
        error.map_or(Ok(()), |reason| Err(self.failed(&reason)))
    }

    /// What was logged so far will take of the finished file, bytes, but for columns of scalars; a viewer has its own
    /// limit and forgets the oldest, so nothing is counted.
    pub(super) fn weight(&self) -> f64 {
        match &self.to {
            Destination::File { .. } => self.always.get() + self.waiting.borrow().weight(),
            Destination::Live(_) => 0.0,
        }
    }

    /// Writes what waits and binds the file.
    pub(super) fn close(&mut self) -> Result<(), ObserveError> {
        if self.closed {
            return self.check();
        }
        self.closed = true;
        let sent = self.send_rows();
        let file = match &self.to {
            Destination::File { file, .. } => file,
            Destination::Live(link) => {
                // What a viewer does not take in time it does not get: nobody waits for it.
                let flushed = self.recording.flush_with_timeout(LIVE_CLOSE_TIMEOUT);
                link.ended(flushed.is_ok());
                return Ok(());
            }
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
