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

use ratatui::buffer::Buffer;
use ratatui::layout::{Position, Rect};

use crate::tui::action::Action;
use crate::tui::app::{App, MapKind, PanelKind, Zoom};
use crate::tui::kinds::Downwards;
use crate::tui::kymograph::SHOWN;
use crate::tui::pixels::{Bitmap, PixelPlot};
use crate::tui::theme::Role;
use crate::tui::view::areas::{Areas, PanelSpacing};
use crate::tui::view::chart::zoomed;
use crate::tui::view::panel::panel;
use crate::tui::view::place::{columns, put, rows};
use asperity_engine::sim::Frame;
use asperity_picture::profile::SurfaceProfile;
use asperity_picture::{Picture, Subject};
use heading::heading;
use motion::motion;
use paint::{MapMark, MapPainter, color_bar, look, mark};
use raster::{MapWindow, Raster, rasterize, rasterize_lines};

/// Columns of the colour bar with its numbers.
const BAR: u16 = 8;

pub(super) fn render(app: &App, areas: &Areas, buffer: &mut Buffer) -> Option<PixelPlot> {
    let (theme, title) = (app.view.theme, heading(app, areas));
    let inner = panel(app, areas, PanelKind::Map, title, buffer);
    let Some(frame) = app.frame() else {
        waiting(app, inner, buffer);
        return None;
    };
    if app.view.map == MapKind::Profile {
        return profile::side_view(app, frame, inner, buffer);
    }
    let look = look(app);
    let room = MapRoom::of(app, frame, areas);
    let (window, image) = (&room.window, room.image);
    if image.is_empty() {
        return None;
    }
    let rows = usize::from(image.height) * if theme.paints() { 2 } else { 1 };
    match picture_of(app, frame, window, (usize::from(image.width), rows)) {
        // Its room stays blank: the terminal's own pixels come there.
        Some(_) if app.is_in_pixels() => {}
        Some(raster) => {
            let painter = MapPainter {
                kind: app.view.map,
                look: &look,
                window,
                raster: &raster,
            };
            painter.paint(theme, image, buffer);
        }
        None => {
            let text = theme.line("no stress is computed in this scene", Role::Dim);
            put(image, image.height / 2, &text, buffer);
        }
    }
    if !app.is_in_pixels() {
        let marks = [(point_at(app, frame), "◆"), (app.view.probe, "╋")];
        for (at, symbol) in marks {
            if let Some(part) = at.and_then(|(x, y)| window.part(x, y)) {
                mark(theme, image, part, symbol, buffer);
            }
        }
    }
    axes::draw(app, frame, window, image, inner, buffer);
    color_bar(theme, &look, app.view.map, room.bar, buffer);
    motion(app, frame, areas, inner, buffer);
    probe(app, frame, &room, buffer);
    None
}

/// The cells that the map fills.
pub(super) fn room(app: &App, areas: &Areas) -> Option<Rect> {
    let frame = app.frame()?;
    let area = if app.view.map == MapKind::Profile {
        profile::rooms(areas.inside(PanelKind::Map)).0
    } else {
        MapRoom::of(app, frame, areas).image
    };
    (!area.is_empty()).then_some(area)
}

/// The map in pixels, so many for a cell.
pub(super) fn pixels(app: &App, areas: &Areas, cell: (u16, u16)) -> Option<Bitmap> {
    let frame = app.frame()?;
    let area = room(app, areas)?;
    if app.view.map == MapKind::Profile {
        return profile::in_pixels(app, frame, area, cell);
    }
    let MapRoom { window, .. } = MapRoom::of(app, frame, areas);
    let raster = picture_of(app, frame, &window, Bitmap::size(area, cell))?;
    let painter = MapPainter {
        kind: app.view.map,
        look: &look(app),
        window: &window,
        raster: &raster,
    };
    let mut picture = Bitmap::of(area, cell, |column, row| painter.rgba(column, row));
    let marks = [
        (point_at(app, frame), MapMark::Diamond),
        (app.view.probe, MapMark::Cross),
    ];
    for (at, mark) in marks {
        if let Some(part) = at.and_then(|(x, y)| window.part(x, y)) {
            mark.draw(&mut picture, part, 0.6 * f64::from(cell.0));
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
        let (area, _) = profile::rooms(areas.inside(PanelKind::Map));
        let across = at.x >= area.x && at.x < area.right() && areas.map.contains(at);
        let part = (f64::from(at.x.saturating_sub(area.x)) + 0.5) / f64::from(area.width.max(1));
        let x = profile.x[0] + part * (profile.x[1] - profile.x[0]);
        return across.then_some(Action::PutPoint(x));
    }
    let MapRoom { window, image, .. } = MapRoom::of(app, frame, areas);
    let part = |place: u16, start: u16, length: u16| {
        (f64::from(place - start) + 0.5) / f64::from(length.max(1))
    };
    image.contains(at).then(|| {
        let x = window.x_at(part(at.x, image.x, image.width));
        Action::Probe(x, window.y_at(part(at.y, image.y, image.height)))
    })
}

fn waiting(app: &App, area: Rect, buffer: &mut Buffer) {
    let theme = app.view.theme;
    let text = match app.run.setup.scene.lubricant {
        Some(_) => "starting: dry Hertz, then film",
        None => "starting: dry Hertz",
    };
    put(area, area.height / 2, &theme.line(text, Role::Dim), buffer);
}

/// Where the map is drawn, and which part of the plane.
struct MapRoom {
    /// The room that the map may fill.
    picture: Rect,
    /// The colour bar with its numbers.
    bar: Rect,
    window: MapWindow,
    /// What it does fill.
    image: Rect,
}

impl MapRoom {
    /// The motion takes the last row (full: and the first), the axes the row above it and the columns at the left.
    fn of(app: &App, frame: &Frame, areas: &Areas) -> Self {
        let inner = areas.inside(PanelKind::Map);
        let above = u16::from(areas.density == PanelSpacing::Full);
        let [left, below] = axes::room(inner);
        let height = inner.height.saturating_sub(1 + above + below);
        let width = inner.width.saturating_sub(BAR + left);
        let whole = rows(inner, above, height);
        let picture = columns(whole, left, width);
        let window = window(app, frame, picture);
        Self {
            picture,
            bar: columns(whole, left + width, inner.width - width),
            image: image_area(app.view.map, &window, picture),
            window,
        }
    }
}

/// The part of the plane that is drawn, in half-widths.
fn window(app: &App, frame: &Frame, picture: Rect) -> MapWindow {
    let (columns, pixels) = (f64::from(picture.width), 2.0 * f64::from(picture.height));
    let zoomed = |from: f64, to: f64| zoomed(app, frame, [from, to]);
    if app.view.map.is_over_time() {
        return MapWindow {
            x: zoomed(-1.6, 1.4),
            y: [-SHOWN, 0.0],
        };
    }
    if app.view.map == MapKind::Stress {
        let depths = frame.slice.as_ref().map(|slice| &slice.depths_m);
        let deepest = depths.and_then(|depths| depths.last());
        let deepest = deepest.map_or(1.0, |depth| depth / frame.a_m);
        let depth = match app.view.zoom {
            Zoom::Contact => deepest.min(1.2),
            Zoom::Domain => deepest,
        };
        return MapWindow {
            x: zoomed(-1.8, 1.8),
            y: [0.0, depth],
        };
    }
    let half = (-frame.y_min_m / frame.b_m).abs().max(0.1);
    let domain = SurfaceProfile::domain(frame);
    let whole = domain[1] - domain[0];
    let (half_height, wanted_x) = match app.view.zoom {
        Zoom::Contact => (half.min(1.15), whole.min(2.6)),
        Zoom::Domain => (half, whole),
    };
    // As many half-widths per pixel as it takes to show the ellipse; then as much as fits.
    let scale = (2.0 * half_height / pixels.max(1.0)).max(wanted_x / columns.max(1.0));
    let across = (0.5 * scale * pixels).min(half);
    let along = scale * columns;
    MapWindow {
        // The contact stays in the middle of the panel.
        x: zoomed(-0.5 * along, 0.5 * along),
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
    let y = match app.view.map.downwards() {
        Downwards::Depth => point.depth_m / frame.a_m,
        // Now is the last row.
        Downwards::Time => -1e-9,
        Downwards::Across => 0.0,
    };
    Some((point.sample.x_m / frame.a_m, y))
}

/// Pressure and film at a place of the centre line, so many passages ago.
fn waves_at(app: &App, frame: &Frame, x: f64, ago: f64) -> Option<(f32, f32)> {
    let span = app.waves()?;
    let i = raster::node_at(frame, x)?;
    let value = |subject| span.line(subject, ago)?.0.get(i).copied();
    value(Subject::Pressure).zip(value(Subject::Film))
}

/// The values at the probe, on the last row of the picture.
fn probe(app: &App, frame: &Frame, room: &MapRoom, buffer: &mut Buffer) {
    let Some((x, y)) = app.view.probe else { return };
    let (p, h) = (app.view.units.pressure(), app.view.units.film());
    let pressure_and_film = |(pressure, film): (f32, f32)| {
        let (p, h) = (p.show(f64::from(pressure), 3), h.show(f64::from(film), 3));
        format!("p {p}  h {h}")
    };
    let text = if app.view.map.is_over_time() {
        waves_at(app, frame, x, -y)
            .map(|values| format!("{:.2} a ago  {}", -4.0 * y, pressure_and_film(values)))
    } else if app.view.map == MapKind::Stress {
        let shown = |stress: f32| p.show(f64::from(stress), 3);
        raster::stress_at(frame, x, y).map(|stress| format!("z {y:.2} a  σ {}", shown(stress)))
    } else {
        raster::plane_at(frame, x, y)
            .map(|values| format!("y {y:.2} b  {}", pressure_and_film(values)))
    };
    if let Some(text) = text {
        let line = app
            .view
            .theme
            .line(format!(" x {x:.2} a  {text} "), Role::Strong);
        let last = (room.image.bottom() - room.picture.y).saturating_sub(1);
        put(room.picture, last, &line, buffer);
    }
}
