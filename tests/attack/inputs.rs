//! Hostile inputs of every kind that the program reads.

use std::ops::Range;
use std::path::Path;
use std::time::Instant;

use asperity_engine::scene::{Scene, presets};

use super::child::{Ended, MEMORY, Place};
use super::forged::forged_recording;
use super::mutate::{self, Random};
use super::report::Tally;

/// A contact that is done in a moment.
pub(crate) const SMALL: [&str; 8] = [
    "run",
    "demonstration_quick",
    "--set=grid.nodes=33",
    "--set=body_1.surface.kind=smooth",
    "--set=body_2.surface.kind=smooth",
    "--set=stress.depths=8",
    "--set=numerics.error_estimate=none",
    "--threads=1",
];
/// Two cases of it.
const SWEEP: &str = "scene = \"demonstration\"\n[set]\ngrid.nodes = 33\nbody_1.surface.kind = \"smooth\"\n\
                     body_2.surface.kind = \"smooth\"\nstress.depths = 8\nlife = \"none\"\n[vary]\n\
                     motion.slide_roll = [0.0, 0.5]\n[chain]\npassages = 0.25\n";

/// Seeds of all kinds.
pub(crate) struct Arsenal {
    scenes: Vec<String>,
    sweeps: Vec<String>,
    maps: Vec<(&'static str, Vec<u8>)>,
    state: Vec<u8>,
    recording: Vec<u8>,
    folder: Vec<(String, Vec<u8>)>,
}

/// Somebody's findings: files of that ending.
fn corpus(ending: &str) -> Vec<String> {
    texts("tests/attack/corpus", ending)
}

fn texts(folder: &str, ending: &str) -> Vec<String> {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join(folder);
    let mut paths: Vec<_> = std::fs::read_dir(folder)
        .unwrap()
        .map(|entry| entry.unwrap().path())
        .filter(|path| path.to_string_lossy().ends_with(ending))
        .collect();
    paths.sort();
    let text = |path| String::from_utf8_lossy(&std::fs::read(path).unwrap()).into_owned();
    paths.into_iter().map(text).collect()
}

/// A matrix of doubles as numpy writes it.
fn npy(columns: usize, rows: usize) -> Vec<u8> {
    let mut header =
        format!("{{'descr': '<f8', 'fortran_order': False, 'shape': ({rows}, {columns}), }}");
    while (10 + header.len() + 1) % 64 != 0 {
        header.push(' ');
    }
    header.push('\n');
    let mut bytes = b"\x93NUMPY\x01\x00".to_vec();
    bytes.extend((header.len() as u16).to_le_bytes());
    bytes.extend(header.as_bytes());
    let height = |n: usize| 1e-7 * ((n % columns) as f64 * 0.8).cos();
    bytes.extend((0..columns * rows).flat_map(|n| height(n).to_le_bytes()));
    bytes
}

fn csv() -> Vec<u8> {
    let row = |j: usize| {
        let cells = (0..16).map(|i| format!("{}", (i * 7 + j * 3) % 11));
        cells.collect::<Vec<_>>().join(",")
    };
    let rows: Vec<String> = (0..16).map(row).collect();
    format!("# heights\n{}\n", rows.join("\n")).into_bytes()
}

/// All files below a folder.
fn files(root: &Path, below: &str, found: &mut Vec<(String, Vec<u8>)>) {
    let mut entries: Vec<_> = std::fs::read_dir(root.join(below))
        .unwrap()
        .map(|entry| entry.unwrap())
        .collect();
    entries.sort_by_key(std::fs::DirEntry::file_name);
    for entry in entries {
        let name = format!("{below}/{}", entry.file_name().to_string_lossy());
        if entry.path().is_dir() {
            files(root, &name, found);
        } else {
            found.push((name, std::fs::read(entry.path()).unwrap()));
        }
    }
}

/// Puts a height map there; the arguments that have it read.
pub(crate) fn map(ending: &str, bytes: &[u8], place: &Place) -> Vec<String> {
    let name = format!("map.{ending}");
    place.put(&name, bytes);
    let file = format!("--set=body_2.surface.file={name}");
    let own = [
        "check",
        "demonstration",
        "--set=body_2.surface.kind=height_map",
        "--set=body_2.surface.pixel_m=4e-4",
        "--set=body_2.surface.unit_m=1e-9",
        &file,
    ];
    own.map(str::to_owned).to_vec()
}

/// A saved state whose digest fits whatever it holds.
pub(crate) fn sealed_state(body: &str) -> Vec<u8> {
    let digest = asperity_engine::files::fnv(body.as_bytes());
    format!("asperity state 5 {digest:016x}\n{body}").into_bytes()
}

/// A case of a sweep with another value somewhere in it, its digest right.
fn hostile_case(random: &mut Random, bytes: &[u8]) -> Vec<u8> {
    let text = String::from_utf8_lossy(bytes);
    let (head, body) = text.split_once('\n').unwrap();
    let magic = head.rsplit_once(' ').unwrap().0;
    let mut value: serde_json::Value = serde_json::from_str(body).unwrap();
    for _ in 0..=random.below(3) {
        mutate::json(random, &mut value);
    }
    let body = value.to_string();
    let digest = asperity_engine::files::fnv(body.as_bytes());
    format!("{magic} {digest:016x}\n{body}\n").into_bytes()
}

fn hostile_toml(random: &mut Random, seeds: &[String]) -> Vec<u8> {
    let seed = &seeds[random.below(seeds.len())];
    let other = &seeds[random.below(seeds.len())];
    if random.below(3) == 0 {
        mutate::bytes(random, seed.as_bytes(), other.as_bytes())
    } else {
        mutate::toml(random, seed, other)
    }
}

impl Arsenal {
    pub(crate) fn new() -> Self {
        let mut scenes: Vec<String> = presets::listed()
            .map(|preset| Scene::load(preset.name).unwrap().to_toml())
            .collect();
        scenes.extend(corpus(".scene.toml"));
        let mut sweeps = texts("assets/sweeps", ".toml");
        sweeps.extend(corpus(".sweep.toml"));
        sweeps.push(SWEEP.to_owned());
        let place = Place::new();
        let done = |args: &[&str]| {
            let ended = place.run("true", args);
            assert!(matches!(ended.code(), Some(0 | 2)), "{args:?}: {ended:?}");
        };
        let outputs = ["--passages=0.05", "--save-state=in.state", "--out=in.rrd"];
        done(&[&SMALL[..], &outputs].concat());
        place.put("in.toml", SWEEP.as_bytes());
        done(&["sweep", "in.toml", "--out=folder", "--threads=1"]);
        let read = |name: &str| std::fs::read(place.folder().join(name)).unwrap();
        let mut folder = Vec::new();
        files(&place.folder(), "folder", &mut folder);
        let mut maps = vec![("csv", csv()), ("npy", npy(16, 16))];
        maps.extend(
            corpus(".csv")
                .into_iter()
                .map(|text| ("csv", text.into_bytes())),
        );
        Self {
            scenes,
            sweeps,
            maps,
            state: read("in.state"),
            recording: read("in.rrd"),
            folder,
        }
    }

    /// Gives the program those inputs, one after the other.
    pub(crate) fn attack(&self, kind: &str, numbers: Range<u64>) -> Tally {
        let mut tally = Tally::new(kind);
        for number in numbers {
            let began = Instant::now();
            let (ended, fault) = self.one(kind, &mut Random::new(kind, number));
            tally.slowest_s = tally.slowest_s.max(began.elapsed().as_secs_f64());
            tally.take(&ended);
            tally.failures.extend(fault.map(|fault| {
                format!("`ASPERITY_ATTACK={kind}:{number} cargo test --release --test attack hostile`: {fault}")
            }));
        }
        tally
    }

    /// How the program ended, and what is wrong with that.
    fn one(&self, kind: &str, random: &mut Random) -> (Ended, Option<String>) {
        let place = Place::new();
        let mut allowed = Vec::new();
        let (args, codes) = self.prepare(kind, random, &place, &mut allowed);
        let before = place.names();
        let args: Vec<&str> = args.iter().map(String::as_str).collect();
        let ended = place.run(MEMORY, &args);
        let fault = ended.fault(codes).or_else(|| {
            let names = place.names().into_iter();
            let new: Vec<String> = names
                .filter(|name| !before.contains(name) && !allowed.contains(&name.as_str()))
                .collect();
            (!new.is_empty()).then(|| format!("writes {new:?}"))
        });
        (ended, fault)
    }

    /// Puts the input there; arguments, and codes that are in the book for them.
    fn prepare(
        &self,
        kind: &str,
        random: &mut Random,
        place: &Place,
        allowed: &mut Vec<&'static str>,
    ) -> (Vec<String>, &'static [i32]) {
        let words = |args: &[&str]| args.iter().map(|arg| (*arg).to_owned()).collect();
        match kind {
            "scenes" => {
                place.put("in.toml", &hostile_toml(random, &self.scenes));
                (words(&["check", "in.toml"]), &[0, 1])
            }
            "sweeps" | "rides" => {
                place.put("in.toml", &hostile_toml(random, &self.sweeps));
                let show = if kind == "rides" { "ride" } else { "points" };
                (words(&["sweep", "in.toml", "--show", show]), &[0, 1])
            }
            "maps" => {
                let (ending, seed) = &self.maps[random.below(self.maps.len())];
                let other = &self.maps[random.below(self.maps.len())].1;
                let bytes = mutate::bytes(random, seed, other);
                (map(ending, &bytes, place), &[0, 1])
            }
            "states" => {
                place.put("in.state", &self.hostile_state(random));
                let more = ["--passages=0.1", "--no-record", "--from-state=in.state"];
                (words(&[&SMALL[..], &more].concat()), &[0, 1, 2, 3])
            }
            "recordings" => {
                place.put("in.rrd", &self.hostile_recording(random));
                let args = ["run", "--from=in.rrd", "--no-record", "--threads=1"];
                (words(&args), &[0, 1, 2, 3, 5])
            }
            "folders" | "collections" => {
                self.put_folder(random, place);
                place.put("in.toml", SWEEP.as_bytes());
                if kind == "folders" {
                    let args = [
                        "sweep",
                        "in.toml",
                        "--resume",
                        "--out=folder",
                        "--threads=1",
                    ];
                    return (words(&args), &[0, 1, 2, 3, 4]);
                }
                allowed.push("all");
                (
                    words(&["sweep", "collect", "folder", "--out=all"]),
                    &[0, 1, 2, 3, 4],
                )
            }
            _ => panic!("no kind of input: {kind}"),
        }
    }

    fn hostile_state(&self, random: &mut Random) -> Vec<u8> {
        if random.below(3) == 0 {
            return mutate::bytes(random, &self.state, &self.recording);
        }
        let text = String::from_utf8_lossy(&self.state);
        let body = text.split_once('\n').unwrap().1;
        if random.below(4) == 0 {
            let body = mutate::bytes(random, body.as_bytes(), b"[[[[[[[[{\"sim\":1e999");
            return sealed_state(&String::from_utf8_lossy(&body));
        }
        let mut value: serde_json::Value = serde_json::from_str(body).unwrap();
        for _ in 0..=random.below(3) {
            mutate::json(random, &mut value);
        }
        sealed_state(&value.to_string())
    }

    fn hostile_recording(&self, random: &mut Random) -> Vec<u8> {
        if random.below(4) > 0 {
            return mutate::bytes(random, &self.recording, &self.state);
        }
        let scene = mutate::toml(random, &self.scenes[0], &self.scenes[1]);
        let scene = if random.below(2) == 0 {
            "title = \"small\"\n".to_owned()
        } else {
            String::from_utf8_lossy(&scene).into_owned()
        };
        let steps = [0, 1, 1 << 40, 1 << 60, u64::MAX][random.below(5)];
        let turns = [0, 1, u64::MAX][random.below(3)];
        let notes = [
            serde_json::json!({"Origin": {"program": "\u{1b}[2J", "began": "from_scene", "scene_toml": scene}}),
            serde_json::json!({"Turn": {"n": 0, "steps_made": 3, "key": "motion.slide_roll", "value": 1e300, "by": "hand"}}),
            serde_json::json!({"Reach": {"last_step": steps, "turns": turns, "ended": random.below(2) == 0}}),
        ];
        let notes = notes.map(|note| note.to_string());
        forged_recording(notes.iter().map(String::as_bytes))
    }

    /// The folder of a finished sweep, one of its files damaged, missing or another one.
    fn put_folder(&self, random: &mut Random, place: &Place) {
        let cases = || {
            let names = self.folder.iter().enumerate();
            names.filter(|(_, (name, _))| name.contains("/cases/"))
        };
        let bad = match cases().nth(random.below(2 * cases().count())) {
            Some((case, _)) => case,
            None => random.below(self.folder.len()),
        };
        for (k, (name, bytes)) in self.folder.iter().enumerate() {
            let path = place.folder().join(name);
            std::fs::create_dir_all(path.parent().unwrap()).unwrap();
            let other = &self.folder[random.below(self.folder.len())].1;
            let is_case = name.contains("/cases/");
            let written = match random.below(6) {
                _ if k != bad => bytes.clone(),
                _ if is_case && random.below(2) == 0 => hostile_case(random, bytes),
                0 => continue,
                1 => other.clone(),
                2 => Vec::new(),
                _ => mutate::bytes(random, bytes, other),
            };
            std::fs::write(path, written).unwrap();
        }
    }
}
