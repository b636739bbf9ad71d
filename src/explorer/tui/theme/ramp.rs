//! Colour maps on 256 colours or on none.

use asperity_picture::Ramp;

/// The maps chosen from the 256 colours by hand: the nearest ones would mix in greys.
const FIRE_INDEXED: [u8; 13] = [17, 53, 54, 90, 126, 162, 168, 203, 208, 214, 220, 227, 230];
const VIRIDIS_INDEXED: [u8; 13] = [53, 54, 60, 24, 30, 36, 35, 71, 77, 113, 149, 184, 226];
const DIVERGING_INDEXED: [u8; 11] = [51, 38, 31, 24, 23, 238, 58, 94, 136, 178, 226];
/// Characters of growing ink, one step each.
const INK: [&str; 10] = [" ", ".", ":", "-", "=", "+", "*", "#", "%", "@"];

/// A character of growing ink, `t` from 0 to 1.
pub(super) fn ink(t: f32) -> &'static str {
    let last = INK.len() - 1;
    INK[((t.clamp(0.0, 1.0) * last as f32).round() as usize).min(last)]
}

pub(super) fn map_index(ramp: Ramp, t: f32) -> u8 {
    let steps: &[u8] = match ramp {
        Ramp::Inferno | Ramp::Magma => &FIRE_INDEXED,
        Ramp::Viridis => &VIRIDIS_INDEXED,
        Ramp::Diverging => &DIVERGING_INDEXED,
    };
    let last = steps.len() - 1;
    // A NaN becomes the first step.
    let place = (t.clamp(0.0, 1.0) * last as f32).round() as usize;
    steps[place.min(last)]
}

/// The nearest of the 6x6x6 cube and the 24 greys of the 256-colour palette.
pub(super) fn nearest_index([r, g, b]: [u8; 3]) -> u8 {
    const LEVELS: [i32; 6] = [0, 95, 135, 175, 215, 255];
    let nearest = |value: u8| -> usize {
        let value = i32::from(value);
        (0..6)
            .min_by_key(|&i| (LEVELS[i] - value).abs())
            .unwrap_or(0)
    };
    let distance = |candidate: [i32; 3]| -> i32 {
        let want = [i32::from(r), i32::from(g), i32::from(b)];
        (0..3).map(|k| (candidate[k] - want[k]).pow(2)).sum()
    };
    let (i, j, k) = (nearest(r), nearest(g), nearest(b));
    let cube = distance([LEVELS[i], LEVELS[j], LEVELS[k]]);
    let mean = (i32::from(r) + i32::from(g) + i32::from(b)) / 3;
    let step = ((mean - 3) / 10).clamp(0, 23);
    let grey = 8 + 10 * step;
    if distance([grey, grey, grey]) < cube {
        (232 + step) as u8
    } else {
        (16 + 36 * i + 6 * j + k) as u8
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn out_of_range_and_nan_stay_in_the_map() {
        assert_eq!(map_index(Ramp::Inferno, -3.0), 17);
        assert_eq!(map_index(Ramp::Inferno, 9.0), 230);
        assert_eq!(map_index(Ramp::Inferno, f32::NAN), 17);
        assert_eq!(ink(f32::NAN), " ");
        assert_eq!(ink(2.0), "@");
    }

    #[test]
    fn palette_indices() {
        assert_eq!(nearest_index([255, 0, 0]), 196);
        assert_eq!(nearest_index([128, 128, 128]), 244);
        assert_eq!(nearest_index([0, 0, 0]), 16);
    }
}
