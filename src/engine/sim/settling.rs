//! When the average of the life may be shown as the result.
//!
//! ```text
//! ramp      a knob walks                          every step begins the wait anew
//! flush     develop() after it                   what entered meanwhile leaves the contact; then all sums begin
//! average   over a period P                       |ln L now − ln L before| over the last P/2:  ≤ B/2 settled,  > B not
//!           smooth and steady                     settled as solved
//!           fields come back                      c · drift ≤ B/2 settled; closed (orbit.rs) with more, the band is wider by that
//!           not settled                           the band is wider by what eight batches of the samples say of their mean, or more
//!           no common period, 3 P                 settled; the band is as much wider as the mean wandered in 2 P
//!                                                 (the mean of all that was seen, which converges as 1/distance)
//!           cycles by their damage            when the surfaces of P have crossed the contact, in steps that fit P through
//!                                             the last P again (last_round.rs); the band is wider by what their mean moved
//!                                             from half of that on
//! B = c max(ε, 2 tol)                             ε relative error of stress by the mesh, tol a step's of pressure
//! ```
//! P are as few whole periods of what passes as make a length a; the mean itself is over as many as fit in a passage,
//! or over P where steps are fitted to it.
//! L ∝ (σ)^{−c}: an error ε of stress is c ε of ln L. B is never below what two means of steps that are solved to
//! `numerics.tolerance` may differ by. A mean over a whole number of periods meets the same phases at both of its
//! ends, so it moves by what the contact has not forgotten and by nothing else. Bodies whose waves have no common
//! period never repeat: a mean over one P comes and goes with the crests that happen to meet (by 14 % for ever at
//! point B of the FZG gear), so theirs is of all that was seen, and what it still moves is part of what is not known.

use serde::{Deserialize, Serialize};

use super::estimates::{Repeat, Rhythm};
use crate::physics::fatigue::LifeLaw;
use crate::solve::life::LifeMeter;
use crate::solve::marks::Marks;

/// Whether the average has stopped.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub(super) struct Settling {
    law: LifeLaw,
    /// Relative error of pressure that a step is solved to.
    tolerance: f64,
    settled: bool,
    /// Whether only the crossings of points are waited for.
    #[serde(default)]
    waits_for_points: bool,
    /// By how much of ln L a mean without a common period wanders.
    wander: f64,
}

impl Settling {
    /// Before the first sample.
    pub(super) fn new(law: LifeLaw, tolerance: f64) -> Self {
        Self {
            law,
            tolerance,
            settled: false,
            waits_for_points: false,
            wander: 0.0,
        }
    }

    /// The average begins anew.
    pub(super) fn restart(&mut self) {
        (self.settled, self.waits_for_points, self.wander) = (false, false, 0.0);
    }

    /// Takes what the meter's mean did, after a sample; `exponent`: of life against stress
    /// ([`crate::scene::Life::exponent`]).
    pub(super) fn test(
        &mut self,
        meter: &LifeMeter,
        (exponent, stress_error): (f64, f64),
        repeat: Option<Repeat>,
        damage: Option<(&Marks, f64)>,
        is_smooth: bool,
    ) {
        // The first steps of a run, of which nothing is known yet: the start-up has solved the steady contact, and nothing
        // passes through it.
        if is_smooth && repeat.is_none_or(|repeat| repeat.drift.is_none()) {
            self.settled = true;
            return;
        }
        self.judge(meter, (exponent, stress_error), repeat, damage);
        if !self.settled {
            self.wander = (self.wander).max(meter.unsure() / self.law.weibull_slope);
        }
    }

    fn judge(
        &mut self,
        meter: &LifeMeter,
        (exponent, stress_error): (f64, f64),
        repeat: Option<Repeat>,
        damage: Option<(&Marks, f64)>,
    ) {
        (self.wander, self.waits_for_points) = (0.0, false);
        if !meter.covers() {
            return;
        }
        let life = |ln_integral: f64| ln_integral / self.law.weibull_slope;
        let band = exponent * stress_error.max(2.0 * self.tolerance);
        let repeats = repeat.filter(|repeat| repeat.rhythm != Rhythm::Statistics);
        let drift = repeats.and_then(|repeat| Some(exponent * repeat.drift?));
        let comes_back = drift.is_some_and(|drift| drift <= 0.5 * band);
        if repeat.is_some_and(|repeat| repeat.rhythm == Rhythm::Statistics) {
            let marks = damage.map_or(meter.marks(), |(marks, _)| marks);
            self.wander = life(marks.wandered());
            self.settled = meter.marks().moved(2.0).is_some();
            return;
        }
        let moved = meter.marks().moved(0.5).map(life);
        let most = if self.settled { band } else { 0.5 * band };
        self.settled = comes_back || moved.is_some_and(|moved| moved <= most);
        // Closed, if not yet as closely as the mesh is good.
        let is_closed = repeats.is_some_and(|it| it.rhythm == Rhythm::Orbit && it.repeats);
        let drifted = drift.filter(|_| is_closed && !self.settled);
        self.settled |= is_closed;
        if let Some((marks, covered)) = damage {
            let have_crossed = covered >= 1.0 - 1e-9;
            self.waits_for_points = self.settled && !have_crossed;
            self.settled &= have_crossed;
            self.wander = life(marks.wandered());
        }
        self.wander += drifted.unwrap_or(0.0);
    }

    /// Whether it has.
    pub(super) fn has_settled(&self) -> bool {
        self.settled
    }

    /// Whether all else would let it settle, and only points have not crossed.
    pub(super) fn waits_for_points(&self) -> bool {
        self.waits_for_points
    }

    /// What the band is wider by, in ln L.
    pub(super) fn wander(&self) -> f64 {
        self.wander
    }
}
