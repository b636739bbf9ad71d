//! Plane waves in a row of the film: what moves with one frequency, and which wavenumbers it is made of.
//!
//! ```text
//! z(x) = Σ_n 2 w_n (f_n(x) − f̄(x)) e^{iωt_n} / N          w: Hann's window over whole periods
//! z(x) = (α + α' x/l) e^{ikx} + β e^{ik'x}                 by least squares; α' where the mean pressure has a slope
//! ```

use std::f64::consts::TAU;

use rustfft::num_complex::Complex;

use asperity_engine::plan::Plan;
use asperity_engine::scene::Scene;
use asperity_engine::sim::{Frame, Simulation, Stage};

/// Periods that are read.
const PERIODS: f64 = 4.0;

/// The nodes of y = 0 with |x| within the window.
pub(super) struct Read {
    /// Places, a.
    pub(super) x_a: Vec<f64>,
    /// Film that moves with the frequency, m.
    pub(super) film: Vec<Complex<f64>>,
    /// Pressure that does, Pa.
    pub(super) pressure: Vec<Complex<f64>>,
    /// Mean film, m.
    pub(super) film_m: f64,
    /// Mean pressure, Pa.
    pub(super) pressure_pa: f64,
}

/// Marches `scene` and reads the harmonic of angular frequency `omega` where |x| ≤ `reach` a: f = Re z e^{−iωt}.
pub(super) fn read(scene: &Scene, plan: &Plan, omega: f64, reach: f64) -> Result<Read, String> {
    let samples = (PERIODS * TAU / (omega * plan.dt_s)).round() as usize;
    let dt = plan.dt_s;
    let mut sim = Simulation::new(scene, plan.clone(), 1).map_err(|error| error.to_string())?;
    let mut frame = Frame::default();
    let mut inside: Vec<usize> = Vec::new();
    let mut rows: [Vec<Vec<f64>>; 2] = [Vec::new(), Vec::new()];
    while rows[0].len() < samples {
        sim.step().map_err(|error| error.to_string())?;
        if sim.stage() != Stage::Passage {
            continue;
        }
        if !sim.metrics().converged {
            return Err(format!("step {} did not converge", sim.passage_steps()));
        }
        sim.fill(&mut frame);
        if inside.is_empty() {
            let x = |i: usize| (frame.x_min_m + frame.dx_m * i as f64) / frame.a_m;
            inside = (0..frame.nx)
                .filter(|&i| x(i).abs() <= reach + 1e-9)
                .collect();
        }
        let start = frame.ny / 2 * frame.nx;
        for (rows, field) in rows.iter_mut().zip([&frame.film_m, &frame.pressure_pa]) {
            rows.push(
                inside
                    .iter()
                    .map(|&i| f64::from(field[start + i]))
                    .collect(),
            );
        }
    }
    let [films, pressures] = rows;
    let window = |n: usize| 1.0 - (TAU * (n as f64 + 0.5) / samples as f64).cos();
    let mean = |rows: &[Vec<f64>], i: usize| {
        (0..samples).map(|n| window(n) * rows[n][i]).sum::<f64>() / samples as f64
    };
    let harmonic = |rows: &[Vec<f64>], i: usize| -> Complex<f64> {
        let mean = mean(rows, i);
        let terms = (0..samples).map(|n| {
            let turned = Complex::from_polar(1.0, omega * dt * n as f64);
            turned * (2.0 * window(n) * (rows[n][i] - mean) / samples as f64)
        });
        terms.sum()
    };
    let all = |rows: &[Vec<f64>]| (0..inside.len()).map(|i| harmonic(rows, i)).collect();
    let over_window = |rows: &[Vec<f64>]| {
        (0..inside.len()).map(|i| mean(rows, i)).sum::<f64>() / inside.len() as f64
    };
    Ok(Read {
        x_a: inside
            .iter()
            .map(|&i| (frame.x_min_m + frame.dx_m * i as f64) / frame.a_m)
            .collect(),
        film: all(&films),
        pressure: all(&pressures),
        film_m: over_window(&films),
        pressure_pa: over_window(&pressures),
    })
}

/// Two wavenumbers that a row is made of, in 1/a.
#[derive(Debug, Clone, Copy)]
pub(super) struct FittedWaves {
    /// Of what is bound to the body.
    pub(super) bound: f64,
    /// Of the other one, with its decay.
    pub(super) other: Complex<f64>,
    /// Whether the bound one may grow along x.
    pub(super) grows: bool,
}

impl FittedWaves {
    fn at(self, x: f64) -> [Complex<f64>; 3] {
        let i = Complex::new(0.0, 1.0);
        let bound = (i * self.bound * x).exp();
        let grown = if self.grows { x } else { 0.0 };
        [bound, (i * self.other * x).exp(), bound * grown]
    }

    /// Amplitudes of the bound and the other wave at x = 0, and Σ|rest|², by least squares.
    pub(super) fn fit(self, x: &[f64], z: &[Complex<f64>]) -> ([Complex<f64>; 2], f64) {
        const MOST: usize = 3;
        let count = if self.grows { MOST } else { MOST - 1 };
        let zero = Complex::new(0.0, 0.0);
        let mut rows = [[zero; MOST + 1]; MOST];
        for (&x, &z) in x.iter().zip(z) {
            let waves = self.at(x);
            for (row, wave) in rows.iter_mut().zip(waves).take(count) {
                for (sum, value) in row.iter_mut().zip(waves.into_iter().chain([z])) {
                    *sum += wave.conj() * value;
                }
            }
        }
        // Gauss without a choice of pivots: the normal equations of independent waves are positive definite.
        for n in 0..count {
            let (above, below) = rows.split_at_mut(n + 1);
            let pivot = above[n];
            for row in below.iter_mut().take(count - n - 1) {
                let factor = row[n] / pivot[n];
                for (value, pivot) in row.iter_mut().zip(pivot) {
                    *value -= factor * pivot;
                }
            }
        }
        let mut found = [zero; MOST];
        for n in (0..count).rev() {
            let known: Complex<f64> = (n + 1..count).map(|m| rows[n][m] * found[m]).sum();
            found[n] = (rows[n][MOST] - known) / rows[n][n];
        }
        let rest = |(&x, &z): (&f64, &Complex<f64>)| {
            let waves = self.at(x);
            let sum: Complex<f64> = (0..count).map(|n| waves[n] * found[n]).sum();
            (z - sum).norm_sqr()
        };
        ([found[0], found[1]], x.iter().zip(z).map(rest).sum())
    }

    /// The same with the other wavenumber that leaves the least rest, searched from the one given.
    pub(super) fn best(self, x: &[f64], z: &[Complex<f64>]) -> Self {
        let mut best = self;
        let mut least = best.fit(x, z).1;
        let size = self.other.norm();
        let mut step = 0.2 * size;
        while step > 1e-5 * size {
            let ways = [(1.0, 0.0), (-1.0, 0.0), (0.0, 1.0), (0.0, -1.0)];
            let better = ways.iter().find_map(|&(re, im)| {
                let tried = Self {
                    other: best.other + Complex::new(re, im) * step,
                    ..best
                };
                let rest = tried.fit(x, z).1;
                (rest < least).then_some((tried, rest))
            });
            match better {
                Some(found) => (best, least) = found,
                None => step *= 0.5,
            }
        }
        best
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn waves_that_are_there_are_found() {
        let i = Complex::new(0.0, 1.0);
        let (bound, other) = (12.0, Complex::new(5.0, 0.7));
        let x: Vec<f64> = (0..81).map(|n| -0.6 + 0.015 * f64::from(n)).collect();
        let z: Vec<_> = x
            .iter()
            .map(|&x| (i * bound * x).exp() * (0.3 + 0.1 * x) + (i * other * x).exp() * 0.8)
            .collect();
        let waves = FittedWaves {
            bound,
            other: Complex::new(4.5, 0.3),
            grows: true,
        };
        let found = waves.best(&x, &z);
        let ([one, two], rest) = found.fit(&x, &z);
        assert!((found.other - other).norm() < 1e-2, "{}", found.other);
        assert!((one.norm() - 0.3).abs() < 2e-3 && (two.norm() - 0.8).abs() < 2e-3);
        assert!(rest < 1e-4, "{rest}");
        // Without the growth something is left.
        let stiff = FittedWaves {
            grows: false,
            ..found
        };
        assert!(stiff.fit(&x, &z).1 > 100.0 * rest);
    }
}
