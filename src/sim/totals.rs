//! Means over the last passage, and the summary of a run.

use std::collections::{BTreeMap, VecDeque};

use serde::de::Error as _;
use serde::{Deserialize, Deserializer, Serialize};

use super::caution;
use super::fatigue_stage::LifeStage;
use super::frame::{SUMMED, summed, total};
use super::summary::PitStart;
use super::{CATALOGUE, Grounds, LifeEstimate, Metrics, Over, Simulation, Stats, Summary};
use crate::physics::cycles::BodyId;
use crate::physics::iso281::{a_iso_radial_ball, kappa_from_lambda};

/// One step.
#[derive(Debug, Clone, Copy, Serialize, Deserialize)]
struct Entry {
    /// Way at its end, in a.
    way: f64,
    /// Its length, in a.
    span: f64,
    /// What the catalogue sums up, in its order.
    #[serde(deserialize_with = "padded")]
    values: [Option<f64>; SUMMED],
    /// Greatest effective stress: value, depth, x.
    stress: Option<[f64; 3]>,
    /// What both bodies have yielded up to its end, m³.
    #[serde(default)]
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
    way: f64,
    not_converged: u64,
}

impl Totals {
    /// Makes the memory for `most` steps, which a copy or a file does not keep.
    pub(super) fn make_room(&mut self, most: usize) {
        let room = (most + 2).saturating_sub(self.recent.len());
        self.recent.reserve_exact(room);
    }

    /// Forgets the steps so far, but not those that failed.
    pub(super) fn restart(&mut self) {
        self.recent.clear();
    }

    /// Takes a step that ended at `way` (in a); keeps what the last `window` (in a) touches.
    pub(super) fn push(&mut self, m: &Metrics, way: f64, window: f64) {
        let span = way - self.way;
        (self.way, self.window) = (way, window);
        while let Some(first) = self.recent.front()
            && first.way <= (way - window) * (1.0 + 1e-12)
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
            way,
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
        let start = self.way - self.window;
        let known = self.recent.iter().filter_map(|entry| {
            let weight = entry.span.min((entry.way - start).max(0.0));
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
}

/// The summary of a simulation. What only its run knows (name, clock, steps planned, discretisation error) is left out.
pub(super) fn summary(
    sim: &Simulation,
    totals: &Totals,
    life: Option<&LifeEstimate>,
    counters: Stats,
) -> Summary {
    let m = sim.metrics();
    let size = sim.size_now();
    let stress = totals.greatest_stress();
    Summary {
        converged: totals.not_converged == 0,
        steps: sim.passage_steps(),
        steps_not_converged: totals.not_converged,
        a_m: sim.plan.hertz.a_m * size,
        p_hertz_pa: sim.plan.hertz.p_max_pa * size,
        h_central_m: totals.number(const { total("h_central_m") }),
        h_min_m: totals.number(const { total("h_min_m") }),
        p_max_pa: totals.number(const { total("p_max_pa") }),
        p_max_greatest_pa: totals.number(const { total("p_max_greatest_pa") }),
        h_min_least_m: totals.number(const { total("h_min_least_m") }),
        regime: m.regime,
        cautions: caution::list(m, &sim.grounds()),
        lambda_ratio: m.lambda_ratio,
        contact_ratio: totals.number(const { total("contact_ratio") }),
        contact_load_ratio: totals.number(const { total("contact_load_ratio") }),
        load_n: totals.number(const { total("load_n") }),
        load_error: totals.number(const { total("load_error") }),
        mass_error: totals.number(const { total("mass_error") }),
        friction_coefficient: totals.number(const { total("friction_coefficient") }),
        yielded_body_1_m3: m.yielded_m3.map(|both| both[0]),
        yielded_body_2_m3: m.yielded_m3.map(|both| both[1]),
        yielded_last_share: totals.yielded_last_share(),
        n_body_1: m.n_body_1,
        n_body_2: m.n_body_2,
        n_counted_body_1: m.n_counted_body_1,
        n_counted_body_2: m.n_counted_body_2,
        sigma_eff_max_pa: stress.map(|s| s[0]),
        sigma_eff_max_depth_m: stress.map(|s| s[1]),
        sigma_eff_max_x_m: stress.map(|s| s[2]),
        counters,
        pit_body_1: pit(sim, BodyId::One),
        pit_body_2: pit(sim, BodyId::Two),
        cycles_end_depth_1_m: cycles_end(sim, BodyId::One),
        cycles_end_depth_2_m: cycles_end(sim, BodyId::Two),
        a_iso: a_iso(sim),
        rhythm: m.repeat.map(|r| r.rhythm),
        period_s: m.repeat.map(|r| r.period_s),
        period_drift: m.repeat.and_then(|r| r.drift),
        periodic: m.repeat.map(|r| r.repeats),
        by_itself: totals.by_themselves(),
        ..with_life(life, sim.state.life.as_ref())
    }
}

/// What a summary says of the life.
fn with_life(life: Option<&LifeEstimate>, stage: Option<&LifeStage>) -> Summary {
    Summary {
        i_ref: life.map(|l| l.i_ref),
        i_mean: life.map(|l| l.i_mean),
        cycle_factor: life.map(|l| l.cycle_factor),
        stress_factor: life.map(|l| l.stress_factor),
        peak_factor: life.map(|l| l.peak_factor),
        traction_factor: life.map(|l| l.traction_factor),
        load_factor: life.map(|l| l.load_factor),
        life_relative: life.map(|l| l.life_relative),
        life_relative_low: life.map(|l| l.life_relative_low),
        life_relative_high: life.map(|l| l.life_relative_high),
        survival_ratio: stage.map(LifeStage::survival_ratio),
        life_model: life.and_then(|l| Some(l.detail.model?.name().to_owned())),
        life_count: stage.map(LifeStage::count_text),
        life_basis: stage.map(LifeStage::basis_text),
        life_body: life.map(|l| l.detail.body),
        life_body_1: life.and_then(|l| l.detail.life_body[0]),
        life_body_2: life.and_then(|l| l.detail.life_body[1]),
        life_system: life.and_then(|l| l.detail.life_system),
        life_global: life.and_then(|l| l.detail.life_global),
        life_damage: life.and_then(|l| l.detail.life_damage),
        life_snapshot: life.and_then(|l| l.detail.life_snapshot),
        life_swept: life.and_then(|l| l.detail.life_swept),
        life_models_low: life.map(|l| l.detail.spread_low),
        life_models_high: life.map(|l| l.detail.spread_high),
        life_models: life.map(|l| l.detail.variants),
        life_cycles: life.and_then(|l| l.detail.cycles),
        life_cycles_low: life
            .and_then(|l| Some(l.detail.cycles? * l.life_relative_low / l.life_relative)),
        life_cycles_high: life
            .and_then(|l| Some(l.detail.cycles? * l.life_relative_high / l.life_relative)),
        ..Summary::default()
    }
}

/// Where the pit of a body starts.
fn pit(sim: &Simulation, body: BodyId) -> Option<PitStart> {
    let counting = sim.state.counting.as_ref()?;
    let size = sim.size_now();
    let pit = counting.pit(body, size)?;
    let depth = *sim.work.stress.as_ref()?.depths().get(pit.depth)?;
    let length = counting.map(body, size)?.0.spec().length;
    Some(PitStart {
        depth_m: sim.door.m_from_x(depth),
        place_m: super::fill::place_m(sim, pit.place, length),
        damage: pit.damage,
    })
}

/// Depth from which on a crossing counts less than 1.5 cycles of signed shear.
fn cycles_end(sim: &Simulation, body: BodyId) -> Option<f64> {
    let counts = sim.state.counting.as_ref()?.shear_counts(body)?;
    let depths = sim.work.stress.as_ref()?.depths();
    let last = counts.iter().rposition(|count| *count >= 1.5);
    let k = last.map_or(0, |k| (k + 1).min(depths.len() - 1));
    Some(sim.door.m_from_x(depths[k]))
}

/// a_ISO beside the result, from λ and e_C C_u/P at the load P of now.
fn a_iso(sim: &Simulation) -> Option<f64> {
    let m = sim.metrics();
    let load_ratio = sim.iso_load_ratio? * sim.plan.force_n / m.load_n;
    a_iso_radial_ball(kappa_from_lambda(m.lambda_ratio?), load_ratio)
}

#[cfg(test)]
#[expect(clippy::unwrap_used, reason = "tests")]
mod tests {
    use super::*;

    #[test]
    fn steps_saved_before_a_quantity_was_added_are_read() {
        let entry = |values: usize| {
            let values = vec!["2.5"; values].join(",");
            let text = format!(r#"{{"way":1.0,"span":0.5,"values":[{values}],"stress":null}}"#);
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
