//! What lives are relative to: the smooth, frictionless contact at S = 0, at the load and speed of now.
//!
//! ```text
//! I_ref(now)  = I_ref(where it was computed) r^g            r: ratio of Hertz half-widths, g: LifeEquation::growth
//! load_factor = [I_ref(base)/I_ref(now)]^{1/e}              both in the scene's units
//! N_smooth    = I_ref(now)^{-1/e}                            in GPa and mm: of any scene's
//! ```
//! The start-up computes it for the load and speed that the scene begins with, the base, and `smooth.rs` for
//! others. On the way there it grows as Hertz contacts do.

use super::LifeStage;
use crate::physics::cycles::BodyId;
use crate::physics::hertz::Hertz;
use crate::physics::life_models::calibrated_reference;
use crate::sim::grounds::ReferenceLife;
use crate::sim::smooth::LoadAndSpeed;
use crate::sim::stress_stage::StressStage;
use crate::sim::variant::{LifeIntegral, Variant};
use crate::solve::stress::Loading;

impl LifeStage {
    /// Takes the smooth contact as the reference, and as the base.
    pub(in crate::sim) fn set_reference(&mut self, stress: &mut StressStage, at: LoadAndSpeed) {
        (self.reference_size, self.reference_at) = (1.0, at);
        self.measure_reference(stress);
    }

    /// Takes the smooth contact of `size` times the scene's as the reference of now; the base, and what has been
    /// sampled, stay.
    pub(in crate::sim) fn move_reference(
        &mut self,
        stress: &mut StressStage,
        size: f64,
        at: LoadAndSpeed,
    ) {
        let mut blank = self.clone();
        blank.reference_size = size;
        blank.measure_reference(stress);
        for (own, blank) in self.variants.iter_mut().zip(&blank.variants) {
            own.move_reference(blank);
        }
        (self.reference_size, self.reference_at) = (size, at);
        self.reference_cycles = blank.reference_cycles;
    }

    /// Begins with base and reference of a stage of the same scene on a coarser mesh.
    pub(in crate::sim) fn take_references(&mut self, other: &Self) {
        for (own, other) in self.variants.iter_mut().zip(&other.variants) {
            own.take_references(other);
        }
        (self.reference_size, self.reference_at) = (other.reference_size, other.reference_at);
        self.reference_cycles = other.reference_cycles;
    }

    /// Takes the smooth contact of `size` times the scene's, which was the reference on a coarser mesh, for the reference
    /// of now; the base moves with it.
    pub(in crate::sim) fn raise_references(
        &mut self,
        stress: &mut StressStage,
        size: f64,
        at: LoadAndSpeed,
    ) {
        let before = self.clone();
        self.reference_size = size;
        self.measure_reference(stress);
        for (own, before) in self.variants.iter_mut().zip(&before.variants) {
            own.raise_base(before);
        }
        self.reference_at = at;
    }

    fn measure_reference(&mut self, stress: &mut StressStage) {
        self.clear();
        self.each(stress, |variant, stress, shared| {
            variant.set_reference(stress, shared);
        });
        self.sweep.restart();
        self.reference_cycles = self.calibrate(stress);
    }

    /// Begins with the base of a stage that [`Self::fits`], which is that of the conditions `at`.
    pub(in crate::sim) fn take_base(&mut self, other: &Self, at: LoadAndSpeed) {
        for (own, other) in self.variants.iter_mut().zip(&other.variants) {
            own.take_base(other);
        }
        // Cycles at the base by the same law as they were carried on from there.
        let back = self.cycles_ratio(1.0 / other.reference_size);
        (self.reference_size, self.reference_at) = (1.0, at);
        self.reference_cycles = other.reference_cycles.map(|cycles| cycles * back);
    }

    /// Cycles of the smooth contact of the reference, from the calibration point.
    fn calibrate(&mut self, stress: &mut StressStage) -> Option<f64> {
        let point = self.calibration?;
        let model = self.variants[0].model;
        let cycles = point.cycles * point.survival_ratio;
        let ratio = point.pressure_ratio / self.reference_size;
        if let Some(exponent) = model.pressure_exponent(self.law, self.sides) {
            return Some(calibrated_reference(cycles, ratio, 1.0, exponent));
        }
        // A limit breaks the power law: the integral once more with the limit in units of the point's
        // pressure. It grows like the model without a limit.
        let mut law = self.laws[0];
        law.limit /= ratio;
        stress.volume(&[law]);
        let shares = stress.sums().layers(Loading::Normal(BodyId::One), 0);
        let weighted = shares.iter().zip(&self.depths);
        let ln_point = crate::math::ln_sum::ln_sum(
            weighted.map(|(ln, z)| (1.0, ln + model.ln_depth_weight(*z))),
        );
        let growth = model.growth(self.law, self.sides, false);
        let ln_reference = self.variants[0].ln_reference(BodyId::One, LifeIntegral::Snapshot);
        let ln = ln_point + growth * ratio.ln() - ln_reference;
        ln.is_finite()
            .then(|| cycles * (ln / self.law.weibull_slope).exp())
    }

    /// Loading cycles of the smooth contact of `size` times the scene's; `None`: the scene gives no calibration point.
    pub(in crate::sim) fn smooth_cycles(&self, size: f64) -> Option<f64> {
        Some(self.reference_cycles? * self.cycles_ratio(size / self.reference_size))
    }

    /// What a growth of the smooth contact by `ratio` does to its life.
    pub(super) fn cycles_ratio(&self, ratio: f64) -> f64 {
        let model = self.variants[0].model;
        let growth = model.growth(self.law, self.sides, false) + model.width(self.sides);
        ratio.powf(-growth / self.law.weibull_slope)
    }

    /// ln J of the reference for a contact of `size` times the scene's.
    pub(super) fn ln_reference(
        &self,
        variant: &Variant,
        body: BodyId,
        integral: LifeIntegral,
        size: f64,
    ) -> f64 {
        let ratio = size / self.reference_size;
        variant.ln_reference(body, integral) + self.growth(variant, integral) * ratio.ln()
    }

    /// Life of the smooth contact of `size` times the scene's, whose Hertz contact is `hertz`, but for the constant of the
    /// scene's model: I in GPa and mm, to the power of −1/e. `None`: no stress of it is above the fatigue limit, or there is
    /// no reference yet.
    pub(in crate::sim) fn smooth_life(&self, hertz: &Hertz, size: f64) -> Option<f64> {
        let Self { law, sides, .. } = *self;
        let scene = &self.variants[0];
        let over_stress = scene.model.over_stress(law);
        let all = scene.model.growth(law, sides, false) + scene.model.width(sides);
        let ln = self.ln_reference(scene, BodyId::One, LifeIntegral::Snapshot, size)
            + scene.model.width(sides) * size.ln()
            + over_stress * (hertz.p_max_pa * 1e-9).ln()
            + (all - over_stress) * (hertz.a_m * 1e3).ln();
        let life = law.integral_factor(0.0, ln);
        life.is_finite().then_some(life)
    }

    /// Whether any stress of the smooth contact is above the fatigue limit.
    pub(in crate::sim) fn reference_ends(&self) -> ReferenceLife {
        let scene = &self.variants[0];
        let limit = scene
            .model
            .stress_law(self.law)
            .map_or(0.0, |(_, limit)| limit);
        let ln = scene.ln_reference(BodyId::One, LifeIntegral::Snapshot);
        if limit > 0.0 && ln == f64::NEG_INFINITY {
            ReferenceLife::ForEver
        } else {
            ReferenceLife::Ends
        }
    }

    pub(super) fn growth(&self, variant: &Variant, integral: LifeIntegral) -> f64 {
        let swept = match integral {
            LifeIntegral::Snapshot => false,
            LifeIntegral::Material => true,
        };
        variant.model.growth(self.law, self.sides, swept)
    }

    /// Life of the smooth contact of `size` times the scene's over its life at the base. What a load costs the smooth
    /// contact is the same whatever is counted of the rough one.
    pub(super) fn load_factor(&self, variant: &Variant, body: BodyId, size: f64) -> f64 {
        let integral = LifeIntegral::Snapshot;
        let ln_base = variant.ln_base(body, integral);
        let ln_now = self.ln_reference(variant, body, integral, size);
        if ln_base == ln_now && size == 1.0 {
            // Below a fatigue limit both are −∞.
            return 1.0;
        }
        let width = variant.model.width(self.sides) * size.ln();
        self.law.integral_factor(ln_base, ln_now + width)
    }
}
