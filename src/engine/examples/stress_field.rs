//! The effective stress below the surface of body 1 in the last step, y = 0, as an array for numpy.
//!
//! `cargo run --release -p asperity-engine --example stress_field [FILE.npy]`, then in Python
//! `numpy.load("stress.npy")`: Pa, shape (depths, x).

use std::io::Write as _;

use asperity_engine::plan::Plan;
use asperity_engine::scene::{Override, Scene};
use asperity_engine::sim::{Frame, Simulation};

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let sets: [Override; 2] = ["grid.nodes=65".parse()?, "time.passages=0.1".parse()?];
    let scene = Scene::load_with("demonstration_quick", &sets)?;
    let mut simulation = Simulation::new(&scene, Plan::new(&scene)?, 2)?;
    while !simulation.is_done() {
        simulation.step()?;
    }
    let mut frame = Frame::default();
    simulation.fill(&mut frame);
    let slice = frame.slice.as_ref().ok_or("the scene asks for no stress")?;

    let path = std::env::args()
        .nth(1)
        .unwrap_or_else(|| "stress.npy".to_owned());
    write_npy(&path, [slice.depths_m.len(), frame.nx], &slice.effective_pa)?;
    let maximum = slice.effective_pa.iter().copied().fold(0.0, f32::max);
    println!(
        "{path}: {} depths of {} nodes, maximum {:.3} GPa",
        slice.depths_m.len(),
        frame.nx,
        maximum / 1e9
    );
    Ok(())
}

/// Writes `values`, row by row, as numpy's format 1.0.
fn write_npy(path: &str, shape: [usize; 2], values: &[f32]) -> std::io::Result<()> {
    let [rows, columns] = shape;
    let text =
        format!("{{'descr': '<f4', 'fortran_order': False, 'shape': ({rows}, {columns}), }}");
    // Magic, version, length and header together are a multiple of 64 bytes and end in a line feed.
    let width = (10 + text.len() + 1).next_multiple_of(64) - 11;
    let mut file = std::io::BufWriter::new(std::fs::File::create(path)?);
    file.write_all(b"\x93NUMPY\x01\x00")?;
    file.write_all(&((width + 1) as u16).to_le_bytes())?;
    writeln!(file, "{text:width$}")?;
    for value in values {
        file.write_all(&value.to_le_bytes())?;
    }
    file.flush()
}
