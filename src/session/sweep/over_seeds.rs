//! What hangs on chance: cases that differ in the seeds of their surfaces alone, taken together.
//!
//! ```text
//! mean = exp ⟨ln N⟩,   scatter = exp s,   s² = Σ (ln N − ⟨ln N⟩)²/(n − 1)
//! mean's own factor = exp (s/√n),   seeds_for_10_percent = (s/ln 1.1)²
//! ln(−ln(1 − F_i)) = β ln N_i + const by least squares,   F_i = (i − 0.3)/(n + 0.4)     (Benard's median ranks)
//! ```
//! Lives of patches differ by factors, so their logarithms are averaged; β is the Weibull slope of the lives of patches, which
//! is not the slope of the material.

use std::collections::BTreeMap;
use std::fmt::Write as _;

use super::spec::Sweep;
use super::table::{Rows, write_value};
use crate::cells::{Cells, csv_line};

/// Numbers that are averaged, by their columns in the table.
const AVERAGED: [&str; 8] = [
    "life_common",
    "life_damage",
    "life_global",
    "p_max_greatest_pa",
    "h_min_least_m",
    "contact_ratio",
    "n_counted_body_1",
    "n_counted_body_2",
];

/// Positive numbers of some cases, summed up.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Scatter {
    /// How many.
    pub n: usize,
    /// exp of the mean of their logarithms.
    pub mean: f64,
    /// exp of the standard deviation of those; 1 of one number.
    pub scatter: f64,
    /// Least and greatest.
    pub ends: [f64; 2],
    /// β; `None`: fewer than three numbers, or all the same.
    pub weibull_slope: Option<f64>,
}

impl Scatter {
    /// Of the positive ones among `numbers`; `None`: there are none.
    pub fn of(numbers: impl IntoIterator<Item = f64>) -> Option<Self> {
        let mut logs: Vec<f64> = (numbers.into_iter())
            .filter(|v| v.is_finite() && *v > 0.0)
            .map(f64::ln)
            .collect();
        logs.sort_by(f64::total_cmp);
        let (first, last) = (*logs.first()?, *logs.last()?);
        let n = logs.len() as f64;
        let mean = logs.iter().sum::<f64>() / n;
        let squares: f64 = logs.iter().map(|log| (log - mean).powi(2)).sum();
        let ranks = (1..=logs.len()).map(|i| {
            let failed = (i as f64 - 0.3) / (n + 0.4);
            (-(1.0 - failed).ln()).ln()
        });
        let ranks: Vec<f64> = ranks.collect();
        let middle = ranks.iter().sum::<f64>() / n;
        let product: f64 = (logs.iter().zip(&ranks))
            .map(|(log, rank)| (log - mean) * (rank - middle))
            .sum();
        Some(Self {
            n: logs.len(),
            mean: mean.exp(),
            scatter: (squares / (n - 1.0).max(1.0)).sqrt().exp(),
            ends: [first.exp(), last.exp()],
            weibull_slope: (logs.len() > 2 && squares > 0.0).then(|| product / squares),
        })
    }

    /// Factor within which the mean is known, one standard error either way.
    pub fn of_mean(&self) -> f64 {
        (self.scatter.ln() / (self.n as f64).sqrt()).exp()
    }

    /// Seeds that would bring [`Scatter::of_mean`] to 1.1.
    pub fn enough(&self) -> f64 {
        (self.scatter.ln() / 1.1_f64.ln()).powi(2).ceil()
    }
}

impl Sweep {
    /// Places of the axes that are seeds, and of the others.
    pub(super) fn seed_axes(&self) -> (Vec<usize>, Vec<usize>) {
        (0..self.axes.len()).partition(|&axis| self.axes[axis].key.ends_with(".surface.seed"))
    }

    /// Cases that differ in their seeds alone, together; empty: no seed varies.
    pub(super) fn over_seeds(&self) -> Vec<Vec<usize>> {
        let (seeds, others) = self.seed_axes();
        let mut groups: BTreeMap<Vec<usize>, Vec<usize>> = BTreeMap::new();
        if seeds.is_empty() {
            return Vec::new();
        }
        for case in 0..self.len() {
            let place = self.place(case);
            let own = others.iter().map(|&axis| place[axis]).collect();
            groups.entry(own).or_default().push(case);
        }
        groups.into_values().collect()
    }
}

impl Rows {
    /// A table of what the seeds make of each of the other cases; `None`: no seed varies.
    pub fn seeds_csv(&self, sweep: &Sweep) -> Option<String> {
        let groups = sweep.over_seeds();
        groups.first()?;
        let (_, others) = sweep.seed_axes();
        let columns = ["n", "mean", "scatter", "of_mean", "least", "greatest"];
        let head = (others.iter().map(|&axis| sweep.axes[axis].key.clone()))
            .chain(["seeds", "seeds_for_10_percent", "weibull_slope"].map(str::to_owned))
            .chain(
                AVERAGED
                    .iter()
                    .flat_map(|name| columns[1..].iter().map(move |of| format!("{name}_{of}"))),
            );
        let mut text = csv_line(head);
        let mut row = Cells::default();
        for group in &groups {
            row.clear();
            for &axis in &others {
                write_value(&mut row, sweep.values(group[0])[axis]);
            }
            let life = self.scatter(sweep, AVERAGED[0], group);
            row.text(group.len());
            row.optional(life.map(|life| life.enough()));
            row.optional(life.and_then(|life| life.weibull_slope));
            for name in AVERAGED {
                let found = self.scatter(sweep, name, group);
                row.optional(found.map(|f| f.mean));
                row.optional(found.map(|f| f.scatter));
                row.optional(found.map(|f| f.of_mean()));
                row.optional(found.map(|f| f.ends[0]));
                row.optional(found.map(|f| f.ends[1]));
            }
            text.push_str(&csv_line(row.iter()));
        }
        Some(text)
    }

    fn scatter(&self, sweep: &Sweep, name: &str, group: &[usize]) -> Option<Scatter> {
        let column = self.column(sweep, name)?;
        Scatter::of(group.iter().map(|&case| column[case]))
    }

    /// The lives in words, a line each; empty: no seed varies.
    pub fn seeds_lines(&self, sweep: &Sweep) -> Vec<String> {
        let (_, others) = sweep.seed_axes();
        let line = |group: Vec<usize>| {
            let life = self.scatter(sweep, AVERAGED[0], &group)?;
            let mut at = String::new();
            for &axis in &others {
                let key = &sweep.axes[axis].key;
                let value = sweep.values(group[0])[axis];
                let _ = write!(at, "{} {value}, ", key.rsplit('.').next().unwrap_or(key));
            }
            let slope = life
                .weibull_slope
                .map_or_else(String::new, |b| format!(", Weibull slope {b:.2}"));
            Some(format!(
                "{at}{} seeds: life {:.3} on average (known to a factor of {:.2}), one pair a factor of {:.2} either way, {:.3} to {:.3}{slope}; {} seeds would know the average to a tenth",
                life.n,
                life.mean,
                life.of_mean(),
                life.scatter,
                life.ends[0],
                life.ends[1],
                life.enough()
            ))
        };
        sweep.over_seeds().into_iter().filter_map(line).collect()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// By hand: ln of 1, e² and e⁴ have the mean 2 and the deviation 2. A Weibull sample at its own median ranks has its slope.
    #[test]
    fn logarithms_are_averaged() {
        let e = std::f64::consts::E;
        let found = Scatter::of([e.powi(4), 1.0, f64::NAN, e.powi(2), 0.0]).expect("three");
        assert_eq!(found.n, 3);
        assert!((found.mean / e.powi(2) - 1.0).abs() < 1e-12);
        assert!((found.scatter / e.powi(2) - 1.0).abs() < 1e-12);
        assert!((found.of_mean().ln() - 2.0 / 3_f64.sqrt()).abs() < 1e-12);
        assert_eq!(found.enough(), (2.0 / 1.1_f64.ln()).powi(2).ceil());
        let quantile = |i: usize| (-(1.0 - (i as f64 - 0.3) / 20.4).ln()).powf(1.0 / 1.7);
        let slope = Scatter::of((1..=20).map(quantile)).and_then(|found| found.weibull_slope);
        assert!((slope.unwrap_or_default() - 1.7).abs() < 1e-9, "{slope:?}");
        assert_eq!(Scatter::of([f64::NAN]), None);
    }
}
