//! Material points of both bodies on the line y = 0 that count cycles and collect damage.

use serde::{Deserialize, Serialize};

use super::damage_count::{DamageCount, Passing};
use super::last_round::LastRound;
use super::stress_stage::StressStage;
use super::{LifeEstimate, Metrics};
use crate::math::grid::Grid;
use crate::physics::cycles::{BodyId, Kinematics};
use crate::physics::felt::felt_where_counted;
use crate::physics::life_models::CycleProfile;
use crate::plan::Plan;
use crate::saved::saved;
use crate::scene::CycleBasis;
use crate::solve::damage::{BlockSpec, DamageMap, Pit};
use crate::solve::material::{Line, MaterialTracker, Sample, TrackerSpec};
use crate::solve::stress::StressLaw;

/// Depth, in a, at which the shown material point lies: shallow enough to feel single asperities.
const SHOWN_DEPTH: f64 = 0.1;
/// Ratio of the lives of both bodies below which neither is followed rather than the other.
const ALIKE: f64 = 1.05;
/// Half-width behind which a crossing has ended, over Hertz's: what is off the contact adds no cycle.
const BEHIND: f64 = 1.2;
/// Steps that points are moved on through known rounds at most.
const MOST_STEPS: usize = 4096;
/// How often a round of them is looked at.
const MARKS: usize = 8;
/// Columns of a damage map.
const MAP_COLUMNS: usize = 24;

/// Counts of both bodies, and the point that is shown.
#[derive(Debug, Clone, Serialize, Deserialize)]
pub(super) struct Counting {
    trackers: [MaterialTracker; 2],
    shown_depth: usize,
    shown_body: BodyId,
    /// Whether somebody chose it; else it is the one that governs.
    is_chosen: bool,
    /// The shown point.
    pub(super) shown: Option<Sample>,
    profiles: [Profile; 2],
    /// Maximum damage of one passage of the smooth contact.
    reference: f64,
    /// Size of that contact over the scene's.
    reference_size: f64,
    /// c: damage grows as its power with the size, and with it the pressure.
    exponent: f64,
    /// Cycles by their damage, where a life is asked for.
    by_damage: Option<DamageCount>,
    /// What passed last, until points have been moved on through it.
    #[serde(default)]
    last_round: LastRound,
    /// Whether points have been moved on through it.
    #[serde(default)]
    went_on: bool,
}

saved! {
    Counting {
        same: exponent;
        parts: trackers, profiles, by_damage, last_round;
        free: went_on, shown_depth, shown_body, is_chosen, shown, reference, reference_size;
    }
    holds |own, saved| saved.shown_depth < own.profiles[0].shear.len().max(1)
}

/// Cycles of a body by depth.
#[derive(Debug, Clone, Default, Serialize, Deserialize)]
struct Profile {
    /// Whether a crossing has been counted.
    is_known: bool,
    /// Cycles of signed shear.
    shear: Vec<f64>,
    /// Cycles of effective stress, each by its peak, in cycles of the maximum.
    by_peaks: Vec<f64>,
}

saved! {
    Profile { parts: shear, by_peaks; free: is_known; }
}

/// What is counted.
pub(super) struct CountingSpec {
    /// Depths of the slice; 0: pressure alone.
    pub(super) depths: usize,
    /// c.
    pub(super) exponent: f64,
    /// Blocks of both bodies for which damage is mapped: length and distance from a crest, a.
    pub(super) blocks: [Option<(f64, f64)>; 2],
    /// How life integrates stress (models of one depth: not at all); `None`: no life is asked for.
    pub(super) laws: Option<Vec<StressLaw>>,
    /// Wavelengths of both bodies' crests along x, a.
    pub(super) waves: [Option<f64>; 2],
    /// Blocks of both bodies whose pits are followed: length in a and columns; `None`: they are not.
    pub(super) pits: [Option<(f64, usize)>; 2],
    /// Fatigue limit of damage, p_h; 0: none.
    pub(super) limit: f64,
}

impl Counting {
    /// Trackers across the whole domain of `grid`, with the slice's `depths` (in a).
    pub(super) fn new(grid: &Grid, depths: &[f64], spec: &CountingSpec) -> Self {
        let x_last = grid.x_min + (grid.nx - 1) as f64 * grid.dx;
        let shown_depth = depths.iter().take_while(|&&z| z < SHOWN_DEPTH).count();
        let shown_depth = shown_depth.min(depths.len().saturating_sub(1));
        let tracker = |body: usize| {
            let track = (grid.x_min, x_last);
            let mut tracker = TrackerSpec::new(track, spec.depths, spec.exponent);
            tracker.shown_depth = shown_depth;
            if let Some((length, offset)) = spec.blocks[body] {
                let block = BlockSpec {
                    columns: MAP_COLUMNS,
                    depths: spec.depths,
                    length,
                    offset,
                };
                tracker.map = Some(block);
                tracker.points = TrackerSpec::MAP_POINTS;
            }
            MaterialTracker::new(tracker)
        };
        let law = StressLaw {
            exponent: spec.exponent,
            limit: spec.limit,
        };
        let pits = spec.pits.map(|block| {
            let (length, columns) = block?;
            let spec = BlockSpec {
                columns,
                depths: spec.depths,
                length,
                offset: 0.0,
            };
            Some((spec, law))
        });
        let profile = Profile {
            is_known: false,
            shear: vec![1.0; spec.depths],
            by_peaks: vec![1.0; spec.depths],
        };
        Self {
            trackers: [tracker(0), tracker(1)],
            shown_depth,
            shown_body: BodyId::One,
            is_chosen: false,
            shown: None,
            profiles: [profile.clone(), profile],
            reference: 1.0,
            reference_size: 1.0,
            exponent: spec.exponent,
            by_damage: (spec.laws.as_ref())
                .map(|laws| DamageCount::new(grid, spec.depths, laws, spec.waves, pits)),
            last_round: LastRound::new(grid.nx, depths.len()),
            went_on: false,
        }
    }

    /// Takes the smooth contact of `size` times the scene's: its worst point is the unit of damage.
    pub(super) fn set_reference(&mut self, stress: &StressStage, size: f64) {
        let effective = &stress.slice_in(BodyId::One).effective;
        let peak = effective.iter().fold(0.0, |a: f32, b| a.max(*b));
        self.reference = f64::from(peak).powf(self.exponent);
        self.reference_size = size;
    }

    /// Takes over the unit of damage of counts of the same contact, and which body is followed.
    pub(super) fn take_reference(&mut self, other: &Self) {
        (self.reference, self.reference_size) = (other.reference, other.reference_size);
        self.is_chosen = other.is_chosen;
        if other.shown_body != self.shown_body {
            self.show(other.shown_body, None, self.shown_depth);
        }
    }

    /// Forgets all counts; the bodies have moved by `travelled` (in a).
    pub(super) fn restart(&mut self, travelled: [f64; 2]) {
        for (tracker, distance) in self.trackers.iter_mut().zip(travelled) {
            tracker.restart(distance);
        }
        for profile in &mut self.profiles {
            profile.is_known = false;
        }
        if let Some(by_damage) = &mut self.by_damage {
            by_damage.restart(travelled);
        }
        self.last_round.restart();
        self.went_on = false;
    }

    /// Moves the points by `travel` (in a) and samples the line y = 0 below the surface loaded last.
    pub(super) fn step(
        &mut self,
        grid: &Grid,
        travel: [f64; 2],
        stress: &StressStage,
        passing: &Passing,
    ) {
        let lines = BodyId::BOTH.map(|body| {
            let slice = stress.slice_in(body);
            Line {
                x_first: grid.x_min,
                dx: grid.dx,
                pressure: stress.pressure_on_axis(grid),
                tau_xz: Some(&slice.sxz[..]),
                effective: Some(&slice.effective[..]),
            }
        });
        self.pass(travel, &lines, passing);
        if self.by_damage.is_some() && !self.went_on {
            self.last_round.push(passing.steps, travel, &lines);
        }
        let shown = self.shown_body.index();
        self.shown = Some(self.trackers[shown].shown(&lines[shown]));
    }

    /// Whether a whole round has been seen that the points have not been moved on through; once until the next restart.
    pub(super) fn may_go_on(&self) -> bool {
        !self.went_on && self.last_round.is_whole()
    }

    /// Moves the points on through the last round, which those to come are like, until those of a round have crossed; `marked`
    /// sees the counts [`MARKS`] times a round.
    pub(super) fn go_on(&mut self, grid: &Grid, passing: &Passing, mut marked: impl FnMut(&Self)) {
        self.went_on = true;
        let shown = self.shown_body.index();
        let at = self.shown.map(|shown| shown.x);
        let last = std::mem::take(&mut self.last_round);
        let every = last.len().div_ceil(MARKS);
        let mut left = MOST_STEPS;
        while left > 0 && self.covers(passing.round) < 1.0 - 1e-9 {
            for (n, (travel, lines)) in last.steps((grid.x_min, grid.dx)).enumerate() {
                self.pass(travel, &lines, passing);
                left = left.saturating_sub(1);
                if (n + 1).is_multiple_of(every) {
                    self.weigh();
                    marked(self);
                }
            }
        }
        self.last_round = last;
        self.last_round.restart();
        self.trackers[shown].look_at(at, self.shown_depth);
        self.weigh();
        marked(self);
    }

    /// What crossings that have ended make of the swept integral, as of now.
    pub(super) fn weigh(&mut self) {
        if let Some(by_damage) = &mut self.by_damage {
            by_damage.weigh();
        }
    }

    /// Moves the points by `travel` (in a) below such lines.
    fn pass(&mut self, travel: [f64; 2], lines: &[Line; 2], passing: &Passing) {
        for body in BodyId::BOTH {
            let i = body.index();
            let before = self.trackers[i].crossings();
            self.trackers[i].step(travel[i], BEHIND * passing.size, &lines[i]);
            if let Some(by_damage) = &mut self.by_damage {
                by_damage.step(body, travel[i], &lines[i], passing);
            }
            if self.trackers[i].crossings() == before {
                continue;
            }
            let profile = &mut self.profiles[i];
            let (shear, by_peaks) = (&mut profile.shear, &mut profile.by_peaks);
            profile.is_known = self.trackers[i].cycles_by_depth(shear, by_peaks);
        }
        if let Some(by_damage) = &mut self.by_damage {
            by_damage.take(travel, passing.round, &self.trackers);
        }
    }

    /// Shows the point of `body` nearest to `x` (in a; `None`: the same point) at depth `k`.
    pub(super) fn look_at(&mut self, body: BodyId, x: Option<f64>, k: usize) {
        self.is_chosen = true;
        self.show(body, x, k);
    }

    fn show(&mut self, body: BodyId, x: Option<f64>, k: usize) {
        self.shown_depth = k;
        self.shown_body = body;
        self.trackers[body.index()].look_at(x, k);
    }

    /// Shows a point of this body from the beginning on, unless somebody has chosen one.
    pub(super) fn begin_with(&mut self, body: BodyId) {
        if !self.is_chosen && body != self.shown_body {
            self.show(body, None, self.shown_depth);
        }
    }

    /// Shows a point of the body that governs a life, unless somebody has chosen one. Where both live nearly alike, the one that
    /// is shown stays.
    pub(super) fn look_at_governing(&mut self, life: &LifeEstimate) {
        let Some(body) = BodyId::of(life.detail.body) else {
            return;
        };
        let shown = life.detail.life_body[self.shown_body.index()];
        let is_clear = shown.is_none_or(|shown| shown > ALIKE * life.life_relative);
        if !self.is_chosen && life.settled && body != self.shown_body && is_clear {
            self.show(body, None, self.shown_depth);
        }
    }

    /// Body of the shown point.
    pub(super) fn shown_body(&self) -> BodyId {
        self.shown_body
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
                .map(|cycles| cycles.count)
        })
    }

    /// Cycles by depth on a counted basis; `None` for the others and until a crossing has been counted.
    pub(super) fn profile(&self, body: BodyId, basis: CycleBasis) -> Option<CycleProfile<'_>> {
        let cycles = match basis {
            CycleBasis::Damage => self.by_damage.as_ref()?.cycles(body),
            CycleBasis::Global => None,
            CycleBasis::Peaks => {
                let profile = &self.profiles[body.index()];
                profile.is_known.then_some(&profile.by_peaks[..])
            }
        };
        cycles.map(CycleProfile::Counted)
    }

    /// Part of a `period` (in a, at U) over which crossings by damage have finished; 1 where they are not followed.
    pub(super) fn covers(&self, period: f64) -> f64 {
        let by_damage = self.by_damage.as_ref();
        by_damage.map_or(1.0, |by_damage| by_damage.covers(period, &self.trackers))
    }

    /// ln of what the swept integral of a law becomes as the mean over material points, by depth, when it was weighed last.
    pub(super) fn ln_ratios(&self, body: BodyId, law: usize) -> Option<&[f64]> {
        Some(self.by_damage.as_ref()?.ln_ratios(body, law))
    }

    /// Counts of signed shear by depth; `None` until a crossing has been counted.
    pub(super) fn shear_counts(&self, body: BodyId) -> Option<&[f64]> {
        let profile = &self.profiles[body.index()];
        profile.is_known.then_some(&profile.shear[..])
    }

    /// Damage map of a body, and the damage of the worst point of the smooth contact of `size` times the scene's.
    pub(super) fn map(&self, body: BodyId, size: f64) -> Option<(&DamageMap, f64)> {
        let growth = (size / self.reference_size).powf(self.exponent);
        let unit = self.reference * growth;
        let map = self.trackers[body.index()].map()?;
        (unit > 0.0).then_some((map, unit))
    }

    /// Whether every column of the damage maps has been crossed.
    pub(super) fn has_whole_maps(&self) -> bool {
        let maps = self.trackers.iter().filter_map(MaterialTracker::map);
        maps.into_iter()
            .all(|map| map.filled() == map.spec().columns)
    }

    /// Damage of a loading cycle of a body's own by place and depth, over that of the worst point of the smooth contact of
    /// `size` times the scene's, into `out`; false where it is not known.
    pub(super) fn damage_by_place(&self, body: BodyId, size: f64, out: &mut [f64]) -> bool {
        let worst = self.reference.powf(self.exponent.recip()) * size / self.reference_size;
        (self.by_damage.as_ref()).is_some_and(|count| count.damage_by_place(body, worst, out))
    }

    /// Where the pit of a body starts, with its damage over that of the smooth contact.
    pub(super) fn pit(&self, body: BodyId, size: f64) -> Option<Pit> {
        let (map, unit) = self.map(body, size)?;
        let pit = map.pit()?;
        Some(Pit {
            damage: pit.damage / unit,
            ..pit
        })
    }
}

/// n of both bodies by formula over the zone 2a of the present load, with the amplitudes that they now have
/// (none, no crests); `None` where a body stands.
pub(super) fn contacts(
    plan: &Plan,
    a_m: f64,
    u_m_s: f64,
    s: f64,
    amplitudes_m: [f64; 2],
) -> [Option<f64>; 2] {
    let kinematics = Kinematics::from_slide_roll(u_m_s, s, 2.0 * a_m);
    BodyId::BOTH.map(|body| {
        let mate = body.mate().index();
        let crests = plan.waves[mate]
            .filter(|_| amplitudes_m[mate] != 0.0)
            .map_or(0.0, |wave| wave.crests_per_m);
        kinematics.contacts(body, crests).per_cycle()
    })
}

/// How much a body of a contact of `size` times the scene's feels of the crests of the other, 0 to 1: body 1, body 2.
pub(super) fn felt_at_points(plan: &Plan, size: f64, m: &Metrics) -> [f64; 2] {
    // The pressure grows as the half-width does.
    let p_hertz_pa = plan.hertz.p_max_pa * size;
    let amplitudes_m = [m.amplitude_1_m, m.amplitude_2_m];
    let by_count = [
        (m.n_body_1, m.n_counted_body_1),
        (m.n_body_2, m.n_counted_body_2),
    ];
    BodyId::BOTH.map(|body| {
        let mate = body.mate().index();
        let by_pressure =
            plan.waves[mate].map_or(1.0, |wave| wave.felt(amplitudes_m[mate], p_hertz_pa));
        let (n, counted) = by_count[body.index()];
        let by_count = n.zip(counted);
        by_pressure * by_count.map_or(1.0, |(n, counted)| felt_where_counted(n, counted))
    })
}
