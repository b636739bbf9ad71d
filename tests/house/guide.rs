//! README and guide against what they speak of: files, tests, names of the code, presets, cautions.

use std::path::{Path, PathBuf};

use asperity_engine::scene::{keys, presets};

/// Words of the README.
const LONGEST_README: usize = 1000;

fn root() -> &'static Path {
    Path::new(env!("CARGO_MANIFEST_DIR"))
}

fn read(path: &Path) -> String {
    std::fs::read_to_string(path).unwrap_or_else(|error| panic!("{}: {error}", path.display()))
}

/// README and the guide's pages, with their text.
fn pages() -> Vec<(PathBuf, String)> {
    let guide = std::fs::read_dir(root().join("assets/guide")).unwrap();
    let mut files: Vec<_> = guide.map(|entry| entry.unwrap().path()).collect();
    files.push(root().join("README.md"));
    files.sort();
    assert!(files.len() > 10, "{files:?}");
    let text = |file: PathBuf| (file.clone(), read(&file));
    files.into_iter().map(text).collect()
}

fn page(name: &str) -> String {
    read(&root().join("assets/guide").join(name))
}

/// What stands between `open` and `close`, everywhere in `text`.
fn between<'a>(text: &'a str, open: &str, close: &str) -> Vec<&'a str> {
    let parts = text.split(open).skip(1);
    parts
        .filter_map(|part| Some(part.split_once(close)?.0))
        .collect()
}

/// All source and test files, in one text.
fn code() -> String {
    super::sources().into_iter().map(|(_, text)| text).collect()
}

#[test]
fn the_readme_is_short() {
    let words = read(&root().join("README.md")).split_whitespace().count();
    assert!(words <= LONGEST_README, "{words} words");
}

#[test]
fn links_lead_to_files() {
    let mut links = 0;
    for (file, text) in pages() {
        for link in between(&text, "](", ")") {
            let target = link.split('#').next().unwrap_or(link);
            if target.is_empty() || target.starts_with("http") {
                continue;
            }
            let target = file.parent().unwrap().join(target);
            assert!(target.exists(), "{}: {link}", file.display());
            links += 1;
        }
    }
    assert!(links > 30, "{links}");
}

#[test]
fn every_page_is_reached_and_rendered() {
    let readme = read(&root().join("README.md"));
    let docs = read(&root().join("src/guide.rs"));
    for entry in std::fs::read_dir(root().join("assets/guide")).unwrap() {
        let name = entry.unwrap().file_name().into_string().unwrap();
        assert!(
            readme.contains(&format!("](assets/guide/{name})")),
            "README: {name}"
        );
        assert!(
            docs.contains(&format!("../assets/guide/{name}\"")),
            "src/guide.rs: {name}"
        );
    }
}

/// `--test PROGRAM FILE::` and `--bench NAME` name what is there.
#[test]
fn quoted_tests_exist() {
    let tests = root().join("tests");
    let mut quoted = 0;
    for (file, text) in pages() {
        for after in text.split("--test ").skip(1) {
            let mut words = after.split(|c: char| !(c.is_alphanumeric() || c == '_' || c == ':'));
            let program = words.next().unwrap_or_default();
            let known = tests.join(program).join("main.rs").exists()
                || tests.join(format!("{program}.rs")).exists();
            assert!(
                known || program == "PROGRAM",
                "{}: --test {program}",
                file.display()
            );
            if let Some(name) = words.next().and_then(|word| word.strip_suffix("::")) {
                let folder = tests.join(program);
                let files = [format!("{name}.rs"), format!("{name}/mod.rs")];
                let there = files.iter().any(|file| folder.join(file).exists());
                assert!(there, "{}: --test {program} {name}::", file.display());
            }
            quoted += 1;
        }
        for name in between(&text, "--bench ", "`") {
            assert!(
                tests.join(format!("bench/{name}.rs")).exists(),
                "--bench {name}"
            );
        }
    }
    assert!(quoted > 20, "{quoted}");
}

#[test]
fn quoted_source_files_exist() {
    for (file, text) in pages() {
        for quoted in between(&text, "`src/", "`") {
            let path = root()
                .join("src")
                .join(quoted.split(' ').next().unwrap_or(quoted));
            assert!(path.exists(), "{}: src/{quoted}", file.display());
        }
    }
}

/// The last column of the glossary: a type, a field, or a key of a scene.
#[test]
fn the_glossary_names_what_is_in_the_code() {
    let code = code();
    let mut names = 0;
    for row in page("glossary.md")
        .lines()
        .filter(|line| line.starts_with("| "))
    {
        let cells: Vec<_> = row.trim_matches('|').split(" | ").collect();
        let Some(name) = cells.last().and_then(|cell| cell.split('`').nth(1)) else {
            continue;
        };
        assert!(is_in_code(&code, name), "{row}");
        names += 1;
    }
    assert!(names > 30, "{names}");
    assert!(!is_in_code(&code, "NoSuchType") && !is_in_code(&code, "no.such_key"));
}

fn is_in_code(code: &str, name: &str) -> bool {
    if name.contains('.') {
        return keys::find(name).is_some();
    }
    let declared = |what: &str| {
        let text = format!("{what} {name}");
        let ends = |rest: &str| !rest.starts_with(|c: char| c.is_alphanumeric() || c == '_');
        code.match_indices(&text)
            .any(|(at, _)| ends(&code[at + text.len()..]))
    };
    let is_type = ["struct", "enum", "trait"].into_iter().any(declared);
    is_type || code.contains(&format!("pub {name}: "))
}

#[test]
fn presets_and_cautions_are_described() {
    let scenes = page("scenes.md");
    for preset in presets::listed() {
        assert!(
            scenes.contains(&format!("`{}`", preset.name)),
            "scenes.md: {}",
            preset.name
        );
    }
    let life = page("life.md");
    let enumeration = read(&root().join("src/engine/sim/caution.rs"));
    let variants = between(&enumeration, "pub enum CautionCode {", "\n}")[0].lines();
    let mut described = 0;
    for line in variants.map(str::trim).filter(|line| line.ends_with(',')) {
        let code = snake_case(line.trim_end_matches(','));
        assert!(life.contains(&format!("`{code}`")), "life.md: {code}");
        described += 1;
    }
    assert!(described >= 13, "{described}");
}

fn snake_case(name: &str) -> String {
    let mut text = String::new();
    for letter in name.chars() {
        if letter.is_uppercase() && !text.is_empty() {
            text.push('_');
        }
        text.extend(letter.to_lowercase());
    }
    text
}
