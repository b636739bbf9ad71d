//! Chosen steps as `.npz` files that numpy, Julia and MATLAB read, and as pictures, with the scene beside them.
//!
//! One file a step: `step_000128.npz` with arrays named as the frame's fields, units in the names, `[y, x]`
//! with x the rolling direction, the slice `[depth, x]`; every scalar that is known, named as in the table. Pictures are `step_000128_pressure.png` and so on. Beside them `scene.toml`, which
//! repeats the run.

mod drawing;
mod npz;
mod png;

use std::fs::{File, TryLockError};
use std::io::BufWriter;
use std::path::{Path, PathBuf};
use std::sync::Arc;

use self::npz::Npz;
use self::png::Pictures;
use super::{
    NOTHING_CAME, ObserveError, Observer, ObserverReport, Overwrite, RunContext, RunEvent,
};
use crate::sim::{CATALOGUE, Frame, Stage};

/// What is written of a step.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Format {
    /// All fields as a numpy archive.
    Npz,
    /// Maps and centre line as pictures.
    Png,
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
    pictures: Pictures,
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
            pictures: Pictures::default(),
            frames: 0,
            bytes: 0,
        })
    }

    fn failed(&self, error: &std::io::Error) -> ObserveError {
        ObserveError::new(
            self.folder.display().to_string(),
            format!("the fields could not be written ({error}); files written before are kept"),
        )
    }

    fn draw(&mut self, frame: &Frame) -> Result<u64, ObserveError> {
        let mut bytes = 0;
        for (page, path) in Pictures::files(frame, &self.folder) {
            self.overwrite.write_by(&path, |at| {
                let drawn = self.pictures.draw(frame, page, at);
                drawn.map_err(std::io::Error::other)
            })?;
            bytes += std::fs::metadata(&path).map_or(0, |data| data.len());
        }
        Ok(bytes)
    }

    fn write(&self, frame: &Frame) -> Result<u64, ObserveError> {
        let path = self.folder.join(format!("step_{:06}.npz", frame.step));
        self.overwrite
            .write_by(&path, |at| write_frame(File::create(at)?, frame))
    }

    /// Puts the scene into the folder, in place of what an earlier run left there: its steps beside another scene
    /// would pass for this one's. Not before there is a step to put beside it.
    fn move_in(&mut self) -> Result<(), ObserveError> {
        let entries = std::fs::read_dir(&self.folder).into_iter().flatten();
        let names = entries.flatten().map(|entry| entry.file_name());
        for name in names.filter(|name| is_a_step(&name.to_string_lossy())) {
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
    let head = crate::files::read_up_to(path, 1 << 20).unwrap_or_default();
    head.starts_with(b"# A scene of asperity.")
}

/// Whether a file of that name is one that an export writes: `step_000128.npz`, `step_000128_pressure.png`, the
/// scene.
pub fn is_exported(name: &str) -> bool {
    name == SCENE || is_a_step(name)
}

fn is_a_step(name: &str) -> bool {
    let Some(rest) = name.strip_prefix("step_") else {
        return false;
    };
    let what = rest.trim_start_matches(|c: char| c.is_ascii_digit());
    rest.len() - what.len() >= 6 && (what == ".npz" || Pictures::are_named(what))
}

/// All arrays of a frame; the bytes written.
fn write_frame(file: File, frame: &Frame) -> std::io::Result<u64> {
    let mut npz = Npz::new(BufWriter::new(file));
    for quantity in CATALOGUE {
        if let Some(value) = quantity.number(frame) {
            npz.f64(quantity.name, &[], &[value])?;
        }
    }
    let axis = |n: usize, first: f64, step: f64| -> Vec<f64> {
        (0..n).map(|k| first + step * k as f64).collect()
    };
    npz.f64(
        "x_m",
        &[frame.nx],
        &axis(frame.nx, frame.x_min_m, frame.dx_m),
    )?;
    npz.f64(
        "y_m",
        &[frame.ny],
        &axis(frame.ny, frame.y_min_m, frame.dy_m),
    )?;
    let plane = [frame.ny, frame.nx];
    for (name, field) in [
        ("pressure_pa", &frame.pressure_pa),
        ("film_m", &frame.film_m),
        ("roughness_1_m", &frame.roughness_1_m),
        ("roughness_2_m", &frame.roughness_2_m),
        ("traction_on_body_1_pa", &frame.traction_pa),
    ] {
        npz.f32(name, &plane, field)?;
    }
    npz.u8("contact", &plane, &frame.contact)?;
    if let Some(slice) = &frame.slice {
        let shape = [slice.depths_m.len(), frame.nx];
        npz.f64("slice_depths_m", &shape[..1], &slice.depths_m)?;
        npz.f32("slice_effective_pa", &shape, &slice.effective_pa)?;
        npz.f32("slice_tau_xz_pa", &shape, &slice.tau_xz_pa)?;
    }
    npz.finish()
}

impl Observer for Export {
    fn begin(&mut self, context: &RunContext) -> Result<(), ObserveError> {
        self.scene_toml.clone_from(&context.scene_toml);
        self.pictures = Pictures::new(&context.scene);
        Ok(())
    }

    fn frame(&mut self, frame: &Arc<Frame>) -> Result<(), ObserveError> {
        if frame.stage == Stage::Passage {
            if self.frames == 0 {
                self.move_in()?;
            }
            if self.formats.contains(&Format::Npz) {
                self.bytes += self.write(frame)?;
            }
            if self.formats.contains(&Format::Png) {
                self.bytes += self.draw(frame)?;
            }
            self.frames += 1;
        }
        Ok(())
    }

    fn event(&mut self, _event: &RunEvent) -> Result<(), ObserveError> {
        Ok(())
    }

    fn finish(&mut self) -> Result<ObserverReport, ObserveError> {
        let is_empty = self.frames == 0;
        Ok(ObserverReport {
            output: self.folder.display().to_string(),
            frames: self.frames,
            skipped: 0,
            bytes: self.bytes,
            note: if is_empty { NOTHING_CAME } else { "" }.to_owned(),
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
