//! Drawings as pixels. What shapes and letters cover of a pixel is found by `ab_glyph_rasterizer`.

use ab_glyph::{Font as _, FontRef, PxScale, point as glyph_point};
use ab_glyph_rasterizer::{Rasterizer, point};

use super::{Drawing, Pen, PixelField, Rgb, Shape, Text, font, text_width};

/// Pixels of three bytes, row by row from above.
#[derive(Debug, Clone, Default, PartialEq, Eq)]
pub(crate) struct Pixels {
    pub(crate) wide: u32,
    pub(crate) tall: u32,
    pub(crate) rgb: Vec<u8>,
}

impl Drawing {
    /// As pixels; a drawing in pixels alone is sharp.
    ///
    /// # Errors
    /// When the font cannot be read.
    pub(crate) fn pixels(&self) -> Result<Pixels, String> {
        let font = font::font()?;
        let [wide, tall] = self.size.map(|side| side.round().max(1.0) as u32);
        let mut pixels = Pixels {
            wide,
            tall,
            rgb: vec![255; 3 * (wide * tall) as usize],
        };
        for field in &self.fields {
            pixels.field(field);
        }
        for shape in &self.shapes {
            pixels.shape(shape);
        }
        for text in &self.texts {
            pixels.text(font, text, self.font * text.size);
        }
        Ok(pixels)
    }

    /// As a PNG file.
    ///
    /// # Errors
    /// In words, when the font cannot be read or the pixels cannot be packed.
    pub(crate) fn png(&self) -> Result<Vec<u8>, String> {
        let pixels = self.pixels()?;
        png_of(&pixels.rgb, [pixels.wide, pixels.tall])
    }
}

impl Pixels {
    /// Lays a colour over a pixel, which it covers by that share.
    fn blend(&mut self, x: i64, y: i64, colour: Rgb, share: f32) {
        if x < 0 || y < 0 || x >= self.wide.into() || y >= self.tall.into() {
            return;
        }
        let at = 3 * (y as usize * self.wide as usize + x as usize);
        let share = share.clamp(0.0, 1.0);
        for (below, above) in self.rgb[at..at + 3].iter_mut().zip(colour) {
            let mixed = f32::from(*below) * (1.0 - share) + f32::from(above) * share;
            *below = (mixed + 0.5) as u8;
        }
    }

    /// Every pixel takes the nearest of the field.
    fn field(&mut self, field: &PixelField) {
        let area = field.area;
        let [columns, rows] = field.pixels;
        let nearest = |k: u32, side: f64, count: u32| {
            let share = (f64::from(k) + 0.5) / side;
            ((share * f64::from(count)) as usize).min(count as usize - 1)
        };
        for row in 0..area.high as u32 {
            for column in 0..area.wide as u32 {
                let [i, j] = [
                    nearest(column, area.wide, columns),
                    nearest(row, area.high, rows),
                ];
                let at = 3 * (j * columns as usize + i);
                let colour = [field.rgb[at], field.rgb[at + 1], field.rgb[at + 2]];
                let (x, y) = (area.left as i64 + i64::from(column), area.top as i64);
                self.blend(x, y + i64::from(row), colour, 1.0);
            }
        }
    }

    fn shape(&mut self, shape: &Shape) {
        let quads: Vec<Vec<[f64; 2]>> = match shape.pen {
            Pen::Fill => vec![shape.points.clone()],
            Pen::Line(width) => segments(&shape.points, width),
        };
        let all = || quads.iter().flatten();
        let (mut low, mut high) = ([f64::INFINITY; 2], [0.0_f64; 2]);
        for at in all() {
            low = [0, 1].map(|k| low[k].min(at[k]));
            high = [0, 1].map(|k| high[k].max(at[k]));
        }
        if all().next().is_none() {
            return;
        }
        let sides = [self.wide, self.tall].map(f64::from);
        let first = [0, 1].map(|k| low[k].clamp(0.0, sides[k]).floor());
        let size = [0, 1].map(|k| (high[k].min(sides[k]).ceil() - first[k]).max(1.0));
        let mut cover = Rasterizer::new(size[0] as usize + 1, size[1] as usize + 1);
        let inside = |at: [f64; 2]| {
            let [x, y] = [0, 1].map(|k| (at[k] - first[k]).clamp(0.0, size[k]) as f32);
            point(x, y)
        };
        for quad in &quads {
            for (k, &from) in quad.iter().enumerate() {
                cover.draw_line(inside(from), inside(quad[(k + 1) % quad.len()]));
            }
        }
        let [left, top] = first.map(|side| side as i64);
        cover.for_each_pixel_2d(|x, y, share| {
            if share > 0.0 {
                self.blend(left + i64::from(x), top + i64::from(y), shape.colour, share);
            }
        });
    }

    fn text(&mut self, font: &FontRef, text: &Text, size: f64) {
        // The library's scale is the height of a line.
        let scale = size * f64::from(font.height_unscaled()) / font::units_per_em(font);
        let scale = PxScale::from(scale as f32);
        let mut along = -text.anchor.share() * text_width(&text.words) * size;
        let at = text.at.map(|at| at.round() as i64);
        for letter in text.words.chars() {
            let id = font.glyph_id(letter);
            let glyph = id.with_scale_and_position(scale, glyph_point(along as f32, 0.0));
            along += font::advance(font, id) * size;
            let Some(outline) = font.outline_glyph(glyph) else {
                continue;
            };
            let low = outline.px_bounds().min;
            outline.draw(|x, y, share| {
                let (right, down) = (low.x as i64 + i64::from(x), low.y as i64 + i64::from(y));
                let [x, y] = if text.is_turned {
                    [at[0] + down, at[1] - right - 1]
                } else {
                    [at[0] + right, at[1] + down]
                };
                self.blend(x, y, text.colour, share);
            });
        }
    }
}

/// A rectangle for each part of a line, all turned the same way: what two cover is counted as covered.
fn segments(points: &[[f64; 2]], width: f64) -> Vec<Vec<[f64; 2]>> {
    let quads = points.windows(2).filter_map(|pair| {
        let [[x_0, y_0], [x_1, y_1]] = [pair[0], pair[1]];
        let (dx, dy) = (x_1 - x_0, y_1 - y_0);
        let length = dx.hypot(dy);
        // Half the width, across and at both ends.
        let [u, v] = [dx, dy].map(|part| 0.5 * width * part / length);
        (length > 0.0).then(|| {
            vec![
                [x_0 - u - v, y_0 - v + u],
                [x_1 + u - v, y_1 + v + u],
                [x_1 + u + v, y_1 + v - u],
                [x_0 - u + v, y_0 - v - u],
            ]
        })
    });
    quads.collect()
}

/// Pixels of three bytes as PNG.
///
/// # Errors
/// What the encoder says.
pub(crate) fn png_of(rgb: &[u8], [wide, tall]: [u32; 2]) -> Result<Vec<u8>, String> {
    let mut bytes = Vec::new();
    let mut encoder = png::Encoder::new(&mut bytes, wide, tall);
    encoder.set_color(png::ColorType::Rgb);
    encoder.set_depth(png::BitDepth::Eight);
    let written = encoder
        .write_header()
        .and_then(|mut writer| writer.write_image_data(rgb).and_then(|()| writer.finish()));
    written.map_err(|error| error.to_string())?;
    Ok(bytes)
}

#[cfg(test)]
mod tests {
    #![expect(clippy::unwrap_used, reason = "tests")]
    use super::super::{Rect, SizeUnit, TextAnchor};
    use super::*;

    fn drawing() -> Drawing {
        Drawing::new(SizeUnit::Pixel, [20.0, 10.0], 8.0)
    }

    fn pixel(pixels: &Pixels, x: usize, y: usize) -> Rgb {
        let at = 3 * (y * pixels.wide as usize + x);
        [pixels.rgb[at], pixels.rgb[at + 1], pixels.rgb[at + 2]]
    }

    #[test]
    fn shapes_cover_what_they_should() {
        let mut drawing = drawing();
        // A line of two pixels' width that crosses itself, and an area over half a pixel.
        let corner = vec![[2.0, 2.0], [8.0, 2.0], [8.0, 8.0], [5.0, 8.0], [5.0, 1.0]];
        drawing.line(corner, [0, 0, 0], 2.0);
        drawing.fill(
            vec![[12.0, 2.0], [14.5, 2.0], [14.5, 4.0], [12.0, 4.0]],
            [255, 0, 0],
        );
        let pixels = drawing.pixels().unwrap();
        for (x, y) in [(3, 1), (3, 2), (7, 5), (8, 5), (5, 2), (4, 5)] {
            assert_eq!(pixel(&pixels, x, y), [0; 3], "{x} {y}");
        }
        assert_eq!(pixel(&pixels, 3, 4), [255; 3]);
        assert_eq!(pixel(&pixels, 12, 3), [255, 0, 0]);
        assert_eq!(pixel(&pixels, 14, 3), [255, 128, 128]);
        assert_eq!(pixel(&pixels, 15, 3), [255; 3]);
    }

    #[test]
    fn fields_lie_where_they_should_and_texts_may_be_turned() {
        let mut drawing = drawing();
        let area = Rect {
            left: 1.0,
            top: 2.0,
            wide: 4.0,
            high: 2.0,
        };
        drawing.field(PixelField {
            area,
            pixels: [2, 1],
            rgb: vec![1, 2, 3, 4, 5, 6],
        });
        let text = Text::new([12.0, 9.0], "I").anchored(TextAnchor::Middle);
        drawing.text(text.clone());
        let upright = drawing.pixels().unwrap();
        assert_eq!(pixel(&upright, 2, 3), [1, 2, 3]);
        assert_eq!(pixel(&upright, 3, 2), [4, 5, 6]);
        assert_eq!(pixel(&upright, 5, 2), [255; 3]);
        // The letter's stem stands above its place; turned it lies before it.
        assert!(pixel(&upright, 12, 5)[0] < 200 || pixel(&upright, 11, 5)[0] < 200);
        drawing.texts = vec![text.turned()];
        let turned = drawing.pixels().unwrap();
        assert!((7..11).all(|x| pixel(&turned, x, 9)[0] < 200 || pixel(&turned, x, 8)[0] < 200));
    }
}
