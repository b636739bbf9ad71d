//! Steps without flow: of a dry contact.
//!
//! Part of `dry.rs`. Ours: the fixed point of the deflection by traction.

use super::super::dry::DryProblem;
use super::super::newton::{Iterate, NewtonReport, Verdict};
use super::{Conditions, Solver};

impl Solver {
    /// A dry step. Deflection by traction (unlike bodies) is at most βμ of that by pressure, some per cent, with any
    /// friction and any materials a half: it is taken from the last pressure and solved again until nothing moves.
    pub(super) fn attempt_dry(&mut self, conditions: &Conditions) -> NewtonReport {
        /// Solutions at most; each gains a factor of about βμ ≤ 1/2, and 2⁻⁴⁰ is less than any tolerance asks for.
        const PASSES: usize = 40;
        let mut whole = NewtonReport::nothing();
        let (dry, newton, trial) = (&mut self.dry, &mut self.newton, &mut self.trial);
        let gap = &mut self.c_star;
        let yielding = &mut newton.yielding;
        for pass in 0..=PASSES {
            gap.copy_from_slice(&self.gap);
            let shear = newton.shear.as_mut().zip(conditions.law);
            let is_coupled = shear.is_some();
            if let Some((shear, law)) = shear {
                shear.add_to_dry(law, &trial.pressure, gap);
            }
            let mut tolerance = conditions.tolerance;
            if pass == PASSES {
                // Only the convergence test: what the last solution leaves under its own traction.
                tolerance.max_iterations = 0;
            }
            let report = dry.solve(
                &mut newton.elastic,
                &DryProblem {
                    grid: &self.grid,
                    gap,
                    load: conditions.load,
                    tolerance,
                },
                &mut Iterate {
                    p: &mut trial.pressure,
                    h: &mut trial.film,
                    h0: &mut trial.h0,
                },
            );
            whole.add(&report);
            let settled = !is_coupled || (pass > 0 && report.iterations == 0);
            if settled || report.verdict != Verdict::Converged {
                break;
            }
        }
        if let Some(yielding) = yielding {
            yielding.take_overlap(&trial.pressure, &mut trial.film);
        }
        whole
    }
}
