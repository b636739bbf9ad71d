//! The transient Reynolds equation as a contact problem along characteristics, and its exact
//! derivative.
//!
//! ```text
//! F = ρ̄H − C* − s ∇·(τ ∇P) = 0 where P > 0,   F ≥ 0 where P = 0
//! τ at a face = harmonic mean of ρ̄H³ × logarithmic mean of g, over λ;   g: fluidity 1/η̄* along or across (`fluidity.rs`);
//!     along the sliding of Eyring oil less where the pressure is steep (`steep.rs`)
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
//! law along a line of constant flow. What both lack beyond second order is added where films are smooth (`deferred.rs`). There is no floor on H: H ≤ 0 has no conductance. As τ → 0 the
//! equation is the dry contact condition ρ̄H = C* ≥ 0. Second order. Tests: `tests/engine/ehl_smooth.rs`.
//! Sources: Venner and Lubrecht (2000) for the scaling; Hu and Zhu (2000) for the unified view.

mod closing;
mod deferred;
mod linearise;

use rayon::prelude::*;

pub use deferred::{Guessed, Lacking};
pub use linearise::Linearisation;

use super::faces::{Faces, conductances};
use super::fluidity::{FlowDirection, Fluidity};
use super::jacobian::Jacobian;
pub use super::medium::Medium;
use super::reynolds_rows::{balance_row, density_values, finish_row};
use crate::math::grid::Grid;

/// Rows per parallel task; untuned.
const ROWS: usize = 4;

/// Scratch of one block of rows.
struct Scratch {
    east: Faces,
    /// Faces below and above the row at hand.
    south: Faces,
    north: Faces,
}

/// Node properties and the residual of the current iterate.
pub struct Reynolds {
    /// ρ̄H³.
    q: Vec<f64>,
    /// g.
    fluidity: Fluidity,
    /// ρ̄ and its derivative.
    rho: Vec<f64>,
    rho_p: Vec<f64>,
    /// ∂q/∂P and ∂q/∂H of the linearisation (`closing.rs`).
    q_p: Vec<f64>,
    q_h: Vec<f64>,
    /// Conductance over λ of the faces with the eastern neighbour and with the row above.
    east: Vec<f64>,
    north: Vec<f64>,
    scratch: Vec<Scratch>,
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
        let zero = vec![0.0; n];
        let scratch = (0..grid.ny.div_ceil(ROWS))
            .map(|_| Scratch {
                east: Faces::new(grid.nx),
                south: Faces::new(grid.nx),
                north: Faces::new(grid.nx),
            })
            .collect();
        Self {
            q: zero.clone(),
            fluidity: Fluidity::new(n),
            rho: vec![1.0; n],
            rho_p: zero.clone(),
            q_p: zero.clone(),
            q_h: zero.clone(),
            east: zero.clone(),
            north: zero.clone(),
            scratch,
            residual: zero.clone(),
            diagonal: vec![1.0; n],
            conductance: zero,
            row_scale: vec![1.0; n],
        }
    }

    /// Density of node `n` at the last call of [`Reynolds::properties`].
    pub fn rho(&self, n: usize) -> f64 {
        self.rho[n]
    }

    /// Densities of all nodes at the last call of [`Reynolds::properties`].
    pub fn densities(&self) -> &[f64] {
        &self.rho
    }

    /// From now on the oil is thinner by ln η̄ (1 + c/scale) + c: c of every node and 1/scale (`physics/thinning.rs`); `None`: cold.
    pub fn warm(&mut self, thinner: Option<(&[f64], f64)>) {
        self.fluidity.warm.set(thinner);
    }

    /// Power of the pressure's flow at every node, τ |∇P|², from the conductances of the last residual: half of what each of its
    /// faces has.
    pub fn power(&self, grid: &Grid, p: &[f64], power: &mut [f64]) {
        let nx = grid.nx;
        let (wx, wy) = grid.flow_weights();
        let interior = grid.interior_rows();
        let (east, north) = (&self.east, &self.north);
        let rows = power.par_chunks_mut(nx).enumerate().with_min_len(ROWS);
        rows.for_each(|(j, power)| {
            power.fill(0.0);
            if !interior.contains(&j) {
                return;
            }
            let row = |j: usize| &p[j * nx..(j + 1) * nx];
            let (here, above, below) = (row(j), row(grid.row_above(j)), row(grid.row_below(j)));
            let faces = |j: usize| j * nx..(j + 1) * nx;
            let (east, up) = (&east[faces(j)], &north[faces(j)]);
            let down = &north[faces(face_below(grid, j))];
            for i in 1..nx - 1 {
                let along = east[i] * (here[i + 1] - here[i]).powi(2)
                    + east[i - 1] * (here[i] - here[i - 1]).powi(2);
                let across =
                    up[i] * (above[i] - here[i]).powi(2) + down[i] * (here[i] - below[i]).powi(2);
                power[i] = 0.5 * (wx * along + wy * across);
            }
        });
    }

    /// Evaluates the fluid laws at every node.
    pub fn properties(&mut self, grid: &Grid, medium: &Medium, p: &[f64], h: &[f64]) {
        let block = ROWS * grid.nx;
        self.q
            .par_chunks_mut(block)
            .zip(self.rho.par_chunks_mut(block))
            .zip(self.rho_p.par_chunks_mut(block))
            .zip(p.par_chunks(block))
            .zip(h.par_chunks(block))
            .for_each(|((((q, rho), rho_p), p), h)| {
                density_values(medium.density, p, h, q, rho, rho_p);
            });
        self.fluidity.evaluate(grid, medium, p, h, block);
    }

    /// Conductances of all faces.
    fn fill_faces(&mut self, grid: &Grid, lambda: f64, p: &[f64], h: &[f64]) {
        let nx = grid.nx;
        let (mut east, mut north) = (
            std::mem::take(&mut self.east),
            std::mem::take(&mut self.north),
        );
        let this = &*self;
        east.par_chunks_mut(nx)
            .zip(north.par_chunks_mut(nx))
            .enumerate()
            .with_min_len(ROWS)
            .for_each(|(j, (east, north))| {
                let nodes = |direction, range| this.fluidity.nodes(direction, &this.q, range);
                let a = nodes(FlowDirection::Along, j * nx..(j + 1) * nx - 1);
                let b = nodes(FlowDirection::Along, j * nx + 1..(j + 1) * nx);
                let out = &mut east[..nx - 1];
                conductances(a.q, a.g, a.ln_g, b.q, b.g, b.ln_g, 1.0 / lambda, out);
                if let Some(steep) = this.fluidity.steep((p, h), j * nx, nx - 1) {
                    steep.lessen(out);
                }
                if j + 1 < grid.ny {
                    let a = nodes(FlowDirection::Across, j * nx..(j + 1) * nx);
                    let b = nodes(FlowDirection::Across, (j + 1) * nx..(j + 2) * nx);
                    conductances(a.q, a.g, a.ln_g, b.q, b.g, b.ln_g, 1.0 / lambda, north);
                }
            });
        (self.east, self.north) = (east, north);
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
        self.fill_faces(grid, lambda, p, h);
        let nx = grid.nx;
        let weights = grid.flow_weights();
        let interior = grid.interior_rows();
        let (rho, east, north) = (&self.rho, &self.east, &self.north);
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
                let row = |j: usize| j * nx..(j + 1) * nx;
                let here = row(j);
                let (south, above) = (row(grid.row_below(j)), row(grid.row_above(j)));
                let below = row(face_below(grid, j));
                balance_row(
                    &p[here.clone()],
                    &p[south],
                    &p[above],
                    &east[here.clone()],
                    &north[below],
                    &north[here.clone()],
                    &s[here.clone()],
                    weights,
                    f,
                    d,
                    t,
                );
                finish_row(
                    &rho[here.clone()],
                    &h[here.clone()],
                    &c_star[here],
                    k00,
                    f,
                    d,
                    scale,
                );
            });
    }

    /// The derivative of F, rows divided by `row_scale`; rows that are not active are zero. Not the tangent where films
    /// close or are about to open (`closing.rs`); at a solution it is.
    pub fn linearise(&mut self, grid: &Grid, at: &Linearisation, jacobian: &mut Jacobian) {
        self.fill_slopes(grid, at);
        let interior = grid.interior_rows();
        let mut scratch = std::mem::take(&mut self.scratch);
        let this = &*self;
        let row_len = jacobian.row_len();
        // Slices: rayon's own `chunks` would make a vector for each block.
        jacobian
            .blocks_mut(ROWS)
            .zip(scratch.par_iter_mut())
            .enumerate()
            .for_each(|(b, (rows, scratch))| {
                for (k, row) in rows.chunks_exact_mut(row_len).enumerate() {
                    let j = b * ROWS + k;
                    if interior.contains(&j) {
                        this.linearise_row(grid, at, j, scratch, row);
                    } else {
                        row.fill(0.0);
                    }
                }
            });
        self.scratch = scratch;
    }
}

/// The row whose faces with the row above it are the faces of row `j` with the row below; mirrored.
fn face_below(grid: &Grid, j: usize) -> usize {
    grid.row_below(j).min(j)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::math::grid::Symmetry;
    use crate::physics::fluid::{Density, ShearedFlow, Viscosity};
    use crate::solve::film::{Elastic, macroscopic_gap};

    /// C* so large that no film closes: every slope is the tangent.
    const RICH: f64 = 1e3;

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
        let (c, s) = (vec![RICH; n], vec![0.05; n]);
        reynolds.residual(grid, elastic.k00, medium.lambda, p, &h, &c, &s);
        (reynolds, h)
    }

    /// One law for both directions; along and across, nowhere at the limiting stress; at it at some of the nodes; with
    /// slopes that are steep.
    const FLOWS: [ShearedFlow; 4] = [
        ShearedFlow::Secant,
        ShearedFlow::AlongAcross {
            limit: 1e3,
            steepness: 0.0,
        },
        ShearedFlow::AlongAcross {
            limit: 6.0,
            steepness: 0.0,
        },
        ShearedFlow::AlongAcross {
            limit: 6.0,
            steepness: 3.0,
        },
    ];

    #[test]
    fn the_linearisation_is_the_derivative() {
        let symmetries = [Symmetry::MirrorY, Symmetry::General, Symmetry::Line];
        for (symmetry, sheared) in symmetries
            .into_iter()
            .flat_map(|symmetry| FLOWS.map(|sheared| (symmetry, sheared)))
        {
            let grid = Grid::new(17, -2.0, 1.5, 1.6, symmetry);
            let mut elastic = Elastic::new(&grid, 0.2);
            let medium = Medium {
                viscosity: Viscosity::roelands(0.04, 2.2e-8, 5e8),
                density: Density::DowsonHigginson { p_hertz_gpa: 0.5 },
                lambda: 0.05,
                sliding: 0.3,
                sheared,
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
            let (mut reynolds, h) = residual_of(&grid, &mut elastic, &medium, &p, h0);
            let mut jacobian = Jacobian::new(&grid);
            let (c, s, active) = (vec![RICH; n], vec![0.05; n], vec![true; n]);
            let at = Linearisation {
                p: &p,
                h: &h,
                c_star: &c,
                s: &s,
                lambda: medium.lambda,
                k00: elastic.k00,
                active: &active,
            };
            reynolds.linearise(&grid, &at, &mut jacobian);
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
                    "{symmetry:?} {sheared:?} {n}: {exact} {ours}"
                );
            }
        }
    }
}
