//! Spectra of the surfaces and of the film along y = 0 within the contact, as a mean over the steps.
//!
//! ```text
//! A(λ) = 2 |Σ w f exp(−2πi x/λ)| / Σ w      f: heights less their parabola, w: Hann's window over |x| < 0.8 a
//! ```
//! The root of the mean of A² over the steps: a body's wave has its amplitude there whatever its phase, and the waves of
//! both bodies, which meet in all phases, the root of the sum of their squares. A window of 1.6 a tells lengths apart that
//! differ by more than λ/(0.8 a) of themselves. Source: Harris (1978), Proc. IEEE 66, for the window; ours.

use std::f64::consts::{PI, TAU};

use asperity_engine::sim::Frame;

/// Half of what is looked at, a.
const HALF: f64 = 0.8;
/// Lengths of waves.
const LENGTHS: usize = 72;
/// Fewest nodes: below, there is no wave to be seen.
const FEWEST: usize = 16;

/// Whose spectrum.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Heights {
    Body1,
    Body2,
    /// Of both bodies together.
    Both,
    Film,
}

impl Heights {
    const ALL: [Self; 4] = [Self::Body1, Self::Body2, Self::Both, Self::Film];
}

/// What waves are looked for by.
#[derive(Debug, Clone, PartialEq)]
struct Looked {
    /// Nodes of a row, and their distance, m.
    nx: usize,
    dx_m: f64,
    first: usize,
    weights: Vec<f64>,
    /// 1, x, x² made orthogonal under the weights, each of unit norm.
    trend: [Vec<f64>; 3],
    lengths_m: Vec<f64>,
}

impl Looked {
    fn of(frame: &Frame) -> Option<Self> {
        let x_m = |i: usize| frame.x_min_m + frame.dx_m * i as f64;
        let half_m = HALF * frame.a_m;
        let inside: Vec<usize> = (0..frame.nx).filter(|&i| x_m(i).abs() < half_m).collect();
        let (first, count) = (*inside.first()?, inside.len());
        let shares = || inside.iter().map(|&i| x_m(i) / half_m);
        let weights: Vec<f64> = shares().map(|t| (0.5 * PI * t).cos().powi(2)).collect();
        let inner = |one: &[f64], two: &[f64]| -> f64 {
            let both = one.iter().zip(two).zip(&weights);
            both.map(|((one, two), w)| w * one * two).sum()
        };
        let mut trend: [Vec<f64>; 3] =
            [0, 1, 2].map(|power| shares().map(|t| t.powi(power)).collect());
        for k in 0..3 {
            let (before, own) = trend.split_at_mut(k);
            for known in before {
                let part = inner(known, &own[0]);
                own[0]
                    .iter_mut()
                    .zip(known)
                    .for_each(|(own, known)| *own -= part * *known);
            }
            let norm = inner(&own[0], &own[0]).sqrt();
            own[0].iter_mut().for_each(|value| *value /= norm);
        }
        let [shortest, longest] = [4.0 * frame.dx_m, half_m];
        let length =
            |k: usize| shortest * (longest / shortest).powf(k as f64 / (LENGTHS - 1) as f64);
        let has_room = count >= FEWEST && longest > shortest;
        has_room.then(|| Self {
            nx: frame.nx,
            dx_m: frame.dx_m,
            first,
            weights,
            trend,
            lengths_m: (0..LENGTHS).map(length).collect(),
        })
    }

    /// Squares of the amplitudes, m².
    fn squares(&self, row: &[f64]) -> Vec<f64> {
        let mut heights = row.to_vec();
        for known in &self.trend {
            let parts = heights.iter().zip(known).zip(&self.weights);
            let part: f64 = parts.map(|((own, known), w)| w * own * known).sum();
            heights
                .iter_mut()
                .zip(known)
                .for_each(|(own, known)| *own -= part * known);
        }
        let total: f64 = self.weights.iter().sum();
        let lengths = self.lengths_m.iter();
        lengths
            .map(|length_m| {
                let (mut cos, mut sin) = (0.0, 0.0);
                for (i, (height, w)) in heights.iter().zip(&self.weights).enumerate() {
                    let phase = TAU * self.dx_m * i as f64 / length_m;
                    (cos, sin) = (
                        cos + w * height * phase.cos(),
                        sin + w * height * phase.sin(),
                    );
                }
                4.0 * (cos * cos + sin * sin) / (total * total)
            })
            .collect()
    }
}

/// Spectra over the steps so far.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct Spectra {
    looked: Option<Looked>,
    sums_m2: [Vec<f64>; 4],
    steps: u64,
}

impl Spectra {
    /// Takes up a frame; another grid begins anew.
    pub fn follow(&mut self, frame: &Frame) {
        let is_of = |own: &Looked| (own.nx, own.dx_m) == (frame.nx, frame.dx_m);
        if !self.looked.as_ref().is_some_and(is_of) {
            self.looked = Looked::of(frame);
            self.sums_m2 = Heights::ALL.map(|_| vec![0.0; LENGTHS]);
            self.steps = 0;
        }
        let Some(looked) = &self.looked else {
            return;
        };
        let rows = [&frame.roughness_1_m, &frame.roughness_2_m, &frame.film_m];
        if rows.iter().any(|field| field.len() != frame.nx * frame.ny) {
            return;
        }
        let within = |field: &[f32]| -> Vec<f64> {
            let row = &frame.centre_line(field)[looked.first..][..looked.weights.len()];
            row.iter().map(|height| f64::from(*height)).collect()
        };
        let [one, two, film] = rows.map(|field| within(field));
        for (heights, sums) in Heights::ALL.into_iter().zip(&mut self.sums_m2) {
            let both: Vec<f64>;
            let row = match heights {
                Heights::Body1 => &one,
                Heights::Body2 => &two,
                Heights::Film => &film,
                Heights::Both => {
                    both = one.iter().zip(&two).map(|(one, two)| one + two).collect();
                    &both
                }
            };
            let squares = looked.squares(row);
            sums.iter_mut()
                .zip(squares)
                .for_each(|(sum, square)| *sum += square);
        }
        self.steps += 1;
    }

    /// Lengths of waves and amplitudes, m; none before the first step.
    pub(crate) fn of(&self, heights: Heights) -> Vec<[f64; 2]> {
        let lengths = self.looked.iter().flat_map(|looked| &looked.lengths_m);
        let at = Heights::ALL.iter().position(|own| *own == heights);
        let sums = at.into_iter().flat_map(|at| &self.sums_m2[at]);
        let amplitude = |sum: &f64| (sum / self.steps.max(1) as f64).sqrt();
        let all = lengths
            .zip(sums)
            .map(|(length, sum)| [*length, amplitude(sum)]);
        all.filter(|_| self.steps > 0).collect()
    }

    /// Amplitude of the film over that of both surfaces: length of the wave, m, and ratio. Only where the surfaces have a
    /// wave: at least half of what they have at any length that the window does not tell from it, and three hundredths of their
    /// greatest. Beside a wave there is what the window makes of it, and nothing to divide by.
    pub(crate) fn ratios(&self) -> Vec<[f64; 2]> {
        let both = self.of(Heights::Both);
        let greatest = both.iter().fold(0.0, |top: f64, at| top.max(at[1]));
        let longest_m = both.last().map_or(1.0, |at| at[0]);
        let has_wave = |[length_m, amplitude]: &[f64; 2]| {
            let near =
                |other: &&[f64; 2]| (1.0 / other[0] - 1.0 / length_m).abs() < 1.0 / longest_m;
            let rivals = both.iter().filter(near).map(|other| other[1]);
            *amplitude >= 0.5 * rivals.fold(0.0, f64::max) && *amplitude >= 0.03 * greatest
        };
        let pairs = both.iter().zip(self.of(Heights::Film));
        let pairs = pairs.filter(|(rough, _)| greatest > 0.0 && has_wave(rough));
        pairs
            .map(|(rough, film)| [rough[0], film[1] / rough[1]])
            .collect()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Waves of both bodies that run, and a film that keeps a part of them on a parabola.
    fn frame(step: usize, waves_m: [f64; 2], kept: f64) -> Frame {
        let (nx, dx_m) = (201, 0.01);
        let wave = |i: usize, body: usize| {
            let x = -1.0 + dx_m * i as f64;
            let speed = [0.0037, 0.0101][body];
            (TAU * (x - speed * step as f64) / waves_m[body]).cos() as f32
        };
        let row = |body: usize| (0..nx).map(|i| 1e-6 * wave(i, body)).collect::<Vec<_>>();
        let [one, two] = [row(0), row(1)];
        let film = (0..nx).map(|i| {
            let x = -1.0 + dx_m * i as f64;
            (1e-5 * (1.0 + x * x)) as f32 + kept as f32 * (one[i] + two[i])
        });
        Frame {
            nx,
            ny: 1,
            x_min_m: -1.0,
            dx_m,
            a_m: 1.0,
            film_m: film.collect(),
            roughness_1_m: one,
            roughness_2_m: two,
            ..Frame::default()
        }
    }

    #[test]
    fn waves_are_found_with_their_lengths_and_heights_and_the_film_keeps_its_part() {
        let mut spectra = Spectra::default();
        for step in 0..200 {
            spectra.follow(&frame(step, [0.1, 0.25], 0.3));
        }
        for (heights, length, height) in [(Heights::Body1, 0.1, 1e-6), (Heights::Body2, 0.25, 1e-6)]
        {
            let all = spectra.of(heights);
            let top = all.iter().max_by(|one, two| one[1].total_cmp(&two[1]));
            let [at, amplitude] = top.copied().unwrap_or_default();
            // The step between two lengths is 4.4 %.
            assert!((at / length - 1.0).abs() < 0.045, "{at} {length}");
            assert!((amplitude / height - 1.0).abs() < 0.05, "{amplitude}");
        }
        let ratios = spectra.ratios();
        let at = |length: f64| {
            ratios
                .iter()
                .filter(move |at| (at[0] / length - 1.0).abs() < 0.05)
        };
        for [length, ratio] in at(0.1).chain(at(0.25)) {
            assert!((ratio - 0.3).abs() < 0.006, "{length}: {ratio}");
        }
        assert!(at(0.1).count() > 0 && at(0.25).count() > 0);
        assert!(
            ratios.len() < LENGTHS / 2,
            "between the waves there is nothing to divide by"
        );
    }

    #[test]
    fn few_nodes_have_no_spectrum() {
        let mut spectra = Spectra::default();
        spectra.follow(&Frame {
            nx: 9,
            ny: 1,
            dx_m: 0.25,
            x_min_m: -1.0,
            a_m: 1.0,
            ..Frame::default()
        });
        assert!(spectra.of(Heights::Film).is_empty() && spectra.ratios().is_empty());
    }
}
