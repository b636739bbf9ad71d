//! One slot with the newest frame: what a screen reads.

use std::collections::VecDeque;
use std::sync::{Arc, Mutex};

use asperity_engine::sim::{Frame, MaterialPoint};

/// Material points kept for a reader, one a step; the oldest make room.
const POINTS: usize = 4096;

/// One slot that holds the newest frame: a slow reader skips frames and never delays the run. What is too
/// fast to be skipped, the crossing of a material point, is kept step by step.
#[derive(Debug, Default, Clone)]
pub struct Latest {
    slot: Arc<Mutex<Slot>>,
}

#[derive(Debug, Default)]
struct Slot {
    frame: Option<Arc<Frame>>,
    points: VecDeque<MaterialPoint>,
}

impl Latest {
    /// Puts a frame, replacing one that nobody took.
    pub fn put(&self, frame: Arc<Frame>) {
        if let Ok(mut slot) = self.slot.lock() {
            if let Some(point) = frame.material_point {
                if slot.points.len() == POINTS {
                    slot.points.pop_front();
                }
                slot.points.push_back(point);
            }
            slot.frame = Some(frame);
        }
    }

    /// Takes the newest frame, if there is one that was not taken yet.
    pub fn take(&self) -> Option<Arc<Frame>> {
        self.slot.lock().ok().and_then(|mut slot| slot.frame.take())
    }

    /// Moves the material points of all steps since the last call, oldest first, to `points`.
    pub fn take_points(&self, points: &mut Vec<MaterialPoint>) {
        if let Ok(mut slot) = self.slot.lock() {
            points.extend(slot.points.drain(..));
        }
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

    #[test]
    fn no_step_of_a_material_point_is_skipped() {
        let latest = Latest::default();
        for step in 0..5000 {
            latest.put(Arc::new(Frame {
                material_point: Some(MaterialPoint {
                    x_m: f64::from(step),
                    ..MaterialPoint::default()
                }),
                ..Frame::default()
            }));
        }
        let mut points = Vec::new();
        latest.take_points(&mut points);
        assert_eq!(points.len(), POINTS);
        assert_eq!(points.last().map(|point| point.x_m), Some(4999.0));
        assert!(
            points
                .windows(2)
                .all(|pair| pair[1].x_m == pair[0].x_m + 1.0)
        );
    }
}
