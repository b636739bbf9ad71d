//! How the deflection by traction follows the iterate (`tangential.rs`).
//!
//! Part of `newton.rs`.

use super::super::converge::left_of;
use super::sums::Evaluation;
use super::{Iterate, Newton, NewtonReport, Problem};

impl Newton {
    /// A step begins with all of the deflection that the traction of its first guess makes, unless this keeps the last one's.
    pub(super) fn begin_traction(&mut self, problem: &Problem, iterate: &mut Iterate) {
        if let Some((shear, sheared)) = self.shear.as_mut().zip(problem.sheared)
            && !sheared.keeps
        {
            shear.aim(&sheared, iterate.p, iterate.h, problem.tolerance.least_film);
            shear.follow(iterate.h);
            self.balance(problem, iterate);
        }
    }

    /// Lets the deflection by traction follow pressure and film once these are solved with the one that is held, unless what
    /// it lacks is a small part of the film; the evaluation of what then is.
    pub(super) fn follow_traction(
        &mut self,
        problem: &Problem,
        iterate: &mut Iterate,
        (held, base): (Evaluation, f64),
        report: &mut NewtonReport,
    ) -> Evaluation {
        let Some((shear, sheared)) = self.shear.as_mut().zip(problem.sheared) else {
            return held;
        };
        let tolerance = &problem.tolerance;
        let mut new = held;
        new.note(problem, report);
        // Dry, the pressure alone makes the traction, and nothing keeps it from following at once.
        let flows = problem.medium.lambda.is_finite();
        if flows && !Self::is_converged(tolerance, report) {
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
}
