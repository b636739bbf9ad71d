//! Drawings on white, laid out once: strokes, texts and fields of pixels. Each writer puts the same drawing into its format.
//!
//! ```text
//! chart, map, profile, centre line ──> Drawing { fields, shapes, texts } ──> pixels (PNG, GIF)
//!                                      y downwards, text last            ├─> SVG
//!                                                                        └─> PDF
//! ```
//! A library of charts (plotters) was used before. It knows whole pixels alone, so that what papers print was laid out a second
//! time, and it took 3 CPU seconds of the first build. PDF is written by `pdf-writer` and `subsetter`, GIF by `gif`: as much
//! together. `svg2pdf`, which reads the SVG again, and `krilla` were measured in their place: 30 to 40 CPU seconds each.

mod bitmap;
mod font;
mod pdf;
#[cfg(test)]
pub(crate) mod seen;
mod svg;

use asperity_engine::math::number::{plain, ticks};

pub(crate) use bitmap::{Pixels, png_of};
pub(crate) use font::text_width;

/// Red, green, blue.
pub(crate) type Rgb = [u8; 3];
/// Axes and their numbers.
pub(crate) const INK: Rgb = [20, 20, 20];
/// Lines behind curves.
const GRID: Rgb = [225, 227, 230];
/// Behind words on a field.
const PLATE: Rgb = [38, 36, 44];
/// Points of a millimetre.
pub(crate) const PT_PER_MM: f64 = 72.0 / 25.4;

/// What a drawing is measured in.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum SizeUnit {
    /// Pixels of a screen.
    Pixel,
    /// Points of 1/72 inch on paper.
    Point,
}

impl SizeUnit {
    /// Width of the lines of axes.
    pub(crate) fn hairline(self) -> f64 {
        match self {
            Self::Pixel => 1.0,
            Self::Point => 0.6,
        }
    }

    /// Width of curves.
    pub(crate) fn curve(self) -> f64 {
        match self {
            Self::Pixel => 2.0,
            Self::Point => 1.0,
        }
    }
}

/// A rectangle of a drawing.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Rect {
    pub(crate) left: f64,
    pub(crate) top: f64,
    pub(crate) wide: f64,
    pub(crate) high: f64,
}

impl Rect {
    pub(crate) fn right(self) -> f64 {
        self.left + self.wide
    }

    pub(crate) fn bottom(self) -> f64 {
        self.top + self.high
    }

    /// The point at these shares of its width and height, from the lower left corner.
    pub(crate) fn at(self, x: f64, y: f64) -> [f64; 2] {
        [self.left + x * self.wide, self.bottom() - y * self.high]
    }

    /// Corners of a rectangle that is larger by so much on each side.
    fn corners(self, larger: f64) -> Vec<[f64; 2]> {
        let (left, right) = (self.left - larger, self.right() + larger);
        let (top, bottom) = (self.top - larger, self.bottom() + larger);
        vec![[left, top], [right, top], [right, bottom], [left, bottom]]
    }
}

/// A rectangle of pixels, three bytes each, row by row from above.
#[derive(Debug, Clone)]
pub(crate) struct PixelField {
    pub(crate) area: Rect,
    pub(crate) pixels: [u32; 2],
    pub(crate) rgb: Vec<u8>,
}

/// How a shape is drawn.
#[derive(Debug, Clone, Copy, PartialEq)]
enum Pen {
    /// Filled within its outline.
    Fill,
    /// A line of that width.
    Line(f64),
}

/// A line or an area.
#[derive(Debug, Clone)]
struct Shape {
    points: Vec<[f64; 2]>,
    colour: Rgb,
    pen: Pen,
}

/// Where a text stands to its place.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum TextAnchor {
    Start,
    Middle,
    End,
}

impl TextAnchor {
    /// Share of a text's width that lies before its place.
    fn share(self) -> f64 {
        match self {
            Self::Start => 0.0,
            Self::Middle => 0.5,
            Self::End => 1.0,
        }
    }
}

/// A text: its place is that of its baseline's anchor.
#[derive(Debug, Clone)]
pub(crate) struct Text {
    at: [f64; 2],
    words: String,
    anchor: TextAnchor,
    is_turned: bool,
    colour: Rgb,
    /// Size over the drawing's size of type.
    size: f64,
}

impl Text {
    /// A text in ink that begins at its place.
    pub(crate) fn new(at: [f64; 2], text: impl Into<String>) -> Self {
        Self {
            at,
            words: text.into(),
            anchor: TextAnchor::Start,
            is_turned: false,
            colour: INK,
            size: 1.0,
        }
    }

    #[must_use]
    pub(crate) fn anchored(self, anchor: TextAnchor) -> Self {
        Self { anchor, ..self }
    }

    /// Reads upwards.
    #[must_use]
    fn turned(self) -> Self {
        Self {
            is_turned: true,
            ..self
        }
    }

    /// On white: as dark as it takes to be read there.
    #[must_use]
    pub(crate) fn coloured(self, colour: Rgb) -> Self {
        self.on_field(legible(colour))
    }

    #[must_use]
    fn on_field(self, colour: Rgb) -> Self {
        Self { colour, ..self }
    }

    #[must_use]
    pub(crate) fn sized(self, size: f64) -> Self {
        Self { size, ..self }
    }
}

/// Size of an index over that of its text, and how far it stands lower, over the size of type.
const INDEX: f64 = 0.72;
const INDEX_DOWN: f64 = 0.22;

/// A text with an index: what is before it, the index, and the rest.
fn parted(words: &str) -> Option<(&str, &str, &str)> {
    let (base, after) = words.split_once('_')?;
    let end = after
        .find(|c: char| !c.is_alphanumeric())
        .unwrap_or(after.len());
    let (index, rest) = after.split_at(end);
    // Names of files and keys stay as they are.
    (base.chars().count() == 1 && !index.is_empty()).then_some((base, index, rest))
}

/// A colour made so dark that a text in it can be read on white: its luminance leaves a contrast of 4.5 and more (WCAG 2.2).
fn legible(colour: Rgb) -> Rgb {
    // Gamma 2.2 in place of the two pieces of sRGB, and so a little more.
    const HIGHEST: f64 = 0.175;
    let part = |value: u8| (f64::from(value) / 255.0).powf(2.2);
    let [r, g, b] = colour.map(part);
    let luminance = 0.2126 * r + 0.7152 * g + 0.0722 * b;
    let darker = (HIGHEST / luminance.max(HIGHEST)).powf(1.0 / 2.2);
    colour.map(|value| (f64::from(value) * darker) as u8)
}

/// The side of a plot on which an axis stands.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Side {
    Below,
    Left,
    Right,
}

/// An axis: where values lie along a side, and which are written.
#[derive(Debug, Clone)]
pub(crate) struct Axis<'a> {
    /// Values at its left and right, or at its lower and upper end.
    pub(crate) ends: [f64; 2],
    pub(crate) title: &'a str,
    pub(crate) colour: Rgb,
    /// Values with a tick, and what is written there.
    pub(crate) labels: Vec<(f64, String)>,
}

impl<'a> Axis<'a> {
    /// With round numbers between its ends.
    pub(crate) fn linear(ends: [f64; 2], title: &'a str) -> Self {
        let [low, high] = [ends[0].min(ends[1]), ends[0].max(ends[1])];
        let labels = ticks(low, high, 5).into_iter();
        Self {
            ends,
            title,
            colour: INK,
            labels: labels.map(|value| (value, plain(value))).collect(),
        }
    }

    #[must_use]
    pub(crate) fn coloured(self, colour: Rgb) -> Self {
        Self { colour, ..self }
    }

    /// Share of its length at which a value lies.
    pub(crate) fn share(&self, value: f64) -> f64 {
        (value - self.ends[0]) / (self.ends[1] - self.ends[0])
    }
}

/// A colour bar: shares of the range from below.
pub(crate) struct ColourBar<'a> {
    pub(crate) title: &'a str,
    pub(crate) colour: &'a dyn Fn(f64) -> Rgb,
    pub(crate) labels: Vec<(f64, String)>,
    /// Below it.
    pub(crate) note: Option<String>,
}

/// A drawing.
#[derive(Debug, Clone)]
pub(crate) struct Drawing {
    unit: SizeUnit,
    size: [f64; 2],
    /// Size of type; distances are multiples of it.
    font: f64,
    fields: Vec<PixelField>,
    shapes: Vec<Shape>,
    texts: Vec<Text>,
}

impl Drawing {
    pub(crate) fn new(unit: SizeUnit, size: [f64; 2], font: f64) -> Self {
        Self {
            unit,
            size,
            font,
            fields: Vec::new(),
            shapes: Vec::new(),
            texts: Vec::new(),
        }
    }

    /// That and another at its right.
    #[must_use]
    pub(crate) fn beside(mut self, other: Self) -> Self {
        let by = self.size[0];
        self.size = [by + other.size[0], self.size[1].max(other.size[1])];
        self.fields
            .extend(other.fields.into_iter().map(|mut field| {
                field.area.left += by;
                field
            }));
        self.shapes
            .extend(other.shapes.into_iter().map(|mut shape| {
                shape.points.iter_mut().for_each(|[x, _]| *x += by);
                shape
            }));
        self.texts.extend(other.texts.into_iter().map(|mut text| {
            text.at[0] += by;
            text
        }));
        self
    }

    /// Left and right, upper and lower edge of a text.
    fn extent(&self, text: &Text) -> [[f64; 2]; 2] {
        let em = self.font * text.size;
        let long = text_width(&text.words) * em;
        let before = text.anchor.share() * long;
        let [x, y] = text.at;
        // Letters reach .76 above their line and .24 below.
        if text.is_turned {
            [
                [x - 0.76 * em, x + 0.24 * em],
                [y - long + before, y + before],
            ]
        } else {
            [
                [x - before, x - before + long],
                [y - 0.76 * em, y + 0.24 * em],
            ]
        }
    }

    /// Texts of which a part lies outside of the drawing.
    #[cfg(test)]
    pub(crate) fn cut_off(&self) -> Vec<&str> {
        let is_cut = |text: &&Text| {
            let [[left, right], [top, bottom]] = self.extent(text);
            left < 0.0 || right > self.size[0] || top < 0.0 || bottom > self.size[1]
        };
        let cut = self.texts.iter().filter(is_cut);
        cut.map(|text| text.words.as_str()).collect()
    }

    pub(crate) fn font(&self) -> f64 {
        self.font
    }

    pub(crate) fn unit(&self) -> SizeUnit {
        self.unit
    }

    /// Lies below all shapes and texts.
    pub(crate) fn field(&mut self, field: PixelField) {
        self.fields.push(field);
    }

    pub(crate) fn line(&mut self, points: Vec<[f64; 2]>, colour: Rgb, width: f64) {
        let pen = Pen::Line(width);
        self.shapes.push(Shape {
            points,
            colour,
            pen,
        });
    }

    pub(crate) fn fill(&mut self, points: Vec<[f64; 2]>, colour: Rgb) {
        let pen = Pen::Fill;
        self.shapes.push(Shape {
            points,
            colour,
            pen,
        });
    }

    pub(crate) fn fill_rect(&mut self, area: Rect, colour: Rgb) {
        self.fill(area.corners(0.0), colour);
    }

    /// A dot.
    pub(crate) fn dot(&mut self, [x, y]: [f64; 2], radius: f64, colour: Rgb) {
        let round = (0..20).map(|k| std::f64::consts::TAU * f64::from(k) / 20.0);
        let points = round.map(|angle| [x + radius * angle.cos(), y + radius * angle.sin()]);
        self.fill(points.collect(), colour);
    }

    /// Lies above all fields and shapes. What stands after a `_` up to the end of its word is set as an index.
    pub(crate) fn text(&mut self, text: Text) {
        let Some((base, index, rest)) = parted(&text.words) else {
            self.texts.push(text);
            return;
        };
        let size = self.font * text.size;
        let long = |words: &str, share: f64| text_width(words) * share * size;
        let lengths = [long(base, 1.0), long(index, INDEX), long(rest, 1.0)];
        let mut along = -text.anchor.share() * lengths.iter().sum::<f64>();
        for (words, share, long) in [
            (base, 1.0, lengths[0]),
            (index, INDEX, lengths[1]),
            (rest, 1.0, lengths[2]),
        ] {
            let down = if share < 1.0 { INDEX_DOWN * size } else { 0.0 };
            let [x, y] = text.at;
            let at = if text.is_turned {
                [x + down, y - along]
            } else {
                [x + along, y + down]
            };
            along += long;
            if !words.is_empty() {
                self.texts.push(Text {
                    at,
                    words: words.to_owned(),
                    anchor: TextAnchor::Start,
                    size: share * text.size,
                    ..text
                });
            }
        }
    }

    /// White words on a dark plate: on a field of any colour they can be read.
    pub(crate) fn plate(&mut self, text: Text) {
        self.behind(&text, 0.3, PLATE);
        self.text(text.on_field([255; 3]));
    }

    /// Words on white, whatever was there.
    pub(crate) fn cleared(&mut self, text: Text) {
        if !text.words.is_empty() {
            self.behind(&text, 0.15, [255; 3]);
            self.text(text);
        }
    }

    /// A rectangle behind a text, at both its sides wider by so many sizes of type.
    fn behind(&mut self, text: &Text, room: f64, colour: Rgb) {
        let [[left, right], [top, bottom]] = self.extent(text);
        let room = room * self.font;
        let area = Rect {
            left: left - room,
            top,
            wide: right - left + 2.0 * room,
            high: bottom - top,
        };
        self.fill_rect(area, colour);
    }

    /// A line around a plot, outside of it.
    pub(crate) fn frame(&mut self, plot: Rect) {
        let width = self.unit.hairline();
        let mut points = plot.corners(0.5 * width);
        points.push(points[0]);
        self.line(points, INK, width);
    }

    /// Light lines at the labels of both axes.
    pub(crate) fn grid(&mut self, plot: Rect, x: &Axis, y: &Axis) {
        let width = self.unit.hairline();
        for (value, _) in &x.labels {
            let at = self.crisp(plot.at(x.share(*value), 0.0)[0]);
            self.line(vec![[at, plot.bottom()], [at, plot.top]], GRID, width);
        }
        for (value, _) in &y.labels {
            let at = self.crisp(plot.at(0.0, y.share(*value))[1]);
            self.line(vec![[plot.left, at], [plot.right(), at]], GRID, width);
        }
    }

    /// The middle of the pixel.
    fn crisp(&self, at: f64) -> f64 {
        match self.unit {
            SizeUnit::Pixel => at.floor() + 0.5,
            SizeUnit::Point => at,
        }
    }

    /// Ticks, numbers and title of an axis; the title stands at the edge of the drawing.
    pub(crate) fn axis(&mut self, plot: Rect, side: Side, axis: &Axis) {
        let (em, width) = (self.font, self.unit.hairline());
        for (value, label) in &axis.labels {
            let share = axis.share(*value);
            let [x, y] = plot.at(share, share).map(|at| self.crisp(at));
            // They begin in the frame: a line's end reaches half its width farther.
            let out = 0.5 * width;
            let (edge, tick, number, anchor) = match side {
                Side::Below => {
                    let y = plot.bottom();
                    let number = [x, y + 1.5 * em];
                    ([x, y + out], [x, y + 0.4 * em], number, TextAnchor::Middle)
                }
                Side::Left => {
                    let x = plot.left;
                    let number = [x - 0.7 * em, y + 0.35 * em];
                    ([x - out, y], [x - 0.4 * em, y], number, TextAnchor::End)
                }
                Side::Right => {
                    let x = plot.right();
                    let number = [x + 0.7 * em, y + 0.35 * em];
                    ([x + out, y], [x + 0.4 * em, y], number, TextAnchor::Start)
                }
            };
            self.line(vec![edge, tick], INK, width);
            let number = Text::new(number, label).anchored(anchor);
            self.text(number.coloured(axis.colour));
        }
        let [middle_x, middle_y] = plot.at(0.5, 0.5);
        let title = match side {
            Side::Below => Text::new([middle_x, plot.bottom() + 3.0 * em], axis.title),
            Side::Left => Text::new([1.2 * em, middle_y], axis.title).turned(),
            Side::Right => Text::new([self.size[0] - 0.6 * em, middle_y], axis.title).turned(),
        };
        let title = title.anchored(TextAnchor::Middle);
        self.text(title.coloured(axis.colour));
    }

    /// A colour bar at the right of a plot.
    pub(crate) fn colour_bar(&mut self, plot: Rect, bar: ColourBar) {
        const ROWS: u32 = 256;
        let em = self.font;
        let area = Rect {
            left: (plot.right() + em).round(),
            wide: em.round(),
            ..plot
        };
        let shares = (0..ROWS).map(|row| 1.0 - f64::from(row) / f64::from(ROWS - 1));
        self.field(PixelField {
            area,
            pixels: [1, ROWS],
            rgb: shares.flat_map(bar.colour).collect(),
        });
        for (share, label) in bar.labels {
            let [x, y] = area.at(1.0, share);
            self.text(Text::new([x + 0.4 * em, y + 0.35 * em], label));
        }
        self.text(Text::new(
            [area.left - 0.2 * em, area.top - 0.85 * em],
            bar.title,
        ));
        if let Some(note) = bar.note {
            let at = [area.left + 5.6 * em, area.bottom() + 1.5 * em];
            self.text(Text::new(at, note).anchored(TextAnchor::End));
        }
    }
}
