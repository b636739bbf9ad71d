//! The height maps that a sweep names outside of its scene.

use std::path::{Path, PathBuf};

use toml::{Table, Value};

use super::axis::VariedKey;
use asperity_engine::files::{fnv, read_up_to};
use asperity_engine::scene::keys;
use asperity_engine::scene::presets::BUILTIN;

/// Longest height map, bytes.
const LONGEST_MAP: u64 = 64 << 20;

/// The height maps that a sweep names outside of its scene.
pub(super) fn files(set: &[(String, Value)], axes: &[VariedKey]) -> Vec<PathBuf> {
    let set = set
        .iter()
        .map(|(key, value)| (key, std::slice::from_ref(value)));
    let varied = axes.iter().map(|axis| (&axis.key, axis.values.as_slice()));
    set.chain(varied)
        .filter(|(key, _)| is_map(key))
        .flat_map(|(_, files)| files.iter().filter_map(Value::as_str))
        .map(PathBuf::from)
        .collect()
}

/// Whether a key names a height map.
fn is_map(key: &str) -> bool {
    key.ends_with(".surface.file")
}

/// A height map's path and the digest of what the file holds; one that cannot be read is refused where its case is
/// planned.
pub(super) fn digest(file: &Path) -> String {
    let bytes = read_up_to(file, LONGEST_MAP).unwrap_or_default();
    format!("{} {:016x}", file.display(), fnv(&bytes))
}

/// Height maps are sought beside the sweep file, from wherever the sweep is run or taken up again.
pub(super) fn absolute(prefix: &str, table: &mut Table, folder: &Path) {
    for (name, value) in table.iter_mut() {
        let full = keys::joined(prefix, name);
        match value {
            Value::Table(inner) => absolute(&full, inner, folder),
            Value::Array(files) if is_map(&full) => {
                for file in files {
                    of_root(file, folder);
                }
            }
            file if is_map(&full) => of_root(file, folder),
            _ => {}
        }
    }
}

fn of_root(file: &mut Value, folder: &Path) {
    if let Value::String(name) = file
        && !name.starts_with(BUILTIN)
        && let Ok(path) = std::path::absolute(folder.join(&*name))
        && let Some(path) = path.to_str()
    {
        path.clone_into(name);
    }
}
