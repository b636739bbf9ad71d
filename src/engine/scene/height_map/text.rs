//! Numbers as text, one row of the map a line: one separator and one decimal mark in the whole file.
//!
//! ```text
//! a semicolon anywhere           it separates; a comma inside a cell is a decimal mark
//! white space between numbers    it separates; a comma inside a cell is a decimal mark
//! else commas                    they separate
//! ```
//! A file whose marks may as well stand between thousands (`1,234;5,678`) is refused with both readings: one of the two
//! is wrong by a factor of a thousand. Lines that begin with `#` may say unit and size ([`Header`]).

use super::header::Header;
use super::{Matrix, Refusal, SIDE, refusal, sides_allowed};
use crate::scene::error::shortened;

/// What stands between two numbers.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Separator {
    Semicolon,
    Comma,
    Tab,
    /// Any white space, as one gap.
    Space,
}

/// The decimal mark.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Mark {
    Point,
    Comma,
}

/// A way to read the file.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
struct Reading {
    separator: Separator,
    mark: Mark,
}

/// What the lines of numbers hold.
#[derive(Debug, Default)]
#[expect(clippy::struct_excessive_bools, reason = "independent observations")]
struct Signs {
    semicolon: bool,
    comma: bool,
    tab: bool,
    /// White space other than a tab between two numbers, not beside another separator.
    space: bool,
    /// A comma beside white space.
    spaced_comma: bool,
}

/// How numbers are marked.
#[derive(Debug, Default)]
struct Marks {
    /// Numbers with a decimal mark.
    marked: u64,
    /// Those of them that may be thousands: `1.234`, `12,345`.
    grouped: u64,
    /// Whole numbers other than 0.
    whole: u64,
    /// One that may be thousands, and where.
    example: Option<(String, usize, usize)>,
}

/// Reads the map, and what the file says of its unit and size.
pub(super) fn parse(bytes: &[u8]) -> Result<(Matrix, Header), Refusal> {
    let text = std::str::from_utf8(bytes).map_err(|_| refusal("not UTF-8", "numbers as text"))?;
    let (mut header, mut signs) = (Header::default(), Signs::default());
    for (number, line) in lines(text) {
        match line.strip_prefix('#') {
            Some(comment) => header.note(number, comment)?,
            None => signs.note(line),
        }
    }
    let reading = signs.reading();
    let (matrix, marks) = matrix(text, reading)?;
    if matrix.values.is_empty() {
        return Err(refusal("no numbers", "one row of the map a line"));
    }
    marks.check(reading)?;
    header.settle((marks.marked > 0).then_some(reading.mark))?;
    Ok((matrix, header))
}

/// Lines that say something, with their numbers.
fn lines(text: &str) -> impl Iterator<Item = (usize, &str)> {
    text.lines()
        .enumerate()
        .map(|(n, line)| (n + 1, line.trim_start_matches('\u{feff}').trim()))
        .filter(|(_, line)| !line.is_empty())
}

impl Signs {
    fn note(&mut self, line: &str) {
        self.semicolon |= line.contains(';');
        self.comma |= line.contains(',');
        self.tab |= line.contains('\t');
        let mut pieces = line.split([',', ';', '\t']);
        self.space |= pieces.any(|piece| piece.trim().contains(' '));
        self.spaced_comma |= [" ,", ", ", "\t,", ",\t"]
            .iter()
            .any(|pair| line.contains(pair));
    }

    /// The one way in which such a file can be read: a comma between two digits, where something else separates, is
    /// a decimal mark; one beside white space separates.
    fn reading(&self) -> Reading {
        let blank = if self.space || !self.tab {
            Separator::Space
        } else {
            Separator::Tab
        };
        let is_blank_between = self.space || self.tab;
        let (separator, mark) = match (self.semicolon, self.comma) {
            (true, true) => (Separator::Semicolon, Mark::Comma),
            (true, false) => (Separator::Semicolon, Mark::Point),
            (false, false) => (blank, Mark::Point),
            (false, true) if is_blank_between && !self.spaced_comma => (blank, Mark::Comma),
            (false, true) => (Separator::Comma, Mark::Point),
        };
        Reading { separator, mark }
    }
}

fn matrix(text: &str, reading: Reading) -> Result<(Matrix, Marks), Refusal> {
    let mut marks = Marks::default();
    let mut matrix = Matrix {
        columns: 0,
        values: Vec::new(),
    };
    let mut rows = 0;
    for (number, line) in lines(text).filter(|(_, line)| !line.starts_with('#')) {
        let before = matrix.values.len();
        for (column, cell) in reading.separator.cells(line).enumerate() {
            if column > *SIDE.end() {
                break;
            }
            let value = reading.mark.value(cell).ok_or_else(|| {
                let found = shortened(cell);
                let place = format!("{found:?} in line {number}, column {}", column + 1);
                refusal(place, instead(cell))
            })?;
            marks.note(cell, value, reading.mark, (number, column + 1));
            matrix.values.push(value);
        }
        let width = matrix.values.len() - before;
        if matrix.columns == 0 {
            matrix.columns = width;
        } else if width != matrix.columns {
            return Err(refusal(
                format!("{width} numbers in line {number}"),
                format!("{}, as in the first row", matrix.columns),
            ));
        }
        rows += 1;
        if width > *SIDE.end() {
            let found = format!("more than {} numbers in line {number}", SIDE.end());
            return Err(refusal(found, sides_allowed()));
        }
        // One too many is enough to refuse it, or to see that it is a list of points.
        if rows > *SIDE.end() {
            break;
        }
    }
    Ok((matrix, marks))
}

impl Separator {
    /// Cells of a line: white space beside a separator says nothing.
    fn cells(self, line: &str) -> Box<dyn Iterator<Item = &str> + '_> {
        match self {
            Self::Semicolon => Box::new(line.split(';').map(str::trim)),
            Self::Comma => Box::new(line.split(',').map(str::trim)),
            Self::Tab => Box::new(line.split('\t').map(str::trim)),
            // Not by other white space: a narrow blank stands between thousands.
            Self::Space => Box::new(line.split([' ', '\t']).filter(|cell| !cell.is_empty())),
        }
    }

    fn name(self) -> &'static str {
        match self {
            Self::Semicolon => "semicolons",
            Self::Comma => "commas",
            Self::Tab => "tabs",
            Self::Space => "white space",
        }
    }
}

impl Mark {
    fn sign(self) -> char {
        match self {
            Self::Point => '.',
            Self::Comma => ',',
        }
    }

    fn name(self) -> &'static str {
        match self {
            Self::Point => "point",
            Self::Comma => "comma",
        }
    }

    /// The number in a cell. A comma is a decimal mark only between two digits.
    pub(super) fn value(self, cell: &str) -> Option<f64> {
        match self {
            Self::Point => cell.parse().ok(),
            Self::Comma => {
                let (whole, part) = cell.split_once(',').unwrap_or((cell, "0"));
                let is_between =
                    whole.ends_with(is_digit) && part.starts_with(is_digit) || whole == cell;
                if cell.contains('.') || !is_between {
                    return None;
                }
                cell.replacen(',', ".", 1).parse().ok()
            }
        }
    }
}

fn is_digit(c: char) -> bool {
    c.is_ascii_digit()
}

/// What to write instead of a cell that is no number.
fn instead(cell: &str) -> &'static str {
    let count = |mark: char| cell.matches(mark).count();
    let is_number_like = cell.starts_with(|c: char| is_digit(c) || matches!(c, '+' | '-'));
    let blank = |c: char| c.is_whitespace() || matches!(c, '\'' | '\u{2019}' | '_');
    let is_grouped = count('.') > 1 || count(',') > 1 || cell.contains(blank);
    if is_number_like && count('.') > 0 && count(',') > 0 {
        "one decimal mark in the whole file, and no thousands marks, such as 1234.5"
    } else if is_number_like && is_grouped {
        "numbers without thousands marks, such as 1234.5"
    } else {
        "numbers only, such as -1.2e-7"
    }
}

/// Whether `cell` is one to three digits, the mark and three digits: thousands, or a fraction of three places.
fn is_grouped(cell: &str, mark: char) -> bool {
    let digits = cell.trim_start_matches(['+', '-']);
    digits.split_once(mark).is_some_and(|(whole, part)| {
        (1..=3).contains(&whole.len())
            && !whole.starts_with('0')
            && part.len() == 3
            && whole.chars().chain(part.chars()).all(is_digit)
    })
}

impl Marks {
    fn note(&mut self, cell: &str, value: f64, mark: Mark, (line, column): (usize, usize)) {
        if !cell.contains(mark.sign()) {
            self.whole += u64::from(value != 0.0);
            return;
        }
        self.marked += 1;
        if is_grouped(cell, mark.sign()) {
            self.grouped += 1;
            if self.example.is_none() {
                self.example = Some((cell.to_owned(), line, column));
            }
        }
    }

    /// Refuses marks that may stand between thousands everywhere. Points do where whole numbers stand beside them:
    /// programs that write three places write them everywhere.
    fn check(&self, reading: Reading) -> Result<(), Refusal> {
        let may_be_thousands = match (reading.mark, reading.separator) {
            (Mark::Comma, _) => true,
            // Who separates by commas has points for decimals.
            (Mark::Point, Separator::Comma) => false,
            (Mark::Point, Separator::Semicolon | Separator::Tab | Separator::Space) => {
                self.whole > 0
            }
        };
        let all_grouped = self.marked > 0 && self.grouped == self.marked;
        let Some((cell, line, column)) = self
            .example
            .as_ref()
            .filter(|_| may_be_thousands && all_grouped)
        else {
            return Ok(());
        };
        let sign = reading.mark.sign();
        let [decimal, thousands] = [".", ""].map(|with| cell.replace(sign, with));
        Err(refusal(
            format!(
                "{cell:?} in line {line}, column {column}: the file fits two readings, separated by {}: {decimal}, its {name} a decimal mark, and {thousands}, its {name} a thousands mark",
                reading.separator.name(),
                name = reading.mark.name()
            ),
            "numbers that can be read in one way, such as 1234.5 or 1.2345e3",
        ))
    }
}

#[cfg(test)]
mod tests {
    #![expect(clippy::unwrap_used, reason = "tests")]

    use super::*;

    fn read(text: &str) -> (usize, Vec<f64>) {
        let (matrix, _) = parse(text.as_bytes()).map_err(|r| r.found).unwrap();
        (matrix.columns, matrix.values)
    }

    fn refused(text: &str) -> String {
        match parse(text.as_bytes()) {
            Ok((matrix, _)) => format!("accepted: {matrix:?}"),
            Err(refusal) => format!("{}; allowed: {}", refusal.found, refusal.allowed),
        }
    }

    #[test]
    fn any_separator_but_one() {
        let eight = [1.0, 2.0, 3.0, 4.0, 5.0, 6.0, 7.0, 8.0];
        for text in [
            "1,2,3,4\n5,6,7,8\n",
            "# heights\n1;2;3;4\n\n5; 6;7;8",
            "1 2\t3  4\r\n5 6 7 8\r\n",
            "\u{feff}1\t2\t3\t4\n5\t6\t7\t8",
            "1,\t2, 3 ,4\n5,6,7,8",
            "1,0;2;3,00;4e0\n5;6,0;+7;80,0e-1",
            "1,0\t2,0\t3,0\t4,0\n5,0\t6,0\t7,0\t8,0",
            "1,0 2,0  3,0 4,0\n5,0 6,0 7 8",
            "1.0 2.00 3 4\n5 6 7 8",
        ] {
            assert_eq!(read(text), (4, eight.to_vec()), "{text}");
        }
        // Fractions of three places, as programs write them.
        assert_eq!(read("1.234;5.678").1, [1.234, 5.678]);
        assert_eq!(read("-0,123;5,678").1, [-0.123, 5.678]);
        assert_eq!(read("1.234,980\n1.5,2").1, [1.234, 980.0, 1.5, 2.0]);
        assert_eq!(read("0 1.500 2.250").1, [0.0, 1.5, 2.25]);
    }

    #[test]
    fn what_is_no_number_is_named_with_its_place() {
        for (text, parts) in [
            ("1,2\n3,x\n", &["\"x\" in line 2, column 2"][..]),
            ("1,2\n3\n", &["1 numbers in line 2", "2, as in the first"]),
            ("1,,2\n", &["\"\" in line 1, column 2"]),
            ("1;2;;4\n", &["\"\" in line 1, column 3"]),
            ("1\t2\t\t4\n", &["\"\" in line 1, column 3"]),
            ("1.234,5;2.345,6", &["1.234,5", "column 1", "thousands"]),
            ("1.234.567;2.5", &["1.234.567", "without thousands"]),
            ("1,234,567;2,5", &["1,234,567", "without thousands"]),
            ("1'234;5'678", &["1'234", "without thousands"]),
            ("5;1 234;6", &["1 234", "column 2", "without thousands"]),
            ("1\u{a0}234 5\u{a0}678", &["column 1", "without thousands"]),
            ("1\u{202f}234\t5", &["column 1", "without thousands"]),
            ("1.5;2,5", &["1.5"]),
            ("1;,5;2,5", &["\",5\"", "column 2"]),
            ("\"100,0\";\"120,0\"", &["100,0", "column 1"]),
            ("", &["no numbers"]),
            ("# nothing", &["no numbers"]),
        ] {
            let found = refused(text);
            for part in parts {
                assert!(found.contains(part), "{part}: {found}");
            }
        }
        assert!(parse(&[0xff, 0xfe]).is_err_and(|r| r.found.contains("UTF-8")));
    }

    #[test]
    fn what_fits_two_readings_is_refused_with_both() {
        for (text, parts) in [
            ("1,234;5,678", &["1.234,", "1234,", "semicolons"][..]),
            ("-1,234\t980\t5,678", &["-1.234,", "-1234,", "tabs"]),
            ("1,234 5,678", &["1.234,", "1234,", "white space"]),
            ("980;1.020;0", &["1.020,", "1020,", "its point", "column 2"]),
            ("12.345 980", &["12.345,", "12345,", "column 1"]),
        ] {
            let found = refused(text);
            assert!(found.contains("fits two readings"), "{found}");
            for part in parts {
                assert!(found.contains(part), "{part}: {found}");
            }
        }
    }

    #[test]
    fn what_is_too_long_is_seen_to_be() {
        let row = vec!["1"; 9000].join(",");
        assert!(refused(&row).contains("more than 8192 numbers in line 1"));
        assert_eq!(read(&"1\n".repeat(9000)).1.len(), SIDE.end() + 1);
    }
}
