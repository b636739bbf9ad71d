//! A wall clock that jumps by years at every reading: what is kept is what it is under one that goes.

use std::path::{Path, PathBuf};
use std::process::Command;

use asperity_recorder::Recorded;
use re_chunk::Chunk;
use re_log_encoding::DecoderApp;
use rerun::external::re_log_types::LogMsg;

use super::child::Place;
use super::faults::{Faults, all_outputs, args, lost, put_mine, refs};

const SWEEP: &str = include_str!("../cluster/tiny.toml");

/// The clock, as a library that is loaded before all others; `None`: there is no C compiler.
fn clock(folder: &Path) -> Option<PathBuf> {
    let (source, library) = (folder.join("clock.c"), folder.join("clock.so"));
    std::fs::write(&source, include_str!("clock.c")).unwrap();
    let made = Command::new("cc")
        .args(["-shared", "-fPIC", "-o"])
        .args([&library, &source])
        .arg("-ldl")
        .status();
    match made {
        Err(error) if error.kind() == std::io::ErrorKind::NotFound => None,
        made => {
            assert!(made.unwrap().success());
            Some(library)
        }
    }
}

/// What a recording holds but its layout, whose parts have names of chance.
fn chunks(path: &Path) -> Vec<Chunk> {
    let file = std::io::BufReader::new(std::fs::File::open(path).unwrap());
    let messages = DecoderApp::decode_eager(file).unwrap().map(Result::unwrap);
    let data = messages.filter_map(|message| match message {
        LogMsg::ArrowMsg(store, data) if !store.is_blueprint() => {
            Some(Chunk::from_arrow_msg(&data).unwrap())
        }
        _ => None,
    });
    let mut data: Vec<Chunk> = data.collect();
    // How many rows are sent at once, and so what comes first, is the clock's affair.
    data.sort_by_cached_key(|chunk| {
        let mut columns: Vec<String> = chunk
            .components_identifiers()
            .map(|column| column.to_string())
            .collect();
        columns.sort();
        (chunk.entity_path().to_string(), columns, chunk.num_rows())
    });
    data
}

/// Where two recordings differ.
fn difference(one: &Path, other: &Path) -> Option<String> {
    let [one, other] = [one, other].map(chunks);
    if one.len() != other.len() {
        return Some(format!("{} and {} chunks", one.len(), other.len()));
    }
    let mut pairs = one.iter().zip(&other);
    pairs.find_map(|(one, other)| {
        // What is not known is no number, which is similar to nothing, not even to itself: such rows are compared by bits.
        let is_same = one.components() == other.components()
            && one.timelines().iter().all(|(name, column)| {
                name.as_str() == "log_time" || other.timelines().get(name) == Some(column)
            });
        if is_same {
            return None;
        }
        let error = Chunk::ensure_similar(one, other).err()?;
        Some(format!("{}: {error}", one.entity_path()))
    })
}

/// The lines of a summary that no clock has made.
fn timeless(path: &Path) -> String {
    let text = std::fs::read_to_string(path).unwrap();
    let lines = text.lines().filter(|line| {
        let clocked = ["wall_s", "steps_per_s"];
        !clocked.iter().any(|key| line.contains(key))
    });
    lines.collect::<Vec<_>>().join("\n")
}

impl Faults {
    /// Under a clock that jumps, run, state, export and sweep leave what they leave under one that goes.
    pub(super) fn clock_jumps(&mut self) {
        let place = Place::new();
        let Some(jumping) = clock(&place.words()) else {
            self.judge("clock jumps: not tried, as there is no cc", None);
            return;
        };
        let jumping = format!("export LD_PRELOAD={}", jumping.display());
        let at = |name: &str| place.folder().join(name);
        let read = |name: &str| std::fs::read(at(name)).ok();
        for (name, limit) in [("a", "true"), ("b", jumping.as_str())] {
            let more = [
                format!("--out={name}.rrd"),
                format!("--table={name}.csv"),
                format!("--summary={name}.json"),
                format!("--save-state={name}.state"),
                format!("--export={name}"),
            ];
            let ended = place.run(limit, &refs(&args("0.5", &more)));
            self.judge("clock jumps: run", self.met(&ended, &[0, 2]));
            let out = format!("--out=sweep-{name}");
            place.put("tiny.toml", SWEEP.replace("n = 16", "n = 4").as_bytes());
            let ended = place.run(limit, &["sweep", "tiny.toml", "--threads=1", &out]);
            self.judge("clock jumps: sweep", self.met(&ended, &[0, 2]));
        }
        for [a, b] in [
            ["a.csv", "b.csv"],
            ["a.state", "b.state"],
            ["a/step_000016.npz", "b/step_000016.npz"],
            ["sweep-a/table.csv", "sweep-b/table.csv"],
            ["sweep-a/sweep.digest", "sweep-b/sweep.digest"],
        ] {
            let same = read(a).is_some() && read(a) == read(b);
            self.judge(
                "clock jumps: same bytes",
                (!same).then(|| format!("{b} differs")),
            );
        }
        let same = timeless(&at("a.json")) == timeless(&at("b.json"));
        self.judge(
            "clock jumps: summary",
            (!same).then(|| "b.json differs".to_owned()),
        );
        self.judge(
            "clock jumps: recording",
            difference(&at("a.rrd"), &at("b.rrd")),
        );
        self.before_1970(&jumping);
        #[cfg(feature = "tui")]
        self.clock_jumps_in_the_explorer(&jumping);
    }

    /// Where no recording can begin a run is refused in words, and what was there stays.
    fn before_1970(&mut self, jumping: &str) {
        let place = Place::new();
        put_mine(&place);
        let more = [all_outputs(), vec!["--force".to_owned()]].concat();
        let limit = format!("export BEFORE_1970=1; {jumping}");
        let ended = place.run(&limit, &refs(&args("0.1", &more)));
        self.judge(
            "clock before 1970",
            self.met(&ended, &[4]).or_else(|| lost(&place)),
        );
    }

    /// The explorer hears keys and leaves a recording that is whole.
    #[cfg(feature = "tui")]
    fn clock_jumps_in_the_explorer(&mut self, jumping: &str) {
        use std::time::Duration;
        let library = jumping.split_once("LD_PRELOAD=").unwrap().1;
        let program = super::child::program();
        let mut terminal = super::pty::Terminal::open(&program, &[]);
        let small = "--threads 1 --set grid.nodes=65 --set stress.depths=8 --out live.rrd";
        terminal.explore(&format!(
            "LD_PRELOAD={library} \"$ASPERITY\" explore {small}; echo code=$?"
        ));
        terminal.see("S slide-to-roll");
        for _ in 0..10 {
            terminal.press("\x1b[C");
            std::thread::sleep(Duration::from_millis(100));
        }
        let path = terminal.folder.path().join("live.rrd");
        let began = std::time::Instant::now();
        while !Recorded::read(&path).is_ok_and(|run| !run.turns.is_empty())
            && began.elapsed() < super::pty::PATIENCE
        {
            std::thread::sleep(Duration::from_millis(100));
        }
        terminal.press("q");
        terminal.see("code=0");
        let run = Recorded::read(&path);
        let whole = run
            .as_ref()
            .is_ok_and(|run| run.broken_off.is_none() && !run.turns.is_empty());
        self.judge(
            "clock jumps: explorer",
            (!whole).then(|| format!("{run:?}")),
        );
    }
}
