//! Flexible GMRES for the bordered linear step.
//!
//! ```text
//! [ J   b ] [v ]   [r]        b = A_H 1 (the column of H0),  v = 0 on inactive nodes
//! [ wᵀ  0 ] [h0] = [g]        w the area weights: g is the load that v must add
//! ```
//! The preconditioner is bordered by its Schur complement, so the load row holds exactly at every
//! iteration: with `y = M⁻¹ b`, `h0 = (wᵀM⁻¹r − g)/(wᵀy)`, `v = M⁻¹r − h0 y`. Classical
//! Gram-Schmidt, sums in fixed order, all vectors made in [`Krylov::new`].
//! Source: Saad (1993), algorithm 2.2.

use rayon::prelude::*;

use super::film::Elastic;
use super::jacobian::Jacobian;
use super::precondition::Preconditioner;
use crate::math::grid::Grid;

/// Most iterations of one linear solve, which is the memory it has; four times what a mixed step takes in all its solves.
pub const MAX_ITERATIONS: usize = 60;

/// Result of one linear solve.
#[derive(Debug, Clone, Copy)]
pub struct LinearReport {
    /// Iterations.
    pub iterations: usize,
    /// Residual over its start.
    pub reduction: f64,
    /// Change of H0.
    pub h0: f64,
}

/// Basis and scratch.
pub struct Krylov {
    basis: Vec<Vec<f32>>,
    directions: Vec<Vec<f32>>,
    h0s: Vec<f64>,
    border: Vec<f32>,
    deflection: Vec<f32>,
    work: Vec<f32>,
    partial: Vec<f64>,
    hessenberg: Vec<[f64; MAX_ITERATIONS + 1]>,
    rotations: Vec<(f64, f64)>,
    rhs: Vec<f64>,
    /// wᵀy and the flag that the border is made.
    border_load: f64,
    pressure: Pressure,
}

/// The part of a vector that is pressure: at held nodes the unknown is the film (`yielding.rs`).
#[derive(Default)]
struct Pressure {
    held: Vec<bool>,
    part: Vec<f32>,
    /// Whether any node is held.
    parted: bool,
}

impl Pressure {
    fn part(&mut self, held: Option<&[bool]>) {
        self.parted = held.is_some();
        if let Some(held) = held {
            self.held.copy_from_slice(held);
        }
    }

    fn of<'a>(&'a mut self, v: &'a [f32]) -> &'a [f32] {
        if !self.parted {
            return v;
        }
        for ((part, &v), &held) in self.part.iter_mut().zip(v).zip(&self.held) {
            *part = if held { 0.0 } else { v };
        }
        &self.part
    }
}

impl Krylov {
    /// Buffers for `grid`.
    pub fn new(grid: &Grid) -> Self {
        let n = grid.len();
        Self {
            basis: vec![vec![0.0; n]; MAX_ITERATIONS + 1],
            directions: vec![vec![0.0; n]; MAX_ITERATIONS],
            h0s: vec![0.0; MAX_ITERATIONS],
            border: vec![0.0; n],
            deflection: vec![0.0; n],
            work: vec![0.0; n],
            partial: vec![0.0; grid.ny * (MAX_ITERATIONS + 2)],
            hessenberg: vec![[0.0; MAX_ITERATIONS + 1]; MAX_ITERATIONS],
            rotations: vec![(1.0, 0.0); MAX_ITERATIONS],
            rhs: vec![0.0; MAX_ITERATIONS + 1],
            border_load: 0.0,
            pressure: Pressure::default(),
        }
    }

    /// Makes room for vectors whose entries are not all pressures.
    pub(super) fn make_room(&mut self, n: usize) {
        self.pressure.held.resize(n, false);
        self.pressure.part.resize(n, 0.0);
    }

    /// Makes the border for a new linearisation: `y = M⁻¹ A_H 1`; `held`: nodes whose unknown is the film.
    pub fn prepare(
        &mut self,
        grid: &Grid,
        jacobian: &Jacobian,
        precondition: &mut Preconditioner,
        held: Option<&[bool]>,
    ) {
        self.pressure.part(held);
        self.deflection.fill(0.0);
        self.work.fill(0.0);
        jacobian.apply(
            grid,
            &self.deflection,
            &self.deflection,
            1.0,
            &mut self.work,
        );
        precondition.apply(grid, jacobian, &self.work, &mut self.border);
        self.border_load = load_of(grid, self.pressure.of(&self.border));
    }

    /// Solves for `v` and the change of H0; `r` is the right-hand side (rows over D, zero on inactive
    /// nodes), `g` the load that `v` must add. Stops at `reduction` or at `most` iterations.
    pub fn solve(
        &mut self,
        grid: &Grid,
        elastic: &mut Elastic,
        jacobian: &Jacobian,
        precondition: &mut Preconditioner,
        r: &[f32],
        g: f64,
        reduction: f64,
        most: usize,
        v: &mut [f32],
    ) -> LinearReport {
        // Start from the border's answer to g alone, so that what follows adds no load.
        let h0_start = -g / self.border_load;
        v.fill(0.0);
        subtract(h0_start as f32, &self.border, v);
        elastic.deflect_single(self.pressure.of(v), &mut self.deflection);
        jacobian.apply(grid, v, &self.deflection, h0_start as f32, &mut self.work);
        self.basis[0].copy_from_slice(r);
        subtract(1.0, &self.work, &mut self.basis[0]);
        let start = norm(&self.basis[0]);
        let mut report = LinearReport {
            iterations: 0,
            reduction: 1.0,
            h0: h0_start,
        };
        if start == 0.0 {
            return report;
        }
        scale(&mut self.basis[0], 1.0 / start);
        self.rhs.fill(0.0);
        self.rhs[0] = start;
        let target = reduction * norm(r).max(start * 1e-3);
        for k in 0..most.min(MAX_ITERATIONS) {
            self.h0s[k] = self.direction(grid, jacobian, precondition, k);
            let pressure = self.pressure.of(&self.directions[k]);
            elastic.deflect_single(pressure, &mut self.deflection);
            jacobian.apply(
                grid,
                &self.directions[k],
                &self.deflection,
                self.h0s[k] as f32,
                &mut self.work,
            );
            let residual = self.orthogonalise(grid, k);
            report.iterations = k + 1;
            report.reduction = residual / start;
            if residual <= target {
                break;
            }
        }
        report.h0 += self.combine(report.iterations, v);
        report
    }

    /// Bordered preconditioner on basis vector `k`; returns the direction's change of H0.
    fn direction(
        &mut self,
        grid: &Grid,
        jacobian: &Jacobian,
        precondition: &mut Preconditioner,
        k: usize,
    ) -> f64 {
        let direction = &mut self.directions[k];
        precondition.apply(grid, jacobian, &self.basis[k], direction);
        let h0 = load_of(grid, self.pressure.of(direction)) / self.border_load;
        subtract(h0 as f32, &self.border, direction);
        h0
    }

    /// Orthogonalises `work` against the basis, updates the least-squares problem, returns the norm
    /// of the residual.
    fn orthogonalise(&mut self, grid: &Grid, k: usize) -> f64 {
        let nx = grid.nx;
        let stride = MAX_ITERATIONS + 2;
        let (basis, work) = (&self.basis, &self.work);
        self.partial
            .par_chunks_mut(stride)
            .enumerate()
            .with_min_len(8)
            .for_each(|(j, partial)| {
                let row = &work[j * nx..(j + 1) * nx];
                for (m, p) in partial.iter_mut().enumerate().take(k + 1) {
                    *p = dot(row, &basis[m][j * nx..(j + 1) * nx]);
                }
            });
        let column = &mut self.hessenberg[k];
        for (m, h) in column.iter_mut().enumerate().take(k + 1) {
            *h = self.partial.iter().skip(m).step_by(stride).sum();
        }
        let (known, next) = self.basis.split_at_mut(k + 1);
        next[0]
            .par_chunks_mut(nx)
            .zip(self.partial.par_chunks_mut(stride))
            .enumerate()
            .with_min_len(8)
            .for_each(|(j, (out, partial))| {
                out.copy_from_slice(&work[j * nx..(j + 1) * nx]);
                for (m, b) in known.iter().enumerate() {
                    let h = column[m] as f32;
                    subtract(h, &b[j * nx..(j + 1) * nx], out);
                }
                partial[0] = dot(out, out);
            });
        let length = self.partial.iter().step_by(stride).sum::<f64>().sqrt();
        if length > 0.0 {
            scale(&mut next[0], 1.0 / length);
        }
        column[k + 1] = length;
        for m in 0..k {
            let (c, s) = self.rotations[m];
            let (a, b) = (column[m], column[m + 1]);
            column[m] = c * a + s * b;
            column[m + 1] = c * b - s * a;
        }
        let radius = column[k].hypot(column[k + 1]);
        let (c, s) = if radius > 0.0 {
            (column[k] / radius, column[k + 1] / radius)
        } else {
            (1.0, 0.0)
        };
        self.rotations[k] = (c, s);
        column[k] = radius;
        self.rhs[k + 1] = -s * self.rhs[k];
        self.rhs[k] *= c;
        self.rhs[k + 1].abs()
    }

    /// Adds the best combination of the directions to `v`; returns its change of H0.
    fn combine(&mut self, n: usize, v: &mut [f32]) -> f64 {
        let mut h0 = 0.0;
        for k in (0..n).rev() {
            let mut value = self.rhs[k];
            for m in k + 1..n {
                value -= self.hessenberg[m][k] * self.rhs[m];
            }
            let pivot = self.hessenberg[k][k];
            self.rhs[k] = if pivot == 0.0 { 0.0 } else { value / pivot };
        }
        for k in 0..n {
            let y = self.rhs[k];
            h0 += y * self.h0s[k];
            subtract(-y as f32, &self.directions[k], v);
        }
        h0
    }
}

dispatched! {
fn dot(a: &[f32], b: &[f32]) -> f64 {
    let mut lanes = [0.0_f32; 16];
    let (a_chunks, b_chunks) = (a.chunks_exact(16), b.chunks_exact(16));
    let tail: f32 = a_chunks
        .remainder()
        .iter()
        .zip(b_chunks.remainder())
        .map(|(x, y)| x * y)
        .sum();
    for (x, y) in a_chunks.zip(b_chunks) {
        for k in 0..16 {
            lanes[k] += x[k] * y[k];
        }
    }
    lanes.iter().map(|&v| f64::from(v)).sum::<f64>() + f64::from(tail)
}
}

dispatched! {
/// `y −= h x`.
fn subtract(h: f32, x: &[f32], y: &mut [f32]) {
    for (y, &x) in y.iter_mut().zip(x) {
        *y -= h * x;
    }
}
}

fn norm(a: &[f32]) -> f64 {
    dot(a, a).sqrt()
}

fn scale(a: &mut [f32], factor: f64) {
    scale_by(a, factor as f32);
}

dispatched! {
fn scale_by(a: &mut [f32], factor: f32) {
    for v in a {
        *v *= factor;
    }
}
}

fn load_of(grid: &Grid, v: &[f32]) -> f64 {
    let rows = v.chunks_exact(grid.nx).enumerate();
    rows.map(|(j, row)| grid.weight(j) * sum(row)).sum()
}

dispatched! {
fn sum(a: &[f32]) -> f64 {
    let mut lanes = [0.0_f64; 16];
    let chunks = a.chunks_exact(16);
    let tail: f64 = chunks.remainder().iter().map(|&v| f64::from(v)).sum();
    for x in chunks {
        for k in 0..16 {
            lanes[k] += f64::from(x[k]);
        }
    }
    lanes.iter().sum::<f64>() + tail
}
}
