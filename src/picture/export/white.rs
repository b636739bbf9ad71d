//! Colours on white paper: what has either sign is white at zero, blue below and orange above.

use crate::draw::Rgb;
use crate::{Look, Ramp, Tint};

/// From −1 to 1 at 17 points. Oklch of hue 250° (below) and 45° (above) with the lightness 1 − .62|u|, the same on both
/// sides, and the chroma .16 sin(.75π |u|^.8) as far as sRGB has it. (Ottosson 2020 for Oklab; ours.)
const SIGNED: [u32; 17] = [
    0x014478, 0x01599b, 0x016fc0, 0x2087df, 0x42a0f7, 0x74b9ff, 0xa5d1fe, 0xd3e8fe, 0xffffff,
    0xffddcf, 0xffba9b, 0xfc9464, 0xe8773f, 0xcf5e20, 0xb24800, 0x903900, 0x6f2a01,
];

/// A tint's colour on paper; white where there is no value.
pub(super) fn paint(look: &Look, tint: Tint) -> Rgb {
    match tint {
        Tint::Share(share) if look.ramp() == Ramp::Diverging => signed(share),
        Tint::Blank | Tint::Plain(_) | Tint::Share(_) => look.paint(tint).unwrap_or([255; 3]),
    }
}

/// The colour at a share of a range that is as wide below zero as above.
fn signed(share: f32) -> Rgb {
    let at = share.clamp(0.0, 1.0) * 16.0;
    let k = (at as usize).min(15);
    let [low, high] = [SIGNED[k], SIGNED[k + 1]].map(|hex| {
        let [_, r, g, b] = hex.to_be_bytes();
        [r, g, b].map(f32::from)
    });
    let weight = at - k as f32;
    std::array::from_fn(|c| (low[c] + (high[c] - low[c]) * weight + 0.5) as u8)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::draw::seen::{Sight, contrast, difference, lightness};
    use crate::export::centre_line::{FILM, PRESSURE};
    use crate::export::history::BAND;
    use crate::export::profile::POINT;
    use crate::profile::{OIL, STEEL};

    const STEPS: u16 = 64;

    fn shares() -> impl Iterator<Item = [f32; 2]> {
        (0..STEPS).map(|k| [k, k + 1].map(|k| f32::from(k) / f32::from(STEPS)))
    }

    #[test]
    fn whoever_sees_colours_badly_sees_what_is_more() {
        for sight in Sight::ALL {
            for ramp in [Ramp::Inferno, Ramp::Magma, Ramp::Viridis] {
                for shares in shares() {
                    let [one, two] = shares.map(|t| lightness(sight.sees(ramp.colour(t, 1.0))));
                    assert!(
                        one < two + 0.3,
                        "{ramp:?}, {sight:?}, {shares:?}: {one} {two}"
                    );
                }
            }
            for [one, two] in shares() {
                let [near, far] = [one, two].map(|t| 0.5 * (1.0 + t));
                for [near, far] in [[near, far], [1.0 - near, 1.0 - far]] {
                    let [light, dark] = [near, far].map(|t| lightness(sight.sees(signed(t))));
                    assert!(dark < light, "{sight:?}, {near}: {light} {dark}");
                }
            }
            // The signs are told apart from a tenth of the range on.
            for share in [0.05, 0.1, 0.25, 0.5] {
                let both = [0.5 - share, 0.5 + share].map(|t| sight.sees(signed(t)));
                let apart = difference(both[0], both[1]);
                assert!(apart > 12.0, "{sight:?}, ±{share}: {apart}");
            }
        }
    }

    #[test]
    fn whoever_sees_colours_badly_tells_curves_and_bodies_apart() {
        let white = [255; 3];
        let [[pressed, loose], [one, two]] =
            [OIL, STEEL].map(|two| two.map(|c| c.map(|part| part as u8)));
        let side_by_side = [
            ("curves of the centre line", PRESSURE, FILM),
            ("pressure and Hertz's", PRESSURE, BAND),
            ("film and Hertz's pressure", FILM, BAND),
            ("trace and point", PRESSURE, POINT),
            ("a curve and the paper", BAND, white),
            ("body 1 and oil", one, loose),
            ("body 2 and oil", two, loose),
            ("body 1 and oil under pressure", one, pressed),
            ("body 2 and oil under pressure", two, pressed),
        ];
        for sight in Sight::ALL {
            for (what, left, right) in side_by_side {
                let apart = difference(sight.sees(left), sight.sees(right));
                assert!(apart > 20.0, "{what}, {sight:?}: {apart}");
            }
        }
    }

    #[test]
    fn signs_are_as_dark_and_zero_is_the_paper() {
        assert_eq!(signed(0.5), [255; 3]);
        for [one, _] in shares() {
            let both = [one, 1.0 - one].map(|t| lightness(signed(t)));
            assert!((both[0] - both[1]).abs() < 6.0, "{one}: {both:?}");
        }
        assert!(contrast([0; 3], [255; 3]) > 20.9);
    }
}
