//! Steps of the smooth contact beside the run ([`Smooth`]), and what becomes of it.

use super::present::{conditions, has_reference_of_now};
use super::rung::{measure_smooth, smooth_drive};
use super::start_up::mesh_errors;
use super::watching::slice_again;
use crate::math::grid::refined_nodes;
use crate::sim::motion::Travel;
use crate::sim::pace::Stepping;
use crate::sim::sim_plan::SimPlan;
use crate::sim::smooth::{LoadAndSpeed, Smooth};
use crate::sim::state::Phase;
use crate::sim::stepping::Mover;
use crate::sim::work::Work;
use crate::sim::{State, Stats, StepError};

/// One step of the smooth contact, where the reference is another one's.
///
/// # Errors
/// [`StepError`] as of the run's own steps.
pub(super) fn step_smooth(
    plan: &SimPlan,
    state: &mut State,
    work: &mut Work,
    stats: &mut Stats,
) -> Result<(), StepError> {
    let mut smooth = match state.smooth.take() {
        Some(smooth) => smooth,
        None if has_reference_of_now(plan, state) => return Ok(()),
        None => begin_smooth(plan, state, work),
    };
    if smooth.left == 0 {
        if smooth.nodes == plan.decided.domain.nodes {
            work.smooth = None;
            measure_reference(plan, state, work, stats, &smooth);
            if plan.hands_on {
                state.reference = Some(smooth.contact);
            }
            return Ok(());
        }
        refine_smooth(plan, &mut smooth);
    }
    let made = advance_smooth(plan, state.time_s, work, stats, &mut smooth);
    smooth.left -= u64::from(made.is_ok());
    state.smooth = Some(smooth);
    made
}

/// A Hertz contact of the load that the knobs go to, on the coarsest grid.
fn begin_smooth(plan: &SimPlan, state: &State, work: &mut Work) -> Smooth {
    let at = conditions(plan, state);
    let nodes = plan.first_nodes();
    let size = plan.scaling.size_ratio(at.load / plan.decided.force_n);
    let film = plan.film_at(at);
    let central = film.map_or(0.0, |film| plan.scaling.h_from_m(film.central_m));
    let drive = smooth_drive(plan, state, at);
    let mut smooth = work.take_smooth(plan, nodes);
    let hertz = || smooth.solver.hertz_of_size(&plan.shape, size, central);
    let contact = work.pool.install(hertz);
    work.smooth = Some(smooth);
    Smooth {
        nodes,
        contact,
        drive,
        motion: Travel::new(),
        at,
        left: plan.smooth_steps(nodes, flows_at(plan, at)),
    }
}

fn flows_at(plan: &SimPlan, at: LoadAndSpeed) -> bool {
    plan.film_at(at).is_some_and(|film| film.flows())
}

fn refine_smooth(plan: &SimPlan, smooth: &mut Smooth) {
    let grid = |nodes| plan.grid(nodes);
    let next = refined_nodes(smooth.nodes);
    smooth.contact = smooth.contact.refined(&grid(smooth.nodes), &grid(next));
    smooth.nodes = next;
    smooth.left = plan.smooth_steps(next, flows_at(plan, smooth.at));
}

fn advance_smooth(
    plan: &SimPlan,
    t_s: f64,
    work: &mut Work,
    stats: &mut Stats,
    smooth: &mut Smooth,
) -> Result<(), StepError> {
    let mut with = work.take_smooth(plan, smooth.nodes);
    let usual = plan.stepping.usual();
    let before = with.solver.transforms();
    let attempted = work.pool.install(|| {
        Mover {
            state: &mut smooth.contact,
            solver: &mut with.solver,
            roughness: &mut with.roughness,
            drive: &mut smooth.drive,
            motion: &mut smooth.motion,
            plan,
            stepping: Stepping::Fixed(usual),
            given: None,
            yielded: None,
            worn: None,
            heated: None,
        }
        .advance(usual)
    });
    let made = with.solver.transforms() - before;
    work.smooth = Some(with);
    stats.add(&attempted, made);
    attempted.fatal(t_s).map_or(Ok(()), Err)
}

/// Its integrals become the reference of now, of a run that has climbed to this mesh its own; the slices below the run's
/// own contact are made again.
fn measure_reference(
    plan: &SimPlan,
    state: &mut State,
    work: &mut Work,
    stats: &mut Stats,
    smooth: &Smooth,
) {
    let size = plan
        .scaling
        .size_ratio(smooth.at.load / plan.decided.force_n);
    let climbs = matches!(state.phase, Phase::Settle { .. });
    if climbs {
        let measured = measure_smooth(plan, smooth.nodes, &smooth.contact, smooth.at);
        state.mesh_errors = mesh_errors(plan, state.coarser, &measured);
    }
    if let (Some(stress), Some(life)) = (&mut work.stress, &mut state.life) {
        work.pool.install(|| {
            stress.slice(&smooth.contact.pressure, &[], 0.0);
            if climbs {
                life.raise_references(stress, size, smooth.at);
            } else {
                life.move_reference(stress, size, smooth.at);
            }
            stats.stress_volumes += u64::from(life.integrates());
            if let Some(counting) = &mut state.counting {
                counting.set_reference(stress, size);
            }
        });
    }
    slice_again(plan, state, work);
}
