//! Pictures one after another, as GIF: 255 colours for all pictures, those that are seen most, and one that lets the picture
//! before show through.

use std::borrow::Cow;
use std::io::Write;

use gif::{Encoder, EncodingError, Repeat};

use crate::draw::Pixels;

/// Most pictures that are kept; when there are more every other one goes.
const MOST: usize = 180;
/// How long all of them are shown, s, and one at least and at most: 12 to 20 a second look as if they moved.
const ALL_S: f64 = 10.0;
const SHOWN_S: [f64; 2] = [0.05, 0.08];

/// Pictures of one size.
#[derive(Debug, Default)]
pub(super) struct Animation {
    pictures: Vec<Pixels>,
    /// Pictures that came, and how many make one that is kept.
    came: usize,
    every: usize,
}

impl Animation {
    /// Whether the next picture is kept; one that is not need not be drawn.
    pub(super) fn wants(&mut self) -> bool {
        self.every = self.every.max(1);
        let wants = self.came.is_multiple_of(self.every);
        self.came += 1;
        wants
    }

    /// Takes a picture up.
    pub(super) fn push(&mut self, picture: Pixels) {
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
        let shown = ALL_S / self.pictures.len().max(1) as f64;
        let [least, most] = SHOWN_S;
        (100.0 * shown.clamp(least, most)).round() as u16
    }

    /// Writes it as GIF.
    ///
    /// # Errors
    /// What the disk or the encoder says.
    pub(super) fn write(&self, out: impl Write) -> Result<(), EncodingError> {
        let size = self
            .pictures
            .first()
            .map_or([0; 2], |picture| [picture.wide, picture.tall]);
        let [width, height] = size.map(|side| side as u16);
        let palette = Palette::of(&self.pictures);
        let mut encoder = Encoder::new(out, width, height, palette.colours.as_flattened())?;
        encoder.set_repeat(Repeat::Infinite)?;
        let mut before: Vec<u8> = Vec::new();
        for picture in &self.pictures {
            let now = palette.indices(&picture.rgb);
            let pixels = now.iter().enumerate().map(|(at, index)| {
                let is_same = before.get(at) == Some(index);
                if is_same { TRANSPARENT } else { *index }
            });
            encoder.write_frame(&gif::Frame {
                width,
                height,
                delay: self.delay(),
                transparent: Some(TRANSPARENT),
                buffer: Cow::Owned(pixels.collect()),
                ..gif::Frame::default()
            })?;
            before = now;
        }
        Ok(())
    }
}

/// Lets the picture before show through.
const TRANSPARENT: u8 = 255;

/// Colours that stand for all.
struct Palette {
    colours: [[u8; 3]; 256],
    /// Of every colour at five bits: which stands for it.
    of: Vec<u8>,
}

impl Palette {
    fn of(pictures: &[Pixels]) -> Self {
        let mut seen = vec![(0_u64, [0_u64; 3]); 1 << 15];
        for pixel in pictures
            .iter()
            .flat_map(|picture| picture.rgb.chunks_exact(3))
        {
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
            let own = mean(at).map(i32::from);
            let off = |k: &usize| -> i32 {
                let other = colours[*k].map(i32::from);
                (0..3).map(|c| (own[c] - other[c]).pow(2)).sum()
            };
            of[at] = (0..kept).min_by_key(off).unwrap_or(0) as u8;
        }
        Self { colours, of }
    }

    fn indices(&self, rgb: &[u8]) -> Vec<u8> {
        let pixels = rgb.chunks_exact(3);
        pixels.map(|pixel| self.of[coarse(pixel)]).collect()
    }
}

/// A colour at five bits.
fn coarse(pixel: &[u8]) -> usize {
    pixel
        .iter()
        .fold(0, |all, &value| all << 5 | usize::from(value >> 3))
}

#[cfg(test)]
mod tests {
    #![expect(clippy::unwrap_used, reason = "tests")]
    use super::*;

    fn one_pixel(colour: [u8; 3]) -> Pixels {
        Pixels {
            wide: 1,
            tall: 1,
            rgb: colour.to_vec(),
        }
    }

    #[test]
    fn long_animations_keep_every_other_picture() {
        let mut animation = Animation::default();
        for k in 0..500 {
            if animation.wants() {
                animation.push(one_pixel([k as u8, 0, 0]));
            }
        }
        let kept = animation.pictures.iter().map(|picture| picture.rgb[0]);
        let kept: Vec<u8> = kept.collect();
        assert!((90..=181).contains(&kept.len()), "{}", kept.len());
        let steps = kept.windows(2).map(|pair| pair[1].wrapping_sub(pair[0]));
        let steps: Vec<u8> = steps.collect();
        assert!(steps.iter().all(|step| *step == steps[0]), "{steps:?}");
    }

    #[test]
    fn colours_come_back() {
        let mut animation = Animation::default();
        let colours = [[255; 3], [255; 3], [200, 8, 16]];
        for colour in colours {
            assert!(animation.wants());
            animation.push(one_pixel(colour));
        }
        let mut file = Vec::new();
        animation.write(&mut file).unwrap();
        let mut options = gif::DecodeOptions::new();
        options.set_color_output(gif::ColorOutput::RGBA);
        let mut decoder = options.read_info(file.as_slice()).unwrap();
        let mut shown = Vec::new();
        while let Some(frame) = decoder.read_next_frame().unwrap() {
            assert_eq!(frame.delay, 8);
            shown.push(frame.buffer.to_vec());
        }
        // The second is the same as the one before and lets it through.
        let [first, second, third] = [[255; 4], [0; 4], [200, 8, 16, 255]];
        assert_eq!(
            (&shown[0][..], shown[1][3], &shown[2][..]),
            (&first[..], second[3], &third[..])
        );
    }
}
