//! Centre, above: a field over the plane of the contact, or the stress in the plane below it.
//!
//! Lengths are drawn in half-widths, x/a along and y/b across, so that the Hertz ellipse is a
//! circle. A cell holds two pixels (half blocks); without colour one character of more or less ink.

mod raster;

use ratatui::buffer::Buffer;
use ratatui::layout::{Position, Rect};
use ratatui::text::{Line, Span};

use crate::sim::Frame;
use crate::tui::action::Action;
use crate::tui::app::{App, MapKind, Zoom};
use crate::tui::theme::{Ramp, Role, Theme};
use crate::tui::units::{Unit, sig, tick};
use crate::tui::view::{Areas, Density, ascii_text, inside, panel, put, put_right, title};
use raster::{Raster, Window, rasterize};

/// Columns of the colour bar with its numbers.
const BAR: u16 = 8;

/// What a map shows: scale, unit and colours.
struct Look {
    ramp: Ramp,
    low: f64,
    high: f64,
    unit: Unit,
}

pub(super) fn render(app: &App, areas: &Areas, buffer: &mut Buffer) {
    let theme = app.theme;
    let inner = panel(theme, areas, areas.map, heading(app), buffer);
    let Some(frame) = app.frame() else {
        waiting(app, inner, buffer);
        return;
    };
    let (picture, bar) = split(areas, inner);
    let look = look(app);
    let window = window(app, frame, picture);
    let image = image_area(&window, picture);
    if image.is_empty() {
        return;
    }
    match rasterize(
        frame,
        app.map,
        &window,
        usize::from(image.width),
        rows(theme, image),
    ) {
        Some(raster) => paint(theme, &raster, &look, &window, app.map, image, buffer),
        None => put(
            image,
            image.height / 2,
            &Line::styled("this scene computes no stress", theme.style(Role::Dim)),
            buffer,
        ),
    }
    marker(app, frame, &window, image, buffer);
    color_bar(theme, &look, app.map, bar, buffer);
    motion(app, frame, areas, inner, buffer);
    probe(app, frame, &window, (picture, image), buffer);
}

/// A press on the picture reads it there.
pub(super) fn pressed(app: &App, areas: &Areas, at: Position) -> Option<Action> {
    let frame = app.frame()?;
    let (picture, _) = split(areas, inside(areas, areas.map));
    let window = window(app, frame, picture);
    let image = image_area(&window, picture);
    image.contains(at).then(|| {
        let part = |place: u16, start: u16, length: u16| {
            (f64::from(place - start) + 0.5) / f64::from(length.max(1))
        };
        Action::Probe(
            window.x_at(part(at.x, image.x, image.width)),
            window.y_at(part(at.y, image.y, image.height)),
        )
    })
}

fn heading(app: &App) -> Line<'static> {
    let theme = app.theme;
    let mut line = title(theme, "m", app.map.name());
    let note = match (app.map, app.zoom) {
        (MapKind::Stress, _) => "x–z plane, y = 0 ",
        (_, Zoom::Domain) => "whole domain ",
        (_, Zoom::Contact) => "",
    };
    line.push_span(Span::styled(
        ascii_text(theme, note),
        theme.style(Role::Dim),
    ));
    line
}

fn waiting(app: &App, area: Rect, buffer: &mut Buffer) {
    let theme = app.theme;
    let text = "starting: dry Hertz, then film";
    put(
        area,
        area.height / 2,
        &Line::styled(text, theme.style(Role::Dim)),
        buffer,
    );
}

/// Room for the picture and for the colour bar; the motion takes the last row (full: and the first).
fn split(areas: &Areas, inner: Rect) -> (Rect, Rect) {
    let above = u16::from(areas.density == Density::Full);
    let picture = Rect {
        y: inner.y + above,
        height: inner.height.saturating_sub(1 + above),
        width: inner.width.saturating_sub(BAR),
        ..inner
    };
    let bar = Rect {
        x: picture.right(),
        width: inner.width - picture.width,
        ..picture
    };
    (picture, bar)
}

fn rows(theme: Theme, image: Rect) -> usize {
    usize::from(image.height) * if theme.paints() { 2 } else { 1 }
}

/// The part of the plane that is drawn, in half-widths.
fn window(app: &App, frame: &Frame, picture: Rect) -> Window {
    let (columns, pixels) = (f64::from(picture.width), 2.0 * f64::from(picture.height));
    let x_end = frame.x_min_m + (frame.nx.max(2) - 1) as f64 * frame.dx_m;
    let domain = [frame.x_min_m / frame.a_m, x_end / frame.a_m];
    if app.map == MapKind::Stress {
        let x = match app.zoom {
            Zoom::Contact => [domain[0].max(-1.8), domain[1].min(1.8)],
            Zoom::Domain => domain,
        };
        let deepest = frame
            .slice
            .as_ref()
            .and_then(|slice| slice.depths_m.last())
            .map_or(1.0, |depth| depth / frame.a_m);
        let depth = match app.zoom {
            Zoom::Contact => deepest.min(1.2),
            Zoom::Domain => deepest,
        };
        return Window { x, y: [0.0, depth] };
    }
    let half = (-frame.y_min_m / frame.b_m).abs().max(0.1);
    let least = match app.zoom {
        Zoom::Contact => half.min(1.15),
        Zoom::Domain => half,
    };
    // As many half-widths per pixel as it takes to show the ellipse; then as much as fits.
    let wanted_x = match app.zoom {
        Zoom::Contact => (domain[1] - domain[0]).min(2.6),
        Zoom::Domain => domain[1] - domain[0],
    };
    let scale = (2.0 * least / pixels.max(1.0)).max(wanted_x / columns.max(1.0));
    let across = (0.5 * scale * pixels).min(half);
    let along = scale * columns;
    let x = match app.zoom {
        // The contact stays in the middle of the panel.
        Zoom::Contact => [domain[0].max(-0.5 * along), domain[1].min(0.5 * along)],
        Zoom::Domain => domain,
    };
    Window {
        x,
        y: [-across, across],
    }
}

/// The picture keeps its shape: x = 0 in the middle of the room there is, as far as that goes.
fn image_area(window: &Window, picture: Rect) -> Rect {
    if window.y[0] == 0.0 || picture.is_empty() {
        return picture;
    }
    let (along, across) = (window.x[1] - window.x[0], window.y[1] - window.y[0]);
    let scale = (along / f64::from(picture.width)).max(across / (2.0 * f64::from(picture.height)));
    let width = ((along / scale).round() as u16).clamp(1, picture.width);
    let height = ((0.5 * across / scale).round() as u16).clamp(1, picture.height);
    let middle = 0.5 * f64::from(picture.width) + window.x[0] / scale;
    let spare = picture.width - width;
    Rect {
        x: picture.x + (middle.round().max(0.0) as u16).min(spare),
        y: picture.y + (picture.height - height) / 2,
        width,
        height,
    }
}

fn look(app: &App) -> Look {
    let ranges = &app.ranges;
    let (ramp, low, high, unit) = match app.map {
        MapKind::Pressure | MapKind::Contact => {
            (Ramp::Heat, 0.0, ranges.pressure_pa, app.units.pressure())
        }
        MapKind::Film => (Ramp::Depth, 0.0, ranges.film_m, app.units.film()),
        MapKind::Roughness => (
            Ramp::Diverging,
            -ranges.height_m,
            ranges.height_m,
            app.units.height(),
        ),
        MapKind::Stress => (Ramp::Heat, 0.0, ranges.stress_pa, app.units.pressure()),
    };
    Look {
        ramp,
        low,
        high: if high > low { high } else { low + 1.0 },
        unit,
    }
}

impl Look {
    /// Place of a value on the colour map. Deep film is dark, so that where it collapses shines.
    fn part(&self, value: f64) -> f32 {
        let part = ((value - self.low) / (self.high - self.low)) as f32;
        match self.ramp {
            Ramp::Depth => 1.0 - part,
            Ramp::Heat | Ramp::Diverging => part,
        }
    }
}

fn paint(
    theme: Theme,
    raster: &Raster,
    look: &Look,
    window: &Window,
    kind: MapKind,
    image: Rect,
    buffer: &mut Buffer,
) {
    let pixel = |column: usize, row: usize| {
        let t = look.part(f64::from(raster.at(column, row)));
        let spot = kind == MapKind::Contact && raster.spot(column, row);
        let ring = kind != MapKind::Stress && on_ellipse(window, raster, column, row);
        if spot {
            theme.rgb([120, 214, 255])
        } else if kind == MapKind::Contact {
            theme.map_color(look.ramp, 0.45 * t)
        } else if ring {
            theme.map_color_lit(look.ramp, t, 0.35)
        } else {
            theme.map_color(look.ramp, t)
        }
    };
    for row in 0..usize::from(image.height) {
        for column in 0..usize::from(image.width) {
            let at = (image.x + column as u16, image.y + row as u16);
            let Some(cell) = buffer.cell_mut(at) else {
                continue;
            };
            if theme.paints() {
                cell.set_symbol("▀")
                    .set_fg(pixel(column, 2 * row))
                    .set_bg(pixel(column, 2 * row + 1));
            } else {
                let ring = kind != MapKind::Stress && on_ellipse(window, raster, column, row);
                cell.set_symbol(ink(look, raster, kind, ring, column, row));
            }
        }
    }
}

fn ink(
    look: &Look,
    raster: &Raster,
    kind: MapKind,
    ring: bool,
    column: usize,
    row: usize,
) -> &'static str {
    let t = look.part(f64::from(raster.at(column, row)));
    match kind {
        MapKind::Contact if raster.spot(column, row) => "#",
        MapKind::Contact if ring => "o",
        MapKind::Contact => Theme::map_ink(0.3 * t),
        _ => Theme::map_ink(t),
    }
}

/// Whether the Hertz ellipse passes through a pixel.
fn on_ellipse(window: &Window, raster: &Raster, column: usize, row: usize) -> bool {
    let x = window.x_at((column as f64 + 0.5) / raster.columns as f64);
    let y = window.y_at((row as f64 + 0.5) / raster.rows as f64);
    let pixel = (window.x[1] - window.x[0]) / raster.columns as f64;
    (x.hypot(y) - 1.0).abs() < 0.5 * pixel
}

/// Where the material point is: on the centre line, or at its depth.
fn marker(app: &App, frame: &Frame, window: &Window, image: Rect, buffer: &mut Buffer) {
    let Some(point) = &frame.material_point else {
        return;
    };
    let y = if app.map == MapKind::Stress {
        point.depth_m / frame.a_m
    } else {
        0.0
    };
    place(app, window, image, (point.x_m / frame.a_m, y), "◆", buffer);
}

fn place(
    app: &App,
    window: &Window,
    image: Rect,
    (x, y): (f64, f64),
    symbol: &'static str,
    buffer: &mut Buffer,
) {
    let theme = app.theme;
    let part = |value: f64, range: [f64; 2]| (value - range[0]) / (range[1] - range[0]);
    let (along, down) = (part(x, window.x), part(y, window.y));
    if !(0.0..1.0).contains(&along) || !(0.0..1.0).contains(&down) {
        return;
    }
    let at = (
        image.x + (along * f64::from(image.width)) as u16,
        image.y + (down * f64::from(image.height)) as u16,
    );
    if let Some(cell) = buffer.cell_mut(at) {
        cell.set_symbol(theme.pick(symbol, "X"));
        if theme.paints() {
            cell.set_fg(theme.rgb([255, 255, 255]));
        } else {
            cell.set_style(theme.style(Role::Strong));
        }
    }
}

/// The values at the probe, on the last row of the picture.
fn probe(
    app: &App,
    frame: &Frame,
    window: &Window,
    (picture, image): (Rect, Rect),
    buffer: &mut Buffer,
) {
    let Some((x, y)) = app.probe else { return };
    place(app, window, image, (x, y), "╋", buffer);
    let theme = app.theme;
    let text = if app.map == MapKind::Stress {
        raster::stress_at(frame, x, y).map(|stress| {
            format!(
                "x {x:.2} a  z {y:.2} a  σ {}",
                app.units.pressure().show(f64::from(stress), 3)
            )
        })
    } else {
        raster::plane_at(frame, x, y).map(|(pressure, film)| {
            format!(
                "x {x:.2} a  y {y:.2} b  p {}  h {}",
                app.units.pressure().show(f64::from(pressure), 3),
                app.units.film().show(f64::from(film), 3)
            )
        })
    };
    if let Some(text) = text {
        let line = Line::styled(
            format!(" {} ", ascii_text(theme, &text)),
            theme.style(Role::Strong),
        );
        let row = Rect {
            y: image.bottom() - 1,
            height: 1,
            ..picture
        };
        put(row, 0, &line, buffer);
    }
}

fn color_bar(theme: Theme, look: &Look, kind: MapKind, bar: Rect, buffer: &mut Buffer) {
    if bar.width < 4 || bar.height < 3 {
        return;
    }
    let pixels = f64::from(2 * bar.height - 1);
    for row in 0..bar.height {
        let part = |half: u16| {
            let down = f64::from(2 * row + half) / pixels;
            look.part(look.high - (look.high - look.low) * down)
        };
        if let Some(cell) = buffer.cell_mut((bar.x + 1, bar.y + row)) {
            if theme.paints() {
                let dim = if kind == MapKind::Contact { 0.45 } else { 1.0 };
                cell.set_symbol("▀")
                    .set_fg(theme.map_color(look.ramp, dim * part(0)))
                    .set_bg(theme.map_color(look.ramp, dim * part(1)));
            } else {
                cell.set_symbol(Theme::map_ink(part(0)));
            }
        }
    }
    let text = Rect {
        x: bar.x + 3,
        width: bar.width - 3,
        ..bar
    };
    let dim = theme.style(Role::Dim);
    let number = |value: f64| Line::styled(tick(look.unit.of(value)), dim);
    put(text, 0, &number(look.high), buffer);
    put(
        text,
        1,
        &Line::styled(ascii_text(theme, look.unit.name), dim),
        buffer,
    );
    if bar.height >= 7 {
        put(
            text,
            bar.height / 2,
            &number(0.5 * (look.low + look.high)),
            buffer,
        );
    }
    put(text, bar.height - 1, &number(look.low), buffer);
    if kind == MapKind::Contact && bar.height >= 9 {
        let spot = Line::from(vec![
            Span::styled(theme.pick("█", "#"), theme.style(Role::Film)),
            Span::styled("spot", dim),
        ]);
        put(text, bar.height - 3, &spot, buffer);
    }
}

/// Both bodies' motion: chevrons that travel as far as the body does, in the picture's scale.
fn motion(app: &App, frame: &Frame, areas: &Areas, inner: Rect, buffer: &mut Buffer) {
    let metrics = &frame.metrics;
    let mean = metrics.entrainment_m_s;
    let slide = 0.5 * metrics.slide_roll;
    let bodies = [
        ("2", mean * (1.0 + slide), Role::Body2),
        ("1", mean * (1.0 - slide), Role::Body1),
    ];
    let last = inner.height.saturating_sub(1);
    if areas.density == Density::Full {
        for ((name, speed, role), row) in bodies.into_iter().zip([0, last]) {
            let row = Rect {
                y: inner.y + row,
                height: 1,
                ..inner
            };
            strip(app, frame, name, speed, role, row, buffer);
        }
        return;
    }
    let half = inner.width / 2;
    for ((name, speed, role), x) in bodies.into_iter().zip([0, half + 1]) {
        let row = Rect {
            x: inner.x + x,
            y: inner.y + last,
            width: half.saturating_sub(1),
            height: 1,
        };
        strip(app, frame, name, speed, role, row, buffer);
    }
}

/// Columns from one chevron to the next.
const PITCH: i64 = 4;

fn strip(
    app: &App,
    frame: &Frame,
    name: &str,
    speed_m_s: f64,
    role: Role,
    row: Rect,
    buffer: &mut Buffer,
) {
    let theme = app.theme;
    let style = theme.style(role);
    let body = if row.width >= 30 { "body " } else { "" };
    let label = Line::styled(format!("{body}{name} "), style);
    let unit = app.units.speed();
    let value = if row.width >= 30 {
        format!(" {}", unit.show(speed_m_s, 3))
    } else {
        format!(" {}", sig(unit.of(speed_m_s), 3))
    };
    let value = Line::styled(value, style);
    let (before, after) = (label.width() as u16, value.width() as u16);
    put(row, 0, &label, buffer);
    put_right(row, 0, &value, buffer);
    let columns = row.width.saturating_sub(before + after);
    // One column is about a tenth of a half-width: slow enough to follow, and both bodies alike.
    let travelled = speed_m_s * frame.time_s / (0.1 * frame.a_m.max(1e-12));
    let shift = (travelled.rem_euclid(PITCH as f64)) as i64;
    let arrow = if speed_m_s > 0.0 {
        theme.pick("›", ">")
    } else if speed_m_s < 0.0 {
        theme.pick("‹", "<")
    } else {
        theme.pick("·", ".")
    };
    for column in 0..columns {
        if (i64::from(column) - shift).rem_euclid(PITCH) == 0
            && let Some(cell) = buffer.cell_mut((row.x + before + column, row.y))
        {
            cell.set_symbol(arrow).set_style(style);
        }
    }
}
