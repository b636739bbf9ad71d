//! What a step costs against grid, symmetry, threads and regime.
//!
//! ```text
//! units = time of a step / time of one padded transform pair (f64, whole grid, one thread), same nodes
//! transforms, % = time of a step's transforms on their own, as many threads / time of the step
//! ```
//! The pair is what one deflection costs; it is measured in the same run, before and after the steps, so that
//! units mean the same on any machine. Steps are those of the default scene's passage (rough on both bodies,
//! mixed lubrication, converged to the scene's tolerance) without stress, life and recording; medians. The
//! whole grid is had by turning body 2's waves by a hundredth of a degree, which breaks the symmetry and
//! nothing else. A second run with all stages on, of the mirrored grid, splits what a step costs:
//! whatever it takes beyond the bare one goes to stress, counting and life; a frame is filled apart. A whole frame is all of it.

use std::time::Instant;

use rustfft::FftNum;

use super::table::{MarkdownTable, figure};
use super::{Extent, Report, StudyError, StudyProgress, planned, refuse_nothing, scene_with};
use asperity_engine::math::filter::{Filter, Padding};
use asperity_engine::math::grid::{Grid, Symmetry};
use asperity_engine::scene::presets;
use asperity_engine::sim::{Frame, Simulation, Stage};

/// One measured case.
#[derive(Debug, Clone, PartialEq)]
pub struct ScalingRow {
    /// What was run.
    pub case: String,
    /// Nodes per side.
    pub nodes: usize,
    /// Worker threads.
    pub threads: usize,
    /// Transform pair, s.
    pub pair_s: f64,
    /// Median step, s.
    pub step_s: f64,
    /// What the transforms of a step take on their own, on as many threads, s; of a dry step, which has others, nothing.
    pub transforms_s: Option<f64>,
    /// Newton iterations a step.
    pub newton: f64,
    /// Krylov iterations a step.
    pub krylov: f64,
    /// Two-dimensional transforms a step.
    pub transforms: f64,
    /// Steps that did not converge.
    pub failed: u32,
    /// Memory by the plan's account, bytes.
    pub memory_bytes: u64,
    /// What the other stages take; `None`: not measured in this case.
    pub split: Option<Split>,
}

/// What a step takes beside the solution, s.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Split {
    /// Mean of stress, counting and life over steps: volumes are due in some of them only.
    pub stress_and_life_s: f64,
    /// Mean of a whole step with all of them.
    pub whole_s: f64,
    /// A frame of it.
    pub frame_s: f64,
    /// Memory with them, bytes.
    pub memory_bytes: u64,
}

impl Split {
    /// A whole step and its frame, s.
    fn whole_frame_s(&self) -> f64 {
        self.whole_s + self.frame_s
    }
}

impl ScalingRow {
    /// Cost of a step in transform pairs.
    pub fn units(&self) -> f64 {
        self.step_s / self.pair_s
    }
}

/// One case to run: its name, nodes, threads, steps and the keys that it sets.
struct ScalingCase {
    name: &'static str,
    nodes: usize,
    threads: usize,
    steps: usize,
    keys: &'static [&'static str],
}

impl ScalingCase {
    fn title(&self) -> String {
        format!("{}² {}, {} threads", self.nodes, self.name, self.threads)
    }
}

const DRY: &str = "dry";
const GENERAL: &[&str] = &["body_2.surface.angle_deg=0.01"];
const MIRRORED: &[&str] = &[];
const MIRRORED_CASE: &str = "mirrored in y";

/// The default scene at other speeds of entrainment: at its own, 2 % of the contact are asperity contact.
const SPEEDS: [(&str, &[&str]); 5] = [
    ("U = 5 m/s, full film", &["motion.entrainment_m_s=5"]),
    (
        "U = 0.05 m/s, 56 % in contact",
        &["motion.entrainment_m_s=0.05"],
    ),
    ("U = 0.01 m/s", &["motion.entrainment_m_s=1e-2"]),
    ("U = 1e-3 m/s, near dry", &["motion.entrainment_m_s=1e-3"]),
    ("U = 1e-4 m/s, near dry", &["motion.entrainment_m_s=1e-4"]),
];

/// Nodes of the largest grid.
const LARGEST: usize = 513;

fn cases(extent: Extent) -> Vec<ScalingCase> {
    let mut cases = Vec::new();
    let sizes: &[(usize, usize)] = match extent {
        Extent::Quick => &[(65, 32), (129, 32)],
        Extent::Usual => &[(65, 256), (129, 256), (257, 256)],
        Extent::Full => &[(65, 256), (129, 256), (257, 256), (LARGEST, 24)],
    };
    let mut push = |name, nodes, threads, steps, keys| {
        cases.push(ScalingCase {
            name,
            nodes,
            threads,
            steps,
            keys,
        });
    };
    for &(nodes, steps) in sizes {
        // The largest grid takes minutes to start up: one thread, for the growth.
        let most = if nodes == LARGEST { 1 } else { 2 };
        for threads in 1..=most {
            push("whole grid", nodes, threads, steps, GENERAL);
            push(MIRRORED_CASE, nodes, threads, steps, MIRRORED);
        }
    }
    if extent != Extent::Quick {
        for (name, keys) in SPEEDS {
            push(name, 129, 2, 256, keys);
        }
        push(DRY, 129, 2, 256, &["lubricant=none"]);
    }
    cases
}

/// Measures the cases, those whose name holds `only` if that is given; `progress` hears the name of each before it runs.
///
/// # Errors
/// [`StudyError`] when a case cannot be made or fails, or when none has that name.
pub fn scaling(
    extent: Extent,
    only: Option<&str>,
    progress: &mut StudyProgress,
) -> Result<Vec<ScalingRow>, StudyError> {
    let mut cases = cases(extent);
    cases.retain(|case| only.is_none_or(|part| case.title().contains(part)));
    refuse_nothing(only, cases.is_empty())?;
    let mut rows = Vec::with_capacity(cases.len());
    for (n, case) in cases.iter().enumerate() {
        let name = case.title();
        progress(&name, n, cases.len());
        rows.push(measure(case).map_err(|reason| StudyError::Run { case: name, reason })?);
    }
    Ok(rows)
}

fn measure(case: &ScalingCase) -> Result<ScalingRow, String> {
    let bare = run(case, &["stress=none", "life=none"])?;
    let pair_s = bare.pair_s;
    let split = if case.name == MIRRORED_CASE {
        let whole = run(case, &[])?;
        Some(Split {
            whole_s: whole.mean_s,
            stress_and_life_s: (whole.mean_s - bare.mean_s).max(0.0),
            frame_s: whole.frame_s,
            memory_bytes: whole.memory_bytes,
        })
    } else {
        None
    };
    Ok(ScalingRow {
        case: case.name.to_owned(),
        nodes: case.nodes,
        threads: case.threads,
        pair_s,
        step_s: bare.median_s,
        transforms_s: if case.name == DRY {
            None
        } else {
            Some(transforms_s(case, &bare)?)
        },
        newton: bare.newton,
        krylov: bare.krylov,
        transforms: bare.transforms,
        failed: bare.failed,
        memory_bytes: bare.memory_bytes,
        split,
    })
}

/// Times and work of a case's steps.
struct Timings {
    pair_s: f64,
    median_s: f64,
    mean_s: f64,
    frame_s: f64,
    newton: f64,
    krylov: f64,
    /// Two-dimensional transforms a step.
    transforms: f64,
    failed: u32,
    memory_bytes: u64,
}

fn run(case: &ScalingCase, more: &[&str]) -> Result<Timings, String> {
    let nodes = format!("grid.nodes={}", case.nodes);
    let mut sets = vec![
        nodes,
        "record=none".to_owned(),
        "time.passages=4".to_owned(),
    ];
    sets.extend(more.iter().chain(case.keys).map(|&key| key.to_owned()));
    let (scene, plan) = planned(scene_with(presets::DEFAULT, &sets)?)?;
    let memory_bytes = plan.cost.memory_bytes;
    let mut sim = Simulation::new(&scene, plan, case.threads).map_err(|error| error.to_string())?;
    while sim.stage() != Stage::Passage {
        sim.step().map_err(|error| error.to_string())?;
    }
    let before = pair_s(case.nodes)?;
    let start = *sim.stats();
    let mut times = Vec::with_capacity(case.steps);
    let mut failed = 0;
    sim.inside(|sim| {
        for _ in 0..case.steps {
            let clock = Instant::now();
            sim.step().map_err(|error| error.to_string())?;
            times.push(clock.elapsed().as_secs_f64());
            failed += u32::from(!sim.metrics().converged);
        }
        Ok::<(), String>(())
    })?;
    let mut frame = Frame::default();
    let frame_s = best(|| sim.fill(&mut frame));
    let pair_s = before.min(pair_s(case.nodes)?);
    let mean_s = times.iter().sum::<f64>() / times.len() as f64;
    times.sort_by(f64::total_cmp);
    let per_step = |count: u64| count as f64 / case.steps as f64;
    Ok(Timings {
        pair_s,
        median_s: times[times.len() / 2],
        mean_s,
        frame_s,
        newton: per_step(sim.stats().newton_iterations - start.newton_iterations),
        krylov: per_step(sim.stats().linear_iterations - start.linear_iterations),
        transforms: per_step(sim.stats().ffts - start.ffts),
        failed,
        memory_bytes,
    })
}

/// Best time of some calls, s.
fn best(mut call: impl FnMut()) -> f64 {
    const CALLS: u32 = 40;
    (0..CALLS)
        .map(|_| {
            let clock = Instant::now();
            call();
            clock.elapsed().as_secs_f64()
        })
        .fold(f64::INFINITY, f64::min)
}

/// Best time of one padded double-precision transform pair on the whole grid, one thread.
fn pair_s(nodes: usize) -> Result<f64, String> {
    filter_s::<f64>(nodes, Symmetry::General, Padding::Doubled, 1)
}

/// Best time of one transform pair that works on so many threads.
fn filter_s<T: FftNum>(
    nodes: usize,
    symmetry: Symmetry,
    padding: Padding,
    threads: usize,
) -> Result<f64, String> {
    let pool = rayon::ThreadPoolBuilder::new()
        .num_threads(threads)
        .build()
        .map_err(|error| error.to_string())?;
    let grid = Grid::new(nodes, -2.5, 1.5, 2.0, symmetry);
    let mut filter = Filter::<T>::new(&grid, padding, 1);
    filter.set_symbol(0, |_, _| 1.0);
    let input = vec![T::one(); grid.len()];
    let mut out = vec![T::zero(); grid.len()];
    Ok(pool.install(|| best(|| filter.apply(&input, &mut out))))
}

/// What the transforms of a mean step take on their own, as many as were counted: a padded pair in double precision for each
/// evaluation (one before the first Newton iteration), a padded one in single precision for each Krylov iteration; all others
/// are pinned ones of the preconditioner, in single precision, one forth and one back for each of its bins.
fn transforms_s(case: &ScalingCase, of: &Timings) -> Result<f64, String> {
    let symmetry = if case.keys == GENERAL {
        Symmetry::General
    } else {
        Symmetry::MirrorY
    };
    let pair = |padding| filter_s::<f32>(case.nodes, symmetry, padding, case.threads);
    let double = filter_s::<f64>(case.nodes, symmetry, Padding::Doubled, case.threads)?;
    let evaluations = of.newton + 1.0;
    let pinned = (0.5 * of.transforms - evaluations - of.krylov).max(0.0);
    Ok(
        evaluations * double
            + of.krylov * pair(Padding::Doubled)?
            + pinned * pair(Padding::Pinned)?,
    )
}

/// The steps, then what each stage takes in pairs.
pub fn scaling_report(rows: &[ScalingRow]) -> Report {
    type Column<T> = (&'static str, fn(&T) -> String);
    let steps: [Column<ScalingRow>; 13] = [
        ("grid", |row| format!("{}²", row.nodes)),
        ("case", |row| row.case.clone()),
        ("threads", |row| row.threads.to_string()),
        ("pair, ms", |row| format!("{:.3}", row.pair_s * 1e3)),
        ("step, ms", |row| format!("{:.2}", row.step_s * 1e3)),
        ("units (pairs)", |row| format!("{:.0}", row.units())),
        ("transforms, %", |row| {
            figure(row.transforms_s.map(|s| 100.0 * s / row.step_s))
        }),
        ("steps/s", |row| format!("{:.1}", 1.0 / row.step_s)),
        ("Newton", |row| format!("{:.1}", row.newton)),
        ("Krylov", |row| format!("{:.1}", row.krylov)),
        ("transforms", |row| format!("{:.0}", row.transforms)),
        ("MB", |row| format!("{:.0}", row.memory_bytes as f64 * 1e-6)),
        ("not converged", |row| row.failed.to_string()),
    ];
    let stages: [Column<(&ScalingRow, Split)>; 8] = [
        ("grid", |(row, _)| format!("{}²", row.nodes)),
        ("threads", |(row, _)| row.threads.to_string()),
        ("solution, pairs", |(row, _)| format!("{:.1}", row.units())),
        ("stress, counting and life, pairs", |(row, split)| {
            format!("{:.1}", split.stress_and_life_s / row.pair_s)
        }),
        ("frame, pairs", |(row, split)| {
            format!("{:.1}", split.frame_s / row.pair_s)
        }),
        ("whole frame, pairs", |(row, split)| {
            format!("{:.1}", split.whole_frame_s() / row.pair_s)
        }),
        ("whole frames/s", |(_, split)| {
            format!("{:.1}", 1.0 / split.whole_frame_s())
        }),
        ("MB with them", |(_, split)| {
            format!("{:.0}", split.memory_bytes as f64 * 1e-6)
        }),
    ];
    let of_stages: Vec<_> = rows
        .iter()
        .filter_map(|row| Some((row, row.split?)))
        .collect();
    let table = MarkdownTable::of(rows, &steps);
    Report {
        title: "Scaling",
        text: format!(
            "{}\n{}",
            table.markdown(),
            MarkdownTable::of(&of_stages, &stages).markdown()
        ),
        table,
        plots: Vec::new(),
        passes: rows.iter().all(|row| row.failed == 0),
    }
}
