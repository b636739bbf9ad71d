//! A sweep's folder: every case in a file of its own, written whole or not at all.
//!
//! ```text
//! FOLDER/sweep.toml              the sweep, with its scene in it
//! FOLDER/sweep.digest            what the cases belong to
//! FOLDER/base.toml               the scene that every case starts from, before its own keys are set
//! FOLDER/cases/0000012.json      asperity case 1 <FNV-1a of the rest> \n { ... }
//! FOLDER/chains/0000003-0000012.state      where chain 3 goes on after case 12; gone when it is done
//! FOLDER/table.csv, seconds.csv, *.svg, *.png   when all cases are there
//! ```
//! A file is written under another name, brought to the disk and renamed, so that a kill leaves the old one or
//! the new one. Two processes that write the same case write the same bytes. A record whose digest does not
//! fit counts as missing.

use std::io::Write as _;
use std::path::{Path, PathBuf};
use std::sync::atomic::{AtomicU64, Ordering};

use super::case::CaseRecord;
use super::error::SweepError;
use super::spec::Sweep;
use crate::run::Checkpoint;
use crate::scene::Scene;
use crate::sim::State;

const MAGIC: &str = "asperity case 1 ";

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

/// A sweep's folder.
#[derive(Debug, Clone)]
pub struct Folder {
    root: PathBuf,
}

impl Folder {
    /// Opens or makes the folder of a sweep.
    ///
    /// # Errors
    /// [`SweepError::Folder`] when it belongs to another sweep, holds cases that were not expected, or cannot
    /// be written.
    pub fn create(root: &Path, sweep: &Sweep, existing: Existing) -> Result<Self, SweepError> {
        let folder = Self {
            root: root.to_owned(),
        };
        let mark = root.join("sweep.digest");
        let digest = sweep.digest();
        if let Ok(found) = std::fs::read_to_string(&mark)
            && existing != Existing::Replace
        {
            if found.trim() != digest {
                return Err(SweepError::folder(
                    root,
                    "holds another sweep (or one of another version, or an edited one); take another --out, or --force replaces it",
                ));
            }
            if existing == Existing::Refuse && folder.holds_cases() {
                return Err(SweepError::folder(
                    root,
                    "holds cases of this sweep already; --resume goes on, --force starts anew",
                ));
            }
        }
        for name in ["cases", "chains"] {
            let path = root.join(name);
            if existing == Existing::Replace && path.exists() {
                std::fs::remove_dir_all(&path).map_err(|e| SweepError::folder(&path, e))?;
            }
            std::fs::create_dir_all(&path).map_err(|e| SweepError::folder(&path, e))?;
        }
        folder.write(&root.join("sweep.toml"), sweep.to_toml().as_bytes())?;
        folder.write(&mark, format!("{digest}\n").as_bytes())?;
        if let Ok(scene) = sweep.base_scene() {
            folder.write(&root.join("base.toml"), scene.to_toml().as_bytes())?;
        }
        Ok(folder)
    }

    /// A folder that some shard has filled.
    ///
    /// # Errors
    /// [`SweepError::Folder`] when it is none of this sweep.
    pub fn open(root: &Path, sweep: &Sweep) -> Result<Self, SweepError> {
        let mark = root.join("sweep.digest");
        let found = std::fs::read_to_string(&mark).map_err(|e| SweepError::folder(&mark, e))?;
        if found.trim() != sweep.digest() {
            return Err(SweepError::folder(root, "holds cases of another sweep"));
        }
        Ok(Self {
            root: root.to_owned(),
        })
    }

    /// The sweep whose cases a folder holds.
    ///
    /// # Errors
    /// [`SweepError`] when the folder holds none.
    pub fn sweep_in(root: &Path) -> Result<Sweep, SweepError> {
        let path = root.join("sweep.toml");
        let text = std::fs::read_to_string(&path).map_err(|e| SweepError::folder(&path, e))?;
        let name = root
            .file_stem()
            .map_or_else(|| "sweep".to_owned(), |s| s.to_string_lossy().into_owned());
        Sweep::parse(&text, &name, Path::new(""))
    }

    fn holds_cases(&self) -> bool {
        std::fs::read_dir(self.root.join("cases")).is_ok_and(|mut dir| dir.next().is_some())
    }

    /// Its path.
    pub fn root(&self) -> &Path {
        &self.root
    }

    fn case_path(&self, index: usize) -> PathBuf {
        self.root.join("cases").join(format!("{index:07}.json"))
    }

    /// Writes a record.
    ///
    /// # Errors
    /// [`SweepError::Folder`] when the disk says no.
    pub fn write_case(&self, record: &CaseRecord) -> Result<(), SweepError> {
        let path = self.case_path(record.index);
        let body = serde_json::to_string(record).map_err(|e| SweepError::folder(&path, e))?;
        let text = format!("{MAGIC}{:016x}\n{body}\n", fnv(body.as_bytes()));
        self.write(&path, text.as_bytes())
    }

    /// A record; `None`: missing, cut short or changed.
    pub fn read_case(&self, index: usize) -> Option<CaseRecord> {
        let text = std::fs::read_to_string(self.case_path(index)).ok()?;
        let (head, body) = text.split_once('\n')?;
        let body = body.strip_suffix('\n')?;
        let digest = format!("{:016x}", fnv(body.as_bytes()));
        if head.strip_prefix(MAGIC)? != digest {
            return None;
        }
        let record: CaseRecord = serde_json::from_str(body).ok()?;
        (record.index == index).then_some(record)
    }

    fn state_path(&self, chain: usize, case: usize) -> PathBuf {
        let name = format!("{chain:07}-{case:07}.state");
        self.root.join("chains").join(name)
    }

    /// Writes where a chain goes on after a case.
    ///
    /// # Errors
    /// [`SweepError::Folder`] when the disk says no.
    pub(super) fn write_state(
        &self,
        (chain, case): (usize, usize),
        scene: &Scene,
        state: &State,
    ) -> Result<(), SweepError> {
        let path = self.state_path(chain, case);
        let failed = |error: std::io::Error| SweepError::folder(&path, error);
        let temporary = self.temporary();
        let checkpoint = Checkpoint {
            program: concat!("asperity ", env!("CARGO_PKG_VERSION")).to_owned(),
            scene: scene.to_toml(),
            n_events_played: 0,
            n_unconverged: 0,
            sim: state.clone(),
        };
        let mut file = std::fs::File::create(&temporary).map_err(failed)?;
        checkpoint.write(&mut file).map_err(failed)?;
        std::fs::rename(&temporary, &path).map_err(failed)
    }

    /// The state after a case; `None`: there is none, or none that fits.
    pub(super) fn read_state(&self, at: (usize, usize), scene: &Scene) -> Option<State> {
        let checkpoint = Checkpoint::read(&self.state_path(at.0, at.1)).ok()?;
        checkpoint.fits(scene).ok()?;
        Some(checkpoint.sim)
    }

    /// Takes a state away that is not needed any more.
    pub(super) fn drop_state(&self, chain: usize, case: usize) {
        // One that stays behind does no harm.
        let _ = std::fs::remove_file(self.state_path(chain, case));
    }

    fn temporary(&self) -> PathBuf {
        static COUNT: AtomicU64 = AtomicU64::new(0);
        let n = COUNT.fetch_add(1, Ordering::Relaxed);
        // Shards may share a folder: the name holds the process, and the machine's in case the folder is
        // on a network.
        let host = std::fs::read_to_string("/proc/sys/kernel/hostname").unwrap_or_default();
        let name = format!("temporary-{}-{}-{n}", host.trim(), std::process::id());
        self.root.join(name)
    }

    /// Writes a file whole or not at all.
    ///
    /// # Errors
    /// [`SweepError::Folder`] when the disk says no.
    pub fn write(&self, path: &Path, bytes: &[u8]) -> Result<(), SweepError> {
        self.write_by(path, |temporary| {
            std::fs::File::create(temporary)
                .and_then(|mut file| file.write_all(bytes).and_then(|()| file.sync_all()))
                .map_err(|error| error.to_string())
        })
    }

    /// Lets somebody write a file, under another name with the same ending, and gives it its own when it is
    /// whole.
    ///
    /// # Errors
    /// [`SweepError::Folder`] when the writer or the disk says no.
    pub(super) fn write_by<T>(
        &self,
        path: &Path,
        writer: impl FnOnce(&Path) -> Result<T, String>,
    ) -> Result<(), SweepError> {
        let mut temporary = self.temporary();
        if let Some(ending) = path.extension() {
            temporary.set_extension(ending);
        }
        let renamed = writer(&temporary)
            .and_then(|_| std::fs::rename(&temporary, path).map_err(|error| error.to_string()));
        renamed.map_err(|error| {
            let _ = std::fs::remove_file(&temporary);
            SweepError::folder(path, error)
        })
    }

    /// Takes away what processes that were killed left half-written: files that nobody has touched for ten
    /// minutes, since another shard may be writing one.
    pub fn tidy(&self) {
        const ABANDONED: std::time::Duration = std::time::Duration::from_mins(10);
        let left = std::fs::read_dir(&self.root)
            .into_iter()
            .flatten()
            .flatten();
        for entry in left {
            let is_temporary = entry
                .file_name()
                .to_string_lossy()
                .starts_with("temporary-");
            let age = entry.metadata().and_then(|about| about.modified()).ok();
            let age = age.and_then(|time| time.elapsed().ok());
            if is_temporary && age.is_some_and(|age| age > ABANDONED) {
                let _ = std::fs::remove_file(entry.path());
            }
        }
    }
}

impl Sweep {
    /// What a folder's cases belong to: FNV-1a of the program's version, the scene and the keys.
    pub fn digest(&self) -> String {
        format!("{:016x}", fnv(self.canonical().as_bytes()))
    }
}

/// FNV-1a, 64 bits (Fowler, Noll and Vo): against accidents, not against malice.
pub(super) fn fnv(bytes: &[u8]) -> u64 {
    bytes.iter().fold(0xcbf2_9ce4_8422_2325, |hash, &byte| {
        (hash ^ u64::from(byte)).wrapping_mul(0x0100_0000_01b3)
    })
}
