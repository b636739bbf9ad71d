//! Bottom: the stress history of one material point while it crosses the contact, each peak counted as it
//! passes. At S = 0 one cycle, at S = 0.5 a comb.

use ratatui::buffer::Buffer;
use ratatui::layout::{Position, Rect};
use ratatui::text::Line;

use crate::tui::action::Action;
use crate::tui::app::{App, PanelKind, PointNow, PointQuantity};
use crate::tui::pixels::PixelPlot;
use crate::tui::theme::Role;
use crate::tui::trace::TraceSample;
use crate::tui::units::{nice_ceiling, sig_or_dash, tick};
use crate::tui::view::areas::{Areas, PanelSpacing};
use crate::tui::view::chart::{CurvePanel, Pen, Plot, Symbol};
use crate::tui::view::panel::{panel, title};
use crate::tui::view::place::{Entry, columns, columns_from, put, put_right, rows, table};
use asperity_engine::sim::{Frame, Stage};

pub(super) fn render(app: &App, areas: &Areas, buffer: &mut Buffer) -> Option<PixelPlot> {
    let inner = panel(app, areas, PanelKind::Point, heading(app), buffer);
    let frame = app.frame()?;
    let Some(point) = app.point_now() else {
        let text = match (frame.stage, &app.run.setup.scene.stress) {
            (_, None) => "no stress is computed in this scene, so no material point is followed",
            (Stage::StartUp, _) => "followed once the passage begins",
            (Stage::Passage, _) => "no material point is followed",
        };
        put(inner, 0, &app.view.theme.line(text, Role::Dim), buffer);
        return None;
    };
    let left = columns(inner, 0, words(areas));
    table(app.view.theme, left, &numbers(app, frame, &point), buffer);
    let area = plot(areas);
    if area.is_empty() {
        return None;
    }
    over(app, area, X_RANGE, buffer)
}

/// The trace alone over some x/a: under the profile those of the picture above it.
pub(super) fn over(app: &App, area: Rect, x: [f64; 2], buffer: &mut Buffer) -> Option<PixelPlot> {
    let (frame, point) = (app.frame()?, app.point_now()?);
    let y = range(app, frame);
    let plot = Plot { area, x, y };
    let curves = trace(app, frame, plot, buffer);
    peaks_ticked(app, frame, &plot, buffer);
    axis(app, &plot, point.depth_m, buffer);
    curves
}

/// Columns of the numbers; a narrow screen leaves them to the trace, unless it is all that is shown.
fn words(areas: &Areas) -> u16 {
    if areas.is_narrow && !areas.knobs.is_empty() {
        0
    } else if areas.density == PanelSpacing::Full {
        27
    } else {
        24
    }
}

/// Where the trace is drawn; empty where there is no room for it.
fn plot(areas: &Areas) -> Rect {
    let inner = areas.inside(PanelKind::Point);
    let right = columns_from(inner, words(areas) + 6);
    let plot = columns(right, 0, right.width.saturating_sub(1));
    let plot = rows(plot, 0, plot.height.saturating_sub(1));
    if plot.width < 8 || plot.height < 2 {
        return Rect::default();
    }
    plot
}

/// A press on the trace chooses the point that is there now, elsewhere what is shown of it.
pub(super) fn pressed(areas: &Areas, at: Position) -> Option<Action> {
    let elsewhere = || areas.point.contains(at).then_some(Action::PointQuantity);
    dragged(areas, at).or_else(elsewhere)
}

/// A drag along the trace takes the point with it.
pub(super) fn dragged(areas: &Areas, at: Position) -> Option<Action> {
    let (area, x) = (plot(areas), X_RANGE);
    let plot = Plot { area, x, y: x };
    area.contains(at).then(|| Action::PutPoint(plot.x_at(at.x)))
}

fn heading(app: &App) -> Line<'static> {
    let theme = app.view.theme;
    let name = match app.view.point_quantity {
        PointQuantity::Pressure => "material point: pressure on it",
        PointQuantity::Excess => "material point: pressure on it less Hertz's",
        PointQuantity::Shear => "material point: shear below it",
        PointQuantity::Effective => "material point: effective stress below it",
    };
    let mut line = title(theme, "p", name);
    if let Some(point) = app.point_now() {
        let depth = app.view.units.length().show(point.depth_m, 2);
        let note = format!("body {}, {depth} deep ", point.body);
        line.push_span(theme.span("P ", Role::Key));
        line.push_span(theme.span(note, Role::Dim));
    }
    line
}

fn numbers(app: &App, frame: &Frame, point: &PointNow) -> [Entry; 8] {
    let pressure = app.view.units.pressure();
    let sample = point.sample;
    let body = match point.body {
        2 => Role::Body2,
        _ => Role::Body1,
    };
    let crossing = match app.replay.playing {
        Some(_) => "in this crossing",
        None => "crossing before",
    };
    let count = |value: f64| format!("{value:.0}");
    let closed = point.closed.map_or_else(|| "–".to_owned(), count);
    let (average, expected) = (
        sig_or_dash(point.average, 3),
        sig_or_dash(point.expected, 3),
    );
    let x = format!("{:.2} a", sample.x_m / frame.a_m);
    let shown = |value_pa: f64, digits: i32| pressure.show(value_pa, digits);
    [
        Entry::new("peaks so far", count(sample.cycles), Role::Cycles),
        Entry::new(crossing, closed, Role::Strong),
        Entry::new("counted on average", average, Role::Strong),
        Entry::new("expected on average", expected, Role::Formula),
        Entry::new("x", x, body),
        Entry::new("pressure", shown(sample.pressure_pa, 3), Role::Pressure),
        Entry::new("shear τxz", shown(sample.tau_xz_pa, 2), Role::Shear),
        Entry::new("effective", shown(sample.effective_pa, 3), Role::Text),
    ]
}

fn value(quantity: PointQuantity, sample: &TraceSample, frame: &Frame) -> f64 {
    match quantity {
        PointQuantity::Pressure => sample.pressure_pa,
        PointQuantity::Excess => sample.pressure_pa - hertz_pa(sample.x_m / frame.a_m, frame),
        PointQuantity::Shear => sample.tau_xz_pa,
        PointQuantity::Effective => sample.effective_pa,
    }
}

/// Hertz's pressure at x/a on y = 0.
fn hertz_pa(x: f64, frame: &Frame) -> f64 {
    frame.p_hertz_pa * (1.0 - x * x).max(0.0).sqrt()
}

fn trace(app: &App, frame: &Frame, plot: Plot, buffer: &mut Buffer) -> Option<PixelPlot> {
    let mut chart = CurvePanel::new(plot);
    let pen = |role: Role, letter: char| Pen::new(app.view.theme, role, letter);
    let quantity = app.view.point_quantity;
    let points = |samples: &[TraceSample], frame: &Frame| -> Vec<(f64, f64)> {
        let place = |sample: TraceSample| (sample.x_m / frame.a_m, value(quantity, &sample, frame));
        samples.iter().copied().map(place).collect()
    };
    let (role, hertz) = match quantity {
        PointQuantity::Pressure => (Role::Pressure, Some(frame.p_hertz_pa)),
        PointQuantity::Excess => (Role::Pressure, Some(0.0)),
        PointQuantity::Shear => (Role::Shear, None),
        PointQuantity::Effective => (Role::Peaks, None),
    };
    if let Some(p_hertz_pa) = hertz {
        chart.hertz(p_hertz_pa, pen(Role::Hertz, '.'));
    }
    if let Some((ghost, frozen)) = ghost(app) {
        chart.line(points(ghost, frozen), pen(Role::Formula, ','));
    }
    chart.line(
        points(app.replay.trace.before(), frame),
        pen(Role::Border, '.'),
    );
    chart.line(points(app.replay.trace.current(), frame), pen(role, '*'));
    let curves = chart.render(app, buffer);
    if let Some(last) = app.replay.trace.current().last() {
        let y = value(quantity, last, frame).clamp(plot.y[0], plot.y[1]);
        let here = Symbol::new(app.view.theme, "◆", "X", Role::Strong);
        plot.mark(last.x_m / frame.a_m, y, here, buffer);
    }
    curves
}

/// The crossing that was frozen, and the frame beside it.
fn ghost(app: &App) -> Option<(&[TraceSample], &Frame)> {
    let ghost = app.view.frozen.as_ref()?;
    let frame = ghost.frame()?;
    let (before, current) = (ghost.replay.trace.before(), ghost.replay.trace.current());
    let whole = if before.is_empty() { current } else { before };
    Some((whole, frame))
}

/// x/a over which the point is followed.
const X_RANGE: [f64; 2] = [-1.5, 1.5];

/// The scale of the trace itself: this crossing and the one before, so that small teeth are seen.
fn range(app: &App, frame: &Frame) -> [f64; 2] {
    let samples = app
        .replay
        .trace
        .before()
        .iter()
        .chain(app.replay.trace.current());
    let values = samples.map(|sample| value(app.view.point_quantity, sample, frame).abs());
    let frozen = ghost(app).into_iter().flat_map(|(samples, frame)| {
        let frozen = samples.iter();
        frozen.map(|sample| value(app.view.point_quantity, sample, frame).abs())
    });
    let reached = nice_ceiling(values.chain(frozen).fold(0.0, f64::max));
    // Nothing yet, or next to nothing: a part of Hertz's pressure.
    let most = reached.max(0.02 * frame.p_hertz_pa).max(1.0);
    match app.view.point_quantity {
        PointQuantity::Pressure => [0.0, most.max(frame.p_hertz_pa)],
        PointQuantity::Effective => [0.0, most],
        PointQuantity::Shear | PointQuantity::Excess => [-most, most],
    }
}

/// A tick under the trace for each peak that has passed, and its number on the curve where there is room.
fn peaks_ticked(app: &App, frame: &Frame, plot: &Plot, buffer: &mut Buffer) {
    let mut free_from = 0;
    let symbol = Symbol::new(app.view.theme, "╿", "|", Role::Cycles);
    for tick in app.replay.trace.ticks() {
        let Some(column) = plot.column(tick.x_m / frame.a_m) else {
            continue;
        };
        symbol.draw((column, plot.area.bottom()), buffer);
        let number = tick.number.to_string();
        let width = number.len() as u16;
        let first = (column.saturating_sub((width - 1) / 2)).min(plot.area.right() - width);
        let Some(sample) = nearest(app.replay.trace.current(), tick.x_m) else {
            continue;
        };
        if first < free_from {
            continue;
        }
        // Above the curve, or on it where it reaches the top.
        let row = plot.row(value(app.view.point_quantity, sample, frame));
        let row = row.saturating_sub(1).max(plot.area.y);
        buffer.set_line(
            first,
            row,
            &app.view.theme.line(number, Role::Cycles),
            width,
        );
        free_from = first + width + 1;
    }
}

fn nearest(samples: &[TraceSample], x_m: f64) -> Option<&TraceSample> {
    let away = |sample: &TraceSample| (sample.x_m - x_m).abs();
    let all = samples.iter();
    all.min_by(|one, two| away(one).total_cmp(&away(two)))
}

fn axis(app: &App, plot: &Plot, depth_m: f64, buffer: &mut Buffer) {
    let theme = app.view.theme;
    let pressure = app.view.units.pressure();
    let ends = plot.y.map(|value| tick(pressure.of(value)));
    plot.y_ends(theme, &ends, pressure.name, buffer);
    if app.view.point_quantity != PointQuantity::Pressure && plot.area.height >= 5 {
        let depth = app.view.units.length().show(depth_m, 2);
        let text = theme.line(format!("at depth {depth}"), Role::Dim);
        put_right(plot.area, 0, &text, buffer);
    }
}
