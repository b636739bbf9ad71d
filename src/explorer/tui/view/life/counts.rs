//! Cycles by formula and counted, and the life against the one that was pinned.

use ratatui::text::{Line, Span};

use super::{RowAllotment, simulated};
use crate::tui::app::App;
use crate::tui::theme::Role;
use crate::tui::units::{sig, sig_or_dash};
use crate::tui::view::sheet::Sheet;
use asperity_engine::scene::CycleBasis;

/// n by formula beside n counted, for both bodies.
pub(super) fn counts(app: &App, rows: &mut RowAllotment, sheet: &mut Sheet<'_>) {
    let theme = app.view.theme;
    let metrics = app.frame().map(|frame| frame.metrics.clone());
    let metrics = metrics.unwrap_or_default();
    let bodies = [
        (
            "n₁",
            app.lives.estimate.n_body_1,
            metrics.n_counted_body_1,
            Role::Body1,
        ),
        (
            "n₂",
            app.lives.estimate.n_body_2,
            metrics.n_counted_body_2,
            Role::Body2,
        ),
    ];
    for (name, formula, counted, role) in bodies {
        let row = rows.take(1);
        // A figure that is cut is another figure.
        let counted_word = if row.width < 21 { "cnt. " } else { "counted " };
        let formula = formula.map_or_else(|| theme.pick("∞", "inf").to_owned(), |n| sig(n, 3));
        let line = Line::from(vec![
            theme.span(format!("{} ", theme.text(name)), role),
            theme.span(format!("{formula:<5}"), Role::Formula),
            theme.span(counted_word, Role::Dim),
            Span::styled(
                theme.text(&sig_or_dash(counted, 3)),
                simulated(app, theme.style(Role::Strong)),
            ),
        ]);
        sheet.line(row, 0, &line);
    }
}

/// The life by the count that is not the headline's: the paper's, or that by damage.
pub(super) fn other_count(app: &App, rows: &mut RowAllotment, sheet: &mut Sheet<'_>) {
    let (Some(life), Some(asked)) = (app.life(), &app.run.setup.scene.life) else {
        return;
    };
    let (word, other) = match asked.cycles {
        CycleBasis::Damage => ("paper's count", life.detail.life_global),
        _ => ("by damage", life.detail.life_damage),
    };
    let theme = app.view.theme;
    let line = Line::from(vec![
        theme.span(format!("{word} "), Role::Dim),
        Span::styled(
            theme.text(&sig_or_dash(other, 2)),
            simulated(app, theme.style(Role::Text)),
        ),
    ]);
    sheet.line(rows.take(1), 0, &line);
}

/// "3.4 times shorter than pinned".
pub(super) fn comparison(app: &App, rows: &mut RowAllotment, sheet: &mut Sheet<'_>) {
    let theme = app.view.theme;
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
        theme.span(format!("{} ", theme.pick("▼", "P")), Role::Warn),
        theme.span(format!("{times}{word}{than}"), role),
    ]);
    sheet.line(row, 0, &line);
    let Some(pinned) = &app.view.pinned else {
        return;
    };
    if rows.rest().height >= 20 {
        let text = format!(
            "  pinned: {} {} at S {}, p_h {}",
            pinned.leading.name(),
            sig(pinned.life_relative, 2),
            sig(pinned.slide_roll, 2),
            app.view.units.pressure().show(pinned.p_hertz_pa, 3)
        );
        sheet.text(rows.take(1), 0, text, Role::Dim);
    }
}
