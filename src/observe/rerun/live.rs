//! A recording that goes to a viewer instead of a file: one that runs already, or whoever connects to us.
//!
//! Such a stream may stall for as long as the viewer does, so it never shares a stream with a file: it has its
//! own recorder behind a queue that drops frames and counts them
//! ([`Queue::spawn_live`](crate::observe::Queue::spawn_live)). A viewer that is closed is no failure of the
//! run: nothing more is sent, and the report says so.

use std::cell::Cell;
use std::net::{SocketAddr, TcpListener, TcpStream};
use std::sync::Arc;
use std::time::Duration;

use rerun::external::re_uri::ProxyUri;
use rerun::log::LogMsg;
use rerun::sink::{GrpcSink, GrpcSinkConnectionState, LogSink, SinkFlushError};
use rerun::{
    MemoryLimit, PlaybackBehavior, RecordingStream, RecordingStreamBuilder, ServerOptions,
};

use crate::observe::ObserveError;

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
pub(super) fn url(address: impl std::fmt::Display) -> String {
    format!("rerun+http://{address}/proxy")
}

/// The connection, as far as it can be asked.
pub(super) enum Link {
    /// To a viewer, and whether it has answered.
    Viewer(Arc<GrpcSink>, Cell<bool>),
    /// Viewers come and go.
    Server,
}

impl Link {
    /// Whether the viewer has been closed or has broken off.
    pub(super) fn is_gone(&self) -> bool {
        match self {
            Self::Viewer(sink, _) => {
                matches!(sink.status(), GrpcSinkConnectionState::Disconnected(_))
            }
            Self::Server => false,
        }
    }

    /// Whether the viewer has ever answered: something listens at many a port that is no viewer.
    pub(super) fn has_answered(&self) -> bool {
        match self {
            Self::Viewer(sink, answered) => {
                let now = matches!(sink.status(), GrpcSinkConnectionState::Connected);
                answered.set(answered.get() || now);
                answered.get()
            }
            Self::Server => true,
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
pub(super) fn open(
    live: Live,
    builder: RecordingStreamBuilder,
) -> Result<(RecordingStream, Link), ObserveError> {
    let failed = |reason: String| ObserveError::new(live.to_string(), reason);
    match live {
        Live::Connect(address) => {
            // The library would return Ok, fill its buffers, and then block for ever.
            TcpStream::connect_timeout(&address, PATIENCE).map_err(|error| {
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
            Ok((recording, Link::Viewer(sink, Cell::new(false))))
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
