//! Colours that colour-blind people can tell apart, for what the viewer does not colour itself.
//!
//! Meshes take the colours of the viewer's maps from [`Ramp`]; lines use the palette of Okabe and Ito (2008).

use rerun::Color;

pub(super) use crate::observe::ramp::Ramp;

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
    fn contact_is_dark_and_the_first_green_fringe_is_at_a_quarter_wave() {
        assert_eq!(interference(0.0), [0, 0, 0]);
        let quarter = LIGHTS_NM[1] * 1e-3 / (4.0 * REFRACTIVE_INDEX);
        assert!(interference(quarter)[1] > 250);
        // Far out all three lights are equally bright: white light shows no fringe.
        assert!(interference(5.0).iter().all(|&c| c.abs_diff(128) <= 1));
    }
}
