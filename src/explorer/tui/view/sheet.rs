//! What panels write on, the frames around them, and parts of their room.

use ratatui::buffer::Buffer;
use ratatui::layout::{Margin, Rect};
use ratatui::style::Style;
use ratatui::symbols;
use ratatui::text::{Line, Span, Text};
use ratatui::widgets::{Block, BorderType, Borders, Paragraph, Widget, Wrap};

use super::areas::{Areas, PanelSpacing};
use crate::tui::app::App;
use crate::tui::kinds::PanelKind;
use crate::tui::theme::{Role, Theme};

/// Cells, in the colours and characters of a theme.
pub(super) struct Sheet<'a> {
    pub(super) theme: Theme,
    pub(super) buffer: &'a mut Buffer,
}

impl Sheet<'_> {
    /// Writes text at a row of an area, if the row is there.
    pub(super) fn text(&mut self, area: Rect, row: u16, text: impl AsRef<str>, role: Role) {
        self.line(area, row, &self.theme.line(text, role));
    }

    /// Writes text against the right edge of a row.
    pub(super) fn text_right(&mut self, area: Rect, row: u16, text: impl AsRef<str>, role: Role) {
        self.line_right(area, row, &self.theme.line(text, role));
    }

    /// Writes a line at a row of an area, if the row is there.
    pub(super) fn line(&mut self, area: Rect, row: u16, line: &Line<'_>) {
        if row < area.height {
            self.buffer.set_line(area.x, area.y + row, line, area.width);
        }
    }

    /// Writes a line against the right edge of a row.
    pub(super) fn line_right(&mut self, area: Rect, row: u16, line: &Line<'_>) {
        let width = (line.width() as u16).min(area.width);
        self.line(with_columns(area, area.right() - width, width), row, line);
    }

    /// Writes words over as many rows as they take.
    pub(super) fn paragraph<'a>(&mut self, area: Rect, text: impl Into<Text<'a>>) {
        Paragraph::new(text)
            .wrap(Wrap { trim: true })
            .render(area, self.buffer);
    }

    /// Draws one cell, where there is one.
    pub(super) fn cell(&mut self, x: u16, y: u16, symbol: &str, style: Style) {
        if let Some(cell) = self.buffer.cell_mut((x, y)) {
            cell.set_symbol(symbol).set_style(style);
        }
    }
}

/// These rows of an area.
pub(super) fn with_rows(area: Rect, y: u16, height: u16) -> Rect {
    Rect { y, height, ..area }
}

/// What is left of an area below so many of its rows.
pub(super) fn below(area: Rect, taken: u16) -> Rect {
    with_rows(area, area.y + taken, area.height.saturating_sub(taken))
}

/// These columns of an area.
pub(super) fn with_columns(area: Rect, x: u16, width: u16) -> Rect {
    Rect { x, width, ..area }
}

/// Draws a panel's frame and gives the room inside; the frame of the one that the keys speak of stands out.
pub(super) fn panel(
    app: &App,
    areas: &Areas,
    kind: PanelKind,
    title: Line<'_>,
    sheet: &mut Sheet<'_>,
) -> Rect {
    let (theme, area) = (app.view.theme, areas.of_panel(kind));
    let (role, key) = match app.view.enlarged {
        Some(_) => (Role::Key, " Esc "),
        None if app.view.is_frozen => (Role::Formula, ""),
        None if app.view.focus == kind => (Role::Key, " ⏎ "),
        None => (Role::Border, ""),
    };
    let has_room = title.width() + key.chars().count() + 2 < usize::from(area.width);
    let borders = match areas.density {
        PanelSpacing::Compact => Borders::TOP,
        PanelSpacing::Full => Borders::ALL,
    };
    let mut block = Block::new()
        .borders(borders)
        .border_style(theme.style(role))
        .title_top(title);
    block = if theme.is_ascii() {
        block.border_set(ASCII_BORDER)
    } else {
        block.border_type(BorderType::Rounded)
    };
    if has_room && !key.is_empty() {
        let key = theme.line(key, Role::Key);
        block = block.title_top(key.right_aligned());
    }
    block.render(area, sheet.buffer);
    inside(areas, area)
}

/// The room inside a panel's frame.
pub(super) fn inside(areas: &Areas, area: Rect) -> Rect {
    match areas.density {
        PanelSpacing::Compact => Rect {
            y: area.y + 1,
            height: area.height.saturating_sub(1),
            ..area
        },
        PanelSpacing::Full => area.inner(Margin::new(1, 1)),
    }
}

pub(super) const ASCII_BORDER: symbols::border::Set<'static> = symbols::border::Set {
    top_left: "+",
    top_right: "+",
    bottom_left: "+",
    bottom_right: "+",
    vertical_left: "|",
    vertical_right: "|",
    horizontal_top: "-",
    horizontal_bottom: "-",
};

/// A panel's title: its name, with the key that changes it in the key's colour.
pub(super) fn title<'a>(theme: Theme, key: &'a str, name: &'a str) -> Line<'a> {
    let mut spans = vec![Span::raw(" ")];
    if !key.is_empty() {
        spans.push(Span::styled(key, theme.style(Role::Key)));
        spans.push(Span::raw(" "));
    }
    spans.push(Span::styled(name, theme.style(Role::Title)));
    spans.push(Span::raw(" "));
    Line::from(spans)
}
