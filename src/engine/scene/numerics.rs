//! Time steps and tolerances: `[time]`, `[numerics]`.

use serde::{Deserialize, Serialize};

use crate::closed_set;

/// `[time]`
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields, default)]
pub struct Time {
    /// Time step in nodes travelled at the entrainment speed: U dt/dx.
    pub step_nodes: f64,
    /// Length of the run after the start-up, in lengths of 4 a travelled at U; left out: until the life has settled, where it
    /// can ([`crate::plan::Plan::until_settled`]), [`Time::MOST_PASSAGES`] at most.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub passages: Option<f64>,
    /// Relative error of the film that time stepping may add over one crossing of the contact; left out:
    /// fixed steps.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub tolerance: Option<f64>,
}

impl Default for Time {
    fn default() -> Self {
        Self {
            step_nodes: 1.0,
            passages: None,
            tolerance: None,
        }
    }
}

impl Time {
    /// Passages of a run that does not say how many.
    pub const MOST_PASSAGES: f64 = 2.0;

    /// Most passages that a run makes.
    pub fn most_passages(&self) -> f64 {
        self.passages.unwrap_or(Self::MOST_PASSAGES)
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
    /// Order of the discretisation where the solution is smooth.
    pub order: OrderAsked,
    /// Where a headless run's estimate of its discretisation error comes from.
    pub error_estimate: ErrorSource,
    /// Whether a run climbs a ladder of meshes up to `grid.nodes`; else it is made on that mesh alone.
    pub ladder: bool,
}

closed_set! {
    /// Order of the discretisation that a scene asks for.
    pub enum OrderAsked {
        /// [`Order::Second`].
        Second = "second",
        /// [`Order::High`].
        High = "high",
        /// High as long as the mesh carries the smooth film.
        ByMesh = "by_mesh",
    }
}

impl OrderAsked {
    /// The order on a mesh that carries the smooth film, or does not.
    pub fn order(self, is_carried: bool) -> Order {
        match self {
            Self::High => Order::High,
            Self::ByMesh if is_carried => Order::High,
            Self::Second | Self::ByMesh => Order::Second,
        }
    }
}

impl From<Order> for OrderAsked {
    fn from(order: Order) -> Self {
        match order {
            Order::Second => Self::Second,
            Order::High => Self::High,
        }
    }
}

/// Order of the discretisation of film and flow where they are smooth.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Order {
    /// Two in space and time.
    Second,
    /// Three in time and of the deflection, four of the flow.
    High,
}

closed_set! {
    /// Where the estimate of the discretisation error comes from.
    pub enum ErrorSource {
        /// A run on half the nodes each way: that of the ladder, or a second one.
        Companion = "companion",
        /// No estimate.
        None = "none",
    }
}

impl Default for Numerics {
    fn default() -> Self {
        Self {
            tolerance: 1.0e-3,
            max_iterations: 20,
            order: OrderAsked::Second,
            error_estimate: ErrorSource::Companion,
            ladder: true,
        }
    }
}
