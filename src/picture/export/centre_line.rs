//! The classic figure: pressure with Hertz's behind it, and the film, along y = 0.

use super::map::HERTZ;
use super::sheet::Sheet;
use crate::Ranges;
use crate::draw::{Axis, Drawing, Rect, Rgb, Side, Text, text_width};
use asperity_engine::math::number::{GPA, MM, UM, Unit};
use asperity_engine::sim::Frame;

pub(super) const PRESSURE: Rgb = [213, 94, 0];
pub(super) const FILM: Rgb = [0, 114, 178];

/// A curve of the figure, in the units of its axis.
struct CentreCurve {
    name: &'static str,
    colour: Rgb,
    points: Vec<(f64, f64)>,
}

/// Draws it.
pub(super) fn centre_line(frame: &Frame, ranges: &Ranges, sheet: &Sheet, x_title: &str) -> Drawing {
    let (mut drawing, plot) = sheet.begin(4.8, 0.62);
    let nodes = [0, frame.nx - 1].map(|i| x_mm(frame, i));
    let x = Axis::linear(nodes, x_title);
    let left = Axis::linear([0.0, GPA.of(ranges.pressure_pa)], "pressure, GPa");
    let right = Axis::linear([0.0, UM.of(ranges.film_m)], "film, µm");
    let hertz = CentreCurve {
        name: "Hertz pressure",
        colour: HERTZ,
        points: hertz(frame),
    };
    let pressure = CentreCurve {
        name: "pressure",
        colour: PRESSURE,
        points: along(frame, &frame.pressure_pa, GPA),
    };
    let film = CentreCurve {
        name: "film (right axis)",
        colour: FILM,
        points: along(frame, &frame.film_m, UM),
    };
    drawing.grid(plot, &x, &left);
    let mut name_at = plot.left;
    for (curve, y) in [(&hertz, &left), (&pressure, &left), (&film, &right)] {
        draw_curve(&mut drawing, plot, curve, &x, y);
        let em = drawing.font();
        let at = [name_at, plot.top - 0.6 * em];
        drawing.text(Text::new(at, curve.name).coloured(curve.colour));
        name_at += (text_width(curve.name) + 1.5) * em;
    }
    drawing.frame(plot);
    drawing.axis(plot, Side::Below, &x);
    drawing.axis(plot, Side::Left, &left.coloured(PRESSURE));
    drawing.axis(plot, Side::Right, &right.coloured(FILM));
    drawing
}

/// What of a curve is above the axis is left out, not bent.
fn draw_curve(drawing: &mut Drawing, plot: Rect, curve: &CentreCurve, x: &Axis, y: &Axis) {
    let width = drawing.unit().curve();
    for part in inside(&curve.points, y.ends[1]) {
        let points = part.iter();
        let points = points.map(|(at, value)| plot.at(x.share(*at), y.share(*value)));
        drawing.line(points.collect(), curve.colour, width);
    }
}

/// The parts of a curve below the top.
fn inside(points: &[(f64, f64)], top: f64) -> impl Iterator<Item = &[(f64, f64)]> {
    let parts = points.split(move |(_, value)| *value > top);
    parts.filter(|part| part.len() > 1)
}

fn x_mm(frame: &Frame, i: usize) -> f64 {
    (frame.x_min_m + frame.dx_m * i as f64) * MM
}

/// A field at y = 0.
fn along(frame: &Frame, field: &[f32], unit: Unit) -> Vec<(f64, f64)> {
    let row = field.chunks_exact(frame.nx).nth(frame.ny / 2);
    let values = row.into_iter().flatten().enumerate();
    values
        .map(|(i, &value)| (x_mm(frame, i), unit.of(value.into())))
        .collect()
}

fn hertz(frame: &Frame) -> Vec<(f64, f64)> {
    let shares = (0..=200).map(|k| f64::from(k) / 100.0 - 1.0);
    let point = |t: f64| {
        let share = (1.0 - t * t).max(0.0).sqrt();
        (t * frame.a_m * MM, share * GPA.of(frame.p_hertz_pa))
    };
    shares.map(point).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn curves_are_cut_at_the_top_and_not_bent() {
        let points = [(0.0, 1.0), (1.0, 2.0), (2.0, 9.0), (3.0, 2.0), (4.0, 1.0)];
        let parts: Vec<_> = inside(&points, 5.0).collect();
        assert_eq!(parts, [&points[..2], &points[3..]]);
    }
}
