//! Pages of what has been up to a step: fields along y = 0 against time, and the life.

use std::borrow::Cow;

use super::centre_line::PRESSURE;
use super::map::{RowScale, drawn};
use super::sheet::Sheet;
use crate::draw::{Axis, Drawing, Rgb, Side};
use crate::{Look, NodeAxis, Picture, Ranges, Subject};
use asperity_engine::sim::Frame;

/// Fields that have a page over time.
pub(super) const OVER_TIME: [Subject; 5] = [
    Subject::Pressure,
    Subject::Film,
    Subject::Surface1,
    Subject::Surface2,
    Subject::OilRise,
];
/// Most rows that are kept; when there are more every other one goes.
const MOST: usize = 1024;
/// Height of both pages over their width.
const HEIGHT: f64 = 0.6;
/// The band of the life.
pub(super) const BAND: Rgb = [150, 155, 165];

/// What has been so far.
#[derive(Debug, Default)]
pub(super) struct History {
    /// When, s; of which frame's nodes.
    times_s: Vec<f64>,
    nodes: usize,
    /// Rows along y = 0, one after another, of each of [`OVER_TIME`]; and where bodies touch.
    rows: [Vec<f32>; OVER_TIME.len()],
    touches: Vec<u8>,
    /// Time, ms, and log10 of the life with its band.
    lives: Vec<(f64, [f64; 3])>,
    came: usize,
    every: usize,
}

impl History {
    /// Takes up what is shown of a step.
    pub(super) fn follow(&mut self, shown: &Frame) {
        self.every = self.every.max(1);
        let wants = self.came.is_multiple_of(self.every);
        self.came += 1;
        if !wants {
            return;
        }
        self.nodes = shown.nx;
        self.times_s.push(shown.time_s);
        for (rows, subject) in self.rows.iter_mut().zip(OVER_TIME) {
            if let Some(field) = subject.field(shown) {
                rows.extend(shown.centre_line(&field));
            }
        }
        self.touches.extend(shown.centre_line(&shown.contact));
        if let Some(life) = &shown.metrics.life {
            let lives = [
                life.life_relative_low,
                life.life_relative,
                life.life_relative_high,
            ];
            if lives.iter().all(|life| *life > 0.0) {
                self.lives.push((shown.time_s * 1e3, lives.map(f64::log10)));
            }
        }
        if self.times_s.len() > MOST {
            self.halve();
        }
    }

    /// Keeps every other step.
    fn halve(&mut self) {
        let nx = self.nodes.max(1);
        let mut keep = false;
        self.times_s.retain(|_| {
            keep = !keep;
            keep
        });
        for rows in &mut self.rows {
            *rows = every_other(rows, nx);
        }
        self.touches = every_other(&self.touches, nx);
        self.every *= 2;
    }

    /// Draws a field along y = 0 against time; `None`: there is none of it.
    pub(super) fn over_time(
        &self,
        subject: Subject,
        frame: &Frame,
        ranges: &Ranges,
        sheet: &Sheet,
        x_title: &str,
    ) -> Option<Drawing> {
        let at = OVER_TIME.iter().position(|own| *own == subject)?;
        let mut times_s = self.times_s.clone();
        let mut rows = Cow::Borrowed(self.rows[at].as_slice());
        let mut touches = Cow::Borrowed(self.touches.as_slice());
        if times_s.len() == 1 {
            // One step is shown as if it lasted.
            times_s.push(times_s[0] + 1e-9);
            rows = rows.repeat(2).into();
            touches = touches.repeat(2).into();
        }
        let is_whole = self.nodes == frame.nx && rows.len() == times_s.len() * self.nodes;
        let picture = is_whole.then(|| Picture {
            look: Look::of(subject, ranges),
            values: rows,
            x: NodeAxis::Even {
                first_m: frame.x_min_m,
                step_m: frame.dx_m,
                nodes: frame.nx,
            },
            y: NodeAxis::Uneven(&times_s),
            is_below: true,
            contact: if subject == Subject::Film {
                &touches
            } else {
                &[]
            },
            hertz: (frame.kind, [frame.a_m, frame.b_m]),
        })?;
        // Seconds are to milliseconds as metres to millimetres.
        Some(drawn(
            &picture,
            sheet,
            x_title,
            "time, ms",
            HEIGHT,
            RowScale::Even,
        ))
    }

    /// Draws the life with its band; `None`: none is known yet.
    pub(super) fn life(&self, sheet: &Sheet) -> Option<Drawing> {
        let values = || self.lives.iter().flat_map(|(_, lives)| lives);
        let low = values().copied().fold(f64::INFINITY, f64::min);
        let high = values().copied().fold(f64::NEG_INFINITY, f64::max);
        let (first, last) = (self.lives.first()?.0, self.lives.last()?.0);
        let (mut drawing, plot) = sheet.begin(1.0, HEIGHT);
        let x = Axis::linear([first, last.max(first + 1e-6)], "time, ms");
        let room = 0.05 * (high - low).max(0.1);
        let y = Axis::linear([low - room, high + room], "life, log10");
        drawing.grid(plot, &x, &y);
        let width = drawing.unit().curve();
        for (k, colour, wide) in [(0, BAND, 0.7), (2, BAND, 0.7), (1, PRESSURE, 1.4)] {
            let points = self.lives.iter();
            let points = points.map(|(at, lives)| plot.at(x.share(*at), y.share(lives[k])));
            drawing.line(points.collect(), colour, wide * width);
        }
        drawing.frame(plot);
        drawing.axis(plot, Side::Below, &x);
        drawing.axis(plot, Side::Left, &y);
        Some(drawing)
    }
}

fn every_other<T: Copy>(rows: &[T], nx: usize) -> Vec<T> {
    rows.chunks(nx).step_by(2).flatten().copied().collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use asperity_engine::math::number::MM;

    fn frame(step: usize) -> Frame {
        Frame {
            nx: 2,
            ny: 3,
            time_s: step as f64,
            dx_m: 1.0 / MM,
            a_m: 1.0,
            b_m: 1.0,
            pressure_pa: [0.0, 0.0, step as f32, 1.0, 0.0, 0.0].into(),
            film_m: vec![1e-7; 6],
            contact: vec![0, 0, 1, 0, 0, 0],
            ..Frame::default()
        }
    }

    #[test]
    fn rows_are_those_of_the_middle_and_long_runs_keep_every_other() {
        let mut history = History::default();
        for step in 0..3000 {
            history.follow(&frame(step));
        }
        let rows = history.times_s.len();
        assert!((MOST / 2..=MOST).contains(&rows), "{rows}");
        for (k, time_s) in history.times_s.iter().enumerate() {
            assert_eq!(*time_s, (4 * k) as f64);
            assert_eq!(history.rows[0][2 * k..2 * k + 2], [(4 * k) as f32, 1.0]);
        }
        assert_eq!(history.touches.len(), 2 * rows);
        assert!(history.rows[2].is_empty(), "no heat");
        let sheet = Sheet::printed(&super::super::PrintSize::default());
        let ranges = Ranges::default();
        let last = frame(2999);
        let draw = |subject| history.over_time(subject, &last, &ranges, &sheet, "x");
        assert!(draw(Subject::Pressure).is_some() && draw(Subject::Film).is_some());
        assert!(draw(Subject::OilRise).is_none() && draw(Subject::Traction).is_none());
        assert!(history.life(&sheet).is_none(), "no life was known");
        let mut one = History::default();
        one.follow(&last);
        let drawn = one.over_time(Subject::Pressure, &last, &ranges, &sheet, "x");
        assert!(drawn.is_some());
    }
}
