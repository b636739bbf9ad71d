//! A run that starts from its neighbour's end instead of from Hertz: one step of a continuation.
//!
//! ```text
//! contact     pressure, film and history of the neighbour's last step
//! knobs       walk from the neighbour's values to this scene's at their own rates
//! surfaces    x_i(end) = x_i(cold start) (mod W_i)        the distance that is missing is spread over the walk
//! settle      max(walk, spread) + 1.6 a at U, then the passage begins like any other
//! ```
//! Only S and the two amplitudes may differ: they leave the scales, the domain and the smooth reference as
//! they are, which the neighbour passes on. Where the waves of both bodies keep step (S = 0: crest on crest
//! or crest on valley) the result depends on how they stand to each other, so the surfaces are led to where a
//! cold start would have put them, at most half a wave away. Film that entered before the walk ended has passed
//! four fifths of the contact 1.6 a later at U; over 21 values of S of the default scene life is then within 0.3 %
//! and the central film within 0.05 % of what they are after settling for 4 a in short steps (0.07 and 0.05 % after
//! 2 a). Without the lead they are 1.3 % off at S = 0 (`tests/command_line/sweep.rs`, `a_warm_case_is_what_a_cold_one_is`).

use super::Simulation;
use crate::sim::drive::Drive;
use crate::sim::sim_plan::DEVELOP;
use crate::sim::state::Phase;
use crate::sim::{Knob, SimError, State};

/// Distance at U, in a, in which what entered under the neighbour's conditions leaves all but the end of the contact.
const FLUSH: f64 = 1.6;
/// Part of it, in a, at the end, that is stepped as the passage is; before it steps are [`COARSE`] times as
/// long, whose own errors have left the inner contact when the passage begins; with 0.75 the film is still 2 % off
/// in the mean of the passage.
const FINE: f64 = 1.1;
/// Steps of settling over those of the passage.
pub(super) const COARSE: f64 = 2.0;
/// Knobs that a neighbour may differ in.
const FREE: [Knob; 3] = Knob::OF_ROUGHNESS_AND_SLIDING;
/// Speed, in U, at which a surface is led at most.
const LEAD: f64 = 0.5;
/// Shortest distance over which surfaces are led, in a.
const LEAST_LEAD: f64 = 0.5;

impl Simulation {
    /// Starts from the end of `neighbour`, a run of the same scene but for the slide-to-roll ratio and the
    /// amplitudes, in place of the start-up.
    ///
    /// # Errors
    /// [`SimError::State`] when the neighbour's passage had not begun or its fields do not fit; the simulation
    /// is as it was.
    pub fn follow(&mut self, neighbour: &State) -> Result<(), SimError> {
        self.take_over(neighbour)?;
        let dt = self.plan.stepping.usual() * self.plan.decided.domain.dx_a();
        let goal = self.cold_distances(dt);
        for knob in FREE {
            let targets = self.state.targets.get(knob).target;
            self.state.drive.jump(knob, neighbour.drive.get(knob).now);
            self.state.drive.aim(knob, targets);
        }
        for knob in [Knob::ForceN, Knob::ForceNPerM, Knob::EntrainmentMS] {
            self.state
                .drive
                .jump(knob, self.state.targets.get(knob).target);
        }
        let walk = FREE
            .map(|knob| {
                let setting = self.state.drive.get(knob);
                (setting.target - setting.now).abs() / setting.rate
            })
            .into_iter()
            .fold(0.0, f64::max);
        // How far the surfaces must be led depends on how long settling takes, and the other way round: two
        // rounds find a length that serves.
        let mut plan = SettlingSteps::new(walk, dt);
        let mut over = 0.0;
        for _ in 0..2 {
            let lead = self.lead_after(&plan, goal);
            let longest = lead.into_iter().map(f64::abs).fold(0.0, f64::max);
            over = (longest / LEAD).max(LEAST_LEAD);
            plan = SettlingSteps::new(walk.max(over), dt);
        }
        let lead = self.lead_after(&plan, goal);
        self.state.motion.lead(lead, over);
        self.state.motion.disturb(plan.length());
        self.state.phase = Phase::Settle {
            coarse: plan.coarse,
            fine: plan.fine,
        };
        self.state.start_up_steps = (0, plan.coarse + plan.fine);
        self.state.watched = self.state.motion.travelled;
        self.see_again();
        Ok(())
    }

    /// What both surfaces lack of their places after settling.
    fn lead_after(&self, plan: &SettlingSteps, goal: [f64; 2]) -> [f64; 2] {
        let half = distances(
            &self.state.drive,
            self.state.motion.travelled,
            (plan.coarse, COARSE * plan.dt),
        );
        let end = distances(&half.0, half.1, (plan.fine, plan.dt)).1;
        [0, 1].map(|body: usize| self.missing(body, goal[body] - end[body]))
    }

    /// What a distance is short of, modulo the body's wave: between −W/2 and W/2. A body without one wave along x
    /// has no place to be led to.
    fn missing(&self, body: usize, distance: f64) -> f64 {
        match self.work.roughness.wavenumbers(body).map(f64::abs) {
            [one, two] if one > 0.0 && (two == 0.0 || two == one) => {
                let wave = std::f64::consts::TAU / one;
                distance - wave * (distance / wave).round()
            }
            [0.0, two] if two > 0.0 => {
                let wave = std::f64::consts::TAU / two;
                distance - wave * (distance / wave).round()
            }
            _ => 0.0,
        }
    }

    /// Where a cold start would have both surfaces when the passage begins, in a.
    fn cold_distances(&self, dt: f64) -> [f64; 2] {
        let smooth = self.plan.smooth_distance();
        let steps = (DEVELOP / dt).ceil() as u64;
        let mut drive = self.state.targets.clone();
        for knob in FREE {
            drive.jump(knob, 0.0);
            drive.aim(knob, self.state.targets.get(knob).target);
        }
        let steps = if self.develops() { steps } else { 0 };
        distances(&drive, [smooth; 2], (steps, dt)).1
    }
}

/// Steps of settling.
struct SettlingSteps {
    coarse: u64,
    fine: u64,
    dt: f64,
}

impl SettlingSteps {
    /// After a walk of so much.
    fn new(walk: f64, dt: f64) -> Self {
        Self {
            coarse: ((walk + FLUSH - FINE) / (COARSE * dt)).ceil() as u64,
            fine: (FINE / dt).ceil() as u64,
            dt,
        }
    }

    /// In a.
    fn length(&self) -> f64 {
        (COARSE * self.coarse as f64 + self.fine as f64) * self.dt
    }
}

/// Knobs and distances of both bodies after so many steps of such a length, from `travelled` on.
fn distances(drive: &Drive, mut travelled: [f64; 2], (steps, dt): (u64, f64)) -> (Drive, [f64; 2]) {
    let mut drive = drive.clone();
    for _ in 0..steps {
        drive.walk(dt);
        let s = drive.get(Knob::SlideRoll).now;
        travelled[0] += (1.0 - 0.5 * s) * dt;
        travelled[1] += (1.0 + 0.5 * s) * dt;
    }
    (drive, travelled)
}
