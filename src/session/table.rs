//! The scalars of every step as comma-separated values, one row per step.
//!
//! The columns are the [`CATALOGUE`]'s; what is not known yet is an empty cell. Every row
//! reaches the file at once, so a killed run leaves a table up to its last step.

use std::fs::File;
use std::path::Path;
use std::sync::Arc;

use crate::cells::Cells;
use asperity_engine::observe::{
    Left, NOTHING_CAME, ObserveError, Observer, ObserverReport, Overwrite, Placed, RunContext,
    RunEvent, RunEventKind,
};
use asperity_engine::sim::{CATALOGUE, Frame};

/// Writes the table.
#[derive(Debug)]
pub struct Table {
    output: String,
    writer: csv::Writer<File>,
    placed: Placed,
    row: Cells,
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
            row: Cells::default(),
            rows: 0,
        };
        table
            .writer
            .write_record(CATALOGUE.iter().map(|quantity| quantity.name))
            .and_then(|()| Ok(table.writer.flush()?))
            .map_err(|error| table.failed(&error.into()))?;
        Ok(table)
    }

    fn write(&mut self, frame: &Frame) -> Result<(), csv::Error> {
        self.row.clear();
        for quantity in CATALOGUE {
            self.row.reading(quantity.read(frame));
        }
        for cell in self.row.iter() {
            self.writer.write_field(cell)?;
        }
        self.writer.write_record(None::<&[u8]>)?;
        self.writer.flush()?;
        Ok(())
    }

    /// It keeps its rows where they are; a table that they were to replace stays.
    fn failed(&mut self, error: &std::io::Error) -> ObserveError {
        let rows = self.rows;
        let kept = match self.placed.leave() {
            Left::Nothing => "no row of it was written".to_owned(),
            Left::InItsPlace => format!("the {rows} rows written before are kept"),
            Left::Beside(at) => {
                let at = at.display();
                format!("the {rows} rows written before are kept in {at}")
            }
        };
        let reason = format!("the table could not be written ({error}); {kept}");
        ObserveError::new(&self.output, reason)
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

    fn event(&mut self, event: &RunEvent) -> Result<(), ObserveError> {
        if matches!(event.kind, RunEventKind::CutShort) {
            self.placed.cut_short();
        }
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
            output: (self.placed.set_aside())
                .map_or_else(|| self.output.clone(), |at| at.display().to_string()),
            frames: self.rows,
            skipped: 0,
            bytes: if is_there { bytes } else { 0 },
            note: if is_there { "" } else { NOTHING_CAME }.to_owned(),
            queue: None,
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use asperity_engine::sim::{LifeEstimate, MaterialPoint, Metrics};

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
