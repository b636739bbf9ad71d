//! What leaving out gains: every stage that a plan leaves out, forced in.
//!
//! For each preset the run is made as planned, and again with each left-out stage forced in ([`Forced`]). What the
//! scene does not need must change nothing beyond a stated bound, and what it saves is told as a ratio of times and
//! of work in one run of the study.

mod force;
mod measure;

use std::fmt::Write as _;

pub use force::Forced;
pub use measure::{Difference, Gain, PruningRow};

use super::table::{Table, figure};
use super::{Extent, Progress, StudyError, refuse_nothing};
use crate::plan::Plan;
use crate::scene::{Override, Scene, presets};

/// Presets and variants of them: name, preset, settings.
type Variant = (String, &'static str, Vec<String>);

/// Tolerance of the study's steps. At the usual one (1e-3) the iteration hides the stages: in an all but dry line what
/// each step leaves adds up to 4 % of the life in FZG's point B (3.5, 1.4 and 0 % at 1e-4, 1e-5 and 1e-6), and two runs
/// that differ by rounding differ by as much.
const TOLERANCE: f64 = 1e-6;

/// Scenes in which stages are left out that no preset leaves out.
const VARIANTS: [(&str, &str, &[&str]); 4] = [
    (
        "demonstration, dry, smooth",
        "demonstration",
        &[
            "lubricant=none",
            "stress=none",
            "life=none",
            "body_1.surface.kind=smooth",
            "body_2.surface.kind=smooth",
        ],
    ),
    (
        "demonstration, Newtonian",
        "demonstration",
        &["lubricant.rheology=newtonian", "motion.slide_roll=0.02"],
    ),
    (
        "demonstration, smooth",
        "demonstration",
        &["body_1.surface.kind=smooth", "body_2.surface.kind=smooth"],
    ),
    (
        "demonstration, longitudinal",
        "demonstration",
        &[
            "body_1.surface.kind=smooth",
            "body_2.surface.wavelength_x_m=inf",
        ],
    ),
];

fn variants(extent: Extent, only: Option<&str>) -> Vec<Variant> {
    let common = |nodes: Option<usize>, passages: f64| {
        let mut sets = vec![
            format!("time.passages={passages}"),
            "numerics.error_estimate=none".to_owned(),
            "record.every_steps=16".to_owned(),
            // So that a difference is the stage's and not the iteration's.
            format!("numerics.tolerance={TOLERANCE:e}"),
            "numerics.max_iterations=60".to_owned(),
        ];
        sets.extend(nodes.map(|nodes| format!("grid.nodes={nodes}")));
        sets
    };
    let sets = match extent {
        Extent::Quick => common(Some(65), 0.1),
        Extent::Usual => common(None, 0.1),
        Extent::Full => common(None, 1.0),
    };
    let mut all: Vec<Variant> = presets::all()
        .iter()
        .filter(|preset| extent != Extent::Quick || preset.name == presets::DEFAULT)
        .map(|preset| (preset.name.to_owned(), preset.name, sets.clone()))
        .collect();
    all.extend(VARIANTS.iter().map(|(name, preset, more)| {
        let mut sets = sets.clone();
        sets.extend(more.iter().map(|&text| text.to_owned()));
        ((*name).to_owned(), *preset, sets)
    }));
    all.retain(|(name, ..)| only.is_none_or(|part| name.contains(part)));
    all
}

/// Forces in, preset by preset, what each leaves out.
///
/// # Errors
/// [`StudyError`] when a run fails.
pub fn pruning(
    extent: Extent,
    only: Option<&str>,
    threads: usize,
    progress: &mut Progress,
) -> Result<Vec<PruningRow>, StudyError> {
    let variants = variants(extent, only);
    refuse_nothing(only, variants.is_empty())?;
    let mut rows = Vec::new();
    for (n, (name, preset, sets)) in variants.iter().enumerate() {
        let failed = |reason: String| StudyError::Run {
            case: name.clone(),
            reason,
        };
        let (scene, plan) = prepared(preset, sets).map_err(StudyError::Scene)?;
        progress(name, n, variants.len());
        let base = measure::plain(&scene, &plan, threads).map_err(failed)?;
        for stage in Forced::ALL {
            if stage == Forced::DeepWaves && scene.kind() == crate::scene::ContactKind::Line {
                continue;
            }
            progress(&format!("{name}: {}", stage.name()), n, variants.len());
            rows.extend(measure::forced(name, stage, (&scene, &plan), &base));
        }
    }
    Ok(rows)
}

fn prepared(preset: &str, sets: &[String]) -> Result<(Scene, Plan), String> {
    let overrides = sets
        .iter()
        .map(|text| text.parse::<Override>())
        .collect::<Result<Vec<_>, _>>()
        .map_err(|error| error.to_string())?;
    let scene = Scene::load_with(preset, &overrides).map_err(|error| error.to_string())?;
    let plan = Plan::new(&scene).map_err(|error| error.to_string())?;
    Ok((scene, plan))
}

/// The rows as a table.
pub fn pruning_table(rows: &[PruningRow]) -> Table {
    let mut table = Table::new(&[
        "scene",
        "stage forced in",
        "pressure",
        "film",
        "ln stress factor",
        "allowed",
        "why",
        "time, with/without",
        "Krylov, with/without",
        "transforms, with/without",
    ]);
    for row in rows {
        let (allowed, why) = row.stage.allowed();
        let gain = row.found.as_ref().ok();
        let cell = |value: &dyn Fn(&measure::Gain) -> Option<f64>| figure(gain.and_then(value));
        table.rows.push(vec![
            row.preset.clone(),
            row.stage.name().to_owned(),
            cell(&|gain| Some(gain.difference.pressure)),
            cell(&|gain| Some(gain.difference.film)),
            cell(&|gain| gain.difference.life),
            figure(Some(allowed)),
            match &row.found {
                Ok(_) => why.to_owned(),
                Err(reason) => format!("the run with it ended: {reason}"),
            },
            cell(&|gain| Some(gain.time_ratio)),
            cell(&|gain| Some(gain.work_ratio)),
            cell(&|gain| Some(gain.transform_ratio)),
        ]);
    }
    table
}

/// The whole report as Markdown: the table, and each stage over all scenes.
pub fn pruning_text(rows: &[PruningRow]) -> String {
    let mut text = format!(
        "Relative differences of the last step's fields and of life's stress factor, with the stage against without; times and work of \
         the whole run, start-up included. Steps are solved to {TOLERANCE:e} of the pressure: at the usual 1e-3 two runs that differ \
         by rounding alone differ by up to 3 % of the life where films all but close.\n\n",
    );
    text.push_str(&pruning_table(rows).markdown());
    text.push_str(
        "\n| stage | scenes | greatest difference | allowed | time, with/without |\n|---|---|---|---|---|\n",
    );
    for stage in Forced::ALL {
        let of_stage: Vec<&Gain> = rows
            .iter()
            .filter(|row| row.stage == stage)
            .filter_map(|row| row.found.as_ref().ok())
            .collect();
        if of_stage.is_empty() {
            continue;
        }
        let greatest = of_stage
            .iter()
            .map(|gain| gain.difference.greatest())
            .fold(0.0, f64::max);
        let ratios = || of_stage.iter().map(|gain| gain.time_ratio);
        let _ = writeln!(
            text,
            "| {} | {} | {} | {} | {} to {} |",
            stage.name(),
            of_stage.len(),
            figure(Some(greatest)),
            figure(Some(stage.allowed().0)),
            figure(Some(ratios().fold(f64::INFINITY, f64::min))),
            figure(Some(ratios().fold(0.0, f64::max))),
        );
    }
    text
}
