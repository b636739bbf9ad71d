//! The life as a large figure, beside it where it comes from.

use ratatui::buffer::Buffer;
use ratatui::layout::Rect;
use ratatui::text::{Line, Span};

use super::Rows;
use crate::tui::app::{App, Leading};
use crate::tui::theme::Role;
use crate::tui::units::{sig, sig_or_dash};
use crate::tui::view::{ascii_text, digits, put};

/// The number itself.
pub(super) fn figure(app: &App, rows: &mut Rows, buffer: &mut Buffer) {
    let theme = app.theme;
    let leading = app.leading();
    let role = match leading {
        Leading::Simulated => Role::Strong,
        Leading::Formula => Role::Formula,
    };
    let text = short(app.leading_life());
    let area = rows.take(digits::ROWS);
    if theme.is_ascii() {
        let line = Line::styled(format!(">> {text} <<"), theme.style(Role::Strong));
        put(area, 1, &line, buffer);
    } else if app.leading_life().is_some() {
        digits::render(&text, area, theme.style(role), buffer);
    } else {
        put(
            area,
            1,
            &Line::styled("no estimate", theme.style(Role::Dim)),
            buffer,
        );
    }
    said(app, area, digits::width(&text), buffer);
    let below = rows.take(1);
    put(below, 0, &provenance(app, below.width), buffer);
}

/// Which model and effective stress, and how far other choices would move the number.
pub(super) fn model(app: &App, row: Rect, buffer: &mut Buffer) {
    let theme = app.theme;
    let scene = &app.setup.scene;
    let (Some(life), Some(stress)) = (&scene.life, &scene.stress) else {
        return;
    };
    let mut text = format!("{}, {}", life.model.name(), stress.measure.name());
    if let Some(detail) = app.life().map(|life| life.detail)
        && detail.variants > 1
    {
        let (low, high) = (sig(detail.spread_low, 2), sig(detail.spread_high, 2));
        let spread = format!("; models {low}–{high}");
        if text.chars().count() + spread.chars().count() <= usize::from(row.width) {
            text.push_str(&spread);
        }
    }
    let line = Line::styled(ascii_text(theme, &text), theme.style(Role::Dim));
    put(row, 0, &line, buffer);
}

/// Beside the large figure: where the number comes from.
fn said(app: &App, area: Rect, used: u16, buffer: &mut Buffer) {
    let theme = app.theme;
    let used = if theme.is_ascii() {
        used / 2 + 8
    } else {
        used + 2
    };
    if area.width < used + 9 {
        return;
    }
    let right = Rect {
        x: area.x + used,
        width: area.width - used,
        ..area
    };
    let dim = theme.style(Role::Dim);
    let word = match app.leading() {
        Leading::Simulated => Line::styled("simulated", theme.style(Role::Good)),
        Leading::Formula => Line::styled("formula", theme.style(Role::Formula)),
    };
    put(right, 0, &word, buffer);
    if right.width >= 16 {
        let of = ascii_text(theme, "× smooth rolling");
        put(right, 1, &Line::styled(of, dim), buffer);
        put(right, 2, &Line::styled("at the same load", dim), buffer);
    }
}

/// The other number, and the band.
fn provenance(app: &App, width: u16) -> Line<'static> {
    let theme = app.theme;
    let text = match (app.leading(), app.life()) {
        (Leading::Simulated, Some(life)) => {
            let (low, high) = (life.life_relative_low, life.life_relative_high);
            let band = format!("band {}–{}", sig(low, 2), sig(high, 2));
            let formula = format!("  formula {}", sig_or_dash(app.estimate.life_relative, 2));
            let mut spans = vec![Span::styled(
                ascii_text(theme, &band),
                theme.style(Role::Text),
            )];
            if band.chars().count() + formula.len() <= usize::from(width) {
                spans.push(Span::styled(formula, theme.style(Role::Formula)));
            }
            return Line::from(spans);
        }
        (_, Some(life)) => format!("settling: {}", sig(life.life_relative, 2)),
        (_, None) => "not simulated yet".to_owned(),
    };
    Line::from(vec![
        Span::styled(
            format!("{} ", theme.pick("≈", "~")),
            theme.style(Role::Formula),
        ),
        Span::styled(text, theme.style(Role::Dim)),
    ])
}

/// A number short enough for large figures.
fn short(life: Option<f64>) -> String {
    match life {
        Some(life) if (1e-3..1e3).contains(&life) => sig(life, 2),
        Some(life) if life > 0.0 && life.is_finite() => format!("{life:.0e}").replace("e-0", "e-"),
        _ => "-".to_owned(),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn large_figures_are_short() {
        let table = [
            (Some(0.0432), "0.043"),
            (Some(1.0), "1.0"),
            (Some(14.0), "14"),
            (Some(2.3e-7), "2e-7"),
            (Some(3.0e5), "3e5"),
            (None, "-"),
            (Some(f64::NAN), "-"),
        ];
        for (life, text) in table {
            assert_eq!(short(life), text);
        }
    }
}
