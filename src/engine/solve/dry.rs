//! Dry contact: constrained conjugate gradients on the pressure.
//!
//! ```text
//! find 0 ≤ P ≤ P_H, H0   with   H = H0 + G + K P ≥ 0 where P < P_H,   P H = 0,   H ≤ 0 where P = P_H,   ∬P = load
//! i.e. minimise ½ PᵀKP + GᵀP over 0 ≤ P ≤ P_H of that load; −H0 is the multiplier of the load
//! contact set   C = {0 < P < P_H} ∪ {P = 0, H < 0} ∪ {P = P_H, H > 0}
//! residual      r = H on C, H0 such that ∬_C r = 0
//! direction     t = z + β t_old on C,   z = Π M⁻¹ r,   M⁻¹ = F⁻¹[F[·]/K̂] cut to C, Π takes the mean off
//! step          P ← max(P − τ t, 0), at most P_H, brought to the load,   τ = rᵀz/tᵀKt
//! ```
//! | symbol | meaning | shape |
//! |---|---|---|
//! | P, H, G | pressure, gap, undeformed gap without H0 | ny × nx |
//! | P_H | hardness of the softer body; ∞: both are elastic | scalar |
//! | K | influence of a cell (`film.rs`), K̂ its symbol | |
//! | M⁻¹ | elastic inverse on the unpadded periodic grid, single precision | |
//!
//! Source: Polonsky and Keer (1999), Wear 231, 206-219: conjugate gradients on the present
//! contact set, pressures below zero cut off, overlapping nodes let in, the search begun anew when the
//! set changes. What is added is the preconditioner: without it the iterations grow as √N, because the
//! condition of K on the set grows as N; with it they hardly do. It costs a quarter of a padded pair.
//! An overlap where P = P_H is the depth by which the softer body yields for good (`yielding.rs`, source there).
//! `K P` is carried along (`K P − τ K t`, single precision for `K t`, whose error shrinks with the step)
//! and made anew in double precision before the result is believed.
//!
//! The preconditioned residual z is nearly the Newton step, so that `∬_C |z|/load` is the relative error
//! of the pressure: what [`Tolerance::pressure`] bounds. It bounds the greatest overlap or gap on C too, in
//! units of K00, the film that a pressure of 1 on one node makes. Sums run in fixed order: the result is the same
//! on any number of threads. Order of the discretisation: 2 in the mean, 1.5 in the maximum at a node,
//! where the sampled edge of the contact rules. Tests: `tests/engine/hertz_dry.rs`, `tests/engine/dry_periodic.rs`.

mod bounds;
mod search;

use super::film::{Edge, Elastic};
use super::newton::{Iterate, NewtonReport, Tolerance, Verdict};
use crate::math::filter::{Filter, Padding};
use crate::math::grid::Grid;

/// Iterations between two exact evaluations of K P at most: more than a smooth contact takes in all (30, `tests/engine/hertz_dry.rs`).
const REFRESH: u32 = 40;
/// Directions for each of [`Tolerance::max_iterations`], so that one limit serves wet and dry steps; untuned.
const DIRECTIONS: usize = 25;

/// What is solved.
pub struct DryProblem<'a> {
    /// Grid.
    pub grid: &'a Grid,
    /// Undeformed gap without H0.
    pub gap: &'a [f64],
    /// ∬P.
    pub load: f64,
    /// Tolerances: `pressure` bounds ∬|z|/load and max |r|/K00, `max_iterations` the directions, 25 to a Newton iteration;
    /// the others are not read, the load holds by construction.
    pub tolerance: Tolerance,
}

/// Workspace of the dry solver.
pub struct Dry {
    inverse: Filter<f32>,
    /// K P.
    deflection: Vec<f64>,
    in_contact: Vec<bool>,
    residual: Vec<f32>,
    residual_old: Vec<f32>,
    direction: Vec<f32>,
    image: Vec<f32>,
    z: Vec<f32>,
    edge: Edge,
    /// P_H; infinite: elastic.
    hardness: f64,
    /// P and K P before a step between two bounds.
    before: [Vec<f64>; 2],
}

/// Sums over the contact set.
#[derive(Default)]
struct ContactSums {
    area: f64,
    gap: f64,
}

impl Dry {
    /// Makes all memory for `grid`; `elastic` gives the symbol that the preconditioner inverts.
    pub fn new(grid: &Grid, elastic: &Elastic) -> Self {
        let n = grid.len();
        let padding = match elastic.edge() {
            Edge::Free => Padding::Pinned,
            Edge::Periodic => Padding::Periodic,
        };
        let mut inverse = Filter::new(grid, padding, 1);
        inverse.set_symbol(0, |kx, ky| {
            let symbol = elastic.symbol_on_domain(kx, ky).abs();
            if symbol > 0.0 { 1.0 / symbol } else { 0.0 }
        });
        Self {
            inverse,
            deflection: vec![0.0; n],
            in_contact: vec![false; n],
            residual: vec![0.0; n],
            residual_old: vec![0.0; n],
            direction: vec![0.0; n],
            image: vec![0.0; n],
            z: vec![0.0; n],
            edge: elastic.edge(),
            hardness: f64::INFINITY,
            before: [Vec::new(), Vec::new()],
        }
    }

    /// Transforms made so far by the preconditioner.
    pub fn transforms(&self) -> u64 {
        self.inverse.transforms()
    }

    /// Solves from the pressure given, which is the warm start; leaves P, H and H0. H is below zero where the body yields.
    ///
    /// `film_error` of the report is the greatest gap or overlap on the contact set, max |r|/K00.
    /// `linear_iterations` of the report counts directions (a deflection in single precision and a
    /// preconditioning each), `iterations` those of them that began a new search, `evaluations` the
    /// deflections in double precision.
    pub fn solve(
        &mut self,
        elastic: &mut Elastic,
        problem: &DryProblem,
        iterate: &mut Iterate,
    ) -> NewtonReport {
        let grid = problem.grid;
        let mut report = NewtonReport::nothing();
        self.begin(problem, iterate);
        self.refresh(elastic, iterate.p, &mut report);
        let (mut directions, mut since, mut fresh_search) = (0, 0, true);
        loop {
            fresh_search |= self.update_contact_set(problem, iterate);
            self.precondition(grid);
            self.turn_from_bounds(grid, iterate.p);
            report.change = self.size_of_step(grid) / problem.load;
            report.left = report.change;
            if !report.change.is_finite() {
                report.verdict = Verdict::NotFinite;
                break;
            }
            let worst;
            (report.worst_node, worst) = self.worst();
            report.film_error = worst / elastic.k00;
            let allowed = problem.tolerance.pressure;
            let small = report.change <= allowed && worst <= allowed * elastic.k00;
            if small && since == 0 {
                report.verdict = Verdict::Converged;
                break;
            }
            if directions >= DIRECTIONS * problem.tolerance.max_iterations {
                break;
            }
            if small || since >= REFRESH {
                self.bring_back(problem, iterate.p);
                self.refresh(elastic, iterate.p, &mut report);
                since = 0;
                continue;
            }
            directions += 1;
            report.linear_iterations += 1;
            report.iterations += u32::from(fresh_search);
            since += 1;
            self.turn(grid, fresh_search);
            let mut tau = self.line(elastic, grid);
            if !tau.is_finite() {
                // As many directions as the contact set has freedoms leave nothing to turn to.
                self.turn(grid, true);
                tau = self.line(elastic, grid);
            }
            fresh_search = self.walk_down(elastic, problem, iterate, tau, &mut report);
            if fresh_search {
                since = 0;
            }
        }
        self.finish(problem, iterate, &mut report);
        report
    }

    /// Nodes whose pressure is unknown, row by row.
    fn rows(&self, grid: &Grid) -> std::ops::Range<usize> {
        match self.edge {
            Edge::Free => grid.interior_rows(),
            Edge::Periodic => 0..grid.ny - 1,
        }
    }

    fn columns(&self, grid: &Grid) -> std::ops::Range<usize> {
        match self.edge {
            Edge::Free => 1..grid.nx - 1,
            Edge::Periodic => 0..grid.nx - 1,
        }
    }

    /// A pressure of the right load, zero where it must be; uniform where nothing is known.
    fn begin(&self, problem: &DryProblem, iterate: &mut Iterate) {
        let grid = problem.grid;
        let columns = self.columns(grid);
        let rows = self.rows(grid);
        for (j, row) in iterate.p.chunks_exact_mut(grid.nx).enumerate() {
            for (i, p) in row.iter_mut().enumerate() {
                let known = p.is_finite() && rows.contains(&j) && columns.contains(&i);
                *p = if known { p.max(0.0) } else { 0.0 };
            }
        }
        let mut load = self.total(grid, iterate.p);
        if load <= 0.0 {
            for j in rows {
                iterate.p[j * grid.nx..][columns.clone()].fill(1.0);
            }
            load = self.total(grid, iterate.p);
        }
        let scale = problem.load / load;
        iterate.p.iter_mut().for_each(|p| *p *= scale);
        self.bring_back(problem, iterate.p);
    }

    fn total(&self, grid: &Grid, p: &[f64]) -> f64 {
        let columns = self.columns(grid);
        self.rows(grid)
            .map(|j| p[j * grid.nx..][columns.clone()].iter().sum::<f64>() * grid.weight(j))
            .sum()
    }

    /// K P in double precision.
    fn refresh(&mut self, elastic: &mut Elastic, p: &[f64], report: &mut NewtonReport) {
        elastic.deflect(p, &mut self.deflection);
        report.evaluations += 1;
    }

    /// H0, contact set and residual; whether the set has changed.
    fn update_contact_set(&mut self, problem: &DryProblem, iterate: &mut Iterate) -> bool {
        let grid = problem.grid;
        let hardness = self.hardness;
        // H0 from the loaded nodes, then again with those that overlap.
        let first = self.level(problem, |n, _| {
            iterate.p[n] > 0.0 && iterate.p[n] < hardness
        });
        let first = first.unwrap_or_else(|| -self.least_pressed(problem, iterate.p));
        let mut changed = false;
        let (rows, columns) = (self.rows(grid), self.columns(grid));
        for n in rows.flat_map(|j| columns.clone().map(move |i| j * grid.nx + i)) {
            let film = problem.gap[n] + self.deflection[n] + first;
            let inside = if iterate.p[n] < hardness {
                iterate.p[n] > 0.0 || film < 0.0
            } else {
                film > 0.0
            };
            changed |= inside != self.in_contact[n];
            self.in_contact[n] = inside;
        }
        let of_set = self.level(problem, |_, inside| inside);
        *iterate.h0 = of_set.unwrap_or(first);
        std::mem::swap(&mut self.residual, &mut self.residual_old);
        for (n, r) in self.residual.iter_mut().enumerate() {
            *r = if self.in_contact[n] {
                (*iterate.h0 + problem.gap[n] + self.deflection[n]) as f32
            } else {
                0.0
            };
        }
        changed
    }

    /// H0 that closes the mean gap of the nodes asked for; `None`: there are none.
    fn level(&self, problem: &DryProblem, counts: impl Fn(usize, bool) -> bool) -> Option<f64> {
        let grid = problem.grid;
        let columns = self.columns(grid);
        let mut sums = ContactSums::default();
        for j in self.rows(grid) {
            let mut row = ContactSums::default();
            for n in columns.clone().map(|i| j * grid.nx + i) {
                if counts(n, self.in_contact[n]) {
                    row.area += 1.0;
                    row.gap += problem.gap[n] + self.deflection[n];
                }
            }
            sums.area += row.area * grid.weight(j);
            sums.gap += row.gap * grid.weight(j);
        }
        (sums.area > 0.0).then(|| -sums.gap / sums.area)
    }

    /// z = Π M⁻¹ r.
    fn precondition(&mut self, grid: &Grid) {
        self.inverse.apply(&self.residual, &mut self.z);
        self.take_mean_off(grid);
    }

    fn take_mean_off(&mut self, grid: &Grid) {
        let (mut mean, mut area) = (0.0, 0.0);
        for j in self.rows(grid) {
            let range = j * grid.nx..(j + 1) * grid.nx;
            let (mut sum, mut count) = (0.0, 0.0);
            for (&z, &inside) in self.z[range.clone()].iter().zip(&self.in_contact[range]) {
                if inside {
                    sum += f64::from(z);
                    count += 1.0;
                }
            }
            mean += sum * grid.weight(j);
            area += count * grid.weight(j);
        }
        let mean = if area > 0.0 {
            (mean / area) as f32
        } else {
            0.0
        };
        for (z, &inside) in self.z.iter_mut().zip(&self.in_contact) {
            *z = if inside { *z - mean } else { 0.0 };
        }
    }

    /// ∬|z|.
    fn size_of_step(&self, grid: &Grid) -> f64 {
        grid.integrate(|n| f64::from(self.z[n].abs()))
    }

    /// The node where contact or complementarity is missed most, and by how much film.
    fn worst(&self) -> (usize, f64) {
        let mut worst = (0, 0.0_f32);
        for (n, r) in self.residual.iter().enumerate() {
            if r.abs() > worst.1 {
                worst = (n, r.abs());
            }
        }
        (worst.0, f64::from(worst.1))
    }

    /// The film and the load error.
    fn finish(&self, problem: &DryProblem, iterate: &mut Iterate, report: &mut NewtonReport) {
        for ((h, &g), &u) in iterate.h.iter_mut().zip(problem.gap).zip(&self.deflection) {
            *h = *iterate.h0 + g + u;
        }
        let load = self.total(problem.grid, iterate.p);
        report.load_error = (load / problem.load - 1.0).abs();
    }
}
