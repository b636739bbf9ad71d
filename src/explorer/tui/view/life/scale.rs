//! The life on a logarithmic scale.

use ratatui::style::Style;

use super::{RowAllotment, simulated};
use crate::tui::app::App;
use crate::tui::theme::Role;
use crate::tui::view::sheet::{Sheet, with_columns};

/// Decades of the scale: from 10^-4 to 10.
const DECADES: [f64; 2] = [-4.0, 1.0];

/// Place of a factor on the logarithmic scale, 0 to 1.
fn place(value: f64) -> f64 {
    let decade = value.max(1e-300).log10();
    ((decade - DECADES[0]) / (DECADES[1] - DECADES[0])).clamp(0.0, 1.0)
}

fn column(value: f64, width: u16) -> u16 {
    (place(value) * f64::from(width.saturating_sub(1))).round() as u16
}

/// The logarithmic scale with band, number, formula and pin.
pub(super) fn scale(app: &App, rows: &mut RowAllotment, sheet: &mut Sheet<'_>) {
    let theme = app.view.theme;
    let bar = rows.take(1);
    let width = bar.width;
    let mut mark = |value: f64, symbol: &'static str, style: Style| {
        if let Some(cell) = sheet.buffer.cell_mut((bar.x + column(value, width), bar.y))
            && !bar.is_empty()
        {
            cell.set_symbol(symbol).set_style(style);
        }
    };
    for offset in 0..400 {
        // Dense enough to reach every column of any panel.
        let value = 10_f64.powf(DECADES[0] + (DECADES[1] - DECADES[0]) * f64::from(offset) / 399.0);
        mark(value, theme.pick("─", "-"), theme.style(Role::Border));
    }
    for decade in -4..=1 {
        mark(
            10_f64.powi(decade),
            theme.pick("┴", "+"),
            theme.style(Role::Border),
        );
    }
    if let Some(life) = app.life() {
        let style = simulated(app, theme.style(Role::Good));
        let (low, high) = (
            life.life_relative_low.max(1e-12),
            life.life_relative_high.max(1e-12),
        );
        for step in 0..=40 {
            let value = low * (high / low).powf(f64::from(step) / 40.0);
            mark(value, theme.pick("━", "="), style);
        }
        mark(life.life_relative, theme.pick("●", "O"), style);
    }
    if let Some(estimate) = app.lives.estimate.formula.life() {
        mark(estimate, theme.pick("◇", "f"), theme.style(Role::Formula));
    }
    if let Some(pinned) = &app.view.pinned {
        mark(
            pinned.life_relative,
            theme.pick("▼", "P"),
            theme.style(Role::Warn),
        );
    }
    let names = rows.take(1);
    for decade in [-4, -2, 0] {
        let text = if decade == 0 {
            "1".to_owned()
        } else {
            format!("1e{decade}")
        };
        let at = column(10_f64.powi(decade), width);
        let start = at.saturating_sub(text.len() as u16 / 2);
        let place = with_columns(names, names.x + start, names.width.saturating_sub(start));
        sheet.text(place, 0, text, Role::Dim);
    }
    sheet.text_right(names, 0, "10", Role::Dim);
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_scale_ends_at_its_decades() {
        assert_eq!(place(1e-4), 0.0);
        assert_eq!(place(10.0), 1.0);
        assert_eq!(place(0.0), 0.0);
        assert!((place(1.0) - 0.8).abs() < 1e-12);
    }
}
