//! Closed forms of contact mechanics, lubrication, stress and fatigue.

pub mod cycles;
pub mod estimate;
pub mod eyring;
pub mod fatigue;
pub mod felt;
pub mod film_regression;
pub mod film_ripple;
pub mod fluid;
pub mod gear;
pub mod gear_tooth;
pub mod groups;
pub mod height_map;
pub mod hertz;
pub mod invariants;
pub mod iso281;
pub mod levelling;
pub mod life_models;
pub mod line;
pub mod multiaxial;
pub mod race_and_cam;
pub mod rainflow;
pub mod ripple;
pub mod strength;
pub mod stress_exact;
pub mod turning;
pub mod waviness;
