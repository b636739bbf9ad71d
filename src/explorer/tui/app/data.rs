//! What the screen's state is made of, and what it asks for.

use crate::tui::kinds::Leading;
use crate::tui::trace::TraceSample;
use asperity_engine::physics::estimate::Factors;
use asperity_engine::scene::Scene;
use asperity_engine::sim::Frame;
use asperity_session::run::Command;
use asperity_session::sweep::CurveOrder;

/// What a key does outside of the screen and the run, where the program offers it.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum ErrandKind {
    /// Switches recording on and off.
    Record,
    /// Opens the viewer.
    View,
    /// Saves the scene.
    Save,
    /// Runs another scene.
    Rebuild,
    /// Writes what is shown.
    Write,
}

/// What the app asks of the loop around it.
#[derive(Debug, Clone, PartialEq)]
pub enum Effect {
    /// A command for the run.
    Send(Command),
    /// An errand.
    Errand(ErrandKind),
    /// Compute this beside the run, from where it has settled.
    Sweep(Box<CurveOrder>),
    /// Call that off.
    EndSweep,
    /// Run this scene in place of the present one, under this name.
    Rebuild(Box<Scene>, String),
    /// To the shell.
    Suspend,
    /// The end.
    Quit,
}

/// A state to compare with.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Pinned {
    /// Relative life (same-load reference).
    pub life_relative: f64,
    /// What its load costs against the scene's; lives are compared with it.
    pub load_factor: f64,
    /// Which number was pinned.
    pub leading: Leading,
    /// S.
    pub slide_roll: f64,
    /// The load, N, of a line N/m (the scene may give it as a Hertz pressure).
    pub load_n: f64,
    /// Hertz pressure, Pa.
    pub p_hertz_pa: f64,
}

/// The upper ends of the curves' axes, which have few rows: what was reached. They only grow, so that frames can be
/// compared. Maps have the ranges of all pictures ([`asperity_picture::Ranges`]).
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct AxisEnds {
    /// Pressure, Pa.
    pub pressure_pa: f64,
    /// Film, m.
    pub film_m: f64,
}

/// A step that did not converge, and what of it.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Trouble {
    /// Which step.
    pub step: u64,
    /// What did not.
    pub what: WhyUnconverged,
}

/// What of a step did not converge.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum WhyUnconverged {
    /// The pressure: its residual, and how often the step was tried again.
    Pressure(f64, u32),
    /// The film: the part that is not balanced.
    Film(f64),
    /// Surfaces overlap by so much, m: at nodes that did not converge, or where the domain cuts contact off.
    Overlap(f64),
}

impl Trouble {
    /// Of a frame's step, whose pressure was to converge to `tolerance`.
    pub fn of(frame: &Frame, tolerance: f64) -> Self {
        let metrics = &frame.metrics;
        let what = if metrics.residual > tolerance {
            WhyUnconverged::Pressure(metrics.residual, metrics.retries)
        } else if metrics.overlap_m > 0.0 {
            WhyUnconverged::Overlap(metrics.overlap_m)
        } else {
            WhyUnconverged::Film(metrics.film_error)
        };
        Self {
            step: frame.step,
            what,
        }
    }
}

/// One point of the life's history.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct LifeSample {
    /// Passages travelled.
    pub passages: f64,
    /// Relative life.
    pub life_relative: f64,
}

/// What a state is told by, of the simulation or of the formula.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct LifeAccount {
    /// Contacts of the body that meets most in one loading cycle; `None`: a body stands.
    pub n: Option<f64>,
    /// Cycles, peaks, traction, load.
    pub factors: Factors,
    /// Mean film of the central part, m; 0: dry.
    pub film_m: f64,
    /// The body that governs: 1 or 2; 0: both alike.
    pub body: u8,
}

/// A state before a knob was turned.
#[derive(Debug, Clone)]
pub struct StateBefore {
    /// Where each knob was.
    pub(super) targets: Vec<f64>,
    pub(super) formula: LifeAccount,
    /// `None`: it had not settled.
    pub(super) simulated: Option<LifeAccount>,
}

/// Mean of a number over the frames since the life has settled: within a period it comes and goes.
#[derive(Debug, Clone, Copy, Default)]
pub(crate) struct SettledMean {
    sum: f64,
    frames: f64,
}

impl SettledMean {
    /// The mean with one more frame.
    pub(super) fn add(&mut self, value: f64) -> f64 {
        self.sum += value;
        self.frames += 1.0;
        self.sum / self.frames
    }

    /// The mean; `None`: of no frame.
    pub(super) fn value(self) -> Option<f64> {
        (self.frames > 0.0).then(|| self.sum / self.frames)
    }
}

/// A material point now.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct PointNow {
    /// Body: 1 or 2.
    pub body: u8,
    /// Depth at which its stress is given, m.
    pub depth_m: f64,
    /// Where it is and what it feels.
    pub sample: TraceSample,
    /// Cycles a crossing by formula: n, expected on average.
    pub expected: Option<f64>,
    /// Mean of the crossings that were counted.
    pub average: Option<f64>,
    /// Closed cycles: in a replay of this crossing, else of the one before.
    pub closed: Option<f64>,
}
