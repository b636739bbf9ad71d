//! The explorer of a running simulation: knobs, pictures, lessons.
//!
//! * [`tui`]: the screen, in a terminal.
//! * `web` (on wasm32): the same screen in a page.

pub mod tui;
// For a page; elsewhere for its unit tests only.
#[cfg(any(target_arch = "wasm32", test))]
pub mod web;
