//! `asperity view`: hands a recording to the Rerun viewer.

use std::ffi::OsStr;
use std::path::{Path, PathBuf};
use std::process::{Command, Stdio};

use miette::miette;

use super::failure::Failure;

/// How to get the viewer that reads this version's recordings.
const HOW_TO_GET_IT: &str = "the viewer is a program of its own; get it by one of\n  \
    pip install rerun-sdk==0.36.3\n  \
    cargo install rerun-cli --locked --version 0.36.3\n\
    and see that `rerun` is on the PATH. A recording can also be opened at https://app.rerun.io";

/// Opens `file` in the viewer and waits until it is closed.
pub(crate) fn view(file: &Path) -> Result<u8, Failure> {
    if let Err(error) = asperity::files::open_plain(file) {
        return Err(Failure::input(miette!(
            help = "asperity run writes a recording; asperity explore too",
            "cannot read the recording {}: {error}",
            file.display()
        )));
    }
    let status = command(file)?
        .status()
        .map_err(|error| Failure::input(miette!("the viewer could not be started: {error}")))?;
    if status.success() {
        Ok(0)
    } else {
        Err(Failure::input(miette!(
            help =
                "recordings need the viewer of the same version: rerun --version should say 0.36.3",
            "the viewer ended with {status}"
        )))
    }
}

/// The viewer on `file`, with its output kept off the terminal, or how to get it.
pub(crate) fn command(file: &Path) -> Result<Command, Failure> {
    let mut command = quiet_viewer(&file.display().to_string())?;
    command.arg(file);
    Ok(command)
}

/// The viewer with its output kept off the terminal, or how to get it. `what`: what it should show.
pub(crate) fn quiet_viewer(what: &str) -> Result<Command, Failure> {
    let Some(viewer) = find("rerun", std::env::var_os("PATH").as_deref()) else {
        return Err(Failure::input(miette!(
            help = HOW_TO_GET_IT,
            "no Rerun viewer (`rerun`) on the PATH to show {what}"
        )));
    };
    let mut command = Command::new(viewer);
    command
        .stdin(Stdio::null())
        .stdout(Stdio::null())
        .stderr(Stdio::null());
    Ok(command)
}

fn find(program: &str, path: Option<&OsStr>) -> Option<PathBuf> {
    let name = format!("{program}{}", std::env::consts::EXE_SUFFIX);
    std::env::split_paths(path?)
        .map(|folder| folder.join(&name))
        .find(|candidate| candidate.is_file())
}

#[cfg(test)]
mod tests {
    #![expect(clippy::unwrap_used, reason = "tests")]
    use super::*;

    #[test]
    fn finds_a_program_on_the_path_only() {
        let folder = tempfile::tempdir().unwrap();
        let path = std::env::join_paths([Path::new("/nonexistent"), folder.path()]).unwrap();
        assert_eq!(find("viewer", Some(&path)), None);
        let program = folder
            .path()
            .join(format!("viewer{}", std::env::consts::EXE_SUFFIX));
        std::fs::write(&program, "").unwrap();
        assert_eq!(find("viewer", Some(&path)), Some(program));
        assert_eq!(find("viewer", None), None);
    }
}
