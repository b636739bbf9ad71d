//! Where an output's file lies while it is written, and where when it is done.
//!
//! | there before | while it is written | when it is done | after a kill |
//! |---|---|---|---|
//! | nothing | until something came beside it, as `NAME.part-PID-N.ENDING`; then under its name | under its name; gone if nothing came | the same |
//! | a file, `--force` | beside it, as `NAME.part-PID-N.ENDING` | in place of it; it stays if nothing came | the old file; the new one beside it |
//! | a device | in it | | |
//!
//! A file that another run is writing is refused, by a lock that ends with its process. A killed run leaves a name free
//! until there is something that is worth it.

use std::fs::{File, OpenOptions, TryLockError};
use std::io::ErrorKind;
use std::path::{Path, PathBuf};

use super::ObserveError;
use crate::files::{folder_of, open_plain, part_of, publish, sync_file, sync_folder, write_whole};

/// What to do with an output file that is there already.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum Overwrite {
    /// It is left alone and the output is refused.
    #[default]
    Refuse,
    /// It is replaced once its successor is whole.
    Replace,
}

/// What a name leads to.
enum There {
    Nothing,
    /// A plain file, links followed.
    File(PathBuf),
    /// Something that is written into: a device, a pipe.
    Device,
}

impl Overwrite {
    /// What `--force` means.
    pub fn from_force(force: bool) -> Self {
        if force { Self::Replace } else { Self::Refuse }
    }

    /// Sees that a file of that name can be written when the time comes. Nothing is changed.
    ///
    /// # Errors
    /// When it exists and may not be replaced, or its folder takes no file.
    pub fn check(self, path: &Path) -> Result<(), ObserveError> {
        let beside = match self.look(path)? {
            There::Device => return Ok(()),
            There::Nothing => path.to_owned(),
            There::File(real) => real,
        };
        let part = part_of(&beside);
        let made = OpenOptions::new().write(true).create_new(true).open(&part);
        made.map_err(|error| refused(path, &error))?;
        std::fs::remove_file(&part).map_err(|error| refused(path, &error))
    }

    /// Writes a file whole or not at all.
    ///
    /// # Errors
    /// When it exists and may not be replaced, or the disk says no; then a file that was there is as it was.
    pub fn write(self, path: &Path, bytes: &[u8]) -> Result<(), ObserveError> {
        self.write_by(path, |at| std::fs::write(at, bytes))
    }

    /// Same by somebody who writes a file of the name that he is given.
    ///
    /// # Errors
    /// As [`Overwrite::write`].
    pub fn write_by<T>(
        self,
        path: &Path,
        writer: impl FnOnce(&Path) -> std::io::Result<T>,
    ) -> Result<T, ObserveError> {
        let written = match self.look(path)? {
            There::Device => writer(path),
            There::Nothing => write_whole(path, false, writer),
            There::File(real) => write_whole(&real, true, |at| {
                let value = writer(at)?;
                // Where the system has none the new file has its usual ones.
                drop(
                    std::fs::metadata(&real)
                        .map(|old| std::fs::set_permissions(at, old.permissions())),
                );
                Ok(value)
            }),
        };
        written.map_err(|error| refused(path, &error))
    }

    /// Opens a file that is written bit by bit.
    ///
    /// # Errors
    /// When it exists and may not be replaced, is being written by another run, or cannot be written.
    pub fn open(self, path: &Path) -> Result<(File, Placed), ObserveError> {
        let failed = |error: std::io::Error| refused(path, &error);
        let new = |at: &Path| OpenOptions::new().write(true).create_new(true).open(at);
        // A `Placed` is made of a file of this run's own only: it may take that away again.
        let (file, mut placed) = match self.look(path)? {
            There::Device => {
                let file = OpenOptions::new().write(true).open(path).map_err(failed)?;
                let mut placed = Placed::new(path, path);
                placed.name = Name::Device;
                (file, placed)
            }
            There::Nothing => {
                let part = part_of(path);
                let file = new(&part).map_err(failed)?;
                let mut placed = Placed::new(path, &part);
                placed.name = Name::Free;
                placed.lock = Some(file.try_clone().map_err(failed)?);
                (file, placed)
            }
            There::File(real) => {
                let old = std::fs::metadata(&real).map_err(failed)?;
                let part = part_of(&real);
                let file = new(&part).map_err(failed)?;
                // Where the system has none the new file has its usual ones.
                drop(file.set_permissions(old.permissions()));
                let mut placed = Placed::new(&real, &part);
                // A file that may be written but not read is not locked.
                placed.lock = File::open(&real).ok();
                (file, placed)
            }
        };
        placed.take_lock(path)?;
        Ok((file, placed))
    }

    fn look(self, path: &Path) -> Result<There, ObserveError> {
        let refuse = |reason: &str| Err(ObserveError::new(path.display().to_string(), reason));
        match std::fs::symlink_metadata(path) {
            Err(error) if error.kind() == ErrorKind::NotFound => {
                if folder_of(path).is_dir() {
                    Ok(There::Nothing)
                } else {
                    Err(refused(path, &error))
                }
            }
            Err(error) => Err(refused(path, &error)),
            Ok(_) if self == Self::Refuse => Err(refused(path, &ErrorKind::AlreadyExists.into())),
            Ok(_) => match std::fs::metadata(path) {
                Err(_) => refuse("a link to a file that does not exist; remove the link"),
                Ok(there) if there.is_dir() => refuse("a folder has this name"),
                Ok(there) if is_pipe(&there) && !path.starts_with("/dev") => refuse(
                    "a pipe, which waits until somebody reads it; /dev/stdout is one that does not",
                ),
                Ok(there) if !there.is_file() => Ok(There::Device),
                Ok(there) if there.permissions().readonly() => {
                    Err(refused(path, &ErrorKind::PermissionDenied.into()))
                }
                Ok(_) => path
                    .canonicalize()
                    .map(There::File)
                    .map_err(|error| refused(path, &error)),
            },
        }
    }
}

#[cfg(unix)]
fn is_pipe(there: &std::fs::Metadata) -> bool {
    use std::os::unix::fs::FileTypeExt as _;
    there.file_type().is_fifo()
}

#[cfg(not(unix))]
fn is_pipe(_there: &std::fs::Metadata) -> bool {
    false
}

/// Whether nothing has a name, and no run is writing a file that will have it.
pub fn is_free(path: &Path) -> bool {
    !path.exists() && !is_expected(path, Path::new(""))
}

/// Whether a run is writing a file, other than `own`, that will have that name.
fn is_expected(target: &Path, own: &Path) -> bool {
    let stem = target.file_stem().unwrap_or_default().to_string_lossy();
    let begins = format!("{stem}.part-");
    let entries = std::fs::read_dir(folder_of(target)).into_iter().flatten();
    entries.flatten().any(|entry| {
        let name = entry.file_name();
        let is_part = own.file_name() != Some(&name)
            && name.to_string_lossy().starts_with(&begins)
            && Path::new(&name).extension() == target.extension();
        let locked = |file: File| matches!(file.try_lock_shared(), Err(TryLockError::WouldBlock));
        is_part && open_plain(&entry.path()).is_ok_and(locked)
    })
}

fn refused(path: &Path, error: &std::io::Error) -> ObserveError {
    let reason = match error.kind() {
        ErrorKind::AlreadyExists => {
            "the file exists; choose another name or ask for overwriting (--force)".to_owned()
        }
        ErrorKind::NotFound => "its folder does not exist; create it first".to_owned(),
        _ => format!("cannot be written: {error}"),
    };
    ObserveError::new(path.display().to_string(), reason)
}

/// What a name leads to while its file is written.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Name {
    /// To nothing: the file takes it as soon as it holds something.
    Free,
    /// To the file that it will replace.
    Taken,
    /// To what is written into.
    Device,
}

/// A file that is being written, and the name that it will have.
#[derive(Debug)]
pub struct Placed {
    target: PathBuf,
    /// Where it is written.
    at: PathBuf,
    /// Held while it is written.
    lock: Option<File>,
    holds_something: bool,
    name: Name,
    is_settled: bool,
}

impl Placed {
    fn new(target: &Path, at: &Path) -> Self {
        Self {
            target: target.to_owned(),
            at: at.to_owned(),
            lock: None,
            holds_something: false,
            name: Name::Taken,
            is_settled: false,
        }
    }

    /// Refuses a file that another run holds. Where the system knows no locks there is none to respect.
    fn take_lock(&mut self, path: &Path) -> Result<(), ObserveError> {
        // Elsewhere a lock also keeps readers out, such as a viewer that looks on.
        if !cfg!(unix) {
            self.lock = None;
        }
        let tried = self.lock.as_ref().map(File::try_lock);
        let is_held = matches!(tried, Some(Err(TryLockError::WouldBlock)));
        if is_held || (self.name == Name::Free && is_expected(&self.target, &self.at)) {
            // The part file alone is this run's.
            if self.at != self.target {
                drop(std::fs::remove_file(&self.at));
            }
            self.is_settled = true;
            let reason = "another run is writing it; wait for its end or choose another name";
            return Err(ObserveError::new(path.display().to_string(), reason));
        }
        Ok(())
    }

    /// Where it is written: its name, or beside it.
    pub fn at(&self) -> &Path {
        &self.at
    }

    /// There is something in it that is worth its name, which it takes if nothing has it.
    ///
    /// # Errors
    /// When the file or its folder cannot be written.
    pub fn hold(&mut self) -> std::io::Result<()> {
        let is_first = !std::mem::replace(&mut self.holds_something, true);
        if is_first && self.name == Name::Free {
            publish(&self.at, &self.target, false)?;
            self.at.clone_from(&self.target);
        }
        Ok(())
    }

    /// Leaves it where it is: it has failed, and what it replaces is worth more. Says where that is, if it is not
    /// its own name.
    pub fn leave(&mut self) -> Option<PathBuf> {
        if !self.holds_something {
            self.discard();
            return None;
        }
        self.is_settled = true;
        (self.at != self.target && self.name != Name::Device).then(|| self.at.clone())
    }

    /// Brings it to the disk and gives it its name; takes it away if nothing is in it. Whether it is there.
    ///
    /// # Errors
    /// When the file or its folder cannot be written.
    pub fn settle(&mut self) -> std::io::Result<bool> {
        if self.is_settled || self.name == Name::Device {
            self.is_settled = true;
            return Ok(self.holds_something);
        }
        if !self.holds_something {
            self.discard();
            return Ok(false);
        }
        self.is_settled = true;
        sync_file(&self.at)?;
        if self.at == self.target {
            sync_folder(folder_of(&self.at));
        } else {
            publish(&self.at, &self.target, true)?;
        }
        Ok(true)
    }

    /// Takes away a file that nothing is in.
    fn discard(&mut self) {
        if !self.is_settled && self.name != Name::Device {
            // Gone already is as good.
            drop(std::fs::remove_file(&self.at));
        }
        self.is_settled = true;
    }
}

impl Drop for Placed {
    /// An output that nobody finished keeps what it was given.
    fn drop(&mut self) {
        // Nobody is left to tell.
        drop(self.settle());
    }
}

#[cfg(test)]
#[expect(clippy::unwrap_used, reason = "tests")]
mod tests {
    use super::*;
    use std::io::Write as _;

    fn read(path: &Path) -> Option<String> {
        std::fs::read_to_string(path).ok()
    }

    #[test]
    fn a_refused_or_empty_output_takes_nothing_away() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("run.csv");
        std::fs::write(&path, "mine").unwrap();
        assert!(Overwrite::Refuse.open(&path).is_err());
        assert!(Overwrite::Refuse.check(&path).is_err());
        drop(Overwrite::Replace.open(&path).unwrap());
        assert_eq!(read(&path).as_deref(), Some("mine"));
        // What holds something is worth it, finished or not.
        let (mut file, mut placed) = Overwrite::Replace.open(&path).unwrap();
        file.write_all(b"new").unwrap();
        placed.hold().unwrap();
        assert_eq!(read(&path).as_deref(), Some("mine"));
        drop(placed);
        assert_eq!(read(&path).as_deref(), Some("new"));
        // A new name that nothing came for is free again.
        let other = folder.path().join("other.csv");
        drop(Overwrite::Refuse.open(&other).unwrap());
        assert_eq!(std::fs::read_dir(folder.path()).unwrap().count(), 1);
    }

    #[cfg(unix)]
    #[test]
    fn a_file_has_one_writer_and_keeps_its_permissions() {
        use std::os::unix::fs::PermissionsExt as _;
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("run.csv");
        let held = Overwrite::Refuse.open(&path).unwrap();
        let second = Overwrite::Replace.open(&path).unwrap_err();
        assert!(second.reason.contains("another run"), "{second}");
        let other = folder.path().join("run.rrd");
        drop(Overwrite::Refuse.open(&other).unwrap());
        // Its name is free until it holds something.
        assert!(!path.exists());
        let (file, mut placed) = held;
        placed.hold().unwrap();
        assert!(path.exists());
        let third = Overwrite::Replace.open(&path).unwrap_err();
        assert!(third.reason.contains("another run"), "{third}");
        drop((file, placed));
        std::fs::write(&path, "mine").unwrap();
        std::fs::set_permissions(&path, std::fs::Permissions::from_mode(0o640)).unwrap();
        Overwrite::Replace.write(&path, b"new").unwrap();
        assert_eq!(path.metadata().unwrap().permissions().mode() & 0o777, 0o640);
        std::fs::set_permissions(&path, std::fs::Permissions::from_mode(0o440)).unwrap();
        assert!(Overwrite::Replace.write(&path, b"newer").is_err());
        assert_eq!(read(&path).as_deref(), Some("new"));
    }
}
