//! Writing: beside, brought to the disk, renamed, the folder brought to the disk. Whatever breaks it off leaves the
//! old file or the new one.
//!
//! The crate `tempfile` was measured in place of names and links: a file of 20 kB takes the same time to 2 % (9.3 ms, the
//! disk), 20 lines of 60 would go, those that bring files and folders to the disk stay. Lost would be file systems
//! without links, and the process in the name.

use std::fs::{File, OpenOptions};
use std::io::{ErrorKind, Result};
use std::path::{Path, PathBuf};
use std::sync::atomic::{AtomicU64, Ordering};

/// The folder that a file lies in.
pub fn folder_of(path: &Path) -> &Path {
    match path.parent() {
        Some(folder) if !folder.as_os_str().is_empty() => folder,
        _ => Path::new("."),
    }
}

/// A name beside `path` with the same ending that nobody has: `run.rrd` is written as `run.part-4711-0.rrd`.
pub fn part_of(path: &Path) -> PathBuf {
    static COUNT: AtomicU64 = AtomicU64::new(0);
    let n = COUNT.fetch_add(1, Ordering::Relaxed);
    beside(path, &format!("part-{}-{n}", std::process::id()))
}

/// A name beside `path` with the same ending and a word before it.
pub fn beside(path: &Path, word: &str) -> PathBuf {
    let mut name = format!("{}.{word}", stem_beside(path));
    if let Some(ending) = path.extension() {
        name.push('.');
        name.push_str(&ending.to_string_lossy());
    }
    path.with_file_name(name)
}

/// What names beside `path` begin with: its stem, of a long name as much as leaves room for the rest.
pub fn stem_beside(path: &Path) -> String {
    /// Bytes that file systems give a name, and that the word and its points take.
    const NAME: usize = 255;
    const WORD: usize = 40;
    let mut stem = path
        .file_stem()
        .unwrap_or_default()
        .to_string_lossy()
        .into_owned();
    let ending = path.extension().map_or(0, std::ffi::OsStr::len);
    let room = NAME.saturating_sub(WORD + ending);
    while stem.len() > room {
        stem.pop();
    }
    stem
}

/// What two spellings of one file have in common: its path without links and dots.
pub fn identity(path: &Path) -> PathBuf {
    if let Ok(real) = path.canonicalize() {
        return real;
    }
    match (folder_of(path).canonicalize(), path.file_name()) {
        (Ok(folder), Some(name)) => folder.join(name),
        _ => std::path::absolute(path).unwrap_or_else(|_| path.to_owned()),
    }
}

/// Brings a file to the disk.
///
/// # Errors
/// When the disk refuses.
pub fn sync_file(path: &Path) -> Result<()> {
    OpenOptions::new().write(true).open(path)?.sync_all()
}

/// Brings the names in a folder to the disk, where the system can.
pub fn sync_folder(folder: &Path) {
    // Not every system opens folders; the name is then as safe as the system makes it.
    if let Ok(folder) = File::open(folder) {
        drop(folder.sync_all());
    }
}

/// Gives a whole file its name. `replaces`: it may take the name of another.
///
/// # Errors
/// When the name cannot be given.
pub fn publish(part: &Path, path: &Path, replaces: bool) -> Result<()> {
    if replaces {
        std::fs::rename(part, path)?;
    } else {
        match std::fs::hard_link(part, path) {
            Ok(()) => std::fs::remove_file(part)?,
            Err(error) if error.kind() == ErrorKind::AlreadyExists => return Err(error),
            // A file system without links: the name is free unless somebody was faster than these two lines.
            Err(_) if !path.exists() => std::fs::rename(part, path)?,
            Err(error) => return Err(error),
        }
    }
    sync_folder(folder_of(path));
    Ok(())
}

/// Lets somebody write a file under another name with the same ending, and gives it its own when it is whole.
///
/// # Errors
/// When the writer or the disk says no: the old file is as it was and nothing else is left.
pub fn write_whole<T>(
    path: &Path,
    replaces: bool,
    writer: impl FnOnce(&Path) -> Result<T>,
) -> Result<T> {
    let part = part_of(path);
    let written = writer(&part).and_then(|value| {
        sync_file(&part)?;
        publish(&part, path, replaces)?;
        Ok(value)
    });
    if written.is_err() {
        // It may never have been there.
        drop(std::fs::remove_file(&part));
    }
    written
}

#[cfg(test)]
#[expect(clippy::unwrap_used, reason = "tests")]
mod tests {
    use super::*;

    fn names(folder: &Path) -> Vec<String> {
        let mut names: Vec<String> = std::fs::read_dir(folder)
            .unwrap()
            .map(|entry| entry.unwrap().file_name().into_string().unwrap())
            .collect();
        names.sort();
        names
    }

    #[test]
    fn a_writer_that_fails_leaves_the_old_file_and_nothing_else() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("state.txt");
        write_whole(&path, false, |at| std::fs::write(at, "old")).unwrap();
        let failed = write_whole(&path, true, |at| {
            std::fs::write(at, "half")?;
            Err::<(), _>(std::io::Error::other("full"))
        });
        assert!(failed.is_err());
        assert_eq!(std::fs::read_to_string(&path).unwrap(), "old");
        let taken = write_whole(&path, false, |at| std::fs::write(at, "new")).unwrap_err();
        assert_eq!(taken.kind(), ErrorKind::AlreadyExists);
        assert_eq!(std::fs::read_to_string(&path).unwrap(), "old");
        write_whole(&path, true, |at| std::fs::write(at, "new")).unwrap();
        assert_eq!(std::fs::read_to_string(&path).unwrap(), "new");
        assert_eq!(names(folder.path()), ["state.txt"]);
    }

    #[test]
    fn spellings_of_one_file_are_one() {
        let folder = tempfile::tempdir().unwrap();
        let (one, other) = (
            folder.path().join("a.csv"),
            folder.path().join("./b/../a.csv"),
        );
        std::fs::create_dir(folder.path().join("b")).unwrap();
        assert_eq!(identity(&one), identity(&other));
        std::fs::write(&one, "").unwrap();
        assert_eq!(identity(&one), identity(&other));
        assert_ne!(identity(&one), identity(&folder.path().join("c.csv")));
    }
}
