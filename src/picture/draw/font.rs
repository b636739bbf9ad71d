//! The font of all drawings, which is part of the program.

use std::sync::LazyLock;

use ab_glyph::{Font as _, FontRef, GlyphId};

/// The file.
pub(super) fn file() -> &'static [u8] {
    dejavu::sans::regular()
}

/// The font, read once; a test reads it.
///
/// # Errors
/// When it cannot be read.
pub(super) fn font() -> Result<&'static FontRef<'static>, String> {
    static FONT: LazyLock<Option<FontRef<'static>>> =
        LazyLock::new(|| FontRef::try_from_slice(file()).ok());
    FONT.as_ref()
        .ok_or_else(|| "the font of the pictures cannot be read".to_owned())
}

/// Units of the font in its size of type.
pub(super) fn units_per_em(font: &FontRef) -> f64 {
    f64::from(font.units_per_em().unwrap_or(2048.0))
}

/// Width of a letter over the size of type.
pub(super) fn advance(font: &FontRef, glyph: GlyphId) -> f64 {
    f64::from(font.h_advance_unscaled(glyph)) / units_per_em(font)
}

/// Width of a text over the size of type; 0 without a font.
pub(crate) fn text_width(text: &str) -> f64 {
    let Ok(font) = font() else {
        return 0.0;
    };
    let glyphs = text.chars().map(|letter| font.glyph_id(letter));
    glyphs.map(|glyph| advance(font, glyph)).sum()
}

#[cfg(test)]
mod tests {
    #[test]
    fn the_font_is_read_and_has_the_letters_of_our_units() {
        assert!(super::font().is_ok());
        let [narrow, wide] = ["il", "σµ≥"].map(super::text_width);
        assert!(0.3 < narrow && narrow < wide && wide < 3.0);
    }
}
