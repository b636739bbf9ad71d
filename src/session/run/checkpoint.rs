//! A run's state in a file: JSON behind one line with format and digest.
//!
//! ```text
//! asperity state 5 <FNV-1a of the rest, hexadecimal>
//! { "program": ..., "scene": ..., "n_events_played": ..., "n_unconverged": ..., "stats": { ... }, "sim": { ... } }
//! ```
//! Numbers are written with as many digits as read back to the same bits.

use std::io::{Read as _, Write as _};
use std::path::Path;

use serde::{Deserialize, Serialize};
use thiserror::Error;

use super::ladder::Climb;
use asperity_engine::files::fnv;
use asperity_engine::scene::Scene;
use asperity_engine::sim::{State, Stats};

const MAGIC: &str = "asperity state 5 ";
/// Nodes per side of the finest grid.
const FINEST: usize = 1025;
/// Digits of the digest.
const DIGITS: usize = 16;
/// Longest state, bytes: three times what the greatest was seen to take (300 for a node; 2.4 million of a line), with
/// room for what does not grow with the grid, up to sixteen million numbers of the steps of a period and of a round among it.
const LONGEST_NODE: u64 = 1 << 10;
const LONGEST_REST: u64 = 288 << 20;

/// Everything that a run needs to go on.
#[derive(Debug, Clone, Serialize, Deserialize)]
pub struct Checkpoint {
    /// Program and version that wrote it.
    pub program: String,
    /// Its scene, as TOML.
    pub scene: String,
    /// Scripted events that have been played, in the order of their times.
    pub n_events_played: usize,
    /// Steps so far that did not converge.
    pub n_unconverged: u64,
    /// Knobs turned by hand so far: it goes on from where they stand, where the scene's own run would not be.
    pub n_turned_by_hand: usize,
    /// Work that was counted.
    pub stats: Stats,
    /// How far it has climbed its meshes.
    #[serde(default)]
    pub climb: Climb,
    /// The simulation.
    pub sim: State,
}

/// A state that cannot be taken up or written.
#[derive(Debug, Clone, PartialEq, Eq, Error)]
pub enum CheckpointError {
    /// The file cannot be read or is no state.
    #[error("{path}: {reason}")]
    File {
        /// File.
        path: String,
        /// Why.
        reason: String,
    },
    /// The scene that it was saved with cannot be read any more: another version, or a height map that changed.
    #[error("the saved state's own scene: {0}")]
    SavedScene(String),
    /// It belongs to another scene.
    #[error("the saved state belongs to another scene: {0} differs")]
    OtherScene(&'static str),
}

/// Longest state of a grid of so many nodes per side, bytes.
fn longest(nodes: usize) -> u64 {
    let nodes = nodes as u64;
    LONGEST_REST + LONGEST_NODE * nodes * nodes
}

impl Checkpoint {
    /// Reads a file.
    ///
    /// # Errors
    /// [`CheckpointError::File`] when it cannot be read, is cut short, changed or no state at all.
    pub fn read(path: &Path) -> Result<Self, CheckpointError> {
        Self::read_up_to(path, longest(FINEST))
    }

    /// Reads a file for a run of `scene`: none that is longer than its states are.
    ///
    /// # Errors
    /// As [`Checkpoint::read`] and [`Checkpoint::fits`].
    pub fn read_for(path: &Path, scene: &Scene) -> Result<Self, CheckpointError> {
        let saved = Self::read_up_to(path, longest(scene.grid.nodes))?;
        saved.fits(scene)?;
        Ok(saved)
    }

    fn read_up_to(path: &Path, most: u64) -> Result<Self, CheckpointError> {
        let failed = |reason: String| CheckpointError::File {
            path: path.display().to_string(),
            reason,
        };
        let io = |error: std::io::Error| failed(error.to_string());
        let about = std::fs::metadata(path).map_err(io)?;
        if !about.is_file() {
            // Opening a pipe may wait for ever, and reading a device may never end.
            return Err(failed("not a regular file".to_owned()));
        }
        if about.len() > most {
            let reason = format!("{} bytes, more than any state on its grid", about.len());
            return Err(failed(reason));
        }
        let mut file = std::fs::File::open(path).map_err(io)?;
        let mut head = vec![0; MAGIC.len() + DIGITS + 1];
        let whole = file.read_exact(&mut head);
        let head = String::from_utf8_lossy(&head);
        let digest = head
            .strip_prefix(MAGIC)
            .and_then(|rest| rest.strip_suffix('\n'));
        let Some(digest) = digest.filter(|_| whole.is_ok()) else {
            return Err(failed(
                "no state, or one of an earlier format (this build reads format 5)".to_owned(),
            ));
        };
        let mut body = String::new();
        let mut rest = file.take(most);
        rest.read_to_string(&mut body).map_err(io)?;
        if digest != format!("{:016x}", fnv(body.as_bytes())) {
            return Err(failed(
                "cut short or changed: its digest is wrong".to_owned(),
            ));
        }
        serde_json::from_str(&body).map_err(|error| failed(error.to_string()))
    }

    /// Writes it to an open file.
    ///
    /// # Errors
    /// When the disk says no, or when what would be written could not be read again.
    pub fn write(&self, file: &mut std::fs::File) -> std::io::Result<()> {
        let body = serde_json::to_string(self)?;
        // JSON has no infinity: better no state, and told, than one that nothing can load.
        serde_json::from_str::<Self>(&body)?;
        writeln!(file, "{MAGIC}{:016x}", fnv(body.as_bytes()))?;
        file.write_all(body.as_bytes())?;
        file.sync_all()
    }

    /// Whether it is one of the scene's own mesh.
    pub(super) fn is_on_top(&self, scene: &Scene) -> bool {
        self.climb.nodes == 0 || self.climb.nodes == scene.grid.nodes
    }

    /// Whether a run of `scene` can go on from here: all must agree but words, outputs and the length of
    /// the run.
    ///
    /// # Errors
    /// [`CheckpointError::OtherScene`] names the table that differs.
    pub fn fits(&self, scene: &Scene) -> Result<(), CheckpointError> {
        let saved = Scene::from_toml(&self.scene)
            .map_err(|error| CheckpointError::SavedScene(error.to_string()))?;
        let Scene {
            title: _,
            about: _,
            contact,
            body_1,
            body_2,
            lubricant,
            friction,
            motion,
            load,
            grid,
            time,
            numerics,
            stress,
            life,
            heat,
            wear,
            age,
            tooth: _,
            record: _,
            events,
        } = scene;
        let mut time_asked = time.clone();
        time_asked.passages = saved.time.passages;
        let agree = [
            (saved.contact == *contact, "[contact]"),
            (saved.body_1 == *body_1, "[body_1]"),
            (saved.body_2 == *body_2, "[body_2]"),
            (saved.lubricant == *lubricant, "[lubricant]"),
            (saved.friction == *friction, "[friction]"),
            (saved.motion == *motion, "[motion]"),
            (saved.load == *load, "[load]"),
            (saved.grid == *grid, "[grid]"),
            (saved.time == time_asked, "[time]"),
            (saved.numerics == *numerics, "[numerics]"),
            (saved.stress == *stress, "[stress]"),
            (saved.life == *life, "[life]"),
            (saved.heat == *heat, "[heat]"),
            (saved.wear == *wear, "[wear]"),
            (saved.age == *age, "[age]"),
            (saved.events == *events, "[[event]]"),
        ];
        match agree.into_iter().find(|(same, _)| !same) {
            Some((_, table)) => Err(CheckpointError::OtherScene(table)),
            None => Ok(()),
        }
    }
}
