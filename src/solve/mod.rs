//! The solvers: one equation per file, dimensionless, slices and own scratch in.

pub mod life;
pub mod material;
pub mod stress;
