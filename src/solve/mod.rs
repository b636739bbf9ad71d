//! The solvers: one equation per file, dimensionless, slices and own scratch in.

pub mod stress;
