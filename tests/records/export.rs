//! Exported fields: one archive a step with the scene beside it, and nobody's files lost.
#![expect(clippy::unwrap_used, reason = "tests")]

use crate::common::synthetic;
use asperity_engine::observe::{Observer, Overwrite};
use asperity_picture::export::{Export, Format, PrintSize};

const NODES: usize = 17;

#[test]
fn every_step_handed_over_becomes_an_archive_beside_the_scene() {
    let folder = tempfile::tempdir().unwrap();
    let target = folder.path().join("fields");
    let mut export = Export::create(&target, Overwrite::Refuse, &[Format::Npz]).unwrap();
    let context = synthetic::context(synthetic::scene(NODES, 1.0));
    export.begin(&context).unwrap();
    for step in [16, 32] {
        export.frame(&synthetic::frame(NODES, step)).unwrap();
    }
    let report = export.finish().unwrap();
    let bytes = |name: &str| std::fs::read(target.join(name)).unwrap();
    let (one, two) = (bytes("step_000016.npz"), bytes("step_000032.npz"));
    assert_eq!(
        (report.frames, report.bytes),
        (2, (one.len() + two.len()) as u64)
    );
    assert_eq!(bytes("scene.toml"), context.scene_toml.as_bytes());
    // The pressure lies in the file as the frame held it.
    let frame = synthetic::frame(NODES, 16);
    let pressure: Vec<u8> = frame
        .pressure_pa
        .iter()
        .flat_map(|p| p.to_le_bytes())
        .collect();
    assert!(one.windows(pressure.len()).any(|window| window == pressure));
    for name in [
        "pressure_pa.npy",
        "film_m.npy",
        "slice_effective_pa.npy",
        "x_m.npy",
    ] {
        assert!(
            one.windows(name.len())
                .any(|window| window == name.as_bytes()),
            "{name}"
        );
    }
}

#[test]
fn a_folder_with_somebodys_files_is_refused() {
    let folder = tempfile::tempdir().unwrap();
    std::fs::write(folder.path().join("notes.txt"), "mine").unwrap();
    let refused = Export::create(folder.path(), Overwrite::Refuse, &[Format::Npz]).unwrap_err();
    assert!(refused.reason.contains("--force"), "{refused}");
    assert!(Export::create(folder.path(), Overwrite::Replace, &[Format::Npz]).is_ok());
    let file = folder.path().join("notes.txt");
    assert!(Export::create(&file.join("below"), Overwrite::Refuse, &[Format::Npz]).is_err());
}

/// What was asked for and is not there is told.
#[test]
fn a_picture_that_no_step_has_is_named() {
    let folder = tempfile::tempdir().unwrap();
    let export = Export::create(folder.path(), Overwrite::Refuse, &[Format::Png]).unwrap();
    let asked = ["pressure", "tooth"].map(str::to_owned);
    let mut export = export.of(&asked, PrintSize::default());
    export
        .begin(&synthetic::context(synthetic::scene(NODES, 1.0)))
        .unwrap();
    export.frame(&synthetic::frame(NODES, 16)).unwrap();
    let note = export.finish().unwrap().note;
    assert_eq!(note, "nothing to draw of tooth: the run has none of it");
}

/// Of a run pictures show what was between the steps that are drawn; arrays are of those steps alone.
#[test]
fn steps_between_are_in_the_pictures_and_write_nothing() {
    let drawn = |every: u64, given: u64| {
        let folder = tempfile::tempdir().unwrap();
        let formats = [Format::Png, Format::Npz];
        let export = Export::create(folder.path(), Overwrite::Refuse, &formats).unwrap();
        let mut export = export.every(every);
        export
            .begin(&synthetic::context(synthetic::scene(NODES, 1.0)))
            .unwrap();
        for step in (given..=16).step_by(given as usize) {
            export.frame(&synthetic::frame(NODES, step)).unwrap();
        }
        assert_eq!(export.kept(), Some(16 / every.max(given)));
        export.finish().unwrap();
        let read = |name: &str| std::fs::read(folder.path().join(format!("step_000016{name}")));
        [
            "_pressure.png",
            ".npz",
            "_passage.png",
            "_pressure_over_time.png",
        ]
        .map(|name| read(name).unwrap())
    };
    let [all, some] = [drawn(8, 1), drawn(8, 8)];
    // The same map and the same arrays, and a trace and rows of sixteen steps in place of two.
    assert_eq!(all[..2], some[..2]);
    assert!(all[2] != some[2] && all[3] != some[3]);
}

#[test]
fn pictures_are_drawn_of_every_map_and_of_the_centre_line() {
    let folder = tempfile::tempdir().unwrap();
    let mut export = Export::create(folder.path(), Overwrite::Refuse, &[Format::Png]).unwrap();
    let context = synthetic::context(synthetic::scene(NODES, 1.0));
    export.begin(&context).unwrap();
    export.frame(&synthetic::frame(NODES, 16)).unwrap();
    let report = export.finish().unwrap();
    let mut bytes = 0;
    for name in [
        "pressure",
        "film",
        "interferogram",
        "traction",
        "roughness_1",
        "roughness_2",
        "effective_stress",
        "tau_xz",
        "centre_line",
        "profile",
        "passage",
        "pressure_over_time",
        "film_over_time",
        "life_over_time",
        "stress_path",
        "sn_point",
    ] {
        let file = folder.path().join(format!("step_000016_{name}.png"));
        let picture = std::fs::read(&file).unwrap();
        assert!(picture.starts_with(b"\x89PNG\r\n"), "{name}");
        // Width and height in the header; the end is there.
        assert!(u32::from_be_bytes(picture[16..20].try_into().unwrap()) > 700);
        assert!(picture.ends_with(b"IEND\xaeB`\x82"), "{name}");
        bytes += picture.len() as u64;
    }
    assert_eq!((report.frames, report.bytes), (1, bytes));
    assert!(!folder.path().join("step_000016.npz").exists());
}

/// What comes back from a recording goes through the same painter.
#[cfg(feature = "rerun")]
mod from_a_recording {
    use std::path::Path;
    use std::process::Command;
    use std::sync::Arc;

    use asperity_engine::observe::{Observer, Overwrite, RunContext};
    use asperity_engine::scene::{Record, Scene};
    use asperity_engine::sim::Frame;
    use asperity_picture::Window;
    use asperity_picture::export::{Export, Format, PrintSize, TakenAs};
    use asperity_recorder::{RecordedFrames, Recorder};
    use asperity_session::Table;

    use crate::common::synthetic;
    use crate::recording::Contents;

    const NODES: usize = 33;

    fn context() -> RunContext {
        let text = Scene::load("demonstration").unwrap().to_toml();
        RunContext {
            scene_toml: text.clone(),
            ..synthetic::context(Scene::from_toml(&text).unwrap())
        }
    }

    /// The frame of a run with heat.
    fn warm(frame: &Frame) -> Frame {
        let rise = |k_per_pa: f32| frame.pressure_pa.iter().map(|p| p * k_per_pa).collect();
        Frame {
            surface_rise_k: [rise(1e-8), rise(2e-8)],
            film_rise_k: rise(5e-8),
            ..frame.clone()
        }
    }

    /// Frames, and the same from a recording of them.
    fn both(folder: &Path, steps: u64) -> (Vec<Arc<Frame>>, RecordedFrames) {
        let frames: Vec<Arc<Frame>> = (1..=steps)
            .map(|step| Arc::new(warm(&synthetic::frame(NODES, step))))
            .collect();
        let path = folder.join("run.rrd");
        let record = Record {
            every_steps: 1,
            budget_mb: 200.0,
        };
        let mut recorder = Recorder::create(&path, Overwrite::Refuse, &record).unwrap();
        recorder.begin(&context()).unwrap();
        for frame in &frames {
            recorder.frame(frame).unwrap();
        }
        recorder.finish().unwrap();
        (frames, RecordedFrames::read(&path).unwrap())
    }

    fn export(folder: &Path, formats: &[Format], frames: &[Frame], chosen: &[&str]) -> u64 {
        let chosen: Vec<String> = chosen.iter().map(ToString::to_string).collect();
        let export = Export::create(folder, Overwrite::Refuse, formats).unwrap();
        let mut export = export.of(&chosen, PrintSize::default());
        export.begin(&context()).unwrap();
        for frame in frames {
            export.take(frame, TakenAs::Still).unwrap();
        }
        export.finish().unwrap().bytes
    }

    fn has_ending(name: &str, ending: &str) -> bool {
        Path::new(name).extension().is_some_and(|own| own == ending)
    }

    fn pixels(path: &Path) -> Vec<u8> {
        let decoder =
            png::Decoder::new(std::io::BufReader::new(std::fs::File::open(path).unwrap()));
        let mut reader = decoder.read_info().unwrap();
        let mut bytes = vec![0; reader.output_buffer_size().unwrap()];
        reader.next_frame(&mut bytes).unwrap();
        bytes
    }

    #[test]
    fn pictures_and_numbers_are_those_of_the_run_within_half_precision() {
        let folder = tempfile::tempdir().unwrap();
        let (frames, read) = both(folder.path(), 8);
        let whole = read.whole();
        let window = Window::around(&frames[0], 1.0);
        let back: Vec<Frame> = whole
            .iter()
            .map(|&step| read.frame(step).unwrap())
            .collect();
        let own: Vec<Frame> = whole
            .iter()
            .map(|&step| window.cut(&frames[step as usize - 1]))
            .collect();
        let [one, two] = ["run", "recording"].map(|name| folder.path().join(name));
        // Both painters see the first frame first: it sets the ranges.
        export(&one, &[Format::Png, Format::Npz], &own, &[]);
        export(&two, &[Format::Png, Format::Npz], &back, &[]);
        let mut compared = 0;
        for entry in std::fs::read_dir(&one).unwrap() {
            let name = entry.unwrap().file_name();
            let [one, two] = [one.join(&name), two.join(&name)];
            let name = name.to_string_lossy().into_owned();
            if has_ending(&name, "npz") {
                let sizes = [&one, &two].map(|path| std::fs::metadata(path).unwrap().len());
                assert_eq!(sizes[0], sizes[1], "{name}: the same arrays");
            }
            // Fringes repeat ten times in the film that is 0.05 % uncertain in the bath.
            if !has_ending(&name, "png") || name.contains("interferogram") {
                continue;
            }
            let [one, two] = [pixels(&one), pixels(&two)];
            assert_eq!(one.len(), two.len(), "{name}");
            let far = one
                .iter()
                .zip(&two)
                .filter(|(one, two)| one.abs_diff(**two) > 4)
                .count();
            assert!(
                far as f64 <= 1e-3 * one.len() as f64,
                "{name}: {far} of {}",
                one.len()
            );
            compared += 1;
        }
        assert!(compared >= 4 * 8, "{compared}");
    }

    #[test]
    fn recordings_are_drawn_side_by_side_in_the_same_ranges() {
        let folder = tempfile::tempdir().unwrap();
        let (frames, _) = both(folder.path(), 4);
        let high: Vec<Frame> = frames
            .iter()
            .map(|frame| {
                let mut frame = Frame::clone(frame);
                frame.pressure_pa.iter_mut().for_each(|p| *p *= 2.0);
                frame.metrics.p_max_pa *= 2.0;
                frame
            })
            .collect();
        let drawn = |name: &str, others: &[&[Frame]]| {
            let out = folder.path().join(name);
            let formats = [Format::Png, Format::Gif];
            let export = Export::create(&out, Overwrite::Refuse, &formats).unwrap();
            let chosen = ["pressure", "passage"].map(str::to_owned);
            let scene = context().scene;
            let scenes = others.iter().map(|_| &*scene);
            let mut export = export.of(&chosen, PrintSize::default()).beside(scenes);
            export.begin(&context()).unwrap();
            for (k, frame) in frames.iter().enumerate() {
                let others = others.iter().map(|run| &run[k]);
                let all: Vec<&Frame> = std::iter::once(&**frame).chain(others).collect();
                export.take_all(&all, TakenAs::Still).unwrap();
            }
            export.finish().unwrap();
            assert!(out.join("passage.gif").exists());
            let size = |name: &str| {
                let bytes = std::fs::read(out.join(name)).unwrap();
                [16, 20].map(|at| u32::from_be_bytes(bytes[at..at + 4].try_into().unwrap()))
            };
            let [wide, tall] = size("step_000004_passage.png");
            assert_eq!(wide as usize, 900 * (1 + others.len()));
            assert!(tall > 700);
            pixels(&out.join("step_000004_pressure.png"))
        };
        let [alone, twice, with_higher] = [
            drawn("alone", &[]),
            drawn("twice", &[&high]),
            drawn("three", &[&high, &high]),
        ];
        // The right half of two is the middle third of three, and the left one is drawn to the higher range.
        let part = |pixels: &[u8], runs: usize, at: usize| -> Vec<u8> {
            let rows = pixels.chunks_exact(3 * 900 * runs);
            rows.flat_map(|row| &row[3 * 900 * at..][..3 * 900])
                .copied()
                .collect()
        };
        assert_eq!(part(&twice, 2, 1), part(&with_higher, 3, 1));
        assert_eq!(part(&with_higher, 3, 1), part(&with_higher, 3, 2));
        assert_ne!(part(&twice, 2, 0), alone, "its range is the common one");
    }

    #[test]
    fn the_table_of_a_recording_is_that_of_the_run() {
        let folder = tempfile::tempdir().unwrap();
        let (frames, read) = both(folder.path(), 6);
        let table = |name: &str, frames: &[Arc<Frame>]| {
            let path = folder.path().join(name);
            let mut table = Table::create(&path, Overwrite::Refuse).unwrap();
            table.begin(&context()).unwrap();
            for frame in frames {
                table.frame(frame).unwrap();
            }
            table.finish().unwrap();
            std::fs::read_to_string(path).unwrap()
        };
        let back: Vec<Arc<Frame>> = read.steps().map(Arc::new).collect();
        assert_eq!(table("one.csv", &frames), table("two.csv", &back));
    }

    #[test]
    fn papers_have_their_size_and_no_title_and_animations_move() {
        let folder = tempfile::tempdir().unwrap();
        let (_, read) = both(folder.path(), 12);
        let back: Vec<Frame> = read
            .shown()
            .iter()
            .map(|&step| read.frame(step).unwrap())
            .collect();
        let target = folder.path().join("out");
        let formats = [Format::Svg, Format::Pdf, Format::Gif, Format::Vti];
        let bytes = export(
            &target,
            &formats,
            &back,
            &["pressure", "centre_line", "effective_stress"],
        );
        assert!(bytes > 0);
        let svg = std::fs::read_to_string(target.join("step_000001_pressure.svg")).unwrap();
        assert!(
            svg.contains("width=\"85.00mm\"") && svg.contains("<image"),
            "{}",
            &svg[..200]
        );
        assert!(!svg.contains("step 1"), "no title, no state");
        assert!(svg.contains("x, mm") && svg.contains("p, GPa"));
        let pdf = std::fs::read(target.join("step_000001_centre_line.pdf")).unwrap();
        assert!(pdf.starts_with(b"%PDF-1.7") && pdf.ends_with(b"%%EOF"));
        // The table of objects is where the end says, and each object where the table says; a font is one of them.
        let text = String::from_utf8_lossy(&pdf).into_owned();
        let start = text.rsplit("startxref\n").next().unwrap();
        let start: usize = start.lines().next().unwrap().parse().unwrap();
        assert!(pdf[start..].starts_with(b"xref"));
        let table = String::from_utf8_lossy(&pdf[start..]).into_owned();
        for (k, line) in table.lines().skip(3).take(5).enumerate() {
            let at: usize = line[..10].parse().unwrap();
            assert!(
                pdf[at..].starts_with(format!("{} 0 obj", k + 1).as_bytes()),
                "{line}"
            );
        }
        assert!(text.contains("/FontFile2") && text.contains("/ToUnicode"));
        let vti = std::fs::read(target.join("step_000001.vti")).unwrap();
        assert!(String::from_utf8_lossy(&vti).contains("Name=\"pressure_pa\""));
        assert!(target.join("step_000001_slice.vtr").exists());
        let gif = std::fs::read(target.join("pressure.gif")).unwrap();
        assert!(gif.starts_with(b"GIF89a") && gif.ends_with(b";"));
        let pictures = gif
            .windows(4)
            .filter(|four| *four == [0x21, 0xf9, 4, 5])
            .count();
        assert_eq!(pictures, back.len());
    }

    #[test]
    fn the_band_in_a_recording_is_that_of_the_report() {
        let folder = tempfile::tempdir().unwrap();
        let output = Command::new(env!("CARGO_BIN_EXE_asperity"))
            .args([
                "run",
                "--set=grid.nodes=65",
                "--passages=1",
                "--threads=1",
                "--out=run.rrd",
            ])
            .args(["--summary=run.json"])
            .current_dir(folder.path())
            .output()
            .unwrap();
        assert_eq!(
            output.status.code(),
            Some(0),
            "{}",
            String::from_utf8_lossy(&output.stderr)
        );
        let summary = std::fs::read_to_string(folder.path().join("run.json")).unwrap();
        let summary: serde_json::Value = serde_json::from_str(&summary).unwrap();
        let ends =
            ["life_relative_low", "life_relative_high"].map(|key| summary[key].as_f64().unwrap());
        let contents = Contents::read(&folder.path().join("run.rrd"));
        let band = contents.scalars("life/log10_relative/with_the_meshs_error");
        assert_eq!(band.len(), 2, "at the first and at the last step");
        for values in band.values() {
            for (value, end) in values.iter().zip(ends) {
                assert!((value - end.log10()).abs() < 1e-12, "{value} {end}");
            }
        }
        let last = RecordedFrames::read(&folder.path().join("run.rrd")).unwrap();
        let step = *last.shown().last().unwrap();
        assert!(!last.text(step).is_empty());
        let text = last.text(u64::try_from(i64::MAX).unwrap());
        assert!(text.contains("with what the mesh costs"), "{text}");
        // Pictures say the same of the last step.
        let (of, band) = last.last_band().unwrap();
        assert_eq!(Some(of), last.steps().last().map(|frame| frame.step));
        for (value, end) in band.iter().zip(ends) {
            assert!((value / end - 1.0).abs() < 1e-12, "{value} {end}");
        }
    }
}
