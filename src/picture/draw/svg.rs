//! Drawings as SVG.

use std::fmt::Write as _;

use base64::Engine as _;
use base64::prelude::BASE64_STANDARD;

use super::{Drawing, PT_PER_MM, Pen, Rgb, Shape, SizeUnit, Text, TextAnchor, png_of};

impl Drawing {
    /// As an SVG file.
    ///
    /// # Errors
    /// In words, when a field cannot be packed.
    pub(crate) fn svg(&self) -> Result<Vec<u8>, String> {
        let [wide, high] = self.size;
        let [width, height] = self.size.map(|side| match self.unit {
            SizeUnit::Pixel => format!("{side}"),
            SizeUnit::Point => format!("{:.2}mm", side / PT_PER_MM),
        });
        let mut svg = format!(
            "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"{width}\" height=\"{height}\" viewBox=\"0 0 {wide:.2} {high:.2}\">\n\
             <rect width=\"100%\" height=\"100%\" fill=\"white\"/>\n"
        );
        for field in &self.fields {
            let area = field.area;
            // Writing to a string cannot fail.
            let _ = writeln!(
                svg,
                "<image x=\"{:.2}\" y=\"{:.2}\" width=\"{:.2}\" height=\"{:.2}\" preserveAspectRatio=\"none\" \
                 href=\"data:image/png;base64,{}\"/>",
                area.left,
                area.top,
                area.wide,
                area.high,
                BASE64_STANDARD.encode(png_of(&field.rgb, field.pixels)?)
            );
        }
        for shape in &self.shapes {
            write_shape(&mut svg, shape);
        }
        for text in &self.texts {
            write_text(&mut svg, text, self.font * text.size);
        }
        svg.push_str("</svg>\n");
        Ok(svg.into_bytes())
    }
}

fn write_shape(svg: &mut String, shape: &Shape) {
    let points = shape.points.iter();
    let points: Vec<String> = points.map(|[x, y]| format!("{x:.2},{y:.2}")).collect();
    let (points, colour) = (points.join(" "), hex(shape.colour));
    // Writing to a string cannot fail.
    let _ = match shape.pen {
        Pen::Fill => writeln!(svg, "<polygon fill=\"{colour}\" points=\"{points}\"/>"),
        Pen::Line(width) => writeln!(
            svg,
            "<polyline fill=\"none\" stroke=\"{colour}\" stroke-width=\"{width}\" points=\"{points}\"/>"
        ),
    };
}

fn write_text(svg: &mut String, text: &Text, size: f64) {
    let [x, y] = text.at;
    let anchor = match text.anchor {
        TextAnchor::Start => "start",
        TextAnchor::Middle => "middle",
        TextAnchor::End => "end",
    };
    let turn = if text.is_turned {
        format!(" transform=\"rotate(-90 {x:.2} {y:.2})\"")
    } else {
        String::new()
    };
    // Writing to a string cannot fail.
    let _ = writeln!(
        svg,
        "<text x=\"{x:.2}\" y=\"{y:.2}\" font-family=\"DejaVu Sans, Arial, sans-serif\" font-size=\"{size:.2}\" \
         text-anchor=\"{anchor}\" fill=\"{}\"{turn}>{}</text>",
        hex(text.colour),
        escaped(&text.words)
    );
}

fn hex([r, g, b]: Rgb) -> String {
    format!("#{r:02x}{g:02x}{b:02x}")
}

fn escaped(text: &str) -> String {
    text.replace('&', "&amp;")
        .replace('<', "&lt;")
        .replace('>', "&gt;")
}
