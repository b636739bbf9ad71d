//! Bottom: the stress history of one material point while it crosses the contact, with the cycles
//! that were counted. At S = 0 one cycle, at S = 0.5 a comb.

use ratatui::buffer::Buffer;
use ratatui::layout::Rect;
use ratatui::text::{Line, Span};

use crate::sim::Frame;
use crate::tui::app::{App, PointQuantity};
use crate::tui::theme::Role;
use crate::tui::trace::TraceSample;
use crate::tui::units::{sig, sig_or_dash, tick};
use crate::tui::view::chart::{Chart, Pen};
use crate::tui::view::{Areas, Density, ascii_text, panel, put, put_right, title};

pub(super) fn render(app: &App, areas: &Areas, buffer: &mut Buffer) {
    let theme = app.theme;
    let inner = panel(theme, areas, areas.point, heading(app), buffer);
    let Some(frame) = app.frame() else { return };
    let Some(point) = &frame.material_point else {
        put(
            inner,
            0,
            &Line::styled("no material point is followed", theme.style(Role::Dim)),
            buffer,
        );
        return;
    };
    let words = if areas.density == Density::Full {
        26
    } else {
        20
    };
    let left = Rect {
        width: words.min(inner.width),
        ..inner
    };
    numbers(app, frame, left, buffer);
    let plot = Rect {
        x: left.right() + 6,
        width: inner.width.saturating_sub(words + 7),
        height: inner.height.saturating_sub(1),
        ..inner
    };
    if plot.width < 8 || plot.height < 2 {
        return;
    }
    trace(app, frame, plot, buffer);
    cycles_ticked(app, frame, plot, buffer);
    axis(app, plot, point.depth_m, buffer);
}

fn heading(app: &App) -> Line<'static> {
    let theme = app.theme;
    let name = match app.quantity {
        PointQuantity::Pressure => "material point: pressure on it",
        PointQuantity::Shear => "material point: shear below it",
    };
    let mut line = title(theme, "p", name);
    let note = match app.frame().and_then(|frame| frame.material_point) {
        Some(point) => format!("body {} ", point.body),
        None => String::new(),
    };
    line.push_span(Span::styled(note, theme.style(Role::Dim)));
    line
}

fn numbers(app: &App, frame: &Frame, area: Rect, buffer: &mut Buffer) {
    let theme = app.theme;
    let Some(point) = &frame.material_point else {
        return;
    };
    let metrics = &frame.metrics;
    let (formula, counted) = match point.body {
        2 => (metrics.n_body_2, metrics.n_counted_body_2),
        _ => (metrics.n_body_1, metrics.n_counted_body_1),
    };
    let role = if point.body == 2 {
        Role::Body2
    } else {
        Role::Body1
    };
    let pressure = app.units.pressure();
    let lines = [
        ("cycles so far", sig(point.cycles_counted, 3), Role::Cycles),
        ("a crossing", sig_or_dash(counted, 3), Role::Strong),
        ("n by formula", sig_or_dash(formula, 3), Role::Formula),
        ("x", format!("{:.2} a", point.x_m / frame.a_m), role),
        (
            "pressure",
            pressure.show(point.pressure_pa, 3),
            Role::Pressure,
        ),
        ("shear τxz", pressure.show(point.tau_xz_pa, 2), Role::Shear),
        (
            "effective",
            pressure.show(point.effective_pa, 3),
            Role::Text,
        ),
        (
            "depth",
            app.units.length().show(point.depth_m, 3),
            Role::Text,
        ),
    ];
    for (row, (name, value, role)) in lines.into_iter().enumerate() {
        let row = row as u16;
        let name = Line::styled(ascii_text(theme, name), theme.style(Role::Dim));
        put(area, row, &name, buffer);
        let value = Line::styled(ascii_text(theme, &value), theme.style(role));
        put_right(area, row, &value, buffer);
    }
}

fn value(quantity: PointQuantity, sample: &TraceSample) -> f64 {
    match quantity {
        PointQuantity::Pressure => sample.pressure_pa,
        PointQuantity::Shear => sample.tau_xz_pa,
    }
}

fn trace(app: &App, frame: &Frame, plot: Rect, buffer: &mut Buffer) {
    let theme = app.theme;
    let range = range(app);
    let mut chart = Chart::new(plot, X_RANGE, range);
    let pen = |role: Role, letter: char| Pen {
        style: theme.style(role),
        letter,
    };
    let quantity = app.quantity;
    let points = |samples: &[TraceSample]| -> Vec<(f64, f64)> {
        samples
            .iter()
            .map(|sample| (sample.x_m / frame.a_m, value(quantity, sample)))
            .collect()
    };
    if quantity == PointQuantity::Pressure {
        let fine = usize::from(plot.width) * 2;
        let hertz = (0..=fine).filter_map(|i| {
            let x = X_RANGE[0] + (X_RANGE[1] - X_RANGE[0]) * i as f64 / fine as f64;
            (x.abs() < 1.0).then(|| (x, frame.p_hertz_pa * (1.0 - x * x).sqrt()))
        });
        chart.scatter(hertz, pen(Role::Hertz, '.'));
    }
    chart.line(points(app.trace.before()), pen(Role::Border, '.'));
    let role = match quantity {
        PointQuantity::Pressure => Role::Pressure,
        PointQuantity::Shear => Role::Shear,
    };
    chart.line(points(app.trace.current()), pen(role, '*'));
    chart.render(theme.is_ascii(), buffer);
    if let Some(last) = app.trace.current().last() {
        let down = 1.0 - (value(quantity, last) - range[0]) / (range[1] - range[0]);
        let row = (down.clamp(0.0, 1.0) * f64::from(plot.height - 1)).round() as u16;
        mark(
            app,
            plot,
            last.x_m / frame.a_m,
            row,
            "◆",
            Role::Strong,
            buffer,
        );
    }
}

/// x/a over which the point is followed.
const X_RANGE: [f64; 2] = [-1.5, 1.5];

fn range(app: &App) -> [f64; 2] {
    match app.quantity {
        PointQuantity::Pressure => [0.0, app.ranges.pressure_pa.max(1.0)],
        PointQuantity::Shear => {
            let most = app.ranges.shear_pa.max(1.0);
            [-most, most]
        }
    }
}

/// A tick under the trace for each cycle that was counted.
fn cycles_ticked(app: &App, frame: &Frame, plot: Rect, buffer: &mut Buffer) {
    for x_m in app.trace.ticks() {
        mark(
            app,
            plot,
            x_m / frame.a_m,
            plot.height,
            "╿",
            Role::Cycles,
            buffer,
        );
    }
}

fn mark(
    app: &App,
    plot: Rect,
    x: f64,
    row: u16,
    symbol: &'static str,
    role: Role,
    buffer: &mut Buffer,
) {
    let part = (x - X_RANGE[0]) / (X_RANGE[1] - X_RANGE[0]);
    if !(0.0..=1.0).contains(&part) {
        return;
    }
    let ascii = if symbol == "◆" { "X" } else { "|" };
    let at = (
        plot.x + (part * f64::from(plot.width - 1)).round() as u16,
        plot.y + row,
    );
    if let Some(cell) = buffer.cell_mut(at) {
        cell.set_symbol(app.theme.pick(symbol, ascii))
            .set_style(app.theme.style(role));
    }
}

fn axis(app: &App, plot: Rect, depth_m: f64, buffer: &mut Buffer) {
    let theme = app.theme;
    let pressure = app.units.pressure();
    let dim = theme.style(Role::Dim);
    let left = Rect {
        x: plot.x.saturating_sub(6),
        width: 5,
        ..plot
    };
    let range = range(app);
    put_right(
        left,
        0,
        &Line::styled(tick(pressure.of(range[1])), dim),
        buffer,
    );
    let foot = tick(pressure.of(range[0]));
    put_right(left, plot.height - 1, &Line::styled(foot, dim), buffer);
    if plot.height >= 4 {
        put_right(left, 1, &Line::styled(pressure.name, dim), buffer);
    }
    if app.quantity == PointQuantity::Shear && plot.height >= 5 {
        let depth = app.units.length().show(depth_m, 2);
        let text = ascii_text(theme, &format!("at depth {depth}"));
        put_right(plot, 0, &Line::styled(text, dim), buffer);
    }
}
