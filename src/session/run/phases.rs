//! Rolling surfaces keep to each other: which crest meets which is chance in a machine. The life at S = 0 over the phases of
//! body 1, on the coarsest mesh that carries the waves.
//!
//! ```text
//! r_k = life(phase k)/life(the scene's phase)     k·45 degrees, one mesh
//! band = life_low · min r/ε … life_high · max r ε   ε: what this mesh is off at the scene's phase
//! ```
//! Only where the scene asks for no phase: both `phase_deg` are 0. Who wants crest on crest writes 360.

use std::sync::Arc;
use std::sync::atomic::AtomicBool;

use super::beside::{coarsest, lives};
use asperity_engine::plan::Plan;
use asperity_engine::scene::{Scene, Surface};
use asperity_engine::sim::Summary;

/// Phases of body 1 beside the scene's, degrees.
const PHASES: [f64; 7] = [45.0, 90.0, 135.0, 180.0, 225.0, 270.0, 315.0];

/// Whether the life of a run hangs on a phase that nobody has asked for.
pub fn asks_for_no_phase(scene: &Scene) -> bool {
    let waves = scene.surfaces().iter().all(|surface| match surface {
        Surface::Sinusoid {
            amplitude_m,
            phase_deg,
            ..
        } => *amplitude_m > 0.0 && *phase_deg == 0.0 && surface.varies_along_x(),
        Surface::Smooth {} | Surface::Random(_) | Surface::HeightMap { .. } => false,
    });
    waves
        && scene.age.is_none()
        && scene.life.is_some()
        && scene.motion.slide_roll == 0.0
        && scene.events.is_empty()
}

/// The scene with another phase of body 1.
fn at_phase(scene: &Scene, phase: f64) -> Scene {
    let mut scene = scene.clone();
    if let Surface::Sinusoid { phase_deg, .. } = &mut scene.body_1.surface {
        *phase_deg = phase;
    }
    scene
}

/// Widens the band of a finished run's life to what the phases make of it; says over how many. `None`: the life hangs on none,
/// or a phase is asked for, or not all of them get through.
pub fn over_phases(
    scene: &Arc<Scene>,
    plan: &Plan,
    threads: usize,
    summary: &mut Summary,
    stop: &AtomicBool,
) -> Option<usize> {
    if !asks_for_no_phase(scene) {
        return None;
    }
    let coarse = coarsest(scene, plan);
    let phases = std::iter::once(0.0).chain(PHASES);
    let scenes: Vec<Scene> = phases.map(|phase| at_phase(&coarse, phase)).collect();
    let lives = lives(&scenes, threads, stop)?;
    let own = lives[0];
    let ratios = || lives.iter().map(|life| life / own);
    let (least, most) = (ratios().fold(1.0, f64::min), ratios().fold(1.0, f64::max));
    let life = summary.life_relative?;
    let off = (life / own).ln().abs().exp();
    summary.life_phases_low = Some(life * least);
    summary.life_phases_high = Some(life * most);
    summary.life_relative_low = summary.life_relative_low.map(|low| low * least / off);
    summary.life_relative_high = summary.life_relative_high.map(|high| high * most * off);
    *summary = std::mem::take(summary).with_cycles_band();
    Some(lives.len())
}
