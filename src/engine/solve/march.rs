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
use crate::math::grid::{Grid, Symmetry};
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
        let past = &self.history;
        Self {
            pressure: on_fine(&self.pressure),
            film: on_fine(&self.film),
            h0: self.h0,
            sheared: if self.sheared.is_empty() {
                Vec::new()
            } else {
                on_fine(&self.sheared)
            },
            history: History {
                mass_1: on_fine(&past.mass_1),
                mass_2: on_fine(&past.mass_2),
                mass_3: on_fine(&past.mass_3),
                pressure_1: on_fine(&past.pressure_1),
                pressure_2: on_fine(&past.pressure_2),
                pressure_slow: on_fine(&past.pressure_slow),
                h0: past.h0,
                last_nodes: 2.0 * past.last_nodes,
                earlier_nodes: 2.0 * past.earlier_nodes,
            },
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

/// Interpolation to a grid with twice the intervals on the same rectangle, along x, then along y: amid two nodes
///
/// ```text
/// (a + b)/2 + (a' − b')/8          a', b' = slopes per interval, |a'| ≤ 4 |a|
/// ```
/// which is Lagrange's cubic through four nodes wherever no slope is held; those that are keep what was positive so. Fields that
/// are zero at the edge keep their sum.
fn prolong(coarse: &Grid, from: &[f64], fine: &Grid) -> Vec<f64> {
    let mut to = vec![0.0; fine.len()];
    for (j, from) in from.chunks_exact(coarse.nx).enumerate() {
        let start = 2 * j * fine.nx;
        for (i, &value) in from.iter().enumerate() {
            to[start + 2 * i] = value;
        }
        fill_amid(&mut to, (start, 1), coarse.nx, false);
    }
    let is_mirrored = coarse.symmetry == Symmetry::MirrorY;
    for i in 0..fine.nx {
        fill_amid(&mut to, (i, fine.nx), coarse.ny, is_mirrored);
    }
    to
}

/// Fills what lies amid `nodes` known values, the first at `start` and each two strides from the one before.
fn fill_amid(to: &mut [f64], (start, stride): (usize, usize), nodes: usize, starts_mirrored: bool) {
    let mut before = 0.0;
    for k in 0..nodes {
        let at = |k: usize| to[start + 2 * k * stride];
        let (below, above) = (k.max(1) - 1, (k + 1).min(nodes - 1));
        let most = 4.0 * at(k).abs();
        let slope = (at(above) - at(below)) / (above - below).max(1) as f64;
        let mut slope = slope.max(-most).min(most);
        if k == 0 && starts_mirrored {
            slope = 0.0;
        }
        if k > 0 {
            let amid = 0.5 * (at(k - 1) + at(k)) + 0.125 * (before - slope);
            to[start + (2 * k - 1) * stride] = amid;
        }
        before = slope;
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn filled(grid: &Grid, of: impl Fn(f64, f64) -> f64) -> Vec<f64> {
        let at = |n: usize| of(grid.x(n % grid.nx), grid.y(n / grid.nx));
        (0..grid.len()).map(at).collect()
    }

    #[test]
    fn cubics_are_prolonged_exactly_and_what_is_carried_stays() {
        for symmetry in [Symmetry::MirrorY, Symmetry::General, Symmetry::Line] {
            let [coarse, fine] = [17, 33].map(|n| Grid::new(n, -2.0, 1.5, 1.6, symmetry));
            let cubic = |x: f64, y: f64| 40.0 + x * x * x - 2.0 * x + (1.0 + x) * y * y;
            let (found, exact) = (
                prolong(&coarse, &filled(&coarse, cubic), &fine),
                filled(&fine, cubic),
            );
            let amid = |n: usize| {
                let (i, j) = (n % fine.nx, n / fine.nx);
                let rows = match symmetry {
                    Symmetry::MirrorY => 0..=fine.ny - 3,
                    Symmetry::General => 2..=fine.ny - 3,
                    Symmetry::Line => 0..=0,
                };
                (2..=fine.nx - 3).contains(&i) && rows.contains(&j)
            };
            for n in (0..fine.len()).filter(|n| amid(*n)) {
                assert!((found[n] - exact[n]).abs() < 1e-12, "{symmetry:?} {n}");
            }
            let bump = |x: f64, y: f64| (1.0 - (x / 1.3).powi(2) - (y / 1.4).powi(2)).max(0.0);
            let (lower, higher) = (filled(&coarse, bump), {
                let lower = filled(&coarse, bump);
                prolong(&coarse, &lower, &fine)
            });
            assert!(higher.iter().all(|p| *p >= 0.0));
            let loads =
                [(&coarse, &lower), (&fine, &higher)].map(|(grid, p)| grid.integrate(|n| p[n]));
            println!("{symmetry:?}: load {:.6} and {:.6}", loads[0], loads[1]);
            assert!((loads[1] / loads[0] - 1.0).abs() < 1e-12);
        }
    }
}
