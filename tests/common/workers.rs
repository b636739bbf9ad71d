//! Work that is one piece, on one thread.

/// Runs what the solver does by itself on one thread: two tests beside each other then share no threads, and
/// nothing waits for the other's.
pub(crate) fn alone<R: Send>(run: impl FnOnce() -> R + Send) -> R {
    let pool = rayon::ThreadPoolBuilder::new().num_threads(1).build();
    pool.unwrap().install(run)
}
