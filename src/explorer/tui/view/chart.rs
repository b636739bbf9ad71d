//! Curves in a rectangle of cells: two by four Braille dots each, or one character without them; in a page lines.
//!
//! Ratatui's `Canvas` and `Chart` have colours only: no weight of a pen and no dashes, by which curves are told apart
//! without colours, and one character for all curves of a layer. With a shape for the dashes a `Canvas` would save 40 lines
//! of 180.

use ratatui::layout::Rect;
use ratatui::style::Style;

use crate::tui::app::App;
use crate::tui::pixels::{PixelCurve, PixelPlot};
use crate::tui::theme::{Role, Theme};
use crate::tui::view::sheet::Sheet;

/// Bit of a dot in a Braille cell, `[row][column]`.
const BITS: [[u8; 2]; 4] = [[0x01, 0x08], [0x02, 0x10], [0x04, 0x20], [0x40, 0x80]];

#[derive(Debug, Clone, Copy, Default)]
struct Cell {
    dots: u8,
    style: Style,
    letter: char,
}

/// Where a figure is drawn, and which values its edges are.
#[derive(Debug, Clone, Copy)]
pub(super) struct PlotFrame {
    pub(super) area: Rect,
    /// Left and right.
    pub(super) x: [f64; 2],
    /// Foot and top.
    pub(super) y: [f64; 2],
}

impl PlotFrame {
    /// The column of the screen for x; `None`: outside.
    pub(super) fn column(&self, x: f64) -> Option<u16> {
        let part = (x - self.x[0]) / (self.x[1] - self.x[0]);
        let cells = (part * f64::from(self.area.width.saturating_sub(1))).round() as u16;
        (0.0..=1.0).contains(&part).then_some(self.area.x + cells)
    }

    /// The row of the figure for y, from above; what lies outside is brought to its edge.
    pub(super) fn row(&self, y: f64) -> u16 {
        let down = 1.0 - (y - self.y[0]) / (self.y[1] - self.y[0]);
        (down.clamp(0.0, 1.0) * f64::from(self.area.height.saturating_sub(1))).round() as u16
    }

    /// Draws a mark at x on a row of the figure, where x is in it.
    pub(super) fn mark(&self, x: f64, row: u16, symbol: &str, role: Role, sheet: &mut Sheet<'_>) {
        if let Some(column) = self.column(x) {
            let style = sheet.theme.style(role);
            sheet.cell(column, self.area.y + row, symbol, style);
        }
    }

    /// x at a column of the screen.
    pub(super) fn x_at(&self, column: u16) -> f64 {
        let last = self.area.width.max(2) - 1;
        let part = f64::from(column.saturating_sub(self.area.x)) / f64::from(last);
        self.x[0] + part * (self.x[1] - self.x[0])
    }
}

/// Curves drawn over each other: a cell takes the colour of the last one that touched it.
#[derive(Debug)]
pub(super) struct CurvePanel {
    area: Rect,
    x: [f64; 2],
    y: [f64; 2],
    cells: Vec<Cell>,
    /// Instead of the cells, where a page draws them.
    curves: Option<Vec<PixelCurve>>,
}

/// How a curve looks.
#[derive(Debug, Clone, Copy)]
pub(super) struct Pen {
    /// Colour and weight.
    style: Style,
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
            style: theme.style(role),
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

impl CurvePanel {
    /// An empty chart with its ranges.
    fn new(area: Rect, x: [f64; 2], y: [f64; 2]) -> Self {
        let cells = vec![Cell::default(); usize::from(area.width) * usize::from(area.height)];
        Self {
            area,
            x,
            y,
            cells,
            curves: None,
        }
    }

    /// The same as the explorer draws it: dots, or a page's lines.
    pub(super) fn of(app: &App, plot: PlotFrame) -> Self {
        Self {
            curves: app.is_in_pixels().then(Vec::new),
            ..Self::new(plot.area, plot.x, plot.y)
        }
    }

    /// A curve through points; one that is not finite breaks it, what lies outside is cut off.
    pub(super) fn line(&mut self, points: impl IntoIterator<Item = (f64, f64)>, pen: Pen) {
        if self.curves.is_some() {
            let points = points.into_iter().map(|(x, y)| self.dot(x, y)).collect();
            self.leave(points, false, pen);
            return;
        }
        let mut last: Option<(f64, f64)> = None;
        for (x, y) in points {
            let here = self.dot(x, y);
            match (last, here) {
                (Some(from), Some(to)) => self.segment(from, to, pen),
                (None, Some(to)) => self.set(to, pen),
                _ => {}
            }
            last = here;
        }
    }

    /// Single dots.
    pub(super) fn scatter(&mut self, points: impl IntoIterator<Item = (f64, f64)>, pen: Pen) {
        if self.curves.is_some() {
            let points = points.into_iter().map(|(x, y)| self.dot(x, y)).collect();
            self.leave(points, true, pen);
            return;
        }
        for (x, y) in points {
            if let Some(place) = self.dot(x, y) {
                self.set(place, pen);
            }
        }
    }

    /// A vertical line of every other dot.
    pub(super) fn upright(&mut self, x: f64, pen: Pen) {
        let Some((column, _)) = self.dot(x, self.y[0]) else {
            return;
        };
        let places = (0..self.rows()).step_by(2).map(|row| (column, row as f64));
        if self.curves.is_some() {
            self.leave(places.map(Some).collect(), true, pen);
            return;
        }
        for place in places {
            self.set(place, pen);
        }
    }

    /// Leaves a curve to the page: from dots to cells.
    fn leave(&mut self, dots: Vec<Option<(f64, f64)>>, is_dotted: bool, pen: Pen) {
        let place = |dot: Option<(f64, f64)>| {
            dot.map_or([f32::NAN; 2], |(column, row)| {
                [0.5 * (column + 0.5), 0.25 * (row + 0.5)].map(|cells| cells as f32)
            })
        };
        let curve = PixelCurve {
            color: pen.style.fg.unwrap_or_default(),
            is_dotted,
            points: dots.into_iter().map(place).collect(),
        };
        self.curves.get_or_insert_default().push(curve);
    }

    /// Draws it, or gives it to the page; cells that no curve touched stay as they are.
    pub(super) fn render(&mut self, sheet: &mut Sheet<'_>) -> Option<PixelPlot> {
        if let Some(curves) = self.curves.take() {
            let area = self.area;
            return Some(PixelPlot { area, curves });
        }
        let ascii = sheet.theme.is_ascii();
        for (place, cell) in self.cells.iter().enumerate() {
            if cell.dots == 0 {
                continue;
            }
            let x = self.area.x + (place % usize::from(self.area.width)) as u16;
            let y = self.area.y + (place / usize::from(self.area.width)) as u16;
            let dots = char::from_u32(0x2800 + u32::from(cell.dots)).filter(|_| !ascii);
            let symbol = dots.unwrap_or(cell.letter);
            sheet.cell(x, y, symbol.encode_utf8(&mut [0; 4]), cell.style);
        }
        None
    }

    fn columns(&self) -> usize {
        usize::from(self.area.width) * 2
    }

    fn rows(&self) -> usize {
        usize::from(self.area.height) * 4
    }

    /// Place in dots; far outside values are kept near, so that a segment to them stays short.
    fn dot(&self, x: f64, y: f64) -> Option<(f64, f64)> {
        let (columns, rows) = (self.columns() as f64, self.rows() as f64);
        let column = (x - self.x[0]) / (self.x[1] - self.x[0]) * (columns - 1.0);
        let row = (1.0 - (y - self.y[0]) / (self.y[1] - self.y[0])) * (rows - 1.0);
        (column.is_finite() && row.is_finite()).then(|| {
            (
                column.clamp(-columns, 2.0 * columns),
                row.clamp(-rows, 2.0 * rows),
            )
        })
    }

    fn segment(&mut self, from: (f64, f64), to: (f64, f64), pen: Pen) {
        let length = (to.0 - from.0).abs().max((to.1 - from.1).abs());
        let steps = length.ceil().max(1.0);
        for step in 0..=steps as usize {
            let part = step as f64 / steps;
            let place = (
                from.0 + (to.0 - from.0) * part,
                from.1 + (to.1 - from.1) * part,
            );
            self.set(place, pen);
        }
    }

    fn set(&mut self, (column, row): (f64, f64), pen: Pen) {
        let (column, row) = (column.round(), row.round());
        let outside = column < 0.0
            || row < 0.0
            || column >= self.columns() as f64
            || row >= self.rows() as f64;
        if outside {
            return;
        }
        let (column, row) = (column as usize, row as usize);
        if !pen.draws(column, row) {
            return;
        }
        let place = row / 4 * usize::from(self.area.width) + column / 2;
        if let Some(cell) = self.cells.get_mut(place) {
            cell.dots |= BITS[row % 4][column % 2];
            cell.style = pen.style;
            cell.letter = pen.letter;
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::tui::theme::{Capabilities, ColorDepth, Glyphs};
    use ratatui::buffer::Buffer;

    fn drawn(chart: &mut CurvePanel, ascii: bool) -> Vec<String> {
        let mut buffer = Buffer::empty(chart.area);
        let glyphs = if ascii {
            Glyphs::Ascii
        } else {
            Glyphs::Unicode
        };
        let theme = Theme::new(Capabilities {
            depth: ColorDepth::Mono,
            glyphs,
        });
        chart.render(&mut Sheet {
            theme,
            buffer: &mut buffer,
        });
        (0..chart.area.height)
            .map(|y| {
                (0..chart.area.width)
                    .map(|x| buffer[(x, y)].symbol().to_owned())
                    .collect()
            })
            .collect()
    }

    fn pen() -> Pen {
        Pen {
            style: Style::new(),
            letter: '*',
            dash: Dash::Solid,
        }
    }

    #[test]
    fn without_colours_curves_differ_by_their_dashes() {
        let dots = |dash: Dash| {
            let mut chart = CurvePanel::new(Rect::new(0, 0, 40, 1), [0.0, 1.0], [0.0, 1.0]);
            chart.line([(0.0, 0.5), (1.0, 0.5)], Pen { dash, ..pen() });
            let dots = chart.cells.iter().map(|cell| cell.dots.count_ones());
            dots.sum::<u32>()
        };
        assert_eq!(
            [Dash::Solid, Dash::Dashed, Dash::Dotted].map(dots),
            [80, 40, 27]
        );
    }

    #[test]
    fn corners_are_the_outermost_dots() {
        let mut chart = CurvePanel::new(Rect::new(0, 0, 2, 2), [0.0, 1.0], [0.0, 1.0]);
        chart.scatter([(0.0, 0.0), (1.0, 1.0)], pen());
        assert_eq!(drawn(&mut chart, false), [" ⠈", "⡀ "]);
        assert_eq!(drawn(&mut chart, true), [" *", "* "]);
    }

    #[test]
    fn what_is_outside_or_no_number_draws_nothing() {
        let mut chart = CurvePanel::new(Rect::new(0, 0, 3, 1), [0.0, 1.0], [0.0, 1.0]);
        chart.line([(f64::NAN, 0.0), (0.5, f64::INFINITY), (5.0, 7.0)], pen());
        assert_eq!(drawn(&mut chart, true), ["   "]);
        // A curve that leaves is drawn up to the edge.
        chart.line([(0.0, 0.0), (0.0, 1e30)], pen());
        assert_eq!(drawn(&mut chart, true), ["*  "]);
    }

    #[test]
    fn an_empty_area_or_range_is_no_fault() {
        let mut chart = CurvePanel::new(Rect::new(0, 0, 0, 0), [0.0, 0.0], [1.0, 1.0]);
        chart.line([(0.0, 1.0), (2.0, 3.0)], pen());
        chart.upright(0.0, pen());
        assert!(drawn(&mut chart, false).is_empty());
    }
}
