//! The scalars of every step as comma-separated values, one row per step.
//!
//! The header names every column with its unit; what is not known yet is an empty cell. Every row
//! reaches the file at once, so a killed run leaves a table up to its last step.

use std::fs::File;
use std::path::Path;
use std::sync::Arc;

use super::cells::Cells;
use super::placed::Placed;
use super::{
    NOTHING_CAME, ObserveError, Observer, ObserverReport, Overwrite, RunContext, RunEvent,
};
use crate::sim::{Frame, LifeEstimate, Metrics, Stage};

/// Columns in the order of [`Row::write`], which destructures every field: a new metric that is
/// not given a column does not compile.
const COLUMNS: [&str; 57] = [
    "step",
    "time_s",
    "passages",
    "stage",
    "a_m",
    "b_m",
    "p_hertz_pa",
    "converged",
    "residual",
    "newton_iterations",
    "linear_iterations",
    "retries",
    "slide_roll",
    "slide_roll_target",
    "entrainment_m_s",
    "load_n",
    "load_target_n",
    "amplitude_1_m",
    "amplitude_2_m",
    "p_max_pa",
    "h_central_m",
    "h_min_m",
    "h_mean_m",
    "lambda_ratio",
    "film_to_roughness",
    "contact_ratio",
    "contact_load_ratio",
    "regime",
    "load_error",
    "film_error",
    "mass_error",
    "overlap_m",
    "friction_coefficient",
    "sigma_eff_max_pa",
    "sigma_eff_max_depth_m",
    "sigma_eff_max_x_m",
    "n_body_1",
    "n_body_2",
    "n_counted_body_1",
    "n_counted_body_2",
    "i_ref",
    "i_mean",
    "phases",
    "cycle_factor",
    "stress_factor",
    "peak_factor",
    "traction_factor",
    "load_factor",
    "life_relative",
    "life_relative_low",
    "life_relative_high",
    "settled",
    "point_x_m",
    "point_effective_pa",
    "point_cycles_counted",
    "yielded_body_1_m3",
    "yielded_body_2_m3",
];

/// Writes the table.
#[derive(Debug)]
pub struct Table {
    output: String,
    writer: csv::Writer<File>,
    placed: Placed,
    row: Row,
    rows: u64,
}

impl Table {
    /// Creates the file and writes the header.
    ///
    /// # Errors
    /// When the file exists and may not be replaced, or cannot be written.
    pub fn create(path: &Path, overwrite: Overwrite) -> Result<Self, ObserveError> {
        let (file, placed) = overwrite.open(path)?;
        let mut table = Self {
            output: path.display().to_string(),
            writer: csv::Writer::from_writer(file),
            placed,
            row: Row::default(),
            rows: 0,
        };
        table
            .writer
            .write_record(COLUMNS)
            .and_then(|()| Ok(table.writer.flush()?))
            .map_err(|error| table.failed(&error.into()))?;
        Ok(table)
    }

    fn write(&mut self, frame: &Frame) -> Result<(), csv::Error> {
        self.row.write(frame);
        for cell in self.row.cells.iter() {
            self.writer.write_field(cell)?;
        }
        self.writer.write_record(None::<&[u8]>)?;
        self.writer.flush()?;
        Ok(())
    }

    /// It keeps its rows where they are; a table that they were to replace stays.
    fn failed(&mut self, error: &std::io::Error) -> ObserveError {
        let place = self.placed.leave();
        let place = place.map_or_else(String::new, |at| format!(" in {}", at.display()));
        ObserveError::new(
            &self.output,
            format!(
                "the table could not be written ({error}); rows written before are kept{place}"
            ),
        )
    }
}

impl Observer for Table {
    fn begin(&mut self, _context: &RunContext) -> Result<(), ObserveError> {
        Ok(())
    }

    fn frame(&mut self, frame: &Arc<Frame>) -> Result<(), ObserveError> {
        self.write(frame)
            .map_err(|error| self.failed(&error.into()))?;
        self.rows += 1;
        self.placed.hold().map_err(|error| self.failed(&error))
    }

    fn event(&mut self, _event: &RunEvent) -> Result<(), ObserveError> {
        Ok(())
    }

    fn finish(&mut self) -> Result<ObserverReport, ObserveError> {
        let flushed = self.writer.flush();
        flushed.map_err(|error| self.failed(&error))?;
        let file = self.writer.get_ref();
        let bytes = file.metadata().map_or(0, |data| data.len());
        let settled = self.placed.settle();
        let is_there = settled.map_err(|error| self.failed(&error))?;
        Ok(ObserverReport {
            output: self.output.clone(),
            frames: self.rows,
            skipped: 0,
            bytes: if is_there { bytes } else { 0 },
            note: if is_there { "" } else { NOTHING_CAME }.to_owned(),
            queue: None,
        })
    }
}

/// One row, used again for the next.
#[derive(Debug, Default)]
struct Row {
    cells: Cells,
}

impl Row {
    fn cell(&mut self, value: f64) {
        self.cells.number(value);
    }

    fn count(&mut self, value: impl Into<u64>) {
        self.cells.text(value.into());
    }

    fn optional(&mut self, value: Option<f64>) {
        self.cells.optional(value);
    }

    fn write(&mut self, frame: &Frame) {
        self.cells.clear();
        self.count(frame.step);
        self.cell(frame.time_s);
        self.cell(frame.passages);
        self.cells.text(match frame.stage {
            Stage::StartUp => "start_up",
            Stage::Passage => "passage",
        });
        self.cell(frame.a_m);
        self.cell(frame.b_m);
        self.cell(frame.p_hertz_pa);
        self.metrics(&frame.metrics);
        self.life(frame.metrics.life.as_ref());
        let point = frame.material_point.as_ref();
        self.optional(point.map(|point| point.x_m));
        self.optional(point.map(|point| point.effective_pa));
        self.optional(point.map(|point| point.cycles_counted));
        let yielded = frame.metrics.yielded_m3;
        self.optional(yielded.map(|both| both[0]));
        self.optional(yielded.map(|both| both[1]));
    }

    fn metrics(&mut self, metrics: &Metrics) {
        let Metrics {
            converged,
            residual,
            newton_iterations,
            linear_iterations,
            retries,
            slide_roll,
            slide_roll_target,
            entrainment_m_s,
            load_n,
            load_target_n,
            amplitude_1_m,
            amplitude_2_m,
            p_max_pa,
            h_central_m,
            h_min_m,
            h_mean_m,
            lambda_ratio,
            film_to_roughness,
            contact_ratio,
            contact_load_ratio,
            regime,
            load_error,
            film_error,
            mass_error,
            overlap_m,
            asked: _,
            friction_coefficient,
            yielded_m3: _,
            sigma_eff_max_pa,
            sigma_eff_max_depth_m,
            sigma_eff_max_x_m,
            life: _,
            n_body_1,
            n_body_2,
            n_counted_body_1,
            n_counted_body_2,
            repeat: _,
            errors: _,
        } = metrics;
        self.count(u8::from(*converged));
        self.cell(*residual);
        self.count(*newton_iterations);
        self.count(*linear_iterations);
        self.count(*retries);
        self.cell(*slide_roll);
        self.cell(*slide_roll_target);
        self.cell(*entrainment_m_s);
        self.cell(*load_n);
        self.cell(*load_target_n);
        self.cell(*amplitude_1_m);
        self.cell(*amplitude_2_m);
        self.cell(*p_max_pa);
        self.cell(*h_central_m);
        self.cell(*h_min_m);
        self.cell(*h_mean_m);
        self.optional(*lambda_ratio);
        self.optional(*film_to_roughness);
        self.cell(*contact_ratio);
        self.cell(*contact_load_ratio);
        self.cells.text(regime.name());
        self.cell(*load_error);
        self.cell(*film_error);
        self.cell(*mass_error);
        self.cell(*overlap_m);
        self.cell(*friction_coefficient);
        self.optional(*sigma_eff_max_pa);
        self.optional(*sigma_eff_max_depth_m);
        self.optional(*sigma_eff_max_x_m);
        self.optional(*n_body_1);
        self.optional(*n_body_2);
        self.optional(*n_counted_body_1);
        self.optional(*n_counted_body_2);
    }

    fn life(&mut self, life: Option<&LifeEstimate>) {
        let Some(life) = life else {
            self.cells.empty(12);
            return;
        };
        let LifeEstimate {
            i_ref,
            i_mean,
            phases,
            cycle_factor,
            stress_factor,
            peak_factor,
            traction_factor,
            load_factor,
            life_relative,
            life_relative_low,
            life_relative_high,
            settled,
            detail: _,
        } = life;
        self.cell(*i_ref);
        self.cell(*i_mean);
        self.count(*phases);
        self.cell(*cycle_factor);
        self.cell(*stress_factor);
        self.cell(*peak_factor);
        self.cell(*traction_factor);
        self.cell(*load_factor);
        self.cell(*life_relative);
        self.cell(*life_relative_low);
        self.cell(*life_relative_high);
        self.count(u8::from(*settled));
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::sim::MaterialPoint;

    fn frame(step: u64) -> Arc<Frame> {
        Arc::new(Frame {
            step,
            time_s: 1.5e-6,
            metrics: Metrics {
                p_max_pa: 1.25e9,
                lambda_ratio: (step > 0).then_some(0.75),
                life: (step > 0).then(|| LifeEstimate {
                    life_relative: 0.25,
                    ..LifeEstimate::default()
                }),
                ..Metrics::default()
            },
            material_point: (step > 0).then(MaterialPoint::default),
            ..Frame::default()
        })
    }

    #[test]
    fn a_row_per_step_under_named_columns() {
        let folder = tempfile::tempdir().expect("a folder");
        let path = folder.path().join("run.csv");
        let mut table = Table::create(&path, Overwrite::Refuse).expect("created");
        for step in 0..3 {
            assert_eq!(table.frame(&frame(step)), Ok(()));
        }
        let report = table.finish().expect("finished");
        assert_eq!(report.frames, 3);
        assert_eq!(
            report.bytes,
            std::fs::metadata(&path).expect("a file").len()
        );

        // The reader refuses rows of another length than the header's.
        let mut reader = csv::Reader::from_path(&path).expect("readable");
        let headers = reader.headers().expect("headers").clone();
        let column = |name: &str| headers.iter().position(|header| header == name);
        let rows: Vec<csv::StringRecord> = reader.records().map(|row| row.expect("row")).collect();
        assert_eq!(rows.len(), 3);
        let cell = |row: usize, name: &str| rows[row][column(name).expect(name)].to_owned();
        assert_eq!(cell(1, "step"), "1");
        assert_eq!(cell(1, "p_max_pa").parse(), Ok(1.25e9));
        assert_eq!(cell(0, "lambda_ratio"), "");
        assert_eq!(cell(1, "lambda_ratio"), "0.75");
        assert_eq!(cell(0, "life_relative"), "");
        assert_eq!(cell(2, "life_relative"), "0.25");
        assert_eq!(cell(0, "point_x_m"), "");
        assert_eq!(cell(2, "point_x_m"), "0");
        assert_eq!(cell(0, "stage"), "start_up");
    }

    #[test]
    fn a_table_that_is_there_is_not_lost() {
        let folder = tempfile::tempdir().expect("a folder");
        let path = folder.path().join("run.csv");
        std::fs::write(&path, "mine").expect("written");
        let refused = Table::create(&path, Overwrite::Refuse).expect_err("refused");
        assert!(refused.reason.contains("--force"), "{refused}");
        assert_eq!(std::fs::read(&path).expect("readable"), b"mine");
        assert!(Table::create(&path, Overwrite::Replace).is_ok());
        let missing = folder.path().join("no").join("run.csv");
        let refused = Table::create(&missing, Overwrite::Refuse).expect_err("refused");
        assert!(refused.reason.contains("folder"), "{refused}");
    }
}
