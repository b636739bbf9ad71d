//! What a run gives out after a step: frames, events, status, a period that repeats.

use std::sync::Arc;

use super::{Driver, Shown};
use crate::run::clock::Clock;
use crate::run::outcome::{End, Outcome, Unconverged};
use crate::run::request::Ending;
use crate::run::settled::{Closing, Gather, PATIENCE};
use asperity_engine::observe::{RunEvent, RunEventKind};
use asperity_engine::sim::{Frame, LubricationRegime, Simulation, Stage, Unsolved};

impl Driver {
    pub(super) fn judge_step(&mut self, sim: &Simulation) {
        let metrics = sim.metrics();
        // A start-up that did not converge is told too: what follows stands on it. On the coarser meshes of a ladder only
        // the way to the last one is made.
        if metrics.converged || !self.is_on_top() {
            return;
        }
        let residual = metrics.residual;
        self.n_unconverged += 1;
        if self.unconverged.len() < Outcome::UNCONVERGED_KEPT {
            self.unconverged.push(Unconverged {
                step: self.steps_shown(sim),
                time_s: self.time_shown_s(sim),
                unsolved: Unsolved {
                    residual,
                    residual_asked: metrics.asked[0],
                    film_error: metrics.film_error,
                    film_error_asked: metrics.asked[1],
                    dry: metrics.regime == LubricationRegime::Dry,
                },
                overlap_m: metrics.overlap_m,
            });
        }
        self.announce(sim, RunEventKind::NotConverged { residual });
    }

    /// Another mesh: what has settled on the last one is shown until this one has.
    pub(in crate::run) fn begin_gathering(&mut self) {
        (self.has_settled, self.waits_since) = (false, 0.0);
        if let Some(gather) = &mut self.gather {
            *gather = Gather::default();
        }
    }

    /// Before the first mesh goes on: the outputs' steps and times do not begin again.
    pub(in crate::run) fn leave_top(&mut self, sim: &Simulation) {
        if self.is_on_top() {
            let Shown {
                steps,
                time_s,
                passages,
            } = &mut self.shown_before;
            *steps += sim.passage_steps();
            *time_s += sim.time_s();
            *passages += sim.passages();
        }
    }

    /// Steps that outputs have been given.
    pub(super) fn steps_shown(&self, sim: &Simulation) -> u64 {
        let on_this = if self.is_on_top() {
            sim.passage_steps()
        } else {
            0
        };
        self.shown_before.steps + on_this
    }

    /// Simulated time that outputs have been given, s.
    pub(super) fn time_shown_s(&self, sim: &Simulation) -> f64 {
        let on_this = if self.is_on_top() { sim.time_s() } else { 0.0 };
        self.shown_before.time_s + on_this
    }

    pub(in crate::run) fn begin_outputs(&mut self) {
        self.outputs.begin(&self.context);
    }

    /// Gives the step to the screen, and to the outputs if it belongs to the results.
    pub(super) fn hand_out(&mut self, sim: &Simulation) {
        let (on_top, before) = (self.is_on_top(), self.shown_before);
        let mut life = sim.metrics().life;
        // The mesh below has aged; what is still on the way there does not differ from it by the mesh alone.
        if let Some(life) = life.as_mut().filter(|_| !sim.is_ageing()) {
            self.widen(life);
        }
        let frame = self.pool.fill(|frame| {
            sim.fill(frame);
            frame.metrics.life = life;
            if on_top && frame.stage == Stage::Passage {
                frame.step += before.steps;
                frame.time_s += before.time_s;
                frame.passages += before.passages;
            }
        });
        if frame.stage == Stage::Passage && on_top {
            self.passage_began.get_or_insert_with(Clock::start);
            self.outputs.frame(&frame);
        }
        self.gather_frame(sim, &frame, on_top);
        if self.shows(sim, &frame) {
            self.link.latest.put(frame);
        }
    }

    /// Whether a frame is for the screen: the start-up of a finer mesh shows nothing that the coarser one has not shown, and
    /// until its life has settled, and its surfaces are as old, the one that has is not taken away; but not for ever.
    fn shows(&self, sim: &Simulation, frame: &Frame) -> bool {
        if self.climb.rungs.is_empty() {
            return true;
        }
        let has_life = self.context.scene.life.is_some();
        let settled = frame.metrics.life.is_some_and(|life| life.settled);
        let has_settled = self.has_settled || settled || !has_life;
        let is_live = self.gather.is_some();
        let waited = frame.passages - self.waits_since >= PATIENCE;
        frame.stage == Stage::Passage && (has_settled || !is_live || waited && !sim.is_ageing())
    }

    /// Looks for a period of a live run; on a coarser mesh for one with a settled life, or the time that it has.
    /// While surfaces age nothing repeats; a finer mesh begins them anew once they have.
    pub(super) fn gather_frame(&mut self, sim: &Simulation, frame: &Arc<Frame>, on_top: bool) {
        let Some(gather) = self.gather.as_mut() else {
            return;
        };
        if sim.is_ageing() {
            self.waits_since = frame.passages;
            return;
        }
        let closing = if on_top {
            Closing::Fields
        } else {
            Closing::Life
        };
        if let Some(mut settled) = gather.take(frame, closing, || Some(sim.save().for_neighbour()))
        {
            settled.is_last = on_top;
            settled.ground = match (&self.ladder, &self.ground) {
                (Some(ladder), Some(ground)) => ladder.ground(ground),
                (Some(ladder), None) => ladder.ground(sim),
                (None, _) => None,
            };
            self.link.lock().settled = Some(Arc::new(settled));
            self.has_settled = true;
        }
        self.has_settled |= !on_top && frame.passages - self.waits_since >= PATIENCE;
    }

    /// Tells the outputs; what happens on a coarser mesh happens again on the last.
    pub(super) fn announce(&mut self, sim: &Simulation, kind: RunEventKind) {
        if !self.is_on_top() && self.ending == Ending::Passages {
            return;
        }
        let event = RunEvent {
            step: self.steps_shown(sim),
            time_s: self.time_shown_s(sim),
            kind,
        };
        self.outputs.event(&event);
    }

    pub(super) fn must_end_for_outputs(&self) -> bool {
        self.ending != Ending::OnStop && !self.outputs.errors.is_empty()
    }

    pub(in crate::run) fn publish_rungs(&self) {
        let mut shared = self.link.lock();
        shared.status.rungs.clone_from(&self.climb.rungs);
    }

    pub(super) fn publish_status(&self, sim: &Simulation) {
        let (nodes, is_on_top) = (self.climb.nodes, self.is_on_top());
        let progress = (self.ladder.as_ref()).map_or(sim.progress(), |ladder| {
            ladder.progress(nodes, sim.progress())
        });
        let mut shared = self.link.lock();
        let status = &mut shared.status;
        status.stage = sim.stage();
        status.progress = progress;
        status.nodes = nodes;
        status.climbs = self.ladder.is_some();
        let is_on_the_way = !self.climb.rungs.is_empty() && !self.has_settled;
        status.finer = is_on_the_way.then(|| (nodes, sim.progress()));
        status.steps = if is_on_top { sim.passage_steps() } else { 0 };
        status.n_unconverged = self.n_unconverged;
        status.outputs.clear();
        status.outputs.extend(self.outputs.statuses());
    }

    pub(in crate::run) fn publish_failure(&self, end: &End) {
        let failure = match end {
            End::Stalled(error) => error.to_string(),
            End::NotStarted(error) => error.to_string(),
            End::OutputFailed => "an output failed".to_owned(),
            End::Done | End::Stopped => return,
        };
        self.link.lock().status.failure = Some(failure);
    }
}
