//! A run that is saved and taken up again equals the uninterrupted one, bit for bit.
#![expect(clippy::unwrap_used, reason = "tests")]

use crate::common::keeper::{bits, kept_request};
use asperity_engine::plan::Plan;
use asperity_engine::scene::{Override, Scene};
use asperity_engine::sim::{Frame, Simulation, State, Stats};
use asperity_session::run::{Checkpoint, CheckpointError, End, Ending, Outcome, Session};

fn scene(sets: &[&str]) -> Scene {
    let sets: Vec<Override> = sets.iter().map(|s| s.parse().unwrap()).collect();
    Scene::load_with("demonstration_quick", &sets).unwrap()
}

const SMALL: [&str; 3] = ["grid.nodes=65", "stress.depths=8", "record=none"];

fn simulation(scene: &Scene) -> Simulation {
    Simulation::new(scene, Plan::new(scene).unwrap(), 2).unwrap()
}

fn through_json(state: &State) -> State {
    serde_json::from_str(&serde_json::to_string(state).unwrap()).unwrap()
}

#[test]
fn every_frame_after_a_restart_is_the_uninterrupted_one() {
    let scene = scene(&[&SMALL[..], &["grid.nodes=129"]].concat());
    let mut whole = simulation(&scene);
    let mut frame = Frame::default();
    let mut cut: Option<Simulation> = None;
    let mut compared = 0;
    // Cut in the smooth start-up, on the fine grid, in the development, and in the passage.
    for step in 0..400 {
        if [3, 70, 180, 270].contains(&step) {
            let mut next = simulation(&scene);
            next.restore(&through_json(&whole.save())).unwrap();
            next.count_from(*whole.stats()).unwrap();
            let mut again = Frame::default();
            whole.fill(&mut frame);
            next.fill(&mut again);
            assert!(bits(&frame) == bits(&again), "at once after step {step}");
            cut = Some(next);
        }
        whole.step().unwrap();
        if let Some(cut) = &mut cut {
            cut.step().unwrap();
            let mut again = Frame::default();
            whole.fill(&mut frame);
            cut.fill(&mut again);
            assert!(bits(&frame) == bits(&again), "after step {step}");
            compared += 1;
        }
        if whole.passage_steps() == 24 {
            break;
        }
    }
    assert_eq!(whole.passage_steps(), 24);
    assert!(compared > 250);
    assert_eq!(whole.summary(), cut.unwrap().summary());
}

#[test]
fn dry_and_line_contacts_go_on_bit_for_bit_too() {
    let dry = scene(&[&SMALL[..], &["lubricant=none"]].concat());
    let line = Scene::load_with("fzg_point_b", &["record=none".parse().unwrap()]).unwrap();
    for scene in [dry, line] {
        let mut whole = simulation(&scene);
        while whole.passage_steps() < 5 {
            whole.step().unwrap();
        }
        let mut cut = simulation(&scene);
        cut.restore(&through_json(&whole.save())).unwrap();
        let (mut one, mut two) = (Frame::default(), Frame::default());
        for _ in 0..6 {
            whole.fill(&mut one);
            cut.fill(&mut two);
            assert!(bits(&one) == bits(&two));
            whole.step().unwrap();
            cut.step().unwrap();
        }
    }
}

/// A frame or an event, but for the steps that its session had made, which begin anew with each session.
fn told(text: &str) -> String {
    match text.split_once("steps_made: ") {
        Some((before, after)) => {
            before.to_owned() + after.trim_start_matches(|c: char| c.is_ascii_digit())
        }
        None => text.to_owned(),
    }
}

fn run(scene: &Scene, from: Option<Checkpoint>) -> (Vec<String>, Outcome) {
    let (request, kept) = kept_request(scene, 2, [], Ending::Passages);
    let session = match from {
        None => Session::start(request),
        Some(checkpoint) => Session::resume(request, checkpoint),
    };
    let outcome = session.unwrap().join().unwrap();
    let kept = kept.lock().unwrap().iter().map(|text| told(text)).collect();
    (kept, outcome)
}

/// Two scripted events, one on each side of the cut, which comes after 16 of 32 steps.
fn scripted(passages: f64) -> Scene {
    let mut scene = scene(&SMALL);
    scene.time.passages = Some(passages);
    let dt_s = Plan::new(&scene).unwrap().dt_s;
    for (at, s) in [(8.0, 1.0), (24.0, 0.2)] {
        let event = format!(
            "at_s = {:e}\ncaption = 'S = {s}'\nset = {{ 'motion.slide_roll' = {s:?} }}",
            (at + 0.5) * dt_s
        );
        scene.events.push(toml::from_str(&event).unwrap());
    }
    scene
}

#[test]
fn a_session_goes_on_through_a_file_with_its_script() {
    let (all, whole) = run(&scripted(0.5), None);
    let (first, cut) = run(&scripted(0.25), None);
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("half.state");
    let mut file = std::fs::File::create(&path).unwrap();
    cut.checkpoint.unwrap().write(&mut file).unwrap();
    let checkpoint = Checkpoint::read(&path).unwrap();
    let (second, rest) = run(&scripted(0.5), Some(checkpoint));
    assert!(all.len() > 32 && first.len() > 16 && second.len() > 16);
    assert!(all == [first, second].concat());
    let timeless = |outcome: &Outcome| {
        let mut summary = outcome.summary.clone().unwrap();
        (summary.wall_s, summary.steps_per_s) = (0.0, None);
        summary
    };
    assert_eq!(timeless(&whole), timeless(&rest));
    // Nothing is left to do: the same results, no further step.
    let done = run(&scripted(0.5), rest.checkpoint.map(|c| *c));
    assert!(done.0.is_empty());
    assert_eq!(timeless(&whole), timeless(&done.1));
}

#[test]
fn a_spoiled_or_foreign_state_is_refused() {
    let scene = scene(&[&SMALL[..], &["time.passages=0.02", "life=none"]].concat());
    let (_, outcome) = run(&scene, None);
    let checkpoint = *outcome.checkpoint.unwrap();
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("a.state");
    checkpoint
        .write(&mut std::fs::File::create(&path).unwrap())
        .unwrap();
    let text = std::fs::read_to_string(&path).unwrap();
    for spoiled in [
        text.replacen("\"h0\":", "\"h0\": ", 1),
        text[..text.len() / 2].to_owned(),
        String::new(),
        "{}".to_owned(),
    ] {
        assert!(spoiled != text);
        std::fs::write(&path, spoiled).unwrap();
        let error = Checkpoint::read(&path).unwrap_err();
        assert!(matches!(error, CheckpointError::File { .. }), "{error}");
    }
    let mut other = scene.clone();
    other.motion.slide_roll = 0.7;
    assert_eq!(
        checkpoint.fits(&other).unwrap_err(),
        CheckpointError::OtherScene("[motion]")
    );
    let (_, refused) = run(&other, Some(checkpoint.clone()));
    assert!(matches!(refused.end, End::NotStarted(_)));
    // The engine itself refuses what would not fit its memory.
    let finer = self::scene(&["grid.nodes=129", "record=none", "life=none"]);
    let error = simulation(&finer).restore(&checkpoint.sim).unwrap_err();
    println!("{error}");
}

/// A state whose digest is right and whose content no run has made: refused in words before a size is taken from it.
#[test]
fn crafted_states_are_refused_in_words() {
    use serde_json::{Value, json};
    let scene = scene(&[&SMALL[..], &["life.cycles=peaks"]].concat());
    let mut sim = simulation(&scene);
    while sim.passage_steps() < 3 {
        sim.step().unwrap();
    }
    let good = serde_json::to_value(sim.save()).unwrap();
    simulation(&scene)
        .restore(&serde_json::from_value(good.clone()).unwrap())
        .unwrap();
    let shorter = |pointer: &str| {
        let mut list = good.pointer(pointer).unwrap().as_array().unwrap().clone();
        list.pop();
        Value::Array(list)
    };
    let huge = json!(1_000_000_000_u64);
    let shares = good["life"]["variants"][0]["meter"]["mean"].clone();
    let point = |field: &str| format!("/counting/trackers/0/points/0/{field}");
    let capacity = point("pressure/open/0/capacity");
    let stack = point("shear/open/0/stack");
    let shears =
        ["turnings", "open", "spans", "tally", "last"].map(|of| point(&format!("shear/{of}")));
    let crafted = [
        ("/nodes", huge.clone()),
        ("/nodes", json!(129)),
        ("/contact/pressure", shorter("/contact/pressure")),
        ("/contact/sheared", json!([1.0])),
        ("/contact/pressure/100", json!(-1.0)),
        ("/contact/history/mass_3", json!([])),
        ("/contact/history/last_nodes", json!(-1.0)),
        ("/phase", json!({"Smooth": {"left": 1_u64 << 50}})),
        ("/phase", json!({"Develop": {"left": 1_u64 << 50}})),
        ("/step", json!(u64::MAX)),
        ("/time_s", json!(-1.0)),
        ("/way", json!(-1.0)),
        ("/motion/unsettled", json!(-1.0)),
        ("/pace/nodes", json!(0.0)),
        ("/orbit/period", json!(0.0)),
        ("/orbit/ring/2/film", json!([])),
        ("/drive/settings/0/now", json!(50.0)),
        ("/drive/settings/1/target", json!(1e12)),
        ("/drive/settings/1/rate", json!(1e12)),
        ("/wanted/settings/4/now", json!(-1.0)),
        ("/life/variants/0/meter/capacity", huge.clone()),
        ("/life/variants/0/meter/window/period", json!(0.0)),
        ("/life/variants/0/meter/window/round", json!(0.0)),
        (
            "/life/variants/0/meter/phases",
            json!([{"span": -1.0, "shares": shares}]),
        ),
        ("/life/variants/0/meter/mean/logs", json!([])),
        ("/life/variants/0/reference", json!([1.0])),
        ("/life/law/stress_exponent", json!(1.0)),
        ("/life/depths", shorter("/life/depths")),
        ("/life", Value::Null),
        ("/counting/trackers/0/spec/trace", huge.clone()),
        ("/counting/trackers/0/spec/points", huge.clone()),
        (&capacity[..], huge),
        (&stack[..], json!(vec![1.0; 200])),
        ("/counting/trackers/1/points", json!([])),
        ("/counting/trackers/1/shown", json!(999)),
        ("/counting/trackers/1/oldest", json!(5000)),
        ("/counting/shown_depth", json!(99)),
    ];
    let lists = shears.iter().map(|list| (&list[..], shorter(list)));
    for (pointer, value) in crafted.into_iter().chain(lists) {
        let mut state = good.clone();
        *state
            .pointer_mut(pointer)
            .unwrap_or_else(|| panic!("{pointer}")) = value.clone();
        let state: State = serde_json::from_value(state).unwrap();
        let mut fresh = simulation(&scene);
        let before = format!("{:?}", fresh.save());
        let error = fresh.restore(&state).expect_err(pointer);
        let value: String = value.to_string().chars().take(40).collect();
        println!("{pointer} = {value}: {error}");
        assert!(
            format!("{:?}", fresh.save()) == before,
            "{pointer}: as it was"
        );
    }
}

/// Waves stand on the finest grid alone: a start-up that has them before is refused, on the coarsest grid and on the finest.
#[test]
fn a_smooth_start_up_with_waves_is_refused() {
    let scene = scene(&["grid.nodes=129", "numerics.ladder=false", "stress.depths=8"]);
    let mut sim = simulation(&scene);
    let mut nodes = Vec::new();
    loop {
        let good = serde_json::to_value(sim.save()).unwrap();
        if good["phase"].get("Smooth").is_none() {
            break;
        }
        if nodes.last() != Some(&good["nodes"]) {
            nodes.push(good["nodes"].clone());
            let restored = |state: &serde_json::Value| {
                let state: State = serde_json::from_value(state.clone()).unwrap();
                simulation(&scene).restore(&state)
            };
            restored(&good).unwrap();
            for end in ["now", "target"] {
                let mut state = good.clone();
                *state
                    .pointer_mut(&format!("/drive/settings/2/{end}"))
                    .unwrap() = 1e-7.into();
                let error = restored(&state).unwrap_err().to_string();
                assert!(error.contains("its smooth start-up is rough"), "{error}");
            }
        }
        sim.step().unwrap();
    }
    assert_eq!(nodes, [65, 129]);
}

/// Counters from a file that would overflow.
#[test]
fn counts_that_no_run_makes_are_refused() {
    let mut sim = simulation(&scene(&SMALL));
    let counted = *sim.stats();
    let much = Stats {
        ffts: u64::MAX,
        ..counted
    };
    println!("{}", sim.count_from(much).unwrap_err());
    assert_eq!(*sim.stats(), counted);
}

/// A step that fails leaves the state as it was: here after a past whose oil no film of
/// one iteration can take in. That past is made with as many iterations as it needs: with one a step takes a hundred times as long.
#[test]
fn a_step_that_fails_leaves_the_state_as_it_was() {
    let sets = ["grid.nodes=65", "record=none", "stress=none", "life=none"];
    let mut past = simulation(&scene(&sets));
    while past.passage_steps() < 2 {
        past.step().unwrap();
    }
    let mut sim = simulation(&scene(
        &[&sets[..], &["numerics.max_iterations=1"]].concat(),
    ));
    let mut state = serde_json::to_value(past.save()).unwrap();
    for field in ["mass_1", "mass_2"] {
        let list = state["contact"]["history"][field].as_array_mut().unwrap();
        for (n, mass) in list.iter_mut().enumerate() {
            let spoiled = mass.as_f64().unwrap() * if n % 3 == 0 { 1e4 } else { 1e-4 };
            *mass = spoiled.into();
        }
    }
    sim.restore(&serde_json::from_value(state).unwrap())
        .unwrap();
    let mut frames = [Frame::default(), Frame::default()];
    let before = serde_json::to_value(sim.save()).unwrap();
    sim.fill(&mut frames[0]);
    println!("{}", sim.step().expect_err("a step that fails"));
    sim.fill(&mut frames[1]);
    assert!(before == serde_json::to_value(sim.save()).unwrap());
    assert!(bits(&frames[0]) == bits(&frames[1]));
    assert!(sim.stats().safer > 0);
}

/// What is no state at all is refused by the program at once, whatever it is.
#[cfg(unix)]
#[test]
fn devices_pipes_and_folders_are_no_states() {
    let folder = tempfile::tempdir().unwrap();
    let pipe = folder.path().join("pipe");
    let made = std::process::Command::new("mkfifo").arg(&pipe).status();
    assert!(made.unwrap().success());
    let spoiled = folder.path().join("spoiled.state");
    let body = "{\"program\":\"\",\"scene\":\"\",\"n_events_played\":0,\"n_unconverged\":0,\"n_turned_by_hand\":0,\"stats\":{},\"sim\":1}";
    let digest = body.bytes().fold(0xcbf2_9ce4_8422_2325_u64, |hash, byte| {
        (hash ^ u64::from(byte)).wrapping_mul(0x0100_0000_01b3)
    });
    std::fs::write(&spoiled, format!("asperity state 5 {digest:016x}\n{body}")).unwrap();
    let began = std::time::Instant::now();
    for path in [
        std::path::Path::new("/dev/zero"),
        &pipe,
        folder.path(),
        &spoiled,
    ] {
        let output = std::process::Command::new(env!("CARGO_BIN_EXE_asperity"))
            .current_dir(folder.path())
            .args([
                "run",
                "demonstration_quick",
                "--set=record=none",
                "--from-state",
            ])
            .arg(path)
            .output()
            .unwrap();
        let words = String::from_utf8_lossy(&output.stderr).into_owned();
        assert_eq!(output.status.code(), Some(1), "{words}");
        println!("{}", words.trim());
    }
    // At once each, alone; a busy machine takes its time.
    assert!(began.elapsed().as_secs() < 60);
}

/// Where all has been done there is no further step, and the summary is the run's in every field but its time.
#[test]
fn a_run_that_is_done_resumes_to_the_same_summary() {
    let sets = [
        "grid.nodes=65",
        "stress.depths=8",
        "record=none",
        "life.cycles=peaks",
        "life.spread=models",
    ];
    let mut scene = scene(&sets);
    scene.time.passages = Some(1.5);
    let (_, outcome) = run(&scene, None);
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("done.state");
    let mut file = std::fs::File::create(&path).unwrap();
    outcome
        .checkpoint
        .as_ref()
        .unwrap()
        .write(&mut file)
        .unwrap();
    let (frames, again) = run(&scene, Some(Checkpoint::read(&path).unwrap()));
    assert!(frames.is_empty());
    let timeless = |outcome: &Outcome| {
        let mut summary = outcome.summary.clone().unwrap();
        (summary.wall_s, summary.steps_per_s) = (0.0, None);
        summary
    };
    let whole = timeless(&outcome);
    assert!(whole.life_relative.is_some() && whole.cycles_end_depth_1_m.is_some());
    assert_eq!(whole, timeless(&again));
}
