//! Drawings as PDF: one page, one content stream, fields as images, and the letters that occur embedded with what they mean,
//! so that text can be searched and copied.

use std::collections::BTreeMap;

use ab_glyph::{Font as _, FontRef};
use miniz_oxide::deflate::compress_to_vec_zlib;
use pdf_writer::types::{CidFontType, FontFlags, SystemInfo, UnicodeCmap};
use pdf_writer::{Content, Filter, Finish as _, Name, Pdf, Rect, Ref, Str};
use subsetter::GlyphRemapper;

use super::{Drawing, Pen, PixelField, Rgb, Text, font, text_width};

const FONT: Name = Name(b"F");
const FONT_NAME: Name = Name(b"ASPERI+DejaVuSans");
/// Effort of packing, of 10.
const LEVEL: u8 = 6;

/// A letter of the page.
struct Letter {
    /// Its number in the embedded font.
    glyph: u16,
    /// Width over the size of type.
    advance: f64,
}

/// The letters of a page, and the font that holds them alone.
struct Letters {
    letters: BTreeMap<char, Letter>,
    remapper: GlyphRemapper,
}

impl Letters {
    fn of(font: &FontRef, texts: &[Text]) -> Self {
        let mut remapper = GlyphRemapper::new();
        let mut letters = BTreeMap::new();
        for letter in texts.iter().flat_map(|text| text.words.chars()) {
            let id = font.glyph_id(letter);
            letters.entry(letter).or_insert_with(|| Letter {
                glyph: remapper.remap(id.0),
                advance: font::advance(font, id),
            });
        }
        Self { letters, remapper }
    }

    /// A text's letters by their numbers, two bytes each.
    fn coded(&self, text: &str) -> Vec<u8> {
        let glyphs = text.chars().map(|letter| self.letters[&letter].glyph);
        glyphs.flat_map(u16::to_be_bytes).collect()
    }
}

/// Numbers of the file's objects.
struct Objects {
    next: i32,
}

impl Objects {
    fn take(&mut self) -> Ref {
        self.next += 1;
        Ref::new(self.next)
    }
}

impl Drawing {
    /// As a PDF file.
    ///
    /// # Errors
    /// In words, when the font cannot be read.
    pub(crate) fn pdf(&self) -> Result<Vec<u8>, String> {
        let font = font::font()?;
        let letters = Letters::of(font, &self.texts);
        let mut objects = Objects { next: 0 };
        let [catalog, pages, page, content, used_font] = std::array::from_fn(|_| objects.take());
        let images: Vec<(String, Ref)> = (0..self.fields.len())
            .map(|k| (format!("I{k}"), objects.take()))
            .collect();
        let mut pdf = Pdf::new();
        pdf.catalog(catalog).pages(pages);
        pdf.pages(pages).kids([page]).count(1);
        let [wide, high] = self.size.map(|side| side as f32);
        let mut on_page = pdf.page(page);
        on_page.media_box(Rect::new(0.0, 0.0, wide, high));
        on_page.parent(pages).contents(content);
        let mut resources = on_page.resources();
        resources.fonts().pair(FONT, used_font);
        let mut named = resources.x_objects();
        for (name, image) in &images {
            named.pair(Name(name.as_bytes()), *image);
        }
        named.finish();
        resources.finish();
        on_page.finish();
        let names = images.iter().map(|(name, _)| name.as_str());
        let packed = compress_to_vec_zlib(&self.content(&letters, names), LEVEL);
        pdf.stream(content, &packed).filter(Filter::FlateDecode);
        for (field, (_, image)) in self.fields.iter().zip(&images) {
            write_image(&mut pdf, *image, field);
        }
        write_font(&mut pdf, &mut objects, used_font, font, &letters)?;
        Ok(pdf.finish())
    }

    /// What is drawn; y upwards.
    fn content<'a>(&self, letters: &Letters, images: impl Iterator<Item = &'a str>) -> Vec<u8> {
        let mut out = Content::new();
        let place = |[x, y]: [f64; 2]| [x as f32, (self.size[1] - y) as f32];
        for (field, name) in self.fields.iter().zip(images) {
            let area = field.area;
            let [x, y] = place([area.left, area.bottom()]);
            out.save_state();
            out.transform([area.wide as f32, 0.0, 0.0, area.high as f32, x, y]);
            out.x_object(Name(name.as_bytes()));
            out.restore_state();
        }
        for shape in &self.shapes {
            let [r, g, b] = shares(shape.colour);
            for (k, &at) in shape.points.iter().enumerate() {
                let [x, y] = place(at);
                if k == 0 {
                    out.move_to(x, y);
                } else {
                    out.line_to(x, y);
                }
            }
            match shape.pen {
                Pen::Line(width) => {
                    out.set_line_width(width as f32);
                    out.set_stroke_rgb(r, g, b).stroke();
                }
                Pen::Fill => {
                    out.set_fill_rgb(r, g, b).fill_nonzero();
                }
            }
        }
        for text in &self.texts {
            let size = self.font * text.size;
            let before = text.anchor.share() * text_width(&text.words) * size;
            let ([x, y], before) = (place(text.at), before as f32);
            let matrix = if text.is_turned {
                [0.0, 1.0, -1.0, 0.0, x, y - before]
            } else {
                [1.0, 0.0, 0.0, 1.0, x - before, y]
            };
            let [r, g, b] = shares(text.colour);
            out.begin_text().set_fill_rgb(r, g, b);
            out.set_font(FONT, size as f32).set_text_matrix(matrix);
            out.show(Str(&letters.coded(&text.words))).end_text();
        }
        out.finish().into_vec()
    }
}

fn shares(colour: Rgb) -> [f32; 3] {
    colour.map(|value| f32::from(value) / 255.0)
}

fn write_image(pdf: &mut Pdf, id: Ref, field: &PixelField) {
    let packed = compress_to_vec_zlib(&field.rgb, LEVEL);
    let mut image = pdf.image_xobject(id, &packed);
    image.filter(Filter::FlateDecode);
    image.width(field.pixels[0] as i32);
    image.height(field.pixels[1] as i32);
    image.color_space().device_rgb();
    image.bits_per_component(8);
}

/// The font with the letters of the page: widths in thousandths of the size of type, the file, and the table back to text.
fn write_font(
    pdf: &mut Pdf,
    objects: &mut Objects,
    id: Ref,
    font: &FontRef,
    letters: &Letters,
) -> Result<(), String> {
    let system = SystemInfo {
        registry: Str(b"Adobe"),
        ordering: Str(b"Identity"),
        supplement: 0,
    };
    let [described, descriptor, meaning, file] = std::array::from_fn(|_| objects.take());
    pdf.type0_font(id)
        .base_font(FONT_NAME)
        .encoding_predefined(Name(b"Identity-H"))
        .descendant_font(described)
        .to_unicode(meaning);
    let mut cid = pdf.cid_font(described);
    cid.subtype(CidFontType::Type2).base_font(FONT_NAME);
    cid.system_info(system).font_descriptor(descriptor);
    cid.default_width(0.0);
    cid.cid_to_gid_map_predefined(Name(b"Identity"));
    let mut widths = cid.widths();
    for letter in letters.letters.values() {
        let width = (1e3 * letter.advance) as f32;
        widths.same(letter.glyph, letter.glyph, width);
    }
    widths.finish();
    cid.finish();
    let thousandths = |units: f32| (1e3 * f64::from(units) / font::units_per_em(font)) as f32;
    let ascent = thousandths(font.ascent_unscaled());
    let descent = thousandths(font.descent_unscaled());
    pdf.font_descriptor(descriptor)
        .name(FONT_NAME)
        .flags(FontFlags::SYMBOLIC)
        .bbox(Rect::new(-1021.0, descent, 1793.0, ascent))
        .italic_angle(0.0)
        .ascent(ascent)
        .descent(descent)
        .cap_height(729.0)
        .stem_v(80.0)
        .font_file2(file);
    let mut table = UnicodeCmap::new(Name(b"Letters"), system);
    for (letter, coded) in &letters.letters {
        table.pair(coded.glyph, *letter);
    }
    pdf.cmap(meaning, &table.finish());
    let subset = subsetter::subset(font::file(), 0, &letters.remapper);
    let subset = subset.map_err(|error| error.to_string())?;
    let packed = compress_to_vec_zlib(&subset, LEVEL);
    let length = subset.len() as i32;
    pdf.stream(file, &packed)
        .filter(Filter::FlateDecode)
        .pair(Name(b"Length1"), length);
    Ok(())
}

#[cfg(test)]
mod tests {
    #![expect(clippy::unwrap_used, reason = "tests")]
    use super::super::SizeUnit;
    use super::*;

    #[test]
    fn the_file_is_whole_and_holds_the_letters_that_occur() {
        let mut drawing = Drawing::new(SizeUnit::Point, [100.0, 50.0], 7.0);
        drawing.text(Text::new([10.0, 10.0], "film h, µm"));
        let pdf = drawing.pdf().unwrap();
        assert!(pdf.starts_with(b"%PDF-1.7") && pdf.ends_with(b"%%EOF"));
        assert!(
            pdf.len() < 20_000,
            "the font's letters alone: {}",
            pdf.len()
        );
        // Each letter's meaning stands in the table.
        let text = String::from_utf8_lossy(&pdf);
        assert!(
            text.contains("<00B5>") && text.contains("/DejaVuSans") || text.contains("+DejaVuSans")
        );
    }
}
