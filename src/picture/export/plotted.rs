//! The page of a [`Plot`].

use super::centre_line::{FILM, PRESSURE};
use super::history::BAND;
use super::profile::POINT;
use super::sheet::Sheet;
use crate::draw::{Axis, Drawing, INK, Rect, Rgb, Side, Text, TextAnchor, text_width};
use crate::plot::{Plot, PlotAxis, Tone};

/// Height over width.
const HEIGHT: f64 = 0.62;
/// Body 2.
pub(super) const SECOND: Rgb = [148, 80, 130];

fn colour(tone: Tone) -> Rgb {
    match tone {
        Tone::Stress => PRESSURE,
        Tone::Film => FILM,
        Tone::Now => POINT,
        Tone::Faint => BAND,
        Tone::Second => SECOND,
    }
}

/// Draws it.
pub(super) fn draw(plot: &Plot, sheet: &Sheet) -> Drawing {
    let (mut drawing, area) = sheet.begin(1.8, HEIGHT);
    let (x, y) = (axis(&plot.x), axis(&plot.y));
    drawing.grid(area, &x, &y);
    let (em, width) = (drawing.font(), drawing.unit().curve());
    for curve in &plot.curves {
        let wide = match curve.tone {
            Tone::Faint => 0.8,
            // What joins two ends.
            _ if curve.name.is_empty() => 0.5,
            // Over the first body's, which may be alike.
            Tone::Second => 0.8,
            Tone::Stress | Tone::Film | Tone::Now => 1.5,
        };
        for part in plot.parts(curve) {
            let points = part.iter().map(|[x, y]| area.at(*x, *y));
            drawing.line(points.collect(), colour(curve.tone), wide * width);
        }
    }
    let places = plot.marks.iter().filter_map(|mark| {
        let (x, y) = plot.x.share(mark.at[0]).zip(plot.y.share(mark.at[1]))?;
        Some((mark, [x, y], area.at(x, y)))
    });
    let places: Vec<_> = places.collect();
    for (mark, _, at) in &places {
        drawing.dot(*at, 0.28 * em, colour(mark.tone));
    }
    for (mark, [x, y], [at_x, at_y]) in places {
        // Towards the middle, so that no word leaves the plot.
        let (off, anchor) = if x > 0.5 {
            (-0.5, TextAnchor::End)
        } else {
            (0.5, TextAnchor::Start)
        };
        let is_below = (mark.is_below || y > 0.9) && y > 0.1;
        let down = if is_below { 1.3 } else { -0.6 };
        let label = Text::new([at_x + off * em, at_y + down * em], &*mark.label);
        drawing.cleared(label.anchored(anchor));
    }
    legend(&mut drawing, area, plot);
    drawing.frame(area);
    drawing.axis(area, Side::Below, &x);
    drawing.axis(area, Side::Left, &y);
    drawing
}

/// Names of the curves above the plot.
fn legend(drawing: &mut Drawing, area: Rect, plot: &Plot) {
    let em = drawing.font();
    let named = || plot.curves.iter().filter(|curve| !curve.name.is_empty());
    let long: f64 = named().map(|curve| text_width(&curve.name) + 1.2).sum();
    let size = (area.wide / em / long.max(1.0)).min(1.0);
    let mut left = area.left;
    for curve in named() {
        let at = [left, area.top - 0.6 * em];
        drawing.text(
            Text::new(at, &*curve.name)
                .sized(size)
                .coloured(colour(curve.tone)),
        );
        left += size * (text_width(&curve.name) + 1.2) * em;
    }
}

/// Its places are shares.
fn axis(axis: &PlotAxis) -> Axis<'_> {
    Axis {
        ends: [0.0, 1.0],
        title: &axis.title,
        colour: INK,
        labels: axis.marks(),
    }
}
