//! Crests along a rough surface: how many there are, and the highest that a point of the mate meets.
//!
//! ```text
//! m_j = Σ_k q_k^j P_k         moments of the spectrum along x, m_0 = Sq²
//! upcrossings of the mean a length  n_0 = (1/2π) √(m_2/m_0)          (Rice 1944)
//! maxima a length                   n_m = (1/2π) √(m_4/m_2)          (Longuet-Higgins 1957)
//! F(h) = Φ exp(−n_0 L e^{−h²/2σ²}/Φ),   Φ = Φ(h/σ),   σ² = m_0,   mean highest over L = ∫ h dF
//! L = |U2 − U1| (2a/U_i)      of the mate passes a point of body i while it crosses the contact
//! ```
//! | symbol | meaning | unit |
//! |---|---|---|
//! | P_k | power of the rows at wavenumber q_k | m² |
//! | Φ | normal distribution | |
//! | L | length that passes | m |
//!
//! F takes the crossings of a level as independent (Cramér & Leadbetter 1967), at their rate among the places that are still
//! below it, the two-state approximation of Vanmarcke 1975: of a Gaussian surface the mean is 12 % low for L of one
//! correlation length, 5 % for five, within 1 % for more (a test), and tends to that of the height itself, 0, for L → 0. A sinusoid has one crest: whoever
//! slides farther meets no higher one. Rows are periodic, and four times as many points as pixels stand for them (by their
//! own waves), since a maximum between two pixels is higher than both.

use std::collections::VecDeque;
use std::f64::consts::{PI, TAU};

use realfft::RealFftPlanner;

use crate::math::spectrum::mean_power;

/// Points for a pixel.
const FINER: usize = 4;
/// Rows that are read at most, evenly spread.
const MOST_ROWS: usize = 256;
/// Steps of the integral over h, and its reach in σ.
const STEPS: usize = 4000;
const REACH: f64 = 10.0;

/// Rows of a surface along x, refined.
#[derive(Debug, Clone, PartialEq)]
pub struct Crests {
    n: usize,
    heights_m: Vec<f64>,
    step_m: f64,
    moments: [f64; 3],
}

/// The highest crest over a length, over all places to begin.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Highest {
    /// Mean, m.
    pub mean_m: f64,
    /// A tenth is below, m.
    pub low_m: f64,
    /// A tenth is above, m.
    pub high_m: f64,
}

impl Crests {
    /// Of rows of `nx` heights `pixel_m` apart; `None`: nothing varies along x.
    pub fn new(nx: usize, heights_m: &[f64], pixel_m: f64) -> Option<Self> {
        let rows = heights_m.len() / nx.max(1);
        if nx < 4 || rows == 0 {
            return None;
        }
        let mean = heights_m.iter().sum::<f64>() / heights_m.len() as f64;
        let row = |j: usize| {
            heights_m[j * nx..(j + 1) * nx]
                .iter()
                .map(move |z| z - mean)
        };
        let scale = (nx * nx) as f64;
        let power = mean_power(nx, rows, row);
        let mut moments = [0.0; 3];
        for (k, p) in power.iter().enumerate() {
            let q = TAU * k as f64 / (nx as f64 * pixel_m);
            for (moment, q) in moments.iter_mut().zip([1.0, q.powi(2), q.powi(4)]) {
                *moment += q * p / scale;
            }
        }
        if moments[1].is_nan() || moments[1] <= 0.0 {
            return None;
        }
        let read = rows.min(MOST_ROWS);
        let mut heights = Vec::with_capacity(read * nx * FINER);
        let mut refined = Refined::new(nx);
        for j in 0..read {
            refined.push(row(j * rows / read), &mut heights);
        }
        Some(Self {
            n: nx * FINER,
            heights_m: heights,
            step_m: pixel_m / FINER as f64,
            moments,
        })
    }

    /// Length after which the rows come again, m.
    pub fn length_m(&self) -> f64 {
        self.n as f64 * self.step_m
    }

    /// σ, m.
    pub fn rms_m(&self) -> f64 {
        self.moments[0].sqrt()
    }

    /// n_0 by the spectrum, 1/m.
    pub fn upcrossings_expected_per_m(&self) -> f64 {
        (self.moments[1] / self.moments[0]).sqrt() / TAU
    }

    /// n_m by the spectrum, 1/m.
    pub fn maxima_expected_per_m(&self) -> f64 {
        (self.moments[2] / self.moments[1]).sqrt() / TAU
    }

    /// Upcrossings counted, 1/m.
    pub fn upcrossings_per_m(&self) -> f64 {
        self.count(|[_, here, next]| here <= 0.0 && next > 0.0)
    }

    /// Maxima counted, 1/m.
    pub fn maxima_per_m(&self) -> f64 {
        self.count(|[before, here, next]| before < here && here >= next)
    }

    fn count(&self, counts: impl Fn([f64; 3]) -> bool) -> f64 {
        let n = self.n;
        let of_row = |row: &[f64]| {
            let three = |i: usize| [row[(i + n - 1) % n], row[i], row[(i + 1) % n]];
            (0..n).filter(|&i| counts(three(i))).count()
        };
        let found: usize = self.heights_m.chunks_exact(n).map(of_row).sum();
        found as f64 / (self.heights_m.len() as f64 * self.step_m)
    }

    /// The highest over `length_m`, from every point of every row on.
    pub fn highest(&self, length_m: f64) -> Highest {
        let window = ((length_m / self.step_m).round() as usize + 1).min(self.n);
        let mut found = Vec::with_capacity(self.heights_m.len());
        for row in self.heights_m.chunks_exact(self.n) {
            push_greatest(row, window, &mut found);
        }
        found.sort_by(f64::total_cmp);
        let at = |share: f64| found[((found.len() - 1) as f64 * share).round() as usize];
        Highest {
            mean_m: found.iter().sum::<f64>() / found.len() as f64,
            low_m: at(0.1),
            high_m: at(0.9),
        }
    }

    /// The same of a Gaussian surface with this spectrum, its mean, m.
    pub fn highest_expected_m(&self, length_m: f64) -> f64 {
        let crossings = self.upcrossings_expected_per_m() * length_m;
        self.rms_m() * mean_highest(crossings)
    }
}

/// Rows by their own waves at [`FINER`] times as many points.
struct Refined {
    forward: std::sync::Arc<dyn realfft::RealToComplex<f64>>,
    back: std::sync::Arc<dyn realfft::ComplexToReal<f64>>,
}

impl Refined {
    fn new(n: usize) -> Self {
        let mut planner = RealFftPlanner::new();
        Self {
            forward: planner.plan_fft_forward(n),
            back: planner.plan_fft_inverse(FINER * n),
        }
    }

    fn push(&mut self, row: impl Iterator<Item = f64>, to: &mut Vec<f64>) {
        let mut values: Vec<f64> = row.collect();
        let n = values.len();
        let mut waves = self.forward.make_output_vec();
        let mut fine = self.back.make_input_vec();
        let mut out = self.back.make_output_vec();
        self.forward
            .process(&mut values, &mut waves)
            .expect("buffers were made for this plan");
        for (to, from) in fine.iter_mut().zip(&waves) {
            *to = from / n as f64;
        }
        if n.is_multiple_of(2) {
            // Half of the wave of two pixels stands at its negative.
            fine[n / 2] *= 0.5;
        }
        self.back
            .process(&mut fine, &mut out)
            .expect("buffers were made for this plan");
        to.extend(out);
    }
}

/// The greatest of `window` values of a ring from each place on.
fn push_greatest(ring: &[f64], window: usize, to: &mut Vec<f64>) {
    let n = ring.len();
    let mut falling: VecDeque<usize> = VecDeque::new();
    for i in 0..n + window - 1 {
        let value = ring[i % n];
        while falling.back().is_some_and(|&j| ring[j % n] <= value) {
            falling.pop_back();
        }
        falling.push_back(i);
        if i + 1 >= window {
            let first = i + 1 - window;
            while falling.front().is_some_and(|&j| j < first) {
                falling.pop_front();
            }
            to.push(ring[falling[0] % n]);
        }
    }
}

/// Mean of the highest of a Gaussian process of unit variance over a length with that many expected upcrossings of the mean.
fn mean_highest(crossings: f64) -> f64 {
    let step = 2.0 * REACH / STEPS as f64;
    let (mut normal, mut mean) = (0.0, 0.0);
    for i in 0..STEPS {
        let h = -REACH + (i as f64 + 0.5) * step;
        let density = (-0.5 * h * h).exp();
        let share = normal + 0.5 * density * step / (2.0 * PI).sqrt();
        normal += density * step / (2.0 * PI).sqrt();
        let below = share * (-crossings * density / share.max(f64::MIN_POSITIVE)).exp();
        mean += step * if h > 0.0 { 1.0 - below } else { -below };
    }
    mean
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::physics::random_surface::{Autocorrelation, RandomSpectrum};

    fn made(seed: u64, correlation: [f64; 2]) -> Crests {
        let spectrum = RandomSpectrum {
            seed,
            autocorrelation: Autocorrelation::Gaussian,
            correlation_m: correlation,
            hurst: 0.8,
            cutoff_short_m: 0.5,
            cutoff_long_m: f64::INFINITY,
            period_m: [600.0, f64::INFINITY],
            skewness: 0.0,
            kurtosis: 3.0,
        };
        let map = spectrum.make().expect("it has waves");
        let mut row = vec![0.0_f32; map.nx()];
        map.row_into(0.0, &mut row);
        let row: Vec<f64> = row.iter().map(|&z| f64::from(z)).collect();
        Crests::new(map.nx(), &row, 600.0 / map.nx() as f64).expect("it varies")
    }

    /// A wave: one crest a length, found whatever the pixels; the highest over a length of it is known.
    #[test]
    fn a_wave_has_its_crests() {
        let n = 70;
        let row: Vec<f64> = (0..n)
            .map(|i| 3.0 * (TAU * 10.0 * (f64::from(i) + 0.3) / f64::from(n)).cos())
            .collect();
        let crests = Crests::new(n as usize, &row, 1.0 / f64::from(n)).expect("it varies");
        for found in [
            crests.maxima_per_m(),
            crests.upcrossings_per_m(),
            crests.maxima_expected_per_m(),
            crests.upcrossings_expected_per_m(),
        ] {
            assert!((found - 10.0).abs() < 1e-9, "{found}");
        }
        let whole = crests.highest(0.1);
        assert!(whole.mean_m > 2.99 && whole.low_m > 2.98, "{whole:?}");
        // No way at all: the heights themselves.
        let none = crests.highest(0.0);
        assert!(
            none.mean_m.abs() < 1e-9 && (none.high_m + none.low_m).abs() < 0.1,
            "{none:?}"
        );
        assert!(Crests::new(70, &[1.0; 70], 1.0).is_none());
    }

    /// Forty surfaces of correlation length 1: 0.390 maxima and 0.225 upcrossings a length; the mean of the highest over lengths of 0
    /// to 100 as the formula has it, within three standard errors beside what that is low by.
    #[test]
    fn made_surfaces_have_the_crests_of_their_spectrum() {
        let all: Vec<Crests> = (1..=40)
            .map(|seed| made(seed, [1.0, f64::INFINITY]))
            .collect();
        let mean = |of: &dyn Fn(&Crests) -> f64| {
            let found: Vec<f64> = all.iter().map(of).collect();
            let n = found.len() as f64;
            let mean = found.iter().sum::<f64>() / n;
            let square = found.iter().map(|v| (v - mean).powi(2)).sum::<f64>() / (n - 1.0);
            [mean, (square / n).sqrt()]
        };
        let near = |what: &str, [found, error]: [f64; 2], theirs: f64, room: f64| {
            println!("{what}: {found:.4} ± {error:.4}, {theirs:.4}");
            assert!(
                (found - theirs).abs() < 3.0 * error + room * theirs.abs(),
                "{what}"
            );
        };
        let upcrossings = 1.0 / (PI * 2_f64.sqrt());
        near("maxima", mean(&|c| c.maxima_per_m()), 0.38985, 0.0);
        near(
            "upcrossings",
            mean(&|c| c.upcrossings_per_m()),
            upcrossings,
            0.0,
        );
        // The approximation itself is that low where few correlation lengths pass.
        for (length, room) in [
            (0.0, 0.0),
            (1.0, 0.13),
            (5.0, 0.06),
            (20.0, 0.01),
            (100.0, 0.01),
        ] {
            let found = mean(&|c| c.highest(length).mean_m / c.rms_m());
            let theirs = mean_highest(length * upcrossings);
            near(&format!("highest over {length}"), found, theirs, room);
        }
    }
}
