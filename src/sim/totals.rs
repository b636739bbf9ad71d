//! Means over the last passage, and the summary of a run.

use std::collections::VecDeque;

use super::summary::PitStart;
use super::{LifeEstimate, Metrics, Simulation, Stats, Summary};
use crate::physics::cycles::BodyId;
use crate::physics::iso281::{a_iso_radial_ball, kappa_from_lambda};

/// What the summary averages, one entry a step of the last passage.
#[derive(Debug, Clone, Default)]
pub(super) struct Totals {
    recent: VecDeque<[f64; 8]>,
    /// Greatest effective stress of each step: value, depth, x.
    stress: VecDeque<[f64; 3]>,
    not_converged: u64,
}

impl Totals {
    /// Takes a step; keeps the last `most`.
    pub(super) fn push(&mut self, m: &Metrics, most: u64) {
        if self.recent.capacity() == 0 {
            self.recent.reserve_exact(most.max(1) as usize + 1);
            self.stress.reserve_exact(most.max(1) as usize + 1);
        }
        while self.recent.len() >= most.max(1) as usize {
            self.recent.pop_front();
        }
        self.recent.push_back([
            m.h_central_m,
            m.h_min_m,
            m.p_max_pa,
            m.contact_ratio,
            m.friction_coefficient,
            m.load_error,
            m.mass_error,
            m.load_n,
        ]);
        if let (Some(value), Some(depth), Some(x)) = (
            m.sigma_eff_max_pa,
            m.sigma_eff_max_depth_m,
            m.sigma_eff_max_x_m,
        ) {
            while self.stress.len() >= most.max(1) as usize {
                self.stress.pop_front();
            }
            self.stress.push_back([value, depth, x]);
        }
        self.not_converged += u64::from(!m.converged);
    }

    fn mean(&self, k: usize) -> f64 {
        self.recent.iter().map(|row| row[k]).sum::<f64>() / self.recent.len().max(1) as f64
    }

    fn greatest_stress(&self) -> Option<[f64; 3]> {
        let by_value = |a: &&[f64; 3], b: &&[f64; 3]| a[0].total_cmp(&b[0]);
        self.stress.iter().max_by(by_value).copied()
    }

    fn greatest(&self, k: usize) -> f64 {
        self.recent.iter().map(|row| row[k]).fold(0.0, f64::max)
    }
}

/// The summary of a simulation.
pub(super) fn summary(
    sim: &Simulation,
    totals: &Totals,
    life: Option<&LifeEstimate>,
    counters: Stats,
) -> Summary {
    let m = sim.metrics();
    let stress = totals.greatest_stress();
    Summary {
        scene: String::new(),
        converged: totals.not_converged == 0,
        steps: sim.passage_steps(),
        steps_not_converged: totals.not_converged,
        wall_s: 0.0,
        steps_per_s: None,
        a_m: sim.plan.hertz.a_m,
        p_hertz_pa: sim.plan.hertz.p_max_pa,
        h_central_m: totals.mean(0),
        h_min_m: totals.mean(1),
        p_max_pa: totals.mean(2),
        contact_ratio: totals.mean(3),
        load_n: totals.mean(7),
        load_error: totals.greatest(5),
        mass_error: totals.greatest(6),
        friction_coefficient: totals.mean(4),
        n_body_1: m.n_body_1,
        n_body_2: m.n_body_2,
        n_counted_body_1: m.n_counted_body_1,
        n_counted_body_2: m.n_counted_body_2,
        i_ref: life.map(|l| l.i_ref),
        i_mean: life.map(|l| l.i_mean),
        cycle_factor: life.map(|l| l.cycle_factor),
        stress_factor: life.map(|l| l.stress_factor),
        peak_factor: life.map(|l| l.peak_factor),
        traction_factor: life.map(|l| l.traction_factor),
        life_relative: life.map(|l| l.life_relative),
        life_relative_low: life.map(|l| l.life_relative_low),
        life_relative_high: life.map(|l| l.life_relative_high),
        survival_ratio: sim
            .life
            .as_ref()
            .map(super::fatigue_stage::LifeStage::survival_ratio),
        sigma_eff_max_pa: stress.map(|s| s[0]),
        sigma_eff_max_depth_m: stress.map(|s| s[1]),
        sigma_eff_max_x_m: stress.map(|s| s[2]),
        counters,
        life_model: life.map(|l| l.detail.model.to_owned()),
        life_basis: sim
            .life
            .as_ref()
            .map(super::fatigue_stage::LifeStage::basis_text),
        life_body: life.map(|l| l.detail.body),
        life_body_1: life.and_then(|l| l.detail.life_body[0]),
        life_body_2: life.and_then(|l| l.detail.life_body[1]),
        life_system: life.and_then(|l| l.detail.life_system),
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
        pit_body_1: pit(sim, BodyId::One),
        pit_body_2: pit(sim, BodyId::Two),
        cycles_end_depth_1_m: cycles_end(sim, BodyId::One),
        cycles_end_depth_2_m: cycles_end(sim, BodyId::Two),
        a_iso: a_iso(sim),
    }
}

/// Where the pit of a body starts.
fn pit(sim: &Simulation, body: BodyId) -> Option<PitStart> {
    let counting = sim.counting.as_ref()?;
    let pit = counting.pit(body)?;
    let depth = *sim.stress.as_ref()?.depths().get(pit.depth)?;
    let length = counting.map(body)?.0.spec().length;
    Some(PitStart {
        depth_m: sim.door.m_from_x(depth),
        place_m: super::fill::place_m(sim, pit.place, length),
        damage: pit.damage,
    })
}

/// Depth from which on a crossing counts less than 1.5 cycles of signed shear.
fn cycles_end(sim: &Simulation, body: BodyId) -> Option<f64> {
    let counts = sim.counting.as_ref()?.shear_counts(body)?;
    let depths = sim.stress.as_ref()?.depths();
    let last = counts.iter().rposition(|count| *count >= 1.5);
    let k = last.map_or(0, |k| (k + 1).min(depths.len() - 1));
    Some(sim.door.m_from_x(depths[k]))
}

/// a_ISO beside the result, from the scene's load ratio and its film parameter.
fn a_iso(sim: &Simulation) -> Option<f64> {
    let lambda = sim.plan.film?.lambda_ratio?;
    a_iso_radial_ball(kappa_from_lambda(lambda), sim.iso_load_ratio?)
}
