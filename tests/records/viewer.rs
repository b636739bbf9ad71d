//! `--spawn`: a viewer that is missing, one that ends at once, one that listens. The viewers are stand-ins on the
//! PATH of the program under test.
#![cfg(all(unix, feature = "rerun"))]
#![expect(clippy::unwrap_used, reason = "tests")]

use std::io::Read as _;
use std::net::{Ipv4Addr, TcpListener};
use std::os::unix::fs::PermissionsExt as _;
use std::path::Path;
use std::process::{Command, Output, Stdio};
use std::time::Duration;

/// Half a passage on a coarse grid, shown and not recorded.
const SHOWN: [&str; 9] = [
    "run",
    "--set=grid.nodes=33",
    "--set=body_1.surface.kind=smooth",
    "--set=body_2.surface.kind=smooth",
    "--threads=1",
    "--passages=0.5",
    "--no-record",
    "--spawn",
    "--force",
];

/// Runs with nothing but `folder` on the PATH.
fn shown(folder: &Path) -> Output {
    Command::new(env!("CARGO_BIN_EXE_asperity"))
        .args(SHOWN)
        .current_dir(folder)
        .env("PATH", folder)
        .stdin(Stdio::null())
        .output()
        .unwrap()
}

/// Puts a program named `rerun` into the folder.
fn viewer(folder: &Path, script: &str) {
    let path = folder.join("rerun");
    std::fs::write(&path, format!("#!/bin/sh\n{script}\n")).unwrap();
    std::fs::set_permissions(&path, std::fs::Permissions::from_mode(0o755)).unwrap();
}

fn says(output: &Output, words: &[&str]) {
    let stderr = String::from_utf8_lossy(&output.stderr);
    for word in words {
        assert!(stderr.contains(word), "{word:?} is missing in {stderr}");
    }
    assert!(!stderr.contains("panicked"), "{stderr}");
}

#[test]
fn a_missing_viewer_is_told_with_how_to_get_it() {
    let folder = tempfile::tempdir().unwrap();
    let output = shown(folder.path());
    assert_eq!(output.status.code(), Some(1));
    says(
        &output,
        &[
            "no Rerun viewer",
            "on the PATH",
            "0.36.3 and newer",
            "tried up to 0.41",
            "uvx --from rerun-sdk==0.36.3 rerun",
            "pipx run --spec rerun-sdk==0.36.3 rerun",
            "pip install rerun-sdk==0.36.3",
            "cargo install rerun-cli",
            "app.rerun.io/version/0.36.3",
        ],
    );
}

#[test]
fn a_viewer_that_ends_at_once_is_told_before_anything_runs() {
    let folder = tempfile::tempdir().unwrap();
    viewer(folder.path(), "echo 'no adapter found' >&2; exit 3");
    let output = shown(folder.path());
    assert_eq!(output.status.code(), Some(4));
    says(
        &output,
        &[
            "the viewer ended at once",
            "exit status: 3",
            "no adapter found",
            "0.36.3 and newer",
        ],
    );
}

/// Runs `asperity view`.
fn opened(folder: &Path, file: &str) -> Output {
    Command::new(env!("CARGO_BIN_EXE_asperity"))
        .args(["view", file])
        .current_dir(folder)
        .env("PATH", folder)
        .stdin(Stdio::null())
        .output()
        .unwrap()
}

#[test]
fn view_passes_on_what_the_viewer_says() {
    let folder = tempfile::tempdir().unwrap();
    std::fs::write(folder.path().join("run.rrd"), "").unwrap();
    viewer(folder.path(), "echo \"cannot draw $1\" >&2; exit 3");
    let output = opened(folder.path(), "run.rrd");
    assert_eq!(output.status.code(), Some(1));
    let words = [
        "cannot draw run.rrd",
        "exit status: 3",
        "0.36.3 and newer",
        "tried up to 0.41",
    ];
    says(&output, &words);
    viewer(folder.path(), "exit 0");
    let output = opened(folder.path(), "run.rrd");
    assert_eq!(output.status.code(), Some(0));
    says(&output, &["opening run.rrd", "0.36.3 and newer"]);
}

#[test]
fn without_a_viewer_view_gives_the_line_that_starts_one() {
    let folder = tempfile::tempdir().unwrap();
    std::fs::write(folder.path().join("my run.rrd"), "").unwrap();
    let output = opened(folder.path(), "my run.rrd");
    assert_eq!(output.status.code(), Some(1));
    let words = [
        "uvx --from rerun-sdk==0.36.3 rerun 'my run.rrd'",
        "pipx run --spec rerun-sdk==0.36.3 rerun 'my run.rrd'",
        "https://app.rerun.io/version/0.36.3/",
    ];
    says(&output, &words);
}

/// The viewer is this test's own program, which runs [`stand_in`] below.
#[test]
fn a_viewer_that_listens_is_sent_the_run() {
    let folder = tempfile::tempdir().unwrap();
    let got = folder.path().join("got");
    viewer(
        folder.path(),
        &format!(
            "WORDS=\"$*\" GOT='{}' exec '{}' --exact viewer::stand_in --ignored --nocapture",
            got.display(),
            std::env::current_exe().unwrap().display()
        ),
    );
    let output = shown(folder.path());
    assert_eq!(
        output.status.code(),
        Some(0),
        "{}",
        String::from_utf8_lossy(&output.stderr)
    );
    // HTTP/2's first words: what a viewer is spoken to in.
    let first = std::fs::read_to_string(&got).unwrap();
    assert_eq!(first, "PRI * HTTP/2.0");
}

/// Listens on the port that it is told, keeps the first words, and closes.
#[test]
#[ignore = "the viewer of a_viewer_that_listens_is_sent_the_run"]
fn stand_in() {
    let words = std::env::var("WORDS").unwrap();
    let mut words = words.split(' ').skip_while(|word| *word != "--port");
    let port: u16 = words.nth(1).unwrap().parse().unwrap();
    let listener = TcpListener::bind((Ipv4Addr::LOCALHOST, port)).unwrap();
    let mut first = [0; 14];
    // The program looks twice whether somebody listens before it speaks.
    for _ in 0..4 {
        let (mut stream, _) = listener.accept().unwrap();
        stream
            .set_read_timeout(Some(Duration::from_secs(20)))
            .unwrap();
        if stream.read_exact(&mut first).is_ok() {
            let got = std::env::var_os("GOT").unwrap();
            std::fs::write(got, first).unwrap();
            return;
        }
    }
    panic!("nobody spoke");
}
