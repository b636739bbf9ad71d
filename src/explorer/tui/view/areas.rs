//! Where each panel is on a screen of any size.

use ratatui::layout::{Constraint, Layout, Margin, Position, Rect};

use crate::tui::app::PanelKind;
use crate::tui::view::place::{columns, columns_from, rows_from};

/// Minimum size of the screen, columns and rows.
pub const MIN_SCREEN: (u16, u16) = (60, 20);
/// Minimum size of a narrower one: a phone held upright.
pub const MIN_NARROW_SCREEN: (u16, u16) = (40, 30);

/// How much room there is.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum PanelSpacing {
    /// Panels have a rule above them.
    Compact,
    /// Panels have a frame.
    Full,
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
    /// Whether there is room for one picture only, with life and knobs below it.
    pub is_narrow: bool,
}

impl Areas {
    /// The panels on a screen, with so many rows of a caption under the top line; `None` where it is too small.
    pub fn of(screen: Rect, caption_rows: u16) -> Option<Self> {
        let caption_rows = caption_rows.min(MAX_CAPTION_ROWS);
        if screen.width < MIN_SCREEN.0 {
            return Self::narrow(screen, caption_rows);
        }
        if screen.height < MIN_SCREEN.1 {
            return None;
        }
        let density = if screen.width >= 110 && screen.height >= 32 {
            PanelSpacing::Full
        } else {
            PanelSpacing::Compact
        };
        let (point_rows, status_rows) = match density {
            // Six rows for the trace, its title and its ticks, once the life has its own.
            PanelSpacing::Compact => {
                let taken = 1 + caption_rows + 2 + LIFE_ROWS;
                (screen.height.saturating_sub(taken).clamp(5, 8), 2)
            }
            PanelSpacing::Full => ((screen.height / 5 + 1).clamp(9, 12), 3),
        };
        let body_rows = screen.height - 1 - caption_rows - point_rows - status_rows;
        let heights = [1, caption_rows, body_rows, point_rows, status_rows];
        let [header, caption, body, point, status] =
            Layout::vertical(heights.map(Constraint::Length)).areas(screen);
        let (left, right) = side_widths(screen.width, density);
        let gap = u16::from(density == PanelSpacing::Compact);
        let [knobs, centre, life] = Layout::horizontal([
            Constraint::Length(left),
            Constraint::Fill(1),
            Constraint::Length(right),
        ])
        .spacing(gap)
        .areas(body);
        let map_rows = (body_rows * 57).div_ceil(100);
        let [map, centre_line] =
            Layout::vertical([Constraint::Length(map_rows), Constraint::Fill(1)]).areas(centre);
        Some(Self {
            density,
            header,
            caption,
            knobs,
            map,
            centre_line,
            life,
            point,
            status,
            frozen: Rect::default(),
            is_narrow: false,
        })
    }

    /// One picture, life and knobs, one below the other.
    fn narrow(screen: Rect, caption_rows: u16) -> Option<Self> {
        /// Rows of the sentence on a knob, of the run's state, and of the keys.
        const STATUS: u16 = 3;
        if screen.width < MIN_NARROW_SCREEN.0 || screen.height < MIN_NARROW_SCREEN.1 {
            return None;
        }
        let body_rows = screen.height - 1 - caption_rows - STATUS;
        // Three rows a knob are a finger's width; two where rows are few.
        let knob_rows = if body_rows >= 36 { 16 } else { 11 };
        let life_rows = ((body_rows - knob_rows) * 2 / 5).clamp(5, LIFE_ROWS);
        let map_rows = body_rows - knob_rows - life_rows;
        let heights = [1, caption_rows, map_rows, life_rows, knob_rows, STATUS];
        let [header, caption, map, life, knobs, status] =
            Layout::vertical(heights.map(Constraint::Length)).areas(screen);
        Some(Self {
            density: PanelSpacing::Compact,
            header,
            caption,
            map,
            life,
            knobs,
            status,
            centre_line: Rect::default(),
            point: Rect::default(),
            frozen: Rect::default(),
            is_narrow: true,
        })
    }

    /// The room inside a panel's frame.
    pub(super) fn inside(&self, panel: PanelKind) -> Rect {
        let area = self.of_panel(panel);
        match self.density {
            PanelSpacing::Compact => rows_from(area, 1),
            PanelSpacing::Full => area.inner(Margin::new(1, 1)),
        }
    }

    /// The same, on a narrow screen with another picture than the map.
    #[must_use]
    pub(super) fn with_picture(mut self, panel: PanelKind) -> Self {
        let place = match panel {
            PanelKind::CentreLine => &mut self.centre_line,
            PanelKind::Point => &mut self.point,
            PanelKind::Knobs | PanelKind::Map | PanelKind::Life => return self,
        };
        if self.is_narrow {
            *place = std::mem::take(&mut self.map);
        }
        self
    }

    /// The same screen with one panel in place of all.
    #[must_use]
    pub fn enlarged(self, panel: PanelKind) -> Self {
        let whole = Rect {
            x: self.header.x,
            y: self.caption.bottom(),
            width: self.header.width,
            height: self.status.y - self.caption.bottom(),
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

    /// The same with one more of the last lines, taken from the panel above them; a narrow screen has it anyway.
    #[must_use]
    pub(super) fn with_a_line(mut self) -> Self {
        if self.is_narrow {
            return self;
        }
        self.point.height -= 1;
        self.status.y -= 1;
        self.status.height += 1;
        self
    }

    /// The same with two maps beside each other, where both have room.
    #[must_use]
    pub(super) fn with_two_maps(mut self) -> Self {
        let half = self.map.width / 2;
        if half >= MIN_MAP_COLUMNS {
            self.frozen = columns(self.map, 0, half);
            self.map = columns_from(self.map, half);
        }
        self
    }

    /// The panel at a place.
    pub(super) fn panel_at(&self, at: Position) -> Option<PanelKind> {
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

/// Columns in which a map can be read.
const MIN_MAP_COLUMNS: u16 = 26;
/// Rows of a caption, its title included.
const MAX_CAPTION_ROWS: u16 = 6;
/// Rows that the life and its factors take.
const LIFE_ROWS: u16 = 13;

fn side_widths(width: u16, density: PanelSpacing) -> (u16, u16) {
    match density {
        PanelSpacing::Compact => ((width / 4).clamp(17, 26), (width * 31 / 100).clamp(19, 28)),
        PanelSpacing::Full => ((width / 5).clamp(28, 38), (width / 4).clamp(32, 46)),
    }
}
