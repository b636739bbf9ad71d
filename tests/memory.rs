//! A warm step allocates nothing: everything is made by `Simulation::new`.
#![expect(clippy::unwrap_used, reason = "tests")]

use std::alloc::System;

use asperity::plan::Plan;
use asperity::scene::{Override, Scene};
use asperity::sim::{Frame, Knob, Simulation};
use stats_alloc::{INSTRUMENTED_SYSTEM, Region, StatsAlloc};

#[global_allocator]
static ALLOCATOR: &StatsAlloc<System> = &INSTRUMENTED_SYSTEM;

/// A simulation in its passage, all stages on, every point of the counting past its first crossing.
fn warm(threads: usize, extra: &[&str]) -> Simulation {
    let sets: Vec<Override> = ["grid.nodes=65", "stress.depths=8", "record=none"]
        .iter()
        .chain(extra)
        .map(|s| s.parse().unwrap())
        .collect();
    let scene = Scene::load_with("demonstration", &sets).unwrap();
    let mut sim = Simulation::new(&scene, Plan::new(&scene).unwrap(), threads).unwrap();
    while sim.passage_steps() < 20 {
        sim.step().unwrap();
    }
    sim
}

/// Calls of the allocator in `steps` steps, each written into a frame.
fn calls(sim: &mut Simulation, steps: u64, mut before: impl FnMut(&mut Simulation, u64)) -> usize {
    let mut frame = Frame::default();
    sim.fill(&mut frame);
    let region = Region::new(ALLOCATOR);
    for step in 0..steps {
        before(sim, step);
        sim.step().unwrap();
        sim.fill(&mut frame);
    }
    let change = region.change();
    change.allocations + change.reallocations
}

/// One test, because the counter counts the whole process.
#[test]
fn a_warm_step_allocates_nothing() {
    // The counter counts.
    let region = Region::new(ALLOCATOR);
    let planted = std::hint::black_box(vec![1_u8; 100]);
    assert_eq!(region.change().allocations, 1);
    drop(planted);

    // Handing work to another thread goes through a queue of rayon's that takes a new block of 63 places
    // now and then: four hand-overs a step at most.
    let steps = 100;
    let queue = (4 * steps as usize).div_ceil(63) + 1;
    for threads in [1, 2] {
        let mut sim = warm(threads, &[]);
        let n = calls(&mut sim, steps, |_, _| {});
        println!("{threads} threads: {n} calls of the allocator in {steps} steps (queue: {queue})");
        assert!(n <= queue, "{n}");
    }
    // Knobs that move, steps that adapt.
    let mut sim = warm(1, &["time.tolerance=0.02"]);
    let n = calls(&mut sim, steps, |sim, step| {
        if step == 10 {
            sim.set(Knob::SlideRoll, 0.8).unwrap();
        }
    });
    println!("adaptive, with a knob: {n} calls");
    assert!(n <= queue, "{n}");
    // A restored simulation has its room again.
    let mut again = warm(1, &[]);
    let state = again.save();
    again.restore(state).unwrap();
    let n = calls(&mut again, steps, |_, _| {});
    println!("restored: {n} calls");
    assert!(n <= queue, "{n}");
}
