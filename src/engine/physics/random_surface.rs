//! Made surfaces: a sample of a Gaussian process with a given spectrum, periodic, by its modes.
//!
//! ```text
//! z(x, y) = Re Σ_mn √C(q_mn) (g₁ + i g₂) e^{2πi (m x/P_x + n y/P_y)},   q = (m/P_x, n/P_y),   1/λ_long ≤ |q| ≤ 1/λ_short
//! gaussian      R = e^{−r²}     C ∝ e^{−(πρ)²}                ridges  e^{−(πρ)²}
//! exponential   R = e^{−r}      C ∝ (1 + (2πρ)²)^{−3/2}               (1 + (2πρ)²)^{−1}
//! self_affine                   C ∝ ρ^{−2(1+H)}                       ρ^{−(1+2H)}
//! r² = (x/L_x)² + (y/L_y)²,   ρ² = (q_x L_x)² + (q_y L_y)²
//! ```
//! | symbol | meaning | unit |
//! |---|---|---|
//! | P_x, P_y | period | m |
//! | L_x, L_y | correlation length, in which R falls to 1/e; ∞: ridges, which do not vary that way | m |
//! | λ_short, λ_long | shortest and longest wave that the surface has, whichever way it runs | m |
//! | H | Hurst exponent | |
//! | g | standard normal numbers, drawn for (seed, m, n) alone | |
//!
//! Heights are scaled to Sq = `rq_m` exactly; their spectrum is a sample, as that of a patch of a real surface is. A mode's
//! number does not depend on which other modes there are: a shorter cut-off adds waves to the same surface. Spectra: Nayak
//! (1971), J. Lubr. Technol. 93, 398-407; Persson et al. (2005), J. Phys.: Condens. Matter 17, R1-R62 (self-affine).
//! Heights of another skewness and kurtosis: waves keep their height and are turned until the heights have the distribution of
//! [`HeightDistribution`] as nearly as the waves allow (Schreiber and Schmitz 1996, Phys. Rev. Lett. 77, 635-638).

use std::f64::consts::{PI, TAU};

use rand_chacha::ChaCha8Rng;
use rand_chacha::rand_core::{RngCore as _, SeedableRng as _};
use rustfft::num_complex::Complex;
use rustfft::{FftDirection, FftPlanner};

use super::height_distribution::HeightDistribution;
use super::height_map::HeightMap;

crate::closed_set! {
    /// How heights at two places are related.
    #[derive(Default)]
    pub enum Autocorrelation {
        /// e^{−r}: peaks of every size, as ground surfaces have.
        #[default]
        Exponential = "exponential",
        /// e^{−r²}: smooth below the correlation length.
        Gaussian = "gaussian",
        /// A power law between the cut-offs.
        SelfAffine = "self_affine",
    }
}

/// What a surface is made by.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct RandomSpectrum {
    /// Which surface of that kind.
    pub seed: u64,
    /// The law.
    pub autocorrelation: Autocorrelation,
    /// L_x, L_y, m; ∞: no waves that way.
    pub correlation_m: [f64; 2],
    /// H, read by the power law alone.
    pub hurst: f64,
    /// λ_short, m.
    pub cutoff_short_m: f64,
    /// λ_long, m; ∞: none but the period.
    pub cutoff_long_m: f64,
    /// P_x, P_y, m.
    pub period_m: [f64; 2],
    /// Ssk; 0: normal.
    pub skewness: f64,
    /// Sku; 3: normal.
    pub kurtosis: f64,
}

/// Pixels of the shortest wave: cubic convolution then leaves less than a hundredth of Rq (a test measures it).
const PIXELS_OF_WAVE: f64 = 8.0;
/// Numbers of modes are told apart below this.
const MOST_MODES: u64 = 1 << 20;

impl RandomSpectrum {
    /// Highest mode along x and y.
    fn modes(&self) -> [usize; 2] {
        let of = |k: usize| {
            if self.correlation_m[k].is_finite() {
                (self.period_m[k] / self.cutoff_short_m * (1.0 + 1e-12)) as usize
            } else {
                0
            }
        };
        [of(0), of(1)]
    }

    /// Pixels along x and y; 1 where nothing varies.
    pub fn pixels(&self) -> [usize; 2] {
        let of = |modes: usize| match modes {
            0 => 1,
            modes => ((PIXELS_OF_WAVE * modes as f64) as usize).next_multiple_of(16),
        };
        self.modes().map(of)
    }

    /// √C of a wave of wavenumbers `q`, 1/m, over an arbitrary constant; 0 beyond the cut-offs.
    fn amplitude(&self, q: [f64; 2]) -> f64 {
        let wave = q[0].hypot(q[1]);
        let slack = 1.0 + 1e-9;
        if wave * self.cutoff_short_m > slack || wave * self.cutoff_long_m < 1.0 / slack {
            return 0.0;
        }
        let is_ridge = self.correlation_m.iter().any(|length| length.is_infinite());
        let reach = |k: usize| {
            if self.correlation_m[k].is_finite() {
                q[k] * self.correlation_m[k]
            } else {
                0.0
            }
        };
        let rho = reach(0).hypot(reach(1));
        let power: f64 = match (self.autocorrelation, is_ridge) {
            (Autocorrelation::Gaussian, _) => (-(PI * rho).powi(2)).exp(),
            (Autocorrelation::Exponential, false) => (1.0 + (TAU * rho).powi(2)).powf(-1.5),
            (Autocorrelation::Exponential, true) => 1.0 / (1.0 + (TAU * rho).powi(2)),
            (Autocorrelation::SelfAffine, false) => rho.powf(-2.0 - 2.0 * self.hurst),
            (Autocorrelation::SelfAffine, true) => rho.powf(-1.0 - 2.0 * self.hurst),
        };
        power.sqrt()
    }

    /// The modes that the surface has: m, n and their complex amplitude, over an arbitrary constant; half of the plane,
    /// the other half is its mirror image.
    fn waves(&self) -> impl Iterator<Item = ([i64; 2], Complex<f64>)> + '_ {
        let [along, across] = self.modes().map(|k| k as i64);
        let mut random = ChaCha8Rng::seed_from_u64(self.seed);
        let all = (0..=across).flat_map(move |n| {
            let from = if n == 0 { 1 } else { -along };
            (from..=along).map(move |m| [m, n])
        });
        all.filter_map(move |[m, n]| {
            let amplitude =
                self.amplitude([m as f64 / self.period_m[0], n as f64 / self.period_m[1]]);
            if amplitude == 0.0 {
                return None;
            }
            let [one, two] = normals(&mut random, m, n);
            Some(([m, n], Complex::new(amplitude * one, amplitude * two)))
        })
    }

    /// The surface on its pixels; `None`: no wave lies between the cut-offs, or no heights have that skewness and kurtosis.
    pub fn make(&self) -> Option<HeightMap> {
        let [nx, ny] = self.pixels();
        let mut planes = Planes::new(nx, ny);
        let mut waves: Vec<_> = self.waves().collect();
        let mut heights = planes.heights(&waves);
        if self.is_shaped() {
            let sorted = HeightDistribution::new(self.skewness, self.kurtosis)?.quantiles(nx * ny);
            for _ in 0..TURNS {
                put_in_order(&mut heights, &sorted);
                planes.turn(&heights, &mut waves);
                heights = planes.heights(&waves);
            }
        }
        HeightMap::made(nx, &heights)
    }

    /// Whether its heights are other than normal.
    pub fn is_shaped(&self) -> bool {
        self.skewness != 0.0 || self.kurtosis != 3.0
    }
}

/// Turns between the heights asked for and the spectrum asked for. The spectrum has the last word, so that the cut-off holds; the
/// moments that are left are printed.
const TURNS: usize = 20;

/// Gives the heights the values of `sorted`, the order among them kept.
fn put_in_order(heights: &mut [f64], sorted: &[f64]) {
    let mut order: Vec<usize> = (0..heights.len()).collect();
    order.sort_by(|&a, &b| heights[a].total_cmp(&heights[b]));
    for (place, value) in order.into_iter().zip(sorted) {
        heights[place] = *value;
    }
}

/// Waves m, n and their complex amplitudes.
type Waves = [([i64; 2], Complex<f64>)];

/// Transforms between waves and heights on pixels.
struct Planes {
    nx: usize,
    ny: usize,
    plan: FftPlanner<f64>,
    values: Vec<Complex<f64>>,
}

impl Planes {
    fn new(nx: usize, ny: usize) -> Self {
        Self {
            nx,
            ny,
            plan: FftPlanner::new(),
            values: vec![Complex::default(); nx * ny],
        }
    }

    fn place(&self, [m, n]: [i64; 2]) -> usize {
        n as usize * self.nx + m.rem_euclid(self.nx as i64) as usize
    }

    fn transform(&mut self, direction: FftDirection) {
        let (nx, ny) = (self.nx, self.ny);
        let along = self.plan.plan_fft(nx, direction);
        for row in self.values.chunks_exact_mut(nx) {
            along.process(row);
        }
        let across = self.plan.plan_fft(ny, direction);
        let mut column = vec![Complex::default(); ny];
        for i in 0..nx {
            for (j, value) in column.iter_mut().enumerate() {
                *value = self.values[j * nx + i];
            }
            across.process(&mut column);
            for (j, value) in column.iter().enumerate() {
                self.values[j * nx + i] = *value;
            }
        }
    }

    /// Re Σ of the waves.
    fn heights(&mut self, waves: &Waves) -> Vec<f64> {
        self.values.fill(Complex::default());
        for &(wave, amplitude) in waves {
            let place = self.place(wave);
            self.values[place] = amplitude;
        }
        self.transform(FftDirection::Inverse);
        self.values.iter().map(|value| value.re).collect()
    }

    /// Turns each wave to its phase in `heights`; how high it is stays.
    fn turn(&mut self, heights: &[f64], waves: &mut Waves) {
        for (value, &height) in self.values.iter_mut().zip(heights) {
            *value = Complex::new(height, 0.0);
        }
        self.transform(FftDirection::Forward);
        for (wave, amplitude) in waves {
            let found = self.values[self.place(*wave)];
            if found.norm() > 0.0 {
                *amplitude = found / found.norm() * amplitude.norm();
            }
        }
    }
}

/// Two standard normal numbers of a mode (Box and Muller).
fn normals(random: &mut ChaCha8Rng, m: i64, n: i64) -> [f64; 2] {
    let place = (n as u64 * 2 * MOST_MODES) | (m + MOST_MODES as i64) as u64;
    random.set_word_pos(4 * u128::from(place));
    let mut uniform = || ((random.next_u64() >> 11) + 1) as f64 / (1_u64 << 53) as f64;
    let (radius, angle) = ((-2.0 * uniform().ln()).sqrt(), TAU * uniform());
    [radius * angle.cos(), radius * angle.sin()]
}
