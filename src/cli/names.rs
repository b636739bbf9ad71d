//! No output of a run is an input of it or another output, however its path is spelled.

use std::path::{Path, PathBuf};

use asperity_engine::files::identity;
use asperity_engine::scene::{Scene, Surface, presets};
use asperity_picture::export::is_exported;
use miette::miette;

use super::args::{HeadlessArgs, RunArgs};
use super::failure::Failure;

/// A file of a run: what it is for, and where.
type Named = (String, PathBuf);

/// Files that a run reads and writes.
#[derive(Default)]
pub(crate) struct Names {
    inputs: Vec<Named>,
    outputs: Vec<Named>,
    export: Option<PathBuf>,
}

impl Names {
    /// Those of a run of `scene` that records to `recording`, if it does.
    pub(crate) fn of(args: &RunArgs, scene: &Scene, recording: &Path) -> Self {
        let mut names = Self {
            export: args.export.clone(),
            ..Self::default()
        };
        if presets::find(&args.scene.name()).is_none() {
            names.reads("the scene", Some(Path::new(&args.scene.scene)));
        }
        for surface in scene.surfaces() {
            match surface {
                Surface::HeightMap { file, .. } => {
                    names.reads("a height map", Some(Path::new(file)));
                }
                Surface::Smooth {} | Surface::Sinusoid { .. } | Surface::Random(_) => {}
            }
        }
        let recording = scene.record.is_some().then_some(recording);
        names.writes("the recording", recording);
        names.writes("--table", args.table.as_deref());
        let summary = args.summary.as_deref();
        names.writes("--summary", summary.filter(|path| path.as_os_str() != "-"));
        names
    }

    /// Those of a run without a screen, too.
    pub(crate) fn with_states(mut self, args: &HeadlessArgs) -> Self {
        self.reads("--from", args.from.as_deref());
        self.reads("--from-state", args.from_state.as_deref());
        self.writes("--save-state", args.save_state.as_deref());
        self
    }

    fn reads(&mut self, what: &str, path: Option<&Path>) {
        let named = |path: &Path| (what.to_owned(), path.to_owned());
        self.inputs.extend(path.map(named));
    }

    fn writes(&mut self, what: &str, path: Option<&Path>) {
        let named = |path: &Path| (what.to_owned(), path.to_owned());
        self.outputs.extend(path.map(named));
    }

    /// Refuses a run that would write one file twice, or one that it reads.
    pub(crate) fn check(&self) -> Result<(), Failure> {
        for (k, output) in self.outputs.iter().enumerate() {
            for other in self.inputs.iter().chain(&self.outputs[..k]) {
                if are_one(&output.1, &other.1) {
                    return Err(clash(output, other));
                }
            }
        }
        let Some(folder) = &self.export else {
            return Ok(());
        };
        let real = identity(folder);
        let export = ("--export".to_owned(), folder.clone());
        for other in self.inputs.iter().chain(&self.outputs) {
            let path = identity(&other.1);
            let name = path.file_name().unwrap_or_default().to_string_lossy();
            if path == real || (path.parent() == Some(real.as_path()) && is_exported(&name)) {
                return Err(clash(&export, other));
            }
        }
        Ok(())
    }
}

/// Whether both paths lead to one plain file, or will. A device may be written by many.
fn are_one(one: &Path, other: &Path) -> bool {
    let is_device = |path: &Path| path.exists() && !path.is_file();
    identity(one) == identity(other) && !is_device(one)
}

fn clash(output: &Named, other: &Named) -> Failure {
    Failure::input(miette!(
        help = "give every output a name of its own, and none that of a file that is read",
        "{} {} is {} ({})",
        output.0,
        output.1.display(),
        other.0,
        other.1.display()
    ))
}
