//! When a step is solved, and what is left of its equations.
//!
//! ```text
//! natural residual  φ = min(P, F/D)          merit = Σ φ² dA
//! pressure error    Σ|dP|/ΣP . 3 ρ/(1 − ρ),  ρ² = merit after over merit before the iteration
//! film error        Σ|F| / Σ max(ρ̄H, h_least)         over pressurised nodes
//! mass error        Σ (|F| − carried·max(ρ̄H, h_least))⁺ / Σ max(ρ̄H, h_least)
//! ```
//! `h_least` is the film below which oil is no continuum: thinner films are not resolved to a share of
//! themselves. Means over the contact leave single nodes free, so none may overlap by more than a share of
//! `h_least` ([`OVERLAP`]). Sums run by rows in fixed order.
//!
//! Sources: Facchinei and Pang (2003), *Finite-Dimensional Variational Inequalities and Complementarity Problems*, §1.5, for
//! the natural residual; Eisenstat and Walker (1996), SIAM J. Sci. Comput. 17, 16-32, choice 2, for the forcing. Ours: what is left after a
//! step that shrank the residual by ρ is the geometric sum ρ/(1 − ρ) of the step; 3 is its safety against steps solved to
//! 1e-6 (`tests/engine/converged_step.rs`).

use rayon::prelude::*;

use crate::math::grid::Grid;

/// Part of a node's film that a step may leave unbalanced as carry-over to the next one. Of steps that leave
/// more, the excess is lost: a loose step whose whole residual is carried over blows up near dry.
pub const CARRIED: f64 = 0.1;

/// Least films that the bodies may overlap by at a node; small beside the film that the bodies are
/// said to touch at, untuned.
pub const OVERLAP: f64 = 0.05;

/// Times that the deflection by traction may use a solution's iterations in one step; a safeguard, untuned.
const FOLLOWED: usize = 4;

/// When to stop.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Tolerance {
    /// Estimate of Σ|P − P*|/ΣP.
    pub pressure: f64,
    /// Film error.
    pub film: f64,
    /// Mass error.
    pub mass: f64,
    /// Film below which both errors are taken of it, not of the film that is there.
    pub least_film: f64,
    /// Load error.
    pub load: f64,
    /// Most Newton iterations.
    pub max_iterations: usize,
}

/// How the iteration ended.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Verdict {
    /// All tolerances hold.
    Converged,
    /// The iterations ran out.
    Stalled,
    /// A value was not finite.
    NotFinite,
}

/// What one step took and reached.
#[derive(Debug, Clone, Copy)]
pub struct NewtonReport {
    /// How it ended.
    pub verdict: Verdict,
    /// Newton iterations.
    pub iterations: u32,
    /// Newton iterations when the deflection by traction last followed (`tangential.rs`).
    pub followed_at: u32,
    /// Krylov iterations.
    pub linear_iterations: u32,
    /// Residual evaluations (one deflection in double precision each).
    pub evaluations: u32,
    /// Last Σ|dP|/ΣP.
    pub change: f64,
    /// Estimate of what is left, Σ|P − P*|/ΣP.
    pub left: f64,
    /// Σ|F| over Σ ρ̄H, pressurised nodes.
    pub film_error: f64,
    /// The part of it that the next step does not take over.
    pub mass_error: f64,
    /// |ΣP − load|/load.
    pub load_error: f64,
    /// Deepest overlap max(−H), 0 where the bodies are apart everywhere.
    pub overlap: f64,
    /// Node of the largest |φ|.
    pub worst_node: usize,
}

impl NewtonReport {
    /// Nothing done yet.
    pub(super) fn nothing() -> Self {
        Self {
            verdict: Verdict::Stalled,
            iterations: 0,
            followed_at: 0,
            linear_iterations: 0,
            evaluations: 0,
            change: f64::INFINITY,
            left: f64::INFINITY,
            film_error: 0.0,
            mass_error: 0.0,
            load_error: 0.0,
            overlap: 0.0,
            worst_node: 0,
        }
    }

    /// Whether the contact with the u^s that is held has had its `most` iterations, or all of them together [`FOLLOWED`]
    /// times as many.
    pub(super) fn is_out_of_work(&self, most: usize) -> bool {
        let since = self.iterations - self.followed_at;
        since as usize >= most || self.iterations as usize >= FOLLOWED * most
    }

    /// Takes what a further solution reached and adds what it took.
    pub(super) fn add(&mut self, further: &Self) {
        let before = *self;
        *self = *further;
        self.iterations += before.iterations;
        self.linear_iterations += before.linear_iterations;
        self.evaluations += before.evaluations;
    }
}

/// Estimate of the pressure's error after an iteration that changed it by `change` and the merit by the factor
/// `reduction`.
pub(super) fn left_of(change: f64, reduction: f64) -> f64 {
    let ratio = reduction.sqrt();
    if ratio < 1.0 {
        change * (3.0 * ratio / (1.0 - ratio)).min(1.0)
    } else {
        change
    }
}

/// Reduction asked of the first linear solve of a step; 0.3 and 0.03 were tried and are the same work (guide, numerics).
pub(super) const FIRST_FORCING: f64 = 0.1;

/// Reduction asked of the next linear solve where the last iteration changed the merit by the factor `reduction`:
/// looser after a poor step, which the next one will not follow far. Near dry that saves a tenth of the Krylov
/// iterations against 0.1 throughout. Down to 0.05 after good steps saves 7 % of the Newton iterations of mixed steps
/// at 129² and costs 14 % more Krylov iterations at 257²: the same time. Source: Eisenstat and Walker (1996), choice 2, but for that.
pub(super) fn forcing_after(reduction: f64) -> f64 {
    const TIGHTEST: f64 = FIRST_FORCING;
    // 0.3 was tried throughout and is the same work; untuned between.
    const LOOSEST: f64 = 0.2;
    reduction.clamp(TIGHTEST, LOOSEST)
}

/// Sums over the nodes of a row, or of the grid by area.
#[derive(Debug, Clone, Copy, Default)]
pub(super) struct Sums {
    /// φ².
    pub(super) merit: f64,
    /// |F|, pressurised nodes.
    pub(super) film: f64,
    /// |F| beyond what is carried, pressurised nodes.
    pub(super) lost: f64,
    /// ρ̄H, pressurised nodes.
    pub(super) mass: f64,
    /// P.
    pub(super) load: f64,
    /// Largest |φ|.
    pub(super) largest: f64,
    /// Largest −H.
    pub(super) overlap: f64,
}

impl Sums {
    fn add(&mut self, row: &Self, weight: f64) {
        self.merit += weight * row.merit;
        self.film += weight * row.film;
        self.lost += weight * row.lost;
        self.mass += weight * row.mass;
        self.load += weight * row.load;
        self.overlap = self.overlap.max(row.overlap);
    }
}

/// Sums of an evaluation.
pub(super) struct Evaluation {
    pub(super) merit: f64,
    /// Merit over that before the iteration.
    pub(super) reduction: f64,
    pub(super) film_error: f64,
    pub(super) mass_error: f64,
    pub(super) load: f64,
    pub(super) overlap: f64,
    pub(super) worst_row: usize,
    pub(super) finite: bool,
}

impl Evaluation {
    /// Tells its errors to a report of a contact under `load`; dry there is no flow whose mass could be lost.
    pub(super) fn note(&self, load: f64, flows: bool, report: &mut NewtonReport) {
        (report.film_error, report.mass_error) = if flows {
            (self.film_error, self.mass_error)
        } else {
            (0.0, 0.0)
        };
        report.load_error = (self.load / load - 1.0).abs();
        report.overlap = self.overlap;
    }
}

/// What an iterate is judged by, shape ny × nx.
pub(super) struct Judged<'a> {
    /// P.
    pub(super) p: &'a [f64],
    /// H.
    pub(super) h: &'a [f64],
    /// F.
    pub(super) residual: &'a [f64],
    /// D of the merit.
    pub(super) reference: &'a [f64],
    /// ρ̄.
    pub(super) rho: &'a [f64],
}

impl Judged<'_> {
    /// Sums over the grid; `rows` is scratch, one a row.
    pub(super) fn sum(&self, grid: &Grid, least_film: f64, rows: &mut [Sums]) -> Evaluation {
        let (nx, interior) = (grid.nx, grid.interior_rows());
        let each = rows.par_iter_mut().enumerate().with_min_len(8);
        each.filter(|(j, _)| interior.contains(j))
            .for_each(|(j, row)| {
                // The boundary has no equation; whether surfaces overlap there is asked by `march.rs`.
                let here = j * nx + 1..(j + 1) * nx - 1;
                *row = sum_row(
                    &self.residual[here.clone()],
                    &self.p[here.clone()],
                    &self.reference[here.clone()],
                    &self.rho[here.clone()],
                    &self.h[here],
                    least_film,
                );
            });
        let mut total = Sums::default();
        let (mut worst_row, mut largest) = (0, 0.0);
        for j in grid.interior_rows() {
            let row = &rows[j];
            if row.largest > largest {
                (worst_row, largest) = (j, row.largest);
            }
            total.add(row, grid.weight(j));
        }
        let mass = total.mass.max(f64::MIN_POSITIVE);
        Evaluation {
            merit: total.merit,
            reduction: 1.0,
            film_error: total.film / mass,
            mass_error: total.lost / mass,
            load: total.load,
            overlap: total.overlap,
            worst_row,
            finite: total.merit.is_finite() && total.load.is_finite(),
        }
    }

    /// Node of the largest |φ| in a row.
    pub(super) fn worst_node(&self, grid: &Grid, row: usize) -> usize {
        let phi = |n: usize| self.p[n].min(self.residual[n] / self.reference[n]).abs();
        let nodes = row * grid.nx + 1..(row + 1) * grid.nx - 1;
        nodes
            .max_by(|&a, &b| phi(a).total_cmp(&phi(b)))
            .unwrap_or_default()
    }
}

/// Values side by side in the sums of a row.
const LANES: usize = 8;

dispatched! {
/// Sums over the inner nodes of one row.
fn sum_row(
    f: &[f64],
    p: &[f64],
    reference: &[f64],
    rho: &[f64],
    h: &[f64],
    least_film: f64,
) -> Sums {
    let mut lanes = [[0.0_f64; LANES]; 7];
    let n = f.len();
    let (p, reference, rho, h) = (&p[..n], &reference[..n], &rho[..n], &h[..n]);
    let mut take = |i: usize, k: usize| {
        let phi = p[i].min(f[i] / reference[i]);
        let pressed = if p[i] > 0.0 { 1.0 } else { 0.0 };
        let (left, full) = (f[i].abs(), (rho[i] * h[i]).max(least_film));
        lanes[0][k] += phi * phi;
        lanes[1][k] += pressed * left;
        lanes[2][k] += pressed * (left - CARRIED * full).max(0.0);
        lanes[3][k] += pressed * full;
        lanes[4][k] += p[i];
        lanes[5][k] = if phi.abs() > lanes[5][k] { phi.abs() } else { lanes[5][k] };
        lanes[6][k] = if -h[i] > lanes[6][k] { -h[i] } else { lanes[6][k] };
    };
    let blocks = n / LANES;
    for b in 0..blocks {
        for k in 0..LANES {
            take(b * LANES + k, k);
        }
    }
    for i in blocks * LANES..n {
        take(i, 0);
    }
    let sum = |lane: &[f64; LANES]| lane.iter().sum::<f64>();
    Sums {
        merit: sum(&lanes[0]),
        film: sum(&lanes[1]),
        lost: sum(&lanes[2]),
        mass: sum(&lanes[3]),
        load: sum(&lanes[4]),
        largest: lanes[5].iter().copied().fold(0.0, f64::max),
        overlap: lanes[6].iter().copied().fold(0.0, f64::max),
    }
}
}
