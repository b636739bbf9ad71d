//! Pressure and film along y = 0 over time: stripes whose slopes are the speeds of both bodies' waves.
//!
//! The run's rows are those of the frames that the screen took, each over the way until the next: where the run
//! is much faster than the screen the stripes are coarse. Of a passage that repeats every step is there.

use std::collections::VecDeque;

use crate::tui::replay::Replay;
use asperity_engine::sim::{Frame, Stage};
use asperity_picture::Subject;

/// The way that is shown, in passages of 4 a: few enough waves for a picture of twenty rows.
pub(crate) const SHOWN: f64 = 0.5;
/// Maximum number of rows.
const ROWS: usize = 512;

#[derive(Debug, Clone)]
struct KymographRow {
    passages: f64,
    pressure: Vec<f32>,
    film: Vec<f32>,
    contact: Vec<u8>,
}

/// Rows of a run, the newest last.
#[derive(Debug, Clone, Default)]
pub(crate) struct Kymograph {
    rows: VecDeque<KymographRow>,
}

/// Values along y = 0, SI, and where there is asperity contact.
pub(crate) type CentreValues<'a> = (&'a [f32], &'a [u8]);

impl Kymograph {
    /// Takes a frame of the passage.
    pub(crate) fn push(&mut self, frame: &Frame) {
        let newest = self.rows.back().map_or(f64::MIN, |row| row.passages);
        if frame.stage != Stage::Passage || frame.passages <= newest {
            return;
        }
        if self.rows.len() == ROWS {
            self.rows.pop_front();
        }
        self.rows.push_back(KymographRow {
            passages: frame.passages,
            pressure: frame.centre_line(&frame.pressure_pa).to_vec(),
            film: frame.centre_line(&frame.film_m).to_vec(),
            contact: frame.centre_line(&frame.contact).to_vec(),
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
    /// Pressure or film of the centre line so many passages before the frame; `None`: before the first, or nothing else is kept.
    pub(crate) fn line(&self, subject: Subject, ago: f64) -> Option<CentreValues<'_>> {
        let is_film = match subject {
            Subject::Pressure => false,
            Subject::Film => true,
            Subject::Interferogram
            | Subject::Contact
            | Subject::Traction
            | Subject::Surface1
            | Subject::Surface2
            | Subject::OilRise
            | Subject::Roughness1
            | Subject::Roughness2
            | Subject::RoughnessOfBoth
            | Subject::EffectiveStress
            | Subject::ShearStress => return None,
        };
        match self {
            Self::Run { kept, passages } => {
                let row = kept.row(passages - ago)?;
                let values = if is_film { &row.film } else { &row.pressure };
                Some((values, &row.contact))
            }
            Self::Orbit(replay) => {
                let frame = replay.before(ago);
                let values = if is_film {
                    &frame.film_m
                } else {
                    &frame.pressure_pa
                };
                Some((frame.centre_line(values), frame.centre_line(&frame.contact)))
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
            contact: vec![0; 2],
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
            span.line(Subject::Pressure, ago)
                .map(|(line, _)| f64::from(line[0]))
        };
        assert_eq!(at(0.0), Some(newest));
        assert_eq!(at(0.5), Some(newest - 1.0));
        assert_eq!(at(ROWS as f64 - 1.0), Some(ROWS as f64));
        assert_eq!(at(ROWS as f64), None);
        let film = span
            .line(Subject::Film, 1.0)
            .map(|(line, _)| f64::from(line[1]));
        assert_eq!(film, Some(1.0 - newest));
    }
}
