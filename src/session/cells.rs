//! One row of a table of comma-separated values: how a number is written, and where the cells lie.
//!
//! Numbers are written in the fewest digits that read back to the same bits, with an exponent where that is
//! shorter to read; what is not known is an empty cell. The table of a run and that of a sweep are both made
//! of these rows.

use std::fmt::Write as _;

use asperity_engine::sim::Reading;

/// Cells one after another in one buffer, which is used again for the next row.
#[derive(Debug, Default)]
pub struct Cells {
    text: String,
    ends: Vec<usize>,
}

impl Cells {
    /// Begins the next row.
    pub fn clear(&mut self) {
        self.text.clear();
        self.ends.clear();
    }

    /// A cell as it stands.
    pub fn text(&mut self, value: impl std::fmt::Display) {
        // Writing to a string cannot fail.
        let _ = write!(self.text, "{value}");
        self.ends.push(self.text.len());
    }

    /// A number; one that is none (NaN, infinite) is an empty cell.
    pub fn number(&mut self, value: f64) {
        if value.is_finite() {
            let written = if value == 0.0 || (1e-3..1e15).contains(&value.abs()) {
                write!(self.text, "{value}")
            } else {
                write!(self.text, "{value:e}")
            };
            // Writing to a string cannot fail.
            let _ = written;
        }
        self.ends.push(self.text.len());
    }

    /// A number that may not be known.
    pub fn optional(&mut self, value: Option<f64>) {
        self.number(value.unwrap_or(f64::NAN));
    }

    /// What was read of a quantity.
    pub fn reading(&mut self, reading: Reading) {
        match reading {
            Reading::Unknown => self.optional(None),
            Reading::Number(value) => self.number(value),
            Reading::Word(word) => self.text(word),
        }
    }

    /// The cells from left to right.
    pub fn iter(&self) -> impl Iterator<Item = &str> {
        let starts = std::iter::once(0).chain(self.ends.iter().copied());
        starts
            .zip(&self.ends)
            .map(|(start, &end)| &self.text[start..end])
    }
}

/// Cells as a line of a table, quoted where they need it.
pub fn csv_line(cells: impl IntoIterator<Item = impl AsRef<[u8]>>) -> String {
    let builder = &mut csv::WriterBuilder::new();
    let mut writer = builder.buffer_capacity(512).from_writer(Vec::new());
    // Text into memory: this cannot fail.
    drop(writer.write_record(cells));
    let bytes = writer.into_inner().ok().unwrap_or_default();
    String::from_utf8(bytes).unwrap_or_default()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers_read_back_to_the_same_bits_and_are_short() {
        let mut cells = Cells::default();
        let values = [
            0.0,
            -0.25,
            1.0 / 3.0,
            1.625e-7,
            1e-3,
            9.9e-4,
            1.7e9,
            1e15,
            -2.5e300,
            f64::MIN_POSITIVE,
        ];
        for value in values {
            cells.number(value);
        }
        let written: Vec<&str> = cells.iter().collect();
        for (text, value) in written.iter().zip(values) {
            assert_eq!(text.parse(), Ok(value));
        }
        assert_eq!(
            written[..6],
            [
                "0",
                "-0.25",
                "0.3333333333333333",
                "1.625e-7",
                "0.001",
                "9.9e-4"
            ]
        );
        assert_eq!(written[6..9], ["1700000000", "1e15", "-2.5e300"]);
    }

    #[test]
    fn what_is_not_known_is_an_empty_cell() {
        let mut cells = Cells::default();
        cells.text("gone");
        cells.clear();
        cells.optional(None);
        cells.number(f64::INFINITY);
        cells.text("warm");
        cells.reading(Reading::Unknown);
        cells.reading(None::<f64>.into());
        cells.optional(Some(2.0));
        assert_eq!(
            cells.iter().collect::<Vec<_>>(),
            ["", "", "warm", "", "", "2"]
        );
    }
}
