//! One life model as it runs: its mean over the phases, its maximum over the track, its reference.

use serde::{Deserialize, Serialize};

use super::counting::Counting;
use super::stress_stage::StressStage;
use crate::math::ln_sum::ln_list;
use crate::physics::cycles::BodyId;
use crate::physics::fatigue::LifeLaw;
use crate::physics::life_models::LifeEquation;
use crate::saved::saved;
use crate::scene::{CycleBasis, Life, LifeModel, Spread};
use crate::solve::life::{LifeMeter, Shares, SweptRows, Window};
use crate::solve::stress::{Loading, StressLaw};

/// Which volume integral is taken; what belongs to which count: `damage_count.rs`.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum LifeIntegral {
    /// Mean of the integral over the phases of a passage.
    Snapshot,
    /// Mean over material points of the maximum stress that each meets.
    Material,
}

impl LifeIntegral {
    /// The one that belongs to a cycle basis.
    pub(super) fn of(basis: CycleBasis) -> Self {
        match basis {
            CycleBasis::Damage => Self::Material,
            CycleBasis::Global | CycleBasis::Peaks => Self::Snapshot,
        }
    }
}

/// A model with its accumulators: plain data, all of it state.
#[derive(Debug, Clone, Serialize, Deserialize)]
pub(super) struct Variant {
    pub(super) model: LifeEquation,
    /// Place of its stress law in the volume pass; `None`: it reads slices.
    pub(super) law: Option<usize>,
    meter: LifeMeter,
    /// Maximum shares over all samples (models of one depth), or the swept integral.
    swept: Shares,
    /// The swept integral as the mean over material points, where it is counted; else as it is: the bound.
    material: Shares,
    /// ln J of the reference of now, `[2 · body + integral]`, in the scene's units; of a smooth contact all material
    /// points meet the same.
    #[serde(with = "ln_list")]
    reference: Vec<f64>,
    /// Same of the base: the conditions that the scene began with.
    #[serde(with = "ln_list")]
    base: Vec<f64>,
    /// Half range of shear, or risk, by depth of each body in the last sample, p_h (models of one depth).
    by_depth: [Vec<f32>; 2],
}

saved! {
    Variant {
        same: model, law;
        parts: meter, swept, material, reference, base, by_depth;
    }
}

/// What every variant is computed with.
pub(super) struct Shared<'a> {
    pub(super) law: LifeLaw,
    pub(super) laws: &'a [StressLaw],
    pub(super) sweep: &'a SweptRows,
    pub(super) scratch: Shares,
}

impl Variant {
    pub(super) fn new(
        model: LifeEquation,
        law: Option<usize>,
        depths: usize,
        (window, capacity): (Window, usize),
    ) -> Self {
        Self {
            model,
            law,
            meter: LifeMeter::new(depths, window, capacity),
            swept: Shares::new(depths),
            material: Shares::new(depths),
            reference: vec![f64::NEG_INFINITY; 4],
            base: vec![f64::NEG_INFINITY; 4],
            by_depth: [vec![0.0; depths], vec![0.0; depths]],
        }
    }

    /// Takes the smooth, frictionless contact as the reference.
    pub(super) fn set_reference(&mut self, stress: &mut StressStage, shared: &mut Shared) {
        self.take(stress, shared);
        for body in BodyId::BOTH {
            let at = 2 * body.index();
            self.reference[at] = shared.scratch.ln(Loading::Normal(body));
            self.reference[at + 1] = self.swept.ln(Loading::Normal(body));
        }
        self.base.clone_from(&self.reference);
        self.restart();
    }

    /// Begins with the base of a variant of the same make.
    pub(super) fn take_base(&mut self, other: &Self) {
        self.base.clone_from(&other.base);
        self.reference.clone_from(&other.base);
    }

    /// Begins with base and reference of a variant of the same make on a coarser mesh.
    pub(super) fn take_references(&mut self, other: &Self) {
        self.base.clone_from(&other.base);
        self.reference.clone_from(&other.reference);
    }

    /// The base is what it was on the coarser mesh, times what the reference there has become on this one.
    pub(super) fn raise_base(&mut self, coarser: &Self) {
        let pairs = coarser.base.iter().zip(&coarser.reference);
        for ((own, reference), (base, before)) in
            self.base.iter_mut().zip(&self.reference).zip(pairs)
        {
            // Below a fatigue limit all are −∞.
            *own = if base == before {
                *reference
            } else {
                base + (reference - before)
            };
        }
    }

    /// Takes the reference of `other`, a variant of the same make, for the one of now; the base stays.
    pub(super) fn move_reference(&mut self, other: &Self) {
        self.reference.clone_from(&other.reference);
    }

    /// ln J of the reference of now.
    pub(super) fn ln_reference(&self, body: BodyId, integral: LifeIntegral) -> f64 {
        self.reference[2 * body.index() + integral as usize]
    }

    /// ln J of the base.
    pub(super) fn ln_base(&self, body: BodyId, integral: LifeIntegral) -> f64 {
        self.base[2 * body.index() + integral as usize]
    }

    /// Takes the mean over `window` (in a) from now on.
    pub(super) fn set_window(&mut self, window: Window) {
        self.meter.set_window(window);
    }

    /// Forgets all samples.
    pub(super) fn restart(&mut self) {
        self.meter.restart();
        self.swept.clear();
        self.material.clear();
    }

    /// Takes the surface loaded last; the volume pass has been made.
    pub(super) fn push(&mut self, distance: f64, stress: &mut StressStage, shared: &mut Shared) {
        self.take(stress, shared);
        self.meter.push(distance, &shared.scratch);
    }

    /// What has been swept, as the mean over the material points of `counting`.
    pub(super) fn weigh_material(&mut self, counting: Option<&Counting>) {
        for loading in Loading::ALL {
            let target = self.material.of_mut(loading);
            target.copy_from_slice(self.swept.of(loading));
            let ratios = self
                .law
                .and_then(|law| counting?.ln_ratios(loading.body(), law));
            for (share, ln) in target.iter_mut().zip(ratios.unwrap_or_default()) {
                *share += ln;
            }
        }
    }

    /// Shares of the surface loaded last into the scratch, and what has been swept.
    fn take(&mut self, stress: &mut StressStage, shared: &mut Shared) {
        let depths = stress.depth_count();
        for loading in Loading::ALL {
            if let Some(law) = self.law {
                let target = shared.scratch.of_mut(loading);
                let sums = stress.sums();
                target.copy_from_slice(sums.layers(loading, law));
                let swept = self.swept.of_mut(loading);
                sums.swept_into(shared.sweep.of(loading), shared.laws[law], swept);
                for (k, (share, swept)) in target.iter_mut().zip(swept).enumerate() {
                    let weight = self.model.ln_depth_weight(stress.depths()[k]);
                    *share += weight;
                    *swept += weight;
                }
            } else if let Some(same) = stress.equal_loading(loading) {
                for k in 0..depths {
                    shared.scratch.of_mut(loading)[k] = shared.scratch.of(same)[k];
                    self.swept.of_mut(loading)[k] = self.swept.of(same)[k];
                }
                if loading.body() != same.body() {
                    let [one, two] = &mut self.by_depth;
                    two.copy_from_slice(one);
                }
            } else {
                stress.criterion_slice(loading);
                let target = shared.scratch.of_mut(loading);
                // Full load comes after the pressure alone and stays.
                let by_depth = &mut self.by_depth[loading.body().index()];
                stress.criterion((self.model, shared.law), by_depth, target);
                for (most, share) in self.swept.of_mut(loading).iter_mut().zip(target) {
                    *most = most.max(*share);
                }
            }
        }
    }

    /// Shares of an integral; `None` before the first sample.
    pub(super) fn shares(&self, integral: LifeIntegral) -> Option<&Shares> {
        let mean = self.meter.mean()?;
        Some(match integral {
            LifeIntegral::Snapshot => mean,
            LifeIntegral::Material => &self.material,
        })
    }

    /// Risk by depth of a body in the last sample, p_h; `None` for models that integrate.
    pub(super) fn risk(&self, body: BodyId) -> Option<&[f32]> {
        self.law.is_none().then(|| &self.by_depth[body.index()][..])
    }

    pub(super) fn meter(&self) -> &LifeMeter {
        &self.meter
    }
}

/// The models that are computed: the scene's, and those of the spread.
pub(super) fn models(asked: &Life, p_hertz_pa: f64) -> Vec<LifeEquation> {
    let make = |model: LifeModel| asked.equation(model, p_hertz_pa);
    let own = std::iter::once(asked.model);
    match asked.spread {
        Spread::Off | Spread::Cycles => own.map(make).collect(),
        Spread::Models => {
            let others = LifeModel::ALL
                .into_iter()
                .filter(|model| *model != asked.model);
            own.chain(others).map(make).collect()
        }
    }
}
