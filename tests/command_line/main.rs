//! The program by its command line: messages, files, sweeps, and the same number everywhere.

mod cautions;
mod cli;
#[path = "../common/mod.rs"]
mod common;
mod common_life;
mod outputs;
mod report;
mod surface;
mod sweep;
mod sweep_shared;
mod truth;
