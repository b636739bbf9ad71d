//! Right: relative life, large, with its band, and the mechanisms that make it.

mod mechanisms;

use ratatui::buffer::Buffer;
use ratatui::layout::Rect;
use ratatui::style::{Modifier, Style};
use ratatui::text::{Line, Span};

use crate::tui::app::{App, Leading};
use crate::tui::theme::Role;
use crate::tui::units::{sig, sig_or_dash};
use crate::tui::view::{
    Areas, Density, ascii_text, digits, life_curve, panel, put, put_right, title,
};

/// Decades of the logarithmic scale: from 10^-4 to 10.
const DECADES: [f64; 2] = [-4.0, 1.0];

pub(super) fn render(app: &App, areas: &Areas, buffer: &mut Buffer) {
    let theme = app.theme;
    let inner = panel(
        theme,
        areas,
        areas.life,
        title(theme, "", "relative life"),
        buffer,
    );
    let inner = if areas.density == Density::Full {
        Rect {
            x: inner.x + 1,
            width: inner.width.saturating_sub(2),
            ..inner
        }
    } else {
        inner
    };
    let mut rows = Rows {
        area: inner,
        next: 0,
    };
    let roomy = inner.height >= 20;
    if roomy {
        rows.skip();
    }
    figure(app, &mut rows, buffer);
    scale(app, &mut rows, buffer);
    if roomy {
        model(app, rows.take(1), buffer);
    }
    mechanisms::mechanisms(app, &mut rows, buffer);
    if roomy {
        rows.skip();
    }
    counts(app, &mut rows, buffer);
    if app.pinned.is_some() {
        comparison(app, &mut rows, buffer);
    }
    life_curve::render(app, rows.rest(), buffer);
}

/// Rows handed out from above.
struct Rows {
    area: Rect,
    next: u16,
}

impl Rows {
    fn take(&mut self, rows: u16) -> Rect {
        let rest = self.rest();
        self.next += rows;
        Rect {
            height: rows.min(rest.height),
            ..rest
        }
    }

    fn skip(&mut self) {
        self.next += 1;
    }

    fn rest(&self) -> Rect {
        let used = self.next.min(self.area.height);
        Rect {
            y: self.area.y + used,
            height: self.area.height - used,
            ..self.area
        }
    }
}

/// Dims what the simulation says while it is on its way.
fn simulated(app: &App, style: Style) -> Style {
    match app.leading() {
        Leading::Simulated => style,
        Leading::Formula => style.add_modifier(Modifier::DIM),
    }
}

fn figure(app: &App, rows: &mut Rows, buffer: &mut Buffer) {
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
fn model(app: &App, row: Rect, buffer: &mut Buffer) {
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

/// Place of a factor on the logarithmic scale, 0 to 1.
fn place(value: f64) -> f64 {
    let decade = value.max(1e-300).log10();
    ((decade - DECADES[0]) / (DECADES[1] - DECADES[0])).clamp(0.0, 1.0)
}

fn column(value: f64, width: u16) -> u16 {
    (place(value) * f64::from(width.saturating_sub(1))).round() as u16
}

/// The logarithmic scale with band, number, formula and pin.
fn scale(app: &App, rows: &mut Rows, buffer: &mut Buffer) {
    let theme = app.theme;
    let bar = rows.take(1);
    let width = bar.width;
    let mut mark = |value: f64, symbol: &'static str, style: Style| {
        if let Some(cell) = buffer.cell_mut((bar.x + column(value, width), bar.y))
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
    if let Some(estimate) = app.estimate.life_relative {
        mark(estimate, theme.pick("◇", "f"), theme.style(Role::Formula));
    }
    if let Some(pinned) = &app.pinned {
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
        let place = Rect {
            x: names.x + start,
            width: names.width.saturating_sub(start),
            ..names
        };
        put(
            place,
            0,
            &Line::styled(text, theme.style(Role::Dim)),
            buffer,
        );
    }
    put_right(
        names,
        0,
        &Line::styled("10", theme.style(Role::Dim)),
        buffer,
    );
}

/// n by formula beside n counted, for both bodies.
fn counts(app: &App, rows: &mut Rows, buffer: &mut Buffer) {
    let theme = app.theme;
    let metrics = app.frame().map(|frame| frame.metrics.clone());
    let metrics = metrics.unwrap_or_default();
    let bodies = [
        (
            "n₁",
            app.estimate.n_body_1,
            metrics.n_counted_body_1,
            Role::Body1,
        ),
        (
            "n₂",
            app.estimate.n_body_2,
            metrics.n_counted_body_2,
            Role::Body2,
        ),
    ];
    for (name, formula, counted, role) in bodies {
        let row = rows.take(1);
        let formula = formula.map_or_else(|| theme.pick("∞", "inf").to_owned(), |n| sig(n, 3));
        let line = Line::from(vec![
            Span::styled(format!("{} ", ascii_text(theme, name)), theme.style(role)),
            Span::styled(format!("{formula:<5}"), theme.style(Role::Formula)),
            Span::styled("counted ", theme.style(Role::Dim)),
            Span::styled(
                ascii_text(theme, &sig_or_dash(counted, 3)),
                simulated(app, theme.style(Role::Strong)),
            ),
        ]);
        put(row, 0, &line, buffer);
    }
}

/// "3.4 times shorter than pinned".
fn comparison(app: &App, rows: &mut Rows, buffer: &mut Buffer) {
    let theme = app.theme;
    let row = rows.take(1);
    let Some(ratio) = app.against_pinned() else {
        return;
    };
    let (times, word, role) = if (ratio - 1.0).abs() < 0.005 {
        (String::new(), "as long as pinned".to_owned(), Role::Text)
    } else if ratio < 1.0 {
        (sig(1.0 / ratio, 2), " times shorter".to_owned(), Role::Bad)
    } else {
        (sig(ratio, 2), " times longer".to_owned(), Role::Good)
    };
    let than = if row.width >= 32 && !times.is_empty() {
        " than pinned"
    } else {
        ""
    };
    let line = Line::from(vec![
        Span::styled(
            format!("{} ", theme.pick("▼", "P")),
            theme.style(Role::Warn),
        ),
        Span::styled(format!("{times}{word}{than}"), theme.style(role)),
    ]);
    put(row, 0, &line, buffer);
    let Some(pinned) = &app.pinned else { return };
    if rows.rest().height >= 20 {
        let text = format!(
            "  pinned: {} at S {}, p_h {}",
            sig(pinned.life_relative, 2),
            sig(pinned.slide_roll, 2),
            app.units.pressure().show(pinned.p_hertz_pa, 3)
        );
        put(
            rows.take(1),
            0,
            &Line::styled(text, theme.style(Role::Dim)),
            buffer,
        );
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

    #[test]
    fn the_scale_ends_at_its_decades() {
        assert_eq!(place(1e-4), 0.0);
        assert_eq!(place(10.0), 1.0);
        assert_eq!(place(0.0), 0.0);
        assert!((place(1.0) - 0.8).abs() < 1e-12);
    }
}
