//! `asperity view`: hands a recording to the Rerun viewer.

use std::ffi::OsStr;
use std::io::Write as _;
use std::path::{Path, PathBuf};
use std::process::{Command, Stdio};

use miette::miette;

use super::failure::Failure;

/// Which viewers open what this program records.
pub(crate) const VERSIONS: &str = "viewers of version 0.36.3 and newer open it, tried up to 0.41";

/// The viewer in a browser, of the version that recordings are made for.
pub(crate) const IN_A_BROWSER: &str = "https://app.rerun.io/version/0.36.3/";

/// How to get such a viewer, without installing it first.
fn how_to_get_it(arguments: &str) -> String {
    format!(
        "the viewer is a program of its own; {VERSIONS}. One line starts it without installing anything for good:\n  \
         uvx --from rerun-sdk==0.36.3 rerun{arguments}\n  \
         pipx run --spec rerun-sdk==0.36.3 rerun{arguments}\n\
         Or install it, so that `rerun` is on the PATH, by one of\n  \
         pip install rerun-sdk==0.36.3\n  \
         cargo install rerun-cli --locked --version 0.36.3\n\
         A recording can also be opened in a browser at {IN_A_BROWSER}"
    )
}

/// Opens `file` in the viewer and waits until it is closed. What the viewer has to say goes to stderr.
pub(crate) fn view(file: &Path) -> Result<u8, Failure> {
    if let Err(error) = asperity_engine::files::open_plain(file) {
        return Err(Failure::input(miette!(
            help = "asperity run writes a recording; asperity explore too",
            "cannot read the recording {}: {error}",
            file.display()
        )));
    }
    let mut viewer = command(file)?;
    let note = format!(
        "opening {} in {}; {VERSIONS}",
        file.display(),
        viewer.get_program().display()
    );
    // A terminal that is gone reads nothing; the viewer opens all the same.
    let _ = writeln!(std::io::stderr(), "{note}");
    let status = viewer
        .stderr(Stdio::inherit())
        .status()
        .map_err(|error| Failure::input(miette!("the viewer could not be started: {error}")))?;
    if status.success() {
        Ok(0)
    } else {
        Err(Failure::input(miette!(
            help = format!(
                "what it said stands above; `rerun --version` tells which one it is: {VERSIONS}. It needs a screen; \
                 without one use the browser: {IN_A_BROWSER}"
            ),
            "the viewer ended with {status}"
        )))
    }
}

/// The viewer on `file`, with its output kept off the terminal, or how to get it.
pub(crate) fn command(file: &Path) -> Result<Command, Failure> {
    let mut command = quiet_viewer(&file.display().to_string(), &format!(" {}", quoted(file)))?;
    command.arg(file);
    Ok(command)
}

/// The viewer with its output kept off the terminal, or how to get it. `what`: what it should show; `arguments`: how it
/// would be started by hand.
pub(crate) fn quiet_viewer(what: &str, arguments: &str) -> Result<Command, Failure> {
    let Some(viewer) = find("rerun", std::env::var_os("PATH").as_deref()) else {
        return Err(Failure::input(miette!(
            help = how_to_get_it(arguments),
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

/// A path as a shell takes it.
fn quoted(file: &Path) -> String {
    let text = file.display().to_string();
    let plain = |c: char| c.is_ascii_alphanumeric() || "/._-+=:".contains(c);
    if text.chars().all(plain) {
        text
    } else {
        format!("'{}'", text.replace('\'', "'\\''"))
    }
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
