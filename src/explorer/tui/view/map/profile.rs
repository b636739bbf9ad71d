//! The map of the profile: [`SurfaceProfile`] in half blocks, characters or the terminal's own pixels.

use ratatui::layout::Rect;
use ratatui::text::Line;

use super::paint::MapMark;
use super::raster::MapWindow;
use crate::tui::app::{App, Zoom};
use crate::tui::pixels::{Bitmap, PixelPlot};
use crate::tui::theme::Role;
use crate::tui::units::{sig, tick};
use crate::tui::view::point;
use crate::tui::view::sheet::{Sheet, with_columns, with_rows};
use asperity_engine::sim::Frame;
use asperity_picture::profile::{Matter, ProfileColumn, ProfileScale, SurfaceProfile};

/// Rows of half blocks from which the trace has room below.
const ROWS_WITH_TRACE: u16 = 14;

/// The profile that the explorer shows of a frame.
pub(super) fn of<'a>(app: &App, frame: &'a Frame) -> Option<SurfaceProfile<'a>> {
    let domain = SurfaceProfile::domain(frame);
    let x = match app.view.zoom {
        Zoom::Contact => [domain[0].max(-1.5), domain[1].min(1.4)],
        Zoom::Domain => domain,
    };
    let amplitude_m = frame.metrics.amplitude_1_m.max(frame.metrics.amplitude_2_m);
    let scale = ProfileScale::of(&app.run.setup.scene, app.run.axis_ends.film_m, amplitude_m);
    SurfaceProfile::new(frame, scale, x, &app.ranges())
}

/// How many times larger heights are drawn than lengths; 1 where nothing is drawn.
pub(super) fn exaggeration(app: &App, area: Rect) -> f64 {
    let frame = app.frame();
    let Some((profile, frame)) = frame.and_then(|frame| Some((of(app, frame)?, frame))) else {
        return 1.0;
    };
    let length_m = (profile.x[1] - profile.x[0]) * frame.a_m / f64::from(area.width.max(1));
    // A cell is twice as high as it is wide.
    let height_m = 2.0 * profile.half_m() / (2.0 * f64::from(area.height.max(1)));
    length_m / height_m
}

/// A character, for screens without colours.
fn letter(matter: Matter) -> &'static str {
    match matter {
        Matter::Touching => "#",
        Matter::Oil(_) => " ",
        Matter::Body(1, ..) => ":",
        Matter::Body(..) => "+",
    }
}

/// Where the profile is drawn, where numbers stand at its left, and where the trace below it.
pub(super) fn rooms(inner: Rect) -> (Rect, Option<Rect>) {
    const LEFT: u16 = 6;
    let rows = inner.height.saturating_sub(1);
    let above = if inner.height >= ROWS_WITH_TRACE {
        rows * 3 / 5
    } else {
        rows
    };
    let profile = Rect {
        x: inner.x + LEFT,
        width: inner.width.saturating_sub(LEFT),
        height: above,
        ..inner
    };
    let below = with_rows(
        profile,
        profile.bottom() + 1,
        rows.saturating_sub(above + 2),
    );
    let trace = (below.height >= 3).then_some(below);
    (profile, trace)
}

/// Both surfaces with the oil between them, and below them the trace of the point that rides on one.
pub(super) fn side_view(
    app: &App,
    frame: &Frame,
    inner: Rect,
    sheet: &mut Sheet<'_>,
) -> Option<PixelPlot> {
    let profile = of(app, frame)?;
    let (area, below) = rooms(inner);
    draw(app, (&profile, frame), (area, inner), sheet);
    point::under_profile(app, frame, (below?, profile.x), sheet)
}

/// Draws the profile, where it is not left to the terminal's own pixels, and its numbers.
fn draw(
    app: &App,
    (profile, frame): (&SurfaceProfile, &Frame),
    (area, inner): (Rect, Rect),
    sheet: &mut Sheet<'_>,
) {
    let theme = app.view.theme;
    let rows = usize::from(area.height) * if theme.paints() { 2 } else { 1 };
    let columns = if app.is_in_pixels() {
        Vec::new()
    } else {
        profile.columns(usize::from(area.width)).collect()
    };
    for (x, column) in (area.x..).zip(&columns) {
        for row in 0..area.height {
            let Some(cell) = sheet.buffer.cell_mut((x, area.y + row)) else {
                continue;
            };
            let row = usize::from(row);
            if theme.paints() {
                let color = |row: usize| theme.rgb(profile.rgb(profile.at(column, row, rows)));
                cell.set_symbol("▀")
                    .set_fg(color(2 * row))
                    .set_bg(color(2 * row + 1));
            } else {
                cell.set_symbol(letter(profile.at(column, row, rows)));
            }
        }
    }
    numbers(app, profile, area, inner, sheet);
    let cell = |part: f64, cells: u16| (part * f64::from(cells)) as u16;
    if !app.is_in_pixels()
        && let Some([along, down]) = point_part(app, (profile, frame))
        && let (column, row) = (cell(along, area.width), cell(down, area.height))
        && let Some(cell) = sheet.buffer.cell_mut((area.x + column, area.y + row))
    {
        cell.set_symbol(theme.pick("◆", "X"));
        if theme.paints() {
            cell.set_fg(theme.rgb([255, 255, 255]));
        } else {
            cell.set_style(theme.style(Role::Strong));
        }
    }
}

/// The followed point, riding on its body: parts of the picture along and down.
fn point_part(app: &App, (profile, frame): (&SurfaceProfile, &Frame)) -> Option<[f64; 2]> {
    let point = app.point_now()?;
    let x = point.sample.x_m / frame.a_m;
    let [lower, upper] = profile.surfaces(x);
    let z = if point.body == 2 { upper } else { lower };
    let along = (x - profile.x[0]) / (profile.x[1] - profile.x[0]);
    let down = 0.5 * (1.0 - z / profile.half_m());
    let inside = |part: f64| (0.0..1.0).contains(&part);
    (inside(along) && inside(down)).then_some([along, down])
}

/// Heights at the left, x/a and what is what below.
fn numbers(app: &App, profile: &SurfaceProfile, area: Rect, inner: Rect, sheet: &mut Sheet<'_>) {
    let theme = app.view.theme;
    let dim = theme.style(Role::Dim);
    let unit = app.view.units.film();
    let left = with_columns(area, inner.x, area.x - inner.x - 1);
    let last = area.height.saturating_sub(1);
    let height = |value: f64| Line::styled(tick(unit.of(value)), dim);
    sheet.line_right(left, 0, &height(profile.half_m()));
    sheet.line_right(left, last, &height(-profile.half_m()));
    if area.height >= 5 {
        sheet.line_right(left, 1, &Line::styled(theme.text(unit.name), dim));
        sheet.line_right(left, area.height / 2, &Line::styled("0", dim));
    }
    let foot = with_rows(area, area.bottom(), 1);
    let [from, to] = profile.x.map(|x| format!("{} a", sig(x, 2)));
    sheet.line(foot, 0, &Line::styled(theme.text(&from), dim));
    sheet.line_right(foot, 0, &Line::styled(to, dim));
    let words = if theme.paints() {
        [
            "body 2 above, body 1 below, lit by their stress; oil by its pressure; cyan touches",
            "bodies by stress, oil by pressure; cyan touches",
            "cyan touches",
        ]
    } else {
        [
            "+ body 2 above, : body 1 below, oil between them; # touches",
            "+ body 2, : body 1; # touches",
            "# touches",
        ]
    };
    let room = usize::from(foot.width).saturating_sub(16);
    if let Some(words) = words.iter().find(|words| words.len() <= room) {
        let start = (usize::from(foot.width) - words.len()) / 2;
        let middle = with_columns(foot, foot.x + start as u16, words.len() as u16);
        sheet.line(middle, 0, &Line::styled(*words, dim));
    }
}

/// The profile in the terminal's own pixels, so many for a cell.
fn pixels(profile: &SurfaceProfile, area: Rect, cell: (u16, u16)) -> Bitmap {
    let side = |cells: u16, each: u16| usize::from(cells) * usize::from(each);
    let (width, height) = (side(area.width, cell.0), side(area.height, cell.1));
    let columns: Vec<ProfileColumn> = profile.columns(width).collect();
    let places = (0..height).flat_map(|row| columns.iter().map(move |column| (column, row)));
    let rgba = places
        .flat_map(|(column, row)| {
            let [r, g, b] = profile.rgb(profile.at(column, row, height));
            [r, g, b, 255]
        })
        .collect();
    Bitmap {
        area,
        width,
        height,
        rgba,
    }
}

/// The same with the followed point.
pub(super) fn in_pixels(app: &App, frame: &Frame, area: Rect, cell: (u16, u16)) -> Option<Bitmap> {
    let profile = of(app, frame)?;
    let mut picture = pixels(&profile, area, cell);
    if let Some([x, y]) = point_part(app, (&profile, frame)) {
        let whole = MapWindow {
            x: [0.0, 1.0],
            y: [0.0, 1.0],
        };
        MapMark::Diamond.draw(&mut picture, &whole, (x, y), 0.6 * f64::from(cell.0));
    }
    Some(picture)
}
