//! Drawing of maps and curves on white: axes, colour bar, title, state.

use std::path::Path;

use plotters::chart::SeriesAnno;
use plotters::coord::Shift;
use plotters::prelude::*;
use plotters::style::text_anchor::{HPos, Pos, VPos};

use crate::observe::chart::{FONT, font};
use crate::observe::ramp::Ramp;
use crate::observe::scales::{divisions, number};

/// Width of a picture's axes, pixels.
const WIDE: u32 = 720;
/// Room around the axes, pixels.
const LEFT: u32 = 92;
const ABOVE: u32 = 74;
const BELOW: u32 = 58;
const RIGHT: u32 = 116;
/// The axes' titles stand on their left edge.
const EDGE: u32 = 18;
/// Where bodies touch.
const CONTACT: [u8; 3] = [60, 230, 240];
/// Values above the range, where they would drown the rest.
const BEYOND: [u8; 3] = [206, 208, 212];

type Area<'a> = DrawingArea<BitMapBackend<'a>, Shift>;

/// A picture to draw.
pub(super) struct Drawing<'a> {
    pub(super) file: &'a Path,
    pub(super) title: String,
    /// Below the title.
    pub(super) state: String,
}

/// A field on a rectangle.
pub(super) struct Map {
    pub(super) columns: usize,
    /// In the bar's unit, row by row from the top.
    pub(super) values: Vec<f32>,
    /// Marked values; empty: none.
    pub(super) marks: Vec<bool>,
    pub(super) x: [f64; 2],
    /// Lower and upper edge.
    pub(super) y: [f64; 2],
    /// Upper end of the colour range; the lower is 0, or its negative for a diverging map.
    pub(super) top: f64,
    pub(super) ramp: Ramp,
    pub(super) bar: String,
    pub(super) y_title: String,
    /// Half-axes of Hertz's contact.
    pub(super) ellipse: Option<[f64; 2]>,
    pub(super) grey_above: bool,
}

/// Curves over x with an axis at each side.
pub(super) struct Figure {
    pub(super) x: [f64; 2],
    pub(super) left_top: f64,
    pub(super) left_title: String,
    pub(super) left: Vec<Curve>,
    pub(super) right: Right,
}

/// The right axis of a figure.
pub(super) struct Right {
    pub(super) top: f64,
    pub(super) title: String,
    pub(super) curve: Curve,
}

/// A curve of a figure.
pub(super) struct Curve {
    pub(super) name: &'static str,
    pub(super) colour: [u8; 3],
    pub(super) points: Vec<(f64, f64)>,
}

impl Drawing<'_> {
    /// Draws a map to scale.
    ///
    /// # Errors
    /// What went wrong, in words.
    pub(super) fn map(&self, map: &Map) -> Result<(), String> {
        let tall = f64::from(WIDE) * (map.y[1] - map.y[0]) / (map.x[1] - map.x[0]);
        let tall = (tall.round() as u32).clamp(120, 4 * WIDE);
        let root = self.begin(WIDE + LEFT + RIGHT, tall + ABOVE + BELOW)?;
        let (left, right) = root.split_horizontally(WIDE + LEFT);
        draw_map(&left, map).map_err(|error| error.to_string())?;
        draw_bar(&right, map, tall).map_err(|error| error.to_string())?;
        root.present().map_err(|error| error.to_string())
    }

    /// Draws a figure.
    ///
    /// # Errors
    /// What went wrong, in words.
    pub(super) fn figure(&self, figure: &Figure) -> Result<(), String> {
        let root = self.begin(WIDE + 2 * LEFT, 420 + ABOVE + BELOW)?;
        draw_figure(&root, figure).map_err(|error| error.to_string())?;
        root.present().map_err(|error| error.to_string())
    }

    /// An empty picture with title and state.
    fn begin(&self, width: u32, height: u32) -> Result<Area<'_>, String> {
        font()?;
        let root = BitMapBackend::new(self.file, (width, height)).into_drawing_area();
        let text = |text: &str, y: i32, size: i32, colour: RGBColor| {
            let style = TextStyle::from((FONT, size)).color(&colour);
            root.draw(&Text::new(text.to_owned(), (16, y), style))
        };
        root.fill(&WHITE)
            .and_then(|()| text(&self.title, 12, 20, BLACK))
            .and_then(|()| text(&self.state, 40, 15, RGBColor(90, 95, 105)))
            .map_err(|error| error.to_string())?;
        Ok(root)
    }
}

type DrawingResult<'a> =
    Result<(), DrawingAreaErrorKind<<BitMapBackend<'a> as DrawingBackend>::ErrorType>>;

fn draw_map<'a>(area: &Area<'a>, map: &Map) -> DrawingResult<'a> {
    let mut chart = ChartBuilder::on(area)
        .margin_top(ABOVE)
        .margin_left(EDGE)
        .x_label_area_size(BELOW)
        .y_label_area_size(LEFT - EDGE)
        .build_cartesian_2d(map.x[0]..map.x[1], map.y[0]..map.y[1])?;
    let size = chart.plotting_area().dim_in_pixel();
    let corner = (map.x[0], map.y[1]);
    if let Some(image) = BitMapElement::with_owned_buffer(corner, size, map.paint(size)) {
        chart.plotting_area().draw(&image)?;
    }
    if let Some([a, b]) = map.ellipse {
        let points = (0..=180).map(|k| {
            let angle = std::f64::consts::TAU * f64::from(k) / 180.0;
            (a * angle.cos(), b * angle.sin())
        });
        let inside: Vec<_> = points
            .filter(|(_, y)| (map.y[0]..=map.y[1]).contains(y))
            .collect();
        chart.draw_series(LineSeries::new(inside, RGBColor(150, 155, 165)))?;
    }
    chart
        .configure_mesh()
        .disable_mesh()
        .label_style((FONT, 15))
        .axis_desc_style((FONT, 16))
        .x_desc("x, mm (rolling direction to the right)")
        .y_desc(map.y_title.as_str())
        .x_labels(8)
        .y_labels(8)
        .x_label_formatter(&|x| number(*x))
        // Depths are drawn downwards.
        .y_label_formatter(&|y| number(if map.ellipse.is_some() { *y } else { -y }))
        .draw()
}

impl Map {
    fn low(&self) -> f64 {
        if self.ramp == Ramp::Diverging {
            -self.top
        } else {
            0.0
        }
    }

    fn colour(&self, value: f64) -> [u8; 3] {
        if self.grey_above && value > self.top {
            return BEYOND;
        }
        let share = (value - self.low()) / (self.top - self.low());
        self.ramp.colour(share as f32, 1.0)
    }

    /// Pixels, three bytes each: values interpolated between their places.
    fn paint(&self, (wide, tall): (u32, u32)) -> Vec<u8> {
        let rows = self.values.len() / self.columns.max(1);
        let place = |pixel: u32, pixels: u32, n: usize| {
            let at = f64::from(pixel) / f64::from(pixels.max(2) - 1) * (n.max(1) - 1) as f64;
            let low = (at as usize).min(n.saturating_sub(2));
            (low, (low + 1).min(n - 1), at - low as f64)
        };
        let mut bytes = Vec::with_capacity(3 * (wide * tall) as usize);
        for row in 0..tall {
            let (j0, j1, v) = place(row, tall, rows);
            for column in 0..wide {
                let (i0, i1, u) = place(column, wide, self.columns);
                let near =
                    (if v < 0.5 { j0 } else { j1 }) * self.columns + if u < 0.5 { i0 } else { i1 };
                if self.marks.get(near) == Some(&true) {
                    bytes.extend(CONTACT);
                    continue;
                }
                let at = |j: usize, i: usize| f64::from(self.values[j * self.columns + i]);
                let upper = at(j0, i0) * (1.0 - u) + at(j0, i1) * u;
                let lower = at(j1, i0) * (1.0 - u) + at(j1, i1) * u;
                bytes.extend(self.colour(upper * (1.0 - v) + lower * v));
            }
        }
        bytes
    }
}

/// The colour bar with its unit.
fn draw_bar<'a>(area: &Area<'a>, map: &Map, tall: u32) -> DrawingResult<'a> {
    let (left, wide) = (18, 24);
    let (top, bottom) = (ABOVE as i32, (ABOVE + tall) as i32);
    let (low, span) = (map.low(), map.top - map.low());
    for y in top..bottom {
        let value = map.top - span * f64::from(y - top) / f64::from(bottom - top);
        let [r, g, b] = map.colour(value);
        let row = Rectangle::new(
            [(left, y), (left + wide, y + 1)],
            RGBColor(r, g, b).filled(),
        );
        area.draw(&row)?;
    }
    let style = TextStyle::from((FONT, 15)).pos(Pos::new(HPos::Left, VPos::Center));
    let values = if low < 0.0 {
        [-1.0, -0.5, 0.0, 0.5, 1.0].map(|t| t * map.top).to_vec()
    } else {
        divisions(map.top)
    };
    for value in values {
        let y = bottom - (f64::from(bottom - top) * (value - low) / span) as i32;
        let text = Text::new(number(value), (left + wide + 8, y), style.clone());
        area.draw(&text)?;
    }
    let title = TextStyle::from((FONT, 16));
    area.draw(&Text::new(map.bar.clone(), (left - 8, top - 28), title))
}

fn draw_figure<'a>(area: &Area<'a>, figure: &Figure) -> DrawingResult<'a> {
    let x = figure.x[0]..figure.x[1];
    let mut chart = ChartBuilder::on(area)
        .margin_top(ABOVE)
        .margin_left(EDGE)
        .margin_right(EDGE)
        .x_label_area_size(BELOW)
        .y_label_area_size(LEFT - EDGE)
        .right_y_label_area_size(LEFT - EDGE)
        .build_cartesian_2d(x.clone(), 0.0..figure.left_top)?
        .set_secondary_coord(x, 0.0..figure.right.top);
    chart
        .configure_mesh()
        .light_line_style(TRANSPARENT)
        .bold_line_style(RGBColor(225, 227, 230))
        .label_style((FONT, 15))
        .axis_desc_style((FONT, 16))
        .x_desc("x, mm (rolling direction to the right)")
        .y_desc(figure.left_title.as_str())
        .x_label_formatter(&|x| number(*x))
        .y_label_formatter(&|y| number(*y))
        .draw()?;
    chart
        .configure_secondary_axes()
        .label_style((FONT, 15))
        .axis_desc_style((FONT, 16))
        .y_desc(figure.right.title.as_str())
        .y_label_formatter(&|y| number(*y))
        .draw()?;
    for curve in &figure.left {
        let style = style(curve);
        for part in inside(&curve.points, figure.left_top) {
            chart.draw_series(LineSeries::new(part, style))?;
        }
        legend(chart.draw_series(LineSeries::new([], style))?, curve);
    }
    let curve = &figure.right.curve;
    for part in inside(&curve.points, figure.right.top) {
        chart.draw_secondary_series(LineSeries::new(part, style(curve)))?;
    }
    legend(
        chart.draw_secondary_series(LineSeries::new([], style(curve)))?,
        curve,
    );
    chart
        .configure_series_labels()
        .label_font((FONT, 15))
        .position(SeriesLabelPosition::UpperLeft)
        .background_style(WHITE.mix(0.85))
        .border_style(RGBColor(200, 202, 206))
        .draw()
}

fn style(curve: &Curve) -> ShapeStyle {
    let [r, g, b] = curve.colour;
    RGBColor(r, g, b).stroke_width(2)
}

fn legend(series: &mut SeriesAnno<'_, BitMapBackend<'_>>, curve: &Curve) {
    let style = style(curve);
    series
        .label(curve.name)
        .legend(move |(x, y)| PathElement::new(vec![(x, y), (x + 22, y)], style));
}

/// The parts of a curve below the top; what is above is left out, not bent.
fn inside(points: &[(f64, f64)], top: f64) -> Vec<Vec<(f64, f64)>> {
    points
        .split(|(_, value)| *value > top)
        .filter(|part| part.len() > 1)
        .map(<[_]>::to_vec)
        .collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    fn map() -> Map {
        Map {
            columns: 2,
            values: vec![0.0, 1.0, 2.0, 3.0],
            marks: vec![false, true, false, false],
            x: [0.0, 1.0],
            y: [0.0, 1.0],
            top: 2.0,
            ramp: Ramp::Inferno,
            bar: "p, GPa".into(),
            y_title: "y, mm".into(),
            ellipse: None,
            grey_above: true,
        }
    }

    #[test]
    fn pixels_are_the_values_colours_with_marks_and_what_is_beyond() {
        let bytes = map().paint((2, 2));
        let pixel = |at: usize| [bytes[3 * at], bytes[3 * at + 1], bytes[3 * at + 2]];
        assert_eq!(pixel(0), Ramp::Inferno.colour(0.0, 1.0));
        assert_eq!(pixel(1), CONTACT);
        assert_eq!(pixel(2), Ramp::Inferno.colour(1.0, 1.0));
        assert_eq!(pixel(3), BEYOND);
    }

    #[test]
    fn curves_are_cut_at_the_top_and_not_bent() {
        let points = [(0.0, 1.0), (1.0, 2.0), (2.0, 9.0), (3.0, 2.0), (4.0, 1.0)];
        let parts = inside(&points, 5.0);
        assert_eq!(parts, vec![points[..2].to_vec(), points[3..].to_vec()]);
    }
}
