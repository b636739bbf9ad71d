//! Relative life of the run so far: the running mean of the life integral over a passage of the roughness.
//!
//! ```text
//! Ī = Σ τ_s I_s / Σ τ_s     over the samples s of the last full period (phases of the roughness)
//! N/N_ref = (n_ref/n) (I_ref/Ī)^{1/e} = cycle · peak · traction
//! ```
//! The integral is averaged, not the life (the *snapshot* form of the literature). Integrals are kept and
//! added as logarithms. τ is the length of the step in whatever the period is given in (time, or distance
//! at U). Memory is bounded: when the samples of one period do not fit, neighbours are merged in pairs,
//! which leaves the mean as it is.

use std::collections::VecDeque;

use serde::{Deserialize, Serialize};

use super::stress::VolumeOut;
use crate::physics::fatigue::{CyclePair, IntegralLogs, LifeFactors, LifeLaw};

/// One sample, or several merged.
#[derive(Debug, Clone, Copy, Serialize, Deserialize)]
struct Phase {
    span: f64,
    normal: f64,
    full: f64,
}

/// Mean over the last period, and the life from it.
#[derive(Debug, Clone, Serialize, Deserialize)]
pub struct LifeMeter {
    law: LifeLaw,
    ln_reference: f64,
    period: f64,
    phases: VecDeque<Phase>,
    capacity: usize,
    total: f64,
    samples: u32,
}

/// Relative life now.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct LifeNow {
    /// Factors.
    pub factors: LifeFactors,
    /// ln of the mean integral with traction.
    pub ln_mean: f64,
    /// Ends of the band from the error of stress.
    pub band: (f64, f64),
    /// Samples since the last restart.
    pub samples: u32,
    /// How much of the period the mean covers.
    pub coverage: Coverage,
}

/// How much of a period a mean covers.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Coverage {
    /// Less than one period since the last restart.
    Partial,
    /// One full period.
    Settled,
}

impl LifeMeter {
    /// Meter against the reference integral `ln_reference`, over `period`, with memory for `capacity`
    /// samples (at least 16).
    pub fn new(law: LifeLaw, ln_reference: f64, period: f64, capacity: usize) -> Self {
        let capacity = capacity.max(16);
        Self {
            law,
            ln_reference,
            period,
            phases: VecDeque::with_capacity(capacity + 1),
            capacity,
            total: 0.0,
            samples: 0,
        }
    }

    /// Forgets the samples (after a change of load, speed or roughness) and takes a new period.
    pub fn restart(&mut self, period: f64) {
        self.phases.clear();
        (self.total, self.samples) = (0.0, 0);
        self.period = period;
    }

    /// Makes the room again that a copy or a file does not keep.
    pub fn make_room(&mut self) {
        let room = (self.capacity + 1).saturating_sub(self.phases.len());
        self.phases.reserve_exact(room);
    }

    /// Takes the mean over `period` from now on.
    pub fn set_period(&mut self, period: f64) {
        self.period = period;
    }

    /// Takes the integrals of a step of length `span`.
    pub fn push(&mut self, span: f64, volume: &VolumeOut) {
        if span <= 0.0 {
            return;
        }
        self.phases.push_back(Phase {
            span,
            normal: volume.normal.ln,
            full: volume.full.ln,
        });
        self.total += span;
        self.samples = self.samples.saturating_add(1);
        while let Some(first) = self.phases.front()
            && self.total - first.span >= self.period * (1.0 - 1e-9)
        {
            self.total -= first.span;
            self.phases.pop_front();
        }
        if self.phases.len() > self.capacity {
            self.merge_pairs();
        }
    }

    fn merge_pairs(&mut self) {
        let pairs = self.phases.len() / 2;
        for i in 0..pairs {
            let (a, b) = (self.phases[2 * i], self.phases[2 * i + 1]);
            let span = a.span + b.span;
            let mean = |a_ln: f64, b_ln: f64| ln_sum([(a.span, a_ln), (b.span, b_ln)]) - span.ln();
            self.phases[i] = Phase {
                span,
                normal: mean(a.normal, b.normal),
                full: mean(a.full, b.full),
            };
        }
        let odd = self.phases.len() % 2;
        if odd == 1 {
            self.phases[pairs] = self.phases[2 * pairs];
        }
        self.phases.truncate(pairs + odd);
    }

    /// Life with contacts per cycle `n` and a relative error of stress; `None` before the first sample.
    pub fn now(&self, n: CyclePair, stress_error: f64) -> Option<LifeNow> {
        if self.phases.is_empty() {
            return None;
        }
        let span: f64 = self.phases.iter().map(|p| p.span).sum();
        let mean =
            |ln: fn(&Phase) -> f64| ln_sum(self.phases.iter().map(|p| (p.span, ln(p)))) - span.ln();
        let ln = IntegralLogs {
            reference: self.ln_reference,
            normal: mean(|p| p.normal),
            full: mean(|p| p.full),
        };
        let factors = self.law.factors(n, ln);
        Some(LifeNow {
            factors,
            ln_mean: ln.full,
            band: self.law.band(factors.relative, stress_error),
            samples: self.samples,
            coverage: if span >= self.period * (1.0 - 1e-9) {
                Coverage::Settled
            } else {
                Coverage::Partial
            },
        })
    }
}

/// ln Σ w e^a.
fn ln_sum(terms: impl IntoIterator<Item = (f64, f64)> + Clone) -> f64 {
    let top = terms
        .clone()
        .into_iter()
        .fold(f64::NEG_INFINITY, |top, (_, a)| top.max(a));
    if top == f64::NEG_INFINITY {
        return top;
    }
    let sum: f64 = terms.into_iter().map(|(w, a)| w * (a - top).exp()).sum();
    top + sum.ln()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::solve::stress::{Integral, Peak};
    use approx::assert_relative_eq;

    const N: CyclePair = CyclePair {
        reference: 1.0,
        scene: 1.0,
    };

    fn volume(normal: f64, full: f64) -> VolumeOut {
        let integral = |i: f64| Integral {
            ln: i.ln(),
            peak: Peak::default(),
        };
        VolumeOut {
            normal: integral(normal),
            full: integral(full),
        }
    }

    #[test]
    fn mean_is_of_the_integral_over_the_last_period() {
        let law = LifeLaw::default();
        let mut meter = LifeMeter::new(law, 0.0, 4.0, 64);
        assert!(meter.now(N, 0.0).is_none());
        for (i, value) in [100.0, 1.0, 2.0, 3.0, 6.0].into_iter().enumerate() {
            meter.push(1.0, &volume(value, 2.0 * value));
            let coverage = meter.now(N, 0.0).expect("sampled").coverage;
            assert_eq!(coverage == Coverage::Settled, i >= 3);
        }
        let now = meter.now(N, 0.01).expect("sampled");
        assert_relative_eq!(now.ln_mean.exp(), 6.0, max_relative = 1e-12);
        assert_relative_eq!(now.factors.peak, 3.0_f64.powf(-0.9), max_relative = 1e-12);
        assert_relative_eq!(
            now.factors.traction,
            2.0_f64.powf(-0.9),
            max_relative = 1e-12
        );
        assert!(now.band.0 < now.factors.relative && now.factors.relative < now.band.1);
        meter.restart(2.0);
        assert!(meter.now(N, 0.0).is_none());
    }

    #[test]
    fn merging_keeps_the_mean() {
        let law = LifeLaw::default();
        let (mut small, mut large) = (
            LifeMeter::new(law, 0.0, 1e9, 16),
            LifeMeter::new(law, 0.0, 1e9, 4096),
        );
        for i in 0..1000 {
            let v = volume(1.0 + f64::from(i % 7), 2.0 + f64::from(i % 5));
            small.push(0.5 + f64::from(i % 3), &v);
            large.push(0.5 + f64::from(i % 3), &v);
        }
        let (a, b) = (small.now(N, 0.0), large.now(N, 0.0));
        let ln = |now: Option<LifeNow>| now.expect("sampled").ln_mean;
        assert_relative_eq!(ln(a), ln(b), max_relative = 1e-12);
        assert!(small.phases.len() <= 17);
    }
}
