//! A passage that repeats: its replay, and the material point.

use std::sync::Arc;
use std::time::Duration;

use super::data::{Effect, PointNow};
use super::state::App;
use crate::tui::kinds::{AutoReplay, RunPace};
use crate::tui::replay::{Replay, ReplayMotion};
use crate::tui::trace::{Chosen, Trace, TraceSample};
use asperity_engine::sim::{Follow, Rhythm};
use asperity_session::run::{Command, Settled};

impl App {
    /// Takes what the run says of a passage that repeats; `None`: it does not (any more).
    pub fn take_settled(&mut self, settled: Option<Arc<Settled>>) -> Vec<Effect> {
        // A knob was turned: until the run has heard of it, it still tells of the passage that was left.
        let settled = settled.filter(|new| {
            !(self.replay.settled_before.as_ref()).is_some_and(|old| Arc::ptr_eq(old, new))
        });
        match (&self.replay.settled, settled) {
            (None, None) => Vec::new(),
            (Some(old), Some(new)) if Arc::ptr_eq(old, &new) => Vec::new(),
            (_, None) => {
                self.replay.settled = None;
                Vec::new()
            }
            (_, Some(new)) => {
                let is_last = new.is_last;
                self.replay.settled = Some(new);
                let replays = self.replay.auto == AutoReplay::On;
                let runs = self.run.pace == RunPace::Running;
                // On the first mesh already: it is the one that sweeps are made on.
                let mut effects = match self.lives.sweep {
                    None => self.begin_sweep(),
                    Some(_) => Vec::new(),
                };
                if !is_last {
                    // The run goes on to a finer mesh meanwhile.
                    if replays && runs {
                        self.replay_settled();
                    }
                } else if replays && runs {
                    effects.extend(self.begin_replay());
                }
                effects
            }
        }
    }

    /// Lets time go by: the replay goes on, the tour follows.
    pub fn advance(&mut self, wall: Duration) -> Vec<Effect> {
        let Some(replay) = &mut self.replay.playing else {
            return Vec::new();
        };
        replay.advance(wall.as_secs_f64());
        self.retrace();
        self.tour_on()
    }

    /// Passages of 4 a since the start, those of a replay too.
    pub(super) fn passages(&self) -> f64 {
        let newest = self.run.frames.back().map_or(0.0, |frame| frame.passages);
        let replayed = self.replay.playing.as_ref().map_or(0.0, Replay::passages);
        self.run.passages_before + newest + replayed
    }

    /// Replays what has settled, while the run rests where it is on its last mesh.
    fn begin_replay(&mut self) -> Vec<Effect> {
        let is_last = (self.replay.settled.as_ref()).is_some_and(|settled| settled.is_last);
        if self.replay_settled() && is_last {
            self.paused_first()
        } else {
            Vec::new()
        }
    }

    /// Whether there is something to replay.
    fn replay_settled(&mut self) -> bool {
        let replay = self.replay.settled.clone().and_then(Replay::new);
        let Some(replay) = replay else {
            // On a finer mesh nothing moves that moved on a coarser one.
            self.replay.playing = None;
            return false;
        };
        self.run.frames_back = 0;
        if let Some(coarser) = self.replay.playing.replace(replay) {
            // The lesson's time does not go back.
            self.run.passages_before += coarser.passages();
        }
        self.retrace();
        true
    }

    /// Back to the run, which goes on.
    pub(super) fn end_replay(&mut self) -> Vec<Effect> {
        if self.replay.playing.take().is_none() {
            return Vec::new();
        }
        self.replay.trace = Trace::default();
        match self.run.pace {
            RunPace::Running => Vec::new(),
            RunPace::Paused => {
                self.run.pace = RunPace::Running;
                vec![Effect::Send(Command::Pause)]
            }
        }
    }

    /// What a knob that is turned ends.
    pub(super) fn unsettle(&mut self) -> Vec<Effect> {
        let mut effects = self.end_replay();
        if let Some(settled) = self.replay.settled.take() {
            self.replay.settled_before = Some(settled);
        }
        self.replay.auto = AutoReplay::On;
        // Whether one goes on is known one drawing later only: what it finds would be of the old knobs.
        self.lives.sweep = None;
        self.lives.swept.clear();
        self.lives.assumed.clear();
        effects.push(Effect::EndSweep);
        effects
    }

    pub(super) fn toggle_replay(&mut self) -> Vec<Effect> {
        if self.replay.playing.is_some() {
            self.replay.auto = AutoReplay::Off;
            return self.end_replay();
        }
        let effects = self.begin_replay();
        if self.replay.playing.is_none() {
            let repeats = self
                .frame()
                .and_then(|frame| frame.metrics.repeat)
                .filter(|repeat| repeat.repeats);
            self.say(match repeats.map(|repeat| repeat.rhythm) {
                None => "no replay yet: the passage does not repeat",
                Some(Rhythm::Orbit) => "the passage repeats; one whole period is gathered first",
                Some(Rhythm::Steady) => "nothing changes in time: there is nothing to replay",
                Some(Rhythm::Statistics) => {
                    "no replay: only the means have settled, no period is common to both bodies"
                }
            });
        }
        effects
    }

    pub(super) fn replay_faster(&mut self, times: i32) -> Vec<Effect> {
        let Some(replay) = &mut self.replay.playing else {
            return self.age_faster(times);
        };
        replay.faster(times);
        Vec::new()
    }

    /// Pause and single frames of a replay; false: there is none.
    pub(super) fn replay_stepped(&mut self, frames: i32) -> bool {
        let Some(replay) = &mut self.replay.playing else {
            return false;
        };
        match frames {
            0 => replay.toggle(),
            n => replay.step(n),
        }
        self.retrace();
        true
    }

    /// Whether a replay stands.
    pub fn replay_stands(&self) -> bool {
        self.replay
            .playing
            .as_ref()
            .is_some_and(|replay| replay.motion() == ReplayMotion::Frozen)
    }

    /// The point that was chosen; before that the one that the run shows, of the body that governs.
    fn aimed(&self) -> Chosen {
        let shown = self.frame().and_then(|frame| {
            let (point, slice) = (frame.material_point?, frame.slice.as_ref()?);
            let above = |z: &&f64| **z < point.depth_m * (1.0 - 1e-6);
            let governing = frame.metrics.life.map(|life| life.detail.body);
            Some(Chosen {
                body: governing.filter(|body| *body > 0).unwrap_or(point.body),
                depth: slice.depths_m.iter().take_while(above).count(),
                place_m: 0.0,
            })
        });
        self.replay.point.or(shown).unwrap_or_default()
    }

    fn retrace(&mut self) {
        let point = self.aimed();
        let Some(replay) = &self.replay.playing else {
            return;
        };
        let trace = Trace::replayed(replay.settled(), point, replay.at_s());
        self.replay.trace = trace.unwrap_or_default();
    }

    pub(super) fn other_body(&mut self) -> Vec<Effect> {
        let mut point = self.aimed();
        point.body = 3 - point.body;
        self.replay.point = Some(point);
        self.followed(None)
    }

    pub(super) fn point_depth(&mut self, by: i32) -> Vec<Effect> {
        let last = self.depths().saturating_sub(1) as i32;
        let mut point = self.aimed();
        point.depth = (point.depth as i32 + by).clamp(0, last) as usize;
        self.replay.point = Some(point);
        self.followed(None)
    }

    /// The point that is so many quarters of a further on, now.
    pub(super) fn move_point(&mut self, quarters: i32) -> Vec<Effect> {
        let Some(frame) = self.frame() else {
            return Vec::new();
        };
        let by_m = 0.25 * f64::from(quarters) * frame.a_m;
        let here = self
            .replay
            .trace
            .current()
            .last()
            .map_or(0.0, |sample| sample.x_m);
        self.put_point_m(here + by_m)
    }

    /// The point that is at x/a now.
    pub(super) fn put_point(&mut self, x: f64) -> Vec<Effect> {
        let a_m = self.frame().map_or(0.0, |frame| frame.a_m);
        self.put_point_m(x * a_m)
    }

    fn put_point_m(&mut self, x_m: f64) -> Vec<Effect> {
        let here = self.replay.trace.current().last().map(|sample| sample.x_m);
        if let (Some(replay), Some(here)) = (&self.replay.playing, here) {
            // Bodies that run towards −x enter on the other side.
            let heading = replay.frame().metrics.entrainment_m_s.signum();
            let mut point = self.aimed();
            point.place_m += heading * (x_m - here);
            self.replay.point = Some(point);
        }
        self.followed(Some(x_m))
    }

    fn depths(&self) -> usize {
        let slice = self.frame().and_then(|frame| frame.slice.as_ref());
        slice.map_or(0, |slice| slice.depths_m.len())
    }

    /// Tells the run which point is followed.
    fn followed(&mut self, x_m: Option<f64>) -> Vec<Effect> {
        self.retrace();
        let point = self.aimed();
        let slice = self.frame().and_then(|frame| frame.slice.as_ref());
        let Some(depth_m) = slice.and_then(|s| s.depths_m.get(point.depth).copied()) else {
            self.say("no stress is computed, so only the pressure can be followed");
            return Vec::new();
        };
        let body = point.body;
        vec![Effect::Send(Command::Follow(Follow { body, depth_m, x_m }))]
    }

    /// The material point on the screen, as it is now: the run's, or that of the replay.
    pub fn point_now(&self) -> Option<PointNow> {
        let frame = self.frame()?;
        let metrics = &frame.metrics;
        let of_body = |body: u8| match body {
            2 => (metrics.n_body_2, metrics.n_counted_body_2),
            _ => (metrics.n_body_1, metrics.n_counted_body_1),
        };
        if let (Some(_), Some(whole)) = (&self.replay.playing, self.replay.trace.counted()) {
            let sample = *self.replay.trace.current().last()?;
            let (body, depth_m) = self.replay.trace.point();
            let (expected, average) = of_body(body);
            return Some(PointNow {
                body,
                depth_m,
                sample,
                expected,
                average,
                closed: Some(whole),
            });
        }
        let point = frame.material_point?;
        let (expected, average) = of_body(point.body);
        Some(PointNow {
            body: point.body,
            depth_m: point.depth_m,
            sample: TraceSample::of(&point),
            expected,
            average,
            closed: point.cycles_before,
        })
    }
}
