//! The stiff set: rough on both bodies, waves of 8 nodes, Barus' law.

use asperity_engine::plan::Plan;
use asperity_engine::scene::{Override, Scene};

/// A stiff scene.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Stiff {
    /// p_h, Pa.
    pub(crate) p_hertz_pa: f64,
    /// U, m/s.
    pub(crate) speed_m_s: f64,
    /// S.
    pub(crate) slide_roll: f64,
    /// Nodes per side.
    pub(crate) nodes: usize,
}

/// The scene's overrides; the waves are 8 nodes long.
pub(crate) fn sets(stiff: Stiff) -> Vec<String> {
    let mut sets = vec![
        "load.force_n=none".to_owned(),
        format!("load.hertz_pressure_pa={:e}", stiff.p_hertz_pa),
        "lubricant.viscosity_law=barus".to_owned(),
        "lubricant.pressure_viscosity_per_pa=2.2e-8".to_owned(),
        format!("motion.entrainment_m_s={:e}", stiff.speed_m_s),
        format!("motion.slide_roll={}", stiff.slide_roll),
        format!("grid.nodes={}", stiff.nodes),
        "life=none".to_owned(),
        "stress=none".to_owned(),
    ];
    let smooth = ["body_1.surface.kind=smooth", "body_2.surface.kind=smooth"];
    let all = sets.iter().map(String::as_str).chain(smooth);
    let all: Vec<Override> = all.map(|s| s.parse().unwrap()).collect();
    let plan = Plan::new(&Scene::load_with("demonstration_quick", &all).unwrap()).unwrap();
    let (wx, wy) = (8.0 * plan.dx_m, 8.0 * plan.dy_m);
    sets.extend([
        format!("body_1.surface.wavelength_x_m={wx:e}"),
        format!("body_2.surface.wavelength_x_m={wx:e}"),
        format!("body_2.surface.wavelength_y_m={wy:e}"),
        "body_1.surface.amplitude_m=1.5e-6".to_owned(),
        "body_2.surface.amplitude_m=1.5e-6".to_owned(),
    ]);
    sets
}
