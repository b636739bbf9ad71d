//! A run that goes on from a coarser mesh of the same scene instead of from Hertz: one rung of a ladder of meshes.
//!
//! ```text
//! contact     pressure, film and masses of the coarser run, interpolated; H0 and the places of both bodies as they are
//! skins       what has flowed and what is worn, at the new columns; the damage of the nearest column
//! reference   the smooth contact, interpolated and made steady on this mesh: first of all, while the rough one waits
//! settle      1.1 a at U in usual steps, a steady contact as long as a start-up's development: what the interpolation
//!             disturbed leaves the contact, then the passage begins
//! ```
//! Interpolation by cubics leaves the load, a sum by the trapezoidal rule, as it is, and the past goes along: the first
//! step is of second order, too. Averages, counts and the search for an orbit begin anew. Over settling of 0.6 to 1.6 a lives of five
//! presets are within 1.3 % of each other, and central films within 1e-4. The base of the lives moves with the reference: what a load costs is a ratio of two smooth
//! contacts, and both are of one mesh.
//!
//! The passage of the last rung begins with both surfaces where the scene says they are at t = 0: the first rung is held back
//! by what the settling of the others takes ([`climb_distances`]).

use super::follow::SettlingSteps;
use super::present::conditions;
use super::watching::{publish, see_again};
use crate::math::grid::refined_nodes;
use crate::physics::cycles::speed_ratios;
use crate::plan::{Plan, TimeDependence};
use crate::saved::Saved as _;
use crate::scene::Scene;
use crate::sim::drive::Drive;
use crate::sim::measure::{Fields, Measured, RowSums, measure};
use crate::sim::motion::Travel;
use crate::sim::sim_plan::SimPlan;
use crate::sim::smooth::{LoadAndSpeed, Smooth};
use crate::sim::state::Phase;
use crate::sim::stepping::Attempted;
use crate::sim::work::Work;
use crate::sim::{Knob, SimError, State};
use crate::solve::march::ContactState;

/// Distance at U, in a, in which what the interpolation disturbed leaves the inner contact.
const FLUSH: f64 = 1.1;

/// Starts from `lower`, a run of the same scene on half the intervals.
///
/// # Errors
/// [`SimError::State`] when it is none, or when its passage has not begun; the simulation is as it was.
pub(super) fn climb(
    plan: &SimPlan,
    state: &mut State,
    work: &mut Work,
    lower: &State,
) -> Result<(), SimError> {
    let reference = fitting(plan, work, lower)?;
    let (coarse, fine) = (plan.grid(lower.nodes), plan.finest());
    work.solve_on(plan, fine.nx);
    state.nodes = fine.nx;
    state.contact = lower.contact.refined(&coarse, &fine);
    state.drive.clone_from(&lower.drive);
    state.targets.clone_from(&lower.targets);
    state.motion = Travel::new();
    state.motion.travelled = lower.motion.travelled;
    if let (Some(own), Some(other)) = (&mut state.yielded, &lower.yielded) {
        own.take_over(&fine, other, &coarse);
    }
    if let (Some(own), Some(other)) = (&mut state.worn, &lower.worn) {
        own.take_over(other);
        state.ages.clone_from(&lower.ages);
    }
    let at =
        (lower.life.as_ref()).map_or_else(|| conditions(plan, state), |life| life.reference_at);
    if let (Some(own), Some(other)) = (&mut state.life, &lower.life) {
        own.take_references(other);
    }
    if let (Some(own), Some(other)) = (&mut state.counting, &lower.counting) {
        own.take_reference(other);
    }
    state.coarser = Some(measure_smooth(plan, lower.nodes, reference, at));
    state.smooth = Some(Smooth {
        nodes: fine.nx,
        contact: reference.refined(&coarse, &fine),
        drive: smooth_drive(plan, state, at),
        motion: Travel::new(),
        at,
        left: plan.smooth_steps(fine.nx, plan.decided.has_flow()),
    });
    let settling = settling(plan, state.drive.walk_left());
    state.motion.disturb(settling.length());
    state.phase = settling.phase();
    let smooth_steps = state.smooth.as_ref().map_or(0, |smooth| smooth.left);
    state.start_up_steps = (0, smooth_steps + settling.steps());
    state.watched = state.motion.travelled;
    let measured = see_again(plan, state, work);
    publish(
        plan,
        state,
        work,
        &Attempted::held(&lower.metrics, 0.0),
        &measured,
    );
    Ok(())
}

/// The smooth contact of a run that may be gone on from.
fn fitting<'a>(
    plan: &SimPlan,
    work: &Work,
    lower: &'a State,
) -> Result<&'a ContactState, SimError> {
    let refuse = |what: &str| Err(SimError::State(what.to_owned()));
    if refined_nodes(lower.nodes) != plan.decided.domain.nodes {
        return refuse("its mesh has not half the intervals of this one");
    }
    let Some(reference) = lower
        .reference
        .as_ref()
        .filter(|_| lower.phase == Phase::Passage)
    else {
        return refuse("its passage has not begun");
    };
    let empty = ContactState::empty(plan.grid(lower.nodes).len(), work.solver.is_unlike());
    for contact in [&lower.contact, reference] {
        if empty.check(contact).is_err() {
            return refuse("its contact is not of this scene");
        }
    }
    Ok(reference)
}

/// Knobs of the smooth contact at such a load and speed.
pub(super) fn smooth_drive(plan: &SimPlan, state: &State, at: LoadAndSpeed) -> Drive {
    let mut drive = state.targets.smooth();
    drive.jump(plan.scaling.load_knob(), at.load);
    drive.jump(Knob::EntrainmentMS, at.speed_m_s);
    drive
}

/// Scalars of a smooth contact on the grid of so many nodes per side.
pub(super) fn measure_smooth(
    plan: &SimPlan,
    nodes: usize,
    contact: &ContactState,
    at: LoadAndSpeed,
) -> Measured {
    let grid = plan.grid(nodes);
    let size = plan.scaling.size_ratio(at.load / plan.decided.force_n);
    let fields = Fields {
        grid: &grid,
        law: &plan.law,
        p: &contact.pressure,
        h: &contact.film,
        shift: &[],
        ellipse: (size, size * plan.scaling.b_over_a),
    };
    let (mut traction, mut rows) = (vec![0.0; grid.len()], vec![RowSums::default(); grid.ny]);
    measure(&fields, &mut traction, &mut rows)
}

/// Distances, in a, that both surfaces come while runs by these plans settle, each after having climbed from the one before:
/// by so much the first must be held back for t = 0 of the last to find them as the scene says.
pub fn climb_distances(rungs: &[(&Scene, &Plan)]) -> [f64; 2] {
    let settling = rungs.iter().skip(1).map(|(scene, plan)| {
        let plan = SimPlan::new(scene, (*plan).clone());
        settling(&plan, 0.0).length()
    });
    let (all, slide_roll) = (
        settling.sum::<f64>(),
        rungs
            .first()
            .map_or(0.0, |(scene, _)| scene.motion.slide_roll),
    );
    speed_ratios(slide_roll).map(|ratio| ratio * all)
}

/// Steps of settling once knobs have walked for so long.
fn settling(plan: &SimPlan, walk: f64) -> SettlingSteps {
    let length = match plan.decided.time_dependence {
        TimeDependence::Steady { .. } => plan.develop(),
        TimeDependence::Transient => FLUSH,
    };
    SettlingSteps::new(walk, length, plan.usual_dt())
}
