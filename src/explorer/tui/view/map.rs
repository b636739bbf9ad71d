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

use ratatui::layout::{Position, Rect, Size};
use ratatui::style::Style;

use crate::tui::action::Action;
use crate::tui::app::{App, MapKind, PanelKind, Zoom};
use crate::tui::kymograph::SHOWN;
use crate::tui::pixels::{Bitmap, PixelPlot};
use crate::tui::theme::{Role, Theme};
use crate::tui::view::areas::{Areas, PanelSpacing};
use crate::tui::view::sheet::{Sheet, inside, panel, with_columns};
use asperity_engine::sim::Frame;
use asperity_picture::{Picture, Subject};
use heading::heading;
use motion::motion;
use paint::{MapMark, Pixel, color_bar, look, paint};
use raster::{MapWindow, Raster, rasterize, rasterize_lines};

/// Columns of the colour bar with its numbers.
const BAR: u16 = 8;

/// Where a map is drawn, and which part of the plane it shows.
struct MapLayout {
    window: MapWindow,
    /// The room for the map.
    room: Rect,
    /// Its cells: all of the room, or as many as keep its shape.
    image: Rect,
    /// The cells of the colour bar.
    bar: Rect,
}

impl MapLayout {
    fn of(app: &App, areas: &Areas, frame: &Frame) -> Self {
        let (room, bar) = split(areas, inside(areas, areas.map));
        let window = window(app, frame, room);
        Self {
            window,
            room,
            image: image_area(app.view.map, &window, room),
            bar,
        }
    }
}

pub(super) fn render(app: &App, areas: &Areas, sheet: &mut Sheet<'_>) -> Option<PixelPlot> {
    let title = heading(app, areas);
    let inner = panel(app, areas, PanelKind::Map, title, sheet);
    let Some(frame) = app.frame() else {
        waiting(app, inner, sheet);
        return None;
    };
    if app.view.map == MapKind::Profile {
        return profile::side_view(app, frame, inner, sheet);
    }
    let layout = MapLayout::of(app, areas, frame);
    let (window, image) = (&layout.window, layout.image);
    if image.is_empty() {
        return None;
    }
    let look = look(app);
    let (columns, rows) = (usize::from(image.width), pixel_rows(sheet.theme, image));
    match picture_of(app, frame, window, columns, rows) {
        // Its room stays blank: a page's own pixels come there.
        Some(_) if app.is_in_pixels() => {}
        Some(raster) => paint(&raster, &look, window, app.view.map, image, sheet),
        None => {
            let words = "no stress is computed in this scene";
            sheet.text(image, image.height / 2, words, Role::Dim);
        }
    }
    if !app.is_in_pixels() {
        let marks = [(point_at(app, frame), "◆"), (app.view.probe, "╋")];
        for (at, symbol) in marks {
            if let Some(part) = at.and_then(|(x, y)| window.part(x, y)) {
                white_mark(image, part, symbol, sheet);
            }
        }
    }
    axes::draw(app, frame, &layout, inner, sheet);
    color_bar(&look, app.view.map, layout.bar, sheet);
    motion(app, frame, areas, inner, sheet);
    probe(app, frame, &layout, sheet);
    None
}

/// The cells that the map fills.
pub(super) fn room(app: &App, areas: &Areas) -> Option<Rect> {
    let frame = app.frame()?;
    let area = match app.view.map {
        MapKind::Profile => profile::rooms(inside(areas, areas.map)).0,
        _ => MapLayout::of(app, areas, frame).image,
    };
    (!area.is_empty()).then_some(area)
}

/// The map in pixels, so many for a cell.
pub(super) fn pixels(app: &App, areas: &Areas, cell: Size) -> Option<Bitmap> {
    let frame = app.frame()?;
    let area = room(app, areas)?;
    if app.view.map == MapKind::Profile {
        return profile::in_pixels(app, frame, area, cell);
    }
    let window = MapLayout::of(app, areas, frame).window;
    let look = look(app);
    let mut picture = Bitmap::blank(area, cell);
    let (columns, rows) = (picture.width, picture.height);
    let raster = picture_of(app, frame, &window, columns, rows)?;
    picture.rgba = (0..rows)
        .flat_map(|row| (0..columns).map(move |column| (column, row)))
        .flat_map(|(column, row)| {
            Pixel::of(&look, &raster, &window, app.view.map, column, row).rgba(&look)
        })
        .collect();
    let marks = [
        (point_at(app, frame), MapMark::Diamond),
        (app.view.probe, MapMark::Cross),
    ];
    for (at, mark) in marks {
        if let Some(part) = at.and_then(|(x, y)| window.part(x, y)) {
            mark.draw(&mut picture, part, 0.6 * f64::from(cell.width));
        }
    }
    Some(picture)
}

/// The pixels of the map; `None` where the frame does not hold it.
fn picture_of(
    app: &App,
    frame: &Frame,
    window: &MapWindow,
    columns: usize,
    rows: usize,
) -> Option<Raster> {
    let subject = app.view.map.subject();
    let picture = Picture::of(frame, subject, &app.ranges())?;
    if !app.view.map.is_over_time() {
        return rasterize(&picture, window, columns, rows);
    }
    let span = app.waves()?;
    rasterize_lines(&picture, window, columns, rows, |passages| {
        span.line(subject, -passages)
    })
}

/// A press on the picture reads it there.
pub(super) fn pressed(app: &App, areas: &Areas, at: Position) -> Option<Action> {
    let frame = app.frame()?;
    let part = |place: u16, start: u16, length: u16| {
        (f64::from(place.saturating_sub(start)) + 0.5) / f64::from(length.max(1))
    };
    if app.view.map == MapKind::Profile {
        let profile = profile::of(app, frame)?;
        let (area, _) = profile::rooms(inside(areas, areas.map));
        let across = at.x >= area.x && at.x < area.right() && areas.map.contains(at);
        let along = part(at.x, area.x, area.width);
        let x = profile.x[0] + along * (profile.x[1] - profile.x[0]);
        return across.then_some(Action::PutPoint(x));
    }
    let MapLayout { window, image, .. } = MapLayout::of(app, areas, frame);
    image.contains(at).then(|| {
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

fn pixel_rows(theme: Theme, image: Rect) -> usize {
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

/// A mark at a part (0 to 1 along and down) of a map.
fn white_mark(image: Rect, part: [f64; 2], symbol: &'static str, sheet: &mut Sheet<'_>) {
    let theme = sheet.theme;
    let x = image.x + (part[0] * f64::from(image.width)) as u16;
    let y = image.y + (part[1] * f64::from(image.height)) as u16;
    let style = if theme.paints() {
        Style::new().fg(theme.rgb([255, 255, 255]))
    } else {
        theme.style(Role::Strong)
    };
    sheet.cell(x, y, theme.pick(symbol, "X"), style);
}

/// Pressure and film at a place of the centre line, so many passages ago.
fn waves_at(app: &App, frame: &Frame, x: f64, ago: f64) -> Option<(f32, f32)> {
    let span = app.waves()?;
    let i = raster::node_at(frame, x)?;
    let value = |subject| span.line(subject, ago)?.0.get(i).copied();
    value(Subject::Pressure).zip(value(Subject::Film))
}

/// The values at the probe, on the last row of the picture.
fn probe(app: &App, frame: &Frame, layout: &MapLayout, sheet: &mut Sheet<'_>) {
    let Some((x, y)) = app.view.probe else { return };
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
        let row = layout.image.bottom() - 1 - layout.room.y;
        sheet.text(layout.room, row, format!(" {text} "), Role::Strong);
    }
}
