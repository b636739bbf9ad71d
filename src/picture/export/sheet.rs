//! What pages are drawn on: a screen's picture with title and state, one of a picture that moves, or what papers print:
//! sized in mm, in one size of type, without a title.

use crate::Picture;
use crate::draw::{Drawing, PT_PER_MM, PixelField, Rect, SizeUnit, Text, text_width};

/// How a picture is printed.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct PrintSize {
    /// Width of the whole picture, mm.
    pub width_mm: f64,
    /// Pixels of the field, per inch.
    pub dpi: f64,
    /// Size of type, points of 1/72".
    pub font_pt: f64,
}

impl Default for PrintSize {
    /// One column of a journal.
    fn default() -> Self {
        Self {
            width_mm: 85.0,
            dpi: 300.0,
            font_pt: 7.0,
        }
    }
}

/// What stands above a picture.
pub(super) struct Heading {
    pub(super) title: String,
    pub(super) state: String,
}

/// What a page is drawn on.
pub(super) struct Sheet {
    unit: SizeUnit,
    wide: f64,
    /// Size of type.
    font: f64,
    /// Pixels of a field along a unit.
    density: f64,
    heading: Option<Heading>,
}

impl Sheet {
    /// A picture of a screen.
    pub(super) fn still(heading: Heading) -> Self {
        Self::screen(900.0, heading)
    }

    /// One of a picture that moves, smaller where it is shared by runs.
    pub(super) fn moving(heading: Heading, shared: bool) -> Self {
        let screen = Self::screen(580.0, heading);
        if shared {
            let (wide, font) = (430.0, 12.0);
            return Self {
                wide,
                font,
                ..screen
            };
        }
        screen
    }

    fn screen(wide: f64, heading: Heading) -> Self {
        Self {
            unit: SizeUnit::Pixel,
            wide,
            font: 15.0,
            density: 1.0,
            heading: Some(heading),
        }
    }

    /// What papers print.
    pub(super) fn printed(print: &PrintSize) -> Self {
        Self {
            unit: SizeUnit::Point,
            wide: print.width_mm * PT_PER_MM,
            font: print.font_pt,
            density: print.dpi / 72.0,
            heading: None,
        }
    }

    /// A drawing with a plot of that height over its width, at whose right so many sizes of type are left.
    pub(super) fn begin(&self, right: f64, height: f64) -> (Drawing, Rect) {
        let em = self.font;
        let above = if self.heading.is_some() { 5.8 } else { 1.8 };
        let left = (5.0 * em).round();
        let wide = (self.wide - left - right * em).round();
        let plot = Rect {
            left,
            top: (above * em).round(),
            wide,
            high: (height * wide).clamp(6.0 * em, 4.0 * wide).round(),
        };
        let size = [self.wide, plot.bottom() + (4.2 * em).round()];
        let mut drawing = Drawing::new(self.unit, size, em);
        if let Some(heading) = &self.heading {
            // Smaller where it would be cut off.
            let fitted =
                |words: &str, size: f64| size.min((self.wide / em - 1.5) / text_width(words));
            let title = Text::new([em, 1.9 * em], &*heading.title);
            drawing.text(title.sized(fitted(&heading.title, 4.0 / 3.0)));
            let state = Text::new([em, 3.4 * em], &*heading.state);
            let state = state.sized(fitted(&heading.state, 1.0));
            drawing.text(state.coloured([90, 95, 105]));
        }
        (drawing, plot)
    }

    /// A field of the sheet's pixels over a plot; `paint` is told their number.
    pub(super) fn field(&self, plot: Rect, paint: impl FnOnce([u32; 2]) -> Vec<u8>) -> PixelField {
        let pixels = [plot.wide, plot.high].map(|side| (side * self.density).round().max(2.0));
        let pixels = pixels.map(|side| side as u32);
        PixelField {
            area: plot,
            pixels,
            rgb: paint(pixels),
        }
    }

    /// Height over width at which a picture is to scale.
    pub(super) fn height_to_scale(picture: &Picture) -> f64 {
        let [wide, high] = [picture.x, picture.y].map(|axis| {
            let [from, to] = axis.ends();
            to - from
        });
        high / wide
    }
}
