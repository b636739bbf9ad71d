//! Kymographs: pressure and film along y = 0 from left to right, time downwards. Roughness of body 1 and
//! of body 2 draw stripes of different slopes (their speeds); where they cross, peaks flash
//! and the film has its narrowest places.
//!
//! The picture grows with the run and is written anew a few times while it does (its last state at
//! the end), so its cost stays a small part of the file. A run that goes on beyond its scene's end gets a time axis of
//! twice the length, and every other row, as often as it takes: the picture always shows all of it.

use rerun::components::{ImageBuffer, ImageFormat};
use rerun::{ChannelDatatype, SegmentationImage};

use super::classes;
use super::colour::GREEN;
use super::geometry::Geometry;
use super::picture::{Field, PixelField, log_styled};
use super::plot::{PlotBox, Strips, line, ticks_at};
use super::raster::{Height, RasterEntity};
use super::stream::{Holds, Stream};
use super::view::View;
use asperity_engine::math::number::ticks;
use asperity_engine::scene::Scene;
use asperity_engine::sim::Frame;
use asperity_picture::{Look, Ranges, Scope, Subject};

/// Most rows of the picture; longer runs keep every 2nd, 3rd, … step.
const ROWS: usize = 512;
/// Part of the recording's budget for the picture as it grows; its last state comes at the end.
const ON_THE_WAY: f64 = 0.05;

/// Height of the picture over its width.
const HEIGHT: f64 = 0.6;

/// What the scene lets expect of a run.
pub(crate) struct ExpectedRun {
    pub(crate) steps: f64,
    pub(crate) step_s: f64,
    /// Of the recording.
    pub(crate) budget_bytes: f64,
}

/// One kymograph.
pub(crate) struct KymographEntity {
    entity: &'static str,
    subject: Subject,
    look: Look,
    geometry: Geometry,
    raster: RasterEntity,
    plot: PlotBox,
    values: Vec<f32>,
    /// Where bodies touch; empty where that is not marked.
    touches: Vec<u8>,
    row_bytes: usize,
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

impl KymographEntity {
    /// Sets up the picture for so many steps.
    pub(crate) fn new(
        stream: &Stream,
        geometry: Geometry,
        entity: &'static str,
        subject: Subject,
        ranges: &Ranges,
        run: &ExpectedRun,
    ) -> Self {
        let steps = run.steps.clamp(1.0, 1e6).ceil() as usize;
        let every = steps.div_ceil(ROWS).max(1);
        let rows = steps.div_ceil(every).max(2);
        let x = [geometry.x_min, geometry.x_max()];
        let height = HEIGHT * (x[1] - x[0]);
        let row_height = height / rows as f64;
        let plot = PlotBox {
            x,
            y: [0.0, height],
            x_ticks: ticks_at(&ticks(x[0], x[1], 5), |x| x),
            x_title: "x, mm".into(),
            titles: vec![(0.1, "time, ms".into(), None)],
            ..PlotBox::default()
        };
        let pixels = PixelField {
            columns: geometry.nx,
            rows,
            first: [geometry.x_min, 0.5 * row_height],
            size: [geometry.dx, row_height],
        };
        let look = Look::of(subject, ranges);
        let touches = if look.marks_contact {
            let place = over_of(entity);
            log_styled(stream, &place, &classes::styled(), &pixels);
            stream.log_static(place, &classes::context());
            vec![0; geometry.nx * rows]
        } else {
            Vec::new()
        };
        let now = line(GREEN, 1.5).with_draw_order(28.0);
        stream.log_static(format!("{entity}/now"), &now);
        // Two of a value, one of what lies over it.
        let row_bytes = (2 + usize::from(look.marks_contact)) * geometry.nx;
        Self {
            entity,
            subject,
            look,
            row_bytes,
            geometry,
            raster: RasterEntity::new(stream, entity, look, pixels, &plot, Height::Growing),
            touches,
            plot,
            values: vec![0.0; geometry.nx * rows],
            rows: 0,
            rows_logged: 0,
            most_rows: rows,
            every: every as u64,
            axes_for: 0,
            step_s: run.step_s,
            first_step: None,
            spare_rows: (ON_THE_WAY * run.budget_bytes / row_bytes as f64) as usize,
        }
    }

    /// Bytes of the picture when it is full.
    pub(crate) fn full_bytes(&self) -> usize {
        self.row_bytes * self.most_rows
    }

    pub(crate) fn plot(&self) -> &PlotBox {
        &self.plot
    }

    /// Keeps every other row, of twice as many steps.
    fn halve(&mut self) {
        let nx = self.geometry.nx;
        let kept = self.rows.div_ceil(2);
        for row in 1..kept {
            let from = 2 * row * nx..(2 * row + 1) * nx;
            if !self.touches.is_empty() {
                self.touches.copy_within(from.clone(), row * nx);
            }
            self.values.copy_within(from, row * nx);
        }
        (self.rows, self.rows_logged) = (kept, 0);
        self.every = self.every.saturating_mul(2);
    }

    /// Logs the picture when an eighth has been added.
    fn log_if_due(&mut self, stream: &Stream) {
        let due = self.rows_logged == 0
            || self.rows >= self.rows_logged + self.most_rows.div_ceil(8)
            || (self.rows == self.most_rows && self.rows > self.rows_logged);
        if due && self.rows <= self.spare_rows {
            self.spare_rows -= self.rows;
            self.log_picture(stream);
        }
    }

    /// Logs the line at a step, on the axis that was drawn last.
    fn log_now(&self, stream: &Stream, step: u64) {
        let steps = step.saturating_sub(self.first_step.unwrap_or(step)) + 1;
        let all = self.most_rows as f64 * self.axes_for.max(1) as f64;
        let [x, y] = [self.plot.x, self.plot.y].map(|ends| ends.map(|end| end as f32));
        let at = y[1] * (steps as f64 / all).min(1.0) as f32;
        let mut strip = Strips::default();
        strip.to([x[0], at]);
        strip.to([x[1], at]);
        strip.log(stream, &format!("{}/now", self.entity));
    }

    /// Logs the picture as it is now.
    fn log_picture(&mut self, stream: &Stream) {
        if self.rows == self.rows_logged {
            return;
        }
        if self.axes_for != self.every {
            self.axes_for = self.every;
            let span_ms = self.step_s * 1e3 * self.most_rows as f64 * self.every as f64;
            let height = self.plot.y[1];
            self.plot.left_ticks = ticks_at(&ticks(0.0, span_ms, 5), |t| height * t / span_ms);
            let axes = format!("{}/axes", self.entity);
            self.plot.log(stream, &axes, Holds::FromNow);
        }
        self.rows_logged = self.rows;
        let nodes = self.rows * self.geometry.nx;
        if !self.touches.is_empty() {
            self.log_over(stream, nodes);
        }
        let upper = Field::TopDown(&self.values[..nodes]);
        self.raster.log(stream, upper);
    }

    /// Contact and what is above the range, in the colours that they have in the map.
    fn log_over(&self, stream: &Stream, nodes: usize) {
        let mut over = vec![0; nodes];
        classes::of_row(&self.look, &self.touches, &self.values, &mut over);
        let resolution = [self.geometry.nx as u32, self.rows as u32];
        let image = SegmentationImage::update_fields()
            .with_buffer(ImageBuffer::from(over))
            .with_format(ImageFormat::segmentation(resolution, ChannelDatatype::U8));
        stream.log(&over_of(self.entity), &image);
    }
}

impl View for KymographEntity {
    fn widen(&mut self, stream: &Stream, _scene: Option<&Scene>, scope: &Scope) {
        self.look = Look::of(self.subject, &scope.ranges);
        self.raster.widen(stream, self.look);
    }

    /// Takes up a step. Rows of steps that were not handed to the recording repeat the next one
    /// that was.
    fn follow_fields(&mut self, frame: &Frame) {
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
        let Some(field) = self.subject.field(frame) else {
            return;
        };
        let new = self.rows * nx..rows * nx;
        for row in self.values[new.clone()].chunks_exact_mut(nx) {
            row.copy_from_slice(&field[from..from + nx]);
        }
        for row in self
            .touches
            .get_mut(new)
            .into_iter()
            .flat_map(|rows| rows.chunks_exact_mut(nx))
        {
            row.copy_from_slice(&frame.contact[from..from + nx]);
        }
        self.rows = rows;
    }

    /// The picture where it is due, and the line at now.
    fn log(&mut self, stream: &Stream, frame: &Frame) {
        self.log_if_due(stream);
        self.log_now(stream, frame.step);
    }

    fn finish(&mut self, stream: &Stream) {
        self.log_picture(stream);
    }
}

/// What lies over the picture of that entity.
fn over_of(entity: &str) -> String {
    format!("{entity}/over")
}
