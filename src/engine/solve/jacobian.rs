//! The linearised Reynolds equation, rows divided by their scale.
//!
//! ```text
//! (J v)_n = Σ_m A_P[n,m] v_m + A_H[n,m] (w_m + h0),   w = K v,   m over n and its four neighbours
//! L = A_P + c K00 A_H,  c = 1/2:   the local part, for the preconditioner
//! ```
//! L takes the film to yield where the pressure changes and only there, by c K00: between the self-influence K00 of a
//! node's pressure and what is left of it in corrections that alternate from node to node. Where films are about to
//! close, flow depends on them more than on the pressure. Krylov iterations a step of the default scene on 129² nodes
//! at U = 1e-4 m/s, with all of c in the flow's part of A_H: 65.8 at c = 0, 59.4 at 0.3, 60.4 at 0.5, 60.0 at 0.7, 69.1 at 1.
//!
//! Single precision: search directions need no more, because the residual is double. A grid row is stored
//! as lines, one per coefficient, so that products run along the row in vector registers.
//!
//! Ours: the derivative of `reynolds.rs`, and c by the counts above.

use rayon::prelude::*;

use crate::math::grid::Grid;

/// Lines of a stencil: self, west, east, south, north.
pub const STENCIL: usize = 5;

/// Stencils of a row: A_P, A_H, L.
const STENCILS: usize = 3;

/// c of L: by the counts above, the same work from 0.3 to 0.7.
const YIELD: f32 = 0.5;

/// All rows, `[row][A_P, A_H, L][self, west, east, south, north][i]`; of boundary and inactive nodes zero.
pub struct Jacobian {
    nx: usize,
    lines: Vec<f32>,
}

impl Jacobian {
    /// Zero rows for `grid`.
    pub fn new(grid: &Grid) -> Self {
        Self {
            nx: grid.nx,
            lines: vec![0.0; grid.len() * STENCILS * STENCIL],
        }
    }

    /// Values of one grid row: all its lines.
    pub fn row_len(&self) -> usize {
        STENCILS * STENCIL * self.nx
    }

    /// The lines of every grid row, in blocks of `rows` rows to be filled in parallel.
    pub fn blocks_mut(&mut self, rows: usize) -> rayon::slice::ChunksMut<'_, f32> {
        let size = rows * self.row_len();
        self.lines.par_chunks_mut(size)
    }

    /// The five lines of L in grid row `j`.
    pub fn local(&self, j: usize) -> [&[f32]; STENCIL] {
        let [_, _, local] = self.stencils(j);
        lines(local, self.nx)
    }

    /// ∂F/∂H at the nodes of grid row `j`, over the row's scale.
    pub fn own_slope(&self, j: usize) -> &[f32] {
        let [_, a_h, _] = self.stencils(j);
        &a_h[..self.nx]
    }

    /// A_P, A_H and L of grid row `j`.
    fn stencils(&self, j: usize) -> [&[f32]; STENCILS] {
        let size = STENCIL * self.nx;
        std::array::from_fn(|k| &self.lines[(STENCILS * j + k) * size..][..size])
    }

    /// Makes the film of the held nodes an unknown in place of their pressure (`yielding.rs`): their columns of A_P become
    /// K00 A_H, those of A_H zero.
    pub fn exchange(&mut self, grid: &Grid, held: &[bool], k00: f64) {
        let (nx, size) = (self.nx, STENCIL * self.nx);
        let row_len = self.row_len();
        let interior = grid.interior_rows();
        let rows = self.lines.par_chunks_exact_mut(row_len).enumerate();
        rows.filter(|(j, _)| interior.contains(j))
            .for_each(|(j, row)| {
                let [here, south, north] = around(grid, held, j);
                let (a_p, residual) = row.split_at_mut(size);
                let (a_h, local) = residual.split_at_mut(size);
                let mut turn = |line: usize, i: usize, is_held: bool| {
                    let n = line * nx + i;
                    if is_held {
                        a_p[n] = k00 as f32 * a_h[n];
                        a_h[n] = 0.0;
                        local[n] = a_p[n];
                    }
                };
                for i in 1..nx - 1 {
                    turn(0, i, here[i]);
                    turn(1, i, here[i - 1]);
                    turn(2, i, here[i + 1]);
                    turn(3, i, south[i]);
                    turn(4, i, north[i]);
                }
            });
    }

    /// `out = A_P v + A_H (w + h0)`.
    pub fn apply(&self, grid: &Grid, v: &[f32], w: &[f32], h0: f32, out: &mut [f32]) {
        let nx = grid.nx;
        let interior = grid.interior_rows();
        out.par_chunks_mut(nx)
            .enumerate()
            .with_min_len(8)
            .for_each(|(j, out)| {
                if !interior.contains(&j) {
                    out.fill(0.0);
                    return;
                }
                let v = around(grid, v, j);
                let w = around(grid, w, j);
                let [a_p, a_h, _] = self.stencils(j);
                apply_row(a_p, v[0], v[1], v[2], out);
                add_deflected_row(a_h, w[0], w[1], w[2], h0, out);
            });
    }

    /// `out = (r − L v − e v) f`: the residual of the local part with an extra diagonal `e`, times `f`; zero in
    /// the rows of parity `solved`, which the last sweep has solved.
    pub fn local_residual(
        &self,
        grid: &Grid,
        extra: &[f32],
        v: &[f32],
        solved: usize,
        r: &[f32],
        factor: &[f32],
        out: &mut [f32],
    ) {
        let nx = grid.nx;
        let interior = grid.interior_rows();
        out.par_chunks_mut(nx)
            .enumerate()
            .with_min_len(8)
            .for_each(|(j, out)| {
                if j % 2 == solved || !interior.contains(&j) {
                    out.fill(0.0);
                    return;
                }
                let here = j * nx..(j + 1) * nx;
                let v = around(grid, v, j);
                let [_, _, local] = self.stencils(j);
                apply_row(local, v[0], v[1], v[2], out);
                residual_row(
                    &extra[here.clone()],
                    v[0],
                    &r[here.clone()],
                    &factor[here],
                    out,
                );
            });
    }
}

/// Row `j` of a field and the rows below and above it.
fn around<'a, T>(grid: &Grid, field: &'a [T], j: usize) -> [&'a [T]; 3] {
    let row = |j: usize| &field[j * grid.nx..(j + 1) * grid.nx];
    [row(j), row(grid.row_below(j)), row(grid.row_above(j))]
}

/// The five lines of a stencil, each of length `nx`.
#[inline(always)]
fn lines(stencil: &[f32], nx: usize) -> [&[f32]; STENCIL] {
    std::array::from_fn(|k| &stencil[k * nx..(k + 1) * nx])
}

dispatched! {
/// L of a row from its A_P and A_H.
pub(super) fn localise(a_p: &[f32], a_h: &[f32], k00: f64, local: &mut [f32]) {
    let n = local.len();
    let (a_p, a_h, share) = (&a_p[..n], &a_h[..n], YIELD * k00 as f32);
    for i in 0..n {
        local[i] = a_p[i] + share * a_h[i];
    }
}
}

dispatched! {
fn apply_row(a: &[f32], here: &[f32], south: &[f32], north: &[f32], out: &mut [f32]) {
    let nx = out.len();
    let [c, w, e, s, n] = lines(a, nx);
    let (here, south, north) = (&here[..nx], &south[..nx], &north[..nx]);
    out[0] = 0.0;
    out[nx - 1] = 0.0;
    for i in 1..nx - 1 {
        out[i] = c[i] * here[i]
            + w[i] * here[i - 1]
            + e[i] * here[i + 1]
            + s[i] * south[i]
            + n[i] * north[i];
    }
}
}

dispatched! {
fn add_deflected_row(
    a: &[f32],
    here: &[f32],
    south: &[f32],
    north: &[f32],
    h0: f32,
    out: &mut [f32],
) {
    let nx = out.len();
    let [c, w, e, s, n] = lines(a, nx);
    let (here, south, north) = (&here[..nx], &south[..nx], &north[..nx]);
    for i in 1..nx - 1 {
        out[i] += c[i] * (here[i] + h0)
            + w[i] * (here[i - 1] + h0)
            + e[i] * (here[i + 1] + h0)
            + s[i] * (south[i] + h0)
            + n[i] * (north[i] + h0);
    }
}
}

dispatched! {
fn residual_row(extra: &[f32], v: &[f32], r: &[f32], factor: &[f32], out: &mut [f32]) {
    let nx = out.len();
    let (extra, v, r, factor) = (&extra[..nx], &v[..nx], &r[..nx], &factor[..nx]);
    for i in 0..nx {
        out[i] = (r[i] - out[i] - extra[i] * v[i]) * factor[i];
    }
}
}
