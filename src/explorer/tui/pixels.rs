//! The map in the terminal's own pixels, where it has them: sixel or kitty's protocol in place of half blocks.
//!
//! ```text
//! frame ──> view: cells, the map's room left blank ──> terminal
//!       └─> view: RGBA of that room ──> sixel | kitty ──> terminal, under or before the letters on it
//! ```
//! Which protocol a terminal has is known from its name; a terminal within another (tmux, ssh) is not asked for
//! pixels unless the key says so.
//!
//! The crate `ratatui-image` was measured in place of the two encoders (215 lines without tests): it brings 114 crates, 34
//! of them new to this program; with its usual features 178 and 61, 164 CPU seconds, and did not build without the C
//! library chafa. It cannot put letters on a picture, which the marks of a map are.

#[cfg(not(target_arch = "wasm32"))]
pub(super) mod kitty;
#[cfg(not(target_arch = "wasm32"))]
pub(super) mod sixel;

use ratatui::layout::Rect;
use ratatui::style::Color;

/// How the map is drawn.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum Pixels {
    /// In half blocks, or characters of growing ink.
    #[default]
    Blocks,
    /// In sixels.
    Sixel,
    /// By kitty's graphics protocol.
    Kitty,
    /// In the pixels of a page.
    Page,
}

impl Pixels {
    /// What a terminal is known to have, by the environment's variables.
    pub fn detect(variable: impl Fn(&str) -> Option<String>) -> Self {
        let filled = |name: &str| variable(name).filter(|value| !value.is_empty());
        let within = ["TMUX", "STY", "SSH_CONNECTION", "NO_COLOR"];
        if within.iter().any(|name| filled(name).is_some()) {
            return Self::Blocks;
        }
        let term = filled("TERM").unwrap_or_default();
        let program = filled("TERM_PROGRAM").unwrap_or_default();
        if filled("KITTY_WINDOW_ID").is_some() || term.contains("kitty") || term.contains("ghostty")
        {
            Self::Kitty
        } else if ["foot", "mlterm", "contour"]
            .iter()
            .any(|name| term.starts_with(name))
            || program == "WezTerm"
            || filled("KONSOLE_VERSION").is_some()
        {
            Self::Sixel
        } else {
            Self::Blocks
        }
    }

    /// The next way.
    #[must_use]
    pub fn next(self) -> Self {
        match self {
            Self::Blocks => Self::Sixel,
            Self::Sixel => Self::Kitty,
            Self::Kitty => Self::Blocks,
            // A page has no other.
            Self::Page => Self::Page,
        }
    }

    /// In words.
    pub fn name(self) -> &'static str {
        match self {
            Self::Blocks => "half blocks",
            Self::Sixel => "sixels",
            Self::Kitty => "kitty's pixels",
            Self::Page => "the page's pixels",
        }
    }
}

/// Curves in a part of the screen, where a page draws them as lines.
#[derive(Debug, Clone, PartialEq)]
pub struct PixelPlot {
    /// The cells in which they are; what goes beyond is cut off.
    pub area: Rect,
    /// The curves, each over those before it.
    pub curves: Vec<PixelCurve>,
}

/// A curve, or a row of dots.
#[derive(Debug, Clone, PartialEq)]
pub struct PixelCurve {
    /// Its colour.
    pub color: Color,
    /// Whether its points are dots, not joined.
    pub is_dotted: bool,
    /// Columns and rows of cells from the left upper corner of the plot; NaN breaks the line.
    pub points: Vec<[f32; 2]>,
}

/// Pixels for a part of the screen.
#[derive(Debug, Clone, PartialEq)]
pub struct Bitmap {
    /// The cells that it fills.
    pub area: Rect,
    /// Pixels along.
    pub width: usize,
    /// Pixels down.
    pub height: usize,
    /// Red, green, blue, opacity; row by row.
    pub rgba: Vec<u8>,
}

impl Bitmap {
    /// Pixels along and down of so many cells.
    pub(super) fn size(area: Rect, cell: (u16, u16)) -> (usize, usize) {
        let side = |cells: u16, each: u16| usize::from(cells) * usize::from(each);
        (side(area.width, cell.0), side(area.height, cell.1))
    }

    /// Every pixel by its column and row.
    pub(super) fn of(area: Rect, cell: (u16, u16), rgba: impl Fn(usize, usize) -> [u8; 4]) -> Self {
        let (width, height) = Self::size(area, cell);
        let rgba = (0..width * height).flat_map(|place| rgba(place % width, place / width));
        let rgba = rgba.collect();
        Self {
            area,
            width,
            height,
            rgba,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn pixels_are_known_by_the_terminals_name() {
        let detect = |pairs: &[(&str, &str)]| {
            Pixels::detect(|name| {
                let found = pairs.iter().find(|(key, _)| *key == name);
                found.map(|(_, value)| (*value).to_owned())
            })
        };
        assert_eq!(detect(&[("TERM", "xterm-256color")]), Pixels::Blocks);
        assert_eq!(detect(&[("TERM", "xterm-kitty")]), Pixels::Kitty);
        assert_eq!(detect(&[("TERM", "foot")]), Pixels::Sixel);
        assert_eq!(
            detect(&[("TERM", "xterm-kitty"), ("TMUX", "/tmp/tmux-0/default,1,0")]),
            Pixels::Blocks
        );
        assert_eq!(
            detect(&[("TERM", "foot"), ("NO_COLOR", "1")]),
            Pixels::Blocks
        );
    }
}
