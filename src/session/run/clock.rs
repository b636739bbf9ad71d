//! Wall time, where there is a clock: a page has none that the engine may ask.

#[cfg(not(target_arch = "wasm32"))]
use std::time::Instant;

/// When something began.
#[derive(Debug, Clone, Copy)]
pub struct Clock {
    #[cfg(not(target_arch = "wasm32"))]
    began: Instant,
}

impl Clock {
    /// Now.
    pub fn start() -> Self {
        Self {
            #[cfg(not(target_arch = "wasm32"))]
            began: Instant::now(),
        }
    }

    /// Seconds since then; none pass without a clock.
    #[cfg(not(target_arch = "wasm32"))]
    pub fn elapsed_s(self) -> f64 {
        self.began.elapsed().as_secs_f64()
    }

    /// Seconds since then; none pass without a clock.
    #[cfg(target_arch = "wasm32")]
    pub fn elapsed_s(self) -> f64 {
        0.0
    }
}
