//! What the passage costs: material points that count cycles, and the mean life integral.
//!
//! The reference is the same scene smooth, frictionless, with S = 0, computed in the start-up;
//! n_ref = 1. The cycle factor takes the n of the body that suffers more per own loading cycle.

use serde::{Deserialize, Serialize};

use super::frame::LifeEstimate;
use crate::math::grid::Grid;
use crate::physics::cycles::{BodyId, Kinematics};
use crate::physics::fatigue::{CyclePair, LifeLaw};
use crate::plan::Plan;
use crate::solve::life::{Coverage, LifeMeter};
use crate::solve::material::{Line, MaterialTracker, Sample, TrackerSpec};
use crate::solve::stress::VolumeOut;

/// Depth, in a, at which the shown material point lies: shallow enough to feel single asperities.
const SHOWN_DEPTH: f64 = 0.1;

/// Counts of both bodies, and the point that is shown.
#[derive(Debug, Clone, Serialize, Deserialize)]
pub(super) struct Counting {
    trackers: [MaterialTracker; 2],
    row: Vec<f32>,
    shown_depth: usize,
    /// The shown point of body 1.
    pub(super) shown: Option<Sample>,
}

impl Counting {
    /// Trackers across the whole domain of `grid`; `depths` of the slice (empty: pressure alone).
    pub(super) fn new(grid: &Grid, depths: &[f64], exponent: f64) -> Self {
        let x_last = grid.x_min + (grid.nx - 1) as f64 * grid.dx;
        let shown_depth = depths.iter().take_while(|&&z| z < SHOWN_DEPTH).count();
        let shown_depth = shown_depth.min(depths.len().saturating_sub(1));
        let mut spec = TrackerSpec::new((grid.x_min, x_last), depths.len(), exponent);
        spec.shown_depth = shown_depth;
        Self {
            trackers: [MaterialTracker::new(spec), MaterialTracker::new(spec)],
            row: vec![0.0; grid.nx],
            shown_depth,
            shown: None,
        }
    }

    /// Makes the room again that a copy or a file does not keep.
    pub(super) fn make_room(&mut self) {
        for tracker in &mut self.trackers {
            tracker.make_room();
        }
    }

    /// Whether the counts were made on `grid`, and nothing in them points astray.
    pub(super) fn fits(&self, grid: &Grid) -> bool {
        self.row.len() == grid.nx && self.trackers.iter().all(MaterialTracker::is_sound)
    }

    /// Forgets all counts.
    pub(super) fn restart(&mut self) {
        for tracker in &mut self.trackers {
            tracker.restart();
        }
    }

    /// Moves the points by `travel` (in a) and samples the line y = 0.
    pub(super) fn step(
        &mut self,
        grid: &Grid,
        travel: [f64; 2],
        pressure: &[f64],
        tau_xz: Option<&[f32]>,
    ) {
        let axis = grid.axis_row() * grid.nx;
        for (to, &from) in self.row.iter_mut().zip(&pressure[axis..axis + grid.nx]) {
            *to = from as f32;
        }
        let line = Line {
            x_first: grid.x_min,
            dx: grid.dx,
            pressure: &self.row,
            tau_xz,
        };
        for (tracker, travel) in self.trackers.iter_mut().zip(travel) {
            tracker.step(travel, &line);
        }
        self.shown = Some(self.trackers[0].shown(&line));
    }

    /// Index of the depth at which the shown point lies.
    pub(super) fn shown_depth(&self) -> usize {
        self.shown_depth
    }

    /// Mean counted cycles of a crossing, both bodies.
    pub(super) fn counted(&self) -> [Option<f64>; 2] {
        [0, 1].map(|body: usize| {
            self.trackers[body]
                .pressure_cycles()
                .map(|tally| tally.count)
        })
    }
}

/// n of both bodies by formula; `None` where a body stands.
pub(super) fn contacts(plan: &Plan, u_m_s: f64, s: f64) -> [Option<f64>; 2] {
    let kinematics = Kinematics::from_slide_roll(u_m_s, s, 2.0 * plan.hertz.a_m);
    [(BodyId::One, 1), (BodyId::Two, 0)].map(|(body, mate): (BodyId, usize)| {
        let crests = plan.waves[mate].map_or(0.0, |wave| wave.crests_per_m);
        kinematics.contacts(body, crests).per_cycle()
    })
}

/// The life meter, once there is a reference.
#[derive(Debug, Clone, Serialize, Deserialize)]
pub(super) struct LifeStage {
    law: LifeLaw,
    survival: f64,
    period: f64,
    capacity: usize,
    ln_reference: f64,
    meter: Option<LifeMeter>,
}

impl LifeStage {
    /// A meter over a way of `period` (in a), for lives at probability `survival`.
    pub(super) fn new(law: LifeLaw, survival: f64, period: f64, capacity: usize) -> Self {
        Self {
            law,
            survival,
            period,
            capacity,
            ln_reference: 0.0,
            meter: None,
        }
    }

    /// m = c e.
    pub(super) fn exponent(&self) -> f64 {
        self.law.integral_exponent()
    }

    /// Life at the scene's probability of survival over that at 50 %. The relative life is the same at
    /// any one probability.
    pub(super) fn survival_ratio(&self) -> f64 {
        self.law.survival_ratio(self.survival, 0.5)
    }

    /// Takes the reference's integral.
    pub(super) fn set_reference(&mut self, reference: &VolumeOut) {
        self.ln_reference = reference.normal.ln;
        let meter = LifeMeter::new(self.law, self.ln_reference, self.period, self.capacity);
        self.meter = Some(meter);
    }

    /// Makes the room again that a copy or a file does not keep.
    pub(super) fn make_room(&mut self) {
        if let Some(meter) = &mut self.meter {
            meter.make_room();
        }
    }

    /// Takes the mean over a way of `period` (in a) from now on.
    pub(super) fn set_period(&mut self, period: f64) {
        self.period = period;
        if let Some(meter) = &mut self.meter {
            meter.set_period(period);
        }
    }

    /// Forgets the phases seen: they belong to other conditions. The mean is over a way of `period` (in a).
    pub(super) fn restart(&mut self, period: f64) {
        self.period = period;
        if let Some(meter) = &mut self.meter {
            meter.restart(self.period);
        }
    }

    /// Takes the integrals that stand for a `way` (in a).
    pub(super) fn push(&mut self, way: f64, volume: &VolumeOut) {
        if let Some(meter) = &mut self.meter {
            meter.push(way, volume);
        }
    }

    /// The estimate for the contacts `n` of both bodies and the relative error of stress.
    pub(super) fn estimate(&self, n: [Option<f64>; 2], stress_error: f64) -> Option<LifeEstimate> {
        let n = CyclePair {
            reference: 1.0,
            scene: n.into_iter().flatten().fold(1.0, f64::max),
        };
        let now = self.meter.as_ref()?.now(n, stress_error)?;
        Some(LifeEstimate {
            i_ref: self.ln_reference.exp(),
            i_mean: now.ln_mean.exp(),
            phases: now.samples,
            cycle_factor: now.factors.cycle,
            stress_factor: now.factors.stress,
            peak_factor: now.factors.peak,
            traction_factor: now.factors.traction,
            life_relative: now.factors.relative,
            life_relative_low: now.band.0,
            life_relative_high: now.band.1,
            settled: now.coverage == Coverage::Settled,
        })
    }
}
