//! Axes, ticks, titles and colour legends of the two-dimensional views.
//!
//! The viewer draws none of these, so they are lines and labels in the same view. The vertical axis
//! of a view points down.

use rerun::components::LineStrip2D;
use rerun::{Color, LineStrips2D, Points2D, Radius};

use super::colour::{GREY, WHITE, faded};
use super::geometry::Geometry;
use super::stream::{Holds, Stream};
use asperity_engine::math::number::{self, MM, plain, sig};
use asperity_engine::scene::ContactKind;
use asperity_engine::sim::Frame;

/// Upper edge of titles above a plot, as a share of its height: clear of the label of a tick at its top, which begins at
/// [`HALF_LABEL`], also where a plot is only 170 points high and text takes 17.
pub(crate) const TITLES: f64 = 0.15;
/// Half the height of a label: it stands so far above its tick.
pub(crate) const HALF_LABEL: f64 = 0.022;

/// A tick: where, in units of the view, and its text.
pub(crate) type AxisTick = (f64, String);

/// A stroke of a frame.
struct Stroke {
    strip: Vec<[f64; 2]>,
    /// `None`: the frame's own.
    colour: Option<[u8; 3]>,
    /// Points of the screen.
    radius: f32,
}

/// The frame of a plot.
#[derive(Debug, Clone, Default, PartialEq)]
pub(crate) struct PlotBox {
    /// Left and right edge.
    pub(crate) x: [f64; 2],
    /// Upper and lower edge (y points down).
    pub(crate) y: [f64; 2],
    pub(crate) x_ticks: Vec<AxisTick>,
    pub(crate) left_ticks: Vec<AxisTick>,
    pub(crate) right_ticks: Vec<AxisTick>,
    /// Below the horizontal ticks.
    pub(crate) x_title: String,
    /// Above the frame, each centred at a share of its width; of a curve with its colour over it.
    pub(crate) titles: Vec<(f64, String, Option<[u8; 3]>)>,
    /// Of the curve whose axis the edge is.
    pub(crate) left_colour: Option<[u8; 3]>,
    /// The same at the right.
    pub(crate) right_colour: Option<[u8; 3]>,
}

impl PlotBox {
    fn width(&self) -> f64 {
        self.x[1] - self.x[0]
    }

    fn height(&self) -> f64 {
        self.y[1] - self.y[0]
    }

    /// What text beside the frame takes its room of: the width, in a narrow picture more, because text keeps its size.
    pub(crate) fn beside(&self) -> f64 {
        self.width().max(0.7 * self.height())
    }

    /// What the view must show: the frame with its ticks and, on request, a legend at the right.
    pub(crate) fn bounds(&self, right: Margin) -> [[f64; 2]; 2] {
        let (w, h) = (self.width(), self.height());
        let right = match right {
            Margin::Plain => 0.05,
            Margin::Ticks => 0.15,
            Margin::Legend => 0.26,
        };
        [
            [
                self.x[0] - 0.14 * self.beside(),
                self.x[1] + right * self.beside(),
            ],
            // Text keeps its size, so that a flat plot needs a larger share of its height for it.
            [
                self.y[0] - (TITLES + 0.025) * h,
                self.y[1] + if h < 0.65 * w { 0.35 } else { 0.26 } * h,
            ],
        ]
    }

    /// Of a plane below the surface: x as the nodes have it, depth down with the ticks that a height is given.
    pub(crate) fn below_surface(g: Geometry, ticks: impl FnOnce(f64) -> Vec<AxisTick>) -> Self {
        /// Height of the picture over its width.
        const HEIGHT: f64 = 0.72;
        let x = [g.x_min - 0.5 * g.dx, g.x_max() + 0.5 * g.dx];
        let height = HEIGHT * (x[1] - x[0]);
        Self {
            x,
            y: [0.0, height],
            x_ticks: ticks_at(&number::ticks(x[0], x[1], 5), |x| x),
            left_ticks: ticks(height),
            x_title: "x, mm".into(),
            titles: vec![(0.13, "depth z, µm".into(), None)],
            ..Self::default()
        }
    }

    /// Where a place lies in it, its depth as a share of the height; `None` beside it.
    pub(crate) fn at_depth(&self, x_m: f64, share: f64) -> Option<[f32; 2]> {
        let (x, [left, right]) = (x_m * MM, self.x);
        let inside = (left..=right).contains(&x);
        inside.then_some([x as f32, (self.y[1] * share) as f32])
    }

    /// Draws the frame, for good or until the next.
    pub(crate) fn log(&self, stream: &Stream, entity: &str, holds: Holds) {
        let (lines, labels) = self.drawn();
        stream.log_for(holds, &format!("{entity}/frame"), &lines);
        labels.log(stream, &format!("{entity}/labels"), holds);
    }

    /// The frame, and what is written beside it.
    pub(crate) fn drawn(&self) -> (LineStrips2D, Labels) {
        let (lines, labels) = (self.lines(), self.texts());
        let strips = lines.iter().map(|stroke| points(&stroke.strip));
        // Where no curve has its colour here, one look for all, which weighs less.
        let is_plain = lines.iter().all(|stroke| stroke.colour.is_none());
        let looks = if is_plain { &lines[..1] } else { &lines[..] };
        let colours = looks.iter().map(|stroke| stroke.colour.unwrap_or(GREY));
        let colours = colours.map(|colour| faded(colour, u8::MAX));
        let radii = looks
            .iter()
            .map(|stroke| Radius::new_ui_points(stroke.radius));
        let drawn = LineStrips2D::new(strips)
            .with_colors(colours)
            .with_radii(radii)
            .with_draw_order(20.0);
        (drawn, labels)
    }

    /// Where its titles stand.
    fn title_places(&self) -> impl Iterator<Item = [f64; 2]> {
        let (w, h, left, top) = (self.width(), self.height(), self.x[0], self.y[0]);
        let aside = 0.1 * (self.beside() - w);
        let shares = self.titles.iter().map(|(share, ..)| share);
        shares.map(move |share| [left + share * w - aside, top - TITLES * h])
    }

    /// Frame and ticks, edges in the colour of what they measure, and the colours of titles over them.
    fn lines(&self) -> Vec<Stroke> {
        const THIN: f32 = 0.75;
        const THICK: f32 = 1.5;
        let (w, h) = (self.width(), self.height());
        let ([left, right], [top, bottom]) = (self.x, self.y);
        let tick = 0.015 * w.min(h).abs();
        let stroke = |from: [f64; 2], to: [f64; 2], colour, radius| Stroke {
            strip: vec![from, to],
            colour,
            radius,
        };
        let edge = |x: f64, colour: Option<[u8; 3]>| {
            let radius = if colour.is_some() { THICK } else { THIN };
            stroke([x, top], [x, bottom], colour, radius)
        };
        let mut lines: Vec<_> = [top, bottom]
            .map(|y| stroke([left, y], [right, y], None, THIN))
            .into();
        lines.extend([edge(left, self.left_colour), edge(right, self.right_colour)]);
        let below = self.x_ticks.iter();
        lines.extend(below.map(|(x, _)| stroke([*x, bottom], [*x, bottom + tick], None, THIN)));
        let at_left = self.left_ticks.iter();
        lines.extend(
            at_left.map(|(y, _)| stroke([left - tick, *y], [left, *y], self.left_colour, THIN)),
        );
        let at_right = self.right_ticks.iter();
        lines.extend(
            at_right.map(|(y, _)| stroke([right, *y], [right + tick, *y], self.right_colour, THIN)),
        );
        let half = 0.03 * self.beside();
        let titles = self.titles.iter().zip(self.title_places());
        lines.extend(titles.filter_map(|((.., colour), [x, y])| {
            (*colour).map(|colour| stroke([x - half, y], [x + half, y], Some(colour), THICK))
        }));
        lines
    }

    fn texts(&self) -> Labels {
        let (w, h) = (self.width(), self.height());
        let ([left, right], bottom) = (self.x, self.y[1]);
        let beside = self.beside();
        let mut labels = Labels::default();
        for (x, text) in &self.x_ticks {
            labels.add([*x, bottom + 0.02 * h], text);
        }
        for (y, text) in &self.left_ticks {
            labels.add([left - 0.07 * beside, y - HALF_LABEL * h], text);
        }
        for (y, text) in &self.right_ticks {
            labels.add([right + 0.07 * beside, y - HALF_LABEL * h], text);
        }
        let under = bottom + if h < 0.65 * w { 0.17 } else { 0.125 } * h;
        labels.add([0.5 * (left + right), under], &self.x_title);
        for ((_, title, _), at) in self.titles.iter().zip(self.title_places()) {
            labels.add(at, title);
        }
        labels
    }
}

/// What is drawn at the right of a plot.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Margin {
    /// Nothing.
    Plain,
    /// Ticks.
    Ticks,
    /// A colour legend.
    Legend,
}

/// Texts at places.
#[derive(Debug, Default)]
pub(crate) struct Labels {
    at: Vec<[f32; 2]>,
    texts: Vec<String>,
}

impl Labels {
    /// A text whose upper edge is centred at a place; nothing for an empty text.
    pub(crate) fn add(&mut self, at: [f64; 2], text: &str) {
        if !text.is_empty() {
            self.at.push([at[0] as f32, at[1] as f32]);
            self.texts.push(text.to_owned());
        }
    }

    /// For good or until the next.
    pub(crate) fn log(&self, stream: &Stream, entity: &str, holds: Holds) {
        stream.log_for(holds, entity, &self.drawn());
    }

    /// As the library has it.
    pub(crate) fn drawn(&self) -> Points2D {
        Points2D::new(self.at.iter().copied())
            .with_radii([Radius::new_scene_units(0.0)])
            .with_colors([Color::from(WHITE)])
            .with_labels(self.texts.iter().map(String::as_str))
            .with_show_labels(true)
            .with_draw_order(30.0)
    }
}

/// Where Hertz's contact is at the load of now. Logged when it has changed.
#[derive(Debug, Default)]
pub(crate) struct HertzCurve {
    shown_m: Option<[f64; 2]>,
}

impl HertzCurve {
    /// Whether the half-widths are others than last time.
    fn changes(&mut self, frame: &Frame) -> bool {
        let now = Some([frame.a_m, frame.b_m]);
        std::mem::replace(&mut self.shown_m, now) != now
    }

    /// From above: an ellipse, or the two edges of a line.
    pub(crate) fn log_ring(&mut self, stream: &Stream, entity: &str, frame: &Frame) {
        if !self.changes(frame) {
            return;
        }
        let (a, b) = (frame.a_m * MM, frame.b_m * MM);
        // Of a line a stretch that lies inside of every picture, those of a part of the domain too.
        let high = 1.2 * b;
        let strips: Vec<Vec<[f64; 2]>> = match frame.kind {
            ContactKind::Point => vec![
                (0..=96)
                    .map(|k| {
                        let angle = std::f64::consts::TAU * f64::from(k) / 96.0;
                        [a * angle.cos(), b * angle.sin()]
                    })
                    .collect(),
            ],
            ContactKind::Line => vec![vec![[-a, -high], [-a, high]], vec![[a, -high], [a, high]]],
        };
        stream.log_for(Holds::FromNow, entity, &edges(&strips));
    }

    /// In a section whose surface is the upper edge of a plot: both edges, and the half-width in figures.
    pub(crate) fn log_width(
        &mut self,
        stream: &Stream,
        entity: &str,
        plot: &PlotBox,
        frame: &Frame,
    ) {
        if !self.changes(frame) {
            return;
        }
        let (a, top) = (frame.a_m * MM, plot.y[0]);
        let end = top + 0.04 * plot.height();
        let strips = [-a, a].map(|x| vec![[x, top], [x, end]]);
        stream.log_for(Holds::FromNow, entity, &edges(&strips));
        let mut label = Labels::default();
        let at = [0.5 * (plot.x[0] + plot.x[1]), top - TITLES * plot.height()];
        label.add(at, &format!("a = {} µm", sig(frame.a_m * 1e6, 4)));
        label.log(stream, &format!("{entity}/label"), Holds::FromNow);
    }
}

fn edges(strips: &[Vec<[f64; 2]>]) -> LineStrips2D {
    LineStrips2D::new(strips.iter().map(|strip| points(strip)))
        .with_colors([faded(WHITE, 150)])
        .with_radii([Radius::new_ui_points(0.75)])
        .with_draw_order(15.0)
}

/// How a point that moves looks: its colour and how many points its radius has.
pub(crate) fn dot(colour: [u8; 3], radius: f32) -> Points2D {
    Points2D::update_fields()
        .with_radii([Radius::new_ui_points(radius)])
        .with_colors([faded(colour, u8::MAX)])
        .with_draw_order(26.0)
}

/// How a curve looks: its colour and how many points its radius has.
pub(crate) fn line(colour: [u8; 3], radius: f32) -> LineStrips2D {
    LineStrips2D::update_fields()
        .with_colors([faded(colour, u8::MAX)])
        .with_radii([Radius::new_ui_points(radius)])
        .with_draw_order(12.0)
}

/// Curves that are drawn point by point.
#[derive(Debug, Default)]
pub(crate) struct Strips {
    finished: Vec<Vec<[f32; 2]>>,
    drawn: Vec<[f32; 2]>,
}

impl Strips {
    /// A single curve.
    pub(crate) fn of(curve: &[[f32; 2]]) -> Self {
        Self {
            finished: Vec::new(),
            drawn: curve.to_vec(),
        }
    }

    /// Goes on to a point.
    pub(crate) fn to(&mut self, at: [f32; 2]) {
        self.drawn.push(at);
    }

    /// Ends a curve; a single point is none.
    pub(crate) fn lift(&mut self) {
        let drawn = std::mem::take(&mut self.drawn);
        if drawn.len() > 1 {
            self.finished.push(drawn);
        }
    }

    /// Logs them: they take the place of those before.
    pub(crate) fn log(mut self, stream: &Stream, entity: &str) {
        self.lift();
        let strips = self.finished.into_iter().map(LineStrip2D::from_iter);
        stream.log(entity, &LineStrips2D::update_fields().with_strips(strips));
    }
}

/// The viewer's single-precision points.
pub(crate) fn points(strip: &[[f64; 2]]) -> Vec<[f32; 2]> {
    strip
        .iter()
        .map(|at| at.map(|value| value as f32))
        .collect()
}

/// Ticks at round values; `place` says where in the view a value lies.
pub(crate) fn ticks_at(values: &[f64], place: impl Fn(f64) -> f64) -> Vec<AxisTick> {
    values
        .iter()
        .map(|&value| (place(value), plain(value)))
        .collect()
}
