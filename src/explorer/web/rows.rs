//! Every scalar of the last steps of a run, for the table that the page saves.

use std::collections::VecDeque;
use std::sync::{Arc, Mutex, PoisonError};

use asperity_engine::observe::{ObserveError, Observer, ObserverReport, RunContext, RunEvent};
use asperity_engine::sim::{CATALOGUE, Frame, Reading};
use asperity_session::cells::{Cells, csv_line};

/// Steps that are kept; the oldest make room.
const KEPT: usize = 5000;

/// Rows of a table, filled by a run and read by the page.
#[derive(Debug, Default, Clone)]
pub(super) struct KeptRows(Arc<Mutex<RowRing>>);

/// The cells of the last rows, one row after another. All memory is taken at the first: a page's memory never shrinks.
#[derive(Debug, Default)]
struct RowRing(VecDeque<Reading>);

impl RowRing {
    fn push(&mut self, row: impl Iterator<Item = Reading>) {
        let Self(cells) = self;
        cells.reserve_exact(KEPT * CATALOGUE.len() - cells.len());
        if cells.len() == KEPT * CATALOGUE.len() {
            cells.drain(..CATALOGUE.len());
        }
        cells.extend(row);
    }

    /// Rows from the oldest on.
    fn rows(&mut self) -> impl Iterator<Item = &[Reading]> {
        self.0.make_contiguous().chunks_exact(CATALOGUE.len())
    }
}

impl KeptRows {
    /// The table.
    pub(super) fn csv(&self) -> String {
        let mut ring = self.0.lock().unwrap_or_else(PoisonError::into_inner);
        let mut table = csv_line(CATALOGUE.iter().map(|quantity| quantity.name));
        let mut cells = Cells::default();
        for row in ring.rows() {
            cells.clear();
            for reading in row {
                cells.reading(*reading);
            }
            table += &csv_line(cells.iter());
        }
        table
    }
}

impl Observer for KeptRows {
    fn begin(&mut self, _context: &RunContext) -> Result<(), ObserveError> {
        Ok(())
    }

    fn frame(&mut self, frame: &Arc<Frame>) -> Result<(), ObserveError> {
        let mut ring = self.0.lock().unwrap_or_else(PoisonError::into_inner);
        ring.push(CATALOGUE.iter().map(|quantity| quantity.read(frame)));
        Ok(())
    }

    fn event(&mut self, _event: &RunEvent) -> Result<(), ObserveError> {
        Ok(())
    }

    fn finish(&mut self) -> Result<ObserverReport, ObserveError> {
        Ok(ObserverReport::default())
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_last_steps_are_kept_in_order_and_take_no_more_memory() {
        let mut ring = RowRing::default();
        let step = |n: usize| CATALOGUE.iter().map(move |_| Reading::Number(n as f64));
        ring.push(step(0));
        let room = ring.0.capacity();
        assert_eq!(ring.rows().count(), 1);
        (1..KEPT).for_each(|n| ring.push(step(n)));
        for (n, last) in (KEPT..KEPT + 7).enumerate() {
            ring.push(step(last));
            let firsts: Vec<Reading> = ring.rows().map(|row| row[0]).collect();
            let kept = (n + 1..=last).map(|n| Reading::Number(n as f64));
            assert_eq!(firsts, kept.collect::<Vec<_>>());
        }
        assert_eq!(ring.0.capacity(), room);
    }
}
