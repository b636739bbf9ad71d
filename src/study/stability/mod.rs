//! Stiff and extreme cases: every one ends converged or by name.
//!
//! The cases are data ([`CaseSet::shipped`]). Each is run from Hertz through its start-up and its passage on one
//! thread under a work limit; every step and every field is judged ([`TrialEnd`]). A long run of the default scene shows whether
//! anything creeps ([`Drift`]).

mod case;
mod drift;
mod trial;

use std::fmt::Write as _;

pub use case::{Case, CaseSet, Texture};
pub use drift::Drift;
pub use trial::{Trial, TrialEnd};

use super::table::{MarkdownTable, figure};
use super::{Extent, Report, StudyError, StudyProgress, refuse_nothing};
use asperity_session::run::share_out;

/// A case and how it went.
#[derive(Debug, Clone, PartialEq)]
pub struct StabilityRow {
    /// Name.
    pub name: String,
    /// What it is extreme in.
    pub group: String,
    /// How it went.
    pub trial: Trial,
}

/// The study's result.
#[derive(Debug, Clone, PartialEq)]
pub struct Stability {
    /// Nodes per side.
    pub nodes: usize,
    /// The cases.
    pub rows: Vec<StabilityRow>,
    /// The long run.
    pub drift: Drift,
}

/// What asks for the long run alone.
const LONG_RUN: &str = "long run";

/// Least share of the cases that must converge.
pub const MUST_CONVERGE: f64 = 0.95;

impl Stability {
    /// Cases that converged.
    pub fn converged(&self) -> usize {
        let rows = self.rows.iter();
        rows.filter(|row| row.trial.ending.is_converged()).count()
    }

    /// Cases that neither converged nor failed by name.
    pub fn quiet(&self) -> usize {
        let rows = self.rows.iter();
        rows.filter(|row| !row.trial.ending.is_converged_or_named())
            .count()
    }

    /// Whether the set is as it must be.
    pub fn passes(&self) -> bool {
        self.quiet() == 0
            && self.converged() as f64 >= MUST_CONVERGE * self.rows.len() as f64
            && self.drift.is_steady()
    }
}

/// Runs the set, `workers` cases at a time. Quick: a part of it on 33²; usual: all on 65²; full: all on 129², and
/// 10 000 steps on 65² in place of 2 000 on 33². `only`: the cases that it is part of; "long run" that alone. `keys`: set in all of them and in
/// the long run, before a case's own.
///
/// # Errors
/// [`StudyError`] when the data of the study are wrong.
pub fn stability(
    extent: Extent,
    only: Option<&str>,
    keys: &[String],
    workers: usize,
    progress: &mut StudyProgress,
) -> Result<Stability, StudyError> {
    let mut set = CaseSet::shipped().map_err(StudyError::Scene)?;
    set.set.extend_from_slice(keys);
    let (nodes, drift_nodes, drift_steps) = match extent {
        Extent::Quick => (33, 33, 600),
        Extent::Usual => (65, 33, 2_000),
        Extent::Full => (129, 65, 10_000),
    };
    let wanted = |case: &&Case| match only {
        Some(part) => case.name.contains(part) || case.group.contains(part),
        None => extent != Extent::Quick || case.quick,
    };
    let cases: Vec<Case> = set.cases.iter().filter(wanted).cloned().collect();
    refuse_nothing(only, cases.is_empty() && only != Some(LONG_RUN))?;
    let rows = share_out(
        &cases,
        workers,
        |case| run_case(&set, case, nodes),
        &mut |case, n_begun| progress(&case.name, n_begun, cases.len()),
    );
    let all = cases.len() + 1;
    let steps = match only {
        Some(part) if part != LONG_RUN => 0,
        _ => drift_steps,
    };
    let drift = drift::long_run(drift_nodes, steps, keys, &mut |done| {
        progress(&format!("long run, step {done} of {steps}"), all - 1, all);
    })
    .map_err(StudyError::Scene)?;
    Ok(Stability { nodes, rows, drift })
}

fn run_case(set: &CaseSet, case: &Case, nodes: usize) -> StabilityRow {
    StabilityRow {
        name: case.name.clone(),
        group: case.group.clone(),
        trial: match set.ready(case, nodes) {
            Ok(ready) => trial::run(&ready),
            Err(reason) => Trial::refused(reason),
        },
    }
}

/// A column: its name and what a row has in it.
type Column = (&'static str, fn(&StabilityRow) -> String);

/// The cases, then the long run.
pub fn stability_report(result: &Stability) -> Report {
    let columns: [Column; 18] = [
        ("group", |row| row.group.clone()),
        ("case", |row| row.name.clone()),
        ("ending", |row| row.trial.ending.text()),
        ("steps", |row| row.trial.steps.to_string()),
        ("residual", |row| figure(Some(row.trial.residual))),
        ("load error", |row| figure(Some(row.trial.load_error))),
        ("mass error", |row| figure(Some(row.trial.mass_error))),
        ("p min/p_h", |row| figure(Some(row.trial.p_min))),
        ("p max/p_h", |row| figure(Some(row.trial.p_max))),
        ("h min, nm", |row| figure(Some(row.trial.h_min_nm))),
        ("h_c/formula", |row| figure(row.trial.film_ratio)),
        ("not finite", |row| row.trial.not_finite.to_string()),
        ("Newton", |row| {
            row.trial.stats.newton_iterations.to_string()
        }),
        ("Krylov", |row| {
            row.trial.stats.linear_iterations.to_string()
        }),
        ("retries", |row| row.trial.stats.retries.to_string()),
        ("halved", |row| row.trial.stats.halved.to_string()),
        ("safe", |row| row.trial.stats.safer.to_string()),
        ("s", |row| figure(Some(row.trial.seconds))),
    ];
    let table = MarkdownTable::of(&result.rows, &columns);
    let mut text = String::new();
    let all = result.rows.len();
    if all > 0 {
        text = format!(
            "{}\n{} of {all} cases converged on {n}² ({:.0} %), {} failed by name, {} quietly.\n",
            table.markdown(),
            result.converged(),
            100.0 * result.converged() as f64 / all as f64,
            all - result.converged() - result.quiet(),
            result.quiet(),
            n = result.nodes,
        );
    }
    if result.drift.steps > 0 {
        let _ = writeln!(text, "\nLong run: {}.", result.drift.text());
    }
    Report {
        title: "Stability",
        text,
        table,
        plots: Vec::new(),
        passes: result.passes(),
    }
}
