//! What leaving out gains: every stage that a plan leaves out, forced in.
//!
//! For each preset the run is made as planned, and again with each left-out stage forced in ([`Forced`]). What the
//! scene does not need must change nothing beyond a stated bound, and what it saves is told as a ratio of times and
//! of work in one run.
//!
//! `cargo test --release --test study pruning::report -- --ignored` does so for every preset and writes
//! `assets/reports/pruning.md`.
#![expect(clippy::unwrap_used, reason = "tests")]

mod force;
mod measure;

use std::fmt::Write as _;

use asperity_engine::plan::Plan;
use asperity_engine::scene::{ContactKind, Override, Scene, presets};
use asperity_study::{MarkdownTable, figure, machine};
use force::Forced;
use measure::{Gain, PruningRow, Timing};

/// Presets and variants of them: name, preset, settings.
type Variant = (String, &'static str, Vec<String>);

/// Tolerance of the study's steps. At the usual one (1e-3) the iteration hides the stages: in an all but dry line what
/// each step leaves adds up to 4 % of the life in FZG's point B (3.5, 1.4 and 0 % at 1e-4, 1e-5 and 1e-6), and two runs
/// that differ by rounding differ by as much.
const TOLERANCE: f64 = 1e-6;
/// Threads of the runs whose times are reported.
const THREADS: usize = 2;

/// Scenes in which stages are left out that no preset leaves out.
const VARIANTS: [(&str, &str, &[&str]); 4] = [
    (
        "demonstration, dry, smooth",
        "demonstration_quick",
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
        "demonstration_quick",
        &["lubricant.rheology=newtonian", "motion.slide_roll=0.02"],
    ),
    (
        "demonstration, smooth",
        "demonstration_quick",
        &["body_1.surface.kind=smooth", "body_2.surface.kind=smooth"],
    ),
    (
        "demonstration, longitudinal",
        "demonstration_quick",
        &[
            "body_1.surface.kind=smooth",
            "body_2.surface.wavelength_x_m=inf",
        ],
    ),
];

/// The presets' own grids; or the default scene and the variants on a small one.
fn variants(is_whole: bool) -> Vec<Variant> {
    let mut sets = vec![
        "time.passages=0.1".to_owned(),
        "numerics.error_estimate=none".to_owned(),
        "record.every_steps=16".to_owned(),
        // So that a difference is the stage's and not the iteration's.
        format!("numerics.tolerance={TOLERANCE:e}"),
        "numerics.max_iterations=60".to_owned(),
    ];
    if !is_whole {
        sets.push("grid.nodes=65".to_owned());
    }
    let mut all: Vec<Variant> = presets::all()
        .iter()
        .filter(|preset| is_whole || preset.name == presets::QUICK)
        .map(|preset| (preset.name.to_owned(), preset.name, sets.clone()))
        .collect();
    all.extend(VARIANTS.iter().map(|(name, preset, more)| {
        let mut sets = sets.clone();
        sets.extend(more.iter().map(|&text| text.to_owned()));
        ((*name).to_owned(), *preset, sets)
    }));
    all
}

/// Forces in, variant by variant, what each leaves out.
fn pruning(is_whole: bool) -> Vec<PruningRow> {
    let mut rows = Vec::new();
    let timing = Timing {
        threads: if is_whole { THREADS } else { 1 },
        is_timed: is_whole,
    };
    for (name, preset, sets) in variants(is_whole) {
        let overrides: Vec<Override> = sets.iter().map(|text| text.parse().unwrap()).collect();
        let scene = Scene::load_with(preset, &overrides).unwrap();
        let plan = Plan::new(&scene).unwrap();
        let base = measure::plain(&scene, &plan, timing).unwrap();
        for stage in Forced::ALL {
            if stage == Forced::DeepWaves && scene.kind() == ContactKind::Line {
                continue;
            }
            rows.extend(measure::forced(&name, stage, (&scene, &plan), &base));
        }
    }
    rows
}

/// The rows as a table.
fn pruning_table(rows: &[PruningRow]) -> MarkdownTable {
    let mut table = MarkdownTable::new(&[
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
fn pruning_text(rows: &[PruningRow]) -> String {
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

#[test]
fn what_a_scene_does_not_need_changes_nothing() {
    let rows = pruning(false);
    println!("{}", pruning_text(&rows));
    for row in &rows {
        let (allowed, why) = row.stage.allowed();
        assert!(
            row.is_harmless(),
            "{}, {}: {:?} > {allowed} ({why})",
            row.preset,
            row.stage.name(),
            row.found
        );
    }
    // Every stage is left out by one of these scenes.
    for stage in Forced::ALL {
        assert!(
            rows.iter().any(|row| row.stage == stage),
            "{} is never left out",
            stage.name()
        );
    }
}

#[test]
#[ignore = "minutes: writes a report"]
fn report() {
    let rows = pruning(true);
    let text = format!(
        "`cargo test --release --test study pruning::report -- --ignored`\n\n# Pruning\n\n\
         {}, on {}, {THREADS} threads.\n\n{}",
        asperity_session::program::PROGRAM,
        machine(),
        pruning_text(&rows),
    );
    let folder = concat!(env!("CARGO_MANIFEST_DIR"), "/../../assets/reports");
    std::fs::write(format!("{folder}/pruning.md"), text).unwrap();
    std::fs::write(format!("{folder}/pruning.csv"), pruning_table(&rows).csv()).unwrap();
    assert!(rows.iter().all(PruningRow::is_harmless));
}
