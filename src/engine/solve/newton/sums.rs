//! What an evaluation of the iterate amounts to: merit, errors, and where it is worst.
//!
//! Part of `converge.rs`.

use rayon::prelude::*;

use super::super::converge::{Sums, sum_row};
use super::{Iterate, Newton, NewtonReport, Problem};
use crate::math::grid::Grid;

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
    /// Tells its errors.
    pub(super) fn note(&self, problem: &Problem, report: &mut NewtonReport) {
        // Dry: there is no flow whose mass could be lost.
        (report.film_error, report.mass_error) = if problem.medium.lambda.is_finite() {
            (self.film_error, self.mass_error)
        } else {
            (0.0, 0.0)
        };
        report.load_error = (self.load / problem.load - 1.0).abs();
        report.overlap = self.overlap;
    }
}

impl Newton {
    /// [`Self::sums`] with the D of this evaluation.
    pub(super) fn sums_anew(&mut self, problem: &Problem, iterate: &Iterate) -> Evaluation {
        self.reference.copy_from_slice(&self.reynolds.diagonal);
        self.sums(problem, iterate)
    }

    /// Sums of the evaluation; the merit uses the frozen D in `reference`.
    pub(super) fn sums(&mut self, problem: &Problem, iterate: &Iterate) -> Evaluation {
        let (grid, nx) = (problem.grid, problem.grid.nx);
        let interior = grid.interior_rows();
        let (reynolds, reference) = (&self.reynolds, &self.reference);
        let (p, h): (&[f64], &[f64]) = (iterate.p, iterate.h);
        let rows = self.rows.par_iter_mut().enumerate().with_min_len(8);
        rows.filter(|(j, _)| interior.contains(j))
            .for_each(|(j, row)| {
                // The boundary has no equation; whether surfaces overlap there is asked by `march.rs`.
                let here = j * nx + 1..(j + 1) * nx - 1;
                *row = sum_row(
                    &reynolds.residual[here.clone()],
                    &p[here.clone()],
                    &reference[here.clone()],
                    &reynolds.densities()[here.clone()],
                    &h[here],
                    problem.tolerance.least_film,
                );
            });
        let mut total = Sums::default();
        let (mut worst_row, mut largest) = (0, 0.0);
        for j in grid.interior_rows() {
            let row = &self.rows[j];
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

    /// Node of the largest |φ|.
    pub(super) fn worst_node(&self, grid: &Grid, p: &[f64], row: usize) -> usize {
        let phi = |n: usize| {
            p[n].min(self.reynolds.residual[n] / self.reference[n])
                .abs()
        };
        let nodes = row * grid.nx + 1..(row + 1) * grid.nx - 1;
        nodes
            .max_by(|&a, &b| phi(a).total_cmp(&phi(b)))
            .unwrap_or_default()
    }
}
