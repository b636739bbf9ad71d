//! The floors of the house: imports go downward only, foreign crates stay in their room, files stay short.
#![expect(clippy::unwrap_used, reason = "tests")]

mod circles;
mod features;
mod guide;
mod names;
mod provenance;

use std::path::Path;

/// From the cellar to the roof. A file may import its own floor and those before it.
const FLOORS: [&str; 15] = [
    "files", "math", "physics", "scene", "plan", "solve", "sim", "picture", "observe", "run",
    "sweep", "study", "tui", "web", "cli",
];
/// Crates and the only folders that may name them.
const ROOMS: [(&str, &[&str]); 4] = [
    ("rerun", &["src/observe/rerun"]),
    ("re_log_types", &["src/observe/rerun"]),
    ("ratatui", &["src/tui", "src/web"]),
    ("crossterm", &["src/tui/terminal"]),
];
/// Lines of a file before its test module.
const LONGEST_FILE: usize = 400;

/// What is wrong with a file of that path.
fn violations(path: &str, text: &str) -> Vec<String> {
    let code = without_comments(text);
    let mut found = Vec::new();
    if let Some(own) = floor_of(path) {
        for name in imported(&code) {
            match FLOORS.iter().position(|floor| *floor == name) {
                Some(floor) if floor > own => {
                    found.push(format!("{path} ({}) imports {name}", FLOORS[own]));
                }
                _ => {}
            }
        }
    }
    for (name, rooms) in ROOMS {
        let is_inside = rooms.iter().any(|room| path.starts_with(room));
        if !is_inside && names_crate(&code, name) {
            found.push(format!("{path} names {name}, which belongs to {rooms:?}"));
        }
    }
    let before_tests = text
        .lines()
        .take_while(|line| !line.starts_with("#[cfg(test)]"))
        .count();
    if before_tests > LONGEST_FILE {
        found.push(format!("{path} has {before_tests} lines"));
    }
    let body = code.split("#[cfg(test)]").next().unwrap_or("");
    for printing in ["println!", "print!", "dbg!"] {
        // The build script talks to Cargo by printing.
        if body.contains(printing) && path != "src/build.rs" {
            found.push(format!("{path} prints with {printing}"));
        }
    }
    found
}

/// The floor of a file; `None` for the root of the library, which names all of them.
fn floor_of(path: &str) -> Option<usize> {
    let name = path.strip_prefix("src/")?.split(['/', '.']).next()?;
    let name = if name == "main" { "cli" } else { name };
    FLOORS.iter().position(|floor| *floor == name)
}

fn without_comments(text: &str) -> String {
    let lines = text
        .lines()
        .map(|line| line.split("//").next().unwrap_or(""));
    lines.collect::<Vec<_>>().join("\n")
}

/// First names after `crate::` and `asperity::`, those in braces too.
fn imported(code: &str) -> Vec<String> {
    let mut names = Vec::new();
    for root in ["crate::", "asperity::"] {
        for (at, _) in code.match_indices(root) {
            let is_whole = !code[..at].ends_with(is_word);
            if !is_whole {
                continue;
            }
            let rest = &code[at + root.len()..];
            if let Some(group) = rest.strip_prefix('{') {
                names.extend(first_names_in_group(group));
            } else {
                names.push(word(rest));
            }
        }
    }
    names
}

/// `a, b::{c, d}, e}` gives a, b, e.
fn first_names_in_group(group: &str) -> Vec<String> {
    let mut names = Vec::new();
    let mut depth = 0;
    let mut starts = true;
    for (at, c) in group.char_indices() {
        match c {
            '{' => depth += 1,
            '}' if depth == 0 => break,
            '}' => depth -= 1,
            ',' if depth == 0 => starts = true,
            c if starts && depth == 0 && is_word(c) => {
                names.push(word(&group[at..]));
                starts = false;
            }
            _ => {}
        }
    }
    names
}

fn word(text: &str) -> String {
    text.chars().take_while(|c| is_word(*c)).collect()
}

fn is_word(c: char) -> bool {
    c.is_alphanumeric() || c == '_'
}

/// Whether a path begins with that crate: `name::...` or `use name`.
fn names_crate(code: &str, name: &str) -> bool {
    code.match_indices(name).any(|(at, _)| {
        let (before, after) = (&code[..at], &code[at + name.len()..]);
        let begins = !before.ends_with(is_word) && !before.ends_with("::");
        let leads = after.starts_with("::");
        let used = before.trim_end().ends_with("use") && !after.starts_with(is_word);
        begins && (leads || used)
    })
}

fn all_files(folder: &Path, found: &mut Vec<std::path::PathBuf>) {
    let mut entries: Vec<_> = std::fs::read_dir(folder)
        .unwrap()
        .map(|entry| entry.unwrap().path())
        .collect();
    entries.sort();
    for path in entries {
        if path.is_dir() {
            all_files(&path, found);
        } else if path.extension().is_some_and(|extension| extension == "rs") {
            found.push(path);
        }
    }
}

/// Paths and texts of all sources.
fn sources() -> Vec<(String, String)> {
    let root = Path::new(env!("CARGO_MANIFEST_DIR"));
    let mut files = Vec::new();
    all_files(&root.join("src"), &mut files);
    assert!(files.len() > 20, "only {} files were found", files.len());
    let read = |file: &std::path::PathBuf| {
        let path = file.strip_prefix(root).unwrap();
        let path = path.to_str().unwrap().replace('\\', "/");
        (path, std::fs::read_to_string(file).unwrap())
    };
    files.iter().map(read).collect()
}

#[test]
fn the_house_stands() {
    let mut found = Vec::new();
    for (path, text) in sources() {
        found.extend(violations(&path, &text));
    }
    assert!(found.is_empty(), "\n{}", found.join("\n"));
}

#[test]
fn planted_faults_are_found() {
    let upward = [
        ("src/math/grid.rs", "use crate::physics::hertz::Hertz;"),
        (
            "src/scene/model.rs",
            "fn f() { crate::sim::Knob::ALL.len(); }",
        ),
        (
            "src/solve/film.rs",
            "use crate::{math::root, observe::Latest};",
        ),
        (
            "src/plan/mod.rs",
            "use crate::{\n    math::{root, elliptic},\n    solve,\n};",
        ),
        ("src/run/mod.rs", "pub use crate::tui::explore;"),
    ];
    for (path, text) in upward {
        let found = violations(path, text);
        assert_eq!(found.len(), 1, "{path}: {text}: {found:?}");
        assert!(found[0].contains("imports"), "{found:?}");
    }
    let foreign = [
        ("src/observe/table.rs", "use rerun::RecordingStream;"),
        ("src/cli/mod.rs", "fn f() { ratatui::init(); }"),
        ("src/main.rs", "use crossterm;"),
        ("src/tui/view/mod.rs", "use crossterm::event;"),
    ];
    for (path, text) in foreign {
        let found = violations(path, text);
        assert_eq!(found.len(), 1, "{path}: {text}: {found:?}");
        assert!(found[0].contains("belongs to"), "{found:?}");
    }
    let long = "fn f() {}\n".repeat(LONGEST_FILE + 1);
    assert_eq!(violations("src/math/grid.rs", &long).len(), 1);
    assert_eq!(
        violations("src/math/grid.rs", "fn f() { println!(); }").len(),
        1
    );
}

#[test]
fn what_is_allowed_passes() {
    let tested = format!("{}#[cfg(test)]\n{}", "\n".repeat(300), "\n".repeat(300));
    for (path, text) in [
        (
            "src/sim/step.rs",
            "use crate::scene::Scene;\nuse crate::sim::Frame;",
        ),
        (
            "src/sim/step.rs",
            "// see crate::tui::explore\nuse super::Frame;",
        ),
        ("src/lib.rs", "pub use crate::tui::explore;"),
        ("src/observe/rerun/stream.rs", "use rerun::RecordingStream;"),
        (
            "src/cli/outputs.rs",
            "use asperity::observe::rerun::Recorder;",
        ),
        ("src/tui/mod.rs", "use ratatui::layout::Rect;"),
        ("src/math/grid.rs", tested.as_str()),
    ] {
        assert_eq!(violations(path, text), Vec::<String>::new(), "{text}");
    }
}
