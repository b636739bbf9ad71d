//! One passage of a rough contact: pressure, film and contact of chosen steps, then the life.
//!
//! `cargo run --release -p asperity-engine --example passage [SCENE.toml|PRESET]`

use asperity_engine::plan::Plan;
use asperity_engine::scene::{Override, Scene};
use asperity_engine::sim::{Simulation, Stage};

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let name = std::env::args().nth(1);
    let sets: Vec<Override> = match name {
        None => vec!["grid.nodes=65".parse()?, "time.passages=0.5".parse()?],
        Some(_) => Vec::new(),
    };
    let scene = Scene::load_with(name.as_deref().unwrap_or("demonstration_quick"), &sets)?;
    let plan = Plan::new(&scene)?;
    println!("{plan}");

    let mut simulation = Simulation::new(&scene, plan, 2)?;
    println!("    step  time, ms  p_max, GPa  h_min, nm  contact, %");
    while !simulation.is_done() {
        simulation.step()?;
        if simulation.stage() == Stage::Passage && simulation.passage_steps().is_multiple_of(8) {
            let metrics = simulation.metrics();
            println!(
                "{:8}{:10.4}{:12.3}{:11.1}{:12.2}",
                simulation.passage_steps(),
                simulation.time_s() * 1e3,
                metrics.p_max_pa / 1e9,
                metrics.h_min_m * 1e9,
                metrics.contact_ratio * 100.0
            );
        }
    }
    let summary = simulation.summary();
    println!("friction {:.4}", summary.friction_coefficient);
    if let Some(life) = summary.life_relative {
        println!("life relative to the smooth contact {life:.6}");
    }
    Ok(())
}
