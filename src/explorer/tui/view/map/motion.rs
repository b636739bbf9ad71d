//! Both bodies' motion beside the map.

use ratatui::buffer::Buffer;
use ratatui::layout::Rect;

use crate::tui::app::App;
use crate::tui::theme::Role;
use crate::tui::units::sig;
use crate::tui::view::areas::{Areas, PanelSpacing};
use crate::tui::view::chart::Symbol;
use crate::tui::view::place::{columns, put, put_right, rows};
use asperity_engine::sim::Frame;

/// Both bodies' motion: chevrons that travel as far as the body does, in the picture's scale.
pub(super) fn motion(app: &App, frame: &Frame, areas: &Areas, inner: Rect, buffer: &mut Buffer) {
    let metrics = &frame.metrics;
    let mean = metrics.entrainment_m_s;
    let slide = 0.5 * metrics.slide_roll;
    let bodies = [
        ("2", mean * (1.0 + slide), Role::Body2),
        ("1", mean * (1.0 - slide), Role::Body1),
    ];
    let last = inner.height.saturating_sub(1);
    let half = inner.width / 2;
    let places = match areas.density {
        PanelSpacing::Full => [rows(inner, 0, 1), rows(inner, last, 1)],
        PanelSpacing::Compact => {
            [0, half + 1].map(|x| columns(rows(inner, last, 1), x, half.saturating_sub(1)))
        }
    };
    for ((name, speed_m_s, role), row) in bodies.into_iter().zip(places) {
        // One column is about a tenth of a half-width: slow enough to follow, and both bodies alike.
        let travelled = speed_m_s * frame.time_s / (0.1 * frame.a_m.max(1e-12));
        strip(app, name, speed_m_s, travelled, role, row, buffer);
    }
}

/// A body's name, its speed, and between them chevrons that have travelled so many columns.
fn strip(
    app: &App,
    name: &str,
    speed_m_s: f64,
    travelled: f64,
    role: Role,
    row: Rect,
    buffer: &mut Buffer,
) {
    /// Columns from one chevron to the next.
    const PITCH: i64 = 4;
    let theme = app.view.theme;
    let unit = app.view.units.speed();
    let (label, value) = match row.width {
        30.. => (
            format!("body {name} "),
            format!(" {}", unit.show(speed_m_s, 3)),
        ),
        _ => (
            format!("{name} "),
            format!(" {}", sig(unit.of(speed_m_s), 3)),
        ),
    };
    let (label, value) = (theme.line(label, role), theme.line(value, role));
    put(row, 0, &label, buffer);
    put_right(row, 0, &value, buffer);
    let (before, after) = (label.width() as u16, value.width() as u16);
    let free = columns(row, before, row.width.saturating_sub(before + after));
    let arrow = if speed_m_s > 0.0 {
        Symbol::new(theme, "›", ">", role)
    } else if speed_m_s < 0.0 {
        Symbol::new(theme, "‹", "<", role)
    } else {
        Symbol::new(theme, "·", ".", role)
    };
    let shift = travelled.rem_euclid(PITCH as f64) as i64;
    for (column, at) in (0..).zip(free.positions()) {
        if (column - shift).rem_euclid(PITCH) == 0 {
            arrow.draw(at, buffer);
        }
    }
}
