//! The transient Reynolds equation as a contact problem along characteristics, and its exact
//! derivative.
//!
//! ```text
//! F = ρ̄H − C* − s ∇·(τ ∇P) = 0 where P > 0,   F ≥ 0 where P = 0
//! τ at a face = harmonic mean of ρ̄H³ × logarithmic mean of 1/η̄*, over λ
//! J v = A_P v + A_H (K v + h0),   A_P = ∂F/∂P at fixed H,   A_H = ∂F/∂H
//! ```
//! | symbol | meaning | shape |
//! |---|---|---|
//! | P, H, F | pressure, film, residual in film units | ny × nx |
//! | C*, s | convected mass and effective step (`history.rs`) | ny × nx |
//! | λ | 12 U η0 Rx²/(a³ p_h) | scalar |
//! | D | ρ̄K00 + s Σ τ/d²: turns F into pressure units, F/D | ny × nx |
//!
//! The harmonic mean lets no flow through a touching node; the logarithmic mean is exact for Barus'
//! law along a line of constant flow. There is no floor on H: H ≤ 0 has no conductance. As τ → 0 the
//! equation is the dry contact condition ρ̄H = C* ≥ 0. Second order. Tests: `tests/ehl_smooth.rs`.
//! Sources: Venner and Lubrecht (2000) for the scaling; Hu and Zhu (2000) for the unified view.

use rayon::prelude::*;

use super::jacobian::Jacobian;
use crate::math::grid::Grid;
use crate::physics::fluid::{Density, Viscosity, eyring_ln_factor};

/// Rows per parallel task.
const ROWS: usize = 4;

/// The fluid, dimensionless.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Medium {
    /// Viscosity law.
    pub viscosity: Viscosity,
    /// Density law.
    pub density: Density,
    /// λ.
    pub lambda: f64,
    /// Z = η0 |U2−U1| Rx/(τ0 a²); 0: Newtonian.
    pub sliding: f64,
}

/// Values of one node that the faces need.
#[derive(Debug, Clone, Copy, Default)]
struct Node {
    /// ρ̄H³ and derivatives with respect to P and H.
    q: f64,
    q_p: f64,
    q_h: f64,
    /// 1/η̄*, its logarithm and derivatives.
    g: f64,
    ln_g: f64,
    g_p: f64,
    g_h: f64,
    /// ρ̄ and its derivative.
    rho: f64,
    rho_p: f64,
}

/// A face's conductance and derivatives; "a" is this node, "b" the neighbour.
#[derive(Debug, Clone, Copy, Default)]
struct Face {
    tau: f64,
    p_a: f64,
    h_a: f64,
    p_b: f64,
    h_b: f64,
}

/// Node properties and the residual of the current iterate.
pub struct Reynolds {
    nodes: Vec<Node>,
    /// F, film units.
    pub residual: Vec<f64>,
    /// D.
    pub diagonal: Vec<f64>,
    /// Mean conductance of a node's faces.
    pub conductance: Vec<f64>,
    /// Scale of the linear rows, √(D K00): between pressure and film units, so that the linear solve
    /// serves the inlet (where D is large) and the contact alike.
    pub row_scale: Vec<f64>,
}

impl Reynolds {
    /// Buffers for `grid`.
    pub fn new(grid: &Grid) -> Self {
        let n = grid.len();
        Self {
            nodes: vec![Node::default(); n],
            residual: vec![0.0; n],
            diagonal: vec![1.0; n],
            conductance: vec![0.0; n],
            row_scale: vec![1.0; n],
        }
    }

    /// Density of node `n` at the last call of [`Reynolds::properties`].
    pub fn rho(&self, n: usize) -> f64 {
        self.nodes[n].rho
    }

    /// Evaluates the fluid laws at every node.
    pub fn properties(&mut self, grid: &Grid, medium: &Medium, p: &[f64], h: &[f64]) {
        let nx = grid.nx;
        self.nodes
            .par_chunks_mut(ROWS * nx)
            .zip(p.par_chunks(ROWS * nx))
            .zip(h.par_chunks(ROWS * nx))
            .for_each(|((nodes, p), h)| {
                for ((node, &p), &h) in nodes.iter_mut().zip(p).zip(h) {
                    *node = node_values(medium, p, h);
                }
            });
    }

    /// F and D from the properties.
    pub fn residual(
        &mut self,
        grid: &Grid,
        k00: f64,
        lambda: f64,
        p: &[f64],
        h: &[f64],
        c_star: &[f64],
        s: &[f64],
    ) {
        let nx = grid.nx;
        let nodes = &self.nodes;
        let (wx, wy) = grid.flow_weights();
        let interior = grid.interior_rows();
        self.residual
            .par_chunks_mut(nx)
            .zip(self.diagonal.par_chunks_mut(nx))
            .zip(self.conductance.par_chunks_mut(nx))
            .zip(self.row_scale.par_chunks_mut(nx))
            .enumerate()
            .with_min_len(ROWS)
            .for_each(|(j, (((f, d), t), scale))| {
                f.fill(0.0);
                d.fill(1.0);
                t.fill(0.0);
                scale.fill(1.0);
                if !interior.contains(&j) {
                    return;
                }
                let (south, north) = (grid.row_below(j) * nx, grid.row_above(j) * nx);
                for i in 1..nx - 1 {
                    let n = j * nx + i;
                    let conductance = |m: usize| face_conductance(&nodes[n], &nodes[m]) / lambda;
                    let (w, e) = (conductance(n - 1), conductance(n + 1));
                    let (so, no) = (conductance(south + i), conductance(north + i));
                    let flow = wx * (e * (p[n + 1] - p[n]) + w * (p[n - 1] - p[n]))
                        + wy * (no * (p[north + i] - p[n]) + so * (p[south + i] - p[n]));
                    f[i] = nodes[n].rho * h[n] - c_star[n] - s[n] * flow;
                    d[i] = nodes[n].rho * k00 + s[n] * (wx * (e + w) + wy * (no + so));
                    scale[i] = (d[i] * k00).sqrt();
                    t[i] = 0.25 * (e + w + no + so);
                }
            });
    }

    /// The derivative of F, rows divided by `row_scale`; rows where `active` is false are zero.
    pub fn linearise(
        &self,
        grid: &Grid,
        lambda: f64,
        p: &[f64],
        h: &[f64],
        s: &[f64],
        active: &[bool],
        jacobian: &mut Jacobian,
    ) {
        let nx = grid.nx;
        let nodes = &self.nodes;
        let (wx, wy) = grid.flow_weights();
        let interior = grid.interior_rows();
        let row_scale = &self.row_scale;
        jacobian
            .rows
            .par_chunks_mut(nx)
            .enumerate()
            .with_min_len(ROWS)
            .for_each(|(j, rows)| {
                rows.fill(super::jacobian::Row::default());
                if !interior.contains(&j) {
                    return;
                }
                let (south, north) = (grid.row_below(j) * nx, grid.row_above(j) * nx);
                for (i, row) in rows.iter_mut().enumerate().take(nx - 1).skip(1) {
                    let n = j * nx + i;
                    if !active[n] {
                        continue;
                    }
                    let around = [(n - 1, wx), (n + 1, wx), (south + i, wy), (north + i, wy)];
                    let scale = 1.0 / row_scale[n];
                    let mut a_p = [0.0_f64; 5];
                    let mut a_h = [0.0_f64; 5];
                    a_p[0] = nodes[n].rho_p * h[n];
                    a_h[0] = nodes[n].rho;
                    for (k, (m, weight)) in around.into_iter().enumerate() {
                        let face = face_derivatives(&nodes[n], &nodes[m]);
                        let w = s[n] * weight / lambda;
                        let dp = p[m] - p[n];
                        a_p[0] += w * (face.tau - face.p_a * dp);
                        a_p[k + 1] = -w * (face.tau + face.p_b * dp);
                        a_h[0] -= w * face.h_a * dp;
                        a_h[k + 1] = -w * face.h_b * dp;
                    }
                    row.set(scale, &a_p, &a_h);
                }
            });
    }
}

#[inline]
fn node_values(medium: &Medium, p: f64, h: f64) -> Node {
    let (rho, rho_p) = medium.density.rho(p);
    let (ln_eta, ln_eta_p) = if p == 0.0 {
        (0.0, medium.viscosity.ln_eta(0.0).1)
    } else {
        medium.viscosity.ln_eta(p)
    };
    let open = h.max(0.0);
    let (mut ln_g, mut slope_p, mut slope_h) = (-ln_eta, -ln_eta_p, 0.0);
    if medium.sliding > 0.0 && open > 0.0 {
        let zeta = medium.sliding / open * ln_eta.exp();
        let (factor, slope) = eyring_ln_factor(zeta);
        ln_g += factor;
        slope_p += slope * ln_eta_p;
        slope_h = -slope / open;
    }
    let g = ln_g.exp();
    Node {
        q: rho * open * open * open,
        q_p: rho_p * open * open * open,
        q_h: 3.0 * rho * open * open,
        g,
        ln_g,
        g_p: g * slope_p,
        g_h: g * slope_h,
        rho,
        rho_p,
    }
}

/// Logarithmic mean of g and its derivatives with respect to both values.
#[inline]
fn log_mean(a: &Node, b: &Node) -> (f64, f64, f64) {
    let d = a.ln_g - b.ln_g;
    if d.abs() < 1e-3 {
        // Series about equal values; the next terms are below 1e-13.
        let mid = (a.g * b.g).sqrt();
        let mean = mid * (1.0 + d * d / 24.0);
        (
            mean,
            mid / a.g * (0.5 + d / 12.0),
            mid / b.g * (0.5 - d / 12.0),
        )
    } else {
        let mean = (a.g - b.g) / d;
        (mean, (1.0 - mean / a.g) / d, (mean / b.g - 1.0) / d)
    }
}

#[inline]
fn face_conductance(a: &Node, b: &Node) -> f64 {
    let sum = a.q + b.q;
    if sum <= 0.0 {
        return 0.0;
    }
    let d = a.ln_g - b.ln_g;
    let mean = if d.abs() < 1e-3 {
        0.5 * (a.g + b.g) * (1.0 - d * d / 12.0)
    } else {
        (a.g - b.g) / d
    };
    2.0 * a.q * b.q / sum * mean
}

#[inline]
fn face_derivatives(a: &Node, b: &Node) -> Face {
    let sum = a.q + b.q;
    if sum <= 0.0 {
        return Face::default();
    }
    let harmonic = 2.0 * a.q * b.q / sum;
    let (by_a, by_b) = (2.0 * (b.q / sum).powi(2), 2.0 * (a.q / sum).powi(2));
    let (mean, mean_a, mean_b) = log_mean(a, b);
    Face {
        tau: harmonic * mean,
        p_a: by_a * a.q_p * mean + harmonic * mean_a * a.g_p,
        h_a: by_a * a.q_h * mean + harmonic * mean_a * a.g_h,
        p_b: by_b * b.q_p * mean + harmonic * mean_b * b.g_p,
        h_b: by_b * b.q_h * mean + harmonic * mean_b * b.g_h,
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::math::grid::Symmetry;
    use crate::solve::film::{Elastic, macroscopic_gap};

    /// F at fixed C*, s for pressure `p` and approach `h0`.
    fn residual_of(
        grid: &Grid,
        elastic: &mut Elastic,
        medium: &Medium,
        p: &[f64],
        h0: f64,
    ) -> (Reynolds, Vec<f64>) {
        let n = grid.len();
        let mut h = vec![0.0; n];
        let mut gap = vec![0.0; n];
        macroscopic_gap(grid, 1.0, &mut gap);
        elastic.deflect(p, &mut h);
        for (h, g) in h.iter_mut().zip(&gap) {
            *h += h0 + g;
        }
        let mut reynolds = Reynolds::new(grid);
        reynolds.properties(grid, medium, p, &h);
        let (c, s) = (vec![0.1; n], vec![0.05; n]);
        reynolds.residual(grid, elastic.k00, medium.lambda, p, &h, &c, &s);
        (reynolds, h)
    }

    #[test]
    fn the_linearisation_is_the_derivative() {
        for symmetry in [Symmetry::MirrorY, Symmetry::General, Symmetry::Line] {
            let grid = Grid::new(17, -2.0, 1.5, 1.6, symmetry);
            let mut elastic = Elastic::new(&grid, 0.2);
            let medium = Medium {
                viscosity: Viscosity::roelands(0.04, 2.2e-8, 5e8),
                density: Density::DowsonHigginson { p_hertz_gpa: 0.5 },
                lambda: 0.05,
                sliding: 0.3,
            };
            let n = grid.len();
            let (mut p, mut v) = (vec![0.0; n], vec![0.0; n]);
            for j in grid.interior_rows() {
                for i in 1..16 {
                    let r2 = grid.x(i).powi(2) + grid.y(j).powi(2);
                    p[j * 17 + i] = (1.2 - r2).max(0.0).sqrt() + 0.01;
                    v[j * 17 + i] = (0.7 * i as f64 + 0.3 * (j * j) as f64).sin();
                }
            }
            let (h0, dh0, step) = (-0.1, 0.4, 1e-6);
            let (reynolds, h) = residual_of(&grid, &mut elastic, &medium, &p, h0);
            let mut jacobian = Jacobian::new(&grid);
            let (s, active) = (vec![0.05; n], vec![true; n]);
            reynolds.linearise(&grid, medium.lambda, &p, &h, &s, &active, &mut jacobian);
            let v32: Vec<f32> = v.iter().map(|&v| v as f32).collect();
            let (mut w, mut out) = (vec![0.0_f32; n], vec![0.0_f32; n]);
            elastic.deflect_single(&v32, &mut w);
            jacobian.apply(&grid, &v32, &w, dh0 as f32, &mut out);
            let shift = |sign: f64| -> Vec<f64> {
                p.iter().zip(&v).map(|(p, v)| p + sign * step * v).collect()
            };
            let plus = residual_of(&grid, &mut elastic, &medium, &shift(1.0), h0 + step * dh0).0;
            let minus = residual_of(&grid, &mut elastic, &medium, &shift(-1.0), h0 - step * dh0).0;
            for (n, &ours) in out.iter().enumerate() {
                let exact = (plus.residual[n] - minus.residual[n]) / (2.0 * step);
                let ours = f64::from(ours) * reynolds.row_scale[n];
                let size = exact.abs().max(reynolds.diagonal[n]);
                assert!(
                    (exact - ours).abs() < 2e-5 * size,
                    "{symmetry:?} {n}: {exact} {ours}"
                );
            }
        }
    }
}
