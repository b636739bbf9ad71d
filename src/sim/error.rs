//! What can go wrong in the loop, with its numbers.

use thiserror::Error;

/// A step that failed.
#[derive(Debug, Clone, Error)]
pub enum StepError {
    /// The step did not converge even after smaller retries.
    #[error(
        "step at t = {t_s:.4e} s stalled after {retries} retries: the last iteration changed the pressure by {residual:.2e} (asked {tolerance:.1e}) and left {film_error:.2e} of the film unbalanced, worst at x = {x_m:.3e} m, y = {y_m:.3e} m"
    )]
    Stalled {
        /// Simulated time, s.
        t_s: f64,
        /// Σ|dP|/ΣP of the last iteration.
        residual: f64,
        /// The change asked for.
        tolerance: f64,
        /// Σ|F|/Σρ̄H that is left.
        film_error: f64,
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
