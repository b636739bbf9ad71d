//! What lies over the screen: keys, plan, a fault.

use ratatui::layout::{Constraint, Margin, Rect, Size};
use ratatui::style::Style;
use ratatui::text::{Line, Span};
use ratatui::widgets::{Block, BorderType, Borders, Clear, Widget};

use crate::tui::action::{Action, Group, KEYS, MOUSE};
use crate::tui::app::{App, ErrandKind};
use crate::tui::theme::Role;
use crate::tui::view::knobs::{SPECIFIC, SYMBOLS};
use crate::tui::view::sheet::{ASCII_BORDER, Sheet, with_columns, with_rows};

/// Draws a box of a wanted size in the middle and gives the room inside.
pub(super) fn boxed(
    within: Rect,
    size: Size,
    title: &str,
    role: Role,
    sheet: &mut Sheet<'_>,
) -> Rect {
    let theme = sheet.theme;
    let width = Constraint::Length(size.width.min(within.width));
    let height = Constraint::Length(size.height.min(within.height));
    let area = within.centered(width, height);
    Clear.render(area, sheet.buffer);
    // As wide as the screen it needs no sides, and no foot where nothing is below.
    let borders = match (area.width == within.width, area.height == within.height) {
        (true, true) => Borders::TOP,
        (true, false) => Borders::TOP | Borders::BOTTOM,
        _ => Borders::ALL,
    };
    let block = Block::new()
        .borders(borders)
        .border_style(theme.style(role))
        .title_top(match title {
            "" => Line::default(),
            title => theme.line(format!(" {title} "), Role::Title),
        });
    let block = if theme.is_ascii() {
        block.border_set(ASCII_BORDER)
    } else {
        block.border_type(BorderType::Rounded)
    };
    block.render(area, sheet.buffer);
    area.inner(Margin::new(2, 1))
}

/// The key table in two columns where they fit; headings go where rows are short, and where even
/// so not all fit, the arrows move it.
pub(super) fn help(app: &App, within: Rect, sheet: &mut Sheet<'_>) {
    let columns = (within.width / 37).clamp(1, 2);
    let most = within.height.saturating_sub(2);
    let mut lines = help_lines(app);
    if lines.len() > usize::from(columns * most) {
        lines.retain(|(heading, _)| *heading != HelpHeading::Yes);
    }
    let rows = (lines.len() as u16).div_ceil(columns).min(most);
    let hidden = (lines.len() as u16).saturating_sub(columns * rows);
    let title = if hidden > 0 {
        app.view.theme.pick(
            "keys (↑↓ for more, ? closes)",
            "keys (up, down for more, ? closes)",
        )
    } else {
        "keys (? closes)"
    };
    let size = Size::new(columns * 40 + 4, rows + 2);
    let inner = boxed(within, size, title, Role::Key, sheet);
    let each = inner.width / columns;
    let shown = lines.iter().skip(usize::from(app.view.scroll.min(hidden)));
    for (place, (_, line)) in shown.enumerate() {
        let (column, row) = (place as u16 / rows.max(1), place as u16 % rows.max(1));
        if column < columns {
            let cell = with_columns(inner, inner.x + column * each, each.saturating_sub(1));
            sheet.line(cell, row, line);
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
    let heading = |name: &'static str| {
        let line = theme.line(name, Role::Title);
        (HelpHeading::Yes, line)
    };
    let row = |keys: &str, help: &str, role: Role| {
        let line = Line::from(vec![
            theme.span(format!("{:>7} ", ascii_keys(app, keys)), role),
            Span::raw(theme.text(help)),
        ]);
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
    lines.extend(
        SYMBOLS
            .iter()
            .chain([&SPECIFIC])
            .map(|(name, meaning)| row(name, meaning, Role::Strong)),
    );
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
    app.view.theme.text(&plain)
}

/// What is computed, what is not, and why.
pub(super) fn plan(app: &App, within: Rect, sheet: &mut Sheet<'_>) {
    let theme = app.view.theme;
    let mut lines = Vec::new();
    let cautions = app.cautions();
    if !cautions.is_empty() {
        lines.push(theme.line("Cautions", Role::Warn));
        lines.extend(
            cautions
                .iter()
                .map(|caution| Line::raw(format!("  {}", theme.text(&caution.text)))),
        );
        lines.push(Line::default());
    }
    if !app.run.setup.left_out.is_empty() {
        lines.push(theme.line("Not modelled or not needed", Role::Warn));
        for left in &app.run.setup.left_out {
            lines.push(Line::from(vec![
                theme.span(format!("  {}: ", theme.text(left.stage)), Role::Strong),
                Span::raw(theme.text(&left.why)),
            ]));
        }
        lines.push(Line::default());
    }
    lines.extend(
        app.run
            .setup
            .plan_text
            .lines()
            .map(|line| Line::raw(theme.text(line))),
    );
    let wide = PLAN_WIDE.min(within.width);
    let columns = usize::from(wide.saturating_sub(4)).max(1);
    let rows: Vec<Line> = lines
        .iter()
        .flat_map(|line| folded(line, columns, 2))
        .collect();
    let tall = (rows.len() as u16 + 2).min(within.height);
    let hidden = (rows.len() as u16).saturating_sub(tall.saturating_sub(2));
    let title = if hidden > 0 {
        theme.pick(
            "plan (↑↓ for more, i closes)",
            "plan (up, down for more, i closes)",
        )
    } else {
        "plan (i closes)"
    };
    let inner = boxed(within, Size::new(wide, tall), title, Role::Key, sheet);
    let shown = rows.iter().skip(usize::from(app.view.scroll.min(hidden)));
    for (row, line) in (0..inner.height).zip(shown) {
        sheet.line(inner, row, line);
    }
}

/// Width of the plan, in columns.
const PLAN_WIDE: u16 = 100;

/// A line in rows of so many columns, broken between words; what goes on keeps the indentation, and so many columns more.
fn folded(line: &Line<'static>, columns: usize, hanging: usize) -> Vec<Line<'static>> {
    if line.width() <= columns {
        return vec![line.clone()];
    }
    let text: String = line
        .spans
        .iter()
        .map(|span| span.content.as_ref())
        .collect();
    let indent = text.chars().take_while(|c| *c == ' ').count();
    let styles: Vec<Style> = line
        .spans
        .iter()
        .flat_map(|span| span.content.chars().map(|_| line.style.patch(span.style)))
        .collect();
    let letters: Vec<char> = text.chars().collect();
    let (mut rows, mut from, mut before) = (Vec::new(), 0, 0);
    while from < letters.len() {
        let room = columns.saturating_sub(before).max(1);
        let most = (from + room).min(letters.len());
        let to = if most == letters.len() {
            most
        } else {
            let space = (from + 1..=most).rev().find(|&k| letters[k] == ' ');
            space.unwrap_or(most)
        };
        let mut spans = vec![Span::raw(" ".repeat(before))];
        spans.extend((from..to).map(|k| Span::styled(letters[k].to_string(), styles[k])));
        rows.push(Line::from(spans));
        from = to + letters[to..].iter().take_while(|c| **c == ' ').count();
        before = indent + hanging;
    }
    rows
}

/// Words that are too long for the last line, in a box at the foot of the screen.
pub(super) fn message(app: &App, text: &str, screen: Rect, sheet: &mut Sheet<'_>) -> Rect {
    let theme = app.view.theme;
    let wide = 100.min(screen.width);
    let text = text.lines().map(|line| theme.line(line, Role::Warn));
    let columns = usize::from(wide.saturating_sub(4)).max(1);
    let lines: Vec<Line> = text.flat_map(|line| folded(&line, columns, 0)).collect();
    let tall = (lines.len() as u16 + 2).min(screen.height);
    let foot = with_rows(screen, screen.bottom() - tall, tall);
    let inner = boxed(foot, Size::new(wide, tall), "", Role::Warn, sheet);
    for (row, line) in (0..).zip(lines) {
        sheet.line(inner, row, &line);
    }
    foot
}

/// An engine that failed.
pub(super) fn fault(app: &App, reason: &str, within: Rect, sheet: &mut Sheet<'_>) {
    let theme = app.view.theme;
    let wide = 76.min(within.width);
    let rows = reason.chars().count() as u16 / wide.saturating_sub(6).max(1) + 1;
    let size = Size::new(wide, rows + 6);
    let inner = boxed(within, size, "the run failed", Role::Bad, sheet);
    let text = vec![
        theme.line(reason.to_owned(), Role::Bad),
        Line::default(),
        Line::raw("What was recorded until then is kept. The last frame stays on the screen."),
        Line::from(vec![
            theme.span("Esc", Role::Key),
            Span::raw(" looks at it, "),
            theme.span("q", Role::Key),
            Span::raw(" quits"),
        ]),
    ];
    sheet.paragraph(inner, text);
}
