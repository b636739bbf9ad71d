//! Numbers along the edges of the map: x/a below it; y/b, the depth, or the way since then at its left.

use ratatui::layout::Rect;

use super::MapLayout;
use super::raster::MapWindow;
use crate::tui::app::{App, MapKind};
use crate::tui::theme::Role;
use crate::tui::units::tick;
use crate::tui::view::sheet::{Sheet, with_columns};
use asperity_engine::math::number::ticks;
use asperity_engine::sim::Frame;

/// Columns at the left.
const LEFT: u16 = 5;

/// Columns and rows that the axes take from a panel; none where it is small.
pub(super) fn room(inner: Rect) -> [u16; 2] {
    let left = if inner.width >= 34 { LEFT } else { 0 };
    [left, u16::from(inner.height >= 8)]
}

/// Draws what there is room for.
pub(super) fn draw(
    app: &App,
    frame: &Frame,
    layout: &MapLayout,
    inner: Rect,
    sheet: &mut Sheet<'_>,
) {
    let [left, below] = room(inner);
    // Above the motion's row.
    let foot = inner.bottom().saturating_sub(2);
    if below > 0 {
        along(&layout.window, layout.image, foot, sheet);
    }
    if left > 0 {
        let cells = with_columns(inner, inner.x, left - 1);
        let scale = down(app, frame);
        downwards(&scale, layout, cells, sheet);
        if below > 0 {
            // The corner says what the numbers above it are.
            number(cells, foot, scale.name, sheet);
        }
    }
}

fn number(cells: Rect, row: u16, text: &str, sheet: &mut Sheet<'_>) {
    sheet.text_right(cells, row - cells.y, text, Role::Dim);
}

/// x/a below the map.
fn along(window: &MapWindow, image: Rect, row: u16, sheet: &mut Sheet<'_>) {
    let mut free_from = image.x;
    for x in ticks(
        window.x[0],
        window.x[1],
        usize::from(image.width / 8).max(2),
    ) {
        let text = if x == 0.0 {
            "0".to_owned()
        } else {
            format!("{}a", tick(x))
        };
        let part = (x - window.x[0]) / (window.x[1] - window.x[0]);
        let width = text.len() as u16;
        let centre = image.x + (part * f64::from(image.width.saturating_sub(1))).round() as u16;
        let first = centre.saturating_sub(width / 2).max(image.x);
        let first = first.min(image.right().saturating_sub(width));
        if first >= free_from {
            let cells = Rect::new(first, row, width, 1);
            sheet.text(cells, 0, text, Role::Dim);
            free_from = first + width + 1;
        }
    }
}

/// y/b, depth or way at the left of the map.
fn downwards(scale: &Down, layout: &MapLayout, cells: Rect, sheet: &mut Sheet<'_>) {
    let image = layout.image;
    let ends = layout.window.y.map(|y| y * scale.per_window);
    let about = usize::from(image.height / 3).clamp(1, 5);
    let mut free_from = 0;
    let mut values = ticks(ends[0].min(ends[1]), ends[0].max(ends[1]), about);
    if ends[0] > ends[1] {
        values.reverse();
    }
    for value in values {
        let part = (value - ends[0]) / (ends[1] - ends[0]);
        let row = image.y + (part * f64::from(image.height.saturating_sub(1))).round() as u16;
        if row >= free_from {
            number(cells, row, &tick(value), sheet);
            free_from = row + 1;
        }
    }
}

/// What runs down a map.
struct Down {
    name: &'static str,
    /// Its unit over the window's.
    per_window: f64,
}

fn down(app: &App, frame: &Frame) -> Down {
    match app.view.map {
        MapKind::Stress => Down {
            name: app.view.units.length().name,
            per_window: app.view.units.length().of(frame.a_m),
        },
        // The window counts passages of 4a.
        MapKind::PressureWaves | MapKind::FilmWaves => Down {
            name: "a",
            per_window: 4.0,
        },
        MapKind::Pressure
        | MapKind::Film
        | MapKind::Fringes
        | MapKind::Contact
        | MapKind::Roughness
        | MapKind::Profile => Down {
            name: "y/b",
            per_window: 1.0,
        },
    }
}
