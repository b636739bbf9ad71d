//! What the solver computes has a source: every header in `src/engine/solve` names an author's year, or says what is ours, or
//! of which file it is a part.

use super::sources;

const FOLDER: &str = "src/engine/solve/";

/// A year after 1800, standing by itself.
fn has_year(text: &str) -> bool {
    let mut words = text.split(|c: char| !c.is_ascii_alphanumeric());
    words.any(|word| word.len() == 4 && word.parse().is_ok_and(|year| (1800..2100).contains(&year)))
}

#[test]
fn every_header_has_a_source() {
    let all = sources();
    let solve = all.iter().filter(|(path, _)| path.starts_with(FOLDER));
    let mut files = 0;
    for (path, text) in solve {
        let lines = text.lines().map_while(|line| line.strip_prefix("//!"));
        let header = lines.collect::<Vec<_>>().join("\n");
        let after = |word: &str| header.split_once(word).map(|(_, after)| after);
        let is_published = after("Source").is_some_and(has_year);
        let is_ours = after("Ours: ").is_some_and(|reason| reason.len() > 30);
        let whole = after("Part of `").and_then(|rest| rest.split('`').next());
        let is_part = whole.is_some_and(|name| {
            let whole = format!("{FOLDER}{name}");
            all.iter().any(|(path, _)| *path == whole)
        });
        assert!(
            is_published || is_ours || is_part,
            "{path}: no source, no \"Ours: \", no \"Part of\""
        );
        files += 1;
    }
    assert!(files > 20, "only {files} files were found");
}
