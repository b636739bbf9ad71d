//! A table of results: once as Markdown for people, once as CSV for other programs.
//!
//! Markdown is eleven lines here. `comfy-table`, which the recorder brings, sets columns in line: every report would be
//! written anew by a longer cell, and it keeps bars in cells as they are.

use asperity_session::cells::csv_line;

/// Columns and rows of text.
#[derive(Debug, Clone, PartialEq, Eq, Default)]
pub struct MarkdownTable {
    /// Names of the columns.
    pub columns: Vec<String>,
    /// Rows, each as long as the columns.
    pub rows: Vec<Vec<String>>,
}

impl MarkdownTable {
    /// A table without rows.
    pub fn new(columns: &[&str]) -> Self {
        Self {
            columns: columns.iter().map(|&name| name.to_owned()).collect(),
            rows: Vec::new(),
        }
    }

    /// A row for each of `rows`: a column is its name and what it says of one.
    pub fn of<T, F: Fn(&T) -> String>(rows: &[T], columns: &[(&str, F)]) -> Self {
        let cells = |row: &T| columns.iter().map(|(_, cell)| cell(row)).collect();
        Self {
            columns: columns.iter().map(|(name, _)| (*name).to_owned()).collect(),
            rows: rows.iter().map(cells).collect(),
        }
    }

    /// As Markdown.
    pub fn markdown(&self) -> String {
        let line = |cells: Vec<String>| format!("| {} |\n", cells.join(" | "));
        let mut text = line(self.columns.clone());
        text.push_str(&"|---".repeat(self.columns.len()));
        text.push_str("|\n");
        for row in &self.rows {
            let cells = row.iter().map(|cell| cell.replace('|', "/"));
            text.push_str(&line(cells.collect()));
        }
        text
    }

    /// As CSV, the names in the first line.
    pub fn csv(&self) -> String {
        let mut text = csv_line(&self.columns);
        for row in &self.rows {
            text.push_str(&csv_line(row));
        }
        text
    }
}

/// A number in three figures, shortest form; a dash for what is not known.
pub fn figure(value: Option<f64>) -> String {
    let Some(value) = value.filter(|value| !value.is_nan()) else {
        return "-".to_owned();
    };
    let size = value.abs();
    if size == 0.0 {
        "0".to_owned()
    } else if (0.01..100.0).contains(&size) {
        format!("{value:.3}")
    } else if (100.0..1e5).contains(&size) {
        format!("{value:.0}")
    } else {
        format!("{value:.1e}")
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn cells_with_commas_and_bars_survive() {
        let table = MarkdownTable {
            columns: vec!["case".to_owned(), "says".to_owned()],
            rows: vec![vec!["a, b".to_owned(), "x | \"y\"".to_owned()]],
        };
        assert_eq!(
            table.markdown(),
            "| case | says |\n|---|---|\n| a, b | x / \"y\" |\n"
        );
        assert_eq!(table.csv(), "case,says\n\"a, b\",\"x | \"\"y\"\"\"\n");
    }
}
