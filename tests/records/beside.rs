//! Runs side by side: frames read back, common ranges, common moments, a run less itself.
#![cfg(feature = "rerun")]
#![expect(clippy::unwrap_used, reason = "tests")]

use std::path::{Path, PathBuf};
use std::process::Command;
use std::sync::Arc;

use asperity_engine::observe::{Observer, Overwrite, RunContext};
use asperity_engine::scene::{Record, Scene};
use asperity_engine::sim::Frame;
use asperity_recorder::{ComparedBy, RecordedFrames, Recorder, RunBeside, RunsCompared, compare};

use crate::common::synthetic;
use crate::recording::{Contents, shown};

const NODES: usize = 33;
const STEPS: u64 = 24;

/// A scene whose TOML reads back as itself.
fn scene() -> Scene {
    let text = Scene::load("demonstration").unwrap().to_toml();
    Scene::from_toml(&text).unwrap()
}

/// Records frames that a change was made to.
fn record(path: &Path, steps: u64, change: impl Fn(&mut Frame)) -> Vec<Arc<Frame>> {
    record_every(1, path, steps, change)
}

/// Same with the fields of every so-many-th step.
fn record_every(
    every_steps: usize,
    path: &Path,
    steps: u64,
    change: impl Fn(&mut Frame),
) -> Vec<Arc<Frame>> {
    let frames = (1..=steps).map(|step| {
        let mut frame = Frame::clone(&synthetic::frame(NODES, step));
        change(&mut frame);
        Arc::new(frame)
    });
    let frames: Vec<Arc<Frame>> = frames.collect();
    let record = Record {
        every_steps,
        budget_mb: 200.0,
    };
    let mut recorder = Recorder::create(path, Overwrite::Refuse, &record).unwrap();
    let scene = scene();
    let context = RunContext {
        scene_toml: scene.to_toml(),
        ..synthetic::context(scene)
    };
    recorder.begin(&context).unwrap();
    for frame in &frames {
        recorder.frame(frame).unwrap();
    }
    recorder.finish().unwrap();
    frames
}

fn beside(files: &[&PathBuf], out: &Path, by: ComparedBy) -> Result<RunsCompared, String> {
    let runs = files.iter().zip(["one", "two", "three"]);
    let runs = runs.map(|(path, name)| RunBeside {
        name: name.to_owned(),
        frames: RecordedFrames::read(path).unwrap(),
    });
    let runs: Vec<RunBeside> = runs.collect();
    compare(&runs, out, Overwrite::Refuse, by).map_err(|error| error.to_string())
}

/// Half precision, and what is below its normal numbers.
fn same(one: &[f32], two: &[f32], least: f32) {
    assert_eq!(one.len(), two.len());
    for (one, two) in one.iter().zip(two) {
        let off = (one - two).abs();
        assert!(off <= one.abs() / 2040.0 + least, "{one} {two}");
    }
}

/// Equal but for so much.
fn near(one: &[f32], two: &[f32], most: f32) {
    assert_eq!(one.len(), two.len());
    for (one, two) in one.iter().zip(two) {
        assert!((one - two).abs() <= 1.001 * most, "{one} {two}");
    }
}

#[test]
fn frames_come_back_with_scalars_to_the_bit_and_fields_as_they_are_stored() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("a.rrd");
    let frames = record(&path, STEPS, |_| {});
    let read = RecordedFrames::read(&path).unwrap();
    assert_eq!(read.n_steps(), frames.len());
    assert_eq!(read.shown(), (1..=STEPS).collect::<Vec<_>>());
    assert_eq!(read.whole().len() as u64, STEPS / 2);
    for (step, frame) in read
        .whole()
        .iter()
        .map(|&step| (step, shown(&frames[step as usize - 1])))
    {
        let frame = &frame;
        let back = read.frame(step).unwrap();
        let scalars = |frame: &Frame| {
            let mut metrics = frame.metrics.clone();
            // Told in words beside the numbers.
            (metrics.repeat, metrics.errors, metrics.asked) = (None, None, [0.0; 2]);
            if let Some(life) = &mut metrics.life {
                let detail = life.detail;
                life.detail = asperity_engine::sim::LifeDetail {
                    life_global: detail.life_global,
                    life_damage: detail.life_damage,
                    ..asperity_engine::sim::LifeDetail::default()
                };
            }
            (
                metrics,
                frame.material_point,
                frame.time_s,
                frame.p_hertz_pa,
                [frame.x_min_m, frame.dx_m],
            )
        };
        assert_eq!(scalars(&back), scalars(frame));
        // Half of a level, and of the film what is stored.
        near(&back.pressure_pa, &frame.pressure_pa, 0.5 / 1024.0 * 1e9);
        let film: Vec<f32> = back.film_m.iter().map(|film| film.min(1.99e-6)).collect();
        let own: Vec<f32> = frame.film_m.iter().map(|film| film.min(1.99e-6)).collect();
        near(&film, &own, 0.5 / 8192.0 * 1e-6);
        same(&back.traction_pa, &frame.traction_pa, 0.04);
        same(&back.roughness_1_m, &frame.roughness_1_m, 4e-14);
        assert_eq!(back.contact, frame.contact);
        let (own, slice) = (back.slice.unwrap(), frame.slice.as_ref().unwrap());
        assert_eq!(own.depths_m, slice.depths_m);
        near(&own.effective_pa, &slice.effective_pa, 0.5 / 1024.0 * 1e9);
        same(&own.tau_xz_pa, &slice.tau_xz_pa, 40.0);
    }
}

#[test]
fn a_run_less_itself_is_zero_to_the_bit_and_stands_there_twice_alike() {
    let folder = tempfile::tempdir().unwrap();
    let [path, out] = ["a.rrd", "both.rrd"].map(|name| folder.path().join(name));
    record(&path, STEPS, |_| {});
    for by in [ComparedBy::Time, ComparedBy::Place] {
        let told = beside(&[&path, &path], &out, by).unwrap();
        assert_eq!(
            (told.difference_pa, told.apart_steps, told.pictures),
            (0.0, 0.0, STEPS)
        );
        let contents = Contents::read(&out);
        let difference = contents.pictures("b/difference/pressure_GPa/image");
        assert_eq!(difference.len() as u64, STEPS);
        assert!(difference.values().flatten().all(|&byte| byte == 0));
        let original = Contents::read(&path).pictures("maps/pressure_GPa/image");
        for run in ["a", "b"] {
            // Written again half precision is the same bits.
            assert_eq!(
                contents.pictures(&format!("{run}/maps/pressure_GPa/image")),
                original
            );
        }
        std::fs::remove_file(&out).unwrap();
    }
}

#[test]
fn ranges_are_common_and_hold_both() {
    let folder = tempfile::tempdir().unwrap();
    let [one, two, out] = ["a.rrd", "b.rrd", "both.rrd"].map(|name| folder.path().join(name));
    record(&one, STEPS, |_| {});
    record(&two, STEPS, |frame| {
        frame.pressure_pa.iter_mut().for_each(|p| *p *= 1.5);
        frame.film_m.iter_mut().for_each(|h| *h *= 2.0);
        frame.metrics.p_max_pa *= 1.5;
        frame.metrics.h_mean_m *= 2.0;
    });
    let told = beside(&[&one, &two, &one], &out, ComparedBy::Time).unwrap();
    assert!(told.difference_pa > 0.4e9, "{}", told.difference_pa);
    let contents = Contents::read(&out);
    let alone = [&one, &two].map(|path| Contents::read(path));
    for entity in [
        "maps/pressure_GPa/image",
        "maps/film_um/image",
        "maps/traction_on_body_1_MPa/image",
        "slice_y0/effective_stress_GPa/image",
        "kymograph/pressure_y0_GPa/image",
    ] {
        let tops = ["a", "b", "c"].map(|run| contents.top(&format!("{run}/{entity}")));
        assert!(tops.iter().all(|&top| top == tops[0]), "{entity}: {tops:?}");
        let own = alone
            .iter()
            .map(|alone| alone.top(entity))
            .fold(0.0, f64::max);
        assert!(tops[0] >= own, "{entity}: {tops:?} below {own}");
    }
    // What a run shows alone is less: the ranges had to grow.
    assert!(alone[0].top("maps/pressure_GPa/image") < contents.top("a/maps/pressure_GPa/image"));
}

/// Where only every third step has a picture not every moment has one of each run near it.
#[test]
fn seldom_pictures_are_at_most_a_step_apart_too() {
    let folder = tempfile::tempdir().unwrap();
    let [one, two, out] = ["a.rrd", "b.rrd", "both.rrd"].map(|name| folder.path().join(name));
    record_every(3, &one, 4 * STEPS, |_| {});
    record_every(3, &two, 8 * STEPS, |frame| {
        frame.time_s *= 0.71;
        frame.metrics.slide_roll = 0.8;
    });
    for by in [ComparedBy::Time, ComparedBy::Place] {
        let told = beside(&[&one, &two], &out, by).unwrap();
        assert!(told.apart_steps < 1.001, "{by:?}: {}", told.apart_steps);
        // More than half of the first run's pictures, of a third of its steps.
        assert!(told.pictures > 4 * STEPS / 6, "{by:?}: {}", told.pictures);
        std::fs::remove_file(&out).unwrap();
    }
}

#[test]
fn moments_are_common_and_at_most_a_step_apart() {
    let folder = tempfile::tempdir().unwrap();
    let [one, two, out] = ["a.rrd", "b.rrd", "both.rrd"].map(|name| folder.path().join(name));
    let of = |frame: &Frame| (frame.time_s, frame.metrics.slide_roll);
    let first = record(&one, STEPS, |_| {});
    // Another pace and another S: by time and by place other steps belong together.
    let second = record(&two, 2 * STEPS, |frame| {
        frame.time_s *= 0.7;
        frame.metrics.slide_roll = 1.0;
    });
    let way = |frame: &Frame| {
        let (time_s, slide_roll) = of(frame);
        time_s * frame.metrics.entrainment_m_s * (1.0 - 0.5 * slide_roll)
    };
    for by in [ComparedBy::Time, ComparedBy::Place] {
        let told = beside(&[&one, &two], &out, by).unwrap();
        assert!(told.apart_steps <= 1.0, "{by:?}: {}", told.apart_steps);
        assert!(told.pictures > 10, "{by:?}: {}", told.pictures);
        let contents = Contents::read(&out);
        let pictures =
            ["a", "b"].map(|run| contents.pictures(&format!("{run}/maps/film_um/image")));
        let steps = pictures
            .each_ref()
            .map(|all| all.keys().copied().collect::<Vec<i64>>());
        assert_eq!(steps[0], steps[1]);
        let originals = Contents::read(&two).pictures("maps/film_um/image");
        for (step, picture) in &pictures[1] {
            let own = originals.iter().find(|(_, original)| *original == picture);
            let own = &second[*own.unwrap().0 as usize - 1];
            let moment = &first[*step as usize - 1];
            let (key, of_moment, pace) = match by {
                ComparedBy::Time => (
                    own.time_s,
                    moment.time_s,
                    second[1].time_s - second[0].time_s,
                ),
                ComparedBy::Place => (way(own), way(moment), way(&second[1]) - way(&second[0])),
            };
            assert!(
                (key - of_moment).abs() <= pace,
                "{by:?}, {step}: {key} {of_moment}"
            );
        }
        std::fs::remove_file(&out).unwrap();
    }
}

/// Runs side by side come back as those that were recorded alone: numbers to the bit, pressure to a level.
#[test]
fn runs_side_by_side_are_read_back_one_by_one() {
    let folder = tempfile::tempdir().unwrap();
    let [one, two, out] = ["a.rrd", "b.rrd", "both.rrd"].map(|name| folder.path().join(name));
    record(&one, STEPS, |_| {});
    record(&two, STEPS, |frame| {
        frame.metrics.friction_coefficient = 0.0789;
        frame.pressure_pa.iter_mut().for_each(|p| *p *= 0.5);
    });
    beside(&[&one, &two], &out, ComparedBy::Time).unwrap();
    let both = RecordedFrames::read_all(&out).unwrap();
    assert_eq!(both.len(), 2);
    for (run, own) in both.iter().zip([&one, &two]) {
        let alone = RecordedFrames::read_all(own).unwrap();
        let [alone] = alone.as_slice() else {
            panic!("one run is not one");
        };
        assert_eq!(run.scene_toml, alone.scene_toml);
        assert!(run.shown_at().len() > 4);
        for (step, time_s) in run.shown_at() {
            let (frame, own) = (run.frame(step).unwrap(), alone.frame(step).unwrap());
            assert_eq!((time_s, &frame.metrics), (own.time_s, &own.metrics));
            let top = own.pressure_pa.iter().fold(0.0_f32, |top, p| top.max(*p));
            let pairs = frame.pressure_pa.iter().zip(&own.pressure_pa);
            let off = pairs.fold(0.0_f32, |off, (one, two)| off.max((one - two).abs()));
            assert!(off < 1e-3 * top, "{step}: {off} of {top}");
        }
    }
}

#[test]
fn what_has_no_common_picture_is_refused_in_words() {
    let folder = tempfile::tempdir().unwrap();
    let [one, standing, out] = ["a.rrd", "b.rrd", "both.rrd"].map(|name| folder.path().join(name));
    record(&one, 4, |_| {});
    record(&standing, 4, |frame| frame.metrics.slide_roll = 2.0);
    let refused = beside(&[&one, &standing], &out, ComparedBy::Place).unwrap_err();
    assert!(refused.contains("compare by time"), "{refused}");
    assert!(beside(&[&one, &standing], &out, ComparedBy::Time).is_ok());
    // Several side by side are no run.
    let refused = RecordedFrames::read(&out).err().unwrap().to_string();
    assert!(refused.contains("side by side"), "{refused}");
    let mut bytes = std::fs::read(&one).unwrap();
    let middle = bytes.len() / 2;
    bytes.truncate(middle);
    std::fs::write(&one, &bytes).unwrap();
    assert!(RecordedFrames::read(&one).is_err());
}

#[test]
fn the_program_runs_both_and_leaves_one_file() {
    let folder = tempfile::tempdir().unwrap();
    let run = |args: &[&str]| {
        let output = Command::new(env!("CARGO_BIN_EXE_asperity"))
            .args(args)
            .current_dir(folder.path())
            .output()
            .unwrap();
        (
            output.status.code(),
            String::from_utf8_lossy(&[output.stdout, output.stderr].concat()).into_owned(),
        )
    };
    let small = [
        "run",
        "--set=grid.nodes=65",
        "--set=stress=none",
        "--set=life=none",
        "--passages=0.25",
        "--threads=1",
        "--out=both.rrd",
        "--beside=motion.slide_roll=0,0.5",
    ];
    let (code, text) = run(&small);
    assert_eq!(code, Some(0), "{text}");
    assert!(text.contains("2 runs side by side"), "{text}");
    let files = std::fs::read_dir(folder.path()).unwrap();
    assert_eq!(files.count(), 1);
    let names = Contents::read(&folder.path().join("both.rrd")).entities();
    assert!(
        names.iter().any(|name| name.starts_with("/b/contact_3d")),
        "{names:?}"
    );
    let (code, text) = run(&small);
    assert_eq!(code, Some(4), "{text}");
    let (code, text) = run(&["compare", "both.rrd", "both.rrd", "--out", "again.rrd"]);
    assert_eq!(code, Some(1), "{text}");
}
