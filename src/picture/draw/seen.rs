//! What eyes make of colours, for tests: contrast, lightness, difference, and what whoever lacks a kind of cones sees.

use super::{Drawing, Rgb, Text};

/// Kinds of sight.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Sight {
    Full,
    /// No long-wave cones.
    Protanopia,
    /// No middle-wave cones.
    Deuteranopia,
    /// No short-wave cones.
    Tritanopia,
}

impl Sight {
    pub(crate) const ALL: [Self; 4] = [
        Self::Full,
        Self::Protanopia,
        Self::Deuteranopia,
        Self::Tritanopia,
    ];

    /// A colour as it is seen (Machado, Oliveira & Fernandes 2009, severity 1, in linear light).
    pub(crate) fn sees(self, colour: Rgb) -> Rgb {
        let matrix = match self {
            Self::Full => return colour,
            Self::Protanopia => [
                [0.152286, 1.052583, -0.204868],
                [0.114503, 0.786281, 0.099216],
                [-0.003882, -0.048116, 1.051998],
            ],
            Self::Deuteranopia => [
                [0.367322, 0.860646, -0.227968],
                [0.280085, 0.672501, 0.047413],
                [-0.011820, 0.042940, 0.968881],
            ],
            Self::Tritanopia => [
                [1.255528, -0.076749, -0.178779],
                [-0.078411, 0.930809, 0.147602],
                [0.004733, 0.691367, 0.303900],
            ],
        };
        let light = colour.map(linear);
        matrix.map(|row: [f64; 3]| {
            let seen: f64 = row
                .iter()
                .zip(light)
                .map(|(share, part)| share * part)
                .sum();
            let seen = seen.clamp(0.0, 1.0);
            let value = if seen <= 0.003_130_8 {
                12.92 * seen
            } else {
                1.055 * seen.powf(1.0 / 2.4) - 0.055
            };
            (255.0 * value).round() as u8
        })
    }
}

fn linear(value: u8) -> f64 {
    let share = f64::from(value) / 255.0;
    if share <= 0.04045 {
        share / 12.92
    } else {
        ((share + 0.055) / 1.055).powf(2.4)
    }
}

/// CIELAB (1976) under D65.
fn lab(colour: Rgb) -> [f64; 3] {
    let [r, g, b] = colour.map(linear);
    let [x, y, z] = [
        (0.4124 * r + 0.3576 * g + 0.1805 * b) / 0.9505,
        0.2126 * r + 0.7152 * g + 0.0722 * b,
        (0.0193 * r + 0.1192 * g + 0.9505 * b) / 1.089,
    ]
    .map(|t: f64| {
        if t > 0.008_856 {
            t.cbrt()
        } else {
            7.787 * t + 16.0 / 116.0
        }
    });
    [116.0 * y - 16.0, 500.0 * (x - y), 200.0 * (y - z)]
}

/// Lightness L*, 0 to 100.
pub(crate) fn lightness(colour: Rgb) -> f64 {
    lab(colour)[0]
}

/// Difference ΔE*ab (CIE 1976): 2.3 is just seen.
pub(crate) fn difference(one: Rgb, two: Rgb) -> f64 {
    let (one, two) = (lab(one), lab(two));
    let squares = one.iter().zip(two).map(|(a, b)| (a - b) * (a - b));
    squares.sum::<f64>().sqrt()
}

/// Contrast as WCAG 2.2 has it.
pub(crate) fn contrast(one: Rgb, two: Rgb) -> f64 {
    let luminance = |colour: Rgb| {
        let [r, g, b] = colour.map(linear);
        0.2126 * r + 0.7152 * g + 0.0722 * b + 0.05
    };
    let (one, two) = (luminance(one), luminance(two));
    (one / two).max(two / one)
}

impl Drawing {
    /// Pairs of texts that lie upon each other by more than a tenth of the size of type.
    pub(crate) fn upon_each_other(&self) -> Vec<[&str; 2]> {
        let room = 0.1 * self.font;
        let meet = |one: &Text, two: &Text| {
            let (one, two) = (self.extent(one), self.extent(two));
            let mut sides = one.iter().zip(two);
            sides.all(|(one, two)| one[0].max(two[0]) + room < one[1].min(two[1]))
        };
        let mut pairs = Vec::new();
        for (k, one) in self.texts.iter().enumerate() {
            let later = self.texts[k + 1..].iter().filter(|two| meet(one, two));
            pairs.extend(later.map(|two| [one.words.as_str(), two.words.as_str()]));
        }
        pairs
    }

    /// Texts with less than that contrast to more than a twentieth of what is behind them, each with the contrast that
    /// nineteen of twenty pixels have.
    pub(crate) fn faint(&self, least: f64) -> Vec<(&str, f64)> {
        let mut bare = self.clone();
        bare.texts.clear();
        let Ok(behind) = bare.pixels() else {
            return vec![("the font cannot be read", 0.0)];
        };
        let reached = |text: &Text| {
            let [[left, right], [top, bottom]] = self.extent(text);
            let mut contrasts = Vec::new();
            for y in top.max(0.0) as u32..(bottom as u32).min(behind.tall) {
                for x in left.max(0.0) as u32..(right as u32).min(behind.wide) {
                    let at = 3 * (y * behind.wide + x) as usize;
                    let pixel = [behind.rgb[at], behind.rgb[at + 1], behind.rgb[at + 2]];
                    contrasts.push(contrast(text.colour, pixel));
                }
            }
            contrasts.sort_by(f64::total_cmp);
            contrasts.get(contrasts.len() / 20).copied().unwrap_or(21.0)
        };
        let all = self
            .texts
            .iter()
            .map(|text| (text.words.as_str(), reached(text)));
        all.filter(|(_, reached)| *reached < least).collect()
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::draw::SizeUnit;

    #[test]
    fn a_faint_text_is_found_and_red_and_green_look_alike_to_some() {
        let mut drawing = Drawing::new(SizeUnit::Pixel, [200.0, 60.0], 15.0);
        drawing.text(Text::new([10.0, 20.0], "ink"));
        drawing.text(Text::new([10.0, 50.0], "grey").on_field([150, 155, 165]));
        let faint = drawing.faint(4.5);
        assert_eq!((faint.len(), faint[0].0), (1, "grey"));
        let [red, green] = [[200, 60, 40], [110, 120, 40]];
        let apart = |sight: Sight| difference(sight.sees(red), sight.sees(green));
        assert!(apart(Sight::Full) > 40.0 && apart(Sight::Deuteranopia) < 20.0);
        assert!((lightness([255; 3]) - 100.0).abs() < 0.1);
    }
}
