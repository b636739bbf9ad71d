//! What a text map says of itself in lines that begin with `#`: `Value units: m`, `Width: 100 µm`, `Height: 80 µm`, as
//! Gwyddion's export of text writes them (its module `asciiexport`; the sides are those of the whole map).

use super::text::Mark;
use super::{Refusal, refusal};
use crate::scene::error::shortened;

/// A statement of the file.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Said {
    /// The unit in m, or the length, m.
    pub(super) value_m: f64,
    /// How far a length may be off by its last digit, over itself.
    pub(super) slack: f64,
    /// As written, with its place.
    pub(super) words: String,
}

/// A length that is not read yet: whether a comma in it is a decimal mark, the numbers below it show.
#[derive(Debug, Clone, PartialEq)]
struct Raw {
    line: usize,
    words: String,
}

/// What the file says.
#[derive(Debug, Clone, Default, PartialEq)]
pub(super) struct Header {
    /// Height that a value of 1 stands for.
    pub(super) unit: Option<Said>,
    /// Side along x.
    pub(super) width: Option<Said>,
    /// Side along y.
    pub(super) height: Option<Said>,
    raw: [Option<Raw>; 2],
}

/// Sides by name.
const SIDES: [&str; 2] = ["width", "height"];

/// How far the two sides of a pixel may differ in a file of an instrument, over themselves.
const UNSQUARE: f64 = 1e-3;

impl Header {
    /// What a file of an instrument says: the unit in m, and the sides of a pixel along x and y, m, of a map of
    /// `sides` columns and rows, each with its words.
    pub(super) fn of_instrument(
        unit: (f64, String),
        pixel: [(f64, String); 2],
        sides: [usize; 2],
    ) -> Self {
        let said = |(value_m, words), slack| Said {
            value_m,
            slack,
            words,
        };
        let [x, y] = pixel;
        let side =
            |(pixel_m, words), n: usize| Some(said((pixel_m * n as f64, words), UNSQUARE / 2.0));
        Self {
            unit: Some(said(unit, 0.0)),
            width: side(x, sides[0]),
            height: side(y, sides[1]),
            ..Self::default()
        }
    }

    /// Takes note of a comment.
    pub(super) fn note(&mut self, line: usize, comment: &str) -> Result<(), Refusal> {
        let comment = comment.trim_start_matches('#').trim();
        let Some((name, value)) = comment.split_once([':', '=']) else {
            return Ok(());
        };
        let (name, value) = (name.trim().to_lowercase(), value.trim());
        if value.is_empty() {
            return Ok(());
        }
        let words = shortened(comment);
        if matches!(
            name.as_str(),
            "value units" | "value unit" | "z units" | "z unit"
        ) {
            let value_m = unit(value).ok_or_else(|| {
                refusal(
                    format!("{words:?} in line {line}"),
                    format!("a unit of length: {UNITS}"),
                )
            })?;
            let said = Said {
                value_m,
                slack: 0.0,
                words: format!("{words:?} in line {line}"),
            };
            return put(&mut self.unit, said);
        }
        if let Some(side) = SIDES.iter().position(|side| *side == name) {
            let raw = Raw {
                line,
                words: value.to_owned(),
            };
            if self.raw[side]
                .as_ref()
                .is_some_and(|first| first.words != raw.words)
            {
                return Err(twice(&format!("{words:?} in line {line}")));
            }
            self.raw[side] = Some(raw);
        }
        Ok(())
    }

    /// Reads the lengths, with the decimal mark of the numbers; `None`: they have none.
    pub(super) fn settle(&mut self, mark: Option<Mark>) -> Result<(), Refusal> {
        let sides = [&mut self.width, &mut self.height];
        for ((raw, name), said) in self.raw.iter().zip(SIDES).zip(sides) {
            if let Some(raw) = raw {
                *said = Some(raw.length(name, mark)?);
            }
        }
        Ok(())
    }
}

/// A second statement must be the first one again.
fn put(place: &mut Option<Said>, said: Said) -> Result<(), Refusal> {
    if place
        .as_ref()
        .is_some_and(|first| first.value_m != said.value_m)
    {
        return Err(twice(&said.words));
    }
    *place = Some(said);
    Ok(())
}

fn twice(words: &str) -> Refusal {
    refusal(
        words,
        "one statement, or the same again: the file has another one above",
    )
}

impl Raw {
    fn length(&self, name: &str, mark: Option<Mark>) -> Result<Said, Refusal> {
        let is_of_number = |c: char| c.is_ascii_digit() || matches!(c, '.' | ',' | '+' | '-');
        let words = format!(
            "\"{name}: {}\" in line {}",
            shortened(&self.words),
            self.line
        );
        let end = self
            .words
            .find(|c| !is_of_number(c))
            .unwrap_or(self.words.len());
        let (number, rest) = self.words.split_at(end);
        // 1e-4 m: an exponent is no unit.
        let exponent = rest.strip_prefix(['e', 'E']).map_or(0, |tail| {
            tail.find(|c| !is_of_number(c)).unwrap_or(tail.len()) + 1
        });
        let (exponent, rest) = rest.split_at(exponent);
        let mark = match mark {
            Some(Mark::Comma) if number.contains(',') => Mark::Comma,
            Some(Mark::Comma | Mark::Point) | None => Mark::Point,
        };
        let value = mark.value(&format!("{number}{exponent}"));
        let length = value
            .zip(unit(rest.trim()))
            .filter(|(v, _)| *v > 0.0 && v.is_finite());
        let Some((value, unit_m)) = length else {
            return Err(refusal(
                words,
                format!(
                    "a length above 0 and its unit ({UNITS}), with the decimal mark of the numbers, such as 100.5 µm"
                ),
            ));
        };
        let digits = number
            .split_once(['.', ','])
            .map_or(0, |(_, part)| part.len());
        let half_digit = 0.5 * 10_f64.powi(-(digits.min(20) as i32)) / value;
        // "1 µm" may be short for 1.00.
        let slack = if exponent.is_empty() {
            half_digit.min(0.01)
        } else {
            0.0
        };
        Ok(Said {
            value_m: value * unit_m,
            slack: slack + 1e-6,
            words,
        })
    }
}

/// Names of units, for messages.
pub(super) const UNITS: &str = "m, cm, mm, µm, nm, pm, Å";

/// A unit of length in m.
pub(super) fn unit(name: &str) -> Option<f64> {
    Some(match name {
        "m" | "meter" | "metre" => 1.0,
        "cm" => 1e-2,
        "mm" => 1e-3,
        // The micro sign, the Greek letter, and what stands for them.
        "\u{b5}m" | "\u{3bc}m" | "um" | "micron" | "microns" => 1e-6,
        "nm" => 1e-9,
        "pm" => 1e-12,
        "\u{c5}" | "\u{212b}" | "A\u{30a}" | "Angstrom" | "angstrom" => 1e-10,
        _ => return None,
    })
}

#[cfg(test)]
mod tests {
    #![expect(clippy::unwrap_used, reason = "tests")]

    use super::*;

    fn header(comments: &[&str], mark: Option<Mark>) -> Result<Header, String> {
        let mut header = Header::default();
        for (n, comment) in comments.iter().enumerate() {
            header.note(n + 1, comment).map_err(|r| r.found)?;
        }
        header.settle(mark).map_err(|r| r.found)?;
        Ok(header)
    }

    #[test]
    fn statements_are_read() {
        for (width, mark, length_m, slack) in [
            ("Width: 100 µm", None, 1e-4, 0.005),
            ("width = 99.90 um", Some(Mark::Point), 9.99e-5, 0.005 / 99.9),
            ("Width: 5,000 \u{3bc}m", Some(Mark::Comma), 5e-6, 1e-4),
            ("Width: 0.1 mm", Some(Mark::Comma), 1e-4, 0.01),
            ("Width: 1e-4 m", None, 1e-4, 0.0),
            ("Width: 1 µm", None, 1e-6, 0.01),
            ("Width: 850nm", None, 8.5e-7, 0.5 / 850.0),
        ] {
            let said = header(&[width], mark).unwrap().width.unwrap();
            assert!((said.value_m / length_m - 1.0).abs() < 1e-12, "{width}");
            assert!(
                (said.slack - slack - 1e-6).abs() < 1e-9,
                "{width}: {}",
                said.slack
            );
        }
        for (unit, unit_m) in [("m", 1.0), ("nm", 1e-9), ("µm", 1e-6), ("Å", 1e-10)] {
            let said = header(&[&format!(" Value units: {unit}")], None).unwrap();
            assert_eq!(said.unit.unwrap().value_m, unit_m);
        }
        let silent = [
            "",
            "heights",
            "Channel: Topography",
            "Value units:",
            "d = 175 nm",
        ];
        assert_eq!(header(&silent, None).unwrap(), Header::default());
    }

    #[test]
    fn statements_that_cannot_be_read_are_refused() {
        for (comments, part) in [
            (&["Value units: V"][..], "Value units: V\" in line 1"),
            (&["Value units: nm", "Value units: m"], "in line 2"),
            (&["Width: 1 µm", "Width: 2 µm"], "in line 2"),
            (&["Width: 64"], "width: 64"),
            (&["Width: 5,000 µm"], "5,000 µm"),
            (&["Width: -5 µm"], "-5 µm"),
            (&["Width: 0 µm"], "0 µm"),
            (&["Width: 1e999 m"], "1e999"),
            (&["Height: tall"], "height: tall"),
            (&["Width: 100 px"], "100 px"),
        ] {
            let found = header(comments, None).unwrap_err();
            assert!(found.contains(part), "{part}: {found}");
        }
    }
}
