//! Damaged recordings given to `run --from`: each is repeated exactly or refused in words. A run that was killed is
//! repeated as far as its recording goes, and says that this is not all.
#![cfg(feature = "rerun")]
#![expect(clippy::unwrap_used, reason = "tests")]

use crate::common::synthetic;
use std::path::{Path, PathBuf};
use std::process::Output;

use asperity_engine::observe::{Observer, Overwrite, RunEvent, RunEventKind, SetBy};
use asperity_engine::scene::Record;
use asperity_recorder::{Recorded, Recorder, RereadError};

const STEPS: u64 = 24;

/// A recording of made-up frames with knobs turned on the way. `Whole`: closed; else as a kill leaves it.
fn record(path: &Path, closed: bool) {
    let record = Record {
        every_steps: 4,
        ..Record::default()
    };
    let mut recorder = Recorder::create(path, Overwrite::Refuse, &record).unwrap();
    let scene = synthetic::scene(33, 1.0);
    recorder.begin(&synthetic::context(scene)).unwrap();
    for step in 1..=STEPS {
        if step % 8 == 5 {
            let kind = RunEventKind::Set {
                key: "motion.slide_roll".to_owned(),
                value: 0.1 * step as f64,
                by: SetBy::Hand,
                steps_made: 100 + step,
            };
            let event = RunEvent {
                step,
                time_s: 1e-5 * step as f64,
                kind,
            };
            recorder.event(&event).unwrap();
        }
        recorder.frame(&synthetic::frame(33, step)).unwrap();
        if step % 6 == 0 {
            recorder.idle().unwrap();
        }
    }
    if closed {
        recorder.finish().unwrap();
    } else {
        // What the system keeps of a killed process is what had been written.
        std::fs::copy(path, path.with_extension("killed.rrd")).unwrap();
    }
}

struct Attack {
    folder: tempfile::TempDir,
    path: PathBuf,
}

impl Attack {
    fn new() -> Self {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("attacked.rrd");
        Self { folder, path }
    }

    fn read(&self, bytes: &[u8]) -> Result<Recorded, RereadError> {
        std::fs::write(&self.path, bytes).unwrap();
        Recorded::read(&self.path)
    }

    /// The recording, with its bytes.
    fn recording(&self, closed: bool) -> (Vec<u8>, Recorded) {
        let path = self.folder.path().join("run.rrd");
        record(&path, closed);
        let path = if closed {
            path
        } else {
            path.with_extension("killed.rrd")
        };
        (
            std::fs::read(&path).unwrap(),
            Recorded::read(&path).unwrap(),
        )
    }
}

fn flipped(bytes: &[u8], bit: usize) -> Vec<u8> {
    let mut damaged = bytes.to_vec();
    damaged[bit / 8] ^= 1 << (bit % 8);
    damaged
}

/// What repeats the run, whatever else is broken.
fn same_run(one: &Recorded, other: &Recorded) -> bool {
    let neutral = |run: &Recorded| Recorded {
        damage: None,
        ..run.clone()
    };
    neutral(one) == neutral(other)
}

#[test]
fn a_bit_that_was_flipped_changes_nothing_or_is_told() {
    let attack = Attack::new();
    let (bytes, whole) = attack.recording(true);
    assert_eq!((whole.last_step, whole.turns.len()), (STEPS, 3));
    assert_eq!((&whole.broken_off, &whole.damage), (&None, &None));
    // All bits of the beginning, then all over the file.
    let head = 0..8 * 200;
    let stride = (8 * bytes.len() / 2000).max(1) | 1;
    let (mut exact, mut refused) = (0, 0);
    for bit in head.chain((0..8 * bytes.len()).step_by(stride)) {
        match attack.read(&flipped(&bytes, bit)) {
            Ok(run) => {
                assert!(same_run(&run, &whole), "bit {bit}: {run:?}");
                exact += 1;
            }
            Err(error) => {
                assert!(!error.reason.is_empty());
                refused += 1;
            }
        }
    }
    println!("{} bytes: {exact} exact, {refused} refused", bytes.len());
    assert!(exact > 100 && refused > 100, "{exact}, {refused}");
}

#[test]
fn a_closed_recording_that_was_cut_is_no_killed_run() {
    let attack = Attack::new();
    let (bytes, whole) = attack.recording(true);
    let mut refused = 0;
    // All over the file, and every cut into what the recorder writes last: the footer of 32 bytes and the index before it.
    let last = bytes.len() - 200..bytes.len();
    for length in (0..last.start).step_by(397).chain(last) {
        match attack.read(&bytes[..length]) {
            // What follows the last word on the run repeats nothing.
            Ok(run) => {
                assert!(same_run(&run, &whole), "{length} bytes");
                assert!(run.damage.is_some(), "{length} bytes");
            }
            Err(error) => {
                assert!(!error.reason.is_empty());
                refused += 1;
            }
        }
    }
    println!("{refused} refused of {} bytes", bytes.len());
    assert!(refused > bytes.len() / 397 / 2);
}

#[test]
fn a_killed_run_goes_as_far_as_its_recording() {
    let attack = Attack::new();
    let (bytes, killed) = attack.recording(false);
    assert_eq!(killed.last_step, STEPS);
    assert!(killed.broken_off.is_some());
    let mut reached = Vec::new();
    for length in (0..bytes.len()).step_by(397).chain([bytes.len()]) {
        if let Ok(run) = attack.read(&bytes[..length]) {
            assert!(run.broken_off.is_some(), "{length} bytes");
            assert!(run.last_step == 1 || run.last_step % 6 == 0);
            let turns = killed.turns.iter();
            let by_then = turns.filter(|turn| turn.steps_made <= 100 + run.last_step);
            assert_eq!(run.turns, by_then.cloned().collect::<Vec<_>>());
            reached.push(run.last_step);
        }
    }
    assert!(reached.is_sorted());
    reached.dedup();
    assert_eq!(reached, [1, 6, 12, 18, 24]);
}

/// Bytes of a number in a message, as a protobuf has it.
fn forged(bytes: &[u8], at: usize, value: u64) -> Vec<u8> {
    let mut damaged = bytes.to_vec();
    damaged[at..at + 8].copy_from_slice(&value.to_le_bytes());
    damaged
}

/// Numbers that are no lengths, over every eight bytes of the beginning and over some of the rest.
#[test]
fn forged_lengths_ask_for_nothing() {
    let attack = Attack::new();
    let (bytes, whole) = attack.recording(true);
    let places = (0..400).chain((400..bytes.len() - 8).step_by(10_007));
    for at in places {
        for value in [u64::MAX, 1 << 62, 1 << 40, 1 << 31] {
            if let Ok(run) = attack.read(&forged(&bytes, at, value)) {
                assert!(same_run(&run, &whole), "{value} at {at}");
            }
        }
    }
}

fn asperity(folder: &Path, args: &[&str]) -> Output {
    let mut command = std::process::Command::new(env!("CARGO_BIN_EXE_asperity"));
    command.current_dir(folder).args(args).output().unwrap()
}

/// The program itself: exit codes, words, the same table.
#[test]
fn the_program_repeats_exactly_or_says_what_it_found() {
    let folder = tempfile::tempdir().unwrap();
    let place = folder.path();
    let run = [
        "run",
        "--passages=0.25",
        "--set=grid.nodes=33",
        "--set=life=none",
        "--set=stress=none",
        "--set=body_1.surface.kind=smooth",
        "--set=body_2.surface.kind=smooth",
        "--out=run.rrd",
        "--table=run.csv",
    ];
    let done = asperity(place, &run);
    assert!(matches!(done.status.code(), Some(0 | 2)), "{done:?}");
    let bytes = std::fs::read(place.join("run.rrd")).unwrap();
    let table = std::fs::read(place.join("run.csv")).unwrap();
    let repeat = [
        "run",
        "--from=bad.rrd",
        "--no-record",
        "--force",
        "--table=again.csv",
    ];
    let mut codes = std::collections::BTreeMap::new();
    let cut = |length: usize| bytes[..length].to_vec();
    let bits = (0..40).map(|k| flipped(&bytes, 8 * bytes.len() / 40 * k + 3));
    let cuts = (1..8).map(|k| cut(bytes.len() * k / 8));
    for damaged in bits.chain(cuts) {
        let length = damaged.len();
        std::fs::write(place.join("bad.rrd"), damaged).unwrap();
        let again = asperity(place, &repeat);
        let told = String::from_utf8_lossy(&again.stderr);
        assert!(!told.contains("panicked"), "{told}");
        let code = again.status.code().unwrap();
        *codes.entry(code).or_insert(0) += 1;
        if code == 1 {
            assert!(told.contains("bad.rrd"), "{told}");
        } else {
            assert_eq!(Some(code), done.status.code(), "{told}");
            assert!(length == bytes.len() || told.contains("damaged"), "{told}");
            assert!(std::fs::read(place.join("again.csv")).unwrap() == table);
        }
    }
    println!("exit codes: {codes:?}");
    assert!(codes.get(&1).is_some_and(|n| *n > 2), "{codes:?}");
}
