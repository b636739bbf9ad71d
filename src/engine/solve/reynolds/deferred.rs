//! What the flow of second order lacks where films are smooth, as a flow through the faces that one step holds fixed.
//!
//! ```text
//! f_k = τ_k (P_k+1 − P_k)            flow through face k, between the nodes k and k + 1
//! −ΔP = ∫ Q r dx,   r = 1/(ρ̄H³g)     along the face, Q = Q_k + Q'ξ + Q''ξ²/2 from the flows around, r by Simpson's rule with
//!                                    H and g of the middle by cubics through four nodes
//! Q_k = [f_k r̄_k − Q'(r_b − r_a)/12 − Q''(r_a + r_b)/48]/r̄,   r̄_k = the resistance that f_k has
//! e_k = Q_k − Q''/24 − f_k           Q''/24: a difference of flows is their slope to order 4
//! C* ← C* + s ∇·e
//! ```
//! The harmonic mean of ρ̄H³ errs by (dX H'/H)²: in the inlet, whose length is of H_c^(2/3), that is the rule for the error
//! of the film on a mesh (`plan/truncation.rs`). A flow through faces loses no oil. e is taken at the first guess of a step
//! and held, so that Newton's matrix stays what it is; a steady film is its own first
//! guess. There is none where one of the four nodes around has no pressure or no film, and it is bounded by the flow itself
//! and by the oil of both nodes, so that C* stays above 0 and films that close stay with the harmonic mean, which cannot leak.
//!
//! With `eyring_flow = "along_across"` the slope of steep crests enters its law as the face has it, to second order.
//!
//! Source: Stetter (1978), *The defect correction principle and discretization methods*, Numer. Math. 29, for correcting a scheme by
//! the residual of a better one. Ours: the resistance in place of the fluidity, and the bounds.
//!
//! Tried and left: 1/H³ integrated for a film that is linear between nodes, in place of the harmonic mean in every iteration:
//! crests then leak, films close that are 25 nm thick, and steps take forty times the iterations.
//! Richardson's extrapolation of the flow from dX and 2dX: smooth films as good or better, waves of 13 nodes are too steep
//! for it (default scene at 129 nodes: central film 2.4 % too thick, least film by a quarter).

use rayon::prelude::*;

use super::super::faces::log_mean;
use super::super::fluidity::FlowDirection;
use super::{ROWS, Reynolds, face_below};
use crate::math::grid::{Grid, Symmetry};

/// Most of a node's oil that a correction moves through one face: the four of a node leave it more than half, so that C* stays
/// above 0.
const MOST_OIL: f64 = 0.1;

/// First guess of a step, and what it is solved against.
#[derive(Clone, Copy)]
pub struct Guessed<'a> {
    /// P, shape ny × nx.
    pub p: &'a [f64],
    /// H.
    pub h: &'a [f64],
    /// C*.
    pub c_star: &'a [f64],
    /// s.
    pub s: &'a [f64],
}

/// Film and fluidity at the four nodes around a face, densities at the two beside it.
struct Around {
    h: [f64; 4],
    g: [f64; 4],
    ln_g: [f64; 2],
    rho: [f64; 2],
}

/// Value in the middle of four that are a spacing apart, near those beside it.
#[inline(always)]
fn middle(v: [f64; 4]) -> f64 {
    let cubic = (9.0 * (v[1] + v[2]) - v[0] - v[3]) / 16.0;
    bounded(cubic, 0.5 * v[1].min(v[2]), 1.5 * v[1].max(v[2]))
}

/// `value` between two bounds, without the branch and the panic of `clamp`, which keep a loop from the vector units.
#[inline(always)]
fn bounded(value: f64, least: f64, most: f64) -> f64 {
    value.max(least).min(most)
}

/// e of a face from the flows through it and its two neighbours.
#[inline(always)]
fn lacking(f: [f64; 3], around: &Around, most: f64) -> f64 {
    let Around { h, g, ln_g, rho } = around;
    let resistance = |rho: f64, h: f64, g: f64| 1.0 / (rho * h * h * h * g);
    let plain = 0.5 * (resistance(rho[0], h[1], 1.0) + resistance(rho[1], h[2], 1.0));
    let harmonic = plain / log_mean(g[1], g[2], ln_g[0] - ln_g[1]);
    let (a, b) = (
        resistance(rho[0], h[1], g[1]),
        resistance(rho[1], h[2], g[2]),
    );
    let c = resistance(0.5 * (rho[0] + rho[1]), middle(*h), middle(*g));
    let (slope, bend) = (0.5 * (f[2] - f[0]), f[2] - 2.0 * f[1] + f[0]);
    let falls = f[1] * harmonic - slope * (b - a) / 12.0 - bend * (a + b) / 48.0;
    let raw = 6.0 * falls / (a + 4.0 * c + b) - bend / 24.0 - f[1];
    let most = most.min((f[0].abs() + f[1].abs() + f[2].abs()) / 3.0);
    bounded(raw, -most, most)
}

/// Faces that are worked out beside each other.
const LANES: usize = 8;

/// A run of faces: of the four nodes around face k what `p[0][k]` to `p[3][k]` and so on hold.
#[derive(Clone, Copy)]
struct Run<'a> {
    p: [&'a [f64]; 4],
    h: [&'a [f64]; 4],
    g: [&'a [f64]; 4],
    ln_g: [&'a [f64]; 2],
    rho: [&'a [f64]; 2],
    /// Conductances of the face before, of the face and of the face behind.
    tau: [&'a [f64]; 3],
    c_star: [&'a [f64]; 2],
    s: [&'a [f64]; 2],
}

/// `LANES` values from `start` on; beyond the end zeros, as of closed films. Loops, here and below: the library's `map`
/// over arrays is compiled for the narrow units and called a value at a time (a fortieth of a frame).
#[inline(always)]
fn lanes<const N: usize>(runs: [&[f64]; N], start: usize) -> [[f64; LANES]; N] {
    let mut all = [[0.0; LANES]; N];
    for (values, run) in all.iter_mut().zip(runs) {
        let left = &run[start..];
        if let Some(chunk) = left.first_chunk() {
            *values = *chunk;
        } else {
            values[..left.len()].copy_from_slice(left);
        }
    }
    all
}

/// The values of one lane.
#[inline(always)]
fn lane<const N: usize>(values: &[[f64; LANES]; N], k: usize) -> [f64; N] {
    let mut all = [0.0; N];
    for (value, of) in all.iter_mut().zip(values) {
        *value = of[k];
    }
    all
}

dispatched! {
/// e of a run of faces whose flow counts with weight `w`; 0 where one of the four nodes has no pressure or no film.
fn fill(run: &Run, w: f64, out: &mut [f64]) {
    for (chunk, e) in out.chunks_mut(LANES).enumerate() {
        let start = chunk * LANES;
        let (p, h, g) = (lanes(run.p, start), lanes(run.h, start), lanes(run.g, start));
        let (ln_g, rho) = (lanes(run.ln_g, start), lanes(run.rho, start));
        let (tau, c_star, s) = (lanes(run.tau, start), lanes(run.c_star, start), lanes(run.s, start));
        let mut all = [0.0; LANES];
        for (k, lacks) in all.iter_mut().enumerate() {
            let (p, tau) = (lane(&p, k), lane(&tau, k));
            let around = Around { h: lane(&h, k), g: lane(&g, k), ln_g: lane(&ln_g, k), rho: lane(&rho, k) };
            let ([c_a, c_b], [s_a, s_b]) = (lane(&c_star, k), lane(&s, k));
            let flows = [tau[0] * (p[1] - p[0]), tau[1] * (p[2] - p[1]), tau[2] * (p[3] - p[2])];
            let most = MOST_OIL * c_a.min(c_b) / (w * s_a.max(s_b));
            let least = |v: [f64; 4]| v[0].min(v[1]).min(v[2].min(v[3]));
            let is_open = least(p).min(least(around.h)) > 0.0;
            let lacking = lacking(flows, &around, most);
            *lacks = if is_open { lacking } else { 0.0 };
        }
        e.copy_from_slice(&all[..e.len()]);
    }
}
}

/// What the flow lacks through the faces with the eastern neighbour and with the row above.
pub struct Lacking {
    east: Vec<f64>,
    north: Vec<f64>,
}

impl Lacking {
    /// Room for `n` nodes.
    pub fn new(n: usize) -> Self {
        Self {
            east: vec![0.0; n],
            north: vec![0.0; n],
        }
    }

    /// Adds to `c_star` what the flow of second order lacks, and takes it off F. Properties, faces and F are those of the
    /// last call of [`Reynolds::residual`], at this guess.
    pub fn correct(
        &mut self,
        reynolds: &mut Reynolds,
        grid: &Grid,
        at: &Guessed,
        c_star: &mut [f64],
    ) {
        let nx = grid.nx;
        let is_line = grid.symmetry == Symmetry::Line;
        let flow = &*reynolds;
        let faces = self
            .east
            .par_chunks_mut(nx)
            .zip(self.north.par_chunks_mut(nx));
        faces
            .enumerate()
            .with_min_len(ROWS)
            .for_each(|(j, (east, north))| {
                flow.lacking_along(grid, at, j, east);
                if !is_line {
                    flow.lacking_across(grid, at, j, north);
                }
            });
        let (wx, wy) = grid.flow_weights();
        let interior = grid.interior_rows();
        let rows = reynolds
            .residual
            .par_chunks_mut(nx)
            .zip(c_star.par_chunks_mut(nx));
        rows.enumerate()
            .with_min_len(ROWS)
            .filter(|(j, _)| interior.contains(j))
            .for_each(|(j, (f, c_star))| {
                let east = &self.east[j * nx..][..nx];
                let north = &self.north[j * nx..][..nx];
                for i in 1..nx - 1 {
                    let mut comes = wx * (east[i] - east[i - 1]);
                    if !is_line {
                        let south = match (j, grid.symmetry) {
                            (0, Symmetry::MirrorY) => -north[i],
                            (0, Symmetry::General | Symmetry::Line) => 0.0,
                            (1.., _) => self.north[(j - 1) * nx + i],
                        };
                        comes += wy * (north[i] - south);
                    }
                    let comes = at.s[j * nx + i] * comes;
                    c_star[i] += comes;
                    f[i] -= comes;
                }
            });
    }
}

impl Reynolds {
    /// Faces whose four nodes begin at `starts`, and whose conductances begin at `faces` in `tau`.
    fn run<'a>(
        &'a self,
        at: &Guessed<'a>,
        direction: FlowDirection,
        (starts, len): ([usize; 4], usize),
        (tau, faces): (&'a [f64], [usize; 3]),
    ) -> Run<'a> {
        let fluidities = self.fluidity.nodes(direction, &self.q, 0..self.q.len());
        let all = |of: &'a [f64]| starts.map(|start| &of[start..start + len]);
        let two = |of: &'a [f64]| [starts[1], starts[2]].map(|start| &of[start..start + len]);
        Run {
            p: all(at.p),
            h: all(at.h),
            g: all(fluidities.g),
            ln_g: two(fluidities.ln_g),
            rho: two(&self.rho),
            tau: faces.map(|face| &tau[face..face + len]),
            c_star: two(at.c_star),
            s: two(at.s),
        }
    }

    /// e of the faces along row `j`: those between the nodes 1 and nx − 2.
    fn lacking_along(&self, grid: &Grid, at: &Guessed, j: usize, out: &mut [f64]) {
        let (start, len) = (j * grid.nx, grid.nx - 3);
        let nodes = [0, 1, 2, 3].map(|k| start + k);
        let faces = (&self.east[..], [0, 1, 2].map(|k| start + k));
        let run = self.run(at, FlowDirection::Along, (nodes, len), faces);
        fill(&run, grid.flow_weights().0, &mut out[1..=len]);
    }

    /// e of the faces between rows `j` and `j + 1`.
    fn lacking_across(&self, grid: &Grid, at: &Guessed, j: usize, out: &mut [f64]) {
        let interior = grid.interior_rows();
        if !interior.contains(&j) || !interior.contains(&(j + 1)) {
            return;
        }
        let nx = grid.nx;
        let nodes = [grid.row_below(j), j, j + 1, grid.row_above(j + 1)].map(|row| row * nx);
        let faces = (
            &self.north[..],
            [face_below(grid, j), j, j + 1].map(|row| row * nx),
        );
        let run = self.run(at, FlowDirection::Across, (nodes, nx), faces);
        fill(&run, grid.flow_weights().1, out);
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::physics::fluid::{Density, ShearedFlow, Viscosity};
    use crate::solve::reynolds::Medium;

    /// A smooth film and pressure on n × n nodes of [−1, 1]².
    fn laid(n: usize, symmetry: Symmetry) -> (Grid, Vec<f64>, Vec<f64>) {
        let grid = Grid::new(n, -1.0, 1.0, 1.0, symmetry);
        let at = |k: usize| (grid.x(k % n), grid.y(k / n));
        let field = |f: &dyn Fn(f64, f64) -> f64| {
            (0..grid.len())
                .map(|k| {
                    let (x, y) = at(k);
                    f(x, y)
                })
                .collect::<Vec<f64>>()
        };
        let p = field(&|x, y| 2.0 + (1.3 * x + 0.4).sin() * (0.9 * y).cos());
        let h = field(&|x, y| 1.0 + 0.3 * (1.7 * x).cos() + 0.1 * y * y);
        (grid, p, h)
    }

    /// s∇·flow of second and of high order at x = 1/4, y = 1/4 (a node of every grid asked for), and all that comes.
    fn flows(n: usize, symmetry: Symmetry, sheared: ShearedFlow) -> ([f64; 2], f64) {
        let (grid, p, h) = laid(n, symmetry);
        let medium = Medium {
            viscosity: Viscosity::Barus { alpha_p: 0.7 },
            density: Density::Incompressible,
            lambda: 1.0,
            sliding: 0.8,
            sheared,
        };
        let len = grid.len();
        let mut reynolds = Reynolds::new(&grid);
        reynolds.properties(&grid, &medium, &p, &h);
        let (c_star, s) = (vec![1e3; len], vec![1.0; len]);
        reynolds.residual(&grid, 0.1, 1.0, &p, &h, &c_star, &s);
        let at = Guessed {
            p: &p,
            h: &h,
            c_star: &c_star,
            s: &s,
        };
        let row = (0..grid.ny)
            .find(|&j| (grid.y(j) - 0.25).abs() < 1e-9)
            .expect("a node");
        let node = row * n + 5 * (n - 1) / 8;
        let flow = |reynolds: &Reynolds, c: &[f64]| h[node] - c[node] - reynolds.residual[node];
        let second = flow(&reynolds, &c_star);
        let mut corrected = c_star.clone();
        Lacking::new(len).correct(&mut reynolds, &grid, &at, &mut corrected);
        let high = second + corrected[node] - c_star[node];
        assert!((h[node] - c_star[node] - reynolds.residual[node] - high).abs() < 1e-9);
        let come = grid.integrate(|k| corrected[k] - c_star[k]);
        ([second, high], come)
    }

    #[test]
    fn smooth_flow_is_of_high_order_and_no_oil_is_lost() {
        let directed = |steepness: f64| ShearedFlow::AlongAcross {
            limit: 1e3,
            steepness,
        };
        // Steep slopes along the sliding come into their law as the face has them, to second order.
        for (symmetry, sheared, least) in [
            (Symmetry::MirrorY, ShearedFlow::Secant, 3.5),
            (Symmetry::General, ShearedFlow::Secant, 3.5),
            (Symmetry::MirrorY, directed(1e-6), 3.5),
            (Symmetry::MirrorY, directed(0.5), 1.8),
        ] {
            let [a, b, c, d] = [17, 33, 65, 129].map(|n| flows(n, symmetry, sheared));
            let order = |k: usize| ((a.0[k] - b.0[k]) / (b.0[k] - c.0[k])).abs().log2();
            let fine = |k: usize| ((b.0[k] - c.0[k]) / (c.0[k] - d.0[k])).abs().log2();
            println!(
                "{symmetry:?} {sheared:?}: {:.2} {:.2}, {:.2} {:.2}",
                order(0),
                fine(0),
                order(1),
                fine(1)
            );
            assert!((fine(0) - 2.0).abs() < 0.2 && fine(1) > least);
            for (_, come) in [a, b, c, d] {
                assert!(come.abs() < 1e-9, "{come}");
            }
        }
    }

    #[test]
    fn what_is_lacking_is_bounded_by_flow_and_oil() {
        let even = Around {
            h: [1.0; 4],
            g: [1.0; 4],
            ln_g: [0.0; 2],
            rho: [1.0; 2],
        };
        // Uniform films: −δ²f/12, as of ∂⁴P of a plain second difference.
        assert!(lacking([1.0, 1.0, 1.0], &even, 9.0).abs() < 1e-15);
        assert!((lacking([1.0, 1.3, 1.0], &even, 9.0) - 0.05).abs() < 1e-14);
        assert!((lacking([9.0, 0.0, 9.0], &even, 1.0) + 1.0).abs() < 1e-15);
        let steep = Around {
            h: [1.0, 1.0, 0.01, 0.01],
            ..even
        };
        assert!(lacking([0.1, 0.1, 0.1], &steep, 9.0).abs() <= 0.1 + 1e-15);
    }
}
