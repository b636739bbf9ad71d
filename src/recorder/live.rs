//! A recording that goes to a viewer instead of a file: one that runs already, or whoever connects to us.
//!
//! Such a stream may stall for as long as the viewer does, so it never shares a stream with a file: it has its
//! own recorder behind a queue that drops frames and counts them
//! ([`Queue::spawn_live`](asperity_session::Queue::spawn_live)). A viewer that is closed is no failure of the
//! run: nothing more is sent, and the report says so.

use std::cell::{Cell, RefCell};
use std::io::{Read as _, Write as _};
use std::net::{SocketAddr, TcpListener, TcpStream};
use std::sync::Arc;
use std::time::Duration;

use rerun::external::re_uri::ProxyUri;
use rerun::log::LogMsg;
use rerun::sink::{GrpcSink, GrpcSinkConnectionState, LogSink, SinkFlushError};
use rerun::{
    MemoryLimit, PlaybackBehavior, RecordingStream, RecordingStreamBuilder, ServerOptions,
};

use super::moment::check_clock;
use asperity_engine::observe::ObserveError;

/// Longest wait for a viewer to take the connection.
const PATIENCE: Duration = Duration::from_secs(2);
/// What is kept for viewers that connect late, bytes; the oldest goes first.
const HISTORY: u64 = 256 * 1024 * 1024;
/// Only this machine: a recording is nobody else's business unless somebody forwards the port.
const HOME: &str = "127.0.0.1";

/// Where a live recording goes.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Live {
    /// To the viewer that listens there.
    Connect(SocketAddr),
    /// To whoever connects to this port of this machine (127.0.0.1).
    Serve(u16),
}

impl std::fmt::Display for Live {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        match self {
            Self::Connect(address) => write!(f, "viewer at {address}"),
            Self::Serve(port) => write!(f, "viewers served at {HOME}:{port}"),
        }
    }
}

/// What a viewer is told to open.
pub(crate) fn url(address: impl std::fmt::Display) -> String {
    format!("rerun+http://{address}/proxy")
}

/// The connection, as far as it can be asked.
pub(crate) enum Link {
    /// To a viewer.
    Viewer {
        sink: Arc<GrpcSink>,
        greeting: Greeting,
        /// It had taken everything when it was closed.
        took_all: Cell<bool>,
    },
    /// Viewers come and go.
    Server,
}

impl Link {
    /// Whether the viewer has been closed or has broken off.
    pub(crate) fn is_gone(&self) -> bool {
        match self {
            Self::Viewer { sink, .. } => {
                matches!(sink.status(), GrpcSinkConnectionState::Disconnected(_))
            }
            Self::Server => false,
        }
    }

    /// Whether the viewer has ever answered.
    pub(crate) fn has_answered(&self) -> bool {
        match self {
            Self::Viewer { greeting, .. } => greeting.is_answered(),
            Self::Server => true,
        }
    }

    /// All has been sent; `took_all`: and taken.
    pub(crate) fn note_end(&self, took: bool) {
        if let Self::Viewer { took_all, .. } = self {
            took_all.set(took);
        }
    }

    /// Whether all that was sent was taken.
    pub(crate) fn took_all(&self) -> bool {
        match self {
            Self::Viewer { took_all, .. } => took_all.get(),
            Self::Server => true,
        }
    }
}

/// A greeting of HTTP/2, on a connection of its own: something takes connections at many a port and is no viewer, and
/// the library calls it connected as soon as it has been taken.
pub(crate) struct Greeting(RefCell<Option<TcpStream>>);

impl Greeting {
    /// Says hello on a connection that stands.
    fn send(mut stream: TcpStream) -> Self {
        /// The client's preface and its empty settings (RFC 9113, 3.4); a server answers with its own settings.
        const HELLO: &[u8] = b"PRI * HTTP/2.0\r\n\r\nSM\r\n\r\n\0\0\0\x04\0\0\0\0\0";
        let sent = stream
            .set_nonblocking(true)
            .and_then(|()| stream.write_all(HELLO));
        // Nobody to be heard of is nobody to be asked.
        Self(RefCell::new(sent.ok().map(|()| stream)))
    }

    /// Whether an answer has come. Once it has the connection is closed.
    fn is_answered(&self) -> bool {
        let mut stream = self.0.borrow_mut();
        let answer = stream.as_mut().map(|stream| stream.read(&mut [0; 9]));
        match answer {
            None => true,
            Some(Ok(n)) if n > 0 => {
                *stream = None;
                true
            }
            _ => false,
        }
    }
}

/// The sink of a viewer, which the recorder keeps to ask how it is.
struct ToViewer(Arc<GrpcSink>);

impl LogSink for ToViewer {
    fn send(&self, message: LogMsg) {
        self.0.send(message);
    }

    fn flush_blocking(&self, timeout: Duration) -> Result<(), SinkFlushError> {
        self.0.flush_blocking(timeout)
    }
}

/// Opens the stream, or says why there is nobody to send to.
pub(crate) fn open(
    live: Live,
    builder: RecordingStreamBuilder,
) -> Result<(RecordingStream, Link), ObserveError> {
    let failed = |reason: String| ObserveError::new(live.to_string(), reason);
    check_clock().map_err(failed)?;
    match live {
        Live::Connect(address) => {
            // The library would return Ok, fill its buffers, and then block for ever.
            let stream = TcpStream::connect_timeout(&address, PATIENCE).map_err(|error| {
                failed(format!(
                    "no viewer listens there ({error}); start one with `rerun --port {}`, or let \
                     --spawn start it",
                    address.port()
                ))
            })?;
            let uri: ProxyUri = url(address)
                .parse()
                .map_err(|error| failed(format!("no address of a viewer: {error}")))?;
            let sink = Arc::new(GrpcSink::new(uri));
            let recording = builder
                .buffered()
                .map_err(|error| failed(error.to_string()))?;
            recording.set_sink(Box::new(ToViewer(Arc::clone(&sink))));
            let link = Link::Viewer {
                sink,
                greeting: Greeting::send(stream),
                took_all: Cell::new(false),
            };
            Ok((recording, link))
        }
        Live::Serve(port) => {
            // The library would return Ok on a busy port and lose everything.
            TcpListener::bind((HOME, port)).map_err(|error| {
                failed(format!(
                    "the port cannot be used ({error}); name another with --serve=PORT"
                ))
            })?;
            let options = ServerOptions {
                playback_behavior: PlaybackBehavior::OldestFirst,
                memory_limit: MemoryLimit::from_bytes(HISTORY),
                ..ServerOptions::default()
            };
            let recording = builder
                .serve_grpc_opts(HOME, port, options)
                .map_err(|error| failed(error.to_string()))?;
            Ok((recording, Link::Server))
        }
    }
}
