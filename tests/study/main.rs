//! What the engine is worth beside other codes, and what leaving stages out costs.

#[path = "../common/engine.rs"]
mod common;
mod peers;
mod pruning;
