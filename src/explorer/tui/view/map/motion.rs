//! Both bodies' motion beside the map.

use ratatui::layout::Rect;

use crate::tui::app::App;
use crate::tui::theme::Role;
use crate::tui::units::sig;
use crate::tui::view::areas::{Areas, PanelSpacing};
use crate::tui::view::sheet::{Sheet, with_rows};
use asperity_engine::sim::Frame;

/// Both bodies' motion: chevrons that travel as far as the body does, in the picture's scale.
pub(super) fn motion(app: &App, frame: &Frame, areas: &Areas, inner: Rect, sheet: &mut Sheet<'_>) {
    let metrics = &frame.metrics;
    let mean = metrics.entrainment_m_s;
    let slide = 0.5 * metrics.slide_roll;
    let bodies = [
        ("2", mean * (1.0 + slide), Role::Body2),
        ("1", mean * (1.0 - slide), Role::Body1),
    ];
    let last = inner.height.saturating_sub(1);
    if areas.density == PanelSpacing::Full {
        for ((name, speed, role), row) in bodies.into_iter().zip([0, last]) {
            let row = with_rows(inner, inner.y + row, 1);
            strip(app, frame, name, speed, role, row, sheet);
        }
        return;
    }
    let half = inner.width / 2;
    for ((name, speed, role), x) in bodies.into_iter().zip([0, half + 1]) {
        let row = Rect {
            x: inner.x + x,
            y: inner.y + last,
            width: half.saturating_sub(1),
            height: 1,
        };
        strip(app, frame, name, speed, role, row, sheet);
    }
}

/// Columns from one chevron to the next.
const PITCH: i64 = 4;

fn strip(
    app: &App,
    frame: &Frame,
    name: &str,
    speed_m_s: f64,
    role: Role,
    row: Rect,
    sheet: &mut Sheet<'_>,
) {
    let theme = app.view.theme;
    let style = theme.style(role);
    let body = if row.width >= 30 { "body " } else { "" };
    let label = theme.line(format!("{body}{name} "), role);
    let unit = app.view.units.speed();
    let value = if row.width >= 30 {
        format!(" {}", unit.show(speed_m_s, 3))
    } else {
        format!(" {}", sig(unit.of(speed_m_s), 3))
    };
    let value = theme.line(value, role);
    let (before, after) = (label.width() as u16, value.width() as u16);
    sheet.line(row, 0, &label);
    sheet.line_right(row, 0, &value);
    let columns = row.width.saturating_sub(before + after);
    // One column is about a tenth of a half-width: slow enough to follow, and both bodies alike.
    let travelled = speed_m_s * frame.time_s / (0.1 * frame.a_m.max(1e-12));
    let shift = (travelled.rem_euclid(PITCH as f64)) as i64;
    let arrow = if speed_m_s > 0.0 {
        theme.pick("›", ">")
    } else if speed_m_s < 0.0 {
        theme.pick("‹", "<")
    } else {
        theme.pick("·", ".")
    };
    for column in 0..columns {
        if (i64::from(column) - shift).rem_euclid(PITCH) == 0
            && let Some(cell) = sheet.buffer.cell_mut((row.x + before + column, row.y))
        {
            cell.set_symbol(arrow).set_style(style);
        }
    }
}
