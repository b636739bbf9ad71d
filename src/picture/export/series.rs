//! All steps of a run with a time axis: as one archive for numpy, and as the list by which ParaView plays the files of steps.
//!
//! ```text
//! fields.npz      time_s [time], step [time], every scalar [time] (no number where it is not known), x_m [x], y_m [y],
//!                 slice_depths_m [depth], pressure_pa [time, y, x], ..., slice_effective_pa [time, depth, x], ...
//! fields.pvd      <DataSet timestep="time, s" file="step_000016.vti"/> ...         slices.pvd: of the plane below
//! ```
//! Each array waits in a file without a name until its length is known, so that a long run takes no memory.

use std::fmt::Write as _;
use std::fs::File;
use std::io::{Error, ErrorKind, Result, Seek as _, Write};
use std::path::Path;

use crc32fast::Hasher;

use super::fields::{FieldArray, NumberKind, arrays, length};
use super::npz::Npz;
use asperity_engine::sim::{CATALOGUE, Frame};

/// Largest archive, bytes: what the format holds, less its directory.
const LARGEST: u64 = u32::MAX as u64 - (1 << 20);

/// An array that grows by a part with each step, or stays.
#[derive(Debug)]
struct Stack {
    name: &'static str,
    kind: NumberKind,
    /// Of a step's part.
    shape: Vec<usize>,
    grows: bool,
    steps: usize,
    file: File,
    bytes: u64,
    checksum: Hasher,
}

impl Stack {
    fn put(&mut self, bytes: &[u8]) -> Result<()> {
        self.file.write_all(bytes)?;
        self.checksum.update(bytes);
        self.bytes += bytes.len() as u64;
        self.steps += 1;
        Ok(())
    }
}

/// The steps so far.
#[derive(Debug, Default)]
pub(super) struct Series {
    stacks: Vec<Stack>,
    times_s: Vec<f64>,
}

impl Series {
    /// Takes up a step; its arrays wait in files of that folder.
    pub(super) fn take(&mut self, frame: &Frame, folder: &Path) -> Result<()> {
        let is_first = self.times_s.is_empty();
        self.times_s.push(frame.time_s);
        let unknown = |name: &'static str| FieldArray::number(name, f64::NAN);
        let scalars = CATALOGUE.iter().map(|quantity| {
            let value = quantity.number(frame);
            value.map_or_else(
                || unknown(quantity.name),
                |v| FieldArray::number(quantity.name, v),
            )
        });
        let fields = arrays(frame).into_iter().filter(|own| !own.axes.is_empty());
        for array in scalars.chain(fields) {
            if is_first {
                self.begin(&array, frame, folder)?;
            }
            let FieldArray { name, values, .. } = array;
            let stack = self.stacks.iter_mut().find(|own| own.name == name);
            let is_due = |own: &&mut Stack| own.grows || is_first;
            if let Some(stack) = stack.filter(is_due) {
                stack.put(&values.bytes())?;
            }
        }
        let bytes: u64 = self.stacks.iter().map(|stack| stack.bytes).sum();
        if bytes > LARGEST {
            let steps = self.times_s.len();
            let what = format!(
                "{steps} steps are more than the 4 GB of a numpy archive; take fewer (--every, --export-every) or \
                 files of steps (npz)"
            );
            return Err(Error::new(ErrorKind::FileTooLarge, what));
        }
        Ok(())
    }

    fn begin(&mut self, array: &FieldArray, frame: &Frame, folder: &Path) -> Result<()> {
        let shape: Vec<usize> = array.axes.iter().map(|axis| length(frame, axis)).collect();
        self.stacks.push(Stack {
            name: array.name,
            kind: array.values.kind(),
            shape,
            // Places stay.
            grows: array.axes.len() != 1,
            steps: 0,
            file: tempfile::tempfile_in(folder)?,
            bytes: 0,
            checksum: Hasher::new(),
        });
        Ok(())
    }

    /// Writes the archive; its bytes. What some of the steps did not have would belong to no time.
    pub(super) fn write(self, out: impl Write) -> Result<u64> {
        let mut npz = Npz::new(out);
        let steps = self.times_s.len();
        for mut stack in self.stacks {
            if stack.grows && stack.steps != steps {
                let (name, own) = (stack.name, stack.steps);
                let what = format!("{name} is in {own} of {steps} steps");
                return Err(Error::new(ErrorKind::InvalidData, what));
            }
            if stack.grows {
                stack.shape.insert(0, steps);
            }
            stack.file.rewind()?;
            let (bytes, checksum) = (stack.bytes, &stack.checksum);
            npz.array_of_file(
                stack.name,
                &stack.shape,
                stack.kind,
                bytes,
                checksum,
                &mut stack.file,
            )?;
        }
        npz.finish()
    }

    /// Whether no step came.
    pub(super) fn is_empty(&self) -> bool {
        self.times_s.is_empty()
    }
}

/// The list of files that ParaView plays: each with its time, s. Source: ParaView's guide, "PVD".
pub(super) fn pvd(files: &[(f64, String)]) -> String {
    let mut text = "<?xml version=\"1.0\"?>\n<VTKFile type=\"Collection\" version=\"0.1\" byte_order=\"LittleEndian\">\n\
                    <Collection>\n"
        .to_owned();
    for (time_s, file) in files {
        // Writing to a string cannot fail.
        let _ = writeln!(
            text,
            "<DataSet timestep=\"{time_s}\" part=\"0\" file=\"{file}\"/>"
        );
    }
    text + "</Collection>\n</VTKFile>\n"
}

#[cfg(test)]
mod tests {
    #![expect(clippy::unwrap_used, reason = "tests")]
    use super::*;

    fn frame(step: u64, heat: bool) -> Frame {
        Frame {
            step,
            time_s: step as f64,
            nx: 3,
            ny: 1,
            pressure_pa: vec![step as f32; 3],
            film_m: vec![1e-7; 3],
            roughness_1_m: vec![0.0; 3],
            roughness_2_m: vec![0.0; 3],
            traction_pa: vec![0.0; 3],
            contact: vec![0; 3],
            film_rise_k: if heat { vec![1.0; 3] } else { Vec::new() },
            ..Frame::default()
        }
    }

    #[test]
    fn arrays_have_a_time_axis_and_places_have_none() {
        let folder = tempfile::tempdir().unwrap();
        let mut series = Series::default();
        for step in [2, 4, 7] {
            series.take(&frame(step, false), folder.path()).unwrap();
        }
        let mut bytes = Vec::new();
        let written = series.write(&mut bytes).unwrap();
        assert_eq!(written, bytes.len() as u64);
        let text = String::from_utf8_lossy(&bytes);
        for (name, shape) in [
            ("pressure_pa", "(3, 1, 3, )"),
            ("x_m", "(3, )"),
            ("time_s", "(3, )"),
        ] {
            let after = text.split(&format!("{name}.npy")).nth(1).unwrap();
            let header = after.split('\n').next().unwrap();
            assert!(header.contains(shape), "{name}: {header}");
        }
        let pressure: Vec<u8> = [2_f32, 2.0, 2.0, 4.0, 4.0, 4.0, 7.0, 7.0, 7.0]
            .iter()
            .flat_map(|value| value.to_le_bytes())
            .collect();
        assert!(bytes.windows(pressure.len()).any(|own| own == pressure));
    }

    #[test]
    fn what_some_steps_lack_is_refused() {
        let folder = tempfile::tempdir().unwrap();
        let mut series = Series::default();
        series.take(&frame(1, true), folder.path()).unwrap();
        series.take(&frame(2, false), folder.path()).unwrap();
        let error = series.write(Vec::new()).unwrap_err().to_string();
        assert_eq!(error, "film_rise_k is in 1 of 2 steps");
    }

    #[test]
    fn a_list_names_times_and_files() {
        let list = pvd(&[(0.5, "step_000001.vti".to_owned())]);
        assert!(list.contains("timestep=\"0.5\" part=\"0\" file=\"step_000001.vti\""));
    }
}
