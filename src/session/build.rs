//! Gives the program the identity of its engine: FNV-1a of the sources that results depend on, of the locked
//! dependencies, the compiler and the target. No time, no path, no name of a machine: the same sources and tools give
//! the same program. FNV stands here in four lines: with the crate the script would have to wait for it.

use std::path::{Path, PathBuf};
use std::process::Command;

/// What results depend on: the engine, the loop of a run, the sweeps, and what they are made with.
const SOURCES: [&str; 4] = ["../../Cargo.lock", "../engine", "run", "sweep"];
/// What stands among it and changes no number.
const BESIDE: [&str; 2] = ["../engine/README.md", "../engine/examples"];

fn main() {
    println!("cargo::rerun-if-changed=build.rs");
    let mut files = Vec::new();
    for source in SOURCES {
        println!("cargo::rerun-if-changed={source}");
        gather(Path::new(source), &mut files);
    }
    files.sort();
    let mut hash = 0xcbf2_9ce4_8422_2325_u64;
    let mut take = |bytes: &[u8]| {
        for &byte in bytes.iter().filter(|byte| **byte != b'\r') {
            hash = (hash ^ u64::from(byte)).wrapping_mul(0x0100_0000_01b3);
        }
    };
    for file in files {
        // Names with slashes, so that every system gives the same.
        let name = file.to_string_lossy().replace('\\', "/");
        take(name.as_bytes());
        take(&std::fs::read(&file).unwrap_or_default());
    }
    take(&compiler());
    take(std::env::var("TARGET").unwrap_or_default().as_bytes());
    println!("cargo::rustc-env=ASPERITY_BUILD={hash:016x}");
}

/// What the compiler calls itself.
fn compiler() -> Vec<u8> {
    let name = std::env::var_os("RUSTC").unwrap_or_else(|| "rustc".into());
    let output = Command::new(name).arg("--version").output();
    output.map(|output| output.stdout).unwrap_or_default()
}

/// All files at or below a path, but what is beside.
fn gather(path: &Path, files: &mut Vec<PathBuf>) {
    if BESIDE.iter().any(|beside| Path::new(beside) == path) {
        return;
    }
    if !path.is_dir() {
        files.push(path.to_owned());
        return;
    }
    for entry in std::fs::read_dir(path).into_iter().flatten().flatten() {
        gather(&entry.path(), files);
    }
}
