//! The ladder of meshes against runs on the last mesh alone, in the middle of it, and under knobs that are turned.
#![expect(clippy::unwrap_used, reason = "tests")]

use std::sync::{Arc, Mutex};
use std::time::{Duration, Instant};

use asperity_engine::observe::{ObserveError, Observer, ObserverReport, RunContext, RunEvent};
use asperity_engine::plan::Plan;
use asperity_engine::scene::{Override, Scene};
use asperity_engine::sim::{Frame, Knob, Metrics, SimError, Simulation, Summary};
use asperity_session::run::{
    Checkpoint, Command, Companion, End, Ending, HandTurn, Ladder, Outcome, Request, Session,
    Settled, Watcher,
};
use asperity_session::sweep::{Along, Background, CurveOrder, Ground, Varied};

fn scene(preset: &str, sets: &[&str]) -> Arc<Scene> {
    let sets = sets.iter().chain(&["record=none"]);
    let sets: Vec<Override> = sets.map(|set| set.parse().unwrap()).collect();
    Arc::new(Scene::load_with(preset, &sets).unwrap())
}

fn request(scene: &Arc<Scene>, ending: Ending, watchers: Vec<Watcher>) -> Request {
    Request {
        name: String::new(),
        scene: Arc::clone(scene),
        plan: Plan::new(scene).unwrap(),
        threads: 2,
        watchers,
        ending,
    }
}

/// Beside what is compared: fewer depths, and no lives by other models or maps of damage.
const BARE: [&str; 3] = ["stress.depths=8", "life.spread=off", "life.damage_map=off"];

fn outcome(preset: &str, sets: &[&str], ladder: bool) -> Summary {
    let ladder_is = format!("numerics.ladder={ladder}");
    let scene = scene(preset, &[sets, &[&*ladder_is]].concat());
    let outcome = Session::start(request(&scene, Ending::Passages, Vec::new()));
    let mut outcome = outcome.unwrap().join().unwrap();
    assert!(matches!(outcome.end, End::Done), "{preset} {sets:?}");
    let mut summary = outcome.summary.take().unwrap();
    if !ladder {
        let plan = Plan::new(&scene).unwrap();
        let companion = Companion::start(&scene, &plan, 2).unwrap();
        companion.compare(&mut summary).unwrap();
    }
    summary
}

/// Numbers that may differ by what both say of their errors, and by this share where they say less: what a mean over other
/// phases of waves without a common period may move by.
const SHARE: f64 = 0.002;

/// What is apart by more than both bands.
fn apart(preset: &str, sets: &[&str]) -> Vec<String> {
    let (climbed, alone) = (outcome(preset, sets, true), outcome(preset, sets, false));
    assert!(climbed.rungs.len() > 1, "{preset} {sets:?}");
    let mut apart = Vec::new();
    let mut compare = |name: &str, one: f64, other: f64, errors: [Option<f64>; 2]| {
        let most = errors.into_iter().flatten().sum::<f64>() + SHARE * other.abs();
        let off = (one - other).abs();
        println!("{preset} {sets:?} {name}: {one:.6e} {other:.6e}, off {off:.1e} of {most:.1e}");
        if off.is_nan() || off > most {
            apart.push(format!("{preset} {sets:?} {name}: {one:e} {other:e}"));
        }
    };
    let (one, two) = (&climbed, &alone);
    let central = [one.error_h_central_m, two.error_h_central_m];
    compare("central film", one.h_central_m, two.h_central_m, central);
    let least = [one.error_h_min_m, two.error_h_min_m];
    compare("least film", one.h_min_m, two.h_min_m, least);
    let most = [one.error_p_max_pa, two.error_p_max_pa];
    compare("maximum pressure", one.p_max_pa, two.p_max_pa, most);
    if let (Some(one), Some(two)) = (one.life_relative, two.life_relative) {
        let errors = [climbed.error_ln_life, alone.error_ln_life];
        compare("ln life", one.ln(), two.ln(), errors);
    }
    apart
}

/// Not until a life has settled, which others of them are.
const HALF: &str = "time.passages=0.5";

/// What is run always: a point, a line, a dry contact, one that yields, unlike bodies, S = 0, a steady one.
const CASES: [(&str, &[&str]); 7] = [
    ("mtm_ball_on_disc", &[]),
    ("fzg_pitch_point", &["grid.nodes=129"]),
    ("twin_disc", &["lubricant=none", HALF]),
    (
        "twin_disc",
        &["body_1.hardness_pa=4e9", "body_2.hardness_pa=4e9", HALF],
    ),
    ("mtm_ball_on_disc", &["body_1.young_pa=7e10", HALF]),
    ("micropitting_rig", &["motion.slide_roll=0"]),
    (
        "demonstration_quick",
        &[
            "body_1.surface.wavelength_x_m=inf",
            "body_1.surface.wavelength_y_m=4e-4",
            "body_2.surface.kind=smooth",
            HALF,
        ],
    ),
];

#[test]
fn the_last_mesh_is_what_a_run_on_it_alone_is() {
    let mut found = Vec::new();
    for (preset, sets) in CASES {
        found.extend(apart(preset, &[sets, &BARE].concat()));
    }
    assert!(found.is_empty(), "{found:#?}");
}

#[test]
#[ignore = "minutes: every preset as it is"]
fn in_every_preset_too() {
    let mut found = Vec::new();
    for preset in asperity_engine::scene::presets::all() {
        let preset = preset.name;
        found.extend(apart(preset, &[]));
    }
    assert!(found.is_empty(), "{found:#?}");
}

/// A ladder of two small meshes with long waves.
const SMALL: [&str; 8] = [
    "grid.nodes=129",
    "time.passages=0.15",
    "body_1.surface.wavelength_x_m=4e-4",
    "body_2.surface.wavelength_x_m=4e-4",
    "body_2.surface.wavelength_y_m=4e-4",
    "life.damage_map=off",
    "stress.depths=8",
    "numerics.order=second",
];

/// An S to turn to: waves of one length meet alike again after one and a half of them, at no other S as soon but rolling.
const TURNED: f64 = 2.0 / 3.0;

/// Step, time, nodes along x and pressure.
type Row = (u64, f64, usize, Vec<f32>);

/// Frames of a run.
#[derive(Debug, Default, Clone)]
struct Frames(Arc<Mutex<Vec<Row>>>);

impl Observer for Frames {
    fn begin(&mut self, _: &RunContext) -> Result<(), ObserveError> {
        Ok(())
    }
    fn event(&mut self, _: &RunEvent) -> Result<(), ObserveError> {
        Ok(())
    }
    fn frame(&mut self, frame: &Arc<Frame>) -> Result<(), ObserveError> {
        let row = (
            frame.step,
            frame.time_s,
            frame.nx,
            frame.pressure_pa.clone(),
        );
        self.0.lock().unwrap().push(row);
        Ok(())
    }
    fn finish(&mut self) -> Result<ObserverReport, ObserveError> {
        Ok(ObserverReport::default())
    }
}

fn watched(frames: &Frames) -> Vec<Watcher> {
    vec![Watcher::new("frames", Box::new(frames.clone()), 1)]
}

/// Numbers of a summary but for its times.
fn untimed(outcome: &Outcome) -> Summary {
    let mut summary = outcome.summary.clone().unwrap();
    (summary.wall_s, summary.steps_per_s, summary.first_life_s) = (0.0, None, None);
    for rung in &mut summary.rungs {
        rung.seconds = 0.0;
    }
    summary
}

#[test]
fn a_run_that_is_stopped_on_any_mesh_goes_on_bit_for_bit() {
    let scene = scene("demonstration_quick", &SMALL);
    let plan = Plan::new(&scene).unwrap();
    let n_meshes = Ladder::of(&scene, &plan).meshes().len();
    assert_eq!(n_meshes, 2);
    let whole = Frames::default();
    let run = Session::start(request(&scene, Ending::Passages, watched(&whole))).unwrap();
    let whole_outcome = run.join().unwrap();
    let mut meshes = std::collections::BTreeSet::new();
    // By the clock: wherever it is stopped it must go on alike, and at least one of the stops falls on each mesh.
    for (nodes, wait_ms) in [65, 129]
        .into_iter()
        .flat_map(|nodes| [0, 90].map(|ms| (nodes, ms)))
    {
        let first = Frames::default();
        let session = Session::start(request(&scene, Ending::Passages, watched(&first))).unwrap();
        while session.handle.status().nodes < nodes && !session.is_finished() {
            std::thread::sleep(Duration::from_millis(1));
        }
        std::thread::sleep(Duration::from_millis(wait_ms));
        session.handle.send(Command::Stop);
        let stopped = session.join().unwrap();
        let Some(checkpoint) = stopped.checkpoint else {
            continue;
        };
        let text = serde_json::to_string(&*checkpoint).unwrap();
        let read: Checkpoint = serde_json::from_str(&text).unwrap();
        meshes.insert(read.climb.nodes);
        let rest = Frames::default();
        let going_on = request(&scene, Ending::Passages, watched(&rest));
        let outcome = Session::resume(going_on, read).unwrap().join().unwrap();
        assert!(matches!(outcome.end, End::Done), "{:?}", outcome.end);
        let (first, rest) = (first.0.lock().unwrap(), rest.0.lock().unwrap());
        let both: Vec<_> = first.iter().chain(rest.iter()).cloned().collect();
        assert!(
            both == *whole.0.lock().unwrap(),
            "frames after {wait_ms} ms"
        );
        assert_eq!(untimed(&outcome), untimed(&whole_outcome), "{wait_ms} ms");
    }
    assert!(meshes.len() > 1, "{meshes:?}");
}

/// What makes a saved run one that no run saves.
type Spoil = fn(&mut Checkpoint);

#[test]
fn a_climb_that_no_run_makes_is_refused() {
    let run = scene("demonstration_quick", &SMALL);
    let session = Session::start(request(&run, Ending::Passages, Vec::new())).unwrap();
    // Stopped on the first mesh, with its passage begun.
    while session.handle.status().nodes != 129 && !session.is_finished() {
        std::thread::sleep(Duration::from_millis(1));
    }
    session.handle.send(Command::Stop);
    let whole = session.join().unwrap().checkpoint.unwrap();
    let table: [(&str, Spoil); 3] = [
        ("no such mesh", |saved| saved.climb.nodes = 77),
        ("another mesh", |saved| saved.climb.nodes = 65),
        ("a launch of another scene", |saved| {
            let other = scene(
                "demonstration_quick",
                &[&SMALL[..], &["stress.depths=9"]].concat(),
            );
            let sim = Simulation::new(&other, Plan::new(&other).unwrap(), 1).unwrap();
            saved.climb.launch = Some(sim.save());
        }),
    ];
    for (what, spoil) in table {
        let mut saved = (*whole).clone();
        spoil(&mut saved);
        let resumed = Session::resume(request(&run, Ending::Passages, Vec::new()), saved);
        let end = resumed.unwrap().join().unwrap().end;
        let refused = matches!(end, End::NotStarted(SimError::State(_)));
        assert!(refused, "{what}: {end:?}");
    }
}

/// Waits until the run has settled on its last mesh.
fn settle(session: &Session) {
    loop {
        let settled = session.handle.settled();
        if settled.is_some_and(|settled| settled.is_last) || session.is_finished() {
            return;
        }
        std::thread::sleep(Duration::from_millis(5));
    }
}

#[test]
fn a_turned_knob_goes_down_and_the_run_is_repeated_bit_for_bit() {
    let scene = scene(
        "demonstration_quick",
        &[&SMALL[..], &["motion.slide_roll=1"]].concat(),
    );
    let live = Frames::default();
    let session = Session::start(request(&scene, Ending::OnStop, watched(&live))).unwrap();
    settle(&session);
    let nodes = session.handle.status().nodes;
    session.handle.send(Command::Set(Knob::SlideRoll, TURNED));
    // Down, and up again: first a mesh that is not the last tells what it has found there.
    let mut told = Vec::new();
    loop {
        if let Some(settled) = session.handle.settled()
            && (settled.frames[0].metrics.slide_roll - TURNED).abs() < 1e-9
        {
            if told.last() != Some(&settled.frames[0].nx) {
                told.push(settled.frames[0].nx);
            }
            if settled.is_last {
                break;
            }
        }
        std::thread::sleep(Duration::from_millis(1));
    }
    assert_eq!(told, [65, 129]);
    assert_eq!((session.handle.status().nodes, nodes), (129, 129));
    session.handle.send(Command::Stop);
    let outcome = session.join().unwrap();
    let live = live.0.lock().unwrap().clone();
    assert!(
        live.iter().all(|frame| frame.2 == 129),
        "the last mesh alone"
    );
    let steps: Vec<u64> = live.iter().map(|frame| frame.0).collect();
    assert!(
        steps.windows(2).all(|pair| pair[1] == pair[0] + 1),
        "{steps:?}"
    );
    assert!(live.windows(2).all(|pair| pair[1].1 > pair[0].1));
    let turns: Vec<HandTurn> = outcome
        .applied
        .iter()
        .filter_map(asperity_session::run::AppliedCommand::to_repeat)
        .collect();
    let again = Frames::default();
    let last = *steps.last().unwrap();
    let repeated = request(&scene, Ending::Steps(last), watched(&again));
    let session = Session::repeat(repeated, turns).unwrap();
    session.join().unwrap();
    let again = again.0.lock().unwrap();
    assert_eq!(again.len(), live.len());
    assert!(*again == live, "a frame differs");
}

#[test]
fn a_live_run_that_nobody_turns_gives_the_frames_of_a_run_by_itself() {
    let scene = scene("demonstration_quick", &SMALL);
    let (alone, live) = (Frames::default(), Frames::default());
    let run = Session::start(request(&scene, Ending::Passages, watched(&alone))).unwrap();
    run.join().unwrap();
    let session = Session::start(request(&scene, Ending::OnStop, watched(&live))).unwrap();
    settle(&session);
    session.handle.send(Command::Stop);
    session.join().unwrap();
    let (alone, live) = (alone.0.lock().unwrap(), live.0.lock().unwrap());
    let n = alone.len().min(live.len());
    assert!(n > 10 && alone[..n] == live[..n]);
}

/// Surfaces that a hundred thousand cycles wear.
const WORN: [&str; 5] = [
    "motion.slide_roll=0.5",
    "wear.coefficient_1_per_pa=1e-17",
    "wear.coefficient_2_per_pa=1e-17",
    "age.cycles=1e5",
    "age.tolerance=0.1",
];

/// On the screen surfaces age from the first second, on the first mesh; the next one ages them anew and takes its place when
/// they are as old there.
#[test]
fn surfaces_age_on_every_mesh() {
    let scene = scene("demonstration_quick", &[&SMALL[..], &WORN].concat());
    let most = scene.age.unwrap().cycles;
    let session = Session::start(request(&scene, Ending::OnStop, Vec::new())).unwrap();
    let (frames, mut seen) = (session.handle.latest(), Vec::new());
    while !session.handle.settled().is_some_and(|one| one.is_last) && !session.is_finished() {
        if let Some(age) = frames
            .take()
            .and_then(|frame| Some((frame.nx, frame.age?.cycles)))
        {
            seen.push(age);
        }
        std::thread::sleep(Duration::from_millis(1));
    }
    session.handle.send(Command::Stop);
    let on_the_way: Vec<f64> = (seen.iter().filter(|age| age.0 == 65))
        .map(|age| age.1)
        .collect();
    assert!(
        on_the_way.iter().filter(|&&cycles| cycles < most).count() > 3,
        "{seen:?}"
    );
    assert!(on_the_way.is_sorted());
    assert!(
        seen.iter()
            .all(|&(nodes, cycles)| nodes == 65 || cycles == most),
        "{seen:?}"
    );
}

/// What two meshes are apart in is the mesh's: both have aged.
#[test]
fn the_error_of_an_aged_life_is_of_aged_meshes() {
    let [new, aged] = [&WORN[..1], &WORN[..]].map(|sets| {
        let sets = [&SMALL[..], sets].concat();
        outcome("demonstration_quick", &sets, true)
    });
    println!("new {:?}, aged {:?}", new.rungs, aged.rungs);
    let below = aged.rungs[0].life_relative.unwrap();
    assert_ne!(new.rungs[0].life_relative, Some(below));
    let apart = (aged.life_relative.unwrap() / below).ln().abs();
    let error = aged.error_ln_life.unwrap();
    assert!(error >= apart, "{error} {apart}");
}

/// Most that a row of body 1, whose ridges are alike across, lies below its own rim, m: the mean along it, for where nodes meet
/// the deepest place hangs on the phase.
fn worn_1_m(frame: &Frame) -> f64 {
    let rows = || frame.roughness_1_m.chunks_exact(frame.nx);
    let rim = rows().next().unwrap();
    let depth = |row: &[f32]| {
        let places = rim.iter().zip(row);
        places.map(|(rim, here)| f64::from(rim - here)).sum::<f64>() / frame.nx as f64
    };
    rows().map(depth).fold(0.0, f64::max)
}

/// Who turns a knob after surfaces have aged looks at the same worn surfaces on every mesh: the finer one does not begin with
/// new ones at what was turned.
#[test]
fn a_knob_turned_after_ageing_leaves_surfaces_worn_on_every_mesh() {
    let scene = scene("demonstration_quick", &[&SMALL[..], &WORN].concat());
    let session = Session::start(request(&scene, Ending::OnStop, Vec::new())).unwrap();
    settle(&session);
    // Aged anew there, surfaces would have lost a third more.
    session.handle.send(Command::Set(Knob::SlideRoll, TURNED));
    let mut worn: Vec<(usize, f64, f64)> = Vec::new();
    while !session.is_finished() {
        let settled = session.handle.settled();
        let is_there = |one: &Settled| (one.frames[0].metrics.slide_roll - TURNED).abs() < 1e-9;
        if let Some(settled) = settled.filter(|one| is_there(one)) {
            let frame = &settled.frames[0];
            if worn.last().is_none_or(|last| last.0 != frame.nx) {
                worn.push((frame.nx, frame.cycles.unwrap(), worn_1_m(frame)));
            }
            if settled.is_last {
                break;
            }
        }
        std::thread::sleep(Duration::from_millis(1));
    }
    session.handle.send(Command::Stop);
    println!("nodes, cycles, worn off body 1 (m): {worn:?}");
    let [coarse, fine] = worn[..] else {
        panic!("{worn:?}")
    };
    assert_eq!([coarse.0, fine.0], [65, 129]);
    assert_eq!([coarse.1, fine.1], [scene.age.unwrap().cycles; 2]);
    // A hundredth of the amplitude: some of it is gone.
    assert!(
        coarse.2 > 5e-9 && (fine.2 / coarse.2 - 1.0).abs() < 0.1,
        "{worn:?}"
    );
}

/// What of a frame a knob turns.
type Reading = fn(&Metrics) -> f64;

/// Seconds from `since` until a life has settled that `is_it` takes for what is waited for.
fn seconds_to(session: &Session, since: Instant, is_it: impl Fn(&Settled) -> bool) -> f64 {
    while !session.handle.settled().is_some_and(|one| is_it(&one)) && !session.is_finished() {
        std::thread::sleep(Duration::from_millis(1));
    }
    since.elapsed().as_secs_f64()
}

/// As long as somebody holds it, a run stays before its third mesh, and obeys all the same.
#[test]
fn a_run_that_is_held_waits_before_its_third_mesh() {
    let scene = scene("fzg_pitch_point", &[]);
    let session = Session::start(request(&scene, Ending::OnStop, Vec::new())).unwrap();
    let hold = session.handle.hold();
    let copy = hold.clone();
    drop(hold);
    let waits = |until: &dyn Fn() -> bool| {
        let began = Instant::now();
        while !until() {
            assert!(began.elapsed() < Duration::from_mins(2), "still waits");
            std::thread::sleep(Duration::from_millis(1));
        }
    };
    let status = || session.handle.status();
    let settled = || session.handle.settled();
    for turn in 0..2 {
        waits(&|| status().rungs.len() == 2 && status().nodes == 257);
        let before = status().progress;
        std::thread::sleep(Duration::from_millis(300));
        assert_eq!(status().progress, before);
        assert!(settled().is_some_and(|settled| !settled.is_last));
        if turn == 0 {
            let speed = 1.1 * scene.motion.entrainment_m_s;
            session
                .handle
                .send(Command::Set(Knob::EntrainmentMS, speed));
            waits(&|| status().rungs.is_empty());
        }
    }
    drop(copy);
    waits(&|| settled().is_some_and(|settled| settled.is_last));
    session.handle.send(Command::Stop);
    session.join().unwrap();
}

/// The default scene as the explorer runs it, with nothing beside: the first settled life, the last mesh's, and the first one
/// after a turn of each knob, over what a headless run on 65 nodes takes.
#[test]
#[ignore = "prints times, for a quiet machine"]
fn times_to_the_first_life_to_the_last_mesh_and_after_turns() {
    let began = Instant::now();
    outcome("demonstration", &["grid.nodes=65"], true);
    let unit = began.elapsed().as_secs_f64();
    println!("a run on 65 nodes: {unit:.2} s");
    let told = |what: &str, seconds: f64| {
        println!("{what}: {seconds:.2} s, {:.2} times", seconds / unit);
    };
    let scene = scene("demonstration", &[]);
    let began = Instant::now();
    let session = Session::start(request(&scene, Ending::OnStop, Vec::new())).unwrap();
    told("first settled life", seconds_to(&session, began, |_| true));
    told(
        "last mesh settled",
        seconds_to(&session, began, |settled| settled.is_last),
    );
    let settled = session.handle.settled().unwrap();
    let steps = settled.frames.last().unwrap().step;
    println!("after {steps} steps of its passage");
    // The explorer pauses a run whose period it replays.
    session.handle.send(Command::Pause);
    curve(&scene, &session, &told);
    session.handle.send(Command::Pause);
    let turns: [(Knob, f64, Reading); 4] = [
        (Knob::SlideRoll, 0.8, |m| m.slide_roll),
        (Knob::ForceN, 1000.0, |m| m.load_n),
        (Knob::Amplitude1M, 4e-7, |m| m.amplitude_1_m),
        (Knob::EntrainmentMS, 0.3, |m| m.entrainment_m_s),
    ];
    for (knob, value, of) in turns {
        let began = Instant::now();
        session.handle.send(Command::Set(knob, value));
        let is_there =
            |settled: &Settled| (of(&settled.frames[0].metrics) / value - 1.0).abs() < 1e-9;
        told(
            &format!("after a turn of {knob:?}"),
            seconds_to(&session, began, is_there),
        );
    }
    session.handle.send(Command::Stop);
    session.join().unwrap();
}

/// The other values of S that the explorer's curve visits, on the first mesh.
fn curve(scene: &Arc<Scene>, session: &Session, told: &dyn Fn(&str, f64)) {
    let settled = session.handle.settled().unwrap();
    let ground = Ground::of(scene, &settled).unwrap();
    let values = [0.05, 0.1, 0.25, 0.5, 0.75, 1.0, 1.25, 1.5, 1.75];
    let mut values: Vec<f64> = values.into_iter().flat_map(|s| [s, -s]).collect();
    values.push(0.0);
    values.retain(|s| *s != scene.motion.slide_roll);
    let order = CurveOrder {
        varied: Varied::Along(Along::SlideRoll),
        values,
        scene: (**scene).clone(),
    };
    let began = Instant::now();
    let sweep = Background::start(ground, order, 2, None);
    let mut found = 0;
    while sweep.progress().is_some() {
        std::thread::sleep(Duration::from_millis(1));
        found += sweep.take().len();
    }
    found += sweep.take().len();
    told(
        &format!("{found} more values of S"),
        began.elapsed().as_secs_f64(),
    );
}
