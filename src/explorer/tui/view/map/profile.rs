//! The map of the profile: [`SurfaceProfile`] in half blocks, characters or the terminal's own pixels.

use ratatui::buffer::Buffer;
use ratatui::layout::Rect;

use super::paint::{MapMark, half_blocks, letters, mark};
use crate::tui::app::App;
use crate::tui::pixels::{Bitmap, PixelPlot};
use crate::tui::theme::Role;
use crate::tui::units::{sig, tick};
use crate::tui::view::chart::{Plot, zoomed};
use crate::tui::view::place::{columns_from, fitting, put, put_middle, put_right};
use crate::tui::view::{place, point};
use asperity_engine::sim::Frame;
use asperity_picture::profile::{Matter, ProfileColumn, ProfileScale, SurfaceProfile};

/// Rows of half blocks from which the trace has room below.
const ROWS_WITH_TRACE: u16 = 14;

/// The profile that the explorer shows of a frame.
pub(super) fn of<'a>(app: &App, frame: &'a Frame) -> Option<SurfaceProfile<'a>> {
    let x = zoomed(app, frame, [-1.5, 1.4]);
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
        Matter::Oil(_) | Matter::Nothing => " ",
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
    let drawn = columns_from(inner, LEFT);
    let below = place::rows(drawn, above + 1, rows.saturating_sub(above + 2));
    let trace = (below.height >= 3).then_some(below);
    (place::rows(drawn, 0, above), trace)
}

/// Both surfaces with the oil between them, and below them the trace of the point that rides on one.
pub(super) fn side_view(
    app: &App,
    frame: &Frame,
    inner: Rect,
    buffer: &mut Buffer,
) -> Option<PixelPlot> {
    let profile = of(app, frame)?;
    let (area, below) = rooms(inner);
    draw(app, &profile, area, buffer);
    if let Some(part) = point_part(app, &profile, frame).filter(|_| !app.is_in_pixels()) {
        mark(app.view.theme, area, part, "◆", buffer);
    }
    point::over(app, below?, profile.x, buffer)
}

/// Draws the profile, where it is not left to the terminal's own pixels, and its numbers.
fn draw(app: &App, profile: &SurfaceProfile, area: Rect, buffer: &mut Buffer) {
    let theme = app.view.theme;
    numbers(app, profile, area, buffer);
    if app.is_in_pixels() {
        return;
    }
    let columns: Vec<ProfileColumn> = profile.columns(usize::from(area.width)).collect();
    let rows = usize::from(area.height);
    if theme.paints() {
        half_blocks(area, buffer, |column, row| {
            theme.rgb(profile.rgb(profile.at(&columns[column], row, 2 * rows)))
        });
        return;
    }
    letters(area, buffer, |column, row| {
        letter(profile.at(&columns[column], row, rows))
    });
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
fn numbers(app: &App, profile: &SurfaceProfile, area: Rect, buffer: &mut Buffer) {
    let theme = app.view.theme;
    let unit = app.view.units.film();
    let y = [-profile.half_m(), profile.half_m()];
    let plot = Plot {
        area,
        x: profile.x,
        y,
    };
    plot.y_ends(
        theme,
        &y.map(|height| tick(unit.of(height))),
        unit.name,
        buffer,
    );
    let foot = Rect {
        y: area.bottom(),
        height: 1,
        ..area
    };
    let [from, to] = profile
        .x
        .map(|x| theme.line(format!("{} a", sig(x, 2)), Role::Dim));
    put(foot, 0, &from, buffer);
    put_right(foot, 0, &to, buffer);
    let words = if theme.paints() {
        [
            "body 2 above, body 1 below, lit by their stress; oil by its pressure; cyan: contact",
            "bodies by stress, oil by pressure; cyan: contact",
            "cyan: contact",
        ]
    } else {
        [
            "+ body 2 above, : body 1 below, oil between them; # contact",
            "+ body 2, : body 1; # contact",
            "# contact",
        ]
    };
    if let Some(words) = fitting(words, usize::from(foot.width).saturating_sub(16)) {
        put_middle(foot, 0, &theme.line(words, Role::Dim), buffer);
    }
}

/// The profile with the followed point in the terminal's own pixels, so many for a cell.
pub(super) fn in_pixels(app: &App, frame: &Frame, area: Rect, cell: (u16, u16)) -> Option<Bitmap> {
    let profile = of(app, frame)?;
    let (width, height) = Bitmap::size(area, cell);
    let columns: Vec<ProfileColumn> = profile.columns(width).collect();
    let mut picture = Bitmap::of(area, cell, |column, row| {
        let [r, g, b] = profile.rgb(profile.at(&columns[column], row, height));
        [r, g, b, 255]
    });
    if let Some(part) = point_part(app, &profile, frame) {
        MapMark::Diamond.draw(&mut picture, part, 0.6 * f64::from(cell.0));
    }
    Some(picture)
}
