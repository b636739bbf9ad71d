//! The classic figure of lubrication: pressure and film along y = 0, Hertz's pressure behind them.

use super::colour::{GREY, ORANGE, SKY};
use super::entities::centre_line::{CENTRE_LINE, FILM, HERTZ, PRESSURE};
use super::geometry::Geometry;
use super::plot::{PlotBox, Strips, line, points, ticks_at};
use super::stream::{Holds, Stream};
use super::view::View;
use asperity_engine::math::number::{GPA, MM, UM, divisions, ticks};
use asperity_engine::scene::Scene;
use asperity_engine::sim::Frame;
use asperity_picture::{Ranges, Scope};

/// The figure.
pub(crate) struct CentreLine {
    geometry: Geometry,
    plot: PlotBox,
    pressure_top_pa: f64,
    film_top_m: f64,
    /// Half-width and pressure of the Hertz curve that was logged last.
    hertz: Option<[f64; 2]>,
}

impl CentreLine {
    /// Sets up the axes for the ranges of the maps.
    pub(crate) fn new(stream: &Stream, geometry: Geometry, ranges: &Ranges) -> Self {
        let x = [geometry.x_min, geometry.x_max()];
        let height = 0.72 * (x[1] - x[0]);
        let plot = PlotBox {
            x,
            y: [-height, 0.0],
            x_ticks: ticks_at(&ticks(x[0], x[1], 5), |x| x),
            x_title: "x, mm   (grey: Hertz)".into(),
            titles: vec![(0.1, "p, GPa".into(), None), (0.9, "h, µm".into(), None)],
            left_colour: Some(ORANGE),
            right_colour: Some(SKY),
            ..PlotBox::default()
        };
        stream.log_static(PRESSURE, &line(ORANGE, 1.5));
        stream.log_static(FILM, &line(SKY, 1.5));
        let mut this = Self {
            geometry,
            plot,
            pressure_top_pa: 0.0,
            film_top_m: 0.0,
            hertz: None,
        };
        this.draw_axes(stream, ranges);
        this
    }

    /// Draws the axes up to these tops from now on.
    fn draw_axes(&mut self, stream: &Stream, ranges: &Ranges) {
        let height = -self.plot.y[0];
        let up = |top: f64| move |value: f64| -height * value / top;
        let (p_top, h_top) = (GPA.of(ranges.pressure_pa), UM.of(ranges.film_m));
        self.plot.left_ticks = ticks_at(&divisions(p_top), up(p_top));
        self.plot.right_ticks = ticks_at(&divisions(h_top), up(h_top));
        (self.pressure_top_pa, self.film_top_m) = (ranges.pressure_pa, ranges.film_m);
        // Hertz's curve is drawn to the same axes.
        self.hertz = None;
        let axes = format!("{CENTRE_LINE}/axes");
        self.plot.log(stream, &axes, Holds::FromNow);
    }

    pub(crate) fn plot(&self) -> &PlotBox {
        &self.plot
    }

    /// Hertz's ellipse, logged when the load has changed.
    fn log_hertz(&mut self, stream: &Stream, frame: &Frame) {
        let now = [frame.a_m, frame.p_hertz_pa];
        if self.hertz == Some(now) {
            return;
        }
        self.hertz = Some(now);
        let a = frame.a_m * MM;
        let strip: Vec<[f64; 2]> = (0..=128)
            .map(|k| -1.0 + f64::from(k) / 64.0)
            .map(|t| [t * a, frame.p_hertz_pa * (1.0 - t * t).max(0.0).sqrt()])
            .map(|[x, p]| [x, self.plot.y[0] * p / self.pressure_top_pa])
            .collect();
        let hertz = line(GREY, 1.0).with_strips([points(&strip)]);
        stream.log_for(Holds::FromNow, HERTZ, &hertz);
    }

    /// The parts of a curve that lie inside the axes; what is above them is left out, not bent.
    fn draw(&self, values: &[f32], top: f64) -> Strips {
        let height = self.plot.y[0];
        let mut strips = Strips::default();
        for (i, &value) in values.iter().enumerate() {
            let share = f64::from(value) / top;
            if share <= 1.0 {
                strips.to([self.geometry.x(i) as f32, (height * share) as f32]);
            } else {
                strips.lift();
            }
        }
        strips
    }
}

impl View for CentreLine {
    fn widen(&mut self, stream: &Stream, _scene: Option<&Scene>, scope: &Scope) {
        self.draw_axes(stream, &scope.ranges);
    }

    fn log(&mut self, stream: &Stream, frame: &Frame) {
        let g = self.geometry;
        let row = g.centre_row() * g.nx..(g.centre_row() + 1) * g.nx;
        self.log_hertz(stream, frame);
        let pressure = self.draw(&frame.pressure_pa[row.clone()], self.pressure_top_pa);
        pressure.log(stream, PRESSURE);
        let film = self.draw(&frame.film_m[row], self.film_top_m);
        film.log(stream, FILM);
    }
}
