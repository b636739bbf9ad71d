//! How oil flows that is sheared beyond its Eyring stress is not settled: the life with the other law of flow, and with half and
//! twice the Eyring stress, on the coarsest mesh that carries the waves.
//!
//! ```text
//! r_k = life(law k)/life(the scene's law)         one mesh
//! range = life · min(1, r) … life · max(1, r)
//! ```
//! A factor of two either way is an assumption. Mineral oils are given 2 to 10 MPa.

use std::sync::Arc;
use std::sync::atomic::AtomicBool;

use super::beside::{coarsest, lives};
use super::ladder::Ladder;
use asperity_engine::plan::Plan;
use asperity_engine::scene::{EyringFlow, Lubricant, Rheology, Scene};
use asperity_engine::sim::Summary;

/// Whether a run is long beside these lives, and hangs on them: its oil is sheared, and it climbs to a finer mesh.
pub fn hangs_on_oil_law(scene: &Arc<Scene>, plan: &Plan) -> bool {
    let eyring = scene.lubricant.as_ref();
    eyring.is_some_and(|oil| oil.rheology == Rheology::Eyring)
        && plan.has_flow()
        && scene.life.is_some()
        && scene.motion.slide_roll != 0.0
        && scene.events.is_empty()
        && scene.age.is_none()
        && Ladder::of(scene, plan).meshes().len() > 1
}

/// Gives a finished run's life its range over laws of the oil; `None`: it hangs on none, or not all of them get through.
pub fn over_oil_laws(
    scene: &Arc<Scene>,
    plan: &Plan,
    threads: usize,
    summary: &mut Summary,
    stop: &AtomicBool,
) -> Option<()> {
    if !hangs_on_oil_law(scene, plan) {
        return None;
    }
    let own = coarsest(scene, plan);
    let others = [other_flow, half, twice].map(|change| {
        let mut scene = own.clone();
        if let Some(oil) = &mut scene.lubricant {
            change(oil);
        }
        scene
    });
    let scenes: Vec<Scene> = std::iter::once(own).chain(others).collect();
    let lives = lives(&scenes, threads, stop)?;
    let life = summary.life_relative?;
    let ratios = || lives.iter().map(|one| one / lives[0]);
    summary.life_oil_low = Some(life * ratios().fold(1.0, f64::min));
    summary.life_oil_high = Some(life * ratios().fold(1.0, f64::max));
    Some(())
}

fn other_flow(oil: &mut Lubricant) {
    oil.eyring_flow = match oil.eyring_flow {
        EyringFlow::Secant => EyringFlow::AlongAcross,
        EyringFlow::AlongAcross => EyringFlow::Secant,
    };
}

fn half(oil: &mut Lubricant) {
    oil.eyring_stress_pa /= 2.0;
}

fn twice(oil: &mut Lubricant) {
    oil.eyring_stress_pa *= 2.0;
}
