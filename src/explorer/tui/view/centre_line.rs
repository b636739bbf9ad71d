//! Centre, below: the figure that every text on lubrication has: pressure and film along the
//! centre line, with the Hertz pressure behind them.

use ratatui::buffer::Buffer;
use ratatui::layout::Rect;
use ratatui::text::{Line, Span};

use crate::tui::app::{App, PanelKind};
use crate::tui::pixels::PixelPlot;
use crate::tui::theme::Role;
use crate::tui::units::tick;
use crate::tui::view::areas::Areas;
use crate::tui::view::chart::{CurvePanel, Pen, Plot, zoomed};
use crate::tui::view::panel::{panel, title};
use crate::tui::view::place::{columns, columns_from, put, put_right, rows};
use asperity_engine::sim::Frame;

/// Columns of the numbers on either side.
const AXIS: u16 = 5;

pub(super) fn render(app: &App, areas: &Areas, buffer: &mut Buffer) -> Option<PixelPlot> {
    let inner = panel(
        app,
        areas,
        PanelKind::CentreLine,
        heading(app, areas),
        buffer,
    );
    let frame = app.frame()?;
    if inner.height < 3 || inner.width < 2 * AXIS + 8 {
        return None;
    }
    let plot = Plot {
        area: columns(
            rows(inner, 0, inner.height - 1),
            AXIS,
            inner.width - 2 * AXIS,
        ),
        x: zoomed(app, frame, [-1.6, 1.4]),
        y: [0.0, 1.0],
    };
    let curves = curves(app, frame, plot, buffer);
    axes(app, inner, &plot, buffer);
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
    let film = if theme.is_mono() { "╌" } else { "━" };
    for (mark, plain, text, role) in [
        ("━", "p ", "pressure", Role::Pressure),
        (film, "h ", "film", Role::Film),
        ("┄", ". ", "Hertz", Role::Hertz),
    ] {
        let mark = theme.pick(mark, plain);
        line.push_span(Span::styled(format!("{mark}{text} "), theme.style(role)));
    }
    line
}

fn curves(app: &App, frame: &Frame, plot: Plot, buffer: &mut Buffer) -> Option<PixelPlot> {
    let pen = |role: Role, letter: char| Pen::new(app.view.theme, role, letter);
    let hertz = frame.p_hertz_pa / app.run.axis_ends.pressure_pa.max(1.0);
    let mut chart = CurvePanel::new(plot);
    chart.hertz(hertz, pen(Role::Hertz, '.'));
    let film = row(frame, &frame.film_m, app.run.axis_ends.film_m);
    chart.line(film, pen(Role::Film, 'h'));
    let pressure = row(frame, &frame.pressure_pa, app.run.axis_ends.pressure_pa);
    chart.line(pressure, pen(Role::Pressure, 'p'));
    if let Some(point) = &frame.material_point {
        chart.upright(point.x_m / frame.a_m, pen(Role::Dim, ':'));
    }
    chart.render(app, buffer)
}

/// The middle row of a field: x/a and the value over the range's end.
fn row<'a>(
    frame: &'a Frame,
    field: &'a [f32],
    full_scale: f64,
) -> impl Iterator<Item = (f64, f64)> + 'a {
    let scale = if full_scale > 0.0 {
        1.0 / full_scale
    } else {
        0.0
    };
    let values = frame.centre_line(field).iter().enumerate();
    values.map(move |(i, value)| (frame.x_over_a(i), f64::from(*value) * scale))
}

/// Pressure at the left, film at the right, x/a below.
fn axes(app: &App, inner: Rect, plot: &Plot, buffer: &mut Buffer) {
    let theme = app.view.theme;
    let (pressure, film) = (app.view.units.pressure(), app.view.units.film());
    let left = columns(inner, 0, AXIS - 1);
    let right = columns_from(inner, inner.width - AXIS + 1);
    let last = plot.area.height - 1;
    // A number in the middle only where a row is in the middle.
    let has_middle = plot.area.height >= 7 && last.is_multiple_of(2);
    let middle = has_middle.then_some((last / 2, 0.5));
    for (row, part) in [(0, 1.0), (last, 0.0)].into_iter().chain(middle) {
        let p = tick(pressure.of(app.run.axis_ends.pressure_pa * part));
        put_right(left, row, &theme.line(p, Role::Pressure), buffer);
        let h = tick(film.of(app.run.axis_ends.film_m * part));
        put(right, row, &theme.line(h, Role::Film), buffer);
    }
    let foot = last + 1;
    put_right(
        left,
        foot,
        &theme.line(pressure.name, Role::Pressure),
        buffer,
    );
    put(right, foot, &theme.line(film.name, Role::Film), buffer);
    plot.half_widths(theme, plot.area.bottom(), buffer);
}
