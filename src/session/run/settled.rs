//! A passage that has become periodic: one period of frames for replay, and the state it can go on from.
//!
//! ```text
//! frames of the last T ──> Repeat::repeats ──> Settled { frames, T, state }        a knob is turned: gone
//! ```
//! On the coarser meshes of a ladder a settled life is enough ([`Closing`]). Where no common period exists (only the means have settled) or nothing moves there is one frame only. So it is, until
//! the period closes, where the life has long been settled: on a coarse mesh with few steps a crest the fields may never
//! compare closely enough.

use std::collections::VecDeque;
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

/// Keeps the last period.
#[derive(Debug, Default)]
pub(super) struct Gather {
    /// The oldest first.
    frames: VecDeque<Arc<Frame>>,
    /// Frames seen, and the time of the last one.
    seen: usize,
    last_s: f64,
    /// Whether a period has been seen since the first.
    is_whole: bool,
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
        if self.is_done {
            return None;
        }
        let metrics = &frame.metrics;
        let moves = frame.stage == Stage::Passage && metrics.converged;
        let known = metrics.repeat.filter(|_| moves);
        let orbit = known.filter(|repeat| repeat.rhythm == Rhythm::Orbit);
        if orbit.is_none() {
            self.begin_anew();
        }
        let is_whole = orbit.is_some_and(|orbit| self.keep(frame, orbit.period_s));
        let repeat = known.filter(|repeat| match closing {
            Closing::Fields => repeat.repeats,
            Closing::Life => repeat.repeats || metrics.life.is_some(),
        });
        let holds = moves && metrics.life.is_none_or(|life| life.settled);
        match repeat.filter(|_| holds) {
            Some(repeat) if repeat.rhythm == Rhythm::Orbit => is_whole.then(|| {
                let frames = std::mem::take(&mut self.frames);
                self.whole(frames.into(), repeat.period_s, save())
            }),
            Some(_) => Some(self.whole(vec![copy(frame)], 0.0, save())),
            None => self.wait(frame, holds, save),
        }
    }

    fn begin_anew(&mut self) {
        self.frames.clear();
        (self.seen, self.is_whole) = (0, false);
    }

    /// Keeps a frame and those of the period before it; whether that is whole.
    fn keep(&mut self, frame: &Arc<Frame>, period_s: f64) -> bool {
        let step_s = (frame.time_s - self.last_s).max(f64::MIN_POSITIVE);
        let bytes = period_s / step_s * bytes(frame) as f64;
        let every = (bytes / MOST_BYTES as f64).ceil().max(1.0) as usize;
        if self.seen.is_multiple_of(every) {
            self.frames.push_back(copy(frame));
        }
        (self.seen, self.last_s) = (self.seen + 1, frame.time_s);
        // The one a period ago is this one again.
        let is_past = |kept: &Arc<Frame>| kept.time_s <= frame.time_s - period_s * (1.0 - 1e-9);
        while self.frames.front().is_some_and(is_past) {
            self.frames.pop_front();
            self.is_whole = true;
        }
        self.is_whole
    }

    /// No period: gives one frame where that has gone on for long.
    fn wait(
        &mut self,
        frame: &Arc<Frame>,
        holds: bool,
        save: impl FnOnce() -> Option<State>,
    ) -> Option<Settled> {
        let since = self.waits_since.unwrap_or(frame.passages);
        self.waits_since = holds.then_some(since);
        self.gave_up &= holds;
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

    /// Steps of the periods that 40 frames leave, which repeat after the `first`; one of them did not converge.
    fn periods(first: u64, failed: u64) -> Vec<Vec<u64>> {
        let mut gather = Gather::default();
        let take = |step| {
            let mut frame = Frame::clone(&frame(step, step > first, Rhythm::Orbit));
            frame.metrics.converged = step != failed;
            let settled = gather.take(&Arc::new(frame), Closing::Fields, || None)?;
            assert_eq!(settled.period_s, 7.0);
            Some(settled.frames.iter().map(|frame| frame.step).collect())
        };
        (1..40).filter_map(take).collect()
    }

    #[test]
    fn the_period_before_the_passage_repeats_is_given_once() {
        assert_eq!(periods(20, 0), [[15, 16, 17, 18, 19, 20, 21]]);
        // As soon as there is a whole one, and one after what did not converge.
        assert_eq!(periods(4, 0), [[2, 3, 4, 5, 6, 7, 8]]);
        assert_eq!(periods(20, 18), [[20, 21, 22, 23, 24, 25, 26]]);
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
        assert_eq!(firsts.collect::<Vec<_>>(), [(110, 1), (195, 7)]);
    }

    #[test]
    fn means_leave_one_frame() {
        let mut gather = Gather::default();
        let settled = gather.take(
            &frame(41, true, Rhythm::Statistics),
            Closing::Fields,
            || None,
        );
        let settled = settled.expect("the means have settled");
        assert_eq!((settled.frames.len(), settled.period_s), (1, 0.0));
    }
}
