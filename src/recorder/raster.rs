//! Images with a colour legend: a field on a rectangle, in half precision, with a colour range that holds until a knob is
//! turned beyond what it was made for.
//!
//! Values are stored in the unit of the entity's name as 16-bit floating-point numbers: eleven significant bits
//! (0.05 %) of everything between 6e-5 and 65 504, so that a film of 5 nm and the bath of 50 µm beside it are in one
//! picture and nothing depends on a range that was guessed. A value beyond is stored as the largest that there is; *Now* tells how large it is.

use std::cell::Cell;

use rerun::components::ImageFormat;
use rerun::{ChannelDatatype, DepthImage};

use super::legend::Legend;
use super::picture::{Beyond, Field, PixelField, log_styled, range, stored, styled};
use super::plot::PlotBox;
use super::stream::{Holds, Stream};
use asperity_picture::Look;

/// Whether a picture has all its rows from the beginning.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Height {
    /// It has.
    Fixed,
    /// Rows are added below.
    Growing,
}

/// An image of a field that changes.
#[derive(Debug, Clone)]
pub(crate) struct RasterEntity {
    entity: String,
    look: Look,
    legend: Legend,
    columns: usize,
    /// Of the picture that was logged last.
    last: Cell<Beyond>,
}

impl RasterEntity {
    /// Logs all that stays: format, colours and place, and of a picture with a fixed height its axes; then the range and the
    /// legend, from now on.
    pub(crate) fn new(
        stream: &Stream,
        entity: &str,
        look: Look,
        pixels: PixelField,
        plot: &PlotBox,
        height: Height,
    ) -> Self {
        let place = format!("{entity}/image");
        let format = ImageFormat::depth(pixels.resolution(), ChannelDatatype::F16);
        match height {
            Height::Fixed => {
                log_styled(stream, &place, &styled(&look).with_format(format), &pixels);
                plot.log(stream, &format!("{entity}/axes"), Holds::Always);
            }
            // What is logged once holds for ever, so the size of a growing picture and its axes may not be.
            Height::Growing => log_styled(stream, &place, &styled(&look), &pixels),
        }
        let legend = Legend::new(stream, format!("{entity}/legend"), &look, plot);
        let raster = Self {
            entity: place,
            look,
            legend,
            columns: pixels.columns,
            last: Cell::default(),
        };
        raster.log_range(stream);
        raster
    }

    /// Gives it another range from now on.
    pub(crate) fn widen(&mut self, stream: &Stream, look: Look) {
        if std::mem::replace(&mut self.look, look) != look {
            self.log_range(stream);
        }
    }

    fn log_range(&self, stream: &Stream) {
        stream.log_for(Holds::FromNow, &self.entity, &range(&self.look));
        self.legend.log(stream, &self.look);
    }

    /// One frame's values in SI.
    pub(crate) fn log(&self, stream: &Stream, field: Field) {
        let (values, beyond) = stored(&self.look, field);
        let image = DepthImage::update_fields().with_buffer(values);
        stream.log(&self.entity, &image);
        self.last.set(beyond);
    }

    /// The upper rows of a growing picture: as many as there are values for.
    pub(crate) fn log_upper(&self, stream: &Stream, values_si: &[f32]) {
        let rows = values_si.len() / self.columns.max(1);
        let resolution = [self.columns as u32, rows as u32];
        // Its samples are those of the maps, where they are counted.
        let (values, _) = stored(&self.look, Field::TopDown(values_si));
        let data = DepthImage::update_fields()
            .with_buffer(values)
            .with_format(ImageFormat::depth(resolution, ChannelDatatype::F16));
        stream.log(&self.entity, &data);
    }

    /// What of the last picture lay beyond the ranges.
    pub(crate) fn beyond(&self) -> Beyond {
        self.last.get()
    }

    /// What its numbers and colours mean.
    pub(crate) fn look(&self) -> &Look {
        &self.look
    }
}
