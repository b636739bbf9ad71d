//! Relative life from the integrals of the phases seen.
//!
//! ```text
//! N/N_ref = cycle × peak × traction
//! cycle    = n_ref/n                        peak = (I_ref/<I_normal>)^(1/e)
//! traction = (<I_normal>/<I_full>)^(1/e)    <.> mean over the phases of the last passage
//! ```
//! The reference is the same scene smooth, frictionless, with S = 0: it is computed in the start-up.
//! n is that of the body that suffers more per own loading cycle; n_ref = 1.

use super::frame::LifeEstimate;
use crate::solve::stress::VolumeOut;

/// Ring of integrals.
#[derive(Debug, Clone)]
pub struct LifeStage {
    /// m = c e.
    pub exponent: f64,
    weibull_slope: f64,
    ln_reference: f64,
    phases: Vec<(f64, f64)>,
    filled: usize,
    next: usize,
    since_change: usize,
}

impl LifeStage {
    /// Room for `phases` phases.
    pub fn new(stress_exponent: f64, weibull_slope: f64, phases: usize) -> Self {
        Self {
            exponent: stress_exponent * weibull_slope,
            weibull_slope,
            ln_reference: f64::NEG_INFINITY,
            phases: vec![(0.0, 0.0); phases.max(1)],
            filled: 0,
            next: 0,
            since_change: 0,
        }
    }

    /// Takes the reference's integral and forgets all phases.
    pub fn set_reference(&mut self, reference: &VolumeOut) {
        self.ln_reference = reference.normal.ln;
        self.forget();
    }

    /// Forgets all phases: what was seen belongs to other conditions.
    pub fn forget(&mut self) {
        (self.filled, self.next, self.since_change) = (0, 0, 0);
    }

    /// A knob moved: the mean goes on but is not settled.
    pub fn unsettle(&mut self) {
        self.since_change = 0;
    }

    /// Takes one phase.
    pub fn push(&mut self, out: &VolumeOut) {
        self.phases[self.next] = (out.normal.ln, out.full.ln);
        self.next = (self.next + 1) % self.phases.len();
        self.filled = (self.filled + 1).min(self.phases.len());
        self.since_change += 1;
    }

    /// Whether a full passage was seen since the last change.
    pub fn is_settled(&self) -> bool {
        self.since_change >= self.phases.len()
    }

    /// The estimate for the cycle numbers `n` of both bodies.
    pub fn estimate(&self, n: [Option<f64>; 2]) -> Option<LifeEstimate> {
        if self.filled == 0 || !self.ln_reference.is_finite() {
            return None;
        }
        let seen = &self.phases[..self.filled];
        let (normal, spread) = self.mean(seen.iter().map(|p| p.0));
        let (full, _) = self.mean(seen.iter().map(|p| p.1));
        let e = self.weibull_slope;
        let peak_factor = ((self.ln_reference - normal) / e).exp();
        let traction_factor = ((normal - full) / e).exp();
        let stress_factor = peak_factor * traction_factor;
        let cycle_factor = 1.0 / n.into_iter().flatten().fold(1.0_f64, f64::max);
        let life_relative = cycle_factor * stress_factor;
        let band = (spread / e).exp();
        Some(LifeEstimate {
            i_ref: self.ln_reference.exp(),
            i_mean: full.exp(),
            phases: self.filled as u32,
            cycle_factor,
            stress_factor,
            peak_factor,
            traction_factor,
            life_relative,
            life_relative_low: life_relative / band,
            life_relative_high: life_relative * band,
            settled: self.is_settled(),
        })
    }

    /// ln of the mean of exp, and the standard error of it.
    fn mean(&self, lns: impl Iterator<Item = f64> + Clone) -> (f64, f64) {
        let top = lns.clone().fold(f64::NEG_INFINITY, f64::max);
        let count = lns.clone().count() as f64;
        let ratio = |ln: f64| (ln - top).exp();
        let mean = lns.clone().map(ratio).sum::<f64>() / count;
        let variance = lns.map(|ln| (ratio(ln) / mean - 1.0).powi(2)).sum::<f64>() / count;
        (top + mean.ln(), (variance / count).sqrt())
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::solve::stress::{Integral, Peak};

    fn out(normal: f64, full: f64) -> VolumeOut {
        let integral = |ln| Integral {
            ln,
            peak: Peak::default(),
        };
        VolumeOut {
            normal: integral(normal),
            full: integral(full),
        }
    }

    #[test]
    fn factors_multiply_and_the_reference_is_one() {
        let mut life = LifeStage::new(31.0 / 3.0, 10.0 / 9.0, 4);
        life.set_reference(&out(-6.7, -6.7));
        life.push(&out(-6.7, -6.7));
        let same = life.estimate([Some(1.0), Some(1.0)]).expect("a phase");
        assert_eq!(same.life_relative, 1.0);
        life.push(&out(-5.0, -4.0));
        let worse = life.estimate([Some(5.0), Some(3.0)]).expect("phases");
        let product = worse.cycle_factor * worse.peak_factor * worse.traction_factor;
        assert!((product / worse.life_relative - 1.0).abs() < 1e-14);
        assert_eq!(worse.cycle_factor, 0.2);
        assert!(!worse.settled);
    }
}
