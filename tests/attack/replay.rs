//! What coverage-guided fuzzing has found to reach something (`fuzz/`, `corpus/PARSER/`), given to the program.

use std::path::Path;
use std::time::Instant;

use super::child::{MEMORY, Place};
use super::forged::forged_recording;
use super::inputs::{self, SMALL};
use super::report::Tally;

/// Parsers, and the exit codes that are in the book for what they read.
const PARSERS: [(&str, &[i32]); 8] = [
    ("scene", &[0, 1]),
    ("set", &[0, 1]),
    ("sweep", &[0, 1]),
    ("csv", &[0, 1]),
    ("npy", &[0, 1]),
    ("state", &[0, 1, 2, 3]),
    ("recording", &[0, 1, 2, 3, 5]),
    ("notes", &[0, 1, 2, 3, 5]),
];

/// The scene that a state names, where it can be read.
fn scene_of(state: &[u8]) -> Option<String> {
    let value: serde_json::Value = serde_json::from_slice(state).ok()?;
    Some(value.get("scene")?.as_str()?.to_owned())
}

/// Puts an input there; the arguments.
fn prepare(parser: &str, bytes: &[u8], place: &Place) -> Vec<String> {
    let words = |args: &[&str]| args.iter().map(|arg| (*arg).to_owned()).collect();
    match parser {
        "scene" => {
            place.put("in.toml", bytes);
            words(&["check", "in.toml"])
        }
        "set" => {
            // The shell's own: no argument holds a zero.
            let text = String::from_utf8_lossy(bytes).replace('\0', " ");
            let sets = text.lines().map(|line| format!("--set={line}"));
            words(&["check", "demonstration"])
                .into_iter()
                .chain(sets)
                .collect()
        }
        "sweep" => {
            place.put("in.toml", bytes);
            words(&["sweep", "in.toml", "--show=points"])
        }
        "csv" | "npy" => inputs::map(parser, bytes, place),
        "state" => {
            place.put(
                "in.state",
                &inputs::sealed_state(&String::from_utf8_lossy(bytes)),
            );
            let more = ["--threads=1", "--no-record", "--from-state=in.state"];
            let Some(scene) = scene_of(bytes) else {
                return words(&[&SMALL[..], &more[1..]].concat());
            };
            place.put("in.toml", scene.as_bytes());
            words(&[&["run", "in.toml"], &more[..]].concat())
        }
        _ => {
            let recording = if parser == "notes" {
                forged_recording(bytes.split(|byte| *byte == b'\n'))
            } else {
                bytes.to_vec()
            };
            place.put("in.rrd", &recording);
            words(&["run", "--from=in.rrd", "--no-record", "--threads=1"])
        }
    }
}

/// All of them.
pub(crate) fn all() -> Vec<Tally> {
    PARSERS
        .iter()
        .map(|(parser, codes)| one(parser, codes))
        .collect()
}

fn one(parser: &str, codes: &[i32]) -> Tally {
    let mut tally = Tally::new(&format!("corpus/{parser}"));
    let folder = Path::new(env!("CARGO_MANIFEST_DIR"))
        .join("tests/attack/corpus")
        .join(parser);
    let mut paths: Vec<_> = std::fs::read_dir(folder)
        .unwrap()
        .map(|entry| entry.unwrap().path())
        .collect();
    paths.sort();
    for path in paths {
        let place = Place::new();
        let args = prepare(parser, &std::fs::read(&path).unwrap(), &place);
        let before = place.names();
        let began = Instant::now();
        let args: Vec<&str> = args.iter().map(String::as_str).collect();
        let ended = place.run(MEMORY, &args);
        tally.slowest_s = tally.slowest_s.max(began.elapsed().as_secs_f64());
        tally.take(&ended);
        let written = (place.names() != before).then(|| format!("writes {:?}", place.names()));
        let fault = ended.fault(codes).or(written);
        tally.failures.extend(fault.map(|fault| {
            format!(
                "`cargo test --release --test attack corpus`: {}: {fault}",
                path.display()
            )
        }));
    }
    tally
}
