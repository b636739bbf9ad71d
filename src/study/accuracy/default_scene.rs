//! The default scene as it comes, and on other meshes, orders and steps, against the finest of them: what its own setting
//! costs and what it misses.
//!
//! Whole frames: solution, stress, counting, life and the frame that a screen or a recording is given, on as many threads
//! as the study has. Their rate is that of the passage; the start-up before it is in the seconds alone.

use std::fmt::Write as _;
use std::time::Instant;

use super::super::{Extent, StudyError, StudyProgress};
use asperity_engine::plan::Plan;
use asperity_engine::scene::{Order, Override, Scene, presets};
use asperity_engine::sim::{Frame, Simulation, Stage, Summary};

/// The name of this part.
pub const DEFAULT_PART: &str = "default scene";

/// Means of a passage that are compared, by their names in a summary.
pub const COMPARED: [&str; 5] = [
    "h_central_m",
    "h_min_m",
    "p_max_pa",
    "contact_ratio",
    "life_relative",
];

/// One setting of the default scene.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct DefaultSetting {
    /// Nodes per side.
    pub nodes: usize,
    /// Order of the discretisation.
    pub order: Order,
    /// Time step, nodes.
    pub step: f64,
}

impl DefaultSetting {
    fn sets(self) -> Vec<String> {
        vec![
            format!("grid.nodes={}", self.nodes),
            format!("numerics.order={}", self.order_name()),
            format!("time.step_nodes={}", self.step),
            "numerics.error_estimate=none".to_owned(),
            "record=none".to_owned(),
        ]
    }

    /// As the scene key has it.
    fn order_name(self) -> &'static str {
        match self.order {
            Order::Second => "second",
            Order::High => "high",
        }
    }
}

/// What came of it.
#[derive(Debug, Clone, PartialEq)]
pub struct DefaultRun {
    /// How it was run.
    pub setting: DefaultSetting,
    /// The values of [`COMPARED`], SI.
    pub values: [f64; COMPARED.len()],
    /// Whole frames a second.
    pub frames_per_s: f64,
    /// The whole run with its start-up, s.
    pub seconds: f64,
    /// Whether the scene comes so.
    pub is_default: bool,
}

/// Coarse to fine; the last is what the others are measured against.
fn settings(extent: Extent) -> Vec<DefaultSetting> {
    let at = |nodes, order, step| DefaultSetting { nodes, order, step };
    let (second, high) = (Order::Second, Order::High);
    match extent {
        Extent::Quick => vec![at(65, second, 1.0), at(65, high, 1.0), at(129, high, 1.0)],
        Extent::Usual => vec![
            at(129, second, 1.0),
            at(129, high, 1.0),
            at(257, second, 1.0),
            at(257, high, 1.0),
        ],
        Extent::Full => vec![
            at(129, second, 1.0),
            at(129, high, 1.0),
            at(129, high, 0.5),
            at(257, second, 1.0),
            at(257, high, 2.0),
            at(257, high, 1.0),
            at(257, high, 0.5),
            at(513, second, 1.0),
            at(513, high, 1.0),
        ],
    }
}

/// Runs them all on `threads` threads; the finest, last, is what the others are measured against.
///
/// # Errors
/// [`StudyError`] when a scene cannot be made or a step fails.
pub fn default_scene(
    extent: Extent,
    threads: usize,
    progress: &mut StudyProgress,
) -> Result<Vec<DefaultRun>, StudyError> {
    let failed = |reason: String| StudyError::Run {
        case: DEFAULT_PART.to_owned(),
        reason,
    };
    let asked =
        Scene::load_with(presets::DEFAULT, &[]).map_err(|error| failed(error.to_string()))?;
    let plan = Plan::new(&asked).map_err(|error| failed(error.to_string()))?;
    let own = DefaultSetting {
        nodes: plan.domain.nodes,
        order: plan.order,
        step: asked.time.step_nodes,
    };
    let settings = settings(extent);
    let all = settings.len();
    let runs = settings.into_iter().enumerate().map(|(n, setting)| {
        let name = format!("{DEFAULT_PART}, {}", setting.sets()[..3].join(", "));
        progress(&name, n, all);
        run(setting, threads, setting == own).map_err(failed)
    });
    runs.collect()
}

fn run(setting: DefaultSetting, threads: usize, is_default: bool) -> Result<DefaultRun, String> {
    let overrides = setting.sets();
    let overrides = overrides.iter().map(|text| text.parse::<Override>());
    let overrides = overrides
        .collect::<Result<Vec<_>, _>>()
        .map_err(|error| error.to_string())?;
    let scene =
        Scene::load_with(presets::DEFAULT, &overrides).map_err(|error| error.to_string())?;
    let plan = Plan::new(&scene).map_err(|error| error.to_string())?;
    let begun = Instant::now();
    let mut sim = Simulation::new(&scene, plan, threads).map_err(|error| error.to_string())?;
    while sim.stage() != Stage::Passage {
        sim.step().map_err(|error| error.to_string())?;
    }
    let (clock, mut frames, mut frame) = (Instant::now(), 0_u32, Frame::default());
    sim.inside(|sim| {
        while !sim.is_done() {
            sim.step().map_err(|error| error.to_string())?;
            sim.fill(&mut frame);
            frames += 1;
        }
        Ok::<(), String>(())
    })?;
    let rate = f64::from(frames) / clock.elapsed().as_secs_f64();
    let summary = sim.summary();
    Ok(DefaultRun {
        setting,
        values: values(&summary),
        frames_per_s: rate,
        seconds: begun.elapsed().as_secs_f64(),
        is_default,
    })
}

/// In the order of [`COMPARED`].
fn values(summary: &Summary) -> [f64; COMPARED.len()] {
    [
        summary.h_central_m,
        summary.h_min_m,
        summary.p_max_pa,
        summary.contact_ratio,
        summary.life_relative.unwrap_or(f64::NAN),
    ]
}

/// The runs as a section of the report.
pub fn default_scene_text(runs: &[DefaultRun]) -> String {
    let mut text = String::new();
    let Some(reference) = runs.last() else {
        return text;
    };
    let s = reference.setting;
    let _ = writeln!(
        text,
        "\n## The default scene\n\n\
         Means of its passage, per cent off the run on {} nodes, order {}, steps of {} nodes. `*`: as the scene comes.\n\n\
         | | nodes | order | step | {} | whole frames a second | s |\n|---|---|---|---|{}---|---|",
        s.nodes,
        s.order_name(),
        s.step,
        COMPARED.join(" | "),
        "---|".repeat(COMPARED.len()),
    );
    for run in runs {
        let s = run.setting;
        let off = run.values.iter().zip(&reference.values);
        let off: Vec<String> = off
            .map(|(value, of)| format!("{:+.2}", 100.0 * (value / of - 1.0)))
            .collect();
        let _ = writeln!(
            text,
            "| {} | {} | {} | {} | {} | {:.1} | {:.1} |",
            if run.is_default { "*" } else { "" },
            s.nodes,
            s.order_name(),
            s.step,
            off.join(" | "),
            run.frames_per_s,
            run.seconds,
        );
    }
    text
}
