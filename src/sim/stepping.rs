//! A time step with its ladder of fallbacks.
//!
//! ```text
//! 1  as asked           from the extrapolated pressure, then from the last one
//! 2  in halves          at most five times, each part from rung 1 on
//! 3  on the safe side   backward Euler, symbols of the preconditioner made for this step, thrice the iterations
//! 4  named              kept where the mass error is below 5 % (exit code 2: where and how much are told),
//!                       else not kept: the run ends (exit code 3)
//! ```
//! Each rung is counted in [`super::Stats`] and shown by `tests/ladder.rs`.

use super::StepError;
use super::door::Door;
use super::drive::Drive;
use super::frame::Metrics;
use super::knob::Knob;
use super::motion::Motion;
use super::pace::{Judgement, Stepping};
use super::regime::Regime;
use super::terrain::Terrain;
use crate::solve::march::{Conditions, Flow, Guess, March};
use crate::solve::newton::{NewtonReport, Verdict};
use crate::solve::traction::TractionLaw;

/// Most times a step is halved.
const MAX_HALVINGS: u32 = 5;
/// Newton iterations of one step after which it is halved no more: what 32 parts cost if all coarser ones failed.
const MOST_NEWTON: u32 = 1500;
/// Film error above which an unconverged step is not kept: it would pump mass into the history.
const HOPELESS: f64 = 0.05;

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
    /// Transforms.
    pub(super) ffts: u64,
    /// Attempts beyond the first.
    pub(super) retries: u32,
    /// Times that it was halved.
    pub(super) halvings: u32,
    /// Parts that needed the safe settings.
    pub(super) safer: u32,
    /// Converged solutions that were made again for their error in time.
    pub(super) rejected: u32,
    /// Error in time over a crossing, by the formula; `None`: not judged.
    pub(super) path_error: Option<f64>,
    /// Where a part that did not converge is worst, m.
    pub(super) worst: Option<(f64, f64)>,
    /// Length, in nodes.
    pub(super) nodes: f64,
    /// Simulated time, s.
    pub(super) dt_s: f64,
    /// Why nothing was kept.
    failure: Option<Failure>,
}

#[derive(Debug, Clone, Copy)]
enum Failure {
    NotFinite,
    Hopeless { x_m: f64, y_m: f64 },
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
    pub(super) fn fatal(&self, t_s: f64, tolerance: f64) -> Option<StepError> {
        Some(match self.failure? {
            Failure::NotFinite => StepError::NotFinite { t_s },
            Failure::Hopeless { x_m, y_m } => StepError::Stalled {
                t_s,
                residual: self.residual,
                tolerance,
                film_error: self.film_error,
                retries: self.retries,
                x_m,
                y_m,
            },
        })
    }

    fn take(&mut self, report: &NewtonReport) {
        self.newton += report.iterations;
        self.linear += report.linear_iterations;
        // A residual is one transform pair, a Krylov iteration one pair and six half-size ones.
        self.ffts += 2 * u64::from(report.evaluations) + 8 * u64::from(report.linear_iterations);
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
    march: &mut March,
    terrain: &mut Terrain,
    drive: &Drive,
    motion: &Motion,
    door: &Door,
) {
    let grid = &march.grid;
    // Roughness is made for the finest grid; on the coarser ones of the start-up there is none yet.
    if terrain
        .heights
        .iter()
        .any(|heights| !heights.is_empty() && heights.len() != grid.len())
    {
        march.gap.copy_from_slice(&march.macroscopic);
        return;
    }
    let rough = [Knob::Amplitude1M, Knob::Amplitude2M];
    let amplitude = rough.map(|knob| door.h_from_m(drive.get(knob).now));
    for (body, (way, amplitude)) in motion.ways().into_iter().zip(amplitude).enumerate() {
        terrain.place(grid, body, way, amplitude);
    }
    terrain.gap_into(&march.macroscopic, &mut march.gap);
}

/// Everything that a step moves.
pub(super) struct Mover<'a> {
    pub(super) march: &'a mut March,
    pub(super) terrain: &'a mut Terrain,
    pub(super) drive: &'a mut Drive,
    pub(super) motion: &'a mut Motion,
    pub(super) door: &'a Door,
    pub(super) law: TractionLaw,
    pub(super) regime: Regime,
    pub(super) stepping: Stepping,
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
                (*self.drive, *self.motion) = before;
                self.in_halves(nodes, 1, &mut done);
                return done;
            };
            let error = match self.stepping {
                Stepping::Fixed(_) => None,
                Stepping::Adaptive { .. } => self.march.path_error(nodes),
            };
            match self.stepping.judge(error, nodes, done.rejected) {
                Judgement::Good => {
                    done.path_error = error;
                    self.commit(nodes, &report, &mut done);
                    return done;
                }
                Judgement::Again(smaller) => {
                    done.rejected += 1;
                    (*self.drive, *self.motion) = before;
                    nodes = smaller;
                }
            }
        }
    }

    /// First rung: from the extrapolated pressure, then from the last one. `None`: neither converged.
    fn solve(&mut self, nodes: f64, done: &mut Attempted) -> Option<NewtonReport> {
        for guess in [Guess::Extrapolated, Guess::Last] {
            let report = self.attempt(nodes, guess);
            done.take(&report);
            if report.verdict == Verdict::Converged {
                return Some(report);
            }
            done.retries += 1;
        }
        None
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
            if done.failure.is_some() {
                (*self.drive, *self.motion) = before;
            }
        }
    }

    /// Third rung: the safe settings. Fourth: kept and named, or not kept and the end of the run.
    fn safely(&mut self, nodes: f64, done: &mut Attempted) {
        done.safer += 1;
        let report =
            self.with_conditions(|march, conditions| march.attempt_safely(conditions, nodes));
        done.take(&report);
        if report.verdict == Verdict::NotFinite {
            done.keep(&report);
            done.failure = Some(Failure::NotFinite);
        } else if report.verdict != Verdict::Converged && report.film_error > HOPELESS {
            done.keep(&report);
            let (x_m, y_m) = self.place_of(report.worst_node);
            done.failure = Some(Failure::Hopeless { x_m, y_m });
        } else {
            self.commit(nodes, &report, done);
        }
    }

    fn place_of(&self, node: usize) -> (f64, f64) {
        let grid = &self.march.grid;
        let (i, j) = (node % grid.nx, node / grid.nx);
        (self.door.place_m(grid.x(i)), self.door.m_from_x(grid.y(j)))
    }

    fn commit(&mut self, nodes: f64, report: &NewtonReport, done: &mut Attempted) {
        done.keep(report);
        if report.verdict != Verdict::Converged {
            done.worst = Some(self.place_of(report.worst_node));
            done.overlap = done.overlap.max(report.overlap);
        }
        if let Some((node, overlap)) = self
            .march
            .overlap_at_edge(self.regime.tolerance(self.march.flow).least_film)
        {
            // Solved as it stands; but contact reaches beyond the domain, so it is not the scene's.
            done.converged = false;
            done.worst = Some(self.place_of(node));
            done.overlap = done.overlap.max(overlap);
        }
        self.march.commit(nodes);
        done.nodes += nodes;
        done.dt_s +=
            nodes * self.march.grid.dx * self.door.a_m / self.drive.get(Knob::EntrainmentMS).now;
    }

    /// Walks the knobs, moves the bodies, makes the gap.
    fn place(&mut self, nodes: f64) {
        let grid = &self.march.grid;
        self.drive.walk(nodes * grid.dx);
        self.motion
            .travel(grid, nodes, self.drive.get(Knob::SlideRoll).now);
        place_surfaces(self.march, self.terrain, self.drive, self.motion, self.door);
    }

    fn attempt(&mut self, nodes: f64, guess: Guess) -> NewtonReport {
        self.with_conditions(|march, conditions| march.attempt(conditions, nodes, guess))
    }

    fn with_conditions(
        &mut self,
        solve: impl FnOnce(&mut March, &Conditions) -> NewtonReport,
    ) -> NewtonReport {
        let value = |knob| self.drive.get(knob).now;
        let flow = self.regime.flow_now(self.door, self.drive);
        let (speed, slide_roll) = (value(Knob::EntrainmentMS), value(Knob::SlideRoll));
        let medium = match flow {
            Flow::Dry => self.door.medium_at_rest(),
            Flow::Film | Flow::MassConserving => self.door.medium(speed, slide_roll),
        };
        let law = match flow {
            Flow::Dry => self.law.without_film(),
            Flow::Film | Flow::MassConserving => self.law,
        };
        let conditions = Conditions {
            medium: &medium,
            law: Some(&law),
            load: self.door.load(value(self.door.load_knob())),
            tolerance: self.regime.tolerance(flow),
        };
        self.march.flow = flow;
        solve(self.march, &conditions)
    }
}
