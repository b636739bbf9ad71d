//! Centre, above: a field over the plane of the contact, or the stress in the plane below it.
//!
//! Lengths are drawn in half-widths, x/a along and y/b across, so that the Hertz ellipse is a
//! circle. A cell holds two pixels (half blocks); without colour one character of more or less ink.

mod axes;
mod heading;
mod motion;
mod paint;
mod profile;
mod raster;

use ratatui::layout::{Position, Rect};

use crate::tui::action::Action;
use crate::tui::app::{App, MapKind, PanelKind, Zoom};
use crate::tui::kymograph::SHOWN;
use crate::tui::pixels::{Bitmap, PixelPlot};
use crate::tui::theme::{Role, Theme};
use crate::tui::view::areas::{Areas, PanelSpacing};
use crate::tui::view::sheet::{Sheet, inside, panel, with_columns, with_rows};
use asperity_engine::sim::Frame;
use asperity_picture::{Picture, Subject};
use heading::heading;
use motion::motion;
use paint::{MapMark, Pixel, color_bar, look, paint};
use raster::{MapWindow, Raster, rasterize, rasterize_lines};

/// Columns of the colour bar with its numbers.
const BAR: u16 = 8;

pub(super) fn render(app: &App, areas: &Areas, sheet: &mut Sheet<'_>) -> Option<PixelPlot> {
    let (theme, title) = (app.view.theme, heading(app, areas));
    let inner = panel(app, areas, PanelKind::Map, title, sheet);
    let Some(frame) = app.frame() else {
        waiting(app, inner, sheet);
        return None;
    };
    if app.view.map == MapKind::Profile {
        return profile::side_view(app, frame, inner, sheet);
    }
    let (picture, bar) = split(areas, inner);
    let look = look(app);
    let window = window(app, frame, picture);
    let image = image_area(app.view.map, &window, picture);
    if image.is_empty() {
        return None;
    }
    let pixels = (usize::from(image.width), rows(theme, image));
    match picture_of(app, frame, &window, pixels) {
        // Its room stays blank: the terminal's own pixels come there.
        Some(_) if app.is_in_pixels() => {}
        Some(raster) => paint(theme, &raster, &look, &window, app.view.map, image, sheet),
        None => sheet.text(
            image,
            image.height / 2,
            "no stress is computed in this scene",
            Role::Dim,
        ),
    }
    if !app.is_in_pixels() {
        let marks = [(point_at(app, frame), "◆"), (app.view.probe, "╋")];
        for (at, symbol) in marks {
            if let Some(at) = at {
                place(app, &window, image, at, symbol, sheet);
            }
        }
    }
    axes::draw(app, frame, &window, (image, inner), sheet);
    color_bar(theme, &look, app.view.map, bar, sheet);
    motion(app, frame, areas, inner, sheet);
    probe(app, frame, (picture, image), sheet);
    None
}

/// The cells that the map fills.
pub(super) fn room(app: &App, areas: &Areas) -> Option<Rect> {
    let frame = app.frame()?;
    if app.view.map == MapKind::Profile {
        let (area, _) = profile::rooms(inside(areas, areas.map));
        return Some(area).filter(|area| !area.is_empty());
    }
    let (picture, _) = split(areas, inside(areas, areas.map));
    let window = window(app, frame, picture);
    Some(image_area(app.view.map, &window, picture)).filter(|image| !image.is_empty())
}

/// The map in pixels, so many for a cell.
pub(super) fn pixels(app: &App, areas: &Areas, cell: (u16, u16)) -> Option<Bitmap> {
    let frame = app.frame()?;
    let area = room(app, areas)?;
    if app.view.map == MapKind::Profile {
        return profile::in_pixels(app, frame, area, cell);
    }
    let (picture, _) = split(areas, inside(areas, areas.map));
    let window = window(app, frame, picture);
    let look = look(app);
    let side = |cells: u16, each: u16| usize::from(cells) * usize::from(each);
    let (width, height) = (side(area.width, cell.0), side(area.height, cell.1));
    let raster = picture_of(app, frame, &window, (width, height))?;
    let places = (0..height).flat_map(|row| (0..width).map(move |column| (column, row)));
    let rgba = places
        .flat_map(|place| Pixel::of(&look, &raster, &window, app.view.map, place).rgba(&look))
        .collect();
    let mut picture = Bitmap {
        area,
        width,
        height,
        rgba,
    };
    let marks = [
        (point_at(app, frame), MapMark::Diamond),
        (app.view.probe, MapMark::Cross),
    ];
    for (at, mark) in marks {
        if let Some(at) = at {
            mark.draw(&mut picture, &window, at, 0.6 * f64::from(cell.0));
        }
    }
    Some(picture)
}

/// The pixels of the map; `None` where the frame does not hold it.
fn picture_of(
    app: &App,
    frame: &Frame,
    window: &MapWindow,
    pixels: (usize, usize),
) -> Option<Raster> {
    let subject = app.view.map.subject();
    let picture = Picture::of(frame, subject, &app.ranges())?;
    if !app.view.map.is_over_time() {
        return rasterize(&picture, window, pixels);
    }
    let span = app.waves()?;
    rasterize_lines(&picture, window, pixels, |passages| {
        span.line(subject, -passages)
    })
}

/// A press on the picture reads it there.
pub(super) fn pressed(app: &App, areas: &Areas, at: Position) -> Option<Action> {
    let frame = app.frame()?;
    if app.view.map == MapKind::Profile {
        let profile = profile::of(app, frame)?;
        let (area, _) = profile::rooms(inside(areas, areas.map));
        let across = at.x >= area.x && at.x < area.right() && areas.map.contains(at);
        let part = (f64::from(at.x.saturating_sub(area.x)) + 0.5) / f64::from(area.width.max(1));
        let x = profile.x[0] + part * (profile.x[1] - profile.x[0]);
        return across.then_some(Action::PutPoint(x));
    }
    let (picture, _) = split(areas, inside(areas, areas.map));
    let window = window(app, frame, picture);
    let image = image_area(app.view.map, &window, picture);
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

fn waiting(app: &App, area: Rect, sheet: &mut Sheet<'_>) {
    let text = match app.run.setup.scene.lubricant {
        Some(_) => "starting: dry Hertz, then film",
        None => "starting: dry Hertz",
    };
    sheet.text(area, area.height / 2, text, Role::Dim);
}

/// Room for the picture and for the colour bar; the motion takes the last row (full: and the first), the axes the
/// row above it and the columns at the left.
fn split(areas: &Areas, inner: Rect) -> (Rect, Rect) {
    let above = u16::from(areas.density == PanelSpacing::Full);
    let [left, below] = axes::room(inner);
    let picture = Rect {
        x: inner.x + left,
        y: inner.y + above,
        height: inner.height.saturating_sub(1 + above + below),
        width: inner.width.saturating_sub(BAR + left),
    };
    let bar = with_columns(picture, picture.right(), inner.width - picture.width);
    (picture, bar)
}

fn rows(theme: Theme, image: Rect) -> usize {
    usize::from(image.height) * if theme.paints() { 2 } else { 1 }
}

/// The part of the plane that is drawn, in half-widths.
fn window(app: &App, frame: &Frame, picture: Rect) -> MapWindow {
    let (columns, pixels) = (f64::from(picture.width), 2.0 * f64::from(picture.height));
    let x_end = frame.x_min_m + (frame.nx.max(2) - 1) as f64 * frame.dx_m;
    let domain = [frame.x_min_m / frame.a_m, x_end / frame.a_m];
    if app.view.map.is_over_time() {
        let x = match app.view.zoom {
            Zoom::Contact => [domain[0].max(-1.6), domain[1].min(1.4)],
            Zoom::Domain => domain,
        };
        return MapWindow {
            x,
            y: [-SHOWN, 0.0],
        };
    }
    if app.view.map == MapKind::Stress {
        let x = match app.view.zoom {
            Zoom::Contact => [domain[0].max(-1.8), domain[1].min(1.8)],
            Zoom::Domain => domain,
        };
        let deepest = frame
            .slice
            .as_ref()
            .and_then(|slice| slice.depths_m.last())
            .map_or(1.0, |depth| depth / frame.a_m);
        let depth = match app.view.zoom {
            Zoom::Contact => deepest.min(1.2),
            Zoom::Domain => deepest,
        };
        return MapWindow { x, y: [0.0, depth] };
    }
    let half = (-frame.y_min_m / frame.b_m).abs().max(0.1);
    let least = match app.view.zoom {
        Zoom::Contact => half.min(1.15),
        Zoom::Domain => half,
    };
    // As many half-widths per pixel as it takes to show the ellipse; then as much as fits.
    let wanted_x = match app.view.zoom {
        Zoom::Contact => (domain[1] - domain[0]).min(2.6),
        Zoom::Domain => domain[1] - domain[0],
    };
    let scale = (2.0 * least / pixels.max(1.0)).max(wanted_x / columns.max(1.0));
    let across = (0.5 * scale * pixels).min(half);
    let along = scale * columns;
    let x = match app.view.zoom {
        // The contact stays in the middle of the panel.
        Zoom::Contact => [domain[0].max(-0.5 * along), domain[1].min(0.5 * along)],
        Zoom::Domain => domain,
    };
    MapWindow {
        x,
        // y points up, as in all pictures.
        y: [across, -across],
    }
}

/// The picture keeps its shape: x = 0 in the middle of the room there is, as far as that goes.
fn image_area(map: MapKind, window: &MapWindow, picture: Rect) -> Rect {
    if !map.is_plane() || picture.is_empty() {
        return picture;
    }
    let (along, across) = (window.x[1] - window.x[0], window.y[0] - window.y[1]);
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

/// Where the material point is: on the centre line, at its depth, or now.
fn point_at(app: &App, frame: &Frame) -> Option<(f64, f64)> {
    let point = app.point_now()?;
    let y = match app.view.map {
        MapKind::Stress => point.depth_m / frame.a_m,
        // Now is the last row.
        MapKind::PressureWaves | MapKind::FilmWaves => -1e-9,
        _ => 0.0,
    };
    Some((point.sample.x_m / frame.a_m, y))
}

fn place(
    app: &App,
    window: &MapWindow,
    image: Rect,
    (x, y): (f64, f64),
    symbol: &'static str,
    sheet: &mut Sheet<'_>,
) {
    let theme = app.view.theme;
    let part = |value: f64, range: [f64; 2]| (value - range[0]) / (range[1] - range[0]);
    let (along, down) = (part(x, window.x), part(y, window.y));
    if !(0.0..1.0).contains(&along) || !(0.0..1.0).contains(&down) {
        return;
    }
    let at = (
        image.x + (along * f64::from(image.width)) as u16,
        image.y + (down * f64::from(image.height)) as u16,
    );
    if let Some(cell) = sheet.buffer.cell_mut(at) {
        cell.set_symbol(theme.pick(symbol, "X"));
        if theme.paints() {
            cell.set_fg(theme.rgb([255, 255, 255]));
        } else {
            cell.set_style(theme.style(Role::Strong));
        }
    }
}

/// Pressure and film at a place of the centre line, so many passages ago.
fn waves_at(app: &App, frame: &Frame, x: f64, ago: f64) -> Option<(f32, f32)> {
    let span = app.waves()?;
    let i = raster::node_at(frame, x)?;
    let value = |subject| span.line(subject, ago)?.0.get(i).copied();
    value(Subject::Pressure).zip(value(Subject::Film))
}

/// The values at the probe, on the last row of the picture.
fn probe(app: &App, frame: &Frame, (picture, image): (Rect, Rect), sheet: &mut Sheet<'_>) {
    let Some((x, y)) = app.view.probe else { return };
    let theme = app.view.theme;
    let pressure_and_film = |(pressure, film): (f32, f32)| {
        let (p, h) = (app.view.units.pressure(), app.view.units.film());
        format!(
            "p {}  h {}",
            p.show(f64::from(pressure), 3),
            h.show(f64::from(film), 3)
        )
    };
    let text = if app.view.map.is_over_time() {
        waves_at(app, frame, x, -y).map(|values| {
            let values = pressure_and_film(values);
            format!("x {x:.2} a  {:.2} a ago  {values}", -4.0 * y)
        })
    } else if app.view.map == MapKind::Stress {
        raster::stress_at(frame, x, y).map(|stress| {
            format!(
                "x {x:.2} a  z {y:.2} a  σ {}",
                app.view.units.pressure().show(f64::from(stress), 3)
            )
        })
    } else {
        raster::plane_at(frame, x, y)
            .map(|values| format!("x {x:.2} a  y {y:.2} b  {}", pressure_and_film(values)))
    };
    if let Some(text) = text {
        let line = theme.line(format!(" {} ", theme.text(&text)), Role::Strong);
        let row = with_rows(picture, image.bottom() - 1, 1);
        sheet.line(row, 0, &line);
    }
}
