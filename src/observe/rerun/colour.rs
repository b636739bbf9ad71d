//! Colours that colour-blind people can tell apart, for what the viewer does not colour itself.
//!
//! The maps are the perceptually uniform ones of the viewer (matplotlib's inferno, magma), given
//! here at 17 points so that meshes have the same colours as maps; lines use the palette of Okabe
//! and Ito (2008).

use rerun::Color;

/// Lines and text.
pub(super) const ORANGE: [u8; 3] = [230, 159, 0];
pub(super) const SKY: [u8; 3] = [86, 180, 233];
pub(super) const GREEN: [u8; 3] = [0, 158, 115];
pub(super) const YELLOW: [u8; 3] = [240, 228, 66];
pub(super) const BLUE: [u8; 3] = [70, 130, 220];
pub(super) const VERMILION: [u8; 3] = [213, 94, 0];
pub(super) const PURPLE: [u8; 3] = [204, 121, 167];
pub(super) const WHITE: [u8; 3] = [235, 235, 235];
pub(super) const GREY: [u8; 3] = [150, 155, 165];
/// Background of spatial views: light enough for the dark end of the colour maps to show.
pub(super) const BACKGROUND: [u8; 3] = [38, 42, 50];

const INFERNO: [u32; 17] = [
    0x000004, 0x0b0724, 0x210c4a, 0x3d0965, 0x57106e, 0x71196e, 0x8a226a, 0xa32c61, 0xbc3754,
    0xd24644, 0xe45a31, 0xf1731d, 0xf98e09, 0xfcac11, 0xf9cb35, 0xf2ea69, 0xfcffa4,
];
const MAGMA: [u32; 17] = [
    0x000004, 0x0a0822, 0x1d1147, 0x36106b, 0x51127c, 0x6a1c81, 0x832681, 0x9c2e7f, 0xb73779,
    0xd0416f, 0xe75263, 0xf56b5c, 0xfc8961, 0xfea772, 0xfec488, 0xfde2a3, 0xfcfdbf,
];

/// A colour map of the meshes.
#[derive(Debug, Clone, Copy)]
pub(super) enum Ramp {
    /// Pressure.
    Inferno,
    /// Stress.
    Magma,
}

impl Ramp {
    /// The colour at `t` of [0, 1] (clamped), times `shade`.
    pub(super) fn colour(self, t: f32, shade: f32) -> [u8; 3] {
        let points = match self {
            Self::Inferno => &INFERNO,
            Self::Magma => &MAGMA,
        };
        let t = if t.is_nan() { 0.0 } else { t.clamp(0.0, 1.0) } * 16.0;
        let k = (t as usize).min(15);
        let (low, high) = (rgb(points[k]), rgb(points[k + 1]));
        let weight = t - k as f32;
        std::array::from_fn(|c| {
            let value = f32::from(low[c]) * (1.0 - weight) + f32::from(high[c]) * weight;
            (value * shade).round() as u8
        })
    }
}

fn rgb(hex: u32) -> [u8; 3] {
    let [_, r, g, b] = hex.to_be_bytes();
    [r, g, b]
}

/// With an opacity.
pub(super) fn faded(colour: [u8; 3], alpha: u8) -> Color {
    Color::from_unmultiplied_rgba(colour[0], colour[1], colour[2], alpha)
}

/// How bright a slope is lit from the inlet side and above, from the rise per length along x and y:
/// 1 on the flat, at least 0.45.
pub(super) fn hillshade(slope_x: f32, slope_y: f32) -> f32 {
    let light = (1.0 - 0.9 * slope_x - 0.35 * slope_y)
        / (1.0 + slope_x * slope_x + slope_y * slope_y).sqrt();
    (0.72 * light + 0.2).clamp(0.45, 1.15) / 0.92
}

/// Refractive index of the oil in the interferogram.
pub(super) const REFRACTIVE_INDEX: f64 = 1.5;
/// Wavelengths of its three lights, nm.
pub(super) const LIGHTS_NM: [f64; 3] = [640.0, 540.0, 450.0];

/// What an optical rig shows for a film of `h_um`: three lights, each of intensity
/// `(1 - cos(4 pi n h / lambda) exp(-(h/h_c)^2))/2`, dark at contact; the coherence length
/// h_c = 0.7 um lets high fringes fade as in white light.
pub(super) fn interference(h_um: f64) -> [u8; 3] {
    let fade = (-(h_um / 0.7).powi(2)).exp();
    LIGHTS_NM.map(|lambda_nm| {
        let phase = 4.0 * std::f64::consts::PI * REFRACTIVE_INDEX * h_um * 1e3 / lambda_nm;
        (255.0 * 0.5 * (1.0 - phase.cos() * fade)).round() as u8
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn ramps_start_dark_and_brighten() {
        for ramp in [Ramp::Inferno, Ramp::Magma] {
            let luma = |t: f32| {
                let [r, g, b] = ramp.colour(t, 1.0).map(f32::from);
                0.2126 * r + 0.7152 * g + 0.0722 * b
            };
            for k in 0..100 {
                assert!(luma(k as f32 / 100.0) < luma((k + 1) as f32 / 100.0) + 0.5);
            }
            assert_eq!(ramp.colour(-1.0, 1.0), ramp.colour(0.0, 1.0));
            assert_eq!(ramp.colour(f32::NAN, 1.0), ramp.colour(0.0, 1.0));
            assert_eq!(ramp.colour(2.0, 1.0), ramp.colour(1.0, 1.0));
        }
    }

    #[test]
    fn contact_is_dark_and_the_first_green_fringe_is_at_a_quarter_wave() {
        assert_eq!(interference(0.0), [0, 0, 0]);
        let quarter = LIGHTS_NM[1] * 1e-3 / (4.0 * REFRACTIVE_INDEX);
        assert!(interference(quarter)[1] > 250);
        // Far out all three lights are equally bright: white light shows no fringe.
        assert!(interference(5.0).iter().all(|&c| c.abs_diff(128) <= 1));
    }
}
