//! What a step costs against grid, symmetry, threads and regime.
//!
//! ```text
//! units = time of a step / time of one padded transform pair (f64, whole grid, one thread), same nodes
//! ```
//! The pair is what one deflection costs; it is measured in the same run, before and after the steps, so that
//! units mean the same on any machine. Steps are those of the default scene's passage (rough on both bodies,
//! mixed lubrication, converged to the scene's tolerance) without stress, life and recording; medians. The
//! whole grid is had by turning body 2's waves by a hundredth of a degree, which breaks the symmetry and
//! nothing else. A second run with all stages on, of the mirrored grid, splits what a step costs:
//! whatever it takes beyond the bare one goes to stress, counting and life; a frame is filled apart. A whole frame is all of it.

use std::fmt::Write as _;
use std::time::Instant;

use super::{Extent, StudyError, StudyProgress, refuse_nothing};
use crate::math::filter::{Filter, Padding};
use crate::math::grid::{Grid, Symmetry};
use crate::plan::Plan;
use crate::scene::{Override, Scene, presets};
use crate::sim::{Frame, Simulation, Stage};

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
    /// Newton iterations a step.
    pub newton: f64,
    /// Krylov iterations a step.
    pub krylov: f64,
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

const GENERAL: &[&str] = &["body_2.surface.angle_deg=0.01"];
const MIRRORED: &[&str] = &[];
const MIRRORED_CASE: &str = "mirrored in y";

/// The default scene at other speeds of entrainment.
const SPEEDS: [(&str, &[&str]); 5] = [
    ("U = 5 m/s, full film", &["motion.entrainment_m_s=5"]),
    (HALF_TOUCHES, &["motion.entrainment_m_s=0.05"]),
    ("U = 0.01 m/s", &["motion.entrainment_m_s=1e-2"]),
    ("U = 1e-3 m/s, near dry", &["motion.entrainment_m_s=1e-3"]),
    ("U = 1e-4 m/s, near dry", &["motion.entrainment_m_s=1e-4"]),
];
/// The mixed regime's dry end: at the default speed 2 % of the contact touch, here 56 %.
const HALF_TOUCHES: &str = "U = 0.05 m/s, 56 % touch";

/// Nodes of the largest grid.
const LARGEST: usize = 513;

fn cases(extent: Extent) -> Vec<ScalingCase> {
    let mut cases = Vec::new();
    let sizes: &[(usize, usize)] = match extent {
        Extent::Quick => &[(65, 32), (129, 32)],
        Extent::Usual => &[(65, 256), (129, 256), (257, 96)],
        Extent::Full => &[(65, 256), (129, 256), (257, 96), (LARGEST, 24)],
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
        push("dry", 129, 2, 256, &["lubricant=none"]);
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
    let splits = case.name == MIRRORED_CASE;
    let split = if splits {
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
        newton: bare.newton,
        krylov: bare.krylov,
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
    failed: u32,
    memory_bytes: u64,
}

fn run(case: &ScalingCase, more: &[&str]) -> Result<Timings, String> {
    let nodes = format!("grid.nodes={}", case.nodes);
    let common = ["record=none", "time.passages=4", &nodes];
    let overrides = common
        .iter()
        .chain(more)
        .chain(case.keys)
        .map(|text| text.parse::<Override>())
        .collect::<Result<Vec<_>, _>>()
        .map_err(|error| error.to_string())?;
    let scene =
        Scene::load_with(presets::DEFAULT, &overrides).map_err(|error| error.to_string())?;
    let plan = Plan::new(&scene).map_err(|error| error.to_string())?;
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
    let pool = rayon::ThreadPoolBuilder::new()
        .num_threads(1)
        .build()
        .map_err(|error| error.to_string())?;
    let grid = Grid::new(nodes, -2.5, 1.5, 2.0, Symmetry::General);
    let mut filter = Filter::<f64>::new(&grid, Padding::Doubled, 1);
    filter.set_symbol(0, |_, _| 1.0);
    let input = vec![1.0; grid.len()];
    let mut out = vec![0.0; grid.len()];
    Ok(pool.install(|| best(|| filter.apply(&input, &mut out))))
}

/// The rows as a Markdown table, with the ratios that the rows give.
pub fn scaling_text(rows: &[ScalingRow]) -> String {
    let mut text = String::from(
        "| grid | case | threads | pair, ms | step, ms | units (pairs) | steps/s | Newton | Krylov | MB | not converged |\n\
         |---|---|---|---|---|---|---|---|---|---|---|\n",
    );
    for row in rows {
        let _ = writeln!(
            text,
            "| {n}² | {} | {} | {:.3} | {:.2} | {:.0} | {:.1} | {:.1} | {:.1} | {:.0} | {} |",
            row.case,
            row.threads,
            row.pair_s * 1e3,
            row.step_s * 1e3,
            row.units(),
            1.0 / row.step_s,
            row.newton,
            row.krylov,
            row.memory_bytes as f64 * 1e-6,
            row.failed,
            n = row.nodes,
        );
    }
    text.push('\n');
    push_ratios(&mut text, rows);
    push_splits(&mut text, rows);
    text
}

/// What each stage takes, in pairs.
fn push_splits(text: &mut String, rows: &[ScalingRow]) {
    text.push_str(
        "\n| grid | case | threads | solution, pairs | stress, counting and life, pairs | frame, pairs | whole frame, pairs | whole frames/s | MB with them |\n\
         |---|---|---|---|---|---|---|---|---|\n",
    );
    for (row, split) in rows
        .iter()
        .filter_map(|row| row.split.map(|split| (row, split)))
    {
        let _ = writeln!(
            text,
            "| {n}² | {} | {} | {:.1} | {:.1} | {:.1} | {:.1} | {:.1} | {:.0} |",
            row.case,
            row.threads,
            row.units(),
            split.stress_and_life_s / row.pair_s,
            split.frame_s / row.pair_s,
            (split.whole_s + split.frame_s) / row.pair_s,
            1.0 / (split.whole_s + split.frame_s),
            split.memory_bytes as f64 * 1e-6,
            n = row.nodes,
        );
    }
}

fn push_ratios(text: &mut String, rows: &[ScalingRow]) {
    let find = |case: &str, nodes: usize, threads: usize| {
        rows.iter()
            .find(|row| row.case == case && row.nodes == nodes && row.threads == threads)
    };
    let mut sizes: Vec<usize> = rows.iter().map(|row| row.nodes).collect();
    sizes.sort_unstable();
    sizes.dedup();
    for &n in &sizes {
        let whole = [find("whole grid", n, 1), find("whole grid", n, 2)];
        let mirrored = find("mirrored in y", n, 2);
        if let ([Some(one), Some(two)], Some(mirrored)) = (whole, mirrored) {
            let _ = writeln!(
                text,
                "{n}²: two threads {:.2} times one; mirrored {:.2} times as fast as the whole grid",
                one.step_s / two.step_s,
                two.step_s / mirrored.step_s
            );
        }
    }
    // From each size to the next, then from the least to the largest.
    let ends = [sizes.first(), sizes.last()].map(|n| *n.unwrap_or(&0));
    let pairs = sizes.windows(2).map(|pair| [pair[0], pair[1]]);
    for [from, to] in pairs.chain((sizes.len() > 2).then_some(ends)) {
        let work = |n: usize| (n * n) as f64 * (n as f64).log2();
        let growth = |case: &str| {
            let (small, large) = (find(case, from, 1)?, find(case, to, 1)?);
            Some(large.step_s / small.step_s)
        };
        if let (Some(whole), Some(mirrored)) = (growth("whole grid"), growth("mirrored in y")) {
            let _ = writeln!(
                text,
                "{from}² to {to}², one thread: cost x {whole:.2}, mirrored x {mirrored:.2}; N² log N x {:.2}",
                work(to) / work(from)
            );
        }
    }
    if let Some(mixed) = find("mirrored in y", 129, 2) {
        for row in rows.iter().filter(|row| row.case.contains("near dry")) {
            let _ = writeln!(
                text,
                "{}: {:.2} times the cost of the mixed regime",
                row.case,
                row.step_s / mixed.step_s
            );
            if let Some(half) = find(HALF_TOUCHES, 129, 2) {
                let _ = writeln!(
                    text,
                    "  and {:.2} times that at its dry end, {}",
                    row.step_s / half.step_s,
                    half.case
                );
            }
        }
    }
}
