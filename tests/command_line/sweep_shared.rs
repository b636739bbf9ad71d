//! Sweeps that many share, and large ones: chains are taken by whoever is free, a million cases begin and end at once.
#![expect(clippy::unwrap_used, reason = "tests")]

use std::io::{BufRead as _, BufReader, Read as _};
use std::path::Path;
use std::process::{Child, Command, Stdio};
use std::time::{Duration, Instant};

use asperity_session::sweep::{Existing, Folder, Progress, Status, run};

use crate::sweep::{FEW, TINY, asperity, fill, planned, refused, sweep, table};

/// The program on its way in a folder.
fn started(folder: &Path, args: &[&str]) -> Child {
    let mut command = Command::new(env!("CARGO_BIN_EXE_asperity"));
    command.args(args).current_dir(folder).stdin(Stdio::null());
    let piped = command.stdout(Stdio::piped()).stderr(Stdio::piped());
    piped.spawn().unwrap()
}

#[test]
fn processes_share_the_chains_of_a_folder() {
    let root = tempfile::tempdir().unwrap();
    let place = root.path();
    std::fs::write(place.join("tiny.toml"), TINY).unwrap();
    let args = |out: &'static str| {
        [
            "sweep",
            "tiny.toml",
            "--resume",
            "--threads=1",
            "--out",
            out,
        ]
    };
    assert!(asperity(place, &args("single")).status.success());
    let both = [
        started(place, &args("shared")),
        started(place, &args("shared")),
    ];
    let computed = both.map(|child| {
        let output = child.wait_with_output().unwrap();
        assert!(output.status.success(), "{output:?}");
        String::from_utf8(output.stdout).unwrap()
    });
    println!("{computed:?}");
    let read = |out: &str| std::fs::read(place.join(out).join("table.csv")).unwrap();
    assert_eq!(read("shared"), read("single"));
    let claims = std::fs::read_dir(place.join("shared/chains")).unwrap();
    assert_eq!(claims.count(), 0, "claims and states are gone");
}

#[test]
fn no_case_is_computed_twice_and_what_others_leave_is_taken() {
    let root = tempfile::tempdir().unwrap();
    let sweep = sweep(TINY);
    let place = root.path().join("out");
    let gate = std::sync::Barrier::new(3);
    let help = || {
        gate.wait();
        fill(&sweep, &place, None, 1).1
    };
    let computed = std::thread::scope(|scope| {
        [(); 3]
            .map(|()| scope.spawn(help))
            .map(|one| one.join().unwrap())
    });
    println!("{computed:?}");
    assert_eq!(computed.iter().sum::<usize>(), 8, "{computed:?}");
    assert!(computed.iter().all(|cases| *cases < 8), "{computed:?}");
}

#[test]
fn a_chain_that_somebody_has_is_left_to_him_and_one_that_the_dead_had_is_not() {
    let root = tempfile::tempdir().unwrap();
    let sweep = sweep(TINY);
    let place = root.path().join("out");
    let folder = Folder::create(&place, &sweep, Existing::Refuse).unwrap();
    let claim = place.join("chains/0000001.claim");
    std::fs::write(&claim, "somewhere process 1\n").unwrap();
    let file = std::fs::File::open(&claim).unwrap();
    file.try_lock().unwrap();
    let work = planned(&sweep, None);
    let helped = run(&sweep, &folder, &work, 2, &Progress::default()).unwrap();
    assert_eq!((helped.computed, helped.held), (6, 1));
    let status = Status::of(&sweep, &folder).unwrap();
    assert_eq!((status.cases, status.chains, status.left.cases), (6, 3, 2));
    let seen: Vec<_> = status
        .claimed
        .iter()
        .map(|c| (c.chain, c.is_alive))
        .collect();
    assert_eq!(seen, [(1, true)]);
    assert_eq!(status.claimed[0].by, "somewhere process 1");
    // The lock goes with its process.
    drop(file);
    let status = Status::of(&sweep, &folder).unwrap();
    assert!(!status.claimed[0].is_alive);
    let (folder, computed) = fill(&sweep, &place, None, 1);
    assert_eq!(computed, 2);
    let (whole, _) = fill(&sweep, &root.path().join("whole"), None, 2);
    assert_eq!(table(&sweep, &[folder]), table(&sweep, &[whole]));
    assert!(!claim.exists());
}

#[test]
fn shards_in_folders_of_their_own_make_the_table_of_one_process() {
    let root = tempfile::tempdir().unwrap();
    let place = root.path();
    std::fs::write(place.join("tiny.toml"), TINY).unwrap();
    let said = |args: &[&str]| {
        let output = asperity(place, args);
        assert!(output.status.success(), "{output:?}");
        String::from_utf8(output.stdout).unwrap()
    };
    said(&["sweep", "tiny.toml", "--out=single"]);
    for (shard, out) in [("--shard=2/2", "--out=two"), ("--shard=1/2", "--out=one")] {
        let told = said(&["sweep", "tiny.toml", shard, out]);
        assert!(
            told.contains("4 cases computed; 4 of 8 cases are missing"),
            "{told}"
        );
    }
    said(&["sweep", "collect", "one", "two", "--out", "both"]);
    let read = |out: &str| std::fs::read(place.join(out).join("table.csv")).unwrap();
    assert_eq!(read("both"), read("single"));
    refused(
        &asperity(place, &["sweep", "tiny.toml", "--shard=3/2"]),
        1,
        &["3/2 is refused", "1 <= i <= n"],
    );
}

#[test]
fn an_engine_runs_the_manifest_chain_by_chain() {
    let root = tempfile::tempdir().unwrap();
    let place = root.path();
    std::fs::write(
        place.join("few.toml"),
        FEW.replace("longest = 2", "longest = 1"),
    )
    .unwrap();
    let said = |args: &[&str]| {
        let output = asperity(place, args);
        assert!(output.status.success(), "{output:?}");
        String::from_utf8(output.stdout).unwrap()
    };
    let manifest = said(&["sweep", "few.toml", "--show", "manifest"]);
    let mut lines = manifest.lines();
    assert_eq!(
        lines.next(),
        Some("chain,first_case,last_case,estimated_s,memory_bytes")
    );
    let chains: Vec<&str> = lines.map(|line| line.split(',').next().unwrap()).collect();
    assert_eq!(chains, ["0", "1"]);
    for (done, chain) in chains.iter().enumerate() {
        let said = said(&["sweep", "few.toml", "--out=out", "--chain", chain]);
        assert!(
            said.starts_with("1 cases computed; asperity sweep collect out"),
            "{said}"
        );
        let status = self::status(place);
        let words = format!("done      {0} of 2 cases, {0} of 2 chains\n", done + 1);
        assert!(status.starts_with(&words), "{status}");
        assert!(status.ends_with("table     none yet\n"), "{status}");
        assert_eq!(
            status.contains("not done  1 cases in 1 chains, an estimated"),
            done == 0
        );
    }
    said(&["sweep", "collect", "out"]);
    assert!(status(place).ends_with("table     out/table.csv\n"));
    let wrong = asperity(place, &["sweep", "few.toml", "--out=out", "--chain=2"]);
    refused(
        &wrong,
        1,
        &["--chain 2", "chains 0 to 1", "--show manifest"],
    );
    let wrong = asperity(place, &["sweep", "few.toml", "--out=out", "--chain=1/2"]);
    refused(&wrong, 1, &["1/2 is refused", "such as 3 or 0,4-7"]);
}

fn status(place: &Path) -> String {
    let output = asperity(place, &["sweep", "status", "out"]);
    assert!(output.status.success(), "{output:?}");
    String::from_utf8(output.stdout).unwrap()
}

#[test]
fn without_a_terminal_progress_comes_as_lines() {
    let root = tempfile::tempdir().unwrap();
    std::fs::write(root.path().join("tiny.toml"), TINY.replace("0.5\n", "50\n")).unwrap();
    let mut child = started(
        root.path(),
        &["sweep", "tiny.toml", "--threads=1", "--out=out"],
    );
    let lines = BufReader::new(child.stderr.take().unwrap()).lines();
    let lines: Vec<String> = lines.take(3).map(Result::unwrap).collect();
    child.kill().unwrap();
    child.wait().unwrap();
    assert_eq!(lines.len(), 3, "{lines:?}");
    for line in &lines[1..] {
        assert!(
            line.starts_with("case ") && line.contains(" of 8, "),
            "{lines:?}"
        );
    }
}

/// Stand-ins for engines: they run what they are given one after the other.
#[cfg(unix)]
const STAND_INS: [(&str, &str); 3] = [
    (
        "parallel",
        "while read -r id; do \"${@//\\{\\}/$id}\" || exit; done",
    ),
    (
        "sbatch",
        "while [[ $1 == -* ]]; do [[ $1 == --array=* ]] && last=${1#*-array=0-}; shift; done
         for k in $(seq 0 \"$last\"); do SLURM_ARRAY_TASK_ID=$k bash \"$@\" || exit; done",
    ),
    (
        "hq",
        "[ \"$1\" = submit ] && shift
         while [[ $1 == -* ]]; do [[ $1 == --array=* ]] && last=${1#*-array=0-}; shift; done
         for k in $(seq 0 \"$last\"); do HQ_TASK_ID=$k \"$@\" || exit; done",
    ),
];

/// Real ones are used by the scripts in `tests/cluster` themselves, where they are installed.
#[cfg(unix)]
#[test]
fn the_scripts_for_engines_make_the_table() {
    use std::os::unix::fs::PermissionsExt as _;
    let root = tempfile::tempdir().unwrap();
    let place = root.path();
    std::fs::write(place.join("tiny.toml"), TINY).unwrap();
    let single = ["sweep", "tiny.toml", "--out=single"];
    assert!(asperity(place, &single).status.success());
    let engines = place.join("engines");
    std::fs::create_dir(&engines).unwrap();
    for (name, text) in STAND_INS {
        let file = engines.join(name);
        std::fs::write(&file, format!("#!/bin/bash\n{text}\n")).unwrap();
        std::fs::set_permissions(&file, std::fs::Permissions::from_mode(0o755)).unwrap();
    }
    let path = format!("{}:{}", engines.display(), std::env::var("PATH").unwrap());
    let scripts = Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/cluster");
    for engine in ["parallel", "slurm", "hyperqueue"] {
        let ended = Command::new("bash")
            .arg(scripts.join(format!("by_{engine}.sh")))
            .args([env!("CARGO_BIN_EXE_asperity"), "tiny.toml", engine])
            .env("PATH", &path)
            .current_dir(place)
            .stdin(Stdio::null())
            .output()
            .unwrap();
        assert!(ended.status.success(), "{engine}: {ended:?}");
        let read = |out: &str| std::fs::read(place.join(out).join("table.csv")).unwrap();
        assert_eq!(read(engine), read("single"), "{engine}");
    }
}

/// A million cases on 65², of a thousand loads and as many S.
const MILLION: &str = "
scene = \"demonstration\"
[set]
grid.nodes = 65
[vary]
motion.slide_roll = { from = 0.0, to = 1.0, n = 1000 }
load.force_n = { from = 100.0, to = 900.0, n = 1000 }
";

/// Whether a machine that others use as well is as fast as one of its own must not decide: to the first line it is the time of
/// the program's own processor, and times are of three the best.
#[cfg(unix)]
#[test]
fn a_million_cases_begin_within_two_seconds_and_end_within_one() {
    let best = |wait_ms: u64| {
        let tries = (0..3).map(|_| begun_and_ended(Duration::from_millis(wait_ms)));
        tries.fold([f64::INFINITY; 2], |best, times| {
            [best[0].min(times[0]), best[1].min(times[1])]
        })
    };
    // While it plans, just when it begins, in the midst of cases.
    for wait_ms in [60, 400, 3000] {
        let [begun_s, ended_s] = best(wait_ms);
        println!(
            "signal after {wait_ms} ms: first line {begun_s:.2} s, end {ended_s:.2} s after the signal"
        );
        assert!(begun_s < 2.0, "{begun_s}");
        assert!(ended_s < 1.0, "{ended_s}");
    }
}

/// Seconds of a process on all processors; `None`: this system does not tell.
#[cfg(unix)]
fn processor_s(pid: u32) -> Option<f64> {
    let stat = std::fs::read_to_string(format!("/proc/{pid}/stat")).ok()?;
    // Behind the name, which may hold anything, the twelfth and thirteenth are its own and the system's hundredths.
    let (_, rest) = stat.rsplit_once(')')?;
    let hundredths = rest.split_whitespace().skip(11).take(2);
    let hundredths = hundredths.map(|text| text.parse::<f64>().ok());
    Some(hundredths.sum::<Option<f64>>()? / 100.0)
}

/// Seconds to the first line, of the processor where the system tells them, and from a signal to the end.
#[cfg(unix)]
fn begun_and_ended(wait: Duration) -> [f64; 2] {
    let root = tempfile::tempdir().unwrap();
    std::fs::write(root.path().join("million.toml"), MILLION).unwrap();
    let began = Instant::now();
    let args = ["sweep", "million.toml", "--threads=1", "--out=out"];
    let mut child = started(root.path(), &args);
    let mut said = BufReader::new(child.stderr.take().unwrap());
    let pid = child.id();
    let lines = std::thread::spawn(move || {
        let mut lines = String::new();
        said.read_line(&mut lines).unwrap();
        let begun_s = processor_s(pid).unwrap_or_else(|| began.elapsed().as_secs_f64());
        said.read_to_string(&mut lines).unwrap();
        (begun_s, lines)
    });
    // From here on signals are watched.
    while !root.path().join("out/base.toml").exists() {
        std::thread::yield_now();
    }
    std::thread::sleep(wait);
    let asked = Instant::now();
    let asks = ["-TERM".to_owned(), pid.to_string()];
    let sent = Command::new("kill").args(asks).status();
    assert!(sent.unwrap().success());
    // Before it is waited for: what it took can be read until then.
    let (begun_s, said) = lines.join().unwrap();
    let code = child.wait().unwrap().code();
    let ended_s = asked.elapsed().as_secs_f64();
    assert_eq!(code, Some(5), "{said}");
    assert!(said.contains("of 1000000 cases; they are kept"), "{said}");
    [begun_s, ended_s]
}
