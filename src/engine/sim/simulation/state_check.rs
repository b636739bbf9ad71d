//! Whether a saved state fits a simulation: a state comes from a file, and a file may come from anywhere.
//!
//! Checked before anything of it is used: that every field is as long as this scene's, that what follows from the scene
//! is what it says (so that no size is taken from the file), and that values lie where a run can bring them. Numbers
//! are finite already: the file's format has no others.

use crate::saved::{Saved as _, path};
use crate::sim::sim_plan::SimPlan;
use crate::sim::smooth::LoadAndSpeed;
use crate::sim::state::Phase;
use crate::sim::work::Work;
use crate::sim::{Knob, SimError, State, Stats};
use crate::solve::march::ContactState;

/// Steps that no run makes.
const MOST_STEPS: u64 = 1 << 52;
/// Steps, in units of this scene's start-up, that settling in a neighbour's wake never takes.
const LONGEST_SETTLING: u64 = 1000;

fn refuse(what: &str) -> SimError {
    SimError::State(what.to_owned())
}

fn not_ours(field: &str) -> SimError {
    SimError::State(format!("`{field}` in it is not of this scene"))
}

fn demand(holds: bool, what: &str) -> Result<(), SimError> {
    if holds { Ok(()) } else { Err(refuse(what)) }
}

/// Whether the state is one of this scene's contact: its fields, its stages.
pub(super) fn check(
    plan: &SimPlan,
    state: &State,
    work: &Work,
    saved: &State,
) -> Result<(), SimError> {
    let smooth = saved.smooth.as_ref();
    let contacts = smooth.map(|smooth| (smooth.nodes, &smooth.contact));
    let reference = saved.reference.as_ref();
    let contacts =
        (contacts.into_iter()).chain(reference.map(|contact| (plan.decided.domain.nodes, contact)));
    for (nodes, contact) in [(saved.nodes, &saved.contact)].into_iter().chain(contacts) {
        let on_a_grid = plan.climb().any(|n| n == nodes);
        demand(on_a_grid, "its grid is not this scene's")?;
        let len = plan.grid(nodes).len();
        ContactState::empty(len, work.solver.is_unlike())
            .check(contact)
            .map_err(|field| not_ours(&path("contact", &field)))?;
    }
    state.check(saved).map_err(|field| not_ours(&field))
}

/// Whether a run can have counted so much.
pub(super) fn check_stats(stats: &Stats) -> Result<(), SimError> {
    let counted = stats.all().into_iter().all(|n| n <= MOST_STEPS);
    demand(counted, "its work counters are not valid")
}

/// Whether a run of this scene can have come there.
pub(super) fn check_course(
    plan: &SimPlan,
    state: &State,
    work: &Work,
    saved: &State,
) -> Result<(), SimError> {
    let start_up = plan.start_up_steps().max(1);
    let on_finest = saved.nodes == plan.decided.domain.nodes;
    let phase_fits = match saved.phase {
        Phase::Smooth { left } => left <= plan.smooth_steps(saved.nodes, plan.decided.has_flow()),
        Phase::Settle { long, usual } => {
            on_finest && long.max(usual) <= LONGEST_SETTLING * start_up
        }
        Phase::Develop { left } => on_finest && left <= start_up,
        Phase::Passage => on_finest,
    };
    demand(phase_fits, "its start-up is not this scene's")?;
    // No wave stands on the coarser grids of a start-up.
    let is_bare = Knob::AMPLITUDES.into_iter().all(|knob| {
        let setting = saved.drive.get(knob);
        setting.now == 0.0 && setting.target == 0.0
    });
    let is_smooth = matches!(saved.phase, Phase::Smooth { .. });
    demand(is_bare || !is_smooth, "its smooth start-up is rough")?;
    let steps = [saved.step, saved.start_up_steps.0, saved.start_up_steps.1];
    demand(
        steps.into_iter().all(|n| n <= MOST_STEPS),
        "no run makes so many steps",
    )?;
    let smooth = saved.smooth.as_ref();
    demand(
        smooth.is_none_or(|smooth| {
            smooth.left <= plan.smooth_steps(smooth.nodes, true) && can_be(plan, work, smooth.at)
        }),
        "its smooth contact is not this scene's",
    )?;
    for drive in [&saved.drive, &saved.targets]
        .into_iter()
        .chain(smooth.map(|smooth| &smooth.drive))
    {
        for knob in Knob::ALL {
            let (own, setting) = (state.drive.get(knob), drive.get(knob));
            let both = [setting.now, setting.target];
            demand(
                own.rate == setting.rate
                    && both.into_iter().all(|v| can_stand_at(plan, work, knob, v)),
                &format!("{} is out of its range", knob.key()),
            )?;
        }
    }
    Ok(())
}

fn can_be(plan: &SimPlan, work: &Work, at: LoadAndSpeed) -> bool {
    can_stand_at(plan, work, plan.scaling.load_knob(), at.load)
        && can_stand_at(plan, work, Knob::EntrainmentMS, at.speed_m_s)
}

/// Whether a knob can stand there, on its way too.
fn can_stand_at(plan: &SimPlan, work: &Work, knob: Knob, value: f64) -> bool {
    match knob {
        Knob::SlideRoll => knob.takes(value),
        Knob::ForceN | Knob::ForceNPerM => {
            let most = plan.decided.maximum_force_n() * (1.0 + 1e-9);
            value > 0.0 && (knob != plan.scaling.load_knob() || value <= most)
        }
        Knob::Amplitude1M => value >= 0.0 && (value == 0.0 || work.roughness.is_rough(0)),
        Knob::Amplitude2M => value >= 0.0 && (value == 0.0 || work.roughness.is_rough(1)),
        Knob::EntrainmentMS => value > 0.0,
    }
}
