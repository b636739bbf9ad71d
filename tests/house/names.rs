//! A type's name has one meaning: no two files define a type of one name.

use std::collections::{BTreeMap, BTreeSet};

use super::{sources, without_comments};

/// Types that code defines outside of its tests; associated types are their traits'.
fn types(code: &str) -> Vec<String> {
    let code = code.split("#[cfg(test)]\nmod ").next().unwrap_or_default();
    let defined = |line: &str| {
        let mut words = line.split_whitespace();
        let mut word = words.next()?;
        if word.starts_with("pub") {
            word = words.next()?;
        }
        let own = match word {
            "struct" | "enum" | "trait" => true,
            "type" => !line.starts_with(' '),
            _ => false,
        };
        let name = words.next()?;
        let end = name
            .find(|c: char| !c.is_alphanumeric())
            .unwrap_or(name.len());
        own.then(|| name[..end].to_owned())
    };
    code.lines().filter_map(defined).collect()
}

/// Names that more than one of these files defines.
fn shared(files: &[(String, String)]) -> BTreeSet<String> {
    let mut places: BTreeMap<String, BTreeSet<&str>> = BTreeMap::new();
    for (path, text) in files {
        for name in types(&without_comments(text)) {
            places.entry(name).or_default().insert(path);
        }
    }
    let twice = places.into_iter().filter(|(_, files)| files.len() > 1);
    twice.map(|(name, _)| name).collect()
}

#[test]
fn no_name_gets_a_second_meaning() {
    assert_eq!(shared(&sources()), BTreeSet::new());
}

#[test]
fn a_second_meaning_is_found() {
    let file = |path: &str, text: &str| (path.to_owned(), text.to_owned());
    let files = [
        file(
            "src/one.rs",
            "pub(super) struct Film<T>(T);\ntype Row = u8;",
        ),
        file(
            "src/two.rs",
            "enum Film {}\nimpl A for B {\n    type Row = u8;\n}",
        ),
        file(
            "src/three.rs",
            "#[cfg(test)]\nmod tests {\n    struct Film;\n}\n// struct Row;",
        ),
    ];
    assert_eq!(shared(&files), BTreeSet::from(["Film".to_owned()]));
}
