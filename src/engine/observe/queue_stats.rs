//! What a queue tells of itself.

use std::time::Duration;

use crate::math::number::counted;

/// How a queue was used.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub struct QueueStats {
    /// Most frames that were waiting when one was put in, with it.
    pub max_depth: usize,
    /// Times that the sender had to wait for room.
    pub waits: u64,
    /// How long it waited, all waits together.
    pub waited: Duration,
    /// Frames that were not delivered because the queue was full.
    pub skipped: u64,
    /// Frames that were handed to the observer's thread.
    pub frames: u64,
    /// Frames that the observer is done with.
    pub done: u64,
    /// How long the observer worked on them, by the clock.
    pub busy: Duration,
    /// Frames that may wait.
    pub capacity: usize,
}

impl std::fmt::Display for QueueStats {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        let busy = self.busy.as_secs_f64();
        write!(
            f,
            "{} offered, {} taken, {} skipped; at most {} of {} waited; the run waited {}, {:.2} s; \
             {:.2} ms of work per frame",
            counted(self.frames + self.skipped, "frame"),
            self.done,
            self.skipped,
            self.max_depth,
            self.capacity,
            counted(self.waits, "time"),
            self.waited.as_secs_f64(),
            1e3 * busy / self.done.max(1) as f64,
        )
    }
}
