//! The loop around a simulation, without a screen or a recorder: commands, outputs, every way to end; errors of the mesh.

#[path = "../common/engine.rs"]
mod common;
mod discretisation;
mod oil_laws;
mod phases;
mod rungs;
mod session;
mod stalls;
mod surfaces;
mod until_settled;
