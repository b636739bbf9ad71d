//! Work counters: integers that are the same on any machine, so that a change of algorithm shows.

use serde::{Deserialize, Serialize};

use super::stepping::Attempted;

/// How much work a run has done so far.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Serialize, Deserialize)]
#[serde(default)]
pub struct Stats {
    /// Time steps, the start-up's included.
    pub steps: u64,
    /// Newton iterations.
    pub newton_iterations: u64,
    /// Linear (Krylov) iterations.
    pub linear_iterations: u64,
    /// Real two-dimensional transforms of the contact's solver, forward and back counted singly where they are made:
    /// deflection by pressure (padded; in double precision of residuals, in single precision of Krylov iterations) and by
    /// traction, preconditioners (not padded). Those of the stress are not among them; they follow from the steps and
    /// from [`Stats::stress_volumes`].
    pub ffts: u64,
    /// Steps that were tried again with safer settings.
    pub retries: u64,
    /// Volume integrals of the stress.
    pub stress_volumes: u64,
    /// Steps that were halved.
    pub halved: u64,
    /// Parts of steps that needed the safe settings.
    pub safer: u64,
    /// Converged steps that were made again for their error in time.
    pub rejected: u64,
}

impl Stats {
    /// Adds up the work of a step, for which so many transforms were made.
    pub(super) fn add(&mut self, step: &Attempted, transforms: u64) {
        self.newton_iterations += u64::from(step.newton);
        self.linear_iterations += u64::from(step.linear);
        self.ffts += transforms;
        self.retries += u64::from(step.retries);
        self.halved += u64::from(step.halvings > 0);
        self.safer += u64::from(step.safer);
        self.rejected += u64::from(step.rejected);
    }

    /// Every counter.
    pub(super) fn all(&self) -> [u64; 9] {
        let Self {
            steps,
            newton_iterations,
            linear_iterations,
            ffts,
            retries,
            stress_volumes,
            halved,
            safer,
            rejected,
        } = *self;
        [
            steps,
            newton_iterations,
            linear_iterations,
            ffts,
            retries,
            stress_volumes,
            halved,
            safer,
            rejected,
        ]
    }
}
