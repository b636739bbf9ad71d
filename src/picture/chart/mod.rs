//! Charts on white, as SVG and PNG: curves over linear or logarithmic axes, maps of coloured cells. Sweeps and
//! studies draw them.

mod cells;
mod curves;
mod scale;

use std::path::Path;

use crate::draw::{Axis, Drawing, INK, Rect, SizeUnit, Text};

pub use cells::HeatMap;
pub use curves::{Curve, Figure, Mark};
pub use scale::Scale;

/// Pixels of a chart.
const SIZE: [f64; 2] = [900.0, 600.0];
/// Size of type, pixels.
const TYPE: f64 = 15.0;

/// What can be drawn.
pub trait Chart {
    /// As SVG; `None`: there is nothing to draw.
    ///
    /// # Errors
    /// In words, when a picture in it cannot be packed.
    fn svg(&self) -> Result<Option<String>, String>;

    /// Writes a PNG, and says whether there was something to draw.
    ///
    /// # Errors
    /// What the disk or the encoder says.
    fn png(&self, path: &Path) -> Result<bool, String>;
}

/// What lays itself out.
trait Layout {
    /// `None`: no value has a place on the axes.
    fn drawing(&self) -> Option<Drawing>;
}

impl<C: Layout> Chart for C {
    fn svg(&self) -> Result<Option<String>, String> {
        let bytes = self.drawing().map(|drawing| drawing.svg()).transpose()?;
        Ok(bytes.map(|bytes| String::from_utf8_lossy(&bytes).into_owned()))
    }

    fn png(&self, path: &Path) -> Result<bool, String> {
        let Some(drawing) = self.drawing() else {
            return Ok(false);
        };
        std::fs::write(path, drawing.png()?).map_err(|error| error.to_string())?;
        Ok(true)
    }
}

/// An empty chart with its title, and its plot, at whose left the numbers of the upright axis have room beside its title, and
/// at whose right so many sizes of type are left.
fn titled(title: &str, upright: &Axis, right: f64) -> (Drawing, Rect) {
    /// For numbers of up to five characters, and what each one more takes, in sizes of type.
    const LEFT: f64 = 78.0;
    const CHARACTER: f64 = 0.6;
    let mut drawing = Drawing::new(SizeUnit::Pixel, SIZE, TYPE);
    let [wide, high] = SIZE;
    let labels = upright.labels.iter();
    let longest = labels.map(|(_, label)| label.chars().count()).max();
    let more = longest.unwrap_or(0).saturating_sub(5) as f64 * CHARACTER;
    let left = LEFT + (more * TYPE).round();
    let plot = Rect {
        left,
        top: 52.0,
        wide: wide - left - (right * TYPE).round(),
        high: high - 52.0 - 66.0,
    };
    let at = [plot.left, 26.0];
    drawing.text(Text::new(at, title).sized(1.2));
    (drawing, plot)
}

/// An axis of places with marks at round numbers.
fn axis(scale: Scale, ends: [f64; 2], title: &str) -> Axis<'_> {
    let marks = scale.marks(ends[0], ends[1]).into_iter();
    Axis {
        ends,
        title,
        colour: INK,
        labels: marks.map(|at| (at, scale.label(at))).collect(),
    }
}
