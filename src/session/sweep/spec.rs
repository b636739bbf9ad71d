//! A sweep file: a scene, what is set in every case, what varies, and how cases start.
//!
//! ```toml
//! title = "Life against slide-to-roll ratio"
//! scene = "demonstration"                  # preset, TOML file (relative to this one), or a table [scene]
//! combine = "grid"                         # "grid": every combination; "list": the lists go side by side
//! [set]
//! load.force_n = 800.0                     # in every case
//! [vary]
//! motion.slide_roll = { from = 0.0, to = 2.0, n = 21, spacing = "linear" }
//! [chain]
//! longest = 7                              # cases that start from each other's end, 1: every case cold
//! passages = 1.0                           # passages of a case; left out: see below
//! ```
//! Instead of `[vary]` a file may give a path (`[gear]`, `[race]`, `[cam]`, see [`super::path`]).
//!
//! **Order.** Cases are numbered with the last axis running fastest. Axes stand in the order in which
//! `asperity scenes NAME` prints their keys, except that the keys which allow warm starts come last, S after
//! the amplitudes, because a chain runs along the last axis.

use std::path::PathBuf;

use toml::{Table, Value};

use super::axis::VariedKey;
use super::error::SweepError;
use super::path::{PathKind, PathPoint};
use super::reader::shown;
use super::ring::Ring;
use asperity_engine::scene::{ContactKind, Override, Scene, SceneError, Tooth};

/// How several axes combine.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Combine {
    /// Every combination, the last axis fastest.
    Grid,
    /// The k-th values of all axes together.
    List,
}

/// `[chain]`
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct ChainKeys {
    /// Most cases that start from each other's end.
    pub longest: usize,
    /// Lengths of 4 a after start-up or settling; `None`: 1, or as long as the scene asks for where material
    /// points must cross (life by counted cycles, damage maps).
    pub passages: Option<f64>,
}

/// A sweep as its file asks for it.
#[derive(Debug, Clone)]
pub struct Sweep {
    /// Name for files.
    pub name: String,
    /// One line about it.
    pub title: String,
    /// What varies, in the order of the table's columns.
    pub axes: Vec<VariedKey>,
    /// How axes combine.
    pub combine: Combine,
    /// How cases start.
    pub chain: ChainKeys,
    /// The points of a path, one a case; empty: no path.
    pub path: Vec<PathPoint>,
    /// The tooth that a path of a gear goes along.
    pub(super) tooth: Option<Tooth>,
    /// The ring that a path of a race goes round.
    pub(super) ring: Option<Ring>,
    /// The scene's text.
    pub(super) base: String,
    /// Keys set in every case.
    pub(super) set: Vec<(String, Value)>,
    /// The whole file with its scene in it: what a folder keeps.
    pub(super) text: String,
    /// The file as it was written.
    pub(super) source: String,
    /// Digests of the height maps that `[set]` and `[vary]` name; the scene holds those of its own.
    pub(super) maps: Vec<String>,
    /// Files that it is made of.
    pub(super) inputs: Vec<PathBuf>,
}

impl Sweep {
    /// Number of cases.
    pub fn len(&self) -> usize {
        match self.combine {
            Combine::Grid => self.axes.iter().map(|axis| axis.values.len()).product(),
            Combine::List => self.axes.first().map_or(1, |axis| axis.values.len()),
        }
    }

    /// Never: every sweep has a case.
    pub fn is_empty(&self) -> bool {
        self.len() == 0
    }

    /// Indices into the axes' values of a case.
    pub fn place(&self, case: usize) -> Vec<usize> {
        match self.combine {
            Combine::List => vec![case; self.axes.len()],
            Combine::Grid => {
                let mut rest = case;
                let mut place: Vec<usize> = self
                    .axes
                    .iter()
                    .rev()
                    .map(|axis| {
                        let k = rest % axis.values.len();
                        rest /= axis.values.len();
                        k
                    })
                    .collect();
                place.reverse();
                place
            }
        }
    }

    /// The values of a case, one an axis.
    pub fn values(&self, case: usize) -> Vec<&Value> {
        let places = self.place(case);
        let axes = self.axes.iter().zip(places);
        axes.map(|(axis, k)| &axis.values[k]).collect()
    }

    /// The values of a case in words.
    pub fn at(&self, case: usize) -> String {
        let values = self.values(case);
        let words = self.axes.iter().zip(values);
        let words: Vec<_> = words
            .map(|(axis, value)| format!("{} = {}", axis.key, shown(value)))
            .collect();
        words.join(", ")
    }

    /// The scene of a case, without recording: a case leaves one row.
    ///
    /// # Errors
    /// [`SweepError::Case`] that names the case, the key, the value and what is allowed.
    pub fn scene(&self, case: usize) -> Result<Scene, SweepError> {
        self.scene_of(case).map_err(|source| SweepError::Case {
            index: case,
            at: self.at(case),
            source,
        })
    }

    fn scene_of(&self, case: usize) -> Result<Scene, SceneError> {
        let axes = self.axes.iter().zip(self.values(case));
        let mut scene = self.scene_with(axes.map(|(axis, value)| (&axis.key, value)))?;
        scene.record = None;
        Ok(scene)
    }

    /// The scene that every case starts from, with `[set]`, before anything varies.
    ///
    /// # Errors
    /// As [`Sweep::scene`].
    pub fn base_scene(&self) -> Result<Scene, SceneError> {
        self.scene_with(std::iter::empty())
    }

    fn scene_with<'a>(
        &'a self,
        varied: impl Iterator<Item = (&'a String, &'a Value)>,
    ) -> Result<Scene, SceneError> {
        let set = self.set.iter().map(|(key, value)| (key, value));
        let overrides: Result<Vec<_>, _> = set
            .chain(varied)
            .map(|(key, value)| setting(key, value))
            .collect();
        Scene::from_toml_with(&self.base, "scene", &overrides?)
    }

    /// The header of a column: loads of a line are per metre of length.
    pub(super) fn header<'a>(&self, column: &'a str) -> &'a str {
        let is_line = self
            .base_scene()
            .is_ok_and(|scene| scene.kind() == ContactKind::Line);
        match column {
            "load_n" if is_line => "load_n_per_m",
            other => other,
        }
    }

    /// The keys of the path's table as the file has them, each with its value; empty: there is no path.
    pub fn path_keys(&self) -> Vec<(String, String)> {
        let file = self.text.parse::<Table>().unwrap_or_default();
        let tables = PathKind::ALL
            .into_iter()
            .filter_map(|kind| Some((kind.name(), file.get(kind.name())?.as_table()?)));
        let keys = tables.flat_map(|(name, table)| {
            table
                .iter()
                .map(move |(key, value)| (format!("{name}.{key}"), value.to_string()))
        });
        keys.collect()
    }

    /// The file as it was written.
    pub fn source(&self) -> &str {
        &self.source
    }

    /// The sweep in one file that needs no other, but height maps.
    pub fn to_toml(&self) -> &str {
        &self.text
    }

    /// Everything that decides the table, in one text: the digest is made of it.
    pub(super) fn canonical(&self) -> String {
        let set = self.set.iter().map(|(key, value)| format!("{key}={value}"));
        let axes = self.axes.iter().map(|axis| {
            let values: Vec<_> = axis.values.iter().map(Value::to_string).collect();
            format!("{} = {}", axis.key, values.join(" "))
        });
        format!(
            "{:?}\n{:?}\n{}\n{}\n{:?}\n{}\n{}",
            self.combine,
            self.chain,
            set.collect::<Vec<_>>().join("\n"),
            axes.collect::<Vec<_>>().join("\n"),
            self.path,
            self.maps.join("\n"),
            self.base
        )
    }
}

/// An override from a key and a TOML value.
pub(super) fn setting(key: &str, value: &Value) -> Result<Override, SceneError> {
    match value.as_str() {
        // The word that takes a key or a table out.
        Some("none") => format!("{key}=none").parse(),
        Some(_) | None => format!("{key}={value}").parse(),
    }
}
