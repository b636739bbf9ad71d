//! Stress below the surface, the counting of its cycles, and lives.

#[path = "../common/engine.rs"]
mod common;
mod counts;
mod damage;
mod felt;
mod integrals;
mod passages;
mod patch;
mod reference;
mod settled;
mod stress_closed_forms;
mod stress_engine;
mod stress_field;
