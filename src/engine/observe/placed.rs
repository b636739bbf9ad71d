//! Where an output's file lies while it is written, and where when it is done.
//!
//! | there before | while it is written | when it is done | after a kill |
//! |---|---|---|---|
//! | nothing | until something came beside it, as `NAME.part-PID-N.ENDING`; then under its name | under its name; gone if nothing came | the same |
//! | a file, `--force` | beside it, as `NAME.part-PID-N.ENDING` | in place of it; it stays if nothing came | the old file; the new one beside it |
//! | the same, of a run that was stopped | | the old file; the new one as `NAME.stopped.ENDING` | |
//! | a device | in it | | |
//!
//! A file that another run is writing is refused, by a lock that ends with its process. A killed run leaves a name free
//! until there is something that is worth it. Of runs that ask for one free name at the same moment the first by the name
//! of its part stays: each makes its part and locks it before it looks for others, so two never stay, and only one that
//! is ahead makes another give way, so one always does. No lock of the folder is needed, which a script may hold.

use std::ffi::OsString;
use std::fs::{File, OpenOptions, TryLockError};
use std::io::ErrorKind;
use std::path::{Path, PathBuf};
use std::time::{Duration, Instant};

use super::ObserveError;
use crate::files::{
    beside, folder_of, identity, open_plain, part_of, publish, stem_beside, sync_file, sync_folder,
    write_whole,
};

/// How long a run waits for others that are behind it to give way: one that does not has the name already.
const GIVING_WAY: Duration = Duration::from_secs(1);
/// How often a name is looked at again that has changed while it was asked for.
const MOST_LOOKS: usize = 10;
const TAKEN: &str = "another run is writing it; wait for its end or choose another name";

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
        for _ in 0..MOST_LOOKS {
            tidy(path);
            if let Some(opened) = self.try_open(path)? {
                return Ok(opened);
            }
        }
        Err(ObserveError::new(path.display().to_string(), TAKEN))
    }

    /// Makes a name this run's own, for a file that is written whole when the run ends.
    ///
    /// # Errors
    /// As [`Overwrite::open`].
    pub fn claim(self, path: &Path) -> Result<Claim, ObserveError> {
        let (_, placed) = self.open(path)?;
        let path = path.to_owned();
        Ok(Claim { path, placed })
    }

    /// Opens what the name leads to; `None`: it leads to something else by now.
    fn try_open(self, path: &Path) -> Result<Option<(File, Placed)>, ObserveError> {
        let failed = |error: std::io::Error| refused(path, &error);
        let new = |at: &Path| OpenOptions::new().write(true).create_new(true).open(at);
        // A `Placed` is made of a file of this run's own only: it may take that away again.
        match self.look(path)? {
            There::Device => {
                let file = OpenOptions::new().write(true).open(path).map_err(failed)?;
                let mut placed = Placed::new(path, path);
                placed.name = Name::Device;
                Ok(Some((file, placed)))
            }
            There::Nothing => {
                let part = part_of(path);
                let file = new(&part).map_err(failed)?;
                let mut placed = Placed::new(path, &part);
                placed.name = Name::Free;
                if !placed.lock_part(&file).map_err(failed)? {
                    return Ok(None);
                }
                if placed.is_first().map_err(failed)? {
                    return Ok(Some((file, placed)));
                }
                placed.discard();
                if path.symlink_metadata().is_ok() {
                    return Ok(None);
                }
                Err(ObserveError::new(path.display().to_string(), TAKEN))
            }
            There::File(real) => {
                let old = std::fs::metadata(&real).map_err(failed)?;
                let part = part_of(&real);
                let file = new(&part).map_err(failed)?;
                // Where the system has none the new file has its usual ones.
                drop(file.set_permissions(old.permissions()));
                let mut placed = Placed::new(&real, &part);
                if !placed.lock_old() {
                    placed.discard();
                    return Err(ObserveError::new(path.display().to_string(), TAKEN));
                }
                let is_there = placed.lock_part(&file).map_err(failed)?;
                Ok(is_there.then_some((file, placed)))
            }
        }
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

/// Where the output of a stopped run goes whose name a whole one has: `run.stopped.rrd`.
pub fn stopped_of(path: &Path) -> PathBuf {
    beside(path, "stopped")
}

/// Whether nothing has a name, and no run is writing a file that will have it.
pub fn is_free(path: &Path) -> bool {
    !path.exists() && others(path).next().is_none()
}

/// Parts of a file that runs left which were killed. Where locks are not used nobody can tell them from parts that are
/// being written.
pub fn leftovers(path: &Path) -> Vec<PathBuf> {
    let beside = identity(path);
    let parts = parts(&beside).filter(|(_, locked)| cfg!(unix) && !locked);
    parts.map(|(name, _)| path.with_file_name(name)).collect()
}

/// Takes away empty parts that killed runs left of a file: nothing was lost with them.
fn tidy(path: &Path) {
    for part in leftovers(path) {
        let opened = open_plain(&part).ok().filter(|part| {
            // Whoever has just made it locks it next, and then finds that it is gone.
            part.try_lock().is_ok() && part.metadata().is_ok_and(|part| part.len() == 0)
        });
        if opened.is_some() {
            // One that stays behind does no harm.
            drop(std::fs::remove_file(&part));
        }
    }
}

/// Names of the parts of a file that runs are writing.
fn others(target: &Path) -> impl Iterator<Item = OsString> {
    let locked = parts(target).filter(|(_, locked)| *locked);
    locked.map(|(name, _)| name)
}

/// Names of the parts of a file, and whether somebody holds them.
fn parts(target: &Path) -> impl Iterator<Item = (OsString, bool)> {
    let begins = format!("{}.part-", stem_beside(target));
    let entries = std::fs::read_dir(folder_of(target)).into_iter().flatten();
    entries.flatten().filter_map(move |entry| {
        let name = entry.file_name();
        let is_part = name.to_string_lossy().starts_with(&begins)
            && Path::new(&name).extension() == target.extension();
        let held = |file: File| matches!(file.try_lock_shared(), Err(TryLockError::WouldBlock));
        let opened = is_part.then(|| open_plain(&entry.path()).ok()).flatten()?;
        Some((name, held(opened)))
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

/// What of a file that has failed is left, and where.
#[derive(Debug, Clone, PartialEq, Eq)]
pub enum Left {
    /// It held nothing that is worth a file, and is gone.
    Nothing,
    /// It has its name.
    InItsPlace,
    /// It lies beside one that has its name.
    Beside(PathBuf),
}

/// A file that is being written, and the name that it will have.
#[derive(Debug)]
pub struct Placed {
    target: PathBuf,
    /// Where it is written.
    at: PathBuf,
    /// Held while it is written.
    locks: Vec<File>,
    holds_something: bool,
    name: Name,
    is_settled: bool,
    /// It is not whole: what it was to replace is worth more.
    is_cut_short: bool,
}

impl Placed {
    fn new(target: &Path, at: &Path) -> Self {
        Self {
            target: target.to_owned(),
            at: at.to_owned(),
            locks: Vec::new(),
            holds_something: false,
            name: Name::Taken,
            is_settled: false,
            is_cut_short: false,
        }
    }

    /// Locks the part, which others then find; false: one of them took it for what a killed run left, and away. Where the
    /// system knows no locks there is none to respect.
    fn lock_part(&mut self, part: &File) -> std::io::Result<bool> {
        // Elsewhere a lock also keeps readers out, such as a viewer that looks on.
        if cfg!(unix) {
            let lock = part.try_clone()?;
            // Not tried but waited for: another run may be looking whether it is locked.
            if lock.lock().is_ok() {
                self.locks.push(lock);
                return self.at.try_exists();
            }
        }
        Ok(true)
    }

    /// Locks the file that will be replaced; false: another run holds it. One that may be written but not read is not
    /// locked.
    fn lock_old(&mut self) -> bool {
        let old = File::open(&self.target).ok().filter(|_| cfg!(unix));
        let tried = old.as_ref().map(File::try_lock);
        let is_held = matches!(tried, Some(Err(TryLockError::WouldBlock)));
        self.locks.extend(old);
        !is_held
    }

    /// Whether the free name is this run's: no other is writing a part of that name, or all who do are behind it and
    /// have given way.
    fn is_first(&self) -> std::io::Result<bool> {
        let own = self.at.file_name().unwrap_or_default();
        let began = Instant::now();
        loop {
            let others: Vec<_> = others(&self.target).filter(|name| name != own).collect();
            if others.is_empty() {
                break;
            }
            if others.iter().any(|name| **name < *own) || began.elapsed() > GIVING_WAY {
                return Ok(false);
            }
            std::thread::sleep(Duration::from_millis(1));
        }
        // One whose part was gone already may have given it the name.
        match self.target.symlink_metadata() {
            Err(error) if error.kind() == ErrorKind::NotFound => Ok(true),
            Err(error) => Err(error),
            Ok(_) => Ok(false),
        }
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

    /// The run that writes it has been stopped before its end.
    pub fn cut_short(&mut self) {
        self.is_cut_short = true;
    }

    /// Where it lies beside the whole file that it was to replace; `None`: it has its name.
    pub fn set_aside(&self) -> Option<&Path> {
        let is_aside = self.is_settled && self.is_cut_short && self.name == Name::Taken;
        is_aside.then_some(&*self.at)
    }

    /// Leaves it where it is: it has failed, and what it replaces is worth more.
    pub fn leave(&mut self) -> Left {
        if !self.holds_something && self.name != Name::Device {
            self.discard();
            return Left::Nothing;
        }
        self.is_settled = true;
        if self.at == self.target {
            Left::InItsPlace
        } else {
            Left::Beside(self.at.clone())
        }
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
        } else if self.is_cut_short {
            let aside = stopped_of(&self.target);
            publish(&self.at, &aside, true)?;
            self.at = aside;
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

/// A name that is this run's from its start, for a file that is written whole at its end. Dropped, it is free again.
#[derive(Debug)]
pub struct Claim {
    /// As it was asked for.
    path: PathBuf,
    placed: Placed,
}

impl Claim {
    /// Its name in messages.
    pub fn name(&self) -> String {
        self.path.display().to_string()
    }

    /// The run that it is of has been stopped before its end.
    pub fn cut_short(&mut self) {
        self.placed.cut_short();
    }

    /// Writes the file whole or not at all.
    ///
    /// # Errors
    /// When the disk says no; then a file that was there is as it was.
    pub fn write(self, bytes: &[u8]) -> Result<(), ObserveError> {
        self.write_by(|at| std::fs::write(at, bytes))
    }

    /// Same by somebody who writes a file of the name that he is given.
    ///
    /// # Errors
    /// As [`Claim::write`].
    pub fn write_by<T>(
        mut self,
        writer: impl FnOnce(&Path) -> std::io::Result<T>,
    ) -> Result<T, ObserveError> {
        let placed = &mut self.placed;
        // Half of it is nothing: it goes with the claim.
        let value = writer(&placed.at).map_err(|error| refused(&self.path, &error))?;
        let is_device = placed.name == Name::Device;
        let synced = if is_device {
            Ok(())
        } else {
            sync_file(&placed.at)
        };
        synced.map_err(|error| refused(&self.path, &error))?;
        let settled = placed.hold().and_then(|()| placed.settle());
        settled.map(|_| value).map_err(|error| {
            let mut failed = refused(&self.path, &error);
            if let Left::Beside(at) = placed.leave() {
                failed.reason = format!("{}; it is {}", failed.reason, at.display());
            }
            failed
        })
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
        // Its name is not given to anything until it holds something.
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

    /// How many of so many that start at one moment have the name; the last of them gives it what it holds.
    fn winners(starters: usize, overwrite: Overwrite, path: &Path) -> usize {
        let gate = std::sync::Barrier::new(starters);
        let start = || {
            gate.wait();
            let opened = overwrite.open(path);
            // Held until all have been refused.
            gate.wait();
            match opened {
                Ok((mut file, mut placed)) => {
                    file.write_all(b"new").unwrap();
                    placed.hold().unwrap();
                    true
                }
                Err(error) => {
                    assert!(error.reason.contains("another run"), "{error}");
                    false
                }
            }
        };
        std::thread::scope(|scope| {
            let all: Vec<_> = (0..starters).map(|_| scope.spawn(start)).collect();
            let won = all.into_iter().map(|one| one.join().unwrap());
            won.filter(|won| *won).count()
        })
    }

    #[test]
    fn of_those_who_ask_for_one_name_together_one_has_it() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("run.csv");
        for round in 0..100 {
            let starters = [2, 2, 2, 5][round % 4];
            assert_eq!(winners(starters, Overwrite::Refuse, &path), 1, "{round}");
            // The old one is replaced by one of them, too.
            std::fs::write(&path, "old").unwrap();
            assert_eq!(winners(starters, Overwrite::Replace, &path), 1, "{round}");
            assert_eq!(read(&path).as_deref(), Some("new"), "{round}");
            std::fs::remove_file(&path).unwrap();
            assert_eq!(winners(starters, Overwrite::Replace, &path), 1, "{round}");
            std::fs::remove_file(&path).unwrap();
            assert_eq!(std::fs::read_dir(folder.path()).unwrap().count(), 0);
        }
    }

    #[test]
    fn a_part_that_a_killed_run_left_blocks_nobody() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("run.csv");
        for name in ["run.part-1-0.csv", "run.part-999999-0.csv"] {
            std::fs::write(folder.path().join(name), "half").unwrap();
        }
        std::fs::write(folder.path().join("run.part-7-0.csv"), "").unwrap();
        let held = Overwrite::Refuse.open(&path).unwrap();
        // The empty one is gone. They are named, and what is being written is none.
        assert_eq!(leftovers(&path).len(), if cfg!(unix) { 2 } else { 0 });
        drop(held);
        assert_eq!(std::fs::read_dir(folder.path()).unwrap().count(), 2);
    }

    #[test]
    fn a_claim_is_held_from_its_start_and_gone_with_what_failed() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("run.state");
        for overwrite in [Overwrite::Refuse, Overwrite::Replace] {
            let claim = overwrite.claim(&path).unwrap();
            let second = Overwrite::Replace.claim(&path).unwrap_err();
            assert!(second.reason.contains("another run"), "{second}");
            let before = read(&path);
            let half = claim.write_by(|at| {
                std::fs::write(at, "half")?;
                Err::<(), _>(std::io::Error::other("full"))
            });
            assert!(half.unwrap_err().reason.contains("full"));
            assert_eq!(read(&path), before);
            overwrite.claim(&path).unwrap().write(b"whole").unwrap();
            assert_eq!(read(&path).as_deref(), Some("whole"));
            assert_eq!(std::fs::read_dir(folder.path()).unwrap().count(), 1);
        }
        // Somebody puts a file there meanwhile: neither is lost.
        std::fs::remove_file(&path).unwrap();
        let claim = Overwrite::Refuse.claim(&path).unwrap();
        std::fs::write(&path, "mine").unwrap();
        let beside = claim.write(b"whole").unwrap_err().reason;
        assert!(
            beside.contains("exists") && beside.contains("run.part-"),
            "{beside}"
        );
        assert_eq!(read(&path).as_deref(), Some("mine"));
        assert_eq!(std::fs::read_dir(folder.path()).unwrap().count(), 2);
    }
}
