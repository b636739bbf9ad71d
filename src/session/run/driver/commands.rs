//! What is asked of a run between two steps: by hand, by its script, by the run that it repeats.

use std::collections::VecDeque;
use std::sync::mpsc::TryRecvError;

use super::{Driver, LoopState, LoopTurn, PausedWait};
use crate::run::command::{AppliedCommand, Command};
use crate::run::outcome::End;
use crate::run::settled::Gather;
use asperity_engine::observe::{RunEventKind, SetBy};
use asperity_engine::scene::Event;
use asperity_engine::sim::{Knob, Simulation, Stage};

impl Driver {
    /// A knob was turned: what had settled is past.
    pub(super) fn forget_settled(&mut self, sim: &Simulation) {
        if let Some(gather) = &mut self.gather {
            *gather = Gather::default();
            (self.has_settled, self.waits_since) = (false, sim.passages());
            self.link.lock().settled = None;
        }
    }

    /// Does what was done at this place in the run that is repeated.
    pub(super) fn repeat_turns(&mut self, sim: &mut Simulation) -> Option<LoopTurn> {
        while self
            .turns
            .front()
            .is_some_and(|turn| turn.steps_made <= self.steps_made)
        {
            let command = self.turns.pop_front()?.command;
            if matches!(command, Command::Set(..)) && self.ground.is_some() {
                self.pending.push(command);
                return Some(LoopTurn::Down);
            }
            self.carry_out(sim, command);
        }
        None
    }

    /// Takes all commands that wait; while paused, waits for them where it may. Gives what the turn came to when no step
    /// follows.
    pub(super) fn obey(&mut self, sim: &mut Simulation, waiting: PausedWait) -> Option<LoopTurn> {
        loop {
            let is_paused = self.pace == LoopState::Paused;
            let command = if is_paused && waiting == PausedWait::Allowed {
                self.link
                    .inbox
                    .recv()
                    .map_err(|_| TryRecvError::Disconnected)
            } else {
                self.link.inbox.try_recv()
            };
            let command = match command {
                Ok(command) => command,
                Err(_) if !is_paused => return None,
                Err(TryRecvError::Empty) => return Some(LoopTurn::Waited),
                // All senders gone while paused: nobody can ever go on.
                Err(TryRecvError::Disconnected) => Command::Stop,
            };
            match command {
                Command::Stop => {
                    self.log(sim, command, SetBy::Hand);
                    return Some(LoopTurn::Ended(End::Stopped));
                }
                Command::Pause => {
                    self.pace = match self.pace {
                        LoopState::Running => LoopState::Paused,
                        LoopState::Paused | LoopState::OneStep => LoopState::Running,
                    };
                    self.log(sim, command, SetBy::Hand);
                }
                Command::StepOnce => {
                    // Without a pause there is nothing to single-step; the next step comes anyway.
                    if self.pace == LoopState::Paused {
                        self.pace = LoopState::OneStep;
                        self.log(sim, command, SetBy::Hand);
                        return None;
                    }
                }
                Command::Set(..) if self.ground.is_some() => {
                    self.pending.push(command);
                    return Some(LoopTurn::Down);
                }
                other => self.carry_out(sim, other),
            }
        }
    }

    /// What leaves the pace alone, and what a run that is repeated does again.
    pub(in crate::run) fn carry_out(&mut self, sim: &mut Simulation, command: Command) {
        match command {
            Command::Set(knob, value) => self.set(sim, knob, value, SetBy::Hand),
            Command::Follow(follow) => {
                sim.show_point(follow);
                self.log(sim, Command::Follow(follow), SetBy::Hand);
            }
            Command::Say(text) => {
                self.log(sim, Command::Say(text.clone()), SetBy::Hand);
                self.announce(sim, RunEventKind::Caption(text));
            }
            Command::Pause | Command::StepOnce | Command::Stop => {}
        }
    }

    pub(super) fn log(&mut self, sim: &Simulation, command: Command, by: SetBy) {
        self.applied.push(AppliedCommand {
            steps_made: self.steps_made,
            by,
            step: self.steps_shown(sim),
            time_s: self.time_shown_s(sim),
            command,
        });
    }

    pub(super) fn set(&mut self, sim: &mut Simulation, knob: Knob, value: f64, by: SetBy) {
        match sim.set(knob, value) {
            Ok(()) => {
                self.log(sim, Command::Set(knob, value), by);
                self.n_turned_by_hand += usize::from(by == SetBy::Hand);
                self.forget_settled(sim);
                // What is gone on from is what the knob makes of it.
                (self.climb.launch, self.climb.widest) = (None, 0.0);
                let kind = RunEventKind::Set {
                    key: knob.key().to_owned(),
                    value,
                    by,
                    steps_made: self.steps_made,
                };
                self.announce(sim, kind);
            }
            // Not done, but told: in words that a run that is repeated says again, as it plays its script again.
            Err(error) if by == SetBy::Hand => self.carry_out(sim, Command::Say(error.to_string())),
            Err(error) => self.announce(sim, RunEventKind::Caption(error.to_string())),
        }
    }

    /// Applies the scripted events whose time has come, in the order of their times.
    pub(super) fn play_script(&mut self, sim: &mut Simulation) {
        while let Some(event) = self.script.front() {
            // At t = 0 the passage begins; before that there is only the start-up.
            let has_begun = event.at_s == 0.0 || sim.stage() == Stage::Passage;
            if !has_begun || event.at_s > sim.time_s() {
                return;
            }
            let Some(event) = self.script.pop_front() else {
                return;
            };
            self.n_events_played += 1;
            for (key, value) in &event.set {
                if let Some(knob) = Knob::from_key(key) {
                    self.set(sim, knob, *value, SetBy::Script);
                }
            }
            if !event.caption.is_empty() {
                self.announce(sim, RunEventKind::Caption(event.caption));
            }
        }
    }

    /// The script of another mesh.
    pub(in crate::run) fn restart_script(&mut self, script: VecDeque<Event>) {
        (self.script, self.n_events_played) = (script, 0);
    }
}
