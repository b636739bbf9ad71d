//! One time step: semi-smooth Newton on pressure, film and load together.
//!
//! ```text
//! unknowns  P ≥ 0 (nodes), H0
//! active    where P − F/D > 0;  elsewhere v = −P, carried into the right-hand side
//! solve     J v + b h0 = −F/D on the active nodes,  wᵀ(P + v) = load          (krylov.rs)
//! update    P ← max(P + t v, 0), H0 ← H0 + t h0,  t halved until the natural residual falls
//! natural residual  φ = min(P, F/D): zero exactly at the solution
//! ```
//! Where the softer body yields, P is bounded from above too, and nodes at that bound have their film for unknown
//! (`yielding.rs`).
//! Converged when the error that is left in the pressure (estimated, `converge.rs`), the film error
//! Σ|F|/Σρ̄H over the pressurised nodes, the mass error and the load error are below their tolerances. What is left of F up to
//! [`CARRIED`] of the film is not lost: the next step takes it over (`march.rs`), so the mass error counts
//! only what lies beyond. Not converging is a verdict, never a panic; nothing is committed by this file.
//!
//! Source: Hintermüller, Ito and Kunisch (2002), SIAM J. Optim. 13, 865-888: the active set as a semi-smooth Newton method.
//! Ours: the border of the load, the film as unknown at the upper bound, what is carried over.

use rayon::prelude::*;

pub use super::converge::{CARRIED, NewtonReport, OVERLAP, Tolerance, Verdict};
use super::converge::{Evaluation, FIRST_FORCING, Judged, Sums, forcing_after, left_of};
use super::film::Elastic;
use super::jacobian::Jacobian;
use super::krylov::Krylov;
use super::newton_rows::{film_row, move_pressure, set_rhs, split_row};
use super::precondition::Preconditioner;
use super::reynolds::{Guessed, Lacking, Linearisation, Medium, Reynolds};
use super::tangential::Shear;
pub use super::tangential::Sheared;
use super::yielding::Yielding;
use crate::math::grid::Grid;
use crate::scene::Order;

/// Most halvings of the line search; untuned.
const MAX_HALVINGS: u32 = 4;

/// What a step is solved against.
pub struct Problem<'a> {
    /// Grid.
    pub grid: &'a Grid,
    /// Fluid.
    pub medium: &'a Medium,
    /// What shears bodies of different materials; `None`: they are alike.
    pub sheared: Option<Sheared<'a>>,
    /// Undeformed gap without H0: macroscopic minus roughness.
    pub gap: &'a [f64],
    /// C*.
    pub c_star: &'a [f64],
    /// s.
    pub s: &'a [f64],
    /// ∬P.
    pub load: f64,
    /// Tolerances.
    pub tolerance: Tolerance,
}

impl Problem<'_> {
    /// Whether oil flows; dry, the film equation is H ≥ 0.
    fn flows(&self) -> bool {
        self.medium.lambda.is_finite()
    }
}

/// The iterate: pressure, film and approach.
pub struct Iterate<'a> {
    /// P.
    pub p: &'a mut [f64],
    /// H.
    pub h: &'a mut [f64],
    /// H0.
    pub h0: &'a mut f64,
}

/// Workspace of the step.
pub struct Newton {
    /// Deflection.
    pub elastic: Elastic,
    /// Residual and properties of the last evaluation.
    pub reynolds: Reynolds,
    /// Preconditioner.
    pub precondition: Preconditioner,
    /// Deflection by traction; `None`: the bodies are alike.
    pub shear: Option<Shear>,
    /// What the softer body yields; `None`: both are elastic.
    pub yielding: Option<Yielding>,
    jacobian: Jacobian,
    krylov: Krylov,
    active: Vec<bool>,
    deflection: Vec<f64>,
    /// Order of the flow.
    pub order: Order,
    /// C* with what the flow of second order lacks.
    corrected: Vec<f64>,
    /// What the flow of second order lacks.
    lacking: Lacking,
    reference: Vec<f64>,
    old_p: Vec<f64>,
    v: Vec<f32>,
    fixed: Vec<f32>,
    fixed_deflection: Vec<f32>,
    rhs: Vec<f32>,
    scratch: Vec<f32>,
    rows: Vec<Sums>,
}

impl Newton {
    /// Second order: see [`Newton::of_order`].
    pub fn new(grid: &Grid, kappa: f64, s: f64) -> Self {
        Self::of_order(grid, kappa, s, Order::Second)
    }

    /// Makes all buffers; `s` is the usual effective step, for the preconditioner's symbols.
    pub fn of_order(grid: &Grid, kappa: f64, s: f64, order: Order) -> Self {
        let n = grid.len();
        let elastic = Elastic::of_order(grid, kappa, order);
        let precondition = Preconditioner::new(grid, &elastic, kappa, s);
        Self {
            elastic,
            reynolds: Reynolds::new(grid),
            precondition,
            shear: None,
            yielding: None,
            jacobian: Jacobian::new(grid),
            krylov: Krylov::new(grid),
            active: vec![false; n],
            deflection: vec![0.0; n],
            order,
            corrected: vec![0.0; n],
            lacking: Lacking::new(n),
            reference: vec![1.0; n],
            old_p: vec![0.0; n],
            v: vec![0.0; n],
            fixed: vec![0.0; n],
            fixed_deflection: vec![0.0; n],
            rhs: vec![0.0; n],
            scratch: vec![0.0; n],
            rows: vec![Sums::default(); grid.ny],
        }
    }

    /// No pressure above `hardness` from now on; infinite: elastic.
    pub fn yield_at(&mut self, hardness: f64) {
        let len = self.active.len();
        if hardness.is_finite() {
            self.krylov.make_room(len);
            let yielding = &mut self.yielding;
            let yielding = yielding.get_or_insert_with(|| Yielding::new(len, hardness));
            yielding.hardness = hardness;
        } else {
            self.yielding = None;
        }
    }

    /// Transforms made so far.
    pub fn transforms(&self) -> u64 {
        let shear = self.shear.as_ref().map_or(0, Shear::transforms);
        self.elastic.transforms() + self.precondition.transforms() + shear
    }

    /// Solves one time step from the iterate given.
    pub fn solve(&mut self, problem: &Problem, iterate: &mut Iterate) -> NewtonReport {
        let mut report = NewtonReport::nothing();
        if let (Some(shear), Some(sheared)) = (&mut self.shear, problem.sheared) {
            shear.begin(sheared.deflection);
        }
        if let Some(yielding) = &mut self.yielding {
            yielding.begin(iterate.p);
        }
        self.corrected.copy_from_slice(problem.c_star);
        self.evaluate(problem, iterate, &mut report);
        self.correct(problem, iterate);
        self.begin_traction(problem, iterate);
        let mut now = self.sums_anew(problem, iterate);
        let mut forcing = FIRST_FORCING;
        loop {
            now.note(problem.load, problem.flows(), &mut report);
            report.worst_node = self.judged(iterate).worst_node(problem.grid, now.worst_row);
            if !now.finite {
                report.verdict = Verdict::NotFinite;
                return report;
            }
            if Self::is_converged(&problem.tolerance, &report) {
                report.verdict = Verdict::Converged;
                return report;
            }
            if report.is_out_of_work(problem.tolerance.max_iterations) {
                return report;
            }
            report.iterations += 1;
            let h0_step = self.linear_step(problem, iterate, now.load, forcing, &mut report);
            now = self.line_search(problem, iterate, h0_step, &mut report);
            forcing = forcing_after(now.reduction);
        }
    }

    /// Lays what the flow of second order lacks, at the first guess, into C* for the whole step.
    fn correct(&mut self, problem: &Problem, iterate: &Iterate) {
        if self.order == Order::Second || !problem.flows() {
            return;
        }
        let at = Guessed {
            p: iterate.p,
            h: iterate.h,
            c_star: problem.c_star,
            s: problem.s,
        };
        let (flow, c_star) = (&mut self.reynolds, &mut self.corrected);
        self.lacking.correct(flow, problem.grid, &at, c_star);
    }

    /// A step begins with all of the deflection that the traction of its first guess makes, unless this keeps the last one's.
    fn begin_traction(&mut self, problem: &Problem, iterate: &mut Iterate) {
        if let Some((shear, sheared)) = self.shear.as_mut().zip(problem.sheared)
            && !sheared.keeps
        {
            shear.aim(&sheared, iterate.p, iterate.h, problem.tolerance.least_film);
            shear.follow(iterate.h);
            self.balance(problem, iterate);
        }
    }

    fn is_converged(tolerance: &Tolerance, report: &NewtonReport) -> bool {
        report.left <= tolerance.pressure
            && report.film_error <= tolerance.film
            && report.mass_error <= tolerance.mass
            && report.load_error <= tolerance.load
            && report.overlap <= OVERLAP * tolerance.least_film
    }

    /// Film, properties, F and D of the iterate.
    fn evaluate(&mut self, problem: &Problem, iterate: &mut Iterate, report: &mut NewtonReport) {
        let grid = problem.grid;
        report.evaluations += 1;
        self.elastic.deflect(iterate.p, &mut self.deflection);
        let (h0, nx) = (*iterate.h0, grid.nx);
        iterate
            .h
            .par_chunks_mut(nx)
            .zip(problem.gap.par_chunks(nx))
            .zip(self.deflection.par_chunks(nx))
            .with_min_len(8)
            .for_each(|((h, gap), u)| film_row(h0, gap, u, h));
        if let Some(shear) = &self.shear {
            shear.add_to(iterate.h);
        }
        if let Some(yielding) = &mut self.yielding {
            yielding.add_to(iterate.p, iterate.h);
        }
        self.balance(problem, iterate);
    }

    /// Properties, F and D of pressure and film.
    fn balance(&mut self, problem: &Problem, iterate: &Iterate) {
        let grid = problem.grid;
        self.reynolds
            .properties(grid, problem.medium, iterate.p, iterate.h);
        self.reynolds.residual(
            grid,
            self.elastic.k00,
            problem.medium.lambda,
            iterate.p,
            iterate.h,
            &self.corrected,
            problem.s,
        );
    }

    /// Film error of an iterate that has been solved, with the oil as warm as it is now.
    pub fn film_error(&mut self, problem: &Problem, iterate: &Iterate) -> f64 {
        self.balance(problem, iterate);
        self.sums(problem, iterate).film_error
    }

    /// Marks the active nodes, P − F/D > 0 (where a step has lifted the bodies apart those with pressure: an
    /// empty set carries no load), and notes v = −P of the others; whether any of them carries pressure.
    fn split(&mut self, grid: &Grid, p: &[f64]) -> bool {
        let (f, d) = (&self.reynolds.residual, &self.reynolds.diagonal);
        for j in grid.interior_rows() {
            let here = j * grid.nx + 1..(j + 1) * grid.nx - 1;
            split_row(
                &p[here.clone()],
                &f[here.clone()],
                &d[here.clone()],
                &mut self.active[here.clone()],
                &mut self.fixed[here],
            );
        }
        if !self.active.contains(&true) {
            (0..p.len()).for_each(|n| self.active[n] = p[n] > 0.0);
            self.fixed.fill(0.0);
        }
        if let Some(yielding) = &mut self.yielding {
            let k00 = self.elastic.k00;
            yielding.split(p, f, d, k00, &self.active, &mut self.fixed);
        }
        self.fixed.iter().any(|&v| v != 0.0)
    }

    /// Linearises, solves, leaves the step in `v`; returns the change of H0.
    fn linear_step(
        &mut self,
        problem: &Problem,
        iterate: &Iterate,
        load: f64,
        forcing: f64,
        report: &mut NewtonReport,
    ) -> f64 {
        let grid = problem.grid;
        let any_fixed = self.split(grid, iterate.p);
        let at = Linearisation {
            p: iterate.p,
            h: iterate.h,
            c_star: &self.corrected,
            s: problem.s,
            lambda: problem.medium.lambda,
            k00: self.elastic.k00,
            active: &self.active,
        };
        self.reynolds.linearise(grid, &at, &mut self.jacobian);
        set_rhs(
            &self.reynolds.residual,
            &self.reynolds.row_scale,
            &self.active,
            &mut self.rhs,
        );
        let mut missing = problem.load - load;
        if any_fixed {
            missing -= self.take_known(grid);
        }
        let held = self.yielding.as_ref().and_then(Yielding::held);
        if let Some(held) = held {
            self.jacobian.exchange(grid, held, self.elastic.k00);
        }
        let pressed = self
            .yielding
            .as_ref()
            .map_or(&self.active[..], Yielding::pressed);
        self.precondition.prepare(
            grid,
            &self.jacobian,
            &self.reynolds.row_scale,
            &self.reynolds.conductance,
            pressed,
            held,
            self.elastic.k00,
        );
        self.krylov
            .prepare(grid, &self.jacobian, &mut self.precondition, held);
        let linear = self.krylov.solve(
            grid,
            &mut self.elastic,
            &self.jacobian,
            &mut self.precondition,
            &self.rhs,
            missing,
            forcing,
            super::krylov::MAX_ITERATIONS,
            &mut self.v,
        );
        report.linear_iterations += linear.iterations as u32;
        if let Some(held) = held {
            clear(held, &mut self.fixed);
        }
        for (v, &fixed) in self.v.iter_mut().zip(&self.fixed) {
            *v += fixed;
        }
        linear.h0
    }

    /// Takes what known changes of pressure do off the right-hand side; gives the load that they carry.
    fn take_known(&mut self, grid: &Grid) -> f64 {
        self.elastic
            .deflect_single(&self.fixed, &mut self.fixed_deflection);
        if let Some(held) = self.yielding.as_ref().and_then(Yielding::held) {
            clear(held, &mut self.fixed_deflection);
        }
        let (fixed, deflection) = (&self.fixed, &self.fixed_deflection);
        self.jacobian
            .apply(grid, fixed, deflection, 0.0, &mut self.scratch);
        for (r, &c) in self.rhs.iter_mut().zip(&self.scratch) {
            *r -= c;
        }
        grid.integrate(|n| f64::from(self.fixed[n]))
    }

    /// Lets the deflection by traction follow pressure and film once these are solved with the one that is held, unless what
    /// it lacks is a small part of the film; the evaluation of what then is.
    fn follow_traction(
        &mut self,
        problem: &Problem,
        iterate: &mut Iterate,
        held: Evaluation,
        base: f64,
        report: &mut NewtonReport,
    ) -> Evaluation {
        let Some((shear, sheared)) = self.shear.as_mut().zip(problem.sheared) else {
            return held;
        };
        let tolerance = &problem.tolerance;
        let mut new = held;
        new.note(problem.load, problem.flows(), report);
        // Dry, the pressure alone makes the traction, and nothing keeps it from following at once.
        if problem.flows() && !Self::is_converged(tolerance, report) {
            return new;
        }
        let residual = shear.aim(&sheared, iterate.p, iterate.h, tolerance.least_film);
        report.film_error += residual;
        if Self::is_converged(tolerance, report) {
            new.film_error += residual;
            return new;
        }
        shear.set_share();
        shear.follow(iterate.h);
        report.followed_at = report.iterations;
        let lacking = shear.lacking(residual);
        self.balance(problem, iterate);
        new = self.sums(problem, iterate);
        new.film_error += lacking;
        new.reduction = new.merit / base;
        report.left = left_of(report.change, new.reduction);
        new
    }

    fn judged<'a>(&'a self, iterate: &'a Iterate) -> Judged<'a> {
        Judged {
            p: iterate.p,
            h: iterate.h,
            residual: &self.reynolds.residual,
            reference: &self.reference,
            rho: self.reynolds.densities(),
        }
    }

    /// [`Self::sums`] with the D of this evaluation.
    fn sums_anew(&mut self, problem: &Problem, iterate: &Iterate) -> Evaluation {
        self.reference.copy_from_slice(&self.reynolds.diagonal);
        self.sums(problem, iterate)
    }

    /// Sums of the evaluation; the merit uses the frozen D in `reference`.
    fn sums(&mut self, problem: &Problem, iterate: &Iterate) -> Evaluation {
        let mut rows = std::mem::take(&mut self.rows);
        let least_film = problem.tolerance.least_film;
        let sums = self
            .judged(iterate)
            .sum(problem.grid, least_film, &mut rows);
        self.rows = rows;
        sums
    }

    /// Takes the step, halved until the natural residual falls; leaves the new evaluation.
    fn line_search(
        &mut self,
        problem: &Problem,
        iterate: &mut Iterate,
        h0_step: f64,
        report: &mut NewtonReport,
    ) -> Evaluation {
        self.old_p.copy_from_slice(iterate.p);
        if let Some(yielding) = &mut self.yielding {
            yielding.accept(iterate.h);
        }
        let base = self.sums_anew(problem, iterate).merit;
        let old_h0 = *iterate.h0;
        let mut t = 1.0;
        for halving in 0..=MAX_HALVINGS {
            let (mut moved, mut total) =
                move_pressure(&self.old_p, &self.v, &self.active, t, iterate.p);
            if let Some(yielding) = &mut self.yielding {
                let k00 = self.elastic.k00;
                (moved, total) = yielding.bound(&self.old_p, &self.v, k00, t, iterate.p);
            }
            *iterate.h0 = old_h0 + t * h0_step;
            report.change = moved / total.max(f64::MIN_POSITIVE) / t;
            self.evaluate(problem, iterate, report);
            let mut new = self.sums(problem, iterate);
            new.reduction = new.merit / base;
            report.left = left_of(report.change, new.reduction);
            if new.finite && new.merit <= base || halving == MAX_HALVINGS {
                return self.follow_traction(problem, iterate, new, base, report);
            }
            t *= 0.5;
        }
        unreachable!("the last halving returns")
    }
}

/// Zero at the nodes that are held.
fn clear(held: &[bool], values: &mut [f32]) {
    for (value, &held) in values.iter_mut().zip(held) {
        *value = if held { 0.0 } else { *value };
    }
}
