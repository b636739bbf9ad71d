//! Grids, fixed-order sums, planned FFTs, convolution. No contact words here.

pub mod elliptic;
pub mod root;
