//! Who works on which chain: `chains/0000003.claim`.
//!
//! The file is locked by whoever works on the chain, and the lock ends with its process however that ends: what the dead had
//! claimed is free at once. Where the system knows no locks whoever made the file has it, until the chain is done or, on his
//! own machine, his process is gone.
//!
//! Two who work on one chain write the same bytes: a claim saves work, and the table does not depend on it.

use std::fs::{File, OpenOptions, TryLockError};
use std::io::Write as _;
use std::path::{Path, PathBuf};

use super::super::error::SweepError;
use super::Folder;
use super::mark::{is_numbered, text};
use asperity_engine::files::open_plain;

/// Ending of the names of claims.
pub(super) const CLAIM: &str = ".claim";

/// A chain is being worked on by this process.
#[derive(Debug)]
pub(in super::super) struct Claim {
    path: PathBuf,
    #[expect(dead_code, reason = "held")]
    file: File,
}

impl Claim {
    /// The chain is done. Who opened the claim before it went sees that as well.
    pub(in super::super) fn done(self) {
        // One that stays behind is nobody's.
        drop(std::fs::remove_file(&self.path));
    }
}

/// A chain that somebody has begun and not ended.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Claimed {
    /// Its number.
    pub chain: usize,
    /// Machine and process.
    pub by: String,
    /// Whether the process is there.
    pub is_alive: bool,
}

/// This machine's name; empty where there is none.
pub(super) fn host() -> String {
    let name = std::fs::read_to_string("/proc/sys/kernel/hostname").unwrap_or_default();
    name.trim().to_owned()
}

/// Whether a claim without a lock may still be somebody's: only of this machine the processes are known.
fn may_live(by: &str) -> bool {
    let Some((machine, process)) = by.trim().rsplit_once(" process ") else {
        return true;
    };
    machine != host() || Path::new("/proc").join(process).exists()
}

impl Folder {
    /// Takes a chain; `None`: somebody else has it.
    ///
    /// # Errors
    /// [`SweepError::Folder`] when the disk says no.
    pub(in super::super) fn claim(&self, chain: usize) -> Result<Option<Claim>, SweepError> {
        let path = self.root.join("chains").join(format!("{chain:07}{CLAIM}"));
        let failed = |error| SweepError::folder(&path, error);
        let mut options = OpenOptions::new();
        options.read(true).write(true);
        let made = options.clone().create_new(true).open(&path);
        let is_new = made.is_ok();
        let opened = made.or_else(|_| {
            // A pipe would wait for somebody.
            open_plain(&path).and_then(|_| options.open(&path))
        });
        let mut file = match opened {
            Ok(file) => file,
            // Done by somebody between the two.
            Err(error) if error.kind() == std::io::ErrorKind::NotFound => return Ok(None),
            Err(error) => return Err(failed(error)),
        };
        let is_free = match file.try_lock() {
            Ok(()) => true,
            Err(TryLockError::WouldBlock) => false,
            Err(TryLockError::Error(_)) => is_new || !text(&path).is_some_and(|by| may_live(&by)),
        };
        if !is_free {
            return Ok(None);
        }
        let by = format!("{} process {}\n", host(), std::process::id());
        let told = file.set_len(0).and_then(|()| file.write_all(by.as_bytes()));
        told.map_err(failed)?;
        Ok(Some(Claim { path, file }))
    }

    /// The chains that somebody has begun and not ended.
    pub fn claimed(&self) -> Vec<Claimed> {
        let entries = std::fs::read_dir(self.root.join("chains"));
        let mut claimed: Vec<_> = entries
            .into_iter()
            .flatten()
            .flatten()
            .filter_map(|entry| {
                let name = entry.file_name().to_string_lossy().into_owned();
                let chain = name
                    .strip_suffix(CLAIM)
                    .filter(|_| is_numbered(&name, CLAIM))?;
                let by = text(&entry.path())?.trim().to_owned();
                let is_alive = match open_plain(&entry.path()).ok()?.try_lock_shared() {
                    Ok(()) => false,
                    Err(TryLockError::WouldBlock) => true,
                    Err(TryLockError::Error(_)) => may_live(&by),
                };
                let chain = chain.parse().ok()?;
                Some(Claimed {
                    chain,
                    by,
                    is_alive,
                })
            })
            .collect();
        claimed.sort_by_key(|claim| claim.chain);
        claimed
    }
}
