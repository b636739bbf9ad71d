//! A time step with its fallbacks: as asked, then from the last pressure, then in halves, then named.

use super::StepError;
use super::door::Door;
use super::drive::Drive;
use super::frame::Metrics;
use super::knob::Knob;
use super::motion::Motion;
use super::terrain::Terrain;
use crate::solve::march::{Conditions, Guess, March};
use crate::solve::newton::{NewtonReport, Tolerance, Verdict};
use crate::solve::traction::TractionLaw;

/// Most times a step is halved.
const MAX_HALVINGS: u32 = 2;
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
    /// Newton iterations.
    pub(super) newton: u32,
    /// Krylov iterations.
    pub(super) linear: u32,
    /// Transforms.
    pub(super) ffts: u64,
    /// Attempts beyond the first.
    pub(super) retries: u32,
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
    /// A step of a steady contact: nothing was solved, the last numbers hold.
    pub(super) fn held(metrics: &Metrics) -> Self {
        Self {
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
        self.residual = self.residual.max(report.change);
        self.film_error = self.film_error.max(report.film_error);
        self.mass_error = self.mass_error.max(report.mass_error);
        self.load_error = self.load_error.max(report.load_error);
    }
}

/// Everything that a step moves.
struct Mover<'a> {
    march: &'a mut March,
    terrain: &'a mut Terrain,
    drive: &'a mut Drive,
    motion: &'a mut Motion,
    door: &'a Door,
    law: TractionLaw,
    tolerance: Tolerance,
}

/// Advances by one full step, in parts where that is what it takes.
pub(super) fn advance(
    march: &mut March,
    terrain: &mut Terrain,
    drive: &mut Drive,
    motion: &mut Motion,
    door: &Door,
    law: TractionLaw,
    tolerance: Tolerance,
) -> Attempted {
    let mut done = Attempted {
        converged: true,
        ..Attempted::default()
    };
    let nodes = motion.nodes;
    let mut mover = Mover {
        march,
        terrain,
        drive,
        motion,
        door,
        law,
        tolerance,
    };
    mover.part(nodes, 0, &mut done);
    done
}

impl Mover<'_> {
    /// One part of a step; halves itself on failure.
    fn part(&mut self, nodes: f64, halvings: u32, done: &mut Attempted) {
        let (drive, travelled) = (self.drive.clone(), self.motion.clone());
        self.place(nodes);
        for guess in [Guess::Extrapolated, Guess::Last] {
            let report = self.attempt(nodes, guess);
            done.take(&report);
            if report.verdict == Verdict::Converged {
                self.commit(nodes, &report, done);
                return;
            }
            done.retries += 1;
        }
        if halvings < MAX_HALVINGS {
            (*self.drive, *self.motion) = (drive, travelled);
            for _ in 0..2 {
                if done.failure.is_none() {
                    self.part(0.5 * nodes, halvings + 1, done);
                }
            }
            return;
        }
        let report = self.attempt(nodes, Guess::Last);
        done.take(&report);
        self.commit_or_fail(nodes, &report, done);
    }

    fn commit_or_fail(&mut self, nodes: f64, report: &NewtonReport, done: &mut Attempted) {
        done.keep(report);
        if report.verdict == Verdict::NotFinite {
            done.failure = Some(Failure::NotFinite);
        } else if report.film_error > HOPELESS {
            let grid = &self.march.grid;
            let (i, j) = (report.worst_node % grid.nx, report.worst_node / grid.nx);
            done.failure = Some(Failure::Hopeless {
                x_m: self.door.place_m(grid.x(i)),
                y_m: self.door.m_from_x(grid.y(j)),
            });
        } else {
            self.commit(nodes, report, done);
        }
    }

    fn commit(&mut self, nodes: f64, report: &NewtonReport, done: &mut Attempted) {
        done.keep(report);
        self.march.commit(nodes);
        done.dt_s +=
            nodes * self.march.grid.dx * self.door.a_m / self.drive.get(Knob::EntrainmentMS).now;
    }

    /// Walks the knobs, moves the bodies, makes the gap.
    fn place(&mut self, nodes: f64) {
        let grid = &self.march.grid;
        self.drive.walk(nodes * grid.dx);
        self.motion
            .travel(grid, nodes, self.drive.get(Knob::SlideRoll).now);
        let rough = [Knob::Amplitude1M, Knob::Amplitude2M];
        let amplitude = rough.map(|knob| self.door.h_from_m(self.drive.get(knob).now));
        if amplitude == [0.0; 2] || grid.len() != self.march.macroscopic.len() {
            self.march.gap.copy_from_slice(&self.march.macroscopic);
            return;
        }
        for (body, (way, amplitude)) in self.motion.ways().into_iter().zip(amplitude).enumerate() {
            self.terrain.place(grid, body, way, amplitude);
        }
        self.terrain
            .gap_into(&self.march.macroscopic, &mut self.march.gap);
    }

    fn attempt(&mut self, nodes: f64, guess: Guess) -> NewtonReport {
        let value = |knob| self.drive.get(knob).now;
        let medium = self
            .door
            .medium(value(Knob::EntrainmentMS), value(Knob::SlideRoll));
        let conditions = Conditions {
            medium: &medium,
            law: Some(&self.law),
            load: self.door.load(value(self.door.load_knob())),
            tolerance: self.tolerance,
        };
        self.march.attempt(&conditions, nodes, guess)
    }
}
