//! Closed forms of contact mechanics, lubrication, stress and fatigue.

pub mod film_regression;
pub mod groups;
pub mod hertz;
