//! Every scalar of the last steps of a run, for the table that the page saves.

use std::collections::VecDeque;
use std::sync::{Arc, Mutex, PoisonError};

use crate::observe::cells::{Cells, csv_line};
use crate::observe::{ObserveError, Observer, ObserverReport, RunContext, RunEvent};
use crate::sim::{CATALOGUE, Frame};

/// Steps that are kept; the oldest make room.
const KEPT: usize = 5000;

/// KeptRows of a table, filled by a run and read by the page.
#[derive(Debug, Default, Clone)]
pub(super) struct KeptRows(Arc<Mutex<VecDeque<String>>>);

impl KeptRows {
    /// The table.
    pub(super) fn csv(&self) -> String {
        let head = csv_line(CATALOGUE.iter().map(|quantity| quantity.name));
        let rows = self.0.lock().unwrap_or_else(PoisonError::into_inner);
        rows.iter().fold(head, |table, row| table + row)
    }
}

impl Observer for KeptRows {
    fn begin(&mut self, _context: &RunContext) -> Result<(), ObserveError> {
        Ok(())
    }

    fn frame(&mut self, frame: &Arc<Frame>) -> Result<(), ObserveError> {
        let mut cells = Cells::default();
        for quantity in CATALOGUE {
            cells.reading(quantity.read(frame));
        }
        let mut rows = self.0.lock().unwrap_or_else(PoisonError::into_inner);
        if rows.len() == KEPT {
            rows.pop_front();
        }
        rows.push_back(csv_line(cells.iter()));
        Ok(())
    }

    fn event(&mut self, _event: &RunEvent) -> Result<(), ObserveError> {
        Ok(())
    }

    fn finish(&mut self) -> Result<ObserverReport, ObserveError> {
        Ok(ObserverReport::default())
    }
}
