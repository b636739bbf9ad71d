//! Kymographs: pressure and film along y = 0 from left to right, time downwards. Roughness of body 1 and
//! of body 2 draw stripes of different slopes (their speeds); where they cross, peaks flash
//! and the film has its narrowest places.
//!
//! The picture grows with the run and is written anew a few times while it does (its last state at
//! the end), so its cost stays a small part of the file. A run that goes on beyond its scene's end gets a time axis of
//! twice the length, and every other row, as often as it takes: the picture always shows all of it.

use rerun::components::Colormap;

use super::colour::WHITE;
use super::geometry::Geometry;
use super::picture::{Pixels, Scale, Sign};
use super::plot::{PlotBox, ticks_at};
use super::raster::{Height, Raster};
use super::stream::{Holds, Stream};
use crate::observe::ObserveError;
use crate::observe::scales::{GPA, UM, ticks};
use crate::sim::Frame;

pub(super) const PRESSURE: &str = "kymograph/pressure_y0_GPa";
pub(super) const FILM: &str = "kymograph/film_y0_um";
/// Most rows of the picture; longer runs keep every 2nd, 3rd, … step.
const ROWS: usize = 512;
/// Part of the recording's budget for the picture as it grows; its last state comes at the end.
const ON_THE_WAY: f64 = 0.05;

/// What a kymograph shows.
#[derive(Debug, Clone, Copy)]
pub(super) enum Shown {
    /// Pressure up to a top, Pa.
    Pressure { top_pa: f64 },
    /// Film up to a top, m.
    Film { top_m: f64 },
}

impl Shown {
    fn entity(self) -> &'static str {
        match self {
            Self::Pressure { .. } => PRESSURE,
            Self::Film { .. } => FILM,
        }
    }

    fn title(self) -> &'static str {
        match self {
            Self::Pressure { .. } => "p, GPa",
            Self::Film { .. } => "h, µm",
        }
    }

    /// The same tops and colours as the maps.
    fn scale(self) -> Scale {
        match self {
            Self::Pressure { top_pa } => {
                let top = top_pa * 0.999;
                Scale::up_to(top, GPA, Sign::Positive, Colormap::Inferno)
            }
            Self::Film { top_m } => {
                let top = top_m * 0.999;
                Scale::up_to(top, UM, Sign::Positive, Colormap::Viridis)
            }
        }
    }

    fn field(self, frame: &Frame) -> &[f32] {
        match self {
            Self::Pressure { .. } => &frame.pressure_pa,
            Self::Film { .. } => &frame.film_m,
        }
    }
}

/// One kymograph.
pub(super) struct Kymograph {
    shown: Shown,
    geometry: Geometry,
    raster: Raster,
    plot: PlotBox,
    values: Vec<f32>,
    rows: usize,
    rows_logged: usize,
    most_rows: usize,
    /// Steps of a row, and those that the axes were logged for.
    every: u64,
    axes_for: u64,
    step_s: f64,
    first_step: Option<u64>,
    /// Rows that may still be written before the end.
    spare_rows: usize,
}

impl Kymograph {
    /// Sets up the picture for so many steps.
    pub(super) fn new(
        stream: &Stream,
        geometry: Geometry,
        shown: Shown,
        expected_steps: f64,
        step_s: f64,
        budget_bytes: f64,
    ) -> Result<Self, ObserveError> {
        let steps = expected_steps.clamp(1.0, 1e6).ceil() as usize;
        let every = steps.div_ceil(ROWS).max(1);
        let rows = steps.div_ceil(every).max(2);
        let x = [geometry.x_min, geometry.x_max()];
        let height = 0.9 * (x[1] - x[0]);
        let row_height = height / rows as f64;
        let plot = PlotBox {
            x,
            y: [0.0, height],
            x_ticks: ticks_at(&ticks(x[0], x[1], 5), |x| x),
            x_title: "x, mm".into(),
            titles: vec![(0.1, "time, ms".into(), WHITE)],
            ..PlotBox::default()
        };
        let pixels = Pixels {
            columns: geometry.nx,
            rows,
            first: [geometry.x_min, 0.5 * row_height],
            size: [geometry.dx, row_height],
        };
        let title = (shown.title(), Height::Growing);
        Ok(Self {
            shown,
            geometry,
            raster: Raster::new(stream, shown.entity(), shown.scale(), pixels, &plot, title)?,
            plot,
            values: vec![0.0; geometry.nx * rows],
            rows: 0,
            rows_logged: 0,
            most_rows: rows,
            every: every as u64,
            axes_for: 0,
            step_s,
            first_step: None,
            spare_rows: (ON_THE_WAY * budget_bytes / (2 * geometry.nx) as f64) as usize,
        })
    }

    /// Colours up to the top of `shown` from now on, as in the maps.
    pub(super) fn reach(&mut self, stream: &Stream, shown: Shown) -> Result<(), ObserveError> {
        self.shown = shown;
        let top_si = shown.scale().top / shown.scale().per_si;
        self.raster.reach(stream, 0.999 * top_si).map(drop)
    }

    /// Bytes of the picture when it is full.
    pub(super) fn full_bytes(&self) -> usize {
        2 * self.geometry.nx * self.most_rows
    }

    pub(super) fn plot(&self) -> &PlotBox {
        &self.plot
    }

    /// Takes up a step. Rows of steps that were not handed to the recording repeat the next one
    /// that was.
    pub(super) fn follow(&mut self, frame: &Frame) {
        let first = *self.first_step.get_or_insert(frame.step);
        let steps = frame.step.saturating_sub(first);
        while steps / self.every >= self.most_rows as u64 {
            self.halve();
        }
        let rows = (steps / self.every) as usize + 1;
        if rows <= self.rows {
            return;
        }
        let nx = self.geometry.nx;
        let from = self.geometry.centre_row() * nx;
        let values = &self.shown.field(frame)[from..from + nx];
        for row in self.values[self.rows * nx..rows * nx].chunks_exact_mut(nx) {
            row.copy_from_slice(values);
        }
        self.rows = rows;
    }

    /// Keeps every other row, of twice as many steps.
    fn halve(&mut self) {
        let nx = self.geometry.nx;
        let kept = self.rows.div_ceil(2);
        for row in 1..kept {
            self.values
                .copy_within(2 * row * nx..(2 * row + 1) * nx, row * nx);
        }
        (self.rows, self.rows_logged) = (kept, 0);
        self.every = self.every.saturating_mul(2);
    }

    /// Logs the picture when an eighth has been added.
    pub(super) fn log_if_due(&mut self, stream: &Stream) -> Result<(), ObserveError> {
        let due = self.rows_logged == 0
            || self.rows >= self.rows_logged + self.most_rows.div_ceil(8)
            || (self.rows == self.most_rows && self.rows > self.rows_logged);
        if due && self.rows <= self.spare_rows {
            self.spare_rows -= self.rows;
            self.log(stream)
        } else {
            Ok(())
        }
    }

    /// Logs the picture as it is now.
    pub(super) fn log(&mut self, stream: &Stream) -> Result<(), ObserveError> {
        if self.rows == self.rows_logged {
            return Ok(());
        }
        if self.axes_for != self.every {
            self.axes_for = self.every;
            let span_ms = self.step_s * 1e3 * self.most_rows as f64 * self.every as f64;
            let height = self.plot.y[1];
            self.plot.left_ticks = ticks_at(&ticks(0.0, span_ms, 5), |t| height * t / span_ms);
            let axes = format!("{}/axes", self.shown.entity());
            self.plot.log_that(stream, &axes, Holds::FromNow)?;
        }
        self.rows_logged = self.rows;
        let values = &self.values[..self.rows * self.geometry.nx];
        self.raster.log_upper(stream, values)
    }
}
