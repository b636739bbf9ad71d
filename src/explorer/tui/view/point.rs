//! Bottom: the stress history of one material point while it crosses the contact, each peak counted as it
//! passes. At S = 0 one cycle, at S = 0.5 a comb.

use ratatui::layout::{Position, Rect};
use ratatui::text::Line;

use crate::tui::action::Action;
use crate::tui::app::{App, PanelKind, PointNow, PointQuantity};
use crate::tui::pixels::PixelPlot;
use crate::tui::theme::Role;
use crate::tui::trace::TraceSample;
use crate::tui::units::{nice_ceiling, sig_or_dash, tick};
use crate::tui::view::areas::{Areas, PanelSpacing};
use crate::tui::view::chart::{CurvePanel, Pen, PlotFrame};
use crate::tui::view::sheet::{Sheet, inside, panel, title, with_columns};
use asperity_engine::sim::{Frame, Stage};

pub(super) fn render(app: &App, areas: &Areas, sheet: &mut Sheet<'_>) -> Option<PixelPlot> {
    let inner = panel(app, areas, PanelKind::Point, heading(app), sheet);
    let frame = app.frame()?;
    let Some(point) = app.point_now() else {
        let text = match (frame.stage, &app.run.setup.scene.stress) {
            (_, None) => "no stress is computed in this scene, so no material point is followed",
            (Stage::StartUp, _) => "followed once the passage begins",
            (Stage::Passage, _) => "no material point is followed",
        };
        sheet.text(inner, 0, text, Role::Dim);
        return None;
    };
    let words = words(areas);
    let left = with_columns(inner, inner.x, words.min(inner.width));
    numbers(app, frame, &point, left, sheet);
    let area = plot(areas);
    if area.is_empty() {
        return None;
    }
    draw(app, frame, area, X_RANGE, sheet)
}

/// The trace over these x/a, with its ticks and axis; nothing where no point is followed.
pub(super) fn draw(
    app: &App,
    frame: &Frame,
    area: Rect,
    x: [f64; 2],
    sheet: &mut Sheet<'_>,
) -> Option<PixelPlot> {
    let point = app.point_now()?;
    let y = range(app, frame);
    let plot = PlotFrame { area, x, y };
    let curves = trace(app, frame, &plot, sheet);
    peaks_ticked(app, frame, &plot, sheet);
    axis(app, &plot, point.depth_m, sheet);
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
    let inner = inside(areas, areas.point);
    let words = words(areas);
    let left = words.min(inner.width);
    let plot = Rect {
        x: inner.x + left + 6,
        width: inner.width.saturating_sub(words + 7),
        height: inner.height.saturating_sub(1),
        ..inner
    };
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
    let plot = plot(areas);
    plot.contains(at).then(|| {
        let plot = PlotFrame {
            area: plot,
            x: X_RANGE,
            y: [0.0, 1.0],
        };
        Action::PutPoint(plot.x_at(at.x))
    })
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
        let note = theme.text(&note);
        line.push_span(theme.span("P ", Role::Key));
        line.push_span(theme.span(note, Role::Dim));
    }
    line
}

fn numbers(app: &App, frame: &Frame, point: &PointNow, area: Rect, sheet: &mut Sheet<'_>) {
    let role = if point.body == 2 {
        Role::Body2
    } else {
        Role::Body1
    };
    let pressure = app.view.units.pressure();
    let sample = point.sample;
    let crossing = if app.replay.playing.is_some() {
        "in this crossing"
    } else {
        "crossing before"
    };
    let count = |value: f64| format!("{value:.0}");
    let lines = [
        ("peaks so far", count(sample.cycles), Role::Cycles),
        (
            crossing,
            point.closed.map_or_else(|| "–".to_owned(), count),
            Role::Strong,
        ),
        (
            "counted on average",
            sig_or_dash(point.average, 3),
            Role::Strong,
        ),
        (
            "expected on average",
            sig_or_dash(point.expected, 3),
            Role::Formula,
        ),
        ("x", format!("{:.2} a", sample.x_m / frame.a_m), role),
        (
            "pressure",
            pressure.show(sample.pressure_pa, 3),
            Role::Pressure,
        ),
        ("shear τxz", pressure.show(sample.tau_xz_pa, 2), Role::Shear),
        (
            "effective",
            pressure.show(sample.effective_pa, 3),
            Role::Text,
        ),
    ];
    for (row, (name, value, role)) in lines.into_iter().enumerate() {
        let row = row as u16;
        sheet.text(area, row, name, Role::Dim);
        sheet.text_right(area, row, &value, role);
    }
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

fn trace(app: &App, frame: &Frame, plot: &PlotFrame, sheet: &mut Sheet<'_>) -> Option<PixelPlot> {
    let theme = app.view.theme;
    let mut chart = CurvePanel::of(app, *plot);
    let pen = |role: Role, letter: char| Pen::new(theme, role, letter);
    let quantity = app.view.point_quantity;
    let points = |samples: &[TraceSample]| -> Vec<(f64, f64)> {
        samples
            .iter()
            .map(|sample| (sample.x_m / frame.a_m, value(quantity, sample, frame)))
            .collect()
    };
    let fine = 2 * usize::from(plot.area.width);
    let hertz = (0..=fine).filter_map(|i| {
        let x = plot.x[0] + (plot.x[1] - plot.x[0]) * i as f64 / fine as f64;
        let p = match quantity {
            PointQuantity::Pressure => hertz_pa(x, frame),
            PointQuantity::Excess => 0.0,
            PointQuantity::Shear | PointQuantity::Effective => return None,
        };
        (x.abs() < 1.0).then_some((x, p))
    });
    chart.scatter(hertz, pen(Role::Hertz, '.'));
    if let Some((samples, frozen)) = frozen(app) {
        let frozen_points = samples.iter().map(|sample| {
            let y = value(quantity, sample, frozen);
            (sample.x_m / frozen.a_m, y)
        });
        chart.line(frozen_points, pen(Role::Formula, ','));
    }
    chart.line(points(app.replay.trace.before()), pen(Role::Border, '.'));
    let role = match quantity {
        PointQuantity::Pressure | PointQuantity::Excess => Role::Pressure,
        PointQuantity::Shear => Role::Shear,
        PointQuantity::Effective => Role::Peaks,
    };
    chart.line(points(app.replay.trace.current()), pen(role, '*'));
    let curves = chart.render(sheet);
    if let Some(last) = app.replay.trace.current().last() {
        let row = plot.row(value(quantity, last, frame));
        let symbol = theme.pick("◆", "X");
        plot.mark(last.x_m / frame.a_m, row, symbol, Role::Strong, sheet);
    }
    curves
}

/// The crossing that was frozen, and the frame beside it.
fn frozen(app: &App) -> Option<(&[TraceSample], &Frame)> {
    let frozen = app.view.frozen.as_ref()?;
    let frame = frozen.frame()?;
    let trace = &frozen.replay.trace;
    let (before, current) = (trace.before(), trace.current());
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
    let frozen = frozen(app).into_iter().flat_map(|(samples, frame)| {
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
fn peaks_ticked(app: &App, frame: &Frame, plot: &PlotFrame, sheet: &mut Sheet<'_>) {
    let area = plot.area;
    let mut free_from = 0;
    for tick in app.replay.trace.ticks() {
        let x = tick.x_m / frame.a_m;
        let Some(column) = plot.column(x) else {
            continue;
        };
        let symbol = sheet.theme.pick("╿", "|");
        plot.mark(x, area.height, symbol, Role::Cycles, sheet);
        let number = tick.number.to_string();
        let width = number.len() as u16;
        let first = (column.saturating_sub((width - 1) / 2)).min(area.right() - width);
        let Some(sample) = nearest(app.replay.trace.current(), tick.x_m) else {
            continue;
        };
        if first < free_from {
            continue;
        }
        // Above the curve, or on it where it touches the top.
        let y = value(app.view.point_quantity, sample, frame);
        let row = plot.row(y).saturating_sub(1);
        let cells = with_columns(area, first, width);
        sheet.text(cells, row, number, Role::Cycles);
        free_from = first + width + 1;
    }
}

fn nearest(samples: &[TraceSample], x_m: f64) -> Option<&TraceSample> {
    let away = |sample: &TraceSample| (sample.x_m - x_m).abs();
    let all = samples.iter();
    all.min_by(|one, two| away(one).total_cmp(&away(two)))
}

fn axis(app: &App, plot: &PlotFrame, depth_m: f64, sheet: &mut Sheet<'_>) {
    let (plot, range) = (plot.area, plot.y);
    let theme = app.view.theme;
    let pressure = app.view.units.pressure();
    let left = with_columns(plot, plot.x.saturating_sub(6), 5);
    sheet.text_right(left, 0, tick(pressure.of(range[1])), Role::Dim);
    let foot = tick(pressure.of(range[0]));
    sheet.text_right(left, plot.height - 1, foot, Role::Dim);
    if plot.height >= 4 {
        sheet.text_right(left, 1, pressure.name, Role::Dim);
    }
    if app.view.point_quantity != PointQuantity::Pressure && plot.height >= 5 {
        let depth = app.view.units.length().show(depth_m, 2);
        let text = theme.text(&format!("at depth {depth}"));
        sheet.text_right(plot, 0, text, Role::Dim);
    }
}
