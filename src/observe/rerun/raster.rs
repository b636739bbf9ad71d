//! Images with a colour legend: a field on a rectangle, quantised to 16 bits, with a fixed range.
//!
//! `stored = round(value * levels/top)` with `top` the upper end of the colour range: 2^12 to 2^13
//! levels lie inside the range (finer than an eye or a screen tells), and values up to 4 to 16 times
//! the top are still stored as they are. The factor is the image's `meter`, so that viewers and
//! scripts get the value back in the unit of the entity's name.

use rerun::components::{Colormap, ImageBuffer, ImageFormat, MagnificationFilter};
use rerun::{AsComponents, ChannelDatatype, DepthImage, Transform3D};

use super::colour::WHITE;
use super::plot::{Labels, PlotBox};
use super::stream::Stream;
use super::waiting::LevelImage;
use crate::observe::ObserveError;
use crate::observe::scales::{divisions, nice_up, number};

/// Values of which sign an image holds.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Sign {
    /// Zero and above: u16.
    Positive,
    /// Both: i16, the colour range symmetrical about zero.
    Both,
}

/// What numbers mean and how they are coloured.
#[derive(Debug, Clone)]
pub(super) struct Scale {
    /// Unit of the values, as in the entity's name.
    pub(super) unit: &'static str,
    /// From SI to the unit.
    pub(super) per_si: f64,
    /// Upper end of the colour range, in the unit.
    pub(super) top: f64,
    /// How many times the top can be stored.
    pub(super) headroom: f64,
    pub(super) sign: Sign,
    pub(super) colours: Colormap,
}

impl Scale {
    /// A scale whose top is the next round number above `value_si`.
    pub(super) fn up_to(
        value_si: f64,
        (unit, per_si): (&'static str, f64),
        sign: Sign,
        colours: Colormap,
        headroom: f64,
    ) -> Self {
        Self {
            unit,
            per_si,
            top: nice_up(value_si * per_si),
            headroom,
            sign,
            colours,
        }
    }

    fn full(&self) -> f64 {
        match self.sign {
            Sign::Positive => f64::from(u16::MAX),
            Sign::Both => f64::from(i16::MAX),
        }
    }

    /// Stored levels per unit.
    fn levels(&self) -> f64 {
        self.full() / (self.top * self.headroom)
    }

    /// The least and the greatest value that can be stored, in the unit.
    pub(super) fn stored_range(&self) -> [f64; 2] {
        let top = self.top * self.headroom;
        match self.sign {
            Sign::Positive => [0.0, top],
            Sign::Both => [-top, top],
        }
    }

    /// The smallest difference that is stored, in the unit.
    pub(super) fn resolution(&self) -> f64 {
        1.0 / self.levels()
    }

    fn low(&self) -> f64 {
        match self.sign {
            Sign::Positive => 0.0,
            Sign::Both => -self.top,
        }
    }

    fn datatype(&self) -> ChannelDatatype {
        match self.sign {
            Sign::Positive => ChannelDatatype::U16,
            Sign::Both => ChannelDatatype::I16,
        }
    }

    /// Adds SI values, quantised, little-endian as the viewer wants them. Values beyond the stored range take its
    /// end.
    fn quantise(&self, field: Field, levels: &mut Vec<u16>) {
        let factor = (self.per_si * self.levels()) as f32;
        let range = match self.sign {
            Sign::Positive => [0.0, f32::from(u16::MAX)],
            Sign::Both => [f32::from(i16::MIN), f32::from(i16::MAX)],
        };
        field.write_to(levels, |row, levels| {
            quantise_row(row, factor, range, levels);
        });
    }

    /// Same as bytes of their own.
    fn quantised(&self, values_si: &[f32]) -> ImageBuffer {
        let mut levels = Vec::with_capacity(values_si.len());
        self.quantise(Field::TopDown(values_si), &mut levels);
        let bytes: Vec<u8> = levels.into_iter().flat_map(u16::to_ne_bytes).collect();
        ImageBuffer::from(bytes)
    }
}

/// Values of a picture, row by row.
#[derive(Debug, Clone, Copy)]
pub(super) enum Field<'a, T = f32> {
    /// As a picture has them.
    TopDown(&'a [T]),
    /// As a frame has them, so many a row: y points up.
    BottomUp(&'a [T], usize),
}

impl<T> Field<'_, T> {
    /// Adds a pixel for each value, through a function of rows. Rows are read as they lie: a frame comes from
    /// another core, and reading it backwards takes three times as long.
    pub(super) fn write_to<P: Copy + Default>(
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
    fn quantise_row(row: &[f32], factor: f32, [low, high]: [f32; 2], levels: &mut [u16]) {
        for (out, value) in levels.iter_mut().zip(row) {
            // Half away from zero, without a call of the library's `round`; both signs have the same low sixteen
            // bits.
            let level = value * factor;
            let level = (level + 0.5_f32.copysign(level)).clamp(low, high);
            *out = (level as i32 as u16).to_le();
        }
    }
}

/// A rectangle of pixels in a view: the centres of the first and the last pixel of both axes.
#[derive(Debug, Clone, Copy)]
pub(super) struct Pixels {
    pub(super) columns: usize,
    pub(super) rows: usize,
    /// Centre of the upper left pixel.
    pub(super) first: [f64; 2],
    /// Size of a pixel.
    pub(super) size: [f64; 2],
}

impl Pixels {
    /// From pixel units of the image to the view.
    pub(super) fn transform(&self) -> Transform3D {
        let corner = [
            (self.first[0] - 0.5 * self.size[0]) as f32,
            (self.first[1] - 0.5 * self.size[1]) as f32,
            0.0,
        ];
        Transform3D::from_translation_scale(corner, [self.size[0] as f32, self.size[1] as f32, 1.0])
    }

    pub(super) fn resolution(&self) -> [u32; 2] {
        [self.columns as u32, self.rows as u32]
    }
}

/// Whether a picture has all its rows from the beginning.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Height {
    /// It has.
    Fixed,
    /// Rows are added below.
    Growing,
}

/// An image of a field that changes.
#[derive(Debug, Clone)]
pub(super) struct Raster {
    entity: String,
    image: LevelImage,
    scale: Scale,
    columns: usize,
}

impl Raster {
    /// Logs all that stays: format, colours, range, place, axes and legend.
    pub(super) fn new(
        stream: &Stream,
        entity: &str,
        scale: Scale,
        pixels: Pixels,
        plot: &PlotBox,
        (title, height): (&str, Height),
    ) -> Result<Self, ObserveError> {
        let place = format!("{entity}/image");
        let format = ImageFormat::depth(pixels.resolution(), scale.datatype());
        // What is logged once holds for ever, so the size of a growing picture may not be.
        let fixed = match height {
            Height::Fixed => styled(&scale).with_format(format),
            Height::Growing => styled(&scale),
        };
        log_styled(stream, &place, &fixed, &pixels)?;
        plot.log(stream, &format!("{entity}/axes"))?;
        log_legend(stream, &format!("{entity}/legend"), &scale, plot, title)?;
        Ok(Self {
            image: stream.level_image(place.as_str()),
            entity: place,
            scale,
            columns: pixels.columns,
        })
    }

    /// One frame's values in SI.
    pub(super) fn log(&self, stream: &Stream, field: Field) -> Result<(), ObserveError> {
        stream.log_levels(self.image, |levels| self.scale.quantise(field, levels))
    }

    /// The upper rows of a growing picture: as many as there are values for.
    pub(super) fn log_upper(&self, stream: &Stream, values_si: &[f32]) -> Result<(), ObserveError> {
        let rows = values_si.len() / self.columns.max(1);
        let resolution = [self.columns as u32, rows as u32];
        let data = DepthImage::update_fields()
            .with_buffer(self.scale.quantised(values_si))
            .with_format(ImageFormat::depth(resolution, self.scale.datatype()));
        stream.log(&self.entity, &data)
    }
}

/// Logs how an image looks and where it is.
pub(super) fn log_styled(
    stream: &Stream,
    entity: &str,
    style: &dyn AsComponents,
    pixels: &Pixels,
) -> Result<(), ObserveError> {
    stream.log_static(entity, &[style, &pixels.transform()])
}

fn styled(scale: &Scale) -> DepthImage {
    let levels = scale.levels();
    DepthImage::update_fields()
        .with_meter(levels as f32)
        .with_colormap(scale.colours)
        .with_depth_range([scale.low() * levels, scale.top * levels])
        .with_magnification_filter(MagnificationFilter::Linear)
}

/// The colour bar: an image of the same colours and range, so that it cannot differ from them.
fn log_legend(
    stream: &Stream,
    entity: &str,
    scale: &Scale,
    plot: &PlotBox,
    title: &str,
) -> Result<(), ObserveError> {
    const ROWS: usize = 128;
    let (w, h) = (plot.x[1] - plot.x[0], plot.y[1] - plot.y[0]);
    let left = plot.x[1] + 0.04 * w;
    let wide = 0.035 * w;
    let span = scale.top - scale.low();
    let ramp: [f32; ROWS] = std::array::from_fn(|row| {
        let value = scale.top - span * (row as f64 + 0.5) / ROWS as f64;
        (value / scale.per_si) as f32
    });
    let pixels = Pixels {
        columns: 1,
        rows: ROWS,
        first: [left + 0.5 * wide, plot.y[0] + 0.5 * h / ROWS as f64],
        size: [wide, h / ROWS as f64],
    };
    let bar = format!("{entity}/bar");
    let image = styled(scale)
        .with_format(ImageFormat::depth(pixels.resolution(), scale.datatype()))
        .with_buffer(scale.quantised(&ramp));
    log_styled(stream, &bar, &image, &pixels)?;

    let mut labels = Labels::default();
    let values = match scale.sign {
        Sign::Positive => divisions(scale.top),
        Sign::Both => [-1.0, -0.5, 0.0, 0.5, 1.0].map(|t| t * scale.top).to_vec(),
    };
    for value in values {
        let y = plot.y[0] + h * (scale.top - value) / span;
        let text = if (value - scale.top).abs() < 1e-9 * span {
            format!("≥{}", number(value))
        } else {
            number(value)
        };
        labels.add([left + 0.13 * w, y - 0.022 * h], &text, WHITE);
    }
    labels.add([left + 0.06 * w, plot.y[0] - 0.085 * h], title, WHITE);
    labels.log(stream, &format!("{entity}/labels"))
}

#[cfg(test)]
mod tests {
    use super::*;

    fn scale(sign: Sign) -> Scale {
        Scale::up_to(1.9e9, ("GPa", 1e-9), sign, Colormap::Inferno, 8.0)
    }

    fn levels(scale: &Scale, values: &[f32]) -> Vec<u16> {
        let mut levels = Vec::new();
        scale.quantise(Field::TopDown(values), &mut levels);
        levels.into_iter().map(u16::from_le).collect()
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
    fn values_come_back_within_half_a_level() {
        let scale = scale(Sign::Positive);
        assert!((scale.top - 2.0).abs() < 1e-12);
        let values = [0.0, 1.234_567e9, 1.9e9, 15.9e9];
        let levels = levels(&scale, &values);
        assert_eq!(levels.len(), values.len());
        for (stored, value) in levels.into_iter().zip(values) {
            let stored = f64::from(stored);
            let back = stored / scale.levels();
            let error = (back - f64::from(value) * 1e-9).abs();
            // Half a level, and the rounding of a single-precision product.
            assert!(error <= 0.5 * scale.resolution() + 1e-6 * back, "{error}");
        }
        assert!(scale.resolution() < scale.top / 4000.0);
    }

    #[test]
    fn the_ends_saturate_and_signs_are_kept() {
        let of = |sign, values: [f32; 2]| levels(&scale(sign), &values);
        assert_eq!(of(Sign::Positive, [1e12, -1.0]), [u16::MAX, 0]);
        assert_eq!(of(Sign::Positive, [f32::NAN, 0.0]), [0, 0]);
        let signed = |values| -> Vec<i16> {
            let levels = of(Sign::Both, values).into_iter();
            levels.map(u16::cast_signed).collect()
        };
        assert_eq!(signed([-1e12, 1e12]), [i16::MIN, i16::MAX]);
        let [low, high] = signed([-1.0e9, 1.0e9])[..] else {
            panic!("two values");
        };
        assert_eq!(low, -high);
        assert!(high > 2000);
    }
}
