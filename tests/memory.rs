//! What the allocator is asked for: nothing in a warm step, since everything is made by `Simulation::new`; and a session that
//! has ended holds nothing.
#![expect(clippy::unwrap_used, reason = "tests")]

use std::alloc::System;
use std::sync::{Mutex, PoisonError};
use std::time::Duration;

use asperity_engine::plan::Plan;
use asperity_engine::scene::{Override, Scene};
use asperity_engine::sim::{Frame, Knob, Simulation};
use asperity_session::run::{Command, Ending, Request, Session};
use stats_alloc::{INSTRUMENTED_SYSTEM, Region, StatsAlloc};

#[global_allocator]
static ALLOCATOR: &StatsAlloc<System> = &INSTRUMENTED_SYSTEM;

/// The counter counts the whole process: one test at a time.
static ALONE: Mutex<()> = Mutex::new(());

/// A simulation in its passage, all stages on, both bodies' damage maps begun: 120 steps take a point of the slower
/// one from inlet to outlet.
fn warm(threads: usize, extra: &[&str]) -> Simulation {
    let sets: Vec<Override> = ["grid.nodes=65", "stress.depths=8", "record=none"]
        .iter()
        .chain(extra)
        .map(|s| s.parse().unwrap())
        .collect();
    let scene = Scene::load_with("demonstration_quick", &sets).unwrap();
    let mut sim = Simulation::new(&scene, Plan::new(&scene).unwrap(), threads).unwrap();
    while sim.passage_steps() < 120 {
        sim.step().unwrap();
    }
    sim
}

/// Calls of the allocator in `steps` steps, each written into a frame; made as a run makes them, all inside the pool.
fn calls(
    sim: &mut Simulation,
    steps: u64,
    mut before: impl FnMut(&mut Simulation, u64) + Send,
) -> usize {
    sim.inside(|sim| {
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
    })
}

#[test]
fn a_warm_step_allocates_nothing() {
    let _alone = ALONE.lock().unwrap_or_else(PoisonError::into_inner);
    // The counter counts; the test harness beside may have called it too.
    let region = Region::new(ALLOCATOR);
    let planted = std::hint::black_box(vec![1_u8; 100]);
    assert!(region.change().allocations >= 1);
    drop(planted);

    let steps = 100;
    for threads in [1, 2] {
        let mut sim = warm(threads, &[]);
        let n = calls(&mut sim, steps, |_, _| {});
        println!("{threads} threads: {n} calls of the allocator in {steps} steps");
        assert_eq!(n, 0);
    }
    // Knobs that move, steps that adapt.
    let mut sim = warm(1, &["time.tolerance=0.02"]);
    let n = calls(&mut sim, steps, |sim, step| {
        if step == 10 {
            sim.set(Knob::SlideRoll, 0.8).unwrap();
        }
    });
    println!("adaptive, with a knob: {n} calls");
    assert_eq!(n, 0);
    // Surfaces that flow, under oil and dry.
    for oil in ["time.passages=1", "lubricant=none"] {
        let mut sim = warm(
            1,
            &["body_1.hardness_pa=2e9", "body_2.hardness_pa=2e9", oil],
        );
        let n = calls(&mut sim, steps, |_, _| {});
        println!("yielding, {oil}: {n} calls");
        assert_eq!(n, 0);
        assert!(sim.summary().yielded_last_share.unwrap() > 0.0);
    }
    // A restored simulation has its room again.
    let mut again = warm(1, &[]);
    let state = again.save();
    again.restore(&state).unwrap();
    let n = calls(&mut again, steps, |_, _| {});
    println!("restored: {n} calls");
    assert_eq!(n, 0);
}

/// Bytes that are held now.
fn held() -> usize {
    let stats = ALLOCATOR.stats();
    stats
        .bytes_allocated
        .saturating_sub(stats.bytes_deallocated)
}

/// The same once the threads of a pool have ended, which they do by themselves: a tenth of a second without a change.
fn settled() -> usize {
    let (mut bytes, mut looks) = (held(), 0);
    while looks < 10 {
        std::thread::sleep(Duration::from_millis(10));
        let now = held();
        looks = if now == bytes { looks + 1 } else { 0 };
        bytes = now;
    }
    bytes
}

/// Sessions as the explorer has them, one after the other: bytes that are held after each.
#[test]
fn a_session_that_has_ended_holds_nothing() {
    let _alone = ALONE.lock().unwrap_or_else(PoisonError::into_inner);
    let sets = [
        "grid.nodes=33",
        "stress.depths=8",
        "record=none",
        "body_1.surface.kind=smooth",
        "body_2.surface.kind=smooth",
    ];
    let sets: Vec<Override> = sets.iter().map(|set| set.parse().unwrap()).collect();
    let scene = Scene::load_with("demonstration_quick", &sets).unwrap();
    let mut after = Vec::new();
    for _ in 0..12 {
        let session = Session::start(Request {
            name: String::new(),
            scene: scene.clone().into(),
            plan: Plan::new(&scene).unwrap(),
            threads: 2,
            watchers: Vec::new(),
            ending: Ending::OnStop,
        })
        .unwrap();
        while session.handle.status().steps < 3 {
            assert!(!session.is_finished());
            std::thread::sleep(Duration::from_millis(1));
        }
        session.handle.send(Command::Stop);
        let outcome = session.join().unwrap();
        assert!(outcome.checkpoint.is_some());
        drop(outcome);
        after.push(settled());
    }
    println!("bytes held: {after:?}");
    let (warm, last) = (after[2] as f64, after[11] as f64);
    assert!(last <= 1.03 * warm, "{warm} {last}");
}
