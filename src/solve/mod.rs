//! The solvers: one equation per file, dimensionless, slices and own scratch in.

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

mod axis;
pub mod critical;
pub mod damage;
pub mod dry;
mod faces;
pub mod film;
pub mod history;
pub mod jacobian;
pub mod krylov;
pub mod life;
mod line_sweep;
pub mod march;
pub mod material;
pub mod newton;
pub mod precondition;
pub mod reynolds;
pub mod stress;
mod tally;
pub mod tangential;
pub mod traction;
