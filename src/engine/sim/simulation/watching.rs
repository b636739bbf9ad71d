//! What is looked at after each step: traction, stress, counts, life, scalars.

use super::present::{has_reference_of_now, publish_lubrication, stress_error_now};
use super::step::fitted_nodes;
use crate::physics::cycles::speed_ratios;
use crate::physics::felt::felt_contacts;
use crate::plan::TimeDependence;
use crate::scene::CycleBasis;
use crate::sim::counting::{Counting, contacts, felt_at_points};
use crate::sim::damage_count::Passing;
use crate::sim::drive::Drive;
use crate::sim::fatigue_stage::Now;
use crate::sim::heat_stage::{HeatStage, SolvedStep, Warmth};
use crate::sim::measure::{Fields, Measured, measure};
use crate::sim::orbit::Orbit;
use crate::sim::roughness::Roughness;
use crate::sim::sim_plan::SimPlan;
use crate::sim::state::Phase;
use crate::sim::stepping::{Attempted, place_surfaces, sliding_m_s, times};
use crate::sim::work::Work;
use crate::sim::yielded::Yielded;
use crate::sim::{Knob, LifeEstimate, State, Stats};

/// Traction, stress, life and scalars of the committed step.
pub(super) fn watch(
    plan: &SimPlan,
    state: &mut State,
    work: &mut Work,
    stats: &mut Stats,
    attempted: &Attempted,
) {
    let before = state.watched;
    state.watched = state.motion.travelled;
    let on_fine = work.solver.grid.nx == plan.decided.domain.nodes;
    if on_fine {
        heat(plan, state, work, attempted);
    }
    let measured = measure_state(plan, state, work);
    if on_fine {
        balance_heat(plan, state, work, &measured);
    }
    let looks = on_fine && state.phase.has_stress();
    if looks && let Some(stress) = &mut work.stress {
        let (p, q) = (&state.contact.pressure, &work.traction);
        work.pool.install(|| stress.slice(p, q, measured.friction));
        if state.phase == Phase::Passage
            && let Some(counting) = &mut state.counting
        {
            let travel = [0, 1].map(|body: usize| state.watched[body] - before[body]);
            let passing = passing(plan, &state.drive, &state.orbit);
            counting.step(&work.solver.grid, travel, stress, &passing);
        }
    }
    if looks {
        sample_life(plan, state, work, stats);
    }
    publish(plan, state, work, attempted, &measured);
    state.metrics.flash_temperature_k = work.heat.as_ref().map(HeatStage::greatest_k);
}

/// What passes now.
fn passing(plan: &SimPlan, drive: &Drive, orbit: &Orbit) -> Passing {
    let ratios = speed_ratios(drive.get(Knob::SlideRoll).now);
    // Only a life by damage waits for points to cross.
    let life = plan.scene.life.as_ref();
    let waits = life.is_some_and(|life| life.cycles == CycleBasis::Damage);
    Passing {
        size: plan.size_now(drive),
        common: (orbit.period()).map(|period| ratios.map(|ratio| ratio.abs() * period)),
        round: orbit.life_window(plan.decided.passage_a, None).round,
        steps: orbit.round_steps(plan.fitted_dt().filter(|_| waits)),
    }
}

/// Counts how warm the surfaces are at the end of the step, which has warmed them unless the contact stands still: then they
/// are warmed here until they are as warm as they get.
fn heat(plan: &SimPlan, state: &mut State, work: &mut Work, attempted: &Attempted) {
    let (Some(stage), Some(warmth)) = (&mut work.heat, &mut state.warmth) else {
        return;
    };
    let is_start_up = matches!(state.phase, Phase::Smooth { .. });
    if is_start_up || attempted.nodes == 0.0 {
        return;
    }
    let grid = &work.solver.grid;
    let law = plan.law_now(&state.drive);
    let step = SolvedStep {
        grid,
        scaling: &plan.scaling,
        law: &law,
        pressure: &state.contact.pressure,
        film: &state.contact.film,
        flow: None,
        entrainment_m_s: state.drive.get(Knob::EntrainmentMS).now,
        sliding_m_s: sliding_m_s(&state.drive),
    };
    let times = times(plan, &state.drive, grid.dx, attempted.nodes);
    let is_steady = matches!(plan.decided.time_dependence, TimeDependence::Steady { .. });
    let made = match state.phase {
        Phase::Passage => state.step,
        Phase::Smooth { .. } | Phase::Settle { .. } | Phase::Develop { .. } => {
            state.start_up_steps.0
        }
    };
    if is_steady && !state.drive.is_walking() {
        let due = made.is_multiple_of((1.0 / grid.dx).ceil() as u64);
        work.pool.install(|| {
            if due {
                stage.soak(warmth, times, &step);
            } else if attempted.newton == 0 {
                stage.step(warmth, times, &step);
            }
        });
    }
    if state.phase == Phase::Passage && !state.drive.is_walking() {
        let size = plan.size_now(&state.drive);
        stage.count(warmth, grid, (size, size * plan.scaling.b_over_a));
    }
}

/// Holds the heat of the step against the work of friction by the traction that is handed out.
fn balance_heat(plan: &SimPlan, state: &mut State, work: &Work, measured: &Measured) {
    let (Some(stage), Some(warmth)) = (&work.heat, &mut state.warmth) else {
        return;
    };
    if state.phase == Phase::Passage && !state.drive.is_walking() {
        let grid = &work.solver.grid;
        let load = plan.scaling.p_hertz_pa * grid.integrate(|n| state.contact.pressure[n]);
        let friction = measured.friction.abs() * load * sliding_m_s(&state.drive);
        stage.balance(warmth, grid, friction);
    }
}

/// The volume under the slice's surface, with the counts up to it.
fn sample_life(plan: &SimPlan, state: &mut State, work: &mut Work, stats: &mut Stats) {
    let stress_error = stress_error_now(plan, state);
    let Some(stress) = &mut work.stress else {
        return;
    };
    let every = plan.decided.life.map_or(f64::INFINITY, |life| {
        life.volume_every_steps as f64 * fitted_nodes(plan, state) * work.solver.grid.dx
    });
    // By the distance at the step's beginning, so that the first step of a passage is looked at.
    let due = state.phase == Phase::Passage && state.distance >= state.next_volume - 1e-9;
    let flushed = state.motion.is_flushed();
    let repeat = state.metrics.repeat;
    let passing = passing(plan, &state.drive, &state.orbit);
    let grid = &work.solver.grid;
    work.pool.install(|| {
        if let Some(life) = &mut state.life
            && due
        {
            state.counting.iter_mut().for_each(Counting::weigh);
            life.push(every, stress, state.counting.as_ref());
            if flushed {
                life.test_settled(stress_error, repeat, state.counting.as_ref());
            }
            if let Some(counting) = state.counting.as_mut().filter(|_| flushed) {
                life.wait_for_points(stress_error, repeat, counting, (grid, &passing));
            }
            stats.stress_volumes += u64::from(life.integrates());
            state.next_volume = next_due(state.next_volume, state.distance, every);
        }
    });
}

/// Whether the passage repeats, after a step that began at the distance `before`.
pub(super) fn look_for_orbit(
    plan: &SimPlan,
    state: &mut State,
    roughness: &Roughness,
    before: f64,
) {
    let s = state.drive.get(Knob::SlideRoll).now;
    let mut frequencies = [0.0; 4];
    for (body, speed) in speed_ratios(s).into_iter().enumerate() {
        let amplitude = Knob::AMPLITUDES[body];
        if state.drive.get(amplitude).now != 0.0 {
            for (plane, k) in roughness.wavenumbers(body).into_iter().enumerate() {
                frequencies[2 * body + plane] = k * speed / std::f64::consts::TAU;
            }
        }
    }
    let passage = plan.decided.passage_a;
    if state.orbit.listen(frequencies, passage)
        && let Some(life) = &mut state.life
    {
        life.set_window(state.orbit.life_window(passage, plan.fitted_dt()));
    }
    if state.motion.is_flushed() {
        let step = state.distance - before;
        let taken = (state.distance, step, plan.fitted_dt());
        (state.orbit).push(taken, &state.contact, &state.metrics);
    }
    let second_per_a = plan.scaling.a_m / state.drive.get(Knob::EntrainmentMS).now;
    state.metrics.repeat = Some(state.orbit.repeat(second_per_a));
}

/// Traction and scalars of the contact.
pub(super) fn measure_state(plan: &SimPlan, state: &State, work: &mut Work) -> Measured {
    let law = plan.law_now(&state.drive);
    let scale = plan.size_now(&state.drive);
    let is_cold = matches!(state.phase, Phase::Smooth { .. });
    let warmth = state.warmth.as_ref().filter(|_| !is_cold);
    let state = &state.contact;
    work.traction.resize(work.solver.grid.len(), 0.0);
    let fields = Fields {
        grid: &work.solver.grid,
        law: &law,
        p: &state.pressure,
        h: &state.film,
        shift: warmth.map_or(&[], Warmth::shift),
        ellipse: (scale, scale * plan.scaling.b_over_a),
    };
    let (traction, rows) = (&mut work.traction, &mut work.row_sums);
    work.pool.install(|| measure(&fields, traction, rows))
}

/// Scalars of the step that has been measured.
pub(super) fn publish(
    plan: &SimPlan,
    state: &mut State,
    work: &Work,
    attempted: &Attempted,
    measured: &Measured,
) {
    publish_lubrication(plan, state, measured);
    let has_stress = state.phase.has_stress();
    let a_m = plan.decided.hertz.a_m * plan.size_now(&state.drive);
    let scaling = &plan.scaling;
    let m = &mut state.metrics;
    m.converged = attempted.converged;
    m.residual = attempted.residual;
    m.newton_iterations = attempted.newton;
    m.linear_iterations = attempted.linear;
    m.retries = attempted.retries;
    m.film_error = attempted.film_error;
    m.mass_error = attempted.mass_error;
    m.load_error = attempted.load_error;
    m.overlap_m = scaling.m_from_h(attempted.overlap);
    let flow = plan.flow_now(&state.drive);
    let tolerance = plan.tolerance(flow);
    m.asked = [tolerance.pressure, tolerance.film];
    let load = scaling.load_knob();
    let (s, force) = (state.drive.get(Knob::SlideRoll), state.drive.get(load));
    (m.slide_roll, m.slide_roll_target) = (s.now, state.targets.get(Knob::SlideRoll).target);
    (m.load_n, m.load_target_n) = (force.now, state.targets.get(load).target);
    m.entrainment_m_s = scaling.heading.sign() * state.drive.get(Knob::EntrainmentMS).now;
    let volumes = state.yielded.as_ref().map(Yielded::volumes);
    m.yielded_m3 = volumes.map(|both| both.map(|volume| scaling.m3_from_volume(volume)));
    if let Some(stress) = work.stress.as_ref().filter(|_| has_stress) {
        let peak = stress.slice.peak;
        m.sigma_eff_max_pa = Some(scaling.pa_from_p(peak.value));
        m.sigma_eff_max_depth_m = Some(scaling.m_from_x(peak.z));
        m.sigma_eff_max_x_m = Some(scaling.place_m(peak.x));
    }
    let n = contacts(
        &plan.decided,
        a_m,
        m.entrainment_m_s,
        m.slide_roll,
        [m.amplitude_1_m, m.amplitude_2_m],
    );
    (m.n_body_1, m.n_body_2) = (n[0], n[1]);
    if let Some(counting) = &state.counting {
        let counted = counting.counted();
        (m.n_counted_body_1, m.n_counted_body_2) = (counted[0], counted[1]);
    }
    let life = life_estimate(plan, state);
    if let (Some(counting), Some(life)) = (&mut state.counting, &life) {
        counting.look_at_governing(life);
    }
    state.metrics.life = life;
}

/// Life as far as it is known.
pub(super) fn life_estimate(plan: &SimPlan, state: &State) -> Option<LifeEstimate> {
    let m = &state.metrics;
    let size = plan.size_now(&state.drive);
    let n = [m.n_body_1, m.n_body_2];
    let felt = felt_at_points(&plan.decided, size, m);
    let now = Now {
        n,
        n_felt: [0, 1].map(|body: usize| Some(felt_contacts(n[body]?, felt[body]))),
        slide_roll: state.metrics.slide_roll,
        size,
        stress_error: stress_error_now(plan, state),
        has_reference: has_reference_of_now(plan, state),
    };
    let stage = state.life.as_ref()?;
    let life = stage.estimate(&now, state.counting.as_ref())?;
    let life_smooth = stage.smooth_life(&plan.decided.hertz, size);
    Some(LifeEstimate {
        life_smooth: life_smooth.unwrap_or(0.0),
        ..life
    })
}

/// Roughness, traction and slice of the state's step, which follow from it.
pub(super) fn see_again(plan: &SimPlan, state: &State, work: &mut Work) -> Measured {
    let Work {
        solver, roughness, ..
    } = work;
    if !matches!(state.phase, Phase::Smooth { .. }) {
        solver.yield_at(plan.hardness);
    }
    place_surfaces(
        solver,
        roughness,
        &plan.scaling,
        &state.drive,
        &state.motion,
        (state.yielded.as_ref(), state.worn.as_ref()),
    );
    slice_again(plan, state, work)
}

/// The slices below the run's own contact.
pub(super) fn slice_again(plan: &SimPlan, state: &State, work: &mut Work) -> Measured {
    let measured = measure_state(plan, state, work);
    let on_fine = state.nodes == plan.decided.domain.nodes;
    if on_fine && state.phase.has_stress() {
        let (p, q) = (&state.contact.pressure, &work.traction);
        if let Some(stress) = &mut work.stress {
            work.pool.install(|| stress.slice(p, q, measured.friction));
        }
    }
    measured
}

/// The first multiple of `every` after `due` that lies beyond `distance`.
fn next_due(due: f64, distance: f64, every: f64) -> f64 {
    due + every * ((distance - due + 1e-9) / every).floor().max(0.0) + every
}
