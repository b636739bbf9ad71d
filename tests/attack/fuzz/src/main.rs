//! The parsers, one after the other byte by byte, led by what of the program each input reaches.
//!
//! `ASPERITY_FUZZ` names the parser; the rest is libFuzzer's command line. See `fuzz.sh`, which is what to call.
#![no_main]

use std::path::PathBuf;
use std::sync::OnceLock;

use asperity_recorder::Recorded;
use asperity_engine::plan::Plan;
use asperity_session::run::Checkpoint;
use asperity_engine::scene::{Override, Scene};
use asperity_engine::sim::Simulation;
use asperity_session::sweep::Sweep;
use libfuzzer_sys::fuzz_target;

#[path = "../../forged.rs"]
mod forged;

/// Nodes per side of what is made a simulation of.
const FEW: usize = 33;

/// A parser, and what it reads from.
struct Parser {
    take: fn(&[u8], &PathBuf),
    folder: PathBuf,
}

fn parser() -> &'static Parser {
    static PARSER: OnceLock<Parser> = OnceLock::new();
    PARSER.get_or_init(|| {
        let kind = std::env::var("ASPERITY_FUZZ").unwrap_or_default();
        let take = match kind.as_str() {
            "scene" => scene,
            "set" => set,
            "sweep" => sweep,
            "csv" => csv,
            "npy" => npy,
            "state" => state,
            "recording" => recording,
            "notes" => notes,
            other => panic!("ASPERITY_FUZZ={other}: no such parser"),
        };
        let folder = std::env::temp_dir().join(format!("asperity-fuzz-{}", std::process::id()));
        std::fs::create_dir_all(&folder).expect("a folder");
        Parser { take, folder }
    })
}

fuzz_target!(|data: &[u8]| {
    let parser = parser();
    (parser.take)(data, &parser.folder);
});

fn planned(scene: &Scene) {
    if let Ok(plan) = Plan::new(scene) {
        assert!(!plan.to_string().contains("NaN"), "{plan}");
    }
}

fn scene(data: &[u8], _: &PathBuf) {
    let Ok(text) = std::str::from_utf8(data) else {
        return;
    };
    match Scene::from_toml(text) {
        Ok(scene) => {
            let again = Scene::from_toml(&scene.to_toml()).expect("what it writes it reads");
            assert!(again == scene, "what it writes is what it read");
            planned(&scene);
        }
        Err(error) => drop(error.to_string()),
    }
}

/// `--set`, a line each.
fn set(data: &[u8], _: &PathBuf) {
    let Ok(text) = std::str::from_utf8(data) else {
        return;
    };
    let sets: Result<Vec<Override>, _> = text.lines().map(str::parse).collect();
    let scene = sets.and_then(|sets| Scene::load_with("demonstration", &sets));
    match scene {
        Ok(scene) => planned(&scene),
        Err(error) => drop(error.to_string()),
    }
}

fn sweep(data: &[u8], folder: &PathBuf) {
    let Ok(text) = std::str::from_utf8(data) else {
        return;
    };
    match Sweep::parse(text, "fuzz", folder) {
        Ok(sweep) => {
            for case in [0, sweep.len() / 2, sweep.len() - 1] {
                match sweep.scene(case) {
                    Ok(scene) => planned(&scene),
                    Err(error) => drop(error.to_string()),
                }
            }
        }
        Err(error) => drop(error.to_string()),
    }
}

fn map(data: &[u8], folder: &PathBuf, name: &str) {
    let file = folder.join(name);
    std::fs::write(&file, data).expect("written");
    let sets = [
        "body_2.surface.kind=height_map".to_owned(),
        format!("body_2.surface.file={}", file.display()),
        "body_2.surface.pixel_m=4e-4".to_owned(),
        "body_2.surface.unit_m=1e-9".to_owned(),
    ];
    let sets: Vec<Override> = sets.iter().map(|set| set.parse().expect("a key")).collect();
    match Scene::load_with("demonstration", &sets) {
        Ok(scene) => planned(&scene),
        Err(error) => drop(error.to_string()),
    }
}

fn csv(data: &[u8], folder: &PathBuf) {
    map(data, folder, "map.csv");
}

fn npy(data: &[u8], folder: &PathBuf) {
    map(data, folder, "map.npy");
}

/// What stands behind the digest of a saved state, given to a run of the scene that it names, or of a small one.
fn state(data: &[u8], _: &PathBuf) {
    let Ok(saved) = serde_json::from_slice::<Checkpoint>(data) else {
        return;
    };
    let Ok(scene) = Scene::from_toml(&saved.scene) else {
        return;
    };
    if scene.grid.nodes > FEW || saved.fits(&scene).is_err() {
        return;
    }
    let Ok(plan) = Plan::new(&scene) else {
        return;
    };
    let Ok(mut sim) = Simulation::new(&scene, plan, 1) else {
        return;
    };
    if let Err(error) = sim.restore(&saved.sim) {
        drop(error.to_string());
        return;
    }
    drop(sim.step());
    assert!(!format!("{:?}", sim.summary()).contains("NaN"), "a NaN leaves it");
}

fn reread(bytes: &[u8], folder: &PathBuf) {
    let file = folder.join("run.rrd");
    std::fs::write(&file, bytes).expect("written");
    match Recorded::read(&file) {
        Ok(run) => drop(Scene::from_toml(&run.scene_toml)),
        Err(error) => drop(error.to_string()),
    }
}

fn recording(data: &[u8], folder: &PathBuf) {
    reread(data, folder);
}

/// Notes of a recording, a line each, their digests right.
fn notes(data: &[u8], folder: &PathBuf) {
    let bytes = forged::forged_recording(data.split(|byte| *byte == b'\n'));
    reread(&bytes, folder);
}
