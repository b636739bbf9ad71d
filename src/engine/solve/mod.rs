//! The solvers: one equation per file, dimensionless, slices and own scratch in.
//!
//! Ours: `assets/guide/numerics.md` draws how they work together in a step.

pub(crate) mod axis;
pub mod columns;
mod converge;
pub mod critical;
mod cycle_count;
pub mod damage;
pub mod dry;
mod faces;
pub mod film;
mod fluidity;
pub mod heat;
pub mod history;
pub mod jacobian;
pub mod krylov;
pub mod life;
mod line_sweep;
pub mod march;
pub mod marks;
pub mod material;
pub mod medium;
pub mod newton;
mod newton_rows;
pub mod precondition;
pub mod reynolds;
mod reynolds_rows;
mod shift;
mod steep;
pub mod stress;
pub mod tangential;
pub mod traction;
pub mod yielding;
