//! No file imports a file that imports it. A module and its own children are one family: they may.

use std::collections::{BTreeMap, BTreeSet};

use super::{is_word, sources, without_comments};

/// A module's path, such as `[plan, domain]`.
type Module = Vec<String>;

/// What a file says of others.
struct File {
    /// Paths of `use`, the name that each gives.
    uses: Vec<(Vec<String>, String)>,
    /// Other paths that begin with `crate`, `super` or `self`.
    paths: Vec<Vec<String>>,
}

fn module_of(path: &str) -> Option<Module> {
    let path = path.strip_prefix("src/")?.strip_suffix(".rs")?;
    let mut names: Module = path.split('/').map(str::to_owned).collect();
    if names.last().is_some_and(|name| name == "mod") {
        names.pop();
    }
    (!["lib", "main", "build"].contains(&names[0].as_str())).then_some(names)
}

/// `a::{b, c::d as e}` gives a::b as b and a::c::d as e.
fn expanded(tree: &str, before: &[String], found: &mut Vec<(Vec<String>, String)>) {
    let Some(open) = tree.find('{') else {
        let (path, name) = tree.split_once(" as ").unwrap_or((tree, ""));
        let mut whole = before.to_vec();
        whole.extend(path.split("::").map(|part| part.trim().to_owned()));
        if whole.last().is_some_and(|last| last == "self") {
            whole.pop();
        }
        let name = if name.is_empty() {
            whole.last().cloned().unwrap_or_default()
        } else {
            name.trim().to_owned()
        };
        found.push((whole, name));
        return;
    };
    let mut whole = before.to_vec();
    let lead = tree[..open]
        .split("::")
        .map(str::trim)
        .filter(|part| !part.is_empty());
    whole.extend(lead.map(str::to_owned));
    let (mut depth, mut start) = (0, open + 1);
    for (at, c) in tree.char_indices().skip_while(|(at, _)| *at < open) {
        match c {
            '{' => depth += 1,
            '}' => depth -= 1,
            _ => {}
        }
        if (c == ',' && depth == 1) || depth == 0 {
            let part = tree[start..at].trim();
            if !part.is_empty() {
                expanded(part, &whole, found);
            }
            start = at + 1;
        }
        if depth == 0 {
            break;
        }
    }
}

fn read(text: &str) -> File {
    let code = without_comments(text);
    let code = code.split("#[cfg(test)]").next().unwrap_or("");
    let (mut uses, mut paths) = (Vec::new(), Vec::new());
    for statement in code.split(';') {
        let mut words = statement.rsplit("use ");
        let tree = words.next().unwrap_or("");
        let before = words.next();
        let is_use = before.is_some_and(|text| {
            let line = text.rsplit(['\n', '}', '{']).next().unwrap_or("").trim();
            line.is_empty() || line.starts_with("pub")
        });
        if is_use {
            expanded(tree.trim(), &[], &mut uses);
        }
        for root in ["crate::", "super::", "self::"] {
            for (at, _) in statement.match_indices(root) {
                let begins = !statement[..at].ends_with(|c: char| is_word(c) || c == ':');
                if begins && !is_use {
                    let rest: String = statement[at..]
                        .chars()
                        .take_while(|c| is_word(*c) || *c == ':')
                        .collect();
                    paths.push(
                        rest.split("::")
                            .filter(|part| !part.is_empty())
                            .map(str::to_owned)
                            .collect(),
                    );
                }
            }
        }
    }
    File { uses, paths }
}

/// A path from the root of the library; `None`: of another crate.
fn absolute(own: &Module, path: &[String], files: &BTreeMap<Module, File>) -> Option<Vec<String>> {
    let (first, rest) = path.split_first()?;
    match first.as_str() {
        "crate" | "asperity" => Some(rest.to_vec()),
        "self" => Some([own, rest].concat()),
        "super" => {
            let ups = path.iter().take_while(|part| *part == "super").count();
            let base = own.get(..own.len().checked_sub(ups)?)?;
            Some([base, &path[ups..]].concat())
        }
        _ => {
            let whole = [own, path].concat();
            files.contains_key(&whole[..=own.len()]).then_some(whole)
        }
    }
}

/// The module in which what that path names is written down, through any `use` that hands it on.
fn home(path: &[String], files: &BTreeMap<Module, File>, depth: usize) -> Option<Module> {
    let length = (1..=path.len())
        .rev()
        .find(|n| files.contains_key(&path[..*n]))?;
    let module = path[..length].to_vec();
    let Some(name) = path.get(length) else {
        return Some(module);
    };
    if depth < 8
        && let Some((handed, _)) = files[&module].uses.iter().find(|(_, given)| given == name)
        && let Some(mut next) = absolute(&module, handed, files)
    {
        next.extend_from_slice(&path[length + 1..]);
        return home(&next, files, depth + 1);
    }
    Some(module)
}

/// Pairs of files that import each other.
fn circles(texts: &[(String, String)]) -> BTreeSet<(String, String)> {
    let files: BTreeMap<Module, File> = texts
        .iter()
        .filter_map(|(path, text)| Some((module_of(path)?, read(text))))
        .collect();
    let mut edges = BTreeSet::new();
    for (own, file) in &files {
        let all = file.uses.iter().map(|(path, _)| path).chain(&file.paths);
        for path in all.filter_map(|path| absolute(own, path, &files)) {
            if let Some(other) = home(&path, &files, 0) {
                edges.insert((own.clone(), other));
            }
        }
    }
    let of_a_family = |a: &Module, b: &Module| a.starts_with(b) || b.starts_with(a);
    let circles = edges
        .iter()
        .filter(|(a, b)| a < b && !of_a_family(a, b) && edges.contains(&(b.clone(), a.clone())));
    circles.map(|(a, b)| (a.join("::"), b.join("::"))).collect()
}

#[test]
fn no_file_imports_a_file_that_imports_it() {
    let found = circles(&sources());
    assert!(found.is_empty(), "{found:#?}");
}

#[test]
fn a_planted_circle_is_found() {
    let file = |path: &str, text: &str| (path.to_owned(), text.to_owned());
    let texts = [
        file(
            "src/room/mod.rs",
            "mod one;\nmod two;\npub use one::{First, other as Third};\npub use two::Second;",
        ),
        file("src/room/one.rs", "use super::Second;\npub struct First;"),
        file(
            "src/room/two.rs",
            "// use\npub(crate) use crate::room::{\n    First,\n};\npub struct Second;",
        ),
        file("src/room/two/child.rs", "fn f() { super::super::Third(); }"),
    ];
    let found = circles(&texts);
    let pair = ("room::one".to_owned(), "room::two".to_owned());
    assert_eq!(found.into_iter().collect::<Vec<_>>(), [pair]);
    assert!(circles(&texts[..2]).is_empty());
}
