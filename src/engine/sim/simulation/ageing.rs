//! The surfaces at the end of a step of the passage: what it has worn, and the jump at the end of a block of passages.

use super::step::forget_passage;
use super::summary::summary;
use super::view::View;
use super::watching::see_again;
use crate::math::grid::Grid;
use crate::physics::cycles::BodyId;
use crate::plan::TimeDependence;
use crate::sim::counting::Counting;
use crate::sim::fatigue_stage::LifeStage;
use crate::sim::orbit::Orbit;
use crate::sim::sim_plan::SimPlan;
use crate::sim::state::Phase;
use crate::sim::summary::AgePoint;
use crate::sim::work::Work;
use crate::sim::worn::{Rubbing, Worn};
use crate::sim::{Knob, State, Stats};

/// How much longer than asked for a block of passages may be.
const MOST_LONGER: f64 = 1.25;

/// Time (a/U) after a jump until its heights meet films that were made over them: those of the contact, 2 a long, move at U.
/// Of 1, 2, 4 and 8 after 10^6 cycles depths and Rq were no further apart than those of two tolerances.
const FLUSH: f64 = 2.0;

/// Counts what a step has worn, and jumps where a block of passages ends.
/// `before`: where body 1, body 2 and the run were when it began, in a.
pub(super) fn age(
    plan: &SimPlan,
    state: &mut State,
    work: &mut Work,
    stats: &Stats,
    before: ([f64; 2], f64),
) {
    if state.phase != Phase::Passage || !state.motion.is_flushed() {
        return;
    }
    let Some(worn) = &mut state.worn else {
        return;
    };
    let law = plan.law_now(&state.drive);
    let step = Rubbing {
        grid: &work.solver.grid,
        law: &law,
        pressure: &state.contact.pressure,
        film: &state.contact.film,
        thin: (plan.scaling).h_from_m(plan.scene.wear.unwrap_or_default().thin_film_m),
        sliding: state.drive.get(Knob::SlideRoll).now.abs(),
        dt: state.distance - before.1,
        travels: state.motion.of_bodies(),
        moved: [0, 1].map(|body: usize| state.motion.travelled[body] - before.0[body]),
    };
    worn.count(&step, state.distance);
    let amplitudes = Knob::AMPLITUDES.map(|knob| state.drive.get(knob).now);
    let rq_m = (amplitudes[0] * plan.rms_shares[0]).hypot(amplitudes[1] * plan.rms_shares[1]);
    let roughness = plan.scaling.h_from_m(rq_m);
    let length = match plan.decided.time_dependence {
        TimeDependence::Steady { .. } => 0.0,
        TimeDependence::Transient => block_length(&state.orbit, plan.decided.length_a),
    };
    if !worn.is_block_over(length, state.distance) {
        return;
    }
    let depths_m = depths_m(plan, worn, state.motion.travelled);
    let size = plan.size_now(&state.drive);
    take_damage(worn, state.counting.as_ref(), state.life.as_ref(), size);
    let Some(end) = worn.end_block(state.motion.travelled, roughness) else {
        return;
    };
    if let Some(cycles) = end.cycles {
        let point = point(plan, state, work, stats, cycles, depths_m);
        // The last cycle comes once more, with the heights that both rates make.
        let again = |last: &AgePoint| cycles > 0.0 && cycles - last.cycles <= 1e-9 * cycles;
        if state.ages.last().is_some_and(again) {
            state.ages.pop();
        }
        if state.ages.len() < state.ages.capacity() {
            state.ages.push(point);
        }
    }
    if end.moved {
        see_again(plan, state, work);
        state.motion.disturb(match plan.decided.time_dependence {
            TimeDependence::Steady { .. } => plan.develop(),
            TimeDependence::Transient => FLUSH,
        });
        forget_passage(plan, state);
    }
}

/// Length of a block near `wanted`, in a: whole periods of both bodies' waves where there are short ones. Over a part of one
/// the rates of two blocks are apart by their phases, and the error control takes that for wear.
fn block_length(orbit: &Orbit, wanted: f64) -> f64 {
    let whole = orbit.window(wanted);
    if whole <= MOST_LONGER * wanted {
        whole
    } else {
        wanted
    }
}

/// Hands on what the block says of damage a loading cycle. What is not known stays as it was.
fn take_damage(worn: &mut Worn, counting: Option<&Counting>, life: Option<&LifeStage>, size: f64) {
    let cycles = life.and_then(|life| life.smooth_cycles(size));
    for (body, pits) in BodyId::BOTH.into_iter().zip(&mut worn.pits) {
        let (Some(pits), Some(counting), Some(cycles)) = (pits, counting, cycles) else {
            continue;
        };
        pits.take(cycles, |out| counting.damage_by_place(body, size, out));
    }
}

/// Greatest depths that both bodies have lost, m.
pub(super) fn depths_m(plan: &SimPlan, worn: &Worn, travelled: [f64; 2]) -> [Option<f64>; 2] {
    let depths = worn.depths(travelled);
    depths.map(|depth| depth.map(|h| plan.scaling.m_from_h(h)))
}

/// What the block that ends has come to.
fn point(
    plan: &SimPlan,
    state: &State,
    work: &Work,
    stats: &Stats,
    cycles: f64,
    depths_m: [Option<f64>; 2],
) -> AgePoint {
    let found = summary(View { plan, state, work }, stats);
    let heights = &work.roughness.heights;
    let [rq_1_m, rq_2_m] = [0, 1].map(|body: usize| {
        let rms = rms(&work.solver.grid, &heights[body]);
        plan.scaling.m_from_h(rms)
    });
    let worn = state.worn.as_ref();
    let area = |body: usize| Some(worn?.known_pits(body)?.area());
    AgePoint {
        cycles,
        wear_depth_1_m: depths_m[0].unwrap_or(0.0),
        wear_depth_2_m: depths_m[1].unwrap_or(0.0),
        pitted_area_1: area(0),
        pitted_area_2: area(1),
        rq_1_m,
        rq_2_m,
        lambda_ratio: found.lambda_ratio.and_then(|new| {
            let rougher = found.rq_1_m.hypot(found.rq_2_m) / rq_1_m.hypot(rq_2_m);
            Some(new * rougher).filter(|lambda| lambda.is_finite())
        }),
        life_relative: found.life_relative,
        p_max_pa: found.p_max_pa,
        h_central_m: found.h_central_m,
        contact_load_ratio: found.contact_load_ratio,
        friction_coefficient: found.friction_coefficient,
    }
}

/// Root mean square about the mean; 0 of a body that is smooth.
fn rms(grid: &Grid, heights: &[f64]) -> f64 {
    if heights.len() != grid.len() {
        return 0.0;
    }
    let area = grid.integrate(|_| 1.0);
    let mean = grid.integrate(|n| heights[n]) / area;
    let rms = (grid.integrate(|n| (heights[n] - mean).powi(2)) / area).sqrt();
    // What rounding leaves of a body that wears alike all along.
    if rms < 1e-9 * mean.abs() { 0.0 } else { rms }
}
