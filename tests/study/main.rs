//! The studies in their quick forms; other codes beside the engine; what leaving stages out costs.

#[path = "../common/engine.rs"]
mod common;
mod evidence;
mod heat;
mod peers;
mod pruning;
mod story;
mod studies;
