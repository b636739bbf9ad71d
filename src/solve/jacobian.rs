//! The linearised Reynolds equation, rows in pressure units.
//!
//! ```text
//! (J v)_n = Σ_m A_P[n,m] v_m + A_H[n,m] (w_m + h0),   w = K v,   m over n and its four neighbours
//! ```
//! Single precision: search directions need no more, because the residual is double.

use rayon::prelude::*;

use crate::math::grid::Grid;

/// One row: self, west, east, south, north, by P and by H.
#[derive(Debug, Clone, Copy, Default)]
pub struct Row {
    /// ∂F/∂P over D.
    pub a_p: [f32; 5],
    /// ∂F/∂H over D.
    pub a_h: [f32; 5],
}

impl Row {
    /// Sets both stencils, times `scale`.
    #[inline]
    pub fn set(&mut self, scale: f64, a_p: &[f64; 5], a_h: &[f64; 5]) {
        for k in 0..5 {
            self.a_p[k] = (a_p[k] * scale) as f32;
            self.a_h[k] = (a_h[k] * scale) as f32;
        }
    }
}

/// All rows, `ny × nx`; rows of boundary and inactive nodes are zero.
pub struct Jacobian {
    /// Rows.
    pub rows: Vec<Row>,
}

impl Jacobian {
    /// Zero rows for `grid`.
    pub fn new(grid: &Grid) -> Self {
        Self {
            rows: vec![Row::default(); grid.len()],
        }
    }

    /// `out = A_P v + A_H (w + h0)`.
    pub fn apply(&self, grid: &Grid, v: &[f32], w: &[f32], h0: f32, out: &mut [f32]) {
        let nx = grid.nx;
        let interior = grid.interior_rows();
        out.par_chunks_mut(nx)
            .enumerate()
            .with_min_len(8)
            .for_each(|(j, out)| {
                out.fill(0.0);
                if !interior.contains(&j) {
                    return;
                }
                let line = |a: &'_ [f32], j: usize| -> std::ops::Range<usize> {
                    debug_assert!(a.len() >= (j + 1) * nx);
                    j * nx..(j + 1) * nx
                };
                let (south, north) = (line(v, grid.row_below(j)), line(v, grid.row_above(j)));
                let here = line(v, j);
                let rows = &self.rows[here.clone()];
                let (v0, vs, vn) = (&v[here.clone()], &v[south.clone()], &v[north.clone()]);
                let (w0, ws, wn) = (&w[here], &w[south], &w[north]);
                for i in 1..nx - 1 {
                    let (p, h) = (&rows[i].a_p, &rows[i].a_h);
                    out[i] = p[0] * v0[i]
                        + p[1] * v0[i - 1]
                        + p[2] * v0[i + 1]
                        + p[3] * vs[i]
                        + p[4] * vn[i]
                        + h[0] * (w0[i] + h0)
                        + h[1] * (w0[i - 1] + h0)
                        + h[2] * (w0[i + 1] + h0)
                        + h[3] * (ws[i] + h0)
                        + h[4] * (wn[i] + h0);
                }
            });
    }

    /// `out = A_P v + e v`: the local part with an extra diagonal `e`.
    pub fn apply_local(&self, grid: &Grid, extra: &[f32], v: &[f32], out: &mut [f32]) {
        let nx = grid.nx;
        let interior = grid.interior_rows();
        out.par_chunks_mut(nx)
            .enumerate()
            .with_min_len(8)
            .for_each(|(j, out)| {
                out.fill(0.0);
                if !interior.contains(&j) {
                    return;
                }
                let (south, north) = (grid.row_below(j) * nx, grid.row_above(j) * nx);
                for i in 1..nx - 1 {
                    let n = j * nx + i;
                    let p = &self.rows[n].a_p;
                    out[i] = (p[0] + extra[n]) * v[n]
                        + p[1] * v[n - 1]
                        + p[2] * v[n + 1]
                        + p[3] * v[south + i]
                        + p[4] * v[north + i];
                }
            });
    }
}
