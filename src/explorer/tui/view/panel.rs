//! A panel's frame and title, and how what it says looks by whether it is simulated.

use ratatui::buffer::Buffer;
use ratatui::layout::Rect;
use ratatui::style::{Modifier, Style};
use ratatui::symbols;
use ratatui::text::{Line, Span};
use ratatui::widgets::{Block, Borders, Widget};

use crate::tui::app::{App, Leading, PanelKind};
use crate::tui::theme::{Role, Theme};
use crate::tui::view::areas::{Areas, PanelSpacing};

/// Draws a panel's frame and gives the room inside; the frame of the one that the keys speak of stands out.
pub(super) fn panel(
    app: &App,
    areas: &Areas,
    kind: PanelKind,
    title: Line<'_>,
    buffer: &mut Buffer,
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
    let mut block = bordered(theme, borders, role).title_top(title);
    if has_room && !key.is_empty() {
        block = block.title_top(theme.line(key, Role::Key).right_aligned());
    }
    block.render(area, buffer);
    areas.inside(kind)
}

/// A frame in the theme's characters.
pub(super) fn bordered(theme: Theme, borders: Borders, role: Role) -> Block<'static> {
    /// The same without box characters.
    const ASCII: symbols::border::Set<'static> = symbols::border::Set {
        top_left: "+",
        top_right: "+",
        bottom_left: "+",
        bottom_right: "+",
        vertical_left: "|",
        vertical_right: "|",
        horizontal_top: "-",
        horizontal_bottom: "-",
    };
    let set = if theme.is_ascii() {
        ASCII
    } else {
        symbols::border::ROUNDED
    };
    Block::new()
        .borders(borders)
        .border_set(set)
        .border_style(theme.style(role))
}

/// The look of a number: a role of its own where the simulation says it, else that of formulas.
pub(super) fn led(leading: Leading, simulated: Role) -> Role {
    match leading {
        Leading::Simulated | Leading::Settling => simulated,
        Leading::Scaled | Leading::Formula => Role::Formula,
    }
}

/// A panel's title: its name, with the key that changes it in the key's colour.
pub(super) fn title<'a>(theme: Theme, key: &'a str, name: &'a str) -> Line<'a> {
    let mut spans = vec![Span::raw(" ")];
    if !key.is_empty() {
        spans.push(theme.span(key, Role::Key));
        spans.push(Span::raw(" "));
    }
    spans.push(theme.span(name, Role::Title));
    spans.push(Span::raw(" "));
    Line::from(spans)
}

/// Dims what the simulation says while it is on its way.
pub(super) fn simulated(app: &App, style: Style) -> Style {
    match app.leading() {
        Leading::Simulated => style,
        Leading::Settling | Leading::Scaled | Leading::Formula => style.add_modifier(Modifier::DIM),
    }
}
