//! What lies over the screen: keys, plan, lessons, the forms of another scene, a message, a fault.

use ratatui::buffer::Buffer;
use ratatui::layout::{Constraint, Layout, Margin, Rect};
use ratatui::text::{Line, Span};
use ratatui::widgets::{Borders, Clear, Paragraph, Widget, Wrap};

use crate::tui::action::{Action, Group, KEYS, MOUSE};
use crate::tui::app::{App, ErrandKind};
use crate::tui::choice::{Draft, Form};
use crate::tui::theme::Role;
use crate::tui::view::knobs::speeds::{SPECIFIC, SYMBOLS};
use crate::tui::view::panel::bordered;
use crate::tui::view::place::{folded, put, rows_from};

/// A box in the middle of a part of the screen.
struct Overlay<'a> {
    app: &'a App,
    within: Rect,
    title: String,
    /// Of its frame.
    role: Role,
}

impl<'a> Overlay<'a> {
    fn new(app: &'a App, within: Rect, title: &str) -> Self {
        let title = app.view.theme.words(title);
        let role = Role::Key;
        Self {
            app,
            within,
            title,
            role,
        }
    }

    /// Draws it in a wanted size and gives the room inside.
    fn frame(&self, width: u16, height: u16, buffer: &mut Buffer) -> Rect {
        let (theme, within) = (self.app.view.theme, self.within);
        let area = within.centered(Constraint::Length(width), Constraint::Length(height));
        Clear.render(area, buffer);
        // As wide as the screen it needs no sides, and no foot where nothing is below.
        let borders = match (area.width == within.width, area.height == within.height) {
            (true, true) => Borders::TOP,
            (true, false) => Borders::TOP | Borders::BOTTOM,
            _ => Borders::ALL,
        };
        let mut block = bordered(theme, borders, self.role);
        if !self.title.is_empty() {
            block = block.title_top(theme.line(format!(" {} ", self.title), Role::Title));
        }
        block.render(area, buffer);
        area.inner(Margin::new(2, 1))
    }

    /// Lines of text in so many columns, folded; what does not fit is reached by the arrows.
    fn text(mut self, width: u16, lines: &[Line<'static>], closes: &str, buffer: &mut Buffer) {
        let width = width.min(self.within.width);
        let columns = usize::from(width.saturating_sub(4)).max(1);
        let lines: Vec<_> = lines
            .iter()
            .flat_map(|line| folded(line, columns))
            .collect();
        let hidden = (lines.len() as u16 + 2).saturating_sub(self.within.height);
        self.titled(hidden, closes);
        let inner = self.frame(width, lines.len() as u16 + 2, buffer);
        let shown = lines
            .iter()
            .skip(usize::from(self.app.view.scroll.min(hidden)));
        for (row, line) in (0..inner.height).zip(shown) {
            put(inner, row, line, buffer);
        }
    }

    /// Says in the title how the rest is reached, and which key closes it.
    fn titled(&mut self, hidden: u16, closes: &str) {
        let theme = self.app.view.theme;
        let more = match hidden {
            0 => "",
            _ => theme.pick("↑↓ for more, ", "up, down for more, "),
        };
        if !closes.is_empty() {
            self.title = format!("{} ({more}{closes})", self.title);
        }
    }
}

/// The key table in two columns where they fit; headings go where rows are short, and where even
/// so not all fit, the arrows move it.
pub(super) fn help(app: &App, within: Rect, buffer: &mut Buffer) {
    let columns = (within.width / 37).clamp(1, 2);
    let most = within.height.saturating_sub(2);
    let mut lines = help_lines(app);
    if lines.len() > usize::from(columns * most) {
        lines.retain(|(heading, _)| *heading != HelpHeading::Yes);
    }
    let each = (lines.len() as u16).div_ceil(columns).min(most).max(1);
    let hidden = (lines.len() as u16).saturating_sub(columns * each);
    let mut overlay = Overlay::new(app, within, "keys");
    overlay.titled(hidden, "? closes");
    let inner = overlay.frame(columns * 40 + 4, each + 2, buffer);
    let cells = Layout::horizontal(vec![Constraint::Fill(1); usize::from(columns)]).split(inner);
    let shown: Vec<_> = lines
        .iter()
        .skip(usize::from(app.view.scroll.min(hidden)))
        .collect();
    for (cell, lines) in cells.iter().zip(shown.chunks(usize::from(each))) {
        let cell = Rect {
            width: cell.width.saturating_sub(1),
            ..*cell
        };
        for (row, (_, line)) in (0..).zip(lines) {
            put(cell, row, line, buffer);
        }
    }
}

/// Whether a line of the help screen only names what follows.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum HelpHeading {
    Yes,
    No,
}

fn help_lines(app: &App) -> Vec<(HelpHeading, Line<'static>)> {
    let theme = app.view.theme;
    let heading = |name: &str| (HelpHeading::Yes, theme.line(name, Role::Title));
    let row = |keys: &str, help: &str, role: Role| {
        let keys = format!("{:>7} ", ascii_keys(app, keys));
        let line = Line::from(vec![theme.span(keys, role), Span::raw(theme.words(help))]);
        (HelpHeading::No, line)
    };
    let mut lines = Vec::new();
    for group in Group::ALL {
        lines.push(heading(group.name()));
        let rows = KEYS.iter().filter(|row| row.group == group);
        let rows = rows.filter(|row| row.keys.iter().any(|(_, action)| offered(app, *action)));
        lines.extend(rows.map(|known| row(known.shown, known.help, Role::Key)));
    }
    lines.push(heading("Mouse"));
    lines.extend(MOUSE.iter().map(|(what, help)| row(what, help, Role::Key)));
    lines.push(heading("Letters"));
    let letters = SYMBOLS.iter().chain([&SPECIFIC]);
    lines.extend(letters.map(|(name, meaning)| row(name, meaning, Role::Strong)));
    lines
}

/// A key that does nothing here is not listed.
fn offered(app: &App, action: Action) -> bool {
    match action {
        Action::Record => app.offers(ErrandKind::Record),
        Action::View => app.offers(ErrandKind::View),
        Action::Save => app.offers(ErrandKind::Save),
        Action::Write => app.offers(ErrandKind::Write),
        Action::Scene | Action::OperatingPoint => app.offers(ErrandKind::Rebuild),
        _ => true,
    }
}

fn ascii_keys(app: &App, keys: &str) -> String {
    if !app.view.theme.is_ascii() {
        return keys.to_owned();
    }
    let plain = keys
        .replace("↑↓", "up dn")
        .replace("⇧←→ ", "")
        .replace("←→", "lt rt");
    app.view.theme.words(plain)
}

/// What is computed, what is not, and why.
pub(super) fn plan(app: &App, within: Rect, buffer: &mut Buffer) {
    let theme = app.view.theme;
    let mut lines = Vec::new();
    let cautions = app.cautions();
    if !cautions.is_empty() {
        lines.push(theme.line("Cautions", Role::Warn));
        let text = |text: &str| Line::raw(theme.words(format!("  {text}")));
        lines.extend(cautions.iter().map(|caution| text(&caution.text)));
        lines.push(Line::default());
    }
    // The plan of what the knobs have made of the scene.
    let turned = app.turned_setup();
    let setup = turned.as_ref().unwrap_or(&app.run.setup);
    if !setup.left_out.is_empty() {
        lines.push(theme.line("Not modelled or not needed", Role::Warn));
        for left in &setup.left_out {
            let stage = theme.span(format!("  {}: ", left.stage), Role::Strong);
            lines.push(Line::from(vec![stage, Span::raw(theme.words(&left.why))]));
        }
        lines.push(Line::default());
    }
    let plan = setup.plan_text.lines();
    lines.extend(plan.map(|line| Line::raw(theme.words(line))));
    Overlay::new(app, within, "plan").text(100, &lines, "i closes", buffer);
}

/// Words that are too long for the last line, in a box at the foot of the screen; gives the rows that it takes.
pub(super) fn message(app: &App, text: &str, screen: Rect, buffer: &mut Buffer) -> Rect {
    let wide = 100.min(screen.width);
    let line = |line: &str| app.view.theme.line(line, Role::Warn);
    let lines: Vec<_> = text.lines().map(line).collect();
    let columns = usize::from(wide.saturating_sub(4)).max(1);
    let tall: usize = lines.iter().map(|line| folded(line, columns).len()).sum();
    let foot = rows_from(screen, screen.height.saturating_sub(tall as u16 + 2));
    let overlay = Overlay {
        role: Role::Warn,
        ..Overlay::new(app, foot, "")
    };
    overlay.text(wide, &lines, "", buffer);
    foot
}

/// An engine that failed.
pub(super) fn fault(app: &App, reason: &str, within: Rect, buffer: &mut Buffer) {
    let theme = app.view.theme;
    let lines = [
        theme.line(reason, Role::Bad),
        Line::default(),
        Line::raw("What was recorded until then is kept. The last frame stays on the screen."),
        Line::from(vec![
            theme.span("Esc", Role::Key),
            Span::raw(" looks at it, "),
            theme.span("q", Role::Key),
            Span::raw(" quits"),
        ]),
    ];
    let overlay = Overlay {
        role: Role::Bad,
        ..Overlay::new(app, within, "the run failed")
    };
    overlay.text(78, &lines, "", buffer);
}

/// The lessons: one of them begins.
pub(super) fn lessons(app: &App, within: Rect, buffer: &mut Buffer) {
    let theme = app.view.theme;
    let overlay = Overlay::new(app, within, "lessons (t closes)");
    let inner = overlay.frame(66, app.lesson.all.len() as u16 + 4, buffer);
    for (place, lesson) in app.lesson.all.iter().enumerate() {
        let chosen = place == app.lesson.chosen;
        let mark = if chosen { theme.pick("▸", ">") } else { " " };
        let role = if chosen { Role::Chosen } else { Role::Text };
        let asked = lesson.beats.iter().filter(|beat| beat.question.is_some());
        let digit = match place {
            0..9 => (place + 1).to_string(),
            _ => " ".to_owned(),
        };
        let line = Line::from(vec![
            theme.span(mark, Role::Chosen),
            theme.span(format!("{digit} "), Role::Key),
            theme.span(&lesson.title, role),
            theme.span(format!("  {} asked", asked.count()), Role::Dim),
        ]);
        put(inner, place as u16, &line, buffer);
    }
    let keys = theme.pick(
        "↑↓ choose  Enter or a digit begins  T ends the lesson",
        "up, down: choose; Enter or a digit begins; T ends the lesson",
    );
    let last = inner.height.saturating_sub(1);
    put(inner, last, &theme.line(keys, Role::Dim), buffer);
}

/// The form that is open: what only a new run can change, and what its plan says.
pub(super) fn scene(app: &App, within: Rect, buffer: &mut Buffer) {
    /// Rows below the list: one left free, three of words, one of keys.
    const BELOW: u16 = 5;
    let theme = app.view.theme;
    let Some(draft) = &app.choice.draft else {
        return;
    };
    let choices = draft.form.rows();
    let numbers = theme.pick(
        "↑↓ choose  ←→ change  1-9 = type  x undo  Enter runs it",
        "up, down: choose; left, right: change; 1-9, =: type; x: undo",
    );
    let (title, keys) = match draft.form {
        Form::Scene => (
            "change the scene (e closes, E operating point)",
            theme.pick(
                "↑↓ choose  ←→ change  x undo  Enter runs it  e, Esc leave it",
                "up, down: choose; left, right: change; x: undo; Enter runs it",
            ),
        ),
        Form::Point => ("operating point (E as on drawings, e scene)", numbers),
        Form::Drawing => ("as on drawings (E closes, e scene)", numbers),
    };
    let overlay = Overlay::new(app, within, title);
    let inner = overlay.frame(66, choices.len() as u16 + BELOW + 1, buffer);
    // Where not all rows fit, the chosen one is among those that are seen.
    let seen = usize::from(inner.height.saturating_sub(BELOW - 1)).clamp(1, choices.len());
    let first = (draft.row + 1).saturating_sub(seen);
    for (place, row) in (first..choices.len()).take(seen).enumerate() {
        put(inner, place as u16, &line_of(app, draft, row), buffer);
    }
    let typed = draft
        .typed
        .as_ref()
        .and_then(|_| draft.allowed(app.view.units));
    let (words, role) = match (&typed, &draft.verdict) {
        (Some(allowed), _) => (allowed, Role::Text),
        (None, Ok(words)) => (words, Role::Good),
        (None, Err(reason)) => (reason, Role::Bad),
    };
    let text = vec![theme.line(words, role), theme.line(keys, Role::Dim)];
    Paragraph::new(text)
        .wrap(Wrap { trim: true })
        .render(rows_from(inner, seen as u16 + 1), buffer);
}

/// Name and value of a row.
fn line_of(app: &App, draft: &Draft, row: usize) -> Line<'static> {
    let theme = app.view.theme;
    let choice = draft.form.rows()[row];
    let chosen = row == draft.row;
    let role = if chosen { Role::Chosen } else { Role::Text };
    let value = match &draft.typed {
        Some(typed) if chosen => format!("= {typed}_"),
        _ if chosen => format!("◂ {} ▸", choice.shown(draft, app.view.units)),
        _ => format!("  {}", choice.shown(draft, app.view.units)),
    };
    Line::from(vec![
        theme.span(format!("{:<22}", choice.name()), role),
        theme.span(value, Role::Strong),
    ])
}
