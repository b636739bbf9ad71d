//! Studies: what results cost, and what they are worth. Every number is measured in the run that prints it.

pub mod accuracy;
pub mod bands;
pub mod evidence;
pub mod heat;
mod machine;
pub mod scaling;
pub mod stability;
pub mod story;
mod table;
pub mod wear;

pub use machine::machine;
pub use table::{MarkdownTable, figure};

use std::sync::Arc;

use asperity_engine::plan::Plan;
use asperity_engine::scene::{Override, Scene};
use asperity_engine::sim::Summary;
use asperity_session::run::{End, Ending, Request, Session, share_out};
use thiserror::Error;

/// How much to measure.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Extent {
    /// The least that shows every part: within about a minute.
    Quick,
    /// Some minutes.
    Usual,
    /// Everything.
    Full,
}

/// Hears the name of what is done next, how many are done, and how many there are.
pub type StudyProgress<'a> = dyn FnMut(&str, usize, usize) + 'a;

/// What a study prints, and what it leaves in files beside it.
#[derive(Debug, Clone)]
pub struct Report {
    /// Its title.
    pub title: &'static str,
    /// Markdown below the title.
    pub text: String,
    /// Its rows for other programs.
    pub table: MarkdownTable,
    /// File names and SVG.
    pub plots: Vec<(String, String)>,
    /// Whether everything is as it must be.
    pub passes: bool,
}

/// A study that could not be done.
#[derive(Debug, Clone, Error)]
pub enum StudyError {
    /// A scene of the study is not accepted: a fault of the study.
    #[error("the study's own scene is refused: {0}")]
    Scene(String),
    /// A picture could not be drawn.
    #[error("a plot could not be drawn: {0}")]
    Plot(String),
    /// Cases were asked for by a text that none has in its name.
    #[error("--only {0}: no case of this study has that in its name")]
    NoCase(String),
    /// What is done can't be kept.
    #[error("what is done can't be kept: {0}")]
    Kept(String),
    /// A run of the study failed.
    #[error("{case}: {reason}")]
    Run {
        /// Which case.
        case: String,
        /// What went wrong.
        reason: String,
    },
}

/// Refuses a choice of cases that leaves nothing.
fn refuse_nothing(only: Option<&str>, is_empty: bool) -> Result<(), StudyError> {
    match only {
        Some(part) if is_empty => Err(StudyError::NoCase(part.to_owned())),
        _ => Ok(()),
    }
}

/// A preset with keys set, such as `grid.nodes=65`.
fn scene_with(preset: &str, sets: &[String]) -> Result<Scene, String> {
    let overrides: Result<Vec<Override>, _> = sets.iter().map(|text| text.parse()).collect();
    let overrides = overrides.map_err(|error| error.to_string())?;
    Scene::load_with(preset, &overrides).map_err(|error| error.to_string())
}

/// A scene and what it is going to compute.
fn planned(scene: Scene) -> Result<(Scene, Plan), String> {
    let plan = Plan::new(&scene).map_err(|error| error.to_string())?;
    Ok((scene, plan))
}

/// Runs all that is asked, so many at a time, each heard of by its name.
///
/// # Errors
/// [`StudyError::Run`] of the first that fails.
fn run_all<A: Sync, R: Send>(
    asked: &[A],
    threads: usize,
    name: impl Fn(&A) -> String,
    run: impl Fn(&A) -> Result<R, String> + Sync,
    progress: &mut StudyProgress,
) -> Result<Vec<R>, StudyError> {
    let found = share_out(asked, threads, run, &mut |one: &A, begun| {
        progress(&name(one), begun, asked.len());
    });
    let named = found.into_iter().zip(asked).map(|(found, asked)| {
        found.map_err(|reason| StudyError::Run {
            case: name(asked),
            reason,
        })
    });
    named.collect()
}

/// What a finished run tells.
struct Finished {
    summary: Summary,
    frames_per_s: f64,
    seconds: f64,
}

/// A run as users make it: on each of its meshes, the time of all of them.
fn climb(scene: Arc<Scene>, plan: Plan, threads: usize) -> Result<Finished, String> {
    let request = Request {
        name: String::new(),
        scene,
        plan,
        threads,
        watchers: Vec::new(),
        ending: Ending::Passages,
    };
    let session = Session::start(request).map_err(|error| error.to_string())?;
    let outcome = session.join().map_err(|error| error.to_string())?;
    match (outcome.end, outcome.summary) {
        (End::Done, Some(summary)) => Ok(Finished {
            frames_per_s: outcome.steps_per_s.unwrap_or(f64::NAN),
            seconds: outcome.wall_s,
            summary,
        }),
        (end, _) => Err(format!("{end:?}")),
    }
}
