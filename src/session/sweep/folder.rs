//! A sweep's folder: every case in a file of its own, written whole or not at all.
//!
//! ```text
//! FOLDER/sweep.digest            the mark: format, digest of the sweep, build that fills the folder; locked (shared) by
//!                                everybody who works in the folder
//! FOLDER/sweep.lock              locked by one who enters the folder
//! FOLDER/sweep.toml              the sweep, with its scene in it
//! FOLDER/base.toml               the scene that every case starts from, before its own keys are set
//! FOLDER/cases/0000012.json      asperity case 1 <FNV-1a of the rest> \n { ... }
//! FOLDER/chains/0000003-0000012.state      where chain 3 goes on after case 12; gone when it is done
//! FOLDER/chains/0000003.claim    locked by the process that works on chain 3; gone when it is done
//! FOLDER/table.csv, seconds.csv, seeds.csv, flank.csv, *.svg, *.png   when all cases are there
//! ```
//! A folder that is not empty and has no mark is somebody else's: nothing in it is touched. In a marked one nothing
//! is touched but files of these names. A file is written under another name, brought to the disk and renamed, so
//! that a kill leaves the old one or the new one. Two processes that write the same case write the same bytes. A
//! record whose digest does not fit counts as missing.

mod claim;
mod mark;

use std::path::{Path, PathBuf};
use std::sync::atomic::{AtomicU64, Ordering};

use super::case::{CaseRecord, Neighbour};
use super::error::SweepError;
use super::spec::Sweep;
use crate::run::{Checkpoint, Climb};
use asperity_engine::files::{fnv, publish, sync_file};
use asperity_engine::scene::Scene;
use asperity_engine::sim::{State, Stats};
pub use claim::Claimed;
pub use mark::Existing;
use mark::{Entry, FolderMark, Lock, MARK, TEMPORARY};

const MAGIC: &str = "asperity case 1 ";

/// A sweep's folder.
#[derive(Debug, Clone)]
pub struct Folder {
    root: PathBuf,
    mark: FolderMark,
    lock: Lock,
}

impl Folder {
    /// Opens or makes the folder of a sweep.
    ///
    /// # Errors
    /// [`SweepError::Folder`] when it belongs to another sweep, holds cases that were not expected, or cannot
    /// be written.
    pub fn create(root: &Path, sweep: &Sweep, existing: Existing) -> Result<Self, SweepError> {
        std::fs::create_dir_all(root).map_err(|e| SweepError::folder(root, e))?;
        let mark = FolderMark::new(sweep.digest());
        let judged = || {
            let found = mark::seen(root)?;
            refuse(root, &mark, found.as_ref(), existing)?;
            Ok(found.as_ref() == Some(&mark))
        };
        // Before a lock lies in a folder of somebody else's ...
        let is_same = judged()?;
        if let Some(input) = mark::input_in_the_way(root, &sweep.inputs, is_same) {
            let reason = format!(
                "the sweep would write over {}, which it reads; choose another --out",
                input.display()
            );
            return Err(SweepError::folder(root, reason));
        }
        let entry = Entry::new(root, existing)?;
        // ... and once more when nobody else can begin: one may have since.
        let is_same = judged()?;
        let mut folder = Self {
            root: root.to_owned(),
            mark,
            lock: Lock::none(),
        };
        if entry.is_alone {
            mark::tidy(root);
        }
        if existing == Existing::Replace {
            mark::clear(root)?;
        }
        // The mark first: whatever else is in the folder stands behind it.
        folder.write_own(!is_same, MARK, &folder.mark.text())?;
        for name in ["cases", "chains"] {
            let path = root.join(name);
            std::fs::create_dir_all(&path).map_err(|e| SweepError::folder(&path, e))?;
        }
        folder.write_own(!is_same, "sweep.toml", sweep.to_toml())?;
        if let Ok(scene) = sweep.base_scene() {
            folder.write_own(!is_same, "base.toml", &scene.to_toml())?;
        }
        folder.lock = entry.share(root);
        Ok(folder)
    }

    /// Writes one of the folder's own texts if that of another sweep is there, or none.
    fn write_own(&self, is_other: bool, name: &str, text: &str) -> Result<(), SweepError> {
        let path = self.root.join(name);
        if is_other || !path.exists() {
            self.write(&path, text.as_bytes())?;
        }
        Ok(())
    }

    /// A folder that somebody has filled.
    ///
    /// # Errors
    /// [`SweepError::Folder`] when it is none of this sweep.
    pub fn open(root: &Path, sweep: &Sweep) -> Result<Self, SweepError> {
        let found = FolderMark::read(root);
        let mark = found.ok_or_else(|| SweepError::folder(root, "no sweep has marked it"))?;
        if mark.digest != sweep.digest() {
            return Err(SweepError::folder(root, "holds cases of another sweep"));
        }
        Ok(Self {
            root: root.to_owned(),
            mark,
            lock: Lock::none(),
        })
    }

    /// The sweep whose cases a folder holds.
    ///
    /// # Errors
    /// [`SweepError`] when the folder holds none.
    pub fn sweep_in(root: &Path) -> Result<Sweep, SweepError> {
        let path = root.join("sweep.toml");
        let text = super::read::read(&path, &path.display().to_string())?;
        let name = root
            .file_stem()
            .map_or_else(|| "sweep".to_owned(), |s| s.to_string_lossy().into_owned());
        Sweep::parse(&text, &name, Path::new(""))
    }

    /// Build that fills it.
    pub(super) fn build(&self) -> &str {
        &self.mark.build
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
        let text = mark::text(&self.case_path(index))?;
        let (head, body) = text.split_once('\n')?;
        let body = body.strip_suffix('\n')?;
        let digest = format!("{:016x}", fnv(body.as_bytes()));
        if head.strip_prefix(MAGIC)? != digest {
            return None;
        }
        let record: CaseRecord = serde_json::from_str(body).ok()?;
        (record.index == index).then_some(record)
    }

    /// Which of so many cases have a record, by its name.
    pub(super) fn cases_by_name(&self, cases: usize) -> Vec<bool> {
        let mut there = vec![false; cases];
        let entries = std::fs::read_dir(self.root.join("cases"));
        for entry in entries.into_iter().flatten().flatten() {
            let name = entry.file_name();
            let number = name.to_str().and_then(|name| name.strip_suffix(".json"));
            let number = number.and_then(|number| number.parse::<usize>().ok());
            if let Some(there) = number.and_then(|number| there.get_mut(number)) {
                *there = true;
            }
        }
        there
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
        chain: usize,
        case: usize,
        end: &Neighbour,
    ) -> Result<(), SweepError> {
        let checkpoint = Checkpoint {
            climb: Climb::default(),
            program: crate::program::PROGRAM.to_owned(),
            scene: end.scene.to_toml(),
            n_events_played: 0,
            n_unconverged: 0,
            n_turned_by_hand: 0,
            stats: Stats::default(),
            sim: end.state.clone(),
        };
        self.write_by(&self.state_path(chain, case), |temporary| {
            std::fs::File::create(temporary)
                .and_then(|mut file| checkpoint.write(&mut file))
                .map_err(|error| error.to_string())
        })
    }

    /// The state after a case; `None`: there is none, or none that fits.
    pub(super) fn read_state(&self, chain: usize, case: usize, scene: &Scene) -> Option<State> {
        let saved = Checkpoint::read_for(&self.state_path(chain, case), scene);
        saved.ok().map(|saved| saved.sim)
    }

    /// Takes a state away that is not needed any more.
    pub(super) fn drop_state(&self, chain: usize, case: usize) {
        // One that stays behind does no harm.
        let _ = std::fs::remove_file(self.state_path(chain, case));
    }

    fn temporary(&self) -> PathBuf {
        static COUNT: AtomicU64 = AtomicU64::new(0);
        let n = COUNT.fetch_add(1, Ordering::Relaxed);
        // Several may share a folder: the name holds the process, and the machine's in case the folder is
        // on a network.
        let name = format!("{TEMPORARY}{}-{}-{n}", claim::host(), std::process::id());
        self.root.join(name)
    }

    /// Writes a file whole or not at all.
    ///
    /// # Errors
    /// [`SweepError::Folder`] when the disk says no.
    pub fn write(&self, path: &Path, bytes: &[u8]) -> Result<(), SweepError> {
        self.write_by(path, |temporary| {
            std::fs::write(temporary, bytes).map_err(|error| error.to_string())
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
        let written = writer(&temporary).and_then(|_| {
            sync_file(&temporary)
                .and_then(|()| publish(&temporary, path, true))
                .map_err(|error| error.to_string())
        });
        written.map_err(|error| {
            let _ = std::fs::remove_file(&temporary);
            SweepError::folder(path, error)
        })
    }
}

/// Whether a sweep may work in a folder.
fn refuse(
    root: &Path,
    mark: &FolderMark,
    found: Option<&FolderMark>,
    existing: Existing,
) -> Result<(), SweepError> {
    let refused = |reason: &str| Err(SweepError::folder(root, reason));
    let Some(found) = found.filter(|_| existing != Existing::Replace) else {
        return Ok(());
    };
    if found.digest != mark.digest {
        return refused(
            "holds another sweep (an edited one, or one with another height map); choose another --out, or --force replaces it",
        );
    }
    if found.build != mark.build {
        return refused(&format!(
            "was filled by build {}, this is build {}: one table would mix the numbers of both; choose another --out, or --force starts anew",
            found.build, mark.build
        ));
    }
    let cases = std::fs::read_dir(root.join("cases"));
    if existing == Existing::Refuse && cases.is_ok_and(|mut cases| cases.next().is_some()) {
        return refused(
            "holds cases of this sweep already; --resume continues, --force starts anew",
        );
    }
    Ok(())
}

impl Sweep {
    /// What a folder's cases belong to: FNV-1a of the scene, the keys and the height maps.
    pub fn digest(&self) -> String {
        format!("{:016x}", fnv(self.canonical().as_bytes()))
    }
}
