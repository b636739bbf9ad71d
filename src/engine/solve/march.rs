//! A contact that marches in time on one grid: what it is ([`ContactState`]) and what solves its steps ([`Solver`]).
//!
//! ```text
//! attempt   trial ← solution of (state, conditions)       the state is read, nothing of it changes
//! commit    state ← trial                                 after the caller has seen the verdict
//! ```
//! The state is all that a restart needs. The solver can be made again between any two steps: what an attempt gives is
//! a function of the state, the gap and the conditions, not of what was evaluated before (`tests/records/restart.rs`).
//!
//! Ours: no equation, but who owns what.

mod dry_steps;
mod solver;

use serde::{Deserialize, Serialize};

pub use solver::Solver;

use super::history::History;
use super::newton::{NewtonReport, Tolerance};
use super::reynolds::Medium;
use super::traction::TractionLaw;
use crate::math::grid::Grid;
use crate::saved::saved;
use crate::scene::Order;

/// What a restart needs: the last committed step and its past.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct ContactState {
    /// P, shape ny × nx.
    pub pressure: Vec<f64>,
    /// H.
    pub film: Vec<f64>,
    /// H0.
    pub h0: f64,
    /// u^s, the deflection by traction, where the next step's begins (`tangential.rs`). Empty: the bodies are alike.
    pub sheared: Vec<f64>,
    /// Past masses and pressures.
    pub history: History,
}

saved! {
    ContactState { parts: pressure, film, sheared, history; free: h0; }
    holds |_, saved| saved.pressure.iter().all(|p| *p >= 0.0)
}

impl ContactState {
    /// Nothing yet on `len` nodes; `unlike`: with deflection by traction.
    pub fn empty(len: usize, unlike: bool) -> Self {
        let field = vec![0.0; len];
        Self {
            history: History::steady(&field, &field, 0.0),
            pressure: field.clone(),
            sheared: if unlike { field.clone() } else { Vec::new() },
            film: field,
            h0: 0.0,
        }
    }

    /// The same contact on `fine`, a grid with twice the intervals of `coarse`.
    #[must_use]
    pub fn refined(&self, coarse: &Grid, fine: &Grid) -> Self {
        let on_fine = |from: &[f64]| prolong(coarse, from, fine);
        let pressure = on_fine(&self.pressure);
        let mass = on_fine(&self.history.mass_1);
        Self {
            film: on_fine(&self.film),
            h0: self.h0,
            sheared: if self.sheared.is_empty() {
                Vec::new()
            } else {
                on_fine(&self.sheared)
            },
            history: History::steady(&mass, &pressure, self.h0),
            pressure,
        }
    }
}

/// Where a step's first guess comes from.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Guess<'a> {
    /// Extrapolated along characteristics.
    Extrapolated,
    /// The last committed pressure.
    Last,
    /// This pressure and H0.
    Given(&'a [f64], f64),
    /// What the last attempt of this step has found.
    Tried,
}

/// Constants of a contact.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Shape {
    /// κ.
    pub kappa: f64,
    /// Rx/Ry.
    pub curvature_y: f64,
    /// Ellipse half-width along y over that along x.
    pub b_over_a: f64,
    /// κ_s of the deflection by traction; 0: the bodies are alike.
    pub kappa_s: f64,
    /// Order of the discretisation.
    pub order: Order,
}

impl Shape {
    /// A circular contact of like bodies, of second order: κ = 2 p_h R/(π E' a) with p_h = E' a/(π R).
    pub const CIRCLE: Self = Self {
        kappa: 2.0 / (std::f64::consts::PI * std::f64::consts::PI),
        curvature_y: 1.0,
        b_over_a: 1.0,
        kappa_s: 0.0,
        order: Order::Second,
    };
}

/// What a step is solved under.
#[derive(Debug, Clone, Copy)]
pub struct Conditions<'a> {
    /// Fluid.
    pub medium: &'a Medium,
    /// Traction law (bodies of different materials only).
    pub law: Option<&'a TractionLaw>,
    /// By how much ln η̄ of warm oil is shifted where it is sheared; empty: it is cold.
    pub shift: &'a [f64],
    /// ∬P.
    pub load: f64,
    /// Tolerances.
    pub tolerance: Tolerance,
}

/// Whether the contact is lubricated, and how the film ruptures.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Flow {
    /// A film that counts as full where it has ruptured (Reynolds' condition).
    Film,
    /// A film that keeps its mass where it has ruptured (Jakobsson-Floberg-Olsson): there the equation
    /// leaves F ≥ 0 and `θ ρ̄H = ρ̄H − F` is the oil that is really there.
    MassConserving,
    /// Dry: the film equation is H ≥ 0.
    Dry,
}

/// A state with its own solver, for contacts without a simulation around them.
pub struct March {
    /// State.
    pub state: ContactState,
    /// Solver.
    pub solver: Solver,
}

impl March {
    /// A Hertz contact with film `h_central` on `grid`; `nodes` is the usual step; `flow` whether there
    /// is a film at all.
    pub fn from_hertz(grid: Grid, shape: &Shape, h_central: f64, nodes: f64, flow: Flow) -> Self {
        let mut solver = Solver::new(grid, shape, nodes, flow);
        Self {
            state: solver.hertz(shape, h_central),
            solver,
        }
    }

    /// The state of a coarser march with half the intervals, interpolated to twice as many.
    pub fn refined(coarse: &Self, grid: Grid, shape: &Shape, nodes: f64, flow: Flow) -> Self {
        Self {
            state: coarse.state.refined(&coarse.solver.grid, &grid),
            solver: Solver::new(grid, shape, nodes, flow),
        }
    }

    /// [`Solver::attempt`].
    pub fn attempt(&mut self, conditions: &Conditions, nodes: f64, guess: Guess) -> NewtonReport {
        self.solver.attempt(&self.state, conditions, nodes, guess)
    }

    /// [`Solver::attempt_safely`].
    pub fn attempt_safely(&mut self, conditions: &Conditions, nodes: f64) -> NewtonReport {
        self.solver.attempt_safely(&self.state, conditions, nodes)
    }

    /// [`Solver::commit`].
    pub fn commit(&mut self, nodes: f64) {
        self.solver.commit(&mut self.state, nodes);
    }
}

/// Bilinear interpolation to a grid with twice the intervals on the same rectangle.
fn prolong(coarse: &Grid, from: &[f64], fine: &Grid) -> Vec<f64> {
    let mut to = vec![0.0; fine.len()];
    for j in 0..fine.ny {
        let (j0, j1) = (j / 2, j.div_ceil(2));
        for i in 0..fine.nx {
            let (i0, i1) = (i / 2, i.div_ceil(2));
            let at = |j: usize, i: usize| from[j * coarse.nx + i];
            to[j * fine.nx + i] = 0.25 * (at(j0, i0) + at(j0, i1) + at(j1, i0) + at(j1, i1));
        }
    }
    to
}
