//! Colour maps: a few stops each, and what becomes of them on 256 colours or on none.

/// A colour map.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Ramp {
    /// Black, red, yellow: pressure and stress.
    Heat,
    /// Dark blue to pale green: depth of film, reversed, as deep water is dark.
    Depth,
    /// Blue, grey, orange: heights.
    Diverging,
}

impl Ramp {
    /// A colour, `t` from 0 to 1.
    pub fn rgb(self, t: f32) -> [u8; 3] {
        map_rgb(self, t)
    }

    /// Same with white mixed in: lines drawn over a map.
    pub fn lit(self, t: f32, white: f32) -> [u8; 3] {
        map_rgb(self, t).map(|c| (f32::from(c) + (255.0 - f32::from(c)) * white) as u8)
    }
}

const HEAT: [[u8; 3]; 8] = [
    [12, 8, 38],
    [58, 12, 96],
    [119, 28, 109],
    [179, 46, 88],
    [229, 85, 48],
    [250, 141, 20],
    [247, 204, 70],
    [252, 252, 190],
];
const DEPTH: [[u8; 3]; 7] = [
    [14, 16, 60],
    [28, 52, 122],
    [30, 98, 150],
    [36, 146, 156],
    [74, 188, 140],
    [150, 222, 120],
    [232, 246, 168],
];
const DIVERGING: [[u8; 3]; 7] = [
    [20, 80, 160],
    [78, 140, 204],
    [150, 188, 222],
    [226, 226, 226],
    [240, 188, 130],
    [222, 132, 52],
    [164, 78, 10],
];
/// The same maps chosen from the 256 colours by hand: the nearest ones would mix in greys.
const HEAT_INDEXED: [u8; 13] = [17, 53, 54, 90, 126, 162, 168, 203, 208, 214, 220, 227, 230];
const DEPTH_INDEXED: [u8; 12] = [17, 18, 24, 25, 31, 37, 43, 79, 114, 150, 192, 229];
const DIVERGING_INDEXED: [u8; 13] = [25, 32, 74, 110, 152, 188, 254, 223, 216, 209, 173, 166, 130];
/// Characters of growing ink, one step each.
const INK: [&str; 10] = [" ", ".", ":", "-", "=", "+", "*", "#", "%", "@"];

/// A character of growing ink, `t` from 0 to 1.
pub(super) fn ink(t: f32) -> &'static str {
    let last = INK.len() - 1;
    INK[((t.clamp(0.0, 1.0) * last as f32).round() as usize).min(last)]
}

pub(super) fn map_rgb(ramp: Ramp, t: f32) -> [u8; 3] {
    match ramp {
        Ramp::Heat => interpolate(&HEAT, t),
        Ramp::Depth => interpolate(&DEPTH, t),
        Ramp::Diverging => interpolate(&DIVERGING, t),
    }
}

pub(super) fn map_index(ramp: Ramp, t: f32) -> u8 {
    let steps: &[u8] = match ramp {
        Ramp::Heat => &HEAT_INDEXED,
        Ramp::Depth => &DEPTH_INDEXED,
        Ramp::Diverging => &DIVERGING_INDEXED,
    };
    let last = steps.len() - 1;
    // A NaN becomes the first step.
    let place = (t.clamp(0.0, 1.0) * last as f32).round() as usize;
    steps[place.min(last)]
}

fn interpolate(stops: &[[u8; 3]], t: f32) -> [u8; 3] {
    let last = stops.len() - 1;
    let t = if t.is_nan() { 0.0 } else { t };
    let place = t.clamp(0.0, 1.0) * last as f32;
    let lower = (place as usize).min(last - 1);
    let part = place - lower as f32;
    let mix = |a: u8, b: u8| (f32::from(a) + (f32::from(b) - f32::from(a)) * part).round() as u8;
    let (low, high) = (stops[lower], stops[lower + 1]);
    [
        mix(low[0], high[0]),
        mix(low[1], high[1]),
        mix(low[2], high[2]),
    ]
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
    fn maps_that_rise_rise_in_lightness() {
        let lightness = |[r, g, b]: [u8; 3]| {
            0.2126 * f64::from(r) + 0.7152 * f64::from(g) + 0.0722 * f64::from(b)
        };
        for ramp in [Ramp::Heat, Ramp::Depth] {
            let shades: Vec<f64> = (0..=64)
                .map(|i| lightness(map_rgb(ramp, i as f32 / 64.0)))
                .collect();
            assert!(
                shades.windows(2).all(|pair| pair[1] > pair[0] - 0.5),
                "{ramp:?}: {shades:?}"
            );
        }
    }

    #[test]
    fn out_of_range_and_nan_stay_in_the_map() {
        assert_eq!(map_rgb(Ramp::Heat, -3.0), HEAT[0]);
        assert_eq!(map_rgb(Ramp::Heat, 9.0), HEAT[7]);
        assert_eq!(map_rgb(Ramp::Heat, f32::NAN), HEAT[0]);
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
