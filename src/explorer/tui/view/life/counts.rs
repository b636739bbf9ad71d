//! Cycles by formula and counted, and the life against the one that was pinned.

use ratatui::buffer::Buffer;
use ratatui::text::{Line, Span};

use crate::tui::app::App;
use crate::tui::theme::Role;
use crate::tui::units::{sig, sig_or_dash};
use crate::tui::view::panel::simulated;
use crate::tui::view::place::RowAllotment;
use crate::tui::view::place::put;
use asperity_engine::scene::CycleBasis;
use asperity_engine::sim::Metrics;

/// n by formula beside n counted, for both bodies.
pub(super) fn counts(app: &App, rows: &mut RowAllotment, buffer: &mut Buffer) {
    let theme = app.view.theme;
    let metrics = app.frame().map(|frame| &frame.metrics);
    let counted = |of: fn(&Metrics) -> Option<f64>| metrics.and_then(of);
    let counted = [
        counted(|metrics| metrics.n_counted_body_1),
        counted(|metrics| metrics.n_counted_body_2),
    ];
    let formula = [app.lives.estimate.n_body_1, app.lives.estimate.n_body_2];
    for (body, (name, role)) in [("n₁ ", Role::Body1), ("n₂ ", Role::Body2)]
        .into_iter()
        .enumerate()
    {
        let row = rows.take(1);
        // A figure that is cut is another figure.
        let (word, expected, end) = match row.width {
            ..30 => ("", " (exp. ", ")"),
            _ => ("counted ", " expected ", ""),
        };
        let formula = formula[body].map_or_else(|| "∞".to_owned(), |n| sig(n, 3));
        let line = Line::from(vec![
            theme.span(name, role),
            theme.span(word, Role::Dim),
            known(app, counted[body], 3, Role::Strong),
            theme.span(expected, Role::Dim),
            theme.span(formula, Role::Formula),
            theme.span(end, Role::Dim),
        ]);
        put(row, 0, &line, buffer);
    }
}

/// What the simulation says, as far as it is known.
fn known(app: &App, value: Option<f64>, digits: i32, role: Role) -> Span<'static> {
    let mut span = app.view.theme.span(sig_or_dash(value, digits), role);
    span.style = simulated(app, span.style);
    span
}

/// The life by the count that is not the headline's: the paper's, or that by damage.
pub(super) fn other_count(app: &App, rows: &mut RowAllotment, buffer: &mut Buffer) {
    let (Some(_), Some(asked)) = (app.life(), &app.run.setup.scene.life) else {
        return;
    };
    let other = app.other_life();
    let word = match asked.cycles {
        CycleBasis::Damage => "Pu et al. 2016",
        CycleBasis::Global | CycleBasis::Peaks => "by damage",
    };
    let word = app.view.theme.span(format!("{word} "), Role::Dim);
    let mut line = Line::from(vec![word, known(app, other, 2, Role::Text)]);
    // A lesson keeps its count.
    if app.lesson.tour.is_none() {
        line.push_span(app.view.theme.span("  a", Role::Key));
    }
    put(rows.take(1), 0, &line, buffer);
}

/// "3.4 times shorter than pinned".
pub(super) fn comparison(app: &App, rows: &mut RowAllotment, buffer: &mut Buffer) {
    let theme = app.view.theme;
    let row = rows.take(1);
    let Some(ratio) = app.against_pinned() else {
        return;
    };
    let (words, role) = if (ratio - 1.0).abs() < 0.005 {
        ("as long as pinned".to_owned(), Role::Text)
    } else {
        let (times, word, role) = match ratio {
            ..1.0 => (1.0 / ratio, "shorter", Role::Bad),
            _ => (ratio, "longer", Role::Good),
        };
        let than = if row.width >= 32 { " than pinned" } else { "" };
        (format!("{} times {word}{than}", sig(times, 2)), role)
    };
    let mark = theme.span(theme.pick("▼ ", "P "), Role::Warn);
    put(
        row,
        0,
        &Line::from(vec![mark, theme.span(words, role)]),
        buffer,
    );
    let Some(pinned) = &app.view.pinned else {
        return;
    };
    if rows.rest.height >= 20 {
        let text = format!(
            "  pinned: {} {} at S {}, p_h {}",
            pinned.leading.name(),
            sig(pinned.life_relative, 2),
            sig(pinned.slide_roll, 2),
            app.view.units.pressure().show(pinned.p_hertz_pa, 3)
        );
        put(rows.take(1), 0, &theme.line(text, Role::Dim), buffer);
    }
}
