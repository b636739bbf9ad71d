//! The stream that is recorded to: opening, logging, closing, and the errors of each. Rows are put together by the
//! library's batcher.

use std::cell::{Cell, RefCell};
use std::path::Path;
use std::time::{Duration, Instant};

use rerun::log::{ChunkBatcherConfig, PendingRow};
use rerun::time::TimePoint;
use rerun::{
    AsComponents, EntityPath, RecordingStream, RecordingStreamBuilder, Scalars,
    SerializedComponentBatch, TextDocument,
};

use super::destination::Destination;
use super::file::RecordingFile;
use super::live::{self, Live};
use super::moment::{Moment, check_clock, time_columns};
use super::note::Note;
use super::size::SizeEstimate;
use asperity_engine::math::number::counted;
use asperity_engine::observe::{Left, ObserveError, Overwrite};

/// Name under which viewers group recordings and remember layouts.
pub(crate) const APPLICATION: &str = "asperity";
/// How often a live stream sends rows, and the most bytes that wait for a viewer: beyond them logging waits.
const LIVE_BATCHES: ChunkBatcherConfig = ChunkBatcherConfig {
    flush_tick: Duration::from_millis(50),
    max_bytes_in_flight: 32 * 1024 * 1024,
    ..ChunkBatcherConfig::DEFAULT
};
/// A file's rows are flushed by the recorder, which then notes how far the file goes.
const FILE_BATCHES: ChunkBatcherConfig = ChunkBatcherConfig {
    flush_tick: Duration::MAX,
    ..ChunkBatcherConfig::DEFAULT
};
/// A file is flushed this often: with a frame that waits in the queue, `kill -9` loses less than a second.
const FLUSH_TICK: Duration = Duration::from_millis(700);
/// ... and after so many bytes: what is not flushed a full disk takes too, and on a small one it would be everything.
const FLUSH_BYTES: f64 = 512.0 * 1024.0;
/// Longest wait for a viewer to take the last bytes.
const LIVE_CLOSE_TIMEOUT: Duration = Duration::from_secs(3);
/// Longest wait for a file to take what was logged.
const FLUSH_TIMEOUT: Duration = Duration::from_mins(1);

/// `enabled` is set because the variable RERUN=off would make a silent no-op of a recording that the user
/// asked for.
fn builder(batches: ChunkBatcherConfig) -> RecordingStreamBuilder {
    RecordingStreamBuilder::new(APPLICATION)
        .enabled(true)
        .batcher_config(batches)
}

/// For how long something that is logged holds. What holds always shadows what holds from some time on.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Holds {
    Always,
    FromNow,
}

/// A recording that is being written.
pub(crate) struct Stream {
    recording: RecordingStream,
    to: Destination,
    output: String,
    closed: bool,
    flushed: Instant,
    flushed_bytes: f64,
    /// Steps that can be read back whatever comes, and the last of them.
    safe: Option<(u64, u64)>,
    now: Cell<Moment>,
    size: RefCell<SizeEstimate>,
    /// Why something could not be logged, first of all that could not: [`Stream::check`] tells.
    refused: RefCell<Option<String>>,
    /// Before the name of all that is logged: which of several runs it is of; empty: there is one.
    run: RefCell<String>,
}

impl Stream {
    /// Opens the file.
    pub(crate) fn create(path: &Path, overwrite: Overwrite) -> Result<Self, ObserveError> {
        let failed = |reason: String| {
            let reason = format!("the recording could not be started: {reason}");
            ObserveError::new(path.display().to_string(), reason)
        };
        let (file, placed) = overwrite.open(path)?;
        let file = RecordingFile::start(file, placed).map_err(failed)?;
        check_clock().map_err(failed)?;
        let recording = builder(FILE_BATCHES)
            .buffered()
            .map_err(|error| failed(error.to_string()))?;
        recording.set_sink(Box::new(file.clone()));
        let output = path.display().to_string();
        Ok(Self::over(recording, Destination::File(file), output))
    }

    /// Opens a connection to a viewer, or for viewers.
    pub(crate) fn live(live: Live) -> Result<Self, ObserveError> {
        let (recording, link) = live::open(live, builder(LIVE_BATCHES))?;
        let output = live.to_string();
        Ok(Self::over(recording, Destination::Live(link), output))
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
            flushed: Instant::now(),
            flushed_bytes: 0.0,
            safe: None,
            now: Cell::default(),
            size: RefCell::default(),
            refused: RefCell::default(),
            run: RefCell::default(),
        }
    }

    /// What is set up or logged next is of that run.
    pub(crate) fn enter_run(&self, run: &str) {
        run.clone_into(&mut self.run.borrow_mut());
    }

    /// The whole path of an entity.
    fn path(&self, entity: impl Into<EntityPath>) -> EntityPath {
        let (run, entity) = (self.run.borrow(), entity.into());
        if run.is_empty() {
            return entity;
        }
        EntityPath::from(run.as_str()).join(&entity)
    }

    /// The path of the file, or which viewer.
    pub(crate) fn output(&self) -> String {
        self.output.clone()
    }

    /// Where it goes.
    pub(crate) fn to(&self) -> &Destination {
        &self.to
    }

    /// Whether a viewer has been closed: nobody reads any more.
    pub(crate) fn is_gone(&self) -> bool {
        self.to.is_gone()
    }

    /// Whether it goes to viewers, while the run goes on.
    pub(crate) fn is_live(&self) -> bool {
        self.to.file().is_none()
    }

    /// The library's stream, for the layout.
    pub(crate) fn recording(&self) -> &RecordingStream {
        &self.recording
    }

    /// Sets the time of what is logged next.
    pub(crate) fn set_time(&self, now: Moment) {
        self.now.set(now);
    }

    /// Logs at the time that was set last.
    pub(crate) fn log(&self, entity: &str, data: &(impl AsComponents + ?Sized)) {
        let batches = data.as_serialized_batches();
        self.size.borrow_mut().add_row(entity, &batches);
        let row = PendingRow::from_iter(self.now.get().timepoint(), batches);
        self.recording.record_row(self.path(entity), row, false);
    }

    /// The time that was set last.
    pub(crate) fn now(&self) -> Moment {
        self.now.get()
    }

    /// Counts numbers of a step that will be logged as columns.
    pub(crate) fn count_scalars(&self, count: usize) {
        self.size.borrow_mut().add_scalars(count);
    }

    /// Logs the numbers of many steps: `width` of each.
    pub(crate) fn log_columns(
        &self,
        entity: &str,
        moments: &[Moment],
        values: &[f64],
        width: usize,
    ) {
        let lengths = std::iter::repeat_n(width, moments.len());
        let columns = Scalars::new(values.iter().copied()).columns(lengths);
        let sent = columns
            .map_err(|error| error.to_string())
            .and_then(|columns| {
                let sent =
                    self.recording
                        .send_columns(self.path(entity), time_columns(moments), columns);
                sent.map_err(|error| error.to_string())
            });
        self.note_refused(sent);
    }

    /// Keeps why something could not be logged, for [`Stream::check`].
    pub(crate) fn note_refused(&self, logged: Result<(), String>) {
        if let Err(reason) = logged {
            self.refused.borrow_mut().get_or_insert(reason);
        }
    }

    /// Logs what holds for the whole recording.
    pub(crate) fn log_static(
        &self,
        entity: impl Into<EntityPath>,
        data: &(impl AsComponents + ?Sized),
    ) {
        let batches = data.as_serialized_batches();
        self.size.borrow_mut().add_message(&batches);
        self.send_row(entity.into(), TimePoint::default(), batches);
    }

    /// Logs what holds for the whole recording, or from the time that was set last until it is logged again. Either is a
    /// chunk of its own: readers go by chunks whose rows all hold the same components.
    pub(crate) fn log_for(&self, holds: Holds, entity: &str, data: &(impl AsComponents + ?Sized)) {
        match holds {
            Holds::Always => self.log_static(entity, data),
            Holds::FromNow => {
                let batches = data.as_serialized_batches();
                self.size.borrow_mut().add_row(entity, &batches);
                self.send_row(entity.into(), self.now.get().timepoint(), batches);
            }
        }
    }

    fn send_row(&self, entity: EntityPath, at: TimePoint, batches: Vec<SerializedComponentBatch>) {
        let chunk = PendingRow::from_iter(at, batches).into_chunk(self.path(entity));
        let sent = chunk.map(|chunk| self.recording.send_chunk(chunk));
        self.note_refused(sent.map_err(|error| error.to_string()));
    }

    /// Whether rows have waited long enough to be flushed.
    pub(crate) fn is_flush_due(&self) -> bool {
        let elapsed = self.flushed.elapsed();
        if self.is_live() {
            return elapsed >= LIVE_BATCHES.flush_tick;
        }
        elapsed >= FLUSH_TICK || self.expected_bytes() - self.flushed_bytes >= FLUSH_BYTES
    }

    /// So many steps up to that one are in the file, with how far it goes.
    pub(crate) fn note_safe(&mut self, steps: u64, last: u64) {
        self.safe = Some((steps, last));
    }

    /// Writes the rows that wait to the file, and after them how far it then goes: of several such notes the finished file
    /// has the last one.
    pub(crate) fn flush(&mut self, reach: Option<(&str, Note)>) -> Result<(), ObserveError> {
        self.flushed = Instant::now();
        self.flushed_bytes = self.expected_bytes();
        if self.is_live() || self.closed {
            return Ok(());
        }
        if let Some((entity, note)) = reach {
            let rows_first = self.recording.flush_async();
            rows_first.map_err(|error| self.failed(&error.to_string()))?;
            let note = TextDocument::new(note.to_text());
            let batches = note.as_serialized_batches();
            self.send_row(entity.into(), TimePoint::default(), batches);
        }
        let flushed = self.recording.flush_with_timeout(FLUSH_TIMEOUT);
        self.check()?;
        flushed.map_err(|error| self.failed(&error.to_string()))
    }

    /// An error if the file has failed, or something could not be logged.
    pub(crate) fn check(&self) -> Result<(), ObserveError> {
        let refused = || self.refused.borrow().clone();
        let error = self.to.file().and_then(RecordingFile::error);
        let error = error.or_else(refused);
        error.map_or(Ok(()), |reason| Err(self.failed(&reason)))
    }

    /// What was logged so far will take of the finished file, bytes. A viewer has its own limit and forgets the oldest, so
    /// nothing is counted.
    pub(crate) fn expected_bytes(&self) -> f64 {
        if self.is_live() {
            0.0
        } else {
            self.size.borrow().bytes()
        }
    }

    /// Writes what waits and compacts the file.
    pub(crate) fn close(&mut self) -> Result<(), ObserveError> {
        if self.closed {
            return self.check();
        }
        self.closed = true;
        let flushed = self.recording.flush_with_timeout(match &self.to {
            Destination::File(_) => FLUSH_TIMEOUT,
            Destination::Live(_) => LIVE_CLOSE_TIMEOUT,
        });
        match &self.to {
            Destination::File(file) => {
                file.finish().map_err(|reason| self.failed(&reason))?;
                flushed.map_err(|error| self.failed(&error.to_string()))
            }
            Destination::Live(link) => {
                // What a viewer does not take in time it does not get: nobody waits for it.
                link.note_end(flushed.is_ok());
                Ok(())
            }
        }
    }

    /// What went wrong, and what is left. The system's own words name the cause: others would be a guess.
    fn failed(&self, reason: &str) -> ObserveError {
        let place = match self.to.file().and_then(RecordingFile::left) {
            Some(Left::Nothing) => "; nothing of it is left".to_owned(),
            Some(Left::Beside(at)) => {
                let at = at.display();
                format!("; it is {at}, the older one is as it was")
            }
            Some(Left::InItsPlace) | None => String::new(),
        };
        let steps = match self.safe {
            Some((steps, last)) => {
                let steps = counted(steps, "step");
                format!("; {steps} up to step {last} can be read back")
            }
            None => "; no step of it can be read back".to_owned(),
        };
        let reason = format!("the recording could not be written ({reason}){steps}{place}");
        ObserveError::new(self.output(), reason)
    }
}

impl Drop for Stream {
    /// A recording that nobody finished is still closed: it opens like any other.
    fn drop(&mut self) {
        // Nobody is left to tell; `close` was the place to see errors.
        drop(self.close());
    }
}
