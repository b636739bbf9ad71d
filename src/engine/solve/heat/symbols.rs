//! How heat of a step, and of the steps before, warms a half-space that moves: in wave space. Part of `heat.rs`.
//!
//! ```text
//! T^(t) = (√κ/k_c) ∫_0^∞ q^(t − s) e^{−μ s}/√(π s) ds,   μ = κ|k|² + i k_x V             (Carslaw & Jaeger 1959, by waves)
//! between steps   q^(t − s) = e^{i k_x U s} [(1 − s/Δt) q^_n + (s/Δt) q^_{n−1} e^{−i k_x U Δt}]
//! last step       E_0 = ∫_0^Δt e^{−ν s}/√(π s) ds,   E_1 = ∫_0^Δt (s/Δt) e^{−ν s}/√(π s) ds,   ν = μ − i k_x U
//! before          1/√(π s) = Σ_j w_j e^{−λ_j s}:   (2/π) ∫ e^{y − e^{2y} s} dy by the trapezoidal rule
//! ```
//! | symbol | meaning | unit |
//! |---|---|---|
//! | κ, k_c | diffusivity, conductivity | m²/s, W/(m K) |
//! | V, U | speed of the body, and at which sources move on the whole | m/s |
//! | q | heat that enters the body | W/m² |
//!
//! Exact in the speed of the body, 0 included. The sum of exponentials is good to 1e-3 from a quarter of a step to a thousand.

use rayon::prelude::*;
use rustfft::num_complex::Complex;

use super::plane::Plane;
use super::{BLOCK, GONE, Thermal};
use crate::math::quadrature::gauss_legendre;

/// Spacing in y of the exponentials: a relative error of exp(−π²/(2·0.7)).
const SPACING: f64 = 0.7;
/// Reach of the sum, in steps.
const REACH: [f64; 2] = [0.25, 1024.0];
/// y beyond both ends.
const TAILS: [f64; 2] = [2.0, 1.2];
/// Nodes of the integrals over a step up to |νΔt| = 4 and beyond; from which Re νΔt on they are done by their limit.
const NODES: [usize; 2] = [14, 40];
const NEAR: f64 = 4.0;
const LIMIT: f64 = 60.0;

/// What does not change with the wave: λ_j in 1/s and w_j.
pub(super) fn exponentials(dt_s: f64) -> Vec<[f64; 2]> {
    let y_of = |steps: f64| -0.5 * (steps * dt_s).ln();
    let (first, last) = (y_of(REACH[1]) - TAILS[0], y_of(REACH[0]) + TAILS[1]);
    let n = ((last - first) / SPACING).ceil() as usize;
    let term = |i: usize| {
        let y = first + SPACING * i as f64;
        let weight = 2.0 / std::f64::consts::PI * y.exp();
        [(2.0 * y).exp(), SPACING * weight]
    };
    // What lies below the first one does not decay within the reach: half of its own interval begins there.
    let tail = 2.0 / std::f64::consts::PI * (first - 0.5 * SPACING).exp();
    let mut all: Vec<[f64; 2]> = (0..=n).map(term).collect();
    all.push([0.0, tail]);
    all
}

/// How many there are.
pub(super) fn n_exponentials() -> usize {
    let span = 0.5 * (REACH[1] / REACH[0]).ln() + TAILS[0] + TAILS[1];
    (span / SPACING).ceil() as usize + 2
}

/// Tables of one body for one step length and speed.
pub(super) struct Symbols {
    /// (√κ/k_c)(E_0 − E_1): what the heat of now does, and the mean of it over all waves.
    pub(super) own: Vec<Complex<f64>>,
    pub(super) mean: f64,
    /// (√κ/k_c) E_1: what that of the last step does, turned to now.
    pub(super) last: Vec<Complex<f64>>,
    /// Of each mode: e^{−(λ_j + μ)Δt}, and what the heat of the last step and of the last but one adds; in blocks as the modes.
    pub(super) modes: Vec<[Complex<f32>; 3]>,
}

impl Symbols {
    /// `length_m`: the plane's unit of length; `v_m_s`, `u_m_s`: V and U.
    pub(super) fn new(
        plane: &Plane,
        length_m: f64,
        thermal: Thermal,
        [v_m_s, u_m_s]: [f64; 2],
        dt_s: f64,
        exponentials: &[[f64; 2]],
    ) -> Self {
        let scale = thermal.diffusivity.sqrt() / thermal.conductivity;
        let rules = NODES.map(gauss_legendre);
        let (n, zero) = (plane.len(), Complex::default());
        let (mut own, mut last) = (vec![zero; n], vec![zero; n]);
        let mut modes = vec![[Complex::default(); 3]; n * exponentials.len()];
        (own.par_chunks_mut(BLOCK).zip(last.par_chunks_mut(BLOCK)))
            .zip(modes.par_chunks_mut(BLOCK * exponentials.len()))
            .enumerate()
            .for_each(|(block, ((own, last), modes))| {
                let width = own.len();
                for k in 0..width {
                    let [kx, ky] = plane.wave(block * BLOCK + k).map(|k| k / length_m);
                    let spread = thermal.diffusivity * (kx * kx + ky * ky);
                    let mu = Complex::new(spread, kx * v_m_s) * dt_s;
                    let nu = Complex::new(spread, kx * (v_m_s - u_m_s)) * dt_s;
                    let rule = &rules[usize::from(nu.norm_sqr() > NEAR * NEAR)];
                    let [whole, first] = over_step(rule, nu).map(|e| e * (scale * dt_s.sqrt()));
                    let turn = Complex::new(0.0, -kx * u_m_s * dt_s).exp();
                    own[k] = whole - first;
                    last[k] = first * turn;
                    for (mode, [rate, weight]) in exponentials.iter().enumerate() {
                        modes[mode * width + k] =
                            factors(mu, nu, turn, rate * dt_s, weight * scale * dt_s);
                    }
                }
            });
        let mean = own.iter().map(|own| own.re).sum::<f64>() / n as f64;
        Self {
            own,
            mean,
            last,
            modes,
        }
    }
}

/// What a step makes of a mode that fades by `slow` in it, and of the heat before it.
fn factors(
    mu: Complex<f64>,
    nu: Complex<f64>,
    turn: Complex<f64>,
    slow: f64,
    weight: f64,
) -> [Complex<f32>; 3] {
    if nu.re + slow > GONE {
        return [Complex::default(); 3];
    }
    let decay = (-(mu + slow)).exp();
    // e^{−ν} = e^{−μ} e^{i k U Δt}.
    let [here, there] = weights_before(nu + slow, decay * turn.conj());
    let narrow = |c: Complex<f64>| Complex::new(c.re as f32, c.im as f32);
    [decay, here * decay * weight, there * turn * decay * weight].map(narrow)
}

/// ∫_0^1 e^{−z r}/√(π r) dr and ∫_0^1 r e^{−z r}/√(π r) dr, by r = x².
fn over_step((nodes, weights): &(Vec<f64>, Vec<f64>), z: Complex<f64>) -> [Complex<f64>; 2] {
    if z.re > LIMIT {
        let whole = z.sqrt().inv();
        return [whole, whole / (2.0 * z)];
    }
    let mut sums = [Complex::default(); 2];
    for (x, weight) in nodes.iter().zip(weights) {
        let one = (-z * (x * x)).exp() * *weight;
        sums[0] += one;
        sums[1] += one * (x * x);
    }
    sums.map(|sum| sum * (2.0 / std::f64::consts::PI.sqrt()))
}

/// ∫_0^1 e^{−z r} dr − ∫_0^1 r e^{−z r} dr, and the latter, where `e` is e^{−z}.
fn weights_before(z: Complex<f64>, e: Complex<f64>) -> [Complex<f64>; 2] {
    if z.norm_sqr() < 1e-4 {
        let whole = 1.0 - z / 2.0 + z * z / 6.0;
        let first = 0.5 - z / 3.0 + z * z / 8.0;
        return [whole - first, first];
    }
    let over = z.conj() / z.norm_sqr();
    let whole = (1.0 - e) * over;
    let first = (whole - e) * over;
    [whole - first, first]
}
