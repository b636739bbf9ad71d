//! Whether the passage repeats.
//!
//! ```text
//! f_i   = a_i (1 ∓ S/2)/2π          crests of body i that pass a fixed place, per distance a at U
//! T     = least distance with T f_i whole for every wave of both bodies       (commensurate: an orbit)
//! drift = max(Σ|P(w+T) − P(w)|/ΣP(w), Σ|H(w+T) − H(w)|/ΣH(w))            over the nodes under pressure
//! ```
//! Both rough surfaces are in the same place again after a distance T, so a contact that has forgotten how it began
//! repeats itself, and so does what its mesh makes of it, where crests meet the nodes anew in the same places: after a
//! whole number of steps. Fixed steps are stretched or shortened by up to 1 % for that, as few periods m T as that
//! takes together. While a knob walks, with adaptive steps, where surfaces age and where waves have few nodes T is no
//! whole number of them: the fields at w + T are interpolated between four steps (cubic Lagrange), which costs 0.1 to
//! 0.5 % of a ripple of ten steps. Where no T up to 16 a exists the passage is quasi-periodic and never repeats; then
//! the means of film, pressure and contact over 4 a are compared with those of the 4 a before, which is less, and is
//! named so. Smooth or longitudinal surfaces: steady, compared over a distance of a.

use serde::{Deserialize, Serialize};

use super::Metrics;
use super::estimates::{Repeat, Rhythm};
use super::last_period::LastPeriod;
use crate::saved::saved;
use crate::solve::life::Window;
use crate::solve::march::ContactState;

/// Longest period that is looked for, in a.
pub(super) const LONGEST: f64 = 16.0;
/// Drift below which an orbit counts as closed: five times the tolerance of a step's pressure.
const CLOSED: f64 = 5e-3;
/// Same for means.
const LEVEL: f64 = 1e-2;
/// Steps that a comparison spans at least.
const FEWEST_STEPS: f64 = 6.0;
/// Periods shorter than this, in a, are looked at several together.
const LEAST_ROUND: f64 = 1.0;
/// Relative mismatch of a common period.
const MATCH: f64 = 1e-9;
/// Part of a step by which it may be stretched or shortened for a period to be a whole number of steps: with more the shift
/// of the film by fractions of a node would be felt (`solve::shift`).
const STRETCHED: f64 = 1e-2;
/// Periods of one wave that are tried.
const MOST_CRESTS: u32 = 4096;

/// Fields of one step, single precision.
#[derive(Debug, Clone, Default, Serialize, Deserialize)]
struct OrbitStep {
    #[serde(rename = "way")]
    distance: f64,
    pressure: Vec<f32>,
    film: Vec<f32>,
}

saved! {
    OrbitStep { parts: pressure, film; free: distance; }
}

impl OrbitStep {
    fn of(len: usize) -> Self {
        Self {
            distance: 0.0,
            pressure: vec![0.0; len],
            film: vec![0.0; len],
        }
    }

    fn take(&mut self, distance: f64, pressure: &[f64], film: &[f64]) {
        self.distance = distance;
        for (to, &from) in self.pressure.iter_mut().zip(pressure) {
            *to = from as f32;
        }
        for (to, &from) in self.film.iter_mut().zip(film) {
            *to = from as f32;
        }
    }

    fn take_from(&mut self, other: &Self) {
        self.distance = other.distance;
        self.pressure.copy_from_slice(&other.pressure);
        self.film.copy_from_slice(&other.film);
    }
}

/// Mean film (in a²/R; the next one in m) below which there is none to compare: about a nanometre, where oil is no
/// continuum and the film of a dry contact is what its solver leaves.
const CLOSED_FILM: f64 = 1e-4;
const CLOSED_FILM_M: f64 = 1e-9;

/// Sums over one window of 4 a.
#[derive(Debug, Clone, Copy, Default, Serialize, Deserialize)]
struct Means {
    from: f64,
    sums: [f64; 4],
}

/// Watches for repetition.
#[derive(Debug, Clone, Serialize, Deserialize)]
pub(super) struct Orbit {
    frequencies: [f64; 4],
    rhythm: Rhythm,
    /// T, in a; the window of the means where there is none.
    period: f64,
    /// Distance from the reference to the comparison: a multiple of T.
    span: f64,
    reference: OrbitStep,
    /// The last four steps, oldest first.
    ring: [OrbitStep; 4],
    last_period: LastPeriod,
    taken: u32,
    means: Means,
    before: Option<[f64; 4]>,
    drift: Option<f64>,
}

saved! {
    Orbit {
        parts: reference, ring, last_period;
        free: frequencies, rhythm, period, span, taken, means, before, drift;
    }
    holds |_, saved| saved.period > 0.0
}

impl Orbit {
    /// For fields of `len` nodes and means over `passage` (in a).
    pub(super) fn new(len: usize, passage: f64) -> Self {
        Self {
            frequencies: [0.0; 4],
            rhythm: Rhythm::Steady,
            period: passage.min(1.0),
            span: 1.0,
            reference: OrbitStep::of(len),
            ring: std::array::from_fn(|_| OrbitStep::of(len)),
            last_period: LastPeriod::new(len),
            taken: 0,
            means: Means::default(),
            before: None,
            drift: None,
        }
    }

    /// Begins anew: what was before belongs to other conditions.
    pub(super) fn restart(&mut self) {
        self.taken = 0;
        self.last_period.restart();
        self.before = None;
        self.drift = None;
        self.means = Means::default();
    }

    /// Takes the frequencies at which crests pass; true when they are new.
    pub(super) fn listen(&mut self, frequencies: [f64; 4], passage: f64) -> bool {
        if frequencies == self.frequencies && self.taken > 0 {
            return false;
        }
        self.restart();
        self.frequencies = frequencies;
        (self.rhythm, self.period) = if frequencies == [0.0; 4] {
            (Rhythm::Steady, 1.0)
        } else {
            match common_period(&frequencies) {
                Some(period) => (Rhythm::Orbit, period),
                None => (Rhythm::Statistics, passage),
            }
        };
        true
    }

    /// T, in a; `None`: nothing that passes has a common one.
    pub(super) fn period(&self) -> Option<f64> {
        (self.rhythm == Rhythm::Orbit).then_some(self.period)
    }

    /// What the mean of the life is taken over: a round, where steps are fitted to it (`usual`: their length before that), as
    /// what comes back says the same in all of them; else all rounds of a passage.
    pub(super) fn life_window(&self, passage: f64, usual: Option<f64>) -> Window {
        let period = self.window(passage);
        let round = match self.rhythm {
            Rhythm::Orbit => (self.period * (LEAST_ROUND / self.period).ceil()).min(period),
            Rhythm::Steady | Rhythm::Statistics => period,
        };
        Window {
            period: if self.round_steps(usual).is_some() {
                round
            } else {
                period
            },
            round,
            is_open: self.rhythm == Rhythm::Statistics,
        }
    }

    /// Distance over which means are taken: whole periods where there are some, at least `passage` long where
    /// periods are short.
    pub(super) fn window(&self, passage: f64) -> f64 {
        match self.rhythm {
            Rhythm::Orbit if self.period <= passage => {
                self.period * (passage / self.period * (1.0 + MATCH)).floor()
            }
            Rhythm::Orbit => self.period,
            Rhythm::Steady | Rhythm::Statistics => passage,
        }
    }

    /// The length nearest to `step` of which as few periods as that takes are a whole number; `step` itself where nothing
    /// repeats.
    pub(super) fn fitting(&self, step: f64) -> f64 {
        match self.rhythm {
            Rhythm::Orbit => {
                let rounds = self.rounds(step);
                let steps = (rounds / step).round();
                let fitted = rounds / steps;
                let is_another = fits(rounds, step) && (fitted / step - 1.0).abs() > MATCH;
                if is_another { fitted } else { step }
            }
            Rhythm::Steady | Rhythm::Statistics => step,
        }
    }

    /// How many fixed steps of about `usual` make as few periods as they fit; `None`: none up to [`LONGEST`], or nothing repeats.
    pub(super) fn round_steps(&self, usual: Option<f64>) -> Option<usize> {
        let usual = usual.filter(|_| self.rhythm == Rhythm::Orbit)?;
        let rounds = self.rounds(usual);
        fits(rounds, usual).then(|| (rounds / usual).round() as usize)
    }

    /// The fewest periods together that fixed steps of about `step` fit; one, where none up to [`LONGEST`] do.
    fn rounds(&self, step: f64) -> f64 {
        let some = (1..=MOST_CRESTS).map(|m| f64::from(m) * self.period);
        let mut some = some.take_while(|rounds| *rounds <= LONGEST);
        some.find(|rounds| fits(*rounds, step))
            .unwrap_or(self.period)
    }

    /// Takes a step that ended at `distance` after a length `step`; `usual`: length of steps that are
    /// fitted to the period, before that.
    pub(super) fn push(
        &mut self,
        (distance, step, usual): (f64, f64, Option<f64>),
        contact: &ContactState,
        metrics: &Metrics,
    ) {
        if self.rhythm == Rhythm::Statistics {
            self.push_means(distance, step, metrics);
            return;
        }
        let (pressure, film) = (&contact.pressure, &contact.film);
        if self.rhythm == Rhythm::Orbit {
            let rounds = usual.map_or(self.period, |usual| self.rounds(usual));
            (self.last_period).push(distance, step, rounds, contact.h0, pressure);
        }
        self.ring.rotate_left(1);
        self.ring[3].take(distance, pressure, film);
        self.taken = self.taken.saturating_add(1);
        if self.taken == 1 {
            self.begin(step);
            return;
        }
        let target = self.reference.distance + self.span;
        if self.taken >= 4 && self.ring[2].distance >= target {
            self.drift = Some(self.compare(target));
            self.begin(step);
        }
    }

    /// Guess of a step that ends at `distance`, from a period ago or a few: H0, and the pressure in `guess`; `usual`: as
    /// pushed.
    pub(super) fn guess(
        &self,
        distance: f64,
        usual: Option<f64>,
        guess: &mut [f64],
    ) -> Option<f64> {
        let rounds = usual.map_or(self.period, |usual| self.rounds(usual));
        self.last_period.guess(distance, rounds, guess)
    }

    /// The last period, where the passage may repeat.
    pub(super) fn last_period(&mut self) -> &mut LastPeriod {
        &mut self.last_period
    }

    /// The newest step becomes the reference.
    fn begin(&mut self, step: f64) {
        self.reference.take_from(&self.ring[3]);
        self.span = span(self.period, step);
    }

    fn compare(&self, target: f64) -> f64 {
        let weights = lagrange(self.ring.each_ref().map(|s| s.distance), target);
        let at = |n: usize, of: fn(&OrbitStep) -> &[f32]| -> f64 {
            let terms = self.ring.iter().zip(weights);
            terms.map(|(s, w)| w * f64::from(of(s)[n])).sum()
        };
        let (mut moved_p, mut all_p, mut moved_h, mut all_h) = (0.0, 0.0, 0.0, 0.0);
        let mut closed = 0.0;
        for (n, &p) in self.reference.pressure.iter().enumerate() {
            if p > 0.0 {
                moved_p += (at(n, |s| &s.pressure) - f64::from(p)).abs();
                all_p += f64::from(p);
                let h = f64::from(self.reference.film[n]);
                moved_h += (at(n, |s| &s.film) - h).abs();
                all_h += h;
                closed += CLOSED_FILM;
            }
        }
        let share = |moved: f64, all: f64| moved / all.max(f64::MIN_POSITIVE);
        let film = if all_h > closed {
            share(moved_h, all_h)
        } else {
            0.0
        };
        share(moved_p, all_p).max(film)
    }

    fn push_means(&mut self, distance: f64, step: f64, m: &Metrics) {
        if self.taken == 0 {
            self.means = Means {
                from: distance - step,
                ..Means::default()
            };
        }
        self.taken = self.taken.saturating_add(1);
        let values = [m.h_central_m, m.h_min_m, m.p_max_pa, m.contact_ratio];
        for (sum, value) in self.means.sums.iter_mut().zip(values) {
            *sum += step * value;
        }
        let length = distance - self.means.from;
        if length < self.period * (1.0 - MATCH) {
            return;
        }
        let now = self.means.sums.map(|sum| sum / length);
        if let Some(before) = self.before {
            // Means of a closed film may differ by what is no film.
            let least = [CLOSED_FILM_M, CLOSED_FILM_M, f64::MIN_POSITIVE];
            let relative = |k: usize| (now[k] - before[k]).abs() / before[k].abs().max(least[k]);
            let contact = (now[3] - before[3]).abs();
            self.drift = Some(relative(0).max(relative(1)).max(relative(2)).max(contact));
        }
        self.before = Some(now);
        self.means = Means {
            from: distance,
            ..Means::default()
        };
    }

    /// What is known; `second_per_a`: time in which oil moves by a.
    pub(super) fn repeat(&self, second_per_a: f64) -> Repeat {
        let limit = if self.rhythm == Rhythm::Statistics {
            LEVEL
        } else {
            CLOSED
        };
        Repeat {
            rhythm: self.rhythm,
            period_s: self.period * second_per_a,
            drift: self.drift,
            repeats: self.drift.is_some_and(|drift| drift <= limit),
        }
    }
}

/// Whether a whole number of steps, each as good as `step`, makes `rounds`.
fn fits(rounds: f64, step: f64) -> bool {
    let steps = rounds / step;
    (steps - steps.round()).abs() <= STRETCHED * steps.round()
}

/// The multiple of `period` over which steps of `step` compare best: nearly a whole number of them, where
/// there is one within 4 a.
fn span(period: f64, step: f64) -> f64 {
    let first = (FEWEST_STEPS * step / period).ceil().max(1.0);
    let last = (4.0 / period).floor().max(first);
    let off = |m: f64| {
        let steps = m * period / step;
        (steps - steps.round()).abs()
    };
    let mut best = first;
    let mut m = first;
    while m <= last {
        if off(m) < off(best) - 1e-6 {
            best = m;
        }
        if off(best) < 0.02 {
            break;
        }
        m += 1.0;
    }
    best * period
}

/// Least T with T f whole for every f that is not 0; `None`: none up to [`LONGEST`].
fn common_period(frequencies: &[f64; 4]) -> Option<f64> {
    let moving = || frequencies.iter().copied().filter(|f| *f != 0.0);
    let slowest = moving().fold(f64::INFINITY, |least, f| least.min(f.abs()));
    (1..=MOST_CRESTS)
        .map(|crests| f64::from(crests) / slowest)
        .take_while(|period| *period <= LONGEST)
        .find(|period| {
            moving().all(|f| {
                let crests = period * f;
                (crests - crests.round()).abs() <= MATCH * crests.abs().max(1.0)
            })
        })
}

/// Weights of the values at `distances` for the value at `target`.
pub(super) fn lagrange(distances: [f64; 4], target: f64) -> [f64; 4] {
    std::array::from_fn(|i| {
        (0..4)
            .filter(|&k| k != i)
            .map(|k| (target - distances[k]) / (distances[i] - distances[k]))
            .product()
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn periods_are_those_of_both_bodies() {
        // W = 0.25 a on both, S = 0.5: 3 crests of body 1 while 5 of body 2 pass.
        let period = common_period(&[3.0, 5.0, 0.0, 0.0]).expect("commensurate");
        assert!((period - 1.0).abs() < 1e-12);
        assert_eq!(common_period(&[2.0, 0.0, 0.0, -3.0]), Some(1.0));
        assert_eq!(common_period(&[1.0, 2.0_f64.sqrt(), 0.0, 0.0]), None);
        // S = 0.37: 163 and 237 crests; found only where they fit into 16 a.
        let ratio = [0.815, 1.185];
        assert_eq!(
            common_period(&[4.0 * ratio[0], 4.0 * ratio[1], 0.0, 0.0]),
            None
        );
        let found = common_period(&[40.0 * ratio[0], 40.0 * ratio[1], 0.0, 0.0]);
        assert!((found.expect("short waves") - 5.0).abs() < 1e-9);
    }

    /// Ripples of both bodies and a transient that dies away.
    fn field(distance: f64, frequency: f64, left: f64) -> Vec<f64> {
        (0..32)
            .map(|i| {
                let x = f64::from(i) / 32.0;
                let phase = std::f64::consts::TAU * frequency * (x - distance);
                1.0 + 0.3 * phase.cos() + left * (-distance).exp()
            })
            .collect()
    }

    fn drift(frequencies: [f64; 4], real: f64, step: f64, left: f64) -> Repeat {
        let mut orbit = Orbit::new(32, 4.0);
        let mut contact = ContactState::empty(32, false);
        let mut metrics = Metrics::default();
        for n in 0..(12.0 / step) as usize {
            let distance = (n + 1) as f64 * step;
            let field = field(distance, real, left);
            metrics.h_central_m = field[16];
            (metrics.h_min_m, metrics.p_max_pa) = (1.0, 1.0);
            orbit.listen(frequencies, 4.0);
            contact.pressure.copy_from_slice(&field);
            contact.film.copy_from_slice(&field);
            orbit.push((distance, step, None), &contact, &metrics);
        }
        orbit.repeat(1.0)
    }

    #[test]
    fn an_orbit_closes_where_the_fields_come_back_and_not_otherwise() {
        for step in [1.0 / 32.0, 0.0317, 0.05] {
            let closed = drift([2.0, 0.0, 0.0, 0.0], 2.0, step, 0.0);
            println!("step {step}: drift {:?}", closed.drift);
            assert!(closed.repeats && closed.rhythm == Rhythm::Orbit);
            assert_eq!(closed.period_s, 0.5);
            // The fields follow another rhythm than the bodies do.
            let other = drift([2.0, 0.0, 0.0, 0.0], 2.3, step, 0.0);
            assert!(!other.repeats && other.drift.is_some());
        }
        let dying = drift([2.0, 0.0, 0.0, 0.0], 2.0, 0.03125, 1e3);
        assert!(!dying.repeats, "{dying:?}");
    }

    #[test]
    fn a_whole_number_of_fixed_steps_makes_as_few_periods_as_that_takes() {
        let fitting = |frequencies, step: f64| {
            let mut orbit = Orbit::new(1, 4.0);
            orbit.listen(frequencies, 4.0);
            orbit.fitting(step)
        };
        let rolls = [2.0, 0.0, 0.0, 0.0];
        // A period of 0.5: 17 steps of 0.0302 are 2.6 % off, two periods are 33; of 0.031 it is 16; 16 of a 32nd are it.
        let near = |one: f64, two: f64| assert!((one / two - 1.0).abs() < 1e-12, "{one} {two}");
        near(fitting(rolls, 0.0302), 1.0 / 33.0);
        near(fitting(rolls, 0.031), 0.5 / 16.0);
        assert_eq!(fitting(rolls, 1.0 / 32.0), 1.0 / 32.0);
        // Both bodies' waves: three crests and five, a period of 1.7.
        near(
            fitting([3.0 / 1.7, 5.0 / 1.7, 0.0, 0.0], 0.03125),
            1.7 / 54.0,
        );
        // Nothing repeats, nothing moves.
        assert_eq!(fitting([2.0, 3.0_f64.sqrt(), 0.0, 0.0], 0.03), 0.03);
        assert_eq!(fitting([0.0; 4], 0.03), 0.03);
    }

    #[test]
    fn without_a_common_period_means_are_compared_and_named_so() {
        let level = drift([2.0, 3.0_f64.sqrt(), 0.0, 0.0], 2.0, 0.03125, 0.0);
        assert_eq!(level.rhythm, Rhythm::Statistics);
        assert!(level.repeats, "{level:?}");
        let rising = drift([2.0, 3.0_f64.sqrt(), 0.0, 0.0], 2.0, 0.03125, 1e4);
        assert!(!rising.repeats, "{rising:?}");
    }
}
