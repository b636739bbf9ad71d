//! What is asked of the loop: by hand, by the run that is repeated, by the scene's script.

use std::sync::mpsc::TryRecvError;

use super::{Driver, LoopState, LoopTurn, PausedWait};
use crate::run::Command;
use crate::run::outcome::{AppliedCommand, End};
use asperity_engine::observe::{RunEventKind, SetBy};
use asperity_engine::sim::{Knob, Simulation, Stage};

impl Driver {
    /// Does what was done at this place in the run that is repeated.
    pub(super) fn repeat_turns(&mut self, sim: &mut Simulation) {
        while self
            .turns
            .front()
            .is_some_and(|(made, _)| *made <= self.made)
        {
            if let Some((_, command)) = self.turns.pop_front() {
                self.carry_out(sim, command);
            }
        }
    }

    /// Takes all commands that wait; while paused, waits for them where it may. Gives what the turn came to when no step
    /// follows.
    pub(super) fn obey(&mut self, sim: &mut Simulation, waiting: PausedWait) -> Option<LoopTurn> {
        loop {
            let is_paused = self.pace == LoopState::Paused;
            let command = if is_paused && waiting == PausedWait::Allowed {
                self.inbox.recv().map_err(|_| TryRecvError::Disconnected)
            } else {
                self.inbox.try_recv()
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
                other => self.carry_out(sim, other),
            }
        }
    }

    /// What leaves the pace alone, and what a run that is repeated does again.
    fn carry_out(&mut self, sim: &mut Simulation, command: Command) {
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

    fn log(&mut self, sim: &Simulation, command: Command, by: SetBy) {
        self.applied.push(AppliedCommand {
            steps_made: self.made,
            by,
            step: sim.passage_steps(),
            time_s: sim.time_s(),
            command,
        });
    }

    fn set(&mut self, sim: &mut Simulation, knob: Knob, value: f64, by: SetBy) {
        match sim.set(knob, value) {
            Ok(()) => {
                self.log(sim, Command::Set(knob, value), by);
                self.n_turned_by_hand += usize::from(by == SetBy::Hand);
                self.forget_settled();
                let kind = RunEventKind::Set {
                    key: knob.key().to_owned(),
                    value,
                    by,
                    steps_made: self.made,
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
}
