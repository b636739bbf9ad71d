//! What leaving out changes: every stage that a plan leaves out, forced in.
//!
//! Each scene is run as planned, and again with each left-out stage forced in ([`Forced`]). What a scene does not need must
//! change nothing beyond a stated bound.
#![expect(clippy::unwrap_used, reason = "tests")]

mod force;
mod measure;

use asperity_engine::plan::Plan;
use asperity_engine::scene::{ContactKind, Override, Scene, presets};
use asperity_study::{MarkdownTable, figure};
use force::Forced;
use measure::PruningRow;

/// Where a steady life is compared with that of time steps: on 33 nodes they are 7e-3 apart.
const STEADY: &str = "grid.nodes=65";

/// The quick demonstration, and with settings that leave other stages out.
const VARIANTS: [(&str, &[&str]); 5] = [
    ("demonstration", &[]),
    (
        "demonstration, dry, smooth",
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
        &["lubricant.rheology=newtonian", "motion.slide_roll=0.02"],
    ),
    (
        "demonstration, smooth",
        &[
            STEADY,
            "body_1.surface.kind=smooth",
            "body_2.surface.kind=smooth",
        ],
    ),
    (
        "demonstration, longitudinal",
        &[
            STEADY,
            "body_1.surface.kind=smooth",
            "body_2.surface.wavelength_x_m=inf",
        ],
    ),
];

/// Forces in, variant by variant, what each leaves out.
fn pruning() -> Vec<PruningRow> {
    let common = [
        "grid.nodes=33",
        "time.passages=0.2",
        "stress.depths=16",
        // What so few nodes carry as 65 carry the scene's own.
        "body_1.surface.wavelength_x_m=4e-4",
        "body_2.surface.wavelength_x_m=4e-4",
        "body_2.surface.wavelength_y_m=4e-4",
        "numerics.error_estimate=none",
        "record.every_steps=16",
        // So that a difference is the stage's and not the iteration's.
        "numerics.tolerance=1e-6",
        "numerics.max_iterations=60",
    ];
    let mut rows = Vec::new();
    for (name, more) in VARIANTS {
        let sets = common.iter().chain(more).map(|text| text.parse().unwrap());
        let overrides: Vec<Override> = sets.collect();
        let scene = Scene::load_with(presets::QUICK, &overrides).unwrap();
        let plan = Plan::new(&scene).unwrap();
        let base = measure::plain(&scene, &plan).unwrap();
        for stage in Forced::ALL {
            if stage == Forced::DeepWaves && scene.kind() == ContactKind::Line {
                continue;
            }
            rows.extend(measure::forced(name, stage, (&scene, &plan), &base));
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
    ]);
    for row in rows {
        let (allowed, why) = row.stage.allowed();
        let found = row.found.as_ref().ok();
        let cell =
            |value: &dyn Fn(&measure::Difference) -> Option<f64>| figure(found.and_then(value));
        table.rows.push(vec![
            row.preset.clone(),
            row.stage.name().to_owned(),
            cell(&|found| Some(found.pressure)),
            cell(&|found| Some(found.film)),
            cell(&|found| found.life),
            figure(Some(allowed)),
            match &row.found {
                Ok(_) => why.to_owned(),
                Err(reason) => format!("the run with it ended: {reason}"),
            },
        ]);
    }
    table
}

#[test]
fn what_a_scene_does_not_need_changes_nothing() {
    let rows = pruning();
    println!("{}", pruning_table(&rows).markdown());
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
