//! Every caution, planted in a scene and read where people read: what `check` says before, report, summary, recording and
//! screen (what the page speaks: `explorer/web/page.rs`).
#![cfg(all(feature = "tui", feature = "rerun"))]
#![expect(clippy::unwrap_used, reason = "tests")]

use std::path::Path;
use std::process::Command;

use super::truth::explorer_after;
use crate::common::tui_fixture::text;
use asperity_engine::plan::Plan;
use asperity_engine::scene::{Override, Scene};
use asperity_engine::sim::CautionCode;
use asperity_explorer::tui::action::Action;
use re_chunk::Chunk;
use re_log_encoding::DecoderApp;
use rerun::TextDocument;
use rerun::external::re_log_types::LogMsg;

/// Codes, each with a preset and the keys that plant it.
const PLANTED: [(&str, &str, &[&str]); 27] = [
    (
        "not_converged",
        QUICK,
        &["numerics.max_iterations=1", "numerics.tolerance=1e-7"],
    ),
    (
        "beyond_yield",
        QUICK,
        &["body_1.surface.amplitude_m=4e-6", "lubricant=none"],
    ),
    (
        "amplitude_doubtful",
        QUICK,
        &["body_1.surface.amplitude_m=5e-11"],
    ),
    ("map_doubtful", MAP, &[]),
    ("dry", QUICK, &["lubricant=none"]),
    (
        "film_below_molecule",
        QUICK,
        &["motion.entrainment_m_s=1e-5"],
    ),
    ("mesh_film", QUICK, &["motion.entrainment_m_s=0.02"]),
    ("short_domain", QUICK, &["grid.x_min_a=-1.3"]),
    ("long_step", QUICK, &["time.step_nodes=2"]),
    ("coarse_wave", QUICK, &[]),
    ("coarse_convected_wave", QUICK, &[]),
    ("coarse_counting", QUICK, &["motion.slide_roll=1.5"]),
    (
        "crests_at_edge",
        QUICK,
        &[
            "load.force_n=1",
            "grid.x_min_a=-2.5",
            "grid.x_max_a=1.5",
            "grid.y_half_a=2",
        ],
    ),
    ("shallow_stress", QUICK, &["stress.depth_max_a=1.2"]),
    ("map_not_seen", MAP, &[]),
    (
        "one_sample",
        QUICK,
        &[
            "body_1.surface.kind=random",
            "body_1.surface.rq_m=1e-7",
            "body_1.surface.correlation_x_m=2e-4",
            "body_1.surface.period_x_m=4e-3",
            "body_1.surface.period_y_m=4e-3",
        ],
    ),
    ("late_event", LATE, &[]),
    ("standing_body", QUICK, &["motion.slide_roll=2"]),
    (
        "crests_not_felt",
        QUICK,
        &["body_1.surface.amplitude_m=1e-10"],
    ),
    ("oil_law", QUICK, &[]),
    (
        "no_reference",
        QUICK,
        &["life.model=ioannides_harris", "life.limit_pa=1.2e9"],
    ),
    ("phase_locked", QUICK, &["motion.slide_roll=0"]),
    ("model_range", QUICK, &[]),
    ("not_settled", QUICK, &[]),
    ("no_life", QUICK, &["life=none"]),
    ("strength_unknown", QUICK, &["body_2.young_pa=7e10"]),
    (
        "thermal_unknown",
        QUICK,
        &["body_2.young_pa=7e10", "heat.bulk_k=353"],
    ),
];
const QUICK: &str = "demonstration_quick";
/// A scene with a tilted map.
const MAP: &str = "map.toml";
/// One with an event a second after its end.
const LATE: &str = "late.toml";

/// Small runs, shorter than a period.
const COMMON: [&str; 3] = ["grid.nodes=65", "stress.depths=8", "time.passages=0.125"];

/// Two millimetres of waves of .16 mm, tilted.
fn write_map(folder: &Path) {
    let height = |row: usize, column: usize| {
        let wave = |n: usize| (std::f64::consts::TAU * n as f64 / 16.0).sin();
        200.0 * wave(row) * wave(column) + 0.8 * column as f64
    };
    let row = |row| {
        let cells = (0..200).map(|column| format!("{:.2}", height(row, column)));
        cells.collect::<Vec<_>>().join(" ")
    };
    let map = (0..200).map(row).collect::<Vec<_>>().join("\n");
    std::fs::write(folder.join("map.txt"), map).unwrap();
    let quick = Scene::load_with(QUICK, &[]).unwrap();
    let mut scene = quick.to_toml();
    let surface = scene.find("[body_1.surface]").unwrap();
    let end = surface + 1 + scene[surface + 1..].find('[').unwrap();
    scene.replace_range(
        surface..end,
        "[body_1.surface]\nkind = \"height_map\"\nfile = \"map.txt\"\nunit_m = 1e-9\npixel_m = 1e-5\nlevel = \"mean\"\n\n",
    );
    std::fs::write(folder.join(MAP), scene).unwrap();
    let late = format!(
        "{}\n[[event]]\nat_s = 1.0\ncaption = \"late\"\n",
        quick.to_toml()
    );
    std::fs::write(folder.join(LATE), late).unwrap();
}

fn program(folder: &Path, of: &str, scene: &str, sets: &[&str], more: &[&str]) -> String {
    let mut command = Command::new(env!("CARGO_BIN_EXE_asperity"));
    command.current_dir(folder).args([of, scene]).args(more);
    for set in sets.iter().chain(&COMMON) {
        command.args(["--set", set]);
    }
    let output = command.output().unwrap();
    let told = String::from_utf8(output.stderr).unwrap();
    assert!(
        matches!(output.status.code(), Some(0 | 2)),
        "{sets:?}: {told}"
    );
    String::from_utf8(output.stdout).unwrap()
}

/// All texts of a recording.
fn texts(path: &Path) -> String {
    let reader = std::io::BufReader::new(std::fs::File::open(path).unwrap());
    let component = TextDocument::descriptor_text().component;
    let mut all = String::new();
    for message in DecoderApp::decode_eager(reader).unwrap() {
        let LogMsg::ArrowMsg(_, message) = message.unwrap() else {
            continue;
        };
        let chunk = Chunk::from_arrow_msg(&message).unwrap();
        for row in chunk.iter_slices::<String>(component) {
            all.extend(row.iter().map(|text| format!("{text}\n")));
        }
    }
    all
}

/// The explorer's list after the last frame of the same run.
fn screen(folder: &Path, scene: &str, sets: &[&str]) -> String {
    let sets = sets.iter().chain(&COMMON);
    let sets: Vec<Override> = sets.map(|text| text.parse().unwrap()).collect();
    let path = folder.join(scene).display().to_string();
    let name = if [MAP, LATE].contains(&scene) {
        &path
    } else {
        scene
    };
    let scene = Scene::load_with(name, &sets).unwrap();
    let mut app = explorer_after(scene, name);
    app.apply(Action::Plan);
    // As wide as the list, which then has nothing beside it.
    words(&text(&app, 100, 100))
}

/// The longest part of it without a number: what moves with the last steps is not recorded with each of them.
fn wording(said: &str) -> &str {
    let parts = said.split(|c: char| c.is_ascii_digit() || "µ²".contains(c));
    parts
        .max_by_key(|part| part.len())
        .unwrap_or_default()
        .trim()
}

/// Words without the frames and breaks between them.
fn words(text: &str) -> String {
    let kept = text.chars().filter(|c| !"│║┃|*".contains(*c));
    let kept: String = kept.collect();
    kept.split_whitespace().collect::<Vec<_>>().join(" ")
}

#[test]
fn a_planted_caution_is_read_in_every_place() {
    let home = tempfile::tempdir().unwrap();
    let folder = home.path();
    write_map(folder);
    let mut missing = Vec::new();
    for (code, scene, sets) in PLANTED {
        let outputs = [
            "--force",
            "--out",
            "r.rrd",
            "--summary",
            "s.json",
            "--threads=1",
        ];
        let report = words(&program(folder, "run", scene, sets, &outputs));
        let summary: serde_json::Value =
            serde_json::from_slice(&std::fs::read(folder.join("s.json")).unwrap()).unwrap();
        let cautions = summary["cautions"].as_array().unwrap();
        let said = cautions.iter().find(|one| one["code"] == code);
        let Some(said) = said.map(|one| words(one["text"].as_str().unwrap())) else {
            missing.push(format!("{code}: summary: {cautions:?}"));
            continue;
        };
        let recording = words(&texts(&folder.join("r.rrd")));
        let screen = screen(folder, scene, sets);
        for (place, text) in [
            ("report", report),
            ("recording", recording),
            ("screen", screen),
        ] {
            // An event that never comes is one of the run and of none of its steps.
            if !text.contains(wording(&said)) && (code != "late_event" || place == "report") {
                missing.push(format!("{code}: {place}: {said}"));
            }
        }
        // What is known before is said before.
        let sets: Vec<Override> = sets
            .iter()
            .chain(&COMMON)
            .map(|set| set.parse().unwrap())
            .collect();
        let path = folder.join(scene).display().to_string();
        let own = Scene::load_with(
            if [MAP, LATE].contains(&scene) {
                &path
            } else {
                scene
            },
            &sets,
        )
        .unwrap();
        let before: Vec<_> = Plan::new(&own).unwrap().warnings;
        for warning in &before {
            let code = serde_json::to_value(CautionCode::of(warning)).unwrap();
            if !cautions.iter().any(|one| one["code"] == code) {
                missing.push(format!(
                    "{scene} {sets:?}: check warns of {code}, the run does not"
                ));
            }
        }
    }
    assert!(missing.is_empty(), "{missing:#?}");
}
