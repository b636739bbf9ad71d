//! A run that starts from its neighbour's end instead of from Hertz: one step of a continuation.
//!
//! ```text
//! contact     pressure, film and history of the neighbour's last step
//! knobs       walk from the neighbour's values to this scene's at their own rates
//! surfaces    x_i(end) = 0 (mod W_i), as after any start  the distance that is missing is spread over the walk
//! settle      max(walk, spread) + 1.6 a at U, then the passage begins like any other
//! ```
//! Only S and the two amplitudes may differ: they leave the scales, the domain and the smooth reference as
//! they are, which the neighbour passes on. Where the waves of both bodies keep step (S = 0: crest on crest
//! or crest on valley) the result depends on how they stand to each other, so the surfaces are led to 0, at most half
//! a wave away. Film that entered before the walk ended has passed four fifths of the contact 1.6 a later at U.
//! Settling is in steps of the passage: what long ones had left of their errors was in the greatest stress that places
//! had met (1.9 % of the life at S = 0; now .16, of which 2.8 a leave .05).
//! `tests/command_line/sweep.rs`, `a_warm_case_is_what_a_cold_one_is`.

use super::state_check::check;
use super::watching::see_again;
use crate::physics::cycles::speed_ratios;
use crate::sim::drive::Drive;
use crate::sim::sim_plan::SimPlan;
use crate::sim::state::Phase;
use crate::sim::work::Work;
use crate::sim::{Knob, SimError, State};

/// Distance at U, in a, in which what entered under the neighbour's conditions leaves all but the end of the contact.
const FLUSH: f64 = 1.6;
/// Steps while knobs walk and surfaces are led over those of the passage. Their own errors must leave the contact, too: what
/// the greatest stress of each place is taken over begins with the passage.
pub(super) const LONG: f64 = 2.0;
/// Knobs that a neighbour may differ in.
const FREE: [Knob; 3] = Knob::OF_ROUGHNESS_AND_SLIDING;
/// Speed, in U, at which a surface is led at most.
const LEAD: f64 = 0.5;
/// Shortest distance over which surfaces are led, in a.
const LEAST_LEAD: f64 = 0.5;

/// Starts from the end of `neighbour`, a run of the same scene but for the slide-to-roll ratio and the
/// amplitudes, in place of the start-up.
///
/// # Errors
/// [`SimError::State`] when the neighbour's passage had not begun or its fields do not fit; the simulation
/// is as it was.
pub(super) fn follow(
    plan: &SimPlan,
    state: &mut State,
    work: &mut Work,
    neighbour: &State,
) -> Result<(), SimError> {
    take_over(plan, state, work, neighbour)?;
    let dt = plan.usual_dt();
    for knob in FREE {
        let targets = state.targets.get(knob).target;
        state.drive.jump(knob, neighbour.drive.get(knob).now);
        state.drive.aim(knob, targets);
    }
    for knob in [Knob::ForceN, Knob::ForceNPerM, Knob::EntrainmentMS] {
        state.drive.jump(knob, state.targets.get(knob).target);
    }
    let walk = state.drive.walk_left();
    // How far the surfaces must be led depends on how long settling takes, and the other way round: two
    // rounds find a length that serves.
    let mut settling = SettlingSteps::new(walk, FLUSH, dt);
    let mut over = 0.0;
    for _ in 0..2 {
        let ends = ends(state, &settling);
        let leads = [0, 1].map(|body: usize| led(work, body, ends[body]).0.abs());
        let longest = leads.into_iter().fold(0.0, f64::max);
        over = (longest / LEAD).max(LEAST_LEAD);
        settling = SettlingSteps::new(walk.max(over), FLUSH, dt);
    }
    let ends = ends(state, &settling);
    let led = [0, 1].map(|body: usize| led(work, body, ends[body]));
    state.motion.lead(led.map(|(lead, _)| lead), over);
    // So that material points meet the nodes as after a cold start: between nodes stress is read by interpolation.
    for (distance, (_, whole)) in state.motion.travelled.iter_mut().zip(led) {
        *distance -= whole;
    }
    state.motion.disturb(settling.length());
    state.phase = settling.phase();
    state.start_up_steps = (0, settling.steps());
    state.watched = state.motion.travelled;
    see_again(plan, state, work);
    Ok(())
}

/// Where both bodies are after settling.
fn ends(state: &State, settling: &SettlingSteps) -> [f64; 2] {
    let travelled = state.motion.travelled;
    let half = distances(&state.drive, travelled, (settling.long, LONG * settling.dt));
    distances(&half.0, half.1, (settling.usual, settling.dt)).1
}

/// What a body that would come to `end` is short of a place that looks like 0, and that place: at most half a wave away; one
/// that does not come back looks like 0 nowhere.
fn led(work: &Work, body: usize, end: f64) -> (f64, f64) {
    let is_rough = work.roughness.is_rough(body);
    match work.roughness.repeat(body) {
        Some(wave) if wave.is_finite() => {
            let whole = wave * (end / wave).round();
            (whole - end, whole)
        }
        None if is_rough => (0.0, 0.0),
        Some(_) | None => (0.0, end),
    }
}

/// Where a cold start has both surfaces when the passage begins, in a, if they set out from 0.
pub(super) fn cold_distances(plan: &SimPlan, targets: &Drive, develops: bool, dt: f64) -> [f64; 2] {
    let smooth = plan.smooth_distance();
    let steps = (plan.develop() / dt).ceil() as u64;
    let mut drive = targets.clone();
    for knob in FREE {
        drive.jump(knob, 0.0);
        drive.aim(knob, targets.get(knob).target);
    }
    let steps = if develops { steps } else { 0 };
    distances(&drive, [smooth; 2], (steps, dt)).1
}

/// Takes over what a neighbour leaves to [`follow`]: its contact and its references.
///
/// # Errors
/// As [`super::Simulation::restore`].
fn take_over(
    plan: &SimPlan,
    state: &mut State,
    work: &mut Work,
    neighbour: &State,
) -> Result<(), SimError> {
    check(plan, state, work, neighbour)?;
    if neighbour.nodes != plan.decided.domain.nodes || neighbour.phase != Phase::Passage {
        let early = "its passage has not begun".to_owned();
        return Err(SimError::State(early));
    }
    work.solve_on(plan, neighbour.nodes);
    state.nodes = neighbour.nodes;
    state.contact.clone_from(&neighbour.contact);
    if let (Some(own), Some(other)) = (&mut state.life, &neighbour.life) {
        own.take_base(other, plan.base());
    }
    if let (Some(own), Some(other)) = (&mut state.counting, &neighbour.counting) {
        own.take_reference(other);
    }
    (state.coarser, state.mesh_errors) = (neighbour.coarser, neighbour.mesh_errors);
    state.motion.travelled = neighbour.motion.travelled;
    Ok(())
}

/// Steps of settling.
pub(super) struct SettlingSteps {
    long: u64,
    usual: u64,
    dt: f64,
}

impl SettlingSteps {
    /// After a walk of so much, over `length`, in a.
    pub(super) fn new(walk: f64, length: f64, dt: f64) -> Self {
        Self {
            long: (walk / (LONG * dt)).ceil() as u64,
            usual: (length / dt).ceil() as u64,
            dt,
        }
    }

    /// In a.
    pub(super) fn length(&self) -> f64 {
        (LONG * self.long as f64 + self.usual as f64) * self.dt
    }

    pub(super) fn steps(&self) -> u64 {
        self.long + self.usual
    }

    pub(super) fn phase(&self) -> Phase {
        Phase::Settle {
            long: self.long,
            usual: self.usual,
        }
    }
}

/// Knobs and distances of both bodies after so many steps of such a length, from `travelled` on.
fn distances(drive: &Drive, mut travelled: [f64; 2], (steps, dt): (u64, f64)) -> (Drive, [f64; 2]) {
    let mut drive = drive.clone();
    for _ in 0..steps {
        drive.walk(dt);
        let [one, two] = speed_ratios(drive.get(Knob::SlideRoll).now);
        travelled[0] += one * dt;
        travelled[1] += two * dt;
    }
    (drive, travelled)
}
