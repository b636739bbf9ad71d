//! What solves the steps of a contact: grid, gap, trial, workspace of both solvers.
//!
//! Part of `march.rs`.

use super::super::dry::Dry;
use super::super::film::macroscopic_gap;
use super::super::history::{History, Past};
use super::super::newton::{CARRIED, Iterate, Newton, NewtonReport, OVERLAP, Problem, Sheared};
use super::super::tangential::{Shear, Tangential};
use super::super::yielding::Yielding;
use super::{Conditions, ContactState, Flow, Guess, Shape};
use crate::math::grid::Grid;
use crate::scene::Order;

/// A solution that nobody has committed yet.
pub(super) struct TriedState {
    pub(super) pressure: Vec<f64>,
    pub(super) film: Vec<f64>,
    pub(super) h0: f64,
}

/// Solver of a contact's steps on one grid.
pub struct Solver {
    /// Grid.
    pub grid: Grid,
    /// X²/2 + c_y Y²/2.
    pub macroscopic: Vec<f64>,
    /// Undeformed gap of the next step.
    pub gap: Vec<f64>,
    /// Solver.
    pub newton: Newton,
    /// Solver of dry contacts: a knob may take the film away.
    pub dry: Dry,
    pub(super) trial: TriedState,
    /// C*; of dry steps, which convect nothing, the gap with u^s.
    pub(super) c_star: Vec<f64>,
    s: Vec<f64>,
    mass: Vec<f64>,
    /// Film against which the last attempt took its errors relative to where there is less.
    least_film: f64,
    /// What the next attempt solves, and the next commit stores.
    pub flow: Flow,
    kappa: f64,
    /// The step that the preconditioner is made for.
    usual_nodes: f64,
}

impl Solver {
    /// Makes all memory for `grid`; `nodes` is the usual step; `flow` whether there is a film at all.
    pub fn new(grid: Grid, shape: &Shape, nodes: f64, flow: Flow) -> Self {
        let zero = vec![0.0; grid.len()];
        let mut newton =
            Newton::of_order(&grid, shape.kappa, 2.0 / 3.0 * nodes * grid.dx, shape.order);
        if shape.kappa_s != 0.0 {
            let tangential = Tangential::new(&grid, shape.kappa_s);
            newton.shear = Some(Shear::new(&grid, tangential));
        }
        let mut macroscopic = zero.clone();
        macroscopic_gap(&grid, shape.curvature_y, &mut macroscopic);
        let dry = Dry::new(&grid, &newton.elastic);
        Self {
            dry,
            gap: macroscopic.clone(),
            macroscopic,
            newton,
            trial: TriedState {
                pressure: zero.clone(),
                film: zero.clone(),
                h0: 0.0,
            },
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

    /// A Hertz contact with film `h_central`.
    pub fn hertz(&mut self, shape: &Shape, h_central: f64) -> ContactState {
        self.hertz_of_size(shape, 1.0, h_central)
    }

    /// The same where half-widths and pressure are `size` times the units.
    pub fn hertz_of_size(&mut self, shape: &Shape, size: f64, h_central: f64) -> ContactState {
        let grid = &self.grid;
        let mut pressure = vec![0.0; grid.len()];
        for j in grid.interior_rows() {
            let y = grid.y(j) / shape.b_over_a;
            for i in 1..grid.nx - 1 {
                let r2 = grid.x(i).powi(2) + y * y;
                pressure[j * grid.nx + i] = (size * size - r2).max(0.0).sqrt();
            }
        }
        let mut film = vec![0.0; grid.len()];
        self.newton.elastic.deflect(&pressure, &mut film);
        for (h, gap) in film.iter_mut().zip(&self.macroscopic) {
            *h += gap;
        }
        let centre = grid.axis_row() * grid.nx + ((-grid.x_min / grid.dx).round() as usize);
        let h0 = h_central - film[centre];
        for h in &mut film {
            *h = (*h + h0).max(0.5 * h_central);
        }
        let unlike = self.newton.shear.is_some();
        ContactState {
            history: History::steady(&film, &pressure, h0),
            sheared: vec![0.0; if unlike { grid.len() } else { 0 }],
            pressure,
            film,
            h0,
        }
    }

    /// Whether the bodies are of different materials: traction deflects them.
    pub fn is_unlike(&self) -> bool {
        self.newton.shear.is_some()
    }

    /// No pressure above `hardness` (P_H, over p_h) from now on; infinite: the bodies are elastic.
    pub fn yield_at(&mut self, hardness: f64) {
        self.newton.yield_at(hardness);
        self.dry.yield_at(hardness);
    }

    /// Depth by which the softer body has yielded for good in the last attempt, film units; `None`: elastic.
    pub fn yielded(&self) -> Option<&[f64]> {
        self.newton.yielding.as_ref().map(Yielding::depth)
    }

    /// Transforms made so far by all filters of this solver.
    pub fn transforms(&self) -> u64 {
        self.newton.transforms() + self.dry.transforms()
    }

    /// Tries a step of `nodes` nodes from `state` against `gap`; nothing is committed.
    pub fn attempt(
        &mut self,
        state: &ContactState,
        conditions: &Conditions,
        nodes: f64,
        guess: Guess,
    ) -> NewtonReport {
        let past = state.history.past(self.newton.order, nodes);
        self.attempt_after(state, conditions, nodes, past, guess)
    }

    /// A last try of a step of `nodes` nodes, with everything on the safe side: backward Euler, whose C* is
    /// never extrapolated, and no correction of the flow; the last pressure as first guess; the preconditioner's symbols made for this very
    /// step, not for the usual one; three times the iterations.
    pub fn attempt_safely(
        &mut self,
        state: &ContactState,
        conditions: &Conditions,
        nodes: f64,
    ) -> NewtonReport {
        let dx = self.grid.dx;
        self.set_symbols(nodes * dx);
        let mut patient = *conditions;
        patient.tolerance.max_iterations *= 3;
        let order = std::mem::replace(&mut self.newton.order, Order::Second);
        let report = self.attempt_after(state, &patient, nodes, Past::One, Guess::Last);
        self.newton.order = order;
        self.set_symbols(2.0 / 3.0 * self.usual_nodes * dx);
        report
    }

    /// Tries a step of so many nodes after such a past.
    fn attempt_after(
        &mut self,
        state: &ContactState,
        conditions: &Conditions,
        nodes: f64,
        past: Past,
        guess: Guess,
    ) -> NewtonReport {
        let history = &state.history;
        if guess != Guess::Tried {
            self.trial.h0 = history.h0[0];
        }
        match guess {
            Guess::Tried => {}
            Guess::Extrapolated => history.predict(&self.grid, nodes, &mut self.trial.pressure),
            Guess::Last => self.trial.pressure.copy_from_slice(&history.pressure_1),
            Guess::Given(pressure, h0) => {
                self.trial.pressure.copy_from_slice(pressure);
                self.trial.h0 = h0;
            }
        }
        if self.flow == Flow::Dry {
            return self.attempt_dry(conditions);
        }
        history.convect(&self.grid, nodes, past, &mut self.c_star, &mut self.s);
        self.least_film = conditions.tolerance.least_film;
        let problem = Problem {
            grid: &self.grid,
            medium: conditions.medium,
            sheared: conditions.law.map(|law| Sheared {
                law,
                deflection: &state.sheared,
                film: &state.film,
                shift: conditions.shift,
                keeps: guess == Guess::Last,
            }),
            gap: &self.gap,
            c_star: &self.c_star,
            s: &self.s,
            load: conditions.load,
            tolerance: conditions.tolerance,
        };
        self.newton.solve(
            &problem,
            &mut Iterate {
                p: &mut self.trial.pressure,
                h: &mut self.trial.film,
                h0: &mut self.trial.h0,
            },
        )
    }

    /// Film error of the last attempt, a step with a film, once its oil is as warm as it is now.
    pub fn film_error(&mut self, conditions: &Conditions) -> f64 {
        let problem = Problem {
            grid: &self.grid,
            medium: conditions.medium,
            sheared: None,
            gap: &self.gap,
            c_star: &self.c_star,
            s: &self.s,
            load: conditions.load,
            tolerance: conditions.tolerance,
        };
        let iterate = Iterate {
            p: &mut self.trial.pressure,
            h: &mut self.trial.film,
            h0: &mut self.trial.h0,
        };
        self.newton.film_error(&problem, &iterate)
    }

    /// Pressure and film of the last attempt.
    pub fn tried(&self) -> (&[f64], &[f64]) {
        (&self.trial.pressure, &self.trial.film)
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
    pub fn path_error(&mut self, state: &ContactState, nodes: f64) -> Option<f64> {
        if self.flow == Flow::Dry {
            return None;
        }
        self.gather_mass();
        let (mass, p) = (&self.mass, &self.trial.pressure);
        state.history.path_error(&self.grid, mass, p, nodes)
    }

    /// Where the surfaces of the last attempt overlap beyond the tolerance at an edge of the domain, which has no
    /// equation: the node and the overlap. There the contact is cut off.
    pub fn overlap_at_edge(&self, least_film: f64) -> Option<(usize, f64)> {
        let (grid, film) = (&self.grid, &self.trial.film);
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

    /// Commits the step that was attempted last to `state`.
    pub fn commit(&mut self, state: &mut ContactState, nodes: f64) {
        if self.flow != Flow::Dry {
            self.gather_mass();
        }
        let TriedState { pressure, film, h0 } = &self.trial;
        let mass = match self.flow {
            Flow::Dry => film,
            Flow::Film | Flow::MassConserving => &self.mass,
        };
        state.pressure.copy_from_slice(pressure);
        state.film.copy_from_slice(film);
        state.h0 = *h0;
        if let Some(shear) = &self.newton.shear {
            state.sheared.copy_from_slice(shear.deflection());
        }
        state.history.commit(mass, pressure, *h0, nodes);
    }

    /// ρ̄H of the last attempt.
    fn gather_mass(&mut self) {
        let trial = &self.trial;
        for (n, mass) in self.mass.iter_mut().enumerate() {
            let full = self.newton.reynolds.rho(n) * trial.film[n];
            let left = self.newton.reynolds.residual[n];
            let missing = if trial.pressure[n] > 0.0 {
                // The residual of a converged step (carry-over) is mass that the next one must find again.
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
