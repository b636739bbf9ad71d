//! Charts on white, as SVG and PNG: curves over linear or logarithmic axes, maps of coloured cells. Sweeps and
//! studies draw them; the pictures of steps share the font.

mod cells;
mod curves;
mod scale;

use std::path::Path;
use std::sync::OnceLock;

use plotters::coord::Shift;
use plotters::prelude::*;
use plotters::style::register_font;

pub use cells::HeatMap;
pub use curves::{Corner, Curve, Figure, Mark};
pub use scale::Scale;

/// The font of all pictures, which is part of the program.
pub const FONT: &str = "sans-serif";
/// Pixels of a chart.
const SIZE: (u32, u32) = (900, 600);
/// What the axes' titles and numbers take, pixels.
const BELOW: u32 = 48;
/// Same on the left.
const BESIDE: u32 = 76;

/// Makes [`FONT`] known to the drawing library, once.
///
/// # Errors
/// When the font cannot be read.
pub fn font() -> Result<(), String> {
    static READ: OnceLock<bool> = OnceLock::new();
    let read = READ
        .get_or_init(|| register_font(FONT, FontStyle::Normal, dejavu::sans::regular()).is_ok());
    if *read {
        Ok(())
    } else {
        Err("the font of the pictures cannot be read".to_owned())
    }
}

/// Pixels of three bytes as PNG.
///
/// # Errors
/// What the encoder says.
pub fn png_of(pixels: &[u8], (wide, tall): (u32, u32)) -> Result<Vec<u8>, String> {
    let mut bytes = Vec::new();
    let mut encoder = png::Encoder::new(&mut bytes, wide, tall);
    encoder.set_color(png::ColorType::Rgb);
    encoder.set_depth(png::BitDepth::Eight);
    let written = encoder.write_header().and_then(|mut writer| {
        writer
            .write_image_data(pixels)
            .and_then(|()| writer.finish())
    });
    written.map_err(|error| error.to_string())?;
    Ok(bytes)
}

/// Whether there was something to draw.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Drawn {
    /// There was.
    Something,
    /// No value has a place on the axes.
    Nothing,
}

/// What can be drawn on any kind of area.
pub trait Chart {
    /// Draws on an area of [`SIZE`].
    ///
    /// # Errors
    /// What the drawing library says.
    fn draw<DB: DrawingBackend>(&self, area: &DrawingArea<DB, Shift>) -> Result<Drawn, String>;

    /// As SVG; `None`: there is nothing to draw.
    ///
    /// # Errors
    /// What the drawing library says.
    fn svg(&self) -> Result<Option<String>, String> {
        let mut text = String::new();
        let drawn = self.on(&SVGBackend::with_string(&mut text, SIZE).into_drawing_area())?;
        Ok((drawn == Drawn::Something).then_some(text))
    }

    /// Writes a PNG; the path must end in `.png`.
    ///
    /// # Errors
    /// What the drawing library says, a full disk included.
    fn png(&self, path: &Path) -> Result<Drawn, String> {
        let mut pixels = vec![0; 3 * (SIZE.0 * SIZE.1) as usize];
        let area = BitMapBackend::with_buffer(&mut pixels, SIZE).into_drawing_area();
        let drawn = self.on(&area)?;
        drop(area);
        std::fs::write(path, png_of(&pixels, SIZE)?).map_err(|error| error.to_string())?;
        Ok(drawn)
    }

    /// Draws and finishes.
    ///
    /// # Errors
    /// What the drawing library says.
    fn on<DB: DrawingBackend>(&self, area: &DrawingArea<DB, Shift>) -> Result<Drawn, String> {
        font()?;
        area.fill(&WHITE).map_err(told)?;
        let drawn = self.draw(area)?;
        area.present().map_err(told)?;
        Ok(drawn)
    }
}

/// The library's error in words.
#[expect(
    clippy::needless_pass_by_value,
    reason = "called by Result::map_err, which gives it away"
)]
fn told<E: std::error::Error + Send + Sync>(error: DrawingAreaErrorKind<E>) -> String {
    error.to_string()
}
