//! The list of lessons over the screen.

use ratatui::layout::{Rect, Size};
use ratatui::text::Line;

use crate::tui::app::App;
use crate::tui::theme::Role;
use crate::tui::view::overlay::boxed;
use crate::tui::view::sheet::Sheet;

/// The lessons: one of them begins.
pub(super) fn lessons(app: &App, within: Rect, sheet: &mut Sheet<'_>) {
    let theme = app.view.theme;
    let rows = app.lesson.all.len() as u16;
    let size = Size::new(66, rows + 4);
    let inner = boxed(within, size, "lessons (t closes)", Role::Key, sheet);
    for (place, lesson) in app.lesson.all.iter().enumerate() {
        let chosen = place == app.lesson.chosen;
        let mark = if chosen { theme.pick("▸", ">") } else { " " };
        let role = if chosen { Role::Chosen } else { Role::Text };
        let asked = lesson.beats.iter().filter(|beat| beat.question.is_some());
        let number = if place < 9 {
            (place + 1).to_string()
        } else {
            " ".to_owned()
        };
        let line = Line::from(vec![
            theme.span(mark, Role::Chosen),
            theme.span(format!("{number} "), Role::Key),
            theme.span(&lesson.title, role),
            theme.span(format!("  {} asked", asked.count()), Role::Dim),
        ]);
        sheet.line(inner, place as u16, &line);
    }
    let keys = theme.pick(
        "↑↓ choose  Enter or a digit begins  T ends the lesson",
        "up, down: choose; Enter or a digit begins; T ends the lesson",
    );
    sheet.text(inner, inner.height.saturating_sub(1), keys, Role::Dim);
}
