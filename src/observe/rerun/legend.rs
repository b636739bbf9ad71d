//! Colour bars: images of the same colours and range as the picture beside them, so that they cannot differ from it.

use rerun::ChannelDatatype;
use rerun::components::ImageFormat;

use super::colour::WHITE;
use super::picture::{Pixels, Scale, Sign, log_styled, range, styled};
use super::plot::{HALF_LABEL, Labels, PlotBox, TITLES};
use super::stream::{Holds, Stream};
use crate::observe::ObserveError;
use crate::observe::scales::{divisions, number};

/// The colour bar of a picture.
#[derive(Debug, Clone)]
pub(super) struct Legend {
    entity: String,
    title: String,
    /// The plot beside which it stands.
    plot: PlotBox,
}

impl Legend {
    const ROWS: usize = 128;

    /// Logs what stays: the bar's place, format and colours.
    pub(super) fn new(
        stream: &Stream,
        entity: String,
        scale: &Scale,
        plot: &PlotBox,
        title: &str,
    ) -> Result<Self, ObserveError> {
        let legend = Self {
            entity,
            title: title.to_owned(),
            plot: plot.clone(),
        };
        let (w, height) = (legend.width(), legend.height() / Self::ROWS as f64);
        let wide = 0.035 * w;
        let pixels = Pixels {
            columns: 1,
            rows: Self::ROWS,
            first: [plot.x[1] + 0.04 * w + 0.5 * wide, plot.y[0] + 0.5 * height],
            size: [wide, height],
        };
        let format = ImageFormat::depth(pixels.resolution(), ChannelDatatype::F16);
        let image = styled(scale).with_format(format);
        log_styled(stream, &legend.bar(), &image, &pixels)?;
        Ok(legend)
    }

    fn width(&self) -> f64 {
        self.plot.x[1] - self.plot.x[0]
    }

    fn height(&self) -> f64 {
        self.plot.y[1] - self.plot.y[0]
    }

    fn bar(&self) -> String {
        format!("{}/bar", self.entity)
    }

    /// Logs the range: the bar's values and the numbers beside it.
    pub(super) fn log(&self, stream: &Stream, scale: &Scale) -> Result<(), ObserveError> {
        let (w, h, upper) = (self.width(), self.height(), self.plot.y[0]);
        let span = scale.top - scale.low();
        let ramp: [f32; Self::ROWS] = std::array::from_fn(|row| {
            let value = scale.top - span * (row as f64 + 0.5) / Self::ROWS as f64;
            (value / scale.per_si) as f32
        });
        let image = range(scale).with_buffer(scale.stored(&ramp).0);
        stream.log(&self.bar(), &image)?;

        let mut labels = Labels::default();
        let values = match scale.sign {
            Sign::Positive => divisions(scale.top),
            Sign::Both => [-1.0, -0.5, 0.0, 0.5, 1.0].map(|t| t * scale.top).to_vec(),
        };
        let right = self.plot.x[1];
        for value in values {
            let y = upper + h * (scale.top - value) / span;
            let text = if (value - scale.top).abs() < 1e-9 * span {
                format!("≥{}", number(value))
            } else {
                number(value)
            };
            labels.add([right + 0.155 * w, y - HALF_LABEL * h], &text, WHITE);
        }
        labels.add([right + 0.09 * w, upper - TITLES * h], &self.title, WHITE);
        labels.log_that(stream, &format!("{}/labels", self.entity), Holds::FromNow)
    }
}
