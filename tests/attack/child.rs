//! A run of the program that may go wrong in any way.

use std::fs::File;
use std::path::{Path, PathBuf};
use std::process::{Child, Command, ExitStatus, Stdio};
use std::time::{Duration, Instant};

/// Longest that anything may take: a second alone, much more beside other tests on a busy machine.
pub(crate) const PATIENCE: Duration = Duration::from_mins(1);
/// Most that anything has to say, bytes: forty lines of a thousand characters.
const MOST_WORDS: usize = 50_000;

/// Most memory that anything may hold, MB.
const MOST_MB: f64 = 2000.0;
/// The same, taken from a process before it starts, as a shell says it: of address space, which is never less than what is
/// held, so that the system keeps it to the byte.
pub(crate) const MEMORY: &str = "ulimit -v 1953125";

/// How it ended.
#[derive(Debug)]
pub(crate) struct Ended {
    /// `None`: it did not, in time.
    pub(crate) status: Option<ExitStatus>,
    pub(crate) out: String,
    pub(crate) err: String,
    /// Most memory that it was seen to hold, MB.
    pub(crate) peak_mb: f64,
    /// How long its end was waited for.
    pub(crate) waited_s: f64,
}

impl Ended {
    pub(crate) fn code(&self) -> Option<i32> {
        self.status.and_then(|status| status.code())
    }

    /// What no input may bring about: a signal, a panic, a hang, a flood, codes that are not in the book, files that
    /// nobody asked for.
    pub(crate) fn fault(&self, codes: &[i32]) -> Option<String> {
        let Some(status) = self.status else {
            return Some(format!("hangs for {} s", PATIENCE.as_secs()));
        };
        let said = |what: &str| Some(format!("{what}: {:.300}", self.err.trim()));
        if self.err.contains("panicked") {
            return said("panics");
        }
        if self.peak_mb > MOST_MB {
            return Some(format!("holds {:.0} MB", self.peak_mb));
        }
        match status.code() {
            None => said(&format!("ends by {status}")),
            Some(code) if !codes.contains(&code) => said(&format!("exit code {code}")),
            Some(code) if code != 0 && self.err.trim().is_empty() && self.out.trim().is_empty() => {
                Some(format!("exit code {code} without a word"))
            }
            Some(_) if self.err.len() > MOST_WORDS => said("floods the terminal"),
            Some(_) if self.err.contains(['\u{1b}', '\u{7}']) => said("drives the terminal"),
            Some(_) => None,
        }
    }
}

/// This build, or another one to try the attack on.
pub(crate) fn program() -> String {
    let built = env!("CARGO_BIN_EXE_asperity").to_owned();
    std::env::var("ASPERITY_PROGRAM").unwrap_or(built)
}

/// The program in a folder, with a limit as a shell says it; its words go to files outside of that folder.
pub(crate) fn start(folder: &Path, words: &Path, limit: &str, args: &[&str]) -> Child {
    let file = |name: &str| Stdio::from(File::create(words.join(name)).unwrap());
    Command::new("sh")
        .args(["-c", &format!("{limit}; exec \"$0\" \"$@\"")])
        .arg(program())
        .args(args)
        .current_dir(folder)
        .env("RAYON_NUM_THREADS", "1")
        .stdin(Stdio::null())
        .stdout(file("out"))
        .stderr(file("err"))
        .spawn()
        .unwrap()
}

/// Most memory that a process has held so far, MB; nothing of one that has ended, or where the system does not tell.
fn peak_mb(child: &Child) -> Option<f64> {
    let status = std::fs::read_to_string(format!("/proc/{}/status", child.id())).ok()?;
    let line = status
        .lines()
        .find_map(|line| line.strip_prefix("VmHWM:"))?;
    let kb: f64 = line.split_whitespace().next()?.parse().ok()?;
    Some(kb / 1000.0)
}

/// Waits for its end, and ends it when that takes too long.
pub(crate) fn end(mut child: Child, words: &Path) -> Ended {
    let began = Instant::now();
    let mut pause = Duration::from_millis(1);
    let mut peak = 0.0_f64;
    let status = loop {
        peak = peak_mb(&child).unwrap_or(0.0).max(peak);
        if let Some(status) = child.try_wait().unwrap() {
            break Some(status);
        }
        if began.elapsed() > PATIENCE {
            child.kill().unwrap();
            child.wait().unwrap();
            break None;
        }
        std::thread::sleep(pause);
        pause = (pause * 2).min(Duration::from_millis(10));
    };
    let text = |name: &str| {
        let bytes = std::fs::read(words.join(name)).unwrap_or_default();
        String::from_utf8_lossy(&bytes).into_owned()
    };
    Ended {
        status,
        out: text("out"),
        err: text("err"),
        peak_mb: peak,
        waited_s: began.elapsed().as_secs_f64(),
    }
}

pub(crate) fn run(folder: &Path, words: &Path, limit: &str, args: &[&str]) -> Ended {
    end(start(folder, words, limit, args), words)
}

/// A folder to be attacked, in one that nothing else is in.
pub(crate) struct Place {
    root: tempfile::TempDir,
}

impl Place {
    pub(crate) fn new() -> Self {
        let root = tempfile::tempdir().unwrap();
        std::fs::create_dir(root.path().join("place")).unwrap();
        std::fs::create_dir(root.path().join("words")).unwrap();
        Self { root }
    }

    pub(crate) fn folder(&self) -> PathBuf {
        self.root.path().join("place")
    }

    pub(crate) fn words(&self) -> PathBuf {
        self.root.path().join("words")
    }

    pub(crate) fn put(&self, name: &str, bytes: &[u8]) {
        std::fs::write(self.folder().join(name), bytes).unwrap();
    }

    pub(crate) fn run(&self, limit: &str, args: &[&str]) -> Ended {
        run(&self.folder(), &self.words(), limit, args)
    }

    /// Names in it, and beside it.
    pub(crate) fn names(&self) -> Vec<String> {
        let list = |folder: &Path| -> Vec<String> {
            let entries = std::fs::read_dir(folder).unwrap();
            let name = |entry: std::io::Result<std::fs::DirEntry>| entry.unwrap().file_name();
            entries
                .map(|entry| name(entry).to_string_lossy().into_owned())
                .collect()
        };
        let beside = list(self.root.path()).into_iter();
        let beside = beside.filter(|name| !["place", "words"].contains(&name.as_str()));
        let mut names = list(&self.folder());
        names.extend(beside.map(|name| format!("../{name}")));
        names.sort();
        names
    }
}
