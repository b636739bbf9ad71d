//! A recording repeats its run bit for bit: the scene, and the knobs that were turned by hand while it ran.
#![cfg(feature = "rerun")]
#![expect(clippy::unwrap_used, reason = "tests")]

use std::path::Path;
use std::sync::Arc;
use std::time::Duration;

use crate::common::keeper::{Kept, kept_request};
use asperity_engine::observe::{Observer as _, Overwrite, RunContext};
use asperity_engine::scene::{Override, Record, Scene};
use asperity_engine::sim::Knob;
use asperity_recorder::{Recorded, Recorder};
use asperity_session::run::{Command, Ending, HandTurn, Request, Session, Watcher};
use asperity_session::{Queue, WhenFull};

fn request(scene: &Scene, record: Option<&Path>, ending: Ending) -> (Request, Kept) {
    let recording = record.map(|path| {
        let recorder = Recorder::create(path, Overwrite::Refuse, &Record::default()).unwrap();
        let queue = Queue::spawn("record", 8, WhenFull::Wait, Box::new(recorder)).unwrap();
        Watcher::new("recording", Box::new(queue), 1)
    });
    kept_request(scene, 2, recording, ending)
}

fn wait_for_steps(session: &Session, steps: u64) {
    while session.handle.status().steps < steps {
        assert!(!session.is_finished(), "ended before step {steps}");
        std::thread::sleep(Duration::from_millis(1));
    }
}

fn small(sets: &[&str]) -> Scene {
    let all = ["grid.nodes=65", "stress.depths=8"];
    let sets: Vec<Override> = all.iter().chain(sets).map(|s| s.parse().unwrap()).collect();
    Scene::load_with("demonstration_quick", &sets).unwrap()
}

#[test]
fn a_session_with_turned_knobs_repeats_bit_for_bit() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("lecture.rrd");
    let mut scene = small(&[]);
    // A script of its own is played again by the scene and must not be played twice.
    scene.events.push(
        toml::from_str("at_s = 1e-5\ncaption = 'up'\nset = { 'motion.slide_roll' = 0.7 }").unwrap(),
    );
    let (request, kept) = self::request(&scene, Some(&path), Ending::OnStop);
    let session = Session::start(request).unwrap();
    // Whenever these arrive, in the start-up and in the passage: the recording knows when it was.
    session.handle.send(Command::Set(Knob::ForceN, 700.0));
    std::thread::sleep(Duration::from_millis(150));
    session
        .handle
        .send(Command::Set(Knob::Amplitude2M, 1.25e-7));
    wait_for_steps(&session, 4);
    session
        .handle
        .send(Command::Set(Knob::SlideRoll, 1.0 / 3.0));
    wait_for_steps(&session, 20);
    session.handle.send(Command::Set(Knob::EntrainmentMS, 0.9));
    wait_for_steps(&session, 40);
    session.handle.send(Command::Stop);
    let outcome = session.join().unwrap();
    assert!(outcome.output_errors.is_empty());
    // Whoever goes on from its state is told that it is not the scene's own run.
    let saved = outcome.checkpoint.as_ref().unwrap();
    assert_eq!(saved.n_turned_by_hand, 4);

    let recorded = Recorded::read(&path).unwrap();
    assert_eq!(recorded.last_step, outcome.steps);
    assert_eq!(recorded.turns.len(), 4, "{:?}", recorded.turns);
    assert_eq!(recorded.turns[2].value, 1.0 / 3.0);
    assert_eq!(recorded.turns[0].steps_made, 0);
    let again = Scene::from_toml(&recorded.scene_toml).unwrap();
    assert_eq!(again, scene);
    let turns = recorded.turns.iter().map(|turn| HandTurn {
        steps_made: turn.steps_made,
        command: Command::Set(Knob::from_key(&turn.key).unwrap(), turn.value),
    });
    let ending = Ending::Steps(recorded.last_step);
    let (request, kept_again) = self::request(&again, None, ending);
    let outcome = Session::repeat(request, turns.collect())
        .unwrap()
        .join()
        .unwrap();
    assert_eq!(outcome.steps, recorded.last_step);
    let (one, two) = (kept.lock().unwrap(), kept_again.lock().unwrap());
    assert_eq!(one.len(), two.len());
    assert!(one.len() > 40);
    let differs = one.iter().zip(two.iter()).position(|(one, two)| one != two);
    assert_eq!(differs, None, "entry that differs");
}

#[test]
fn what_cannot_be_repeated_is_refused_in_words() {
    let folder = tempfile::tempdir().unwrap();
    let refused = |name: &str, bytes: &[u8]| {
        let path = folder.path().join(name);
        std::fs::write(&path, bytes).unwrap();
        Recorded::read(&path).unwrap_err().reason
    };
    assert!(refused("empty.rrd", b"").contains("recording"));
    assert!(refused("text.rrd", b"not a recording at all").contains("recording"));
    let missing = Recorded::read(&folder.path().join("nowhere.rrd")).unwrap_err();
    assert!(missing.reason.contains("cannot be read"), "{missing}");
    // A recording that holds a scene and no step.
    let path = folder.path().join("start-up.rrd");
    let mut recorder = Recorder::create(&path, Overwrite::Refuse, &Record::default()).unwrap();
    let scene = small(&[]);
    let context = RunContext {
        scene_toml: scene.to_toml(),
        plan_text: String::new(),
        program: "asperity".to_owned(),
        began: asperity_engine::observe::Began::FromScene,
        scene: Arc::new(scene),
    };
    recorder.begin(&context).unwrap();
    recorder.idle().unwrap();
    let reason = Recorded::read(&recorder.path().unwrap())
        .unwrap_err()
        .reason;
    assert!(reason.contains("no step"), "{reason}");
    // Finished without a step it holds nothing that is worth a file.
    recorder.finish().unwrap();
    assert!(!path.exists());
    // One that went on from a state.
    let path = folder.path().join("state.rrd");
    let mut recorder = Recorder::create(&path, Overwrite::Refuse, &Record::default()).unwrap();
    let context = RunContext {
        began: asperity_engine::observe::Began::FromState,
        ..context
    };
    recorder.begin(&context).unwrap();
    recorder.idle().unwrap();
    let reason = Recorded::read(&recorder.path().unwrap())
        .unwrap_err()
        .reason;
    assert!(reason.contains("--from-state"), "{reason}");
}

/// The command line: the table of the repetition is the table of the run, byte for byte.
#[test]
fn run_from_a_recording_writes_the_same_table() {
    let folder = tempfile::tempdir().unwrap();
    let asperity = |args: &[&str]| {
        let mut command = std::process::Command::new(env!("CARGO_BIN_EXE_asperity"));
        let output = command
            .current_dir(folder.path())
            .arg("run")
            .args(args)
            .output();
        output.unwrap()
    };
    let first = [
        "--set=grid.nodes=65",
        "--set=stress.depths=8",
        "--set=motion.slide_roll=0.75",
        "--passages=0.5",
        "--out=one.rrd",
        "--table=one.csv",
    ];
    let done = asperity(&first);
    assert!(
        done.status
            .code()
            .is_some_and(|code| code == 0 || code == 2)
    );
    let again = asperity(&["--from=one.rrd", "--table=two.csv"]);
    assert_eq!(again.status.code(), done.status.code());
    let table = |name: &str| std::fs::read(folder.path().join(name)).unwrap();
    assert!(table("one.csv").len() > 1000);
    assert!(table("one.csv") == table("two.csv"));
    assert!(folder.path().join("one-again.rrd").exists());
    // A recording says what it repeats; nothing may be set on top.
    let both = asperity(&["--from=one.rrd", "--set=grid.nodes=33"]);
    assert_eq!(both.status.code(), Some(1));
    let none = asperity(&["--from=none.rrd"]);
    assert_eq!(none.status.code(), Some(1));
    assert!(String::from_utf8_lossy(&none.stderr).contains("none.rrd"));
}
