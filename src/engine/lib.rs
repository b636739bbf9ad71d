//! # asperity-engine
//!
//! Transient mixed elastohydrodynamic lubrication of rough rolling-sliding contacts, subsurface
//! stress, stress-cycle counting and relative fatigue life.
//!
//! ## Floors
//! Imports go downward only: `files < math < physics < scene < plan < solve < sim < observe`.
//!
//! * [`files`]: plain files read, whole files written, digests.
//! * [`math`]: grids, fixed-order sums, planned FFTs, convolution. No contact words.
//! * [`physics`]: closed forms: Hertz, fluid laws, waviness, film regressions, stress, fatigue.
//! * [`scene`]: what the user asked, in SI, validated.
//! * [`plan`]: what that scene needs, and why each stage that is left out is left out.
//! * [`solve`]: one equation per file, dimensionless.
//! * [`sim`]: the simulation loop: `step`, `set`, `fill`.
//! * [`observe`]: what an observer of a run implements, and where the files that it writes lie meanwhile.

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

mod closed_set;
pub mod files;
pub mod math;
pub mod observe;
pub mod physics;
pub mod plan;
pub mod scene;
pub mod sim;
pub mod solve;
