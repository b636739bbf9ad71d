//! # asperity
//!
//! Transient mixed elastohydrodynamic lubrication of rough rolling-sliding contacts, subsurface
//! stress, stress-cycle counting and relative fatigue life.
//!
//! ## Floors
//! Imports go downward only (`tests/house/main.rs` reads them):
//!
//! `files < math < physics < scene < plan < solve < sim < picture < observe < run < sweep < study < tui < web < cli/main`
//!
//! * [`files`]: plain files read, whole files written, digests, which program wrote them.
//! * [`math`]: grids, fixed-order sums, planned FFTs, convolution. No contact words.
//! * [`physics`]: closed forms: Hertz, fluid laws, waviness, film regressions, stress, fatigue.
//! * [`scene`]: what the user asked, in SI, validated.
//! * [`plan`]: what that scene needs, and why each stage that is left out is left out.
//! * [`solve`]: one equation per file, dimensionless.
//! * [`sim`]: the simulation loop: `step`, `set`, `fill`.
//! * [`picture`]: frame and subject to values, axes, range, colours and legend, once for all who paint.
//! * [`observe`]: what watches a run: latest frame, bounded queue, table, Rerun recording.
//! * [`run`]: a session: threads, commands, outcome.
//! * [`sweep`]: life maps and operating paths over many scenes, cases run beside the explorer.
//! * [`study`]: error against run time, scaling.
//! * `tui` (feature `tui`): the live screen. The engine never names it.
//! * `web` (feature `web`, on wasm32): the same screen in a page.
//!
//! How to use and change the program: `guide`.

/// Compiles a function for the wide vector units too, and picks one at run time.
macro_rules! dispatched {
    ($function:item) => {
        #[multiversion::multiversion(targets(
            "x86_64+avx512f+avx512vl+avx512dq+avx512bw+fma",
            "x86_64+avx2+fma"
        ))]
        $function
    };
}

pub mod files;
#[cfg(doc)]
pub mod guide;
pub mod math;
pub mod observe;
pub mod physics;
pub mod picture;
pub mod plan;
pub mod run;
pub mod scene;
pub mod sim;
pub mod solve;
#[cfg(not(target_arch = "wasm32"))]
pub mod study;
pub mod sweep;
#[cfg(feature = "tui")]
pub mod tui;
// For a page; elsewhere for its unit tests only.
#[cfg(any(
    all(feature = "web", target_arch = "wasm32"),
    all(feature = "tui", test)
))]
pub mod web;
