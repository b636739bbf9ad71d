//! Recordings that end before their time: on a disk that fills, by a kill, by another program. What was written before is
//! read, nothing of it is wrong, and the words name what happened.
#![cfg(feature = "rerun")]
#![expect(clippy::unwrap_used, reason = "tests")]

use std::collections::BTreeMap;
use std::path::{Path, PathBuf};
use std::process::{Command, Output};

use asperity_engine::observe::{Observer, Overwrite, RunContext};
use asperity_engine::scene::{Record, Scene};
use asperity_engine::sim::Frame;
use asperity_recorder::{Recorded, RecordedFrames, Recorder};

use crate::common::synthetic;

const NODES: usize = 33;
const STEPS: u64 = 6;
/// Steps after which the recording is flushed, beside the first.
const FLUSHED: u64 = 2;

fn context() -> RunContext {
    let text = Scene::load("demonstration").unwrap().to_toml();
    RunContext {
        scene_toml: text.clone(),
        ..synthetic::context(Scene::from_toml(&text).unwrap())
    }
}

/// A recording of made-up frames; with what a kill before its end would have left.
fn record(folder: &Path) -> [PathBuf; 2] {
    let (path, killed) = (folder.join("run.rrd"), folder.join("killed.rrd"));
    let record = Record {
        every_steps: 1,
        budget_mb: 200.0,
    };
    let mut recorder = Recorder::create(&path, Overwrite::Refuse, &record).unwrap();
    recorder.begin(&context()).unwrap();
    for step in 1..=STEPS {
        recorder.frame(&synthetic::frame(NODES, step)).unwrap();
        if step % FLUSHED == 0 {
            recorder.idle().unwrap();
        }
    }
    std::fs::copy(&path, &killed).unwrap();
    recorder.finish().unwrap();
    [path, killed]
}

/// Frames of a whole recording, by their steps: every cut is compared with them.
type Whole = BTreeMap<u64, Frame>;

fn whole(path: &Path) -> Whole {
    let read = RecordedFrames::read(path).unwrap();
    assert_eq!(read.broken_off(), None);
    let shown = read.shown().into_iter();
    shown
        .map(|step| (step, read.frame(step).unwrap()))
        .collect()
}

/// The steps of a recording, which are those of the whole one, and where it breaks off; or why there are none.
fn steps(path: &Path, whole: &Whole) -> Result<(Vec<u64>, Option<String>), String> {
    let read = RecordedFrames::read(path).map_err(|error| error.reason)?;
    for step in read.shown() {
        let (one, other) = (read.frame(step).unwrap(), &whole[&step]);
        assert_eq!(one.pressure_pa, other.pressure_pa, "step {step}");
        assert_eq!(one.film_m, other.film_m, "step {step}");
        assert_eq!(one.roughness_1_m, other.roughness_1_m, "step {step}");
        assert_eq!(one.metrics.p_max_pa, other.metrics.p_max_pa, "step {step}");
    }
    let steps = read.steps().map(|frame| frame.step).collect();
    Ok((steps, read.broken_off().map(str::to_owned)))
}

#[test]
fn a_recording_that_is_cut_anywhere_is_read_up_to_there() {
    let folder = tempfile::tempdir().unwrap();
    let [path, killed] = record(folder.path());
    let whole = whole(&path);
    let cut = folder.path().join("cut.rrd");
    let mut reached = Vec::new();
    let bytes = std::fs::read(&killed).unwrap();
    for length in (0..bytes.len()).step_by(1999).chain([3, 7, bytes.len()]) {
        std::fs::write(&cut, &bytes[..length]).unwrap();
        let found = steps(&cut, &whole);
        let repeated = Recorded::read(&cut);
        match found {
            Ok((steps, words)) => {
                let last = *steps.last().unwrap();
                assert_eq!(steps, (1..=last).collect::<Vec<_>>(), "{length}");
                assert_eq!(repeated.unwrap().last_step, last, "{length}");
                reached.push(last);
                let words = words.unwrap();
                assert!(words.contains(&format!("after step {last}")), "{words}");
            }
            Err(reason) => {
                assert!(repeated.is_err(), "{length}");
                assert!(
                    reason.contains("breaks off") || reason.contains("it "),
                    "{length}: {reason}"
                );
            }
        }
    }
    reached.sort_unstable();
    reached.dedup();
    assert_eq!(reached, [1, 2, 4, 6]);
}

/// A finished one lies by quantity: less of it is left, and what is left is right.
#[test]
fn a_finished_recording_that_is_cut_shows_no_step_that_is_not_whole() {
    let folder = tempfile::tempdir().unwrap();
    let [path, _] = record(folder.path());
    let whole = whole(&path);
    let bytes = std::fs::read(&path).unwrap();
    let cut = folder.path().join("cut.rrd");
    let ends = bytes.len() - 40..bytes.len();
    let mut read = 0;
    for length in (0..ends.start).step_by(1999).chain(ends) {
        std::fs::write(&cut, &bytes[..length]).unwrap();
        match steps(&cut, &whole) {
            Ok((steps, _)) => {
                // Where a chunk ends between two steps those before it are whole.
                let last = *steps.last().unwrap();
                assert_eq!(steps, (1..=last).collect::<Vec<_>>(), "{length}");
                read += u64::from(last == STEPS);
            }
            Err(reason) => assert!(
                reason.contains("breaks off") || reason.contains("it "),
                "{length}: {reason}"
            ),
        }
    }
    // All that follows the last picture is the index.
    assert!(read >= 40, "{read}");
}

/// A run of a small scene whose files may have so many kilobytes each.
fn limited(folder: &Path, kilobytes: u64, passages: &str, more: &[&str]) -> Output {
    let script = format!("ulimit -f {}; exec \"$0\" \"$@\"", 2 * kilobytes);
    let mut command = Command::new("sh");
    command.current_dir(folder).args(["-c", &script]);
    command.arg(env!("CARGO_BIN_EXE_asperity"));
    command.args([
        "run",
        "--passages",
        passages,
        "--threads=1",
        "--set=grid.nodes=33",
        "--set=record.every_steps=1",
        "--set=stress.depths=8",
        "--set=body_1.surface.wavelength_x_m=4e-4",
        "--set=body_2.surface.wavelength_x_m=4e-4",
        "--set=body_2.surface.wavelength_y_m=4e-4",
        "--set=body_1.surface.amplitude_m=1e-7",
        "--set=body_2.surface.amplitude_m=1e-7",
    ]);
    command.args(more).output().unwrap()
}

fn asperity(folder: &Path, args: &[&str]) -> Output {
    let mut command = Command::new(env!("CARGO_BIN_EXE_asperity"));
    command.current_dir(folder).args(args).output().unwrap()
}

fn told(output: &Output) -> String {
    let text = String::from_utf8_lossy(&output.stderr).into_owned();
    assert!(!text.contains("panicked"), "{text}");
    text
}

/// `found`: steps, the last of them.
fn words_for(found: Option<(usize, u64)>) -> String {
    match found {
        Some((1, last)) => format!("1 step up to step {last} can be read back"),
        Some((steps, last)) => format!("{steps} steps up to step {last} can be read back"),
        None => "no step of it can be read back; nothing of it is left".to_owned(),
    }
}

#[cfg(unix)]
#[test]
fn a_disk_that_fills_is_code_4_and_what_was_written_is_read() {
    let mut kept = Vec::new();
    for k in 0..30_u32 {
        // From 64 kB to 4 MB, each a seventh more.
        let kilobytes = (64.0 * 64.0_f64.powf(f64::from(k) / 29.0)).round() as u64;
        let folder = tempfile::tempdir().unwrap();
        let place = folder.path();
        let output = limited(place, kilobytes, "6", &["--out=run.rrd"]);
        let words = told(&output);
        assert_eq!(output.status.code(), Some(4), "{kilobytes} kB: {words}");
        assert!(words.contains("File too large"), "{kilobytes} kB: {words}");
        assert!(!words.contains("disk full"), "{kilobytes} kB: {words}");
        let path = place.join("run.rrd");
        let found = path.exists().then(|| {
            let frames = RecordedFrames::read(&path).unwrap();
            let steps: Vec<u64> = frames.steps().map(|frame| frame.step).collect();
            assert!(frames.broken_off().is_some(), "{kilobytes} kB");
            assert!(
                frames
                    .shown()
                    .iter()
                    .all(|step| frames.frame(*step).is_some())
            );
            (steps.len(), *steps.last().unwrap())
        });
        assert!(
            words.contains(&words_for(found)),
            "{kilobytes} kB: {found:?}, {words}"
        );
        let names: Vec<_> = std::fs::read_dir(place).unwrap().collect();
        assert_eq!(names.len(), usize::from(found.is_some()), "{names:?}");
        if found.is_some() && k % 4 == 1 {
            let export = ["export", "run.rrd", "--as=npz", "--every=8", "--out=fields"];
            let export = asperity(place, &export);
            let words = told(&export);
            assert_eq!(export.status.code(), Some(0), "{words}");
            assert!(words.contains("breaks off after step"), "{words}");
            let again = asperity(place, &["run", "--from=run.rrd", "--no-record"]);
            assert_eq!(again.status.code(), Some(5), "{}", told(&again));
        }
        kept.push((kilobytes, found.map_or(0, |found| found.0)));
    }
    println!("kB, steps: {kept:?}");
    assert!(kept.is_sorted_by_key(|(_, steps)| *steps), "{kept:?}");
    assert!(kept[29].1 > 10, "{kept:?}");
}

/// Every other output on such a disk, and the properties that come last.
#[cfg(unix)]
#[test]
fn whatever_cannot_be_written_is_code_4() {
    let folder = tempfile::tempdir().unwrap();
    let place = folder.path();
    for (out, name) in [
        ("--table=run.csv", "run.csv"),
        ("--save-state=run.state", "run.state"),
        ("--summary=run.json", "run.json"),
        ("--export=fields", "fields"),
    ] {
        let output = limited(place, 2, "0.5", &["--no-record", out]);
        let words = told(&output);
        assert_eq!(output.status.code(), Some(4), "{out}: {words}");
        assert!(
            words.contains(name) && words.contains("File too large"),
            "{words}"
        );
    }
    // The recording is longer than the limit when it is finished, if it was not before. How frames fall into batches is a
    // matter of the clock, and with it some hundred bytes.
    let whole = place.join("whole.rrd");
    let done = limited(place, 1 << 20, "0.5", &["--out=whole.rrd"]);
    assert!(matches!(done.status.code(), Some(0 | 2)), "{}", told(&done));
    let fits = std::fs::metadata(&whole).unwrap().len() / 1024;
    let output = limited(place, fits - 4, "0.5", &["--out=short.rrd"]);
    let words = told(&output);
    assert_eq!(output.status.code(), Some(4), "{words}");
    let left: Vec<String> = std::fs::read_dir(place)
        .unwrap()
        .map(|entry| entry.unwrap().file_name().into_string().unwrap())
        .filter(|name| name.contains(".part"))
        .collect();
    assert!(left.is_empty(), "{left:?}");
}
