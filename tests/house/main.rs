//! How the house is kept where the compiler does not: functions that fit on a screen, no printing below the command line,
//! guide and sources that agree. What may import what is said by the crates.
#![expect(clippy::unwrap_used, reason = "tests")]

mod features;
mod guide;
mod provenance;

use std::path::Path;

/// Lines that a function may have.
const LONGEST_FUNCTION: usize = 80;

/// Functions of more than [`LONGEST_FUNCTION`] lines: from the line of their `fn` to the brace that closes it, as `rustfmt`
/// sets them.
fn long_functions(text: &str) -> Vec<String> {
    let lines: Vec<&str> = text.lines().collect();
    let mut found = Vec::new();
    for (at, line) in lines.iter().enumerate() {
        let code = line.trim_start();
        let indent = &line[..line.len() - code.len()];
        let starts = [
            "fn ",
            "pub fn ",
            "pub(crate) fn ",
            "pub(super) fn ",
            "const fn ",
            "pub const fn ",
        ];
        if !starts.iter().any(|start| code.starts_with(start)) {
            continue;
        }
        let close = format!("{indent}}}");
        let length = lines[at..]
            .iter()
            .position(|line| *line == close)
            .unwrap_or(0);
        if length >= LONGEST_FUNCTION {
            found.push(format!(
                "{} has {} lines",
                code.trim_end_matches(" {"),
                length + 1
            ));
        }
    }
    found
}

fn without_comments(text: &str) -> String {
    let lines = text
        .lines()
        .map(|line| line.split("//").next().unwrap_or(""));
    lines.collect::<Vec<_>>().join("\n")
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
fn functions_fit_on_a_screen() {
    let all = sources();
    let found = all.iter().flat_map(|(path, text)| {
        let long = long_functions(text);
        long.into_iter().map(move |one| format!("{path}: {one}"))
    });
    assert_eq!(found.collect::<Vec<_>>(), Vec::<String>::new());
    let long = format!(
        "    pub fn f() {{\n{}    }}\n",
        "        g();\n".repeat(LONGEST_FUNCTION)
    );
    assert_eq!(long_functions(&long).len(), 1);
    assert_eq!(long_functions("fn f() {\n    g();\n}\n").len(), 0);
}

#[test]
fn only_the_command_line_prints() {
    for (path, text) in sources() {
        let code = without_comments(&text);
        let code = code.split("#[cfg(test)]").next().unwrap_or_default();
        // The build script talks to Cargo by printing.
        let may = path.ends_with("/build.rs") || path.starts_with("src/cli/");
        for printing in ["println!", "print!", "dbg!"] {
            assert!(
                may || !code.contains(printing),
                "{path} prints with {printing}"
            );
        }
    }
}
