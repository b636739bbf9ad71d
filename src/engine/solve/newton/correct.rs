//! Part of `newton.rs`: what the flow of second order lacks (`reynolds/deferred.rs`), laid into the right-hand side of a step.

use super::{Iterate, Newton, Problem};
use crate::scene::Order;
use crate::solve::reynolds::Guessed;

impl Newton {
    /// Lays what the flow of second order lacks, at the first guess, into C* for the whole step.
    pub(super) fn correct(&mut self, problem: &Problem, iterate: &Iterate) {
        // Dry: nothing flows.
        if self.order == Order::Second || problem.medium.lambda.is_infinite() {
            return;
        }
        let at = Guessed {
            p: iterate.p,
            h: iterate.h,
            c_star: problem.c_star,
            s: problem.s,
        };
        self.reynolds
            .correct(problem.grid, &at, &mut self.corrected);
    }
}
