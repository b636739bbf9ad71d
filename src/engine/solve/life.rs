//! Relative life of the run so far: the running mean of the life integral over a passage of the roughness.
//!
//! ```text
//! J_k   = Σ τ_s J_ks / Σ τ_s          share of depth k, over the samples s of the last full period (snapshot)
//! J_k   = Σ_rows w max_s max_x σ^m    maximum of each row over all samples (swept)
//! cycle · peak · traction = (J/J_n)^{1/e} (J_ref/J_p)^{1/e} (J_p/J)^{1/e} = N/N_ref
//! J = Σ_k J_k,   J_n = Σ_k n(z_k)^e J_k,   J_p: pressure alone
//! ```
//! The integral is averaged, not the life (the *snapshot* form of the literature); the *swept* form takes for
//! every track the maximum stress that passes over it, which is what a material point sees once S ≠ 0, and is
//! the bound. Integrals are kept and added as logarithms. τ is the length of the step in whatever the period
//! is given in (time, or distance at U); of the oldest sample counts what lies within the period, so that the mean
//! of what repeats with the period stands still. What never repeats has no such period: an open window goes on from the
//! last restart, and its mean converges as 1/distance. Memory is bounded: when the samples of one period do not fit,
//! neighbours are merged in pairs, which leaves the mean as it is. How far ln J has moved of late is kept at marks
//! an eighth of a period apart. A warm `push` allocates nothing.
//!
//! Sources: Lundberg and Palmgren (1947), Ioannides and Harris (1985) for the integral, Zaretsky (1987) without the depth's weight,
//! as in `physics/life_models.rs`. Ours: the running mean, and the three factors, whose product telescopes.

use serde::{Deserialize, Serialize};

use std::collections::VecDeque;
use std::ops::Range;

use super::marks::Marks;
use super::stress::Loading;
use crate::math::elementary;
use crate::math::ln_sum::{ln_list, ln_sum};
use crate::physics::cycles::BodyId;
use crate::physics::fatigue::{CyclePair, IntegralLogs, LifeFactors, LifeLaw};
use crate::physics::life_models::CycleProfile;
use crate::saved::{Saved, saved};

/// ln of every depth's share of J, for each of the four loadings (`[loading · depths + k]`).
#[derive(Debug, Clone, PartialEq, Default, Serialize, Deserialize)]
pub struct Shares {
    depths: usize,
    #[serde(with = "ln_list")]
    logs: Vec<f64>,
}

saved! {
    Shares { same: depths; parts: logs; }
}

impl Shares {
    /// Nothing at any depth.
    pub fn new(depths: usize) -> Self {
        Self {
            depths,
            logs: vec![f64::NEG_INFINITY; 4 * depths],
        }
    }

    /// Shares of one loading.
    pub fn of(&self, loading: Loading) -> &[f64] {
        &self.logs[loading.index() * self.depths..][..self.depths]
    }

    /// Same, to fill.
    pub fn of_mut(&mut self, loading: Loading) -> &mut [f64] {
        &mut self.logs[loading.index() * self.depths..][..self.depths]
    }

    /// ln of the sum over depths.
    pub fn ln(&self, loading: Loading) -> f64 {
        ln_sum(self.of(loading).iter().map(|ln| (1.0, *ln)))
    }

    /// Same of both bodies under their full load.
    fn ln_full(&self) -> [f64; 2] {
        BodyId::BOTH.map(|body| self.ln(Loading::Full(body)))
    }

    /// Nothing at any depth again.
    pub fn clear(&mut self) {
        self.logs.fill(f64::NEG_INFINITY);
    }
}

/// Batches of samples, and what holds the mean of eight means with 90 %: t of seven degrees of freedom.
const BATCHES: usize = 8;
const STUDENT: f64 = 1.895;

/// One sample, or several merged.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
struct MergedPhase {
    span: f64,
    shares: Shares,
}

saved! {
    MergedPhase { parts: shares; free: span; }
    holds |_, saved| saved.span > 0.0
}

/// Samples of a window, the oldest first, in memory that is made once.
#[derive(Clone, PartialEq, Serialize, Deserialize)]
#[serde(transparent)]
struct Phases {
    list: VecDeque<MergedPhase>,
    /// ln J of each under the full load of both bodies.
    #[serde(skip)]
    ln: VecDeque<[f64; 2]>,
    /// Not in use.
    #[serde(skip)]
    spare: Vec<MergedPhase>,
}

/// What a file holds of it: two that show the same are the same state.
impl std::fmt::Debug for Phases {
    fn fmt(&self, out: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        self.list.fmt(out)
    }
}

impl Phases {
    /// Memory for so many of so many depths.
    fn new(room: usize, depths: usize) -> Self {
        let empty = MergedPhase {
            span: 0.0,
            shares: Shares::new(depths),
        };
        Self {
            list: VecDeque::with_capacity(room),
            ln: VecDeque::with_capacity(room),
            spare: vec![empty; room],
        }
    }

    fn clear(&mut self) {
        self.spare.extend(self.list.drain(..));
        self.ln.clear();
    }

    fn drop_first(&mut self) {
        self.spare.extend(self.list.pop_front());
        self.ln.pop_front();
    }

    /// Takes a sample; false: there is no memory left for it.
    fn push(&mut self, span: f64, shares: &Shares) -> bool {
        let Some(mut phase) = self.spare.pop() else {
            return false;
        };
        phase.span = span;
        phase.shares.logs.copy_from_slice(&shares.logs);
        self.ln.push_back(phase.shares.ln_full());
        self.list.push_back(phase);
        true
    }

    /// Makes one of every two.
    fn merge_pairs(&mut self) {
        for pair in 0..self.list.len() / 2 {
            let Some(other) = self.list.remove(pair + 1) else {
                break;
            };
            let one = &mut self.list[pair];
            let span = one.span + other.span;
            for (a, b) in one.shares.logs.iter_mut().zip(&other.shares.logs) {
                *a = ln_sum([(one.span, *a), (other.span, *b)]) - span.ln();
            }
            one.span = span;
            self.spare.push(other);
        }
        self.ln.clear();
        self.ln
            .extend(self.list.iter().map(|phase| phase.shares.ln_full()));
    }
}

/// Logarithms whose means are taken side by side.
const SIDE_BY_SIDE: usize = 16;

dispatched! {
/// `ln Σ τ e^a − ln Σ τ` of every logarithm, without the `beyond` of the oldest sample's span.
fn mean_logs(list: &VecDeque<MergedPhase>, beyond: f64, means: &mut [f64]) {
    let span = |k: usize| list[k].span - if k == 0 { beyond } else { 0.0 };
    let ln_all = (0..list.len()).map(span).sum::<f64>().ln();
    for (part, means) in means.chunks_mut(SIDE_BY_SIDE).enumerate() {
        let here = part * SIDE_BY_SIDE..part * SIDE_BY_SIDE + means.len();
        let (mut tops, mut sums) = ([f64::NEG_INFINITY; SIDE_BY_SIDE], [0.0; SIDE_BY_SIDE]);
        for phase in list {
            for (top, a) in tops.iter_mut().zip(&phase.shares.logs[here.clone()]) {
                *top = if *a > *top { *a } else { *top };
            }
        }
        for (k, phase) in list.iter().enumerate() {
            let span = span(k);
            let logs = &phase.shares.logs[here.clone()];
            for ((sum, top), a) in sums.iter_mut().zip(&tops).zip(logs) {
                *sum += span * elementary::exp(a - top);
            }
        }
        for ((mean, top), sum) in means.iter_mut().zip(tops).zip(sums) {
            // Nothing at any time stays nothing.
            *mean = if top.is_finite() { top + sum.ln() - ln_all } else { top };
        }
    }
}
}

impl Saved for Phases {
    fn check(&self, saved: &Self) -> Result<(), String> {
        if saved.list.len() > self.list.len() + self.spare.len() {
            return Err(String::new());
        }
        let own = self.list.iter().chain(&self.spare).cycle();
        let mut pairs = own.zip(&saved.list);
        pairs.try_for_each(|(own, saved)| own.check(saved))
    }

    fn restore(&mut self, saved: &Self) {
        self.clear();
        for phase in &saved.list {
            self.push(phase.span, &phase.shares);
        }
    }
}

/// Which samples a mean is taken over.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub struct Window {
    /// Distance after which a mean says something; a closed window is as long.
    pub period: f64,
    /// Distance over which is looked at whether the mean still moves: a whole number of periods, as few as say something.
    pub round: f64,
    /// Whether older samples stay in the mean: those of what never repeats.
    pub is_open: bool,
}

impl Window {
    /// The last `period`.
    pub fn closed(period: f64) -> Self {
        Self {
            period,
            round: period,
            is_open: false,
        }
    }

    /// All since the last restart, from `period` on.
    pub fn open(period: f64) -> Self {
        Self {
            period,
            round: period,
            is_open: true,
        }
    }
}

/// Mean over a window.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct LifeMeter {
    window: Window,
    phases: Phases,
    capacity: usize,
    total: f64,
    samples: u32,
    mean: Shares,
    /// Distance pushed since the last restart.
    #[serde(rename = "way")]
    distance: f64,
    /// ln J under the full load of both bodies.
    marks: Marks,
}

saved! {
    LifeMeter {
        same: capacity;
        parts: phases, mean, marks;
        free: window, total, samples, distance;
    }
    holds |_, saved| saved.window.period > 0.0 && saved.window.round > 0.0
}

impl LifeMeter {
    /// Meter of `depths` depths over `window`, with memory for `capacity` samples (at least 16).
    pub fn new(depths: usize, window: Window, capacity: usize) -> Self {
        let capacity = capacity.max(16);
        Self {
            window,
            phases: Phases::new(capacity + 1, depths),
            capacity,
            total: 0.0,
            samples: 0,
            mean: Shares::new(depths),
            distance: 0.0,
            marks: Marks::new(),
        }
    }

    /// Takes the mean over `window` from now on.
    pub fn set_window(&mut self, window: Window) {
        if window != self.window {
            self.window = window;
            self.marks.forget();
        }
    }

    /// Forgets the samples (after a change of load, speed or roughness).
    pub fn restart(&mut self) {
        self.phases.clear();
        (self.total, self.samples, self.distance) = (0.0, 0, 0.0);
        self.mean.clear();
        self.marks.forget();
    }

    /// Takes the shares of a step of length `span`.
    pub fn push(&mut self, span: f64, shares: &Shares) {
        if span <= 0.0 || !self.phases.push(span, shares) {
            return;
        }
        self.total += span;
        self.distance += span;
        self.samples = self.samples.saturating_add(1);
        while !self.window.is_open
            && let Some(first) = self.phases.list.front()
            && self.total - first.span >= self.window.period * (1.0 - 1e-9)
        {
            self.total -= first.span;
            self.phases.drop_first();
        }
        if self.phases.list.len() > self.capacity {
            self.phases.merge_pairs();
        }
        self.take_mean();
        if self.covers() && self.marks.is_due(self.distance) {
            let now = self.mean.ln_full();
            self.marks.take(self.distance, self.window.round, now);
        }
    }

    /// How far ln J moved since the mean first covered a period.
    pub fn marks(&self) -> &Marks {
        &self.marks
    }

    /// How far off ln J the mean of all samples may be, with 90 % and of the body where it is more, if what is to come is as
    /// what was seen: by the means of [`BATCHES`] batches, s/√n times t of Student's distribution, over their mean; 0 of fewer
    /// samples. Source: the method of batch means, Conway (1963).
    pub fn unsure(&self) -> f64 {
        let Phases { list, ln, .. } = &self.phases;
        if list.len() < BATCHES {
            return 0.0;
        }
        let of = |body: BodyId| {
            let mean = |batch: Range<usize>| {
                let spans = list.range(batch.clone()).map(|phase| phase.span);
                let logs = ln.range(batch).map(|ln| ln[body.index()]);
                ln_sum(spans.clone().zip(logs)) - spans.sum::<f64>().ln()
            };
            let whole = mean(0..list.len());
            let at = |batch: usize| batch * list.len() / BATCHES;
            let off = |batch: usize| (mean(at(batch)..at(batch + 1)) - whole).exp() - 1.0;
            let squares: f64 = (0..BATCHES).map(|batch| off(batch).powi(2)).sum();
            let n = BATCHES as f64;
            let relative = STUDENT * (squares / (n * (n - 1.0))).sqrt();
            // Nothing at any time is sure.
            if relative.is_finite() {
                relative.ln_1p()
            } else {
                0.0
            }
        };
        BodyId::BOTH.map(of).into_iter().fold(0.0, f64::max)
    }

    /// Distance since the last restart, and over which the mean is looked at.
    pub fn distance(&self) -> (f64, f64) {
        (self.distance, self.window.round)
    }

    fn take_mean(&mut self) {
        let all: f64 = self.phases.list.iter().map(|p| p.span).sum();
        let beyond = if self.window.is_open {
            0.0
        } else {
            (all - self.window.period).max(0.0)
        };
        mean_logs(&self.phases.list, beyond, &mut self.mean.logs);
    }

    /// Mean shares over the window; `None` before the first sample.
    pub fn mean(&self) -> Option<&Shares> {
        (!self.phases.list.is_empty()).then_some(&self.mean)
    }

    /// Samples since the last restart.
    pub fn samples(&self) -> u32 {
        self.samples
    }

    /// Whether the mean covers a period.
    pub fn covers(&self) -> bool {
        let span: f64 = self.phases.list.iter().map(|p| p.span).sum();
        span >= self.window.period * (1.0 - 1e-9)
    }
}

/// The maximum of every row, or of every depth, over all samples since the last restart.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct SweptRows {
    tops: [Vec<f32>; 4],
}

saved! {
    SweptRows { parts: tops; }
}

impl SweptRows {
    /// Of `rows` rows.
    pub fn new(rows: usize) -> Self {
        Self {
            tops: [0, 1, 2, 3].map(|_| vec![0.0; rows]),
        }
    }

    /// Forgets all.
    pub fn restart(&mut self) {
        self.tops.iter_mut().for_each(|tops| tops.fill(0.0));
    }

    /// Takes the rows of one surface.
    pub fn push(&mut self, loading: Loading, tops: &[f32]) {
        for (most, &top) in self.tops[loading.index()].iter_mut().zip(tops) {
            *most = most.max(top);
        }
    }

    /// Maximum so far.
    pub fn of(&self, loading: Loading) -> &[f32] {
        &self.tops[loading.index()]
    }
}

/// Factors of one body's life: `shares` against the reference `ln_reference`, with cycles by `profile`.
pub fn factors(
    law: LifeLaw,
    shares: &Shares,
    body: BodyId,
    ln_reference: f64,
    profile: CycleProfile,
) -> LifeFactors {
    let full = shares.of(Loading::Full(body));
    let ln_full = shares.ln(Loading::Full(body));
    let n = match profile {
        CycleProfile::Global(n) => n,
        CycleProfile::Counted(_) => {
            let e = law.weibull_slope;
            let weighted = full.iter().enumerate();
            let weighted = weighted.map(|(k, ln)| (1.0, ln + e * profile.at(k).ln()));
            ((ln_sum(weighted) - ln_full) / e).exp()
        }
    };
    law.factors(
        CyclePair {
            reference: 1.0,
            scene: n,
        },
        IntegralLogs {
            reference: ln_reference,
            normal: shares.ln(Loading::Normal(body)),
            full: ln_full,
        },
    )
}

#[cfg(test)]
mod tests {
    use super::*;
    use approx::assert_relative_eq;

    const NORMAL: Loading = Loading::Normal(BodyId::One);
    const FULL: Loading = Loading::Full(BodyId::One);

    fn shares(normal: f64, full: f64) -> Shares {
        let mut shares = Shares::new(2);
        shares.of_mut(NORMAL).fill((0.5 * normal).ln());
        shares.of_mut(FULL).fill((0.5 * full).ln());
        shares
    }

    #[test]
    fn mean_is_of_the_integral_over_the_last_period() {
        let law = LifeLaw::default();
        let mut meter = LifeMeter::new(2, Window::closed(4.0), 64);
        assert!(meter.mean().is_none());
        for (i, value) in [100.0, 1.0, 2.0, 3.0, 6.0].into_iter().enumerate() {
            meter.push(1.0, &shares(value, 2.0 * value));
            assert_eq!(meter.covers(), i >= 3);
        }
        let mean = meter.mean().expect("sampled");
        assert_relative_eq!(mean.ln(FULL).exp(), 6.0, max_relative = 1e-12);
        let profile = CycleProfile::Global(4.0);
        let f = factors(law, mean, BodyId::One, 0.0, profile);
        assert_relative_eq!(f.peak, 3.0_f64.powf(-0.9), max_relative = 1e-12);
        assert_relative_eq!(f.traction, 2.0_f64.powf(-0.9), max_relative = 1e-12);
        assert_eq!(f.cycle, 0.25);
        meter.restart();
        assert!(meter.mean().is_none());
    }

    /// Batches of 1 and 3 in turns: mean 2, s = √(8/7), so that ln J may be off by ln (1 + 1.895 √(1/7)/2) = 0.30610.
    #[test]
    fn an_unfinished_mean_is_as_unsure_as_its_batches_differ() {
        let mut meter = LifeMeter::new(2, Window::closed(100.0), 64);
        assert_eq!(meter.unsure(), 0.0);
        for k in 0..16 {
            // Two samples make a batch.
            let batch = [[0.5, 1.5], [2.5, 3.5]][(k / 2) % 2];
            let value = batch[k % 2];
            meter.push(1.0, &shares(value, 2.0 * value));
        }
        assert_relative_eq!(meter.unsure(), 0.30610, max_relative = 1e-4);
        assert!(!meter.covers());
    }

    #[test]
    fn the_mean_of_what_repeats_with_the_period_stands_still_and_a_drift_moves_it() {
        // 6.4 samples a period: 2 + sin, whose mean is 2 wherever the period begins.
        let period = 6.4;
        let at = |distance: f64| 2.0 + (std::f64::consts::TAU * distance / period).sin();
        let (mut still, mut drifting) = [1, 2]
            .map(|_| LifeMeter::new(2, Window::closed(period), 64))
            .into();
        for step in 0..60 {
            let distance = f64::from(step) + 0.5;
            still.push(1.0, &shares(at(distance), at(distance)));
            let drift = at(distance) * (0.01 * distance).exp();
            drifting.push(1.0, &shares(drift, drift));
            if distance < 1.5 * period - 1.0 {
                assert_eq!(still.marks().moved(0.5), None, "{distance}");
            }
        }
        let [still, drifting] = [&still, &drifting].map(|m| m.marks().moved(0.5).expect("marks"));
        println!("moved: periodic {still:.4}, drifting {drifting:.4}");
        // Samples are taken for constant over their length: of the one that is cut at f its mean is off by f (1 - f)/2 of
        // the change to the next (0.98 at most), in each of the two windows, over a period's sum of 12.8: 0.019.
        assert!(still < 0.02, "{still}");
        let expected = 0.01 * 0.5 * period;
        assert!((drifting - expected).abs() < 0.02, "{drifting} {expected}");
    }

    #[test]
    fn the_mean_of_what_never_repeats_converges_in_an_open_window() {
        // Two waves whose lengths have no common multiple, a window of 4: neither fits into it.
        let at =
            |distance: f64| 2.0 + (1.1 * distance).sin() * (1.1 * 2.0_f64.sqrt() * distance).sin();
        let (mut open, mut closed) = (
            LifeMeter::new(2, Window::open(4.0), 64),
            LifeMeter::new(2, Window::closed(4.0), 64),
        );
        let far = |meter: &LifeMeter| {
            (meter.mean().expect("sampled").ln(FULL).exp() / 2.0)
                .ln()
                .abs()
        };
        let (mut most_open, mut most_closed) = (0.0_f64, 0.0_f64);
        for step in 0..2000 {
            let distance = 0.1 * (f64::from(step) + 0.5);
            open.push(0.1, &shares(at(distance), at(distance)));
            closed.push(0.1, &shares(at(distance), at(distance)));
            if distance > 12.0 {
                // What is shown as its error holds the mean of all times, and shrinks.
                assert!(far(&open) <= open.marks().wandered(), "{distance}");
                most_closed = most_closed.max(far(&closed));
            }
            if distance > 100.0 {
                most_open = most_open.max(open.marks().wandered());
            }
        }
        println!("open wanders {most_open:.4}, closed is off by {most_closed:.4}");
        assert!(most_open < 0.02 && most_closed > 0.1);
    }

    #[test]
    fn cycles_weigh_the_depth_that_they_reach() {
        let law = LifeLaw::default();
        let mut shares = shares(1.0, 1.0);
        shares
            .of_mut(FULL)
            .copy_from_slice(&[0.2_f64.ln(), 0.8_f64.ln()]);
        let cycle = |profile| factors(law, &shares, BodyId::One, 0.0, profile).cycle;
        // n = 9 in a fifth of the integral: J_n/J = 0.2 · 9^e + 0.8.
        let expected = (0.2 * 9.0_f64.powf(law.weibull_slope) + 0.8).powf(-0.9);
        let counted = CycleProfile::Counted(&[9.0, 1.0]);
        assert_relative_eq!(cycle(counted), expected, max_relative = 1e-12);
        assert!(cycle(CycleProfile::Global(9.0)) < cycle(counted));
    }

    #[test]
    fn merging_keeps_the_mean() {
        let (mut small, mut large) = [16, 4096]
            .map(|room| LifeMeter::new(2, Window::closed(1e9), room))
            .into();
        for i in 0..1000 {
            let s = shares(1.0 + f64::from(i % 7), 2.0 + f64::from(i % 5));
            small.push(0.5 + f64::from(i % 3), &s);
            large.push(0.5 + f64::from(i % 3), &s);
        }
        let ln = |meter: &LifeMeter| meter.mean().expect("sampled").ln(FULL);
        assert_relative_eq!(ln(&small), ln(&large), max_relative = 1e-12);
        let Phases { list, spare, .. } = &small.phases;
        assert!(list.len() <= 17 && list.len() + spare.len() == 17);
    }

    #[test]
    fn a_depth_that_is_never_stressed_has_no_share() {
        let mut meter = LifeMeter::new(2, Window::closed(4.0), 64);
        for value in [1.0, 3.0] {
            let mut sample = Shares::new(2);
            sample.of_mut(FULL)[0] = f64::ln(value);
            meter.push(1.0, &sample);
        }
        let mean = meter.mean().expect("sampled");
        assert_eq!(mean.of(FULL)[1], f64::NEG_INFINITY);
        assert_relative_eq!(mean.of(FULL)[0], 2.0_f64.ln(), max_relative = 1e-12);
        assert_eq!(mean.of(NORMAL), [f64::NEG_INFINITY; 2]);
    }

    #[test]
    fn a_sweep_keeps_the_greatest() {
        let mut sweep = SweptRows::new(3);
        sweep.push(FULL, &[1.0, 5.0, 2.0]);
        sweep.push(FULL, &[3.0, 4.0, 0.0]);
        assert_eq!(sweep.of(FULL), [3.0, 5.0, 2.0]);
        assert_eq!(sweep.of(NORMAL), [0.0; 3]);
        sweep.restart();
        assert_eq!(sweep.of(FULL), [0.0; 3]);
    }
}
