//! The binary: exit codes, messages that name key, value and range, files that are written or refused.
#![expect(clippy::unwrap_used, reason = "tests")]

use std::path::Path;
use std::process::{Command, Output, Stdio};

/// A small scene that still has everything: coarse grid, long waves, half a passage.
const SMALL: [&str; 8] = [
    "--set=grid.nodes=33",
    "--set=body_1.surface.wavelength_x_m=4e-4",
    "--set=body_2.surface.wavelength_x_m=4e-4",
    "--set=body_2.surface.wavelength_y_m=4e-4",
    "--set=body_1.surface.amplitude_m=1e-7",
    "--set=body_2.surface.amplitude_m=1e-7",
    "--threads=1",
    "--passages=0.5",
];

fn asperity(folder: &Path, args: &[&str]) -> Output {
    Command::new(env!("CARGO_BIN_EXE_asperity"))
        .args(args)
        .current_dir(folder)
        .stdin(Stdio::null())
        .output()
        .unwrap()
}

fn small(folder: &Path, more: &[&str]) -> Output {
    let args: Vec<&str> = ["run"]
        .into_iter()
        .chain(SMALL)
        .chain(more.iter().copied())
        .collect();
    asperity(folder, &args)
}

fn text(bytes: &[u8]) -> String {
    String::from_utf8(bytes.to_vec()).unwrap()
}

/// The command fails with that code and says all of the words on stderr.
fn refused(output: &Output, code: i32, words: &[&str]) {
    let stderr = text(&output.stderr);
    assert_eq!(output.status.code(), Some(code), "{stderr}");
    for word in words {
        assert!(stderr.contains(word), "{word:?} is missing in {stderr}");
    }
    assert!(!stderr.contains("panicked"), "{stderr}");
}

#[test]
fn bad_input_is_refused_with_key_value_and_range() {
    let folder = tempfile::tempdir().unwrap();
    let cases: [(&str, &[&str]); 10] = [
        (
            "motion.slide_rol=0.5",
            &[
                "motion.slide_rol is not a key",
                "did you mean motion.slide_roll?",
            ],
        ),
        (
            "contact.rx_m=-0.019",
            &["contact.rx_m = -0.019", "1e-6 to 100 m"],
        ),
        (
            "motion.slide_roll=NaN",
            &["motion.slide_roll = \"NaN\"", "-2 to 2"],
        ),
        (
            "load.hertz_pressure_pa=1e11",
            &["load.hertz_pressure_pa = 1e11", "1e6 to 1e10 Pa"],
        ),
        (
            "body_1.surface.wavelength_x_m=2e-5",
            &[
                "body_1.surface.wavelength_x_m = 2e-5 m",
                "at least 2.939e-5 m (4 nodes",
            ],
        ),
        (
            "body_2.surface.wavelength_y_m=2e-5",
            &["body_2.surface.wavelength_y_m = 2e-5 m", "4 nodes"],
        ),
        (
            "motion.entrainment_m_s=0",
            &["motion.entrainment_m_s = 0", "1e-6 to 200 m/s"],
        ),
        (
            "contact.rx_m=19 mm",
            &["contact.rx_m = \"19 mm\"", "a number, without a unit, in m"],
        ),
        (
            "contact.kind=disc",
            &["contact.kind = \"disc\"", "\"point\" or \"line\""],
        ),
        (
            "motion.slide_roll",
            &["--set motion.slide_roll", "KEY=VALUE"],
        ),
    ];
    for (setting, words) in cases {
        for command in ["check", "run"] {
            let output = asperity(folder.path(), &[command, "--set", setting]);
            refused(&output, 1, words);
            assert!(output.stdout.is_empty(), "{setting}");
        }
    }
    let left = std::fs::read_dir(folder.path()).unwrap().count();
    assert_eq!(left, 0, "refused runs leave no files");
}

#[test]
fn bad_files_and_options_are_refused() {
    let folder = tempfile::tempdir().unwrap();
    refused(
        &asperity(folder.path(), &["run", "no/such.toml"]),
        1,
        &["no/such.toml"],
    );
    refused(
        &asperity(folder.path(), &["check", "demonstratoin"]),
        1,
        &[
            "neither a preset nor a scene file",
            "did you mean demonstration?",
        ],
    );
    std::fs::write(folder.path().join("broken.toml"), "[contact\nkind = 1").unwrap();
    refused(
        &asperity(folder.path(), &["check", "broken.toml"]),
        1,
        &["broken.toml is not valid TOML", "line 1"],
    );
    refused(
        &asperity(folder.path(), &["run", "--bogus"]),
        1,
        &["--bogus"],
    );
    refused(
        &asperity(folder.path(), &["run", "--threads", "0"]),
        1,
        &["--threads"],
    );
    refused(
        &asperity(folder.path(), &["run", "--passages", "nan"]),
        1,
        &["time.passages", "0.01 to 10000"],
    );
    refused(
        &asperity(folder.path(), &["view", "nothing.rrd"]),
        1,
        &["nothing.rrd"],
    );
}

#[test]
fn options_that_a_study_does_not_read_are_refused() {
    let folder = tempfile::tempdir().unwrap();
    let cases: [(&[&str], &[&str]); 4] = [
        (
            &["scaling", "--threads=1"],
            &["--threads", "one thread with two"],
        ),
        (
            &["accuracy", "--only=nothing"],
            &["--only nothing", "no case"],
        ),
        (
            &["scaling", "--only=nothing"],
            &["--only nothing", "no case"],
        ),
        (
            &["stability", "--only=nothing"],
            &["--only nothing", "no case"],
        ),
    ];
    for (args, words) in cases {
        let all: Vec<&str> = ["study"].into_iter().chain(args.iter().copied()).collect();
        refused(&asperity(folder.path(), &all), 1, words);
    }
}

#[test]
fn unwritable_outputs_are_refused_before_the_run() {
    let folder = tempfile::tempdir().unwrap();
    let kept = folder.path().join("kept.csv");
    std::fs::write(&kept, "mine").unwrap();
    refused(
        &small(folder.path(), &["--no-record", "--table", "kept.csv"]),
        4,
        &["kept.csv", "exists", "--force"],
    );
    assert_eq!(std::fs::read_to_string(&kept).unwrap(), "mine");
    refused(
        &small(
            folder.path(),
            &["--no-record", "--table", "no/such/folder.csv"],
        ),
        4,
        &["no/such/folder.csv", "folder does not exist"],
    );
    refused(
        &small(
            folder.path(),
            &["--no-record", "--summary", "no/such/folder.json"],
        ),
        4,
        &["no/such/folder.json"],
    );
}

#[test]
fn a_run_writes_its_table_and_a_summary_with_the_promised_keys() {
    let folder = tempfile::tempdir().unwrap();
    let output = small(
        folder.path(),
        &["--no-record", "--table", "table.csv", "--summary", "-"],
    );
    assert_eq!(output.status.code(), Some(0), "{}", text(&output.stderr));
    let summary: serde_json::Value = serde_json::from_slice(&output.stdout).unwrap();
    for key in [
        "scene",
        "converged",
        "steps",
        "steps_not_converged",
        "wall_s",
        "a_m",
        "p_hertz_pa",
        "h_central_m",
        "h_min_m",
        "p_max_pa",
        "contact_ratio",
        "load_n",
        "load_error",
        "mass_error",
        "friction_coefficient",
        "n_body_1",
        "n_body_2",
        "n_counted_body_1",
        "n_counted_body_2",
        "i_ref",
        "i_mean",
        "cycle_factor",
        "stress_factor",
        "peak_factor",
        "traction_factor",
        "life_relative",
        "life_relative_low",
        "life_relative_high",
        "sigma_eff_max_pa",
        "sigma_eff_max_depth_m",
        "sigma_eff_max_x_m",
        "counters",
    ] {
        assert!(summary.get(key).is_some(), "{key} is missing");
    }
    assert_eq!(summary["scene"], "demonstration");
    assert_eq!(summary["converged"], true);
    let steps = summary["steps"].as_u64().unwrap();
    assert_eq!(steps, 16);
    let table = std::fs::read_to_string(folder.path().join("table.csv")).unwrap();
    assert_eq!(table.lines().count() as u64, steps + 1);
    // The same again needs --force, and with it gives the same table.
    let again = small(
        folder.path(),
        &[
            "--no-record",
            "--table",
            "table.csv",
            "--summary",
            "s.json",
            "--force",
        ],
    );
    assert_eq!(again.status.code(), Some(0), "{}", text(&again.stderr));
    assert!(
        text(&again.stdout).contains("converged; 16 steps"),
        "{}",
        text(&again.stdout)
    );
    assert_eq!(
        std::fs::read_to_string(folder.path().join("table.csv")).unwrap(),
        table
    );
    let json = std::fs::read(folder.path().join("s.json")).unwrap();
    let written: serde_json::Value = serde_json::from_slice(&json).unwrap();
    assert_eq!(written["counters"], summary["counters"]);
}

#[test]
fn check_says_what_is_left_out_and_why() {
    let folder = tempfile::tempdir().unwrap();
    let plan = |more: &[&str]| {
        let output = asperity(folder.path(), &[&["check"], more].concat());
        assert_eq!(output.status.code(), Some(0), "{}", text(&output.stderr));
        text(&output.stdout)
    };
    let full = plan(&[]);
    for part in [
        "257 x 257 nodes",
        "512 steps",
        "rows y < 0",
        "same elastic constants",
        "isothermal",
    ] {
        assert!(full.contains(part), "{part:?} is missing in {full}");
    }
    let dry = plan(&[
        "--set",
        "lubricant=none",
        "--set",
        "life=none",
        "--set",
        "stress=none",
    ]);
    for part in ["dry contact", "no [stress]", "no [life]"] {
        assert!(dry.contains(part), "{part:?} is missing in {dry}");
    }
}

/// No measured spacing of crests was found for any part, so whoever looks at a preset is told that it is assumed; the
/// demonstration's is that of a published case.
#[test]
fn check_tells_that_the_spacing_of_crests_is_assumed() {
    let folder = tempfile::tempdir().unwrap();
    for preset in asperity_engine::scene::presets::all() {
        let output = asperity(folder.path(), &["check", preset.name]);
        let told = text(&output.stdout);
        let told = told.split_whitespace().collect::<Vec<_>>().join(" ");
        let says = told.split("The scene says ").nth(1).unwrap_or_default();
        let assumed = says.split("The crest spacing ").nth(1).is_some_and(|rest| {
            rest.split_once("assumed")
                .is_some_and(|(words, _)| words.len() < 20)
        });
        let published = preset.name.starts_with("demonstration")
            && says.contains("Pu, Zhu, Wang & Wang (2016)");
        assert!(assumed || published, "{}: {says}", preset.name);
    }
}

#[test]
fn scenes_lists_and_prints_what_can_be_read_back() {
    let folder = tempfile::tempdir().unwrap();
    let list = text(&asperity(folder.path(), &["scenes"]).stdout);
    for preset in asperity_engine::scene::presets::all() {
        assert!(list.contains(preset.name));
        let printed = asperity(folder.path(), &["scenes", preset.name]);
        std::fs::write(folder.path().join("copy.toml"), &printed.stdout).unwrap();
        let plan = |scene: &str| asperity(folder.path(), &["check", scene]).stdout;
        assert_eq!(plan("copy.toml"), plan(preset.name), "{}", preset.name);
    }
    refused(
        &asperity(folder.path(), &["scenes", "nonesuch"]),
        1,
        &["nonesuch", "presets: demonstration"],
    );
}

#[test]
fn help_teaches() {
    let folder = tempfile::tempdir().unwrap();
    let output = asperity(folder.path(), &["--help"]);
    assert_eq!(output.status.code(), Some(0));
    let help = text(&output.stdout);
    for part in [
        "S = (U2 - U1)/U",
        "Examples:",
        "Exit codes:",
        "asperity view",
    ] {
        assert!(help.contains(part), "{part:?} is missing in {help}");
    }
    assert_eq!(
        asperity(folder.path(), &["--version"]).status.code(),
        Some(0)
    );
}

#[cfg(unix)]
#[test]
fn an_interrupt_ends_cleanly_with_what_was_made() {
    use std::io::Read as _;
    let folder = tempfile::tempdir().unwrap();
    let mut child = Command::new(env!("CARGO_BIN_EXE_asperity"))
        .args(["run"])
        .args(&SMALL[..SMALL.len() - 1])
        .args(["--passages=10000", "--no-record", "--table=table.csv"])
        .current_dir(folder.path())
        .stdout(Stdio::piped())
        .stderr(Stdio::piped())
        .spawn()
        .unwrap();
    // Wait for rows, so that the signal finds a run and not a start.
    let table = folder.path().join("table.csv");
    while std::fs::read_to_string(&table).map_or(0, |text| text.lines().count()) < 3 {
        assert!(
            child.try_wait().unwrap().is_none(),
            "the run ended by itself"
        );
        std::thread::sleep(std::time::Duration::from_millis(20));
    }
    let killed = Command::new("kill")
        .args(["-INT", &child.id().to_string()])
        .status()
        .unwrap();
    assert!(killed.success());
    let (mut stdout, mut stderr) = (String::new(), String::new());
    child
        .stdout
        .take()
        .unwrap()
        .read_to_string(&mut stdout)
        .unwrap();
    child
        .stderr
        .take()
        .unwrap()
        .read_to_string(&mut stderr)
        .unwrap();
    assert_eq!(child.wait().unwrap().code(), Some(5), "{stderr}");
    assert!(stdout.contains("stopped by the user"), "{stdout}");
    assert!(stderr.contains("stopped by the user"), "{stderr}");
    let text = std::fs::read_to_string(&table).unwrap();
    let columns = text.lines().next().unwrap().split(',').count();
    assert!(text.lines().all(|line| line.split(',').count() == columns));
}

#[test]
fn a_tolerance_that_takes_more_steps_than_fixed_ones_is_said() {
    let folder = tempfile::tempdir().unwrap();
    for (set, is_said) in [
        ("--set=time.tolerance=1e-2", true),
        ("--set=time.step_nodes=0.5", false),
    ] {
        let output = small(folder.path(), &[set, "--no-record"]);
        let told = text(&output.stdout);
        let found = told.contains("took more steps than the");
        assert_eq!(found, is_said, "{told}");
    }
}
