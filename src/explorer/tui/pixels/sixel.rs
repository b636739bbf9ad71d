//! Sixel: six rows of pixels at a time, one colour after the other.
//!
//! ```text
//! ESC P 0;1 q "1;1;w;h  #n;2;r;g;b ...  { #n runs $ } - ...  ESC \        run: [!count] char, char = 63 + Σ bit·2^row
//! ```
//! (DEC STD 070, chapter 9.) Colours are parts of 100. A pixel that no colour sets stays as it is (`P2 = 1`).

use std::fmt::Write as _;

use super::Bitmap;

/// Colours at most.
const REGISTERS: usize = 256;
const ROWS: usize = 6;

/// The bytes that draw a picture where the cursor is.
pub(in crate::tui) fn encode(picture: &Bitmap) -> Vec<u8> {
    let (palette, places) = palette(picture);
    let mut text = format!("\x1bP0;1q\"1;1;{};{}", picture.width, picture.height);
    for (n, color) in palette.iter().enumerate() {
        let [r, g, b] = color.map(|c| (u32::from(c) * 100 + 127) / 255);
        // Writing to a string does not fail.
        let _ = write!(text, "#{n};2;{r};{g};{b}");
    }
    for band in 0..picture.height.div_ceil(ROWS) {
        draw_band(picture, &places, palette.len(), band * ROWS, &mut text);
        text.push('-');
    }
    text.push_str("\x1b\\");
    text.into_bytes()
}

fn draw_band(
    picture: &Bitmap,
    places: &[Option<u8>],
    colors: usize,
    top: usize,
    text: &mut String,
) {
    let width = picture.width;
    let mut masks: Vec<Vec<u8>> = vec![Vec::new(); colors];
    for row in 0..ROWS.min(picture.height - top) {
        let from = (top + row) * width;
        for (x, place) in places[from..from + width].iter().enumerate() {
            if let Some(color) = place {
                let mask = &mut masks[usize::from(*color)];
                mask.resize(width, 0);
                mask[x] |= 1 << row;
            }
        }
    }
    for (n, mask) in masks
        .iter()
        .enumerate()
        .filter(|(_, mask)| !mask.is_empty())
    {
        let _ = write!(text, "#{n}");
        for run in mask.chunk_by(|one, next| one == next) {
            let letter = char::from(63 + run[0]);
            if run.len() > 3 {
                let _ = write!(text, "!{}{letter}", run.len());
            } else {
                text.extend(std::iter::repeat_n(letter, run.len()));
            }
        }
        text.push('$');
    }
}

/// The colours, as finely told apart as the registers allow, and each pixel's; `None`: not drawn.
fn palette(picture: &Bitmap) -> (Vec<[u8; 3]>, Vec<Option<u8>>) {
    for bits in (3..=5).rev() {
        let coarse = |c: u8| c >> (8 - bits) << (8 - bits);
        let mut palette: Vec<[u8; 3]> = Vec::new();
        let mut known = vec![None; 1 << 15];
        let mut places = Vec::with_capacity(picture.width * picture.height);
        for pixel in picture.rgba.chunks_exact(4) {
            if pixel[3] == 0 {
                places.push(None);
                continue;
            }
            let key = pixel[..3]
                .iter()
                .fold(0, |key, c| key << 5 | usize::from(coarse(*c) >> 3));
            let place = *known[key].get_or_insert_with(|| {
                palette.push([pixel[0], pixel[1], pixel[2]]);
                palette.len() - 1
            });
            places.push(u8::try_from(place).ok());
        }
        if palette.len() <= REGISTERS || bits == 3 {
            palette.truncate(REGISTERS);
            return (palette, places);
        }
    }
    (Vec::new(), Vec::new())
}

#[cfg(test)]
mod tests {
    use super::*;
    use ratatui::layout::Rect;

    /// Draws what was encoded, as a terminal would.
    fn decode(bytes: &[u8], width: usize, height: usize) -> Vec<Option<usize>> {
        let text = std::str::from_utf8(bytes).expect("it is ASCII");
        let body = text.strip_prefix("\x1bP0;1q").expect("a beginning");
        let body = body.strip_suffix("\x1b\\").expect("an end");
        let mut pixels = vec![None; width * height];
        let (mut x, mut top, mut color) = (0, 0, 0);
        let mut letters = body.chars().peekable();
        let number = |letters: &mut std::iter::Peekable<std::str::Chars<'_>>| {
            let mut n = 0;
            while let Some(digit) = letters.peek().and_then(|c| c.to_digit(10)) {
                n = 10 * n + digit as usize;
                letters.next();
            }
            n
        };
        while let Some(letter) = letters.next() {
            let mut count = 1;
            let mut sixel = letter;
            match letter {
                '"' => {
                    while letters
                        .next_if(|c| c.is_ascii_digit() || *c == ';')
                        .is_some()
                    {}
                    continue;
                }
                '#' => {
                    color = number(&mut letters);
                    while letters
                        .next_if(|c| c.is_ascii_digit() || *c == ';')
                        .is_some()
                    {}
                    continue;
                }
                '$' => {
                    x = 0;
                    continue;
                }
                '-' => {
                    (x, top) = (0, top + ROWS);
                    continue;
                }
                '!' => {
                    count = number(&mut letters);
                    sixel = letters.next().expect("what is repeated");
                }
                _ => {}
            }
            let mask = sixel as usize - 63;
            for column in x..x + count {
                for row in (0..ROWS).filter(|row| mask >> row & 1 == 1) {
                    pixels[(top + row) * width + column] = Some(color);
                }
            }
            x += count;
        }
        pixels
    }

    #[test]
    fn what_is_encoded_is_the_picture() {
        let (width, height) = (23, 14);
        let mut rgba = Vec::new();
        for place in 0..width * height {
            let (x, y) = (place % width, place / width);
            let opacity = if (x + y) % 7 == 0 { 0 } else { 255 };
            rgba.extend([(x / 5 * 50) as u8, (y / 4 * 60) as u8, 90, opacity]);
        }
        let picture = Bitmap {
            area: Rect::default(),
            width,
            height,
            rgba,
        };
        let (palette, places) = palette(&picture);
        assert!(palette.len() > 10 && palette.len() <= REGISTERS);
        let decoded = decode(&encode(&picture), width, height);
        let expected: Vec<_> = places.iter().map(|place| place.map(usize::from)).collect();
        assert_eq!(decoded, expected);
        // Each pixel has the colour of its register, to the coarseness of five bits.
        for (pixel, place) in picture.rgba.chunks_exact(4).zip(&places) {
            assert_eq!(place.is_none(), pixel[3] == 0);
            if let Some(color) = place.map(|place| palette[usize::from(place)]) {
                assert!(
                    color
                        .iter()
                        .zip(pixel)
                        .all(|(one, other)| one.abs_diff(*other) < 8)
                );
            }
        }
    }

    #[test]
    fn many_colours_share_the_registers() {
        let (width, height) = (64, 64);
        let rgba = (0..width * height).flat_map(|place| {
            let (x, y) = (place % width, place / width);
            [4 * x as u8, 4 * y as u8, (2 * (x + y)) as u8, 255]
        });
        let picture = Bitmap {
            area: Rect::default(),
            width,
            height,
            rgba: rgba.collect(),
        };
        let (palette, places) = palette(&picture);
        assert!(palette.len() <= REGISTERS);
        assert!(places.iter().all(Option::is_some));
    }
}
