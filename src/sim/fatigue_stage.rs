//! What the passage costs: mean life integrals of the scene's model and of the variants beside it.
//!
//! The reference is the same scene smooth, frictionless, with S = 0, computed in the start-up;
//! n_ref = 1. A body's life is counted in its own loading cycles, and the weaker body gives the life of the
//! scene unless it names one. As a system both bodies are compared in time, as equal discs:
//! `L = [½ Σ (N_i U/|U_i|)^{−e}]^{−1/e}` relative to the two bodies of the reference.

use serde::{Deserialize, Serialize};

use super::counting::Counting;
use super::frame::{LifeDetail, LifeEstimate};
use super::stress_stage::StressStage;
use super::variant::{Shared, Variant, models};
use crate::physics::cycles::BodyId;
use crate::physics::fatigue::{LifeFactors, LifeLaw};
use crate::physics::life_models::{CycleProfile, LifeModel, calibrated_reference};
use crate::plan::Plan;
use crate::scene::{BodyChoice, ContactKind, CycleBasis, Life, Scene, Spread, VolumeIntegral};
use crate::solve::life::{Coverage, Shares, Sweep, factors};
use crate::solve::stress::{Loading, StressLaw};

/// Loading cycles of the smooth contact, where the scene gives a point of them.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
struct Calibration {
    cycles: f64,
    /// p_cal/p_h.
    pressure_ratio: f64,
    /// Life at the scene's survival over that at the point's.
    survival_ratio: f64,
    /// Directions in which the contact grows with the pressure.
    sides: f64,
}

/// Life models under way.
#[derive(Debug, Clone, Serialize, Deserialize)]
pub(super) struct LifeStage {
    law: LifeLaw,
    asked: Life,
    /// The scene's model first.
    variants: Vec<Variant>,
    laws: Vec<StressLaw>,
    sweep: Sweep,
    scratch: Shares,
    depths: Vec<f64>,
    /// Wavelength along x of the mating crests, a.
    wavelengths: [Option<f64>; 2],
    calibration: Option<Calibration>,
    /// Cycles of the smooth contact at the scene's load.
    reference_cycles: Option<f64>,
}

impl LifeStage {
    /// Meters over a passage of `plan` (in a); `None` without a `[life]`.
    pub(super) fn new(scene: &Scene, plan: &Plan, stress: &StressStage) -> Option<Self> {
        let (asked, life_plan) = (scene.life.clone()?, plan.life?);
        let law = LifeLaw {
            stress_exponent: asked.stress_exponent,
            weibull_slope: asked.weibull_slope,
        };
        let p_h = plan.hertz.p_max_pa;
        let period = plan.passage_a;
        let capacity = life_plan.phases_per_passage.max(1) as usize + 1;
        let depths = stress.depths().to_vec();
        let mut laws = Vec::new();
        let mut variants = Vec::new();
        for model in models(&asked, p_h) {
            let place = model.stress_law(law).map(|(exponent, limit)| {
                laws.push(StressLaw { exponent, limit });
                laws.len() - 1
            });
            variants.push(Variant::new(model, place, depths.len(), (period, capacity)));
        }
        let calibration = asked.calibration().map(|(cycles, p_pa)| Calibration {
            cycles,
            pressure_ratio: p_pa / p_h,
            survival_ratio: law.survival_ratio(asked.survival, asked.calibration_survival),
            sides: match scene.kind() {
                ContactKind::Point => 2.0,
                ContactKind::Line => 1.0,
            },
        });
        let wavelength = |body: BodyId| {
            let wave = plan.waves[body.mate().index()].filter(|wave| wave.crests_per_m > 0.0);
            wave.map(|wave| 1.0 / (wave.crests_per_m * plan.hertz.a_m))
        };
        Some(Self {
            law,
            asked,
            variants,
            laws,
            sweep: Sweep::new(stress.row_count()),
            scratch: Shares::new(depths.len()),
            depths,
            wavelengths: BodyId::BOTH.map(wavelength),
            calibration,
            reference_cycles: None,
        })
    }

    /// c.
    pub(super) fn stress_exponent(&self) -> f64 {
        self.law.stress_exponent
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

    /// Passes over the surface loaded last and hands its sums to every model.
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
            scratch: &mut self.scratch,
        };
        for variant in &mut self.variants {
            take(variant, stress, &mut shared);
        }
    }

    /// Takes the smooth contact as the reference.
    pub(super) fn set_reference(&mut self, stress: &mut StressStage) {
        self.each(stress, |variant, stress, shared| {
            variant.set_reference(stress, shared);
        });
        self.sweep.restart();
        self.reference_cycles = self.calibrate(stress);
    }

    /// Takes over the reference of a stage that [`Self::fits`].
    pub(super) fn take_reference(&mut self, other: &Self) {
        for (own, other) in self.variants.iter_mut().zip(&other.variants) {
            own.take_reference(other);
        }
        self.reference_cycles = other.reference_cycles;
    }

    /// Makes the room again that a copy or a file does not keep.
    pub(super) fn make_room(&mut self) {
        for variant in &mut self.variants {
            variant.make_room();
        }
    }

    /// Whether a stage that was saved is of the same make as this one.
    pub(super) fn fits(&self, saved: &Self) -> bool {
        let (depths, rows) = (self.depths.len(), self.sweep.of(Loading::ALL[0]).len());
        self.law == saved.law
            && self.calibration == saved.calibration
            && self.asked == saved.asked
            && self.laws == saved.laws
            && self.depths == saved.depths
            && saved.sweep.is_sound(rows)
            && saved.scratch.is_sound(depths)
            && self.variants.len() == saved.variants.len()
            && self
                .variants
                .iter()
                .zip(&saved.variants)
                .all(|(a, b)| a.fits(b))
    }

    /// Whether a stage that was saved was made for the same crests.
    pub(super) fn same_waves(&self, saved: &Self) -> bool {
        self.wavelengths == saved.wavelengths
    }

    /// Takes the mean over a way of `period` (in a) from now on.
    pub(super) fn set_period(&mut self, period: f64) {
        for variant in &mut self.variants {
            variant.set_period(period);
        }
    }

    /// Forgets the phases seen: they belong to other conditions. The mean is over a way of `period` (in a).
    pub(super) fn restart(&mut self, period: f64) {
        self.sweep.restart();
        for variant in &mut self.variants {
            variant.restart();
        }
        self.set_period(period);
    }

    /// Takes the surface loaded last, which stands for a `way` (in a).
    pub(super) fn push(&mut self, way: f64, stress: &mut StressStage) {
        self.each(stress, |variant, stress, shared| {
            variant.push(way, stress, shared);
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

    /// Cycles of the smooth contact at the scene's load, from the calibration point.
    fn calibrate(&mut self, stress: &mut StressStage) -> Option<f64> {
        let point = self.calibration?;
        let model = self.variants[0].model;
        let cycles = point.cycles * point.survival_ratio;
        if let Some(exponent) = model.pressure_exponent(self.law, point.sides) {
            let ratio = point.pressure_ratio;
            return Some(calibrated_reference(cycles, ratio, 1.0, exponent));
        }
        // A limit breaks the power law: the integral once more with the limit in units of the point's
        // pressure. It grows with p^{c + 3 − h} (line: c + 2 − h), like the model without a limit.
        let LifeModel::IoannidesHarris { depth_exponent, .. } = model else {
            return None;
        };
        let mut law = self.laws[0];
        law.limit /= point.pressure_ratio;
        stress.volume(&[law]);
        let shares = stress.sums().layers(Loading::Normal(BodyId::One), 0);
        let weighted = shares.iter().zip(&self.depths);
        let ln_point = crate::math::ln_sum::ln_sum(
            weighted.map(|(ln, z)| (1.0, ln + model.ln_depth_weight(*z))),
        );
        let growth = self.law.stress_exponent + point.sides + 1.0 - depth_exponent;
        let ln_reference = self.variants[0].ln_reference(BodyId::One, VolumeIntegral::Snapshot);
        let ln = ln_point + growth * point.pressure_ratio.ln() - ln_reference;
        ln.is_finite()
            .then(|| cycles * (ln / self.law.weibull_slope).exp())
    }

    /// The estimate for the contacts `n` of both bodies, slide-to-roll ratio `s` and the relative error of
    /// stress.
    pub(super) fn estimate(
        &self,
        n: [Option<f64>; 2],
        s: f64,
        counting: Option<&Counting>,
        stress_error: f64,
    ) -> Option<LifeEstimate> {
        let (basis, form) = (self.asked.cycles, self.asked.volume);
        let scene = &self.variants[0];
        let lives = self.lives(scene, (basis, form), n, counting)?;
        let (body, f) = self.governing(lives)?;
        let (low, high) = self.law.band(f.relative, stress_error);
        let other = |form| {
            let lives = self.lives(scene, (basis, form), n, counting)?;
            lives[body.index()].map(|f| f.relative)
        };
        let spread = self.spread(n, counting, f.relative);
        let shares = scene.shares(form)?;
        Some(LifeEstimate {
            i_ref: scene.ln_reference(body, form).exp(),
            i_mean: shares.ln(Loading::Full(body)).exp(),
            phases: scene.meter().samples(),
            cycle_factor: f.cycle,
            stress_factor: f.stress,
            peak_factor: f.peak,
            traction_factor: f.traction,
            load_factor: 1.0,
            life_relative: f.relative,
            life_relative_low: low,
            life_relative_high: high,
            settled: scene.meter().coverage() == Coverage::Settled,
            detail: LifeDetail {
                model: Some(self.asked.model),
                body: body.index() as u8 + 1,
                life_body: lives.map(|f| f.map(|f| f.relative)),
                life_system: self.system(lives, s),
                life_snapshot: other(VolumeIntegral::Snapshot),
                life_swept: other(VolumeIntegral::Swept),
                spread_low: spread.0,
                spread_high: spread.1,
                variants: spread.2,
                cycles: self.reference_cycles.map(|cycles| cycles * f.relative),
            },
        })
    }

    /// Factors of both bodies; `None` for a body that stands or is not counted yet, and for all where
    /// nothing was sampled.
    fn lives(
        &self,
        variant: &Variant,
        (basis, form): (CycleBasis, VolumeIntegral),
        n: [Option<f64>; 2],
        counting: Option<&Counting>,
    ) -> Option<[Option<LifeFactors>; 2]> {
        let shares = variant.shares(form)?;
        Some(BodyId::BOTH.map(|body| {
            let profile = self.profile(body, basis, n[body.index()]?, counting)?;
            let ln_reference = variant.ln_reference(body, form);
            let f = factors(self.law, shares, body, ln_reference, profile, &self.depths);
            f.relative.is_finite().then_some(f)
        }))
    }

    fn profile<'a>(
        &self,
        body: BodyId,
        basis: CycleBasis,
        n: f64,
        counting: Option<&'a Counting>,
    ) -> Option<CycleProfile<'a>> {
        match basis {
            CycleBasis::Global => Some(CycleProfile::Global(n)),
            CycleBasis::Depth => Some(CycleProfile::Depth {
                n,
                wavelength: self.wavelengths[body.index()].unwrap_or(f64::INFINITY),
            }),
            CycleBasis::Peaks | CycleBasis::Ranges => counting?.profile(body, basis),
        }
    }

    /// The body that gives the life.
    fn governing(&self, lives: [Option<LifeFactors>; 2]) -> Option<(BodyId, LifeFactors)> {
        let of = |body: BodyId| lives[body.index()].map(|f| (body, f));
        match self.asked.body {
            BodyChoice::Body1 => of(BodyId::One),
            BodyChoice::Body2 => of(BodyId::Two),
            BodyChoice::Weaker => BodyId::BOTH
                .into_iter()
                .filter_map(of)
                .min_by(|a, b| a.1.relative.total_cmp(&b.1.relative)),
        }
    }

    /// Both bodies together, in time, relative to both bodies of the reference.
    fn system(&self, lives: [Option<LifeFactors>; 2], s: f64) -> Option<f64> {
        let [one, two] = lives;
        let turns = [1.0 - 0.5 * s, 1.0 + 0.5 * s].map(f64::abs);
        let time = |f: Option<LifeFactors>, turns: f64| Some(f?.relative / turns);
        let both = self
            .law
            .system_life(time(one, turns[0])?, time(two, turns[1])?);
        let life = both / self.law.system_life(1.0, 1.0);
        life.is_finite().then_some(life)
    }

    /// Least and greatest life over the variants, cycle bases and forms of the integral, and how many.
    fn spread(
        &self,
        n: [Option<f64>; 2],
        counting: Option<&Counting>,
        life: f64,
    ) -> (f64, f64, u32) {
        let (mut low, mut high, mut count) = (life, life, 0);
        if self.asked.spread == Spread::Off {
            return (low, high, 1);
        }
        for variant in &self.variants {
            for form in [VolumeIntegral::Snapshot, VolumeIntegral::Swept] {
                for basis in CycleBasis::ALL {
                    let lives = self.lives(variant, (basis, form), n, counting);
                    if let Some((_, f)) = lives.and_then(|lives| self.governing(lives)) {
                        (low, high) = (low.min(f.relative), high.max(f.relative));
                        count += 1;
                    }
                }
            }
        }
        (low, high, count)
    }
}
