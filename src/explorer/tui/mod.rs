//! The live screen: the only folder that names ratatui, and in `terminal` crossterm.
//!
//! ```text
//! Latest ──newest frame──> App ──view──> terminal, page
//! keys, mouse ──Action──>  App ──Effect──> Command ──> run
//! ```
//!
//! [`app`] holds the state and the reducer and does not draw, wait or read a clock; [`view`] draws
//! a state and changes nothing; [`Explorer`] wires the two to a run; `terminal` is the loop that shows it there.
//! Frames are taken newest first: a slow screen skips frames and never delays the run.

pub mod action;
pub mod app;
pub mod choice;
pub mod dial;
pub mod estimate;
pub mod event;
mod explorer;
pub mod kinds;
mod kymograph;
pub mod lessons;
pub mod pixels;
pub mod replay;
mod tables;
#[cfg(not(target_arch = "wasm32"))]
mod terminal;
pub mod theme;
pub mod trace;
pub mod units;
pub mod view;
pub mod wiring;

pub use explorer::{Control, Explorer};
#[cfg(not(target_arch = "wasm32"))]
pub use terminal::explore;
pub use wiring::{
    Health, Rebuild, RecorderActivity, RecorderState, RunStatus, Setup, Shown, TuiError, Wiring,
    WriteShown,
};
