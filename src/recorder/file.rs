//! The file behind the library's stream.
//!
//! The library's own file sink keeps its errors to itself: on a full disk its writer ends, `log`
//! goes on returning `Ok`, and a flush (also the one on closing) waits for ever. This sink writes
//! what it gets at once, keeps the first error for whoever asks, and cuts the file back to its last
//! whole message, so that it stays readable up to there.
//!
//! While the run goes on the clock says when something is written, so that a kill loses less than a second. The
//! finished file is [compacted](super::compact): rows together by entity, whenever they were written, and a footer.

use std::fs::File;
use std::path::PathBuf;
use std::sync::{Arc, Mutex, MutexGuard, PoisonError};
use std::time::Duration;

use rerun::external::re_log_encoding::{CrateVersion, Encoder, EncodingOptions};
use rerun::log::LogMsg;
use rerun::sink::{LogSink, SinkFlushError};

use super::compact::{NoEpilogue, compact};
use asperity_engine::observe::{Left, Placed};

/// A recording's file, shared by the library's thread, which writes, and the recorder, which asks.
#[derive(Clone)]
pub(crate) struct RecordingFile(Arc<Mutex<FileState>>);

struct FileState {
    /// `None` once the file is closed or has failed.
    encoder: Option<Encoder<File>>,
    /// The same file, for its length.
    file: File,
    /// Length up to the last whole message.
    bytes: u64,
    /// The first thing that went wrong, and what is left.
    error: Option<(String, Left)>,
    /// Why the file is as it was written in the run, without a footer.
    not_compacted: Option<String>,
    /// Where it lies and what it will be called.
    placed: Placed,
}

impl FileState {
    fn write(&mut self, message: &LogMsg) {
        let Some(encoder) = &mut self.encoder else {
            return;
        };
        match encoder.append(message) {
            Ok(bytes) => self.bytes += bytes,
            Err(error) => self.fail(&error.to_string()),
        }
    }

    fn finish(&mut self) {
        if let Some(mut encoder) = self.encoder.take() {
            match encoder.finish() {
                Ok(()) => self.compact(),
                Err(error) => self.fail(&error.to_string()),
            }
        }
        if self.error.is_none() {
            match self.placed.settle() {
                Ok(true) => {}
                Ok(false) => self.bytes = 0,
                Err(error) => self.fail(&error.to_string()),
            }
        }
    }

    /// Puts rows together and adds the footer. A recording that cannot be compacted (no room for another) is complete
    /// all the same: viewers then read it from its beginning.
    fn compact(&mut self) {
        self.bytes = self.length();
        match compact(self.placed.at(), NoEpilogue) {
            Ok(bytes) => self.bytes = bytes,
            Err(reason) => self.not_compacted = Some(reason),
        }
    }

    fn fail(&mut self, reason: &str) {
        let left = self.placed.leave();
        self.error.get_or_insert_with(|| (reason.to_owned(), left));
        if let Some(mut encoder) = self.encoder.take() {
            // Dropping it would try to write a footer to a disk that takes no more.
            encoder.do_not_emit_footer();
        }
        // A half message at the end is skipped by readers with a warning; better it is not there.
        drop(self.file.set_len(self.bytes));
    }

    fn length(&self) -> u64 {
        self.file.metadata().map_or(self.bytes, |data| data.len())
    }
}

impl RecordingFile {
    /// Starts a recording in an empty file.
    pub(crate) fn start(file: File, placed: Placed) -> Result<Self, String> {
        let for_length = file.try_clone().map_err(|error| error.to_string())?;
        let options = EncodingOptions::PROTOBUF_COMPRESSED;
        let mut encoder = Encoder::new_eager(CrateVersion::LOCAL, options, file)
            .map_err(|error| error.to_string())?;
        // An index of 5.6 kB a message, kept in memory until the end: it is made when the file is compacted.
        encoder.do_not_emit_footer();
        let mut state = FileState {
            encoder: Some(encoder),
            file: for_length,
            bytes: 0,
            error: None,
            not_compacted: None,
            placed,
        };
        state.bytes = state.length();
        Ok(Self(Arc::new(Mutex::new(state))))
    }

    /// The state stays whole between statements, so a panic elsewhere does not spoil it.
    fn lock(&self) -> MutexGuard<'_, FileState> {
        self.0.lock().unwrap_or_else(PoisonError::into_inner)
    }

    /// A step is in it: from now on it is worth its name.
    pub(crate) fn mark_worth_keeping(&self) {
        let mut state = self.lock();
        if let Err(error) = state.placed.hold() {
            state.fail(&error.to_string());
        }
    }

    /// The run that it is of has been stopped before its end.
    pub(crate) fn cut_short(&self) {
        self.lock().placed.cut_short();
    }

    /// Where it lies beside the whole file that it was to replace; `None`: it has its name.
    pub(crate) fn set_aside(&self) -> Option<PathBuf> {
        self.lock()
            .placed
            .set_aside()
            .map(std::path::Path::to_path_buf)
    }

    /// Where it is written.
    pub(crate) fn path(&self) -> PathBuf {
        self.lock().placed.at().to_owned()
    }

    /// Bytes written.
    pub(crate) fn bytes(&self) -> u64 {
        self.lock().bytes
    }

    /// Why writing has ended, if it has.
    pub(crate) fn error(&self) -> Option<String> {
        self.lock().error.as_ref().map(|(reason, _)| reason.clone())
    }

    /// What is left of a file whose writing has ended before its time.
    pub(crate) fn left(&self) -> Option<Left> {
        self.lock().error.as_ref().map(|(_, left)| left.clone())
    }

    /// Why the finished file has no footer, if it has none.
    pub(crate) fn not_compacted(&self) -> Option<String> {
        self.lock().not_compacted.clone()
    }

    /// Compacts the file and gives it its name; what is sent afterwards is not written.
    pub(crate) fn finish(&self) -> Result<(), String> {
        let mut state = self.lock();
        state.finish();
        let error = state.error.as_ref().map(|(reason, _)| reason.clone());
        error.map_or(Ok(()), Err)
    }
}

impl LogSink for RecordingFile {
    fn send(&self, message: LogMsg) {
        self.lock().write(&message);
    }

    fn flush_blocking(&self, _timeout: Duration) -> Result<(), SinkFlushError> {
        // Everything was written when it was sent.
        self.error()
            .map_or(Ok(()), |reason| Err(SinkFlushError::failed(reason)))
    }
}
