//! From a sweep file's text to a [`Sweep`]: every key known, of the right kind and within its range.

use std::path::{Path, PathBuf};

use toml::{Table, Value};

use super::axis::{MOST_CASES, VariedKey, WARM};
use super::error::SweepError;
use super::maps;
use super::path::{self, PathKind};
use super::presets;
use super::reader::{TableReader, shown};
use super::spec::{ChainKeys, Combine, Sweep, setting};
use asperity_engine::files::read_up_to;
use asperity_engine::scene::{Scene, SceneError, keys, presets as preset_scenes};

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

const COMBINE: [(&str, Combine); 2] = [("grid", Combine::Grid), ("list", Combine::List)];

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
    let mut file = TableReader::new("", &root);
    let title = file.optional("title", "a text of at most 200 characters", |value| {
        value.as_str().filter(|text| text.chars().count() <= 200)
    });
    let title = title.unwrap_or_default().to_owned();
    let scene = file.optional("scene", "", Some);
    let combine = file.choice("combine", &COMBINE);
    let [set, vary, chain] = ["set", "vary", "chain"].map(|name| file.table(name));
    let mut paths = Vec::new();
    for kind in PathKind::ALL {
        paths.extend(file.table(kind.name()).map(|table| (kind, table)));
    }
    file.finish()?;
    let mut sweep = Sweep {
        name: name.to_owned(),
        title,
        axes: Vec::new(),
        combine,
        chain: read_chain(chain)?,
        path: Vec::new(),
        tooth: None,
        ring: None,
        base: read_base(scene, folder)?,
        set: set.map_or_else(|| Ok(Vec::new()), |set| settings("set", set))?,
        text: String::new(),
        source: text.to_owned(),
        maps: Vec::new(),
        inputs: Vec::new(),
    };
    for (key, value) in &sweep.set {
        setting(key, value)?;
    }
    match (vary, paths.as_slice()) {
        (Some(vary), []) => {
            let axes = settings("vary", vary)?;
            let axes = axes.iter().map(|(key, value)| VariedKey::read(key, value));
            sweep.axes = axes.collect::<Result<_, _>>()?;
        }
        (None, [(kind, table)]) => {
            let path = path::read(*kind, table, &sweep.base_scene()?)?;
            (sweep.axes, sweep.path) = (path.axes, path.points);
            (sweep.tooth, sweep.ring) = (path.tooth, path.ring);
            sweep.combine = Combine::List;
        }
        (Some(_), [_, ..]) | (None, [] | [_, _, ..]) => {
            return Err(SceneError::Missing {
                key: "[vary]".to_owned(),
                allowed: "exactly one of [vary], [gear], [race], [cam]".to_owned(),
            });
        }
    }
    let is_set = |axis: &&VariedKey| sweep.set.iter().any(|(key, _)| *key == axis.key);
    if let Some(axis) = sweep.axes.iter().find(is_set) {
        let key = format!("set.{}", axis.key);
        return Err(SceneError::value(key, "a value", "nothing: the key varies"));
    }
    sort(&mut sweep.axes);
    check_size(&sweep.axes, sweep.combine)?;
    sweep.inputs = maps::files(&sweep.set, &sweep.axes);
    sweep.maps = sweep.inputs.iter().map(|file| maps::digest(file)).collect();
    sweep.inputs.extend(inputs_of(scene, folder));
    let mut whole = root.clone();
    if let Ok(scene) = sweep.base.parse::<Table>() {
        whole.insert("scene".to_owned(), Value::Table(scene));
    }
    sweep.text = whole.to_string();
    Ok(sweep)
}

/// The scene's file and its height maps.
fn inputs_of(scene: Option<&Value>, folder: &Path) -> Vec<PathBuf> {
    let name = scene.and_then(Value::as_str);
    let file = name.filter(|name| preset_scenes::find(name).is_none());
    let maps = ["body_1", "body_2"].into_iter().filter_map(|body| {
        let surface = scene?.get(body)?.get("surface")?;
        surface.get("file")?.as_str()
    });
    let files = file.into_iter().chain(maps);
    files.map(|file| folder.join(file)).collect()
}

/// The base scene's text, checked.
fn read_base(scene: Option<&Value>, folder: &Path) -> Result<String, SceneError> {
    let scene = match scene {
        None => Scene::load(preset_scenes::DEFAULT)?,
        Some(Value::String(name)) if preset_scenes::find(name).is_some() => Scene::load(name)?,
        Some(Value::String(name)) => Scene::load(&folder.join(name).to_string_lossy())?,
        Some(Value::Table(table)) => Scene::from_toml_with(&table.to_string(), "scene", &[])?,
        Some(other) => {
            let allowed = "a preset, a TOML file, or a table [scene]";
            return Err(SceneError::value("scene", shown(other), allowed));
        }
    };
    toml::to_string(&scene).map_err(|error| SceneError::Syntax {
        origin: "scene".to_owned(),
        reason: error.to_string(),
    })
}

/// `[set]` or `[vary]` with dotted keys put together: `motion.slide_roll` may stand as one quoted key or as a table in a
/// table.
fn settings(name: &str, table: &Table) -> Result<Vec<(String, Value)>, SceneError> {
    let mut found = Vec::new();
    flatten("", table, &mut found);
    for (key, _) in &found {
        match (keys::find(key), keys::section(key)) {
            (None, None) => return Err(SceneError::unknown_key(key)),
            (None, Some(_)) if name == "vary" => {
                let full = format!("vary.{key}");
                return Err(SceneError::value(full, "a table", "one of its keys"));
            }
            (Some(_), _) | (None, Some(_)) => {}
        }
    }
    // A table has no order, and a surface of another kind keeps nothing that was set before.
    found.sort_by_key(|(key, _)| !key.ends_with(".surface.kind"));
    let mut names: Vec<_> = found.iter().map(|(key, _)| key.clone()).collect();
    names.sort();
    if let Some([twice, ..]) = names.windows(2).find(|pair| pair[0] == pair[1]) {
        let key = format!("{name}.{twice}");
        return Err(SceneError::value(key, "given twice", "each key once"));
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

fn read_chain(table: Option<&Table>) -> Result<ChainKeys, SceneError> {
    let none = Table::new();
    let mut chain = TableReader::new("chain", table.unwrap_or(&none));
    let keys = ChainKeys {
        longest: chain.whole("longest", 1..=LONGEST_CHAIN, CHAIN),
        passages: chain.optional_number("passages", 0.25..=1e4, ""),
    };
    chain.finish()?;
    Ok(keys)
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
