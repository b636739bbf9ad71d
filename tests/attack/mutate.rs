//! Damage and malice, by bytes and by structure, from a seeded generator.

/// Splitmix64 (Steele, Lea and Flood 2014).
pub(crate) struct Random(u64);

impl Random {
    pub(crate) fn new(kind: &str, number: u64) -> Self {
        let name = kind.bytes().fold(0xcbf2_9ce4_8422_2325, |hash: u64, byte| {
            (hash ^ u64::from(byte)).wrapping_mul(0x0100_0000_01b3)
        });
        Self(name.wrapping_add(number.wrapping_mul(0x9e37_79b9_7f4a_7c15)))
    }

    pub(crate) fn next(&mut self) -> u64 {
        self.0 = self.0.wrapping_add(0x9e37_79b9_7f4a_7c15);
        let mut z = self.0;
        z = (z ^ (z >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
        z ^ (z >> 31)
    }

    /// Less than `n`; 0 for none.
    pub(crate) fn below(&mut self, n: usize) -> usize {
        (self.next() % n.max(1) as u64) as usize
    }

    pub(crate) fn of<'a, T: ?Sized>(&mut self, list: &[&'a T]) -> &'a T {
        list[self.below(list.len())]
    }
}

/// Numbers and words that somebody once forgot.
const VALUES: [&str; 40] = [
    "nan",
    "inf",
    "-inf",
    "-nan",
    "0",
    "-0.0",
    "1e308",
    "-1e308",
    "1e-320",
    "1e999",
    "9223372036854775807",
    "-9223372036854775808",
    "18446744073709551616",
    "4294967296",
    "65537",
    "1000000",
    "-1",
    "0.5",
    "1e9",
    "1e-9",
    "\"\"",
    "\"../../etc/passwd\"",
    "\"/dev/zero\"",
    "\"/dev/full\"",
    "\"smooth\"",
    "\"none\"",
    "\"\\u0000\"",
    "\"\\u001b[2J\"",
    "\"\u{202e}\u{feff}x\"",
    "[]",
    "[[]]",
    "{}",
    "[1, 2, 3]",
    "{ from = 0, to = 1, n = 1000000000 }",
    "{ from = 1, to = 0, n = 3, spacing = \"log\" }",
    "true",
    "1979-05-27T07:32:00Z",
    "0x7fffffff",
    "'''x'''",
    "none",
];

const TOKENS: [&str; 16] = [
    "\0", "\u{feff}", "\r\n", "=", "[", "]", "[[", "{", "}", "\"", "'''", "#", "\\", "e", ".", ",",
];

/// Eight bytes that are no length.
const NUMBERS: [u64; 8] = [0, 1, 0xff, 0xffff, 1 << 31, 1 << 40, 1 << 62, u64::MAX];

/// Some bytes are not what they were.
pub(crate) fn bytes(random: &mut Random, seed: &[u8], other: &[u8]) -> Vec<u8> {
    let mut out = seed.to_vec();
    for _ in 0..=random.below(4) {
        if out.is_empty() {
            return out;
        }
        let at = random.below(out.len());
        let span = at..(at + 1 + random.below(64)).min(out.len());
        match random.below(9) {
            0..3 => out[at] ^= 1 << random.below(8),
            3 => out[at] = random.next() as u8,
            4 => drop(out.drain(span)),
            5 => {
                let part = out[span].to_vec();
                out.splice(at..at, part);
            }
            6 => out.truncate(at),
            7 => {
                let number = NUMBERS[random.below(NUMBERS.len())].to_le_bytes();
                let end = (at + 8).min(out.len());
                out[at..end].copy_from_slice(&number[..end - at]);
            }
            _ => {
                let from = random.below(other.len());
                let part = &other[from..(from + 64).min(other.len())];
                out.splice(at..at, part.iter().copied());
            }
        }
    }
    out
}

/// A TOML text with other values, lines that are missing, doubled or in another place, keys that do not exist.
pub(crate) fn toml(random: &mut Random, seed: &str, other: &str) -> Vec<u8> {
    let mut lines: Vec<String> = seed.lines().map(str::to_owned).collect();
    let others: Vec<&str> = other.lines().collect();
    for _ in 0..=random.below(4) {
        let at = random.below(lines.len());
        let Some(line) = lines.get(at).cloned() else {
            break;
        };
        match random.below(10) {
            0..5 => {
                if let Some((key, _)) = line.split_once('=') {
                    lines[at] = format!("{key}= {}", random.of(&VALUES));
                }
            }
            5 => drop(lines.remove(at)),
            6 => lines.insert(at, line),
            7 => lines.insert(at, random.of(&others).to_owned()),
            8 => {
                let key = line.split('=').next().unwrap_or("x").trim().to_owned();
                lines[at] = format!(
                    "{key}{} = {}",
                    random.of(&["x", ".x", " ", "\""]),
                    random.of(&VALUES)
                );
            }
            _ => {
                let mut place = random.below(line.len() + 1);
                while !line.is_char_boundary(place) {
                    place -= 1;
                }
                let (before, after) = line.split_at(place);
                lines[at] = format!("{before}{}{after}", random.of(&TOKENS));
            }
        }
    }
    lines.join("\n").into_bytes()
}

/// A JSON value with another one somewhere in it.
pub(crate) fn json(random: &mut Random, value: &mut serde_json::Value) {
    use serde_json::{Value, json};
    let inner = match value {
        Value::Array(list) if !list.is_empty() && random.below(8) > 0 => {
            let at = random.below(list.len());
            if random.below(12) == 0 {
                list.remove(at);
                return;
            }
            Some(&mut list[at])
        }
        Value::Object(map) if !map.is_empty() && random.below(12) > 0 => {
            let at = random.below(map.len());
            map.values_mut().nth(at)
        }
        _ => None,
    };
    if let Some(inner) = inner {
        json(random, inner);
        return;
    }
    let values = [
        json!(0),
        json!(-1),
        json!(1e308),
        json!(-1e308),
        json!(1e-320),
        json!(u64::MAX),
        json!(1_u64 << 40),
        json!(null),
        json!(true),
        json!(""),
        json!([]),
        json!({}),
        json!([1.0, 2.0]),
        json!(0.5),
    ];
    *value = values[random.below(values.len())].clone();
}
