//! Signals that end a run in order, by the crate `ctrlc`: it calls on a thread of its own, which `nix` and `rustix` leave to
//! `unsafe` code.

use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::{Arc, OnceLock};

use super::failure::Failure;

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
