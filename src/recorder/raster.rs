//! Images with a colour legend: a field on a rectangle, with a colour range that holds until a knob is turned beyond what
//! it was made for.
//!
//! Values are stored in the unit of the entity's name. What has a sign stands as 16-bit floating-point numbers: eleven
//! significant bits (0.05 %) of everything between 6e-5 and 65 504; a value beyond is stored as the largest that there is.
//! What has none stands in [levels](super::levels), in a fourth of the room. *Now* tells how large the largest is.

use std::cell::Cell;

use rerun::components::ImageFormat;
use rerun::{ChannelDatatype, DepthImage, EncodedDepthImage};

use super::legend::Legend;
use super::levels::levelled;
use super::picture::{
    Beyond, Field, PixelField, log_styled, range, stored, styled, styled_levels, top,
};
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
        if is_signed(&look) {
            let format = ImageFormat::depth(pixels.resolution(), ChannelDatatype::F16);
            log_styled(stream, &place, &styled(&look).with_format(format), &pixels);
        } else {
            log_styled(stream, &place, &styled_levels(&look), &pixels);
        }
        // What is logged once holds for ever, so the axes of a growing picture may not be.
        if height == Height::Fixed {
            plot.log(stream, &format!("{entity}/axes"), Holds::Always);
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
        // Levels have theirs with each picture.
        if is_signed(&self.look) {
            stream.log_for(Holds::FromNow, &self.entity, &range(&self.look));
        }
        self.legend.log(stream, &self.look);
    }

    /// One frame's values in SI: of a growing picture as many rows as there are values for.
    pub(crate) fn log(&self, stream: &Stream, field: Field) {
        if is_signed(&self.look) {
            let (values, beyond) = stored(&self.look, field);
            let image = DepthImage::update_fields().with_buffer(values);
            stream.log(&self.entity, &image);
            self.last.set(beyond);
            return;
        }
        match levelled(&self.look, field, self.columns) {
            Ok(levelled) => {
                let top = top(&self.look) * f64::from(levelled.per_unit);
                let image = EncodedDepthImage::update_fields()
                    .with_blob(levelled.png)
                    .with_meter(levelled.per_unit)
                    .with_depth_range([0.0, top]);
                stream.log(&self.entity, &image);
                self.last.set(levelled.beyond);
            }
            Err(reason) => stream.note_refused(Err(reason)),
        }
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

/// Whether its values may be negative.
fn is_signed(look: &Look) -> bool {
    look.range[0] < 0.0
}
