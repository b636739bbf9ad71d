//! Pictures as papers print them: to a width in mm, in one size of type, without a title; axes and text as vectors around
//! a field of pixels. As SVG and PDF.
//!
//! ```text
//! Picture, ExportedFigure ──> Paper { strokes, texts, field }  (points of 1/72", y down) ──> svg, pdf
//! ```
//! In a PDF letters are drawn as their outlines: it needs no font, and symbols are those of the pictures.

mod pdf;
mod svg;

use crate::Picture;
use asperity_engine::math::number::{MM, plain, ticks};

use super::drawing::{ExportedFigure, field_pixels, inside};

/// How a picture is printed.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct PrintSize {
    /// Width of the whole picture, mm.
    pub width_mm: f64,
    /// Pixels of the field, per inch.
    pub dpi: f64,
    /// Size of type, points of 1/72".
    pub font_pt: f64,
}

impl Default for PrintSize {
    /// One column of a journal.
    fn default() -> Self {
        Self {
            width_mm: 85.0,
            dpi: 300.0,
            font_pt: 7.0,
        }
    }
}

impl PrintSize {
    /// Pixels of a field over a rectangle.
    fn pixels(&self, plot: Box2) -> [u32; 2] {
        [plot.wide, plot.high].map(|side| (side / 72.0 * self.dpi).round().max(2.0) as u32)
    }
}

/// Points of a millimetre.
const PT_PER_MM: f64 = 72.0 / 25.4;

/// Where a text stands to its place.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum TextAnchor {
    Start,
    Middle,
    End,
}

/// A text: its place is that of its baseline's anchor.
struct PaperText {
    at: [f64; 2],
    anchor: TextAnchor,
    /// Whether it reads upwards.
    turned: bool,
    text: String,
    colour: [u8; 3],
}

/// A line or an area.
struct Stroke {
    points: Vec<[f64; 2]>,
    colour: [u8; 3],
    /// Width, points; `None`: filled.
    width: Option<f64>,
}

/// A rectangle of pixels, three bytes each.
pub(super) struct PixelArea {
    at: [f64; 2],
    size: [f64; 2],
    pixels: [u32; 2],
    rgb: Vec<u8>,
}

/// A page of one picture.
pub(super) struct Paper {
    size: [f64; 2],
    font_pt: f64,
    fields: Vec<PixelArea>,
    strokes: Vec<Stroke>,
    texts: Vec<PaperText>,
}

/// Black of axes.
pub(super) const INK: [u8; 3] = [20, 20, 20];

/// A rectangle of a page.
#[derive(Clone, Copy)]
pub(super) struct Box2 {
    left: f64,
    top: f64,
    wide: f64,
    high: f64,
}

impl Box2 {
    /// The point at these shares of its width and height, from above.
    fn at(self, [x, y]: [f64; 2]) -> [f64; 2] {
        [self.left + x * self.wide, self.top + y * self.high]
    }
}

impl PixelArea {
    /// Over a rectangle of a page.
    pub(super) fn over(plot: Box2, pixels: [u32; 2], rgb: Vec<u8>) -> Self {
        Self {
            at: [plot.left, plot.top],
            size: [plot.wide, plot.high],
            pixels,
            rgb,
        }
    }
}

impl Paper {
    /// A field of pixels of that height over its width, which `draw` gives and draws axes around, without a colour bar.
    pub(super) fn field(
        print: &PrintSize,
        height: f64,
        draw: impl FnOnce(&mut Self, Box2, [u32; 2]) -> PixelArea,
    ) -> Self {
        let (wide, em) = (print.width_mm * PT_PER_MM, print.font_pt);
        let inner = wide - 5.6 * em;
        let plot = Box2 {
            left: 4.6 * em,
            top: 0.6 * em,
            wide: inner,
            high: height * inner,
        };
        let mut paper = Self::new([wide, plot.top + plot.high + 4.2 * em], em);
        let field = draw(&mut paper, plot, print.pixels(plot));
        paper.fields.push(field);
        paper
    }

    fn new(size: [f64; 2], font_pt: f64) -> Self {
        Self {
            size,
            font_pt,
            fields: Vec::new(),
            strokes: Vec::new(),
            texts: Vec::new(),
        }
    }

    /// A map to scale with its colour bar.
    pub(super) fn map(picture: &Picture, print: &PrintSize, x_title: &str) -> Self {
        let (wide, em) = (print.width_mm * PT_PER_MM, print.font_pt);
        let [x, y] = [picture.x, picture.y].map(|axis| axis.ends().map(|end| end * MM));
        let inner = wide - 11.5 * em;
        let share = if picture.is_below && picture.contact.is_empty() {
            0.6
        } else {
            (y[1] - y[0]) / (x[1] - x[0])
        };
        let plot = Box2 {
            left: 4.6 * em,
            top: 1.6 * em,
            wide: inner,
            high: (inner * share).clamp(6.0 * em, 4.0 * inner),
        };
        let mut paper = Self::new([wide, plot.top + plot.high + 4.2 * em], em);
        let pixels = print.pixels(plot);
        let rgb = field_pixels(picture, (pixels[0], pixels[1]));
        paper.fields.push(PixelArea::over(plot, pixels, rgb));
        if !picture.is_below {
            let (_, [a, b]) = picture.hertz;
            let ring = (0..=180).map(|k| std::f64::consts::TAU * f64::from(k) / 180.0);
            let ring = ring.map(|angle| [a * MM * angle.cos(), b * MM * angle.sin()]);
            let seen = ring.filter(|[_, at]| (y[0]..=y[1]).contains(at));
            let points = seen.map(|[at_x, at_y]| {
                plot.at([(at_x - x[0]) / (x[1] - x[0]), (y[1] - at_y) / (y[1] - y[0])])
            });
            paper.line(points.collect(), [150, 155, 165], 0.6);
        }
        paper.x_axis(plot, x, x_title);
        let (title, down) = if picture.is_below {
            ("depth z, mm", true)
        } else {
            ("y, mm", false)
        };
        paper.side(plot, y, (title, INK), (false, down));
        paper.bar(picture, plot);
        paper
    }

    /// Curves over x with an axis at each side.
    pub(super) fn figure(figure: &ExportedFigure, print: &PrintSize) -> Self {
        let (wide, em) = (print.width_mm * PT_PER_MM, print.font_pt);
        let inner = wide - 9.4 * em;
        let plot = Box2 {
            left: 4.6 * em,
            top: 1.8 * em,
            wide: inner,
            high: 0.62 * inner,
        };
        let mut paper = Self::new([wide, plot.top + plot.high + 4.2 * em], em);
        let right = std::iter::once((&figure.right.curve, figure.right.top));
        let curves = figure.left.iter().map(|curve| (curve, figure.left_top));
        let mut name_at = plot.left;
        for (curve, top) in curves.chain(right) {
            for part in inside(&curve.points, top) {
                let [first, last] = figure.x;
                let place = |(x, value): &(f64, f64)| {
                    plot.at([(x - first) / (last - first), 1.0 - value / top])
                };
                paper.line(part.iter().map(place).collect(), curve.colour, 1.0);
            }
            paper.text(
                [name_at, plot.top - 0.6 * em],
                TextAnchor::Start,
                curve.name,
                curve.colour,
            );
            name_at += plot.wide / (figure.left.len() + 1) as f64;
        }
        paper.x_axis(plot, figure.x, "x, mm");
        let (left, right) = (figure.left.last(), &figure.right);
        let colour = left.map_or(INK, |curve| curve.colour);
        paper.side(
            plot,
            [0.0, figure.left_top],
            (&figure.left_title, colour),
            (false, false),
        );
        let ends = [0.0, right.top];
        paper.side(
            plot,
            ends,
            (&right.title, right.curve.colour),
            (true, false),
        );
        paper
    }

    fn line(&mut self, points: Vec<[f64; 2]>, colour: [u8; 3], width: f64) {
        self.strokes.push(Stroke {
            points,
            colour,
            width: Some(width),
        });
    }

    fn text(&mut self, at: [f64; 2], anchor: TextAnchor, text: &str, colour: [u8; 3]) {
        self.texts.push(PaperText {
            at,
            anchor,
            turned: false,
            text: text.to_owned(),
            colour,
        });
    }

    /// The frame, and ticks below it.
    pub(super) fn x_axis(&mut self, plot: Box2, [low, high]: [f64; 2], title: &str) {
        let em = self.font_pt;
        let (right, bottom) = (plot.left + plot.wide, plot.top + plot.high);
        let frame = vec![
            [plot.left, plot.top],
            [right, plot.top],
            [right, bottom],
            [plot.left, bottom],
            [plot.left, plot.top],
        ];
        self.line(frame, INK, 0.6);
        for value in ticks(low, high, 5) {
            let x = plot.left + plot.wide * (value - low) / (high - low);
            self.line(vec![[x, bottom], [x, bottom + 0.4 * em]], INK, 0.6);
            self.text(
                [x, bottom + 1.5 * em],
                TextAnchor::Middle,
                &plain(value),
                INK,
            );
        }
        let middle = plot.left + 0.5 * plot.wide;
        self.text([middle, bottom + 3.0 * em], TextAnchor::Middle, title, INK);
    }

    /// Ticks at a side: whether at the right, and whether values grow downwards.
    pub(super) fn side(
        &mut self,
        plot: Box2,
        [low, high]: [f64; 2],
        (title, colour): (&str, [u8; 3]),
        (at_right, down): (bool, bool),
    ) {
        let em = self.font_pt;
        let (edge, out) = if at_right {
            (plot.left + plot.wide, 1.0)
        } else {
            (plot.left, -1.0)
        };
        let anchor = if at_right {
            TextAnchor::Start
        } else {
            TextAnchor::End
        };
        for value in ticks(low, high, 5) {
            let share = (value - low) / (high - low);
            let y = plot.top + plot.high * if down { share } else { 1.0 - share };
            self.line(vec![[edge, y], [edge + 0.4 * out * em, y]], INK, 0.6);
            self.text(
                [edge + 0.7 * out * em, y + 0.35 * em],
                anchor,
                &plain(value),
                colour,
            );
        }
        let away = if at_right { 3.9 } else { 3.4 };
        self.texts.push(PaperText {
            at: [edge + out * away * em, plot.top + 0.5 * plot.high],
            anchor: TextAnchor::Middle,
            turned: true,
            text: title.to_owned(),
            colour,
        });
    }

    /// The colour bar at the right.
    fn bar(&mut self, picture: &Picture, plot: Box2) {
        const ROWS: u32 = 256;
        let (em, look) = (self.font_pt, &picture.look);
        let [low, high] = look.range;
        let left = plot.left + plot.wide + em;
        let share = |row: u32| f64::from(row) / f64::from(ROWS - 1);
        let rows = (0..ROWS).map(|row| high - (high - low) * share(row));
        let rgb = rows.flat_map(|value| look.paint(look.tint(value, false)).unwrap_or([255; 3]));
        self.fields.push(PixelArea {
            at: [left, plot.top],
            size: [em, plot.high],
            pixels: [1, ROWS],
            rgb: rgb.collect(),
        });
        for value in look.divisions() {
            let y = plot.top + plot.high * (high - value) / (high - low);
            self.text(
                [left + 1.4 * em, y + 0.35 * em],
                TextAnchor::Start,
                &look.number(value),
                INK,
            );
        }
        self.text(
            [left - 0.2 * em, plot.top - 0.6 * em],
            TextAnchor::Start,
            &look.title(),
            INK,
        );
        if let Some(note) = look.note() {
            let at = [left + 5.6 * em, plot.top + plot.high + 1.5 * em];
            self.text(at, TextAnchor::End, &note, INK);
        }
    }
}
