//! Experiments: the damage at their operating points by every counting of cycles, and whether what they say holds.

use serde::{Deserialize, Serialize};

use super::measure::{on_grid, run};
use super::random::TriedPairs;
use super::set::{Comparison, EvidenceClaim, EvidencePoint, Experiment};
use asperity_engine::plan::Plan;
use asperity_engine::scene::{CycleBasis, Scene, Surface};
use asperity_engine::sim::{Frame, Simulation, Stage};

/// A ratio above it counts as a rank: what mesh and phases leave of a life that goes with a tenth power of the stress.
const MORE: f64 = 1.1;
/// Damages within this factor are alike: no fatigue test tells less.
const ALIKE: f64 = 1.5;
/// A ratio of lives is met within half a decade: the scatter of a mean of few fatigue tests.
const HALF_A_DECADE: f64 = 3.162_277_660_168_379_5;

/// A point by one counting.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub struct TriedDamage {
    /// 1/life in own loading cycles, or the stress over that of the smooth contact.
    pub value: f64,
    /// Speed of the body, m/s: its loading cycles in a time.
    pub speed_m_s: f64,
}

/// What a claim comes to by every counting.
#[derive(Debug, Clone, PartialEq)]
pub struct Judged {
    /// The claim.
    pub claim: EvidenceClaim,
    /// Damage of the one point over that of the other, by counting.
    pub ratios: Vec<f64>,
    /// Whether the claim holds, by counting.
    pub holds: Vec<bool>,
    /// Whether it goes by stress, which no counting touches.
    pub is_stress: bool,
}

impl Judged {
    /// Whether it is among those by which countings are told apart.
    pub fn counts(&self) -> bool {
        !self.is_stress && self.claim.not_compared.is_none()
    }
}

/// An experiment and what the program says of it.
#[derive(Debug, Clone, PartialEq)]
pub struct Tried {
    /// The experiment.
    pub experiment: Experiment,
    /// Damages of its points, by counting; why there is none.
    pub damages: Vec<Vec<Result<TriedDamage, String>>>,
    /// Its claims.
    pub judged: Vec<Judged>,
    /// The same with made surfaces; empty: not tried.
    pub pairs: TriedPairs,
}

impl Tried {
    /// Judges the claims by the damages found.
    pub(super) fn new(
        experiment: &Experiment,
        damages: Vec<Vec<Result<TriedDamage, String>>>,
        pairs: TriedPairs,
    ) -> Self {
        let of = |label: &str, counting: usize| {
            let at = experiment.point.iter().position(|p| p.label == label)?;
            damages[at][counting].as_ref().ok().copied()
        };
        let judged = experiment.claim.iter().map(|claim| {
            let ratios: Vec<f64> = (0..CycleBasis::ALL.len())
                .map(|counting| {
                    let ratio = claim.ratio_of(|label| of(label, counting));
                    ratio.unwrap_or(f64::NAN)
                })
                .collect();
            let is_stress = experiment
                .point
                .iter()
                .any(|point| point.label == claim.more && point.depth_m.is_some());
            Judged {
                holds: ratios.iter().map(|ratio| holds(claim, *ratio)).collect(),
                claim: claim.clone(),
                ratios,
                is_stress,
            }
        });
        let judged = judged.collect();
        Self {
            experiment: experiment.clone(),
            damages,
            judged,
            pairs,
        }
    }
}

/// Ratios between which a claim holds.
pub(super) fn window(claim: &EvidenceClaim) -> [f64; 2] {
    match claim.kind {
        Comparison::Rank => [MORE, f64::INFINITY],
        Comparison::Equal => [1.0 / ALIKE, ALIKE],
        Comparison::Ratio => {
            let theirs = claim.ratio.unwrap_or(f64::NAN);
            [theirs / HALF_A_DECADE, theirs * HALF_A_DECADE]
        }
    }
}

pub(super) fn holds(claim: &EvidenceClaim, ratio: f64) -> bool {
    let [least, most] = window(claim);
    ratio > least && ratio <= most
}

/// The damage of a point by a counting, on `nodes`.
pub(super) fn damage(
    point: &EvidencePoint,
    basis: CycleBasis,
    nodes: usize,
) -> Result<TriedDamage, String> {
    let mut set = point.set.clone();
    set.push(format!("life.cycles={}", basis.key()));
    let (scene, plan) = on_grid(&point.scene, &set, nodes, nodes)?;
    damage_of(point, &scene, plan)
}

/// The damage of a point by its scene.
pub(super) fn damage_of(
    point: &EvidencePoint,
    scene: &Scene,
    plan: Plan,
) -> Result<TriedDamage, String> {
    let speed_m_s = scene.speeds_m_s()[point.body - 1].abs();
    let value = if let Some(depth_m) = point.depth_m {
        let mut smooth = scene.clone();
        (smooth.body_1.surface, smooth.body_2.surface) = (Surface::Smooth {}, Surface::Smooth {});
        stress_at(scene, depth_m)? / stress_at(&smooth, depth_m)?
    } else {
        let summary = run(scene, plan)?;
        let life = [summary.life_body_1, summary.life_body_2][point.body - 1];
        1.0 / life.ok_or("no life")?
    };
    if value.is_finite() {
        Ok(TriedDamage { value, speed_m_s })
    } else {
        Err(format!("damage {value}"))
    }
}

/// Greatest effective stress of a passage at a depth of body 1, Pa.
fn stress_at(scene: &Scene, depth_m: f64) -> Result<f64, String> {
    let plan = Plan::new(scene).map_err(|error| error.to_string())?;
    let steps = plan.steps_per_passage;
    let mut sim = Simulation::new(scene, plan, 1).map_err(|error| error.to_string())?;
    let mut frame = Frame::default();
    let mut greatest = 0.0_f64;
    while sim.stage() != Stage::Passage || sim.passage_steps() < steps {
        sim.step().map_err(|error| error.to_string())?;
        if sim.stage() != Stage::Passage {
            continue;
        }
        sim.fill(&mut frame);
        let slice = frame.slice.as_ref().ok_or("no stress")?;
        let row = |k: usize| {
            let row = &slice.effective_pa[k * frame.nx..(k + 1) * frame.nx];
            row.iter().map(|s| f64::from(*s)).fold(0.0, f64::max)
        };
        let above = slice.depths_m.partition_point(|z| *z < depth_m);
        let below = above.min(slice.depths_m.len() - 1);
        let above = below.saturating_sub(1);
        let [z_1, z_2] = [above, below].map(|k| slice.depths_m[k]);
        let share = ((depth_m - z_1) / (z_2 - z_1)).clamp(0.0, 1.0);
        greatest = greatest.max(row(above) + share * (row(below) - row(above)));
    }
    Ok(greatest)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn claim(kind: Comparison, ratio: Option<f64>) -> EvidenceClaim {
        EvidenceClaim {
            says: String::new(),
            kind,
            more: String::new(),
            less: None,
            ratio,
            per_time: false,
            not_compared: None,
            why: None,
        }
    }

    #[test]
    fn claims_hold_where_they_should_and_nowhere_else() {
        assert!(
            holds(&claim(Comparison::Rank, None), 1.2)
                && !holds(&claim(Comparison::Rank, None), 1.05)
        );
        assert!(
            holds(&claim(Comparison::Equal, None), 0.8)
                && !holds(&claim(Comparison::Equal, None), 2.0)
        );
        let ratio = claim(Comparison::Ratio, Some(100.0));
        assert!(holds(&ratio, 250.0) && holds(&ratio, 40.0));
        assert!(!holds(&ratio, 20.0) && !holds(&ratio, 400.0));
        for kind in [Comparison::Rank, Comparison::Equal, Comparison::Ratio] {
            assert!(!holds(&claim(kind, Some(1.0)), f64::NAN));
        }
    }
}
