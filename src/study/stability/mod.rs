//! Stiff and extreme cases: every one ends converged or by name.
//!
//! The cases are data ([`CaseSet::shipped`]). Each is run from Hertz through its start-up and its passage on one
//! thread under a work limit; every step and every field is judged ([`TrialEnd`]). A case that does not converge
//! is searched back towards its usual setting until it does. A long run of the default scene shows whether
//! anything creeps ([`Drift`]).

mod case;
mod drift;
mod remedy;
mod trial;

use std::fmt::Write as _;

pub use case::{Case, CaseSet, Texture};
pub use drift::Drift;
pub use trial::{Trial, TrialEnd};

use super::table::{MarkdownTable, figure};
use super::{Extent, StudyError, StudyProgress, refuse_nothing};
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
    /// The nearest setting that works, where it did not converge and one was found.
    pub remedy: Option<String>,
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
/// 10 000 steps on 65² in place of 2 000 on 33². `only`: the cases that it is part of; "long run" that alone.
///
/// # Errors
/// [`StudyError`] when the data of the study are wrong.
pub fn stability(
    extent: Extent,
    only: Option<&str>,
    workers: usize,
    progress: &mut StudyProgress,
) -> Result<Stability, StudyError> {
    let set = CaseSet::shipped().map_err(StudyError::Scene)?;
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
    let drift = drift::long_run(drift_nodes, steps, &mut |done| {
        progress(&format!("long run, step {done} of {steps}"), all - 1, all);
    })
    .map_err(StudyError::Scene)?;
    Ok(Stability { nodes, rows, drift })
}

fn run_case(set: &CaseSet, case: &Case, nodes: usize) -> StabilityRow {
    let trial = match set.ready(case, nodes, 1.0) {
        Ok(ready) => trial::run(&ready),
        Err(reason) => Trial::refused(reason),
    };
    let remedy = if trial.ending.is_converged() {
        None
    } else {
        remedy::search(set, case, nodes)
    };
    StabilityRow {
        name: case.name.clone(),
        group: case.group.clone(),
        trial,
        remedy,
    }
}

/// The table.
pub fn stability_table(result: &Stability) -> MarkdownTable {
    let mut table = MarkdownTable::new(&[
        "group",
        "case",
        "ending",
        "steps",
        "residual",
        "load error",
        "mass error",
        "p min/p_h",
        "p max/p_h",
        "h min, nm",
        "h_c/formula",
        "not finite",
        "Newton",
        "Krylov",
        "retries",
        "halved",
        "safe",
        "s",
    ]);
    for row in &result.rows {
        let trial = &row.trial;
        let stats = &trial.stats;
        let ending = match &row.remedy {
            None => trial.ending.text(),
            Some(remedy) => format!("{}; {remedy}", trial.ending.text()),
        };
        table.rows.push(vec![
            row.group.clone(),
            row.name.clone(),
            ending,
            trial.steps.to_string(),
            figure(Some(trial.residual)),
            figure(Some(trial.load_error)),
            figure(Some(trial.mass_error)),
            figure(Some(trial.p_min)),
            figure(Some(trial.p_max)),
            figure(Some(trial.h_min_nm)),
            figure(trial.film_ratio),
            trial.not_finite.to_string(),
            stats.newton_iterations.to_string(),
            stats.linear_iterations.to_string(),
            stats.retries.to_string(),
            stats.halved.to_string(),
            stats.safer.to_string(),
            figure(Some(trial.seconds)),
        ]);
    }
    table
}

/// The whole report as Markdown.
pub fn stability_text(result: &Stability) -> String {
    let mut text = String::new();
    let all = result.rows.len();
    if all > 0 {
        text.push_str(&stability_table(result).markdown());
        let _ = writeln!(
            text,
            "\n{} of {all} cases converged on {n}² ({:.0} %), {} failed by name, {} quietly.",
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
    text
}
