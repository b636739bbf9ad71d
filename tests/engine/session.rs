//! The loop: commands between steps, scripted events, outputs that fail, every way to end.
#![expect(clippy::unwrap_used, reason = "tests")]

use std::sync::{Arc, Mutex};
use std::time::Duration;

use asperity::observe::{
    ObserveError, Observer, ObserverReport, RunContext, RunEvent, RunEventKind,
};
use asperity::plan::Plan;
use asperity::run::{Command, End, Ending, Outcome, Request, RunError, Session, Stepper, Watcher};
use asperity::scene::{Event, Scene, presets};
use asperity::sim::{Frame, Knob, Metrics, SimError, Stage, StepError, Summary};

const START_UP: u64 = 3;
const DT_S: f64 = 1e-3;

/// A simulation that does nothing but what the test asks for.
#[derive(Default)]
struct Fake {
    made: u64,
    wanted: u64,
    stalls_at: Option<u64>,
    panics_at: Option<u64>,
    unconverged: Vec<u64>,
    metrics: Metrics,
    /// Slide-to-roll ratio of each passage step.
    history: Arc<Mutex<Vec<f64>>>,
}

impl Stepper for Fake {
    fn step(&mut self) -> Result<(), StepError> {
        self.made += 1;
        let step = self.passage_steps();
        if self.stalls_at == Some(step) {
            return Err(StepError::NotFinite { t_s: self.time_s() });
        }
        assert_ne!(self.panics_at, Some(step), "planted");
        self.metrics.converged = !self.unconverged.contains(&step);
        self.metrics.residual = 0.5;
        if step > 0 {
            self.history.lock().unwrap().push(self.metrics.slide_roll);
        }
        Ok(())
    }
    fn set(&mut self, knob: Knob, value: f64) -> Result<(), SimError> {
        if value > 2.0 {
            return Err(SimError::Knob {
                key: knob.key(),
                value,
                allowed: "at most 2".into(),
            });
        }
        self.metrics.slide_roll = value;
        Ok(())
    }
    fn fill(&self, frame: &mut Frame) {
        frame.step = self.passage_steps();
        frame.stage = self.stage();
    }
    fn metrics(&self) -> &Metrics {
        &self.metrics
    }
    fn stage(&self) -> Stage {
        if self.made > START_UP {
            Stage::Passage
        } else {
            Stage::StartUp
        }
    }
    fn progress(&self) -> f64 {
        self.made as f64 / (START_UP + self.wanted) as f64
    }
    fn passage_steps(&self) -> u64 {
        self.made.saturating_sub(START_UP)
    }
    fn time_s(&self) -> f64 {
        self.passage_steps() as f64 * DT_S
    }
    fn is_done(&self) -> bool {
        self.passage_steps() >= self.wanted
    }
    fn summary(&self) -> Summary {
        Summary::default()
    }
}

/// What an observer saw.
#[derive(Debug, Default, Clone)]
struct Seen {
    frames: Vec<u64>,
    events: Vec<(u64, String)>,
    finished: u32,
}

struct Probe {
    seen: Arc<Mutex<Seen>>,
    fails_at: Option<u64>,
    fails_to_begin: Option<()>,
}

impl Observer for Probe {
    fn begin(&mut self, context: &RunContext) -> Result<(), ObserveError> {
        assert!(context.scene_toml.contains("[contact]") && context.plan_text.contains("Grid"));
        match self.fails_to_begin {
            Some(()) => Err(ObserveError::new("probe", "no room")),
            None => Ok(()),
        }
    }
    fn frame(&mut self, frame: &Arc<Frame>) -> Result<(), ObserveError> {
        if self.fails_at == Some(frame.step) {
            return Err(ObserveError::new("probe", "disk full"));
        }
        self.seen.lock().unwrap().frames.push(frame.step);
        Ok(())
    }
    fn event(&mut self, event: &RunEvent) -> Result<(), ObserveError> {
        let what = match &event.kind {
            RunEventKind::Set { key, value, .. } => format!("{key}={value}"),
            RunEventKind::Caption(text) => text.clone(),
            RunEventKind::NotConverged { residual } => format!("residual {residual}"),
        };
        self.seen.lock().unwrap().events.push((event.step, what));
        Ok(())
    }
    fn finish(&mut self) -> Result<ObserverReport, ObserveError> {
        self.seen.lock().unwrap().finished += 1;
        Ok(ObserverReport::default())
    }
}

struct Case {
    fake: Fake,
    ending: Ending,
    every_steps: u64,
    fails_at: Option<u64>,
    fails_to_begin: Option<()>,
    events: Vec<Event>,
}

impl Case {
    fn new(wanted: u64) -> Self {
        Self {
            fake: Fake {
                wanted,
                ..Fake::default()
            },
            ending: Ending::Passages,
            every_steps: 1,
            fails_at: None,
            fails_to_begin: None,
            events: Vec::new(),
        }
    }

    fn start(self) -> (Session, Arc<Mutex<Seen>>) {
        let mut scene = Scene::load(presets::QUICK).unwrap();
        scene.events = self.events;
        let seen = Arc::new(Mutex::new(Seen::default()));
        let probe = Probe {
            seen: Arc::clone(&seen),
            fails_at: self.fails_at,
            fails_to_begin: self.fails_to_begin,
        };
        let request = Request {
            name: "test".into(),
            plan: Plan::new(&scene).unwrap(),
            scene: Arc::new(scene),
            threads: 1,
            watchers: vec![Watcher::new("probe", Box::new(probe), self.every_steps)],
            ending: self.ending,
        };
        let fake = self.fake;
        (
            Session::start_with(request, move |_| Ok(fake)).unwrap(),
            seen,
        )
    }

    fn run(self) -> (Outcome, Seen) {
        let (session, seen) = self.start();
        let outcome = session.join().unwrap();
        let seen = seen.lock().unwrap().clone();
        (outcome, seen)
    }
}

fn wait_until(session: &Session, ready: impl Fn(u64) -> bool) {
    while !ready(session.status().steps) {
        assert!(
            !session.is_finished(),
            "the session ended while it was awaited"
        );
        std::thread::sleep(Duration::from_millis(1));
    }
}

#[test]
fn a_run_hands_out_every_frame_of_the_passage_once() {
    let (outcome, seen) = Case::new(5).run();
    assert!(matches!(outcome.end, End::Done));
    assert_eq!((outcome.steps, outcome.exit_code()), (5, 0));
    assert_eq!(seen.frames, [1, 2, 3, 4, 5], "the start-up is not recorded");
    assert_eq!(seen.finished, 1);
    let summary = outcome.summary.unwrap();
    assert_eq!(
        (summary.scene.as_str(), summary.steps, summary.converged),
        ("test", 5, true)
    );
}

#[test]
fn a_cadence_thins_the_frames_of_its_output_only() {
    let mut case = Case::new(9);
    case.every_steps = 4;
    let (outcome, seen) = case.run();
    assert_eq!(seen.frames, [4, 8]);
    assert_eq!(outcome.steps, 9);
}

#[test]
fn steps_that_do_not_converge_are_named_and_change_the_exit_code() {
    let mut case = Case::new(6);
    case.fake.unconverged = vec![2, 5];
    let (outcome, seen) = case.run();
    let named: Vec<u64> = outcome.unconverged.iter().map(|step| step.step).collect();
    assert_eq!(named, [2, 5]);
    assert_eq!((outcome.n_unconverged, outcome.exit_code()), (2, 2));
    let summary = outcome.summary.unwrap();
    assert_eq!((summary.converged, summary.steps_not_converged), (false, 2));
    assert_eq!(
        seen.events,
        [
            (2, "residual 0.5".to_owned()),
            (5, "residual 0.5".to_owned())
        ]
    );
}

#[test]
fn a_stall_ends_the_run_and_closes_the_outputs() {
    let mut case = Case::new(6);
    case.fake.stalls_at = Some(4);
    let (outcome, seen) = case.run();
    assert!(matches!(
        outcome.end,
        End::Stalled(StepError::NotFinite { .. })
    ));
    assert_eq!(outcome.exit_code(), 3);
    assert_eq!((seen.frames, seen.finished), (vec![1, 2, 3], 1));
    assert!(!outcome.summary.unwrap().converged);
}

#[test]
fn a_simulation_that_cannot_start_is_an_outcome() {
    let scene = Scene::load(presets::QUICK).unwrap();
    let request = Request {
        name: "test".into(),
        plan: Plan::new(&scene).unwrap(),
        scene: Arc::new(scene),
        threads: 1,
        watchers: Vec::new(),
        ending: Ending::Passages,
    };
    let refused = |_: &Scene| {
        Err::<Fake, _>(SimError::Threads {
            threads: 1,
            reason: "none left".into(),
        })
    };
    let outcome = Session::start_with(request, refused)
        .unwrap()
        .join()
        .unwrap();
    assert!(matches!(outcome.end, End::NotStarted(_)));
    assert_eq!((outcome.exit_code(), outcome.summary), (3, None));
}

#[test]
fn an_output_that_fails_ends_a_headless_run() {
    let mut case = Case::new(100);
    case.fails_at = Some(3);
    let (outcome, seen) = case.run();
    assert!(matches!(outcome.end, End::OutputFailed));
    assert_eq!(outcome.exit_code(), 4);
    assert_eq!(
        outcome.output_errors,
        [ObserveError::new("probe", "disk full")]
    );
    assert_eq!(
        (seen.frames, seen.finished, outcome.steps),
        (vec![1, 2], 1, 3)
    );
}

#[test]
fn an_output_that_cannot_begin_costs_no_start_up() {
    let mut case = Case::new(100);
    case.fails_to_begin = Some(());
    let (outcome, _) = case.run();
    assert_eq!((outcome.exit_code(), outcome.steps), (4, 0));
    assert!(outcome.summary.is_none());
}

#[test]
fn a_live_run_goes_on_without_an_output_that_failed() {
    let mut case = Case::new(5);
    case.fails_at = Some(3);
    case.ending = Ending::OnStop;
    let (session, seen) = case.start();
    wait_until(&session, |steps| steps > 20);
    session.send(Command::Stop);
    let outcome = session.join().unwrap();
    assert!(
        matches!(outcome.end, End::Stopped),
        "it also outlives its passages"
    );
    assert_eq!(outcome.exit_code(), 4, "the failure is not forgotten");
    assert_eq!(outcome.output_errors.len(), 1, "and said once");
    assert_eq!(seen.lock().unwrap().frames, [1, 2]);
}

#[test]
fn stop_ends_cleanly() {
    let mut case = Case::new(u64::MAX - START_UP);
    case.every_steps = 1_000_000;
    let (session, seen) = case.start();
    wait_until(&session, |steps| steps > 2);
    session.send(Command::Stop);
    let outcome = session.join().unwrap();
    assert!(matches!(outcome.end, End::Stopped));
    assert_eq!((outcome.exit_code(), seen.lock().unwrap().finished), (5, 1));
    let summary = outcome.summary.unwrap();
    assert!(summary.stopped && outcome.stopped);
    assert!(summary.steps_planned.is_some());
}

#[test]
fn a_pause_holds_and_steps_singly() {
    let mut case = Case::new(5);
    case.ending = Ending::OnStop;
    let (session, _) = case.start();
    wait_until(&session, |steps| steps > 2);
    session.send(Command::Pause);
    // Three single steps and a knob, answered in order; then the stop, which wakes a paused run.
    session.send(Command::StepOnce);
    session.send(Command::Set(Knob::SlideRoll, 1.5));
    session.send(Command::StepOnce);
    session.send(Command::StepOnce);
    session.send(Command::Stop);
    let outcome = session.join().unwrap();
    let log = &outcome.applied;
    let paused_at = log[0].step;
    let expected = [
        (paused_at, Command::Pause),
        (paused_at, Command::StepOnce),
        (paused_at + 1, Command::Set(Knob::SlideRoll, 1.5)),
        (paused_at + 1, Command::StepOnce),
        (paused_at + 2, Command::StepOnce),
        (paused_at + 3, Command::Stop),
    ];
    let got: Vec<_> = log
        .iter()
        .map(|entry| (entry.step, entry.command.clone()))
        .collect();
    assert_eq!(got, expected);
    assert_eq!(outcome.steps, paused_at + 3);
}

#[test]
fn scripted_events_take_effect_at_their_time_in_order() {
    let mut case = Case::new(8);
    let event = |at_s: f64, value: f64, caption: &str| Event {
        at_s,
        set: [("motion.slide_roll".to_owned(), value)].into(),
        caption: caption.into(),
    };
    // Out of order in the file.
    case.events = vec![
        event(5.0 * DT_S, 1.0, "later"),
        event(2.0 * DT_S, 0.25, "first"),
    ];
    let history = Arc::clone(&case.fake.history);
    let (outcome, seen) = case.run();
    let (a, b) = (0.25, 1.0);
    assert_eq!(*history.lock().unwrap(), [0.0, 0.0, a, a, a, b, b, b]);
    let log: Vec<_> = outcome
        .applied
        .iter()
        .map(|entry| (entry.step, entry.command.clone()))
        .collect();
    assert_eq!(
        log,
        [
            (2, Command::Set(Knob::SlideRoll, a)),
            (5, Command::Set(Knob::SlideRoll, b))
        ]
    );
    let events: Vec<_> = seen
        .events
        .iter()
        .map(|(step, what)| (*step, what.as_str()))
        .collect();
    assert_eq!(
        events,
        [
            (2, "motion.slide_roll=0.25"),
            (2, "first"),
            (5, "motion.slide_roll=1"),
            (5, "later")
        ]
    );
}

#[test]
fn a_knob_that_is_refused_is_logged_as_the_words_that_tell_it() {
    let mut case = Case::new(5);
    case.ending = Ending::OnStop;
    let (session, seen) = case.start();
    session.send(Command::Set(Knob::SlideRoll, 3.0));
    wait_until(&session, |steps| steps > 2);
    session.send(Command::Stop);
    let outcome = session.join().unwrap();
    let [told, stopped] = &outcome.applied[..] else {
        panic!("{:?}", outcome.applied);
    };
    assert!(matches!(&told.command, Command::Say(text) if text.contains("at most 2")));
    assert_eq!(stopped.command, Command::Stop);
    let events = seen.lock().unwrap().events.clone();
    assert_eq!(events.len(), 1, "{events:?}");
    assert!(events[0].1.contains("at most 2"), "{events:?}");
}

#[test]
fn a_panic_of_the_simulation_is_an_error_and_not_a_hang() {
    let mut case = Case::new(5);
    case.fake.panics_at = Some(2);
    let (session, _) = case.start();
    assert!(matches!(session.join(), Err(RunError::Panicked(text)) if text.contains("planted")));
}

#[test]
fn the_newest_frame_is_there_to_be_taken() {
    let mut case = Case::new(5);
    case.ending = Ending::OnStop;
    let (session, _) = case.start();
    let latest = session.latest();
    wait_until(&session, |steps| steps > 2);
    session.send(Command::Stop);
    let steps = session.join().unwrap().steps;
    assert_eq!(latest.take().unwrap().step, steps);
    assert!(latest.take().is_none(), "each frame is taken once");
}
