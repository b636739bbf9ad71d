//! Colour maps of pictures, perceptually uniform and told apart by colour-blind people.
//!
//! matplotlib's inferno, magma and viridis (van der Walt & Smith 2015, public domain) at 17 points, and a
//! diverging map from blue over white to orange.

/// A colour map.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Ramp {
    /// Pressure.
    Inferno,
    /// Stress.
    Magma,
    /// Film.
    Viridis,
    /// What may have either sign: zero is white.
    Diverging,
}

const INFERNO: [u32; 17] = [
    0x000004, 0x0b0724, 0x210c4a, 0x3d0965, 0x57106e, 0x71196e, 0x8a226a, 0xa32c61, 0xbc3754,
    0xd24644, 0xe45a31, 0xf1731d, 0xf98e09, 0xfcac11, 0xf9cb35, 0xf2ea69, 0xfcffa4,
];
const MAGMA: [u32; 17] = [
    0x000004, 0x0a0822, 0x1d1147, 0x36106b, 0x51127c, 0x6a1c81, 0x832681, 0x9c2e7f, 0xb73779,
    0xd0416f, 0xe75263, 0xf56b5c, 0xfc8961, 0xfea772, 0xfec488, 0xfde2a3, 0xfcfdbf,
];
const VIRIDIS: [u32; 17] = [
    0x440154, 0x48186a, 0x472d7b, 0x424086, 0x3b528b, 0x33638d, 0x2c728e, 0x26828e, 0x21918c,
    0x1fa088, 0x28ae80, 0x3fbc73, 0x5ec962, 0x84d44b, 0xaddc30, 0xd8e219, 0xfde725,
];
const DIVERGING: [u32; 17] = [
    0x0b3c6f, 0x1a528a, 0x2f69a3, 0x4a82b8, 0x6a9cca, 0x8fb6d9, 0xb3cfe6, 0xd6e5f0, 0xf7f7f7,
    0xf8e4cd, 0xf5cea3, 0xeeb577, 0xe39a4e, 0xd17f2f, 0xb9651b, 0x9c4d0f, 0x7c3808,
];

impl Ramp {
    /// The colour at `t` of [0, 1] (clamped), times `shade`.
    pub(crate) fn colour(self, t: f32, shade: f32) -> [u8; 3] {
        let points = match self {
            Self::Inferno => &INFERNO,
            Self::Magma => &MAGMA,
            Self::Viridis => &VIRIDIS,
            Self::Diverging => &DIVERGING,
        };
        let t = if t.is_nan() { 0.0 } else { t.clamp(0.0, 1.0) } * 16.0;
        let k = (t as usize).min(15);
        let (low, high) = (rgb(points[k]), rgb(points[k + 1]));
        let weight = t - k as f32;
        std::array::from_fn(|c| {
            let value = f32::from(low[c]) * (1.0 - weight) + f32::from(high[c]) * weight;
            // Half up, without a call of the library's `round`.
            (value * shade + 0.5) as u8
        })
    }
}

fn rgb(hex: u32) -> [u8; 3] {
    let [_, r, g, b] = hex.to_be_bytes();
    [r, g, b]
}

#[cfg(test)]
mod tests {
    use super::*;

    fn luma(ramp: Ramp, t: f32) -> f32 {
        let [r, g, b] = ramp.colour(t, 1.0).map(f32::from);
        0.2126 * r + 0.7152 * g + 0.0722 * b
    }

    #[test]
    fn ramps_start_dark_and_brighten() {
        for ramp in [Ramp::Inferno, Ramp::Magma, Ramp::Viridis] {
            for k in 0..100 {
                let (one, two) = (k as f32 / 100.0, (k + 1) as f32 / 100.0);
                assert!(luma(ramp, one) < luma(ramp, two) + 0.5, "{ramp:?} {k}");
            }
            assert_eq!(ramp.colour(-1.0, 1.0), ramp.colour(0.0, 1.0));
            assert_eq!(ramp.colour(f32::NAN, 1.0), ramp.colour(0.0, 1.0));
            assert_eq!(ramp.colour(2.0, 1.0), ramp.colour(1.0, 1.0));
        }
    }

    #[test]
    fn the_diverging_map_is_brightest_at_zero_and_falls_to_both_sides() {
        for k in 0..50 {
            let (far, near) = (k as f32 / 100.0, (k + 1) as f32 / 100.0);
            assert!(luma(Ramp::Diverging, far) < luma(Ramp::Diverging, near) + 0.5);
            let (far, near) = (1.0 - far, 1.0 - near);
            assert!(luma(Ramp::Diverging, far) < luma(Ramp::Diverging, near) + 0.5);
        }
    }
}
