//! Centre, below: the figure that every text on lubrication has: pressure and film along the
//! centre line, with the Hertz pressure behind them.

use ratatui::layout::Rect;
use ratatui::text::Line;

use crate::tui::app::{App, PanelKind, Zoom};
use crate::tui::pixels::PixelPlot;
use crate::tui::theme::Role;
use crate::tui::units::tick;
use crate::tui::view::areas::Areas;
use crate::tui::view::chart::{CurvePanel, Pen, PlotFrame};
use crate::tui::view::sheet::{Sheet, panel, title, with_columns, with_rows};
use asperity_engine::sim::Frame;

/// Columns of the numbers on either side.
const AXIS: u16 = 5;

pub(super) fn render(app: &App, areas: &Areas, sheet: &mut Sheet<'_>) -> Option<PixelPlot> {
    let inner = panel(
        app,
        areas,
        PanelKind::CentreLine,
        heading(app, areas),
        sheet,
    );
    let frame = app.frame()?;
    if inner.height < 3 || inner.width < 2 * AXIS + 8 {
        return None;
    }
    let plot = Rect {
        x: inner.x + AXIS,
        width: inner.width - 2 * AXIS,
        height: inner.height - 1,
        ..inner
    };
    let x = x_range(app, frame);
    let curves = curves(app, frame, plot, x, sheet);
    axes(app, inner, plot, x, sheet);
    curves
}

fn heading(app: &App, areas: &Areas) -> Line<'static> {
    /// Columns of the whole.
    const WHOLE: u16 = 37;
    let theme = app.view.theme;
    let name = match areas.centre_line.width {
        ..WHOLE => "y = 0",
        _ => "centre line",
    };
    let mut line = title(theme, "", name);
    let entry = |mark: &'static str, text: &'static str, role: Role| {
        theme.span(format!("{mark}{text} "), role)
    };
    line.push_span(entry(theme.pick("━", "p "), "pressure", Role::Pressure));
    let film = if theme.is_mono() { "╌" } else { "━" };
    line.push_span(entry(theme.pick(film, "h "), "film", Role::Film));
    line.push_span(entry(theme.pick("┄", ". "), "Hertz", Role::Hertz));
    line
}

fn x_range(app: &App, frame: &Frame) -> [f64; 2] {
    let end = (frame.x_min_m + (frame.nx.max(2) - 1) as f64 * frame.dx_m) / frame.a_m;
    let start = frame.x_min_m / frame.a_m;
    match app.view.zoom {
        Zoom::Contact => [start.max(-1.6), end.min(1.4)],
        Zoom::Domain => [start, end],
    }
}

fn curves(
    app: &App,
    frame: &Frame,
    plot: Rect,
    x: [f64; 2],
    sheet: &mut Sheet<'_>,
) -> Option<PixelPlot> {
    let theme = app.view.theme;
    let pen = |role: Role, letter: char| Pen::new(theme, role, letter);
    let hertz = frame.p_hertz_pa / app.run.axis_ends.pressure_pa.max(1.0);
    let axes = PlotFrame {
        area: plot,
        x,
        y: [0.0, 1.0],
    };
    let mut chart = CurvePanel::of(app, axes);
    let fine = usize::from(plot.width) * 2;
    chart.scatter(
        (0..=fine).filter_map(|i| {
            let x = x[0] + (x[1] - x[0]) * i as f64 / fine as f64;
            (x.abs() < 1.0).then(|| (x, hertz * (1.0 - x * x).sqrt()))
        }),
        pen(Role::Hertz, '.'),
    );
    let film = row(frame, &frame.film_m, app.run.axis_ends.film_m);
    chart.line(film, pen(Role::Film, 'h'));
    let pressure = row(frame, &frame.pressure_pa, app.run.axis_ends.pressure_pa);
    chart.line(pressure, pen(Role::Pressure, 'p'));
    if let Some(point) = &frame.material_point {
        chart.upright(point.x_m / frame.a_m, pen(Role::Dim, ':'));
    }
    chart.render(sheet)
}

/// The middle row of a field: x/a and the value over the range's end.
fn row<'a>(
    frame: &'a Frame,
    field: &'a [f32],
    full_scale: f64,
) -> impl Iterator<Item = (f64, f64)> + 'a {
    let start = frame.ny / 2 * frame.nx;
    let values = field.get(start..start + frame.nx).unwrap_or(&[]);
    let scale = if full_scale > 0.0 {
        1.0 / full_scale
    } else {
        0.0
    };
    values.iter().enumerate().map(move |(i, value)| {
        let x = (frame.x_min_m + i as f64 * frame.dx_m) / frame.a_m;
        (x, f64::from(*value) * scale)
    })
}

fn axes(app: &App, inner: Rect, plot: Rect, x: [f64; 2], sheet: &mut Sheet<'_>) {
    let theme = app.view.theme;
    let (pressure, film) = (app.view.units.pressure(), app.view.units.film());
    let left = with_columns(inner, inner.x, AXIS - 1);
    let right = with_columns(inner, plot.right() + 1, AXIS - 1);
    let foot = plot.height - 1;
    for (row, part) in ticks(plot.height) {
        let p = tick(pressure.of(app.run.axis_ends.pressure_pa * part));
        sheet.text_right(left, row, p, Role::Pressure);
        let h = tick(film.of(app.run.axis_ends.film_m * part));
        sheet.text(right, row, h, Role::Film);
    }
    let name = |text: &str, role| theme.line(text, role);
    sheet.line_right(left, foot + 1, &name(pressure.name, Role::Pressure));
    sheet.line(right, foot + 1, &name(film.name, Role::Film));
    let along = with_rows(plot, plot.bottom(), 1);
    for mark in [-2.0, -1.0, 0.0, 1.0] {
        let part = (mark - x[0]) / (x[1] - x[0]);
        if !(0.0..=1.0).contains(&part) {
            continue;
        }
        let text = if mark == 0.0 {
            "0".to_owned()
        } else {
            format!("{mark:.0}a")
        };
        let column = (part * f64::from(plot.width - 1)) as u16;
        let column = column
            .saturating_sub(text.len() as u16 / 2)
            .min(plot.width.saturating_sub(text.len() as u16));
        let at = with_columns(along, along.x + column, text.len() as u16);
        sheet.text(at, 0, text, Role::Dim);
    }
}

/// Rows that carry a number, with the part of the range they stand for.
fn ticks(rows: u16) -> Vec<(u16, f64)> {
    let last = rows - 1;
    // A number in the middle only where a row is in the middle.
    let marks = if rows >= 7 && last.is_multiple_of(2) {
        vec![0, last / 2, last]
    } else {
        vec![0, last]
    };
    marks
        .into_iter()
        .map(|row| (row, 1.0 - f64::from(row) / f64::from(last.max(1))))
        .collect()
}
