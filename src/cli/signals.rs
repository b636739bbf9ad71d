//! Signals that end a run in order, by the crate `ctrlc`: it calls on a thread of its own, which `nix` and `rustix` leave to
//! `unsafe` code.
//!
//! Beyond a limit of file size the system sends a signal that ends the program in the middle of a write. With any handler, set
//! by the crate `signal-hook`, the write fails instead, like one on a full disk.

use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::{Arc, OnceLock};

use super::failure::Failure;

/// A file that may not grow is an output that failed, and not the program's end.
pub(crate) fn let_limits_of_size_be_errors() {
    // Without it the system does what it did before.
    #[cfg(unix)]
    drop(signal_hook::flag::register(
        signal_hook::consts::SIGXFSZ,
        Arc::default(),
    ));
}

/// Ctrl-C or a request to end stops the run after its step; a second one ends the program at once.
pub(crate) fn stop_on_signals() -> Result<Arc<AtomicBool>, Failure> {
    static ASKED: OnceLock<Arc<AtomicBool>> = OnceLock::new();
    // Of several runs one after another the first has them watched.
    if let Some(asked) = ASKED.get() {
        return Ok(Arc::clone(asked));
    }
    let asked = ASKED.get_or_init(Arc::default);
    let raised = Arc::clone(asked);
    ctrlc::set_handler(move || {
        if raised.swap(true, Ordering::Relaxed) {
            std::process::exit(130);
        }
    })
    .map_err(|error| Failure::stalled(miette::miette!("signals cannot be watched: {error}")))?;
    Ok(Arc::clone(asked))
}
