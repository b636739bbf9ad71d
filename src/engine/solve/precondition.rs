//! The preconditioner: line relaxation where flow rules, frozen symbols where deformation rules.
//!
//! ```text
//! z1 = zebra x-line sweeps on (L + e),   L of `jacobian.rs`; e, of some K00, keeps them idle where deformation rules
//! z2 = Σ_b w_b . F⁻¹[ F[(r − (L + e) z1)/a] / (K̂ + ε_b s k²) ],   z = z1 + z2
//! a = ∂F/∂H of the node, as far as it lies between 1 and [`STEEPEST`]
//! ```
//! The bins ε_b of conductance have their cut-off (K̂ = ε s k²) at wavenumbers 1.5π/dx, /4, /16 …;
//! the first bin, ε = 0, is the elastic inverse. The weights w_b are hats in the logarithm of the
//! local conductance. The constraint of load is bordered: one solve for its column per
//! linearisation. Single precision throughout. The transforms' fields are zero at the ends of the domain, as pressure is
//! (Krylov iterations of a mixed step 16.8 → 15.5 against periodic ones, at U = 1e-4 m/s 75 → 65).
//!
//! Ours: with one conductance ε everywhere ρ̄H − s ∇·(τ∇P) has the symbol K̂ + ε s k², which a transform inverts; hats in ln ε put
//! together what differs from place to place, and line sweeps what is too local for them. The constants are those of the counts below.

use super::film::Elastic;
use super::jacobian::Jacobian;
use super::line_sweep::LineSweep;
use crate::math::elementary::ln;
use crate::math::filter::{Filter, Padding, Weights};
use crate::math::grid::Grid;

/// Number of conductance bins: the cut-off of the last is about the size of the domain, so that sweeps have no more to
/// do on finer grids. Krylov iterations a step at 257² (0.3 passages and start-up): 19.4 with five, 15.9 with six; at
/// 129² 16.0 with five, 17.0 with six.
fn bins(grid: &Grid) -> usize {
    let (mut bins, mut reach) = (2, 1);
    while 3 * reach < grid.nx {
        (bins, reach) = (bins + 1, 4 * reach);
    }
    bins
}

/// Extra diagonal of the line sweeps in units of K00. Krylov iterations a step (mixed; U = 1e-4 m/s; mixed on 513²
/// nodes): 14.0, 60.3 and 19.8 at 1.6, 14.4, 60.1 and 21.4 at 2, 14.7 and 59.4 at 2.3.
const IDLE: f64 = 1.8;

/// Steepest rise of F with H that the frozen symbols divide by: steeper ones are of closing films, whose neighbours
/// rise as well. Krylov iterations a step, mixed, at U = 1e-4 m/s and of 132 steps of the stiff set (`tests/engine/ladder.rs`):
/// 15.6, 59.1 and 22 477 at 1, where only the density of the oil is not divided by; 14.4, 60.1 and 17 447 at 3; 14.4,
/// 66.5 at 10.
const STEEPEST: f32 = 3.0;

/// Order of parities in the line sweeps: with three 5636 and 26 312, with five 5451 and 23 372, with eleven 5374 and
/// 20 566 (at 2 ρ̄K00). A sweep is a hundredth of a mixed step.
const ORDER: [usize; 7] = [0, 1, 0, 1, 0, 1, 0];

/// The preconditioner and its scratch.
pub struct Preconditioner {
    filter: Filter<f32>,
    bins: Vec<f64>,
    weights: Weights<f32>,
    extra: Vec<f32>,
    scale: Vec<f32>,
    sweeps: LineSweep,
    residual: Vec<f32>,
}

impl Preconditioner {
    /// Makes buffers and, for the effective step `s`, the symbols.
    pub fn new(grid: &Grid, elastic: &Elastic, kappa: f64, s: f64) -> Self {
        let (n, bins) = (grid.len(), bins(grid));
        let mut this = Self {
            filter: Filter::new(grid, Padding::Pinned, bins),
            bins: vec![0.0; bins],
            weights: Weights::new(grid, bins),
            extra: vec![0.0; n],
            scale: vec![0.0; n],
            sweeps: LineSweep::new(grid),
            residual: vec![0.0; n],
        };
        this.set_symbols(grid, elastic, kappa, s);
        this
    }

    /// Remakes the symbols for another effective step.
    pub fn set_symbols(&mut self, grid: &Grid, elastic: &Elastic, kappa: f64, s: f64) {
        use std::f64::consts::{PI, TAU};
        let (lx, ly) = (self.filter.lx() as f64, self.filter.ly() as f64);
        for b in 0..self.bins.len() {
            let epsilon = if b == 0 {
                0.0
            } else {
                let k = 1.5 * PI / grid.dx / 4.0_f64.powi(b as i32 - 1);
                TAU * kappa / (s * k.powi(3))
            };
            self.bins[b] = epsilon;
            self.filter.set_symbol(b, |kx, ky| {
                let cx = (2.0 - 2.0 * (PI * kx as f64 / lx).cos()) / (grid.dx * grid.dx);
                let cy = (2.0 - 2.0 * (PI * ky as f64 / ly).cos()) / (grid.dy * grid.dy);
                1.0 / (elastic.symbol(kx, ky) + epsilon * s * (cx + cy))
            });
        }
    }

    /// Takes a new linearisation: line factors, bin weights, scales; `active`: nodes whose pressure is unknown, `held`:
    /// those whose film is (`yielding.rs`).
    pub fn prepare(
        &mut self,
        grid: &Grid,
        jacobian: &Jacobian,
        diagonal: &[f64],
        conductance: &[f64],
        active: &[bool],
        held: Option<&[bool]>,
        k00: f64,
    ) {
        let nx = grid.nx;
        let rows = self.extra.chunks_exact_mut(nx);
        for (j, (extra, scale)) in rows.zip(self.scale.chunks_exact_mut(nx)).enumerate() {
            let here = j * nx..(j + 1) * nx;
            prepare_scales(
                &diagonal[here.clone()],
                &active[here],
                jacobian.own_slope(j),
                IDLE * k00,
                extra,
                scale,
            );
        }
        // There the film is the unknown, and no deformation rules it.
        for (extra, &held) in self.extra.iter_mut().zip(held.unwrap_or_default()) {
            *extra = if held { 0.0 } else { *extra };
        }
        let bins = self.bins.len();
        let (first, last) = (self.bins[1], self.bins[bins - 1]);
        fade_flow(conductance, last, &mut self.scale);
        self.weights.set_rows(|j, weights| {
            let here = j * nx..(j + 1) * nx;
            set_weights(
                &conductance[here.clone()],
                &active[here],
                (first, last),
                weights,
            );
        });
        self.sweeps.factor(jacobian, &self.extra);
    }

    /// Transforms made so far.
    pub fn transforms(&self) -> u64 {
        self.filter.transforms()
    }

    /// `z = M⁻¹ r` (without the border).
    pub fn apply(&mut self, grid: &Grid, jacobian: &Jacobian, r: &[f32], z: &mut [f32]) {
        self.sweeps.solve(r, &ORDER, z);
        let solved = ORDER[ORDER.len() - 1];
        jacobian.local_residual(
            grid,
            &self.extra,
            z,
            solved,
            r,
            &self.scale,
            &mut self.residual,
        );
        self.filter.add_weighted(&self.residual, &self.weights, z);
    }
}

dispatched! {
fn prepare_scales(
    diagonal: &[f64],
    active: &[bool],
    own_slope: &[f32],
    idle: f64,
    extra: &mut [f32],
    scale: &mut [f32],
) {
    let n_all = diagonal.len();
    let (active, own_slope) = (&active[..n_all], &own_slope[..n_all]);
    let (extra, scale) = (&mut extra[..n_all], &mut scale[..n_all]);
    for n in 0..n_all {
        extra[n] = (idle / diagonal[n]) as f32;
        let scale_of_row = diagonal[n] as f32;
        let slope = (own_slope[n] * scale_of_row).clamp(1.0, STEEPEST);
        scale[n] = if active[n] { scale_of_row / slope } else { 0.0 };
    }
}
}

dispatched! {
/// Beyond the last bin flow rules and the sweeps have solved it: what they leave must not leak into the
/// contact through the transform.
fn fade_flow(conductance: &[f64], last: f64, scale: &mut [f32]) {
    let n_all = conductance.len();
    let scale = &mut scale[..n_all];
    for n in 0..n_all {
        scale[n] *= (last / conductance[n].max(last)) as f32;
    }
}
}

dispatched! {
/// Hats in the logarithm of the conductance: bin `b` has its tip at ε_b, bins 64 times apart. One row, bin
/// after bin.
fn set_weights(
    conductance: &[f64],
    active: &[bool],
    (first, last): (f64, f64),
    weights: &mut [f32],
) {
    let n_all = conductance.len();
    let active = &active[..n_all];
    let per_bin = 1.0 / 64.0_f64.ln();
    let last_bin = weights.len() / n_all - 1;
    let (weights, position) = weights.split_at_mut(last_bin * n_all);
    let position = &mut position[..n_all];
    for n in 0..n_all {
        let inside = conductance[n].max(first / 64.0).min(last);
        let place = (1.0 + ln(inside / first) * per_bin) as f32;
        // Far from every bin.
        position[n] = if active[n] { place } else { -2.0 };
    }
    for (b, weights) in weights.chunks_exact_mut(n_all).enumerate() {
        for n in 0..n_all {
            weights[n] = (1.0 - (position[n] - b as f32).abs()).max(0.0);
        }
    }
    for position in position {
        *position = (1.0 - (*position - last_bin as f32).abs()).max(0.0);
    }
}
}
