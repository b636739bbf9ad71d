//! What lies over the screen: keys, plan, a fault, a lesson's caption.

use ratatui::buffer::Buffer;
use ratatui::layout::Rect;
use ratatui::text::{Line, Span};
use ratatui::widgets::{Block, BorderType, Borders, Clear, Paragraph, Widget, Wrap};

use crate::tui::action::{Action, DIGITS, Group, KEYS, MOUSE};
use crate::tui::app::{App, ErrandKind};
use crate::tui::theme::Role;
use crate::tui::view::{ASCII_BORDER, ascii_text};

/// Draws a box of a wanted size in the middle and gives the room inside.
fn boxed(
    app: &App,
    within: Rect,
    (width, height): (u16, u16),
    title: &str,
    role: Role,
    buffer: &mut Buffer,
) -> Rect {
    let theme = &app.theme;
    let (width, height) = (width.min(within.width), height.min(within.height));
    let area = Rect {
        x: within.x + (within.width - width) / 2,
        y: within.y + (within.height - height) / 2,
        width,
        height,
    };
    Clear.render(area, buffer);
    let block = Block::new()
        .borders(Borders::ALL)
        .border_style(theme.style(role))
        .title_top(Line::styled(format!(" {title} "), theme.style(Role::Title)));
    let block = if theme.is_ascii() {
        block.border_set(ASCII_BORDER)
    } else {
        block.border_type(BorderType::Rounded)
    };
    let inner = block.inner(area);
    block.render(area, buffer);
    Rect {
        x: inner.x + 1,
        width: inner.width.saturating_sub(2),
        ..inner
    }
}

/// The key table.
pub(super) fn help(app: &App, within: Rect, buffer: &mut Buffer) {
    let columns = if within.width >= 92 { 2 } else { 1 };
    let lines = help_lines(app);
    let tall = (lines.len().div_ceil(columns) as u16 + 2).min(within.height);
    // On a small screen headings go, then the columns share the rest.
    let columns = if columns == 1 && lines.len() as u16 + 2 > within.height {
        2
    } else {
        columns
    };
    let wide = if columns == 2 { 94 } else { 52 };
    let tall = if columns == 2 {
        (lines.len().div_ceil(2) as u16 + 2).min(within.height)
    } else {
        tall
    };
    let inner = boxed(
        app,
        within,
        (wide, tall),
        "keys (? closes)",
        Role::Key,
        buffer,
    );
    let each = inner.width / columns as u16;
    for (place, line) in lines.iter().enumerate() {
        let (column, row) = (
            place as u16 / inner.height.max(1),
            place as u16 % inner.height.max(1),
        );
        if column >= columns as u16 {
            break;
        }
        let x = inner.x + column * each;
        buffer.set_line(x, inner.y + row, line, each.saturating_sub(1));
    }
}

fn help_lines(app: &App) -> Vec<Line<'static>> {
    let theme = &app.theme;
    let row = |keys: &str, help: &'static str| {
        let keys = if theme.is_ascii() {
            ascii_keys(keys)
        } else {
            keys.to_owned()
        };
        Line::from(vec![
            Span::styled(format!("{keys:>6} "), theme.style(Role::Key)),
            Span::raw(help),
        ])
    };
    let mut lines = Vec::new();
    for group in Group::ALL {
        lines.push(Line::styled(group.name(), theme.style(Role::Title)));
        for binding in KEYS.iter().filter(|binding| binding.group == group) {
            if offered(app, binding.action) {
                lines.push(row(binding.shown, binding.help));
            }
        }
        if group == Group::Knobs {
            lines.push(row(DIGITS.0, DIGITS.1));
        }
    }
    lines.push(Line::styled("Mouse", theme.style(Role::Title)));
    lines.extend(MOUSE.iter().map(|(what, help)| row(what, help)));
    lines
}

/// A key that does nothing here is not listed.
fn offered(app: &App, action: Action) -> bool {
    match action {
        Action::Record => app.offers(ErrandKind::Record),
        Action::View => app.offers(ErrandKind::View),
        Action::Save => app.offers(ErrandKind::Save),
        _ => true,
    }
}

fn ascii_keys(keys: &str) -> String {
    keys.replace('↑', "up")
        .replace('↓', "dn")
        .replace('←', "lt")
        .replace('→', "rt")
        .replace('⇧', "S-")
}

/// What is computed, what is left out, and why.
pub(super) fn plan(app: &App, within: Rect, buffer: &mut Buffer) {
    let theme = &app.theme;
    let mut lines = Vec::new();
    if !app.setup.left_out.is_empty() {
        lines.push(Line::styled("Left out", theme.style(Role::Warn)));
        for left in &app.setup.left_out {
            lines.push(Line::from(vec![
                Span::styled(
                    format!("  {}: ", ascii_text(theme, &left.stage)),
                    theme.style(Role::Strong),
                ),
                Span::raw(ascii_text(theme, &left.reason)),
            ]));
        }
        lines.push(Line::default());
    }
    lines.push(Line::styled("The model itself", theme.style(Role::Warn)));
    lines.push(Line::raw(
        "  no wear, isothermal, elastic, initiation only; no absolute life without a calibration point",
    ));
    lines.push(Line::default());
    lines.extend(
        app.setup
            .plan_text
            .lines()
            .map(|line| Line::raw(ascii_text(theme, line))),
    );
    let tall = lines.len() as u16 + 6;
    let inner = boxed(
        app,
        within,
        (100, tall),
        "plan (i closes)",
        Role::Key,
        buffer,
    );
    Paragraph::new(lines)
        .wrap(Wrap { trim: false })
        .render(inner, buffer);
}

/// An engine that failed.
pub(super) fn fault(app: &App, reason: &str, within: Rect, buffer: &mut Buffer) {
    let theme = &app.theme;
    let wide = 76.min(within.width);
    let rows = reason.chars().count() as u16 / wide.saturating_sub(6).max(1) + 1;
    let size = (wide, rows + 6);
    let inner = boxed(app, within, size, "the run failed", Role::Bad, buffer);
    let text = vec![
        Line::styled(reason.to_owned(), theme.style(Role::Bad)),
        Line::default(),
        Line::raw("What was recorded until then is kept. The last frame stays on the screen."),
        Line::from(vec![
            Span::styled("Esc", theme.style(Role::Key)),
            Span::raw(" looks at it, "),
            Span::styled("q", theme.style(Role::Key)),
            Span::raw(" quits"),
        ]),
    ];
    Paragraph::new(text)
        .wrap(Wrap { trim: true })
        .render(inner, buffer);
}

/// What a lesson, or the scene's script, says now: over the upper edge of the map.
pub(super) fn caption(app: &App, map: Rect, buffer: &mut Buffer) {
    let theme = &app.theme;
    let (title, text, foot) = match app.tour {
        Some(tour) => (
            format!("{} {}", tour.lesson + 1, tour.lesson().title),
            tour.beat().caption,
            "n next lesson, t ends",
        ),
        None => match scripted(app) {
            Some(text) => (String::new(), text, ""),
            None => return,
        },
    };
    let width = map.width.min(72);
    let room = width.saturating_sub(4).max(1);
    let rows = text.chars().count() as u16 / room + 1;
    let within = Rect {
        y: map.y,
        height: (rows + 3).min(map.height),
        ..map
    };
    let inner = boxed(app, within, (width, rows + 3), &title, Role::Key, buffer);
    Paragraph::new(vec![
        Line::raw(ascii_text(theme, text)),
        Line::styled(foot, theme.style(Role::Dim)),
    ])
    .wrap(Wrap { trim: true })
    .render(inner, buffer);
}

/// The caption of the last scripted event, while it is fresh (half a passage).
fn scripted(app: &App) -> Option<&str> {
    let frame = app.frame()?;
    let fresh = 2.0 * frame.a_m / frame.metrics.entrainment_m_s.abs().max(1e-9);
    app.setup
        .scene
        .events
        .iter()
        .filter(|event| !event.caption.is_empty())
        .filter(|event| (event.at_s..event.at_s + fresh).contains(&frame.time_s))
        .next_back()
        .map(|event| event.caption.as_str())
}
