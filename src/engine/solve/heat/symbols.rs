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

use rustfft::num_complex::Complex;

use super::plane::Plane;
use crate::math::quadrature::gauss_legendre;

/// Spacing in y of the exponentials: a relative error of exp(−π²/(2·0.7)).
const SPACING: f64 = 0.7;
/// Reach of the sum, in steps.
const REACH: [f64; 2] = [0.25, 1024.0];
/// y beyond both ends.
const TAILS: [f64; 2] = [2.0, 1.2];
/// Nodes of the integrals over a step, and from which νΔt on they are done by their limit.
const NODES: usize = 40;
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

/// How many exponentials there are.
pub(super) fn n_exponentials() -> usize {
    exponentials(1.0).len()
}

/// Tables of one body for one step length and speed.
pub(super) struct Symbols {
    /// (√κ/k_c)(E_0 − E_1): what the heat of now does.
    pub(super) own: Vec<Complex<f64>>,
    /// (√κ/k_c) E_1: what that of the last step does, turned to now.
    pub(super) last: Vec<Complex<f64>>,
    /// e^{−μΔt}, e^{−i k_x U Δt}, ν Δt.
    pub(super) decay: Vec<[Complex<f64>; 3]>,
    /// √κ/k_c.
    pub(super) scale: f64,
}

impl Symbols {
    /// `length_m`: the plane's unit of length.
    pub(super) fn new(
        plane: &Plane,
        length_m: f64,
        [conductivity, diffusivity]: [f64; 2],
        [v_m_s, u_m_s]: [f64; 2],
        dt_s: f64,
    ) -> Self {
        let scale = diffusivity.sqrt() / conductivity;
        let rule = gauss_legendre(NODES);
        let n = plane.len();
        let mut this = Self {
            own: Vec::with_capacity(n),
            last: Vec::with_capacity(n),
            decay: Vec::with_capacity(n),
            scale,
        };
        for wave in 0..n {
            let [kx, ky] = plane.wave(wave).map(|k| k / length_m);
            let spread = diffusivity * (kx * kx + ky * ky);
            let mu = Complex::new(spread, kx * v_m_s) * dt_s;
            let nu = Complex::new(spread, kx * (v_m_s - u_m_s)) * dt_s;
            let [whole, first] = over_step(&rule, nu).map(|e| e * (scale * dt_s.sqrt()));
            this.own.push(whole - first);
            this.last.push(first);
            let turn = Complex::new(0.0, -kx * u_m_s * dt_s).exp();
            this.decay.push([(-mu).exp(), turn, nu]);
        }
        this
    }
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
pub(super) fn weights_before(z: Complex<f64>, e: Complex<f64>) -> [Complex<f64>; 2] {
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
