//! Files of runs under attack: nothing that was there is lost, nothing half-written passes for whole, a stopped run
//! says so. By the binary alone.
#![cfg(unix)]
#![expect(clippy::unwrap_used, reason = "tests")]

use std::io::Read as _;
use std::net::{Ipv4Addr, TcpListener};
use std::path::{Path, PathBuf};
use std::process::{Child, Command, Output, Stdio};
use std::time::{Duration, Instant};

/// A small scene that still has everything: coarse grid, long waves, half a passage.
const SMALL: [&str; 8] = [
    "--set=grid.nodes=33",
    "--set=body_1.surface.wavelength_x_m=4e-4",
    "--set=body_2.surface.wavelength_x_m=4e-4",
    "--set=body_2.surface.wavelength_y_m=4e-4",
    "--set=body_1.surface.amplitude_m=1e-7",
    "--set=body_2.surface.amplitude_m=1e-7",
    "--set=stress.depths=8",
    "--threads=1",
];

fn command(folder: &Path, args: &[&str]) -> Command {
    let mut command = Command::new(env!("CARGO_BIN_EXE_asperity"));
    command.args(args).current_dir(folder).stdin(Stdio::null());
    command
}

fn asperity(folder: &Path, args: &[&str]) -> Output {
    command(folder, args).output().unwrap()
}

fn small<'a>(passages: &'a str, more: &[&'a str]) -> Vec<&'a str> {
    let own = ["run", "--passages", passages];
    let own = own.into_iter().chain(SMALL);
    own.chain(more.iter().copied()).collect()
}

/// Half a passage of the small scene.
fn short(folder: &Path, more: &[&str]) -> Output {
    asperity(folder, &small("0.5", more))
}

/// A run of the small scene that ends when it is told to.
fn endless(folder: &Path, more: &[&str]) -> Child {
    let mut command = command(folder, &small("10000", more));
    command.stdout(Stdio::piped()).stderr(Stdio::piped());
    command.spawn().unwrap()
}

fn text(bytes: &[u8]) -> String {
    String::from_utf8_lossy(bytes).into_owned()
}

fn assert_code(output: &Output, code: i32) {
    let (out, err) = (text(&output.stdout), text(&output.stderr));
    assert_eq!(output.status.code(), Some(code), "{out}\n{err}");
    assert!(!err.contains("panicked"), "{err}");
}

/// The command fails with that code and says the words on stderr.
fn refused(output: &Output, code: i32, words: &[&str]) {
    assert_code(output, code);
    let stderr = text(&output.stderr);
    for word in words {
        assert!(stderr.contains(word), "{word:?} is missing in {stderr}");
    }
}

fn names(folder: &Path) -> Vec<String> {
    let entries = std::fs::read_dir(folder).unwrap();
    let name = |entry: std::io::Result<std::fs::DirEntry>| entry.unwrap().file_name();
    let mut names: Vec<String> = entries
        .map(|entry| name(entry).into_string().unwrap())
        .collect();
    names.sort();
    names
}

fn wait_until(what: &str, mut is_so: impl FnMut() -> bool) {
    let began = Instant::now();
    while !is_so() {
        assert!(began.elapsed() < Duration::from_mins(2), "{what}");
        std::thread::sleep(Duration::from_millis(10));
    }
}

fn rows(path: &Path) -> usize {
    std::fs::read_to_string(path).map_or(0, |text| text.lines().count())
}

fn signal(child: &Child, name: &str) {
    let args = [name.to_owned(), child.id().to_string()];
    assert!(Command::new("kill").args(args).status().unwrap().success());
}

/// Exit code, stdout and stderr of a run that ends.
fn ended(mut child: Child) -> (Option<i32>, String, String) {
    let (mut out, mut err) = (String::new(), String::new());
    child
        .stdout
        .take()
        .unwrap()
        .read_to_string(&mut out)
        .unwrap();
    child
        .stderr
        .take()
        .unwrap()
        .read_to_string(&mut err)
        .unwrap();
    (child.wait().unwrap().code(), out, err)
}

const MINE: [&str; 4] = ["run.rrd", "run.csv", "run.json", "run.state"];
const OVER_MINE: [&str; 5] = [
    "--force",
    "--out=run.rrd",
    "--table=run.csv",
    "--summary=run.json",
    "--save-state=run.state",
];

/// Four files with somebody's work.
fn put_mine(folder: &Path) {
    for name in MINE {
        std::fs::write(folder.join(name), format!("mine: {name}")).unwrap();
    }
}

fn assert_mine(folder: &Path) {
    for name in MINE {
        let found = std::fs::read_to_string(folder.join(name)).unwrap();
        assert_eq!(found, format!("mine: {name}"));
    }
}

#[test]
fn what_is_wrong_with_an_input_costs_no_output() {
    let folder = tempfile::tempdir().unwrap();
    put_mine(folder.path());
    std::fs::write(folder.path().join("bad.state"), "asperity state").unwrap();
    for wrong in [
        "--from-state=nowhere.state",
        "--from-state=bad.state",
        "--set=motion.slide_roll=7",
    ] {
        let more: Vec<&str> = OVER_MINE.into_iter().chain([wrong]).collect();
        assert_code(&short(folder.path(), &more), 1);
        assert_mine(folder.path());
    }
    // An output that cannot be made costs none of the others, and nobody listens at port 9.
    for wrong in ["--export=run.csv/fields", "--connect=127.0.0.1:9"] {
        let more: Vec<&str> = OVER_MINE.into_iter().chain([wrong]).collect();
        assert_code(&short(folder.path(), &more), 4);
        assert_mine(folder.path());
    }
    assert_eq!(names(folder.path()).len(), 5, "{:?}", names(folder.path()));
}

#[test]
fn a_run_that_fails_leaves_no_stub_that_blocks_the_next() {
    let folder = tempfile::tempdir().unwrap();
    let place = folder.path();
    let outputs = &OVER_MINE[1..];
    let with = |more: &[&'static str]| {
        outputs
            .iter()
            .copied()
            .chain(more.iter().copied())
            .collect::<Vec<_>>()
    };
    assert_code(&short(place, &with(&["--connect=127.0.0.1:9"])), 4);
    assert_code(&short(place, &with(&["--from-state=nowhere"])), 1);
    assert_code(
        &short(place, &with(&["--export=fields", "--connect=127.0.0.1:9"])),
        4,
    );
    assert_eq!(names(place), [""; 0]);
    assert_code(&short(place, &with(&[])), 0);
    let mut all = MINE.map(str::to_owned);
    all.sort();
    assert_eq!(names(place), all);
    // One that is there is refused, and none of the others is touched.
    std::fs::remove_file(place.join("run.rrd")).unwrap();
    refused(&short(place, &with(&[])), 4, &["exists", "--force"]);
    assert!(!place.join("run.rrd").exists());
}

#[test]
fn an_output_is_no_input_and_no_other_output() {
    let folder = tempfile::tempdir().unwrap();
    let place = folder.path();
    std::fs::create_dir(place.join("sub")).unwrap();
    std::os::unix::fs::symlink("one.csv", place.join("link.csv")).unwrap();
    std::fs::write(place.join("one.csv"), "mine").unwrap();
    let scene = asperity(place, &["scenes", "demonstration"]).stdout;
    std::fs::write(place.join("mine.toml"), &scene).unwrap();
    assert_code(&short(place, &["--no-record", "--save-state=a.state"]), 0);
    let before = std::fs::read(place.join("a.state")).unwrap();
    let cases: [&[&str]; 7] = [
        &["--out=x", "--table=./x"],
        &["--table=one.csv", "--summary=sub/../one.csv"],
        &["--table=link.csv", "--summary=one.csv"],
        &["--from-state=a.state", "--save-state=./a.state"],
        &["--from-state=a.state", "--table=a.state"],
        &["--summary=f/scene.toml", "--export=f"],
        &["--export=.", "--table=step_000016.npz"],
    ];
    for case in cases {
        let more: Vec<&str> = ["--force"]
            .into_iter()
            .chain(case.iter().copied())
            .collect();
        refused(&short(place, &more), 1, &[" is ", "a name of its own"]);
    }
    let over_scene = [
        "run",
        "mine.toml",
        "--no-record",
        "--force",
        "--table=mine.toml",
    ];
    refused(&asperity(place, &over_scene), 1, &["--table", "the scene"]);
    assert_eq!(std::fs::read(place.join("mine.toml")).unwrap(), scene);
    assert_eq!(std::fs::read(place.join("a.state")).unwrap(), before);
    assert_eq!(
        std::fs::read_to_string(place.join("one.csv")).unwrap(),
        "mine"
    );
    // What a link leads to is replaced, not the link.
    assert_code(
        &short(place, &["--no-record", "--force", "--table=link.csv"]),
        0,
    );
    assert!(place.join("link.csv").is_symlink());
    assert!(rows(&place.join("one.csv")) > 1);
}

#[test]
fn a_killed_run_leaves_what_it_was_to_replace_and_what_it_had_made() {
    let folder = tempfile::tempdir().unwrap();
    let place = folder.path();
    put_mine(place);
    let mut child = endless(place, &OVER_MINE);
    let part = |ending: &str| -> Option<PathBuf> {
        let found = names(place);
        let name = found
            .iter()
            .find(|name| name.starts_with("run.part-") && name.ends_with(ending))?;
        Some(place.join(name))
    };
    wait_until("rows beside", || {
        assert!(child.try_wait().unwrap().is_none());
        part(".csv").is_some_and(|path| rows(&path) > 20)
    });
    assert_mine(place);
    // Another run on the same names is refused while this one is at it, and spoils nothing.
    refused(
        &short(place, &["--force", "--out=run.rrd"]),
        4,
        &["run.rrd", "another run"],
    );
    wait_until("steps in the recording", || {
        part(".rrd").is_some_and(|path| {
            asperity_recorder::Recorded::read(&path).is_ok_and(|run| run.last_step > 0)
        })
    });
    child.kill().unwrap();
    child.wait().unwrap();
    assert_mine(place);
    let kept = part(".rrd").unwrap();
    let name = kept.file_name().unwrap().to_str().unwrap();
    let again = asperity(place, &["run", "--from", name, "--no-record"]);
    // What there is of it is repeated, and is not all.
    refused(&again, 5, &["breaks off after step"]);
    // The lock went with the process; now all are replaced, whole, and nothing lies beside.
    for path in [kept, part(".csv").unwrap()] {
        std::fs::remove_file(path).unwrap();
    }
    assert_code(&short(place, &OVER_MINE), 0);
    let mut all = MINE.map(str::to_owned);
    all.sort();
    assert_eq!(names(place), all);
    assert_code(&short(place, &["--from-state=run.state", "--no-record"]), 0);
    let again = asperity(place, &["run", "--from=run.rrd", "--no-record"]);
    assert_code(&again, 0);
}

/// How many of two that are started together win; whoever loses is told what to do.
fn winners(place: &Path, args: &[&str], told: &str) -> usize {
    let start = |_| {
        let mut command = command(place, args);
        command.stdout(Stdio::null()).stderr(Stdio::piped());
        command.spawn().unwrap()
    };
    let both: Vec<Child> = (0..2).map(start).collect();
    let ends = both.into_iter().map(|child| {
        let output = child.wait_with_output().unwrap();
        let won = matches!(output.status.code(), Some(0 | 2));
        if !won {
            refused(&output, 4, &[told]);
        }
        usize::from(won)
    });
    ends.sum()
}

#[test]
fn of_two_runs_started_together_on_one_name_one_wins() {
    const SWEEP: &str = include_str!("../cluster/tiny.toml");
    // Each starter in a process of its own takes a second; names alone are asked for a hundred times in the engine.
    let rounds = std::env::var("ASPERITY_ROUNDS").map_or(3, |rounds| rounds.parse().unwrap());
    for round in 0..rounds {
        let folder = tempfile::tempdir().unwrap();
        let place = folder.path();
        for (names, out) in [
            (&["--out=run.rrd"][..], "run.rrd"),
            (&["--no-record", "--table=run.csv"], "run.csv"),
            (&["--no-record", "--save-state=run.state"], "run.state"),
            (&["--no-record", "--summary=run.json"], "run.json"),
            (
                &["--no-record", "--export=fields", "--export-every=1"],
                "fields",
            ),
        ] {
            let won = winners(place, &small("0.1", names), "choose another");
            assert_eq!(won, 1, "{out}, round {round}");
            assert!(place.join(out).exists(), "{out}, round {round}");
        }
        std::fs::write(place.join("tiny.toml"), SWEEP.replace("n = 16", "n = 2")).unwrap();
        let sweep = ["sweep", "tiny.toml", "--threads=1", "--out=own"];
        assert_eq!(winners(place, &sweep, "sweep"), 1, "sweep, round {round}");
        let beside = names(place);
        let left: Vec<_> = beside.iter().filter(|name| name.contains("part")).collect();
        assert!(left.is_empty(), "{left:?}");
    }
}

/// Before its first step a run has nothing that is worth a name: a kill leaves the names free.
#[test]
fn a_run_that_is_killed_in_its_start_up_blocks_nobody() {
    let folder = tempfile::tempdir().unwrap();
    let place = folder.path();
    let outputs = ["--out=run.rrd", "--table=run.csv", "--export=fields"];
    let long = ["run", "--set=grid.nodes=257", "--threads=1"];
    let mut child = command(place, &[&long[..], &outputs].concat())
        .stdout(Stdio::null())
        .stderr(Stdio::null())
        .spawn()
        .unwrap();
    wait_until("files beside", || names(place).len() == 3);
    // While it goes on its names are its own, whatever is forced.
    for other in ["--out=run.rrd", "--table=run.csv", "--export=fields"] {
        let more = ["--no-record", "--force", other];
        let more = &more[usize::from(other.starts_with("--out"))..];
        refused(&short(place, more), 4, &["another run"]);
    }
    assert!(child.try_wait().unwrap().is_none(), "too short a start-up");
    child.kill().unwrap();
    child.wait().unwrap();
    assert!(
        names(place)
            .iter()
            .all(|name| name != "run.rrd" && name != "run.csv")
    );
    assert_code(&short(place, &outputs), 0);
    assert!(place.join("run.rrd").exists() && rows(&place.join("run.csv")) > 1);
}

#[test]
fn a_stopped_run_says_so() {
    let folder = tempfile::tempdir().unwrap();
    let place = folder.path();
    for name in ["-TERM", "-HUP", "-INT"] {
        let table = place.join(format!("{name}.csv"));
        let to_table = format!("--table={}", table.display());
        let child = endless(place, &["--no-record", "--summary=-", &to_table]);
        wait_until("rows", || rows(&table) > 3);
        signal(&child, name);
        let (code, out, err) = ended(child);
        assert_eq!(code, Some(5), "{name}: {err}");
        let summary: serde_json::Value = serde_json::from_str(&out).unwrap();
        assert_eq!(summary["stopped"], true);
        let (done, planned) = (summary["steps"].as_u64(), summary["steps_planned"].as_u64());
        assert!(
            done.unwrap() < planned.unwrap() && planned > Some(100_000),
            "{summary}"
        );
        let said = format!("stopped by the user after {} of", done.unwrap());
        assert!(err.contains(&said), "{err}");
        assert_eq!(rows(&table) as u64, done.unwrap() + 1);
    }
    let whole = short(place, &["--no-record", "--summary=-"]);
    assert_code(&whole, 0);
    let summary: serde_json::Value = serde_json::from_slice(&whole.stdout).unwrap();
    assert_eq!(summary["stopped"], false);
    assert_eq!(summary["steps"], summary["steps_planned"]);
}

#[test]
fn what_cannot_be_told_is_an_output_that_failed() {
    let full = || std::fs::File::options().write(true).open("/dev/full");
    if full().is_err() {
        return;
    }
    let folder = tempfile::tempdir().unwrap();
    let summary = small("0.5", &["--no-record", "--summary=-"]);
    let cases: [&[&str]; 5] = [
        &summary,
        &["scenes"],
        &["check"],
        &["--help"],
        &["sweep", "slide_roll", "--show=file"],
    ];
    for args in cases {
        let mut command = command(folder.path(), args);
        let output = command.stdout(full().unwrap()).output().unwrap();
        refused(&output, 4, &["stdout", "No space left"]);
    }
}

#[test]
fn an_export_takes_away_its_own_steps_only() {
    let folder = tempfile::tempdir().unwrap();
    let fields = folder.path().join("fields");
    let export = [
        "--no-record",
        "--export=fields",
        "--export-as=npz,png",
        "--export-every=8",
    ];
    assert_code(&short(folder.path(), &export), 0);
    let first = names(&fields);
    assert!(first.contains(&"step_000008.npz".to_owned()), "{first:?}");
    for name in [
        "step_000999.npz",
        "step_000999_pressure.png",
        "step_1.npz",
        "step_000999_mine.png",
        "notes",
    ] {
        std::fs::write(fields.join(name), "old").unwrap();
    }
    // A run that makes no step takes nothing away.
    let broken = [&export[..], &["--force", "--from-state=nowhere"]].concat();
    assert_code(&short(folder.path(), &broken), 1);
    assert_eq!(names(&fields).len(), first.len() + 5);
    let again = [&export[..], &["--force"]].concat();
    assert_code(&short(folder.path(), &again), 0);
    let mut all = first;
    all.extend(["step_1.npz", "step_000999_mine.png", "notes"].map(str::to_owned));
    all.sort();
    assert_eq!(names(&fields), all);
    std::fs::write(fields.join("scene.toml"), "title = 'mine'").unwrap();
    refused(
        &short(folder.path(), &again),
        4,
        &["scene.toml", "no export"],
    );
}

#[test]
fn a_server_on_any_port_says_which() {
    let folder = tempfile::tempdir().unwrap();
    let output = short(folder.path(), &["--no-record", "--serve=0"]);
    assert_code(&output, 0);
    let told = text(&output.stderr);
    assert!(
        told.contains("127.0.0.1:") && !told.contains("127.0.0.1:0/"),
        "{told}"
    );
}

#[test]
fn nothing_was_sent_to_a_viewer_that_never_answered() {
    let folder = tempfile::tempdir().unwrap();
    let listener = TcpListener::bind((Ipv4Addr::LOCALHOST, 0)).unwrap();
    let connect = format!("--connect={}", listener.local_addr().unwrap());
    let output = short(folder.path(), &["--no-record", &connect]);
    assert_code(&output, 0);
    let told = text(&output.stdout);
    assert!(
        told.contains("(0 frames") && told.contains("never answered"),
        "{told}"
    );
}

#[test]
fn no_text_drives_the_terminal_or_floods_it() {
    let folder = tempfile::tempdir().unwrap();
    let place = folder.path();
    let title = "--set=title=\"a \\u001b[31mred \\u009b2J\\u0007 \\u202eb\"";
    let output = short(place, &["--no-record", title]);
    assert_code(&output, 1);
    let told = text(&output.stderr);
    assert!(
        told.contains("title") && !told.contains(['\u{1b}', '\u{9b}', '\u{7}', '\u{202e}']),
        "{told}"
    );
    std::fs::write(
        place.join("escape.toml"),
        "title = \u{1b}[31m\u{1b}]0;mine\u{7}\n",
    )
    .unwrap();
    std::fs::write(
        place.join("long.toml"),
        format!("title = {}\n", "x".repeat(100_000)),
    )
    .unwrap();
    let long = format!("{}.toml", "y".repeat(100_000));
    for args in [
        ["check", "escape.toml"],
        ["check", "long.toml"],
        ["check", &long],
        ["sweep", "escape.toml"],
        ["sweep", "long.toml"],
        ["view", "\u{1b}[31m.rrd"],
        ["check", "--\u{1b}[31m"],
    ] {
        let output = asperity(place, &args);
        assert_code(&output, 1);
        let told = text(&output.stderr);
        assert!(!told.contains(['\u{1b}', '\u{7}']), "{told}");
        assert!(
            told.len() < 6000,
            "{} bytes for {:.40}",
            told.len(),
            args[1]
        );
    }
}

#[test]
fn a_pipe_is_refused_and_not_waited_for() {
    let folder = tempfile::tempdir().unwrap();
    let place = folder.path();
    assert!(
        Command::new("mkfifo")
            .arg(place.join("pipe.toml"))
            .status()
            .unwrap()
            .success()
    );
    let cases: [&[&str]; 4] = [
        &["check", "pipe.toml"],
        &["sweep", "pipe.toml"],
        &["run", "--from=pipe.toml", "--no-record"],
        &["view", "pipe.toml"],
    ];
    for args in cases {
        let mut child = command(place, args)
            .stdout(Stdio::piped())
            .stderr(Stdio::piped())
            .spawn()
            .unwrap();
        wait_until("a refusal", || child.try_wait().unwrap().is_some());
        let (code, _, err) = ended(child);
        assert_eq!(code, Some(1), "{args:?}: {err}");
        assert!(err.contains("not a plain file"), "{err}");
    }
}

/// Ridges of so many nm on 16 x 16 pixels.
fn write_map(path: &Path, height_nm: f64) {
    let row = |_| {
        (0..16)
            .map(|i| format!("{}", height_nm * f64::from(i % 8)))
            .collect::<Vec<_>>()
            .join(",")
    };
    let rows: Vec<String> = (0..16).map(row).collect();
    std::fs::write(path, rows.join("\n")).unwrap();
}

#[test]
fn another_surface_under_the_same_name_is_another_scene() {
    let folder = tempfile::tempdir().unwrap();
    let place = folder.path();
    let map = place.join("map.csv");
    write_map(&map, 10.0);
    let file = format!("--set=body_2.surface.file={}", map.display());
    let scene = [
        "--set=body_2.surface.kind=height_map",
        "--set=body_2.surface.pixel_m=4e-4",
        "--set=body_2.surface.unit_m=1e-9",
        &file,
    ];
    let run = |more: &[&str]| {
        let rough = &SMALL[1..2];
        let own = ["run", "--passages=0.25", "--set=grid.nodes=33"];
        asperity(place, &[&own[..], rough, &scene[..], more].concat())
    };
    let ended = |output: Output| {
        let told = text(&output.stderr);
        assert!(matches!(output.status.code(), Some(0 | 2)), "{told}");
    };
    let goes_on = ["--from-state=one.state", "--no-record"];
    let repeats = ["run", "--from=one.rrd", "--no-record"];
    ended(run(&["--out=one.rrd", "--save-state=one.state"]));
    ended(run(&goes_on));
    ended(asperity(place, &repeats));
    // Written in another way it is the same surface.
    let other_words = std::fs::read_to_string(&map)
        .unwrap()
        .replace("10,", "1e1,");
    std::fs::write(&map, other_words + "\n").unwrap();
    ended(run(&goes_on));
    write_map(&map, 11.0);
    refused(&run(&goes_on), 1, &["map.csv", "have changed"]);
    refused(&asperity(place, &repeats), 1, &["map.csv", "have changed"]);
}

#[test]
fn what_a_map_is_stands_in_check_report_and_summary() {
    let folder = tempfile::tempdir().unwrap();
    let place = folder.path();
    // 16 pixels of 0.4 mm a side, waves of 100 nm by hand: 0, 100, 0, -100.
    let row = "0,0;100,0;0;-100,0;0;100;0;-100;0;100;0;-100;0;100;0;-100\n";
    let header = "# Width: 6.4 mm\n# Value units: nm\n".replace('.', ",");
    std::fs::write(place.join("map.txt"), header + &row.repeat(16)).unwrap();
    let scene = [
        "--set=body_2.surface.kind=height_map",
        "--set=body_2.surface.file=map.txt",
    ];
    let told = [
        "map.txt: 16 rows x 16 columns, 6400 µm along x, 6400 µm along y; a value of 1 is 1e-9 m",
        "taken off: the mean",
        "minimum -100 nm, maximum 100 nm, Sq 70.7 nm, greatest departure 1.41 Sq",
    ];
    let with = |own: &[&str]| {
        let output = asperity(place, &[own, &SMALL[1..2], &scene].concat());
        assert!(
            matches!(output.status.code(), Some(0 | 2)),
            "{}",
            text(&output.stderr)
        );
        text(&output.stdout)
    };
    let check = with(&["check", "--set=grid.nodes=33"]);
    let run = [
        "run",
        "--passages=0.25",
        "--set=grid.nodes=33",
        "--no-record",
    ];
    let report = with(&run);
    for line in told {
        assert!(check.contains(line), "{line}: {check}");
        assert!(report.contains(line), "{line}: {report}");
    }
    let summary = with(&[&run[..], &["--summary=-"]].concat());
    let summary: serde_json::Value = serde_json::from_str(&summary).unwrap();
    let map = &summary["map_body_2"];
    assert_eq!(summary.get("map_body_1"), None, "its surface is a sinusoid");
    assert_eq!((&map["rows"], &map["columns"]), (&16.into(), &16.into()));
    assert_eq!(
        (&map["level"], &map["outliers"]),
        (&"mean".into(), &0.into())
    );
    assert!(map["file"].as_str().unwrap().ends_with("map.txt"));
    for (key, told) in [
        ("size_x_m", 6.4e-3),
        ("size_y_m", 6.4e-3),
        ("unit_m", 1e-9),
        ("min_m", -1e-7),
        ("max_m", 1e-7),
        ("sq_m", 1e-7 / 2.0_f64.sqrt()),
        ("max_over_sq", 2.0_f64.sqrt()),
    ] {
        let found = map[key].as_f64().unwrap();
        assert!((found / told - 1.0).abs() < 1e-6, "{key}: {found:e}");
    }
}

/// What a whole run has left is not given up for the part of another: that lies beside it, and says where.
#[test]
fn a_stopped_run_leaves_the_whole_one_that_it_was_to_replace() {
    let home = tempfile::tempdir().unwrap();
    let folder = home.path();
    let outputs = ["--out=a.rrd", "--table=a.csv", "--summary=a.json"];
    let whole = short(folder, &outputs);
    assert_code(&whole, 0);
    let read = |name: &str| std::fs::read(folder.join(name)).unwrap();
    let before = ["a.rrd", "a.csv", "a.json"].map(read);
    let forced = [&outputs[..], &["--force"]].concat();
    let child = endless(folder, &forced);
    wait_until("rows of the second run", || {
        let parts = names(folder).into_iter();
        let is_table = |name: &str| Path::new(name).extension().is_some_and(|end| end == "csv");
        let part = parts.filter(|name| name.contains(".part-") && is_table(name));
        part.map(|name| rows(&folder.join(name))).max() > Some(20)
    });
    signal(&child, "-INT");
    let (code, out, err) = ended(child);
    assert_eq!(code, Some(5), "{err}");
    assert_eq!(["a.rrd", "a.csv", "a.json"].map(read), before);
    assert_eq!(
        names(folder),
        [
            "a.csv",
            "a.json",
            "a.rrd",
            "a.stopped.csv",
            "a.stopped.json",
            "a.stopped.rrd"
        ]
    );
    assert!(
        out.contains("a.stopped.rrd") && out.contains("a.stopped.csv"),
        "{out}"
    );
    let summary: serde_json::Value = serde_json::from_slice(&read("a.stopped.json")).unwrap();
    assert_eq!(summary["stopped"], true);
    assert_eq!(summary["converged"], false);
    // It can be read.
    assert_code(
        &asperity(folder, &["export", "a.stopped.rrd", "--as=csv"]),
        0,
    );
    // One that comes to its end takes the name, as always.
    assert_code(&short(folder, &forced), 0);
    assert!(read("a.csv").len() == before[1].len());
}

/// Names are bytes, and 255 of them; titles are one line that drives no terminal.
#[test]
fn paths_need_be_no_text_and_may_be_long_and_titles_are_one_line() {
    use std::os::unix::ffi::OsStrExt as _;
    let home = tempfile::tempdir().unwrap();
    let folder = home
        .path()
        .join(std::ffi::OsStr::from_bytes(b"no \xff text"));
    std::fs::create_dir(&folder).unwrap();
    let scene = text(&asperity(home.path(), &["scenes", "demonstration_quick"]).stdout);
    let file = folder.join("scene.toml");
    std::fs::write(&file, &scene).unwrap();
    let long = folder.join(format!("{}.rrd", "n".repeat(251)));
    let run = Command::new(env!("CARGO_BIN_EXE_asperity"))
        .args(["run", "--passages=0.5", "--force"])
        .args(SMALL)
        .arg(&file)
        .arg("--out")
        .arg(&long)
        .arg("--table")
        .arg(folder.join("t.csv"))
        .output()
        .unwrap();
    assert_code(&run, 0);
    assert!(std::fs::metadata(&long).unwrap().len() > 10_000);
    assert!(rows(&folder.join("t.csv")) > 5);
    assert_eq!(std::fs::read_dir(&folder).unwrap().count(), 3);
    for title in ["two\\nlines", "\\u202ereversed", "\\u001b[31mred"] {
        let mut lines: Vec<String> = scene.lines().map(str::to_owned).collect();
        let at = lines
            .iter()
            .position(|line| line.starts_with("title"))
            .unwrap();
        lines[at] = format!("title = \"{title}\"");
        std::fs::write(home.path().join("t.toml"), lines.join("\n")).unwrap();
        let checked = asperity(home.path(), &["check", "t.toml"]);
        refused(&checked, 1, &["title", "one line"]);
        let told = text(&checked.stderr);
        assert!(
            !told.contains('\u{202e}') && !told.contains('\u{1b}'),
            "{told:?}"
        );
    }
}

/// A recording is no larger than was asked for; what nothing can keep is refused with what can be kept.
#[test]
fn a_budget_holds_or_is_refused() {
    let home = tempfile::tempdir().unwrap();
    let folder = home.path();
    // Half a passage fills a budget as far as two do. What the mesh costs is recorded at the end: one line tells it.
    let record = |scene: &str, nodes: &str, budget: &str| {
        let source = if scene == "fzg_point_b" {
            "companion"
        } else {
            "none"
        };
        asperity(
            folder,
            &[
                "run",
                scene,
                "--nodes",
                nodes,
                "--passages=0.5",
                "--set=numerics.ladder=false",
                &format!("--set=numerics.error_estimate={source}"),
                "--out=a.rrd",
                "--force",
                "--threads=2",
                &format!("--set=record.budget_mb={budget}"),
            ],
        )
    };
    for (scene, nodes, least) in [
        ("demonstration_quick", "65", "1.7"),
        ("demonstration_quick", "129", "1.8"),
        ("fzg_point_b", "257", "2.1"),
        ("cam_nose", "257", "2.1"),
        ("fzg_point_a", "513", "2.7"),
    ] {
        refused(
            &record(scene, nodes, "0.5"),
            1,
            &["record.budget_mb", &format!("at least {least} MB")],
        );
        for budget in [least, "3", "4"] {
            assert_code(&record(scene, nodes, budget), 0);
            let bytes = std::fs::metadata(folder.join("a.rrd")).unwrap().len();
            let most = 1e6 * budget.parse::<f64>().unwrap();
            println!("{scene} {nodes}: {bytes} bytes of {budget} MB");
            assert!(
                bytes as f64 <= most,
                "{scene} {nodes}: {bytes} of {budget} MB"
            );
        }
    }
}
