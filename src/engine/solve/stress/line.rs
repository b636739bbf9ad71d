//! Plane-strain stress below a line contact: exact influence functions of uniformly loaded strips.
//!
//! ```text
//! σ_i(z) = Σ_j A_{i−j}(z) p_j + B_{i−j}(z) q_j,   A, B = [F]_{x−dx/2}^{x+dx/2},   r² = x² + z²
//! pressure   xx: −(1/π)[atan(x/z) − xz/r²]    zz: −(1/π)[atan(x/z) + xz/r²]    xz:  (1/π) z²/r²
//! traction   xx: −(1/π)[ln r² + z²/r²]        zz:  (1/π) z²/r²                 xz: −(1/π)[atan(x/z) − xz/r²]
//! σyy = ν(σxx + σzz),   σxy = σyz = 0
//! ```
//! | symbol | meaning | shape, unit |
//! |---|---|---|
//! | p, q | pressure (> 0 presses), traction on the body along +x | nx, p_h |
//! | σ | stress, tension positive | `[k·nx + i]`, p_h |
//! | x, z | along rolling, into the body | b |
//!
//! The sums over strips are convolutions, done by transforms of twice the length: with p = q = 0 at both
//! ends of the domain they are the direct sums (free space, no images). Influence functions were taken
//! rather than windowed frequency responses because in one dimension their tables are small (6 numbers
//! a mode and depth) and need no window. Error: that of steps in place of the pressure, second order away
//! from Hertz's edge. The life integral is over x and z, per unit length. What pressure does and what traction does are
//! transformed once a surface; the loadings of both bodies are their sum, their difference and the first alone.
//!
//! Proved in `tests/engine/line.rs`: Hertz's maxima, the direct sum, the life integrals.
//! Source: Johnson, Contact Mechanics (1985), §2.5 (strips), §4.2 (Hertz line).

use std::f64::consts::PI;
use std::sync::Arc;

use realfft::num_complex::Complex;
use realfft::{ComplexToReal, RealFftPlanner, RealToComplex};

use super::depth::depth_rule;
use super::engine::VolumeOut;
use super::peak;
use super::slice_out::{Peak, SliceOut};
use super::spec::{Loading, StressSpec, Symmetry};
use super::sums::{LayerSum, MAX_LAWS, StressLaw, VolumeSums};
use crate::math::elementary;
use crate::math::kernel_symbol::{REPEATING, even_kernel_symbol, odd_kernel_symbol};
use crate::physics::cycles::BodyId;
use crate::scene::StressMeasure;

/// Stress below which a point adds nothing to a life integral, p_h: its tenth power is 1e-60 of the greatest.
const NEGLIGIBLE: f32 = 1e-6;

/// Components of a plane stress that are transformed: xx, zz, xz.
const COMPONENTS: usize = 3;

/// Symbols of one depth: pressure and traction to each component.
struct LineLayer {
    /// By pressure and by traction: xx, zz, xz, one number a mode. Real where the kernel is even; the imaginary part where it
    /// is odd.
    symbols: [[Vec<f32>; COMPONENTS]; 2],
}

/// The engine of a line: tables, stress by the surface loaded last, scratch.
pub struct LineStress {
    spec: StressSpec,
    layers: Vec<LineLayer>,
    forward: Arc<dyn RealToComplex<f32>>,
    inverse: Arc<dyn ComplexToReal<f32>>,
    loaded: LoadedLine,
    real: Vec<f32>,
    spectrum: Vec<Complex<f32>>,
    product: Vec<Complex<f32>>,
    scratch: Vec<Complex<f32>>,
    /// By pressure and by traction: `[(k · 3 + component) · nx + i]`.
    stress: [Vec<f32>; 2],
    /// xx, zz, xz and the measure along one depth.
    rows: [Vec<f32>; COMPONENTS],
    row: Vec<f32>,
    sums: VolumeSums,
}

/// What was loaded last.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum LoadedLine {
    Pressure,
    PressureAndTraction,
}

impl LineStress {
    /// Tables for `nx` nodes `dx` apart, the first at `x_first`, and `n_depths` depths down to `depth_max`
    /// (lengths in half-widths).
    pub fn new(
        nx: usize,
        (x_first, dx): (f64, f64),
        nu: [f64; 2],
        depths: (usize, f64),
        measure: StressMeasure,
    ) -> Self {
        let mut spec = StressSpec::new((nx, 1), (dx, 1.0), nu[0], depths, Symmetry::Line);
        (spec.nu_2, spec.x_first, spec.measure) = (nu[1], x_first, measure);
        (spec.depths, spec.weights) = depth_rule(depths.0, depths.1);
        let length = 2 * (nx - 1);
        let mut planner = RealFftPlanner::<f32>::new();
        let (forward, inverse) = (
            planner.plan_fft_forward(length),
            planner.plan_fft_inverse(length),
        );
        let zero = Complex::new(0.0, 0.0);
        let modes = length / 2 + 1;
        let stress = vec![0.0; spec.depths.len() * COMPONENTS * nx];
        let scratch = forward.get_scratch_len().max(inverse.get_scratch_len());
        Self {
            layers: spec
                .depths
                .iter()
                .map(|&z| LineLayer::new(length, dx, z))
                .collect(),
            loaded: LoadedLine::Pressure,
            real: vec![0.0; length],
            spectrum: vec![zero; modes],
            product: vec![zero; modes],
            scratch: vec![zero; scratch],
            stress: [stress.clone(), stress],
            rows: [0; COMPONENTS].map(|_| vec![0.0; nx]),
            row: vec![0.0; nx],
            sums: VolumeSums::of_line(&spec.weights),
            spec,
            forward,
            inverse,
        }
    }

    /// Nodes, depths, weights and measure; of its rows and `dy` a line has no use.
    pub fn spec(&self) -> &StressSpec {
        &self.spec
    }

    /// Takes a surface: pressure and, where there is any, traction.
    pub fn load(&mut self, pressure: &[f32], traction: Option<&[f32]>) {
        self.act(0, pressure);
        self.loaded = LoadedLine::Pressure;
        if let Some(traction) = traction {
            self.act(1, traction);
            self.loaded = LoadedLine::PressureAndTraction;
        }
    }

    /// What pressure (0) or traction (1) does at every depth.
    fn act(&mut self, which: usize, field: &[f32]) {
        self.real[..field.len()].copy_from_slice(field);
        self.real[field.len()..].fill(0.0);
        self.forward
            .process_with_scratch(&mut self.real, &mut self.spectrum, &mut self.scratch)
            .expect("buffer lengths were made for this plan");
        let symbols =
            (self.layers.iter()).flat_map(|layer| layer.symbols[which].iter().enumerate());
        let rows = self.stress[which].chunks_exact_mut(self.spec.nx);
        for (row, (component, symbol)) in rows.zip(symbols) {
            // xx and zz are even in x under pressure and odd under traction; xz the other way round.
            let is_even = (component < 2) == (which == 0);
            multiply(&self.spectrum, symbol, is_even, &mut self.product);
            let last = self.product.len() - 1;
            (self.product[0].im, self.product[last].im) = (0.0, 0.0);
            self.inverse
                .process_with_scratch(&mut self.product, &mut self.real, &mut self.scratch)
                .expect("buffer lengths were made for this plan");
            row.copy_from_slice(&self.real[..self.spec.nx]);
        }
    }

    /// The stress of body 1 in the plane x z under the surface loaded last.
    pub fn slice(&mut self, out: &mut SliceOut) {
        self.slice_of(Loading::Full(BodyId::One), out);
    }

    /// The stress of a body in the plane x z under the surface loaded last.
    pub fn slice_of(&mut self, loading: Loading, out: &mut SliceOut) {
        let nx = self.spec.nx;
        let nu = self.spec.poisson(loading.body()) as f32;
        for k in 0..self.layers.len() {
            let here = k * nx..(k + 1) * nx;
            let fields = [&mut out.sxx, &mut out.szz, &mut out.sxz];
            let [xx, zz, xz] = fields.map(|field| &mut field[here.clone()]);
            for (component, to) in [&mut *xx, &mut *zz, &mut *xz].into_iter().enumerate() {
                self.component(k, component, loading, to);
            }
            let yy = &mut out.syy[here.clone()];
            for (yy, (xx, zz)) in yy.iter_mut().zip(xx.iter().zip(&*zz)) {
                *yy = nu * (xx + zz);
            }
            measures(
                self.spec.measure,
                nu,
                [xx, zz, xz],
                &mut out.effective[here],
            );
        }
        out.peak = peak::refine(&self.spec, out);
    }

    /// A component at depth `k`.
    fn component(&self, k: usize, component: usize, loading: Loading, to: &mut [f32]) {
        let nx = self.spec.nx;
        let row = (k * COMPONENTS + component) * nx..(k * COMPONENTS + component + 1) * nx;
        let [by_pressure, by_traction] = &self.stress;
        let sign = match self.loaded {
            LoadedLine::Pressure => 0.0,
            LoadedLine::PressureAndTraction => loading.traction_sign(),
        };
        if sign == 0.0 {
            to.copy_from_slice(&by_pressure[row]);
        } else {
            let both = by_pressure[row.clone()].iter().zip(&by_traction[row]);
            for (to, (p, q)) in to.iter_mut().zip(both) {
                *to = p + sign * q;
            }
        }
    }

    /// ln ∫ s^m dx dz of the surface loaded last, without and with its traction.
    pub fn volume(&mut self, exponent: f64) -> VolumeOut {
        self.volume_under(&[StressLaw::power(exponent)], &BodyId::BOTH);
        VolumeOut::of(&self.sums)
    }

    /// Sums of the surface loaded last under one or two laws, for the bodies that are asked for.
    ///
    /// # Panics
    /// Without a law, or with more than two.
    pub fn volume_under(&mut self, laws: &[StressLaw], bodies: &[BodyId]) -> &VolumeSums {
        assert!((1..=MAX_LAWS).contains(&laws.len()), "one or two laws");
        self.sums.clear();
        let alike = self.spec.materials() == 1;
        for loading in Loading::ALL {
            let same = match (loading, self.loaded) {
                (Loading::Full(body), LoadedLine::Pressure) => Some(Loading::Normal(body)),
                (Loading::Normal(BodyId::Two), _) if alike => Some(Loading::Normal(BodyId::One)),
                (Loading::Normal(body), _)
                | (Loading::Full(body), LoadedLine::PressureAndTraction) => {
                    (!bodies.contains(&body)).then_some(Loading::Normal(BodyId::One))
                }
            };
            if let Some(same) = same.filter(|same| *same != loading) {
                self.sums.copy(same, loading);
                continue;
            }
            for k in 0..self.layers.len() {
                self.layer_sums(k, loading, laws);
            }
        }
        &self.sums
    }

    /// Sums of the last call of [`Self::volume_under`].
    pub fn sums(&self) -> &VolumeSums {
        &self.sums
    }

    /// One depth under one loading.
    fn layer_sums(&mut self, k: usize, loading: Loading, laws: &[StressLaw]) {
        let nu = self.spec.poisson(loading.body()) as f32;
        let mut rows = std::mem::take(&mut self.rows);
        for (component, row) in rows.iter_mut().enumerate() {
            self.component(k, component, loading, row);
        }
        let [xx, zz, xz] = &rows;
        measures(self.spec.measure, nu, [xx, zz, xz], &mut self.row);
        self.rows = rows;
        let (mut top, mut at) = (0.0_f32, 0);
        for (i, s) in self.row.iter().enumerate() {
            if *s > top {
                (top, at) = (*s, i);
            }
        }
        for (slot, law) in laws.iter().enumerate() {
            let greatest = f64::from(top) - law.limit;
            let ln = if greatest > 0.0 {
                let sum = power_sum(&self.row, *law, greatest);
                (self.spec.weights[k] * self.spec.dx * sum).ln() + law.exponent * greatest.ln()
            } else {
                f64::NEG_INFINITY
            };
            let peak = Peak {
                value: f64::from(top),
                x: self.spec.x_first + self.spec.dx * at as f64,
                y: 0.0,
                z: self.spec.depths[k],
            };
            self.sums.set(loading, slot, k, LayerSum { ln, peak });
        }
    }
}

dispatched! {
/// A spectrum times a symbol: real where its kernel is even, imaginary where it is odd.
fn multiply(spectrum: &[Complex<f32>], symbol: &[f32], is_even: bool, out: &mut [Complex<f32>]) {
    let pairs = out.iter_mut().zip(spectrum).zip(symbol);
    if is_even {
        for ((out, v), s) in pairs {
            *out = Complex::new(v.re * s, v.im * s);
        }
    } else {
        for ((out, v), s) in pairs {
            *out = Complex::new(-v.im * s, v.re * s);
        }
    }
}
}

dispatched! {
/// The measure along a row of xx, zz, xz.
fn measures(measure: StressMeasure, nu: f32, [xx, zz, xz]: [&[f32]; COMPONENTS], out: &mut [f32]) {
    for (((out, xx), zz), xz) in out.iter_mut().zip(xx).zip(zz).zip(xz) {
        *out = effective(measure, [*xx, nu * (xx + zz), *zz, *xz]);
    }
}
}

/// Points that are raised to a power side by side.
const SIDE_BY_SIDE: usize = 8;

dispatched! {
/// `Σ (<s − limit>/greatest)^exponent` of a row.
fn power_sum(row: &[f32], law: StressLaw, greatest: f64) -> f64 {
    let mut sums = [0.0; SIDE_BY_SIDE];
    for part in row.chunks(SIDE_BY_SIDE) {
        for (sum, s) in sums.iter_mut().zip(part) {
            let beyond = f64::from(*s) - law.limit;
            let is_felt = *s > NEGLIGIBLE && beyond > 0.0;
            let share = if is_felt { beyond / greatest } else { 1.0 };
            let power = elementary::exp(law.exponent * elementary::ln(share));
            *sum += if is_felt { power } else { 0.0 };
        }
    }
    sums.iter().sum()
}
}

impl LineLayer {
    fn new(length: usize, dx: f64, z: f64) -> Self {
        let strip = |f: fn(f64, f64) -> f64| {
            move |i: usize, _: usize| {
                let x = i as f64 * dx;
                f(x + 0.5 * dx, z) - f(x - 0.5 * dx, z)
            }
        };
        let scale = 1.0 / length as f64;
        let narrow = |symbol: Vec<f64>| {
            symbol
                .into_iter()
                .map(|s| (s * scale) as f32)
                .collect::<Vec<_>>()
        };
        let even = |f| narrow(even_kernel_symbol((length, 1), REPEATING, strip(f)));
        let odd = |f| narrow(odd_kernel_symbol((length, 1), REPEATING, strip(f)));
        Self {
            symbols: [
                [even(across), even(down), odd(shared)],
                [odd(along), odd(shared), even(across)],
            ],
        }
    }
}

/// σxx by pressure, and σxz by traction.
fn across(x: f64, z: f64) -> f64 {
    -((x / z).atan() - x * z / (x * x + z * z)) / PI
}

/// σzz by pressure.
fn down(x: f64, z: f64) -> f64 {
    -((x / z).atan() + x * z / (x * x + z * z)) / PI
}

/// σxz by pressure, and σzz by traction.
fn shared(x: f64, z: f64) -> f64 {
    z * z / (x * x + z * z) / PI
}

/// σxx by traction.
fn along(x: f64, z: f64) -> f64 {
    let r2 = x * x + z * z;
    -(r2.ln() + z * z / r2) / PI
}

/// The measure of xx, yy, zz, xz with y a principal axis.
#[inline(always)]
fn effective(measure: StressMeasure, [xx, yy, zz, xz]: [f32; 4]) -> f32 {
    let (a, b, c) = (xx - yy, yy - zz, zz - xx);
    let mises = || (0.5 * (a * a + b * b + c * c) + 3.0 * xz * xz).sqrt();
    match measure {
        StressMeasure::VonMises => mises(),
        StressMeasure::Octahedral => std::f32::consts::SQRT_2 / 3.0 * mises(),
        StressMeasure::MaxShear => {
            let (middle, radius) = (0.5 * (xx + zz), (0.25 * c * c + xz * xz).sqrt());
            // Either in the plane, or between y and the farther of the two principal stresses.
            radius.max(0.5 * ((middle - yy).abs() + radius))
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::physics::invariants::Stress6;

    #[test]
    fn transforms_are_the_direct_sum() {
        let (nx, dx) = (33, 0.1);
        let mut engine =
            LineStress::new(nx, (-1.5, dx), [0.3; 2], (8, 2.0), StressMeasure::VonMises);
        let field = |phase: f64| -> Vec<f32> {
            (0..nx)
                .map(|i| {
                    let inside = i > 0 && i + 1 < nx;
                    if inside {
                        (0.7 * i as f64 + phase).sin() as f32
                    } else {
                        0.0
                    }
                })
                .collect()
        };
        let (p, q) = (field(0.2), field(1.3));
        engine.load(&p, Some(&q));
        let mut out = SliceOut::new(engine.spec());
        engine.slice(&mut out);
        for (k, &z) in engine.spec().depths.iter().enumerate() {
            for i in 0..nx {
                let sum = |f: fn(f64, f64) -> f64, field: &[f32]| -> f64 {
                    field
                        .iter()
                        .enumerate()
                        .map(|(j, &v)| {
                            let x = (i as f64 - j as f64) * dx;
                            (f(x + 0.5 * dx, z) - f(x - 0.5 * dx, z)) * f64::from(v)
                        })
                        .sum()
                };
                let n = k * nx + i;
                let (xx, zz) = (
                    sum(across, &p) + sum(along, &q),
                    sum(down, &p) + sum(shared, &q),
                );
                let xz = sum(shared, &p) + sum(across, &q);
                for (got, exact) in [(out.sxx[n], xx), (out.szz[n], zz), (out.sxz[n], xz)] {
                    assert!(
                        (f64::from(got) - exact).abs() < 2e-6,
                        "{k} {i}: {got} {exact}"
                    );
                }
                assert!((f64::from(out.syy[n]) - 0.3 * (xx + zz)).abs() < 1e-6);
            }
        }
    }

    #[test]
    fn measures_are_the_invariants() {
        for [xx, yy, zz, xz] in [
            [-0.7, -0.3, -0.2, 0.25],
            [0.3, 0.1, -0.9, 0.0],
            [0.2, 0.9, 0.1, 0.1],
        ] {
            let state = Stress6::of([xx, yy, zz, 0.0, xz, 0.0]);
            for (measure, exact) in [
                (StressMeasure::VonMises, state.von_mises()),
                (StressMeasure::MaxShear, state.max_shear()),
                (StressMeasure::Octahedral, state.octahedral_shear()),
            ] {
                let got = effective(measure, [xx, yy, zz, xz].map(|v: f64| v as f32));
                assert!(
                    (f64::from(got) - exact).abs() < 1e-6,
                    "{measure:?}: {got} {exact}"
                );
            }
        }
    }
}
