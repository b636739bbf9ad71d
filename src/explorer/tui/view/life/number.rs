//! The life as a large figure, beside it where it comes from.

use ratatui::layout::Rect;
use ratatui::text::Line;

use super::RowAllotment;
use crate::tui::app::{App, Leading};
use crate::tui::theme::Role;
use crate::tui::units::{sig, sig_or_dash};
use crate::tui::view::areas::{Areas, PanelSpacing};
use crate::tui::view::digits;
use crate::tui::view::sheet::{Sheet, with_columns};

/// What the number is, for the panel's title: where there is no room beside the figure, against what.
pub(super) fn name(app: &App, areas: &Areas) -> &'static str {
    let times = app.view.theme.pick("× smooth rolling", "x smooth rolling");
    match areas.life.width {
        _ if areas.density == PanelSpacing::Full => "relative life",
        24.. => "against smooth rolling",
        _ => times,
    }
}

/// The number itself.
pub(super) fn figure(app: &App, rows: &mut RowAllotment, sheet: &mut Sheet<'_>) {
    let theme = app.view.theme;
    let role = match app.leading() {
        Leading::Simulated => Role::Strong,
        Leading::Scaled | Leading::Formula => Role::Formula,
    };
    let text = short(app.leading_life());
    let area = rows.take(digits::ROWS);
    if app.leading_life().is_none() {
        let why = if app.lives.estimate.formula.cycle.is_none() {
            "a body stands: no life"
        } else {
            "no estimate"
        };
        sheet.text(area, 1, why, Role::Dim);
    } else if theme.is_ascii() {
        sheet.text(area, 1, format!(">> {text} <<"), Role::Strong);
    } else {
        digits::render(&text, area, theme.style(role), sheet);
    }
    let beside = said(app, area, digits::width(&text), sheet);
    let below = rows.take(1);
    sheet.line(below, 0, &provenance(app, below.width, beside));
}

/// Which model and effective stress, and how far other choices would move the number.
pub(super) fn model(app: &App, row: Rect, sheet: &mut Sheet<'_>) {
    let scene = &app.run.setup.scene;
    let (Some(life), Some(stress)) = (&scene.life, &scene.stress) else {
        return;
    };
    let (model, measure) = (life.model.name(), stress.measure.name());
    let spread = app
        .life()
        .map(|life| life.detail)
        .filter(|detail| detail.variants > 1)
        .map(|detail| {
            let (low, high) = (sig(detail.spread_low, 2), sig(detail.spread_high, 2));
            format!("choices {low}–{high}")
        });
    // The range says more than the names, which the plan has too.
    let mut forms = vec![format!("{model}, {measure}")];
    if let Some(spread) = spread {
        forms = vec![
            format!("{model}, {measure}; {spread}"),
            format!("{model}; {spread}"),
            spread,
        ];
    }
    let fits = |text: &&String| text.chars().count() <= usize::from(row.width);
    let Some(text) = forms.iter().find(fits).or(forms.last()) else {
        return;
    };
    sheet.text(row, 0, text, Role::Dim);
}

/// Whether the large figure's source stands beside it.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Beside {
    Source,
    Nothing,
}

fn source(app: &App) -> (&'static str, Role) {
    let leading = app.leading();
    let role = match leading {
        Leading::Simulated => Role::Good,
        Leading::Scaled | Leading::Formula => Role::Formula,
    };
    (leading.name(), role)
}

/// Beside the large figure: where the number comes from.
fn said(app: &App, area: Rect, used: u16, sheet: &mut Sheet<'_>) -> Beside {
    let theme = app.view.theme;
    let used = if theme.is_ascii() {
        used / 2 + 8
    } else {
        used + 2
    };
    if area.width < used + 16 || app.leading_life().is_none() {
        return Beside::Nothing;
    }
    let right = with_columns(area, area.x + used, area.width - used);
    let (word, role) = source(app);
    sheet.text(right, 0, word, role);
    let of = theme.text("× smooth rolling");
    sheet.text(right, 1, of, Role::Dim);
    sheet.text(right, 2, "at the same load", Role::Dim);
    Beside::Source
}

/// The number's source, where it does not stand beside it; its band, and the other numbers as far as there is room.
fn provenance(app: &App, width: u16, beside: Beside) -> Line<'static> {
    let theme = app.view.theme;
    if app.leading_life().is_none() {
        return Line::default();
    }
    let (word, role) = source(app);
    let mut spans = Vec::new();
    let mut used = 0;
    let mut add = |text: String, role: Role| {
        let text = theme.text(&text);
        let length = text.chars().count();
        if used + length <= usize::from(width) {
            used += length;
            spans.push(theme.span(text, role));
        }
    };
    let formula = sig_or_dash(app.lives.estimate.formula.life(), 2);
    match (app.leading(), app.life()) {
        (Leading::Simulated, Some(life)) => {
            let (low, high) = (life.life_relative_low, life.life_relative_high);
            let band = format!("{}–{}", sig(low, 2), sig(high, 2));
            match beside {
                Beside::Source => add(format!("num. error {band}"), Role::Text),
                Beside::Nothing if word.len() + 1 + band.chars().count() <= usize::from(width) => {
                    add(format!("{word} "), role);
                    add(band, Role::Text);
                }
                Beside::Nothing => {
                    add("sim. ".to_owned(), role);
                    add(band, Role::Text);
                }
            }
            add(format!("  formula {formula}"), Role::Formula);
        }
        (leading, life) => {
            if beside == Beside::Nothing {
                add(format!("{word} "), role);
            }
            match life {
                Some(life) => add(
                    format!("settling {}", sig(life.life_relative, 2)),
                    Role::Dim,
                ),
                None => add("not simulated".to_owned(), Role::Dim),
            }
            if leading == Leading::Scaled {
                add(format!("  formula {formula}"), Role::Formula);
            }
        }
    }
    Line::from(spans)
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
