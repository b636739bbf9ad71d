//! Whole runs of a scene, and whether one that is cut goes on as the uninterrupted one.
#![expect(clippy::unwrap_used, reason = "tests")]

use asperity_engine::plan::Plan;
use asperity_engine::scene::{Override, Scene};
use asperity_engine::sim::{Simulation, State, Summary};

/// A scene from its text, with keys on top.
pub(crate) fn scene(base: &str, sets: &[String]) -> Scene {
    let sets: Vec<Override> = sets.iter().map(|s| s.parse().unwrap()).collect();
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("scene.toml");
    std::fs::write(&path, base).unwrap();
    Scene::load_with(path.to_str().unwrap(), &sets).unwrap()
}

/// The quick demonstration on few nodes, with keys on top.
pub(crate) fn small_demonstration(sets: &[&str]) -> Scene {
    let small = ["grid.nodes=65", "stress.depths=8", "record=none"];
    let sets = small.iter().chain(sets).map(|s| s.parse().unwrap());
    Scene::load_with("demonstration_quick", &sets.collect::<Vec<Override>>()).unwrap()
}

fn simulation(scene: &Scene) -> Simulation {
    Simulation::new(scene, Plan::new(scene).unwrap(), 2).unwrap()
}

fn to_the_end(mut sim: Simulation) -> Summary {
    while !sim.is_done() {
        sim.step().unwrap();
    }
    sim.summary()
}

/// What a run comes to.
pub(crate) fn run(scene: &Scene) -> Summary {
    to_the_end(simulation(scene))
}

/// Saves the run after each of `cuts` steps, takes it up again from the text of its state, and compares the ends.
pub(crate) fn goes_on_bit_for_bit(scene: &Scene, cuts: &[usize]) {
    let mut whole = simulation(scene);
    let mut others: Vec<Simulation> = Vec::new();
    let mut steps = 0;
    while !whole.is_done() {
        if cuts.contains(&steps) {
            let text = serde_json::to_string(&whole.save()).unwrap();
            let state: State = serde_json::from_str(&text).unwrap();
            let mut next = simulation(scene);
            next.restore(&state).unwrap();
            next.count_from(*whole.stats()).unwrap();
            others.push(next);
        }
        whole.step().unwrap();
        steps += 1;
    }
    assert_eq!(others.len(), cuts.len(), "{steps}");
    for other in others {
        assert_eq!(whole.summary(), to_the_end(other));
    }
}
