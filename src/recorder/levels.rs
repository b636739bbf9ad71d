//! What a picture holds that is never negative: whole multiples of a level, as a PNG of one channel.
//!
//! A PNG takes a fourth of what half precision does, because neighbours differ by little. A level is a power of two of the
//! unit, so that reading and writing again changes nothing: the smallest with which the range, and all that a frame
//! has above it, fits into thirteen bits (film: fifteen, and at most twice its range: the oil outside of a contact is a hundred
//! times thicker than within). The viewer is told the levels per unit as it is told those of a depth camera.

use asperity_picture::Look;

use super::picture::{Beyond, Field, top};

/// Levels that a picture has.
const LEVELS: f32 = 8191.0;
/// Levels of the film, and how far it is stored, over its range.
const FILM_LEVELS: f32 = 32_767.0;
const FILM_STORED: f32 = 2.0;

/// A picture in levels.
pub(crate) struct Levelled {
    pub(crate) png: Vec<u8>,
    /// Levels of one unit.
    pub(crate) per_unit: f32,
    /// What of it lies above the range.
    pub(crate) beyond: Beyond,
}

/// SI values in a look's unit, rows of so many columns.
///
/// # Errors
/// What the encoder says.
pub(crate) fn levelled(look: &Look, field: Field, columns: usize) -> Result<Levelled, String> {
    let (factor, top) = (look.unit.per_si as f32, top(look) as f32);
    let mut values: Vec<f32> = Vec::new();
    let mut beyond = Beyond::default();
    field.write_to(&mut values, |row, out| {
        beyond.add(scale_row(row, factor, top, out));
    });
    let (levels, most) = if look.marks_contact {
        (FILM_LEVELS, FILM_STORED * top)
    } else {
        (LEVELS, beyond.maximum.max(top))
    };
    // An infinite value is stored as the greatest level.
    let most = if most.is_finite() { most } else { top };
    let per_unit = (levels / most).log2().floor().exp2();
    let mut bytes = vec![0; 2 * values.len()];
    level_row(&values, per_unit, levels, &mut bytes);
    let rows = values.len() / columns.max(1);
    Ok(Levelled {
        png: png_of(&bytes, [columns as u32, rows as u32])?,
        per_unit,
        beyond,
    })
}

dispatched! {
    /// Values in the unit; how many are above `top`, and the bits of the maximum. Whatever is no number or negative is 0.
    fn scale_row(row: &[f32], factor: f32, top: f32, out: &mut [f32]) -> (u32, u32) {
        let (mut above, mut maximum) = (0, 0);
        for (out, value) in out.iter_mut().zip(row) {
            *out = value * factor;
            let bits = out.to_bits() & 0x7fff_ffff;
            above += u32::from(bits > top.to_bits());
            maximum = if bits > maximum { bits } else { maximum };
        }
        (above, maximum)
    }
}

dispatched! {
    /// The nearest level of each, in the order of bytes that a PNG has.
    fn level_row(values: &[f32], per_unit: f32, levels: f32, bytes: &mut [u8]) {
        for (out, value) in bytes.chunks_exact_mut(2).zip(values) {
            let level = (value * per_unit + 0.5).max(0.0).min(levels) as u16;
            out.copy_from_slice(&level.to_be_bytes());
        }
    }
}

fn png_of(bytes: &[u8], [wide, tall]: [u32; 2]) -> Result<Vec<u8>, String> {
    let mut out = Vec::new();
    let mut encoder = png::Encoder::new(&mut out, wide, tall);
    encoder.set_color(png::ColorType::Grayscale);
    encoder.set_depth(png::BitDepth::Sixteen);
    let written = encoder.write_header().and_then(|mut writer| {
        writer
            .write_image_data(bytes)
            .and_then(|()| writer.finish())
    });
    written.map_err(|error| error.to_string())?;
    Ok(out)
}

/// The values of a picture in its unit, row by row as it has them; `None`: it is none of ours, or has not so many.
pub(crate) fn values_of(png: &[u8], per_unit: f32, count: usize) -> Option<Vec<f32>> {
    let mut reader = png::Decoder::new(std::io::Cursor::new(png))
        .read_info()
        .ok()?;
    let info = reader.info();
    let is_ours = info.color_type == png::ColorType::Grayscale
        && info.bit_depth == png::BitDepth::Sixteen
        && u64::from(info.width) * u64::from(info.height) == count as u64;
    let can_divide = per_unit > 0.0 && per_unit.is_finite();
    if !(is_ours && can_divide) {
        return None;
    }
    let mut bytes = vec![0; 2 * count];
    reader.next_frame(&mut bytes).ok()?;
    let levels = bytes
        .chunks_exact(2)
        .map(|two| u16::from_be_bytes([two[0], two[1]]));
    Some(levels.map(|level| f32::from(level) / per_unit).collect())
}

#[cfg(test)]
mod tests {
    use super::*;
    use asperity_engine::math::number::{GPA, UM, Unit};
    use asperity_picture::Ramp;

    fn look(unit: Unit, top: f64) -> Look {
        Look::up_to("p", unit, top, Ramp::Inferno)
    }

    fn back(look: &Look, values: &[f32], columns: usize) -> (Vec<f32>, Levelled) {
        let levelled = levelled(look, Field::TopDown(values), columns).expect("a picture");
        let values = values_of(&levelled.png, levelled.per_unit, values.len());
        (values.expect("values"), levelled)
    }

    #[test]
    fn values_come_back_to_half_a_level_and_again_to_the_bit() {
        let look = look(GPA, 3e9);
        let values: Vec<f32> = (0..6000_u16).map(|k| 5e5 * f32::from(k)).collect();
        let (first, levelled) = back(&look, &values, 100);
        assert_eq!(levelled.per_unit, 2048.0, "3 GPa in 8191 levels");
        assert_eq!(
            levelled.beyond,
            Beyond {
                above: 0,
                maximum: 2.9995
            }
        );
        for (back, value) in first.iter().zip(&values) {
            assert!(
                (back - value * 1e-9).abs() <= 0.5001 / 2048.0,
                "{value}: {back}"
            );
        }
        let si: Vec<f32> = first.iter().map(|value| value * 1e9).collect();
        assert_eq!(back(&look, &si, 100).0, first);
    }

    #[test]
    fn what_is_above_the_range_makes_levels_coarser_and_film_ends_at_twice_its_range() {
        let (values, pressure) = back(&look(GPA, 1e9), &[0.5e9, 7e9, -1.0, 0.0], 2);
        assert_eq!(
            pressure.beyond,
            Beyond {
                above: 1,
                maximum: 7.0
            }
        );
        assert_eq!(
            (values, pressure.per_unit),
            (vec![0.5, 7.0, 0.0, 0.0], 1024.0)
        );
        let film = Look {
            marks_contact: true,
            ..look(UM, 1e-6)
        };
        let (values, film) = back(&film, &[5e-9, 50e-6], 1);
        assert_eq!(film.per_unit, 8192.0);
        assert!((values[0] - 0.005).abs() < 6.2e-5 && (values[1] - 4.0).abs() < 1e-3);
        assert_eq!(film.beyond.above, 1);
        let (values, _) = back(&look(GPA, 1e9), &[f32::INFINITY, f32::NAN], 2);
        assert_eq!(values, [8191.0 / 4096.0, 0.0]);
    }

    #[test]
    fn what_is_no_picture_of_ours_is_none() {
        assert_eq!(values_of(b"no picture", 1.0, 1), None);
        let (_, levelled) = back(&look(GPA, 1e9), &[1e9; 6], 3);
        assert!(values_of(&levelled.png, 4096.0, 6).is_some());
        assert_eq!(values_of(&levelled.png, 4096.0, 5), None);
        assert_eq!(values_of(&levelled.png, f32::NAN, 6), None);
        assert_eq!(values_of(&levelled.png[..60], 4096.0, 6), None);
    }
}
