//! The picture: where each panel is, and the drawing of all of them.

mod caption;
mod centre_line;
mod chart;
mod curve;
mod digits;
mod header;
mod knobs;
mod life;
mod map;
mod overlay;
mod point;
mod status;

use crossterm::event::{MouseButton, MouseEvent, MouseEventKind};
use ratatui::Frame;
use ratatui::buffer::Buffer;
use ratatui::layout::{Margin, Position, Rect};
use ratatui::style::{Color, Style};
use ratatui::symbols;
use ratatui::text::{Line, Span};
use ratatui::widgets::{Block, BorderType, Borders, Paragraph, Widget, Wrap};

use crate::tui::action::Action;
use crate::tui::app::{App, Overlay, PanelKind};
use crate::tui::pixels::Bitmap;
use crate::tui::theme::{Role, Theme};

/// Least size of the screen, columns and rows.
pub const LEAST: (u16, u16) = (60, 20);

/// How much room there is.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum PanelSpacing {
    /// Panels have a rule above them.
    Compact,
    /// Panels have a frame.
    Full,
}

/// Whether words take a few rows under the top line.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Banner {
    /// They do not.
    None,
    /// A lesson or a script says something that takes so many rows.
    Caption(u16),
}

/// Where the panels are.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Areas {
    /// How much room.
    pub density: PanelSpacing,
    /// Top line.
    pub header: Rect,
    /// Below it a caption, where one is shown (else no rows).
    pub caption: Rect,
    /// Left.
    pub knobs: Rect,
    /// Centre, above.
    pub map: Rect,
    /// Centre, below.
    pub centre_line: Rect,
    /// Right.
    pub life: Rect,
    /// Below all three.
    pub point: Rect,
    /// Last lines.
    pub status: Rect,
    /// Left of the map the one that was frozen, where there is room for two.
    pub frozen: Rect,
}

impl Areas {
    /// The panels on a screen; `None` where it is too small.
    pub fn of(screen: Rect, banner: Banner) -> Option<Self> {
        if screen.width < LEAST.0 || screen.height < LEAST.1 {
            return None;
        }
        let density = if screen.width >= 110 && screen.height >= 32 {
            PanelSpacing::Full
        } else {
            PanelSpacing::Compact
        };
        let (left, right) = side_widths(screen.width, density);
        let caption_rows = match banner {
            Banner::None => 0,
            Banner::Caption(rows) => rows.min(MOST_WORDS),
        };
        let (point_rows, status_rows) = match density {
            // Six rows for the trace, its title and its ticks, once the life has its own.
            PanelSpacing::Compact => {
                let free = screen
                    .height
                    .saturating_sub(1 + caption_rows + 2 + LIFE_ROWS);
                (free.clamp(5, 8), 2)
            }
            PanelSpacing::Full => ((screen.height / 5 + 1).clamp(9, 12), 3),
        };
        let body_rows = screen.height - 1 - caption_rows - point_rows - status_rows;
        let gap = u16::from(density == PanelSpacing::Compact);
        let middle = screen.width - left - right - 2 * gap;
        let map_rows = (body_rows * 57).div_ceil(100);
        let top = screen.y + 1 + caption_rows;
        let centre = screen.x + left + gap;
        let below = top + body_rows;
        Some(Self {
            density,
            header: Rect::new(screen.x, screen.y, screen.width, 1),
            caption: Rect::new(screen.x, screen.y + 1, screen.width, caption_rows),
            knobs: Rect::new(screen.x, top, left, body_rows),
            map: Rect::new(centre, top, middle, map_rows),
            centre_line: Rect::new(centre, top + map_rows, middle, body_rows - map_rows),
            life: Rect::new(centre + middle + gap, top, right, body_rows),
            point: Rect::new(screen.x, below, screen.width, point_rows),
            status: Rect::new(screen.x, below + point_rows, screen.width, status_rows),
            frozen: Rect::default(),
        })
    }
}

impl Areas {
    /// The same screen with one panel in place of all.
    #[must_use]
    pub fn enlarged(self, panel: PanelKind) -> Self {
        let whole = Rect {
            x: self.header.x,
            y: self.knobs.y,
            width: self.header.width,
            height: self.status.y - self.knobs.y,
        };
        let of = |own: PanelKind| if own == panel { whole } else { Rect::default() };
        Self {
            knobs: of(PanelKind::Knobs),
            map: of(PanelKind::Map),
            centre_line: of(PanelKind::CentreLine),
            life: of(PanelKind::Life),
            point: of(PanelKind::Point),
            ..self
        }
    }

    /// The same with one more of the last lines, taken from the panel above them.
    #[must_use]
    fn with_a_line(mut self) -> Self {
        self.point.height -= 1;
        self.status.y -= 1;
        self.status.height += 1;
        self
    }

    /// The same with two maps beside each other, where both have room.
    #[must_use]
    fn with_two_maps(mut self) -> Self {
        let half = self.map.width / 2;
        if half >= LEAST_MAP {
            self.frozen = Rect {
                width: half,
                ..self.map
            };
            self.map.x += half;
            self.map.width -= half;
        }
        self
    }

    /// The panel at a place.
    fn panel_at(&self, at: Position) -> Option<PanelKind> {
        PanelKind::ALL
            .into_iter()
            .find(|panel| self.of_panel(*panel).contains(at))
    }

    /// Where a panel is.
    pub fn of_panel(&self, panel: PanelKind) -> Rect {
        match panel {
            PanelKind::Knobs => self.knobs,
            PanelKind::Map => self.map,
            PanelKind::CentreLine => self.centre_line,
            PanelKind::Life => self.life,
            PanelKind::Point => self.point,
        }
    }
}

/// The panels of the screen as it is now.
fn areas_of(app: &App, screen: Rect) -> Option<Areas> {
    let areas = Areas::of(screen, banner(caption::of(app).as_ref(), screen))?;
    let areas = if app.why().is_some() {
        areas.with_a_line()
    } else {
        areas
    };
    let areas = match app.enlarged {
        Some(panel) => areas.enlarged(panel),
        None => areas,
    };
    Some(match &app.ghost {
        Some(_) => areas.with_two_maps(),
        None => areas,
    })
}

/// Columns in which a map can be read.
const LEAST_MAP: u16 = 26;
/// Rows of a caption, its title included.
const MOST_WORDS: u16 = 6;
/// Rows that the life and its factors take.
const LIFE_ROWS: u16 = 13;

fn side_widths(width: u16, density: PanelSpacing) -> (u16, u16) {
    match density {
        PanelSpacing::Compact => ((width / 4).clamp(17, 26), (width * 31 / 100).clamp(19, 28)),
        PanelSpacing::Full => ((width / 5).clamp(28, 38), (width / 4).clamp(32, 46)),
    }
}

/// Draws the whole screen.
pub fn draw(app: &App, frame: &mut Frame<'_>) {
    let screen = frame.area();
    render(app, screen, frame.buffer_mut());
}

/// Draws the whole screen into a buffer.
pub fn render(app: &App, screen: Rect, buffer: &mut Buffer) {
    draw_panels(app, screen, buffer);
    if let Some(page) = app.theme.page() {
        on_page(page, screen, buffer);
    }
}

/// Gives paper and ink to all that has no colour of its own.
fn on_page(page: Style, screen: Rect, buffer: &mut Buffer) {
    for at in screen.positions() {
        let cell = &mut buffer[at];
        if let (Color::Reset, Some(paper)) = (cell.bg, page.bg) {
            cell.bg = paper;
        }
        if let (Color::Reset, Some(ink)) = (cell.fg, page.fg) {
            cell.fg = ink;
        }
    }
}

fn draw_panels(app: &App, screen: Rect, buffer: &mut Buffer) {
    let Some(areas) = areas_of(app, screen) else {
        too_small(app, screen, buffer);
        return;
    };
    header::render(app, areas.header, buffer);
    for panel in PanelKind::ALL {
        if areas.of_panel(panel).is_empty() {
            continue;
        }
        match panel {
            PanelKind::Knobs => knobs::render(app, &areas, buffer),
            PanelKind::Map => map::render(app, &areas, buffer),
            PanelKind::CentreLine => centre_line::render(app, &areas, buffer),
            PanelKind::Life => drop(life::render(app, &areas, buffer)),
            PanelKind::Point => point::render(app, &areas, buffer),
        }
    }
    if let Some(ghost) = app.ghost.as_ref().filter(|_| !areas.frozen.is_empty()) {
        let map = areas.frozen;
        map::render(ghost, &Areas { map, ..areas }, buffer);
    }
    status::render(app, &areas, buffer);
    if let Some(caption) = caption::of(app) {
        caption::render(app, &caption, areas.caption, buffer);
    }
    let body = Rect {
        height: screen.height - areas.status.height - 1,
        y: screen.y + 1,
        ..screen
    };
    match (app.fault(), app.overlay) {
        (Some(reason), _) => overlay::fault(app, reason, body, buffer),
        (None, Overlay::Help) => overlay::help(app, body, buffer),
        (None, Overlay::Plan) => overlay::plan(app, body, buffer),
        (None, Overlay::Scene) => overlay::scene(app, body, buffer),
        (None, Overlay::Lessons) => overlay::lessons(app, body, buffer),
        (None, Overlay::None) => {}
    }
    status::message(app, &areas, screen, buffer);
}

/// The cells that the terminal's own pixels fill; `None`: none, or something lies over them.
pub fn picture_area(app: &App, screen: Rect) -> Option<Rect> {
    map::room(app, &picture_areas(app, screen)?)
}

/// The picture for them, with cells of so many pixels.
pub fn picture(app: &App, screen: Rect, cell: (u16, u16)) -> Option<Bitmap> {
    map::pixels(app, &picture_areas(app, screen)?, cell)
}

fn picture_areas(app: &App, screen: Rect) -> Option<Areas> {
    let areas = areas_of(app, screen)?;
    (app.is_in_pixels() && !areas.map.is_empty()).then_some(areas)
}

fn banner(caption: Option<&caption::Caption>, screen: Rect) -> Banner {
    caption.map_or(Banner::None, |caption| {
        Banner::Caption(caption.rows(screen.width))
    })
}

/// What a mouse event asks for on a screen of that size.
pub fn pointed(app: &App, screen: Rect, event: &MouseEvent) -> Option<Action> {
    let areas = areas_of(app, screen)?;
    let at = Position::new(event.column, event.row);
    if app.overlay != Overlay::None {
        let closes = matches!(event.kind, MouseEventKind::Down(_));
        return closes.then_some(Action::Close);
    }
    match event.kind {
        MouseEventKind::Down(MouseButton::Left) => status::pressed(app, &areas, at)
            .or_else(|| knobs::pressed(app, &areas, at))
            .or_else(|| life::pressed(app, &areas, screen, at))
            .or_else(|| map::pressed(app, &areas, at))
            .or_else(|| point::pressed(&areas, at))
            .or_else(|| areas.panel_at(at).map(Action::Focus)),
        MouseEventKind::Drag(MouseButton::Left) => knobs::dragged(app, &areas, at)
            .or_else(|| map::pressed(app, &areas, at))
            .or_else(|| point::dragged(&areas, at)),
        MouseEventKind::Down(MouseButton::Right) => Some(Action::Close),
        MouseEventKind::ScrollUp => wheel(app, &areas, at, 1),
        MouseEventKind::ScrollDown => wheel(app, &areas, at, -1),
        _ => None,
    }
}

/// The wheel turns the knob under the mouse (choosing it first), and changes the map.
fn wheel(app: &App, areas: &Areas, at: Position, by: i32) -> Option<Action> {
    if areas.map.contains(at) {
        return Some(if by > 0 {
            Action::NextMap
        } else {
            Action::PreviousMap
        });
    }
    let place = knobs::under(app, areas, at)?;
    Some(if place == app.chosen {
        Action::Turn(by)
    } else {
        Action::Choose(place)
    })
}

fn too_small(app: &App, screen: Rect, buffer: &mut Buffer) {
    let text = format!(
        "{} x {} is too small: {} x {} shows the explorer. q quits.",
        screen.width, screen.height, LEAST.0, LEAST.1
    );
    Paragraph::new(text)
        .style(app.theme.style(Role::Warn))
        .wrap(Wrap { trim: true })
        .render(screen, buffer);
}

/// Draws a panel's frame and gives the room inside; the frame of the one that the keys speak of stands out.
fn panel(app: &App, areas: &Areas, kind: PanelKind, title: Line<'_>, buffer: &mut Buffer) -> Rect {
    let (theme, area) = (app.theme, areas.of_panel(kind));
    let (role, key) = match app.enlarged {
        Some(_) => (Role::Key, " Esc "),
        None if app.is_frozen => (Role::Formula, ""),
        None if app.focus == kind => (Role::Key, " ⏎ "),
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
        let key = Line::styled(ascii_text(theme, key), theme.style(Role::Key));
        block = block.title_top(key.right_aligned());
    }
    block.render(area, buffer);
    inside(areas, area)
}

/// The room inside a panel's frame.
fn inside(areas: &Areas, area: Rect) -> Rect {
    match areas.density {
        PanelSpacing::Compact => Rect {
            y: area.y + 1,
            height: area.height.saturating_sub(1),
            ..area
        },
        PanelSpacing::Full => area.inner(Margin::new(1, 1)),
    }
}

const ASCII_BORDER: symbols::border::Set<'static> = symbols::border::Set {
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
fn title<'a>(theme: Theme, key: &'a str, name: &'a str) -> Line<'a> {
    let mut spans = vec![Span::raw(" ")];
    if !key.is_empty() {
        spans.push(Span::styled(key, theme.style(Role::Key)));
        spans.push(Span::raw(" "));
    }
    spans.push(Span::styled(name, theme.style(Role::Title)));
    spans.push(Span::raw(" "));
    Line::from(spans)
}

/// Writes a line at a row of an area, if the row is there.
fn put(area: Rect, row: u16, line: &Line<'_>, buffer: &mut Buffer) {
    if row < area.height {
        buffer.set_line(area.x, area.y + row, line, area.width);
    }
}

/// Writes text against the right edge of a row.
fn put_right(area: Rect, row: u16, line: &Line<'_>, buffer: &mut Buffer) {
    let width = (line.width() as u16).min(area.width);
    if row < area.height {
        buffer.set_line(area.right() - width, area.y + row, line, width);
    }
}

/// What only Unicode terminals show, in letters for those that do not.
fn ascii_text(theme: Theme, text: &str) -> String {
    if !theme.is_ascii() {
        return text.to_owned();
    }
    let mut plain = String::with_capacity(text.len());
    for letter in text.chars() {
        match letter {
            'λ' => plain.push_str("lambda"),
            'ζ' => plain.push_str("zeta"),
            'µ' | 'μ' => plain.push('u'),
            'σ' => plain.push_str("sigma"),
            'τ' => plain.push_str("tau"),
            '₁' => plain.push('1'),
            '₂' => plain.push('2'),
            '×' => plain.push('x'),
            '→' => plain.push_str("->"),
            '–' | '−' => plain.push('-'),
            '≈' => plain.push('~'),
            '≥' => plain.push_str(">="),
            '≤' => plain.push_str("<="),
            '±' => plain.push_str("+-"),
            '·' => plain.push('.'),
            '…' => plain.push_str("..."),
            '⏎' => plain.push_str("CR"),
            '◂' => plain.push('<'),
            '▸' => plain.push('>'),
            other if other.is_ascii() => plain.push(other),
            _ => plain.push('?'),
        }
    }
    plain
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn panels_fill_the_screen_and_never_overlap() {
        for width in 60..=300 {
            for height in 20..=100 {
                let screen = Rect::new(0, 0, width, height);
                panels_at(screen, Banner::None);
                panels_at(screen, Banner::Caption(5));
            }
        }
        assert_eq!(Areas::of(Rect::new(0, 0, 59, 20), Banner::None), None);
        assert_eq!(Areas::of(Rect::new(0, 0, 60, 19), Banner::None), None);
    }

    fn panels_at(screen: Rect, banner: Banner) {
        let Some(areas) = Areas::of(screen, banner) else {
            panic!("{screen} is large enough")
        };
        let all = [
            areas.header,
            areas.knobs,
            areas.map,
            areas.centre_line,
            areas.life,
            areas.point,
            areas.status,
        ];
        for (i, one) in all.iter().enumerate() {
            assert!(one.width > 0 && one.height > 0, "{screen}: {i}");
            assert_eq!(one.intersection(screen), *one);
            assert!(one.intersection(areas.caption).is_empty(), "{screen}: {i}");
            for other in &all[..i] {
                assert!(one.intersection(*other).is_empty(), "{screen}: {i}");
            }
        }
        assert_eq!(areas.status.bottom(), screen.height);
    }
}
