//! Subsurface stress of both bodies by windowed frequency responses, truncated with depth.
//!
//! ```text
//! p̂, q̂ = FFT of pressure and traction (padded);  per depth z:
//! D = p̂ − Q,  Q = i nx q̂,  A = (1−2ν) p̂ + 2ν Q − kz D,  E = e^{−kz}
//! σxx = E (2Q − 2νD − nx² A)     σyy = −E (2νD + ny² A)        σzz = −E (p̂ + kz D)
//! σxy = E (i ny q̂ − nx ny A)     σxz = E (−q̂ + i nx kz D)      σyz = E i ny kz D
//! ```
//! | symbol | meaning | shape, unit |
//! |---|---|---|
//! | p | pressure, > 0 presses | `[j·nx + i]`, p_h |
//! | q | traction on body 1 along +x (and, where given, +y); body 2 has −q | same |
//! | σ | stress, tension positive | p_h |
//! | x, y, z | along rolling, across, into the body | a |
//! | k, (nx, ny) | wave number and direction of a mode | 1/a |
//!
//! - The 16 × 16 longest waves use windowed kernels ([`window`]), so that the stress is that of one
//!   contact and not of a lattice of them.
//! - A depth keeps only the modes with `kz < ln(1/ε)` and works on a grid that just holds them:
//!   deep layers cost little.
//! - A pressure that is even in y (`MirrorY`) is given and solved on half the rows.
//! - Single precision: it equals double to 2e-7 of p_h here.
//!
//! Error: that of sampling the pressure. Under the square-root edge of a Hertz contact 2.5e-3 p_h at
//! z = 0.1 a and 1e-4 at 0.5 a for 64 nodes a half-width. Proved in `tests/life/stress_engine.rs` and
//! `tests/life/integrals.rs` against the closed forms of [`crate::physics::stress_exact`].
//! Source of the plane-wave solutions: Westergaard (1939); Johnson, Contact Mechanics (1985), §2-3.
//!
//! Order of calls: [`StressEngine::load`], then [`StressEngine::slice`] and
//! [`StressEngine::volume`] in any number. All memory is made by [`StressEngine::new`]; warm calls
//! allocate nothing. Results do not depend on the number of threads.

mod assemble;
mod depth;
mod engine;
mod layer;
mod line;
mod load;
mod measure;
mod peak;
mod rows;
mod slice_out;
mod spec;
mod sums;
mod window;

pub use depth::{DEPTH_SCALE_A, depth_rule};
pub use engine::{Cut, Plane, StressEngine, VolumeOut};
pub use line::LineStress;
pub use slice_out::{Peak, SliceOut};
pub use spec::{Loading, Purpose, StressError, StressSpec, Symmetry};
pub use sums::{Integral, StressLaw, VolumeSums};
