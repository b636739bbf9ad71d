//! Chosen steps as `.npz` files that numpy, Julia and MATLAB read, and as pictures, with the scene beside them.
//!
//! One file a step: `step_000128.npz` with arrays named as the frame's fields, units in the names, `[y, x]`
//! with x the rolling direction, the slice `[depth, x]`. Pictures are `step_000128_pressure.png` and so on. Beside them `scene.toml`, which
//! repeats the run.

mod drawing;
mod npz;
mod png;

use std::fs::File;
use std::io::{BufWriter, Write as _};
use std::path::{Path, PathBuf};
use std::sync::Arc;

use self::npz::Npz;
use self::png::Pictures;
use super::{ObserveError, Observer, ObserverReport, Overwrite, RunContext, RunEvent};
use crate::sim::{Frame, Stage};

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
    overwrite: Overwrite,
    formats: Vec<Format>,
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
        std::fs::create_dir_all(folder)
            .map_err(|error| failed(format!("the folder cannot be made: {error}")))?;
        let mut entries = std::fs::read_dir(folder)
            .map_err(|error| failed(format!("the folder cannot be read: {error}")))?;
        if overwrite == Overwrite::Refuse && entries.next().is_some() {
            let reason = "the folder is not empty; choose another or ask for overwriting (--force)";
            return Err(failed(reason.to_owned()));
        }
        Ok(Self {
            folder: folder.to_owned(),
            overwrite,
            formats: formats.to_vec(),
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
        for (subject, path) in Pictures::files(frame, &self.folder) {
            // Made here, so that nothing is overwritten unasked and an error has its path.
            drop(self.overwrite.create(&path)?);
            let drawn = self.pictures.draw(frame, subject, &path);
            drawn.map_err(|reason| ObserveError::new(path.display().to_string(), reason))?;
            bytes += std::fs::metadata(&path).map_or(0, |data| data.len());
        }
        Ok(bytes)
    }

    fn write(&self, frame: &Frame) -> Result<u64, ObserveError> {
        let path = self.folder.join(format!("step_{:06}.npz", frame.step));
        let file = self.overwrite.create(&path)?;
        write_frame(file, frame).map_err(|error| self.failed(&error))
    }
}

/// All arrays of a frame; the bytes written.
fn write_frame(file: File, frame: &Frame) -> std::io::Result<u64> {
    let mut npz = Npz::new(BufWriter::new(file));
    npz.f64("step", &[], &[frame.step as f64])?;
    for (name, value) in [
        ("time_s", frame.time_s),
        ("passages", frame.passages),
        ("a_m", frame.a_m),
        ("b_m", frame.b_m),
        ("p_hertz_pa", frame.p_hertz_pa),
        ("slide_roll", frame.metrics.slide_roll),
    ] {
        npz.f64(name, &[], &[value])?;
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
        let mut file = self.overwrite.create(&self.folder.join("scene.toml"))?;
        file.write_all(context.scene_toml.as_bytes())
            .map_err(|error| self.failed(&error))?;
        self.pictures = Pictures::new(&context.scene.title);
        Ok(())
    }

    fn frame(&mut self, frame: &Arc<Frame>) -> Result<(), ObserveError> {
        if frame.stage == Stage::Passage {
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
        Ok(ObserverReport {
            output: self.folder.display().to_string(),
            frames: self.frames,
            skipped: 0,
            bytes: self.bytes,
            note: String::new(),
            queue: None,
        })
    }
}
