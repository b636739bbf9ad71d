//! Right, below: a curve along S or the speed with the operating point on it, and the history of the estimate.

mod along;
mod history;

use ratatui::layout::{Position, Rect};
use ratatui::text::Line;

use crate::tui::action::Action;
use crate::tui::app::App;
use crate::tui::pixels::PixelPlot;
use crate::tui::theme::Role;
use crate::tui::view::chart::{CurvePanel, Pen, PlotFrame};
use crate::tui::view::sheet::{Sheet, with_columns, with_rows};

/// Rows from which a curve can be read, with its heading and its axis.
const CURVE_ROWS: u16 = 7;
/// Columns of the numbers left of it.
const AXIS: u16 = 5;

/// x, y, and between which y it may lie.
type Place = (f64, f64, Option<[f64; 2]>);

/// A curve with its axes; places in the units of the axes.
struct CurveFigure {
    name: &'static str,
    /// What a formula says; empty: there is none.
    formula: Vec<(f64, f64)>,
    /// What was simulated, with the ends of its band.
    points: Vec<Place>,
    /// Where the knob is.
    knob: f64,
    /// The number that leads now.
    now: Option<f64>,
    x: [f64; 2],
    y: [f64; 2],
    /// Numbers at the lower and upper end of y.
    y_ends: [String; 2],
    /// Words left, in the middle and right below the axis.
    foot: [String; 3],
}

impl CurveFigure {
    fn on(&self, area: Rect) -> PlotFrame {
        PlotFrame {
            area,
            x: self.x,
            y: self.y,
        }
    }

    /// Draws a mark on a place, where that is in the plot.
    fn spot(&self, plot: Rect, x: f64, y: f64, symbol: &str, role: Role, sheet: &mut Sheet<'_>) {
        if !plot.is_empty() && (self.y[0]..=self.y[1]).contains(&y) {
            let plot = self.on(plot);
            plot.mark(x, plot.row(y), symbol, role, sheet);
        }
    }
}

/// A press on a plot along S, or along the speed, puts that knob there.
pub(super) fn pressed(app: &App, plot: Rect, at: Position) -> Option<Action> {
    let figure = along::figure(app);
    let x = figure.on(plot).x_at(at.x);
    plot.contains(at).then(|| along::goes_to(app, x))
}

/// Draws what there is room for; says where the curve's plot is, and what it leaves to a page.
pub(super) fn render(
    app: &App,
    area: Rect,
    sheet: &mut Sheet<'_>,
) -> (Option<Rect>, Vec<PixelPlot>) {
    let below = |rows: u16, from: u16| with_rows(area, area.y + from, rows);
    let figure = || along::figure(app);
    if area.height >= CURVE_ROWS + 5 {
        let rows = (area.height / 3).clamp(4, 8);
        let curve = area.height - rows - 1;
        let history = history::render(app, below(rows, 1 + curve), sheet);
        let (plot, curve) = draw(app, &figure(), below(curve, 1), sheet);
        (Some(plot), history.into_iter().chain(curve).collect())
    } else if area.height > CURVE_ROWS {
        let (plot, curve) = draw(app, &figure(), below(area.height - 1, 1), sheet);
        (Some(plot), curve.into_iter().collect())
    } else if area.height >= 2 {
        let history = history::render(app, area, sheet);
        (None, history.into_iter().collect())
    } else {
        (None, Vec::new())
    }
}

fn pen(app: &App, role: Role, letter: char) -> Pen {
    Pen::new(app.view.theme, role, letter)
}

fn draw(
    app: &App,
    figure: &CurveFigure,
    area: Rect,
    sheet: &mut Sheet<'_>,
) -> (Rect, Option<PixelPlot>) {
    let theme = app.view.theme;
    heading(app, figure, area, sheet);
    let plot = Rect {
        x: area.x + AXIS,
        y: area.y + 1,
        width: area.width.saturating_sub(AXIS),
        height: area.height.saturating_sub(2),
    };
    let mut chart = CurvePanel::of(app, figure.on(plot));
    chart.upright(figure.knob, pen(app, Role::Dim, ':'));
    chart.line(figure.formula.iter().copied(), pen(app, Role::Formula, '.'));
    for &(x, _, band) in &figure.points {
        let ends = band.into_iter().flatten().map(|y| (x, y));
        chart.line(ends, pen(app, Role::Good, '|'));
    }
    let curves = chart.render(sheet);
    let simulated = theme.pick("•", "o");
    for &(x, y, _) in &figure.points {
        figure.spot(plot, x, y, simulated, Role::Good, sheet);
    }
    if let Some(now) = figure.now {
        let symbol = theme.pick("◉", "O");
        figure.spot(plot, figure.knob, now, symbol, Role::Strong, sheet);
    }
    axes(app, figure, area, plot, sheet);
    (plot, curves)
}

/// Its name and what the marks mean, and how far a sweep is: in the corner, or below it.
fn heading(app: &App, figure: &CurveFigure, area: Rect, sheet: &mut Sheet<'_>) {
    let theme = app.view.theme;
    let legend = |words: [&'static str; 2]| {
        let mut spans = vec![
            theme.span("y ", Role::Key),
            theme.span(format!("{} ", figure.name), Role::Title),
        ];
        let marks = [("┄ ", ". ", Role::Formula), ("• ", "o ", Role::Good)];
        for ((mark, plain, role), word) in marks.into_iter().zip(words) {
            if role != Role::Formula || !figure.formula.is_empty() {
                spans.push(theme.span(theme.pick(mark, plain), role));
                spans.push(theme.span(word, Role::Dim));
            }
        }
        Line::from(spans)
    };
    let full = legend(["formula ", "simulated "]);
    let heading = if full.width() <= usize::from(area.width) {
        full
    } else {
        legend(["form. ", "sim. "])
    };
    sheet.line(area, 0, &heading);
    let Some((done, all)) = app.lives.sweep else {
        return;
    };
    let text = format!("{}{done}/{all}", theme.pick("↻ ", "@ "));
    let line = theme.line(text, Role::Warn);
    let has_room = (heading.width() + line.width()) as u16 <= area.width;
    sheet.line_right(area, u16::from(!has_room), &line);
}

fn axes(app: &App, figure: &CurveFigure, area: Rect, plot: Rect, sheet: &mut Sheet<'_>) {
    let word = |text: &str| app.view.theme.line(app.view.theme.text(text), Role::Dim);
    let left = Rect {
        y: plot.y,
        width: AXIS - 1,
        height: plot.height,
        ..area
    };
    sheet.line_right(left, 0, &word(&figure.y_ends[1]));
    let last = plot.height.saturating_sub(1);
    sheet.line_right(left, last, &word(&figure.y_ends[0]));
    let foot = with_rows(plot, plot.bottom(), 1);
    let [from, middle, to] = figure.foot.each_ref().map(|text| word(text));
    sheet.line(foot, 0, &from);
    sheet.line_right(foot, 0, &to);
    let width = middle.width() as u16;
    let taken = (from.width() + to.width() + 2) as u16 + width;
    if taken <= foot.width {
        let start = (foot.width / 2).saturating_sub(width / 2);
        let centred = with_columns(foot, foot.x + start.max(from.width() as u16 + 1), width);
        sheet.line(centred, 0, &middle);
    }
}
