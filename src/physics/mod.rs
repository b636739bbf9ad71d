//! Closed forms of contact mechanics, lubrication, stress and fatigue.

pub mod estimate;
