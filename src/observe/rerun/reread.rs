//! Reads back from a recording what repeats its run: the scene, the knobs turned by hand with the number of
//! steps made before each, and the last step.
//!
//! A file that breaks off (a killed run) is read up to there.

use std::path::Path;

use rerun::external::re_log_encoding::DecoderApp;
use rerun::log::{Chunk, LogMsg};
use serde::{Deserialize, Serialize};
use thiserror::Error;

use super::moment::STEP;
use super::text::{COMMANDS, ORIGIN, SCENE_TOML};
use crate::observe::{Began, SetBy};

/// Version of what a recording holds for repeating its run; those before it was counted are 0.
const FORMAT: u32 = 1;

/// What a recording says of itself.
#[derive(Debug, Serialize, Deserialize)]
struct Head<T> {
    #[serde(default)]
    format: u32,
    #[serde(flatten)]
    origin: T,
}

/// How a run began, as the recording holds it.
#[derive(Debug, Serialize, Deserialize)]
pub(super) struct Origin {
    pub(super) program: String,
    pub(super) began: Began,
}

/// A knob that was turned, as the recording holds it.
#[derive(Debug, Serialize, Deserialize)]
pub(super) struct CommandLine {
    pub(super) steps_made: u64,
    pub(super) key: String,
    pub(super) value: f64,
    pub(super) by: SetBy,
}

impl Origin {
    pub(super) fn to_text(&self) -> String {
        let format = FORMAT;
        to_json(&Head {
            format,
            origin: self,
        })
    }
}

impl CommandLine {
    pub(super) fn to_text(&self) -> String {
        to_json(self)
    }
}

/// Strings, numbers and unit variants: nothing that JSON could not hold.
fn to_json(value: &impl Serialize) -> String {
    serde_json::to_string(value).unwrap_or_default()
}

/// A knob turned by hand.
#[derive(Debug, Clone, PartialEq)]
pub struct RecordedTurn {
    /// Steps that the run had made, those of the start-up too.
    pub steps_made: u64,
    /// Scene key.
    pub key: String,
    /// SI value.
    pub value: f64,
}

/// What repeats a run.
#[derive(Debug, Clone, PartialEq)]
pub struct Recorded {
    /// Program and version that recorded it.
    pub program: String,
    /// The scene as TOML, with what was set on the command line.
    pub scene_toml: String,
    /// Knobs turned by hand, in order. Those of the scene's own script are in the scene.
    pub turns: Vec<RecordedTurn>,
    /// The last step that the file holds.
    pub last_step: u64,
}

/// A recording that cannot be repeated.
#[derive(Debug, Clone, PartialEq, Eq, Error)]
#[error("{path}: {reason}")]
pub struct RereadError {
    /// File.
    pub path: String,
    /// Why.
    pub reason: String,
}

impl Recorded {
    /// Reads a recording of a run or of the explorer.
    ///
    /// # Errors
    /// [`RereadError`] when the file cannot be read, is no recording of this program, holds no step, or
    /// began from a saved state, which it does not hold.
    pub fn read(path: &Path) -> Result<Self, RereadError> {
        let refused = |reason: String| RereadError {
            path: path.display().to_string(),
            reason,
        };
        let file = crate::files::open_plain(path)
            .map_err(|error| refused(format!("cannot be read: {error}")))?;
        let found = Found::read(std::io::BufReader::new(file)).map_err(refused)?;
        let (Some(scene_toml), Some(origin)) = (found.scene_toml, found.origin) else {
            return Err(refused("no recording that asperity made".to_owned()));
        };
        let Head { format, origin } = serde_json::from_str::<Head<Origin>>(&origin)
            .map_err(|error| refused(format!("its origin cannot be read: {error}")))?;
        if format > FORMAT {
            return Err(refused(format!(
                "a later version made it, {}",
                origin.program
            )));
        }
        if origin.began == Began::FromState {
            let reason = "it went on from a saved state, which a recording does not hold; repeat it with \
                          --from-state";
            return Err(refused(reason.to_owned()));
        }
        if found.last_step == 0 {
            return Err(refused("it holds no step".to_owned()));
        }
        let mut turns = Vec::with_capacity(found.commands.len());
        for text in &found.commands {
            let line: CommandLine = serde_json::from_str(text)
                .map_err(|error| refused(format!("a command cannot be read: {error}")))?;
            if line.by == SetBy::Hand {
                turns.push(RecordedTurn {
                    steps_made: line.steps_made,
                    key: line.key,
                    value: line.value,
                });
            }
        }
        Ok(Self {
            program: origin.program,
            scene_toml,
            turns,
            last_step: found.last_step,
        })
    }
}

/// What is in the file, as it is there.
#[derive(Default)]
struct Found {
    scene_toml: Option<String>,
    origin: Option<String>,
    commands: Vec<String>,
    last_step: u64,
}

impl Found {
    fn read(reader: impl std::io::BufRead) -> Result<Self, String> {
        let mut found = Self::default();
        let messages = DecoderApp::decode_eager(reader)
            .map_err(|error| format!("no Rerun recording: {error}"))?;
        for message in messages {
            // From where the file breaks off nothing more can be read.
            let Ok(message) = message else { break };
            if let LogMsg::ArrowMsg(store, message) = message
                && store.is_recording()
            {
                let chunk = Chunk::from_arrow_msg(&message).map_err(|error| error.to_string())?;
                found.take_up(&chunk);
            }
        }
        Ok(found)
    }

    fn take_up(&mut self, chunk: &Chunk) {
        let entity = chunk.entity_path().to_string();
        let document = rerun::TextDocument::descriptor_text().component;
        match entity.trim_start_matches('/') {
            SCENE_TOML => self.scene_toml = strings(chunk, document).pop(),
            ORIGIN => self.origin = strings(chunk, document).pop(),
            COMMANDS => {
                let text = rerun::TextLog::descriptor_text().component;
                self.commands.extend(strings(chunk, text));
            }
            _ => {}
        }
        let steps = chunk.timelines().get(&STEP.into());
        let last = steps.and_then(|steps| steps.times_raw().iter().copied().max());
        let last = last.and_then(|step| u64::try_from(step).ok()).unwrap_or(0);
        self.last_step = self.last_step.max(last);
    }
}

fn strings(chunk: &Chunk, component: rerun::ComponentIdentifier) -> Vec<String> {
    chunk
        .iter_slices::<String>(component)
        .flat_map(|row| row.iter().map(ToString::to_string).collect::<Vec<_>>())
        .collect()
}
