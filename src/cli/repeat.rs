//! `asperity run --from FILE.rrd`: the run that a recording shows, once more.

use std::path::Path;

#[cfg(feature = "rerun")]
use asperity_session::run::Command;
use asperity_session::run::HandTurn;

use super::args::RunArgs;
use super::failure::Failure;
use super::scenes::Prepared;

/// How a recorded run went.
pub(crate) struct Repetition {
    /// The scene of the recording.
    pub(crate) prepared: Prepared,
    /// Knobs turned by hand.
    pub(crate) turns: Vec<HandTurn>,
    /// The last step that was recorded.
    pub(crate) last_step: u64,
    /// Whether the recording breaks off: its run went on, nobody knows how far.
    pub(crate) broken_off: bool,
}

impl Repetition {
    /// Whether it is a run of the scene and nothing else, from beginning to end.
    pub(crate) fn is_plain(&self) -> bool {
        self.turns.is_empty() && !self.broken_off && self.last_step == self.prepared.plan.steps
    }
}

/// Reads the recording.
#[cfg(feature = "rerun")]
pub(crate) fn read(path: &Path, args: &RunArgs) -> Result<Repetition, Failure> {
    use super::failure::tell;
    use asperity_engine::scene::Scene;
    use asperity_engine::sim::Knob;
    use asperity_recorder::Recorded;
    use miette::miette;

    let recorded = Recorded::read(path).map_err(|error| {
        Failure::input(miette!(
            help = "asperity run and asperity explore write recordings that can be repeated",
            "{error}"
        ))
    })?;
    let program = asperity_session::program::PROGRAM;
    if recorded.program != program {
        let by = &recorded.program;
        tell(&format!(
            "recorded by {by}; this is {program}, so numbers may differ"
        ));
    }
    let scene = Scene::from_toml(&recorded.scene_toml)?;
    let mut turns = Vec::with_capacity(recorded.turns.len());
    for turn in recorded.turns {
        let knob = Knob::from_key(&turn.key).ok_or_else(|| {
            Failure::input(miette!(
                "{}: turns {}, which this version cannot turn",
                path.display(),
                turn.key
            ))
        })?;
        turns.push(HandTurn {
            steps_made: turn.steps_made,
            command: Command::Set(knob, turn.value),
        });
    }
    if let Some(words) = &recorded.broken_off {
        tell(&format!(
            "{}: {words}; its run is repeated up to there",
            path.display()
        ));
    }
    if let Some(words) = &recorded.damage {
        tell(&format!(
            "{}: damaged: {words}; what is needed to repeat its run is intact",
            path.display()
        ));
    }
    let stem = path
        .file_stem()
        .map_or("scene".into(), |stem| stem.to_string_lossy());
    let prepared = super::scenes::finish(args, scene, format!("{stem}-again"))?;
    judge_length(path, &prepared, recorded.last_step)?;
    Ok(Repetition {
        prepared,
        turns,
        last_step: recorded.last_step,
        broken_off: recorded.broken_off.is_some(),
    })
}

/// Refuses more steps than the longest run of the scene has, and tells when it has more than the scene asks for.
#[cfg(feature = "rerun")]
fn judge_length(path: &Path, prepared: &Prepared, steps: u64) -> Result<(), Failure> {
    /// Longest run that a scene may ask for, passages.
    const LONGEST: f64 = 1e4;
    let plan = &prepared.plan;
    let most = plan.steps as f64 * LONGEST / prepared.scene.time.most_passages();
    if steps as f64 > most.max(1.0) {
        return Err(Failure::input(miette::miette!(
            "{}: {steps} steps, where the longest run of its scene has {most:.0}",
            path.display()
        )));
    }
    if steps > plan.steps {
        let seconds = plan.cost.time_s * steps as f64 / plan.steps.max(1) as f64;
        super::failure::tell(&format!(
            "repeats {steps} steps, where the scene asks for {}: about {}",
            plan.steps,
            asperity_engine::math::number::seconds(seconds)
        ));
    }
    Ok(())
}

/// Without the recorder nothing can be read.
#[cfg(not(feature = "rerun"))]
pub(crate) fn read(_path: &Path, _args: &RunArgs) -> Result<Repetition, Failure> {
    Err(Failure::without_recorder("reads no recordings"))
}
