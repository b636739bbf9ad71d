//! Large figures, three columns by three rows of half blocks each.
//!
//! The crate `tui-big-text` was measured in its place: ten new crates, 24 CPU seconds, for 60 lines; its figures are eight
//! pixels wide, so "0.0123" takes 48 columns in half blocks for the 21 here, more than the panel at 80 × 24 has.

use ratatui::buffer::Buffer;
use ratatui::layout::Rect;
use ratatui::style::Style;

/// Rows that large figures take.
pub(super) const ROWS: u16 = 3;

/// Three by five pixels, rows from above, bit 2 is left. What has no picture is left blank.
fn picture(letter: char) -> (u16, [u8; 5]) {
    match letter {
        '0' => (3, [7, 5, 5, 5, 7]),
        '1' => (3, [2, 6, 2, 2, 7]),
        '2' => (3, [7, 1, 7, 4, 7]),
        '3' => (3, [7, 1, 3, 1, 7]),
        '4' => (3, [5, 5, 7, 1, 1]),
        '5' => (3, [7, 4, 7, 1, 7]),
        '6' => (3, [7, 4, 7, 5, 7]),
        '7' => (3, [7, 1, 1, 2, 2]),
        '8' => (3, [7, 5, 7, 5, 7]),
        '9' => (3, [7, 5, 7, 1, 7]),
        'e' => (3, [0, 7, 7, 4, 7]),
        '-' => (3, [0, 0, 7, 0, 0]),
        '.' => (1, [0, 0, 0, 0, 4]),
        _ => (1, [0; 5]),
    }
}

/// Columns that a text takes.
pub(super) fn width(text: &str) -> u16 {
    let columns: u16 = text.chars().map(|letter| picture(letter).0 + 1).sum();
    columns.saturating_sub(1)
}

/// Draws figures from the left of an area.
pub(super) fn render(text: &str, area: Rect, style: Style, buffer: &mut Buffer) {
    let mut x = area.x;
    for letter in text.chars() {
        let (columns, rows) = picture(letter);
        for column in 0..columns {
            for half in 0..ROWS {
                let bit = |row: usize| {
                    rows.get(row)
                        .is_some_and(|bits| bits >> (2 - column) & 1 == 1)
                };
                let (upper, lower) = (bit(2 * half as usize), bit(2 * half as usize + 1));
                let symbol = match (upper, lower) {
                    (true, true) => "█",
                    (true, false) => "▀",
                    (false, true) => "▄",
                    (false, false) => continue,
                };
                let at = (x + column, area.y + half);
                if area.contains(at.into())
                    && let Some(cell) = buffer.cell_mut(at)
                {
                    cell.set_symbol(symbol).set_style(style);
                }
            }
        }
        x += columns + 1;
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn figures_are_readable() {
        let area = Rect::new(0, 0, width("0.25"), ROWS);
        let mut buffer = Buffer::empty(area);
        render("0.25", area, Style::new(), &mut buffer);
        insta::assert_snapshot!(
            (0..ROWS)
                .map(|y| (0..area.width).map(|x| buffer[(x, y)].symbol()).collect::<String>())
                .collect::<Vec<_>>()
                .join("\n"),
            @r"
        █▀█   ▀▀█ █▀▀
        █ █   █▀▀ ▀▀█
        ▀▀▀ ▀ ▀▀▀ ▀▀▀
        "
        );
    }
}
