//! Closed forms of contact mechanics, lubrication, stress and fatigue.

pub mod cycles;
pub mod fatigue;
pub mod invariants;
pub mod rainflow;
pub mod stress_exact;
pub mod stress_exact_patch;
