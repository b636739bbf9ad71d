//! Means over the last passage, and what a summary says of them.

use std::collections::{BTreeMap, VecDeque};

use serde::de::Error as _;
use serde::{Deserialize, Deserializer, Serialize};

use super::frame::{SUMMED, summed, total};
use super::{CATALOGUE, Grounds, Metrics, Over, Summary};
use crate::saved::saved;

/// One step.
#[derive(Debug, Clone, Copy, Serialize, Deserialize)]
struct Entry {
    /// Distance at its end, in a.
    #[serde(rename = "way")]
    distance: f64,
    /// Its length, in a.
    span: f64,
    /// What the catalogue sums up, in its order.
    #[serde(deserialize_with = "padded")]
    values: [Option<f64>; SUMMED],
    /// Greatest effective stress: value, depth, x.
    stress: Option<[f64; 3]>,
    /// What both bodies have yielded up to its end, m³.
    yielded_m3: f64,
}

/// Values of a state saved before the catalogue got its last lines: what those read is not known of its steps.
fn padded<'de, D: Deserializer<'de>>(saved: D) -> Result<[Option<f64>; SUMMED], D::Error> {
    let known = Vec::<Option<f64>>::deserialize(saved)?;
    let mut values = [None; SUMMED];
    let Some(first) = values.get_mut(..known.len()) else {
        return Err(D::Error::invalid_length(
            known.len(),
            &"fewer values of a step",
        ));
    };
    first.copy_from_slice(&known);
    Ok(values)
}

/// What the summary averages over the last passage or period, each step by its length.
#[derive(Debug, Clone, Default, Serialize, Deserialize)]
pub(super) struct Totals {
    recent: VecDeque<Entry>,
    window: f64,
    #[serde(rename = "way")]
    distance: f64,
    not_converged: u64,
}

saved! {
    Totals { free: recent, window, distance, not_converged; }
}

impl Totals {
    /// None yet, with memory for `most` steps.
    pub(super) fn new(most: usize) -> Self {
        Self {
            recent: VecDeque::with_capacity(most + 2),
            ..Self::default()
        }
    }

    /// Forgets the steps so far, but not those that failed.
    pub(super) fn restart(&mut self) {
        self.recent.clear();
    }

    /// Takes a step that ended at `distance` (in a); keeps what the last `window` (in a) touches.
    pub(super) fn push(&mut self, m: &Metrics, distance: f64, window: f64) {
        let span = distance - self.distance;
        (self.distance, self.window) = (distance, window);
        while let Some(first) = self.recent.front()
            && first.distance <= (distance - window) * (1.0 + 1e-12)
        {
            self.recent.pop_front();
        }
        let stress = match (
            m.sigma_eff_max_pa,
            m.sigma_eff_max_depth_m,
            m.sigma_eff_max_x_m,
        ) {
            (Some(value), Some(depth), Some(x)) => Some([value, depth, x]),
            _ => None,
        };
        let mut values = [None; SUMMED];
        for (value, quantity) in values.iter_mut().zip(summed()) {
            *value = quantity.read_metrics(m).number();
        }
        self.recent.push_back(Entry {
            distance,
            span,
            values,
            stress,
            yielded_m3: m.yielded_m3.map_or(0.0, |[one, two]| one + two),
        });
        self.not_converged += u64::from(!m.converged);
    }

    /// One number of the steps, as [`total`] places it; `None`: it was not known in any of them.
    fn sum_up(&self, (place, over): (usize, Over)) -> Option<f64> {
        let mut values = self.recent.iter().filter_map(|entry| entry.values[place]);
        match over {
            Over::Mean => self.mean(place),
            Over::Greatest => values.reduce(f64::max),
            Over::Least => values.reduce(f64::min),
            Over::Last => values.next_back(),
        }
    }

    /// Same of what every step knows; 0 before the first.
    fn number(&self, total: (usize, Over)) -> f64 {
        self.sum_up(total).unwrap_or(0.0)
    }

    /// Mean by length; of the first step only what lies within the window.
    fn mean(&self, place: usize) -> Option<f64> {
        let start = self.distance - self.window;
        let known = self.recent.iter().filter_map(|entry| {
            let weight = entry.span.min((entry.distance - start).max(0.0));
            Some((weight, entry.values[place]?))
        });
        let sum: f64 = known.clone().map(|(weight, value)| weight * value).sum();
        let length: f64 = known.map(|(weight, _)| weight).sum();
        (length > 0.0).then(|| sum / length)
    }

    /// What is shown by itself, each by its key.
    fn by_themselves(&self) -> BTreeMap<String, Option<f64>> {
        let shown = CATALOGUE.iter().filter(|quantity| quantity.by_itself);
        let keys = shown.flat_map(|quantity| quantity.over);
        keys.map(|(_, key)| ((*key).to_owned(), self.sum_up(total(key))))
            .collect()
    }

    fn greatest_stress(&self) -> Option<[f64; 3]> {
        let by_value = |a: &[f64; 3], b: &[f64; 3]| a[0].total_cmp(&b[0]);
        self.recent.iter().filter_map(|e| e.stress).max_by(by_value)
    }

    /// Adds what cautions need of the steps.
    pub(super) fn ground(&self, grounds: &mut Grounds) {
        grounds.steps_not_converged = self.not_converged;
        grounds.p_max_greatest_pa = self.number(const { total("p_max_greatest_pa") });
        grounds.yielded_last_share = self.yielded_last_share();
        grounds.sigma_eff_greatest_pa = self.greatest_stress().map(|stress| stress[0]);
    }

    /// Part of all that has flowed that did so after the first of these steps; `None`: nothing has.
    fn yielded_last_share(&self) -> Option<f64> {
        let (first, last) = self.recent.front().zip(self.recent.back())?;
        let lately = last.yielded_m3 - first.yielded_m3;
        (last.yielded_m3 > 0.0).then(|| lately / last.yielded_m3)
    }

    /// The summary of the last step `m` and of what was summed up; `known`: what does not come from the steps.
    pub(super) fn summary(&self, m: &Metrics, known: Summary) -> Summary {
        /// The catalogue's sums over the steps by their keys, and scalars of the last step by their names.
        macro_rules! numbers {
            ($($key:ident)*; $($last:ident)*) => {
                Summary {
                    $($key: self.number(const { total(stringify!($key)) }),)*
                    $($last: m.$last,)*
                    ..known
                }
            };
        }
        let numbers = numbers!(
            h_central_m h_min_m h_min_least_m p_max_pa p_max_greatest_pa contact_ratio contact_load_ratio
            load_n load_error mass_error friction_coefficient;
            regime lambda_ratio n_body_1 n_body_2 n_counted_body_1 n_counted_body_2
        );
        let stress = self.greatest_stress();
        Summary {
            converged: self.not_converged == 0,
            steps_not_converged: self.not_converged,
            yielded_body_1_m3: m.yielded_m3.map(|both| both[0]),
            yielded_body_2_m3: m.yielded_m3.map(|both| both[1]),
            yielded_last_share: self.yielded_last_share(),
            sigma_eff_max_pa: stress.map(|s| s[0]),
            sigma_eff_max_depth_m: stress.map(|s| s[1]),
            sigma_eff_max_x_m: stress.map(|s| s[2]),
            rhythm: m.repeat.map(|r| r.rhythm),
            period_s: m.repeat.map(|r| r.period_s),
            period_drift: m.repeat.and_then(|r| r.drift),
            periodic: m.repeat.map(|r| r.repeats),
            by_itself: self.by_themselves(),
            ..numbers
        }
    }
}

#[cfg(test)]
#[expect(clippy::unwrap_used, reason = "tests")]
mod tests {
    use super::*;

    #[test]
    fn steps_saved_before_a_quantity_was_added_are_read() {
        let entry = |values: usize| {
            let values = vec!["2.5"; values].join(",");
            let text = format!(
                r#"{{"way":1.0,"span":0.5,"values":[{values}],"stress":null,"yielded_m3":0}}"#
            );
            serde_json::from_str::<Entry>(&text)
        };
        let before = entry(SUMMED - 1).unwrap();
        assert_eq!(
            (before.values[0], before.values[SUMMED - 1]),
            (Some(2.5), None)
        );
        assert_eq!(entry(SUMMED).unwrap().values, [Some(2.5); SUMMED]);
        let refused = entry(SUMMED + 1).unwrap_err().to_string();
        assert!(refused.contains("invalid length"), "{refused}");
    }
}
