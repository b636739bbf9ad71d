//! One slot with the newest frame: what a screen reads.

use std::sync::{Arc, Mutex};

use crate::sim::Frame;

/// One slot that holds the newest frame: a slow reader skips frames and never delays the run.
#[derive(Debug, Default, Clone)]
pub struct Latest {
    slot: Arc<Mutex<Option<Arc<Frame>>>>,
}

impl Latest {
    /// Puts a frame, replacing one that nobody took.
    pub fn put(&self, frame: Arc<Frame>) {
        if let Ok(mut slot) = self.slot.lock() {
            *slot = Some(frame);
        }
    }

    /// Takes the newest frame, if there is one that was not taken yet.
    pub fn take(&self) -> Option<Arc<Frame>> {
        self.slot.lock().ok().and_then(|mut slot| slot.take())
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_newest_frame_wins_and_is_taken_once() {
        let latest = Latest::default();
        assert!(latest.take().is_none());
        for step in 1..=3 {
            latest.put(Arc::new(Frame {
                step,
                ..Frame::default()
            }));
        }
        assert_eq!(latest.take().map(|frame| frame.step), Some(3));
        assert!(latest.take().is_none());
    }
}
