//! Grids, fixed-order sums, planned FFTs, roots, elliptic integrals. No contact words here.

pub mod elementary;
pub mod elliptic;
mod even_transform;
pub mod filter;
pub mod grid;
mod halfway;
pub mod kernel_symbol;
pub mod ln_sum;
mod quarter_wave;
pub mod root;
pub mod spectrum;
mod turned;
