//! The program by its command line: messages, files, studies, sweeps, and the same number everywhere.

mod cli;
#[path = "../common/mod.rs"]
mod common;
mod evidence;
mod outputs;
mod study;
mod sweep;
mod truth;
