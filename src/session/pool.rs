//! Frames that are filled, shared and filled again: a warm run allocates no frame.
//!
//! The pool keeps one reference to every frame it ever made. A frame whose only owner is the pool
//! has been dropped by everyone who got it, so it may be filled again; nothing has to be handed
//! back. When all frames are out the pool grows by one.

use std::sync::Arc;

use asperity_engine::sim::Frame;

/// Recycles frames.
#[derive(Debug, Default)]
pub struct FramePool {
    frames: Vec<Arc<Frame>>,
    next: usize,
}

impl FramePool {
    /// A pool with `n_frames` copies of `template`, whose fields already have their final sizes so
    /// that filling them allocates nothing.
    pub fn new(n_frames: usize, template: &Frame) -> Self {
        Self {
            frames: (0..n_frames).map(|_| Arc::new(template.clone())).collect(),
            next: 0,
        }
    }

    /// Fills a frame that nobody holds any more and shares it.
    pub fn fill(&mut self, write: impl FnOnce(&mut Frame)) -> Arc<Frame> {
        let slot = self.free_slot();
        if let Some(frame) = Arc::get_mut(&mut self.frames[slot]) {
            write(frame);
        }
        Arc::clone(&self.frames[slot])
    }

    /// A slot of which the pool is the only owner. The search goes round, so that the frame that
    /// was dropped longest ago comes first and usually the first look finds one.
    fn free_slot(&mut self) -> usize {
        let n = self.frames.len();
        for offset in 0..n {
            let slot = (self.next + offset) % n;
            if Arc::get_mut(&mut self.frames[slot]).is_some() {
                self.next = (slot + 1) % n;
                return slot;
            }
        }
        let template = self
            .frames
            .first()
            .map(|frame| Frame::clone(frame))
            .unwrap_or_default();
        self.frames.push(Arc::new(template));
        n
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn template() -> Frame {
        Frame {
            pressure_pa: vec![0.0; 9],
            ..Frame::default()
        }
    }

    #[test]
    fn frames_come_back_when_dropped() {
        let mut pool = FramePool::new(2, &template());
        let mut seen = Vec::new();
        for step in 0..10 {
            let frame = pool.fill(|frame| frame.step = step);
            assert_eq!(frame.step, step);
            seen.push(frame.pressure_pa.as_ptr());
        }
        seen.sort_unstable();
        seen.dedup();
        assert_eq!(seen.len(), 2, "the same two buffers are used");
        assert_eq!(pool.frames.len(), 2);
    }

    #[test]
    fn a_held_frame_is_never_written_again() {
        let mut pool = FramePool::new(1, &template());
        let held = pool.fill(|frame| frame.step = 1);
        let other = pool.fill(|frame| frame.step = 2);
        assert_eq!((held.step, other.step), (1, 2));
        assert_eq!(pool.frames.len(), 2);
        drop(held);
        let third = pool.fill(|frame| frame.step = 3);
        assert_eq!((other.step, third.step), (2, 3));
        assert_eq!(pool.frames.len(), 2);
    }
}
