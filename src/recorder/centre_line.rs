//! The classic figure of lubrication: pressure and film along y = 0, Hertz's pressure behind them.

use rerun::{LineStrips2D, Radius};

use super::colour::{GREY, ORANGE, SKY, faded};
use super::gathered::LineStyle;
use super::geometry::Geometry;
use super::plot::{PlotBox, points, ticks_at};
use super::stream::{Holds, Stream};
use super::waiting::Curves;
use asperity_engine::math::number::{GPA, MM, UM, divisions, ticks};
use asperity_engine::observe::ObserveError;
use asperity_engine::sim::Frame;

pub(super) const CENTRE_LINE: &str = "centre_line_y0";

/// The figure.
pub(super) struct CentreLine {
    geometry: Geometry,
    plot: PlotBox,
    pressure_top_pa: f64,
    film_top_m: f64,
    hertz: Option<[f64; 2]>,
    pressure: Curves,
    film: Curves,
}

impl CentreLine {
    /// Sets up the axes for the ranges of the maps.
    pub(super) fn new(
        stream: &Stream,
        geometry: Geometry,
        pressure_top_pa: f64,
        film_top_m: f64,
    ) -> Result<Self, ObserveError> {
        let x = [geometry.x_min, geometry.x_max()];
        let height = 0.72 * (x[1] - x[0]);
        let plot = PlotBox {
            x,
            y: [-height, 0.0],
            x_ticks: ticks_at(&ticks(x[0], x[1], 5), |x| x),
            x_title: "x, mm   (grey: Hertz)".into(),
            titles: vec![(0.1, "p, GPa".into(), ORANGE), (0.9, "h, µm".into(), SKY)],
            left_colour: Some(ORANGE),
            right_colour: Some(SKY),
            ..PlotBox::default()
        };
        let curves = |name: &str, colour| {
            let entity = format!("{CENTRE_LINE}/{name}");
            stream.log_static(entity.as_str(), &line(colour, 1.5))?;
            Ok(stream.curves(entity))
        };
        let mut this = Self {
            geometry,
            plot,
            pressure_top_pa,
            film_top_m,
            hertz: None,
            pressure: curves("pressure_GPa", ORANGE)?,
            film: curves("film_um", SKY)?,
        };
        this.reach(stream, pressure_top_pa, film_top_m)?;
        Ok(this)
    }

    /// Draws the axes up to these tops from now on.
    pub(super) fn reach(
        &mut self,
        stream: &Stream,
        pressure_top_pa: f64,
        film_top_m: f64,
    ) -> Result<(), ObserveError> {
        let height = -self.plot.y[0];
        let up = |top: f64| move |value: f64| -height * value / top;
        let (p_top, h_top) = (GPA.of(pressure_top_pa), UM.of(film_top_m));
        self.plot.left_ticks = ticks_at(&divisions(p_top), up(p_top));
        self.plot.right_ticks = ticks_at(&divisions(h_top), up(h_top));
        (self.pressure_top_pa, self.film_top_m) = (pressure_top_pa, film_top_m);
        // Hertz's curve is drawn to the same axes.
        self.hertz = None;
        let axes = format!("{CENTRE_LINE}/axes");
        self.plot.log_that(stream, &axes, Holds::FromNow)
    }

    pub(super) fn plot(&self) -> &PlotBox {
        &self.plot
    }

    /// Logs one frame's curves.
    pub(super) fn log(&mut self, stream: &Stream, frame: &Frame) -> Result<(), ObserveError> {
        let g = self.geometry;
        let row = g.centre_row() * g.nx..(g.centre_row() + 1) * g.nx;
        self.log_hertz(stream, frame)?;
        let pressure = &frame.pressure_pa[row.clone()];
        stream.log_curves(self.pressure, |pen| {
            self.draw(pressure, self.pressure_top_pa, pen);
        })?;
        let film = &frame.film_m[row];
        stream.log_curves(self.film, |pen| self.draw(film, self.film_top_m, pen))
    }

    /// Hertz's ellipse, logged when the load has changed.
    fn log_hertz(&mut self, stream: &Stream, frame: &Frame) -> Result<(), ObserveError> {
        let now = [frame.a_m, frame.p_hertz_pa];
        if self.hertz == Some(now) {
            return Ok(());
        }
        self.hertz = Some(now);
        let a = frame.a_m * MM;
        let strip: Vec<[f64; 2]> = (0..=128)
            .map(|k| -1.0 + f64::from(k) / 64.0)
            .map(|t| [t * a, frame.p_hertz_pa * (1.0 - t * t).max(0.0).sqrt()])
            .map(|[x, p]| [x, self.plot.y[0] * p / self.pressure_top_pa])
            .collect();
        let hertz = line(GREY, 1.0).with_strips([points(&strip)]);
        stream.log(&format!("{CENTRE_LINE}/hertz_pressure_GPa"), &hertz)
    }

    /// The parts of a curve that lie inside the axes; what is above them is left out, not bent.
    fn draw(&self, values: &[f32], top: f64, pen: &mut LineStyle) {
        let height = self.plot.y[0];
        for (i, &value) in values.iter().enumerate() {
            let share = f64::from(value) / top;
            if share <= 1.0 {
                pen.to([self.geometry.x(i) as f32, (height * share) as f32]);
            } else {
                pen.lift();
            }
        }
    }
}

/// How a curve looks: its colour and how many points wide it is.
pub(super) fn line(colour: [u8; 3], radius: f32) -> LineStrips2D {
    LineStrips2D::update_fields()
        .with_colors([faded(colour, 255)])
        .with_radii([Radius::new_ui_points(radius)])
        .with_draw_order(12.0)
}
