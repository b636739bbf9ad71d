//! `--connect`, `--spawn`, `--serve`: viewers that look on while a scene runs.
#![cfg_attr(
    not(feature = "rerun"),
    expect(dead_code, reason = "nothing to show without the recorder")
)]

use std::fs::File;
use std::io::{Read as _, Seek as _, Write as _};
use std::net::{Ipv4Addr, SocketAddr, TcpListener, TcpStream, ToSocketAddrs as _};
use std::path::PathBuf;
use std::process::{Child, Command};
use std::time::{Duration, Instant};

use miette::miette;

use super::failure::Failure;
use super::view;

/// Longest wait for a viewer that was started.
const START: Duration = Duration::from_secs(30);
/// How often it is looked for.
const LOOK: Duration = Duration::from_millis(100);
/// Most memory of a viewer that was started; it forgets the oldest beyond it.
const VIEWER_MEMORY: &str = "2GB";
/// Lines of what a viewer said that are passed on.
const LINES: usize = 12;

/// The address of a viewer: `HOST:PORT`, also in the form that viewers print.
pub(crate) fn address(text: &str) -> Result<SocketAddr, Failure> {
    let bare = text
        .trim_start_matches("rerun+http://")
        .trim_end_matches("/proxy");
    bare.to_socket_addrs()
        .ok()
        .and_then(|mut found| found.next())
        .ok_or_else(|| {
            Failure::input(miette!(
                help = "such as --connect=127.0.0.1:9876; --connect alone means just that",
                "--connect={text}: no address of the form HOST:PORT"
            ))
        })
}

/// Starts a viewer of its own and waits until it listens. It stays open when the run has ended.
pub(crate) fn spawn() -> Result<SocketAddr, Failure> {
    let mut command = view::quiet_viewer("the run", "")?;
    let port = free_port()?;
    command.args(["--port", &port.to_string(), "--bind", "127.0.0.1"]);
    command.args(["--memory-limit", VIEWER_MEMORY, "--hide-welcome-screen"]);
    leave_alone(&mut command);
    let mut words = ViewerOutput::new();
    if let Some(file) = words.as_ref().and_then(|words| words.file.try_clone().ok()) {
        command.stderr(file);
    }
    let mut child = command
        .spawn()
        .map_err(|error| Failure::output(miette!("the viewer could not be started: {error}")))?;
    let address = SocketAddr::from((Ipv4Addr::LOCALHOST, port));
    wait_for(&mut child, address, words.as_mut())?;
    Ok(address)
}

/// What a viewer says, in a file: it outlives the run, and must never find its way out closed.
struct ViewerOutput {
    file: File,
    path: PathBuf,
}

impl ViewerOutput {
    /// Nothing where there is no room for it: a viewer without words is better than none.
    fn new() -> Option<Self> {
        let name = format!("asperity-viewer-{}.log", std::process::id());
        let path = std::env::temp_dir().join(name);
        let file = File::options()
            .read(true)
            .append(true)
            .create_new(true)
            .open(&path)
            .ok()?;
        Some(Self { file, path })
    }

    /// The last lines.
    fn read(&mut self) -> String {
        let mut text = Vec::new();
        let read = self
            .file
            .rewind()
            .and_then(|()| self.file.read_to_end(&mut text));
        let text = String::from_utf8_lossy(&text);
        let lines: Vec<&str> = text
            .lines()
            .filter(|line| !line.trim().is_empty())
            .collect();
        match read {
            Ok(_) => lines[lines.len().saturating_sub(LINES)..].join("\n"),
            Err(_) => String::new(),
        }
    }
}

impl Drop for ViewerOutput {
    fn drop(&mut self) {
        // Where a file that is in use cannot be removed it is left to the system's own tidying.
        drop(std::fs::remove_file(&self.path));
    }
}

/// A port of this machine that nobody uses.
pub(crate) fn free_port() -> Result<u16, Failure> {
    TcpListener::bind((Ipv4Addr::LOCALHOST, 0))
        .and_then(|listener| listener.local_addr())
        .map(|address| address.port())
        .map_err(|error| Failure::output(miette!("no free port for a viewer: {error}")))
}

/// A group of its own: Ctrl-C ends the run and not the viewer.
#[cfg(unix)]
fn leave_alone(command: &mut Command) {
    use std::os::unix::process::CommandExt as _;
    command.process_group(0);
}

#[cfg(not(unix))]
fn leave_alone(_command: &mut Command) {}

fn wait_for(
    child: &mut Child,
    address: SocketAddr,
    words: Option<&mut ViewerOutput>,
) -> Result<(), Failure> {
    let until = Instant::now() + START;
    while TcpStream::connect_timeout(&address, LOOK).is_err() {
        if let Ok(Some(status)) = child.try_wait() {
            let said = words.map(ViewerOutput::read).unwrap_or_default();
            let said = if said.is_empty() {
                said
            } else {
                format!(", and said:\n{said}")
            };
            return Err(Failure::output(miette!(
                help = format!("it needs a screen; {}", view::VERSIONS),
                "the viewer ended at once with {status}{said}"
            )));
        }
        if Instant::now() > until {
            // Its end is what was asked for; when it is gone already, so much the better.
            drop(child.kill());
            return Err(Failure::output(miette!(
                "the viewer did not listen within {} s",
                START.as_secs()
            )));
        }
        std::thread::sleep(LOOK);
    }
    Ok(())
}

/// Says where viewers may connect.
pub(crate) fn announce(port: u16) {
    let url = format!("rerun+http://127.0.0.1:{port}/proxy");
    let _ = writeln!(
        std::io::stderr(),
        "viewers may connect while it runs ({}):\n  rerun --connect {url}\n  or in a browser: {}?url={url}",
        view::VERSIONS,
        view::IN_A_BROWSER
    );
}

/// Waits for Enter, or for a signal. Without anybody to press Enter it is the signal that ends it.
#[cfg(feature = "rerun")]
pub(crate) fn wait_for_enter() {
    use std::sync::atomic::Ordering;
    use std::sync::mpsc::channel;

    super::failure::tell("viewers are served until Enter or Ctrl-C");
    let (pressed, enter) = channel();
    std::thread::spawn(move || {
        let mut line = String::new();
        match std::io::stdin().read_line(&mut line) {
            Ok(1..) => drop(pressed.send(())),
            // The end of what is no keyboard: the sender is kept.
            Ok(0) | Err(_) => std::mem::forget(pressed),
        }
    });
    let Ok(stop) = super::signals::stop_on_signals() else {
        return;
    };
    while !stop.load(Ordering::Relaxed) && enter.recv_timeout(LOOK).is_err() {}
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn addresses_are_read_in_both_forms_and_refused_in_words() {
        for text in ["127.0.0.1:9876", "rerun+http://127.0.0.1:9876/proxy"] {
            let address = address(text).map_err(|failure| failure.to_string());
            assert_eq!(address, Ok(SocketAddr::from(([127, 0, 0, 1], 9876))));
        }
        let refused = address("9876").map_err(|failure| failure.to_string());
        assert!(refused.is_err_and(|text| text.contains("HOST:PORT")));
    }

    #[cfg(unix)]
    #[test]
    fn a_viewer_that_ends_at_once_is_told() {
        let mut command = Command::new("false");
        leave_alone(&mut command);
        let port = free_port().map_err(|failure| failure.to_string());
        let (Ok(mut child), Ok(port)) = (command.spawn(), port) else {
            return;
        };
        let told = wait_for(
            &mut child,
            SocketAddr::from((Ipv4Addr::LOCALHOST, port)),
            None,
        );
        let told = told.map_err(|failure| failure.to_string());
        assert!(told.is_err_and(|text| text.contains("ended at once")));
    }
}
