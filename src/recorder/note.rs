//! What repeats a run, as lines of a recording's texts that are found and checked without the rest of the file.
//!
//! ```text
//! asperity note 2 <FNV-1a of the rest, hexadecimal> <its bytes> <JSON>
//! ```
//! The library's decoder believes what it reads: lengths that a damaged file claims, it asks the system for. A line
//! with a digest needs no decoder, and is as it was written or is not there.

use serde::{Deserialize, Serialize};

use asperity_engine::files::fnv;
use asperity_engine::observe::{Began, SetBy};

/// Before every line: what it is, and the version of what it may say.
const MAGIC: &str = "asperity note 2 ";
/// Digits of a digest.
const DIGITS: usize = 16;
/// Bytes that are read for digests, over those of the message. Notes do not overlap, so that whole ones need one; the rest
/// is for damaged lengths. A forged message that claims a note in every line would take for ever.
const MOST_READINGS: usize = 8;
/// Longest length in digits: no text of that length fits into a message.
const LENGTH_DIGITS: usize = 10;

/// One of those lines.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub(crate) enum Note {
    /// What the run began with.
    Origin {
        program: String,
        began: Began,
        scene_toml: String,
    },
    /// A knob that was turned.
    Turn {
        /// How many were turned before it.
        n: u64,
        steps_made: u64,
        key: String,
        value: f64,
        by: SetBy,
    },
    /// How far the file goes.
    Reach {
        last_step: u64,
        /// Knobs turned by then.
        turns: u64,
        /// The recorder has closed it: nothing came after.
        ended: bool,
    },
}

impl Note {
    /// As the recording holds it.
    pub(crate) fn to_text(&self) -> String {
        // Strings, numbers and unit variants: nothing that JSON could not hold.
        let body = serde_json::to_string(self).unwrap_or_default();
        let digest = fnv(body.as_bytes());
        format!("{MAGIC}{digest:0DIGITS$x} {} {body}", body.len())
    }

    /// Those in the bytes of a message; what does not agree with its digest is none.
    pub(crate) fn all_in(bytes: &[u8], mut take: impl FnMut(Self)) {
        let magic = MAGIC.as_bytes();
        let mut rest = bytes;
        let mut readings = MOST_READINGS * bytes.len();
        while let Some(at) = rest.windows(magic.len()).position(|part| part == magic) {
            rest = &rest[at + magic.len()..];
            if let Some(note) = Self::at_start_of(rest, &mut readings) {
                take(note);
            }
        }
    }

    fn at_start_of(bytes: &[u8], readings: &mut usize) -> Option<Self> {
        let head = bytes.get(..DIGITS)?;
        let rest = bytes.get(DIGITS..)?.strip_prefix(b" ")?;
        let digits = rest.iter().take(LENGTH_DIGITS);
        let digits = digits.take_while(|byte| byte.is_ascii_digit()).count();
        let length: usize = std::str::from_utf8(&rest[..digits]).ok()?.parse().ok()?;
        let body = rest[digits..].strip_prefix(b" ")?.get(..length)?;
        *readings = readings.checked_sub(length)?;
        let digest = format!("{:0DIGITS$x}", fnv(body));
        if head != digest.as_bytes() {
            return None;
        }
        serde_json::from_slice(body).ok()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn turn(n: u64) -> Note {
        Note::Turn {
            n,
            steps_made: 104,
            key: "motion.slide_roll".to_owned(),
            value: 0.1 + 0.2,
            by: SetBy::Hand,
        }
    }

    fn all(bytes: &[u8]) -> Vec<Note> {
        let mut found = Vec::new();
        Note::all_in(bytes, |note| found.push(note));
        found
    }

    #[test]
    fn notes_are_found_among_other_bytes_as_they_were_written() {
        let mut bytes = b"\xff\xff asperity note \x00".to_vec();
        for n in 0..3 {
            bytes.extend(turn(n).to_text().as_bytes());
        }
        bytes.extend(b"asperity note 2 0123");
        assert_eq!(all(&bytes), [turn(0), turn(1), turn(2)]);
    }

    #[test]
    fn a_note_with_any_bit_turned_is_the_same_or_none() {
        let text = turn(7).to_text().into_bytes();
        for bit in 0..8 * text.len() {
            let mut bytes = text.clone();
            bytes[bit / 8] ^= 1 << (bit % 8);
            assert_eq!(all(&bytes), [], "bit {bit}");
        }
        for length in 0..text.len() {
            assert_eq!(all(&text[..length]), [], "{length} bytes");
        }
        // Each claims megabytes of what follows: 60 GB to digest, were they believed.
        let mut claims = format!("{MAGIC}{:016x} 4000000 ", 0).repeat(100_000);
        claims.push_str(&turn(1).to_text());
        let began = std::time::Instant::now();
        assert_eq!(all(claims.as_bytes()), [turn(1)]);
        assert!(began.elapsed().as_secs() < 20, "{:?}", began.elapsed());
        // A length that no file has.
        let forged = format!("{MAGIC}{:016x} 9999999999 {{}}", 0);
        assert_eq!(all(forged.as_bytes()), []);
    }
}
