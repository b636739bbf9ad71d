//! What the passage costs: mean life integrals of the scene's model and of the variants beside it.
//!
//! The reference is the same scene smooth, frictionless, with S = 0, at the load and speed of now (`reference.rs`);
//! n_ref = 1. A body's life is counted in its own loading cycles, by [`CycleBasis::Damage`] in those of the faster body
//! ([`super::damage_count`]), and the weaker body gives the life of the scene unless it names one. As a system both
//! bodies are compared in time, as equal discs: `L = [½ Σ (N_i U/|U_i|)^{−e}]^{−1/e}` relative to the two bodies of the
//! reference (U_fast in place of U_i where N_i are its cycles).

mod lives;
mod reference;

use serde::{Deserialize, Serialize};

use super::counting::Counting;
use super::damage_count::Passing;
use super::estimates::{LifeDetail, LifeEstimate, Repeat};
use super::settling::Settling;
use super::smooth::LoadAndSpeed;
use super::stress_stage::StressStage;
use super::variant::{LifeIntegral, Shared, Variant, models};
use crate::math::grid::Grid;
use crate::math::ln_sum::ln_sum;
use crate::physics::cycles::{BodyId, speed_ratios};
use crate::physics::fatigue::LifeLaw;
use crate::plan::Plan;
use crate::saved::saved;
use crate::scene::{ContactKind, CycleBasis, Life, Scene, Surface};
use crate::solve::life::{SweptRows, Window};
use crate::solve::marks::Marks;
use crate::solve::stress::{Loading, StressLaw};

/// Conditions of an estimate.
pub(super) struct Now {
    /// Contacts of both bodies; `None`: the body stands.
    pub(super) n: [Option<f64>; 2],
    /// The same without crests that the contact does not feel.
    pub(super) n_felt: [Option<f64>; 2],
    /// S.
    pub(super) slide_roll: f64,
    /// Hertz half-width over the scene's.
    pub(super) size: f64,
    /// Relative error of stress.
    pub(super) stress_error: f64,
    /// Whether the reference is that of the load and speed that the knobs go to.
    pub(super) has_reference: bool,
}

/// Loading cycles of the smooth contact, where the scene gives a point of them.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
struct Calibration {
    /// Cycles of the point.
    cycles: f64,
    /// p_cal/p_h.
    pressure_ratio: f64,
    /// Life at the scene's survival over that at the point's.
    survival_ratio: f64,
}

/// Life models and what they have integrated so far.
#[derive(Debug, Clone, Serialize, Deserialize)]
pub(super) struct LifeStage {
    law: LifeLaw,
    asked: Life,
    /// The scene's model first.
    variants: Vec<Variant>,
    pub(super) laws: Vec<StressLaw>,
    sweep: SweptRows,
    depths: Vec<f64>,
    is_smooth: bool,
    calibration: Option<Calibration>,
    /// Directions in which the contact grows with the pressure.
    sides: f64,
    /// Hertz half-width, over the scene's, for which the reference was computed.
    reference_size: f64,
    /// Load and speed for which it was.
    pub(super) reference_at: LoadAndSpeed,
    /// Cycles of the smooth contact of that size.
    reference_cycles: Option<f64>,
    settling: Settling,
    /// How far ln of the damage of both bodies moved, where cycles count by it.
    damage: Marks,
}

saved! {
    LifeStage {
        same: law, asked, laws, depths, is_smooth, calibration, sides;
        parts: variants, sweep, damage;
        free: reference_size, reference_at, reference_cycles, settling;
    }
}

impl LifeStage {
    /// Meters over a passage of `plan` (in a); `None` without a `[life]`.
    pub(super) fn new(scene: &Scene, plan: &Plan, stress: &StressStage) -> Option<Self> {
        let (asked, life_plan) = (scene.life.clone()?, plan.life?);
        let law = asked.law();
        let p_h = plan.hertz.p_max_pa;
        let window = Window::closed(plan.passage_a);
        let capacity = life_plan.phases_per_passage.max(1) as usize + 1;
        let depths = stress.depths().to_vec();
        let mut laws = Vec::new();
        let mut variants = Vec::new();
        for model in models(&asked, p_h) {
            let place = model.stress_law(law).map(|(exponent, limit)| {
                laws.push(StressLaw { exponent, limit });
                laws.len() - 1
            });
            variants.push(Variant::new(model, place, depths.len(), (window, capacity)));
        }
        let calibration = asked.calibration().map(|(cycles, p_pa)| Calibration {
            cycles,
            pressure_ratio: p_pa / p_h,
            survival_ratio: law.survival_ratio(asked.survival, asked.calibration_survival),
        });
        Some(Self {
            law,
            asked,
            variants,
            laws,
            sweep: SweptRows::new(stress.row_count()),
            depths,
            is_smooth: scene.surfaces().into_iter().all(Surface::is_smooth),
            calibration,
            sides: match scene.kind() {
                ContactKind::Point => 2.0,
                ContactKind::Line => 1.0,
            },
            reference_size: 1.0,
            reference_at: LoadAndSpeed::default(),
            reference_cycles: None,
            settling: Settling::new(law, scene.numerics.tolerance),
            damage: Marks::new(),
        })
    }

    /// Life at the scene's probability of survival over that at 50 %. The relative life is the same at
    /// any one probability.
    pub(super) fn survival_ratio(&self) -> f64 {
        self.law.survival_ratio(self.asked.survival, 0.5)
    }

    /// The scene's model, and what a relative life is relative to.
    pub(super) fn basis_text(&self) -> String {
        let relative = "relative to the smooth, frictionless contact at S = 0";
        match (self.calibration, self.reference_cycles) {
            (None, _) => format!(
                "{relative}: the scene gives no calibration point, and no constant of this model is \
                 universal"
            ),
            (Some(_), Some(_)) => {
                format!("{relative}; absolute by the scene's calibration point")
            }
            (Some(_), None) => {
                format!("{relative}: the calibration point lies below the fatigue limit")
            }
        }
    }

    /// Passes over the surface loaded last and gives its sums to every model.
    fn each(
        &mut self,
        stress: &mut StressStage,
        mut take: impl FnMut(&mut Variant, &mut StressStage, &mut Shared),
    ) {
        self.pass(stress);
        let mut shared = Shared {
            law: self.law,
            laws: &self.laws,
            sweep: &self.sweep,
            scratch: std::mem::take(&mut stress.shares),
        };
        for variant in &mut self.variants {
            take(variant, stress, &mut shared);
        }
        stress.shares = shared.scratch;
    }

    /// How cycles are counted, and of whose loading cycles lives are.
    pub(super) fn count_text(&self) -> String {
        let basis = self.asked.cycles;
        format!("{}, in {}", basis.name(), basis.unit())
    }

    /// Takes the mean over `window` (in a) from now on.
    pub(super) fn set_window(&mut self, window: Window) {
        self.damage.forget();
        for variant in &mut self.variants {
            variant.set_window(window);
        }
    }

    /// Forgets the phases seen: they belong to other conditions. The mean is over `window` (in a).
    pub(super) fn restart(&mut self, window: Window) {
        self.clear();
        self.set_window(window);
    }

    /// Forgets the phases seen.
    fn clear(&mut self) {
        self.sweep.restart();
        for variant in &mut self.variants {
            variant.restart();
        }
        self.settling.restart();
        self.damage.forget();
    }

    /// Whether the average may be called settled, after a sample without anything of a ramp in it.
    pub(super) fn test_settled(
        &mut self,
        stress_error: f64,
        repeat: Option<Repeat>,
        counting: Option<&Counting>,
    ) {
        let by_damage = self.asked.cycles == CycleBasis::Damage;
        let meter = self.variants[0].meter();
        let (distance, period) = meter.distance();
        let covered = counting.map_or(1.0, |counting| counting.covers(period));
        if by_damage && self.damage.is_due(distance) {
            self.mark(counting);
        }
        let damage = by_damage.then_some((&self.damage, covered));
        let meter = self.variants[0].meter();
        let sensitivity = (self.asked.exponent(), stress_error);
        self.settling
            .test(meter, sensitivity, repeat, damage, self.is_smooth);
    }

    /// Takes down where the damage of both bodies stands, once half of a round has crossed.
    fn mark(&mut self, counting: Option<&Counting>) {
        let (distance, period) = self.variants[0].meter().distance();
        if counting.is_none_or(|counting| counting.covers(period) >= 0.5) {
            let ln = BodyId::BOTH.map(|body| self.ln_damage(body, counting));
            self.damage.take(distance, period, ln);
        }
    }

    /// Where fields come back and only points are waited for: moves them on through what they meet again, and tests as
    /// [`Self::test_settled`] does.
    pub(super) fn wait_for_points(
        &mut self,
        stress_error: f64,
        repeat: Option<Repeat>,
        counting: &mut Counting,
        (grid, passing): (&Grid, &Passing),
    ) {
        let comes_back = repeat.is_some_and(|repeat| repeat.repeats);
        if !comes_back || !self.settling.waits_for_points() || !counting.may_go_on() {
            return;
        }
        counting.go_on(grid, passing, |counting| {
            for variant in &mut self.variants {
                variant.weigh_material(Some(counting));
            }
            self.mark(Some(counting));
        });
        self.test_settled(stress_error, repeat, Some(counting));
    }

    /// `ln Σ_k n_k^e J_k` of a body by its damage.
    fn ln_damage(&self, body: BodyId, counting: Option<&Counting>) -> f64 {
        let e = self.law.weibull_slope;
        let cycles = counting.and_then(|counting| counting.profile(body, CycleBasis::Damage));
        let shares = self.variants[0].shares(LifeIntegral::Material);
        let (Some(cycles), Some(shares)) = (cycles, shares) else {
            return f64::NEG_INFINITY;
        };
        let shares = shares.of(Loading::Full(body)).iter().enumerate();
        ln_sum(shares.map(|(k, ln)| (1.0, ln + e * cycles.at(k).ln())))
    }

    /// Takes the surface loaded last, which stands for a `distance` (in a), and what has been counted up to it.
    pub(super) fn push(
        &mut self,
        distance: f64,
        stress: &mut StressStage,
        counting: Option<&Counting>,
    ) {
        self.each(stress, |variant, stress, shared| {
            variant.push(distance, stress, shared);
            variant.weigh_material(counting);
        });
    }

    /// Risk by depth of a body by the scene's model, p_h; `None` for models that integrate.
    pub(super) fn risk(&self, body: BodyId) -> Option<&[f32]> {
        self.variants.first()?.risk(body)
    }

    /// Whether a model wants the volume pass.
    pub(super) fn integrates(&self) -> bool {
        !self.laws.is_empty()
    }

    /// The volume pass, where a model wants one.
    fn pass(&mut self, stress: &mut StressStage) {
        if !self.integrates() {
            return;
        }
        stress.volume(&self.laws);
        for loading in Loading::ALL {
            self.sweep.push(loading, stress.sums().row_tops(loading));
        }
    }

    /// The estimate for the conditions of now.
    pub(super) fn estimate(&self, now: &Now, counting: Option<&Counting>) -> Option<LifeEstimate> {
        let basis = self.asked.cycles;
        let integral = LifeIntegral::of(basis);
        let scene = &self.variants[0];
        let lives = self.lives(scene, basis, now, counting)?;
        let (body, f) = self.governing(lives)?;
        let (low, high) = band(self.asked.exponent(), f.relative, now.stress_error);
        let unsettled = self.settling.wander();
        let (low, high) = (low / unsettled.exp(), high * unsettled.exp());
        let by = |basis: CycleBasis| {
            let lives = self.lives(scene, basis, now, counting)?;
            Some(self.governing(lives)?.1.relative)
        };
        let spread = self.spread(now, counting, f.relative);
        let shares = scene.shares(integral)?;
        let ln_unit = self.growth(scene, integral) * now.size.ln();
        let cycles_now = self.cycles_ratio(now.size / self.reference_size);
        Some(LifeEstimate {
            i_ref: (self.ln_reference(scene, body, integral, now.size) - ln_unit).exp(),
            i_mean: (shares.ln(Loading::Full(body)) - ln_unit).exp(),
            phases: scene.meter().samples(),
            cycle_factor: f.cycle,
            stress_factor: f.stress,
            peak_factor: f.peak,
            traction_factor: f.traction,
            load_factor: self.load_factor(scene, body, now.size),
            life_smooth: 0.0,
            life_relative: f.relative,
            life_relative_low: low,
            life_relative_high: high,
            settled: now.has_reference && self.settling.has_settled(),
            detail: LifeDetail {
                model: Some(self.asked.model),
                body: body.index() as u8 + 1,
                unsettled,
                basis_factor: basis_factor(basis, body, now.slide_roll),
                life_body: lives.map(|f| f.map(|f| f.relative)),
                life_system: self.system(lives, now.slide_roll),
                life_global: by(CycleBasis::Global),
                life_damage: by(CycleBasis::Damage),
                spread_low: spread.0,
                spread_high: spread.1,
                variants: spread.2,
                cycles: self
                    .reference_cycles
                    .map(|cycles| cycles * cycles_now * f.relative),
            },
        })
    }
}

/// From own loading cycles to those in which a life is: `U_fast/|U_i|` by damage, else 1. Of a body that stands, which has
/// none of its own, 1.
fn basis_factor(basis: CycleBasis, body: BodyId, slide_roll: f64) -> f64 {
    let own = speed_ratios(slide_roll).map(f64::abs);
    let ratio = match basis {
        CycleBasis::Damage => own[0].max(own[1]) / own[body.index()],
        CycleBasis::Global | CycleBasis::Peaks => 1.0,
    };
    if ratio.is_finite() { ratio } else { 1.0 }
}

/// Part of ln L that a mesh which just carries the waves may miss: the waves are sampled too low, and what they cost falls
/// with them. Measured on the first mesh of 52 scenes, six to seventeen nodes a wave: .28 at most (`asperity study bands`).
const MISSED: f64 = 0.35;

/// The ends of a life by the error of its stress, `L (1 ± error)^{∓m}`: no more than a share of what it is off that of the
/// smooth contact.
fn band(exponent: f64, life: f64, stress_error: f64) -> (f64, f64) {
    let error = stress_error.abs().min(0.99);
    let [low, high] = [1.0 + error, 1.0 - error].map(|stress| life * stress.powf(-exponent));
    let most = MISSED * life.ln().abs();
    (low.max(life * (-most).exp()), high.min(life * most.exp()))
}

#[cfg(test)]
mod tests {
    use super::band;
    use crate::scene::{Life, LifeModel};

    #[test]
    fn stress_error_widens_the_band_by_the_models_exponent() {
        for (model, low, high) in [
            (LifeModel::Zaretsky, 0.9023, 1.1094),
            (LifeModel::LundbergPalmgren, 0.9116, 1.0980),
        ] {
            let life = Life {
                model,
                ..Life::default()
            };
            // A smooth contact's life tells nothing of its error; far from it no share holds the ends.
            let ends = band(life.exponent(), 1e-3, 0.01);
            println!("{model:?}: 1 % of stress is {ends:?} of life 1e-3");
            assert!((ends.0 / 1e-3 - low).abs() < 1e-4 && (ends.1 / 1e-3 - high).abs() < 1e-4);
        }
    }
}
