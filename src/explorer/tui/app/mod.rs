//! The screen's state, and the reducer: (state, action) → state and effects. Nothing here draws,
//! waits or reads a clock, so every screen can be made in a test.

mod curve;
mod data;
mod frozen;
mod ingest;
mod life_map;
mod lives;
mod reduce;
mod repeating;
mod staged;
mod state;
mod tour;
mod typed;
mod why;

pub use crate::tui::kinds::{
    Across, Aged, AutoReplay, CurveKind, Leading, MapKind, Overlay, PanelKind, PointQuantity,
    RunPace, Zoom,
};
pub use data::{
    AxisEnds, Effect, ErrandKind, LifeAccount, LifeSample, Pinned, PointNow, StateBefore, Trouble,
    WhyUnconverged,
};
pub use life_map::LifeMap;
pub use state::App;
pub use why::WhyLine;
