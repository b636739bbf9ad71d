//! Right, below: a curve along S or the speed with the operating point on it, and the history of the estimate.

mod aged;
mod along;
mod map;

use ratatui::buffer::Buffer;
use ratatui::layout::{Position, Rect};
use ratatui::text::{Line, Span};

use crate::tui::action::Action;
use crate::tui::app::App;
use crate::tui::pixels::PixelPlot;
use crate::tui::theme::Role;
use crate::tui::view::chart::{CurvePanel, Pen, Plot, Symbol};
use crate::tui::view::place::{columns_from, put, put_middle, put_right, rows, rows_from};
use along::CurveFigure;
use asperity_session::sweep::Varied;

/// Rows from which a curve can be read, with its heading and its axis.
const CURVE_ROWS: u16 = 7;

/// A press on a plot along S, or along the speed, puts that knob there.
pub(super) fn pressed(app: &App, plot: Rect, at: Position) -> Option<Action> {
    let Some(figure) = along::figure(app) else {
        return map::pressed(app, plot, at);
    };
    let x = figure.plot(plot).x_at(at.x);
    along::goes_to(app, x).filter(|_| plot.contains(at))
}

/// Draws what there is room for; says where the curve's plot is, and what it leaves to a page.
pub(super) fn render(app: &App, area: Rect, buffer: &mut Buffer) -> (Option<Rect>, Vec<PixelPlot>) {
    let history_rows = match area.height {
        0..2 => return (None, Vec::new()),
        2..=CURVE_ROWS => area.height,
        height if height < CURVE_ROWS + 5 => 0,
        height => (height / 3).clamp(4, 8),
    };
    let curve_rows = area.height - history_rows;
    let below = rows_from(area, curve_rows);
    let left_to_page = history(app, below, buffer);
    if curve_rows == 0 {
        return (None, left_to_page.into_iter().collect());
    }
    let area = rows(area, 1, curve_rows - 1);
    let (plot, curve) = match along::figure(app) {
        Some(figure) => {
            let (plot, curve) = draw(app, &figure, area, buffer);
            (Some(plot), curve)
        }
        None => (map::draw(app, area, buffer), None),
    };
    (plot, left_to_page.into_iter().chain(curve).collect())
}

fn draw(
    app: &App,
    figure: &CurveFigure,
    area: Rect,
    buffer: &mut Buffer,
) -> (Rect, Option<PixelPlot>) {
    /// Columns of the numbers left of it.
    const AXIS: u16 = 5;
    let theme = app.view.theme;
    let pen = |role: Role, letter: char| Pen::new(theme, role, letter);
    heading(app, figure, area, buffer);
    let below = columns_from(rows_from(area, 1), AXIS);
    let plot = figure.plot(rows(below, 0, below.height.saturating_sub(1)));
    let mut chart = CurvePanel::new(plot);
    chart.upright(figure.knob, pen(Role::Dim, ':'));
    chart.line(figure.formula.iter().copied(), pen(Role::Formula, '.'));
    for point in &figure.points {
        let ends = point.band.into_iter().flatten().map(|y| (point.x, y));
        chart.line(ends, pen(Role::Good, '|'));
    }
    let curves = chart.render(app, buffer);
    let simulated = Symbol::new(theme, "•", "o", Role::Good);
    let other = Symbol::new(theme, "∘", "x", Role::Cycles);
    for (x, y) in &figure.other {
        plot.mark(*x, *y, other, buffer);
    }
    for point in &figure.points {
        plot.mark(point.x, point.y, simulated, buffer);
    }
    if let Some(now) = figure.now {
        let here = Symbol::new(theme, "◉", "O", Role::Strong);
        plot.mark(figure.knob, now, here, buffer);
    }
    plot.y_ends(theme, &figure.y_ends, "", buffer);
    let foot = rows_from(below, plot.area.height);
    let [from, middle, to] = figure
        .foot
        .each_ref()
        .map(|text| theme.line(text, Role::Dim));
    put(foot, 0, &from, buffer);
    put_right(foot, 0, &to, buffer);
    let beside = from.width().max(to.width());
    if 2 * (beside + 1) + middle.width() <= usize::from(foot.width) {
        put_middle(foot, 0, &middle, buffer);
    }
    (plot.area, curves)
}

/// Its name and what the marks mean, and how far a sweep is: in the corner, or below it.
fn heading(app: &App, figure: &CurveFigure, area: Rect, buffer: &mut Buffer) {
    let theme = app.view.theme;
    let legend = |words: [&'static str; 2], other: &'static str| {
        let mut spans = vec![
            theme.span("y ", Role::Key),
            theme.span(format!("{} ", figure.name), Role::Title),
        ];
        let marks = [("┄ ", ". ", Role::Formula), ("• ", "o ", Role::Good)];
        for ((mark, plain, role), word) in marks.into_iter().zip(words) {
            if role != Role::Formula || !figure.formula.is_empty() {
                let mark = Span::styled(theme.pick(mark, plain), theme.style(role));
                spans.extend([mark, theme.span(word, Role::Dim)]);
            }
        }
        if !figure.other.is_empty() {
            let mark = Span::styled(theme.pick("∘ ", "x "), theme.style(Role::Cycles));
            spans.extend([mark, theme.span(other, Role::Dim)]);
        }
        Line::from(spans)
    };
    let [other, short] = figure.other_name;
    let [simulated, sim] = figure.points_name;
    let full = legend(["formula ", simulated], other);
    let heading = if full.width() <= usize::from(area.width) {
        full
    } else {
        legend(["form. ", sim], short)
    };
    put(area, 0, &heading, buffer);
    let (Some((done, all)), Varied::Along(_)) = (app.lives.sweep, app.lives.sweeping) else {
        return;
    };
    let text = format!("{}{done}/{all}", theme.pick("↻ ", "@ "));
    let line = theme.line(text, Role::Warn);
    let has_room = (heading.width() + line.width()) as u16 <= area.width;
    put_right(area, u16::from(!has_room), &line, buffer);
}

/// The estimate over the passages seen, the present on the right.
fn history(app: &App, area: Rect, buffer: &mut Buffer) -> Option<PixelPlot> {
    /// Half of the minimum range, decades: noise stays small.
    const MIN_HALF: f64 = 0.17;
    let theme = app.view.theme;
    let (first, last) = (app.lives.history.front()?, app.lives.history.back()?);
    let span = last.passages - first.passages;
    let unit = if area.width >= 27 { " of 4a" } else { "" };
    let heading = Line::from(vec![
        theme.span("history ", Role::Title),
        theme.span(format!("{span:.1} passages{unit}"), Role::Dim),
    ]);
    put(area, 0, &heading, buffer);
    let area = rows_from(area, 1);
    if span <= 0.0 || area.is_empty() {
        return None;
    }
    let samples = app.lives.history.iter();
    let points = samples.map(|sample| (sample.passages, sample.life_relative.log10()));
    let decades = points.clone().map(|(_, decade)| decade);
    let (low, high) = (
        decades.clone().fold(f64::MAX, f64::min),
        decades.fold(f64::MIN, f64::max),
    );
    let middle = 0.5 * (low + high);
    let half = (0.55 * (high - low)).max(MIN_HALF);
    let mut chart = CurvePanel::new(Plot {
        area,
        x: [first.passages, last.passages],
        y: [middle - half, middle + half],
    });
    chart.line(points, Pen::new(theme, Role::Good, '*'));
    chart.render(app, buffer)
}
