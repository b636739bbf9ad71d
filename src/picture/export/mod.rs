//! Chosen steps as `.npz` files that numpy, Julia and MATLAB read, as `.vti` and `.vtr` that ParaView opens, and as pictures,
//! with the scene beside them.
//!
//! One file a step: `step_000128.npz` with arrays named as the frame's fields, units in the names, `[y, x]`
//! with x the rolling direction, the slice `[depth, x]`; every scalar that is known, named as in the table.
//! `step_000128.vti` and `step_000128_slice.vtr` hold the same. Pictures are `step_000128_pressure.png` and so on. Beside
//! them `scene.toml`, which repeats the run.

mod animation;
mod centre_line;
mod fields;
mod format;
mod history;
mod map;
mod npz;
mod pages;
mod passage;
mod plotted;
mod profile;
mod series;
mod sheet;
mod tooth_page;
mod vtk;
mod white;

use std::collections::{BTreeMap, BTreeSet};
use std::fs::{File, TryLockError};
use std::io::{BufWriter, Error};
use std::path::{Path, PathBuf};
use std::sync::Arc;

use self::animation::Animation;
use self::fields::write_npz;
pub use self::format::Format;
use self::format::FormatKind;
use self::pages::{Page, Pictures, SheetKind};
use self::series::Series;
pub use self::sheet::PrintSize;
use crate::draw::Drawing;
use asperity_engine::observe::{
    NOTHING_CAME, ObserveError, Observer, ObserverReport, Overwrite, RunContext, RunEvent,
};
use asperity_engine::scene::Scene;
use asperity_engine::sim::{Frame, Stage};

/// What becomes of a step.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub enum TakenAs {
    /// A picture of those that move, and what later pictures show of what has been.
    Moving,
    /// That, and a part of what has a time axis.
    InSeries,
    /// That, and files of its own.
    Still,
}

/// Names of the pictures that there are.
pub fn picture_names() -> Vec<&'static str> {
    Pictures::names().collect()
}

/// Writes fields and pictures.
#[derive(Debug)]
pub struct Export {
    folder: PathBuf,
    /// Held while it is written into. Where the system knows no locks there is none to respect.
    _lock: Option<File>,
    /// The folder was not there before.
    is_new: bool,
    overwrite: Overwrite,
    formats: Vec<Format>,
    scene_toml: String,
    /// Of the run, and of those that stand beside it.
    pictures: Vec<Pictures>,
    /// Pictures that are drawn; empty: all, or of those that move the one that tells most.
    chosen: Vec<String>,
    print: PrintSize,
    /// Whether ranges of what papers print are those of the step that stands alone.
    stands_alone: bool,
    /// Of the steps that it is given it writes those that are multiples.
    every: u64,
    moving: BTreeMap<&'static str, Animation>,
    series: Series,
    /// Names of the pictures that were drawn.
    drawn: BTreeSet<&'static str>,
    /// Time, s, and file of each step for ParaView: of the surface and of the plane below.
    lists: [Vec<(f64, String)>; 2],
    frames: u64,
    bytes: u64,
}

impl Export {
    /// Makes the folder, if it is not there, and sees that nothing in it is lost.
    ///
    /// # Errors
    /// When the folder cannot be made, or holds something and may not be written over.
    pub fn create(
        folder: &Path,
        overwrite: Overwrite,
        formats: &[Format],
    ) -> Result<Self, ObserveError> {
        let failed = |reason: String| ObserveError::new(folder.display().to_string(), reason);
        let is_new = !folder.exists();
        std::fs::create_dir_all(folder)
            .map_err(|error| failed(format!("the folder cannot be made: {error}")))?;
        let lock = File::open(folder).ok().filter(|_| cfg!(unix));
        if let Some(Err(TryLockError::WouldBlock)) = lock.as_ref().map(File::try_lock) {
            let reason =
                "another run is writing into it; wait for its end or choose another folder";
            return Err(failed(reason.to_owned()));
        }
        let mut entries = std::fs::read_dir(folder)
            .map_err(|error| failed(format!("the folder cannot be read: {error}")))?;
        if overwrite == Overwrite::Refuse && entries.next().is_some() {
            let reason = "the folder is not empty; choose another or ask for overwriting (--force)";
            return Err(failed(reason.to_owned()));
        }
        let scene = folder.join(SCENE);
        if scene.exists() && !is_ours(&scene) {
            let reason = "holds a scene.toml that no export wrote; choose another folder";
            return Err(failed(reason.to_owned()));
        }
        overwrite.check(&scene)?;
        Ok(Self {
            folder: folder.to_owned(),
            _lock: lock,
            is_new,
            overwrite,
            formats: formats.to_vec(),
            scene_toml: String::new(),
            pictures: vec![Pictures::default()],
            chosen: Vec::new(),
            print: PrintSize::default(),
            stands_alone: false,
            every: 1,
            moving: BTreeMap::new(),
            series: Series::default(),
            drawn: BTreeSet::new(),
            lists: Default::default(),
            frames: 0,
            bytes: 0,
        })
    }

    fn failed(&self, error: &Error) -> ObserveError {
        ObserveError::new(
            self.folder.display().to_string(),
            format!("the fields could not be written ({error}); files written before are kept"),
        )
    }

    /// Draws the pictures of these names alone, and prints those for papers in that size.
    #[must_use]
    pub fn of(mut self, chosen: &[String], print: PrintSize) -> Self {
        (self.chosen, self.print) = (chosen.to_vec(), print);
        self
    }

    /// Gives what papers print ranges with round ends just above what its step holds, as no other is compared with it.
    #[must_use]
    pub fn alone(mut self, stands_alone: bool) -> Self {
        self.stands_alone = stands_alone;
        self
    }

    /// Writes every n-th step only; where it [draws](Format::is_drawn) it should be given all of them, for what pictures show
    /// of the steps between.
    #[must_use]
    pub fn every(mut self, steps: u64) -> Self {
        self.every = steps.max(1);
        self
    }

    /// Draws runs of these scenes beside the one that it begins with, in ranges that hold for all.
    #[must_use]
    pub fn beside<'a>(mut self, scenes: impl Iterator<Item = &'a Scene>) -> Self {
        self.pictures.extend(scenes.map(Pictures::new));
        self
    }

    /// Takes a step up.
    ///
    /// # Errors
    /// When a file cannot be written.
    pub fn take(&mut self, frame: &Frame, taken: TakenAs) -> Result<(), ObserveError> {
        self.take_all(&[frame], taken)
    }

    /// The same of all runs that stand beside each other; arrays are those of the first.
    ///
    /// # Errors
    /// When a file cannot be written.
    pub fn take_all(&mut self, frames: &[&Frame], taken: TakenAs) -> Result<(), ObserveError> {
        let Some(&frame) = frames.first() else {
            return Ok(());
        };
        if self.frames == 0 {
            self.move_in()?;
            self.share_ranges(frames);
        }
        // Arrays hold all of a frame.
        let mut shown = Vec::new();
        if self.draws() {
            let pairs = self.pictures.iter_mut().zip(frames);
            shown.extend(pairs.map(|(pictures, frame)| pictures.shown(frame)));
        }
        if self.formats.contains(&Format::Gif) {
            self.follow(&shown)?;
        }
        if taken >= TakenAs::InSeries && self.formats.contains(&Format::NpzSeries) {
            let took = self.series.take(frame, &self.folder);
            took.map_err(|error| self.failed(&error))?;
        }
        let is_still = taken == TakenAs::Still;
        let own = match self.pictures.first_mut() {
            Some(pictures) if is_still && self.stands_alone => pictures.ranges_around(&shown),
            _ => None,
        };
        let print = SheetKind::Printed(self.print, own);
        for format in self.formats.clone().into_iter().filter(|_| is_still) {
            self.bytes += match format {
                Format::Npz => self.write(frame, NPZ, &|out| write_npz(out, frame))?,
                Format::Vti => self.write_vtk(frame)?,
                Format::Png => self.draw(&shown, format, SheetKind::Still, Drawing::png)?,
                Format::Svg => self.draw(&shown, format, print, Drawing::svg)?,
                Format::Pdf => self.draw(&shown, format, print, Drawing::pdf)?,
                Format::NpzSeries | Format::Gif | Format::Csv => 0,
            };
        }
        self.frames += 1;
        Ok(())
    }

    /// Tells the band of a run's life with what the mesh costs, which its last step is shown with.
    pub fn end(&mut self, run: usize, last: (u64, [f64; 2])) {
        if let Some(pictures) = self.pictures.get_mut(run) {
            pictures.end(last);
        }
    }

    /// Takes up a step of a run, counted from 0, without fields, for what pictures show of the followed point.
    pub fn pass(&mut self, run: usize, frame: &Frame) {
        if let Some(pictures) = self.pictures.get_mut(run) {
            pictures.pass(frame);
        }
    }

    fn draws(&self) -> bool {
        self.formats.iter().any(|format| format.is_drawn())
    }

    /// Gives runs that stand beside each other the same ranges.
    fn share_ranges(&mut self, frames: &[&Frame]) {
        let scopes = self.pictures.iter().zip(frames);
        let scopes = scopes.map(|(pictures, frame)| pictures.scope(frame));
        let common = scopes.reduce(|one, other| one.with(&other));
        if let Some(common) = common.filter(|_| frames.len() > 1) {
            for pictures in &mut self.pictures {
                pictures.share(&common);
            }
        }
    }

    /// A page of all runs.
    fn page(
        &mut self,
        shown: &[Frame],
        page: Page,
        kind: SheetKind,
    ) -> Result<Drawing, ObserveError> {
        let pairs = self.pictures.iter_mut().zip(shown);
        let all: Result<Vec<Drawing>, String> = pairs
            .map(|(pictures, frame)| pictures.draw(frame, page, kind))
            .collect();
        let joined = all.and_then(|all| {
            let joined = all.into_iter().reduce(Drawing::beside);
            joined.ok_or_else(|| "there is no run".to_owned())
        });
        joined.map_err(|reason| self.failed(&Error::other(reason)))
    }

    /// A step's pictures in one format; the bytes written.
    fn draw(
        &mut self,
        shown: &[Frame],
        format: Format,
        sheet: SheetKind,
        file: fn(&Drawing) -> Result<Vec<u8>, String>,
    ) -> Result<u64, ObserveError> {
        let mut bytes = 0;
        for (name, page) in Pictures::pages(&self.pictures, shown, &self.chosen) {
            self.drawn.insert(name);
            let drawn = file(&self.page(shown, page, sheet)?);
            let drawn = drawn.map_err(|reason| self.failed(&Error::other(reason)))?;
            let step = shown.first().map_or(0, |frame| frame.step);
            let name = format!("step_{step:06}_{name}.{}", format.ending());
            self.overwrite.write(&self.folder.join(name), &drawn)?;
            bytes += drawn.len() as u64;
        }
        Ok(bytes)
    }

    /// Takes a step up for the pictures that move, which are written at the end.
    fn follow(&mut self, shown: &[Frame]) -> Result<(), ObserveError> {
        let one = [Pictures::MOVING.to_owned()];
        let chosen = if self.chosen.is_empty() {
            &one[..]
        } else {
            &self.chosen
        };
        let shared = shown.len() > 1;
        let kind = SheetKind::Moving { shared };
        for (name, page) in Pictures::pages(&self.pictures, shown, chosen) {
            self.drawn.insert(name);
            if self.moving.entry(name).or_default().wants() {
                let pixels = self.page(shown, page, kind)?.pixels();
                let pixels = pixels.map_err(|reason| self.failed(&Error::other(reason)))?;
                self.moving.entry(name).or_default().push(pixels);
            }
        }
        Ok(())
    }

    /// What was asked for and is in no step, in words.
    fn missing(&self) -> String {
        let asked = self.chosen.iter().filter(|_| self.draws());
        let missing = asked.filter(|name| !self.drawn.contains(name.as_str()));
        let missing: Vec<&str> = missing.map(String::as_str).collect();
        if missing.is_empty() {
            return String::new();
        }
        format!(
            "nothing to draw of {}: the run has none of it",
            missing.join(", ")
        )
    }

    /// Writes the pictures that move.
    fn write_moving(&mut self) -> Result<(), ObserveError> {
        for (name, animation) in std::mem::take(&mut self.moving) {
            let path = self.folder.join(moving_file(name));
            self.overwrite.write_by(&path, |at| {
                let out = BufWriter::new(File::create(at)?);
                animation.write(out).map_err(Error::other)
            })?;
            self.bytes += std::fs::metadata(&path).map_or(0, |data| data.len());
        }
        Ok(())
    }

    /// Writes a file of a step's arrays; the bytes written.
    fn write(
        &self,
        frame: &Frame,
        ending: &str,
        by: &dyn Fn(BufWriter<File>) -> Result<u64, Error>,
    ) -> Result<u64, ObserveError> {
        let file = self.folder.join(step_file(frame.step, ending));
        let write = |at: &Path| by(BufWriter::new(File::create(at)?));
        self.overwrite.write_by(&file, write)
    }

    /// Writes the arrays of a step for VTK; the bytes written.
    fn write_vtk(&mut self, frame: &Frame) -> Result<u64, ObserveError> {
        let listed = |ending: &str| (frame.time_s, step_file(frame.step, ending));
        let mut bytes = self.write(frame, VTI, &|out| vtk::write_surface(out, frame))?;
        self.lists[0].push(listed(VTI));
        if let Some(slice) = &frame.slice {
            bytes += self.write(frame, VTR, &|out| vtk::write_slice(out, frame, slice))?;
            self.lists[1].push(listed(VTR));
        }
        Ok(bytes)
    }

    /// Writes what has a time axis.
    fn write_series(&mut self) -> Result<(), ObserveError> {
        for (name, files) in LISTS.into_iter().zip(std::mem::take(&mut self.lists)) {
            if !files.is_empty() {
                let list = series::pvd(&files);
                self.bytes += list.len() as u64;
                self.overwrite
                    .write(&self.folder.join(name), list.as_bytes())?;
            }
        }
        let series = std::mem::take(&mut self.series);
        if !series.is_empty() {
            let file = self.folder.join(SERIES);
            self.bytes += self
                .overwrite
                .write_by(&file, |at| series.write(BufWriter::new(File::create(at)?)))?;
        }
        Ok(())
    }

    /// Puts the scene into the folder, in place of what an earlier run left there: its steps beside another scene
    /// would pass for this one's. Not before there is a step to put beside it.
    fn move_in(&mut self) -> Result<(), ObserveError> {
        let entries = std::fs::read_dir(&self.folder).into_iter().flatten();
        let names = entries.flatten().map(|entry| entry.file_name());
        let ours = |name: &str| is_exported(name) && name != SCENE;
        for name in names.filter(|name| ours(&name.to_string_lossy())) {
            let removed = std::fs::remove_file(self.folder.join(name));
            removed.map_err(|error| self.failed(&error))?;
        }
        let scene = self.folder.join(SCENE);
        self.overwrite.write(&scene, self.scene_toml.as_bytes())
    }
}

/// The scene beside the steps.
const SCENE: &str = "scene.toml";

/// Whether a file begins as the scenes do that this program writes.
fn is_ours(path: &Path) -> bool {
    let head = asperity_engine::files::read_up_to(path, 1 << 20).unwrap_or_default();
    head.starts_with(b"# A scene of asperity.")
}

/// Endings of the files of a step's arrays.
const NPZ: &str = ".npz";
const VTI: &str = ".vti";
const VTR: &str = "_slice.vtr";
/// The archive with a time axis, and the lists by which ParaView plays steps.
const SERIES: &str = "fields.npz";
const LISTS: [&str; 2] = ["fields.pvd", "slices.pvd"];

fn step_file(step: u64, ending: &str) -> String {
    format!("step_{step:06}{ending}")
}

/// Whether a file of that name is one that an export writes: `step_000128.npz`, `step_000128_pressure.png`, the
/// scene.
pub fn is_exported(name: &str) -> bool {
    [SCENE, SERIES].contains(&name) || LISTS.contains(&name) || is_a_step(name) || is_moving(name)
}

fn is_a_step(name: &str) -> bool {
    let Some(rest) = name.strip_prefix("step_") else {
        return false;
    };
    let what = rest.trim_start_matches(|c: char| c.is_ascii_digit());
    let is_picture = || {
        let parts = what.strip_prefix('_').and_then(|what| what.split_once('.'));
        parts.is_some_and(|(name, ending)| is_named(name, ending, FormatKind::Pictures))
    };
    rest.len() - what.len() >= 6 && ([NPZ, VTI, VTR].contains(&what) || is_picture())
}

fn is_moving(name: &str) -> bool {
    let parts = name.split_once('.');
    parts.is_some_and(|(name, ending)| is_named(name, ending, FormatKind::Moving))
}

/// Whether a picture has that name, and a format of that kind that ending.
fn is_named(name: &str, ending: &str, kind: FormatKind) -> bool {
    let formats = Format::ALL.into_iter();
    let mut of_kind = formats.filter(|format| format.kind() == kind);
    of_kind.any(|format| format.ending() == ending) && Pictures::names().any(|own| own == name)
}

/// Name of a picture that moves.
fn moving_file(name: &str) -> String {
    format!("{name}.{}", Format::Gif.ending())
}

impl Observer for Export {
    fn begin(&mut self, context: &RunContext) -> Result<(), ObserveError> {
        self.scene_toml.clone_from(&context.scene_toml);
        self.pictures[0] = Pictures::new(&context.scene);
        Ok(())
    }

    fn frame(&mut self, frame: &Arc<Frame>) -> Result<(), ObserveError> {
        if frame.stage != Stage::Passage {
            return Ok(());
        }
        if frame.step.is_multiple_of(self.every) {
            self.take(frame, TakenAs::Still)?;
        } else if self.draws() {
            self.pictures[0].shown(frame);
        }
        Ok(())
    }

    fn kept(&self) -> Option<u64> {
        Some(self.frames)
    }

    fn event(&mut self, _event: &RunEvent) -> Result<(), ObserveError> {
        Ok(())
    }

    fn finish(&mut self) -> Result<ObserverReport, ObserveError> {
        let is_empty = self.frames == 0;
        self.write_moving()?;
        self.write_series()?;
        Ok(ObserverReport {
            output: self.folder.display().to_string(),
            frames: self.frames,
            skipped: 0,
            bytes: self.bytes,
            note: if is_empty {
                NOTHING_CAME.to_owned()
            } else {
                self.missing()
            },
            queue: None,
        })
    }
}

impl Drop for Export {
    /// A folder that was made for nothing goes again.
    fn drop(&mut self) {
        if self.is_new && self.frames == 0 {
            // Only an empty folder can be taken away like this.
            drop(std::fs::remove_dir(&self.folder));
        }
    }
}
