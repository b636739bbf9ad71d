//! Pages as PDF 1.4: one page, one content stream, fields as images.

use std::fmt::Write as _;

use ab_glyph::{Font as _, FontRef, OutlineCurve, Point};

use crate::chart::png_of;

use super::{Paper, PaperText, TextAnchor};

impl Paper {
    /// The page.
    ///
    /// # Errors
    /// In words, when the font cannot be read or a field cannot be packed.
    pub(in super::super) fn pdf(&self) -> Result<Vec<u8>, String> {
        let font =
            FontRef::try_from_slice(dejavu::sans::regular()).map_err(|error| error.to_string())?;
        let [wide, high] = self.size;
        let mut objects = vec![
            b"<< /Type /Catalog /Pages 2 0 R >>".to_vec(),
            b"<< /Type /Pages /Kids [3 0 R] /Count 1 >>".to_vec(),
        ];
        let names: Vec<String> = (0..self.fields.len())
            .map(|k| format!("/F{k} {} 0 R", k + 5))
            .collect();
        let names = names.join(" ");
        objects.push(
            format!(
                "<< /Type /Page /Parent 2 0 R /MediaBox [0 0 {wide:.2} {high:.2}] /Contents 4 0 R \
                 /Resources << /XObject << {names} >> >> >>"
            )
            .into_bytes(),
        );
        objects.push(stream("", self.content(&font).as_bytes()));
        for field in &self.fields {
            let [columns, rows] = field.pixels;
            let head = format!(
                "/Type /XObject /Subtype /Image /Width {columns} /Height {rows} /ColorSpace /DeviceRGB \
                 /BitsPerComponent 8 /Filter /FlateDecode /DecodeParms << /Predictor 15 /Colors 3 /Columns {columns} >> "
            );
            objects.push(stream(
                &head,
                &packed(&png_of(&field.rgb, field.pixels.into())?),
            ));
        }
        Ok(file(&objects))
    }

    /// What is drawn, in an order in which text comes last.
    fn content(&self, font: &FontRef) -> String {
        let high = self.size[1];
        let mut out = String::new();
        // Writing to a string cannot fail.
        for (k, field) in self.fields.iter().enumerate() {
            let ([x, y], [w, h]) = (field.at, field.size);
            let _ = writeln!(
                out,
                "q {w:.3} 0 0 {h:.3} {x:.3} {:.3} cm /F{k} Do Q",
                high - y - h
            );
        }
        for stroke in &self.strokes {
            let [r, g, b] = shares(stroke.colour);
            for (k, [x, y]) in stroke.points.iter().enumerate() {
                let _ = write!(
                    out,
                    "{x:.3} {:.3} {} ",
                    high - y,
                    if k == 0 { "m" } else { "l" }
                );
            }
            let _ = match stroke.width {
                Some(width) => writeln!(out, "{width} w {r:.3} {g:.3} {b:.3} RG S"),
                None => writeln!(out, "{r:.3} {g:.3} {b:.3} rg f"),
            };
        }
        for text in &self.texts {
            self.write_text(font, text, &mut out);
        }
        out
    }

    /// A text as the outlines of its letters.
    fn write_text(&self, font: &FontRef, text: &PaperText, out: &mut String) {
        let scale = f64::from(font.units_per_em().unwrap_or(2048.0)).recip() * self.font_pt;
        let glyphs = || text.text.chars().map(|letter| font.glyph_id(letter));
        let wide: f64 = glyphs()
            .map(|id| f64::from(font.h_advance_unscaled(id)) * scale)
            .sum();
        let mut along = match text.anchor {
            TextAnchor::Start => 0.0,
            TextAnchor::Middle => -0.5 * wide,
            TextAnchor::End => -wide,
        };
        let ([x, y], [r, g, b]) = (text.at, shares(text.colour));
        let turn = if text.turned { "0 1 -1 0" } else { "1 0 0 1" };
        let _ = writeln!(
            out,
            "q {turn} {x:.3} {:.3} cm {r:.3} {g:.3} {b:.3} rg",
            self.size[1] - y
        );
        for id in glyphs() {
            if let Some(outline) = font.outline(id) {
                let at = |point: Point| {
                    [
                        along + f64::from(point.x) * scale,
                        f64::from(point.y) * scale,
                    ]
                };
                write_outline(&outline.curves, at, out);
            }
            along += f64::from(font.h_advance_unscaled(id)) * scale;
        }
        out.push_str("f Q\n");
    }
}

/// Curves one after another; each that does not go on where the last ended begins anew.
fn write_outline(curves: &[OutlineCurve], at: impl Fn(Point) -> [f64; 2], out: &mut String) {
    let mut last = None;
    for curve in curves {
        let (from, points) = match *curve {
            OutlineCurve::Line(from, to) => (from, vec![to]),
            OutlineCurve::Quad(from, by, to) => {
                // The cubic that is the same curve.
                let near = |end: Point| Point {
                    x: end.x + 2.0 / 3.0 * (by.x - end.x),
                    y: end.y + 2.0 / 3.0 * (by.y - end.y),
                };
                (from, vec![near(from), near(to), to])
            }
            OutlineCurve::Cubic(from, one, two, to) => (from, vec![one, two, to]),
        };
        if last != Some(from) {
            let [x, y] = at(from);
            let _ = write!(out, "{x:.3} {y:.3} m ");
        }
        last = points.last().copied();
        for point in &points {
            let [x, y] = at(*point);
            let _ = write!(out, "{x:.3} {y:.3} ");
        }
        out.push_str(if points.len() == 1 { "l " } else { "c " });
    }
}

fn shares(colour: [u8; 3]) -> [f64; 3] {
    colour.map(|value| f64::from(value) / 255.0)
}

fn stream(head: &str, bytes: &[u8]) -> Vec<u8> {
    let mut object = format!("<< {head}/Length {} >>\nstream\n", bytes.len()).into_bytes();
    object.extend_from_slice(bytes);
    object.extend_from_slice(b"\nendstream");
    object
}

/// The packed rows of a PNG: PDF unpacks the same.
fn packed(png: &[u8]) -> Vec<u8> {
    let (mut rest, mut data) = (png.get(8..).unwrap_or_default(), Vec::new());
    while let [a, b, c, d, kind @ ..] = rest {
        let length = u32::from_be_bytes([*a, *b, *c, *d]) as usize;
        let (Some(name), Some(body)) = (kind.get(..4), kind.get(4..4 + length)) else {
            break;
        };
        if name == b"IDAT" {
            data.extend_from_slice(body);
        }
        rest = kind.get(8 + length..).unwrap_or_default();
    }
    data
}

/// Objects with the table of where they are.
fn file(objects: &[Vec<u8>]) -> Vec<u8> {
    let mut out = b"%PDF-1.4\n%\xe2\xe3\xcf\xd3\n".to_vec();
    let mut table = format!("xref\n0 {}\n0000000000 65535 f \n", objects.len() + 1);
    for (k, object) in objects.iter().enumerate() {
        let _ = writeln!(table, "{:010} 00000 n ", out.len());
        out.extend_from_slice(format!("{} 0 obj\n", k + 1).as_bytes());
        out.extend_from_slice(object);
        out.extend_from_slice(b"\nendobj\n");
    }
    let start = out.len();
    let size = objects.len() + 1;
    out.extend_from_slice(table.as_bytes());
    out.extend_from_slice(
        format!("trailer\n<< /Size {size} /Root 1 0 R >>\nstartxref\n{start}\n%%EOF\n").as_bytes(),
    );
    out
}
