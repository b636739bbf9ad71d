//! What can go wrong in the loop, with its numbers.

use std::fmt;

use serde::{Deserialize, Serialize};
use thiserror::Error;

/// What a step leaves of its equations, and what it may leave.
#[derive(Debug, Clone, Copy, PartialEq, Default, Serialize, Deserialize)]
pub struct Unsolved {
    /// Estimate of the pressure's error, Σ|P − P*|/ΣP.
    pub residual: f64,
    /// What it may be.
    pub residual_asked: f64,
    /// Σ|F|/Σρ̄H; dry: the greatest gap or overlap of touching nodes, over the film that p_h on one node makes.
    pub film_error: f64,
    /// What it may be.
    pub film_error_asked: f64,
    /// Whether there was no flow.
    pub dry: bool,
}

impl fmt::Display for Unsolved {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Self {
            residual,
            residual_asked,
            film_error,
            film_error_asked,
            dry,
        } = self;
        write!(f, "residual {residual:.2e} (asked {residual_asked:.1e}), ")?;
        if *dry {
            write!(
                f,
                "gaps or overlaps of up to {film_error:.2e} (asked {film_error_asked:.1e}) of the film that p_h on one \
                 node makes where the bodies touch"
            )
        } else {
            write!(
                f,
                "{film_error:.2e} of the film unbalanced (asked {film_error_asked:.1e})"
            )
        }
    }
}

/// A step that failed.
#[derive(Debug, Clone, Error)]
pub enum StepError {
    /// The step did not converge even after smaller retries.
    #[error(
        "step at t = {t_s:.4e} s stalled after {retries} retries: {unsolved}, worst at x = {x_m:.3e} m, y = {y_m:.3e} m"
    )]
    Stalled {
        /// Simulated time, s.
        t_s: f64,
        /// What is left, and what was asked.
        unsolved: Unsolved,
        /// Retries made.
        retries: u32,
        /// Where the residual is greatest, m.
        x_m: f64,
        /// Where the residual is greatest, m.
        y_m: f64,
    },
    /// A value that is no number appeared; the step was not committed.
    #[error("step at t = {t_s:.4e} s produced a value that is not finite; nothing of it was kept")]
    NotFinite {
        /// Simulated time, s.
        t_s: f64,
    },
}

/// A simulation that could not be made or started.
#[derive(Debug, Clone, Error)]
pub enum SimError {
    /// The thread pool could not be built.
    #[error("could not start {threads} worker threads: {reason}")]
    Threads {
        /// Threads asked for.
        threads: usize,
        /// What the system said.
        reason: String,
    },
    /// A knob was set to a value outside of its range.
    #[error("{key} = {value} is out of range: {allowed}")]
    Knob {
        /// Scene key of the knob.
        key: &'static str,
        /// Value asked for.
        value: f64,
        /// What is allowed.
        allowed: String,
    },
    /// The stress engine refused the plan.
    #[error("{0}")]
    Stress(String),
    /// A saved state does not belong to this scene.
    #[error("the saved state does not fit: {0}")]
    State(String),
    /// The smooth start-up failed.
    #[error("the start-up failed: {0}")]
    StartUp(#[from] StepError),
}
