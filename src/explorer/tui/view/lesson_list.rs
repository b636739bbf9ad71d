//! The list of lessons over the screen.

use ratatui::buffer::Buffer;
use ratatui::layout::Rect;
use ratatui::text::{Line, Span};

use crate::tui::app::App;
use crate::tui::theme::Role;
use crate::tui::view::overlay::boxed;
use crate::tui::view::{ascii_text, put};

/// The lessons: one of them begins.
pub(super) fn lessons(app: &App, within: Rect, buffer: &mut Buffer) {
    let theme = app.view.theme;
    let rows = app.lesson.all.len() as u16;
    let size = (66, rows + 4);
    let inner = boxed(app, within, size, "lessons (t closes)", Role::Key, buffer);
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
            Span::styled(mark, theme.style(Role::Chosen)),
            Span::styled(format!("{number} "), theme.style(Role::Key)),
            Span::styled(ascii_text(theme, &lesson.title), theme.style(role)),
            Span::styled(format!("  {} asked", asked.count()), theme.style(Role::Dim)),
        ]);
        put(inner, place as u16, &line, buffer);
    }
    let keys = theme.pick(
        "↑↓ choose  Enter or a digit begins  T ends the lesson",
        "up, down: choose; Enter or a digit begins; T ends the lesson",
    );
    put(
        inner,
        inner.height.saturating_sub(1),
        &Line::styled(keys, theme.style(Role::Dim)),
        buffer,
    );
}
