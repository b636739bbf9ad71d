//! The meshes that a run climbs: from the coarsest that carries the scene's waves up to its own.
//!
//! ```text
//! 65² ── settled ──> 129² ── settled ──> 257²        start-up on the first one only; each goes on from where the passage of the
//!     life, band         life, band    life, band   one before began, so that all passages are of the same phases
//! ```
//! The last mesh is the scene's own, and what outputs get is its passage. A mesh that stalls is left out: the next one starts
//! from Hertz, as a run on it alone does.

use std::sync::Arc;

use serde::{Deserialize, Serialize};

use asperity_engine::plan::Plan;
use asperity_engine::scene::Scene;
use asperity_engine::sim::{Rung, SimError, Simulation, State, Summary, climb_distances};

use super::errors::coarser;

/// Fewest nodes per side of the first mesh, where there is a second one.
const FIRST_NODES: usize = 65;
/// Fewest nodes of the shortest wave on the first mesh.
const FIRST_WAVE_NODES: f64 = 6.0;

/// One mesh.
#[derive(Debug, Clone)]
pub struct Mesh {
    /// The scene on it.
    pub scene: Arc<Scene>,
    /// Its plan.
    pub plan: Plan,
}

/// Meshes, the coarsest first; the last is the scene's own.
#[derive(Debug, Clone)]
pub struct Ladder {
    meshes: Vec<Mesh>,
    /// What the surfaces of the first one are held back, in a.
    climb_distances: [f64; 2],
}

/// How far a run has come on its ladder: what it saves beside the simulation.
#[derive(Debug, Clone, Default, Serialize, Deserialize)]
pub struct Climb {
    /// Nodes per side of the mesh that it is on; 0: it climbs none.
    pub nodes: usize,
    /// The meshes that are done.
    pub rungs: Vec<Rung>,
    /// What the one below came to; `None`: there is none, or it stalled.
    pub below: Option<Summary>,
    /// The widest error of a settled life, in ln L, that the mesh below has said on this one.
    #[serde(default)]
    pub widest: f64,
    /// Where the passage on this one began, for the next.
    pub launch: Option<State>,
}

impl Ladder {
    /// The meshes of a run of `scene` by `plan`; one alone where the scene asks for no ladder.
    pub fn of(scene: &Arc<Scene>, plan: &Plan) -> Self {
        let mut meshes = vec![Mesh {
            scene: Arc::clone(scene),
            plan: plan.clone(),
        }];
        while scene.numerics.ladder
            && let Some(mesh) = below(&meshes[0])
        {
            meshes.insert(0, mesh);
        }
        let pairs: Vec<_> = (meshes.iter())
            .map(|mesh| (&*mesh.scene, &mesh.plan))
            .collect();
        let climb_distances = climb_distances(&pairs);
        Self {
            meshes,
            climb_distances,
        }
    }

    /// The meshes, the coarsest first.
    pub fn meshes(&self) -> &[Mesh] {
        &self.meshes
    }

    /// Whether there is more than one.
    pub fn climbs(&self) -> bool {
        self.meshes.len() > 1
    }

    /// The first mesh, with a run on it.
    pub(super) fn ground(&self, sim: &Simulation) -> Option<(Arc<Scene>, State)> {
        let mesh = self.meshes.first()?;
        Some((Arc::clone(&mesh.scene), sim.save().for_neighbour()))
    }

    /// The mesh of so many nodes per side, and the next finer one.
    pub(super) fn mesh(&self, nodes: usize) -> Option<(&Mesh, Option<&Mesh>)> {
        let at = (self.meshes.iter()).position(|mesh| mesh.plan.domain.nodes == nodes)?;
        Some((&self.meshes[at], self.meshes.get(at + 1)))
    }

    /// Nodes per side of the last.
    pub(super) fn top(&self) -> usize {
        self.meshes.last().map_or(0, |mesh| mesh.plan.domain.nodes)
    }

    /// Part of the work that is done with `done` of the present mesh's.
    pub(super) fn progress(&self, nodes: usize, done: f64) -> f64 {
        let cost = |mesh: &Mesh| mesh.plan.cost.time_s;
        let all: f64 = self.meshes.iter().map(cost).sum();
        let share = |mesh: &Mesh| match mesh.plan.domain.nodes.cmp(&nodes) {
            std::cmp::Ordering::Less => cost(mesh),
            std::cmp::Ordering::Equal => done * cost(mesh),
            std::cmp::Ordering::Greater => 0.0,
        };
        self.meshes.iter().map(share).sum::<f64>() / all.max(f64::MIN_POSITIVE)
    }

    /// The simulation on a mesh, going on from where the one below has been launched; `lower`: `None`, from Hertz.
    pub(super) fn simulation(
        &self,
        mesh: &Mesh,
        lower: Option<&State>,
        threads: usize,
    ) -> Result<Simulation, SimError> {
        let nodes = mesh.plan.domain.nodes;
        let mut sim = Simulation::new(&mesh.scene, mesh.plan.clone(), threads)?;
        if nodes != self.top() {
            sim.hand_on();
        }
        match lower {
            Some(lower) => sim.climb(lower)?,
            None if nodes == self.meshes[0].plan.domain.nodes => {
                sim.hold_back(self.climb_distances);
            }
            None => {}
        }
        Ok(sim)
    }
}

/// The mesh of half the intervals, if it carries the waves.
fn below(mesh: &Mesh) -> Option<Mesh> {
    let scene = coarser(&mesh.scene, &mesh.plan).ok()?;
    let plan = Plan::new(&scene).ok()?;
    let carries = plan.domain.nodes >= FIRST_NODES && fewest_wave_nodes(&plan) >= FIRST_WAVE_NODES;
    carries.then(|| Mesh {
        scene: Arc::new(scene),
        plan,
    })
}

/// Nodes of the shortest wave of both bodies; infinite: they are smooth.
pub(super) fn fewest_wave_nodes(plan: &Plan) -> f64 {
    let nodes = plan.waves.iter().flatten().flat_map(|wave| wave.nodes);
    nodes.fold(f64::INFINITY, f64::min)
}
