//! What is a sweep's own in a folder, and who is in it.

use std::fs::{File, OpenOptions, TryLockError};
use std::path::{Path, PathBuf};
use std::sync::Arc;

use super::super::error::SweepError;
use super::claim::CLAIM;
use crate::program::BUILD;
use asperity_engine::files::{identity, open_plain, read_up_to};

/// Beginning of the mark: the format of the folder and its files.
const FORMAT: &str = "asperity sweep 3 ";
/// The file with the mark.
pub(super) const MARK: &str = "sweep.digest";
const LOCK: &str = "sweep.lock";
/// Beginning of the names of files that are being written.
pub(super) const TEMPORARY: &str = "temporary-";

/// Files with one name each.
const NAMES: [&str; 10] = [
    "sweep.toml",
    "base.toml",
    MARK,
    LOCK,
    "table.csv",
    "seconds.csv",
    "seeds.csv",
    "flank.csv",
    "report.html",
    "path.csv",
];

/// Longest text of a folder, bytes: a case has some kilobytes.
const LONGEST: u64 = 1 << 20;

/// What one of a folder's texts says; `None`: there is none, or what has its name is no text (a pipe, a device).
pub(super) fn text(path: &Path) -> Option<String> {
    let bytes = read_up_to(path, LONGEST).ok()?;
    String::from_utf8(bytes).ok()
}

/// What to do about a folder that holds cases already.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Existing {
    /// Refuse it.
    Refuse,
    /// Go on where they end.
    Resume,
    /// Throw them away.
    Replace,
}

/// What the folder of a sweep is marked with.
#[derive(Debug, Clone, PartialEq, Eq)]
pub(super) struct FolderMark {
    /// Digest of the sweep.
    pub(super) digest: String,
    /// Build that fills the folder.
    pub(super) build: String,
}

impl FolderMark {
    /// The mark of a sweep that this build runs.
    pub(super) fn new(digest: String) -> Self {
        let build = BUILD.to_owned();
        Self { digest, build }
    }

    /// The mark of a folder; `None`: no sweep has marked it.
    pub(super) fn read(root: &Path) -> Option<Self> {
        let text = text(&root.join(MARK))?;
        let (digest, build) = text.trim().strip_prefix(FORMAT)?.split_once(' ')?;
        Some(Self {
            digest: digest.to_owned(),
            build: build.to_owned(),
        })
    }

    pub(super) fn text(&self) -> String {
        format!("{FORMAT}{} {}\n", self.digest, self.build)
    }
}

/// The mark of a folder that a sweep may work in: its own, or none in a folder that is empty.
pub(super) fn seen(root: &Path) -> Result<Option<FolderMark>, SweepError> {
    let found = FolderMark::read(root);
    let Some(name) = stranger(root).filter(|_| found.is_none()) else {
        return Ok(found);
    };
    // Another process may have begun here since: its mark comes before all else.
    let since = FolderMark::read(root);
    if since.is_none() {
        let reason = format!(
            "holds {name}, and no sweep has marked the folder: its contents are somebody else's; choose another --out"
        );
        return Err(SweepError::folder(root, reason));
    }
    Ok(since)
}

/// Something in a folder that no sweep put there; hidden files and what sweeps need before they mark a folder do not
/// count.
fn stranger(root: &Path) -> Option<String> {
    let entries = std::fs::read_dir(root).into_iter().flatten().flatten();
    let mut names = entries.map(|entry| entry.file_name().to_string_lossy().into_owned());
    names.find(|name| name != LOCK && !name.starts_with(TEMPORARY) && !name.starts_with('.'))
}

/// The first input that lies where the sweep writes. `keeps_scenes`: `sweep.toml` and `base.toml` stay as they are.
pub(super) fn input_in_the_way<'a>(
    root: &Path,
    inputs: &'a [PathBuf],
    keeps_scenes: bool,
) -> Option<&'a Path> {
    let folder = identity(root);
    let is_written = |path: &PathBuf| {
        let path = identity(path);
        let name = path.file_name().unwrap_or_default().to_string_lossy();
        let stays = keeps_scenes && (name == "sweep.toml" || name == "base.toml");
        path.parent() == Some(folder.as_path()) && NAMES.contains(&&*name) && !stays
    };
    inputs
        .iter()
        .find(|path| is_written(path))
        .map(PathBuf::as_path)
}

/// Whether a case or a state of a chain has that name.
pub(super) fn is_numbered(name: &str, ending: &str) -> bool {
    let stem = name.strip_suffix(ending);
    stem.is_some_and(|stem| {
        let digits = |part: &str| part.len() >= 7 && part.bytes().all(|c| c.is_ascii_digit());
        stem.split('-').all(digits)
    })
}

/// Whether a table or a picture has that name.
fn is_result(name: &str) -> bool {
    const PICTURES: [&str; 15] = [
        "life_against_",
        "traction_against_",
        "pressure_against_",
        "film_against_",
        "mechanisms_against_",
        "contacts_against_",
        "lambda_against_",
        "pits_against_",
        "worn_against_",
        "stribeck.",
        "life_map.",
        "pits_map.",
        "worn_map.",
        "life_over_seeds.",
        "pits_over_seeds.",
    ];
    let drawn = |name: &str| PICTURES.iter().any(|picture| name.starts_with(picture));
    let path = Path::new(name);
    let ending = path.extension().unwrap_or_default();
    match ending.to_str() {
        Some("svg" | "png") => drawn(name),
        _ => NAMES[4..].contains(&name),
    }
}

/// Takes away what the sweep that marked the folder has made, and nothing else.
pub(super) fn clear(root: &Path) -> Result<(), SweepError> {
    let cases = |name: &str| is_numbered(name, ".json");
    let states = |name: &str| is_numbered(name, ".state");
    let claims = |name: &str| is_numbered(name, CLAIM);
    take_away(&root.join("cases"), cases)?;
    take_away(&root.join("chains"), states)?;
    take_away(&root.join("chains"), claims)?;
    take_away(root, is_result)
}

/// Takes away what processes that were killed left half-written. Only where nobody else can be writing: how old a file is
/// says nothing where clocks differ or jump.
pub(super) fn tidy(root: &Path) {
    // One that stays behind does no harm.
    drop(take_away(root, |name| name.starts_with(TEMPORARY)));
    drop(take_away(&root.join("chains"), |name| {
        is_numbered(name, CLAIM)
    }));
}

/// Takes away the files of a folder whose names are such.
fn take_away(folder: &Path, such: impl Fn(&str) -> bool) -> Result<(), SweepError> {
    for entry in std::fs::read_dir(folder).into_iter().flatten().flatten() {
        let path = entry.path();
        if such(&entry.file_name().to_string_lossy()) && path.is_file() {
            std::fs::remove_file(&path).map_err(|error| SweepError::folder(&path, error))?;
        }
    }
    Ok(())
}

/// Says that this process is in a folder, for as long as it is; ends with the process however that ends.
#[derive(Debug, Clone)]
pub(super) struct Lock(#[expect(dead_code, reason = "held")] Option<Arc<File>>);

/// An entry into a folder: nobody else comes in before [`Entry::share`].
pub(super) struct Entry {
    /// `None`: the system knows no locks.
    file: Option<File>,
    /// Nobody else is there.
    pub(super) is_alone: bool,
}

impl Entry {
    /// Enters a folder: to begin in it nobody else may be there. Where the system knows no locks everybody begins.
    pub(super) fn new(root: &Path, existing: Existing) -> Result<Self, SweepError> {
        let path = root.join(LOCK);
        let failed = |error| SweepError::folder(&path, error);
        if path.exists() {
            // A pipe would wait for somebody.
            open_plain(&path).map_err(failed)?;
        }
        let mut options = OpenOptions::new();
        options.read(true).write(true).create(true).truncate(false);
        let file = options.open(&path).map_err(failed)?;
        let locked = if existing == Existing::Resume {
            // Whoever begins lets others in at once.
            file.lock().map_err(TryLockError::Error)
        } else {
            file.try_lock()
        };
        let is_entering = matches!(locked, Err(TryLockError::WouldBlock));
        let is_there = is_entering || is_held(&root.join(MARK));
        if is_there && existing != Existing::Resume {
            let reason = "another sweep is working in it; --resume joins it";
            return Err(SweepError::folder(root, reason));
        }
        Ok(Self {
            is_alone: locked.is_ok() && !is_there,
            file: locked.is_ok().then_some(file),
        })
    }

    /// Lets others in. That somebody is there they see by the mark: a lock on the way in would have to be given up and
    /// taken again, and one who comes in between would believe himself alone.
    pub(super) fn share(self, root: &Path) -> Lock {
        let mark = open_plain(&root.join(MARK)).ok();
        let mark = mark.filter(|mark| self.file.is_some() && mark.lock_shared().is_ok());
        Lock(mark.map(Arc::new))
    }
}

/// Whether somebody works in the folder with that mark.
fn is_held(mark: &Path) -> bool {
    let tried = open_plain(mark).map(|mark| mark.try_lock());
    matches!(tried, Ok(Err(TryLockError::WouldBlock)))
}

impl Lock {
    /// For one who reads only.
    pub(super) fn none() -> Self {
        Self(None)
    }
}
