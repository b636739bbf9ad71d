//! A door before a served recording, which knows whether a viewer is there: the library's server does not tell.
//!
//! Viewers connect to the door's port; every connection is handed on, byte by byte, to the server's own.

use std::io::{Read as _, Write as _};
use std::net::{Ipv4Addr, Shutdown, TcpListener, TcpStream};
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, AtomicUsize, Ordering};
use std::time::{Duration, Instant};

use asperity_engine::observe::ObserveError;

/// How often it is looked who is there.
const LOOK: Duration = Duration::from_millis(50);
/// A viewer that comes back within this time has not left.
const LEFT: Duration = Duration::from_secs(2);

/// The door. It closes when it is dropped.
pub struct Gate {
    port: u16,
    behind: u16,
    shared: Arc<GateState>,
    stop: Arc<AtomicBool>,
}

#[derive(Default)]
struct GateState {
    /// Connections that stand.
    open: AtomicUsize,
    /// All that have been.
    came: AtomicUsize,
    closed: AtomicBool,
}

impl Gate {
    /// Opens a port of this machine; 0: any that is free. Waiting ends when `stop` is raised.
    ///
    /// # Errors
    /// When the port cannot be used.
    pub fn open(port: u16, stop: Arc<AtomicBool>) -> Result<Self, ObserveError> {
        let failed = |error: std::io::Error| {
            let reason =
                format!("the port cannot be used ({error}); name another with --serve=PORT");
            ObserveError::new(format!("viewers served at 127.0.0.1:{port}"), reason)
        };
        let door = TcpListener::bind((Ipv4Addr::LOCALHOST, port)).map_err(failed)?;
        let free = TcpListener::bind((Ipv4Addr::LOCALHOST, 0)).map_err(failed)?;
        let behind = free.local_addr().map_err(failed)?.port();
        drop(free);
        let port = door.local_addr().map_err(failed)?.port();
        door.set_nonblocking(true).map_err(failed)?;
        let shared = Arc::new(GateState::default());
        let own = Arc::clone(&shared);
        let keeper = move || {
            while !own.closed.load(Ordering::Relaxed) {
                match door.accept() {
                    Ok((viewer, _)) => own.hand_on(viewer, behind),
                    Err(_) => std::thread::sleep(LOOK),
                }
            }
        };
        std::thread::Builder::new()
            .name("gate".into())
            .spawn(keeper)
            .map_err(failed)?;
        Ok(Self {
            port,
            behind,
            shared,
            stop,
        })
    }

    /// The port that viewers are told.
    pub fn port(&self) -> u16 {
        self.port
    }

    /// The port that the server listens on.
    pub fn behind(&self) -> u16 {
        self.behind
    }

    /// Waits until a viewer has come.
    pub fn wait_for_one(&self) {
        while self.shared.came.load(Ordering::Relaxed) == 0 && !self.stop.load(Ordering::Relaxed) {
            std::thread::sleep(LOOK);
        }
    }

    /// Waits until all viewers have left.
    pub fn wait_until_left(&self) {
        let mut alone = Instant::now();
        while alone.elapsed() < LEFT && !self.stop.load(Ordering::Relaxed) {
            if self.shared.open.load(Ordering::Relaxed) > 0 {
                alone = Instant::now();
            }
            std::thread::sleep(LOOK);
        }
    }
}

impl Drop for Gate {
    fn drop(&mut self) {
        self.shared.closed.store(true, Ordering::Relaxed);
    }
}

impl GateState {
    /// Hands a connection on, both ways, until one side ends it. What is not a viewer says nothing and counts for none.
    fn hand_on(self: &Arc<Self>, viewer: TcpStream, behind: u16) {
        let Ok(server) = TcpStream::connect((Ipv4Addr::LOCALHOST, behind)) else {
            return;
        };
        let blocking = viewer.set_nonblocking(false);
        let (Ok(()), Ok(viewer_too), Ok(server_too)) =
            (blocking, viewer.try_clone(), server.try_clone())
        else {
            return;
        };
        let own = Arc::clone(self);
        let inward = move || {
            let mut counted = false;
            pass(viewer, server, || {
                if !std::mem::replace(&mut counted, true) {
                    own.open.fetch_add(1, Ordering::Relaxed);
                    own.came.fetch_add(1, Ordering::Relaxed);
                }
            });
            if counted {
                own.open.fetch_sub(1, Ordering::Relaxed);
            }
        };
        // A thread that cannot be had is a viewer that is not served.
        drop(std::thread::Builder::new().spawn(inward));
        drop(std::thread::Builder::new().spawn(move || pass(server_too, viewer_too, || {})));
    }
}

/// Passes bytes on to the end.
fn pass(mut from: TcpStream, mut to: TcpStream, mut passed: impl FnMut()) {
    let mut bytes = vec![0; 64 * 1024];
    while let Ok(n @ 1..) = from.read(&mut bytes) {
        passed();
        if to.write_all(&bytes[..n]).is_err() {
            break;
        }
    }
    // Both ends: the other direction has nobody to talk to either.
    drop(from.shutdown(Shutdown::Both));
    drop(to.shutdown(Shutdown::Both));
}
