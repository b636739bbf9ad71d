//! The solvers: one equation per file, dimensionless, slices and own scratch in.

mod axis;
mod converge;
pub mod critical;
pub mod damage;
pub mod dry;
mod faces;
pub mod film;
mod fluidity;
pub mod history;
pub mod jacobian;
pub mod krylov;
pub mod life;
mod line_sweep;
pub mod march;
pub mod material;
pub mod newton;
mod newton_rows;
pub mod precondition;
pub mod reynolds;
mod reynolds_rows;
mod shift;
mod steep;
pub mod stress;
mod tally;
pub mod tangential;
pub mod traction;
pub mod yielding;
