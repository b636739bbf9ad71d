//! What is done of a study, in a file beside its report: one of hours goes on where it was stopped.
//!
//! ```text
//! first line    {"by": program and set}              another one: begun anew
//! the others    {"job": name, "found": result}       as jobs end; one that is torn, or holds what JSON has no number for, is done again
//! ```

use std::collections::HashMap;
use std::fs::File;
use std::hash::{DefaultHasher, Hash as _, Hasher as _};
use std::io::Write as _;
use std::path::{Path, PathBuf};
use std::sync::Mutex;

use serde::{Deserialize, Serialize};

use super::EvidenceResult;
use super::set::SET;

/// Which program found it, of which set.
#[derive(Debug, PartialEq, Serialize, Deserialize)]
struct KeptHead {
    by: String,
}

/// One job that has ended.
#[derive(Debug, Serialize, Deserialize)]
struct KeptJob {
    job: String,
    found: EvidenceResult,
}

/// Results of an earlier run, and where those of this one go.
#[derive(Debug, Default)]
pub(super) struct Kept {
    known: HashMap<String, EvidenceResult>,
    file: Option<Mutex<File>>,
}

/// The file in a folder of reports.
pub fn kept_in(folder: &Path) -> PathBuf {
    folder.join("evidence.part.jsonl")
}

impl Kept {
    /// Takes up what stands in the folder; `None`: nothing is kept.
    ///
    /// # Errors
    /// When the file can't be written.
    pub(super) fn open(folder: Option<&Path>) -> std::io::Result<Self> {
        let Some(folder) = folder else {
            return Ok(Self::default());
        };
        let path = kept_in(folder);
        let mut hasher = DefaultHasher::new();
        SET.hash(&mut hasher);
        let head = KeptHead {
            by: format!(
                "{}, set {:016x}",
                asperity_session::program::PROGRAM,
                hasher.finish()
            ),
        };
        std::fs::create_dir_all(folder)?;
        let known = std::fs::read_to_string(&path)
            .ok()
            .and_then(|text| read(&text, &head));
        let mut file = match &known {
            Some(_) => File::options().append(true).open(&path)?,
            None => File::create(&path)?,
        };
        // After a torn line a new one begins.
        match &known {
            Some(_) => writeln!(file)?,
            None => writeln!(file, "{}", serde_json::to_string(&head)?)?,
        }
        Ok(Self {
            known: known.unwrap_or_default(),
            file: Some(Mutex::new(file)),
        })
    }

    /// What is known of a job.
    pub(super) fn known(&self, job: &str) -> Option<EvidenceResult> {
        self.known.get(job).cloned()
    }

    /// Keeps a result. On a full disk it is not kept: the report at the end says so, and is what counts.
    pub(super) fn keep(&self, job: &str, found: &EvidenceResult) {
        let line = serde_json::to_string(&KeptJob {
            job: job.to_owned(),
            found: found.clone(),
        });
        if let (Some(file), Ok(line)) = (&self.file, line)
            && let Ok(mut file) = file.lock()
        {
            drop(writeln!(file, "{line}"));
        }
    }
}

/// The jobs of a file with this head; `None`: it has another one.
fn read(text: &str, head: &KeptHead) -> Option<HashMap<String, EvidenceResult>> {
    let mut lines = text.lines();
    let theirs = serde_json::from_str::<KeptHead>(lines.next()?).ok()?;
    (theirs == *head).then(|| {
        lines
            .filter_map(|line| serde_json::from_str::<KeptJob>(line).ok())
            .map(|kept| (kept.job, kept.found))
            .collect()
    })
}
