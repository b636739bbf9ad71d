//! The forms of another scene: what only a new run can change, and what its plan says.

use ratatui::layout::{Rect, Size};
use ratatui::text::Line;

use crate::tui::app::App;
use crate::tui::choice::{Draft, Form};
use crate::tui::theme::Role;
use crate::tui::view::overlay::boxed;
use crate::tui::view::sheet::{Sheet, with_rows};

/// Columns of the box.
const WIDE: u16 = 66;
/// Rows below the list: one left free, three of words, one of keys.
const BELOW: u16 = 5;

/// The form that is open.
pub(super) fn scene(app: &App, within: Rect, sheet: &mut Sheet<'_>) {
    let theme = app.view.theme;
    let Some(draft) = &app.choice.draft else {
        return;
    };
    let rows = draft.form.rows();
    let title = match draft.form {
        Form::Scene => "change the scene (e closes, E operating point)",
        Form::Point => "operating point (E closes, e scene)",
    };
    let size = Size::new(WIDE, rows.len() as u16 + BELOW + 1);
    let inner = boxed(within, size, title, Role::Key, sheet);
    // Where not all rows fit, the chosen one is among those that are seen.
    let seen = usize::from(inner.height.saturating_sub(BELOW - 1)).clamp(1, rows.len());
    let first = (draft.row + 1).saturating_sub(seen);
    for (place, row) in (first..rows.len()).take(seen).enumerate() {
        sheet.line(inner, place as u16, &line_of(app, draft, row));
    }
    let below = with_rows(
        inner,
        inner.y + seen as u16 + 1,
        inner.height.saturating_sub(seen as u16 + 1),
    );
    let typed = draft
        .typed
        .as_ref()
        .and_then(|_| draft.allowed(app.view.units));
    let (words, role) = match (typed, &draft.verdict) {
        (Some(allowed), _) => (allowed, Role::Text),
        (None, Ok(words)) => (words.clone(), Role::Good),
        (None, Err(reason)) => (reason.clone(), Role::Bad),
    };
    let keys = match draft.form {
        Form::Scene => theme.pick(
            "↑↓ choose  ←→ change  Enter runs it  e, Esc leave it",
            "up, down: choose; left, right: change; Enter runs it; Esc leaves it",
        ),
        Form::Point => theme.pick(
            "↑↓ choose  ←→ change  = type  1-9 typical  Enter runs it",
            "up, down: choose; left, right: change; =: type; 1-9: typical",
        ),
    };
    let text = vec![theme.line(&words, role), theme.line(keys, Role::Dim)];
    sheet.paragraph(below, text);
}

/// Name and value of a row.
fn line_of(app: &App, draft: &Draft, row: usize) -> Line<'static> {
    let theme = app.view.theme;
    let choice = draft.form.rows()[row];
    let chosen = row == draft.row;
    let role = if chosen { Role::Chosen } else { Role::Text };
    let value = match &draft.typed {
        Some(typed) if chosen => format!("= {typed}_"),
        _ => {
            let value = theme.text(&choice.shown(draft, app.view.units));
            if chosen {
                format!("{} {value} {}", theme.pick("◂", "<"), theme.pick("▸", ">"))
            } else {
                format!("  {value}")
            }
        }
    };
    Line::from(vec![
        theme.span(format!("{:<22}", choice.name()), role),
        theme.span(value, Role::Strong),
    ])
}
