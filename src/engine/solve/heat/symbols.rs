//! How heat of a step, and of the steps before, warms a half-space that moves: in wave space. Part of `heat.rs`.
//!
//! ```text
//! T^(t) = (√κ/k_c) ∫_0^∞ q^(t − s) e^{−μ s}/√(π s) ds,   μ = κ|k|² + i k_x V             (Carslaw & Jaeger 1959, by waves)
//! between steps   q^(t − s) = e^{i k_x U s} [(1 − s/Δt) q^_n + (s/Δt) q^_{n−1} e^{−i k_x U Δt}]
//! last step       E_0 = ∫_0^Δt e^{−ν s}/√(π s) ds,   E_1 = ∫_0^Δt (s/Δt) e^{−ν s}/√(π s) ds,   ν = μ − i k_x U
//! before          1/√(π s) = Σ_j w_j e^{−λ_j s}
//! ```
//! | symbol | meaning | unit |
//! |---|---|---|
//! | κ, k_c | diffusivity, conductivity | m²/s, W/(m K) |
//! | V, U | speed of the body, and at which sources move on the whole | m/s |
//! | q | heat that enters the body | W/m² |
//!
//! Exact in the speed of the body, 0 included. Ours: the sum of exponentials, fitted so that its greatest relative error is least,
//! 1e-3 from a quarter of a step to 16384; older heat fades. The trapezoidal rule over λ takes three more for 4e-3 and a sixteenth.

use rayon::prelude::*;
use rustfft::num_complex::Complex;

use super::plane::Plane;
use super::{BLOCK, GONE, Thermal};
use crate::math::quadrature::gauss_legendre;

/// λ_j and w_j for a step of 1.
pub(super) const EXPONENTIALS: [[f64; 2]; 10] = [
    [2.78642e-5, 6.83873e-3],
    [2.92905e-4, 8.64208e-3],
    [1.17614e-3, 1.40161e-2],
    [4.13082e-3, 2.54135e-2],
    [1.42598e-2, 4.70331e-2],
    [4.91279e-2, 8.72585e-2],
    [1.69211e-1, 1.61928e-1],
    [5.82786e-1, 3.00518e-1],
    [2.00816, 5.58584e-1],
    [6.99048, 1.06914],
];
/// Nodes of the integrals over a step up to |νΔt| = 4 and beyond; from which Re νΔt on they are done by their limit.
const NODES: [usize; 2] = [14, 40];
const NEAR: f64 = 4.0;
const LIMIT: f64 = 60.0;

/// Of steps of that length: λ_j in 1/s and w_j in 1/√s.
pub(super) fn exponentials(dt_s: f64) -> [[f64; 2]; EXPONENTIALS.len()] {
    EXPONENTIALS.map(|[rate, weight]| [rate / dt_s, weight / dt_s.sqrt()])
}

/// How a body moves in a step: V and U, m/s, and the step, s.
#[derive(Debug, Clone, Copy)]
pub(super) struct Moving {
    pub(super) speeds_m_s: [f64; 2],
    pub(super) dt_s: f64,
}

impl Moving {
    /// μ and ν of a wave over the step, and the turn of what was before to now.
    fn of(self, thermal: Thermal, [kx, ky]: [f64; 2]) -> [Complex<f64>; 3] {
        let Self {
            speeds_m_s: [v_m_s, u_m_s],
            dt_s,
        } = self;
        let spread = thermal.diffusivity * (kx * kx + ky * ky);
        let mu = Complex::new(spread, kx * v_m_s) * dt_s;
        let nu = Complex::new(spread, kx * (v_m_s - u_m_s)) * dt_s;
        [mu, nu, Complex::new(0.0, -kx * u_m_s * dt_s).exp()]
    }
}

/// What heat of a step does at its end, to both bodies.
pub(super) struct Own {
    /// A_i = (√κ/k_c)(E_0 − E_1).
    pub(super) of: [Vec<Complex<f32>>; 2],
    /// The mean of both together over all waves.
    pub(super) mean: f64,
}

impl Own {
    /// `length_m`: the plane's unit of length.
    pub(super) fn new(
        plane: &Plane,
        length_m: f64,
        thermals: [Thermal; 2],
        moving: [Moving; 2],
    ) -> Self {
        let rules = NODES.map(gauss_legendre);
        let of = [0, 1].map(|body: usize| {
            let (thermal, moving) = (thermals[body], moving[body]);
            let scale = scale(thermal) * moving.dt_s.sqrt();
            let mut own = vec![Complex::default(); plane.len()];
            (own.par_iter_mut().enumerate())
                .with_min_len(BLOCK)
                .for_each(|(k, own)| {
                    let [_, nu, _] = moving.of(thermal, plane.wave(k).map(|k| k / length_m));
                    let [whole, first] = over_step(&rules, nu);
                    *own = narrow((whole - first) * scale);
                });
            own
        });
        let sum = of
            .iter()
            .flatten()
            .map(|own| f64::from(own.re))
            .sum::<f64>();
        Self {
            of,
            mean: sum / plane.len() as f64,
        }
    }
}

/// √κ/k_c.
fn scale(thermal: Thermal) -> f64 {
    thermal.diffusivity.sqrt() / thermal.conductivity
}

/// What heat of the steps before does at the end of a step, to one body.
pub(super) struct Symbols {
    /// (√κ/k_c) E_1: what that of the last step does, turned to now.
    pub(super) last: Vec<Complex<f32>>,
    /// Of each mode: e^{−(λ_j + μ)Δt}, what the heat of the last step and of the last but one adds; in blocks as the modes, of
    /// each mode one after another.
    pub(super) modes: Vec<Complex<f32>>,
    /// Whether a mode of a block is anything after a step: short waves of a slow body have spread by then.
    pub(super) lives: Vec<bool>,
}

impl Symbols {
    /// `length_m`: the plane's unit of length.
    pub(super) fn new(
        plane: &Plane,
        length_m: f64,
        thermal: Thermal,
        moving: Moving,
        exponentials: &[[f64; 2]],
    ) -> Self {
        let (scale, dt_s) = (scale(thermal), moving.dt_s);
        let rules = NODES.map(gauss_legendre);
        let (n, n_modes) = (plane.len(), exponentials.len());
        let mut last = vec![Complex::default(); n];
        let mut modes = vec![Complex::default(); 3 * n * n_modes];
        let mut lives = vec![false; n.div_ceil(BLOCK) * n_modes];
        (last.par_chunks_mut(BLOCK))
            .zip(modes.par_chunks_mut(3 * BLOCK * n_modes))
            .zip(lives.par_chunks_mut(n_modes))
            .enumerate()
            .for_each(|(block, ((last, modes), lives))| {
                let width = last.len();
                for (k, last) in last.iter_mut().enumerate() {
                    let wave = plane.wave(block * BLOCK + k).map(|k| k / length_m);
                    let [mu, nu, turn] = moving.of(thermal, wave);
                    let [_, first] = over_step(&rules, nu);
                    *last = narrow(first * turn * (scale * dt_s.sqrt()));
                    for (mode, [rate, weight]) in exponentials.iter().enumerate() {
                        let of_mode = factors(mu, nu, turn, rate * dt_s, weight * scale * dt_s);
                        lives[mode] |= of_mode != [Complex::default(); 3];
                        for (part, factor) in of_mode.into_iter().enumerate() {
                            modes[(3 * mode + part) * width + k] = factor;
                        }
                    }
                }
            });
        Self { last, modes, lives }
    }
}

pub(super) fn narrow(wave: Complex<f64>) -> Complex<f32> {
    Complex::new(wave.re as f32, wave.im as f32)
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
    [decay, here * decay * weight, there * turn * decay * weight].map(narrow)
}

/// ∫_0^1 e^{−z r}/√(π r) dr and ∫_0^1 r e^{−z r}/√(π r) dr, by r = x².
fn over_step(rules: &[(Vec<f64>, Vec<f64>); 2], z: Complex<f64>) -> [Complex<f64>; 2] {
    if z.re > LIMIT {
        let whole = z.sqrt().inv();
        return [whole, whole / (2.0 * z)];
    }
    let (nodes, weights) = &rules[usize::from(z.norm_sqr() > NEAR * NEAR)];
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

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_exponentials_are_the_kernel() {
        let worst = (0..=2000).map(|i| {
            let s = 0.25 * 65536.0_f64.powf(f64::from(i) / 2000.0);
            let of = |[rate, weight]: [f64; 2]| weight * (-rate * s).exp();
            let sum: f64 = exponentials(1.0).into_iter().map(of).sum();
            (sum * (std::f64::consts::PI * s).sqrt() - 1.0).abs()
        });
        let worst = worst.fold(0.0, f64::max);
        println!("off by {worst:.2e}");
        assert!(worst < 1e-3);
    }
}
