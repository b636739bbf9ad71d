//! From a sweep file's text to a [`Sweep`]: every key known, of the right kind and within its range.
//!
//! `serde` was tried in place of reading key by key: some 40 lines of 330 less, but of 12 faulty files it took 2 (a chain of
//! 0, a range of one case) and of 3 said only that no variant fits; no message would give the range, as those of scenes do.

use std::path::{Path, PathBuf};

use toml::{Table, Value};

use super::axis::{MOST_CASES, VariedKey, WARM, shown};
use super::error::SweepError;
use super::maps;
use super::path;
use super::presets;
use super::spec::{ChainKeys, Combine, Sweep, setting};
use asperity_engine::files::read_up_to;
use asperity_engine::scene::{Scene, SceneError, keys};

/// Longest sweep file, bytes: a list of a million values.
const LONGEST_FILE: u64 = 32 << 20;
/// Cases of a chain, where the file says nothing.
const CHAIN: usize = 7;
/// Longest chain.
const LONGEST_CHAIN: i64 = 1000;

impl Sweep {
    /// Reads a built-in sweep by name, or a file by path.
    ///
    /// # Errors
    /// [`SweepError::File`] that names the key, the value and what is allowed.
    pub fn load(name_or_path: &str) -> Result<Self, SweepError> {
        if let Some(preset) = presets::find(name_or_path) {
            return Self::parse(preset.toml, preset.name, Path::new(""));
        }
        let path = PathBuf::from(name_or_path);
        let text = read(&path, name_or_path)?;
        let name = path
            .file_stem()
            .map_or_else(|| "sweep".to_owned(), |s| s.to_string_lossy().into_owned());
        let mut sweep = Self::parse(&text, &name, path.parent().unwrap_or(Path::new("")))?;
        sweep.inputs.push(path);
        Ok(sweep)
    }

    /// Reads a sweep's text; files that it names are sought from `folder`.
    ///
    /// # Errors
    /// As [`Sweep::load`].
    pub fn parse(text: &str, name: &str, folder: &Path) -> Result<Self, SweepError> {
        read_sweep(text, name, folder).map_err(|source| SweepError::File {
            origin: name.to_owned(),
            source,
        })
    }
}

/// Reads a file, but never more than a sweep can be.
pub(super) fn read(path: &Path, shown_path: &str) -> Result<String, SweepError> {
    let failed = |reason: String| SweepError::Read {
        path: shown_path.to_owned(),
        reason,
    };
    let bytes = read_up_to(path, LONGEST_FILE).map_err(|error| {
        if error.kind() == std::io::ErrorKind::NotFound && path.extension().is_none() {
            failed(format!(
                "no such file, and no built-in sweep; built in: {}",
                presets::names()
            ))
        } else {
            failed(error.to_string())
        }
    })?;
    if bytes.len() as u64 > LONGEST_FILE {
        return Err(failed("longer than 32 MiB, which no sweep is".to_owned()));
    }
    String::from_utf8(bytes).map_err(|_| failed("not UTF-8 text".to_owned()))
}

const TOP: [&str; 9] = [
    "title", "scene", "combine", "set", "vary", "chain", "gear", "race", "cam",
];

fn read_sweep(text: &str, name: &str, folder: &Path) -> Result<Sweep, SceneError> {
    let mut root = text.parse::<Table>().map_err(|error| SceneError::Syntax {
        origin: name.to_owned(),
        reason: error.to_string(),
    })?;
    for part in ["scene", "set", "vary"] {
        if let Some(Value::Table(table)) = root.get_mut(part) {
            maps::absolute("", table, folder);
        }
    }
    if let Some(key) = root.keys().find(|key| !TOP.contains(&key.as_str())) {
        return Err(SceneError::unknown_among(key, &TOP));
    }
    let title = text_of(&root, "title", 200)?.unwrap_or_default();
    let base = read_base(&root, folder)?;
    let mut set = Vec::new();
    let mut set_text = Vec::new();
    let mut set_keys = Vec::new();
    for (key, value) in flat(&root, "set")? {
        set_text.push(format!("{key}={value}"));
        set.push(setting(&key, &value)?);
        set_keys.push(key);
    }
    let chain = read_chain(&root)?;
    let paths = ["gear", "race", "cam"];
    let given: Vec<_> = paths
        .into_iter()
        .filter(|p| root.contains_key(*p))
        .collect();
    let (mut axes, combine, points) = match (given.as_slice(), root.contains_key("vary")) {
        ([], true) => {
            let combine = read_combine(&root)?;
            let mut axes = Vec::new();
            for (key, value) in flat(&root, "vary")? {
                axes.push(VariedKey::read(&key, &value)?);
            }
            (axes, combine, Vec::new())
        }
        ([kind], false) => {
            let scene = Scene::from_toml_with(&base.0, &base.1, &set)?;
            let path = path::read(kind, table_of(&root, kind)?, &scene)?;
            (path.axes, Combine::List, path.points)
        }
        _ => {
            return Err(SceneError::Missing {
                key: "[vary]".to_owned(),
                allowed: "exactly one of [vary], [gear], [race], [cam]".to_owned(),
            });
        }
    };
    if let Some(axis) = axes.iter().find(|axis| set_keys.contains(&axis.key)) {
        let key = format!("set.{}", axis.key);
        return Err(SceneError::value(key, "a value", "nothing: the key varies"));
    }
    sort(&mut axes);
    let files = maps::files(&set_text, &axes);
    let maps = files.iter().map(|file| maps::digest(file)).collect();
    let mut inputs = files;
    inputs.extend(inputs_of(&root, folder));
    check_size(&axes, combine)?;
    let mut whole = root;
    if let Ok(scene) = base.0.parse::<Table>() {
        whole.insert("scene".to_owned(), Value::Table(scene));
    }
    Ok(Sweep {
        name: name.to_owned(),
        title,
        axes,
        combine,
        chain,
        path: points,
        base,
        set,
        set_text,
        text: whole.to_string(),
        source: text.to_owned(),
        maps,
        inputs,
    })
}

/// The scene's file and its height maps.
fn inputs_of(root: &Table, folder: &Path) -> Vec<PathBuf> {
    let mut files = Vec::new();
    let scene = root.get("scene");
    if let Some(name) = scene.and_then(Value::as_str)
        && asperity_engine::scene::presets::find(name).is_none()
    {
        files.push(folder.join(name));
    }
    for body in ["body_1", "body_2"] {
        let surface = scene.and_then(|scene| scene.get(body)?.get("surface"));
        let file = surface.and_then(|surface| surface.get("file")?.as_str());
        files.extend(file.map(|file| folder.join(file)));
    }
    files
}

/// The base scene's text, checked, and its name.
fn read_base(root: &Table, folder: &Path) -> Result<(String, String), SceneError> {
    let scene = match root.get("scene") {
        None => Scene::load(asperity_engine::scene::presets::DEFAULT)?,
        Some(Value::String(name)) if asperity_engine::scene::presets::find(name).is_some() => {
            Scene::load(name)?
        }
        Some(Value::String(name)) => Scene::load(&folder.join(name).to_string_lossy())?,
        Some(Value::Table(table)) => Scene::from_toml_with(&table.to_string(), "scene", &[])?,
        Some(other) => {
            return Err(SceneError::value(
                "scene",
                shown(other),
                "a preset, a TOML file, or a table [scene]",
            ));
        }
    };
    let text = toml::to_string(&scene).map_err(|error| SceneError::Syntax {
        origin: "scene".to_owned(),
        reason: error.to_string(),
    })?;
    Ok((text, "scene".to_owned()))
}

/// `[set]` and `[vary]` with their dotted keys put together: `motion.slide_roll` may stand as one quoted key
/// or as a table in a table.
fn flat(root: &Table, name: &str) -> Result<Vec<(String, Value)>, SceneError> {
    if !root.contains_key(name) {
        return Ok(Vec::new());
    }
    let mut found = Vec::new();
    flatten("", table_of(root, name)?, &mut found);
    for (key, _) in &found {
        match (keys::find(key), keys::section(key)) {
            (None, None) => return Err(SceneError::unknown_key(key)),
            (None, Some(_)) if name == "vary" => {
                let full = format!("vary.{key}");
                return Err(SceneError::value(full, "a table", "one of its keys"));
            }
            _ => {}
        }
    }
    // A table has no order, and a surface of another kind keeps nothing that was set before.
    found.sort_by_key(|(key, _)| !key.ends_with(".surface.kind"));
    let mut names: Vec<_> = found.iter().map(|(key, _)| key.clone()).collect();
    names.sort();
    if let Some([twice, ..]) = names.windows(2).find(|pair| pair[0] == pair[1]) {
        return Err(SceneError::value(
            format!("{name}.{twice}"),
            "given twice",
            "each key once",
        ));
    }
    Ok(found)
}

fn flatten(prefix: &str, table: &Table, found: &mut Vec<(String, Value)>) {
    for (name, value) in table {
        let full = keys::joined(prefix, name);
        match value {
            Value::Table(inner) if keys::find(&full).is_none() => flatten(&full, inner, found),
            _ => found.push((full, value.clone())),
        }
    }
}

fn table_of<'a>(root: &'a Table, name: &str) -> Result<&'a Table, SceneError> {
    match root.get(name) {
        Some(Value::Table(table)) => Ok(table),
        Some(other) => Err(SceneError::value(
            name,
            shown(other),
            format!("a table [{name}]"),
        )),
        None => Err(SceneError::Missing {
            key: format!("[{name}]"),
            allowed: "a table".to_owned(),
        }),
    }
}

fn text_of(root: &Table, name: &str, longest: usize) -> Result<Option<String>, SceneError> {
    match root.get(name) {
        None => Ok(None),
        Some(Value::String(text)) if text.chars().count() <= longest => Ok(Some(text.clone())),
        Some(other) => Err(SceneError::value(
            name,
            shown(other),
            format!("a text of at most {longest} characters"),
        )),
    }
}

fn read_combine(root: &Table) -> Result<Combine, SceneError> {
    match root.get("combine").map(|value| (value.as_str(), value)) {
        None | Some((Some("grid"), _)) => Ok(Combine::Grid),
        Some((Some("list"), _)) => Ok(Combine::List),
        Some((_, other)) => Err(SceneError::value(
            "combine",
            shown(other),
            "\"grid\" or \"list\"",
        )),
    }
}

fn read_chain(root: &Table) -> Result<ChainKeys, SceneError> {
    let mut chain = ChainKeys {
        longest: CHAIN,
        passages: None,
    };
    if !root.contains_key("chain") {
        return Ok(chain);
    }
    for (name, value) in table_of(root, "chain")? {
        match name.as_str() {
            "longest" => {
                let allowed = format!("a whole number, 1 to {LONGEST_CHAIN}");
                chain.longest = value
                    .as_integer()
                    .filter(|n| (1..=LONGEST_CHAIN).contains(n))
                    .ok_or_else(|| SceneError::value("chain.longest", shown(value), allowed))?
                    as usize;
            }
            "passages" => {
                let passages = super::axis::number(value)
                    .filter(|p| (0.25..=1e4).contains(p))
                    .ok_or_else(|| {
                        SceneError::value("chain.passages", shown(value), "0.25 to 1e4")
                    })?;
                chain.passages = Some(passages);
            }
            other => {
                let full = format!("chain.{other}");
                return Err(SceneError::unknown_among(&full, &["longest", "passages"]));
            }
        }
    }
    Ok(chain)
}

/// In the order in which scenes print their keys, those that allow warm starts last.
fn sort(axes: &mut [VariedKey]) {
    let order: Vec<String> = keys::all_paths().collect();
    axes.sort_by_key(|axis| {
        let warm = WARM.iter().position(|knob| knob.key() == axis.key);
        let place = order.iter().position(|key| *key == axis.key);
        (warm.map_or(0, |k| k + 1), place)
    });
}

fn check_size(axes: &[VariedKey], combine: Combine) -> Result<(), SceneError> {
    let lengths = || axes.iter().map(|axis| axis.values.len());
    if axes.is_empty() {
        return Err(SceneError::Missing {
            key: "vary".to_owned(),
            allowed: "at least one key with its values".to_owned(),
        });
    }
    if combine == Combine::List && lengths().any(|n| n != axes[0].values.len()) {
        let list: Vec<_> = axes
            .iter()
            .map(|axis| format!("{}: {}", axis.key, axis.values.len()))
            .collect();
        return Err(SceneError::value(
            "combine",
            "\"list\"",
            format!("lists of one length; these have {}", list.join(", ")),
        ));
    }
    let all = lengths().try_fold(1_usize, usize::checked_mul);
    if combine == Combine::Grid && all.is_none_or(|n| n > MOST_CASES) {
        let n = all.map_or_else(|| "more than can be counted".to_owned(), |n| n.to_string());
        return Err(SceneError::value(
            "vary",
            format!("{n} cases"),
            format!("at most {MOST_CASES}"),
        ));
    }
    Ok(())
}
