//! Low ripples in a line contact: what of a harmonic is bound and what is convected, and the linear theory of a film.
#![expect(clippy::unwrap_used, reason = "tests")]

use std::cmp::Ordering;
use std::f64::consts::PI;

use asperity_engine::physics::eyring;
use asperity_engine::physics::fluid::{Density, Viscosity};
use asperity_engine::scene::{EyringFlow, Scene};
use rustfft::num_complex::Complex;

/// Waves of the fit: the bound one, x times it, the other one.
const WAVES: usize = 3;

/// `z = (α + α' x) e^{ikx} + β e^{ik'x}`: α and Σ|rest|², by least squares. The mean pressure's slope makes what is bound
/// grow along the contact by a term that is odd in x, and zero at the centre, where the closed form holds.
pub(crate) fn two_waves(
    x: &[f64],
    z: &[Complex<f64>],
    k: Complex<f64>,
    other: Complex<f64>,
) -> (Complex<f64>, f64) {
    let i = Complex::new(0.0, 1.0);
    let zero = Complex::new(0.0, 0.0);
    let length = x.iter().fold(0.0_f64, |most, x| most.max(x.abs()));
    let waves = |x: f64| {
        let bound = (i * k * x).exp();
        [bound, bound * (x / length), (i * other * x).exp()]
    };
    let mut rows = [[zero; WAVES + 1]; WAVES];
    for (&x, &z) in x.iter().zip(z) {
        let waves = waves(x);
        for (row, wave) in rows.iter_mut().zip(waves) {
            for (sum, value) in row.iter_mut().zip(waves.into_iter().chain([z])) {
                *sum += wave.conj() * value;
            }
        }
    }
    // Gauss without a choice of pivots: the normal equations of three independent waves are positive definite.
    for n in 0..WAVES {
        let (above, below) = rows.split_at_mut(n + 1);
        let pivot = above[n];
        for row in below {
            let factor = row[n] / pivot[n];
            for (value, pivot) in row.iter_mut().zip(pivot) {
                *value -= factor * pivot;
            }
        }
    }
    let mut found = [zero; WAVES];
    for n in (0..WAVES).rev() {
        let known: Complex<f64> = (n + 1..WAVES).map(|m| rows[n][m] * found[m]).sum();
        found[n] = (rows[n][WAVES] - known) / rows[n][n];
    }
    let rest = |x: f64, z: Complex<f64>| {
        let sum: Complex<f64> = waves(x)
            .into_iter()
            .zip(found)
            .map(|(wave, a)| wave * a)
            .sum();
        (z - sum).norm_sqr()
    };
    (found[0], x.iter().zip(z).map(|(&x, &z)| rest(x, z)).sum())
}

/// The complex wavenumber of the other wave that leaves the least rest, from a first guess.
pub(crate) fn other_wave(
    x: &[f64],
    z: &[Complex<f64>],
    k: Complex<f64>,
    guess: Complex<f64>,
) -> Complex<f64> {
    let mut best = guess;
    let mut least = two_waves(x, z, k, best).1;
    let mut step = 0.2 * guess.norm();
    while step > 1e-5 * guess.norm() {
        let ways = [(1.0, 0.0), (-1.0, 0.0), (0.0, 1.0), (0.0, -1.0)];
        let better = ways.iter().find_map(|&(re, im)| {
            let tried = best + Complex::new(re, im) * step;
            let rest = two_waves(x, z, k, tried).1;
            (rest < least).then_some((tried, rest))
        });
        match better {
            Some(found) => (best, least) = found,
            None => step *= 0.5,
        }
    }
    best
}

/// A steady film along x, from node to node.
pub(crate) struct SteadyFilm {
    pub(crate) x_m: Vec<f64>,
    pub(crate) film_m: Vec<f64>,
    pub(crate) pressure_pa: Vec<f64>,
}

/// The oil at a pressure: density over ρ0 and its slope.
fn density(scene: &Scene, p: f64) -> (f64, f64) {
    let p_hertz = scene.hertz().p_max_pa;
    let law = Density::DowsonHigginson {
        p_hertz_gpa: 1e-9 * p_hertz,
    };
    let (rho, slope) = law.rho(p / p_hertz);
    (rho, slope / p_hertz)
}

/// ρh³/(12 η) along the sliding.
fn conductance(scene: &Scene, p: f64, h: f64) -> f64 {
    let oil = scene.lubricant.as_ref().unwrap();
    let p_hertz = scene.hertz().p_max_pa;
    let law = Viscosity::roelands(
        oil.viscosity_pa_s(),
        oil.pressure_viscosity_per_pa(),
        p_hertz,
    );
    let eta = oil.viscosity_pa_s() * law.ln_eta(p / p_hertz).0.exp();
    let sliding = (scene.motion.slide_roll * scene.motion.entrainment_m_s).abs();
    let free = (eta * sliding / (oil.eyring_stress_pa * h)).asinh();
    let thin = match oil.eyring_flow {
        EyringFlow::Secant => eyring::across(free.exp()).0,
        EyringFlow::AlongAcross => {
            let most = oil.limiting_shear_ratio * p / oil.eyring_stress_pa;
            eyring::along(free.min(most).exp()).0
        }
    };
    density(scene, p).0 * h.powi(3) * thin / (12.0 * eta)
}

/// Film of a ripple of amplitude 1 at wavenumber k of body 1 in the steady film `base`: the Reynolds equation linearised
/// about it and solved for the frequency ω = k u1, the whole contact with its inlet and outlet, without steps in time.
///
/// ```text
/// ∂x[c ∂x p̃ + ∂x p (c_p p̃ + c_h h̃)] = (U ∂x − iω)(ρ h̃ + ρ' h p̃),   c = ρh³/(12η)
/// h̃ = e^{ikx} + h̃0 − (4/(πE')) ∫ p̃ ln|x − s| ds,   ∫ p̃ = 0,   p̃ = 0 where there is no pressure
/// ```
/// Central differences, of the fourth order where oil is carried; the kernel integrated over cells; dense elimination.
pub(crate) fn linear_theory(scene: &Scene, base: &SteadyFilm, k: f64) -> Vec<Complex<f64>> {
    let SteadyFilm {
        x_m,
        film_m,
        pressure_pa,
    } = base;
    let (all, d) = (x_m.len(), x_m[1] - x_m[0]);
    let [body, _] = scene.speeds_m_s();
    let mean = scene.motion.entrainment_m_s;
    let pressed: Vec<usize> = (2..all - 2).filter(|&n| pressure_pa[n] > 0.0).collect();
    let size = pressed.len() + 1;
    let zero = Complex::new(0.0, 0.0);
    // Columns: p̃ of the pressed nodes, h̃0, and what is known.
    let response: Vec<f64> = (0..all)
        .map(|m| {
            let primitive = |s: f64| {
                if s == 0.0 {
                    0.0
                } else {
                    s * (s.abs().ln() - 1.0)
                }
            };
            let far = d * m as f64;
            let cell = primitive(far + 0.5 * d) - primitive(far - 0.5 * d);
            -4.0 / (PI * scene.e_prime_pa()) * cell
        })
        .collect();
    let film = |n: usize, column: usize| -> Complex<f64> {
        match (column + 1).cmp(&size) {
            Ordering::Less => Complex::new(response[n.abs_diff(pressed[column])], 0.0),
            Ordering::Equal => Complex::new(1.0, 0.0),
            Ordering::Greater => Complex::new(0.0, k * x_m[n]).exp(),
        }
    };
    let own =
        |n: usize, column: usize| f64::from(u8::from(column + 1 < size && pressed[column] == n));
    let slopes: Vec<[f64; 5]> = (0..all)
        .map(|n| {
            let (p, h) = (pressure_pa[n], film_m[n]);
            let (rho, rho_p) = density(scene, p);
            let c = |p: f64, h: f64| conductance(scene, p, h);
            let (dp, dh) = (1e-6 * scene.hertz().p_max_pa, 1e-6 * h);
            let by_p = (c(p + dp, h) - c((p - dp).max(0.0), h)) / (dp + dp.min(p));
            let by_h = (c(p, h + dh) - c(p, h - dh)) / (2.0 * dh);
            [rho, rho_p * h, c(p, h), by_p, by_h]
        })
        .collect();
    let stored =
        |n: usize, column: usize| film(n, column) * slopes[n][0] + own(n, column) * slopes[n][1];
    let flow = |n: usize, column: usize| -> Complex<f64> {
        // Through the face behind node n.
        let m = n + 1;
        let rise = (pressure_pa[m] - pressure_pa[n]) / d;
        let change = |n: usize| film(n, column) * slopes[n][4] + own(n, column) * slopes[n][3];
        let slope = (own(m, column) - own(n, column)) / d;
        (change(n) + change(m)) * (0.5 * rise) + 0.5 * (slopes[n][2] + slopes[m][2]) * slope
    };
    let omega = k * body;
    let mut rows: Vec<Vec<Complex<f64>>> = pressed
        .iter()
        .map(|&n| {
            let mut row: Vec<Complex<f64>> = (0..=size)
                .map(|column| {
                    let at = |n: usize| stored(n, column);
                    let along =
                        (at(n - 2) - at(n + 2) + (at(n + 1) - at(n - 1)) * 8.0) / (12.0 * d);
                    let carried = along * mean - at(n) * Complex::new(0.0, omega);
                    (flow(n, column) - flow(n - 1, column)) / d - carried
                })
                .collect();
            row[size] = -row[size];
            row
        })
        .collect();
    // ∫ p̃ = 0, in units of the deflection.
    let mut load = vec![zero; size + 1];
    load[..size - 1].fill(Complex::new(response[1].abs(), 0.0));
    rows.push(load);
    let found = eliminate(rows);
    (0..all)
        .map(|n| {
            let known = film(n, size);
            (0..size)
                .map(|c| film(n, c) * found[c])
                .fold(known, |sum, v| sum + v)
        })
        .collect()
}

/// The solution of a system whose last column is its right-hand side, with row pivots.
fn eliminate(mut rows: Vec<Vec<Complex<f64>>>) -> Vec<Complex<f64>> {
    let size = rows.len();
    for row in &mut rows {
        let most = row[..size].iter().map(|v| v.norm()).fold(0.0, f64::max);
        for value in row {
            *value /= most;
        }
    }
    for n in 0..size {
        let best = (n..size).max_by(|&a, &b| rows[a][n].norm().total_cmp(&rows[b][n].norm()));
        rows.swap(n, best.unwrap());
        let (above, below) = rows.split_at_mut(n + 1);
        let pivot = &above[n];
        for row in below {
            let factor = row[n] / pivot[n];
            for (value, pivot) in row[n..].iter_mut().zip(&pivot[n..]) {
                *value -= factor * pivot;
            }
        }
    }
    let mut found = vec![Complex::new(0.0, 0.0); size];
    for n in (0..size).rev() {
        let known: Complex<f64> = (n + 1..size).map(|m| rows[n][m] * found[m]).sum();
        found[n] = (rows[n][size] - known) / rows[n][n];
    }
    found
}
