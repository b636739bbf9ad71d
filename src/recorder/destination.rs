//! Where a recording goes, and what is told of it at the end.

use super::file::RecordingFile;
use super::live::Link;
use asperity_engine::observe::{NOTHING_CAME, ObserverReport};

/// What is sent to a viewer that has not answered yet, bytes: far less than the library lets wait before it blocks.
const UNANSWERED: u64 = 8 * 1024 * 1024;

/// Where a recording goes.
pub(crate) enum Destination {
    File(RecordingFile),
    Live(Link),
}

impl Destination {
    /// The recording's file; `None`: it goes to a viewer.
    pub(crate) fn file(&self) -> Option<&RecordingFile> {
        match self {
            Self::File(file) => Some(file),
            Self::Live(_) => None,
        }
    }

    /// Whether a viewer has been closed: nobody reads any more.
    pub(crate) fn is_gone(&self) -> bool {
        match self {
            Self::File(_) => false,
            Self::Live(link) => link.is_gone(),
        }
    }

    /// Whether enough was sent to a viewer that has not answered.
    pub(crate) fn is_deaf(&self, sent: u64) -> bool {
        match self {
            Self::File(_) => false,
            Self::Live(link) => sent > UNANSWERED && !link.has_answered(),
        }
    }

    /// What it holds of so many frames, and of so many that were not sent.
    pub(crate) fn report(&self, output: String, frames: u64, unsent: u64) -> ObserverReport {
        let (frames, skipped, note) = match self {
            Self::File(_) if frames == 0 => (0, 0, NOTHING_CAME),
            Self::File(_) => (frames, unsent, ""),
            Self::Live(link) if !link.has_answered() => {
                (0, frames + unsent, "the viewer never answered")
            }
            Self::Live(_) if unsent > 0 => (frames, unsent, "the viewer was closed"),
            Self::Live(link) if !link.took_all() => {
                (frames, 0, "the viewer did not take all of it in time")
            }
            Self::Live(_) => (frames, 0, ""),
        };
        ObserverReport {
            output,
            frames,
            skipped,
            bytes: self.file().map_or(0, RecordingFile::bytes),
            note: note.to_owned(),
            queue: None,
        }
    }
}
