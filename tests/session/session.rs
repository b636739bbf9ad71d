//! The loop: commands between steps, scripted events, outputs that fail, every way to end.
#![expect(clippy::unwrap_used, reason = "tests")]

use std::sync::{Arc, Mutex};
use std::time::Duration;

use asperity_engine::observe::{
    ObserveError, Observer, ObserverReport, RunContext, RunEvent, RunEventKind,
};
use asperity_engine::plan::Plan;
use asperity_engine::scene::{Event, Override, Scene, presets};
use asperity_engine::sim::{Frame, Knob, SimError, Simulation, StepError};
use asperity_session::run::{
    Command, End, Ending, Outcome, Request, RunError, Session, Unconverged, Watcher,
};

/// Takes the oil out: steps of a fraction of a millisecond.
const DRY: &str = "lubricant=none";

/// A rough contact on few nodes.
fn scene(sets: &[&str]) -> Scene {
    let all = [
        "grid.nodes=33",
        "stress=none",
        "life=none",
        "record=none",
        "numerics.error_estimate=none",
        "time.passages=0.05",
        "body_1.surface.wavelength_x_m=6e-4",
        "body_2.surface.wavelength_x_m=6e-4",
        "body_2.surface.wavelength_y_m=6e-4",
        "motion.slide_roll=0",
    ];
    let sets: Vec<Override> = (all.iter().chain(sets))
        .map(|set| set.parse().unwrap())
        .collect();
    Scene::load_with(presets::QUICK, &sets).unwrap()
}

/// Steps that fail where the test asks for it; a step of the passage is the one after so many.
#[derive(Default)]
struct Faults {
    stalls_at: Option<u64>,
    panics_at: Option<u64>,
}

impl Faults {
    fn step(&self, sim: &mut Simulation) -> Result<(), StepError> {
        let step = (sim.passage_steps() > 0).then(|| sim.passage_steps() + 1);
        if step.is_some() && self.stalls_at == step {
            return Err(StepError::NotFinite { t_s: sim.time_s() });
        }
        assert!(step.is_none() || self.panics_at != step, "planted");
        sim.step()
    }
}

/// What an observer saw.
#[derive(Debug, Default, Clone)]
struct Seen {
    frames: Vec<u64>,
    /// Where S was going in each frame.
    targets: Vec<f64>,
    /// Steps whose frames say that they did not converge.
    unconverged: Vec<u64>,
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
        let mut seen = self.seen.lock().unwrap();
        seen.frames.push(frame.step);
        seen.targets.push(frame.metrics.slide_roll_target);
        if !frame.metrics.converged {
            seen.unconverged.push(frame.step);
        }
        Ok(())
    }
    fn event(&mut self, event: &RunEvent) -> Result<(), ObserveError> {
        let what = match &event.kind {
            RunEventKind::Set { key, value, .. } => format!("{key}={value}"),
            RunEventKind::Caption(text) => text.clone(),
            RunEventKind::NotConverged { residual } => format!("residual {residual}"),
            // It lies between what is looked for here.
            RunEventKind::CutShort => return Ok(()),
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
    scene: Scene,
    faults: Faults,
    ending: Ending,
    every_steps: u64,
    fails_at: Option<u64>,
    fails_to_begin: Option<()>,
}

impl Case {
    /// A run of so many steps of the passage.
    fn new(steps: u64) -> Self {
        Self {
            scene: scene(&[DRY]),
            faults: Faults::default(),
            ending: Ending::Steps(steps),
            every_steps: 1,
            fails_at: None,
            fails_to_begin: None,
        }
    }

    fn start(self) -> (Session, Arc<Mutex<Seen>>) {
        let seen = Arc::new(Mutex::new(Seen::default()));
        let probe = Probe {
            seen: Arc::clone(&seen),
            fails_at: self.fails_at,
            fails_to_begin: self.fails_to_begin,
        };
        let request = Request {
            name: "test".into(),
            plan: Plan::new(&self.scene).unwrap(),
            scene: Arc::new(self.scene),
            threads: 1,
            watchers: vec![Watcher::new("probe", Box::new(probe), self.every_steps)],
            ending: self.ending,
        };
        let (plan, faults) = (request.plan.clone(), self.faults);
        let make = move |scene: &Scene| Simulation::new(scene, plan, 1);
        let session = Session::start_with(request, make, move |sim| faults.step(sim));
        (session.unwrap(), seen)
    }

    fn run(self) -> (Outcome, Seen) {
        let (session, seen) = self.start();
        let outcome = session.join().unwrap();
        let seen = seen.lock().unwrap().clone();
        (outcome, seen)
    }
}

fn wait_until(session: &Session, ready: impl Fn(u64) -> bool) {
    while !ready(session.handle.status().steps) {
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
    let mut case = Case::new(30);
    // So little and so few that some steps get there and some do not.
    case.scene = scene(&["numerics.tolerance=5e-9", "numerics.max_iterations=2"]);
    let (outcome, seen) = case.run();
    println!("{:?} of {:?}", seen.unconverged, seen.frames);
    assert!(!seen.unconverged.is_empty() && seen.unconverged.len() < seen.frames.len());
    // Those of the start-up, which has no frames, bear the number 0.
    let kept = |step: &&Unconverged| step.step > 0;
    let named = outcome
        .unconverged
        .iter()
        .filter(kept)
        .map(|step| step.step);
    assert_eq!(named.collect::<Vec<_>>(), seen.unconverged);
    let all = outcome.unconverged.len() as u64;
    assert_eq!((outcome.n_unconverged, outcome.exit_code()), (all, 2));
    let summary = outcome.summary.unwrap();
    assert_eq!(
        (summary.converged, summary.steps_not_converged),
        (false, all)
    );
    let told = outcome.unconverged.iter();
    let told = told.map(|step| (step.step, format!("residual {}", step.unsolved.residual)));
    assert_eq!(seen.events, told.collect::<Vec<_>>());
}

#[test]
fn a_stall_ends_the_run_and_closes_the_outputs() {
    let mut case = Case::new(6);
    case.faults.stalls_at = Some(4);
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
    let scene = scene(&[DRY]);
    let request = Request {
        name: "test".into(),
        plan: Plan::new(&scene).unwrap(),
        scene: Arc::new(scene),
        threads: 1,
        watchers: Vec::new(),
        ending: Ending::Passages,
    };
    let refused = |_: &Scene| {
        Err(SimError::Threads {
            threads: 1,
            reason: "none left".into(),
        })
    };
    let outcome = Session::start_with(request, refused, Simulation::step)
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
    let planned = Plan::new(&case.scene).unwrap().steps;
    let (session, seen) = case.start();
    wait_until(&session, |steps| steps > planned + 5);
    session.handle.send(Command::Stop);
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
    let mut case = Case::new(u64::MAX);
    case.every_steps = 1_000_000;
    let (session, seen) = case.start();
    wait_until(&session, |steps| steps > 2);
    session.handle.send(Command::Stop);
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
    session.handle.send(Command::Pause);
    // Three single steps and a knob, answered in order; then the stop, which wakes a paused run.
    session.handle.send(Command::StepOnce);
    session.handle.send(Command::Set(Knob::SlideRoll, 1.5));
    session.handle.send(Command::StepOnce);
    session.handle.send(Command::StepOnce);
    session.handle.send(Command::Stop);
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
    let dt_s = Plan::new(&case.scene).unwrap().dt_s;
    // Out of order in the file.
    case.scene.events = vec![
        event(4.5 * dt_s, 1.0, "later"),
        event(1.5 * dt_s, 0.25, "first"),
    ];
    let (outcome, seen) = case.run();
    let (a, b) = (0.25, 1.0);
    assert_eq!(seen.targets, [0.0, 0.0, a, a, a, b, b, b]);
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
    session.handle.send(Command::Set(Knob::SlideRoll, 3.0));
    wait_until(&session, |steps| steps > 2);
    session.handle.send(Command::Stop);
    let outcome = session.join().unwrap();
    let [told, stopped] = &outcome.applied[..] else {
        panic!("{:?}", outcome.applied);
    };
    assert!(matches!(&told.command, Command::Say(text) if text.contains("-2 to 2")));
    assert_eq!(stopped.command, Command::Stop);
    let events = seen.lock().unwrap().events.clone();
    assert_eq!(events.len(), 1, "{events:?}");
    assert!(events[0].1.contains("-2 to 2"), "{events:?}");
}

#[test]
fn a_panic_of_the_simulation_is_an_error_and_not_a_hang() {
    let mut case = Case::new(5);
    case.faults.panics_at = Some(2);
    let (session, _) = case.start();
    assert!(matches!(session.join(), Err(RunError::Panicked(text)) if text.contains("planted")));
}

#[test]
fn the_newest_frame_is_there_to_be_taken() {
    let mut case = Case::new(5);
    case.ending = Ending::OnStop;
    let (session, _) = case.start();
    let latest = session.handle.latest();
    wait_until(&session, |steps| steps > 2);
    session.handle.send(Command::Stop);
    let steps = session.join().unwrap().steps;
    assert_eq!(latest.take().unwrap().step, steps);
    assert!(latest.take().is_none(), "each frame is taken once");
}
