//! Time steps and tolerances: `[time]`, `[numerics]`.

use serde::{Deserialize, Serialize};

/// `[time]`
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields, default)]
pub struct Time {
    /// Time step in nodes travelled at the entrainment speed: U dt/dx.
    pub step_nodes: f64,
    /// Length of the run after the start-up, in lengths of 4 a travelled at U.
    pub passages: f64,
    /// Relative error of the film that time stepping may add over one crossing of the contact; left out:
    /// fixed steps.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub tolerance: Option<f64>,
}

impl Default for Time {
    fn default() -> Self {
        Self {
            step_nodes: 1.0,
            passages: 2.0,
            tolerance: None,
        }
    }
}

/// `[numerics]`
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields, default)]
pub struct Numerics {
    /// Relative change of pressure at which a time step counts as converged.
    pub tolerance: f64,
    /// Most Newton iterations of one step.
    pub max_iterations: usize,
    /// Where a headless run's estimate of its discretisation error comes from.
    pub error_estimate: ErrorSource,
}

/// Where the estimate of the discretisation error comes from.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum ErrorSource {
    /// A second run on half the nodes each way.
    Companion,
    /// No estimate.
    None,
}

impl Default for Numerics {
    fn default() -> Self {
        Self {
            tolerance: 1.0e-3,
            max_iterations: 20,
            error_estimate: ErrorSource::Companion,
        }
    }
}
