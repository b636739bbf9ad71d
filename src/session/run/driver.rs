//! The loop itself: commands, script, step, frames, in this order, on the simulation's thread.

mod obeying;
mod telling;

use std::collections::VecDeque;
use std::sync::mpsc::Receiver;
use std::sync::{Arc, Mutex};

use super::Command;
use super::checkpoint::Checkpoint;
use super::clock::Clock;
use super::outcome::{AppliedCommand, End, Outcome, Unconverged};
use super::settled::Gather;
use super::shared::{Ending, SharedStatus, lock};
use super::watcher::Watcher;
use crate::{FramePool, Latest};
use asperity_engine::observe::{ObserveError, RunContext, RunEventKind};
use asperity_engine::scene::{Event, Scene};
use asperity_engine::sim::{Frame, LubricationRegime, SimError, Simulation, StepError, Unsolved};

/// Frames that the pool starts with: one shown, one in the making, a few in the recorder's queue.
const FRAMES: usize = 6;

/// Whether the loop steps.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum LoopState {
    Running,
    Paused,
    /// Paused, after one more step.
    OneStep,
}

/// What one turn of the loop came to.
#[derive(Debug, Clone)]
pub enum LoopTurn {
    /// A step was made and handed out.
    Stepped,
    /// Nothing: it is paused, and no command came.
    Waited,
    /// The run has ended.
    Ended(End),
}

/// Whether the loop may wait for a command.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum PausedWait {
    /// While paused it does.
    Allowed,
    /// It returns: its thread has other things to do.
    Never,
}

/// What another run had done before this one goes on.
#[derive(Debug, Clone, Copy, Default)]
pub(super) struct Done {
    pub(super) events_played: usize,
    pub(super) turned_by_hand: usize,
    pub(super) unconverged: u64,
}

/// Makes one time step: [`Simulation::step`], or in tests one that fails on purpose.
pub(super) type MakeStep = Box<dyn FnMut(&mut Simulation) -> Result<(), StepError> + Send>;

/// The loop's own state, on the simulation's thread.
pub(super) struct Driver {
    make_step: MakeStep,
    ending: Ending,
    /// Steps of the whole run; `None`: it has no end.
    steps_planned: Option<u64>,
    watchers: Vec<Watcher>,
    script: VecDeque<Event>,
    /// What was done by hand in the run that is repeated, with the steps made by then.
    turns: VecDeque<(u64, Command)>,
    /// Steps made, those of the start-up too.
    made: u64,
    inbox: Receiver<Command>,
    latest: Latest,
    shared: Arc<Mutex<SharedStatus>>,
    pool: FramePool,
    /// Of live runs: one period, once the passage repeats.
    gather: Option<Gather>,
    pace: LoopState,
    applied: Vec<AppliedCommand>,
    unconverged: Vec<Unconverged>,
    n_unconverged: u64,
    output_errors: Vec<ObserveError>,
    n_events_played: usize,
    n_turned_by_hand: usize,
    /// When the first step of the passage was done.
    passage_began: Option<Clock>,
}

impl Driver {
    pub(super) fn new(
        ending: Ending,
        watchers: Vec<Watcher>,
        events: &[Event],
        inbox: Receiver<Command>,
        latest: Latest,
        shared: Arc<Mutex<SharedStatus>>,
    ) -> Self {
        let mut script = events.to_vec();
        script.sort_by(|one, two| one.at_s.total_cmp(&two.at_s));
        Self {
            make_step: Box::new(Simulation::step),
            ending,
            steps_planned: None,
            watchers,
            script: script.into(),
            turns: VecDeque::new(),
            made: 0,
            inbox,
            latest,
            shared,
            pool: FramePool::new(FRAMES, &Frame::default()),
            gather: (ending == Ending::OnStop).then(Gather::default),
            pace: LoopState::Running,
            applied: Vec::new(),
            unconverged: Vec::new(),
            n_unconverged: 0,
            output_errors: Vec::new(),
            n_events_played: 0,
            n_turned_by_hand: 0,
            passage_began: None,
        }
    }

    /// Goes on where another run ended: what it has done is not done again.
    pub(super) fn after(mut self, done: Done) -> Self {
        let played = done.events_played.min(self.script.len());
        self.script.drain(..played);
        self.n_events_played = done.events_played;
        self.n_turned_by_hand = done.turned_by_hand;
        self.n_unconverged = done.unconverged;
        self
    }

    /// Says how many steps the scene's plan has, where it is the plan that ends the run.
    pub(super) fn planned(mut self, steps: u64) -> Self {
        self.steps_planned = match self.ending {
            Ending::Passages => Some(steps),
            Ending::Steps(last) => Some(last),
            Ending::OnStop => None,
        };
        self
    }

    /// Steps otherwise.
    pub(super) fn stepping_by(mut self, make_step: MakeStep) -> Self {
        self.make_step = make_step;
        self
    }

    /// Does again what was done by hand in another run: each command with the steps made by then.
    pub(super) fn repeating(mut self, turns: Vec<(u64, Command)>) -> Self {
        self.turns = turns.into();
        self
    }

    /// The whole run, from opening the outputs to closing them.
    pub(super) fn run(
        mut self,
        context: &RunContext,
        name: &str,
        make: impl FnOnce(&Scene) -> Result<Simulation, SimError>,
    ) -> Outcome {
        let started = Clock::start();
        // Outputs first: a path that cannot be written must not cost a start-up.
        self.begin_outputs(context);
        let mut summary = None;
        let mut steps = 0;
        let mut steps_per_s = None;
        let mut checkpoint = None;
        let end = if self.must_end_for_outputs() {
            End::OutputFailed
        } else {
            match make(&context.scene) {
                Err(error) => End::NotStarted(error),
                Ok(mut sim) => {
                    let end = sim.inside(|sim| self.drive(sim));
                    steps = sim.passage_steps();
                    steps_per_s = self
                        .passage_began
                        .filter(|_| steps > 1)
                        .map(|began| (steps - 1) as f64 / began.elapsed_s().max(1e-9));
                    summary = (steps > 0).then(|| sim.summary());
                    checkpoint = Some(self.checkpoint(context, &sim));
                    end
                }
            }
        };
        // A run without an end of its own is ended by whoever says stop.
        let stopped = matches!(end, End::Stopped) && self.ending != Ending::OnStop;
        self.tell_failure(&end);
        let reports = self.finish_outputs();
        let wall_s = started.elapsed_s();
        if let Some(summary) = &mut summary {
            name.clone_into(&mut summary.scene);
            summary.wall_s = wall_s;
            summary.steps_per_s = steps_per_s;
            summary.steps = steps;
            summary.steps_planned = self.steps_planned;
            summary.stopped = stopped;
            summary.steps_not_converged = self.n_unconverged;
            summary.converged = self.n_unconverged == 0 && !matches!(end, End::Stalled(_));
        }
        Outcome {
            end,
            stopped,
            summary,
            steps,
            steps_planned: self.steps_planned,
            unconverged: self.unconverged,
            n_unconverged: self.n_unconverged,
            applied: self.applied,
            reports,
            output_errors: self.output_errors,
            checkpoint,
            wall_s,
            steps_per_s,
        }
    }

    fn checkpoint(&self, context: &RunContext, sim: &Simulation) -> Box<Checkpoint> {
        Box::new(Checkpoint {
            program: context.program.clone(),
            scene: context.scene_toml.clone(),
            n_events_played: self.n_events_played,
            n_unconverged: self.n_unconverged,
            n_turned_by_hand: self.n_turned_by_hand,
            stats: *sim.stats(),
            sim: sim.save(),
        })
    }

    /// Steps until something ends the run.
    fn drive(&mut self, sim: &mut Simulation) -> End {
        if self.has_ended(sim) {
            // Taken up where all that is asked for had been done.
            return End::Done;
        }
        loop {
            if let LoopTurn::Ended(end) = self.turn(sim, PausedWait::Allowed) {
                return end;
            }
        }
    }

    /// Commands, script, one step, its frame.
    pub(super) fn turn(&mut self, sim: &mut Simulation, waiting: PausedWait) -> LoopTurn {
        self.repeat_turns(sim);
        if let Some(turn) = self.obey(sim, waiting) {
            return turn;
        }
        self.play_script(sim);
        if let Err(error) = (self.make_step)(sim) {
            return LoopTurn::Ended(End::Stalled(error));
        }
        self.made += 1;
        if self.pace == LoopState::OneStep {
            self.pace = LoopState::Paused;
        }
        self.judge_step(sim);
        self.hand_out(sim);
        self.tell_status(sim);
        if self.must_end_for_outputs() {
            return LoopTurn::Ended(End::OutputFailed);
        }
        if self.has_ended(sim) {
            return LoopTurn::Ended(End::Done);
        }
        LoopTurn::Stepped
    }

    fn has_ended(&self, sim: &Simulation) -> bool {
        match self.ending {
            Ending::Passages => sim.is_done(),
            Ending::Steps(steps) => sim.passage_steps() >= steps,
            Ending::OnStop => false,
        }
    }

    fn judge_step(&mut self, sim: &Simulation) {
        let metrics = sim.metrics();
        // A start-up that did not converge is told too: what follows stands on it.
        if metrics.converged {
            return;
        }
        let residual = metrics.residual;
        self.n_unconverged += 1;
        if self.unconverged.len() < Outcome::UNCONVERGED_KEPT {
            self.unconverged.push(Unconverged {
                step: sim.passage_steps(),
                time_s: sim.time_s(),
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

    /// A knob was turned: what had settled is past.
    fn forget_settled(&mut self) {
        if let Some(gather) = &mut self.gather {
            *gather = Gather::default();
            lock(&self.shared).settled = None;
        }
    }
}
