//! What a run leaves behind: recordings, exports, saved states, and the runs that go on from them.

mod beside;
#[path = "../common/mod.rs"]
mod common;
mod cut;
mod damaged;
mod export;
mod live;
mod painters;
mod recording;
mod repeat;
mod restart;
mod restart_cli;
mod restart_matrix;
mod viewer;
mod views;
mod workspace;
