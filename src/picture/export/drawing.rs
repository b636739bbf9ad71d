//! Drawing of maps and curves on white: axes, colour bar, title, state.

use plotters::chart::SeriesAnno;
use plotters::coord::Shift;
use plotters::prelude::*;
use plotters::style::text_anchor::{HPos, Pos, VPos};

use crate::chart::{FONT, font};
use crate::{NodeAxis, Picture};
use asperity_engine::math::number::{MM, plain};

/// Width of a picture's axes, pixels, in a file of its own and where it moves.
const WIDE: u32 = 720;
const MOVING_WIDE: u32 = 400;
/// Room around the axes, pixels.
pub(super) const LEFT: u32 = 92;
pub(super) const ABOVE: u32 = 74;
pub(super) const BELOW: u32 = 58;
const RIGHT: u32 = 116;
/// The axes' titles stand on their left edge.
pub(super) const EDGE: u32 = 18;
pub(super) type Area<'a> = DrawingArea<BitMapBackend<'a>, Shift>;

/// A picture to draw.
pub(super) struct Drawing {
    pub(super) title: String,
    /// Below the title.
    pub(super) state: String,
    /// Below the map.
    pub(super) x_title: &'static str,
}

/// What becomes of the pixels, three bytes each.
pub(super) enum PictureTarget<'a> {
    /// A file of its own.
    Still(&'a mut Vec<u8>),
    /// One of a picture that moves.
    Moving(&'a mut Vec<u8>),
}

impl<'a> PictureTarget<'a> {
    /// Width of the axes.
    pub(super) fn wide(&self) -> u32 {
        match self {
            Self::Still(_) => WIDE,
            Self::Moving(_) => MOVING_WIDE,
        }
    }

    fn area(self, size: (u32, u32)) -> Area<'a> {
        let (Self::Still(pixels) | Self::Moving(pixels)) = self;
        pixels.clear();
        pixels.resize(3 * (size.0 * size.1) as usize, 0);
        BitMapBackend::with_buffer(pixels, size).into_drawing_area()
    }
}

/// Curves over x with an axis at each side.
pub(super) struct ExportedFigure {
    pub(super) x: [f64; 2],
    pub(super) left_top: f64,
    pub(super) left_title: String,
    pub(super) left: Vec<DrawnCurve>,
    pub(super) right: Right,
}

/// The right axis of a figure.
pub(super) struct Right {
    pub(super) top: f64,
    pub(super) title: String,
    pub(super) curve: DrawnCurve,
}

/// A curve of a figure.
pub(super) struct DrawnCurve {
    pub(super) name: &'static str,
    pub(super) colour: [u8; 3],
    pub(super) points: Vec<(f64, f64)>,
}

impl Drawing {
    /// Draws a map to scale; its size.
    ///
    /// # Errors
    /// What went wrong, in words.
    pub(super) fn map(
        &self,
        picture: &Picture,
        canvas: PictureTarget,
    ) -> Result<(u32, u32), String> {
        let [across, high] = [picture.x, picture.y].map(|axis| {
            let [from, to] = axis.ends();
            to - from
        });
        let wide = canvas.wide();
        let tall = (f64::from(wide) * high / across).round() as u32;
        let tall = tall.clamp(120, 4 * wide);
        let size = (wide + LEFT + RIGHT, tall + ABOVE + BELOW);
        let root = self.begin(canvas, size)?;
        let (left, right) = root.split_horizontally(wide + LEFT);
        draw_map(&left, picture, self.x_title).map_err(|error| error.to_string())?;
        draw_bar(&right, picture, tall).map_err(|error| error.to_string())?;
        root.present().map_err(|error| error.to_string())?;
        Ok(size)
    }

    /// Draws a figure; its size.
    ///
    /// # Errors
    /// What went wrong, in words.
    pub(super) fn figure(
        &self,
        figure: &ExportedFigure,
        canvas: PictureTarget,
    ) -> Result<(u32, u32), String> {
        let wide = canvas.wide();
        let size = (wide + 2 * LEFT, wide * 7 / 12 + ABOVE + BELOW);
        let root = self.begin(canvas, size)?;
        draw_figure(&root, figure).map_err(|error| error.to_string())?;
        root.present().map_err(|error| error.to_string())?;
        Ok(size)
    }

    /// An empty picture with title and state.
    pub(super) fn begin<'a>(
        &self,
        canvas: PictureTarget<'a>,
        size: (u32, u32),
    ) -> Result<Area<'a>, String> {
        font()?;
        let root = canvas.area(size);
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

fn draw_map<'a>(area: &Area<'a>, picture: &Picture, x_title: &str) -> DrawingResult<'a> {
    let [x, y] = [picture.x, picture.y].map(|axis| axis.ends().map(|end| end * MM));
    // Depths are drawn downwards.
    let y = if picture.is_below { [-y[1], -y[0]] } else { y };
    let mut chart = ChartBuilder::on(area)
        .margin_top(ABOVE)
        .margin_left(EDGE)
        .x_label_area_size(BELOW)
        .y_label_area_size(LEFT - EDGE)
        .build_cartesian_2d(x[0]..x[1], y[0]..y[1])?;
    let size = chart.plotting_area().dim_in_pixel();
    let bytes = field_pixels(picture, size);
    if let Some(image) = BitMapElement::with_owned_buffer((x[0], y[1]), size, bytes) {
        chart.plotting_area().draw(&image)?;
    }
    if !picture.is_below {
        let (_, [a, b]) = picture.hertz;
        let points = (0..=180).map(|k| {
            let angle = std::f64::consts::TAU * f64::from(k) / 180.0;
            (a * MM * angle.cos(), b * MM * angle.sin())
        });
        let inside: Vec<_> = points
            .filter(|(_, at)| (y[0]..=y[1]).contains(at))
            .collect();
        chart.draw_series(LineSeries::new(inside, RGBColor(150, 155, 165)))?;
    }
    let y_title = if picture.is_below {
        "depth z, mm"
    } else {
        "y, mm"
    };
    chart
        .configure_mesh()
        .disable_mesh()
        .label_style((FONT, 15))
        .axis_desc_style((FONT, 16))
        .x_desc(x_title)
        .y_desc(y_title)
        .x_labels(8)
        .y_labels(8)
        .x_label_formatter(&|x| plain(*x))
        .y_label_formatter(&|y| plain(if picture.is_below { -y } else { *y }))
        .draw()
}

/// Pixels, three bytes each: values interpolated between their nodes; the first and the last pixel of both sides lie on
/// nodes.
pub(super) fn field_pixels(picture: &Picture, (wide, tall): (u32, u32)) -> Vec<u8> {
    let places = |axis: NodeAxis, [from, to]: [f64; 2], pixels: u32, off: f64| -> Vec<f64> {
        let last = f64::from(pixels.max(2) - 1);
        let at = |pixel: u32| from + (to - from) * (f64::from(pixel) + off) / last;
        (0..pixels).map(|pixel| axis.place(at(pixel))).collect()
    };
    let (x_ends, [first, last]) = (picture.x.ends(), picture.y.ends());
    let down = if picture.is_below {
        [first, last]
    } else {
        [last, first]
    };
    let across = |off| places(picture.x, x_ends, wide, off);
    let rows = |off| places(picture.y, down, tall, off);
    let mut bytes = Vec::with_capacity(3 * (wide * tall) as usize);
    if let Some(film) = picture.film() {
        let xs: Vec<_> = across(-0.5).into_iter().zip(across(0.5)).collect();
        for (y_0, y_1) in rows(-0.5).into_iter().zip(rows(0.5)) {
            for (x_0, x_1) in &xs {
                bytes.extend(film.cell([*x_0, *x_1], [y_0, y_1]));
            }
        }
        return bytes;
    }
    let xs = across(0.0);
    for y in rows(0.0) {
        for x in &xs {
            let touches = picture.touches(x.round() as usize, y.round() as usize);
            let tint = picture.look.tint(between(picture, *x, y), touches);
            bytes.extend(picture.look.paint(tint).unwrap_or([255; 3]));
        }
    }
    bytes
}

/// A value between nodes, SI.
fn between(picture: &Picture, x: f64, y: f64) -> f64 {
    let near = |place: f64, nodes: usize| {
        let low = (place as usize).min(nodes.saturating_sub(2));
        (low, (low + 1).min(nodes - 1), place - low as f64)
    };
    let (i_0, i_1, u) = near(x, picture.x.nodes());
    let (j_0, j_1, v) = near(y, picture.y.nodes());
    let row =
        |j: usize| f64::from(picture.at(i_0, j)) * (1.0 - u) + f64::from(picture.at(i_1, j)) * u;
    row(j_0) * (1.0 - v) + row(j_1) * v
}

/// The colour bar with its unit.
fn draw_bar<'a>(area: &Area<'a>, picture: &Picture, tall: u32) -> DrawingResult<'a> {
    let (left, wide) = (18, 24);
    let (top, bottom) = (ABOVE as i32, (ABOVE + tall) as i32);
    let look = &picture.look;
    let [low, high] = look.range;
    let span = high - low;
    for y in top..bottom {
        let value = high - span * f64::from(y - top) / f64::from(bottom - top);
        let [r, g, b] = look.paint(look.tint(value, false)).unwrap_or([255; 3]);
        let row = Rectangle::new(
            [(left, y), (left + wide, y + 1)],
            RGBColor(r, g, b).filled(),
        );
        area.draw(&row)?;
    }
    let style = TextStyle::from((FONT, 15)).pos(Pos::new(HPos::Left, VPos::Center));
    for value in look.divisions() {
        let y = bottom - (f64::from(bottom - top) * (value - low) / span) as i32;
        let text = Text::new(look.number(value), (left + wide + 8, y), style.clone());
        area.draw(&text)?;
    }
    if let Some(note) = look.note() {
        area.draw(&Text::new(note, (left, bottom + 18), style))?;
    }
    let title = TextStyle::from((FONT, 16));
    area.draw(&Text::new(look.title(), (left - 8, top - 28), title))
}

fn draw_figure<'a>(area: &Area<'a>, figure: &ExportedFigure) -> DrawingResult<'a> {
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
        .x_label_formatter(&|x| plain(*x))
        .y_label_formatter(&|y| plain(*y))
        .draw()?;
    chart
        .configure_secondary_axes()
        .label_style((FONT, 15))
        .axis_desc_style((FONT, 16))
        .y_desc(figure.right.title.as_str())
        .y_label_formatter(&|y| plain(*y))
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

fn style(curve: &DrawnCurve) -> ShapeStyle {
    let [r, g, b] = curve.colour;
    RGBColor(r, g, b).stroke_width(2)
}

fn legend(series: &mut SeriesAnno<'_, BitMapBackend<'_>>, curve: &DrawnCurve) {
    let style = style(curve);
    series
        .label(curve.name)
        .legend(move |(x, y)| PathElement::new(vec![(x, y), (x + 22, y)], style));
}

/// The parts of a curve below the top; what is above is left out, not bent.
pub(super) fn inside(points: &[(f64, f64)], top: f64) -> Vec<Vec<(f64, f64)>> {
    points
        .split(|(_, value)| *value > top)
        .filter(|part| part.len() > 1)
        .map(<[_]>::to_vec)
        .collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{Ramp, Ranges, Subject};
    use asperity_engine::sim::Frame;

    #[test]
    fn pixels_are_the_values_colours_with_marks_and_what_is_above() {
        let frame = Frame {
            nx: 2,
            ny: 2,
            dx_m: 1.0,
            dy_m: 1.0,
            film_m: vec![2.0, 3.0, 0.0, 1.0],
            contact: vec![0, 0, 0, 1],
            ..Frame::default()
        };
        let ranges = Ranges {
            film_m: 2.0,
            ..Ranges::default()
        };
        let picture = Picture::of(&frame, Subject::Film, &ranges).expect("a film");
        let bytes = field_pixels(&picture, (2, 2));
        let pixel = |at: usize| [bytes[3 * at], bytes[3 * at + 1], bytes[3 * at + 2]];
        // y upwards: the frame's last row comes first.
        assert_eq!(pixel(0), Ramp::Viridis.colour(0.0, 1.0));
        assert_eq!(pixel(1), crate::CONTACT);
        assert_eq!(pixel(2), Ramp::Viridis.colour(1.0, 1.0));
        assert_eq!(pixel(3), crate::ABOVE);
    }

    #[test]
    fn curves_are_cut_at_the_top_and_not_bent() {
        let points = [(0.0, 1.0), (1.0, 2.0), (2.0, 9.0), (3.0, 2.0), (4.0, 1.0)];
        let parts = inside(&points, 5.0);
        assert_eq!(parts, vec![points[..2].to_vec(), points[3..].to_vec()]);
    }
}
