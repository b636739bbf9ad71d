//! The smooth, frictionless contact at S = 0 beside a run whose knobs have left the load or the speed of its reference.
//!
//! ```text
//! knobs' targets ≠ load, speed of the reference  ──>  Hertz there, on 65²  ──>  steady  ──>  next grid  ──> ... ──>
//! its integrals are the reference of now; one step of it a step of the run
//! ```
//! It is the start-up's own path to the reference (`start_up.rs`), at the load and speed that the knobs go to: what a run
//! that begins there has, on this run's grid. A run whose load and speed stay as they are makes none of these steps. Until
//! it is done the last reference grows as Hertz contacts do (`reference.rs`), which is 0.7 % of the integral off between
//! 800 and 2376 N of the default scene, but 4 % for five times its speed, whose film is no small part of the contact any
//! more (129²; `asperity run demonstration` with smooth bodies, S = 0 and `load.force_n` or `motion.entrainment_m_s` set).
//! Knobs that turn all the time (a ride along a gear tooth) have the reference of where they were going when it began.

use serde::{Deserialize, Serialize};

use super::drive::Drive;
use super::motion::Travel;
use crate::solve::march::ContactState;

/// Load (N, of a line N/m) and entrainment speed (m/s).
#[derive(Debug, Clone, Copy, PartialEq, Default, Serialize, Deserialize)]
pub(super) struct LoadAndSpeed {
    pub(super) load: f64,
    pub(super) speed_m_s: f64,
}

/// A smooth contact on its way to the steady state: what is saved.
#[derive(Debug, Clone, Serialize, Deserialize)]
pub(super) struct Smooth {
    /// Nodes per side of its grid.
    pub(super) nodes: usize,
    pub(super) contact: ContactState,
    pub(super) drive: Drive,
    pub(super) motion: Travel,
    pub(super) at: LoadAndSpeed,
    /// Steps to go on this grid.
    pub(super) left: u64,
}
