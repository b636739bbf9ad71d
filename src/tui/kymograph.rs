//! Pressure and film along y = 0 over time: stripes whose slopes are the speeds of both bodies' waves.
//!
//! The run's rows are those of the frames that the screen took, each over the way until the next: where the run
//! is much faster than the screen the stripes are coarse. Of a passage that repeats every step is there.

use std::collections::VecDeque;

use crate::sim::{Frame, Stage};
use crate::tui::replay::Replay;

/// The way that is shown, in passages of 4 a: few enough waves for a picture of twenty rows.
pub(crate) const SHOWN: f64 = 0.5;
/// Rows kept at most.
const ROWS: usize = 512;

#[derive(Debug, Clone)]
struct KymographRow {
    passages: f64,
    pressure: Vec<f32>,
    film: Vec<f32>,
}

/// Rows of a run, the newest last.
#[derive(Debug, Clone, Default)]
pub(crate) struct Kymograph {
    rows: VecDeque<KymographRow>,
}

/// Which field.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Field {
    Pressure,
    Film,
}

/// The nodes of y = 0.
fn middle(field: &[f32], frame: &Frame) -> Option<Vec<f32>> {
    let start = frame.ny / 2 * frame.nx;
    field.get(start..start + frame.nx).map(<[f32]>::to_vec)
}

impl Kymograph {
    /// Takes a frame of the passage.
    pub(crate) fn push(&mut self, frame: &Frame) {
        let newest = self.rows.back().map_or(f64::MIN, |row| row.passages);
        let (Some(pressure), Some(film)) = (
            middle(&frame.pressure_pa, frame),
            middle(&frame.film_m, frame),
        ) else {
            return;
        };
        if frame.stage != Stage::Passage || frame.passages <= newest {
            return;
        }
        if self.rows.len() == ROWS {
            self.rows.pop_front();
        }
        self.rows.push_back(KymographRow {
            passages: frame.passages,
            pressure,
            film,
        });
    }

    fn row(&self, passages: f64) -> Option<&KymographRow> {
        let after = self.rows.partition_point(|row| row.passages <= passages);
        self.rows.get(after.checked_sub(1)?)
    }
}

/// The way that led to a frame.
pub(crate) enum Span<'a> {
    /// Of the run.
    Run {
        /// Its rows.
        kept: &'a Kymograph,
        /// Where the frame is.
        passages: f64,
    },
    /// Of a replay.
    Orbit(&'a Replay),
}

impl Span<'_> {
    /// The centre line so many passages before the frame; `None`: before the first.
    pub(crate) fn line(&self, field: Field, ago: f64) -> Option<&[f32]> {
        match self {
            Self::Run { kept, passages } => {
                let row = kept.row(passages - ago)?;
                Some(match field {
                    Field::Pressure => &row.pressure,
                    Field::Film => &row.film,
                })
            }
            Self::Orbit(replay) => {
                let frame = replay.before(ago);
                let values = match field {
                    Field::Pressure => &frame.pressure_pa,
                    Field::Film => &frame.film_m,
                };
                let start = frame.ny / 2 * frame.nx;
                values.get(start..start + frame.nx)
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn frame(passages: f64) -> Frame {
        Frame {
            stage: Stage::Passage,
            passages,
            nx: 2,
            ny: 1,
            pressure_pa: vec![passages as f32; 2],
            film_m: vec![-passages as f32; 2],
            ..Frame::default()
        }
    }

    #[test]
    fn a_row_holds_until_the_next_and_old_ones_go() {
        let mut kept = Kymograph::default();
        for step in 0..2 * ROWS {
            kept.push(&frame(step as f64));
            // The same frame again, and one of the start-up, are no rows.
            kept.push(&frame(step as f64));
            kept.push(&Frame::default());
        }
        let newest = (2 * ROWS - 1) as f64;
        let span = Span::Run {
            kept: &kept,
            passages: newest,
        };
        let at = |ago: f64| {
            span.line(Field::Pressure, ago)
                .map(|line| f64::from(line[0]))
        };
        assert_eq!(at(0.0), Some(newest));
        assert_eq!(at(0.5), Some(newest - 1.0));
        assert_eq!(at(ROWS as f64 - 1.0), Some(ROWS as f64));
        assert_eq!(at(ROWS as f64), None);
        let film = span.line(Field::Film, 1.0).map(|line| f64::from(line[1]));
        assert_eq!(film, Some(1.0 - newest));
    }
}
