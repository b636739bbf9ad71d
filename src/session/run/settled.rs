//! A passage that has become periodic: one period of frames for replay, and the state it can go on from.
//!
//! ```text
//! Repeat::repeats ──> gather frames over T ──> Settled { frames, T, state }        a knob is turned: gone
//! ```
//! On the coarser meshes of a ladder a settled life is enough ([`Closing`]). Where no common period exists (only the means have settled) or nothing moves there is one frame only. So it is, until
//! the period closes, where the life has long been settled: on a coarse mesh with few steps a crest the fields may never
//! compare closely enough.

use std::sync::Arc;

use asperity_engine::scene::Scene;
use asperity_engine::sim::{Frame, Rhythm, Stage, State};

/// Memory that the frames of a period may take, bytes; longer periods keep every second, third, ... frame.
const MOST_BYTES: usize = 128 << 20;

/// Passages of 4 a with a settled life after which a period that does not close is no longer waited for: twice the longest
/// that is looked for.
pub(super) const PATIENCE: f64 = 8.0;

/// What a periodic passage leaves.
#[derive(Debug)]
pub struct Settled {
    /// Frames of one period in order; one where nothing moves or only means have settled.
    pub frames: Vec<Arc<Frame>>,
    /// The period, s; 0 with a single frame.
    pub period_s: f64,
    /// State of the simulation at the last frame, to start others from; `None` where no simulation made the frames.
    pub state: Option<State>,
    /// Whether it is of the scene's own mesh: no finer one follows.
    pub is_last: bool,
    /// The run on its first mesh, for what has to be answered soon; `None`: there is one mesh alone.
    pub ground: Option<(Arc<Scene>, State)>,
}

/// What a period has to bring back.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Closing {
    /// The fields, and a settled life.
    Fields,
    /// A settled life: coarse meshes with few steps a crest may never bring the fields back so closely.
    Life,
}

/// Collects a period.
#[derive(Debug, Default)]
pub(super) struct Gather {
    frames: Vec<Arc<Frame>>,
    /// Frames seen since the period began.
    seen: usize,
    began_s: f64,
    every: usize,
    is_done: bool,
    /// Passages at which the life had settled without a period.
    waits_since: Option<f64>,
    /// Whether one frame was given in place of a period.
    gave_up: bool,
}

impl Gather {
    /// Takes a frame; `Some` once, when the period is whole. `save` gives the state at this frame.
    pub(super) fn take(
        &mut self,
        frame: &Arc<Frame>,
        closing: Closing,
        save: impl FnOnce() -> Option<State>,
    ) -> Option<Settled> {
        let metrics = &frame.metrics;
        let repeat = metrics.repeat.filter(|repeat| match closing {
            Closing::Fields => repeat.repeats,
            Closing::Life => repeat.repeats || metrics.life.is_some(),
        });
        let counted = metrics.life.is_none_or(|life| life.settled);
        let holds = frame.stage == Stage::Passage && metrics.converged && counted;
        if self.is_done {
            return None;
        }
        let Some(repeat) = repeat.filter(|_| holds) else {
            return self.wait(frame, holds, save);
        };
        if repeat.rhythm != Rhythm::Orbit {
            return Some(self.whole(vec![copy(frame)], 0.0, save()));
        }
        if self.seen == 0 {
            self.began_s = frame.time_s;
        }
        if self.seen == 1 {
            let step_s = (frame.time_s - self.began_s).max(f64::MIN_POSITIVE);
            let bytes = repeat.period_s / step_s * bytes(frame) as f64;
            self.every = (bytes / MOST_BYTES as f64).ceil().max(1.0) as usize;
        }
        // The first frame of the next period is the first of this one again.
        if self.seen > 1 && frame.time_s >= self.began_s + repeat.period_s * (1.0 - 1e-9) {
            let frames = std::mem::take(&mut self.frames);
            return Some(self.whole(frames, repeat.period_s, save()));
        }
        if self.seen.is_multiple_of(self.every.max(1)) {
            self.frames.push(copy(frame));
        }
        self.seen += 1;
        None
    }

    /// No period (any more): begins anew, and gives one frame where that has gone on for long.
    fn wait(
        &mut self,
        frame: &Arc<Frame>,
        holds: bool,
        save: impl FnOnce() -> Option<State>,
    ) -> Option<Settled> {
        let since = self.waits_since.unwrap_or(frame.passages);
        *self = Self {
            waits_since: holds.then_some(since),
            gave_up: holds && self.gave_up,
            ..Self::default()
        };
        if !holds || self.gave_up || frame.passages - since < PATIENCE {
            return None;
        }
        self.gave_up = true;
        Some(Settled {
            frames: vec![copy(frame)],
            period_s: 0.0,
            state: save(),
            is_last: true,
            ground: None,
        })
    }

    fn whole(&mut self, frames: Vec<Arc<Frame>>, period_s: f64, state: Option<State>) -> Settled {
        self.is_done = true;
        Settled {
            frames,
            period_s,
            state,
            is_last: true,
            ground: None,
        }
    }
}

/// A frame of its own: one kept for long would make the run's pool of frames grow.
fn copy(frame: &Arc<Frame>) -> Arc<Frame> {
    Arc::new(Frame::clone(frame))
}

fn bytes(frame: &Frame) -> usize {
    let slices = [&frame.slice, &frame.slice_2];
    let stresses: usize = slices
        .into_iter()
        .flatten()
        .map(|slice| slice.effective_pa.len() + slice.tau_xz_pa.len())
        .sum();
    (frame.nx * frame.ny * 5 + stresses) * size_of::<f32>() + frame.contact.len()
}

#[cfg(test)]
mod tests {
    use super::*;
    use asperity_engine::sim::{Metrics, Repeat};

    fn frame(step: u64, repeats: bool, rhythm: Rhythm) -> Arc<Frame> {
        Arc::new(Frame {
            step,
            time_s: step as f64,
            stage: Stage::Passage,
            metrics: Metrics {
                converged: true,
                repeat: Some(Repeat {
                    rhythm,
                    period_s: 7.0,
                    drift: Some(0.0),
                    repeats,
                }),
                ..Metrics::default()
            },
            ..Frame::default()
        })
    }

    #[test]
    fn one_period_is_gathered_once_after_the_passage_repeats() {
        let mut gather = Gather::default();
        let mut found = Vec::new();
        for step in 1..40 {
            let frame = frame(step, step > 4, Rhythm::Orbit);
            found.extend(gather.take(&frame, Closing::Fields, || None));
        }
        let [settled] = &found[..] else {
            panic!("{} periods", found.len());
        };
        let steps: Vec<u64> = settled.frames.iter().map(|frame| frame.step).collect();
        assert_eq!(steps, [5, 6, 7, 8, 9, 10, 11]);
        assert_eq!(settled.period_s, 7.0);
    }

    #[test]
    fn a_period_that_does_not_close_is_not_waited_for_for_ever() {
        let mut gather = Gather::default();
        let mut found = Vec::new();
        // A passage in eight steps; the 45th does not converge; the orbit closes from the 200th on.
        for step in 1..=240 {
            let mut frame = Frame::clone(&frame(step, step > 200, Rhythm::Orbit));
            frame.passages = 0.125 * step as f64;
            frame.metrics.converged = step != 45;
            found.extend(gather.take(&Arc::new(frame), Closing::Fields, || None));
        }
        let firsts = found
            .iter()
            .map(|settled| (settled.frames[0].step, settled.frames.len()));
        assert_eq!(firsts.collect::<Vec<_>>(), [(110, 1), (201, 7)]);
    }

    #[test]
    fn a_break_begins_anew_and_means_leave_one_frame() {
        let mut gather = Gather::default();
        for step in 1..40 {
            let frame = frame(step, step % 5 != 0, Rhythm::Orbit);
            assert!(
                gather.take(&frame, Closing::Fields, || None).is_none(),
                "{step}"
            );
        }
        let settled = gather.take(
            &frame(41, true, Rhythm::Statistics),
            Closing::Fields,
            || None,
        );
        let settled = settled.expect("the means have settled");
        assert_eq!((settled.frames.len(), settled.period_s), (1, 0.0));
    }
}
