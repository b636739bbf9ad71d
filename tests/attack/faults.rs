//! Faults: whatever breaks off a run, what was there stays or is replaced by something whole.

use std::cell::Cell;
use std::path::Path;
use std::time::{Duration, Instant};

use asperity_engine::observe::stopped_of;
use asperity_recorder::Recorded;
use asperity_session::run::Checkpoint;

use super::child::{self, Ended, Place};
use super::report::Tally;

const SMALL: [&str; 8] = [
    "run",
    "demonstration_quick",
    "--set=grid.nodes=33",
    "--set=body_1.surface.wavelength_x_m=4e-4",
    "--set=body_2.surface.wavelength_x_m=4e-4",
    "--set=body_2.surface.wavelength_y_m=4e-4",
    "--set=numerics.error_estimate=none",
    "--threads=1",
];
/// Outputs, by the option that asks for them.
const OUTPUTS: [(&str, &str); 4] = [
    ("--out", "run.rrd"),
    ("--table", "run.csv"),
    ("--summary", "run.json"),
    ("--save-state", "run.state"),
];
const MINE: &str = "mine, and a day's work: ";
const NONE: &str = "true";

pub(super) fn args(passages: &str, more: &[String]) -> Vec<String> {
    let own = SMALL.map(str::to_owned).into_iter();
    let own = own.chain([format!("--passages={passages}")]);
    let recorded = more.iter().any(|arg| arg.starts_with("--out"));
    let unrecorded = (!recorded).then(|| "--no-record".to_owned());
    own.chain(unrecorded).chain(more.iter().cloned()).collect()
}

pub(super) fn refs(args: &[String]) -> Vec<&str> {
    args.iter().map(String::as_str).collect()
}

pub(super) fn all_outputs() -> Vec<String> {
    OUTPUTS
        .map(|(option, name)| format!("{option}={name}"))
        .to_vec()
}

pub(super) fn put_mine(place: &Place) {
    for (_, name) in OUTPUTS {
        place.put(name, format!("{MINE}{name}").as_bytes());
    }
}

fn is_mine(path: &Path) -> bool {
    let name = path.file_name().unwrap().to_string_lossy();
    std::fs::read_to_string(path).is_ok_and(|text| text == format!("{MINE}{name}"))
}

/// Whether a file is what its name says, from beginning to end.
fn is_whole(path: &Path) -> bool {
    let text = || std::fs::read_to_string(path).unwrap_or_default();
    match path.extension().unwrap().to_string_lossy().as_ref() {
        "rrd" => {
            let run = Recorded::read(path);
            run.is_ok_and(|run| run.broken_off.is_none() && run.damage.is_none())
        }
        "csv" => text().lines().count() > 1 && text().ends_with('\n'),
        "json" => serde_json::from_str::<serde_json::Value>(&text()).is_ok(),
        _ => Checkpoint::read(path).is_ok(),
    }
}

/// What was lost of the outputs, if anything.
pub(super) fn lost(place: &Place) -> Option<String> {
    OUTPUTS.iter().find_map(|(_, name)| {
        let path = place.folder().join(name);
        let good = is_mine(&path) || is_whole(&path);
        (!good).then(|| format!("{name} is lost"))
    })
}

/// What was lost when a run was stopped: what it was to replace stays, and what there is of it lies beside; the state, from which
/// it goes on, has its name.
fn lost_by_a_stop(place: &Place) -> Option<String> {
    OUTPUTS.iter().find_map(|(option, name)| {
        let path = place.folder().join(name);
        let good = if *option == "--save-state" {
            is_whole(&path)
        } else {
            is_mine(&path) && is_whole(&stopped_of(&path))
        };
        (!good).then(|| format!("{name} is lost"))
    })
}

pub(super) struct Faults {
    tally: Tally,
    /// Longest that an end was waited for, s; most memory that was held, MB.
    most: Cell<(f64, f64)>,
}

impl Faults {
    /// What is wrong with how a process ended.
    pub(super) fn met(&self, ended: &Ended, codes: &[i32]) -> Option<String> {
        let (waited_s, peak_mb) = self.most.get();
        let most = (waited_s.max(ended.waited_s), peak_mb.max(ended.peak_mb));
        self.most.set(most);
        ended.fault(codes)
    }

    /// Takes up how a drill ended.
    pub(super) fn judge(&mut self, drill: &str, fault: Option<String>) {
        self.tally.count(drill);
        let repeat = "`cargo test --release --test attack faults`";
        self.tally
            .failures
            .extend(fault.map(|fault| format!("{repeat}: {drill}: {fault}")));
    }

    /// A short run with all outputs over files that are there, with something taken from it.
    fn deprived(&mut self, drill: &str, limit: &str, codes: &[i32]) {
        let place = Place::new();
        put_mine(&place);
        let more = [all_outputs(), vec!["--force".to_owned()]].concat();
        let ended = place.run(limit, &refs(&args("0.1", &more)));
        // With too little memory an allocation that fails ends a process by a signal, after it was told.
        let by_memory = codes.is_empty() && ended.err.contains("memory");
        let fault = if by_memory {
            None
        } else {
            self.met(
                &ended,
                if codes.is_empty() {
                    &[0, 2, 3, 4]
                } else {
                    codes
                },
            )
        };
        self.judge(drill, fault.or_else(|| lost(&place)));
    }

    /// One output in a place that does not take it.
    fn misplaced(
        &mut self,
        drill: &str,
        option: &str,
        at: &str,
        force: bool,
        prepare: impl Fn(&Place),
    ) {
        let place = Place::new();
        put_mine(&place);
        prepare(&place);
        let mut more = vec![format!("{option}={at}")];
        more.extend(force.then(|| "--force".to_owned()));
        let before = place.names();
        let ended = place.run(NONE, &refs(&args("0.1", &more)));
        let fault = self.met(&ended, &[1, 4]);
        let stub = (place.names() != before).then(|| format!("leaves {:?}", place.names()));
        let gone = OUTPUTS
            .iter()
            .find(|(_, name)| !is_mine(&place.folder().join(name)));
        let gone = gone.map(|(_, name)| format!("{name} is lost"));
        self.judge(
            drill,
            fault
                .or(stub)
                .or(gone)
                .map(|fault| format!("{option}={at}: {fault}")),
        );
    }

    fn signalled(&mut self, signal: &str) {
        let place = Place::new();
        put_mine(&place);
        let more = [all_outputs(), vec!["--force".to_owned()]].concat();
        let child = child::start(
            &place.folder(),
            &place.words(),
            NONE,
            &refs(&args("10000", &more)),
        );
        wait_for_rows(&place);
        let sent = std::process::Command::new("kill")
            .args([signal, &child.id().to_string()])
            .status();
        assert!(sent.unwrap().success());
        let ended = child::end(child, &place.words());
        let killed = signal == "-KILL";
        let fault = if killed {
            ended.status.is_none().then(|| "lives on".to_owned())
        } else {
            self.met(&ended, &[5])
        };
        let all_mine = OUTPUTS
            .iter()
            .all(|(_, name)| is_mine(&place.folder().join(name)));
        let touched =
            (killed && !all_mine).then(|| "a killed run has touched what was there".to_owned());
        self.judge(
            &format!("signal {signal}"),
            fault.or(touched).or_else(|| {
                if killed {
                    lost(&place)
                } else {
                    lost_by_a_stop(&place)
                }
            }),
        );
    }

    fn two_writers(&mut self) {
        let place = Place::new();
        put_mine(&place);
        let more = [all_outputs(), vec!["--force".to_owned()]].concat();
        let first = child::start(
            &place.folder(),
            &place.words(),
            NONE,
            &refs(&args("10000", &more)),
        );
        wait_for_rows(&place);
        for option in ["--out=run.rrd", "--table=run.csv"] {
            let words = tempfile::tempdir().unwrap();
            let second = args("0.1", &[option.to_owned(), "--force".to_owned()]);
            let ended = child::run(&place.folder(), words.path(), NONE, &refs(&second));
            self.judge("two writers", self.met(&ended, &[4]));
        }
        let sent = std::process::Command::new("kill")
            .args(["-TERM", &first.id().to_string()])
            .status();
        assert!(sent.unwrap().success());
        let ended = child::end(first, &place.words());
        self.judge(
            "two writers",
            self.met(&ended, &[5]).or_else(|| lost_by_a_stop(&place)),
        );
    }

    /// Nobody reads what it prints.
    fn unread(&mut self) {
        let place = Place::new();
        let script = "\"$0\" \"$@\" | true";
        let args = args("0.1", &["--summary=-".to_owned()]);
        let output = std::process::Command::new("sh")
            .args(["-c", script, &child::program()])
            .args(&args)
            .current_dir(place.folder())
            .output()
            .unwrap();
        let told = String::from_utf8_lossy(&output.stderr).into_owned();
        self.judge("closed pipe", (!told.is_empty()).then_some(told));
    }

    /// A sweep that is killed, runs out of disk, meets another: its table is that of one that met nothing.
    fn sweeps(&mut self) {
        const SWEEP: &str = include_str!("../cluster/tiny.toml");
        let place = Place::new();
        place.put("tiny.toml", SWEEP.replace("n = 16", "n = 6").as_bytes());
        let sweep = |out: &str, more: &[&str], limit: &str| -> Ended {
            let out = format!("--out={out}");
            let own = ["sweep", "tiny.toml", "--threads=1", &out];
            place.run(limit, &[&own[..], more].concat())
        };
        let table = |folder: &str| std::fs::read(place.folder().join(folder).join("table.csv"));
        let whole = sweep("whole", &[], NONE);
        self.judge("sweep", self.met(&whole, &[0, 2]));
        // Less than a case takes.
        let full = sweep("full", &[], "ulimit -f 1; trap '' XFSZ");
        self.judge("sweep on a full disk", self.met(&full, &[4]));
        let child = child::start(
            &place.folder(),
            &place.words(),
            NONE,
            &["sweep", "tiny.toml", "--threads=1", "--out=killed"],
        );
        let cases = place.folder().join("killed/cases");
        let began = Instant::now();
        while std::fs::read_dir(&cases).map_or(0, Iterator::count) < 2
            && began.elapsed() < child::PATIENCE
        {
            std::thread::sleep(Duration::from_millis(5));
        }
        let words = tempfile::tempdir().unwrap();
        let second = ["sweep", "tiny.toml", "--out=killed", "--force"];
        let second = child::run(&place.folder(), words.path(), NONE, &second);
        self.judge("two sweeps in one folder", self.met(&second, &[1, 4]));
        let sent = std::process::Command::new("kill")
            .args(["-KILL", &child.id().to_string()])
            .status();
        assert!(sent.unwrap().success());
        drop(child::end(child, &place.words()));
        for folder in ["killed", "full"] {
            let again = sweep(folder, &["--resume"], NONE);
            let same = table(folder).ok() == table("whole").ok();
            let other = (!same).then(|| "another table".to_owned());
            self.judge("sweep taken up again", self.met(&again, &[0, 2]).or(other));
        }
        place.put("notes.txt", b"mine");
        std::fs::create_dir(place.folder().join("mine")).unwrap();
        std::fs::write(place.folder().join("mine/table.csv"), MINE).unwrap();
        let foreign = sweep("mine", &["--force"], NONE);
        let kept = std::fs::read_to_string(place.folder().join("mine/table.csv"));
        let gone =
            (kept.ok().as_deref() != Some(MINE)).then(|| "somebody's table is lost".to_owned());
        self.judge(
            "sweep into somebody's folder",
            self.met(&foreign, &[1, 4]).or(gone),
        );
    }

    /// Nobody waits for a pipe that has the name of one of a sweep's own files.
    fn pipes_in_a_sweep(&mut self) {
        const SWEEP: &str = include_str!("../cluster/tiny.toml");
        let place = Place::new();
        place.put("tiny.toml", SWEEP.replace("n = 16", "n = 2").as_bytes());
        let resume = ["sweep", "tiny.toml", "--threads=1", "--resume", "--out=own"];
        let whole = place.run(NONE, &resume);
        self.judge("sweep", self.met(&whole, &[0, 2]));
        for name in [
            "sweep.digest",
            "sweep.lock",
            "sweep.toml",
            "cases/0000001.json",
        ] {
            let path = place.folder().join("own").join(name);
            let kept = std::fs::read(&path).unwrap();
            std::fs::remove_file(&path).unwrap();
            for args in [&["sweep", "collect", "own", "--out=all"], &resume[..]] {
                drop(std::fs::remove_file(&path));
                mkfifo(&path);
                let ended = place.run(NONE, args);
                let fault = self.met(&ended, &[0, 1, 2, 3, 4]);
                let fault = fault.map(|fault| format!("{name}: {}: {fault}", args[1]));
                self.judge("a pipe in a sweep's folder", fault);
            }
            std::fs::remove_file(&path).unwrap();
            std::fs::write(&path, kept).unwrap();
        }
    }

    /// An export whose steps do not fit, and one that is killed.
    fn exports(&mut self) {
        let place = Place::new();
        let more = ["--export=fields".to_owned(), "--export-every=1".to_owned()];
        let full = place.run("ulimit -f 1; trap '' XFSZ", &refs(&args("0.1", &more)));
        let names = std::fs::read_dir(place.folder().join("fields")).map_or(0, Iterator::count);
        let half = (names > 0).then(|| format!("{names} files of a full disk"));
        self.judge("export on a full disk", self.met(&full, &[4]).or(half));
        let force = [&more[..], &["--force".to_owned()]].concat();
        let whole = place.run(NONE, &refs(&args("0.1", &force)));
        self.judge("export", self.met(&whole, &[0, 2]));
    }
}

fn mkfifo(path: &Path) {
    let made = std::process::Command::new("mkfifo").arg(path).status();
    assert!(made.unwrap().success());
}

/// All drills.
pub(crate) fn all() -> Vec<Tally> {
    let mut faults = Faults {
        tally: Tally::new("faults"),
        most: Cell::default(),
    };
    for signal in ["-KILL", "-TERM", "-HUP", "-INT"] {
        faults.signalled(signal);
    }
    for kb in [1, 8, 64, 512, 2048] {
        let blocks = 2 * kb;
        faults.deprived(
            "full disk",
            &format!("ulimit -f {blocks}; trap '' XFSZ"),
            &[0, 2, 4],
        );
    }
    for n in [6, 8, 12, 16, 20] {
        faults.deprived(
            "few descriptors",
            &format!("ulimit -n {n}"),
            &[0, 1, 2, 3, 4],
        );
    }
    for kb in [60_000, 150_000, 300_000, 600_000] {
        faults.deprived("low memory", &format!("ulimit -v {kb}"), &[]);
    }
    faults.deprived("closed stdin and stdout", "exec <&- >&-", &[0, 2, 4]);
    faults.deprived("all closed", "exec <&- >&- 2>&-", &[0, 2, 4]);
    for (option, name) in OUTPUTS {
        faults.misplaced("existing", option, name, false, |_| {});
        faults.misplaced("no folder", option, "nowhere/file", true, |_| {});
        faults.misplaced("a folder", option, ".", true, |_| {});
        faults.misplaced("read-only", option, "/proc/asperity.csv", true, |_| {});
        faults.misplaced("/dev/full", option, "/dev/full", true, |_| {});
        faults.misplaced("a pipe that nobody reads", option, "pipe", true, |place| {
            mkfifo(&place.folder().join("pipe"));
        });
        faults.misplaced("a link to nothing", option, "link", true, |place| {
            std::os::unix::fs::symlink("nothing", place.folder().join("link")).unwrap();
        });
        faults.misplaced("a link to a file", option, "link", false, |place| {
            std::os::unix::fs::symlink("run.json", place.folder().join("link")).unwrap();
        });
    }
    faults.two_writers();
    faults.unread();
    faults.exports();
    faults.sweeps();
    faults.pipes_in_a_sweep();
    #[cfg(target_os = "linux")]
    faults.clock_jumps();
    (faults.tally.slowest_s, faults.tally.peak_mb) = faults.most.get();
    vec![faults.tally]
}

/// Waits until a run has written rows of its table, and so has all its files open.
fn wait_for_rows(place: &Place) {
    let is_table = |name: &String| {
        name.contains(".part-") && Path::new(name).extension().is_some_and(|it| it == "csv")
    };
    let rows = || {
        let name = place.names().into_iter().find(is_table)?;
        let text = std::fs::read_to_string(place.folder().join(name)).ok()?;
        Some(text.lines().count())
    };
    let began = Instant::now();
    while rows().unwrap_or(0) < 8 && began.elapsed() < child::PATIENCE {
        std::thread::sleep(Duration::from_millis(5));
    }
}
