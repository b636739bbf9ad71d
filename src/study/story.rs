//! The first scene as it is told: its life against S on every mesh of the ladder, by both counts, with what takes it; at
//! S = 0, where the same crests meet all the way, at several phases; and beside it a gear tooth, a line contact.
//!
//! ```text
//! fall  = life(S = 0)/life(S = .5)  at least 5, on the last mesh
//! after = no life beyond S = .5 above the band of that at .5
//! ```

use std::sync::Arc;

use super::{
    Extent, MarkdownTable, Report, StudyError, StudyProgress, climb, figure, planned,
    refuse_nothing, run_all, scene_with,
};
use asperity_engine::scene::presets;
use asperity_engine::sim::Summary;

/// Lengths of life from S = 0 to .5 that a first scene has to lose.
pub const FALL: f64 = 5.0;
/// S of the first scene.
const SLIDING: [f64; 6] = [0.0, 0.1, 0.25, 0.5, 0.75, 1.0];
/// Other phases of body 1 at S = 0, degrees.
const PHASES: [f64; 3] = [0.0, 180.0, 270.0];
/// The gear tooth and its S.
const TOOTH: (&str, [f64; 4]) = ("fzg_point_b", [0.0, 0.1, 0.44, 1.0]);

/// A run of it.
#[derive(Debug, Clone)]
pub struct Told {
    scene: &'static str,
    slide_roll: f64,
    /// Of body 1, where it is not the scene's.
    phase_deg: Option<f64>,
    /// What came out.
    pub summary: Summary,
}

impl Told {
    /// S of the run.
    pub fn slide_roll(&self) -> f64 {
        self.slide_roll
    }
}

/// What of it is run.
#[derive(Debug, Clone, Copy)]
struct Asked {
    scene: &'static str,
    slide_roll: f64,
    phase_deg: Option<f64>,
    nodes: usize,
}

impl Asked {
    fn all(extent: Extent) -> Vec<Self> {
        let (nodes, on_tooth) = match extent {
            Extent::Quick => (65, 129),
            Extent::Usual => (257, 257),
            Extent::Full => (513, 513),
        };
        let first = |slide_roll, phase_deg| Self {
            scene: presets::DEFAULT,
            slide_roll,
            phase_deg,
            nodes,
        };
        let own = SLIDING.map(|slide_roll| first(slide_roll, None));
        let phases = PHASES.map(|phase_deg| first(0.0, Some(phase_deg)));
        let tooth = TOOTH.1.map(|slide_roll| Self {
            scene: TOOTH.0,
            slide_roll,
            phase_deg: None,
            nodes: on_tooth,
        });
        own.into_iter().chain(phases).chain(tooth).collect()
    }

    fn name(&self) -> String {
        let phase = self
            .phase_deg
            .map_or_else(String::new, |deg| format!(", {deg} degrees"));
        format!("{}, S = {}{phase}", self.scene, self.slide_roll)
    }

    fn run(&self) -> Result<Told, String> {
        let mut sets = vec![
            format!("motion.slide_roll={}", self.slide_roll),
            format!("grid.nodes={}", self.nodes),
            "record=none".to_owned(),
        ];
        sets.extend(
            self.phase_deg
                .map(|deg| format!("body_1.surface.phase_deg={deg}")),
        );
        let (scene, plan) = planned(scene_with(self.scene, &sets)?)?;
        let outcome = climb(Arc::new(scene), plan, 1)?;
        Ok(Told {
            scene: self.scene,
            slide_roll: self.slide_roll,
            phase_deg: self.phase_deg,
            summary: outcome.summary,
        })
    }
}

/// Runs them, those whose name holds `only` if that is given, so many at a time.
///
/// # Errors
/// [`StudyError`] when a run fails, or when none has that in its name.
pub fn story(
    extent: Extent,
    only: Option<&str>,
    threads: usize,
    progress: &mut StudyProgress,
) -> Result<Vec<Told>, StudyError> {
    let mut asked = Asked::all(extent);
    asked.retain(|one| only.is_none_or(|only| one.name().contains(only)));
    refuse_nothing(only, asked.is_empty())?;
    run_all(&asked, threads, Asked::name, Asked::run, progress)
}

/// What the first scene shows: how many times shorter it lives at S = .5 than at 0, and by how much the longest life
/// beyond exceeds the upper end of the band at .5. `None`: not all of it was run.
pub fn shown(told: &[Told]) -> Option<[f64; 2]> {
    let own = told
        .iter()
        .filter(|one| one.scene == presets::DEFAULT && one.phase_deg.is_none());
    let at = |s: f64| own.clone().find(|one| one.slide_roll == s);
    let half = at(0.5)?;
    let fall = at(0.0)?.summary.life_relative? / half.summary.life_relative?;
    let beyond = own.clone().filter(|one| one.slide_roll > 0.5);
    // A band of its own may reach down into that at S = .5.
    let beyond = beyond.map(|one| one.summary.life_relative_low.unwrap_or(f64::NAN));
    let rise = beyond.fold(0.0, f64::max) / half.summary.life_relative_high?;
    Some([fall, rise])
}

/// Life and band on a mesh of the ladder; of a run on one mesh, its own.
fn life(told: &Told, rung: usize) -> String {
    let s = &told.summary;
    let (mesh, numbers) = match s.rungs.get(rung) {
        Some(r) => (
            format!("{}²: ", r.nodes),
            [r.life_relative, r.life_relative_low, r.life_relative_high],
        ),
        None if rung == 0 => (
            String::new(),
            [s.life_relative, s.life_relative_low, s.life_relative_high],
        ),
        None => return "-".to_owned(),
    };
    let [life, low, high] = numbers.map(figure);
    format!("{mesh}{life} ({low} to {high})")
}

/// The report.
pub fn story_report(told: &[Told]) -> Report {
    type Cell = fn(&Told) -> String;
    let columns: [(&'static str, Cell); 14] = [
        ("scene", |t| t.scene.to_owned()),
        ("S", |t| t.slide_roll.to_string()),
        ("phase", |t| {
            t.phase_deg
                .map_or_else(|| "the scene's".to_owned(), |deg| deg.to_string())
        }),
        ("life, first mesh", |t| life(t, 0)),
        ("second", |t| life(t, 1)),
        ("third", |t| life(t, 2)),
        ("by the paper's count", |t| figure(t.summary.life_global)),
        ("takes it", |t| {
            t.summary
                .life_cause
                .map_or("-", |cause| cause.words())
                .to_owned()
        }),
        ("peaks", |t| figure(t.summary.peak_factor)),
        ("traction", |t| figure(t.summary.traction_factor)),
        ("own cycles", |t| {
            figure(
                t.summary
                    .cycle_factor
                    .zip(t.summary.basis_factor)
                    .map(|(all, basis)| all / basis),
            )
        }),
        ("body", |t| {
            t.summary
                .life_body
                .map_or_else(|| "-".to_owned(), |body| body.to_string())
        }),
        ("counted, expected", |t| {
            let s = &t.summary;
            let (counted, expected) = match s.life_body {
                Some(2) => (s.n_counted_body_2, s.n_body_2),
                _ => (s.n_counted_body_1, s.n_body_1),
            };
            format!("{}, {}", figure(counted), figure(expected))
        }),
        ("seconds", |t| figure(Some(t.summary.wall_s))),
    ];
    let table = MarkdownTable::of(told, &columns);
    let shown = shown(told);
    let passes = shown.is_none_or(|[fall, rise]| fall >= FALL && rise <= 1.0);
    let words = shown.map_or_else(String::new, |[fall, rise]| {
        format!(
            "\nFrom S = 0 to 0.5 the life falls {} times (at least {FALL} are asked for). The lowest end of a band beyond S = 0.5 is \
             at most {} of the upper end of that at 0.5 (at most 1 is). At S = 0 the same crests meet all the way: the rows with a \
             phase say what another one does to the life.\n",
            figure(Some(fall)),
            figure(Some(rise)),
        )
    });
    Report {
        title: "Story",
        text: format!("{}{words}", table.markdown()),
        table,
        plots: Vec::new(),
        passes,
    }
}
