//! From Hertz to the developed rough contact.

use super::watching::measure_state;
use crate::math::grid::refined_nodes;
use crate::sim::heat_stage::HeatStage;
use crate::sim::measure::Measured;
use crate::sim::sim_plan::SimPlan;
use crate::sim::state::Phase;
use crate::sim::work::Work;
use crate::sim::{Knob, MeshErrors, State};

/// What a coarser grid's value is off a finer one's; all of it, where that is nothing: bodies that touch.
fn off(coarser: f64, finer: f64) -> f64 {
    if finer > 0.0 {
        (coarser / finer - 1.0).abs()
    } else {
        1.0
    }
}

/// Errors by the mesh, from the smooth contact on two grids.
pub(super) fn mesh_errors(
    plan: &SimPlan,
    coarser: Option<Measured>,
    finer: &Measured,
) -> Option<MeshErrors> {
    coarser.map(|coarser| MeshErrors {
        h_central: off(coarser.h_central, finer.h_central),
        h_min: off(coarser.h_min, finer.h_min),
        p_max: off(coarser.p_max, finer.p_max) + plan.stress_error([1.0; 2], 1.0),
    })
}

/// The next finer grid, or the reference and the development.
pub(super) fn refine_or_develop(plan: &SimPlan, state: &mut State, work: &mut Work) {
    let nx = work.solver.grid.nx;
    if nx < plan.decided.domain.nodes {
        let next = refined_nodes(nx);
        state.coarser = Some(measure_state(plan, state, work));
        let grid = plan.grid(next);
        state.contact = state.contact.refined(&work.solver.grid, &grid);
        state.nodes = next;
        work.solve_on(plan, next);
        state.phase = Phase::Smooth {
            left: plan.smooth_steps(next, plan.decided.has_flow()),
        };
        return;
    }
    let measured = measure_state(plan, state, work);
    state.mesh_errors = mesh_errors(plan, state.coarser, &measured);
    if plan.hands_on {
        state.reference = Some(state.contact.clone());
    }
    let base = plan.base();
    if let (Some(stress), Some(life)) = (&mut work.stress, &mut state.life) {
        let (p, q) = (&state.contact.pressure, &work.traction);
        work.pool.install(|| {
            stress.slice(p, q, 0.0);
            life.set_reference(stress, base);
            if let Some(counting) = &mut state.counting {
                counting.set_reference(stress, 1.0);
            }
        });
    }
    for knob in Knob::ALL {
        state.drive.aim(knob, state.targets.get(knob).target);
    }
    let developing = develops(state, work);
    let left = if developing {
        plan.steps_of(plan.develop())
    } else {
        0
    };
    state.motion.flush();
    if developing {
        state.motion.disturb(plan.develop());
    }
    state.phase = Phase::Develop { left };
}

/// Whether sliding, roughness or warm oil come up after the smooth contact.
pub(super) fn develops(state: &State, work: &Work) -> bool {
    let warms = work.heat.as_ref().is_some_and(HeatStage::feeds_back);
    let is_rough = |body| work.roughness.is_rough(body);
    let sliding = state.targets.get(Knob::SlideRoll).target;
    warms || is_rough(0) || is_rough(1) || sliding != 0.0
}
