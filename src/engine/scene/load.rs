//! From a preset, a file or a text to a scene that has passed every check.

use std::path::Path;
use std::sync::Arc;

use toml::{Table, Value};

use super::check;
use super::drawing;
use super::error::{SceneError, nearest};
use super::height_map;
use super::keys;
use super::model::{Scene, Surface};
use super::presets;
use super::random::RandomSurface;
use crate::files::read_up_to;

/// Longest scene file, bytes. Scenes are some kilobytes; anything longer is not one.
const LONGEST_FILE: u64 = 1 << 20;

/// One `--set KEY=VALUE`: a key of the scene and the TOML value it takes.
#[derive(Debug, Clone, PartialEq)]
pub struct Override {
    key: String,
    value: Value,
}

impl std::str::FromStr for Override {
    type Err = SceneError;

    /// Reads `KEY=VALUE`. The value is TOML; a bare word is a text; `none` takes the key or table out, but of a key that
    /// knows the word.
    fn from_str(text: &str) -> Result<Self, SceneError> {
        let malformed = || SceneError::Override {
            text: super::error::shortened(text),
        };
        let (key, value) = text.split_once('=').ok_or_else(malformed)?;
        let (key, value) = (key.trim(), value.trim());
        if key.is_empty() || value.is_empty() {
            return Err(malformed());
        }
        if keys::find(key).is_none() && (keys::section(key).is_none() || value != "none") {
            return Err(match keys::section(key) {
                Some(_) => {
                    SceneError::value(key, value, "none, or one of its keys, as TABLE.KEY=VALUE")
                }
                None => check::unknown(key),
            });
        }
        // Only a text that is one TOML value and nothing else counts as TOML.
        let parsed = format!("v = {value}").parse::<Table>().ok();
        let value = parsed
            .filter(|table| table.len() == 1)
            .and_then(|mut table| table.remove("v"))
            .unwrap_or_else(|| Value::String(value.to_owned()));
        Ok(Self {
            key: key.to_owned(),
            value,
        })
    }
}

impl Override {
    /// An override from a key and a number.
    ///
    /// # Errors
    /// [`SceneError::UnknownKey`] when no scene has that key.
    pub fn number(key: &str, value: f64) -> Result<Self, SceneError> {
        if keys::find(key).is_none() {
            return Err(check::unknown(key));
        }
        Ok(Self {
            key: key.to_owned(),
            value: Value::Float(value),
        })
    }

    /// Whether it takes its key or table out.
    fn takes_out(&self) -> bool {
        let is_none = |key: &keys::Key| key.kind.is_choice("none");
        self.value.as_str() == Some("none") && !keys::find(&self.key).is_some_and(is_none)
    }

    fn apply(&self, root: &mut Table) {
        drawing::unsay(root, &self.key);
        let (path, name) = self.key.rsplit_once('.').unwrap_or(("", &self.key));
        if self.takes_out() {
            if let Some(table) = descend(root, path) {
                table.remove(name);
            }
            return;
        }
        if self.key.ends_with("surface.file")
            && let Some(table) = descend(root, path)
        {
            // The digest is that of the former file.
            table.remove("digest");
        }
        if self.key.ends_with("surface.finish") {
            // So does one that is finished in another way.
            if let Some(table) = descend(root, path) {
                table.clear();
            }
        }
        if self.key.ends_with("surface.kind") {
            // A body of another kind keeps nothing of its former surface.
            if let Some(table) = descend(root, path)
                && table.get("kind") != Some(&self.value)
            {
                table.clear();
            }
        }
        if self.key == "contact.kind"
            && self.value.as_str() == Some("line")
            && let Some(table) = descend(root, path)
        {
            // A contact made a line has no radius across; its load must be given per length or as pressure.
            table.remove("ry_m");
        }
        if path == "lubricant"
            && let Some(table) = descend(root, path)
        {
            // So do the ways of giving the oil.
            let others: &[&str] = match name {
                "viscosity_pa_s" => &["vg", "temperature_c", "viscosity_index"],
                "vg" => &["viscosity_pa_s", "pressure_viscosity_per_pa"],
                _ => &[],
            };
            for other in others {
                table.remove(*other);
            }
        }
        if path == "load" {
            // The ways of giving the load exclude each other: the last word counts.
            if let Some(table) = descend(root, path) {
                table.clear();
            }
        }
        if let Some(table) = descend(root, path) {
            drawing::make_room(table, path, name);
            table.insert(name.to_owned(), self.value.clone());
        }
    }
}

/// The table at a path, made where it is missing; `None` where something else stands in its place,
/// which the check then reports.
fn descend<'a>(root: &'a mut Table, path: &str) -> Option<&'a mut Table> {
    if path.is_empty() {
        return Some(root);
    }
    path.split('.').try_fold(root, |table, name| {
        table
            .entry(name)
            .or_insert_with(|| Value::Table(Table::new()))
            .as_table_mut()
    })
}

impl Scene {
    /// A preset by name, or a TOML file by path.
    ///
    /// # Errors
    /// [`SceneError`] naming the key, the value and what is allowed, or why the file cannot be read.
    pub fn load(name_or_path: &str) -> Result<Self, SceneError> {
        Self::load_with(name_or_path, &[])
    }

    /// Same, with keys set on top of what the file says, in order.
    ///
    /// # Errors
    /// As [`Scene::load`].
    pub fn load_with(name_or_path: &str, overrides: &[Override]) -> Result<Self, SceneError> {
        if let Some(preset) = presets::find(name_or_path) {
            return Self::from_toml_with(preset.toml, name_or_path, overrides);
        }
        Self::load_file_with(Path::new(name_or_path), overrides)
    }

    /// A TOML file by its path, which need not be text, with keys set on top.
    ///
    /// # Errors
    /// As [`Scene::load`].
    pub fn load_file_with(path: &Path, overrides: &[Override]) -> Result<Self, SceneError> {
        let text = read(path)?;
        let folder = path.parent().unwrap_or(Path::new(""));
        Self::parsed(&text, &path.to_string_lossy(), overrides, folder)
    }

    /// A scene from TOML text.
    ///
    /// # Errors
    /// As [`Scene::load`].
    pub fn from_toml(text: &str) -> Result<Self, SceneError> {
        Self::from_toml_with(text, "the scene", &[])
    }

    /// Same, with a name for messages and keys set on top.
    ///
    /// # Errors
    /// As [`Scene::load`].
    pub fn from_toml_with(
        text: &str,
        origin: &str,
        overrides: &[Override],
    ) -> Result<Self, SceneError> {
        Self::parsed(text, origin, overrides, Path::new(""))
    }

    /// Height maps are sought from `folder`.
    fn parsed(
        text: &str,
        origin: &str,
        overrides: &[Override],
        folder: &Path,
    ) -> Result<Self, SceneError> {
        let mut table = text
            .parse::<Table>()
            .map_err(|error| syntax_in(text, origin, &error))?;
        for setting in overrides {
            setting.apply(&mut table);
        }
        drawing::translate(&mut table)?;
        check::check_table(&mut table)?;
        // The check knows every key and kind, so this cannot fail unless the two disagree (a test
        // walks all presets and keys); an error is still better than a panic.
        let mut scene: Self = table.try_into().map_err(|error| syntax(origin, &error))?;
        scene.read_maps(folder)?;
        check::check_rules(&scene).map_err(|error| error.beside_the_unusual(&scene))?;
        Ok(scene)
    }

    /// Reads the height maps that have not been read yet and makes the surfaces that have not been made, relative paths from `folder`; the paths become
    /// absolute, so that a copy of the scene finds them from anywhere.
    ///
    /// # Errors
    /// [`SceneError::Value`] that names the key, the file and what is wrong with it.
    pub fn read_maps(&mut self, folder: &Path) -> Result<(), SceneError> {
        let bodies = [
            ("body_1.surface", &mut self.body_1),
            ("body_2.surface", &mut self.body_2),
        ];
        let mut seed = None;
        for (table, body) in bodies {
            match &mut body.surface {
                Surface::Smooth {}
                | Surface::Sinusoid { .. }
                | Surface::HeightMap { map: Some(_), .. } => {}
                Surface::Random(random) => {
                    random.make(table, RandomSurface::usual_seed(seed))?;
                    seed = random.seed;
                }
                Surface::HeightMap {
                    file,
                    pixel_m,
                    edge,
                    unit_m,
                    digest,
                    level,
                    outliers,
                    crop_m,
                    turn_deg,
                    s_filter_m,
                    l_filter_m,
                    map: map @ None,
                    ..
                } => {
                    let asked = height_map::Asked {
                        table,
                        file,
                        pixel_m: *pixel_m,
                        unit_m: *unit_m,
                        beyond: *edge,
                        level: *level,
                        outliers: *outliers,
                        crop_m: *crop_m,
                        turn_deg: *turn_deg,
                        filters_m: [*s_filter_m, *l_filter_m],
                    };
                    let found = asked.read(folder)?;
                    if digest
                        .as_ref()
                        .is_some_and(|digest| *digest != found.digest)
                    {
                        return Err(height_map::changed(table, file, &found.digest));
                    }
                    *map = Some(Arc::new(found.map));
                    *digest = Some(found.digest);
                    // A copy of the scene keeps what the file says now.
                    (*pixel_m, *unit_m) = (Some(found.pixel_m), Some(found.unit_m));
                    if !file.starts_with(presets::BUILTIN)
                        && let Ok(absolute) = std::path::absolute(folder.join(&*file))
                        && let Some(text) = absolute.to_str()
                    {
                        text.clone_into(file);
                    }
                }
            }
        }
        Ok(())
    }

    /// Checks a scene that was made or changed in code by the same rules as a file.
    ///
    /// # Errors
    /// As [`Scene::load`].
    pub fn validate(&self) -> Result<(), SceneError> {
        let mut table = Table::try_from(self).map_err(|error| SceneError::Syntax {
            origin: "the scene".to_owned(),
            reason: error.to_string(),
        })?;
        check::check_table(&mut table)?;
        check::check_rules(self).map_err(|error| error.beside_the_unusual(self))
    }
}

fn syntax(origin: &str, error: &toml::de::Error) -> SceneError {
    SceneError::Syntax {
        origin: origin.to_owned(),
        reason: error.to_string(),
    }
}

/// Same, with what the line should have said where it holds a number that is written in another way.
fn syntax_in(text: &str, origin: &str, error: &toml::de::Error) -> SceneError {
    let start = error.span().map_or(0, |span| span.start);
    let before = text.get(..start).unwrap_or_default();
    let line = text.lines().nth(before.matches('\n').count());
    let meant = line.and_then(super::wrong::meant_in_line);
    let meant = meant.map_or_else(String::new, |words| format!("\n{words}"));
    SceneError::Syntax {
        origin: origin.to_owned(),
        reason: format!("{}{meant}", error.to_string().trim_end()),
    }
}

/// Reads a scene file, but never more than a scene can be.
fn read(file: &Path) -> Result<String, SceneError> {
    let path = &*file.to_string_lossy();
    let has_extension = file.extension().is_some();
    let looks_like_a_path = has_extension || path.contains(['/', '\\']);
    let failed = |error: std::io::Error| {
        if error.kind() == std::io::ErrorKind::NotFound && !looks_like_a_path {
            return SceneError::UnknownScene {
                name: super::error::shortened(path),
                nearest: nearest(path, presets::listed().map(|preset| preset.name))
                    .map(str::to_owned),
                presets: presets::names(),
            };
        }
        SceneError::Read {
            path: path.to_owned(),
            reason: error.to_string(),
        }
    };
    let bytes = read_up_to(file, LONGEST_FILE).map_err(failed)?;
    if bytes.len() as u64 > LONGEST_FILE {
        return Err(SceneError::Read {
            path: path.to_owned(),
            reason: "longer than 1 MiB, which no scene is".to_owned(),
        });
    }
    String::from_utf8(bytes).map_err(|_| SceneError::Read {
        path: path.to_owned(),
        reason: "not UTF-8 text".to_owned(),
    })
}
