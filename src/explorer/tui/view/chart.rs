//! Curves over ranges of x and y, with the numbers at their edges: ratatui's `Canvas` in Braille dots, or in one character a
//! curve without them; in a page lines.

use ratatui::buffer::Buffer;
use ratatui::layout::{Position, Rect};
use ratatui::style::{Color, Style};
use ratatui::symbols::Marker;
use ratatui::widgets::Widget;
use ratatui::widgets::canvas::{Canvas, Painter, Shape};

use crate::tui::app::{App, Zoom};
use crate::tui::pixels::{PixelCurve, PixelPlot};
use crate::tui::theme::{Role, Theme};
use crate::tui::units::tick;
use crate::tui::view::place::put_right;
use asperity_engine::math::number::ticks;
use asperity_engine::sim::Frame;
use asperity_picture::profile::SurfaceProfile;

/// A rectangle of cells, and the values at the middles of its outermost ones.
#[derive(Debug, Clone, Copy)]
pub(super) struct Plot {
    pub(super) area: Rect,
    /// Left and right.
    pub(super) x: [f64; 2],
    /// Bottom and top.
    pub(super) y: [f64; 2],
}

/// Part of a range, 0 to 1.
fn part(value: f64, [from, to]: [f64; 2]) -> f64 {
    (value - from) / (to - from)
}

impl Plot {
    /// The column of the screen for x; `None` outside.
    pub(super) fn column(&self, x: f64) -> Option<u16> {
        let part = part(x, self.x);
        let last = f64::from(self.area.width.saturating_sub(1));
        // A rounding beyond its end is its end.
        let inside = (-1e-9..=1.0 + 1e-9).contains(&part) && self.area.width > 0;
        inside.then(|| self.area.x + (part * last).round() as u16)
    }

    /// The row of the screen for y; what lies outside stays at the edge.
    pub(super) fn row(&self, y: f64) -> u16 {
        let last = f64::from(self.area.height.saturating_sub(1));
        let down = 1.0 - part(y, self.y);
        self.area.y + (down.clamp(0.0, 1.0) * last).round() as u16
    }

    /// x at a column of the screen.
    pub(super) fn x_at(&self, column: u16) -> f64 {
        let last = f64::from(self.area.width.max(2) - 1);
        let part = f64::from(column.saturating_sub(self.area.x)) / last;
        self.x[0] + part * (self.x[1] - self.x[0])
    }

    /// Draws a mark at a place, where that is in the plot.
    pub(super) fn mark(&self, x: f64, y: f64, symbol: Symbol, buffer: &mut Buffer) {
        let inside = (0.0..=1.0).contains(&part(y, self.y)) && !self.area.is_empty();
        if let Some(column) = self.column(x).filter(|_| inside) {
            symbol.draw((column, self.row(y)), buffer);
        }
    }

    /// Its upper and lower end at the left, and under the upper one what is measured, where there is room.
    pub(super) fn y_ends(&self, theme: Theme, ends: &[String; 2], unit: &str, buffer: &mut Buffer) {
        /// Columns of the numbers.
        const NUMBERS: u16 = 5;
        let left = Rect {
            x: self.area.x.saturating_sub(NUMBERS + 1),
            width: NUMBERS,
            ..self.area
        };
        let last = self.area.height.saturating_sub(1);
        put_right(left, 0, &theme.line(&ends[1], Role::Dim), buffer);
        put_right(left, last, &theme.line(&ends[0], Role::Dim), buffer);
        if self.area.height >= 4 {
            put_right(left, 1, &theme.line(unit, Role::Dim), buffer);
        }
    }

    /// Round numbers of half-widths in a row below it.
    pub(super) fn half_widths(&self, theme: Theme, row: u16, buffer: &mut Buffer) {
        let mut free_from = self.area.x;
        let about = usize::from(self.area.width / 8).max(2);
        for x in ticks(self.x[0], self.x[1], about) {
            let text = match tick(x).as_str() {
                "0" => "0".to_owned(),
                number => format!("{number}a"),
            };
            let width = text.len() as u16;
            let Some(centre) = self.column(x) else {
                continue;
            };
            let first = centre.saturating_sub(width / 2).max(self.area.x);
            let first = first.min(self.area.right().saturating_sub(width));
            if first >= free_from {
                buffer.set_line(first, row, &theme.line(text, Role::Dim), width);
                free_from = first + width + 1;
            }
        }
    }
}

/// The part of a frame's x/a that is drawn: around the contact, or all of it.
pub(super) fn zoomed(app: &App, frame: &Frame, [from, to]: [f64; 2]) -> [f64; 2] {
    let domain = SurfaceProfile::domain(frame);
    match app.view.zoom {
        Zoom::Contact => [domain[0].max(from), domain[1].min(to)],
        Zoom::Domain => domain,
    }
}

/// One character on the screen.
#[derive(Debug, Clone, Copy)]
pub(super) struct Symbol {
    symbol: &'static str,
    pub(super) style: Style,
}

impl Symbol {
    /// `unicode`, or `ascii` where only that may be drawn, in the look of a role.
    pub(super) fn new(
        theme: Theme,
        unicode: &'static str,
        ascii: &'static str,
        role: Role,
    ) -> Self {
        let (symbol, style) = (theme.pick(unicode, ascii), theme.style(role));
        Self { symbol, style }
    }

    /// Draws it into a cell, where that is on the screen.
    pub(super) fn draw(self, at: impl Into<Position>, buffer: &mut Buffer) {
        if let Some(cell) = buffer.cell_mut(at) {
            cell.set_symbol(self.symbol).set_style(self.style);
        }
    }
}

/// How a curve looks.
#[derive(Debug, Clone, Copy)]
pub(super) struct Pen {
    color: Color,
    /// Character where there is no Braille.
    letter: char,
    dash: Dash,
}

/// Which dots of a curve are drawn: without colours curves are told apart by it.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Dash {
    Solid,
    /// Four dots, four left out.
    Dashed,
    /// One dot in three.
    Dotted,
}

impl Pen {
    /// The pen for a role.
    pub(super) fn new(theme: Theme, role: Role, letter: char) -> Self {
        let dash = match role {
            Role::Film | Role::Formula if theme.is_mono() => Dash::Dashed,
            Role::Border | Role::Hertz if theme.is_mono() => Dash::Dotted,
            _ => Dash::Solid,
        };
        Self {
            color: theme.style(role).fg.unwrap_or_default(),
            letter,
            dash,
        }
    }

    fn draws(self, column: usize, row: usize) -> bool {
        match self.dash {
            Dash::Solid => true,
            Dash::Dashed => (column + row) % 8 < 4,
            Dash::Dotted => (column + row).is_multiple_of(3),
        }
    }
}

/// Points of one pen.
#[derive(Debug)]
struct Curve {
    /// Parts of the plot from the left and from below; not finite: the curve breaks.
    points: Vec<[f64; 2]>,
    pen: Pen,
    is_dotted: bool,
    /// Dots of the plot along and down.
    dots: [f64; 2],
}

/// Curves drawn over each other: a cell takes the colour of the last one that passes through it.
#[derive(Debug)]
pub(super) struct CurvePanel {
    plot: Plot,
    curves: Vec<Curve>,
}

impl CurvePanel {
    /// A plot without curves.
    pub(super) fn new(plot: Plot) -> Self {
        let curves = Vec::new();
        Self { plot, curves }
    }

    /// A curve through points; one that is not finite breaks it, what lies outside is cut off.
    pub(super) fn line(&mut self, points: impl IntoIterator<Item = (f64, f64)>, pen: Pen) {
        self.add(points, pen, false);
    }

    /// Single dots.
    pub(super) fn scatter(&mut self, points: impl IntoIterator<Item = (f64, f64)>, pen: Pen) {
        self.add(points, pen, true);
    }

    /// A vertical line of every other dot.
    pub(super) fn upright(&mut self, x: f64, pen: Pen) {
        let rows = 4 * self.plot.area.height;
        let [from, to] = self.plot.y;
        let y = |row: u16| to + (from - to) * f64::from(row) / f64::from(rows - 1);
        self.scatter((0..rows).step_by(2).map(|row| (x, y(row))), pen);
    }

    /// Hertz's pressure over x/a on y = 0, `p_hertz √(1 − x²)`, in dots.
    pub(super) fn hertz(&mut self, p_hertz: f64, pen: Pen) {
        let [from, to] = self.plot.x;
        let fine = 2 * self.plot.area.width;
        let x = move |i: u16| from + (to - from) * f64::from(i) / f64::from(fine);
        let inside = (0..=fine).map(x).filter(|x| x.abs() < 1.0);
        self.scatter(inside.map(|x| (x, p_hertz * (1.0 - x * x).sqrt())), pen);
    }

    fn add(&mut self, points: impl IntoIterator<Item = (f64, f64)>, pen: Pen, is_dotted: bool) {
        let Plot { area, x, y } = self.plot;
        // Far outside values are kept near, so that a segment to them stays short.
        let part = |value: f64, range: [f64; 2]| match part(value, range) {
            part if part.is_finite() => part.clamp(-1.0, 2.0),
            _ => f64::NAN,
        };
        let points = points.into_iter();
        self.curves.push(Curve {
            points: points.map(|at| [part(at.0, x), part(at.1, y)]).collect(),
            pen,
            is_dotted,
            dots: [2 * area.width, 4 * area.height].map(f64::from),
        });
    }

    /// Draws the curves, or leaves them to the page; cells that no curve passes through stay as they are.
    pub(super) fn render(&self, app: &App, buffer: &mut Buffer) -> Option<PixelPlot> {
        let area = self.plot.area;
        if app.is_in_pixels() {
            let curves = self.curves.iter().map(Curve::in_pixels).collect();
            return Some(PixelPlot { area, curves });
        }
        self.draw(app.view.theme.is_ascii(), buffer);
        None
    }

    fn draw(&self, is_ascii: bool, buffer: &mut Buffer) {
        let curves = Canvas::default()
            .x_bounds([0.0, 1.0])
            .y_bounds([0.0, 1.0])
            .paint(|context| {
                for curve in &self.curves {
                    if is_ascii {
                        context.marker(Marker::Custom(curve.pen.letter));
                    }
                    context.draw(curve);
                }
            });
        curves.render(self.plot.area, buffer);
    }
}

impl Curve {
    /// In cells from the left upper corner.
    fn in_pixels(&self) -> PixelCurve {
        let [columns, rows] = self.dots;
        let place = |&[along, up]: &[f64; 2]| {
            let cells = [
                0.5 * (along * (columns - 1.0) + 0.5),
                0.25 * ((1.0 - up) * (rows - 1.0) + 0.5),
            ];
            cells.map(|cells| cells as f32)
        };
        PixelCurve {
            color: self.pen.color,
            is_dotted: self.is_dotted,
            points: self.points.iter().map(place).collect(),
        }
    }

    fn dot(&self, painter: &mut Painter<'_, '_>, at: [f64; 2]) {
        // Up to half a dot outside is on the edge.
        let is_near = |part: f64, dots: f64| (part - 0.5).abs() < 0.5 + 0.5 / (dots - 1.0).max(1.0);
        let [along, up] = at;
        if !is_near(along, self.dots[0]) || !is_near(up, self.dots[1]) {
            return;
        }
        let place = painter.get_point(along.clamp(0.0, 1.0), up.clamp(0.0, 1.0));
        if let Some((column, row)) = place.filter(|&(column, row)| self.pen.draws(column, row)) {
            painter.paint(column, row, self.pen.color);
        }
    }
}

impl Shape for Curve {
    fn draw(&self, painter: &mut Painter<'_, '_>) {
        let mut last: Option<[f64; 2]> = None;
        for &to in &self.points {
            if !to.iter().all(|part| part.is_finite()) {
                last = None;
                continue;
            }
            let from = last.filter(|_| !self.is_dotted).unwrap_or(to);
            let away = |k: usize| (to[k] - from[k]).abs() * (self.dots[k] - 1.0);
            let steps = away(0).max(away(1)).ceil().max(1.0);
            for step in 0..=steps as usize {
                let part = step as f64 / steps;
                let between = |k: usize| from[k] + (to[k] - from[k]) * part;
                self.dot(painter, [between(0), between(1)]);
            }
            last = Some(to);
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn panel(width: u16, height: u16) -> CurvePanel {
        CurvePanel::new(Plot {
            area: Rect::new(0, 0, width, height),
            x: [0.0, 1.0],
            y: [0.0, 1.0],
        })
    }

    fn drawn(chart: &CurvePanel, is_ascii: bool) -> Vec<String> {
        let mut buffer = Buffer::empty(chart.plot.area);
        chart.draw(is_ascii, &mut buffer);
        let row = |y| (0..chart.plot.area.width).map(move |x| (x, y));
        (0..chart.plot.area.height)
            .map(|y| row(y).map(|at| buffer[at].symbol()).collect())
            .collect()
    }

    fn pen(dash: Dash) -> Pen {
        Pen {
            color: Color::Reset,
            letter: '*',
            dash,
        }
    }

    #[test]
    fn without_colours_curves_differ_by_their_dashes() {
        let dots = |dash: Dash| -> u32 {
            let mut chart = panel(40, 1);
            chart.line([(0.0, 0.5), (1.0, 0.5)], pen(dash));
            let letters = drawn(&chart, false).concat();
            let bits = letters.chars().map(|letter| letter as u32);
            bits.filter(|bits| *bits >= 0x2800)
                .map(|bits| (bits - 0x2800).count_ones())
                .sum()
        };
        assert_eq!(
            [Dash::Solid, Dash::Dashed, Dash::Dotted].map(dots),
            [80, 40, 27]
        );
    }

    #[test]
    fn corners_are_the_outermost_dots() {
        let mut chart = panel(2, 2);
        chart.scatter([(0.0, 0.0), (1.0, 1.0)], pen(Dash::Solid));
        assert_eq!(drawn(&chart, false), [" ⠈", "⡀ "]);
        assert_eq!(drawn(&chart, true), [" *", "* "]);
    }

    #[test]
    fn what_is_outside_or_no_number_draws_nothing() {
        let mut chart = panel(3, 1);
        let outside = [(f64::NAN, 0.0), (0.5, f64::NAN), (5.0, 7.0)];
        chart.line(outside, pen(Dash::Solid));
        assert_eq!(drawn(&chart, true), ["   "]);
        // A curve that leaves is drawn up to the edge.
        chart.line([(0.0, 0.0), (0.0, 1e30)], pen(Dash::Solid));
        assert_eq!(drawn(&chart, true), ["*  "]);
    }

    #[test]
    fn an_empty_area_or_range_is_no_fault() {
        let mut chart = panel(0, 0);
        chart.plot.x = [0.0, 0.0];
        chart.line([(0.0, 1.0), (2.0, 3.0)], pen(Dash::Solid));
        chart.upright(0.0, pen(Dash::Solid));
        assert!(drawn(&chart, false).is_empty());
    }
}
