//! The life as a large figure, beside it where it comes from.

use ratatui::buffer::Buffer;
use ratatui::layout::Rect;
use ratatui::text::{Line, Span};

use crate::tui::app::{App, Leading};
use crate::tui::theme::Role;
use crate::tui::units::{sig, sig_or_dash};
use crate::tui::view::areas::{Areas, PanelSpacing};
use crate::tui::view::digits;
use crate::tui::view::panel::{led, simulated};
use crate::tui::view::place::RowAllotment;
use crate::tui::view::place::{columns_from, fitted, fitting, put};

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
pub(super) fn figure(app: &App, rows: &mut RowAllotment, buffer: &mut Buffer) {
    let theme = app.view.theme;
    let role = led(app.leading(), Role::Strong);
    let text = short(app.leading_life());
    let area = rows.take(digits::ROWS);
    if app.leading_life().is_none() {
        let why = if app.lives.estimate.formula.cycle.is_none() {
            "a body stands: no life"
        } else {
            "no estimate"
        };
        put(area, 1, &theme.line(why, Role::Dim), buffer);
    } else if theme.is_ascii() {
        let line = theme.line(format!(">> {text} <<"), Role::Strong);
        put(area, 1, &line, buffer);
    } else {
        digits::render(&text, area, theme.style(role), buffer);
    }
    let beside = said(app, area, digits::width(&text), buffer);
    let below = rows.take(1);
    put(below, 0, &provenance(app, below.width, beside), buffer);
}

/// Which model and effective stress, and how far other choices would move the number.
pub(super) fn model(app: &App, row: Rect, buffer: &mut Buffer) {
    let theme = app.view.theme;
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
    let words = fitting(forms.iter().map(String::as_str), usize::from(row.width));
    let words = words.or(forms.last().map(String::as_str));
    put(
        row,
        0,
        &theme.line(words.unwrap_or_default(), Role::Dim),
        buffer,
    );
}

/// What takes the life, and whose it is.
pub(super) fn cause(app: &App, row: Rect, buffer: &mut Buffer) {
    let Some(life) = app.life() else {
        return;
    };
    let words = life.cause().words();
    let mut forms = vec![words.to_owned()];
    if let body @ 1.. = life.detail.body {
        forms.insert(0, format!("{words}; body {body} governs"));
        forms.insert(1, format!("{words}; body {body}"));
    }
    if let Some(words) = fitting(forms.iter().map(String::as_str), usize::from(row.width)) {
        let mut line = app.view.theme.line(words, Role::Strong);
        line.style = simulated(app, line.style);
        put(row, 0, &line, buffer);
    }
}

/// Whether the large figure's source stands beside it.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Beside {
    Source,
    Nothing,
}

/// Where the number comes from.
fn source(app: &App, gap: &str) -> Span<'static> {
    let leading = app.leading();
    let words = format!("{}{gap}", leading.name());
    app.view.theme.span(words, led(leading, Role::Good))
}

/// Beside the large figure: where the number comes from.
fn said(app: &App, area: Rect, used: u16, buffer: &mut Buffer) -> Beside {
    let theme = app.view.theme;
    let used = if theme.is_ascii() {
        used / 2 + 8
    } else {
        used + 2
    };
    if area.width < used + 16 || app.leading_life().is_none() {
        return Beside::Nothing;
    }
    let right = columns_from(area, used);
    put(right, 0, &source(app, "").into(), buffer);
    put(right, 1, &theme.line("× smooth rolling", Role::Dim), buffer);
    put(right, 2, &theme.line("at the same load", Role::Dim), buffer);
    Beside::Source
}

/// The number's source, where it does not stand beside it; its band, and the other numbers as far as there is room.
fn provenance(app: &App, width: u16, beside: Beside) -> Line<'static> {
    let theme = app.view.theme;
    if app.leading_life().is_none() {
        return Line::default();
    }
    let formula = format!(
        "  formula {}",
        sig_or_dash(app.lives.estimate.formula.life(), 2)
    );
    let formula = theme.span(formula, Role::Formula);
    let parts = match (app.leading(), app.life_band()) {
        (Leading::Simulated, Some([low, high])) => {
            let band = theme.span(band(low, high), Role::Text);
            let source = source(app, " ");
            let mesh = theme.span(mesh(app), Role::Dim);
            let name = match beside {
                Beside::Source => theme.span("num. error ", Role::Text),
                Beside::Nothing if source.width() + band.width() <= usize::from(width) => source,
                Beside::Nothing => Span::styled("sim. ", source.style),
            };
            let name = match mesh.width() {
                0 => name,
                _ => mesh,
            };
            vec![name, band, formula]
        }
        (leading, _) => {
            let settling = match app.life() {
                Some(_) if leading == Leading::Settling => match beside {
                    Beside::Source => mesh(app) + "not settled",
                    Beside::Nothing => mesh(app),
                },
                Some(life) => format!("settling {}", sig(life.life_relative, 2)),
                None => "not simulated".to_owned(),
            };
            let mut parts = vec![theme.span(settling, Role::Dim)];
            if beside == Beside::Nothing {
                parts.insert(0, source(app, " "));
            }
            match leading {
                Leading::Scaled | Leading::Settling => parts.push(formula),
                Leading::Simulated | Leading::Formula => {}
            }
            parts
        }
    };
    fitted(parts, width)
}

/// The mesh of what is shown, where the run climbs several: "65² ".
fn mesh(app: &App) -> String {
    match app.frame() {
        Some(frame) if app.run.status.climbs => {
            format!("{} ", app.run.setup.scene.kind().mesh(frame.nx))
        }
        Some(_) | None => String::new(),
    }
}

/// The ends of a band; of a narrow one half of its width.
fn band(low: f64, high: f64) -> String {
    let half = 0.5 * (high / low).ln();
    if (0.0..0.05).contains(&half) {
        format!("± {} %", sig(100.0 * half, 1))
    } else {
        format!("{}–{}", sig(low, 2), sig(high, 2))
    }
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
