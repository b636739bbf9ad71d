//! Life against the slide-to-roll ratio S, as CSV.
//!
//! `cargo run --release -p asperity-engine --example life_against_s`

use asperity_engine::plan::Plan;
use asperity_engine::scene::{Override, Scene};
use asperity_engine::sim::Simulation;

fn main() -> Result<(), Box<dyn std::error::Error>> {
    println!("slide_roll,life_relative,cycle_factor,stress_factor");
    for slide_roll in [0.0, 0.25, 0.5, 1.0] {
        let sets: [Override; 3] = [
            "grid.nodes=65".parse()?,
            "time.passages=0.5".parse()?,
            format!("motion.slide_roll={slide_roll}").parse()?,
        ];
        let scene = Scene::load_with("demonstration_quick", &sets)?;
        let mut simulation = Simulation::new(&scene, Plan::new(&scene)?, 2)?;
        while !simulation.is_done() {
            simulation.step()?;
        }
        let summary = simulation.summary();
        let life = summary.life_relative.ok_or("the scene asks for no life")?;
        let cycles = summary.cycle_factor.unwrap_or(1.0);
        let stress = summary.stress_factor.unwrap_or(1.0);
        println!("{slide_roll},{life:.4},{cycles:.4},{stress:.4}");
    }
    Ok(())
}
