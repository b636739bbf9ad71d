//! Images with a colour legend: a field on a rectangle, in half precision, with a colour range that holds until a knob is
//! turned beyond what it was made for.
//!
//! Values are stored in the unit of the entity's name as 16-bit floating-point numbers: eleven significant bits
//! (0.05 %) of everything between 6e-5 and 65 504, so that a film of 5 nm and the bath of 50 µm beside it are in one
//! picture and nothing depends on a range that was guessed. A value beyond is stored as the greatest, and counted.

use std::cell::Cell;

use rerun::components::ImageFormat;
use rerun::{ChannelDatatype, DepthImage};

use super::legend::Legend;
use super::picture::{Beyond, Field, PixelField, log_styled, range, store, stored, styled, top};
use super::plot::PlotBox;
use super::stream::Stream;
use super::waiting::LevelImage;
use asperity_engine::observe::ObserveError;
use asperity_picture::Look;

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
pub(super) struct RasterEntity {
    entity: String,
    image: LevelImage,
    look: Look,
    legend: Legend,
    columns: usize,
    /// Of the picture that was logged last, and of all.
    last: Cell<Beyond>,
    all: Cell<Beyond>,
}

impl RasterEntity {
    /// Logs all that stays: format, colours and place, and of a picture with a fixed height its axes; then the range and the
    /// legend, from now on.
    pub(super) fn new(
        stream: &Stream,
        entity: &str,
        look: Look,
        pixels: PixelField,
        plot: &PlotBox,
        height: Height,
    ) -> Result<Self, ObserveError> {
        let place = format!("{entity}/image");
        let format = ImageFormat::depth(pixels.resolution(), ChannelDatatype::F16);
        match height {
            Height::Fixed => {
                log_styled(stream, &place, &styled(&look).with_format(format), &pixels)?;
                plot.log(stream, &format!("{entity}/axes"))?;
            }
            // What is logged once holds for ever, so the size of a growing picture and its axes may not be.
            Height::Growing => log_styled(stream, &place, &styled(&look), &pixels)?,
        }
        let legend = Legend::new(stream, format!("{entity}/legend"), &look, plot)?;
        let raster = Self {
            image: stream.level_image(place.as_str()),
            entity: place,
            look,
            legend,
            columns: pixels.columns,
            last: Cell::default(),
            all: Cell::default(),
        };
        raster.log_range(stream)?;
        Ok(raster)
    }

    /// Gives it another range from now on; the old and the new top, in its unit, where they differ.
    pub(super) fn reach(
        &mut self,
        stream: &Stream,
        look: Look,
    ) -> Result<Option<[f64; 2]>, ObserveError> {
        let before = std::mem::replace(&mut self.look, look);
        if before == look {
            return Ok(None);
        }
        self.log_range(stream)?;
        Ok(Some([top(&before), top(&look)]))
    }

    fn log_range(&self, stream: &Stream) -> Result<(), ObserveError> {
        stream.log(&self.entity, &range(&self.look))?;
        self.legend.log(stream, &self.look)
    }

    /// One frame's values in SI.
    pub(super) fn log(&self, stream: &Stream, field: Field) -> Result<(), ObserveError> {
        let mut beyond = Beyond::default();
        stream.log_levels(self.image, |halves| {
            beyond = store(&self.look, field, halves);
        })?;
        self.last.set(beyond);
        self.all.set(self.all.get().with(beyond));
        Ok(())
    }

    /// The upper rows of a growing picture: as many as there are values for.
    pub(super) fn log_upper(&self, stream: &Stream, values_si: &[f32]) -> Result<(), ObserveError> {
        let rows = values_si.len() / self.columns.max(1);
        let resolution = [self.columns as u32, rows as u32];
        // Its samples are those of the maps, where they are counted.
        let data = DepthImage::update_fields()
            .with_buffer(stored(&self.look, values_si))
            .with_format(ImageFormat::depth(resolution, ChannelDatatype::F16));
        stream.log(&self.entity, &data)
    }

    /// What of the last picture lay beyond the ranges.
    pub(super) fn beyond(&self) -> Beyond {
        self.last.get()
    }

    /// Same of all pictures.
    pub(super) fn beyond_in_all(&self) -> Beyond {
        self.all.get()
    }

    /// What its numbers and colours mean.
    pub(super) fn look(&self) -> &Look {
        &self.look
    }
}
