//! The solver, from closed forms to runs: films, dry contacts, steps, plans, scenes, the loop; all without a screen or a file.

#[path = "../common/engine.rs"]
mod common;
mod converged_step;
mod dent;
mod domain;
mod dry_limit;
mod dry_periodic;
mod dry_switch;
mod ehl_elliptic;
mod ehl_smooth;
mod ehl_transient;
mod eyring;
mod heat;
mod height_map;
mod hertz_dry;
mod ladder;
mod line;
mod lubricants;
mod measured_maps;
mod motions;
mod order;
mod plan;
mod random_scenes;
mod random_surface;
mod refusals;
mod regime;
mod ripple;
mod scene;
mod simulation;
mod stepping;
mod surface_files;
mod wear;
#[path = "../common/whole.rs"]
mod whole;
mod work_counters;
mod yielding;
mod yielding_steps;
