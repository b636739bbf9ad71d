//! Experiments with made surfaces in place of waves: of the same Rq, several pairs of them, each claim judged on the mean of
//! all pairs with its scatter.
//!
//! ```text
//! r_i = ln (damage of the one point / damage of the other) with pair i,   s² = Σ (r_i − ⟨r⟩)²/(n − 1)
//! ratio = exp ⟨r⟩,   known to lie within exp (⟨r⟩ ± t s/√n)   with 90 %, t of Student's distribution of n − 1
//! ```
//! A claim is met where it holds all over that range, not met where it holds nowhere in it, and else not decided. Both points
//! of a ratio have the same pair of surfaces, so what the pair itself does to both falls out.

use std::f64::consts::SQRT_2;

use serde::Deserialize;

use super::set::{EvidenceClaim, EvidencePoint, Experiment, planned};
use super::tried::{TriedDamage, damage_of, holds, window};
use asperity_engine::closed_set;
use asperity_engine::plan::Plan;
use asperity_engine::scene::{CycleBasis, Scene, Surface};
use asperity_session::sweep::Scatter;

/// Two-sided 90 % of Student's distribution, of 1 to 9 degrees of freedom.
const STUDENT: [f64; 9] = [
    6.314, 2.920, 2.353, 2.132, 2.015, 1.943, 1.895, 1.860, 1.833,
];

/// Standard errors either way that hold the mean of `n` numbers, 2 and more, with 90 %.
pub fn student(n: usize) -> f64 {
    STUDENT[n.saturating_sub(2).min(STUDENT.len() - 1)]
}

/// What is assumed of the roughness beside its Rq: the facts at hand do not give it.
#[derive(Debug, Clone, PartialEq, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct AssumedRoughness {
    /// Why these.
    pub about: String,
    /// Length of the exponential autocorrelation along the motion, m; across it the ridges do not end.
    pub correlation_x_m: f64,
    /// Shortest waves, m: the first is the one that all countings are tried with.
    pub cutoffs_short_m: Vec<f64>,
    /// Length after which a surface comes again, m; a run is at least that long.
    pub period_x_m: f64,
    /// Of both bodies, Pa.
    pub hardness_pa: f64,
    /// Pairs of surfaces, 2 to 10.
    pub pairs: u64,
    /// Nodes of the grid.
    pub nodes: usize,
    /// What the study leaves out, tried by damage with the first cut-off.
    #[serde(default)]
    pub variant: Vec<MadeVariant>,
}

/// Physics that the other ways leave out.
#[derive(Debug, Clone, PartialEq, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct MadeVariant {
    /// Name of its column.
    pub name: String,
    /// Where its numbers come from.
    pub about: String,
    /// Keys set in every scene that has oil.
    pub set: Vec<String>,
    /// Points that it is tried at, by label; none named: all.
    #[serde(default)]
    pub points: Vec<String>,
}

/// One way of trying: a cut-off and a counting.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct MadeWay {
    /// Shortest wave, m.
    pub cutoff_short_m: f64,
    /// How cycles are counted.
    pub basis: CycleBasis,
    /// Which of [`AssumedRoughness::variant`]; `None`: with nothing that the study leaves out.
    pub variant: Option<usize>,
}

impl AssumedRoughness {
    /// The first cut-off by damage and by the paper's count, the others by damage; then the variants.
    pub fn ways(&self) -> Vec<MadeWay> {
        let way = |basis| {
            move |&cutoff_short_m: &f64| MadeWay {
                cutoff_short_m,
                basis,
                variant: None,
            }
        };
        let by_paper = self
            .cutoffs_short_m
            .iter()
            .take(1)
            .map(way(CycleBasis::Global));
        let mut ways: Vec<MadeWay> = by_paper.collect();
        ways.extend(self.cutoffs_short_m.iter().map(way(CycleBasis::Damage)));
        ways.rotate_left(1);
        let first = ways[0];
        ways.extend((0..self.variant.len()).map(|variant| MadeWay {
            variant: Some(variant),
            ..first
        }));
        ways
    }

    /// Whether a point is tried that way.
    pub fn tries(&self, point: &EvidencePoint, way: MadeWay) -> bool {
        let Some(variant) = way.variant.map(|at| &self.variant[at]) else {
            return true;
        };
        variant.points.is_empty() || variant.points.contains(&point.label)
    }

    /// Keys that put made surfaces in the place of a point's waves.
    ///
    /// # Errors
    /// Why the scene itself is refused.
    pub fn keys(
        &self,
        point: &EvidencePoint,
        way: MadeWay,
        pair: u64,
    ) -> Result<Vec<String>, String> {
        let (scene, plan) = planned(&point.scene, &point.set)?;
        let mut keys = point.set.clone();
        for (body, of) in [(1, &scene.body_1.surface), (2, &scene.body_2.surface)] {
            keys.push(format!("body_{body}.hardness_pa={:e}", self.hardness_pa));
            let amplitude_m = match of {
                Surface::Sinusoid { amplitude_m, .. } => amplitude_m,
                Surface::Smooth {} | Surface::Random(_) | Surface::HeightMap { .. } => continue,
            };
            let surface = format!("body_{body}.surface");
            let seed = pair + if body == 1 { 0 } else { 1_000_000 };
            keys.extend([
                format!("{surface}.kind=random"),
                format!("{surface}.seed={seed}"),
                format!("{surface}.rq_m={:.3e}", amplitude_m / SQRT_2),
                format!("{surface}.correlation_x_m={:e}", self.correlation_x_m),
                format!("{surface}.correlation_y_m=inf"),
                format!("{surface}.cutoff_short_m={:e}", way.cutoff_short_m),
                format!("{surface}.period_x_m={:e}", self.period_x_m),
            ]);
        }
        let passages = (self.period_x_m / (4.0 * plan.hertz.a_m)).ceil();
        keys.extend([
            format!("time.passages={passages}"),
            format!("grid.nodes={}", self.nodes),
            format!("life.cycles={}", way.basis.key()),
            "numerics.error_estimate=none".to_owned(),
        ]);
        if let Some(variant) = way.variant.filter(|_| scene.lubricant.is_some()) {
            keys.extend_from_slice(&self.variant[variant].set);
        }
        Ok(keys)
    }
}

/// The damage of a point with a pair of made surfaces.
pub(super) fn made_damage(
    assumed: &AssumedRoughness,
    point: &EvidencePoint,
    way: MadeWay,
    pair: u64,
) -> Result<TriedDamage, String> {
    let keys = assumed.keys(point, way, pair)?;
    let (scene, plan): (Scene, Plan) = planned(&point.scene, &keys)?;
    damage_of(point, &scene, plan)
}

closed_set! {
    /// What the pairs say of a claim.
    pub enum Verdict {
        /// It holds all over the range.
        Met = "met" "met",
        /// It holds nowhere in it.
        NotMet = "not_met" "not met",
        /// Neither.
        NotDecided = "not_decided" "not decided",
    }
}

/// A claim with made surfaces, one way.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct MadeRatio {
    /// Geometric mean over the pairs.
    pub ratio: f64,
    /// The range in which it lies with 90 %.
    pub range: [f64; 2],
    /// What that says.
    pub verdict: Verdict,
}

impl MadeRatio {
    /// Judges a claim by its ratio with every pair; `None`: fewer than two were found.
    pub fn judge(claim: &EvidenceClaim, ratios: &[f64]) -> Option<Self> {
        let found = Scatter::of(ratios.iter().copied())?;
        if found.n < 2 || found.n < ratios.len() {
            return None;
        }
        let factor = found.of_mean().powf(student(found.n));
        let range = [found.mean / factor, found.mean * factor];
        let [least, most] = window(claim);
        let verdict = if range.iter().all(|end| holds(claim, *end)) {
            Verdict::Met
        } else if range[1] <= least || range[0] >= most {
            Verdict::NotMet
        } else {
            Verdict::NotDecided
        };
        Some(Self {
            ratio: found.mean,
            range,
            verdict,
        })
    }
}

/// An experiment's points with every pair, and what its claims come to: `damages[point][way][pair]`, `judged[claim][way]`.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct TriedPairs {
    /// Damages; why there is none. Ways that a point is not tried have no pair.
    pub damages: Vec<Vec<Vec<Result<TriedDamage, String>>>>,
    /// The claims.
    pub judged: Vec<Vec<Option<MadeRatio>>>,
}

impl TriedPairs {
    pub(super) fn new(
        experiment: &Experiment,
        ways: usize,
        damages: Vec<Vec<Vec<Result<TriedDamage, String>>>>,
    ) -> Self {
        let of_claim = |claim: &EvidenceClaim| -> Vec<Option<MadeRatio>> {
            let judge = |way: usize| {
                let pairs = damages.iter().map(|ways| ways[way].len()).max();
                let pairs = pairs.unwrap_or(0);
                let ratio = |pair: usize| {
                    let of = |label: &str| {
                        let at = experiment.point.iter().position(|p| p.label == label)?;
                        damages[at][way].get(pair)?.as_ref().ok().copied()
                    };
                    claim.ratio_of(of).unwrap_or(f64::NAN)
                };
                let ratios: Vec<f64> = (0..pairs).map(ratio).collect();
                MadeRatio::judge(claim, &ratios)
            };
            (0..ways).map(judge).collect()
        };
        Self {
            judged: experiment.claim.iter().map(of_claim).collect(),
            damages,
        }
    }

    /// Life of a point, or its stress over the smooth contact's, over the pairs of a way.
    pub fn scatter(&self, point: usize, way: usize, is_stress: bool) -> Option<Scatter> {
        let found = &self.damages.get(point)?[way];
        let of = |damage: &TriedDamage| {
            if is_stress {
                damage.value
            } else {
                1.0 / damage.value
            }
        };
        Scatter::of(found.iter().flatten().map(of))
    }
}

#[cfg(test)]
mod tests {
    use super::super::set::Comparison;
    use super::*;

    fn judged(kind: Comparison, ratio: Option<f64>, ratios: &[f64]) -> Verdict {
        let claim = EvidenceClaim {
            says: String::new(),
            kind,
            more: String::new(),
            less: None,
            ratio,
            per_time: false,
            not_compared: None,
            why: None,
        };
        MadeRatio::judge(&claim, ratios)
            .expect("two and more")
            .verdict
    }

    /// Five numbers whose mean and standard error are known: e^0.5 and 0.1, t = 2.132.
    #[test]
    fn a_claim_is_decided_by_the_range_of_its_mean() {
        let s = 0.1 * 5_f64.sqrt();
        let spread = [-1.0, -1.0, 0.0, 1.0, 1.0].map(|e| 0.5 + s * e);
        let pairs = spread.map(f64::exp);
        let claim = |kind, ratio| judged(kind, ratio, &pairs);
        let found = Scatter::of(pairs).expect("there are five");
        assert!((found.of_mean().ln() - 0.1).abs() < 1e-12);
        // The range is 1.33 to 2.04.
        assert_eq!(claim(Comparison::Rank, None), Verdict::Met);
        assert_eq!(claim(Comparison::Equal, None), Verdict::NotDecided);
        assert_eq!(claim(Comparison::Ratio, Some(2.0)), Verdict::Met);
        assert_eq!(claim(Comparison::Ratio, Some(100.0)), Verdict::NotMet);
        assert_eq!(claim(Comparison::Ratio, Some(5.0)), Verdict::NotDecided);
        let turned = pairs.map(|ratio| 1.0 / ratio);
        assert_eq!(judged(Comparison::Rank, None, &turned), Verdict::NotMet);
        assert!(
            MadeRatio::judge(
                &EvidenceClaim {
                    says: String::new(),
                    kind: Comparison::Rank,
                    more: String::new(),
                    less: None,
                    ratio: None,
                    per_time: false,
                    not_compared: None,
                    why: None,
                },
                &[2.0, f64::NAN, 3.0]
            )
            .is_none()
        );
    }
}
