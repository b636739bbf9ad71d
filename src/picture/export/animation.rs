//! Pictures one after another: GIF (89a) and animated PNG.
//!
//! A GIF has 255 colours for all its pictures, those that are seen most, and one that lets the picture before show through;
//! of each picture only the part that differs is written, packed by LZW (Welch 1984).

use std::path::Path;

/// Most pictures that are kept; when there are more every other one goes.
const MOST: usize = 120;
/// How long a passage is shown, s, and a picture at least and at most.
const PASSAGE_S: f64 = 10.0;
const SHOWN_S: [f64; 2] = [0.04, 0.2];

/// Pictures of one size, three bytes a pixel.
#[derive(Debug, Default)]
pub(super) struct Animation {
    size: (u32, u32),
    pictures: Vec<Vec<u8>>,
    /// Pictures that came, and how many make one that is kept.
    came: usize,
    every: usize,
    /// Where the first and the last are, passages.
    passages: [f64; 2],
}

impl Animation {
    /// Whether the next picture is kept; one that is not need not be drawn.
    pub(super) fn wants(&mut self, passages: f64) -> bool {
        if self.came == 0 {
            (self.every, self.passages[0]) = (1, passages);
        }
        self.passages[1] = passages;
        let wants = self.came.is_multiple_of(self.every);
        self.came += 1;
        wants
    }

    /// Takes a picture up.
    pub(super) fn push(&mut self, size: (u32, u32), picture: Vec<u8>) {
        self.size = size;
        self.pictures.push(picture);
        if self.pictures.len() > MOST {
            let mut keep = false;
            self.pictures.retain(|_| {
                keep = !keep;
                keep
            });
            self.every *= 2;
        }
    }

    /// How long a picture is shown, hundredths of a second.
    fn delay(&self) -> u16 {
        let shown =
            PASSAGE_S * (self.passages[1] - self.passages[0]) / self.pictures.len().max(1) as f64;
        let [least, most] = SHOWN_S;
        (100.0 * shown.clamp(least, most)).round() as u16
    }

    /// As GIF.
    pub(super) fn gif(&self) -> Vec<u8> {
        let (wide, tall) = self.size;
        let palette = GifPalette::of(&self.pictures);
        let mut out = b"GIF89a".to_vec();
        let short = |value: u32| (value as u16).to_le_bytes();
        out.extend(short(wide));
        out.extend(short(tall));
        // A table of 256 colours for all pictures.
        out.extend([0xf7, 0, 0]);
        out.extend(palette.colours.iter().flatten());
        // For ever.
        out.extend(b"\x21\xff\x0bNETSCAPE2.0\x03\x01\0\0\0");
        let mut before: Vec<u8> = Vec::new();
        for picture in &self.pictures {
            let now = palette.indices(picture);
            let ChangedArea { left, top, w, h } =
                ChangedArea::that_differs(&before, &now, wide as usize);
            out.extend([0x21, 0xf9, 4, 5]);
            out.extend(self.delay().to_le_bytes());
            out.extend([TRANSPARENT, 0, 0x2c]);
            for value in [left, top, w, h] {
                out.extend(short(value as u32));
            }
            out.extend([0, 8]);
            let rows =
                (top..top + h).flat_map(|y| (left..left + w).map(move |x| y * wide as usize + x));
            let pixels = rows.map(|at| {
                let same = before.get(at) == Some(&now[at]);
                if same { TRANSPARENT } else { now[at] }
            });
            for block in packed(pixels).chunks(255) {
                out.push(block.len() as u8);
                out.extend_from_slice(block);
            }
            out.push(0);
            before = now;
        }
        out.push(0x3b);
        out
    }

    /// As animated PNG.
    ///
    /// # Errors
    /// In words.
    pub(super) fn apng(&self) -> Result<Vec<u8>, String> {
        let mut bytes = Vec::new();
        let words = |error: png::EncodingError| error.to_string();
        let mut encoder = png::Encoder::new(&mut bytes, self.size.0, self.size.1);
        encoder.set_color(png::ColorType::Rgb);
        encoder.set_depth(png::BitDepth::Eight);
        encoder
            .set_animated(self.pictures.len() as u32, 0)
            .map_err(words)?;
        encoder.set_frame_delay(self.delay(), 100).map_err(words)?;
        let mut writer = encoder.write_header().map_err(words)?;
        for picture in &self.pictures {
            writer.write_image_data(picture).map_err(words)?;
        }
        writer.finish().map_err(words)?;
        Ok(bytes)
    }

    /// Writes it; the name says as what.
    ///
    /// # Errors
    /// What the disk or the encoder says.
    pub(super) fn write(&self, path: &Path) -> std::io::Result<()> {
        let is_gif = path.extension().is_some_and(|ending| ending == "gif");
        let bytes = if is_gif {
            self.gif()
        } else {
            self.apng().map_err(std::io::Error::other)?
        };
        std::fs::write(path, bytes)
    }
}

/// Lets the picture before show through.
const TRANSPARENT: u8 = 255;

/// A rectangle of a picture.
struct ChangedArea {
    left: usize,
    top: usize,
    w: usize,
    h: usize,
}

impl ChangedArea {
    /// The least one that holds all that differs, of one pixel at least.
    fn that_differs(before: &[u8], now: &[u8], wide: usize) -> Self {
        let (mut x, mut y) = ([usize::MAX, 0], [usize::MAX, 0]);
        for (at, value) in now.iter().enumerate() {
            if before.get(at) != Some(value) {
                let (i, j) = (at % wide, at / wide);
                (x, y) = ([x[0].min(i), x[1].max(i)], [y[0].min(j), y[1].max(j)]);
            }
        }
        if x[0] == usize::MAX {
            (x, y) = ([0, 0], [0, 0]);
        }
        Self {
            left: x[0],
            top: y[0],
            w: x[1] - x[0] + 1,
            h: y[1] - y[0] + 1,
        }
    }
}

/// Colours that stand for all.
struct GifPalette {
    colours: [[u8; 3]; 256],
    /// Of every colour at five bits: which stands for it.
    of: Vec<u8>,
}

impl GifPalette {
    fn of(pictures: &[Vec<u8>]) -> Self {
        let mut seen = vec![(0_u64, [0_u64; 3]); 1 << 15];
        for pixel in pictures.iter().flat_map(|picture| picture.chunks_exact(3)) {
            let (count, sums) = &mut seen[coarse(pixel)];
            *count += 1;
            for (sum, &value) in sums.iter_mut().zip(pixel) {
                *sum += u64::from(value);
            }
        }
        let mut order: Vec<usize> = (0..seen.len()).filter(|&at| seen[at].0 > 0).collect();
        order.sort_by_key(|&at| std::cmp::Reverse(seen[at].0));
        let mean = |at: usize| seen[at].1.map(|sum| (sum / seen[at].0.max(1)) as u8);
        let mut colours = [[0; 3]; 256];
        let kept = order.len().min(usize::from(TRANSPARENT));
        for (colour, &at) in colours.iter_mut().zip(&order[..kept]) {
            *colour = mean(at);
        }
        let mut of = vec![0; seen.len()];
        for at in order {
            let own = mean(at);
            let off = |colour: &[u8; 3]| -> i32 {
                let parts = colour.iter().zip(own);
                parts
                    .map(|(&one, two)| (i32::from(one) - i32::from(two)).pow(2))
                    .sum()
            };
            let nearest = (0..kept).min_by_key(|&k| off(&colours[k]));
            of[at] = nearest.unwrap_or(0) as u8;
        }
        Self { colours, of }
    }

    fn indices(&self, picture: &[u8]) -> Vec<u8> {
        picture
            .chunks_exact(3)
            .map(|pixel| self.of[coarse(pixel)])
            .collect()
    }
}

/// A colour at five bits.
fn coarse(pixel: &[u8]) -> usize {
    pixel
        .iter()
        .fold(0, |all, &value| all << 5 | usize::from(value >> 3))
}

/// LZW with codes of 9 to 12 bits.
fn packed(pixels: impl Iterator<Item = u8>) -> Vec<u8> {
    const CLEAR: u16 = 256;
    const FIRST: u16 = 258;
    const NONE: u16 = 0;
    let mut bits = Bits::default();
    // What follows a code with a pixel behind it.
    let mut next = vec![NONE; 4096 << 8];
    let (mut free, mut size) = (FIRST, 9);
    bits.push(CLEAR, size);
    let mut before: Option<u16> = None;
    for pixel in pixels {
        let Some(code) = before else {
            before = Some(pixel.into());
            continue;
        };
        let at = usize::from(code) << 8 | usize::from(pixel);
        if next[at] != NONE {
            before = Some(next[at]);
            continue;
        }
        bits.push(code, size);
        before = Some(pixel.into());
        if free < 4096 {
            next[at] = free;
            if free == 1 << size {
                size += 1;
            }
            free += 1;
        } else {
            bits.push(CLEAR, size);
            next.fill(NONE);
            (free, size) = (FIRST, 9);
        }
    }
    if let Some(code) = before {
        bits.push(code, size);
    }
    // The reader has added one more by then.
    if free == 1 << size && size < 12 {
        size += 1;
    }
    bits.push(CLEAR + 1, size);
    bits.end()
}

/// Codes as bytes, the lowest bit first.
#[derive(Default)]
struct Bits {
    bytes: Vec<u8>,
    held: u32,
    count: u32,
}

impl Bits {
    fn push(&mut self, code: u16, size: u32) {
        self.held |= u32::from(code) << self.count;
        self.count += size;
        while self.count >= 8 {
            self.bytes.push(self.held as u8);
            self.held >>= 8;
            self.count -= 8;
        }
    }

    fn end(mut self) -> Vec<u8> {
        if self.count > 0 {
            self.bytes.push(self.held as u8);
        }
        self.bytes
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// What a reader makes of the codes.
    fn unpacked(bytes: &[u8]) -> Vec<u8> {
        let (mut held, mut count, mut size) = (0_u32, 0, 9);
        let mut bytes = bytes.iter();
        let mut table: Vec<Vec<u8>> = Vec::new();
        let (mut out, mut before): (Vec<u8>, Option<Vec<u8>>) = (Vec::new(), None);
        loop {
            while count < size {
                held |= u32::from(*bytes.next().expect("an end")) << count;
                count += 8;
            }
            let code = (held & ((1 << size) - 1)) as usize;
            (held, count) = (held >> size, count - size);
            if code == 257 {
                return out;
            }
            if code == 256 {
                table = (0..258).map(|value| vec![value as u8]).collect();
                (size, before) = (9, None);
                continue;
            }
            let known = table.get(code).cloned();
            let text = known.or_else(|| {
                before.clone().map(|mut text| {
                    text.push(text[0]);
                    text
                })
            });
            let text = text.expect("a code");
            if let Some(mut own) = before.take().filter(|_| table.len() < 4096) {
                own.push(text[0]);
                table.push(own);
                if table.len() == 1 << size && size < 12 {
                    size += 1;
                }
            }
            out.extend(&text);
            before = Some(text);
        }
    }

    #[test]
    fn pixels_come_back() {
        for n in [1, 2, 300, 5_000, 100_000] {
            let mut state = 1_u32;
            let pixels: Vec<u8> = (0..n)
                .map(|k| {
                    state = state.wrapping_mul(1_664_525).wrapping_add(1_013_904_223);
                    if k % 7 < 4 { 3 } else { (state >> 24) as u8 }
                })
                .collect();
            assert_eq!(unpacked(&packed(pixels.iter().copied())), pixels, "{n}");
        }
    }

    #[test]
    fn long_animations_keep_every_other_picture() {
        let mut animation = Animation::default();
        for k in 0..500 {
            if animation.wants(f64::from(k) / 100.0) {
                animation.push((1, 1), vec![k as u8, 0, 0]);
            }
        }
        let kept: Vec<u8> = animation
            .pictures
            .iter()
            .map(|picture| picture[0])
            .collect();
        assert!((60..=121).contains(&kept.len()), "{}", kept.len());
        let steps: Vec<u8> = kept
            .windows(2)
            .map(|pair| pair[1].wrapping_sub(pair[0]))
            .collect();
        assert!(steps.iter().all(|step| *step == steps[0]), "{steps:?}");
        assert!(animation.gif().starts_with(b"GIF89a") && animation.apng().is_ok());
    }
}
