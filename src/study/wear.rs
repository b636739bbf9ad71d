//! Pits on surfaces that wear, beside what was published of them: the part A_p of a surface that has pits after ten million cycles,
//! without wear and with it, against S, against lambda, by whose roughness it is and along a tooth, each with several pairs of
//! made surfaces.
//!
//! ```text
//! d_i = A_p of one case − A_p of another, both with pair i;   a claim is judged over ⟨d⟩ ± t s/√n: 90 % of Student's distribution
//! ```
//! The coefficient, the film below which roughness touches and the calibration point are assumptions: the sources have units of
//! their own, or no number. Theirs: Morales-Espejel & Brizmer (2011), Tribol. Trans. 54, 625; Morales-Espejel, Rycerz & Kadiric
//! (2018), Wear 398-399, 99.

use std::sync::Arc;

use asperity_engine::plan::Plan;
use asperity_engine::scene::{CycleBasis, Scene};
use asperity_engine::sim::Summary;

use super::evidence::{
    AssumedRoughness, EvidencePoint, EvidenceSet, MadeWay, Verdict, planned, student,
};
use super::{
    Extent, MarkdownTable, Report, StudyError, StudyProgress, climb, refuse_nothing, run_all,
};

/// Coefficient of both bodies, 1/Pa: none, and that of mild wear.
const COEFFICIENTS: [f64; 2] = [0.0, 5e-18];
/// What every run has, beside what the evidence assumes of roughness.
const AGED: [&str; 9] = [
    "grid.nodes=129",
    "time.passages=1",
    "numerics.ladder=false",
    "record=none",
    "age.cycles=1e7",
    "age.tolerance=0.1",
    "wear.thin_film_m=5e-8",
    "life.calibration_cycles=1e7",
    "life.calibration_pressure_pa=1.7e9",
];
/// Length after which a surface comes again, m: a passage.
const PERIOD_M: f64 = 0.96e-3;
/// Two discs at lambda .25, each with as much of the roughness, in keys of their scene.
const DISCS: [&str; 2] = ["motion.entrainment_m_s=0.345", "motion.slide_roll=0.02"];

/// A case of a source.
#[derive(Debug, Clone, PartialEq)]
struct Place {
    point: EvidencePoint,
    /// A_p as published, without wear and with it: their computations.
    published: [&'static str; 2],
}

/// All of them: discs, then the tooth of the evidence.
fn places(set: &EvidenceSet) -> Result<Vec<Place>, StudyError> {
    let discs = |label: &str, keys: &[&str], published| Place {
        point: EvidencePoint {
            label: label.to_owned(),
            scene: "two_rough_discs".to_owned(),
            set: DISCS
                .iter()
                .chain(keys)
                .map(|&key| key.to_owned())
                .collect(),
            body: 1,
            depth_m: None,
            x: None,
            measured: None,
        },
        published,
    };
    let s = |label, key, published| discs(label, &[key], published);
    let lambda = |label, amplitude_m: [&str; 2], published| discs(label, &amplitude_m, published);
    let mut places = vec![
        s("discs, S .005", "motion.slide_roll=0.005", ["-", "-"]),
        s(
            "discs, S .01",
            "motion.slide_roll=0.01",
            ["-", "9.5 (.011)"],
        ),
        discs("discs, S .02", &[], ["15 (lambda .2)", "2.4 (.019)"]),
        s("discs, S .05", "motion.slide_roll=0.05", ["-", "0.4"]),
        lambda(
            "discs, lambda .6",
            [
                "body_1.surface.amplitude_m=1.35e-7",
                "body_2.surface.amplitude_m=1.35e-7",
            ],
            ["11", "5"],
        ),
        lambda(
            "discs, lambda 1",
            [
                "body_1.surface.amplitude_m=8.1e-8",
                "body_2.surface.amplitude_m=8.1e-8",
            ],
            ["9", "8.5"],
        ),
        discs(
            "smooth under rough",
            &[
                "body_1.surface.kind=smooth",
                "body_2.surface.amplitude_m=4.58e-7",
            ],
            ["44 and .042", "-"],
        ),
    ];
    let gear = (set.experiments.iter())
        .find(|e| e.point[0].scene == "morales_rycerz_kadiric_2018_gear")
        .ok_or_else(|| StudyError::Scene("the evidence has no gear".to_owned()))?;
    let along = [
        ["91", "24"],
        ["89", "24"],
        ["85", "28"],
        ["71", "36"],
        ["47", "47"],
        ["0", "0"],
    ];
    places.extend(
        (gear.point.iter().zip(along)).map(|(point, published)| Place {
            point: point.clone(),
            published,
        }),
    );
    Ok(places)
}

/// What two cases are compared by.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Compared {
    Without,
    With,
    /// The one less the other.
    Taken,
}
use Compared::{Taken, With, Without};

impl Compared {
    fn words(self) -> &'static str {
        match self {
            Without => "without wear",
            With => "with wear",
            Taken => "what wear takes away",
        }
    }
}

/// A case: of its bodies what its source gives, or one of them.
#[derive(Debug, Clone, Copy)]
struct Side {
    label: &'static str,
    body: Option<usize>,
}

const fn at(label: &'static str) -> Side {
    Side { label, body: None }
}

const fn of_body(label: &'static str, body: usize) -> Side {
    Side {
        label,
        body: Some(body),
    }
}

/// What was published, as more pits here than there.
const CLAIMS: [(Compared, Side, Side); 13] = [
    (Without, at("discs, S .05"), at("discs, S .005")),
    (With, at("discs, S .01"), at("discs, S .05")),
    (Taken, at("discs, S .05"), at("discs, S .005")),
    (Without, at("discs, S .02"), at("discs, lambda .6")),
    (Without, at("discs, lambda .6"), at("discs, lambda 1")),
    (With, at("discs, lambda 1"), at("discs, S .02")),
    (Taken, at("discs, S .02"), at("discs, lambda 1")),
    (
        Without,
        of_body("smooth under rough", 1),
        of_body("smooth under rough", 2),
    ),
    (Without, at("22.38 deg"), at("24.92 deg")),
    (Without, at("24.92 deg"), at("27.14 deg")),
    (With, at("24.92 deg"), at("22.38 deg")),
    (With, at("27.14 deg"), at("24.92 deg")),
    (Taken, at("22.38 deg"), at("27.14 deg")),
];

/// A run: a case, one of [`COEFFICIENTS`] and a pair of surfaces.
struct Asked<'a> {
    place: &'a Place,
    with: usize,
    pair: u64,
    made: &'a AssumedRoughness,
}

impl Asked<'_> {
    fn name(&self) -> String {
        let (label, k) = (&self.place.point.label, COEFFICIENTS[self.with]);
        format!("{label}, k {k:e}, pair {}", self.pair)
    }

    fn planned(&self) -> Result<(Scene, Plan), String> {
        let way = MadeWay {
            cutoff_short_m: self
                .made
                .cutoffs_short_m
                .iter()
                .copied()
                .fold(0.0, f64::max),
            basis: CycleBasis::Damage,
            variant: None,
        };
        let point = &self.place.point;
        let mut keys = self.made.keys(point, way, self.pair)?;
        let periods: Vec<String> = keys
            .iter()
            .filter_map(|key| key.split_once(".period_x_m="))
            .map(|(surface, _)| format!("{surface}.period_x_m={PERIOD_M:e}"))
            .collect();
        keys.extend(periods);
        keys.extend(AGED.map(str::to_owned));
        let k = COEFFICIENTS[self.with];
        keys.extend([1, 2].map(|body| format!("wear.coefficient_{body}_per_pa={k:e}")));
        planned(&point.scene, &keys)
    }

    fn run(&self) -> Result<Summary, String> {
        let (scene, plan) = self.planned()?;
        Ok(climb(Arc::new(scene), plan, 1)?.summary)
    }
}

/// A case with every pair of surfaces: pitted parts of both bodies, without wear and with it.
#[derive(Debug, Clone, PartialEq)]
pub struct Pitted {
    place: Place,
    /// `[without, with][pair][body]`.
    parts: [Vec<[f64; 2]>; 2],
    converged: bool,
    seconds: f64,
}

impl Pitted {
    /// Mean over the pairs of one body, or of both.
    fn mean(&self, with: usize, of: impl Fn([f64; 2]) -> f64) -> f64 {
        let parts = &self.parts[with];
        parts.iter().map(|&part| of(part)).sum::<f64>() / parts.len() as f64
    }
}

/// Of both bodies; on a tooth the driver's, as published.
fn of_interest(place: &Place, [first, second]: [f64; 2]) -> f64 {
    if place.point.x.is_some() {
        first
    } else {
        f64::midpoint(first, second)
    }
}

/// Runs those cases whose name holds `only` if that is given, so many runs at a time.
///
/// # Errors
/// [`StudyError`] when a run fails, or when none has that in its name.
pub fn wear(
    extent: Extent,
    only: Option<&str>,
    threads: usize,
    progress: &mut StudyProgress,
) -> Result<Vec<Pitted>, StudyError> {
    let set = EvidenceSet::shipped().map_err(StudyError::Scene)?;
    let mut places = places(&set)?;
    places.retain(|place| only.is_none_or(|only| place.point.label.contains(only)));
    refuse_nothing(only, places.is_empty())?;
    let pairs = match extent {
        Extent::Quick => 2,
        Extent::Usual => 4,
        Extent::Full => 24,
    };
    let made = &set.made;
    let mut asked = Vec::new();
    for place in &places {
        for with in 0..COEFFICIENTS.len() {
            asked.extend((1..=pairs).map(|pair| Asked {
                place,
                with,
                pair,
                made,
            }));
        }
    }
    let found = run_all(&asked, threads, Asked::name, Asked::run, progress)?;
    let part = |s: &Summary| [s.pitted_area_1, s.pitted_area_2].map(|a| a.unwrap_or(f64::NAN));
    let of_place = |(place, runs): (&Place, &[Summary])| {
        let (without, with) = runs.split_at(pairs as usize);
        Pitted {
            place: place.clone(),
            parts: [without, with].map(|runs| runs.iter().map(part).collect()),
            converged: runs.iter().all(|run| run.converged),
            seconds: runs.iter().map(|run| run.wall_s).sum(),
        }
    };
    let runs = found.chunks_exact(COEFFICIENTS.len() * pairs as usize);
    Ok(places.iter().zip(runs).map(of_place).collect())
}

/// Mean and half-width of the range of a claim's difference, and what it says; `None`: a case was not run.
fn judged(
    (compared, more, less): (Compared, Side, Side),
    all: &[Pitted],
) -> Option<([f64; 2], Verdict)> {
    let of = |side: Side| {
        let one = all.iter().find(|one| one.place.point.label == side.label)?;
        let part = move |with: usize, pair: usize| {
            let part = one.parts[with][pair];
            side.body
                .map_or_else(|| of_interest(&one.place, part), |body| part[body - 1])
        };
        let value = move |pair| match compared {
            Without => part(0, pair),
            With => part(1, pair),
            Taken => part(0, pair) - part(1, pair),
        };
        Some((0..one.parts[0].len()).map(value).collect::<Vec<f64>>())
    };
    let differences: Vec<f64> = (of(more)?.iter().zip(of(less)?))
        .map(|(more, less)| more - less)
        .collect();
    let n = differences.len() as f64;
    let mean = differences.iter().sum::<f64>() / n;
    let squares: f64 = differences.iter().map(|d| (d - mean).powi(2)).sum();
    let half = student(differences.len()) * (squares / (n - 1.0) / n).sqrt();
    let verdict = if mean - half > 0.0 {
        Verdict::Met
    } else if mean + half < 0.0 {
        Verdict::NotMet
    } else {
        Verdict::NotDecided
    };
    Some(([mean, half], verdict))
}

/// A claim in words.
fn says((compared, more, less): (Compared, Side, Side)) -> String {
    let words = |side: Side| match side.body {
        Some(body) => format!("{}, body {body}", side.label),
        None => side.label.to_owned(),
    };
    format!(
        "{}: more at {} than at {}",
        compared.words(),
        words(more),
        words(less)
    )
}

/// The report.
pub fn wear_report(all: &[Pitted]) -> Report {
    type Cell = fn(&Pitted) -> String;
    let columns: [(&'static str, Cell); 6] = [
        ("case", |one| one.place.point.label.clone()),
        ("published, %", |one| one.place.published.join("; ")),
        ("without wear, %", |one| cell(one, 0)),
        ("with wear, %", |one| cell(one, 1)),
        ("each pair, %", |one| {
            let of = |with: usize| {
                let each = one.parts[with].iter();
                let each = each.map(|&part| percent(of_interest(&one.place, part)));
                each.collect::<Vec<_>>().join(" ")
            };
            format!("{}; {}", of(0), of(1))
        }),
        ("seconds", |one| format!("{:.0}", one.seconds)),
    ];
    let table = MarkdownTable::of(all, &columns);
    let claims = CLAIMS.iter().filter_map(|&claim| {
        let ([mean, half], verdict) = judged(claim, all)?;
        let [mean, half] = [mean, half].map(|v| 100.0 * v);
        let (says, verdict) = (says(claim), verdict.name());
        Some(format!(
            "- {says}: {mean:+.1} ± {half:.1} points: {verdict}\n"
        ))
    });
    let claims: String = claims.collect();
    let passes = all.iter().all(|one| one.converged);
    let k = COEFFICIENTS[1];
    let text = format!(
        "{}\nPublished, and found: without wear; with it. Of body 1 and body 2, means over the pairs; each pair: of both bodies, on the \
         tooth of the driver. Assumed: k = {k:e} 1/Pa on both bodies, films below 50 nm wear by a share, calibration at 1e7 cycles \
         of 1.7 GPa, steel of 6.84 GPa, exponential correlation of 15 um, no waves below 64 um, 129 nodes, one passage of .96 mm a \
         block; discs of R = 10 mm at 1.5 GPa.\n\n{claims}",
        table.markdown()
    );
    Report {
        title: "Wear",
        text,
        table,
        plots: Vec::new(),
        passes,
    }
}

/// Both bodies' means.
fn cell(one: &Pitted, with: usize) -> String {
    let body = |body: usize| percent(one.mean(with, |part| part[body]));
    format!("{}, {}", body(0), body(1))
}

/// A part in per cent.
fn percent(part: f64) -> String {
    format!("{:.1}", 100.0 * part)
}

#[cfg(test)]
#[expect(clippy::unwrap_used, reason = "tests")]
mod tests {
    use super::*;

    fn found(label: &str, parts: [Vec<[f64; 2]>; 2]) -> Pitted {
        let set = EvidenceSet::shipped().unwrap();
        let mut places = places(&set).unwrap();
        places.retain(|place| place.point.label == label);
        Pitted {
            place: places.remove(0),
            parts,
            converged: true,
            seconds: 0.0,
        }
    }

    /// Three pairs whose differences are 2, 3 and 4 points: mean 3, s/sqrt 3 = 0.577, t = 2.920.
    #[test]
    fn a_claim_is_judged_by_the_differences_of_the_pairs() {
        let even = |parts: [f64; 3]| parts.map(|part| [0.5 * part, 1.5 * part]).to_vec();
        let worn = even([0.0; 3]);
        let more = found("discs, S .05", [even([0.05, 0.06, 0.08]), worn.clone()]);
        let less = found("discs, S .005", [even([0.03, 0.03, 0.04]), worn]);
        let claim @ (compared, here, there) = CLAIMS[0];
        let ([mean, half], verdict) = judged(claim, &[more.clone(), less.clone()]).unwrap();
        assert!((mean - 0.03).abs() < 1e-12 && (half - 2.920 * 0.01 / 3_f64.sqrt()).abs() < 1e-12);
        assert_eq!(verdict, Verdict::Met);
        // The other way round it holds nowhere; with S .005 alone it is not judged.
        let turned = (compared, there, here);
        let (_, verdict) = judged(turned, &[more.clone(), less.clone()]).unwrap();
        assert_eq!(verdict, Verdict::NotMet);
        assert!(judged(claim, std::slice::from_ref(&less)).is_none());
        // Half and one and a half times as much: of S .05 body 2 has more by what both have on average.
        let bodies = (Taken, of_body(here.label, 2), of_body(here.label, 1));
        let ([mean, _], _) = judged(bodies, &[more]).unwrap();
        assert!((mean - (0.05 + 0.06 + 0.08) / 3.0).abs() < 1e-12);
    }

    #[test]
    fn every_run_is_accepted_and_every_claim_is_of_cases_that_are_there() {
        let set = EvidenceSet::shipped().unwrap();
        let places = places(&set).unwrap();
        let labels: Vec<_> = places.iter().map(|one| &one.point.label[..]).collect();
        for (_, more, less) in CLAIMS {
            assert!(labels.contains(&more.label) && labels.contains(&less.label));
        }
        for place in &places {
            let asked = Asked {
                place,
                with: 1,
                pair: 1,
                made: &set.made,
            };
            let (scene, plan) = asked.planned().unwrap();
            assert_eq!(scene.grid.nodes, 129, "{}", place.point.label);
            assert_eq!(
                scene.wear.unwrap().coefficients_per_pa(),
                [COEFFICIENTS[1]; 2]
            );
            let said = match &place.point.label[..] {
                "discs, lambda .6" => 0.6,
                "discs, lambda 1" => 1.0,
                _ if place.point.x.is_some() => continue,
                _ => 0.25,
            };
            let lambda = plan.film.unwrap().lambda_ratio.unwrap();
            assert!(
                (lambda / said - 1.0).abs() < 0.05,
                "{}: {lambda}",
                place.point.label
            );
        }
    }
}
