//! What a page draws in its own pixels instead of cells: the map as a bitmap, curves as lines.

use ratatui::layout::Rect;
use ratatui::style::Color;

/// What shows the screen.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum Medium {
    /// A terminal: maps are half blocks or characters of growing ink, curves Braille dots.
    #[default]
    Terminal,
    /// A page: maps and curves have pixels of their own.
    Page,
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
