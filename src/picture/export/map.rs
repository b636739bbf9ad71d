//! The drawing of a map: its field, the ring of Hertz's contact, axes in mm, and the colour bar.

use super::sheet::Sheet;
use super::white::paint;
use crate::draw::{Axis, ColourBar, Drawing, Rect, Rgb, Side};
use crate::{NodeAxis, Picture};
use asperity_engine::math::number::{MM, UM, plain};

/// Hertz's contact.
pub(super) const HERTZ: Rgb = [150, 155, 165];

/// How rows of a picture lie.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum RowScale {
    /// To scale.
    Even,
    /// All equally high: depths crowd below the surface, where crests press and pits start.
    Stretched,
}

/// Height over width of a picture with stretched depths.
const BELOW: f64 = 0.6;

/// Draws a map.
pub(super) fn map(picture: &Picture, sheet: &Sheet, x_title: &str) -> Drawing {
    if picture.is_below {
        let title = "depth z, µm (stretched)";
        return drawn(picture, sheet, x_title, title, BELOW, RowScale::Stretched);
    }
    let height = Sheet::height_to_scale(picture);
    drawn(picture, sheet, x_title, "y, mm", height, RowScale::Even)
}

/// Draws a field with that title of its rows, so high over its width.
pub(super) fn drawn(
    picture: &Picture,
    sheet: &Sheet,
    x_title: &str,
    y_title: &str,
    height: f64,
    rows: RowScale,
) -> Drawing {
    let (mut drawing, plot) = sheet.begin(6.9, height);
    drawing.field(sheet.field(plot, |pixels| field_pixels(picture, pixels, rows)));
    let [x, [first, last]] = [picture.x, picture.y].map(|axis| axis.ends().map(|end| end * MM));
    let x = Axis::linear(x, x_title);
    let y = match rows {
        RowScale::Stretched => stretched(picture.y, y_title),
        // Times are drawn downwards.
        RowScale::Even if picture.is_below => Axis::linear([last, first], y_title),
        RowScale::Even => Axis::linear([first, last], y_title),
    };
    if !picture.is_below {
        draw_ring(&mut drawing, plot, picture.hertz.1, &x, &y);
    }
    drawing.frame(plot);
    drawing.axis(plot, Side::Below, &x);
    drawing.axis(plot, Side::Left, &y);
    let look = &picture.look;
    let [low, high] = look.range;
    let share = |value: f64| (value - low) / (high - low);
    let value = |share: f64| low + (high - low) * share;
    let colour = |share: f64| paint(look, look.tint(value(share), false));
    let labels = look.divisions().into_iter();
    let title = look.title().replace("τxz", "τ_xz");
    drawing.colour_bar(
        plot,
        ColourBar {
            title: &title,
            colour: &colour,
            labels: labels.map(|at| (share(at), look.number(at))).collect(),
            note: look.note(),
        },
    );
    drawing
}

/// An axis of rows that are all equally high, with round depths where there is room for them.
fn stretched<'a>(depths: NodeAxis, title: &'a str) -> Axis<'a> {
    /// Least distance of numbers, as a share of the height.
    const APART: f64 = 0.085;
    let last = depths.nodes().saturating_sub(1).max(1) as f64;
    let [first_m, last_m] = depths.ends();
    let decades = (-2..6).flat_map(|k| [1.0, 2.0, 5.0].map(|step| step * 10_f64.powi(k)));
    let mut labels = Vec::new();
    if first_m == 0.0 {
        labels.push((0.0, "0".to_owned()));
    }
    for depth_um in decades {
        let depth_m = depth_um / UM.per_si;
        let place = depths.place(depth_m);
        let far = labels
            .last()
            .is_none_or(|(at, _)| place >= at + APART * last);
        if far && (first_m..=last_m).contains(&depth_m) {
            labels.push((place, plain(depth_um)));
        }
    }
    Axis {
        labels,
        ..Axis::linear([last, 0.0], title)
    }
}

/// The edge of Hertz's contact with those half-widths (m), as far as it is within the plot.
fn draw_ring(drawing: &mut Drawing, plot: Rect, [a, b]: [f64; 2], x: &Axis, y: &Axis) {
    let ring = (0..=180).map(|k| std::f64::consts::TAU * f64::from(k) / 180.0);
    let ring = ring.map(|angle| [a * MM * angle.cos(), b * MM * angle.sin()]);
    let seen = ring.filter(|[_, at]| (y.ends[0]..=y.ends[1]).contains(at));
    let points = seen.map(|[at_x, at_y]| plot.at(x.share(at_x), y.share(at_y)));
    let width = drawing.unit().hairline();
    drawing.line(points.collect(), HERTZ, width);
}

/// Pixels, three bytes each: values interpolated between their nodes; the first and the last pixel of both sides lie on
/// nodes.
fn field_pixels(picture: &Picture, [wide, tall]: [u32; 2], scale: RowScale) -> Vec<u8> {
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
    let rows = |off: f64| match scale {
        RowScale::Even => places(picture.y, down, tall, off),
        RowScale::Stretched => {
            let [nodes, pixels] = [picture.y.nodes() as f64, f64::from(tall.max(2))];
            let place = |pixel: u32| (f64::from(pixel) + off) / (pixels - 1.0) * (nodes - 1.0);
            (0..tall)
                .map(|pixel| place(pixel).clamp(0.0, nodes - 1.0))
                .collect()
        }
    };
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
            bytes.extend(paint(&picture.look, tint));
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
        let bytes = field_pixels(&picture, [2, 2], RowScale::Even);
        let pixel = |at: usize| [bytes[3 * at], bytes[3 * at + 1], bytes[3 * at + 2]];
        // y upwards: the frame's last row comes first.
        assert_eq!(pixel(0), Ramp::Viridis.colour(0.0, 1.0));
        assert_eq!(pixel(1), crate::CONTACT);
        assert_eq!(pixel(2), Ramp::Viridis.colour(1.0, 1.0));
        assert_eq!(pixel(3), crate::ABOVE);
    }

    #[test]
    fn depths_are_written_where_their_rows_are() {
        let depths = [0.0, 1e-6, 2e-6, 5e-6, 1e-4];
        let axis = stretched(NodeAxis::Uneven(&depths), "z");
        let labels: Vec<_> = axis
            .labels
            .iter()
            .map(|(at, text)| (*at, text.as_str()))
            .collect();
        assert_eq!(
            labels,
            [
                (0.0, "0"),
                (0.5, "0.5"),
                (1.0, "1"),
                (2.0, "2"),
                (3.0, "5"),
                (3.0 + 45.0 / 95.0, "50"),
                (4.0, "100")
            ]
        );
        assert_eq!((axis.share(0.0), axis.share(4.0)), (1.0, 0.0));
    }
}
