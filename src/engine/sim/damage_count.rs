//! Cycles that count by the damage they do, and the stress that goes with them.
//!
//! ```text
//! ln(1/Ps) = C N^e ∫ < D_X^e >_X dV            D_X = Σ_cycles s^c: damage of a passage of the material point X (Miner)
//!          ≈ C N^e ∫ n(z)^e < s_X^{c e} >_X dV  s_X: maximum stress that X meets, n = Σ range^c/maximum range^c
//! ```
//! *Which integral belongs to which count.* A count relative to each crossing's own maximum stress needs the mean over
//! material points of *that* stress: the swept integral times `r(z)` of [`Columns`]. The paper's n counts contacts without
//! their size, and its integral is that of an instant, the mean of snapshots. Swapped, a ripple of no height would change
//! the life: the one by n, the other by what single points are spared.
//!
//! *Unit.* N are loading cycles of the **faster** body. With S → 0 they are those of both; of a smooth contact n = 1 for
//! any S; and where a body creeps or stands (|S| → 2) nothing ends: what it suffers in that time is finite,
//! `n → f |U_2 − U_1| Z/U_fast`. A body that stands is the limit of one that creeps on, so that all its track takes turns.

use serde::{Deserialize, Serialize};

use crate::math::grid::Grid;
use crate::physics::cycles::BodyId;
use crate::saved::saved;
use crate::solve::axis::Line;
use crate::solve::columns::Columns;
use crate::solve::damage::BlockSpec;
use crate::solve::material::MaterialTracker;
use crate::solve::stress::StressLaw;

/// Distance over which crossings must have finished before their mean stands alone, where no wave is longer, a.
const LEAST_DISTANCE: f64 = 0.25;

/// Half-width within which a point meets its maximum stress, over Hertz's.
const REACH: f64 = 0.8;
/// Longest waves whose points' largest cycles make a mean: of one, 14 points of the default scene would be.
const WAVES: f64 = 3.0;
/// Bodies slower than this, over the mean speed, are not waited for.
const SLOW: f64 = 0.5;

/// Both bodies.
#[derive(Debug, Clone, Serialize, Deserialize)]
pub(super) struct DamageCount {
    bodies: [BodyCount; 2],
    /// Distance of the faster body since the last restart, a.
    fastest: f64,
    is_known: bool,
}

saved! {
    DamageCount { parts: bodies; free: fastest, is_known; }
}

#[derive(Debug, Clone, Serialize, Deserialize)]
struct BodyCount {
    columns: Columns,
    #[serde(rename = "way")]
    distance: f64,
    /// n by depth.
    cycles: Vec<f64>,
    /// ln r by law and depth.
    ln_ratios: Vec<f64>,
    /// Wavelength of its own crests, and the longest of both bodies', a.
    own: Option<f64>,
    #[serde(rename = "wanted")]
    needed: f64,
}

saved! {
    BodyCount { same: own, needed; parts: columns, cycles, ln_ratios; free: distance; }
}

impl BodyCount {
    /// Distance, a, whose points' largest cycles make a mean while the mean distance of both bodies is `mean`: of what passes in
    /// a `round` (in a, at U), of three waves at most and of one at least.
    fn points_needed(&self, round: f64, mean: f64) -> f64 {
        let passes = round * self.distance / mean;
        passes.min(WAVES * self.needed).max(self.needed)
    }
}

/// What passes through the contact in a step.
pub(super) struct Passing {
    /// Size of the contact over the scene's.
    pub size: f64,
    /// Distances of the bodies, a, after which waves of both have come together again; `None`: never.
    pub common: Option<[f64; 2]>,
    /// Distance at U, a, over which means are taken: whole common periods where there are some.
    pub round: f64,
    /// Fixed steps that make whole common periods; `None`: no number does.
    pub steps: Option<usize>,
}

impl DamageCount {
    /// On `grid` at so many `depths` by `laws`; wavelengths of both bodies' crests along x in a; blocks of both bodies over
    /// whose places damage is summed up.
    pub(super) fn new(
        grid: &Grid,
        depths: usize,
        laws: &[StressLaw],
        waves: [Option<f64>; 2],
        blocks: [Option<(BlockSpec, StressLaw)>; 2],
    ) -> Self {
        let needed = waves
            .iter()
            .flatten()
            .fold(LEAST_DISTANCE, |a, b| a.max(*b));
        let columns = |block: Option<(BlockSpec, StressLaw)>| {
            let columns = Columns::new((grid.x_min, grid.dx), grid.nx, depths, laws);
            match block {
                Some((spec, law)) => columns.with_block(spec, law),
                None => columns,
            }
        };
        let body = |body: usize| BodyCount {
            columns: columns(blocks[body]),
            distance: 0.0,
            cycles: vec![1.0; depths],
            ln_ratios: vec![0.0; laws.len() * depths],
            own: waves[body],
            needed,
        };
        Self {
            bodies: [0, 1].map(body),
            fastest: 0.0,
            is_known: false,
        }
    }

    /// Forgets all counts; the bodies have moved by `travelled` (in a).
    pub(super) fn restart(&mut self, travelled: [f64; 2]) {
        for (body, distance) in self.bodies.iter_mut().zip(travelled) {
            body.columns.restart(distance);
            body.distance = 0.0;
        }
        (self.fastest, self.is_known) = (0.0, false);
    }

    /// Moves a body's columns by `travel` (in a) below the `line`.
    pub(super) fn step(&mut self, body: BodyId, travel: f64, line: &Line, passing: &Passing) {
        let own = &mut self.bodies[body.index()];
        let common = passing.common.map(|distances| distances[body.index()]);
        own.columns.repeat_after(own.own, common);
        own.columns.step(travel, REACH * passing.size, line);
        own.distance += travel.abs();
    }

    /// After both bodies' steps: n of now, with the cycles of `trackers`; means are over `round` (in a, at U).
    pub(super) fn take(&mut self, travel: [f64; 2], round: f64, trackers: &[MaterialTracker; 2]) {
        self.fastest += travel[0].abs().max(travel[1].abs());
        self.is_known = true;
        let mean = self.mean_distance();
        for (body, tracker) in self.bodies.iter_mut().zip(trackers) {
            let distances = (body.distance, self.fastest);
            let share = tracker.finished() / body.points_needed(round, mean);
            self.is_known &= tracker.damage_cycles(distances, share.min(1.0), &mut body.cycles);
        }
    }

    /// r of now.
    pub(super) fn weigh(&mut self) {
        for body in &mut self.bodies {
            let BodyCount {
                columns, ln_ratios, ..
            } = body;
            columns.ln_ratios(body.own, body.needed, ln_ratios);
        }
    }

    /// Part of a `round` (in a, at U) of both bodies' surfaces that has crossed the contact, columns and, of what makes their
    /// mean, points; of slow ones a quarter of it does, and of those that creep none is waited for.
    pub(super) fn covers(&self, round: f64, trackers: &[MaterialTracker; 2]) -> f64 {
        let mean = self.mean_distance();
        let part = |(body, tracker): (&BodyCount, &MaterialTracker)| {
            let speed = body.distance / mean;
            let needed = round * speed * ((speed / SLOW).min(1.0)).powi(2);
            let creeps = speed < 0.5 * SLOW;
            if creeps {
                f64::INFINITY
            } else {
                let columns = body.columns.finished() / needed.max(f64::MIN_POSITIVE);
                let points = needed.min(body.points_needed(round, mean));
                columns.min(tracker.finished() / points.max(f64::MIN_POSITIVE))
            }
        };
        let bodies = self.bodies.iter().zip(trackers).map(part);
        bodies.fold(f64::INFINITY, f64::min)
    }

    fn mean_distance(&self) -> f64 {
        let sum = self.bodies[0].distance + self.bodies[1].distance;
        (0.5 * sum).max(f64::MIN_POSITIVE)
    }

    /// n by depth of a body; `None` before anything moved.
    pub(super) fn cycles(&self, body: BodyId) -> Option<&[f64]> {
        self.is_known
            .then_some(&self.bodies[body.index()].cycles[..])
    }

    /// Damage of a loading cycle of a body's own by place and depth, over that of a point whose greatest stress is `unit`
    /// (p_h), into `out`, `[column · depths + k]`: n(z) < law(s_X) >/law(unit). A place that nothing has crossed keeps what it
    /// has. False where it is not known.
    pub(super) fn damage_by_place(&self, body: BodyId, unit: f64, out: &mut [f64]) -> bool {
        let own = &self.bodies[body.index()];
        let (Some(law), true) = (own.columns.block_law(), self.is_known) else {
            return false;
        };
        let whole = law.of(unit as f32);
        if whole <= 0.0 || own.distance <= 0.0 {
            return false;
        }
        let turns = self.fastest / own.distance;
        let depths = own.cycles.len();
        for (at, out) in out.iter_mut().enumerate() {
            if let Some(mean) = own.columns.block_damage(at / depths, at % depths) {
                *out = own.cycles[at % depths] * turns * mean / whole;
            }
        }
        true
    }

    /// ln r by depth of a body by a law.
    pub(super) fn ln_ratios(&self, body: BodyId, law: usize) -> &[f64] {
        let body = &self.bodies[body.index()];
        let depths = body.cycles.len();
        &body.ln_ratios[law * depths..][..depths]
    }
}
