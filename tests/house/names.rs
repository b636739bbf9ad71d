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

/// The rooms of equations, where the field's words hold.
const FIELD: [&str; 5] = [
    "src/math/",
    "src/physics/",
    "src/plan/",
    "src/solve/",
    "src/sim/",
];

/// Words of the glossary that names do not hold.
fn retired() -> Vec<String> {
    let glossary = super::guide::page("glossary.md");
    let (_, table) = glossary.split_once("| instead of | say |").unwrap();
    let rows = table.lines().filter_map(|line| line.strip_prefix("| "));
    let words = rows.filter_map(|row| Some(row.split_once(" | ")?.0));
    words
        .flat_map(|cell| cell.split(", ").map(str::to_owned))
        .collect()
}

/// Names of the code that hold one of the `words`; `at_rest` is a state of motion.
fn holding(words: &[String], text: &str) -> BTreeSet<String> {
    let code = without_comments(text);
    // Strings are text for people and names of files, raw ones first.
    let raw = code.split("r#\"").enumerate();
    let after = |(k, part): (usize, &str)| match part.split_once("\"#") {
        Some((_, after)) if k > 0 => after.to_owned(),
        _ => part.to_owned(),
    };
    let code: String = raw.map(after).collect();
    let code: String = code.split('"').step_by(2).collect::<Vec<_>>().join(" ");
    let names = code.split(|c: char| !(c.is_alphanumeric() || c == '_'));
    let holds = |name: &&str| {
        let parts = parts(name);
        let is_retired = |part: &String| {
            let stem = part.strip_suffix('d').unwrap_or(part);
            let stem = stem.strip_suffix('s').unwrap_or(stem);
            words.iter().any(|word| word == part || word == stem)
        };
        let at_rest = |k: usize| k > 0 && parts[k - 1] == "at" && parts[k] == "rest";
        (0..parts.len()).any(|k| is_retired(&parts[k]) && !at_rest(k))
    };
    names.filter(holds).map(str::to_owned).collect()
}

/// `LocalRest`, `local_rest` and `LOCAL_REST` are local and rest.
fn parts(name: &str) -> Vec<String> {
    let mut text = String::new();
    let mut before = '_';
    for c in name.chars() {
        if c.is_uppercase() && before.is_lowercase() {
            text.push('_');
        }
        text.extend(c.to_lowercase());
        before = c;
    }
    text.split('_').map(str::to_owned).collect()
}

#[test]
fn names_use_the_words_of_the_field() {
    let words = retired();
    assert!(words.len() >= 8, "{words:?}");
    let field = sources()
        .into_iter()
        .filter(|(path, _)| FIELD.iter().any(|room| path.starts_with(room)));
    let found: BTreeMap<_, _> = field
        .map(|(path, text)| (path, holding(&words, &text)))
        .collect();
    assert!(found.len() > 100, "{}", found.len());
    let found: Vec<_> = found
        .iter()
        .filter(|(_, names)| !names.is_empty())
        .collect();
    assert!(found.is_empty(), "{found:?}");
}

#[test]
fn a_retired_word_is_found() {
    let text = "fn judged(rest_p: f64) {} // way\nlet at_rest = \"door\"; r#\"{\"way\"}\"#; struct OwnTerrain; let always = LEAST_WAYS;";
    let found = holding(&retired(), text);
    let expected = ["LEAST_WAYS", "OwnTerrain", "judged", "rest_p"];
    assert_eq!(found, expected.map(str::to_owned).into());
}
