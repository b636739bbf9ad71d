//! `asperity scenes` and `asperity check`, and how the other commands get their scene.

use std::io::{ErrorKind, Write as _};
use std::path::Path;
use std::sync::Arc;

use asperity_engine::observe::ObserveError;
use asperity_engine::plan::{LeftHeat, Plan};
use asperity_engine::scene::{Override, Record, Scene, SceneError, presets};

use super::args::{RunArgs, SceneArgs};
use super::failure::{Failure, visible};

/// A scene and its plan.
pub(crate) struct Prepared {
    /// Name for files and the summary.
    pub(crate) name: String,
    pub(crate) scene: Arc<Scene>,
    pub(crate) plan: Plan,
}

/// Reads the scene with what was set on the command line.
fn load(args: &SceneArgs) -> Result<Scene, SceneError> {
    let mut overrides = args
        .settings
        .iter()
        .map(|text| text.parse())
        .collect::<Result<Vec<Override>, _>>()?;
    if let Some(passages) = args.passages {
        overrides.push(Override::number("time.passages", passages)?);
    }
    if let Some(cycles) = args.cycles {
        overrides.push(Override::number("age.cycles", cycles)?);
    }
    if let Some(nodes) = args.nodes {
        overrides.push(format!("grid.nodes={nodes}").parse()?);
    }
    match args.scene.to_str() {
        Some(name) => Scene::load_with(name, &overrides),
        // A path that is no text is no preset's name.
        None => Scene::load_file_with(Path::new(&args.scene), &overrides),
    }
}

/// The scene to run, with a recording only if there will be one, and its plan.
pub(crate) fn prepare(args: &RunArgs) -> Result<Prepared, Failure> {
    let scene = load(&args.scene)?;
    let name = Path::new(&args.scene.scene).file_stem().map_or_else(
        || "scene".to_owned(),
        |stem| stem.to_string_lossy().into_owned(),
    );
    finish(args, scene, name)
}

/// Same for a scene that is there already.
pub(crate) fn finish(args: &RunArgs, mut scene: Scene, name: String) -> Result<Prepared, Failure> {
    if args.no_record || !cfg!(feature = "rerun") {
        scene.record = None;
    } else if args.out.is_some() && scene.record.is_none() {
        scene.record = Some(Record::default());
    }
    let plan = Plan::new(&scene)?;
    Ok(Prepared {
        name,
        scene: Arc::new(scene),
        plan,
    })
}

/// Prints the plan, and what the scene says of where its numbers come from.
pub(crate) fn check(args: &SceneArgs) -> Result<u8, Failure> {
    let scene = load(args)?;
    let plan = Plan::new(&scene)?;
    let mut text = plan.to_string();
    if let Some(heat) = LeftHeat::new(&scene, &plan) {
        text.push_str("\nHeat, left out: by closed forms\n");
        for line in heat.lines() {
            for part in ["  ", &line, "\n"] {
                text.push_str(part);
            }
        }
    }
    let mut lines = scene.about.trim().lines().peekable();
    if lines.peek().is_some() {
        text.push_str("\nThe scene says\n");
    }
    for line in lines {
        text.push_str("  ");
        text.push_str(line);
        text.push('\n');
    }
    print(&text)?;
    Ok(0)
}

/// Lists the presets, or prints one.
pub(crate) fn scenes(name: Option<&str>) -> Result<u8, Failure> {
    if let Some(name) = name {
        print(&Scene::load(name)?.to_toml())?;
        return Ok(0);
    }
    let width = presets::listed().map(|preset| preset.name.len()).max();
    let mut text = String::new();
    for preset in presets::listed() {
        let scene = Scene::load(preset.name)?;
        let line = format!(
            "{:width$}  {}\n",
            preset.name,
            scene.title,
            width = width.unwrap_or(0)
        );
        text.push_str(&line);
    }
    text.push_str(
        "\nasperity scenes NAME prints one as TOML, every key explained: a copy to edit.\n",
    );
    print(&text)?;
    Ok(0)
}

/// Writes lines as they are made, until the reader has gone away.
pub(crate) fn print_lines<E>(lines: impl Iterator<Item = Result<String, E>>) -> Result<(), Failure>
where
    Failure: From<E>,
{
    for line in lines {
        if !print_while_read(&line?)? {
            break;
        }
    }
    Ok(())
}

/// Writes to stdout, such that no terminal takes it for more than text; a reader that has gone away (`| head`) is no
/// error.
pub(crate) fn print(text: &str) -> Result<(), ObserveError> {
    print_while_read(text).map(|_| ())
}

/// Same; whether there still is a reader.
fn print_while_read(text: &str) -> Result<bool, ObserveError> {
    let mut out = std::io::stdout().lock();
    let written = out.write_all(visible(text).as_bytes());
    match written.and_then(|()| out.flush()) {
        Ok(()) => Ok(true),
        Err(error) if error.kind() == ErrorKind::BrokenPipe => Ok(false),
        Err(error) => Err(ObserveError::new("stdout", error.to_string())),
    }
}
