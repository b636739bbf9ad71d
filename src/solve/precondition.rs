//! The preconditioner: line relaxation where flow rules, frozen symbols where deformation rules.
//!
//! ```text
//! z1 = zebra x-line sweeps on (A_P + e),   e = c ρ̄ K00/D keeps them idle where deformation rules
//! z2 = Σ_b w_b . F⁻¹[ F[D (r − (A_P + e) z1)] / (K̂ + ε_b s k²) ],   z = z1 + z2
//! ```
//! The bins ε_b of conductance have their cut-off (K̂ = ε s k²) at wavenumbers 1.5π/dx, /4, /16 …;
//! the first bin, ε = 0, is the elastic inverse. The weights w_b are hats in the logarithm of the
//! local conductance. The constraint of load is bordered: one solve for its column per
//! linearisation. Single precision throughout.

use rayon::prelude::*;

use super::film::Elastic;
use super::jacobian::Jacobian;
use crate::math::filter::{Filter, Padding};
use crate::math::grid::Grid;

/// Number of conductance bins.
const BINS: usize = 5;
/// Extra diagonal of the line sweeps in units of ρ̄K00.
const IDLE: f64 = 1.0;

/// One line's factors: `lower`, `upper`, `inverse` of the pivots.
#[derive(Debug, Clone, Copy, Default)]
struct Factor {
    lower: f32,
    upper: f32,
    inverse: f32,
    south: f32,
    north: f32,
}

/// The preconditioner and its scratch.
pub struct Preconditioner {
    filter: Filter<f32>,
    bins: [f64; BINS],
    weights: Vec<f32>,
    extra: Vec<f32>,
    scale: Vec<f32>,
    /// Factors of rows of even and odd index.
    factors: [Vec<Factor>; 2],
    /// z1 of rows of even and odd index.
    lines: [Vec<f32>; 2],
    z1: Vec<f32>,
    rest: Vec<f32>,
}

impl Preconditioner {
    /// Makes buffers and, for the effective step `s`, the symbols.
    pub fn new(grid: &Grid, elastic: &Elastic, kappa: f64, s: f64) -> Self {
        let n = grid.len();
        let (even, odd) = (grid.ny.div_ceil(2) * grid.nx, grid.ny / 2 * grid.nx);
        // A line has no odd row; one of zeros stands in for the neighbours, whose weight is 0.
        let neighbours = odd.max(grid.nx);
        let mut this = Self {
            filter: Filter::new(grid, Padding::Periodic, BINS),
            bins: [0.0; BINS],
            weights: vec![0.0; BINS * n],
            extra: vec![0.0; n],
            scale: vec![0.0; n],
            factors: [vec![Factor::default(); even], vec![Factor::default(); odd]],
            lines: [vec![0.0; even], vec![0.0; neighbours]],
            z1: vec![0.0; n],
            rest: vec![0.0; n],
        };
        this.set_symbols(grid, elastic, kappa, s);
        this
    }

    /// Remakes the symbols for another effective step.
    pub fn set_symbols(&mut self, grid: &Grid, elastic: &Elastic, kappa: f64, s: f64) {
        use std::f64::consts::{PI, TAU};
        let (lx, ly) = (self.filter.lx() as f64, self.filter.ly() as f64);
        for b in 0..BINS {
            let epsilon = if b == 0 {
                0.0
            } else {
                let k = 1.5 * PI / grid.dx / 4.0_f64.powi(b as i32 - 1);
                TAU * kappa / (s * k.powi(3))
            };
            self.bins[b] = epsilon;
            self.filter.set_symbol(b, |kx, ky| {
                let cx = (2.0 - 2.0 * (TAU * kx as f64 / lx).cos()) / (grid.dx * grid.dx);
                let cy = (2.0 - 2.0 * (TAU * ky as f64 / ly).cos()) / (grid.dy * grid.dy);
                1.0 / (elastic.symbol(2 * kx, 2 * ky) + epsilon * s * (cx + cy))
            });
        }
    }

    /// Takes a new linearisation: line factors, bin weights, scales.
    pub fn prepare(
        &mut self,
        grid: &Grid,
        jacobian: &Jacobian,
        diagonal: &[f64],
        conductance: &[f64],
        active: &[bool],
        k00: f64,
    ) {
        let (nx, n_all) = (grid.nx, grid.len());
        for n in 0..n_all {
            self.extra[n] = (IDLE * k00 / diagonal[n]) as f32;
            self.scale[n] = if active[n] { diagonal[n] as f32 } else { 0.0 };
        }
        self.set_weights(conductance, active);
        for parity in 0..2 {
            let extra = &self.extra;
            self.factors[parity]
                .par_chunks_mut(nx)
                .enumerate()
                .with_min_len(4)
                .for_each(|(half, line)| {
                    let start = (2 * half + parity) * nx;
                    factor_line(
                        &jacobian.rows[start..start + nx],
                        &extra[start..start + nx],
                        line,
                    );
                });
        }
    }

    fn set_weights(&mut self, conductance: &[f64], active: &[bool]) {
        let n_all = conductance.len();
        self.weights.fill(0.0);
        let (first, last) = (self.bins[1], self.bins[BINS - 1]);
        for n in 0..n_all {
            if !active[n] {
                continue;
            }
            // Position in bins: bin b has log64(ε_b/ε_1) = b − 1.
            let position = if conductance[n] <= first / 64.0 {
                0.0
            } else if conductance[n] >= last {
                (BINS - 1) as f64
            } else {
                1.0 + (conductance[n] / first).ln() / 64.0_f64.ln()
            };
            let b = (position as usize).min(BINS - 2);
            let upper = (position - b as f64).clamp(0.0, 1.0) as f32;
            // Beyond the last bin flow rules and the sweeps have solved it: what they leave must not
            // leak into the contact through the transform.
            let fade = (last / conductance[n]).min(1.0);
            self.scale[n] *= fade as f32;
            self.weights[b * n_all + n] = 1.0 - upper;
            self.weights[(b + 1) * n_all + n] = upper;
        }
    }

    /// `z = M⁻¹ r` (without the border).
    pub fn apply(&mut self, grid: &Grid, jacobian: &Jacobian, r: &[f32], z: &mut [f32]) {
        for line in &mut self.lines {
            line.fill(0.0);
        }
        for parity in [0, 1, 0] {
            self.sweep(grid, r, parity);
        }
        let nx = grid.nx;
        for (j, row) in self.z1.chunks_exact_mut(nx).enumerate() {
            let start = j / 2 * nx;
            row.copy_from_slice(&self.lines[j % 2][start..start + nx]);
        }
        jacobian.apply_local(grid, &self.extra, &self.z1, &mut self.rest);
        for ((rest, &r), &scale) in self.rest.iter_mut().zip(r).zip(&self.scale) {
            *rest = (r - *rest) * scale;
        }
        self.filter.apply_weighted(&self.rest, &self.weights, z);
        for (z, &z1) in z.iter_mut().zip(&self.z1) {
            *z += z1;
        }
    }

    fn sweep(&mut self, grid: &Grid, r: &[f32], parity: usize) {
        let nx = grid.nx;
        let interior = grid.interior_rows();
        let [even, odd] = &mut self.lines;
        let (mine, other) = if parity == 0 {
            (even, &*odd)
        } else {
            (odd, &*even)
        };
        let factors = &self.factors[parity];
        mine.par_chunks_mut(nx)
            .zip(factors.par_chunks(nx))
            .enumerate()
            .with_min_len(4)
            .for_each(|(half, (z, factor))| {
                let j = 2 * half + parity;
                if !interior.contains(&j) {
                    return;
                }
                let (south, north) = (grid.row_below(j) / 2 * nx, grid.row_above(j) / 2 * nx);
                solve_line(
                    factor,
                    &r[j * nx..(j + 1) * nx],
                    &other[south..south + nx],
                    &other[north..north + nx],
                    z,
                );
            });
    }
}

fn factor_line(rows: &[super::jacobian::Row], extra: &[f32], line: &mut [Factor]) {
    let nx = line.len();
    line[0] = Factor::default();
    line[nx - 1] = Factor::default();
    let (mut upper, mut inverse) = (0.0_f32, 0.0_f32);
    for i in 1..nx - 1 {
        let a = &rows[i].a_p;
        let lower = a[1] * inverse;
        let pivot = a[0] + extra[i] - lower * upper;
        // An inactive row is zero: its correction is zero.
        let idle = rows[i].a_h[0] == 0.0 && a[0] == 0.0;
        inverse = if idle { 0.0 } else { 1.0 / pivot };
        upper = a[2];
        line[i] = Factor {
            lower,
            upper,
            inverse,
            south: a[3],
            north: a[4],
        };
    }
}

fn solve_line(factor: &[Factor], r: &[f32], south: &[f32], north: &[f32], z: &mut [f32]) {
    let nx = z.len();
    let mut carry = 0.0_f32;
    for i in 1..nx - 1 {
        let f = &factor[i];
        carry = r[i] - f.south * south[i] - f.north * north[i] - f.lower * carry;
        z[i] = carry;
    }
    carry = 0.0;
    for i in (1..nx - 1).rev() {
        let f = &factor[i];
        carry = (z[i] - f.upper * carry) * f.inverse;
        z[i] = carry;
    }
}
