//! A time step with its ladder of fallbacks.
//!
//! ```text
//! 1  as asked           from the extrapolated pressure, then from the last one
//! 2  in halves          at most five times, each part from rung 1 on
//! 3  on the safe side   backward Euler, symbols of the preconditioner made for this step, thrice the iterations
//! 4  named              kept where the film error is below 5 % (exit code 2: where and how much are told),
//!                       else not kept: the run ends (exit code 3); a dry step by its gap error in the same way
//! ```
//! Each rung is counted in [`super::Stats`] and shown by `tests/engine/ladder.rs`.

use super::drive::Drive;
use super::frame::Metrics;
use super::heat_stage::{HeatStage, SolvedStep, Times, Warmth};
use super::motion::Travel;
use super::pace::{StepTest, Stepping};
use super::roughness::Roughness;
use super::scaling::Scaling;
use super::sim_plan::SimPlan;
use super::worn::Worn;
use super::yielded::Yielded;
use super::{StepError, Unsolved};
use crate::physics::cycles::speed_ratios;
use crate::scene::Knob;
use crate::solve::march::{Conditions, ContactState, Flow, Guess, Solver};
use crate::solve::newton::{NewtonReport, Verdict};

/// Most times a step is halved.
const MAX_HALVINGS: u32 = 5;
/// Newton iterations of one step after which it is halved no more: what 32 parts cost if all coarser ones failed.
const MOST_NEWTON: u32 = 1500;
/// Film error above which an unconverged step is not kept: it would pump mass into the history. Of a dry step the error is
/// a gap or overlap over the film that p_h on one node makes: this much is wrong by as much of p_h at that node.
const HOPELESS: f64 = 0.05;

/// Most times that a step is solved again because its oil has warmed; beyond it shorter steps are tried.
const MOST_WARMED: usize = 30;

/// What a step took and reached.
#[derive(Debug, Clone, Copy, Default)]
pub(super) struct Attempted {
    /// Every part converged.
    pub(super) converged: bool,
    /// Worst relative change of pressure.
    pub(super) residual: f64,
    /// Worst film error.
    pub(super) film_error: f64,
    /// Worst mass error.
    pub(super) mass_error: f64,
    /// Worst load error.
    pub(super) load_error: f64,
    /// Deepest overlap of the surfaces, in H: at nodes that did not converge, or at an edge of the domain.
    pub(super) overlap: f64,
    /// Newton iterations.
    pub(super) newton: u32,
    /// Krylov iterations.
    pub(super) linear: u32,
    /// Attempts beyond the first.
    pub(super) retries: u32,
    /// Times that it was halved.
    pub(super) halvings: u32,
    /// Parts that needed the safe settings.
    pub(super) safer: u32,
    /// Converged solutions that were made again for their error in time.
    pub(super) rejected: u32,
    /// Error in time over a crossing, by the formula; `None`: not estimated.
    pub(super) path_error: Option<f64>,
    /// Where a part that did not converge is worst, m.
    pub(super) worst: Option<(f64, f64)>,
    /// Length, in nodes.
    pub(super) nodes: f64,
    /// Simulated time, s.
    pub(super) dt_s: f64,
    /// Why nothing was kept.
    failure: Option<StepFailure>,
}

#[derive(Debug, Clone, Copy)]
enum StepFailure {
    NotFinite,
    /// Where it is worst, and what was asked.
    Hopeless {
        x_m: f64,
        y_m: f64,
        asked: Unsolved,
    },
}

impl Attempted {
    /// A step of `nodes` nodes of a steady contact: nothing was solved, the last numbers hold.
    pub(super) fn held(metrics: &Metrics, nodes: f64) -> Self {
        Self {
            nodes,
            converged: metrics.converged,
            residual: metrics.residual,
            film_error: metrics.film_error,
            mass_error: metrics.mass_error,
            load_error: metrics.load_error,
            ..Self::default()
        }
    }

    /// The error, when nothing was kept.
    pub(super) fn fatal(&self, t_s: f64) -> Option<StepError> {
        Some(match self.failure? {
            StepFailure::NotFinite => StepError::NotFinite { t_s },
            StepFailure::Hopeless { x_m, y_m, asked } => StepError::Stalled {
                t_s,
                unsolved: Unsolved {
                    residual: self.residual,
                    film_error: self.film_error,
                    ..asked
                },
                retries: self.retries,
                x_m,
                y_m,
            },
        })
    }

    fn take(&mut self, report: &NewtonReport) {
        self.newton += report.iterations;
        self.linear += report.linear_iterations;
    }

    fn keep(&mut self, report: &NewtonReport) {
        self.converged &= report.verdict == Verdict::Converged;
        self.residual = self.residual.max(report.left);
        self.film_error = self.film_error.max(report.film_error);
        self.mass_error = self.mass_error.max(report.mass_error);
        self.load_error = self.load_error.max(report.load_error);
    }
}

/// Both surfaces where the bodies now are, and the gap that they leave.
pub(super) fn place_surfaces(
    solver: &mut Solver,
    roughness: &mut Roughness,
    scaling: &Scaling,
    drive: &Drive,
    motion: &Travel,
    (yielded, worn): (Option<&Yielded>, Option<&Worn>),
) {
    let grid = &solver.grid;
    let amplitudes = amplitudes(scaling, drive);
    // Roughness is made for the finest grid; a start-up comes up to it smooth.
    if !roughness.is_on(grid) {
        assert_eq!(amplitudes, [0.0; 2], "rough on a grid that carries none");
        solver.gap.copy_from_slice(&solver.macroscopic);
        return;
    }
    let now = motion.of_bodies().into_iter().zip(amplitudes);
    for (body, (travel, amplitude)) in now.enumerate() {
        roughness.place(grid, body, travel, amplitude);
        if let Some(yielded) = yielded {
            let lowered = &mut roughness.heights[body];
            yielded.lower(grid, body, travel, amplitude, lowered);
        }
        if let Some(worn) = worn.filter(|worn| worn.wears(body)) {
            worn.lower(grid, body, travel, &mut roughness.heights[body]);
        }
    }
    roughness.gap_into(&solver.macroscopic, &mut solver.gap);
}

/// Length of a step of so many nodes, and the speeds of both bodies; while a knob walks as where it walks to.
pub(super) fn times(plan: &SimPlan, drive: &Drive, dx: f64, nodes: f64) -> Times {
    let value = |knob| {
        let setting = drive.get(knob);
        if drive.is_walking() {
            setting.target
        } else {
            setting.now
        }
    };
    let (u_m_s, s) = (value(Knob::EntrainmentMS), value(Knob::SlideRoll));
    Times {
        dt_s: nodes * dx * plan.scaling.a_m / u_m_s,
        speeds_m_s: speed_ratios(s).map(|ratio| u_m_s * ratio),
    }
}

/// |U2 − U1|.
pub(super) fn sliding_m_s(drive: &Drive) -> f64 {
    (drive.get(Knob::SlideRoll).now * drive.get(Knob::EntrainmentMS).now).abs()
}

/// Amplitudes of both bodies as the knobs are, film units.
fn amplitudes(scaling: &Scaling, drive: &Drive) -> [f64; 2] {
    Knob::AMPLITUDES.map(|knob| scaling.h_from_m(drive.get(knob).now))
}

/// Everything that a step moves.
pub(super) struct Mover<'a> {
    pub(super) state: &'a mut ContactState,
    pub(super) solver: &'a mut Solver,
    pub(super) roughness: &'a mut Roughness,
    pub(super) drive: &'a mut Drive,
    pub(super) motion: &'a mut Travel,
    pub(super) plan: &'a SimPlan,
    pub(super) stepping: Stepping,
    /// Guess of a step of the length that is asked for.
    pub(super) given: Option<(&'a [f64], f64)>,
    /// What has yielded; `None`: elastic.
    pub(super) yielded: Option<&'a mut Yielded>,
    /// What is worn; `None`: nothing.
    pub(super) worn: Option<&'a Worn>,
    /// What warms; `None`: nobody asks.
    pub(super) heated: Option<Heated<'a>>,
}

/// What a step warms.
pub(super) struct Heated<'a> {
    pub(super) stage: &'a mut HeatStage,
    pub(super) warmth: &'a mut Warmth,
}

impl Mover<'_> {
    /// Advances by a step of `nodes` nodes: shorter where its error in time asks for it, in parts where that
    /// is what it takes to converge.
    pub(super) fn advance(mut self, nodes: f64) -> Attempted {
        let mut done = Attempted {
            converged: true,
            ..Attempted::default()
        };
        let mut nodes = nodes;
        loop {
            let before = (self.drive.clone(), self.motion.clone());
            self.place(nodes);
            let Some(report) = self.solve(nodes, &mut done) else {
                self.in_parts(nodes, before, &mut done);
                return done;
            };
            let error = match self.stepping {
                Stepping::Fixed(_) => None,
                Stepping::Adaptive { .. } => self.solver.path_error(self.state, nodes),
            };
            match self.stepping.test_error(error, nodes, done.rejected) {
                StepTest::Accepted => {
                    done.path_error = error;
                    self.commit(nodes, &report, &mut done);
                    return done;
                }
                StepTest::Repeat(smaller) => {
                    done.rejected += 1;
                    (*self.drive, *self.motion) = before;
                    nodes = smaller;
                }
            }
        }
    }

    /// First rung: from the extrapolated pressure, then from the last one. `None`: neither converged.
    fn solve(&mut self, nodes: f64, done: &mut Attempted) -> Option<NewtonReport> {
        let given = (self.given.take()).map(|(pressure, h0)| Guess::Given(pressure, h0));
        for guess in given.into_iter().chain([Guess::Extrapolated, Guess::Last]) {
            self.begin_heat(nodes);
            let report = self.attempt(nodes, guess);
            done.take(&report);
            if report.verdict == Verdict::Converged
                && let Some(report) = self.warm(nodes, report, done)
            {
                return Some(report);
            }
            done.retries += 1;
        }
        None
    }

    /// The heat of the steps before, at the end of one of so many nodes; the oil is as thin as after the last.
    fn begin_heat(&mut self, nodes: f64) {
        let times = times(self.plan, self.drive, self.solver.grid.dx, nodes);
        if let Some(Heated { stage, warmth }) = &mut self.heated {
            stage.begin(warmth, times);
        }
    }

    /// Heat and temperatures of the step as it has been solved.
    fn find_heat(&mut self) {
        let law = self.plan.law_now(self.drive);
        let flows = self.plan.flow_now(self.drive) != Flow::Dry;
        let (pressure, film) = self.solver.tried();
        if let Some(Heated { stage, .. }) = &mut self.heated {
            stage.find(&SolvedStep {
                grid: &self.solver.grid,
                scaling: &self.plan.scaling,
                law: &law,
                pressure,
                film,
                flow: flows.then_some(&self.solver.newton.reynolds),
                entrainment_m_s: self.drive.get(Knob::EntrainmentMS).now,
                sliding_m_s: sliding_m_s(self.drive),
            });
        }
    }

    /// Solves the step again with the oil as thin as it has become, until its film error is below the tolerance as it
    /// stands; `None`: it does not come to that.
    fn warm(
        &mut self,
        nodes: f64,
        mut report: NewtonReport,
        done: &mut Attempted,
    ) -> Option<NewtonReport> {
        if self.heated.is_none() {
            return Some(report);
        }
        for _ in 0..MOST_WARMED {
            self.find_heat();
            let flow = self.plan.flow_now(self.drive);
            let feeds_back = (self.heated.as_ref()).is_some_and(|heated| heated.stage.feeds_back());
            if !feeds_back || flow == Flow::Dry {
                return Some(report);
            }
            let error = self.with_conditions(|solver, _, conditions| solver.film_error(conditions));
            report.film_error = report.film_error.max(error);
            if error <= self.plan.tolerance(flow).film {
                return Some(report);
            }
            report = self.attempt(nodes, Guess::Tried);
            done.take(&report);
            if report.verdict != Verdict::Converged {
                return None;
            }
        }
        None
    }

    /// All that comes after the first rung; a step that fails leaves everything as it was `before`, its first parts too.
    fn in_parts(&mut self, nodes: f64, before: (Drive, Travel), done: &mut Attempted) {
        let contact = self.state.clone();
        let yielded = self.yielded.as_deref().cloned();
        let warmth = self.heated.as_ref().map(|heated| heated.warmth.clone());
        (*self.drive, *self.motion) = before.clone();
        self.in_halves(nodes, 1, done);
        if done.failure.is_some() {
            *self.state = contact;
            (*self.drive, *self.motion) = before;
            if let (Some(now), Some(yielded)) = (&mut self.yielded, yielded) {
                **now = yielded;
            }
            if let (Some(now), Some(warmth)) = (&mut self.heated, warmth) {
                *now.warmth = warmth;
            }
            self.place_surfaces();
        }
    }

    /// Second rung: two parts of half the length, each from the first rung on.
    fn in_halves(&mut self, nodes: f64, halvings: u32, done: &mut Attempted) {
        done.halvings = done.halvings.max(halvings);
        for _ in 0..2 {
            if done.failure.is_none() {
                self.part(0.5 * nodes, halvings, done);
            }
        }
    }

    fn part(&mut self, nodes: f64, halvings: u32, done: &mut Attempted) {
        let before = (self.drive.clone(), self.motion.clone());
        self.place(nodes);
        if let Some(report) = self.solve(nodes, done) {
            self.commit(nodes, &report, done);
        } else if halvings < MAX_HALVINGS && done.newton < MOST_NEWTON {
            (*self.drive, *self.motion) = before;
            self.in_halves(nodes, halvings + 1, done);
        } else {
            self.safely(nodes, done);
        }
    }

    /// Third rung: the safe settings. Fourth: kept and named, or not kept and the end of the run.
    fn safely(&mut self, nodes: f64, done: &mut Attempted) {
        done.safer += 1;
        self.begin_heat(nodes);
        let report = self.with_conditions(|solver, state, conditions| {
            solver.attempt_safely(state, conditions, nodes)
        });
        done.take(&report);
        if report.verdict == Verdict::NotFinite {
            done.keep(&report);
            done.failure = Some(StepFailure::NotFinite);
        } else if report.verdict != Verdict::Converged && report.film_error > HOPELESS {
            done.keep(&report);
            let (x_m, y_m) = self.place_of(report.worst_node);
            let (flow, tolerance) = (self.solver.flow, self.plan.tolerance(self.solver.flow));
            let asked = Unsolved {
                residual_asked: tolerance.pressure,
                film_error_asked: tolerance.film,
                dry: flow == Flow::Dry,
                ..Unsolved::default()
            };
            done.failure = Some(StepFailure::Hopeless { x_m, y_m, asked });
        } else {
            self.find_heat();
            self.commit(nodes, &report, done);
        }
    }

    fn place_of(&self, node: usize) -> (f64, f64) {
        let grid = &self.solver.grid;
        let (i, j) = (node % grid.nx, node / grid.nx);
        (
            self.plan.scaling.place_m(grid.x(i)),
            self.plan.scaling.m_from_x(grid.y(j)),
        )
    }

    fn commit(&mut self, nodes: f64, report: &NewtonReport, done: &mut Attempted) {
        done.keep(report);
        if report.verdict != Verdict::Converged {
            done.worst = Some(self.place_of(report.worst_node));
            done.overlap = done.overlap.max(report.overlap);
        }
        if let Some((node, overlap)) = self
            .solver
            .overlap_at_edge(self.plan.tolerance(self.solver.flow).least_film)
        {
            // Solved as it stands; but contact reaches beyond the domain, so it is not the scene's.
            done.converged = false;
            done.worst = Some(self.place_of(node));
            done.overlap = done.overlap.max(overlap);
        }
        self.solver.commit(self.state, nodes);
        if let Some(Heated { stage, warmth }) = &mut self.heated {
            stage.commit(warmth);
        }
        let amplitudes = amplitudes(&self.plan.scaling, self.drive);
        if let (Some(yielded), Some(depth)) = (&mut self.yielded, self.solver.yielded())
            && yielded.take(
                &self.solver.grid,
                depth,
                self.motion.of_bodies(),
                amplitudes,
            )
        {
            // The surfaces are seen as the step leaves them.
            self.place_surfaces();
        }
        done.nodes += nodes;
        done.dt_s += nodes * self.solver.grid.dx * self.plan.scaling.a_m
            / self.drive.get(Knob::EntrainmentMS).now;
    }

    /// Walks the knobs, moves the bodies, makes the gap.
    fn place(&mut self, nodes: f64) {
        let grid = &self.solver.grid;
        self.drive.walk(nodes * grid.dx);
        self.motion
            .travel(grid, nodes, self.drive.get(Knob::SlideRoll).now);
        self.place_surfaces();
    }

    fn place_surfaces(&mut self) {
        place_surfaces(
            self.solver,
            self.roughness,
            &self.plan.scaling,
            self.drive,
            self.motion,
            (self.yielded.as_deref(), self.worn),
        );
    }

    fn attempt(&mut self, nodes: f64, guess: Guess) -> NewtonReport {
        self.with_conditions(|solver, state, conditions| {
            solver.attempt(state, conditions, nodes, guess)
        })
    }

    fn with_conditions<R>(
        &mut self,
        solve: impl FnOnce(&mut Solver, &ContactState, &Conditions) -> R,
    ) -> R {
        let value = |knob| self.drive.get(knob).now;
        let flow = self.plan.flow_now(self.drive);
        let (speed, slide_roll) = (value(Knob::EntrainmentMS), value(Knob::SlideRoll));
        let medium = match flow {
            Flow::Dry => self.plan.scaling.medium_at_rest(),
            Flow::Film | Flow::MassConserving => self.plan.scaling.medium(speed, slide_roll),
        };
        // Of the knobs as this step has moved them.
        let law = self.plan.law_now(self.drive);
        let stage = self.heated.as_ref().map(|heated| &*heated.stage);
        (self.solver.newton.reynolds).warm(stage.and_then(HeatStage::thinner));
        let conditions = Conditions {
            medium: &medium,
            law: Some(&law),
            shift: stage.map_or(&[], HeatStage::shift),
            load: self.plan.scaling.load(value(self.plan.scaling.load_knob())),
            tolerance: self.plan.tolerance(flow),
        };
        self.solver.flow = flow;
        self.solver.newton.order = self.plan.order_now(self.drive);
        self.solver.yield_at(match self.yielded {
            Some(_) => self.plan.hardness,
            None => f64::INFINITY,
        });
        solve(self.solver, self.state, &conditions)
    }
}
