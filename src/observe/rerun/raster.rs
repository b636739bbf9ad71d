//! Images with a colour legend: a field on a rectangle, quantised to 16 bits, with a fixed range.
//!
//! `stored = round(value * levels/top)` with `top` the upper end of the colour range: 2^12 to 2^13
//! levels lie inside the range (finer than an eye or a screen tells), and values up to 4 to 16 times
//! the top are still stored as they are. The factor is the image's `meter`, so that viewers and
//! scripts get the value back in the unit of the entity's name.

use rerun::components::{Colormap, ImageBuffer, ImageFormat, MagnificationFilter};
use rerun::{ChannelDatatype, DepthImage, EntityPath, Transform3D};

use super::colour::WHITE;
use super::plot::{Labels, PlotBox};
use super::stream::Stream;
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

    /// Quantises rows of SI values, little-endian as the viewer wants them. Values beyond the stored range take
    /// its end.
    fn quantise<'a>(&self, rows_si: impl Iterator<Item = &'a [f32]>, n: usize) -> Vec<u8> {
        let factor = (self.per_si * self.levels()) as f32;
        let [low, high] = match self.sign {
            Sign::Positive => [0.0, f32::from(u16::MAX)],
            Sign::Both => [f32::from(i16::MIN), f32::from(i16::MAX)],
        };
        let mut bytes = vec![0; 2 * n];
        let mut rest = bytes.as_mut_slice();
        for row in rows_si {
            let (out, after) = rest.split_at_mut(2 * row.len());
            for (pair, value) in out.chunks_exact_mut(2).zip(row) {
                // Half away from zero, without a call of the library's `round`; both signs have the same low
                // sixteen bits.
                let level = value * factor;
                let level = (level + 0.5_f32.copysign(level)).clamp(low, high);
                pair.copy_from_slice(&(level as i32 as u16).to_le_bytes());
            }
            rest = after;
        }
        bytes
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
    image: EntityPath,
    scale: Scale,
    columns: usize,
    rows: usize,
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
        let image = EntityPath::from(format!("{entity}/image"));
        let format = ImageFormat::depth(pixels.resolution(), scale.datatype());
        // What is logged once holds for ever, so the size of a growing picture may not be.
        let fixed = match height {
            Height::Fixed => styled(&scale).with_format(format),
            Height::Growing => styled(&scale),
        };
        stream.log_static(image.clone(), &fixed)?;
        stream.log_static(image.clone(), &pixels.transform())?;
        plot.log(stream, &format!("{entity}/axes"))?;
        log_legend(stream, &format!("{entity}/legend"), &scale, plot, title)?;
        Ok(Self {
            image,
            scale,
            columns: pixels.columns,
            rows: pixels.rows,
        })
    }

    /// One frame's values in SI, row by row from the top.
    pub(super) fn log<'a>(
        &self,
        stream: &Stream,
        rows_si: impl Iterator<Item = &'a [f32]>,
    ) -> Result<(), ObserveError> {
        let bytes = self.scale.quantise(rows_si, self.columns * self.rows);
        let data = DepthImage::update_fields().with_buffer(ImageBuffer::from(bytes));
        stream.log(self.image.clone(), &data)
    }

    /// The upper rows of a growing picture: as many as there are values for.
    pub(super) fn log_upper(&self, stream: &Stream, values_si: &[f32]) -> Result<(), ObserveError> {
        let rows = values_si.len() / self.columns.max(1);
        let resolution = [self.columns as u32, rows as u32];
        let bytes = self
            .scale
            .quantise(std::iter::once(values_si), values_si.len());
        let data = DepthImage::update_fields()
            .with_buffer(ImageBuffer::from(bytes))
            .with_format(ImageFormat::depth(resolution, self.scale.datatype()));
        stream.log(self.image.clone(), &data)
    }
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
        .with_buffer(ImageBuffer::from(
            scale.quantise(std::iter::once(ramp.as_slice()), ROWS),
        ));
    stream.log_static(bar.as_str(), &image)?;
    stream.log_static(bar.as_str(), &pixels.transform())?;

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

    #[test]
    fn values_come_back_within_half_a_level() {
        let scale = scale(Sign::Positive);
        assert!((scale.top - 2.0).abs() < 1e-12);
        let values = [0.0, 1.234_567e9, 1.9e9, 15.9e9];
        let bytes = scale.quantise(std::iter::once(values.as_slice()), 4);
        for (pair, value) in bytes.chunks_exact(2).zip(values) {
            let stored = f64::from(u16::from_le_bytes([pair[0], pair[1]]));
            let back = stored / scale.levels();
            let error = (back - f64::from(value) * 1e-9).abs();
            // Half a level, and the rounding of a single-precision product.
            assert!(error <= 0.5 * scale.resolution() + 1e-6 * back, "{error}");
        }
        assert!(scale.resolution() < scale.top / 4000.0);
    }

    #[test]
    fn the_ends_saturate_and_signs_are_kept() {
        let two = |sign, values: [f32; 2]| {
            let row = values.as_slice();
            scale(sign).quantise(std::iter::once(row), 2)
        };
        assert_eq!(two(Sign::Positive, [1e12, -1.0]), [255, 255, 0, 0]);
        assert_eq!(two(Sign::Positive, [f32::NAN, 0.0]), [0; 4]);
        let ends = two(Sign::Both, [-1e12, 1e12]);
        assert_eq!(ends, [0x00, 0x80, 0xff, 0x7f]);
        let bytes = two(Sign::Both, [-1.0e9, 1.0e9]);
        let low = i16::from_le_bytes([bytes[0], bytes[1]]);
        let high = i16::from_le_bytes([bytes[2], bytes[3]]);
        assert_eq!(low, -high);
        assert!(high > 2000);
    }
}
