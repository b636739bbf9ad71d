//! Whole runs: the film of moving waves, and the default scene from its start-up to its life.
//!
//! *Rough film*: the demonstration at 5 m/s with transverse waves of 0.35 mm (0.74 a) on the faster body, S = 1; each
//! series is measured against its own finest case. *Default scene*: whole frames (solution, stress, counting, life and the
//! frame that a screen or a recording is given) against the finest of the runs, on one mesh and up a ladder of meshes. Their rate is that of the passage; the
//! start-up before it is in the seconds alone.

use std::sync::Arc;
use std::time::Instant;

use super::super::table::MarkdownTable;
use super::super::{Finished, StudyError, climb, planned, scene_with};
use super::series::{Against, Measured, Part, Series, Varied};
use super::{LEVELS, Sizes};
use asperity_engine::scene::{Order, presets};
use asperity_engine::sim::{Frame, Simulation, Stage};
use asperity_picture::chart::{Curve, Mark};

/// The name of the part that runs the default scene.
pub const DEFAULT_PART: &str = "default scene";

/// Means of a passage that are compared, by their names in a summary.
pub const COMPARED: [&str; 5] = [
    "h_central_m",
    "h_min_m",
    "p_max_pa",
    "contact_ratio",
    "life_relative",
];

/// Settings of a run.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Resolution {
    /// Nodes per side.
    pub nodes: usize,
    /// Order of the discretisation.
    pub order: Order,
    /// Time step, nodes.
    pub step: f64,
    /// Tolerance of a step.
    pub tolerance: f64,
    /// Depths.
    pub depths: usize,
    /// Whether the run climbs to its mesh from coarser ones.
    pub climbs: bool,
}

impl Resolution {
    /// What most series are taken at.
    pub(super) const USUAL: Self = Self {
        nodes: 129,
        order: Order::Second,
        step: 1.0,
        tolerance: 1e-3,
        depths: 32,
        climbs: false,
    };

    /// As the scene key has it.
    fn order_name(self) -> &'static str {
        match self.order {
            Order::Second => "second",
            Order::High => "high",
        }
    }

    /// The keys that it sets.
    fn keys(self) -> Vec<String> {
        vec![
            format!("grid.nodes={}", self.nodes),
            format!("numerics.order={}", self.order_name()),
            format!("time.step_nodes={}", self.step),
            format!("numerics.tolerance={:e}", self.tolerance),
            format!("stress.depths={}", self.depths),
            format!("numerics.ladder={}", self.climbs),
        ]
    }

    /// As overrides for a command line.
    pub fn command(self) -> String {
        let set = |key| format!("--set {key}");
        let sets: Vec<String> = self.keys().into_iter().map(set).collect();
        sets.join(" ")
    }

    /// Whether nothing is coarser than in `other`.
    fn is_as_fine_as(self, other: Self) -> bool {
        self.order == other.order
            && self.climbs == other.climbs
            && self.nodes >= other.nodes
            && self.step <= other.step
            && self.tolerance <= other.tolerance
            && self.depths >= other.depths
    }
}

/// A run of the default scene.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct WholeRun {
    /// How it was run.
    pub setting: Resolution,
    /// The values of [`COMPARED`], SI.
    pub values: [f64; COMPARED.len()],
    /// Relative error of the life, against the finest run.
    pub error: f64,
    /// Whole frames a second.
    pub frames_per_s: f64,
    /// The whole run with its start-up, s.
    pub seconds: f64,
}

/// A column: its name and what a run has in it.
type Column<'a> = (&'static str, Box<dyn Fn(&WholeRun) -> String + 'a>);

fn run(setting: Resolution, more: &[&str], threads: usize) -> Result<Finished, String> {
    let mut sets = setting.keys();
    sets.push("numerics.error_estimate=none".to_owned());
    sets.push("record=none".to_owned());
    sets.extend(more.iter().map(|&key| key.to_owned()));
    let (scene, plan) = planned(scene_with(presets::DEFAULT, &sets)?)?;
    if setting.climbs {
        return climb(Arc::new(scene), plan, threads);
    }
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
    Ok(Finished {
        summary: sim.summary(),
        frames_per_s: f64::from(frames) / clock.elapsed().as_secs_f64(),
        seconds: begun.elapsed().as_secs_f64(),
    })
}

/// Central film and maximum pressure of moving waves, over nodes, steps and tolerance.
pub(super) fn rough(sizes: &Sizes, threads: usize) -> Result<Vec<Series>, StudyError> {
    let part = Part {
        name: "rough film",
        quantities: ["mean central film", "mean maximum pressure"],
        against: Against::Finest,
        work_unit: "Krylov",
    };
    let measure = |setting: Resolution| {
        let ran = run(
            setting,
            &[
                "stress=none",
                "life=none",
                "motion.slide_roll=1",
                "motion.entrainment_m_s=5",
                "body_1.surface.kind=smooth",
                "body_2.surface.wavelength_x_m=3.5e-4",
                "body_2.surface.wavelength_y_m=inf",
                "body_2.surface.amplitude_m=1e-7",
                "time.passages=0.5",
            ],
            threads,
        )?;
        Ok(Measured {
            values: [ran.summary.h_central_m, ran.summary.p_max_pa],
            seconds: ran.seconds,
            work: ran.summary.counters.linear_iterations,
        })
    };
    let base = sizes.rough_base;
    let at_nodes = |nodes: f64| Resolution {
        nodes: nodes as usize,
        ..base
    };
    let [nodes, step, tolerance] = [
        format!("N {}", base.nodes),
        format!("step {}", base.step),
        format!("tolerance {:e}", base.tolerance),
    ];
    let rest = format!("{step}, {tolerance}");
    let mut series = part.over(Varied::Nodes, sizes.rough, &rest, |n| measure(at_nodes(n)))?;
    let rest = format!("{nodes}, {tolerance}");
    series.extend(part.over(Varied::Step, sizes.steps, &rest, |step| {
        measure(Resolution { step, ..base })
    })?);
    let rest = format!("{nodes}, {step}");
    let tolerances = [1e-2, 1e-3, 1e-4];
    series.extend(
        part.over(Varied::Tolerance, &tolerances, &rest, |tolerance| {
            measure(Resolution { tolerance, ..base })
        })?,
    );
    Ok(series)
}

/// Runs the default scene at every setting; the last is what the others are measured against.
pub(super) fn whole_runs(
    sizes: &Sizes,
    threads: usize,
    mut heard: impl FnMut(&str),
) -> Result<Vec<WholeRun>, StudyError> {
    let length = format!("time.passages={}", sizes.passages);
    let mut runs = Vec::new();
    for setting in sizes.whole() {
        let name = format!("{DEFAULT_PART}, {}", setting.keys().join(", "));
        heard(&name);
        let failed = |reason| StudyError::Run { case: name, reason };
        let ran = run(setting, &[&length], threads).map_err(failed)?;
        let s = &ran.summary;
        runs.push(WholeRun {
            setting,
            values: [
                s.h_central_m,
                s.h_min_m,
                s.p_max_pa,
                s.contact_ratio,
                s.life_relative.unwrap_or(f64::NAN),
            ],
            error: 0.0,
            frames_per_s: ran.frames_per_s,
            seconds: ran.seconds,
        });
    }
    let life = |run: &WholeRun| run.values[COMPARED.len() - 1];
    let finest = runs.last().map_or(f64::NAN, life);
    for run in &mut runs {
        run.error = (life(run) / finest - 1.0).abs();
    }
    Ok(runs)
}

/// The cheapest run whose life is within `error` of the finest, and that of every run that is as fine in all respects
/// too: an error that is small because two errors cancel recommends nothing.
pub(super) fn cheapest(runs: &[WholeRun], error: f64) -> Option<&WholeRun> {
    let robust = |run: &&WholeRun| {
        let mut finer = runs.iter();
        finer.all(|other| other.error <= error || !other.setting.is_as_fine_as(run.setting))
    };
    let good = runs.iter().filter(robust);
    good.min_by(|one, two| one.seconds.total_cmp(&two.seconds))
}

/// The runs as a section of the report.
pub(super) fn whole_text(runs: &[WholeRun], passages: f64) -> String {
    let Some(finest) = runs.last() else {
        return String::new();
    };
    let compared = COMPARED.iter().enumerate().map(|(k, &name)| {
        let percent = move |run: &WholeRun| 100.0 * (run.values[k] / finest.values[k] - 1.0);
        let cell = move |run: &WholeRun| format!("{:+.2}", percent(run));
        (name, Box::new(cell) as Box<dyn Fn(&WholeRun) -> String>)
    });
    let mut columns: Vec<Column> = vec![
        ("nodes", Box::new(|run| run.setting.nodes.to_string())),
        ("order", Box::new(|run| run.setting.order_name().to_owned())),
        ("step", Box::new(|run| run.setting.step.to_string())),
        (
            "tolerance",
            Box::new(|run| format!("{:e}", run.setting.tolerance)),
        ),
        ("depths", Box::new(|run| run.setting.depths.to_string())),
        ("ladder", Box::new(|run| run.setting.climbs.to_string())),
    ];
    columns.extend(compared);
    columns.push((
        "whole frames a second",
        Box::new(|run| format!("{:.1}", run.frames_per_s)),
    ));
    columns.push(("s", Box::new(|run| format!("{:.1}", run.seconds))));
    let table = MarkdownTable::of(runs, &columns).markdown();
    let recommended = LEVELS.map(|level| match cheapest(runs, level) {
        Some(run) => format!(
            "- {} % in life: `{}` ({:.2} %, {:.1} s)\n",
            100.0 * level,
            run.setting.command(),
            100.0 * run.error,
            run.seconds
        ),
        None => format!("- {} % in life: none of these\n", 100.0 * level),
    });
    format!(
        "\n## The default scene\n\n\
         Means of {passages} passages, per cent off the last run.\n\n{table}\n\
         ## Recommended settings\n\n\
         The cheapest whose error in life stays within the level at every finer setting too.\n\n{}",
        recommended.concat()
    )
}

/// Error in life against time, a curve for each mesh and order.
pub(super) fn life_curves(runs: &[WholeRun]) -> Vec<Curve> {
    let kind = |run: &WholeRun| {
        if run.setting.climbs {
            return "up a ladder of meshes".to_owned();
        }
        format!("{}², {}", run.setting.nodes, run.setting.order_name())
    };
    let mut kinds: Vec<String> = runs.iter().map(kind).collect();
    kinds.dedup();
    let curve = |name: String| {
        let of_kind = runs
            .iter()
            .filter(|run| kind(run) == name && run.error > 0.0);
        let mut points: Vec<(f64, f64)> = of_kind.map(|run| (run.seconds, run.error)).collect();
        points.sort_by(|one, two| one.0.total_cmp(&two.0));
        Curve {
            name,
            points,
            mark: Mark::Computed,
        }
    };
    kinds.into_iter().map(curve).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn errors_that_cancel_recommend_nothing() {
        let run = |nodes, step, error, seconds| WholeRun {
            setting: Resolution {
                nodes,
                step,
                ..Resolution::USUAL
            },
            values: [1.0; COMPARED.len()],
            error,
            frames_per_s: 1.0,
            seconds,
        };
        // The coarsest is right by accident: a finer one is not.
        let runs = [
            run(65, 1.0, 0.001, 1.0),
            run(65, 0.5, 0.03, 2.0),
            run(129, 0.5, 0.008, 9.0),
            run(257, 0.5, 0.002, 90.0),
        ];
        assert_eq!(cheapest(&runs, 0.05).map(|run| run.seconds), Some(1.0));
        assert_eq!(cheapest(&runs, 0.01).map(|run| run.seconds), Some(9.0));
        assert_eq!(cheapest(&runs, 0.001), None);
    }
}
