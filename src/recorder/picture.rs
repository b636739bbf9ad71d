//! What images hold: values in half precision, and where their pixels lie in a view.

use rerun::components::{Colormap, ImageBuffer, MagnificationFilter};
use rerun::datatypes::Blob;
use rerun::external::arrow::buffer::Buffer;
use rerun::{AsComponents, DepthImage, EncodedDepthImage, Transform3D};

use super::stream::Stream;
use asperity_engine::math::number::nice_ceiling;
use asperity_picture::{Look, Ramp};

/// The viewer's map of those colours.
fn colormap(ramp: Ramp) -> Colormap {
    match ramp {
        Ramp::Inferno => Colormap::Inferno,
        Ramp::Magma => Colormap::Magma,
        Ramp::Viridis => Colormap::Viridis,
        Ramp::Diverging => Colormap::CyanToYellow,
    }
}

/// Upper end of a look's range, in its unit.
pub(crate) fn top(look: &Look) -> f64 {
    // To SI and back a round number may lose its last bit.
    nice_ceiling(look.unit.of(look.range[1]))
}

/// Adds SI values in a look's unit and half precision, little-endian as the viewer wants them; what lies beyond.
fn store(look: &Look, field: Field, halves: &mut Vec<u16>) -> Beyond {
    let (factor, top) = (look.unit.per_si as f32, top(look) as f32);
    let mut beyond = Beyond::default();
    field.write_to(halves, |row, halves| {
        beyond.add(store_row(row, factor, top, halves));
    });
    beyond
}

/// Same as an image has them.
pub(crate) fn stored(look: &Look, field: Field) -> (ImageBuffer, Beyond) {
    let mut halves = Vec::new();
    let beyond = store(look, field, &mut halves);
    (ImageBuffer(Blob::from(Buffer::from_vec(halves))), beyond)
}

/// What of a picture lies beyond its ranges.
#[derive(Debug, Clone, Copy, Default, PartialEq)]
pub(crate) struct Beyond {
    /// Samples above the colour range (by their size), which take the top colour.
    pub(crate) above: u64,
    /// The maximum sample by its size, in the unit.
    pub(crate) maximum: f32,
}

impl Beyond {
    pub(crate) fn add(&mut self, (above, maximum): (u32, u32)) {
        self.above += u64::from(above);
        // What is no number (which a field never holds by its contract) is as great as can be.
        let maximum = f32::from_bits(maximum);
        self.maximum = if maximum.is_nan() {
            f32::INFINITY
        } else {
            self.maximum.max(maximum)
        };
    }
}

/// Values of a picture, row by row.
#[derive(Debug, Clone, Copy)]
pub(crate) enum Field<'a, T = f32> {
    /// As a picture has them.
    TopDown(&'a [T]),
    /// As a frame has them, so many a row: y points up.
    BottomUp(&'a [T], usize),
}

impl<T> Field<'_, T> {
    /// Adds a pixel for each value, through a function of rows. Rows are read as they lie: a frame comes from
    /// another core, and reading it backwards takes three times as long.
    pub(crate) fn write_to<P: Copy + Default>(
        self,
        pixels: &mut Vec<P>,
        mut write: impl FnMut(&[T], &mut [P]),
    ) {
        let from = pixels.len();
        match self {
            Self::TopDown(values) => {
                pixels.resize(from + values.len(), P::default());
                write(values, &mut pixels[from..]);
            }
            Self::BottomUp(values, columns) => {
                pixels.resize(from + values.len(), P::default());
                let rows = pixels[from..].chunks_exact_mut(columns).rev();
                for (row, out) in values.chunks_exact(columns).zip(rows) {
                    write(row, out);
                }
            }
        }
    }
}

dispatched! {
    /// Half precision, to the nearest, ties to even. How many sizes are above `top`, and the bits of the maximum.
    fn store_row(row: &[f32], factor: f32, top: f32, halves: &mut [u16]) -> (u32, u32) {
        let (mut above, mut maximum) = (0, 0);
        for (out, value) in halves.iter_mut().zip(row) {
            let bits = (value * factor).to_bits();
            let size = bits & 0x7fff_ffff;
            above += u32::from(size > top.to_bits());
            maximum = if size > maximum { size } else { maximum };
            // From 2^-14 on: fewer digits and another bias of the exponent.
            let normal = (size + 0x0fff + ((size >> 13) & 1)).wrapping_sub(0x3800_0000) >> 13;
            // Below, halves are multiples of 2^-24, as singles are between 0.5 and 1: the sum rounds.
            let small = (f32::from_bits(size) + 0.5).to_bits().wrapping_sub(0x3f00_0000);
            let half = if size < 0x3880_0000 { small } else { normal };
            let half = if half > 0x7bff { 0x7bff } else { half };
            let half = if size > 0x7f80_0000 { 0x7e00 } else { half };
            *out = ((((bits >> 16) & 0x8000) | half) as u16).to_le();
        }
        (above, maximum)
    }
}

/// A rectangle of pixels in a view: the centres of the first and the last pixel of both axes.
#[derive(Debug, Clone, Copy)]
pub(crate) struct PixelField {
    pub(crate) columns: usize,
    pub(crate) rows: usize,
    /// Centre of the upper left pixel.
    pub(crate) first: [f64; 2],
    /// Size of a pixel.
    pub(crate) size: [f64; 2],
}

impl PixelField {
    /// From pixel units of the image to the view.
    pub(crate) fn transform(&self) -> Transform3D {
        let corner = [
            (self.first[0] - 0.5 * self.size[0]) as f32,
            (self.first[1] - 0.5 * self.size[1]) as f32,
            0.0,
        ];
        Transform3D::from_translation_scale(corner, [self.size[0] as f32, self.size[1] as f32, 1.0])
    }

    pub(crate) fn resolution(&self) -> [u32; 2] {
        [self.columns as u32, self.rows as u32]
    }
}

/// Logs how an image looks and where it is.
pub(crate) fn log_styled(
    stream: &Stream,
    entity: &str,
    style: &dyn AsComponents,
    pixels: &PixelField,
) {
    stream.log_static(entity, &[style, &pixels.transform()]);
}

pub(crate) fn styled(look: &Look) -> DepthImage {
    DepthImage::update_fields()
        .with_meter(1.0)
        .with_colormap(colormap(look.ramp()))
        .with_magnification_filter(MagnificationFilter::Linear)
}

/// The same of a picture in [levels](super::levels).
pub(crate) fn styled_levels(look: &Look) -> EncodedDepthImage {
    EncodedDepthImage::update_fields()
        .with_media_type("image/png")
        .with_colormap(colormap(look.ramp()))
        .with_magnification_filter(MagnificationFilter::Linear)
}

pub(crate) fn range(look: &Look) -> DepthImage {
    let top = top(look);
    let low = if look.range[0] < 0.0 { -top } else { 0.0 };
    DepthImage::update_fields().with_depth_range([low, top])
}

#[cfg(test)]
mod tests {
    use super::*;
    use asperity_engine::math::number::{GPA, Unit};

    fn look(unit: Unit) -> Look {
        Look::up_to("p", unit, 2e9, Ramp::Diverging)
    }

    fn stored(look: &Look, values: &[f32]) -> (Vec<f64>, Beyond) {
        let mut halves = Vec::new();
        let beyond = store(look, Field::TopDown(values), &mut halves);
        let values = halves.into_iter().map(u16::from_le).map(value_of);
        (values.collect(), beyond)
    }

    /// IEEE 754 binary16.
    fn value_of(half: u16) -> f64 {
        let (exponent, digits) = (i32::from((half >> 10) & 0x1f), f64::from(half & 0x3ff));
        let size = match exponent {
            0 => digits * 2.0_f64.powi(-24),
            _ => (1024.0 + digits) * 2.0_f64.powi(exponent - 25),
        };
        if half & 0x8000 == 0 { size } else { -size }
    }

    #[test]
    fn a_frames_rows_are_turned_over() {
        let mut pixels = vec![9];
        Field::BottomUp(&[1, 2, 3, 4, 5, 6], 2).write_to(
            &mut pixels,
            |row: &[i32], out: &mut [i32]| {
                out.copy_from_slice(row);
            },
        );
        assert_eq!(pixels, [9, 5, 6, 3, 4, 1, 2]);
    }

    #[test]
    fn values_come_back_to_eleven_bits() {
        let look = look(GPA);
        assert!((top(&look) - 2.0).abs() < 1e-12);
        let values: Vec<f32> = (0..3800)
            .map(|k| 1.0e2 * 1.007_f32.powi(k) * if k % 2 == 0 { 1.0 } else { -1.0 })
            .collect();
        let (back, beyond) = stored(&look, &values);
        assert_eq!(back.len(), values.len());
        for (back, value) in back.into_iter().zip(&values) {
            let value = f64::from(*value) * 1e-9;
            let error = (back - value).abs();
            // Half a unit in the last place, and the rounding of a single-precision product.
            assert!(
                error <= (0.501 / 1024.0 * value.abs()).max(0.5 * 2.0_f64.powi(-24)),
                "{value}: {error}"
            );
        }
        let above = values.iter().filter(|value| value.abs() > 2e9).count();
        assert_eq!(beyond.above, above as u64);
    }

    #[test]
    fn what_cannot_be_stored_takes_the_end_and_is_told() {
        let unit = Look {
            range: [-2.0, 2.0],
            ..look(Unit::new("Pa", 1.0))
        };
        let (back, beyond) = stored(&unit, &[0.0, 7e4, -1e5, 65_504.0, 1.0]);
        assert_eq!(back, [0.0, 65_504.0, -65_504.0, 65_504.0, 1.0]);
        assert_eq!((beyond.above, beyond.maximum), (3, 1e5));
        let (_, beyond) = stored(&unit, &[f32::NAN]);
        assert_eq!(beyond.maximum, f32::INFINITY);
    }
}
