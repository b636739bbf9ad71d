//! How the house is kept where the compiler does not: functions that fit on a screen, no printing below the command line,
//! guide and sources that agree. What may import what is said by the crates.
#![expect(clippy::unwrap_used, reason = "tests")]

mod features;
mod guide;
mod provenance;

use std::path::{Path, PathBuf};

/// Lines that a function may have.
const LONGEST_FUNCTION: usize = 80;

fn rust_files(folder: &Path, found: &mut Vec<PathBuf>) {
    for entry in std::fs::read_dir(folder).unwrap() {
        let path = entry.unwrap().path();
        if path.is_dir() {
            rust_files(&path, found);
        } else if path.extension().is_some_and(|extension| extension == "rs") {
            found.push(path);
        }
    }
}

/// Paths, from the top and with slashes, and texts of all sources.
fn sources() -> Vec<(String, String)> {
    let root = Path::new(env!("CARGO_MANIFEST_DIR"));
    let mut files = Vec::new();
    rust_files(&root.join("src"), &mut files);
    files.sort();
    let read = |file: &PathBuf| {
        let path = file.strip_prefix(root).unwrap().to_str().unwrap();
        let text = std::fs::read_to_string(file).unwrap();
        (path.replace('\\', "/"), text)
    };
    files.iter().map(read).collect()
}

/// From the line of `fn` to the brace that closes it, as `rustfmt` sets them.
#[test]
fn functions_fit_on_a_screen() {
    let mut functions = 0;
    for (path, text) in sources() {
        let lines: Vec<&str> = text.lines().collect();
        for (at, line) in lines.iter().enumerate() {
            let code = line.trim_start();
            if !(code.starts_with("fn ") || code.starts_with("pub") && code.contains(" fn ")) {
                continue;
            }
            let close = format!("{}}}", &line[..line.len() - code.len()]);
            let end = lines[at..].iter().position(|line| *line == close);
            let length = end.unwrap_or(0) + 1;
            assert!(length <= LONGEST_FUNCTION, "{path}: {code} {length} lines");
            functions += 1;
        }
    }
    assert!(functions > 1000, "{functions}");
}

#[test]
fn only_the_command_line_prints() {
    for (path, text) in sources() {
        let code = text.split("#[cfg(test)]").next().unwrap_or_default();
        let mut lines = code.lines().map(|line| line.split("//").next().unwrap());
        let prints = lines.any(|line| line.contains("print!(") || line.contains("println!("));
        // The build script talks to Cargo by printing; examples are programs.
        let may = ["/build.rs", "src/cli/", "/examples/"];
        assert!(
            !prints || may.iter().any(|part| path.contains(part)),
            "{path}"
        );
    }
}
