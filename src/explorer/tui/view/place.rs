//! Parts of a rectangle, and words in them.

use ratatui::buffer::Buffer;
use ratatui::layout::Rect;
use ratatui::text::{Line, Span};

use crate::tui::theme::{Role, Theme};

/// So many rows of an area from one on, as far as it goes.
pub(super) fn rows(area: Rect, from: u16, count: u16) -> Rect {
    let from = from.min(area.height);
    Rect {
        y: area.y + from,
        height: count.min(area.height - from),
        ..area
    }
}

/// All rows of an area from one on.
pub(super) fn rows_from(area: Rect, from: u16) -> Rect {
    rows(area, from, area.height)
}

/// So many columns of an area from one on, as far as it goes.
pub(super) fn columns(area: Rect, from: u16, count: u16) -> Rect {
    let from = from.min(area.width);
    Rect {
        x: area.x + from,
        width: count.min(area.width - from),
        ..area
    }
}

/// All columns of an area from one on.
pub(super) fn columns_from(area: Rect, from: u16) -> Rect {
    columns(area, from, area.width)
}

/// Rows handed out from above.
pub(super) struct RowAllotment {
    pub(super) rest: Rect,
}

impl RowAllotment {
    pub(super) fn take(&mut self, count: u16) -> Rect {
        let taken = rows(self.rest, 0, count);
        self.rest = rows_from(self.rest, count);
        taken
    }
}

/// Writes a line at a row of an area, if the row is there.
pub(super) fn put(area: Rect, row: u16, line: &Line<'_>, buffer: &mut Buffer) {
    if row < area.height {
        buffer.set_line(area.x, area.y + row, line, area.width);
    }
}

/// Writes a line against the right edge of a row.
pub(super) fn put_right(area: Rect, row: u16, line: &Line<'_>, buffer: &mut Buffer) {
    let width = (line.width() as u16).min(area.width);
    put(columns_from(area, area.width - width), row, line, buffer);
}

/// Writes a line in the middle of a row.
pub(super) fn put_middle(area: Rect, row: u16, line: &Line<'_>, buffer: &mut Buffer) {
    let start = area.width.saturating_sub(line.width() as u16) / 2;
    put(columns_from(area, start), row, line, buffer);
}

/// A row of a table: a name, and its value at the right.
pub(super) struct Entry {
    name: &'static str,
    value: String,
    /// Of the value.
    role: Role,
}

impl Entry {
    pub(super) fn new(name: &'static str, value: String, role: Role) -> Self {
        Self { name, value, role }
    }
}

/// Writes a table; where a whole name would run into its value, its first word is enough.
pub(super) fn table(theme: Theme, area: Rect, entries: &[Entry], buffer: &mut Buffer) {
    for (row, Entry { name, value, role }) in (0..).zip(entries) {
        let value = theme.line(value, *role);
        let room = usize::from(area.width).saturating_sub(value.width() + 1);
        let first = name.split(' ').next().unwrap_or(name);
        let name = fitting([*name, first], room).unwrap_or(first);
        put(area, row, &theme.line(name, Role::Dim), buffer);
        put_right(area, row, &value, buffer);
    }
}

/// The first of several forms of the same words that fits into so many columns.
pub(super) fn fitting<'a>(
    forms: impl IntoIterator<Item = &'a str>,
    columns: usize,
) -> Option<&'a str> {
    let mut forms = forms.into_iter();
    forms.find(|words| words.chars().count() <= columns)
}

/// As many parts of a line as fit whole, one after the other.
pub(super) fn fitted(
    parts: impl IntoIterator<Item = Span<'static>>,
    columns: u16,
) -> Line<'static> {
    let mut free = usize::from(columns);
    let fits = |part: &Span<'_>| {
        let fits = part.width() <= free;
        free = free.saturating_sub(part.width());
        fits
    };
    parts.into_iter().take_while(fits).collect()
}

/// As many whole words as fit, and a sign that there are more.
pub(super) fn whole_words(text: &str, columns: usize) -> String {
    if text.chars().count() <= columns {
        return text.to_owned();
    }
    let mut kept = String::new();
    for word in text.split_inclusive(' ') {
        // Three columns for the dots where there are no others.
        if kept.chars().count() + word.trim_end().chars().count() + 3 > columns {
            break;
        }
        kept.push_str(word);
    }
    match kept.trim_end_matches([' ', ',', ':']) {
        "" => String::new(),
        kept => format!("{kept}…"),
    }
}

/// A line in rows of so many columns, broken between words; what goes on keeps the indentation, and two columns more.
pub(super) fn folded(line: &Line<'static>, columns: usize) -> Vec<Line<'static>> {
    let letters: Vec<_> = line.styled_graphemes(line.style).collect();
    let is_space = |k: usize| letters.get(k).is_some_and(|letter| letter.symbol == " ");
    let indent = (0..letters.len()).take_while(|k| is_space(*k)).count();
    let (mut rows, mut from, mut before) = (Vec::new(), 0, 0);
    while from < letters.len() {
        let most = (from + columns.saturating_sub(before).max(1)).min(letters.len());
        let is_end = |k: &usize| *k == letters.len() || is_space(*k);
        let to = (from + 1..=most).rev().find(is_end).unwrap_or(most);
        let mut row = Line::raw(" ".repeat(before));
        let letters = letters[from..to].iter();
        row.extend(letters.map(|letter| Span::styled(letter.symbol.to_owned(), letter.style)));
        rows.push(row);
        from = to;
        while is_space(from) {
            from += 1;
        }
        before = indent + 2;
    }
    if rows.is_empty() {
        rows.push(Line::default());
    }
    rows
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn titles_are_cut_between_words() {
        let title = "Two rough rollers, sliding";
        let table = [
            (26, title),
            (25, "Two rough rollers…"),
            (14, "Two rough…"),
            (6, "Two…"),
            (4, ""),
        ];
        for (room, cut) in table {
            assert_eq!(whole_words(title, room), cut, "{room}");
        }
    }

    #[test]
    fn long_lines_go_on_two_columns_further_in() {
        let line = Line::raw("  film: too thin for it");
        let rows = folded(&line, 14);
        let rows: Vec<String> = rows.iter().map(Line::to_string).collect();
        assert_eq!(rows, ["  film: too", "    thin for", "    it"]);
        assert_eq!(folded(&Line::default(), 14).len(), 1);
    }
}
