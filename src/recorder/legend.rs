//! Colour bars: images of the same colours and range as the picture beside them, so that they cannot differ from it.

use rerun::ChannelDatatype;
use rerun::components::ImageFormat;

use super::picture::{Field, PixelField, log_styled, range, stored, styled};
use super::plot::{HALF_LABEL, Labels, PlotBox, TITLES};
use super::stream::{Holds, Stream};
use asperity_picture::Look;

/// The colour bar of a picture.
#[derive(Debug, Clone)]
pub(crate) struct Legend {
    entity: String,
    /// The plot beside which it stands.
    plot: PlotBox,
}

impl Legend {
    const ROWS: usize = 128;

    /// Logs what stays: the bar's place, format and colours.
    pub(crate) fn new(stream: &Stream, entity: String, look: &Look, plot: &PlotBox) -> Self {
        let legend = Self {
            entity,
            plot: plot.clone(),
        };
        let (w, height) = (plot.beside(), legend.height() / Self::ROWS as f64);
        let wide = 0.035 * w;
        let pixels = PixelField {
            columns: 1,
            rows: Self::ROWS,
            first: [plot.x[1] + 0.04 * w + 0.5 * wide, plot.y[0] + 0.5 * height],
            size: [wide, height],
        };
        let format = ImageFormat::depth(pixels.resolution(), ChannelDatatype::F16);
        let image = styled(look).with_format(format);
        log_styled(stream, &legend.bar(), &image, &pixels);
        legend
    }

    fn height(&self) -> f64 {
        self.plot.y[1] - self.plot.y[0]
    }

    fn bar(&self) -> String {
        format!("{}/bar", self.entity)
    }

    /// Logs the range: the bar's values and the numbers beside it.
    pub(crate) fn log(&self, stream: &Stream, look: &Look) {
        let (w, h, upper) = (self.plot.beside(), self.height(), self.plot.y[0]);
        let [low, top] = look.range;
        let span = top - low;
        let ramp: [f32; Self::ROWS] =
            std::array::from_fn(|row| (top - span * (row as f64 + 0.5) / Self::ROWS as f64) as f32);
        let (values, _) = stored(look, Field::TopDown(&ramp));
        let image = range(look).with_buffer(values);
        stream.log_for(Holds::FromNow, &self.bar(), &image);

        let mut labels = Labels::default();
        let right = self.plot.x[1];
        for value in look.divisions() {
            let y = upper + h * (top - value) / span;
            let at = [right + 0.155 * w, y - HALF_LABEL * h];
            labels.add(at, &look.number(value));
        }
        labels.add([right + 0.09 * w, upper - TITLES * h], &look.title());
        if let Some(note) = look.note() {
            labels.add([right + 0.12 * w, self.plot.y[1] + 0.04 * h], &note);
        }
        labels.log(stream, &format!("{}/labels", self.entity), Holds::FromNow);
    }
}
