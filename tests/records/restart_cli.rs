//! The program's own way from a saved state and from a recording: the rows of the table are those of the whole run, byte
//! for byte, in every preset.
#![expect(clippy::unwrap_used, reason = "tests")]

use std::path::Path;
use std::process::Command;

use asperity_engine::scene::{Record, presets};

use crate::workspace::small;

const ALL: [&str; 2] = ["--threads=1", "--force"];
/// What a companion finds is no row; and few depths, of which all are the same.
const ALONE: [&str; 2] = [
    "--set=numerics.error_estimate=none",
    "--set=stress.depths=8",
];
/// A coarse contact with waves that it resolves.
const SMALL: [&str; 4] = [
    "--set=grid.nodes=33",
    "--set=body_1.surface.wavelength_x_m=4e-4",
    "--set=body_2.surface.wavelength_x_m=4e-4",
    "--set=body_2.surface.wavelength_y_m=4e-4",
];

/// Exit code of a run; nothing but 0 and 2 is one.
fn run(folder: &Path, args: &[&str]) -> i32 {
    let mut command = Command::new(env!("CARGO_BIN_EXE_asperity"));
    command.current_dir(folder).arg("run").args(args).args(ALL);
    let output = command.output().unwrap();
    let code = output.status.code();
    let told = String::from_utf8_lossy(&output.stderr);
    assert!(matches!(code, Some(0 | 2)), "{args:?}: {code:?}: {told}");
    code.unwrap()
}

/// Lines of a table from the row after so many.
fn rows(folder: &Path, name: &str, after: usize) -> Vec<String> {
    let text = std::fs::read_to_string(folder.join(name)).unwrap();
    text.lines().skip(1 + after).map(str::to_owned).collect()
}

/// A run in one go, in two through a state, and once more from its recording: rows, and those that differ.
fn in_all_ways(scene: &[&str], passages: [&str; 2]) -> usize {
    let folder = tempfile::tempdir().unwrap();
    let place = folder.path();
    let with = |more: &[&str]| run(place, &[scene, &ALONE, more].concat());
    let [half, whole] = passages.map(|passages| format!("--passages={passages}"));
    with(&[&whole, "--table=whole.csv", "--out=run.rrd"]);
    with(&[
        &half,
        "--table=half.csv",
        "--no-record",
        "--save-state=half.state",
    ]);
    let resumed = [
        &*whole,
        "--table=rest.csv",
        "--no-record",
        "--from-state=half.state",
    ];
    with(&resumed);
    let done = rows(place, "half.csv", 0);
    assert_eq!(
        done,
        rows(place, "whole.csv", 0)[..done.len()],
        "{scene:?}: first half"
    );
    let rest = rows(place, "rest.csv", 0);
    assert!(!rest.is_empty());
    assert_eq!(
        rest,
        rows(place, "whole.csv", done.len()),
        "{scene:?}: second half"
    );
    if cfg!(feature = "rerun") {
        run(
            place,
            &["--from=run.rrd", "--no-record", "--table=again.csv"],
        );
        let (again, whole) = (rows(place, "again.csv", 0), rows(place, "whole.csv", 0));
        assert_eq!(again, whole, "{scene:?}: recording");
    }
    done.len() + rest.len()
}

#[test]
fn bodies_flows_and_steps_of_every_kind_go_on_and_repeat() {
    let cases: [&[&str]; 5] = [
        &[],
        &["--set=body_1.young_pa=7.5e10", "--set=body_1.poisson=0.22"],
        &["--set=lubricant=none"],
        &[
            "--set=time.tolerance=3e-2",
            "--set=lubricant.cavitation=jfo",
        ],
        &[
            "--set=life.cycles=peaks",
            "--set=life.spread=models",
            "--set=motion.slide_roll=-1",
        ],
    ];
    let mut count = 0;
    for case in cases {
        let scene = [&["demonstration_quick"], &SMALL[..], case].concat();
        count += in_all_ways(&scene, ["0.3", "0.6"]);
    }
    // Made surfaces, without the waves that so few nodes do not carry.
    let random = [
        "random_rollers",
        "--set=grid.nodes=65",
        "--set=body_1.surface.cutoff_short_m=2e-4",
        "--set=body_2.surface.cutoff_short_m=2e-4",
    ];
    count += in_all_ways(&random, ["0.05", "0.12"]);
    println!("{count} rows, 0 differ");
}

#[test]
fn every_preset_goes_on_and_repeats() {
    let mut count = 0;
    for preset in presets::all() {
        // A point and a line on all their grids; the others on the fewest nodes, which changes no branch that they take.
        count += match preset.name {
            "demonstration_quick" | "fzg_point_b" => in_all_ways(&[preset.name], ["0.05", "0.12"]),
            name => {
                let mut scene = small(name, &[]);
                scene.record = Some(Record::default());
                let folder = tempfile::tempdir().unwrap();
                let file = folder.path().join("scene.toml");
                std::fs::write(&file, scene.to_toml()).unwrap();
                in_all_ways(&[file.to_str().unwrap()], ["0.1", "0.25"])
            }
        };
    }
    println!("{} presets, {count} rows, 0 differ", presets::all().len());
}
