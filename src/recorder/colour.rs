//! Colours that colour-blind people can tell apart, for what the viewer does not colour itself.
//!
//! Meshes take the colours of the viewer's maps from [`Ramp`]; lines use the palette of Okabe and Ito (2008).

use rerun::Color;

pub(crate) use asperity_picture::Ramp;

/// Lines and text.
pub(crate) const ORANGE: [u8; 3] = [230, 159, 0];
pub(crate) const SKY: [u8; 3] = [86, 180, 233];
pub(crate) const GREEN: [u8; 3] = [0, 158, 115];
pub(crate) const YELLOW: [u8; 3] = [240, 228, 66];
pub(crate) const PURPLE: [u8; 3] = [204, 121, 167];
pub(crate) const WHITE: [u8; 3] = [255, 255, 255];
pub(crate) const GREY: [u8; 3] = [150, 155, 165];

/// Background of spatial views, nearly black. A viewer puts a plate under each label, halfway between what is behind and a
/// grey of its theme (230 of 255 in a light one, 18 in a dark one), and a label has one colour whatever the theme. On this
/// ground white can be read in both; black could be on a nearly white one, which would glare in a dark theme.
pub(crate) const BACKGROUND: [u8; 3] = [5, 6, 8];

/// Colours of curves in plots, whose background is the viewer's own: dark or light by its theme. All of them stand out
/// from black and from white by 3 : 1 (WCAG 2.2, 1.4.11), and are near those above.
pub(crate) mod curve {
    pub(crate) const ORANGE: [u8; 3] = [216, 120, 0];
    pub(crate) const SKY: [u8; 3] = [40, 140, 215];
    pub(crate) const GREEN: [u8; 3] = [0, 150, 105];
    pub(crate) const OLIVE: [u8; 3] = [150, 135, 0];
    pub(crate) const BLUE: [u8; 3] = [80, 90, 215];
    pub(crate) const VERMILION: [u8; 3] = [205, 80, 20];
    pub(crate) const PURPLE: [u8; 3] = [195, 100, 160];
    pub(crate) const GREY: [u8; 3] = [140, 142, 148];
    #[cfg(test)]
    pub(crate) const ALL: [[u8; 3]; 8] = [ORANGE, SKY, GREEN, OLIVE, BLUE, VERMILION, PURPLE, GREY];
}

/// A colour map in so many steps that an eye sees none: looked up, which costs less than to interpolate.
pub(crate) struct Tints(Vec<[f32; 3]>);

impl Tints {
    /// Over the shares 0 to 1.
    pub(crate) fn new(colour: impl Fn(f32) -> [f32; 3]) -> Self {
        const STEPS: u16 = 512;
        let share = |step: u16| f32::from(step) / f32::from(STEPS - 1);
        Self((0..STEPS).map(|step| colour(share(step))).collect())
    }

    /// Of one of the maps.
    pub(crate) fn of(ramp: Ramp) -> Self {
        Self::new(|share| ramp.colour(share, 1.0).map(f32::from))
    }

    /// The colour at a share (clamped), times a shade, as meshes store it.
    #[inline]
    pub(crate) fn colour(&self, share: f32, shade: f32) -> u32 {
        let last = self.0.len() - 1;
        let step = (share * last as f32 + 0.5) as usize;
        packed(self.0[step.min(last)].map(|value| (value * shade + 0.5) as u8))
    }
}

/// A colour as meshes store it.
#[inline]
pub(crate) fn packed([r, g, b]: [u8; 3]) -> u32 {
    u32::from_be_bytes([r, g, b, u8::MAX])
}

/// With an opacity.
pub(crate) fn faded(colour: [u8; 3], alpha: u8) -> Color {
    Color::from_unmultiplied_rgba(colour[0], colour[1], colour[2], alpha)
}

/// How bright a slope is lit from the inlet side and above, from the rise per length along x and y:
/// 1 on the flat, at least 0.45.
#[inline]
pub(crate) fn hillshade(slope_x: f32, slope_y: f32) -> f32 {
    let light = (1.0 - 0.9 * slope_x - 0.35 * slope_y)
        / (1.0 + slope_x * slope_x + slope_y * slope_y).sqrt();
    (0.72 * light + 0.2).clamp(0.45, 1.15) / 0.92
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn tints_are_the_colours_of_their_map() {
        let tints = Tints::of(Ramp::Inferno);
        for k in 0..=1000_u16 {
            let share = f32::from(k) / 1000.0;
            let [r, g, b, alpha] = tints.colour(share, 1.0).to_be_bytes();
            assert_eq!(alpha, u8::MAX);
            let exact = Ramp::Inferno.colour(share, 1.0);
            // Between two steps of the table colours differ by less than this.
            assert!(
                [r, g, b]
                    .iter()
                    .zip(exact)
                    .all(|(one, two)| one.abs_diff(two) <= 2)
            );
        }
        assert_eq!(tints.colour(7.0, 1.0), tints.colour(1.0, 1.0));
        assert_eq!(tints.colour(f32::NAN, 1.0), tints.colour(-1.0, 1.0));
        assert_eq!(tints.colour(1.0, 0.0), packed([0; 3]));
    }

    /// Contrast as WCAG 2.2 has it.
    fn contrast(one: [u8; 3], two: [u8; 3]) -> f64 {
        let linear = |value: u8| {
            let share = f64::from(value) / 255.0;
            if share <= 0.04045 {
                share / 12.92
            } else {
                ((share + 0.055) / 1.055).powf(2.4)
            }
        };
        let luminance = |colour: [u8; 3]| {
            let [r, g, b] = colour.map(linear);
            0.2126 * r + 0.7152 * g + 0.0722 * b + 0.05
        };
        let (one, two) = (luminance(one), luminance(two));
        (one / two).max(two / one)
    }

    #[test]
    fn curves_stand_out_from_black_and_from_white() {
        for colour in curve::ALL {
            assert!(contrast(colour, [0; 3]) >= 3.0, "{colour:?}");
            assert!(contrast(colour, [255; 3]) >= 3.0, "{colour:?}");
        }
    }

    #[test]
    fn text_can_be_read_in_a_light_and_a_dark_theme() {
        for plate in [230.0, 18.0] {
            let seen = BACKGROUND.map(|behind| (0.5 * (plate + f64::from(behind))).round() as u8);
            assert!(contrast(WHITE, seen) >= 4.5, "{seen:?}");
        }
    }
}
