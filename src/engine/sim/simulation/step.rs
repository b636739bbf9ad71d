//! One step of a run, by the phase that it is in: state goes in, state comes out.

use super::ageing::age;
use super::follow;
use super::smooth_reference::step_smooth;
use super::start_up::refine_or_develop;
use super::watching::{look_for_orbit, watch};
use crate::plan::TimeDependence;
use crate::sim::pace::Stepping;
use crate::sim::sim_plan::SimPlan;
use crate::sim::state::Phase;
use crate::sim::stepping::{Attempted, Heated, Mover};
use crate::sim::work::Work;
use crate::sim::{Knob, State, Stats, StepError};

/// One step, of the start-up first and then of the passage; finer grids and the next phase come with it.
///
/// # Errors
/// [`StepError`] when the step failed; nothing of it was kept.
pub(super) fn step(
    plan: &SimPlan,
    state: &mut State,
    work: &mut Work,
    stats: &mut Stats,
) -> Result<(), StepError> {
    stats.steps += 1;
    loop {
        match state.phase {
            Phase::Smooth { left: 0 } => refine_or_develop(plan, state, work),
            Phase::Develop { left: 0 } => begin_passage(plan, state),
            Phase::Smooth { left } => {
                advance(plan, state, work, stats)?;
                state.phase = Phase::Smooth { left: left - 1 };
                break;
            }
            // On a finer mesh the rough contact waits for the smooth one.
            Phase::Settle { .. } if state.smooth.is_some() => {
                step_smooth(plan, state, work, stats)?;
                if state.smooth.is_some() {
                    break;
                }
            }
            Phase::Settle { long: 0, usual: 0 } => state.phase = Phase::Develop { left: 0 },
            Phase::Settle { long, usual } => {
                advance(plan, state, work, stats)?;
                state.phase = Phase::Settle {
                    long: long.saturating_sub(1),
                    usual: usual - u64::from(long == 0),
                };
                break;
            }
            Phase::Develop { left } => {
                step_smooth(plan, state, work, stats)?;
                advance(plan, state, work, stats)?;
                state.phase = Phase::Develop { left: left - 1 };
                break;
            }
            Phase::Passage => return passage_step(plan, state, work, stats),
        }
    }
    state.start_up_steps.0 += 1;
    // At once, and not with the next step: a finer mesh goes on from t = 0.
    if let Phase::Develop { left: 0 } | Phase::Settle { long: 0, usual: 0 } = state.phase {
        begin_passage(plan, state);
    }
    Ok(())
}

fn begin_passage(plan: &SimPlan, state: &mut State) {
    state.phase = Phase::Passage;
    (state.time_s, state.distance) = (0.0, 0.0);
    state.motion.launch();
    forget_passage(plan, state);
}

/// Counts and phases seen so far belong to other conditions. The next step is looked at.
pub(super) fn forget_passage(plan: &SimPlan, state: &mut State) {
    if let Some(worn) = &mut state.worn {
        worn.forget_block();
    }
    if let Some(warmth) = &mut state.warmth {
        warmth.forget();
    }
    state.orbit.restart();
    let window = (state.orbit).life_window(plan.decided.passage_a, plan.fitted_dt());
    if let Some(life) = &mut state.life {
        life.restart(window);
    }
    state.next_volume = state.distance;
    if let Some(counting) = &mut state.counting {
        counting.restart(state.watched);
    }
}

/// What a step of the passage leaves to be averaged: while a knob walks, and until what entered meanwhile has
/// left the contact, nothing. What was seen of it so far is shown as under way, and forgotten here.
fn count_from_here(plan: &SimPlan, state: &mut State, walked: bool, was_flushed: bool) {
    if state.phase != Phase::Passage {
        return;
    }
    if walked {
        state.motion.disturb(plan.develop());
    } else if !was_flushed && state.motion.is_flushed() {
        forget_passage(plan, state);
        state.totals.restart();
    }
}

fn passage_step(
    plan: &SimPlan,
    state: &mut State,
    work: &mut Work,
    stats: &mut Stats,
) -> Result<(), StepError> {
    step_smooth(plan, state, work, stats)?;
    let (travelled, before) = (state.motion.travelled, state.distance);
    // Where a body yields at rest, what enters is flattened anew.
    let held = matches!(plan.decided.time_dependence, TimeDependence::Steady { .. })
        && state.motion.is_flushed()
        && plan.scaling.p_from_pa(state.metrics.p_max_pa) < plan.hardness * (1.0 - 1e-9);
    if held {
        let speed = state.drive.get(Knob::EntrainmentMS).now;
        state.time_s += plan.stepping.usual() * work.solver.grid.dx * plan.scaling.a_m / speed;
        let held = Attempted::held(&state.metrics, plan.stepping.usual());
        // The contact rests, the bodies do not: material points cross it.
        let s = state.drive.get(Knob::SlideRoll).now;
        let grid = &work.solver.grid;
        state.motion.travel(grid, held.nodes, s);
        watch(plan, state, work, stats, &held);
        state.distance += held.nodes * work.solver.grid.dx;
    } else {
        advance(plan, state, work, stats)?;
    }
    state.step += 1;
    look_for_orbit(plan, state, &work.roughness, before);
    state.totals.push(
        &state.metrics,
        state.distance,
        state.orbit.window(plan.decided.passage_a),
    );
    age(plan, state, work, stats, (travelled, before));
    Ok(())
}

/// One time step: solved, committed, measured.
fn advance(
    plan: &SimPlan,
    state: &mut State,
    work: &mut Work,
    stats: &mut Stats,
) -> Result<(), StepError> {
    let (stepping, nodes) = next_step(plan, state);
    let (walked, was_flushed) = (state.drive.is_walking(), state.motion.is_flushed());
    let transforms = work.solver.transforms();
    // The smooth contact that all lives are compared with is elastic.
    let is_smooth = matches!(state.phase, Phase::Smooth { .. });
    let yielded = state.yielded.as_mut().filter(|_| !is_smooth);
    let [own, extrapolated] = &mut work.guesses;
    let grid = &work.solver.grid;
    let in_passage = state.phase == Phase::Passage;
    let guessed = in_passage
        .then(|| (state.orbit).guess(state.distance + nodes * grid.dx, plan.fitted_dt(), own));
    let guessed = guessed.flatten();
    if guessed.is_some() {
        let history = &state.contact.history;
        (work.pool).install(|| history.predict(grid, nodes, extrapolated));
    }
    let chosen = guessed.filter(|_| state.orbit.last_period().is_better());
    let given = chosen.map(|h0| (&own[..], h0));
    let attempted = work.pool.install(|| {
        Mover {
            state: &mut state.contact,
            solver: &mut work.solver,
            roughness: &mut work.roughness,
            drive: &mut state.drive,
            motion: &mut state.motion,
            plan,
            stepping,
            given,
            yielded,
            worn: state.worn.as_ref().filter(|_| !is_smooth),
            heated: (work.heat.as_mut().filter(|_| !is_smooth))
                .zip(state.warmth.as_mut())
                .map(|(stage, warmth)| Heated { stage, warmth }),
        }
        .advance(nodes)
    });
    let made = work.solver.transforms() - transforms;
    stats.add(&attempted, made);
    if let Some(error) = attempted.fatal(state.time_s) {
        return Err(error);
    }
    if guessed.is_some() {
        let became = &state.contact.pressure;
        (state.orbit.last_period()).judge(became, own, extrapolated);
    }
    state.time_s += attempted.dt_s;
    count_from_here(plan, state, walked, was_flushed);
    watch(plan, state, work, stats, &attempted);
    let dx = work.solver.grid.dx;
    state.distance += attempted.nodes * dx;
    state
        .pace
        .learn(stepping, attempted.path_error, attempted.nodes);
    Ok(())
}

/// Usual length of a step of the passage, in nodes: fitted to the period of the waves where it may be, once no knob walks.
pub(super) fn fitted_nodes(plan: &SimPlan, state: &State) -> f64 {
    let usual = plan.stepping.usual();
    match plan.fitted_dt() {
        Some(dt) if !state.drive.is_walking() => usual * (state.orbit.fitting(dt) / dt),
        Some(_) | None => usual,
    }
}

/// How the next step is chosen, and its length in nodes: the start-up keeps to the usual one.
fn next_step(plan: &SimPlan, state: &State) -> (Stepping, f64) {
    if let Phase::Settle { long: 1.., .. } = state.phase {
        let nodes = follow::LONG * plan.stepping.usual();
        return (Stepping::Fixed(nodes), nodes);
    }
    if state.phase != Phase::Passage {
        return (
            Stepping::Fixed(plan.stepping.usual()),
            plan.stepping.usual(),
        );
    }
    let crests = plan
        .decided
        .waves
        .iter()
        .flatten()
        .map(|wave| wave.crests_per_m);
    let sliding = state.drive.get(Knob::SlideRoll).now.abs();
    let crest = match &state.counting {
        Some(_) => 1.0 / (crests.fold(0.0, f64::max) * sliding * plan.decided.dx_m),
        None => f64::INFINITY,
    };
    let stepping = match plan.stepping {
        Stepping::Fixed(_) => Stepping::Fixed(fitted_nodes(plan, state)),
        adaptive @ Stepping::Adaptive { .. } => adaptive,
    };
    (stepping, state.pace.next(stepping, crest))
}
