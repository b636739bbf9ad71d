//! The tests ask nothing else of the program's dependencies: `cargo test` after `cargo build` compiles none again. Nor do scripts
//! that build the recorder's crates ask anything else of those that both need and that take long.

use std::collections::BTreeSet;
use std::process::Command;

/// Every package that Cargo would build, with its version and features.
fn packages(edges: &str) -> BTreeSet<String> {
    let cargo = std::env::var_os("CARGO").unwrap_or_else(|| "cargo".into());
    let output = Command::new(cargo)
        .args(["tree", "--locked", "--offline", "--prefix", "none"])
        .args(["--format", "{p}: {f}", "--edges", edges])
        .current_dir(env!("CARGO_MANIFEST_DIR"))
        .output()
        .unwrap();
    let messages = String::from_utf8_lossy(&output.stderr);
    assert!(output.status.success(), "{messages}");
    let lines = String::from_utf8(output.stdout).unwrap();
    let packages = lines.lines().map(|line| line.trim_end_matches(" (*)"));
    packages.map(str::to_owned).collect()
}

#[test]
fn tests_compile_no_dependency_again() {
    let (program, tests) = (packages("normal"), packages("normal,dev"));
    assert!(program.len() > 50 && tests.len() > program.len());
    let others: Vec<&String> = program.difference(&tests).collect();
    assert!(
        others.is_empty(),
        "built with other features by the tests: {others:#?}"
    );
}

#[test]
fn build_scripts_compile_no_listed_dependency_again() {
    let manifest = include_str!("../../Cargo.toml");
    let manifest: toml::Table = manifest.parse().unwrap();
    let listed = manifest["build-dependencies"].as_table().unwrap();
    let packages = packages("normal,build");
    for name in listed.keys() {
        let start = format!("{name} v");
        let built: Vec<&String> = packages.iter().filter(|p| p.starts_with(&start)).collect();
        assert_eq!(built.len(), 1, "built more than once: {built:#?}");
    }
}
