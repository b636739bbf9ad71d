//! Pages as SVG.

use std::fmt::Write as _;

use crate::chart::png_of;

use super::{PT_PER_MM, Paper, TextAnchor};

impl Paper {
    /// The page.
    ///
    /// # Errors
    /// In words, when a field cannot be packed.
    pub(in super::super) fn svg(&self) -> Result<String, String> {
        let [wide, high] = self.size;
        let mut svg = String::new();
        // Writing to a string cannot fail.
        let _ = writeln!(
            svg,
            "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"{:.2}mm\" height=\"{:.2}mm\" viewBox=\"0 0 {wide:.2} {high:.2}\">\n\
             <rect width=\"100%\" height=\"100%\" fill=\"white\"/>",
            wide / PT_PER_MM,
            high / PT_PER_MM,
        );
        for field in &self.fields {
            let ([x, y], [w, h]) = (field.at, field.size);
            let _ = writeln!(
                svg,
                "<image x=\"{x:.2}\" y=\"{y:.2}\" width=\"{w:.2}\" height=\"{h:.2}\" preserveAspectRatio=\"none\" \
                 href=\"data:image/png;base64,{}\"/>",
                base64(&png_of(&field.rgb, field.pixels.into())?)
            );
        }
        for stroke in &self.strokes {
            let points: Vec<String> = stroke
                .points
                .iter()
                .map(|[x, y]| format!("{x:.2},{y:.2}"))
                .collect();
            let colour = colour(stroke.colour);
            let look = match stroke.width {
                Some(width) => {
                    format!("fill=\"none\" stroke=\"{colour}\" stroke-width=\"{width}\"")
                }
                None => format!("fill=\"{colour}\""),
            };
            let _ = writeln!(svg, "<polyline {look} points=\"{}\"/>", points.join(" "));
        }
        for text in &self.texts {
            let [x, y] = text.at;
            let anchor = match text.anchor {
                TextAnchor::Start => "start",
                TextAnchor::Middle => "middle",
                TextAnchor::End => "end",
            };
            let turn = if text.turned {
                format!(" transform=\"rotate(-90 {x:.2} {y:.2})\"")
            } else {
                String::new()
            };
            let _ = writeln!(
                svg,
                "<text x=\"{x:.2}\" y=\"{y:.2}\" font-family=\"DejaVu Sans, Arial, sans-serif\" font-size=\"{}\" \
                 text-anchor=\"{anchor}\" fill=\"{}\"{turn}>{}</text>",
                self.font_pt,
                colour(text.colour),
                escaped(&text.text)
            );
        }
        svg.push_str("</svg>\n");
        Ok(svg)
    }
}

fn colour([r, g, b]: [u8; 3]) -> String {
    format!("#{r:02x}{g:02x}{b:02x}")
}

fn escaped(text: &str) -> String {
    text.replace('&', "&amp;")
        .replace('<', "&lt;")
        .replace('>', "&gt;")
}

/// RFC 4648.
fn base64(bytes: &[u8]) -> String {
    const LETTERS: &[u8; 64] = b"ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    let mut text = String::with_capacity(bytes.len().div_ceil(3) * 4);
    for three in bytes.chunks(3) {
        let all = three
            .iter()
            .fold(0_u32, |all, &byte| all << 8 | u32::from(byte))
            << (8 * (3 - three.len()));
        for k in 0..4 {
            let letter = LETTERS[(all >> (18 - 6 * k)) as usize & 63];
            text.push(if k <= three.len() {
                char::from(letter)
            } else {
                '='
            });
        }
    }
    text
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn base64_is_that_of_the_rfc() {
        let cases = [
            ("", ""),
            ("f", "Zg=="),
            ("fo", "Zm8="),
            ("foo", "Zm9v"),
            ("foobar", "Zm9vYmFy"),
        ];
        for (plain, coded) in cases {
            assert_eq!(base64(plain.as_bytes()), coded);
        }
    }
}
