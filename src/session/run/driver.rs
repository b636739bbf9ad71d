//! The loop itself: commands, script, step, frames, in this order, on the simulation's thread.

mod commands;
mod outward;

use std::collections::VecDeque;
use std::sync::Arc;
use std::time::Duration;

use super::checkpoint::Checkpoint;
use super::clock::Clock;
use super::command::{AppliedCommand, Command, HandTurn};
use super::handle::RunLink;
use super::ladder::{Climb, Ladder};
use super::outcome::{End, Outcome, Unconverged};
use super::outputs::Outputs;
use super::request::{Ending, Request};
use super::settled::Gather;
use crate::FramePool;
use asperity_engine::observe::{Began, RunContext, RunEventKind};
use asperity_engine::scene::{Event, Scene};
use asperity_engine::sim::{Frame, SimError, Simulation, StepError};

/// Frames that the pool starts with: one shown, one in the making, a few in the recorder's queue.
const FRAMES: usize = 6;

/// How long a run that is held sleeps before it looks again.
const HELD: Duration = Duration::from_millis(2);

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
    /// Nothing more is to be found on this mesh: the next finer one goes on.
    Up,
    /// A knob was turned: the first mesh goes on.
    Down,
    /// The run has ended.
    Ended(End),
}

/// Where a run goes on the steps of one mesh being done.
#[derive(Debug, Clone)]
pub(super) enum Leg {
    Up,
    Down,
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

/// What outputs have been given, before the run went back to its first mesh.
#[derive(Debug, Clone, Copy, Default)]
struct Shown {
    steps: u64,
    time_s: f64,
    passages: f64,
}

/// Makes one time step in place of [`Simulation::step`]: in tests one that fails on purpose.
pub(super) type MakeStep = Box<dyn FnMut(&mut Simulation) -> Result<(), StepError> + Send>;

/// What a run begins with.
#[derive(Default)]
pub(super) struct Start {
    pub(super) began: Began,
    /// Scripted events that another run had played before this one goes on.
    pub(super) n_events_played: usize,
    /// Knobs that had been turned by hand.
    pub(super) n_turned_by_hand: usize,
    /// Steps that had not converged.
    pub(super) n_unconverged: u64,
    /// What was done by hand in the run that is repeated, in the order of the steps made by then.
    pub(super) turns: Vec<HandTurn>,
    /// What makes a step, where it is not the simulation itself.
    pub(super) make_step: Option<MakeStep>,
    /// The meshes that it climbs; `None`: it stays on the scene's own.
    pub(super) ladder: Option<Arc<Ladder>>,
    /// How far it has come on them.
    pub(super) climb: Climb,
}

/// The loop's own state, on the simulation's thread.
pub(super) struct Driver {
    name: String,
    pub(super) context: RunContext,
    make_step: Option<MakeStep>,
    pub(super) ending: Ending,
    /// Steps of the whole run; `None`: it has no end.
    steps_planned: Option<u64>,
    outputs: Outputs,
    script: VecDeque<Event>,
    turns: VecDeque<HandTurn>,
    /// Steps made, those of the start-up too.
    steps_made: u64,
    link: RunLink,
    pool: FramePool,
    /// Of live runs: one period, once the passage repeats.
    gather: Option<Gather>,
    /// Whether it has one on this mesh.
    has_settled: bool,
    /// Passages of this mesh that had been made when the wait for one began.
    waits_since: f64,
    /// Of live runs on a finer mesh: the first one, where it was left.
    pub(super) ground: Option<Simulation>,
    /// What waits for the first mesh.
    pub(super) pending: Vec<Command>,
    /// What outputs were given on the last mesh before a knob was turned.
    shown_before: Shown,
    pace: LoopState,
    applied: Vec<AppliedCommand>,
    unconverged: Vec<Unconverged>,
    n_unconverged: u64,
    n_events_played: usize,
    n_turned_by_hand: usize,
    /// When the first step of the passage was done.
    passage_began: Option<Clock>,
    pub(super) ladder: Option<Arc<Ladder>>,
    pub(super) climb: Climb,
    pub(super) threads: usize,
    pub(super) started: Clock,
}

/// The scene's events in the order of their times, without those that another run has played.
pub(super) fn script_of(scene: &Scene, n_played: usize) -> VecDeque<Event> {
    let mut script = scene.events.clone();
    script.sort_by(|one, two| one.at_s.total_cmp(&two.at_s));
    script.drain(..n_played.min(script.len()));
    script.into()
}

impl Driver {
    pub(super) fn new(request: Request, start: Start, link: RunLink) -> Self {
        let context = request.context(start.began);
        Self {
            name: request.name,
            context,
            make_step: start.make_step,
            ending: request.ending,
            steps_planned: match request.ending {
                Ending::Passages => Some(request.plan.steps),
                Ending::Steps(last) => Some(last),
                Ending::OnStop => None,
            },
            outputs: Outputs::new(request.watchers),
            script: script_of(&request.scene, start.n_events_played),
            turns: start.turns.into(),
            steps_made: 0,
            link,
            pool: FramePool::new(FRAMES, &Frame::default()),
            gather: (request.ending != Ending::Passages).then(Gather::default),
            has_settled: false,
            waits_since: 0.0,
            ground: None,
            pending: Vec::new(),
            shown_before: Shown::default(),
            pace: LoopState::Running,
            applied: Vec::new(),
            unconverged: Vec::new(),
            n_unconverged: start.n_unconverged,
            n_events_played: start.n_events_played,
            n_turned_by_hand: start.n_turned_by_hand,
            passage_began: None,
            ladder: start.ladder,
            climb: start.climb,
            threads: request.threads,
            started: Clock::start(),
        }
    }

    /// The whole run, from opening the outputs to closing them.
    pub(super) fn run(
        mut self,
        make: impl FnOnce(&Scene) -> Result<Simulation, SimError>,
    ) -> Outcome {
        // Outputs first: a path that cannot be written must not cost a start-up.
        self.begin_outputs();
        let mut summary = None;
        let mut steps = 0;
        let mut steps_per_s = None;
        let mut settled = false;
        let mut checkpoint = None;
        let end = if self.must_end_for_outputs() {
            End::OutputFailed
        } else {
            let (end, sim) = self.go(make);
            if let Some(sim) = &sim {
                checkpoint = Some(self.checkpoint(sim));
                if !matches!(end, End::Done) && self.ending != Ending::OnStop {
                    self.announce(sim, RunEventKind::CutShort);
                }
            }
            let is_live = self.ending == Ending::OnStop;
            if let Some(sim) = sim.filter(|_| is_live || self.is_on_top()) {
                steps = sim.passage_steps();
                settled = matches!(end, End::Done) && sim.ends_settled();
                if settled {
                    self.steps_planned = Some(steps);
                }
                steps_per_s = self
                    .passage_began
                    .filter(|_| steps > 1)
                    .map(|began| (steps - 1) as f64 / began.elapsed_s().max(1e-9));
                summary = (steps > 0).then(|| sim.summary());
            }
            if let Some(summary) = &mut summary {
                self.sum_up(summary, &end);
            }
            end
        };
        // A run without an end of its own is ended by whoever says stop.
        let stopped = matches!(end, End::Stopped) && self.ending != Ending::OnStop;
        self.publish_failure(&end);
        let reports = self.outputs.finish();
        let wall_s = self.started.elapsed_s();
        if let Some(summary) = &mut summary {
            summary.scene = self.name;
            summary.wall_s = wall_s;
            summary.steps_per_s = steps_per_s;
            summary.steps = steps;
            summary.steps_planned = self.steps_planned;
            summary.stopped = stopped;
            summary.steps_not_converged = self.n_unconverged;
            summary.converged =
                self.n_unconverged == 0 && !stopped && !matches!(end, End::Stalled(_));
        }
        Outcome {
            end,
            stopped,
            summary,
            steps,
            steps_planned: self.steps_planned,
            settled,
            unconverged: self.unconverged,
            n_unconverged: self.n_unconverged,
            applied: self.applied,
            reports,
            output_errors: self.outputs.errors,
            checkpoint,
            wall_s,
            steps_per_s,
        }
    }

    /// The simulation of the scene alone, or of one mesh after the other.
    fn go(
        &mut self,
        make: impl FnOnce(&Scene) -> Result<Simulation, SimError>,
    ) -> (End, Option<Simulation>) {
        match self.ladder.clone() {
            Some(ladder) => self.go_up(&ladder, make),
            None => match make(&self.context.scene) {
                Err(error) => (End::NotStarted(error), None),
                Ok(mut sim) => match sim.inside(|sim| self.drive(sim)) {
                    // There is no other mesh.
                    Leg::Up | Leg::Down => (End::Done, Some(sim)),
                    Leg::Ended(end) => (end, Some(sim)),
                },
            },
        }
    }

    fn checkpoint(&self, sim: &Simulation) -> Box<Checkpoint> {
        Box::new(Checkpoint {
            program: self.context.program.clone(),
            scene: self.context.scene_toml.clone(),
            n_events_played: self.n_events_played,
            n_unconverged: self.n_unconverged,
            n_turned_by_hand: self.n_turned_by_hand,
            stats: *sim.stats(),
            climb: self.climb.clone(),
            sim: sim.save(),
        })
    }

    /// Steps until something ends the run, or its steps on this mesh.
    pub(super) fn drive(&mut self, sim: &mut Simulation) -> Leg {
        if self.has_ended(sim) {
            // Taken up where all that is asked for had been done.
            return if self.is_on_top() {
                Leg::Ended(End::Done)
            } else {
                Leg::Up
            };
        }
        loop {
            match self.turn(sim, PausedWait::Allowed) {
                LoopTurn::Stepped | LoopTurn::Waited => {}
                LoopTurn::Up => return Leg::Up,
                LoopTurn::Down => return Leg::Down,
                LoopTurn::Ended(end) => return Leg::Ended(end),
            }
        }
    }

    /// Commands, script, one step, its frame.
    pub(super) fn turn(&mut self, sim: &mut Simulation, waiting: PausedWait) -> LoopTurn {
        if let Some(turn) = self.repeat_turns(sim) {
            return turn;
        }
        if let Some(turn) = self.obey(sim, waiting) {
            return turn;
        }
        if waiting == PausedWait::Allowed && self.is_held() {
            self.publish_status(sim);
            std::thread::sleep(HELD);
            return LoopTurn::Waited;
        }
        self.play_script(sim);
        let made = match &mut self.make_step {
            Some(make_step) => make_step(sim),
            None => sim.step(),
        };
        if let Err(error) = made {
            return LoopTurn::Ended(End::Stalled(error));
        }
        self.steps_made += 1;
        self.keep_launch(sim);
        if self.pace == LoopState::OneStep {
            self.pace = LoopState::Paused;
        }
        self.judge_step(sim);
        self.hand_out(sim);
        self.publish_status(sim);
        if self.must_end_for_outputs() {
            return LoopTurn::Ended(End::OutputFailed);
        }
        if self.has_ended(sim) {
            return if self.is_on_top() {
                LoopTurn::Ended(End::Done)
            } else {
                LoopTurn::Up
            };
        }
        LoopTurn::Stepped
    }

    /// Whether somebody has asked for the cores, and what this mesh has to say may wait.
    fn is_held(&self) -> bool {
        self.climb.rungs.len() >= 2 && !self.has_settled && self.link.lock().is_held()
    }

    /// Whether all steps are made; on a coarser mesh those that it is there for.
    fn has_ended(&self, sim: &Simulation) -> bool {
        match self.ending {
            Ending::Passages => sim.is_done() || !self.is_on_top() && sim.has_settled(),
            Ending::Steps(_) | Ending::OnStop if !self.is_on_top() => {
                self.has_settled && self.script.is_empty()
            }
            Ending::Steps(steps) => self.steps_shown(sim) >= steps,
            Ending::OnStop => false,
        }
    }
}
