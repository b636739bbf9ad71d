//! Reads back from a recording what repeats its run: the scene, the knobs turned by hand with the number of
//! steps made before each, and the last step.
//!
//! A file that breaks off (a killed run) is read up to there. One that the recorder had closed says so at its end, so
//! that what was cut off or damaged afterwards is no killed run.

use std::path::Path;

use thiserror::Error;

use super::messages::{self, Ends, FileRead};
use super::note::Note;
use asperity_engine::observe::{Began, SetBy};

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
    /// Where and why the file breaks off, in words; `None`: its recorder closed it.
    pub broken_off: Option<String>,
    /// What of a closed file cannot be read, in words; nothing that repeats the run was in it.
    pub damage: Option<String>,
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
    /// [`RereadError`] when the file cannot be read, is no recording of this program, is damaged where it matters, holds
    /// no step, or began from a saved state, which it does not hold.
    pub fn read(path: &Path) -> Result<Self, RereadError> {
        let refused = |reason: String| RereadError {
            path: path.display().to_string(),
            reason,
        };
        let mut found = FileContents::default();
        let read = messages::read_file(path, |data| {
            Note::all_in(data, |note| found.take_up(note));
        });
        read.and_then(|read| found.judge(&read)).map_err(refused)
    }
}

/// What is in the file.
#[derive(Default)]
struct FileContents {
    origin: Option<(String, Began, String)>,
    /// By the number turned before it.
    turns: Vec<(u64, SetBy, RecordedTurn)>,
    /// Last step, knobs turned, whether it was closed.
    reach: Option<(u64, u64, bool)>,
}

impl FileContents {
    fn take_up(&mut self, note: Note) {
        match note {
            Note::Origin {
                program,
                began,
                scene_toml,
            } => self.origin = Some((program, began, scene_toml)),
            Note::Turn {
                n,
                steps_made,
                key,
                value,
                by,
            } => {
                let turn = RecordedTurn {
                    steps_made,
                    key,
                    value,
                };
                self.turns.push((n, by, turn));
            }
            Note::Reach {
                last_step,
                turns,
                ended,
            } => self.reach = Some((last_step, turns, ended)),
        }
    }

    /// The run, or why it cannot be repeated.
    fn judge(mut self, read: &FileRead) -> Result<Recorded, String> {
        let (bytes, unreadable) = (read.bytes, read.unreadable);
        let unread = match &read.ends {
            Ends::Early { at, reason } => Some(format!(
                "it can be read up to byte {at} of {bytes} ({reason})"
            )),
            _ if unreadable > 0 => Some(format!("{unreadable} of its messages cannot be read")),
            // For which a full disk had no room, or which was cut off.
            Ends::WithTheFile if matches!(self.reach, Some((.., true))) => {
                Some("its index is missing".to_owned())
            }
            Ends::WithTheFile => Some("its end is missing".to_owned()),
            Ends::Closed => None,
        };
        let damage = unread
            .as_ref()
            .map_or_else(String::new, |words| format!("; {words}"));
        let Some((program, began, scene_toml)) = self.origin else {
            let ends = match read.ends {
                Ends::Closed => "",
                Ends::WithTheFile | Ends::Early { .. } => ", or broken off before it",
            };
            return Err(format!(
                "holds nothing that repeats a run: not recorded by this version of asperity{ends}{damage}"
            ));
        };
        if began == Began::FromState {
            let reason = "it went on from a saved state, which a recording does not hold; repeat it with \
                          --from-state";
            return Err(reason.to_owned());
        }
        let (last_step, turned, ended) = match self.reach {
            Some(reach) if reach.0 > 0 => reach,
            Some(_) => return Err(format!("it holds no step{damage}")),
            // A finished one holds that at its end, beside the knobs that were turned.
            None => {
                let lost = "a finished recording that was cut, or it breaks off in its first words: how far its run went \
                            is not in it";
                return Err(format!("{lost}{damage}"));
            }
        };
        // Of a run that was killed a turn may be there whose steps are not.
        self.turns.retain(|(n, ..)| *n < turned);
        self.turns.sort_by_key(|(n, ..)| *n);
        if self.turns.len() as u64 != turned || (0..).zip(&self.turns).any(|(k, turn)| turn.0 != k)
        {
            let there = self.turns.len();
            return Err(format!(
                "damaged: of {turned} knobs that were turned it holds {there}{damage}"
            ));
        }
        let by_hand = self.turns.into_iter().filter(|turn| turn.1 == SetBy::Hand);
        Ok(Recorded {
            program,
            scene_toml,
            turns: by_hand.map(|turn| turn.2).collect(),
            last_step,
            broken_off: (!ended).then(|| format!("breaks off after step {last_step}{damage}")),
            damage: unread.filter(|_| ended),
        })
    }
}
