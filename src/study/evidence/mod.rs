//! Published tables and experiments beside what the program finds.
//!
//! Computations are solved on two grids and extrapolated with the order q of the scheme, h* = h + (h − h₂)/(2^q − 1); experiments
//! are compared by rank, ratio, depth and place, by every way of counting cycles that the program has. What is compared
//! stands in `assets/studies/evidence.toml`, each case a scene in `src/engine/assets/evidence`. A disagreement is printed with its
//! most likely cause.

mod dent;
mod fit;
mod kept;
mod measure;
mod plot;
mod random;
mod report;
mod set;
mod tried;

use kept::Kept;
pub use kept::kept_in;
use measure::SHRINKING;
pub use plot::{agreement_plot, experiments_plot};
pub use random::{AssumedRoughness, MadeRatio, MadeVariant, MadeWay, TriedPairs, Verdict, student};
pub use report::{evidence_table, evidence_text};
pub use set::{
    Comparison, EvidenceCase, EvidenceClaim, EvidenceNumber, EvidencePoint, EvidenceSet,
    Experiment, Forecast, Grade, Measure, planned,
};
pub use tried::{Judged, Tried, TriedDamage};

use std::collections::BTreeSet;
use std::path::Path;
use std::time::Instant;

use serde::{Deserialize, Serialize};

use super::{Extent, StudyError, StudyProgress, refuse_nothing};
use asperity_engine::scene::CycleBasis;
use asperity_session::run::share_out;

/// A number of a case.
#[derive(Debug, Clone, PartialEq)]
pub struct EvidenceRow {
    /// Case.
    pub case: String,
    /// Grade.
    pub grade: Grade,
    /// Source.
    pub source: String,
    /// What it is.
    pub what: String,
    /// Scene, with the keys set on top, as words of a command line.
    pub scene: String,
    /// The source's number.
    pub theirs: f64,
    /// Half of the range that the source gives.
    pub spread: f64,
    /// Nodes of both grids.
    pub nodes: [usize; 2],
    /// What is found on them.
    pub found: [f64; 2],
    /// What both tend to.
    pub limit: f64,
    /// limit/theirs − 1, from the nearer end of the source's range.
    pub deviation: f64,
    /// Deviation that counts as agreement.
    pub tolerance: f64,
    /// Most likely cause of a disagreement.
    pub cause: Option<String>,
    /// Why there is no number.
    pub failed: Option<String>,
}

impl EvidenceRow {
    /// Whether both agree.
    pub fn agrees(&self) -> bool {
        self.deviation.abs() <= self.tolerance
    }
}

/// The study's result.
#[derive(Debug, Clone, PartialEq)]
pub struct Evidence {
    /// Computations.
    pub rows: Vec<EvidenceRow>,
    /// Experiments.
    pub experiments: Vec<Tried>,
    /// Nodes of the experiments' grid.
    pub nodes: usize,
    /// What is assumed of made surfaces.
    pub made: AssumedRoughness,
    /// Time taken, s.
    pub seconds: f64,
}

impl Evidence {
    /// Whether every number was found, and every disagreement of a computation has a cause.
    pub fn passes(&self) -> bool {
        let named = |row: &EvidenceRow| row.agrees() || row.cause.is_some();
        let rows = self.rows.iter();
        let found = |tried: &Tried| {
            let pairs = tried.pairs.damages.iter().flatten().flatten();
            tried
                .damages
                .iter()
                .flatten()
                .chain(pairs)
                .all(Result::is_ok)
        };
        rows.clone().all(|row| row.failed.is_none() && named(row))
            && self.experiments.iter().all(found)
    }
}

/// What one worker does.
enum EvidenceJob<'a> {
    Case(&'a EvidenceCase, usize, usize),
    Point(&'a Experiment, &'a EvidencePoint, CycleBasis, usize),
    Pair(
        &'a Experiment,
        &'a EvidencePoint,
        &'a AssumedRoughness,
        MadeWay,
        u64,
    ),
}

/// What came of it.
#[derive(Debug, Clone, Serialize, Deserialize)]
enum EvidenceResult {
    Case(Result<Found, String>),
    Point(Result<TriedDamage, String>),
}

/// Numbers that were found, by name.
type Found = Vec<(String, f64)>;

impl EvidenceJob<'_> {
    fn name(&self) -> String {
        match self {
            Self::Case(case, nodes, _) => format!("{}, {nodes} nodes", case.name),
            Self::Point(experiment, point, basis, nodes) => {
                let [name, label] = [&experiment.name, &point.label];
                format!("{name}, {label}, {}, {nodes} nodes", basis.key())
            }
            Self::Pair(experiment, point, made, way, pair) => {
                let [name, label] = [&experiment.name, &point.label];
                let more = way.variant.map_or("", |at| &made.variant[at].name[..]);
                let (basis, shortest_um) = (way.basis.key(), 1e6 * way.cutoff_short_m);
                format!("{name}, {label}, {basis} {more}, from {shortest_um} um, pair {pair}")
            }
        }
    }

    fn work(&self) -> EvidenceResult {
        match *self {
            Self::Case(case, nodes, finest) => {
                let found = measure::measure(case, nodes, finest);
                let named = |(name, value): (&str, f64)| (name.to_owned(), value);
                EvidenceResult::Case(found.map(|found| found.into_iter().map(named).collect()))
            }
            Self::Point(_, point, basis, nodes) => {
                EvidenceResult::Point(tried::damage(point, basis, nodes))
            }
            Self::Pair(_, point, assumed, way, pair) => {
                EvidenceResult::Point(random::made_damage(assumed, point, way, pair))
            }
        }
    }
}

/// Nodes of the experiments' grid: 14 and more on a wave, in the full form 29.
fn nodes_of_experiments(extent: Extent) -> usize {
    match extent {
        Extent::Quick | Extent::Usual => 257,
        Extent::Full => 513,
    }
}

/// Computes the set, `workers` runs at a time, each on one thread. `only`: what has that in its name or source. `folder`: where
/// each result is kept as it comes ([`kept_in`]), and those of a run that was stopped are taken from.
///
/// # Errors
/// [`StudyError`] when the data of the study are wrong, nothing is called that, or the folder can't be written.
pub fn evidence(
    extent: Extent,
    only: Option<&str>,
    workers: usize,
    folder: Option<&Path>,
    progress: &mut StudyProgress,
) -> Result<Evidence, StudyError> {
    let clock = Instant::now();
    let set = EvidenceSet::shipped().map_err(StudyError::Scene)?;
    let wanted = |names: [&str; 3]| only.is_none_or(|part| names.iter().any(|n| n.contains(part)));
    let mut cases: Vec<(&EvidenceCase, [usize; 2])> = Vec::new();
    for case in &set.cases {
        let nodes = case.nodes(extent);
        if let Some(nodes) = nodes.filter(|_| wanted([&case.name, &case.source, &case.scene])) {
            cases.push((case, nodes));
        }
    }
    let is_in = |e: &&Experiment| {
        let asked = only.is_some() || e.quick || extent != Extent::Quick;
        let mut scenes = e.point.iter().map(|point| point.scene.as_str());
        asked && wanted([&e.name, &e.source, scenes.next().unwrap_or_default()])
    };
    let experiments: Vec<&Experiment> = set.experiments.iter().filter(is_in).collect();
    refuse_nothing(only, cases.is_empty() && experiments.is_empty())?;
    let nodes = nodes_of_experiments(extent);
    let mut jobs: Vec<EvidenceJob> = Vec::new();
    for (case, [coarse, fine]) in &cases {
        jobs.extend([*coarse, *fine].map(|nodes| EvidenceJob::Case(case, nodes, *fine)));
    }
    let made = &set.made;
    let (ways, n_pairs) = match extent {
        Extent::Quick => (Vec::new(), 0),
        Extent::Usual | Extent::Full => (made.ways(), made.pairs),
    };
    for &experiment in &experiments {
        for point in &experiment.point {
            let all = CycleBasis::ALL.into_iter();
            jobs.extend(all.map(|basis| EvidenceJob::Point(experiment, point, basis, nodes)));
            for way in ways.iter().filter(|way| made.tries(point, **way)) {
                let pairs = 1..=n_pairs;
                let job = |pair| EvidenceJob::Pair(experiment, point, made, *way, pair);
                jobs.extend(pairs.map(job));
            }
        }
    }
    let done = done(&jobs, workers, folder, progress)?;
    let (mut values, mut damages) = (Vec::new(), Vec::new());
    for done in done {
        match done {
            EvidenceResult::Case(found) => values.push(found),
            EvidenceResult::Point(found) => damages.push(found),
        }
    }
    let pairs = cases.iter().zip(values.chunks_exact(2));
    let rows = pairs.flat_map(|((case, nodes), found)| rows(case, *nodes, found));
    let mut damages = damages.into_iter();
    let tried = experiments.iter().map(|&experiment| {
        let (mut by_waves, mut by_pairs) = (Vec::new(), Vec::new());
        for point in &experiment.point {
            let mut next = |n: usize| damages.by_ref().take(n).collect::<Vec<_>>();
            by_waves.push(next(CycleBasis::ALL.len()));
            let pairs = |way: &MadeWay| usize::from(made.tries(point, *way)) * n_pairs as usize;
            let pairs = ways.iter().map(|way| next(pairs(way)));
            by_pairs.push(pairs.collect());
        }
        let pairs = TriedPairs::new(experiment, ways.len(), by_pairs);
        Tried::new(experiment, by_waves, pairs)
    });
    Ok(Evidence {
        rows: rows.collect(),
        experiments: tried.collect(),
        nodes,
        made: made.clone(),
        seconds: clock.elapsed().as_secs_f64(),
    })
}

/// What comes of all jobs, by this run or by one before.
fn done(
    jobs: &[EvidenceJob],
    workers: usize,
    folder: Option<&Path>,
    progress: &mut StudyProgress,
) -> Result<Vec<EvidenceResult>, StudyError> {
    let names: BTreeSet<String> = jobs.iter().map(EvidenceJob::name).collect();
    if names.len() < jobs.len() {
        let words = "two of its jobs are called alike: one would be told what the other found";
        return Err(StudyError::Scene(words.to_owned()));
    }
    let kept = Kept::open(folder).map_err(|error| StudyError::Kept(error.to_string()))?;
    let work = |job: &EvidenceJob| {
        let name = job.name();
        kept.known(&name).unwrap_or_else(|| {
            let found = job.work();
            kept.keep(&name, &found);
            found
        })
    };
    Ok(share_out(jobs, workers, work, &mut |job, n_begun| {
        progress(&job.name(), n_begun, jobs.len());
    }))
}

/// The rows of a case from what its two grids gave.
fn rows(
    case: &EvidenceCase,
    nodes: [usize; 2],
    found: &[Result<Found, String>],
) -> Vec<EvidenceRow> {
    let failed = found.iter().find_map(|found| found.as_ref().err().cloned());
    let of = |grid: usize, name: &str| {
        let values = found[grid].as_ref().ok();
        let value = values.and_then(|values| values.iter().find(|(known, _)| *known == name));
        value.map_or(f64::NAN, |(_, value)| *value)
    };
    let mut scene = format!("evidence/{}", case.scene);
    for set in &case.set {
        scene.push_str(" --set ");
        scene.push_str(set);
    }
    let row = |row: &EvidenceNumber| {
        let found = [0, 1].map(|grid| of(grid, &row.value));
        let limit = found[1] + (found[1] - found[0]) / of(1, SHRINKING);
        let theirs = match &row.closed {
            Some(name) => of(1, name),
            None => row.theirs.unwrap_or(f64::NAN),
        };
        let nearest = limit.max(theirs - row.spread).min(theirs + row.spread);
        EvidenceRow {
            case: case.name.clone(),
            grade: row.grade.unwrap_or(case.grade),
            source: row.source.as_ref().unwrap_or(&case.source).clone(),
            what: row.what.clone(),
            scene: scene.clone(),
            theirs,
            spread: row.spread,
            nodes,
            found,
            limit,
            deviation: (limit - nearest) / theirs,
            tolerance: row.tolerance,
            cause: row.cause.clone(),
            failed: failed.clone(),
        }
    };
    case.row.iter().map(row).collect()
}
