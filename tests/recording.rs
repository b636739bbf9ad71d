//! Recordings read back: what is in the file, that it opens laid out, that nobody's file is lost and
//! that a file cut off by a kill still tells its beginning.
#![cfg(feature = "rerun")]
#![expect(clippy::unwrap_used, reason = "tests")]

mod synthetic;

use std::collections::{BTreeMap, BTreeSet};
use std::path::Path;
use std::sync::Arc;

use asperity::observe::rerun::Recorder;
use asperity::observe::{
    Observer, ObserverReport, Overwrite, Queue, RunEvent, RunEventKind, SetBy, WhenFull,
};
use asperity::scene::Record;
use asperity::sim::{DamageBlock, Frame, Stage};
use re_chunk::Chunk;
use re_log_encoding::DecoderApp;
use rerun::external::re_log_types::LogMsg;

/// Nodes per side: small, and enough for every view.
const NODES: usize = 33;
const STEPS: u64 = 12;

/// A file's messages, up to where it can be read.
#[derive(Default)]
struct Contents {
    data: Vec<Chunk>,
    layout: Vec<Chunk>,
    activations: usize,
    broke_off: bool,
}

impl Contents {
    fn read(path: &Path) -> Self {
        let mut contents = Self::default();
        let reader = std::io::BufReader::new(std::fs::File::open(path).unwrap());
        for message in DecoderApp::decode_eager(reader).unwrap() {
            match message {
                Ok(LogMsg::ArrowMsg(store, message)) => {
                    let chunk = Chunk::from_arrow_msg(&message).unwrap();
                    let chunks = if store.is_blueprint() {
                        &mut contents.layout
                    } else {
                        &mut contents.data
                    };
                    chunks.push(chunk);
                }
                Ok(LogMsg::BlueprintActivationCommand(_)) => contents.activations += 1,
                Ok(LogMsg::SetStoreInfo(_)) => {}
                Err(_) => {
                    contents.broke_off = true;
                    break;
                }
            }
        }
        contents
    }

    fn rows(&self, entity: &str, is_static: bool) -> usize {
        let of_entity = |chunk: &&Chunk| {
            chunk.entity_path().to_string() == format!("/{entity}")
                && chunk.is_static() == is_static
        };
        self.data
            .iter()
            .filter(of_entity)
            .map(Chunk::num_rows)
            .sum()
    }

    fn entities(&self) -> BTreeSet<String> {
        let paths = self
            .data
            .iter()
            .map(|chunk| chunk.entity_path().to_string());
        paths.collect()
    }

    /// Values of an entity that holds scalars, by step.
    fn scalars(&self, entity: &str) -> BTreeMap<i64, Vec<f64>> {
        let mut values = BTreeMap::new();
        for chunk in &self.data {
            if chunk.entity_path().to_string() != format!("/{entity}") || chunk.is_static() {
                continue;
            }
            let steps = chunk.timelines()[&"step".into()].times_raw().to_vec();
            let component = rerun::Scalars::descriptor_scalars().component;
            let rows = chunk.iter_slices::<f64>(component);
            values.extend(steps.into_iter().zip(rows.map(<[f64]>::to_vec)));
        }
        values
    }

    /// All text of an entity, as the bytes hold it.
    fn text(&self, entity: &str) -> String {
        let component = rerun::TextDocument::descriptor_text().component;
        let mut text = String::new();
        for chunk in &self.data {
            if chunk.entity_path().to_string() == format!("/{entity}") {
                for part in chunk.iter_slices::<String>(component) {
                    text.extend(part.iter().map(std::string::ToString::to_string));
                }
            }
        }
        text
    }
}

/// Records `frames` and tells what the recorder reported.
fn record(path: &Path, record: &Record, frames: &[Arc<Frame>]) -> ObserverReport {
    let mut recorder = Recorder::create(path, Overwrite::Refuse, record).unwrap();
    let passages = frames.len() as f64 / (NODES - 1) as f64;
    recorder
        .begin(&synthetic::context(synthetic::scene(NODES, passages)))
        .unwrap();
    for frame in frames {
        if frame.step == 5 {
            for kind in [
                RunEventKind::Caption("Look at the ridges.".into()),
                RunEventKind::Set {
                    key: "motion.slide_roll".into(),
                    value: 0.75,
                    by: SetBy::Hand,
                    steps_made: 104,
                },
                RunEventKind::NotConverged { residual: 0.25 },
            ] {
                let (step, time_s) = (frame.step, frame.time_s);
                recorder.event(&RunEvent { step, time_s, kind }).unwrap();
            }
        }
        recorder.frame(frame).unwrap();
    }
    recorder.finish().unwrap()
}

/// Pictures of every step.
fn every_step() -> Record {
    Record {
        every_steps: 1,
        ..Record::default()
    }
}

fn frames(steps: u64) -> Vec<Arc<Frame>> {
    (1..=steps)
        .map(|step| synthetic::frame(NODES, step))
        .collect()
}

#[test]
fn a_recording_holds_every_field_of_every_step() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("run.rrd");
    let frames = frames(STEPS);
    let report = record(&path, &every_step(), &frames);
    assert_eq!((report.frames, report.skipped), (STEPS, 0));
    assert_eq!(report.bytes, std::fs::metadata(&path).unwrap().len());

    let contents = Contents::read(&path);
    assert!(!contents.broke_off);
    let steps = STEPS as usize;
    for entity in [
        "maps/pressure_GPa/image",
        "maps/film_um/image",
        "maps/contact_spots",
        "slice_y0/effective_stress_GPa/image",
        "contact_3d/film_coloured_by_pressure",
        "contact_3d/body_1_surface",
        "contact_3d/body_2_surface",
        "contact_3d/effective_stress_slice",
        "contact_3d/material_point",
        "centre_line_y0/pressure_GPa",
        "centre_line_y0/film_um",
        "material_point/trace/pressure_GPa",
        "series/pressure_GPa",
        "life/log10_relative",
        "convergence/log10_errors",
        "text/now",
    ] {
        assert_eq!(contents.rows(entity, false), steps, "{entity}");
    }
    // The second tab takes every second picture.
    for entity in [
        "maps/film_interferogram/image",
        "maps/traction_on_body_1_MPa/image",
        "maps/roughness_body_1_um/image",
        "maps/roughness_body_2_um/image",
        "slice_y0/tau_xz_GPa/image",
    ] {
        assert_eq!(contents.rows(entity, false), steps / 2, "{entity}");
    }
    // Logged when they change, and they do not.
    for entity in [
        "contact_3d/surface_speeds",
        "centre_line_y0/hertz_pressure_GPa",
    ] {
        assert_eq!(contents.rows(entity, false), 1, "{entity}");
    }
    for chunk in contents.data.iter().filter(|chunk| !chunk.is_static()) {
        let timelines: BTreeSet<String> =
            chunk.timelines().keys().map(ToString::to_string).collect();
        let expected = ["passage_x1000", "simulated_time", "step"];
        assert_eq!(timelines, expected.map(String::from).into(), "{chunk:?}");
    }
}

#[test]
fn scalars_come_back_as_they_were() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("run.rrd");
    let frames = frames(STEPS);
    record(&path, &every_step(), &frames);
    let contents = Contents::read(&path);
    let pressure = contents.scalars("series/pressure_GPa");
    let film = contents.scalars("series/film_um");
    let life = contents.scalars("life/relative");
    assert_eq!(pressure.len(), frames.len());
    for frame in &frames {
        let step = i64::try_from(frame.step).unwrap();
        let m = &frame.metrics;
        assert_eq!(
            pressure[&step],
            [m.p_max_pa * 1e-9, frame.p_hertz_pa * 1e-9]
        );
        let films = [m.h_central_m, m.h_mean_m, m.h_min_m];
        assert_eq!(film[&step], films.map(|h| h * 1e6));
        assert_eq!(life[&step], [m.life.unwrap().life_relative]);
    }
}

#[test]
fn what_stays_is_logged_once_and_the_file_explains_itself() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("run.rrd");
    record(&path, &every_step(), &frames(STEPS));
    let contents = Contents::read(&path);
    for entity in [
        "maps/pressure_GPa/axes/frame",
        "maps/pressure_GPa/axes/labels",
        "maps/pressure_GPa/legend/bar",
        "maps/pressure_GPa/legend/labels",
        "maps/hertz_contact",
        "contact_3d/labels",
        "contact_3d/legend/pressure",
        "text/about",
        "text/plan",
        "text/scene_toml",
        "text/notes_on_the_data",
    ] {
        assert_eq!(contents.rows(entity, true), 1, "{entity}");
        assert_eq!(contents.rows(entity, false), 0, "{entity}");
    }
    assert!(
        contents
            .text("text/scene_toml")
            .contains("slide_roll = 0.5")
    );
    assert!(
        contents
            .text("text/about")
            .contains("asperity run scene.toml")
    );
    assert!(
        contents
            .text("text/about")
            .contains(env!("CARGO_PKG_VERSION"))
    );
    assert!(
        contents
            .text("text/notes_on_the_data")
            .contains("heights of film")
    );
    assert!(contents.text("text/now").contains("Look at the ridges."));
    // The first line, three events, the last line.
    assert_eq!(contents.rows("log", false), 5);
    // Nothing outside of the folders that the layout shows.
    let folders: BTreeSet<String> = contents
        .entities()
        .iter()
        .filter_map(|path| path.split('/').nth(1).map(str::to_owned))
        .collect();
    let known = [
        "__properties",
        "centre_line_y0",
        "commands",
        "contact_3d",
        "convergence",
        "kymograph",
        "life",
        "log",
        "maps",
        "material_point",
        "series",
        "slice_y0",
        "text",
    ];
    assert_eq!(folders, known.map(String::from).into());
}

#[test]
fn the_layout_is_in_the_file_with_the_properties_of_its_views() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("run.rrd");
    record(&path, &every_step(), &frames(2));
    let contents = Contents::read(&path);
    assert_eq!(contents.activations, 1);
    let paths: Vec<String> = contents
        .layout
        .iter()
        .map(|chunk| chunk.entity_path().to_string())
        .collect();
    assert!(paths.iter().any(|path| path == "/viewport"));
    let of = |property: &str| paths.iter().filter(|path| path.ends_with(property)).count();
    assert_eq!(of("/EyeControls3D"), 1);
    assert!(of("/VisualBounds2D") >= 10, "{paths:?}");
    // Every property belongs to a view that exists.
    for path in paths
        .iter()
        .filter(|path| path.ends_with("/VisualBounds2D"))
    {
        let view = path.trim_end_matches("/VisualBounds2D");
        assert!(paths.iter().any(|path| path == view), "{path}");
    }
}

#[test]
fn a_small_budget_thins_fields_and_not_scalars() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("run.rrd");
    let frames = frames(40);
    let small = Record {
        every_steps: 1,
        budget_mb: 0.4,
    };
    record(&path, &small, &frames);
    let contents = Contents::read(&path);
    assert_eq!(contents.rows("series/pressure_GPa", false), 40);
    let fields = contents.rows("maps/pressure_GPa/image", false);
    assert!((2..30).contains(&fields), "{fields}");
    assert_eq!(fields, contents.rows("contact_3d/body_1_surface", false));
    let notes = contents.text("text/notes_on_the_data");
    assert!(notes.contains("more seldom than asked for"), "{notes}");
}

#[test]
fn the_start_up_is_not_recorded() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("run.rrd");
    let mut all = frames(3);
    let mut start_up = Frame::clone(&all[0]);
    (start_up.step, start_up.stage) = (0, Stage::StartUp);
    all.insert(0, Arc::new(start_up));
    assert_eq!(record(&path, &every_step(), &all).frames, 3);
    assert_eq!(Contents::read(&path).rows("series/pressure_GPa", false), 3);
}

#[test]
fn a_recording_that_is_there_is_not_overwritten_unasked() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("run.rrd");
    std::fs::write(&path, "somebody's work").unwrap();
    let create = |overwrite| Recorder::create(&path, overwrite, &every_step());
    let refused = create(Overwrite::Refuse).err().unwrap();
    assert!(refused.reason.contains("--force"), "{refused}");
    assert_eq!(std::fs::read(&path).unwrap(), b"somebody's work");
    assert!(create(Overwrite::Replace).is_ok());
    let missing = folder.path().join("nowhere").join("run.rrd");
    let refused = Recorder::create(&missing, Overwrite::Refuse, &every_step());
    assert!(refused.err().unwrap().reason.contains("folder"));
}

#[test]
fn a_file_that_breaks_off_still_tells_its_beginning() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("run.rrd");
    record(&path, &every_step(), &frames(STEPS));
    let whole = Contents::read(&path);
    let bytes = std::fs::read(&path).unwrap();
    let cut = folder.path().join("cut.rrd");
    std::fs::write(&cut, &bytes[..bytes.len() * 9 / 10]).unwrap();
    let broken = Contents::read(&cut);
    assert!(!broken.layout.is_empty() && broken.activations == 1);
    assert!(broken.data.len() > whole.data.len() / 2);
    assert!(broken.text("text/scene_toml").contains("slide_roll = 0.5"));
}

#[test]
fn a_recorder_that_nobody_finished_leaves_a_whole_file() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("run.rrd");
    let mut recorder = Recorder::create(&path, Overwrite::Refuse, &every_step()).unwrap();
    recorder
        .begin(&synthetic::context(synthetic::scene(NODES, 1.0)))
        .unwrap();
    for frame in frames(3) {
        recorder.frame(&frame).unwrap();
    }
    drop(recorder);
    let contents = Contents::read(&path);
    assert!(!contents.broke_off);
    assert_eq!(contents.rows("maps/film_um/image", false), 3);
}

#[test]
fn a_new_grid_needs_a_new_recording() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("run.rrd");
    let mut recorder = Recorder::create(&path, Overwrite::Refuse, &every_step()).unwrap();
    recorder.frame(&synthetic::frame(NODES, 1)).unwrap();
    let error = recorder.frame(&synthetic::frame(17, 2)).unwrap_err();
    assert!(error.reason.contains("17 x 17"), "{error}");
}

#[test]
fn behind_a_queue_nothing_is_lost() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("run.rrd");
    let recorder = Recorder::create(&path, Overwrite::Refuse, &every_step()).unwrap();
    let mut queue = Queue::spawn("record", 2, WhenFull::Wait, Box::new(recorder)).unwrap();
    queue
        .begin(&synthetic::context(synthetic::scene(NODES, 1.0)))
        .unwrap();
    for frame in frames(STEPS) {
        queue.frame(&frame).unwrap();
    }
    let report = queue.finish().unwrap();
    assert_eq!((report.frames, report.skipped), (STEPS, 0));
    let contents = Contents::read(&path);
    assert_eq!(contents.rows("maps/film_um/image", false), STEPS as usize);
}

/// Eight frames with a map of that body from the third on, whole from the sixth on.
fn with_damage(body: usize) -> Vec<Arc<Frame>> {
    let block = |filled: usize| DamageBlock {
        length_m: 1e-4,
        columns: 4,
        depths_m: [0.0, 1e-5, 4e-5].into(),
        damage: (0..12)
            .map(|at| if at / 3 < filled { 0.5 } else { 0.0 })
            .collect(),
        filled,
        pit_place_m: -2.5e-5,
        pit_depth_m: 1e-5,
        pit_damage: 0.5,
    };
    frames(8)
        .into_iter()
        .map(|frame| {
            let mut frame = Frame::clone(&frame);
            frame.damage[body] = match frame.step {
                1..=2 => None,
                3..=5 => Some(block(1)),
                _ => Some(block(4)),
            };
            Arc::new(frame)
        })
        .collect()
}

/// A block comes when material has crossed, and is logged when it changes.
#[test]
fn damage_maps_come_when_they_are_there_and_change() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("run.rrd");
    let frames = with_damage(1);
    record(&path, &every_step(), &frames);
    let contents = Contents::read(&path);
    let entity = "damage/body_2_log10_relative";
    assert_eq!(contents.rows(&format!("{entity}/image"), false), 2);
    assert_eq!(contents.rows(&format!("{entity}/worst_point"), false), 2);
    assert_eq!(contents.rows(&format!("{entity}/axes/frame"), true), 1);
    assert!(
        contents
            .entities()
            .iter()
            .all(|path| !path.contains("damage/body_1"))
    );
}

#[test]
fn the_damage_of_body_1_hangs_below_the_cut() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("run.rrd");
    record(&path, &every_step(), &with_damage(0));
    let contents = Contents::read(&path);
    // Its shape once, its colours with every change.
    assert_eq!(contents.rows("contact_3d/damage_body_1", false), 3);
    assert_eq!(contents.rows("contact_3d/damage_title", false), 1);
}

/// A disk without room for the first bytes is known before the run starts.
#[cfg(target_os = "linux")]
#[test]
fn a_full_disk_is_an_error_and_no_panic() {
    let full = Path::new("/dev/full");
    if !full.exists() {
        return;
    }
    let refused = Recorder::create(full, Overwrite::Replace, &every_step());
    let error = refused.err().unwrap();
    assert_eq!(error.output, "/dev/full");
    assert!(error.reason.contains("No space left"), "{error}");
}
