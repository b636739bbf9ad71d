//! What the explorer's `w` writes: the frame on the screen as fields (npz), pictures (png) and tables (csv), with
//! its scene, into a folder of its own. It takes a part of a second, so it is done on a thread.

use std::path::{Path, PathBuf};
use std::sync::Arc;
use std::sync::mpsc::{Receiver, channel};

use asperity_engine::observe::{
    Began, ObserveError, Observer as _, Overwrite, RunContext, is_free,
};
use asperity_explorer::tui::{Shown, WriteShown};
use asperity_picture::export::{Export, Format};

use super::scenes::Prepared;

/// A writer for a scene's frames.
pub(crate) fn writer(prepared: &Prepared) -> WriteShown {
    let name = format!("{}-shown", prepared.name);
    let context = RunContext {
        scene_toml: String::new(),
        plan_text: prepared.plan.to_string(),
        program: asperity_session::program::PROGRAM.to_owned(),
        began: Began::default(),
        scene: Arc::clone(&prepared.scene),
    };
    Box::new(move |shown| in_background(name.clone(), context.clone(), shown))
}

fn in_background(
    name: String,
    context: RunContext,
    shown: Shown,
) -> Receiver<Result<String, String>> {
    let (answer, heard) = channel();
    let refused = answer.clone();
    let started = std::thread::Builder::new()
        .name("files".to_owned())
        .spawn(move || {
            let written = write(&name, context, &shown);
            let said = written.map(|folder| format!("written into {}", folder.display()));
            // A screen that is gone hears nothing.
            let _ = answer.send(said.map_err(|error| error.to_string()));
        });
    if let Err(error) = started {
        let _ = refused.send(Err(format!("nothing was written: {error}")));
    }
    heard
}

fn write(name: &str, mut context: RunContext, shown: &Shown) -> Result<PathBuf, ObserveError> {
    let folder = numbered(Path::new("."), name, "")
        .ok_or_else(|| ObserveError::new(name, "no free folder name".to_owned()))?;
    context.scene_toml.clone_from(&shown.scene_toml);
    let mut export = Export::create(&folder, Overwrite::Refuse, &[Format::Npz, Format::Png])?;
    export.begin(&context)?;
    export.frame(&shown.frame)?;
    export.finish()?;
    for (file, text) in &shown.tables {
        Overwrite::Refuse.write(&folder.join(file), text.as_bytes())?;
    }
    Ok(folder)
}

/// `name-001.ext` or the next number that is free; without an extension a folder.
pub(super) fn numbered(folder: &Path, name: &str, extension: &str) -> Option<PathBuf> {
    let dot = if extension.is_empty() { "" } else { "." };
    (1..100_000)
        .map(|number| folder.join(format!("{name}-{number:03}{dot}{extension}")))
        .find(|path| is_free(path))
}
