//! What a restart needs. Everything else of a [`super::Simulation`] follows from it and from the scene, or counts work.
//!
//! ```text
//! Simulation = SimPlan (from the scene) + State (saved) + Work (made again at any time) + Stats (counters)
//! ```
//! To save is to copy the state, to restore is to assign it after a check. A run that goes on from a saved state equals
//! the uninterrupted one bit for bit, in every field of every frame (`tests/records/restart.rs`, `restart_matrix.rs`).

use serde::{Deserialize, Serialize};

use super::counting::Counting;
use super::counting_spec::counting_spec;
use super::drive::Drive;
use super::fatigue_stage::LifeStage;
use super::heat_stage::{HeatStage, Warmth};
use super::measure::Measured;
use super::motion::Travel;
use super::orbit::Orbit;
use super::pace::Pace;
use super::pits::Pits;
use super::sim_plan::SimPlan;
use super::smooth::Smooth;
use super::stress_stage::StressStage;
use super::totals::Totals;
use super::work::Work;
use super::worn::{MOST_JUMPS, Worn, ring};
use super::yielded::Yielded;
use super::{AgePoint, Knob, MeshErrors, Metrics, Stage};
use crate::math::grid::Grid;
use crate::saved::saved;
use crate::scene::{Scene, Wear};
use crate::solve::march::ContactState;

/// Where the run is.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
pub(super) enum Phase {
    /// Smooth, with this many steps to go on the present grid.
    Smooth { left: u64 },
    /// In the wake of a neighbour: this many long steps, then so many of the usual length.
    Settle {
        #[serde(rename = "coarse")]
        long: u64,
        #[serde(rename = "fine")]
        usual: u64,
    },
    /// Sliding and roughness come up.
    Develop { left: u64 },
    /// The passage.
    Passage,
}

impl Phase {
    /// Whether the slice belongs to the present step: the smooth contact's is taken once, and while a contact
    /// settles in the wake of a neighbour nobody looks.
    pub(super) fn has_stress(self) -> bool {
        match self {
            Self::Smooth { .. } | Self::Settle { .. } => false,
            Self::Develop { .. } | Self::Passage => true,
        }
    }
}

/// State of a simulation; opaque, made by [`super::Simulation::save`]. `serde(rename)` here and in what it holds: the names
/// that files have.
#[derive(Debug, Clone, Serialize, Deserialize)]
pub struct State {
    /// Nodes per side of the grid that the contact is on: the start-up climbs through several.
    pub(super) nodes: usize,
    pub(super) contact: ContactState,
    pub(super) drive: Drive,
    /// The knobs as they were set; in the smooth start-up the drive does not follow yet.
    #[serde(rename = "wanted")]
    pub(super) targets: Drive,
    pub(super) motion: Travel,
    /// What both bodies have yielded; `None`: they are elastic.
    pub(super) yielded: Option<Yielded>,
    /// What both bodies have lost by wear; `None`: nothing wears.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub(super) worn: Option<Worn>,
    /// How warm the surfaces are; `None`: nobody asks.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub(super) warmth: Option<Warmth>,
    /// What each block of passages has come to, on the axis of loading cycles.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub(super) ages: Vec<AgePoint>,
    /// Where both bodies were when they were looked at last, in a.
    pub(super) watched: [f64; 2],
    pub(super) counting: Option<Counting>,
    pub(super) life: Option<LifeStage>,
    /// Under way to the reference of now; `None`: that is known.
    pub(super) smooth: Option<Smooth>,
    /// The smooth contact that lives are relative to, for the next finer mesh; `None`: there is none, or it is not known.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub(super) reference: Option<ContactState>,
    pub(super) phase: Phase,
    pub(super) metrics: Metrics,
    pub(super) totals: Totals,
    /// The smooth contact on the last but one grid.
    pub(super) coarser: Option<Measured>,
    /// Errors by the mesh of the smooth contact at the scene's speed and load.
    pub(super) mesh_errors: Option<MeshErrors>,
    pub(super) orbit: Orbit,
    pub(super) pace: Pace,
    /// Distance at U since the start-up, in a.
    #[serde(rename = "way")]
    pub(super) distance: f64,
    /// Distance at which the next volume integral is due, in a.
    pub(super) next_volume: f64,
    pub(super) step: u64,
    pub(super) time_s: f64,
    /// Steps of the start-up: made, and in all.
    pub(super) start_up_steps: (u64, u64),
}

saved! {
    State {
        parts: motion, yielded, worn, warmth, counting, life, totals, orbit, pace;
        room: ages;
        free: nodes, contact, drive, targets, watched, smooth, reference, phase, metrics, coarser, mesh_errors, distance,
            next_volume, step, time_s, start_up_steps;
    }
    holds |_, saved| saved.distance >= 0.0 && saved.time_s >= 0.0
}

/// The knobs of a scene, at rest.
pub(super) fn drive_of(scene: &Scene) -> Drive {
    Drive::new(|knob| {
        let value = match knob {
            Knob::EntrainmentMS => knob.of(scene).abs(),
            Knob::SlideRoll
            | Knob::ForceN
            | Knob::ForceNPerM
            | Knob::Amplitude1M
            | Knob::Amplitude2M => knob.of(scene),
        };
        (value, knob.line().ramp.rate(value))
    })
}

/// Nothing worn yet.
fn worn(
    plan: &SimPlan,
    grid: &Grid,
    wear: Wear,
    repeats: [Option<f64>; 2],
    depths: Option<&[f64]>,
) -> Worn {
    let scaling = &plan.scaling;
    // Of P = 1 and a distance a, in film units.
    let unit_m = scaling.p_hertz_pa * scaling.a_m;
    let coefficients = wear.coefficients_per_pa();
    let age = plan.scene.age.map(|age| [age.cycles, age.tolerance]);
    let coefficients = coefficients.map(|k| scaling.h_from_m(k * unit_m));
    let unit = scaling.m_from_h(1.0) / scaling.a_m;
    let pits = repeats.map(|repeat| Some(Pits::new(ring(grid, repeat), depths?, unit)));
    Worn::new(grid, coefficients, repeats, age, pits)
}

impl State {
    /// Before the first step: a Hertz contact of smooth bodies in pure rolling, on the first grid.
    pub(super) fn new(plan: &SimPlan, work: &mut Work) -> Self {
        let (scene, decided) = (&plan.scene, &plan.decided);
        let nodes = plan.first_nodes();
        let fine = plan.finest();
        let film = decided.film.map_or(0.0, |film| film.central);
        let contact = work.pool.install(|| work.solver.hertz(&plan.shape, film));
        let stress = work.stress.as_ref();
        let life = stress.and_then(|stress| LifeStage::new(scene, decided, stress));
        let repeats = [0, 1].map(|body: usize| work.roughness.repeat(body));
        let pits = decided.wear.is_some_and(|wear| wear.pits);
        let counting = stress.map(|stress| {
            let heading = plan.scaling.heading;
            let mut spec = counting_spec(scene, decided, heading, stress.depth_count());
            if pits {
                spec.pits = repeats.map(|repeat| Some(ring(&fine, repeat)));
            }
            spec.laws = life.as_ref().map(|life| life.laws.clone());
            Counting::new(&fine, stress.depths(), &spec)
        });
        let targets = drive_of(scene);
        let yields = plan.hardness.is_finite();
        Self {
            nodes,
            contact,
            drive: targets.smooth(),
            targets,
            motion: Travel::new(),
            yielded: yields.then(|| Yielded::new(&fine, scene.softer(), repeats)),
            warmth: work.heat.as_ref().map(HeatStage::cold),
            ages: Vec::with_capacity(match &scene.age {
                Some(_) => MOST_JUMPS as usize + 2,
                None => 0,
            }),
            worn: scene.wear.map(|wear| {
                let depths = stress.filter(|_| pits).map(StressStage::depths);
                worn(plan, &fine, wear, repeats, depths)
            }),
            watched: [0.0; 2],
            counting,
            life,
            smooth: None,
            reference: None,
            phase: Phase::Smooth {
                left: plan.smooth_steps(nodes, decided.has_flow()),
            },
            metrics: Metrics::default(),
            totals: Totals::new(plan.most_steps()),
            coarser: None,
            mesh_errors: None,
            orbit: Orbit::new(fine.len(), decided.passage_a),
            pace: Pace::new(plan.stepping),
            distance: 0.0,
            next_volume: 0.0,
            step: 0,
            time_s: 0.0,
            start_up_steps: (0, plan.start_up_steps()),
        }
    }

    /// Without what only its own run goes on with: enough for another that starts from it.
    #[must_use]
    pub fn for_neighbour(mut self) -> Self {
        self.orbit.restart();
        self
    }

    /// Time steps since the start-up.
    pub fn passage_steps(&self) -> u64 {
        self.step
    }

    /// Distance since the start-up over `passage` (in a).
    pub(super) fn passages(&self, passage: f64) -> f64 {
        if self.step > 0 {
            self.distance / passage
        } else {
            0.0
        }
    }

    /// Part of the run that the last step belongs to.
    pub(super) fn stage(&self) -> Stage {
        if self.phase == Phase::Passage && self.step > 0 {
            Stage::Passage
        } else {
            Stage::StartUp
        }
    }

    /// How much of the start-up is done, 0 to 1.
    pub(super) fn start_up_progress(&self) -> f64 {
        let (done, all) = self.start_up_steps;
        match self.stage() {
            Stage::Passage => 1.0,
            Stage::StartUp => (done as f64 / all.max(1) as f64).min(1.0),
        }
    }

    /// Simulated time since the start-up, s.
    pub(super) fn time_of_passage_s(&self) -> f64 {
        match self.phase {
            Phase::Passage => self.time_s,
            Phase::Smooth { .. } | Phase::Settle { .. } | Phase::Develop { .. } => 0.0,
        }
    }
}
