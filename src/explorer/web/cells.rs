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

pub(super) fn colour(colour: Color) -> u32 {
    match colour {
        Color::Rgb(r, g, b) => u32::from_be_bytes([0, r, g, b]),
        Color::Black => 0,
        Color::White => 0xff_ffff,
        // The page asks for true colours: no other is drawn.
        _ => NONE,
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use ratatui::style::Style;

    /// Takes what changed into a grid of letters and looks, as the page does.
    fn taken(grid: &mut [(char, [u32; 3])], columns: usize, bytes: &[u8]) -> [u32; 4] {
        let word = |i: usize| u32::from_le_bytes(std::array::from_fn(|k| bytes[4 * i + k]));
        let runs = word(0) as usize;
        let text = String::from_utf8_lossy(&bytes[24 + 20 * runs..]);
        assert_eq!(text.len(), word(1) as usize);
        let mut letters = text.chars();
        for run in 0..runs {
            let at = 6 + 5 * run;
            let first = (word(at) >> 16) as usize * columns + (word(at) & 0xffff) as usize;
            for cell in &mut grid[first..first + word(at + 1) as usize] {
                let letter = letters.next().expect("a letter a cell");
                *cell = (letter, [word(at + 2), word(at + 3), word(at + 4)]);
            }
        }
        assert_eq!(letters.next(), None);
        [word(2), word(3), word(4), word(5)]
    }

    #[test]
    fn a_page_that_takes_what_changed_shows_the_screen() {
        let area = Rect::new(0, 0, 7, 3);
        let bold = Style::new()
            .fg(Color::Rgb(1, 2, 3))
            .add_modifier(Modifier::BOLD);
        let plain = Style::new().bg(Color::Rgb(0, 0, 9));
        let screens = [
            vec![(0, 0, "λ ≤ 1", bold), (0, 2, "abcdefg", plain)],
            // The same letters in other looks, one letter in the middle, all gone.
            vec![(0, 0, "λ ≤ 1", plain), (0, 2, "abcXefg", plain)],
            vec![(6, 0, "x", bold), (0, 1, "y", bold)],
            Vec::new(),
        ];
        let mut before = Buffer::empty(area);
        let mut grid = vec![(' ', [NONE, NONE, 0]); 21];
        for screen in screens {
            let mut now = Buffer::empty(area);
            for (x, y, text, style) in screen {
                now.set_string(x, y, text, style);
            }
            let picture = Rect::new(1, 1, 2, 2);
            let bytes = changed(&before, &now, picture);
            assert_eq!(taken(&mut grid, 7, &bytes), [1, 1, 2, 2]);
            let shown = now.content.iter().map(|cell| {
                let letter = cell.symbol().chars().next().unwrap_or(' ');
                (letter, looks(cell))
            });
            assert_eq!(grid, shown.collect::<Vec<_>>());
            assert_eq!(changed(&now, &now, picture).len(), 24, "nothing changed");
            before = now;
        }
    }

    #[test]
    fn looks_are_the_colours_and_weights_of_the_page() {
        let mut cell = Cell::default();
        assert_eq!(looks(&cell), [NONE, NONE, 0]);
        let weight = Modifier::BOLD | Modifier::REVERSED;
        cell.set_style(
            Style::new()
                .fg(Color::White)
                .bg(Color::Rgb(0x12, 0x34, 0x56)),
        );
        cell.set_style(Style::new().add_modifier(weight));
        assert_eq!(looks(&cell), [0xff_ffff, 0x12_3456, 17]);
    }
}
