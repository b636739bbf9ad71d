//! Numbers along the edges of the map: x/a below it; y/b, the depth, or the way since then at its left.

use ratatui::buffer::Buffer;
use ratatui::layout::Rect;

use super::raster::MapWindow;
use crate::tui::app::App;
use crate::tui::kinds::Downwards;
use crate::tui::theme::Role;
use crate::tui::units::tick;
use crate::tui::view::chart::Plot;
use crate::tui::view::place::{columns, put_right};
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
    window: &MapWindow,
    image: Rect,
    inner: Rect,
    buffer: &mut Buffer,
) {
    let [left, below] = room(inner);
    // Above the motion's row.
    let foot = inner.height.saturating_sub(2);
    let plot = Plot {
        area: image,
        x: window.x,
        y: [window.y[1], window.y[0]],
    };
    if below > 0 {
        plot.half_widths(app.view.theme, inner.y + foot, buffer);
    }
    if left > 0 {
        let cells = columns(inner, 0, left - 1);
        downwards(app, frame, &plot, cells, buffer);
        if below > 0 {
            // The corner says what the numbers above it are.
            let name = app.view.theme.line(down(app, frame).name, Role::Dim);
            put_right(cells, foot, &name, buffer);
        }
    }
}

/// y/b, depth or way at the left of the map.
fn downwards(app: &App, frame: &Frame, plot: &Plot, cells: Rect, buffer: &mut Buffer) {
    let scale = down(app, frame);
    let ends = plot.y.map(|y| y * scale.per_window);
    let about = usize::from(plot.area.height / 3).clamp(1, 5);
    let mut free_from = 0;
    let mut values = ticks(ends[0].min(ends[1]), ends[0].max(ends[1]), about);
    if ends[0] < ends[1] {
        values.reverse();
    }
    for value in values {
        let row = plot.row(value / scale.per_window);
        if row >= free_from {
            let number = app.view.theme.line(tick(value), Role::Dim);
            put_right(cells, row - cells.y, &number, buffer);
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
    match app.view.map.downwards() {
        Downwards::Depth => Down {
            name: app.view.units.length().name,
            per_window: app.view.units.length().of(frame.a_m),
        },
        // The window counts passages of 4a.
        Downwards::Time => Down {
            name: "a",
            per_window: 4.0,
        },
        Downwards::Across => Down {
            name: "y/b",
            per_window: 1.0,
        },
    }
}
