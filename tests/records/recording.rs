//! Recordings read back: what is in the file, that it opens laid out, that nobody's file is lost and
//! that a file cut off by a kill still tells its beginning.
#![cfg(feature = "rerun")]
#![expect(clippy::unwrap_used, reason = "tests")]

use crate::common::synthetic;
use std::collections::{BTreeMap, BTreeSet};
use std::path::Path;
use std::sync::Arc;

use asperity_engine::observe::{
    Observer, ObserverReport, Overwrite, RunEvent, RunEventKind, SetBy,
};
use asperity_engine::scene::{Event, Record, Scene};
use asperity_engine::sim::{AgePoint, DamageBlock, Frame, Stage};
use asperity_picture::Window;
use asperity_recorder::Recorder;
use asperity_session::{Queue, WhenFull};
use re_chunk::Chunk;
use re_log_encoding::{DecoderApp, RawRrdManifest};
use rerun::Loggable as _;
use rerun::external::re_log_types::LogMsg;

/// What of a frame is recorded.
pub(super) fn shown(frame: &Frame) -> Frame {
    Window::around(frame, 1.0).cut(frame)
}

/// The levels of a picture.
fn levels_of(png: &[u8]) -> impl Iterator<Item = f64> {
    let decoder = png::Decoder::new(std::io::Cursor::new(png));
    let mut reader = decoder.read_info().unwrap();
    let mut bytes = vec![0; reader.output_buffer_size().unwrap()];
    reader.next_frame(&mut bytes).unwrap();
    let levels: Vec<f64> = bytes
        .chunks_exact(2)
        .map(|two| f64::from(u16::from_be_bytes([two[0], two[1]])))
        .collect();
    levels.into_iter()
}

/// Nodes per side: small, and enough for every view.
const NODES: usize = 33;
const STEPS: u64 = 12;

/// A file's messages, up to where it can be read.
#[derive(Default)]
pub(super) struct Contents {
    data: Vec<Chunk>,
    layout: Vec<Chunk>,
    activations: usize,
    broke_off: bool,
}

impl Contents {
    pub(super) fn read(path: &Path) -> Self {
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

    /// Updates of an entity; of an image its pictures, whose ranges come in rows of their own.
    fn updates(&self, entity: &str) -> usize {
        match self.pictures(entity).len() {
            0 => self.rows(entity, false),
            pictures => pictures,
        }
    }

    pub(super) fn entities(&self) -> BTreeSet<String> {
        let paths = self
            .data
            .iter()
            .map(|chunk| chunk.entity_path().to_string());
        paths.collect()
    }

    /// Values of an entity that holds scalars, by step.
    pub(super) fn scalars(&self, entity: &str) -> BTreeMap<i64, Vec<f64>> {
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

    /// Bytes of an entity's pictures, by step.
    pub(super) fn pictures(&self, entity: &str) -> BTreeMap<i64, Vec<u8>> {
        let buffers = [
            rerun::DepthImage::descriptor_buffer(),
            rerun::EncodedDepthImage::descriptor_blob(),
            rerun::SegmentationImage::descriptor_buffer(),
        ];
        let buffers = buffers.map(|buffer| buffer.component);
        let mut pictures = BTreeMap::new();
        for chunk in &self.data {
            if chunk.entity_path().to_string() != format!("/{entity}") || chunk.is_static() {
                continue;
            }
            let steps = chunk.timelines()[&"step".into()].times_raw().to_vec();
            for buffer in buffers {
                let rows = chunk.iter_slices::<&[u8]>(buffer);
                let steps = steps.iter().copied();
                pictures.extend(steps.zip(rows.map(|row| row[0].to_vec())));
            }
        }
        pictures
    }

    /// Values of an entity's pictures, by step: IEEE 754 binary16.
    pub(super) fn values(&self, entity: &str) -> BTreeMap<i64, Vec<f64>> {
        let value = |pair: &[u8]| {
            let half = u16::from_le_bytes([pair[0], pair[1]]);
            let (exponent, digits) = (i32::from((half >> 10) & 0x1f), f64::from(half & 0x3ff));
            let size = match exponent {
                0 => digits * 2.0_f64.powi(-24),
                31 => f64::NAN,
                _ => (1024.0 + digits) * 2.0_f64.powi(exponent - 25),
            };
            if half & 0x8000 == 0 { size } else { -size }
        };
        let levels = self.levels_per_unit(entity);
        let values = |step: &i64, bytes: &[u8]| match levels.get(step) {
            Some(per_unit) => levels_of(bytes).map(|level| level / per_unit).collect(),
            None => bytes.chunks_exact(2).map(value).collect(),
        };
        let pictures = self.pictures(entity).into_iter();
        pictures
            .map(|(step, bytes)| (step, values(&step, &bytes)))
            .collect()
    }

    /// Levels of a unit of an entity's pictures, by step; none of pictures that hold the values themselves.
    fn levels_per_unit(&self, entity: &str) -> BTreeMap<i64, f64> {
        let component = rerun::EncodedDepthImage::descriptor_meter().component;
        let mut levels = BTreeMap::new();
        for chunk in &self.data {
            if chunk.entity_path().to_string() == format!("/{entity}") && !chunk.is_static() {
                let steps = chunk.timelines()[&"step".into()].times_raw().to_vec();
                let rows = chunk.iter_slices::<f32>(component);
                levels.extend(steps.into_iter().zip(rows.map(|row| f64::from(row[0]))));
            }
        }
        levels
    }

    /// The upper end of an entity's colour range.
    pub(super) fn top(&self, entity: &str) -> f64 {
        self.tops(entity)[0].1
    }

    /// The upper ends of an entity's colour ranges, each with the step from which on it holds.
    fn tops(&self, entity: &str) -> Vec<(i64, f64)> {
        let levels = self.levels_per_unit(entity);
        let components = [
            rerun::DepthImage::descriptor_depth_range().component,
            rerun::EncodedDepthImage::descriptor_depth_range().component,
        ];
        let of_entity = |chunk: &&Chunk| chunk.entity_path().to_string() == format!("/{entity}");
        let mut tops = BTreeMap::new();
        for (chunk, component) in self
            .data
            .iter()
            .filter(of_entity)
            .flat_map(|chunk| components.map(|component| (chunk, component)))
        {
            let ranges = chunk.iter_slices::<[f64; 2]>(component);
            let tops_here: Vec<f64> = ranges.map(|range| range[0][1]).collect();
            // What holds for ever would shadow what holds from some step on.
            assert!(tops_here.is_empty() || !chunk.is_static(), "{entity}");
            if !tops_here.is_empty() {
                let steps = chunk.timelines()[&"step".into()].times_raw().to_vec();
                let of_unit = |step| levels.get(&step).unwrap_or(&1.0);
                let here = steps.into_iter().zip(tops_here);
                tops.extend(here.map(|(step, top)| (step, top / of_unit(step))));
            }
        }
        let mut tops: Vec<(i64, f64)> = tops.into_iter().collect();
        // Levels tell theirs with each picture.
        tops.dedup_by_key(|(_, top)| *top);
        tops
    }

    /// Curves of an entity, by step.
    pub(super) fn strips(&self, entity: &str) -> BTreeMap<i64, Vec<Vec<[f32; 2]>>> {
        let component = rerun::LineStrips2D::descriptor_strips().component;
        let of_entity = |chunk: &&Chunk| {
            chunk.entity_path().to_string() == format!("/{entity}") && !chunk.is_static()
        };
        let mut curves = BTreeMap::new();
        for chunk in self.data.iter().filter(of_entity) {
            let steps = chunk.timelines()[&"step".into()].times_raw().to_vec();
            for (row, step) in steps.into_iter().enumerate() {
                let Some(batch) = chunk.component_batch_raw(component, row) else {
                    continue;
                };
                let strips = rerun::components::LineStrip2D::from_arrow(&batch.unwrap()).unwrap();
                let strips = strips.into_iter();
                let strips = strips.map(|strip| strip.0.iter().map(|at| at.0).collect());
                curves.insert(step, strips.collect());
            }
        }
        curves
    }

    /// Points of an entity, by step.
    pub(super) fn places(&self, entity: &str) -> BTreeMap<i64, Vec<[f32; 2]>> {
        let component = rerun::Points2D::descriptor_positions().component;
        let of_entity = |chunk: &&Chunk| {
            chunk.entity_path().to_string() == format!("/{entity}") && !chunk.is_static()
        };
        let mut places = BTreeMap::new();
        for chunk in self.data.iter().filter(of_entity) {
            let steps = chunk.timelines()[&"step".into()].times_raw().to_vec();
            let rows = chunk.iter_slices::<[f32; 2]>(component);
            places.extend(steps.into_iter().zip(rows.map(<[[f32; 2]]>::to_vec)));
        }
        places
    }

    /// The highest point of an entity's curves in a step: heights count downwards.
    fn highest(&self, entity: &str, step: i64) -> f32 {
        let strips = self.strips(entity);
        let points = strips[&step].iter().flatten();
        points.map(|at| -at[1]).fold(0.0, f32::max)
    }

    /// Labels of an entity, those of a row one after another.
    fn labels(&self, entity: &str) -> Vec<String> {
        let component = rerun::Points2D::descriptor_labels().component;
        let of_entity = |chunk: &&Chunk| chunk.entity_path().to_string() == format!("/{entity}");
        let chunks = self.data.iter().filter(of_entity);
        let labels = chunks.flat_map(|chunk| {
            let labels = chunk.iter_slices::<String>(component);
            let together = labels.map(|row| row.iter().map(ToString::to_string).collect());
            together.collect::<Vec<String>>()
        });
        labels.collect()
    }

    /// Lines of the log.
    fn log(&self) -> Vec<String> {
        let component = rerun::TextLog::descriptor_text().component;
        let of_log = |chunk: &&Chunk| chunk.entity_path().to_string() == "/log";
        let chunks = self.data.iter().filter(of_log);
        let lines = chunks.flat_map(|chunk| {
            let lines = chunk.iter_slices::<String>(component);
            let own = lines.map(|row| row[0].to_string());
            own.collect::<Vec<_>>()
        });
        lines.collect()
    }

    /// A number among the recording's properties.
    fn property(&self, entity: &str, name: &'static str) -> Option<f64> {
        let entity = format!("/__properties/{entity}");
        let of_entity = |chunk: &&Chunk| chunk.entity_path().to_string() == entity;
        // Of what holds for ever the last one holds.
        let chunks = self.data.iter().filter(of_entity);
        let mut values = chunks.flat_map(|chunk| {
            let values = chunk.iter_slices::<f64>(name.into());
            values.map(|value| value[0]).collect::<Vec<_>>()
        });
        values.next_back()
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

/// What a recording of every one of these frames holds.
fn recorded(frames: &[Arc<Frame>]) -> Contents {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("run.rrd");
    record(&path, &every_step(), frames);
    Contents::read(&path)
}

/// Records `frames` of that scene.
pub(super) fn record_scene(path: &Path, scene: Scene, frames: &[Arc<Frame>]) -> ObserverReport {
    let mut recorder = Recorder::create(path, Overwrite::Refuse, &every_step()).unwrap();
    recorder.begin(&synthetic::context(scene)).unwrap();
    for frame in frames {
        recorder.frame(frame).unwrap();
    }
    recorder.finish().unwrap()
}

/// A scripted change.
pub(super) fn event(key: &str, value: f64) -> Event {
    Event {
        at_s: 1e-3,
        set: [(key.to_owned(), value)].into(),
        caption: String::new(),
    }
}

/// Frames that one after another are changed.
fn changed(steps: u64, change: impl Fn(&mut Frame)) -> Vec<Arc<Frame>> {
    let change = |frame: Arc<Frame>| {
        let mut frame = Frame::clone(&frame);
        change(&mut frame);
        Arc::new(frame)
    };
    frames(steps).into_iter().map(change).collect()
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
        assert_eq!(contents.updates(entity), steps, "{entity}");
    }
    // The second tab takes every second picture.
    for entity in [
        "maps/film_interferogram/image",
        "maps/traction_on_body_1_MPa/image",
        "maps/roughness_body_1_um/image",
        "maps/roughness_body_2_um/image",
        "slice_y0/tau_xz_GPa/image",
    ] {
        assert_eq!(contents.updates(entity), steps / 2, "{entity}");
    }
    // Logged when they change, and they do not.
    for entity in [
        "contact_3d/surface_speeds",
        "centre_line_y0/hertz_pressure_GPa",
        "maps/hertz_contact",
        "slice_y0/hertz_width",
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
    let frames = frames(STEPS);
    let contents = recorded(&frames);
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
fn what_both_bodies_have_yielded_is_a_curve_once_something_has() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("run.rrd");
    // Elastic; then with a hardness, and from the third step on something flows.
    let flown = |step: u64| [2e-18 * (step.max(2) - 2) as f64, 0.0];
    for (has_hardness, rows) in [(false, 0), (true, STEPS - 2)] {
        let mut frames = frames(STEPS);
        for frame in frames.iter_mut().filter(|_| has_hardness) {
            let frame = Arc::make_mut(frame);
            frame.metrics.yielded_m3 = Some(flown(frame.step));
        }
        let _ = std::fs::remove_file(&path);
        record(&path, &every_step(), &frames);
        let curve = Contents::read(&path).scalars("series/yielded_um3");
        assert_eq!(curve.len() as u64, rows);
        for (step, both) in curve {
            let expected = flown(u64::try_from(step).unwrap()).map(|volume| volume * 1e18);
            assert_eq!(both, expected);
        }
    }
}

#[test]
fn what_stays_is_logged_once_and_the_file_explains_itself() {
    let contents = recorded(&frames(STEPS));
    for entity in [
        "maps/pressure_GPa/axes/frame",
        "maps/pressure_GPa/axes/labels",
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
    // Ranges hold from the first frame on and not for ever: a knob may be turned beyond them.
    for entity in [
        "maps/pressure_GPa/legend/bar",
        "maps/pressure_GPa/legend/labels",
        "centre_line_y0/axes/labels",
        "contact_3d/legend/pressure/labels",
    ] {
        assert_eq!(contents.rows(entity, false), 1, "{entity}");
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
    // Nothing outside of the folders that the layout shows, but for what programs read.
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
        "grid_si",
        "kymograph",
        "life",
        "log",
        "maps",
        "material_point",
        "profile_y0",
        "research",
        "scalars_si",
        "series",
        "slice_y0",
        "text",
    ];
    assert_eq!(folders, known.map(String::from).into());
}

#[test]
fn the_layout_is_in_the_file_with_the_properties_of_its_views() {
    let contents = recorded(&frames(2));
    assert_eq!(contents.activations, 1);
    let paths: Vec<String> = contents
        .layout
        .iter()
        .map(|chunk| chunk.entity_path().to_string())
        .collect();
    assert!(paths.iter().any(|path| path == "/viewport"));
    let of = |property: &str| paths.iter().filter(|path| path.ends_with(property)).count();
    // For an audience and for looking closer.
    assert_eq!(of("/EyeControls3D"), 2);
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
        budget_mb: 1.6,
    };
    record(&path, &small, &frames);
    let contents = Contents::read(&path);
    assert_eq!(contents.rows("series/pressure_GPa", false), 40);
    let fields = contents.updates("maps/pressure_GPa/image");
    assert!((2..30).contains(&fields), "{fields}");
    assert_eq!(fields, contents.rows("contact_3d/body_1_surface", false));
    let notes = contents.text("text/notes_on_the_data");
    assert!(notes.contains("more seldom than asked for"), "{notes}");
}

/// The whole file with all that is in it, also when nearly all of it are scalars; and what is kept is the same whatever
/// the clock does.
#[test]
fn a_budget_is_a_budget_and_knows_no_clock() {
    let folder = tempfile::tempdir().unwrap();
    let frames: Vec<Frame> = (1..=64)
        .map(|step| Frame::clone(&synthetic::frame(NODES, step)))
        .collect();
    // Layout and the first chunk of every entity alone take nearly 1.5 MB of this scene: a plan refuses less than 1.7.
    for (budget_mb, steps) in [(1.8, 600), (2.2, 3000), (5.0, 12_000)] {
        let record = |name: &str, pause_every: u64| {
            let path = folder.path().join(name);
            let record = Record {
                every_steps: 1,
                budget_mb,
            };
            let mut recorder = Recorder::create(&path, Overwrite::Replace, &record).unwrap();
            // Half of it comes after the scene's end.
            let passages = 0.5 * steps as f64 / (NODES - 1) as f64;
            let scene = synthetic::scene(NODES, passages);
            recorder.begin(&synthetic::context(scene)).unwrap();
            for step in 1..=steps {
                let mut frame = frames[step as usize % frames.len()].clone();
                frame.step = step;
                recorder.frame(&Arc::new(frame)).unwrap();
                if step % pause_every == 0 {
                    recorder.idle().unwrap();
                }
            }
            let bytes = recorder.finish().unwrap().bytes;
            let contents = Contents::read(&path);
            let scalars = contents.rows("series/pressure_GPa", false);
            (bytes, scalars, contents.pictures("maps/pressure_GPa/image"))
        };
        let (bytes, scalars, quick) = record("quick.rrd", u64::MAX);
        println!(
            "{budget_mb} MB, {steps} steps: {bytes} bytes, {scalars} scalars, {} frames",
            quick.len()
        );
        assert!(bytes as f64 <= 1e6 * budget_mb, "{bytes} of {budget_mb} MB");
        // Weights are upper estimates: what is made up here is compressed better than a run's numbers.
        assert!(
            bytes as f64 > 0.4e6 * budget_mb,
            "{bytes} of {budget_mb} MB"
        );
        assert!(quick.len() > 1 && scalars > 100);
        let (_, again, slow) = record("slow.rrd", 7);
        assert_eq!((again, slow == quick), (scalars, true));
    }
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
    assert_eq!(contents.updates("maps/film_um/image"), 3);
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
    assert_eq!(contents.updates("maps/film_um/image"), STEPS as usize);
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
    let frames = with_damage(1);
    let contents = recorded(&frames);
    let entity = "damage/body_2_log10_relative";
    assert_eq!(contents.updates(&format!("{entity}/image")), 2);
    assert_eq!(contents.rows(&format!("{entity}/worst_point"), false), 2);
    assert_eq!(contents.rows(&format!("{entity}/axes/frame"), true), 1);
    assert!(
        contents
            .entities()
            .iter()
            .all(|path| !path.contains("damage/body_1"))
    );
}

/// What all cycles have left is logged with each jump, after the cycles that it is of; every other picture after those of its
/// heights, which are a jump ahead.
#[test]
fn what_ages_stands_on_a_timeline_of_cycles() {
    let jump = 1000.0;
    let frames: Vec<_> = with_damage(0)
        .into_iter()
        .map(|frame| {
            let mut frame = Frame::clone(&frame);
            let done = jump * (frame.step / 3) as f64;
            frame.suffered = frame.damage.clone();
            frame.cycles = Some(done + jump);
            frame.age = Some(AgePoint {
                cycles: done,
                ..AgePoint::default()
            });
            Arc::new(frame)
        })
        .collect();
    let contents = recorded(&frames);
    let cycles = |entity: &str| -> BTreeSet<i64> {
        let chunks = contents.data.iter();
        chunks
            .filter(|chunk| chunk.entity_path().to_string() == entity)
            .filter_map(|chunk| chunk.timelines().get(&"cycles".into()))
            .flat_map(|column| column.times_raw().to_vec())
            .collect()
    };
    let of_all = "/ages/damage_body_1_log10/image";
    assert_eq!(cycles(of_all), [1000, 2000].into());
    assert_eq!(contents.updates(&of_all[1..]), 2);
    assert_eq!(cycles("/maps/film_um/image"), [1000, 2000, 3000].into());
    assert!(cycles("/ages/damage_body_2_log10/image").is_empty());
}

#[test]
fn the_damage_of_body_1_hangs_below_the_cut() {
    let contents = recorded(&with_damage(0));
    // Its shape once, its colours with every change.
    assert_eq!(contents.rows("contact_3d/damage_body_1", false), 3);
    assert_eq!(contents.rows("contact_3d/damage_title", false), 1);
}

/// A scene that starts at S = 0 has no traction in its first frame, and is told by its script that some will come.
#[test]
fn traction_that_comes_later_is_neither_cut_off_nor_above_the_colours() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("run.rrd");
    let limit = 0.1;
    let frames = changed(STEPS, |frame| {
        let slides = frame.step > 3;
        let ratio = if slides { limit as f32 } else { 0.0 };
        frame.metrics.slide_roll = f64::from(u8::from(slides));
        for (traction, pressure) in frame.traction_pa.iter_mut().zip(&frame.pressure_pa) {
            *traction = ratio * pressure;
        }
    });
    let mut scene = synthetic::scene(NODES, 1.0);
    scene.motion.slide_roll = 0.0;
    scene.friction.boundary = limit;
    scene.events.push(event("motion.slide_roll", 1.0));
    let report = record_scene(&path, scene, &frames);
    assert_eq!(report.note, "");
    let contents = Contents::read(&path);
    let entity = "maps/traction_on_body_1_MPa/image";
    let top = contents.top(entity);
    let (&step, values) = contents
        .values(entity)
        .last_key_value()
        .map(|(k, v)| (k, v.clone()))
        .unwrap();
    let frame = shown(&frames[usize::try_from(step).unwrap() - 1]);
    let greatest = frame.traction_pa.iter().fold(0.0_f32, |top, v| top.max(*v));
    assert!(f64::from(greatest) * 1e-6 <= top, "{greatest} {top}");
    // Rows from the top down.
    let rows = frame.traction_pa.chunks_exact(frame.nx).rev();
    for (value, exact) in values.iter().zip(rows.flatten()) {
        let exact = f64::from(*exact) * 1e-6;
        assert!(
            (value - exact).abs() <= 5e-4 * exact + 1e-7,
            "{value} {exact}"
        );
    }
}

/// Colours hold the load, the speed and the crests that the script brings.
#[test]
fn ranges_follow_what_the_script_brings() {
    let tops = |events: Vec<Event>| {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("run.rrd");
        let mut scene = synthetic::scene(NODES, 1.0);
        scene.events = events;
        record_scene(&path, scene, &frames(2));
        let contents = Contents::read(&path);
        let entities = [
            "maps/pressure_GPa",
            "maps/film_um",
            "maps/roughness_body_1_um",
        ];
        let entities = entities.map(|entity| format!("{entity}/image"));
        entities.map(|entity| contents.top(&entity))
    };
    let plain = tops(Vec::new());
    let loaded = tops(vec![event("load.force_n", 8.0 * 800.0)]);
    // Eight times the load is twice the pressure; round numbers lie up to half as far again above.
    assert!(loaded[0] >= 1.5 * plain[0], "{loaded:?} {plain:?}");
    let fast = tops(vec![event("motion.entrainment_m_s", 10.0)]);
    assert!(fast[1] >= 3.0 * plain[1], "{fast:?} {plain:?}");
    let rough = tops(vec![event("body_1.surface.amplitude_m", 2e-6)]);
    assert!(
        rough[0] > plain[0] && rough[2] >= 2.0,
        "{rough:?} {plain:?}"
    );
    // What is less than now changes nothing.
    assert_eq!(tops(vec![event("load.force_n", 100.0)]), plain);
}

/// A load that is turned by hand beyond the script widens what a script that brings it would have given from the beginning:
/// pictures, legends and axes of the same step, and the log tells.
#[test]
fn a_load_turned_by_hand_widens_the_ranges_from_then_on() {
    const TURNED: u64 = 6;
    let load = 8.0 * 800.0;
    let frames = changed(STEPS, |frame| {
        if frame.step < TURNED {
            return;
        }
        frame.metrics.load_target_n = load;
        // Eight times the load is twice the pressure.
        frame.pressure_pa.iter_mut().for_each(|p| *p *= 2.0);
        frame.metrics.p_max_pa *= 2.0;
    });
    let folder = tempfile::tempdir().unwrap();
    let read = |name: &str, events: Vec<Event>| {
        let path = folder.path().join(name);
        let mut scene = synthetic::scene(NODES, 1.0);
        scene.events = events;
        record_scene(&path, scene, &frames);
        Contents::read(&path)
    };
    let scripted = read("scripted.rrd", vec![event("load.force_n", load)]);
    let by_hand = read("by_hand.rrd", Vec::new());
    for entity in ["maps/pressure_GPa", "slice_y0/effective_stress_GPa"] {
        let image = format!("{entity}/image");
        let wide = scripted.tops(&image);
        assert_eq!(wide.len(), 1, "{wide:?}");
        let found = by_hand.tops(&image);
        let [(1, first), (6, then)] = found[..] else {
            panic!("{entity}: {found:?}")
        };
        assert!(first < then && then == wide[0].1, "{found:?} {wide:?}");
        assert_eq!(by_hand.tops(&format!("{entity}/legend/bar")), found);
        let labels = by_hand.labels(&format!("{entity}/legend/labels"));
        for top in [first, then] {
            let top = format!("≥{top}");
            assert!(labels.iter().any(|row| row.contains(&top)), "{labels:?}");
        }
        let told = format!("the colours of {entity} reach {then} GPa from here on, before {first}");
        let log = by_hand.log();
        assert!(log.iter().any(|line| line.contains(&told)), "{log:?}");
    }
    // Nothing is above the colours.
    assert!(!by_hand.text("text/now").contains("above the colours"));
    // Curves are drawn to the axes of their step.
    let scripted_axes = scripted.labels("centre_line_y0/axes/labels");
    let labels = by_hand.labels("centre_line_y0/axes/labels");
    // What the script foretells is in a larger picture from the beginning.
    let heights = |row: &String| row.trim_start_matches("-1").to_owned();
    let [labels, scripted_axes] =
        [&labels[1..], &scripted_axes].map(|rows| rows.iter().map(heights).collect::<Vec<_>>());
    assert_eq!(labels, scripted_axes);
    for curve in [
        "centre_line_y0/pressure_GPa",
        "material_point/trace/pressure_GPa",
    ] {
        // A picture is as high as it is wide.
        let wide = |size| (Window::around(&frames[0], size).cut(&frames[0]).nx - 1) as f32;
        let [own, foretold] = [wide(1.0), wide(2.0)];
        let highest = |step| {
            let highest = |contents: &Contents, wide| contents.highest(curve, step) / wide;
            [highest(&by_hand, own), highest(&scripted, foretold)]
        };
        let [one, other] = highest(12);
        assert!((one / other - 1.0).abs() < 1e-5, "{curve}: {one} {other}");
        let [one, other] = highest(5);
        assert!(one > 1.2 * other, "{curve}: {one} {other}");
    }
}

/// Where pits start the picture holds what the solver computed, in rows of its own depths.
#[test]
fn stress_near_the_surface_comes_back_as_it_was() {
    let frames = frames(STEPS);
    let contents = recorded(&frames);
    let stresses = contents.values("slice_y0/effective_stress_GPa/image");
    assert_eq!(stresses.len(), frames.len());
    let top = contents.top("slice_y0/effective_stress_GPa/image");
    for frame in frames.iter().map(|frame| shown(frame)) {
        let slice = frame.slice.as_ref().unwrap();
        let stored = &stresses[&i64::try_from(frame.step).unwrap()];
        assert_eq!(stored.len(), frame.nx * slice.depths_m.len());
        for (stored, exact) in stored.iter().zip(&slice.effective_pa) {
            let exact = f64::from(*exact) * 1e-9;
            // Half of a level, which is the 4096th to 8191st part of the range.
            assert!((stored - exact).abs() <= top / 8192.0, "{stored} {exact}");
        }
    }
}

#[test]
fn hertz_follows_the_load() {
    let frames = changed(STEPS, |frame| {
        let size = if frame.step < 6 { 1.0 } else { 1.25 };
        (frame.a_m, frame.b_m) = (size * frame.a_m, size * frame.b_m);
        frame.p_hertz_pa *= size;
    });
    let contents = recorded(&frames);
    for entity in [
        "maps/hertz_contact",
        "slice_y0/hertz_width",
        "slice_y0/hertz_width/label",
        "centre_line_y0/hertz_pressure_GPa",
    ] {
        assert_eq!(contents.rows(entity, false), 2, "{entity}");
        assert_eq!(contents.rows(entity, true), 0, "{entity}");
    }
    let pressures = contents.scalars("series/pressure_GPa");
    assert_eq!(pressures[&12][1], 1.25 * pressures[&1][1]);
    // The scene has no script: what its knobs set has no curve, and is among the numbers of each step.
    let entities = contents.entities();
    let has = |entity: &str| {
        entities
            .iter()
            .any(|own| own.trim_start_matches('/') == entity)
    };
    assert!(!has("series/half_width_um") && !has("series/motion") && has("scalars_si"));
}

/// Chunks in the file: entity, and steps of its rows.
fn division(path: &Path) -> Vec<(String, Vec<i64>)> {
    let contents = Contents::read(path);
    let chunks = contents.data.iter().filter(|chunk| !chunk.is_static());
    let chunks = chunks.map(|chunk| {
        let steps = chunk.timelines()[&"step".into()].times_raw().to_vec();
        (chunk.entity_path().to_string(), steps)
    });
    let mut chunks: Vec<_> = chunks.collect();
    chunks.sort();
    chunks
}

/// On a machine that is busy with other things every frame may be sent by itself: thousands of messages. The finished
/// file is the same, and has its footer.
#[test]
fn what_the_file_holds_does_not_depend_on_the_clock() {
    let folder = tempfile::tempdir().unwrap();
    let record = |name: &str, slow: bool| {
        let path = folder.path().join(name);
        let mut recorder = Recorder::create(&path, Overwrite::Refuse, &every_step()).unwrap();
        recorder
            .begin(&synthetic::context(synthetic::scene(NODES, 1.0)))
            .unwrap();
        for frame in frames(40) {
            recorder.frame(&frame).unwrap();
            if slow {
                recorder.idle().unwrap();
            }
        }
        let report = recorder.finish().unwrap();
        assert_eq!(report.bytes, std::fs::metadata(&path).unwrap().len());
        assert_eq!(report.note, "");
        path
    };
    let (quick, slow) = (record("quick.rrd", false), record("slow.rrd", true));
    assert_eq!(division(&quick), division(&slow));
    for path in [&quick, &slow] {
        let manifests = RawRrdManifest::from_rrd_bytes(&std::fs::read(path).unwrap()).unwrap();
        assert!(
            manifests.iter().any(|of| of.store_id.is_recording()),
            "{}",
            path.display()
        );
        let chunks: usize = manifests.iter().map(|of| of.data.num_rows()).sum();
        let contents = Contents::read(path);
        assert_eq!(chunks, contents.data.len() + contents.layout.len());
    }
    // Nothing is left beside them.
    assert_eq!(std::fs::read_dir(folder.path()).unwrap().count(), 2);
}

/// What is at the first step is a picture and not a line of the log alone.
#[test]
fn the_first_frame_is_a_frame() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("run.rrd");
    let mut recorder = Recorder::create(&path, Overwrite::Refuse, &every_step()).unwrap();
    recorder
        .begin(&synthetic::context(synthetic::scene(NODES, 1.0)))
        .unwrap();
    let kind = RunEventKind::Caption("It begins.".into());
    let (step, time_s) = (0, 0.0);
    recorder.event(&RunEvent { step, time_s, kind }).unwrap();
    for frame in frames(20).iter().skip(2) {
        recorder.frame(frame).unwrap();
    }
    recorder.finish().unwrap();
    let contents = Contents::read(&path);
    let first = |chunk: &Chunk| chunk.timelines()[&"step".into()].times_raw()[0];
    let temporal = contents.data.iter().filter(|chunk| !chunk.is_static());
    assert_eq!(temporal.map(first).min(), Some(3));
    for entity in [
        "maps/pressure_GPa/image",
        "maps/traction_on_body_1_MPa/image",
        "maps/film_interferogram/image",
        "slice_y0/tau_xz_GPa/image",
        "kymograph/pressure_y0_GPa/image",
        "maps/hertz_contact",
        "log",
    ] {
        let chunks = contents.data.iter().filter(|chunk| !chunk.is_static());
        let mut chunks =
            chunks.filter(|chunk| chunk.entity_path().to_string() == format!("/{entity}"));
        assert!(chunks.any(|chunk| first(chunk) == 3), "{entity}");
    }
    assert!(contents.text("text/now").contains("It begins."));
}

/// A run that goes on after the scene's own end is still in the picture, all of it.
#[test]
fn the_kymograph_shows_the_whole_run() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("run.rrd");
    let frames = frames(50);
    // The scene asks for 16 steps.
    record_scene(&path, synthetic::scene(NODES, 0.5), &frames);
    let contents = Contents::read(&path);
    let pictures = contents.values("kymograph/pressure_y0_GPa/image");
    let (_, last) = pictures.last_key_value().unwrap();
    let nx = shown(&frames[0]).nx;
    let rows: Vec<&[f64]> = last.chunks_exact(nx).collect();
    let top = contents.top("kymograph/pressure_y0_GPa/image");
    // 50 steps in rows of four.
    assert_eq!(rows.len(), 13);
    for (row, step) in rows.iter().zip((0..50).step_by(4)) {
        let frame = shown(&frames[step]);
        for (stored, exact) in row.iter().zip(frame.centre_line(&frame.pressure_pa)) {
            let exact = f64::from(*exact) * 1e-9;
            let far = (stored - exact).abs();
            assert!(far <= top / 8192.0, "step {}: {far}", step + 1);
        }
    }
    let axes = contents.rows("kymograph/pressure_y0_GPa/axes/labels", false);
    assert_eq!(axes, 3, "one for each length of the axis");
}

#[test]
fn damage_that_is_not_counted_yet_is_covered_and_told() {
    let contents = recorded(&with_damage(1));
    let entity = "damage/body_2_log10_relative";
    let values = contents.values(&format!("{entity}/image"));
    let covers = contents.pictures(&format!("{entity}/not_crossed"));
    let counted = |values: &[f64]| values.iter().filter(|value| !value.is_nan()).count();
    let [(_, early), (_, late)] = values.iter().collect::<Vec<_>>()[..] else {
        panic!("two pictures");
    };
    // One column of four, three depths each.
    assert_eq!((counted(early), counted(late)), (3, 12));
    let covered = |cover: &Vec<u8>| {
        cover
            .iter()
            .map(|&covered| usize::from(covered))
            .sum::<usize>()
    };
    assert_eq!(covers.values().map(covered).collect::<Vec<_>>(), [9, 0]);
    let labels = contents.labels(&format!("{entity}/worst_point"));
    assert!(labels[0].contains("25 % of it has crossed"), "{labels:?}");
    assert!(!labels[1].contains("crossed"), "{labels:?}");
}

#[test]
fn the_recording_has_a_name_and_properties() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("run.rrd");
    let frames = frames(STEPS);
    record(&path, &every_step(), &frames);
    let contents = Contents::read(&path);
    let component = rerun::RecordingInfo::descriptor_name().component;
    let names = contents.data.iter().flat_map(|chunk| {
        let names = chunk.iter_slices::<String>(component);
        names.map(|name| name[0].to_string()).collect::<Vec<_>>()
    });
    let names: Vec<String> = names.collect();
    assert!(
        names
            .iter()
            .any(|name| name.starts_with("Synthetic passage: S = 0.500")),
        "{names:?}"
    );
    assert_eq!(contents.property("scene", "S"), Some(0.5));
    assert!(
        contents
            .property("scene", "p_Hertz_GPa")
            .is_some_and(|p| p > 1.0)
    );
    let life = frames[frames.len() - 1].metrics.life.unwrap().life_relative;
    assert_eq!(contents.property("result", "life_relative"), Some(life));
    assert_eq!(contents.property("result", "life_extrapolated"), None);

    // What only the companion of the run tells comes after the end.
    let summary = asperity_engine::sim::Summary {
        life_relative: Some(8e-9),
        life_extrapolated: Some(7.5e-9),
        ..asperity_engine::sim::Summary::default()
    };
    let before = division(&path);
    asperity_recorder::note_summary(&path, &summary).unwrap();
    let contents = Contents::read(&path);
    assert_eq!(contents.property("result", "life_relative"), Some(8e-9));
    assert_eq!(
        contents.property("result", "life_extrapolated"),
        Some(7.5e-9)
    );
    assert_eq!(division(&path), before);
    assert!(
        !RawRrdManifest::from_rrd_bytes(&std::fs::read(&path).unwrap())
            .unwrap()
            .is_empty()
    );
}

#[test]
fn numbers_that_can_be_small_keep_their_digits() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("run.rrd");
    let frames = changed(2, |frame| {
        let life = frame.metrics.life.as_mut().unwrap();
        (life.life_relative, life.cycle_factor) = (8e-9, 0.25);
        (life.life_relative_low, life.life_relative_high) = (7e-9, 9e-9);
        life.load_factor = 0.0123;
    });
    record(&path, &every_step(), &frames);
    let now = Contents::read(&path).text("text/now");
    for words in ["8.00e-9", "7.00e-9 to 9.00e-9", "load 0.0123", "regime"] {
        assert!(now.contains(words), "{words}: {now}");
    }
}

#[test]
fn views_bring_their_own_background() {
    let contents = recorded(&frames(2));
    let paths: Vec<String> = contents
        .layout
        .iter()
        .map(|chunk| chunk.entity_path().to_string())
        .collect();
    let of = |property: &str| {
        let of = paths.iter().filter_map(|path| path.strip_suffix(property));
        of.collect::<BTreeSet<_>>()
    };
    let (flat, deep) = (of("/VisualBounds2D"), of("/EyeControls3D"));
    assert_eq!(of("/Background"), &flat | &deep);
    // Plots have the theme's; their colours stand out from either.
    assert!(of("/PlotBackground").is_empty());
}

/// What rests while a run is recorded is a number and no curve; where the script or a hand turns it there is one.
#[test]
fn what_rests_is_no_plot() {
    let folder = tempfile::tempdir().unwrap();
    let titles = |name: &str, events: Vec<Event>, by_hand: bool| -> Vec<String> {
        let path = folder.path().join(name);
        let mut scene = synthetic::scene(NODES, 1.0);
        scene.events = events;
        let recorder = Recorder::create(&path, Overwrite::Refuse, &every_step()).unwrap();
        let mut recorder = if by_hand {
            recorder.by_hand()
        } else {
            recorder
        };
        recorder.begin(&synthetic::context(scene)).unwrap();
        for frame in frames(2) {
            recorder.frame(&frame).unwrap();
        }
        recorder.finish().unwrap();
        let component = rerun::external::re_sdk_types::blueprint::archetypes::ViewBlueprint::descriptor_display_name();
        let layout = Contents::read(&path).layout;
        let names = layout.iter().flat_map(|chunk| {
            let rows = chunk.iter_slices::<String>(component.component);
            rows.flat_map(|row| row.iter().map(ToString::to_string).collect::<Vec<_>>())
                .collect::<Vec<_>>()
        });
        names.collect()
    };
    let load = || vec![event("load.force_n", 900.0)];
    for (name, events, by_hand, turns) in [
        ("rests.rrd", Vec::new(), false, false),
        ("script.rrd", load(), false, true),
        ("hand.rrd", Vec::new(), true, true),
    ] {
        let titles = titles(name, events, by_hand);
        assert!(
            titles.iter().any(|title| title == "Friction coefficient"),
            "{titles:?}"
        );
        for known in ["Load, N", "Motion", "Hertz half-width", "λ ratio"] {
            let has = titles.iter().any(|title| title.starts_with(known));
            assert_eq!(has, turns, "{name}: {known} in {titles:?}");
        }
    }
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

/// Where the scene asks for heat, temperatures are seen from above and over time; elsewhere nothing is there of them.
#[test]
fn temperatures_are_seen_from_above_and_over_time() {
    let warm = changed(STEPS, |frame| {
        let rise = |k_per_pa: f32| -> Vec<f32> {
            frame.pressure_pa.iter().map(|p| p * k_per_pa).collect()
        };
        let rises = [rise(1e-8), rise(2e-8), rise(5e-8)];
        let [one, two, film] = rises;
        (frame.surface_rise_k, frame.film_rise_k) = ([one, two], film);
    });
    let contents = recorded(&warm);
    let last = shown(&warm[warm.len() - 1]);
    for (name, field) in [
        ("surface_1_rise", &last.surface_rise_k[0]),
        ("surface_2_rise", &last.surface_rise_k[1]),
        ("film_rise", &last.film_rise_k),
    ] {
        let entity = format!("kymograph/{name}_y0_K/image");
        let top = contents.top(&entity);
        let pictures = contents.values(&entity);
        let (_, picture) = pictures.last_key_value().unwrap();
        let row = &picture[picture.len() - last.nx..];
        for (stored, exact) in row.iter().zip(last.centre_line(field)) {
            let most = top.max(f64::from(*exact)) / 4096.0;
            assert!(
                (stored - f64::from(*exact)).abs() <= most,
                "{name}: {stored} {exact}"
            );
        }
        assert!(
            contents.updates(&format!("maps/{name}_K/image")) > 0,
            "{name}"
        );
    }
    let cold = recorded(&frames(2)).entities();
    assert!(
        !cold.iter().any(|entity| entity.contains("rise")),
        "{cold:?}"
    );
}
