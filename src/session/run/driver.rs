//! The loop itself: commands, script, step, frames, in this order, on the simulation's thread.

use std::collections::VecDeque;
use std::sync::Arc;
use std::sync::mpsc::TryRecvError;

use super::checkpoint::Checkpoint;
use super::clock::Clock;
use super::command::{AppliedCommand, Command, HandTurn};
use super::handle::RunLink;
use super::ladder::{Climb, Ladder};
use super::outcome::{End, Outcome, Unconverged};
use super::outputs::Outputs;
use super::request::{Ending, Request};
use super::settled::{Closing, Gather, PATIENCE};
use crate::FramePool;
use asperity_engine::observe::{Began, RunContext, RunEvent, RunEventKind, SetBy};
use asperity_engine::scene::{Event, Scene};
use asperity_engine::sim::{
    Frame, Knob, LubricationRegime, SimError, Simulation, Stage, StepError, Unsolved,
};

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
        let mut checkpoint = None;
        let end = if self.must_end_for_outputs() {
            End::OutputFailed
        } else {
            let (end, sim) = self.go(make);
            if let Some(sim) = &sim {
                checkpoint = Some(self.checkpoint(sim));
            }
            let is_live = self.ending == Ending::OnStop;
            if let Some(sim) = sim.filter(|_| is_live || self.is_on_top()) {
                steps = sim.passage_steps();
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

    /// Whether all steps are made; on a coarser mesh those that it is there for.
    fn has_ended(&self, sim: &Simulation) -> bool {
        match self.ending {
            Ending::Passages => sim.is_done(),
            Ending::Steps(_) | Ending::OnStop if !self.is_on_top() => {
                self.has_settled && self.script.is_empty()
            }
            Ending::Steps(steps) => self.steps_shown(sim) >= steps,
            Ending::OnStop => false,
        }
    }

    fn judge_step(&mut self, sim: &Simulation) {
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

    /// A knob was turned: what had settled is past.
    fn forget_settled(&mut self) {
        if let Some(gather) = &mut self.gather {
            *gather = Gather::default();
            self.has_settled = false;
            self.link.lock().settled = None;
        }
    }

    /// Another mesh: what has settled on the last one is shown until this one has.
    pub(super) fn begin_gathering(&mut self) {
        self.has_settled = false;
        if let Some(gather) = &mut self.gather {
            *gather = Gather::default();
        }
    }

    /// Before the first mesh goes on: the outputs' steps and times do not begin again.
    pub(super) fn leave_top(&mut self, sim: &Simulation) {
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
    fn steps_shown(&self, sim: &Simulation) -> u64 {
        let on_this = if self.is_on_top() {
            sim.passage_steps()
        } else {
            0
        };
        self.shown_before.steps + on_this
    }

    /// Simulated time that outputs have been given, s.
    fn time_shown_s(&self, sim: &Simulation) -> f64 {
        let on_this = if self.is_on_top() { sim.time_s() } else { 0.0 };
        self.shown_before.time_s + on_this
    }

    /// Does what was done at this place in the run that is repeated.
    fn repeat_turns(&mut self, sim: &mut Simulation) -> Option<LoopTurn> {
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
    fn obey(&mut self, sim: &mut Simulation, waiting: PausedWait) -> Option<LoopTurn> {
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
    pub(super) fn carry_out(&mut self, sim: &mut Simulation, command: Command) {
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
            steps_made: self.steps_made,
            by,
            step: self.steps_shown(sim),
            time_s: self.time_shown_s(sim),
            command,
        });
    }

    fn set(&mut self, sim: &mut Simulation, knob: Knob, value: f64, by: SetBy) {
        match sim.set(knob, value) {
            Ok(()) => {
                self.log(sim, Command::Set(knob, value), by);
                self.n_turned_by_hand += usize::from(by == SetBy::Hand);
                self.forget_settled();
                // What is gone on from is what the knob makes of it.
                self.climb.launch = None;
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
    fn play_script(&mut self, sim: &mut Simulation) {
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

    pub(super) fn begin_outputs(&mut self) {
        self.outputs.begin(&self.context);
    }

    /// Gives the step to the screen, and to the outputs if it belongs to the results.
    fn hand_out(&mut self, sim: &Simulation) {
        let (on_top, before) = (self.is_on_top(), self.shown_before);
        let mut life = sim.metrics().life;
        if let Some(life) = &mut life {
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
        // The start-up of a finer mesh shows nothing that the coarser one has not shown.
        if frame.stage == Stage::Passage || self.climb.rungs.is_empty() {
            self.link.latest.put(frame);
        }
    }

    /// Looks for a period of a live run; on a coarser mesh for one with a settled life, or the time that it has.
    fn gather_frame(&mut self, sim: &Simulation, frame: &Arc<Frame>, on_top: bool) {
        let Some(gather) = &mut self.gather else {
            return;
        };
        let closing = if on_top {
            Closing::Fields
        } else {
            Closing::Life
        };
        if let Some(mut settled) = gather.take(frame, closing, || Some(sim.save())) {
            settled.is_last = on_top;
            settled.ground = match (&self.ladder, &self.ground) {
                (Some(ladder), Some(ground)) => ladder.ground(ground),
                (Some(ladder), None) => ladder.ground(sim),
                (None, _) => None,
            };
            self.link.lock().settled = Some(Arc::new(settled));
            self.has_settled = true;
        }
        self.has_settled |= !on_top && frame.passages >= PATIENCE;
    }

    /// Tells the outputs; what happens on a coarser mesh happens again on the last.
    fn announce(&mut self, sim: &Simulation, kind: RunEventKind) {
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

    fn must_end_for_outputs(&self) -> bool {
        self.ending != Ending::OnStop && !self.outputs.errors.is_empty()
    }

    /// The script of another mesh.
    pub(super) fn restart_script(&mut self, script: VecDeque<Event>) {
        (self.script, self.n_events_played) = (script, 0);
    }

    pub(super) fn publish_rungs(&self) {
        let mut shared = self.link.lock();
        shared.status.rungs.clone_from(&self.climb.rungs);
    }

    fn publish_status(&self, sim: &Simulation) {
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

    pub(super) fn publish_failure(&self, end: &End) {
        let failure = match end {
            End::Stalled(error) => error.to_string(),
            End::NotStarted(error) => error.to_string(),
            End::OutputFailed => "an output failed".to_owned(),
            End::Done | End::Stopped => return,
        };
        self.link.lock().status.failure = Some(failure);
    }
}
