//! Where a recording goes, and what is told of it at the end.

use re_log_types::StoreId;

use super::file::RecordingFile;
use super::live::Link;
use asperity_engine::observe::{NOTHING_CAME, ObserverReport};

/// What is sent to a viewer that has not answered yet, bytes: far less than the library lets wait before it blocks.
const UNANSWERED: u64 = 8 * 1024 * 1024;

/// Where a recording goes.
pub(super) enum Destination {
    /// Chunks are encoded and written where they are made: the library would take them over two more threads,
    /// to each of which they are cold. Only the layout goes its way.
    File {
        file: RecordingFile,
        store: StoreId,
    },
    Live(Link),
}

impl Destination {
    /// The recording's file; `None`: it goes to a viewer.
    pub(super) fn file(&self) -> Option<&RecordingFile> {
        match self {
            Self::File { file, .. } => Some(file),
            Self::Live(_) => None,
        }
    }

    /// Whether a viewer has been closed: nobody reads any more.
    pub(super) fn is_gone(&self) -> bool {
        match self {
            Self::File { .. } => false,
            Self::Live(link) => link.is_gone(),
        }
    }

    /// Whether enough was sent to a viewer that has not answered.
    pub(super) fn is_deaf(&self, sent: u64) -> bool {
        match self {
            Self::File { .. } => false,
            Self::Live(link) => sent > UNANSWERED && !link.has_answered(),
        }
    }

    /// What it holds of so many frames, and of so many that were not sent.
    pub(super) fn report(&self, output: String, frames: u64, unsent: u64) -> ObserverReport {
        let (frames, skipped, note) = match self {
            Self::File { .. } if frames == 0 => (0, 0, NOTHING_CAME),
            Self::File { .. } => (frames, unsent, ""),
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
