//! Round numbers for axes and colour ranges, and the ranges that every picture of a run shares.

use crate::sim::Frame;

/// Metres to millimetres.
pub(crate) const MM: f64 = 1.0e3;
/// GPa, MPa, µm from SI.
pub(crate) const GPA: (&str, f64) = ("GPa", 1e-9);
/// See [`GPA`].
pub(crate) const MPA: (&str, f64) = ("MPa", 1e-6);
/// See [`GPA`].
pub(crate) const UM: (&str, f64) = ("µm", 1e6);

/// Upper ends of the colour ranges, SI. The first frame fixes them, so that colours mean the same in every
/// frame; values beyond take the top colour.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Ranges {
    /// Pressure, Pa.
    pub(crate) pressure_pa: f64,
    /// Film, m.
    pub(crate) film_m: f64,
    /// Traction of either sign, Pa.
    pub(crate) traction_pa: f64,
    /// Roughness of either sign, m.
    pub(crate) roughness_m: f64,
    /// Effective stress, Pa.
    pub(crate) effective_pa: f64,
    /// Orthogonal shear of either sign, Pa.
    pub(crate) shear_pa: f64,
    /// Which bodies are rough.
    pub(crate) rough: [bool; 2],
}

impl Ranges {
    /// The ranges of a run with that first frame.
    pub(crate) fn of(first: &Frame) -> Self {
        let metrics = &first.metrics;
        let round = |value: f64, (_, per_si): (&str, f64)| nice_up(value * per_si) / per_si;
        let pressure_pa = round((1.1 * metrics.p_max_pa).max(1.3 * first.p_hertz_pa), GPA);
        // The film range starts from what the middle of the contact is like in the mean (the film at the
        // origin goes up and down with every crest); the bath around the contact is ten to a hundred times
        // thicker.
        let mean = if metrics.h_mean_m > 0.0 {
            metrics.h_mean_m
        } else {
            metrics.h_central_m
        };
        let valley = mean + 0.5 * (metrics.amplitude_1_m + metrics.amplitude_2_m);
        let film = (2.5 * mean).max(valley).max(1e-9);
        let traction = greatest(&first.traction_pa).max(0.01 * first.p_hertz_pa);
        let rough = [&first.roughness_1_m, &first.roughness_2_m].map(|field| greatest(field));
        let (effective, shear) = first.slice.as_ref().map_or((0.0, 0.0), |slice| {
            (greatest(&slice.effective_pa), greatest(&slice.tau_xz_pa))
        });
        Self {
            pressure_pa,
            film_m: round(film, UM),
            traction_pa: round(traction, MPA),
            roughness_m: round(rough[0].max(rough[1]), UM),
            // One frame does not tell what others hold. Below a spike of pressure the effective stress
            // reaches about 0.5 of it and the shear 0.2 of it (a line contact's, in its own size), and
            // the spikes' range is known.
            effective_pa: round((1.05 * effective).max(0.38 * pressure_pa), GPA),
            shear_pa: round((1.05 * shear).max(0.15 * pressure_pa), GPA),
            rough: rough.map(|height| height > 0.0),
        }
    }
}

fn greatest(field: &[f32]) -> f64 {
    field.iter().fold(0.0_f32, |top, v| top.max(v.abs())).into()
}

/// The least number of the form {1, 1.5, 2, 2.5, 3, 4, 5, 6, 8} 10^k that is not below `value`.
pub(crate) fn nice_up(value: f64) -> f64 {
    const STEPS: [f64; 10] = [1.0, 1.5, 2.0, 2.5, 3.0, 4.0, 5.0, 6.0, 8.0, 10.0];
    if !(value.is_finite() && value > 0.0) {
        return 1.0;
    }
    let decade = 10_f64.powf(value.log10().floor());
    // The slack lets a value that is nice up to rounding stay where it is.
    let step = STEPS
        .into_iter()
        .find(|step| step * decade >= value * (1.0 - 1e-12));
    step.unwrap_or(10.0) * decade
}

/// Equal parts of [0, top], where top is one of [`nice_up`]'s: three to five, ends included.
pub(crate) fn divisions(top: f64) -> Vec<f64> {
    let leading = top / 10_f64.powf((top.log10() + 1e-9).floor());
    let parts = match (leading * 10.0).round() as u32 {
        15 | 30 | 60 => 3,
        25 | 50 => 5,
        _ => 4,
    };
    (0..=parts)
        .map(|k| top * f64::from(k) / f64::from(parts))
        .collect()
}

/// Round positions in [low, high], about `about` of them.
pub(crate) fn ticks(low: f64, high: f64, about: usize) -> Vec<f64> {
    let raw = (high - low) / about.max(1) as f64;
    if !(raw.is_finite() && raw > 0.0) {
        return vec![low];
    }
    let decade = 10_f64.powf(raw.log10().floor());
    let step = [1.0, 2.0, 2.5, 5.0, 10.0]
        .into_iter()
        .map(|step| step * decade)
        .find(|&step| step >= raw * (1.0 - 1e-9))
        .unwrap_or(raw);
    let first = (low / step - 1e-9).ceil() as i64;
    let last = (high / step + 1e-9).floor() as i64;
    (first..=last).map(|k| k as f64 * step).collect()
}

/// A tick's number without needless digits.
pub(crate) fn number(value: f64) -> String {
    let rounded = (value * 1e6).round() / 1e6;
    // Minus zero reads badly on an axis.
    format!("{}", if rounded == 0.0 { 0.0 } else { rounded })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn tops_of_scales_are_round_and_not_too_far() {
        assert_eq!(nice_up(1.0), 1.0);
        assert_eq!(nice_up(1.01), 1.5);
        assert!((nice_up(0.39) - 0.4).abs() < 1e-12);
        assert_eq!(nice_up(8.5e3), 1.0e4);
        assert_eq!(nice_up(0.0), 1.0);
        assert_eq!(nice_up(f64::NAN), 1.0);
        for k in 1..2000 {
            let value = 1.7e-9 * 1.02_f64.powi(k);
            let top = nice_up(value);
            assert!(top >= value * (1.0 - 1e-9) && top <= 1.51 * value);
        }
    }

    #[test]
    fn divisions_are_round_and_hold_both_ends() {
        for top in [
            1.0, 1.5, 2.0, 2.5, 3.0, 4.0, 5.0, 6.0, 8.0, 10.0, 0.5, 1500.0,
        ] {
            let parts = divisions(top);
            assert_eq!((parts.first(), parts.last()), (Some(&0.0), Some(&top)));
            assert!((4..=6).contains(&parts.len()));
            assert!(
                parts.iter().all(|&value| number(value).len() <= 5),
                "{parts:?}"
            );
        }
    }

    #[test]
    fn ticks_cover_the_axis() {
        let at = ticks(-1.18, 0.71, 4);
        assert_eq!(at, vec![-1.0, -0.5, 0.0, 0.5]);
        assert_eq!(ticks(0.0, 1.0, 4), vec![0.0, 0.25, 0.5, 0.75, 1.0]);
        assert_eq!(ticks(1.0, 1.0, 4), vec![1.0]);
        assert_eq!(number(-0.0), "0");
        assert_eq!(number(0.1 + 0.2), "0.3");
    }
}
