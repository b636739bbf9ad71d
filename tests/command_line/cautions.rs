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

/// Scenes, each with the keys that plant cautions in it, and their codes.
const PLANTED: [(&str, &[&str], &[&str]); 22] = [
    // Where every step of the start-up fails too it takes a hundred times as long: on few nodes.
    (
        QUICK,
        &[
            "numerics.max_iterations=1",
            "numerics.tolerance=1e-7",
            "grid.nodes=33",
            "body_1.surface.wavelength_x_m=4e-4",
            "body_2.surface.wavelength_x_m=4e-4",
            "body_2.surface.wavelength_y_m=4e-4",
        ],
        &["not_converged"],
    ),
    (
        QUICK,
        &["body_1.surface.amplitude_m=4e-6", "lubricant=none"],
        &["beyond_yield"],
    ),
    (
        QUICK,
        &["body_1.surface.amplitude_m=5e-11"],
        &["amplitude_doubtful"],
    ),
    (MAP, &[], &["map_doubtful", "map_not_seen"]),
    (QUICK, &["lubricant=none"], &["dry"]),
    (
        QUICK,
        &["motion.entrainment_m_s=1e-5"],
        &["film_below_molecule"],
    ),
    (QUICK, &["motion.entrainment_m_s=0.02"], &["mesh_film"]),
    (QUICK, &["grid.x_min_a=-1.3"], &["short_domain"]),
    (QUICK, &["time.step_nodes=2"], &["long_step"]),
    (
        QUICK,
        &[],
        &[
            "coarse_wave",
            "coarse_convected_wave",
            "oil_law",
            "model_range",
            "not_settled",
        ],
    ),
    (QUICK, &["motion.slide_roll=1.5"], &["coarse_counting"]),
    (
        QUICK,
        &[
            "load.force_n=1",
            "grid.x_min_a=-2.5",
            "grid.x_max_a=1.5",
            "grid.y_half_a=2",
        ],
        &["crests_at_edge"],
    ),
    (QUICK, &["stress.depth_max_a=1.2"], &["shallow_stress"]),
    (
        QUICK,
        &[
            "body_1.surface.kind=random",
            "body_1.surface.rq_m=1e-7",
            "body_1.surface.correlation_x_m=2e-4",
            "body_1.surface.period_x_m=4e-3",
            "body_1.surface.period_y_m=4e-3",
        ],
        &["one_sample"],
    ),
    (LATE, &[], &["late_event"]),
    (QUICK, &["motion.slide_roll=2"], &["standing_body"]),
    (
        QUICK,
        &["body_1.surface.amplitude_m=1e-10"],
        &["crests_not_felt"],
    ),
    (
        QUICK,
        &["life.model=ioannides_harris", "life.limit_pa=1.2e9"],
        &["no_reference"],
    ),
    (QUICK, &["motion.slide_roll=0"], &["phase_locked"]),
    (QUICK, &["life=none"], &["no_life"]),
    (QUICK, &["body_2.young_pa=7e10"], &["strength_unknown"]),
    (
        QUICK,
        &["body_2.young_pa=7e10", "heat.bulk_k=353"],
        &["thermal_unknown"],
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
    for set in COMMON.iter().chain(sets) {
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

/// A scene with these keys, and its name.
fn loaded(folder: &Path, scene: &str, sets: &[&str]) -> (Scene, String) {
    let sets = COMMON.iter().chain(sets);
    let sets: Vec<Override> = sets.map(|text| text.parse().unwrap()).collect();
    let name = if [MAP, LATE].contains(&scene) {
        folder.join(scene).display().to_string()
    } else {
        scene.to_owned()
    };
    (Scene::load_with(&name, &sets).unwrap(), name)
}

/// The explorer's list after the last frame of the same run.
fn screen(folder: &Path, scene: &str, sets: &[&str]) -> String {
    let (scene, name) = loaded(folder, scene, sets);
    let mut app = explorer_after(scene, &name);
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

/// Where these cautions of a run are not read, and what is said before it and not by it.
fn not_read(folder: &Path, scene: &str, sets: &[&str], codes: &[&str]) -> Vec<String> {
    let mut missing = Vec::new();
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
    let recording = words(&texts(&folder.join("r.rrd")));
    let screen = screen(folder, scene, sets);
    for &code in codes {
        let said = cautions.iter().find(|one| one["code"] == code);
        let Some(said) = said.map(|one| words(one["text"].as_str().unwrap())) else {
            missing.push(format!("{code}: summary: {cautions:?}"));
            continue;
        };
        for (place, text) in [
            ("report", &report),
            ("recording", &recording),
            ("screen", &screen),
        ] {
            // An event that never comes is one of the run and of none of its steps.
            if !text.contains(wording(&said)) && (code != "late_event" || place == "report") {
                missing.push(format!("{code}: {place}: {said}"));
            }
        }
    }
    // What is known before is said before.
    let own = loaded(folder, scene, sets).0;
    for warning in &Plan::new(&own).unwrap().warnings {
        let code = serde_json::to_value(CautionCode::of(warning)).unwrap();
        if !cautions.iter().any(|one| one["code"] == code) {
            missing.push(format!(
                "{scene} {sets:?}: check warns of {code}, the run does not"
            ));
        }
    }
    missing
}

#[test]
fn a_planted_caution_is_read_in_every_place() {
    let home = tempfile::tempdir().unwrap();
    let folder = home.path();
    write_map(folder);
    let mut missing = Vec::new();
    for (scene, sets, codes) in PLANTED {
        missing.extend(not_read(folder, scene, sets, codes));
    }
    assert!(missing.is_empty(), "{missing:#?}");
}
