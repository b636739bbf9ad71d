//! Where each panel is on a screen of any size.

use ratatui::layout::{Position, Rect};

use crate::tui::app::PanelKind;

/// Minimum size of the screen, columns and rows.
pub const MIN_SIZE: (u16, u16) = (60, 20);
/// Minimum size of a narrower one: a phone held upright.
pub const MIN_NARROW_SIZE: (u16, u16) = (40, 30);

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

impl Banner {
    fn rows(self) -> u16 {
        match self {
            Self::None => 0,
            Self::Caption(rows) => rows.min(MOST_WORDS),
        }
    }
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
    /// The panels on a screen; `None` where it is too small.
    pub fn of(screen: Rect, banner: Banner) -> Option<Self> {
        if screen.width < MIN_SIZE.0 {
            return Self::narrow(screen, banner);
        }
        if screen.height < MIN_SIZE.1 {
            return None;
        }
        let density = if screen.width >= 110 && screen.height >= 32 {
            PanelSpacing::Full
        } else {
            PanelSpacing::Compact
        };
        let (left, right) = side_widths(screen.width, density);
        let caption_rows = banner.rows();
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
            is_narrow: false,
        })
    }

    /// One picture, life and knobs, one below the other.
    fn narrow(screen: Rect, banner: Banner) -> Option<Self> {
        /// Rows of the sentence on a knob, of the run's state, and of the keys.
        const STATUS: u16 = 3;
        if screen.width < MIN_NARROW_SIZE.0 || screen.height < MIN_NARROW_SIZE.1 {
            return None;
        }
        let caption_rows = banner.rows();
        let body_rows = screen.height - 1 - caption_rows - STATUS;
        // Three rows a knob are a finger's width; two where rows are few.
        let knob_rows = if body_rows >= 36 { 16 } else { 11 };
        let life_rows = ((body_rows - knob_rows) * 2 / 5).clamp(5, LIFE_ROWS);
        let map_rows = body_rows - knob_rows - life_rows;
        let mut next = screen.y;
        let mut rows = |height: u16| {
            next += height;
            Rect::new(screen.x, next - height, screen.width, height)
        };
        Some(Self {
            density: PanelSpacing::Compact,
            header: rows(1),
            caption: rows(caption_rows),
            map: rows(map_rows),
            life: rows(life_rows),
            knobs: rows(knob_rows),
            status: rows(STATUS),
            centre_line: Rect::default(),
            point: Rect::default(),
            frozen: Rect::default(),
            is_narrow: true,
        })
    }
}

impl Areas {
    /// The same, on a narrow screen with another picture than the map.
    #[must_use]
    pub(super) fn with_picture(self, panel: PanelKind) -> Self {
        let none = Rect::default();
        match panel {
            PanelKind::CentreLine if self.is_narrow => Self {
                centre_line: self.map,
                map: none,
                ..self
            },
            PanelKind::Point if self.is_narrow => Self {
                point: self.map,
                map: none,
                ..self
            },
            _ => self,
        }
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
