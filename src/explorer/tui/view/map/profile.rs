//! The map of the profile: [`SurfaceProfile`] in half blocks, characters or a page's pixels.

use ratatui::layout::{Rect, Size};

use super::paint::MapMark;
use super::white_mark;
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
    draw(app, &profile, frame, area, inner, sheet);
    point::draw(app, frame, below?, profile.x, sheet)
}

/// Draws the profile, where it is not left to a page's pixels, and its numbers.
fn draw(
    app: &App,
    profile: &SurfaceProfile,
    frame: &Frame,
    area: Rect,
    inner: Rect,
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
    if !app.is_in_pixels()
        && let Some(part) = point_part(app, profile, frame)
    {
        white_mark(area, part, "◆", sheet);
    }
}

/// The followed point, riding on its body: parts of the picture along and down.
fn point_part(app: &App, profile: &SurfaceProfile, frame: &Frame) -> Option<[f64; 2]> {
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
    let unit = app.view.units.film();
    let left = with_columns(area, inner.x, area.x - inner.x - 1);
    let last = area.height.saturating_sub(1);
    let height = |value: f64| theme.line(tick(unit.of(value)), Role::Dim);
    sheet.line_right(left, 0, &height(profile.half_m()));
    sheet.line_right(left, last, &height(-profile.half_m()));
    if area.height >= 5 {
        sheet.text_right(left, 1, unit.name, Role::Dim);
        sheet.text_right(left, area.height / 2, "0", Role::Dim);
    }
    let foot = with_rows(area, area.bottom(), 1);
    let [from, to] = profile.x.map(|x| format!("{} a", sig(x, 2)));
    sheet.text(foot, 0, &from, Role::Dim);
    sheet.text_right(foot, 0, to, Role::Dim);
    let words = if theme.paints() {
        [
            "body 2 above, body 1 below, lit by their stress; oil by its pressure; cyan: asperity contact",
            "bodies by stress, oil by pressure; cyan: contact",
            "cyan: contact",
        ]
    } else {
        [
            "+ body 2 above, : body 1 below, oil between them; # asperity contact",
            "+ body 2, : body 1; # contact",
            "# contact",
        ]
    };
    let room = usize::from(foot.width).saturating_sub(16);
    if let Some(words) = words.iter().find(|words| words.len() <= room) {
        let start = (usize::from(foot.width) - words.len()) / 2;
        let middle = with_columns(foot, foot.x + start as u16, words.len() as u16);
        sheet.text(middle, 0, *words, Role::Dim);
    }
}

/// The profile with the followed point in a page's pixels, so many for a cell.
pub(super) fn in_pixels(app: &App, frame: &Frame, area: Rect, cell: Size) -> Option<Bitmap> {
    let profile = of(app, frame)?;
    let mut picture = Bitmap::blank(area, cell);
    let (width, height) = (picture.width, picture.height);
    let columns: Vec<ProfileColumn> = profile.columns(width).collect();
    picture.rgba = (0..height)
        .flat_map(|row| columns.iter().map(move |column| (column, row)))
        .flat_map(|(column, row)| {
            let [r, g, b] = profile.rgb(profile.at(column, row, height));
            [r, g, b, 255]
        })
        .collect();
    if let Some(part) = point_part(app, &profile, frame) {
        MapMark::Diamond.draw(&mut picture, part, 0.6 * f64::from(cell.width));
    }
    Some(picture)
}
