//! What others computed and measured, as data (`assets/studies/evidence.toml`).

use serde::Deserialize;

use super::super::Extent;
use super::random::AssumedRoughness;
use super::tried::TriedDamage;
use asperity_engine::closed_set;
use asperity_engine::plan::Plan;
use asperity_engine::scene::{Override, Scene};

/// The set, as it stands in the program.
/// Its text.
pub(super) const SET: &str = include_str!("../../../assets/studies/evidence.toml");

closed_set! {
    /// Where a number comes from.
    #[derive(PartialOrd, Ord)]
    pub enum Grade {
        /// Closed form.
        A = "A" "A closed form",
        /// Independent code.
        B = "B" "B independent code",
        /// Published computation.
        C = "C" "C published computation",
        /// Published experiment.
        D = "D" "D published experiment",
    }
}

/// What is read from a run.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Measure {
    /// Greatest pressure, greatest effective stress and its depth.
    Stress,
    /// Central and least film of the smooth contact.
    Smooth,
    /// Amplitude of a wave in the film, pure rolling.
    Wave,
    /// Amplitudes of the wave that moves with its body and of the one that moves with the oil.
    TwoWaves,
    /// What is bound to a low ripple, beside the closed form for the film and viscosity found.
    Hooke,
    /// Films round a dent.
    Dent,
}

/// Numbers that were read, by name.
pub(super) type Values = Vec<(&'static str, f64)>;

/// A number of a case.
#[derive(Debug, Clone, PartialEq, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct EvidenceNumber {
    /// What it is, with its unit.
    pub what: String,
    /// Name of the measured value.
    pub value: String,
    /// Grade, where it is not the case's.
    #[serde(default)]
    pub grade: Option<Grade>,
    /// Source, where it is not the case's.
    #[serde(default)]
    pub source: Option<String>,
    /// The source's number.
    #[serde(default)]
    pub theirs: Option<f64>,
    /// Half of the range that the source gives.
    #[serde(default)]
    pub spread: f64,
    /// The value of a closed form that takes the place of the source's number.
    #[serde(default)]
    pub closed: Option<String>,
    /// Relative deviation beyond which the two disagree.
    pub tolerance: f64,
    /// Most likely cause of a disagreement.
    #[serde(default)]
    pub cause: Option<String>,
}

/// A computed case.
#[derive(Debug, Clone, PartialEq, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct EvidenceCase {
    /// Name.
    pub name: String,
    /// Grade.
    pub grade: Grade,
    /// Source.
    pub source: String,
    /// Scene of `src/engine/assets/evidence`.
    pub scene: String,
    /// Keys set on top.
    #[serde(default)]
    pub set: Vec<String>,
    /// What is read.
    pub measure: Measure,
    /// Nodes of both grids in the quick, usual and full form.
    nodes: [Vec<usize>; 3],
    /// The numbers.
    pub row: Vec<EvidenceNumber>,
}

impl EvidenceCase {
    /// Nodes of both grids, coarse first; `None`: left out.
    pub fn nodes(&self, extent: Extent) -> Option<[usize; 2]> {
        let of = match extent {
            Extent::Quick => 0,
            Extent::Usual => 1,
            Extent::Full => 2,
        };
        self.nodes[of][..].try_into().ok()
    }
}

/// An operating point of an experiment.
#[derive(Debug, Clone, PartialEq, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct EvidencePoint {
    /// Name.
    pub label: String,
    /// Scene of `src/engine/assets/evidence`.
    pub scene: String,
    /// Keys set on top.
    #[serde(default)]
    pub set: Vec<String>,
    /// Body whose life it is.
    #[serde(default = "one")]
    pub body: usize,
    /// Depth at which stress is compared with that of the smooth contact, m; `None`: life.
    #[serde(default)]
    pub depth_m: Option<f64>,
    /// Place on the axis of a picture.
    #[serde(default)]
    pub x: Option<f64>,
    /// What was measured there.
    #[serde(default)]
    pub measured: Option<f64>,
}

fn one() -> usize {
    1
}

/// How two damages compare.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Comparison {
    /// The first is greater.
    Rank,
    /// Both are alike.
    Equal,
    /// The first is the measured multiple of the second.
    Ratio,
}

/// What an experiment says.
#[derive(Debug, Clone, PartialEq, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct EvidenceClaim {
    /// In words.
    pub says: String,
    /// How the points compare.
    pub kind: Comparison,
    /// The point with the greater damage.
    pub more: String,
    /// The other one; `None`: the smooth contact, whose stress is 1.
    #[serde(default)]
    pub less: Option<String>,
    /// The ratio that was measured.
    #[serde(default)]
    pub ratio: Option<f64>,
    /// Whether damage in equal times is compared, not in equal loading cycles.
    #[serde(default)]
    pub per_time: bool,
    /// Why it cannot be compared; such a claim is shown and not counted.
    #[serde(default)]
    pub not_compared: Option<String>,
    /// Most likely cause where no counting agrees.
    #[serde(default)]
    pub why: Option<String>,
}

impl EvidenceClaim {
    /// Damage of the one point over that of the other, by the damage of each label; `None`: one of them has none.
    pub(super) fn ratio_of(&self, of: impl Fn(&str) -> Option<TriedDamage>) -> Option<f64> {
        let more = of(&self.more)?;
        let less = match &self.less {
            Some(label) => of(label)?,
            None => TriedDamage { value: 1.0, ..more },
        };
        let time = if self.per_time {
            more.speed_m_s / less.speed_m_s
        } else {
            1.0
        };
        Some(more.value / less.value * time)
    }
}

/// A calibration by one point of an experiment, and what it foretells of another.
#[derive(Debug, Clone, PartialEq, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Forecast {
    /// The point with a known life.
    pub known: String,
    /// The one whose life is wanted.
    pub wanted: String,
    /// Known L10, millions.
    pub l10: f64,
    /// Lower end of its band.
    pub low: f64,
    /// Upper end.
    pub high: f64,
    /// Known L50.
    pub l50: f64,
}

/// An experiment.
#[derive(Debug, Clone, PartialEq, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Experiment {
    /// Name.
    pub name: String,
    /// Source.
    pub source: String,
    /// What was measured.
    pub measured: String,
    /// What of it can be compared.
    pub comparable: String,
    /// What cannot.
    pub not_comparable: String,
    /// Whether the quick form has it.
    pub quick: bool,
    /// Axis of a picture of its points.
    #[serde(default)]
    pub axis: Option<String>,
    /// Operating points.
    pub point: Vec<EvidencePoint>,
    /// What it says of them.
    pub claim: Vec<EvidenceClaim>,
    /// What its known life foretells.
    #[serde(default)]
    pub forecast: Option<Forecast>,
}

/// The set.
#[derive(Debug, Clone, PartialEq, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct EvidenceSet {
    /// Computations.
    #[serde(rename = "case")]
    pub cases: Vec<EvidenceCase>,
    /// Experiments.
    #[serde(rename = "experiment")]
    pub experiments: Vec<Experiment>,
    /// The roughness of the experiments, made.
    #[serde(rename = "made")]
    pub made: AssumedRoughness,
}

impl EvidenceSet {
    /// The set that comes with the program.
    ///
    /// # Errors
    /// What is wrong with the data.
    pub fn shipped() -> Result<Self, String> {
        toml::from_str(SET).map_err(|error| error.to_string())
    }
}

/// A scene of evidence with keys on top, and its plan.
///
/// # Errors
/// Why it is refused.
pub fn planned(scene: &str, sets: &[String]) -> Result<(Scene, Plan), String> {
    let overrides = sets
        .iter()
        .map(|text| text.parse::<Override>())
        .collect::<Result<Vec<_>, _>>()
        .map_err(|error| error.to_string())?;
    let scene = Scene::load_with(&format!("evidence/{scene}"), &overrides)
        .map_err(|error| error.to_string())?;
    let plan = Plan::new(&scene).map_err(|error| error.to_string())?;
    Ok((scene, plan))
}
