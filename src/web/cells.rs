//! The cells that changed since the last drawing, as bytes for the page.
//!
//! ```text
//! u32, little end first: n runs, bytes of text, left, top, columns, rows of the picture
//! each run:              column | row << 16, cells, ink, paper, weight
//! the text of all runs, a character a cell
//! ```
//! Ink and paper are 0xRRGGBB, or [`NONE`]: the page's own. A run is cells of one row with the same looks.

use ratatui::buffer::{Buffer, Cell};
use ratatui::layout::Rect;
use ratatui::style::{Color, Modifier};

/// No colour of its own.
const NONE: u32 = u32::MAX;

/// What changed from one buffer to the next; `picture`: the cells that it fills, or none.
pub(super) fn changed(before: &Buffer, now: &Buffer, picture: Rect) -> Vec<u8> {
    let mut runs: Vec<[u32; 5]> = Vec::new();
    let mut text = String::new();
    let mut next = None;
    for (x, y, cell) in before.diff(now) {
        let looks = looks(cell);
        match runs.last_mut() {
            Some(run) if next == Some((x, y)) && run[2..] == looks => run[1] += 1,
            _ => runs.push([place(x, y), 1, looks[0], looks[1], looks[2]]),
        }
        text.push(cell.symbol().chars().next().unwrap_or(' '));
        next = x.checked_add(1).map(|x| (x, y));
    }
    let picture = [picture.x, picture.y, picture.width, picture.height].map(u32::from);
    let head = [runs.len() as u32, text.len() as u32];
    let words = head.into_iter().chain(picture).chain(runs.concat());
    let mut bytes: Vec<u8> = words.flat_map(u32::to_le_bytes).collect();
    bytes.extend(text.as_bytes());
    bytes
}

fn place(x: u16, y: u16) -> u32 {
    u32::from(x) | u32::from(y) << 16
}

/// Ink, paper, weight: 1 bold, 2 dim, 4 italic, 8 underlined, 16 reversed.
fn looks(cell: &Cell) -> [u32; 3] {
    let weights = [
        Modifier::BOLD,
        Modifier::DIM,
        Modifier::ITALIC,
        Modifier::UNDERLINED,
        Modifier::REVERSED,
    ];
    let weight = weights.iter().enumerate();
    let weight = weight.map(|(bit, weight)| u32::from(cell.modifier.contains(*weight)) << bit);
    [colour(cell.fg), colour(cell.bg), weight.sum()]
}

fn colour(colour: Color) -> u32 {
    match colour {
        Color::Rgb(r, g, b) => u32::from_be_bytes([0, r, g, b]),
        Color::Black => 0,
        Color::White => 0xff_ffff,
        // The page asks for true colours: no other is drawn.
        _ => NONE,
    }
}
