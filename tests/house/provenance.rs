//! What the solver computes has a source: every header in `src/engine/solve` names an author's year, or says what is ours, or
//! of which file it is a part; every constant says what it is.

use super::sources;

const ROOM: &str = "src/engine/solve/";

/// The header: the lines of `//!` that a file opens with.
fn header(text: &str) -> String {
    let lines = text.lines().map_while(|line| line.strip_prefix("//!"));
    lines.collect::<Vec<_>>().join("\n")
}

/// A year after 1800, standing by itself.
fn has_year(text: &str) -> bool {
    let words = text.split(|c: char| !c.is_ascii_alphanumeric());
    words
        .filter(|word| word.len() == 4)
        .filter_map(|word| word.parse::<u32>().ok())
        .any(|year| (1800..2100).contains(&year))
}

/// Says where a file's equations come from.
fn is_grounded(header: &str, exists: &dyn Fn(&str) -> bool) -> bool {
    let after = |word: &str| header.split_once(word).map(|(_, after)| after);
    let published = after("Source").is_some_and(has_year);
    let ours = after("Ours: ").is_some_and(|reason| reason.len() > 30);
    let part = after("Part of `").and_then(|rest| rest.split('`').next());
    published || ours || part.is_some_and(exists)
}

/// Numbers that are given a name and no word of where they come from.
fn bare_constants(text: &str) -> Vec<String> {
    let code = text.split("#[cfg(test)]").next().unwrap_or_default();
    let lines: Vec<&str> = code.lines().map(str::trim).collect();
    let is_bare = |at: usize| {
        let line = lines[at];
        let Some((_, rest)) = line.split_once("const ") else {
            return false;
        };
        let Some((left, value)) = rest.split_once(" = ") else {
            return false;
        };
        let number = ["f64", "f32", "u32", "usize"].map(|kind| format!(": {kind}"));
        let is_number = number.iter().any(|kind| left.ends_with(kind.as_str()))
            && value.starts_with(|c: char| c.is_ascii_digit());
        !line.starts_with("//") && is_number && !(at > 0 && lines[at - 1].starts_with("//"))
    };
    let bare = (0..lines.len()).filter(|at| is_bare(*at));
    bare.map(|at| lines[at].to_owned()).collect()
}

#[test]
fn every_header_has_a_source_and_every_constant_a_word() {
    let all = sources();
    let exists = |name: &str| all.iter().any(|(path, _)| *path == format!("{ROOM}{name}"));
    let room: Vec<_> = all
        .iter()
        .filter(|(path, _)| path.starts_with(ROOM))
        .collect();
    assert!(room.len() > 40, "only {} files were found", room.len());
    let mut found = Vec::new();
    for (path, text) in room {
        if !is_grounded(&header(text), &exists) {
            found.push(format!("{path}: no source, no \"Ours: \", no \"Part of\""));
        }
        found.extend(
            bare_constants(text)
                .into_iter()
                .map(|line| format!("{path}: {line}")),
        );
    }
    assert!(found.is_empty(), "\n{}", found.join("\n"));
}

#[test]
fn what_has_no_source_is_found() {
    let exists = |name: &str| name == "there.rs";
    for (text, grounded) in [
        ("//! Film.\n//!\n//! Source: Love (1929).\nfn f() {}", true),
        ("//! Film.\n//! Sources: Love, of old.\n", false),
        ("//! Of 1929.\n// Source: Love (1929)\n", false),
        ("//! Ours: the mean of two steps, by symmetry.\n", true),
        ("//! Ours: so.\n", false),
        ("//! Part of `there.rs`.\n", true),
        ("//! Part of `elsewhere.rs`.\n", false),
    ] {
        assert_eq!(is_grounded(&header(text), &exists), grounded, "{text}");
    }
    let text = "/// Told.\nconst A: f64 = 1.0;\n\nconst B: usize = 3;\nconst C: &str = \"\";\n#[cfg(test)]\nconst D: u32 = 1;";
    assert_eq!(bare_constants(text), ["const B: usize = 3;"]);
}
