//! The file behind the library's stream.
//!
//! The library's own file sink keeps its errors to itself: on a full disk its writer ends, `log`
//! goes on returning `Ok`, and a flush (also the one on closing) waits for ever. This sink writes
//! what it gets at once, keeps the first error for whoever asks, and cuts the file back to its last
//! whole message, so that it stays readable up to there.

use std::fs::File;
use std::path::PathBuf;
use std::sync::{Arc, Mutex, MutexGuard, PoisonError};
use std::time::Duration;

use rerun::external::re_log_encoding::{CrateVersion, Encoder, EncodingOptions};
use rerun::log::LogMsg;
use rerun::sink::{LogSink, SinkFlushError};

use crate::observe::placed::Placed;

/// Messages from which on the file gets no footer: an index for partial loading, 5.6 kB a message, which would be
/// kept in memory until the end. Without it a viewer reads the file from its beginning, as it does after a kill.
/// Some 260 messages are made once and 50 come with every tick: recordings of a few passages stay below. With 1024
/// the memory of a long run still grew by 7 % after its first thousand steps (`safety.py memory`; 5 % is the bound).
const MOST_INDEXED: u64 = 640;

/// A recording's file, shared by the library's thread, which writes, and the recorder, which asks.
#[derive(Clone)]
pub(super) struct RecordingFile(Arc<Mutex<State>>);

struct State {
    /// `None` once the file is closed or has failed.
    encoder: Option<Encoder<File>>,
    /// The same file, for its length.
    file: File,
    /// Length up to the last whole message.
    bytes: u64,
    messages: u64,
    error: Option<String>,
    /// Where it lies and what it will be called.
    placed: Placed,
}

impl State {
    fn write(&mut self, message: &LogMsg) {
        let Some(encoder) = &mut self.encoder else {
            return;
        };
        self.messages += 1;
        if self.messages == MOST_INDEXED {
            encoder.do_not_emit_footer();
        }
        match encoder.append(message) {
            Ok(bytes) => self.bytes += bytes,
            Err(error) => self.fail(&error.to_string()),
        }
    }

    fn finish(&mut self) {
        if let Some(mut encoder) = self.encoder.take() {
            match encoder.finish() {
                Ok(()) => self.bytes = self.length(),
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

    fn fail(&mut self, reason: &str) {
        let place = self.placed.leave();
        let place = place.map_or_else(String::new, |at| {
            format!("; it is {}, the older one is as it was", at.display())
        });
        self.error.get_or_insert_with(|| format!("{reason}{place}"));
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
    pub(super) fn start(file: File, placed: Placed) -> Result<Self, String> {
        let for_length = file.try_clone().map_err(|error| error.to_string())?;
        let options = EncodingOptions::PROTOBUF_COMPRESSED;
        let encoder = Encoder::new_eager(CrateVersion::LOCAL, options, file)
            .map_err(|error| error.to_string())?;
        let mut state = State {
            encoder: Some(encoder),
            file: for_length,
            bytes: 0,
            messages: 0,
            error: None,
            placed,
        };
        state.bytes = state.length();
        Ok(Self(Arc::new(Mutex::new(state))))
    }

    /// The state stays whole between statements, so a panic elsewhere does not spoil it.
    fn lock(&self) -> MutexGuard<'_, State> {
        self.0.lock().unwrap_or_else(PoisonError::into_inner)
    }

    /// A step is in it: from now on it is worth its name.
    pub(super) fn hold(&self) {
        self.lock().placed.hold();
    }

    /// Where it is written.
    pub(super) fn path(&self) -> PathBuf {
        self.lock().placed.at().to_owned()
    }

    /// Bytes written.
    pub(super) fn bytes(&self) -> u64 {
        self.lock().bytes
    }

    /// Why writing has ended, if it has.
    pub(super) fn error(&self) -> Option<String> {
        self.lock().error.clone()
    }

    /// Writes the footer and gives the file its name; what is sent afterwards is not written.
    pub(super) fn finish(&self) -> Result<(), String> {
        let mut state = self.lock();
        state.finish();
        state.error.clone().map_or(Ok(()), Err)
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
