//! A contact that marches in time on one grid: pressure, film, approach, history, workspace.
//!
//! One attempt of a step: predict, convect, solve; nothing is committed until the caller has seen the
//! verdict. `State` is what a restart needs; everything else can be made again.

mod dry_steps;

use serde::{Deserialize, Serialize};

use super::dry::Dry;
use super::film::macroscopic_gap;
use super::history::History;
use super::newton::{CARRIED, Iterate, Newton, NewtonReport, OVERLAP, Problem, Tolerance};
use super::reynolds::Medium;
use super::tangential::{Shear, Tangential};
use super::traction::TractionLaw;
use crate::math::grid::Grid;

/// What a restart needs.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct State {
    /// P, shape ny × nx.
    pub pressure: Vec<f64>,
    /// H.
    pub film: Vec<f64>,
    /// H0.
    pub h0: f64,
    /// Past masses and pressures.
    pub history: History,
}

impl State {
    /// Whether every field has `len` nodes.
    pub fn fits(&self, len: usize) -> bool {
        let Self {
            pressure,
            film,
            h0: _,
            history,
        } = self;
        pressure.len() == len && film.len() == len && history.fits(len)
    }
}

/// Where a step's first guess comes from.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Guess {
    /// Extrapolated along characteristics.
    Extrapolated,
    /// The last committed pressure.
    Last,
}

/// A contact on one grid.
pub struct March {
    /// Grid.
    pub grid: Grid,
    /// State.
    pub state: State,
    /// X²/2 + c_y Y²/2.
    pub macroscopic: Vec<f64>,
    /// Undeformed gap of the next step.
    pub gap: Vec<f64>,
    /// Solver.
    pub newton: Newton,
    /// Solver of dry contacts: a knob may take the film away.
    pub dry: Dry,
    c_star: Vec<f64>,
    s: Vec<f64>,
    mass: Vec<f64>,
    /// Film against which the last attempt judged its errors where there is less.
    least_film: f64,
    /// What the next attempt solves, and the next commit stores.
    pub flow: Flow,
    kappa: f64,
    /// The step that the preconditioner is made for.
    usual_nodes: f64,
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
}

/// What a step is solved under.
#[derive(Debug, Clone, Copy)]
pub struct Conditions<'a> {
    /// Fluid.
    pub medium: &'a Medium,
    /// Traction law (bodies of different materials only).
    pub law: Option<&'a TractionLaw>,
    /// ∬P.
    pub load: f64,
    /// Tolerances.
    pub tolerance: Tolerance,
}

impl March {
    /// A Hertz contact with film `h_central` on `grid`; `nodes` is the usual step; `flow` whether there
    /// is a film at all.
    pub fn from_hertz(grid: Grid, shape: &Shape, h_central: f64, nodes: f64, flow: Flow) -> Self {
        Self::from_hertz_of_size(grid, shape, (1.0, h_central), nodes, flow)
    }

    /// The same where half-widths and pressure are `size` times the units.
    pub fn from_hertz_of_size(
        grid: Grid,
        shape: &Shape,
        (size, h_central): (f64, f64),
        nodes: f64,
        flow: Flow,
    ) -> Self {
        let mut this = Self::empty(grid, shape, nodes, flow);
        let grid = &this.grid;
        let pressure = &mut this.state.pressure;
        for j in grid.interior_rows() {
            let y = grid.y(j) / shape.b_over_a;
            for i in 1..grid.nx - 1 {
                let r2 = grid.x(i).powi(2) + y * y;
                pressure[j * grid.nx + i] = (size * size - r2).max(0.0).sqrt();
            }
        }
        let film = &mut this.state.film;
        this.newton.elastic.deflect(pressure, film);
        let mut lowest = f64::INFINITY;
        for n in 0..grid.len() {
            film[n] += this.macroscopic[n];
            if pressure[n] > 0.0 {
                lowest = lowest.min(film[n]);
            }
        }
        let centre = grid.axis_row() * grid.nx + ((-grid.x_min / grid.dx).round() as usize);
        this.state.h0 = h_central - film[centre];
        for h in film.iter_mut() {
            *h = (*h + this.state.h0).max(0.5 * h_central);
        }
        this.state.history = History::steady(film, pressure, this.state.h0);
        this
    }

    /// The state of a coarser march with half the intervals, interpolated to twice as many.
    pub fn refined(coarse: &Self, grid: Grid, shape: &Shape, nodes: f64, flow: Flow) -> Self {
        let mut this = Self::empty(grid, shape, nodes, flow);
        prolong(
            &coarse.grid,
            &coarse.state.pressure,
            &this.grid,
            &mut this.state.pressure,
        );
        prolong(
            &coarse.grid,
            &coarse.state.film,
            &this.grid,
            &mut this.state.film,
        );
        let mut mass = vec![0.0; this.grid.len()];
        prolong(
            &coarse.grid,
            &coarse.state.history.mass_1,
            &this.grid,
            &mut mass,
        );
        this.state.h0 = coarse.state.h0;
        this.state.history = History::steady(&mass, &this.state.pressure, this.state.h0);
        this
    }

    fn empty(grid: Grid, shape: &Shape, nodes: f64, flow: Flow) -> Self {
        let n = grid.len();
        let mut newton = Newton::new(&grid, shape.kappa, 2.0 / 3.0 * nodes * grid.dx);
        if shape.kappa_s != 0.0 {
            let tangential = Tangential::new(&grid, shape.kappa_s);
            newton.shear = Some(Shear::new(&grid, tangential));
        }
        let mut macroscopic = vec![0.0; n];
        macroscopic_gap(&grid, shape.curvature_y, &mut macroscopic);
        let zero = vec![0.0; n];
        let dry = Dry::new(&grid, &newton.elastic);
        Self {
            dry,
            state: State {
                pressure: zero.clone(),
                film: zero.clone(),
                h0: 0.0,
                history: History::steady(&zero, &zero, 0.0),
            },
            gap: macroscopic.clone(),
            macroscopic,
            newton,
            c_star: zero.clone(),
            s: zero.clone(),
            mass: zero,
            least_film: 0.0,
            flow,
            kappa: shape.kappa,
            usual_nodes: nodes,
            grid,
        }
    }

    /// Tries a step of `nodes` nodes against `gap`; nothing is committed.
    pub fn attempt(&mut self, conditions: &Conditions, nodes: f64, guess: Guess) -> NewtonReport {
        let history = &self.state.history;
        if self.flow != Flow::Dry {
            history.convect(&self.grid, nodes, &mut self.c_star, &mut self.s);
        }
        match guess {
            Guess::Extrapolated => {
                history.predict(&self.grid, nodes, &mut self.state.pressure);
                self.state.h0 = history.h0[0];
            }
            Guess::Last => {
                self.state.pressure.copy_from_slice(&history.pressure_1);
                self.state.h0 = history.h0[0];
            }
        }
        if self.flow == Flow::Dry {
            return self.attempt_dry(conditions);
        }
        self.least_film = conditions.tolerance.least_film;
        let problem = Problem {
            grid: &self.grid,
            medium: conditions.medium,
            law: conditions.law,
            gap: &self.gap,
            c_star: &self.c_star,
            s: &self.s,
            load: conditions.load,
            tolerance: conditions.tolerance,
        };
        self.newton.solve(
            &problem,
            &mut Iterate {
                p: &mut self.state.pressure,
                h: &mut self.state.film,
                h0: &mut self.state.h0,
            },
        )
    }

    /// A last try of a step of `nodes` nodes, with everything on the safe side: backward Euler, whose C* is
    /// never extrapolated; the last pressure as first guess; the preconditioner's symbols made for this very
    /// step, not for the usual one; three times the iterations.
    pub fn attempt_safely(&mut self, conditions: &Conditions, nodes: f64) -> NewtonReport {
        let dx = self.grid.dx;
        self.set_symbols(nodes * dx);
        let last_nodes = std::mem::replace(&mut self.state.history.last_nodes, 0.0);
        let mut patient = *conditions;
        patient.tolerance.max_iterations *= 3;
        let report = self.attempt(&patient, nodes, Guess::Last);
        self.state.history.last_nodes = last_nodes;
        self.set_symbols(2.0 / 3.0 * self.usual_nodes * dx);
        report
    }

    /// Makes the preconditioner for an effective step `s`.
    fn set_symbols(&mut self, s: f64) {
        let Newton {
            elastic,
            precondition,
            ..
        } = &mut self.newton;
        precondition.set_symbols(&self.grid, elastic, self.kappa, s);
    }

    /// Error that steps like the one attempted last add to the film over a crossing ([`History::path_error`]);
    /// `None`: not known yet, or there is no film.
    pub fn path_error(&mut self, nodes: f64) -> Option<f64> {
        if self.flow == Flow::Dry {
            return None;
        }
        self.gather_mass();
        let State {
            pressure, history, ..
        } = &self.state;
        history.path_error(&self.grid, (&self.mass, pressure), nodes)
    }

    /// Where the surfaces of the last attempt overlap beyond the tolerance at an edge of the domain, which has no
    /// equation: the node and the overlap. There the contact is cut off.
    pub fn overlap_at_edge(&self, least_film: f64) -> Option<(usize, f64)> {
        let (grid, film) = (&self.grid, &self.state.film);
        let rows = grid.interior_rows();
        let deepest = (0..grid.ny)
            .flat_map(|j| {
                let whole = !rows.contains(&j);
                let stride = if whole { 1 } else { grid.nx - 1 };
                (0..grid.nx).step_by(stride).map(move |i| (j, i))
            })
            .map(|(j, i)| j * grid.nx + i)
            .min_by(|&one, &two| film[one].total_cmp(&film[two]))?;
        (film[deepest] < -OVERLAP * least_film).then_some((deepest, -film[deepest]))
    }

    /// Commits the step that was attempted last.
    pub fn commit(&mut self, nodes: f64) {
        if self.flow == Flow::Dry {
            let State {
                film,
                history,
                pressure,
                h0,
            } = &mut self.state;
            return history.commit(film, pressure, *h0, nodes);
        }
        self.gather_mass();
        self.state
            .history
            .commit(&self.mass, &self.state.pressure, self.state.h0, nodes);
    }

    /// ρ̄H of the last attempt.
    fn gather_mass(&mut self) {
        for (n, mass) in self.mass.iter_mut().enumerate() {
            let full = self.newton.reynolds.rho(n) * self.state.film[n];
            let left = self.newton.reynolds.residual[n];
            let missing = if self.state.pressure[n] > 0.0 {
                // The unbalanced rest of a converged step is mass that the next one must find again.
                let most = CARRIED * full.max(self.least_film);
                left.clamp(-most, most)
            } else if self.flow == Flow::MassConserving {
                left.max(0.0)
            } else {
                0.0
            };
            *mass = (full - missing).max(0.0);
        }
    }
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

/// Bilinear interpolation to a grid with twice the intervals on the same rectangle.
fn prolong(coarse: &Grid, from: &[f64], fine: &Grid, to: &mut [f64]) {
    for j in 0..fine.ny {
        let (j0, j1) = (j / 2, j.div_ceil(2));
        for i in 0..fine.nx {
            let (i0, i1) = (i / 2, i.div_ceil(2));
            let at = |j: usize, i: usize| from[j * coarse.nx + i];
            to[j * fine.nx + i] = 0.25 * (at(j0, i0) + at(j0, i1) + at(j1, i0) + at(j1, i1));
        }
    }
}
