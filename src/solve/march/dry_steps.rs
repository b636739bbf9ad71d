//! Steps without flow: of a dry contact, and the first guess where films all but close.

use super::super::dry::DryProblem;
use super::super::newton::{Iterate, NewtonReport, Tolerance, Verdict};
use super::{Conditions, March};

impl March {
    /// Whether films of some times the least one carry most of the load.
    pub(super) fn is_nearly_closed(&self, conditions: &Conditions) -> bool {
        /// In least films.
        const THIN: f64 = 10.0;
        let history = &self.state.history;
        let thin = THIN * conditions.tolerance.least_film;
        let (p, mass) = (&history.pressure_1, &history.mass_1);
        let load = self.grid.integrate(|n| p[n]);
        let carried = self
            .grid
            .integrate(|n| if mass[n] < thin { p[n] } else { 0.0 });
        carried > 0.5 * load
    }

    /// The step without flow, `ρ̄H − C* ≥ 0, P ≥ 0`: a dry contact whose gap is filled by the oil that is
    /// there. Where films all but close flow is slight, and this finds which nodes touch; Newton, which
    /// would close a film by a third at a time (a conductance like H³ has a triple root), adds the flow.
    pub(super) fn guess_without_flow(&mut self, conditions: &Conditions) {
        /// A guess needs no more: Newton's own tolerance.
        const ROUGHLY: f64 = 1e-3;
        /// Least films below which a node takes this guess: where there is more oil it flows, and the guess
        /// of pressures that travel is the better one.
        const CLOSED: f64 = 30.0;
        let gap = &mut self.filled;
        for (n, gap) in gap.iter_mut().enumerate() {
            let (rho, _) = conditions.medium.density.rho(self.state.pressure[n]);
            *gap = self.gap[n] - self.c_star[n] / rho;
        }
        self.mass.copy_from_slice(&self.state.pressure);
        let tolerance = Tolerance {
            pressure: ROUGHLY,
            ..conditions.tolerance
        };
        let Some(dry) = &mut self.dry else { return };
        dry.solve(
            &mut self.newton.elastic,
            &DryProblem {
                grid: &self.grid,
                gap,
                load: conditions.load,
                tolerance,
            },
            &mut Iterate {
                p: &mut self.state.pressure,
                h: &mut self.state.film,
                h0: &mut self.state.h0,
            },
        );
        let thin = CLOSED * conditions.tolerance.least_film;
        for n in 0..self.grid.len() {
            if self.state.history.mass_1[n] >= thin {
                self.state.pressure[n] = self.mass[n];
            }
        }
    }

    /// A dry step. Deflection by traction (unlike bodies) is at most βμ, some per cent, of that by
    /// pressure: it is taken from the last pressure and solved again until nothing moves.
    pub(super) fn attempt_dry(&mut self, conditions: &Conditions) -> NewtonReport {
        /// Solutions at most; each gains a factor of about βμ ≤ 0.1.
        const PASSES: usize = 12;
        let mut whole = NewtonReport::nothing();
        let Some(dry) = &mut self.dry else {
            return whole;
        };
        let newton = &mut self.newton;
        // Without a film nothing is convected: C* is free to hold the gap.
        let gap = &mut self.c_star;
        for pass in 0..PASSES {
            gap.copy_from_slice(&self.gap);
            let shear = newton.shear.as_mut().zip(conditions.law);
            let is_coupled = shear.is_some();
            if let Some((shear, law)) = shear {
                shear.add_to_dry(law, &self.state.pressure, gap);
            }
            let report = dry.solve(
                &mut newton.elastic,
                &DryProblem {
                    grid: &self.grid,
                    gap,
                    load: conditions.load,
                    tolerance: conditions.tolerance,
                },
                &mut Iterate {
                    p: &mut self.state.pressure,
                    h: &mut self.state.film,
                    h0: &mut self.state.h0,
                },
            );
            whole.add(&report);
            let settled = !is_coupled || (pass > 0 && report.iterations == 0);
            if settled || report.verdict != Verdict::Converged {
                return whole;
            }
        }
        whole.verdict = Verdict::Stalled;
        whole
    }
}
