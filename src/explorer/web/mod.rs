//! The explorer in a page: state, reducer, view and simulation in one WebAssembly module, which a worker of the page owns.
//!
//! ```text
//! worker   keys, pointer ──> abi ──> WebPage { Explorer, Cooperative } ──> cells, picture, words ──> page
//! ```
//! The worker calls [`abi`]: events, one step after another for some milliseconds, a drawing, and again. What leaves the
//! module are the cells that changed and the map's pixels; the page paints them on a canvas (`assets/web/page.js`). There is
//! no clock, no thread and no file here: the page says how late it is, and takes what is to be saved.

// Its names are some of the system's own (`open`, `link`): for a page only.
#[cfg(target_arch = "wasm32")]
pub mod abi;
mod cells;
mod curves;
mod link;
mod page;
mod rows;
