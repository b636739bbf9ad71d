//! What steps are solved with: solvers, rough surfaces on the grid, stress engines, buffers, threads.
//!
//! None of it is remembered from step to step in a way that a result could feel: thrown away between any two steps, it leaves
//! every frame the same bit for bit (`tests/records/workspace.rs`).

use std::sync::Arc;

use rayon::{ThreadPool, ThreadPoolBuilder};

use super::SimError;
use super::heat_stage::HeatStage;
use super::measure::RowSums;
use super::roughness::Roughness;
use super::sim_plan::SimPlan;
use super::stress_stage::StressStage;
use crate::math::grid::Grid;
use crate::scene::Surface;
use crate::solve::march::Solver;
use crate::solve::stress::Purpose;

/// Workspace of a simulation.
pub(super) struct Work {
    pub(super) pool: Arc<ThreadPool>,
    pub(super) solver: Solver,
    pub(super) roughness: Roughness,
    pub(super) stress: Option<StressStage>,
    pub(super) heat: Option<HeatStage>,
    pub(super) traction: Vec<f64>,
    pub(super) row_sums: Vec<RowSums>,
    /// First guesses of a step: from a period ago, and extrapolated.
    pub(super) guesses: [Vec<f64>; 2],
    /// Of the smooth contact beside the run, while there is one.
    pub(super) smooth: Option<SmoothWork>,
}

impl Work {
    /// Made by the plan, with the solver on the grid of `nodes` nodes per side.
    ///
    /// # Errors
    /// [`SimError::Stress`] when the stress engine refuses the plan.
    pub(super) fn new(
        plan: &SimPlan,
        nodes: usize,
        pool: Arc<ThreadPool>,
    ) -> Result<Self, SimError> {
        let fine = plan.finest();
        let stress = pool.install(|| stress_stage(plan, &fine))?;
        Ok(Self {
            solver: pool.install(|| plan.solver(nodes)),
            roughness: roughness(plan, &fine),
            stress,
            heat: HeatStage::new(&plan.scene, &fine, plan.scaling.a_m),
            traction: vec![0.0; fine.len()],
            row_sums: vec![RowSums::default(); fine.ny],
            guesses: [vec![0.0; fine.len()], vec![0.0; fine.len()]],
            smooth: None,
            pool,
        })
    }

    /// Makes the solver for a grid of so many nodes per side, if it is for another one.
    pub(super) fn solve_on(&mut self, plan: &SimPlan, nodes: usize) {
        if nodes != self.solver.grid.nx {
            self.solver = self.pool.install(|| plan.solver(nodes));
        }
    }

    /// What solves the smooth contact on a grid of so many nodes per side: what there is, or made anew.
    pub(super) fn take_smooth(&mut self, plan: &SimPlan, nodes: usize) -> SmoothWork {
        let there = self.smooth.take();
        there
            .filter(|work| work.solver.grid.nx == nodes)
            .unwrap_or_else(|| self.pool.install(|| SmoothWork::new(plan, nodes)))
    }
}

/// Solver of the smooth contact beside a run.
pub(super) struct SmoothWork {
    pub(super) solver: Solver,
    pub(super) roughness: Roughness,
}

impl SmoothWork {
    fn new(plan: &SimPlan, nodes: usize) -> Self {
        let smooth = Surface::Smooth {};
        let (grid, scaling) = (plan.grid(nodes), &plan.scaling);
        Self {
            solver: plan.solver(nodes),
            roughness: Roughness::new(&grid, [&smooth, &smooth], scaling.a_m, scaling.heading),
        }
    }
}

/// `threads` workers of a simulation's own.
///
/// # Errors
/// [`SimError::Threads`] when they cannot be started.
#[cfg(not(target_arch = "wasm32"))]
pub(super) fn thread_pool(threads: usize) -> Result<Arc<ThreadPool>, SimError> {
    ThreadPoolBuilder::new()
        .num_threads(threads)
        .thread_name(|i| format!("asperity-{i}"))
        .build()
        .map(Arc::new)
        .map_err(|error| SimError::Threads {
            threads,
            reason: error.to_string(),
        })
}

/// The one thread that there is, which all simulations share.
///
/// # Errors
/// [`SimError::Threads`] when it cannot be had.
#[cfg(target_arch = "wasm32")]
pub(super) fn thread_pool(_threads: usize) -> Result<Arc<ThreadPool>, SimError> {
    use std::sync::OnceLock;
    static POOL: OnceLock<Result<Arc<ThreadPool>, String>> = OnceLock::new();
    let made = || {
        let builder = ThreadPoolBuilder::new().num_threads(1);
        let pool = builder.use_current_thread().build();
        pool.map(Arc::new).map_err(|error| error.to_string())
    };
    let pool = POOL.get_or_init(made).clone();
    pool.map_err(|reason| SimError::Threads { threads: 1, reason })
}

/// Both surfaces, with room for what flows of those that yield.
fn roughness(plan: &SimPlan, grid: &Grid) -> Roughness {
    let (scene, scaling) = (&plan.scene, &plan.scaling);
    let mut roughness = Roughness::new(grid, scene.surfaces(), scaling.a_m, scaling.heading);
    if plan.hardness.is_finite() {
        for body in [0, 1].into_iter().filter(|&body| scene.softer()[body]) {
            roughness.make_heights(grid, body);
        }
    }
    let worn = scene.wear.unwrap_or_default().coefficients_per_pa();
    for body in [0, 1].into_iter().filter(|&body| worn[body] > 0.0) {
        roughness.make_heights(grid, body);
    }
    roughness
}

fn stress_stage(plan: &SimPlan, grid: &Grid) -> Result<Option<StressStage>, SimError> {
    let scene = &plan.scene;
    let Some((asked, planned)) = scene.stress.as_ref().zip(plan.decided.stress.as_ref()) else {
        return Ok(None);
    };
    let depths = (planned.depths, planned.depth_max_m / plan.scaling.a_m);
    let poisson = [scene.body_1.poisson, scene.body_2.poisson];
    let purpose = if scene.life.is_some() {
        Purpose::Volumes
    } else {
        Purpose::Slices
    };
    StressStage::new(grid, poisson, depths, asked.measure, purpose)
        .map(Some)
        .map_err(|error| SimError::Stress(error.to_string()))
}
