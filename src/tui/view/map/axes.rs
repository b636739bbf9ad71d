//! Numbers along the edges of the map: x/a below it; y/b, the depth, or the way since then at its left.

use ratatui::buffer::Buffer;
use ratatui::layout::Rect;
use ratatui::text::Line;

use super::raster::Window;
use crate::observe::scales::ticks;
use crate::sim::Frame;
use crate::tui::app::{App, MapKind};
use crate::tui::theme::Role;
use crate::tui::units::tick;
use crate::tui::view::{ascii_text, put_right};

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
    window: &Window,
    image: Rect,
    picture: Rect,
    buffer: &mut Buffer,
) {
    let theme = app.theme;
    let style = theme.style(Role::Dim);
    let below = picture.bottom();
    // The corner says what the columns at the left are.
    let left = |row: u16, text: &str, buffer: &mut Buffer| {
        let cells = Rect {
            x: picture.x.saturating_sub(LEFT),
            y: row,
            width: LEFT - 1,
            height: 1,
        };
        put_right(
            cells,
            0,
            &Line::styled(ascii_text(theme, text), style),
            buffer,
        );
    };
    if buffer.area.contains((picture.x, below).into()) {
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
            let first = first.min((image.right()).saturating_sub(width));
            if first < free_from {
                continue;
            }
            buffer.set_line(first, below, &Line::styled(text, style), width);
            free_from = first + width + 1;
        }
    }
    let scale = down(app, frame);
    let ends = window.y.map(|y| y * scale.per_window);
    let about = usize::from(image.height / 3).clamp(1, 5);
    let mut free_from = 0;
    for value in ticks(ends[0].min(ends[1]), ends[0].max(ends[1]), about) {
        let part = (value - ends[0]) / (ends[1] - ends[0]);
        let row = image.y + (part * f64::from(image.height.saturating_sub(1))).round() as u16;
        if row >= free_from {
            left(row, &tick(value), buffer);
            free_from = row + 1;
        }
    }
    left(below, scale.name, buffer);
}

/// What runs down a map.
struct Down {
    name: &'static str,
    /// Its unit over the window's.
    per_window: f64,
}

fn down(app: &App, frame: &Frame) -> Down {
    match app.map {
        MapKind::Stress => Down {
            name: app.units.length().name,
            per_window: app.units.length().of(frame.a_m),
        },
        // The window counts passages of 4a.
        MapKind::PressureWaves | MapKind::FilmWaves => Down {
            name: "a",
            per_window: 4.0,
        },
        _ => Down {
            name: "y/b",
            per_window: 1.0,
        },
    }
}
