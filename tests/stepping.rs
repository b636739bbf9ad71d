//! Time steps: adaptive length, the ladder of fallbacks, and whether a passage repeats.
#![expect(clippy::unwrap_used, reason = "tests")]

use std::sync::OnceLock;

use asperity::plan::Plan;
use asperity::scene::{Override, Scene};
use asperity::sim::{Rhythm, Simulation, State, Summary};

const SMALL: [&str; 5] = [
    "grid.nodes=65",
    "life=none",
    "stress=none",
    "record=none",
    "body_1.surface.kind=smooth",
];

fn simulation(sets: &[&str]) -> Simulation {
    let sets: Vec<Override> = SMALL
        .iter()
        .chain(sets)
        .map(|s| s.parse().unwrap())
        .collect();
    let scene = Scene::load_with("demonstration", &sets).unwrap();
    Simulation::new(&scene, Plan::new(&scene).unwrap(), 2).unwrap()
}

/// Runs to the end; every step must converge.
fn run(sets: &[&str]) -> (Simulation, Vec<[f64; 2]>) {
    let mut sim = simulation(sets);
    let mut films = Vec::new();
    while !sim.is_done() {
        sim.step().unwrap();
        assert!(sim.metrics().converged);
        if sim.passage_steps() > 0 {
            films.push([sim.time_s(), sim.metrics().h_central_m]);
        }
    }
    (sim, films)
}

/// A thick film over long waves: smooth in time, so that the error in time is what is seen.
const SWELL: [&str; 5] = [
    "load.force_n=100",
    "motion.entrainment_m_s=2",
    "motion.slide_roll=1",
    "body_2.surface.wavelength_x_m=2.5e-4",
    "numerics.tolerance=1e-5",
];

/// The swell from its first step of the passage on, which all runs share: films at the origin by time.
fn from_the_same_start(extra: &[&str]) -> (Simulation, Vec<[f64; 2]>) {
    static START: OnceLock<State> = OnceLock::new();
    let start = START.get_or_init(|| {
        let mut sim = simulation(&SWELL);
        while sim.passage_steps() < 1 {
            sim.step().unwrap();
        }
        sim.save()
    });
    let sets = [&SWELL[..], &["time.passages=0.6"], extra].concat();
    let mut sim = simulation(&sets);
    sim.restore(start.clone()).unwrap();
    let end_s = 0.6 * 4.0 * sim.summary().a_m / 2.0;
    let mut films = Vec::new();
    while sim.time_s() < end_s {
        films.push([sim.time_s(), sim.metrics().h_central_m]);
        sim.step().unwrap();
        assert!(sim.metrics().converged);
    }
    films.push([sim.time_s(), sim.metrics().h_central_m]);
    (sim, films)
}

/// Film at the origin at the time `t_s`, cubic between the steps.
fn at(films: &[[f64; 2]], t_s: f64) -> f64 {
    let n = films
        .partition_point(|f| f[0] < t_s)
        .clamp(2, films.len() - 2);
    let near = &films[n - 2..n + 2];
    (0..4)
        .map(|i| {
            let others = (0..4).filter(|&k| k != i);
            let weight: f64 = others
                .map(|k| (t_s - near[k][0]) / (near[i][0] - near[k][0]))
                .product();
            weight * near[i][1]
        })
        .sum()
}

/// Root mean square difference at the steps of `films` from the fine run, over the mean film, once the oil of
/// the common start has left.
fn distance(films: &[[f64; 2]], fine: &[[f64; 2]]) -> f64 {
    let end = films.last().unwrap()[0];
    let late = films
        .iter()
        .filter(|f| f[0] > 0.4 * end && f[0] < fine.last().unwrap()[0]);
    let (mut sum, mut film, mut n) = (0.0, 0.0, 0.0);
    for f in late {
        sum += (f[1] - at(fine, f[0])).powi(2);
        film += f[1];
        n += 1.0;
    }
    assert!(n > 3.0);
    (sum / n).sqrt() / (film / n)
}

#[test]
fn the_error_follows_the_tolerance() {
    let (_, fine) = from_the_same_start(&["time.tolerance=5e-4"]);
    println!("fine: {} steps", fine.len());
    for nodes in ["2", "1", "0.5", "0.25"] {
        let setting = format!("time.step_nodes={nodes}");
        let (_, films) = from_the_same_start(&[&setting]);
        let error = distance(&films, &fine);
        println!(
            "fixed {nodes} nodes: error {error:.2e}, {} steps",
            films.len()
        );
    }
    let mut rows = Vec::new();
    for tolerance in [8e-2, 4e-2, 2e-2, 1e-2, 5e-3] {
        let setting = format!("time.tolerance={tolerance}");
        let (sim, films) = from_the_same_start(&[&setting]);
        let error = distance(&films, &fine);
        let ratio = error / tolerance;
        println!(
            "tolerance {tolerance:.0e}: error {error:.2e}, error/tolerance {ratio:.3}, {} steps, {} rejected",
            films.len(),
            sim.stats().rejected
        );
        rows.push((error, ratio, films.len()));
    }
    assert!(rows.is_sorted_by(|a, b| a.0 > b.0 && a.2 < b.2), "{rows:?}");
    // Proportional where time steps make the error, from 1 % up; below, kinks of the film that no grid
    // resolves dominate the estimate, and the error falls faster than the tolerance.
    let ratios = rows[..4].iter().map(|row| row.1);
    let (least, most) = ratios.fold((f64::MAX, 0.0_f64), |(a, b), r| (a.min(r), b.max(r)));
    assert!(most / least < 2.0 && (0.5..2.0).contains(&most), "{rows:?}");
    assert!(rows[4].1 < most, "{rows:?}");
}

/// Steps of a smooth contact whose speed is turned down by a quarter, and its film in the end.
fn after_a_jump(extra: &str) -> (u64, f64) {
    let smooth = [
        "body_2.surface.kind=smooth",
        "load.force_n=20",
        "motion.entrainment_m_s=4",
        "motion.slide_roll=0",
        "time.passages=8",
    ];
    let mut sim = simulation(&[&smooth[..], &[extra]].concat());
    while sim.passage_steps() < 1 {
        sim.step().unwrap();
    }
    sim.set(asperity::sim::Knob::EntrainmentMS, 3.0).unwrap();
    let end_s = 4.0 * sim.summary().a_m / 3.5;
    let first = sim.passage_steps();
    while sim.time_s() < end_s {
        sim.step().unwrap();
    }
    (sim.passage_steps() - first, sim.metrics().h_central_m)
}

#[test]
fn steps_lengthen_when_nothing_happens() {
    let (n_fixed, fixed) = after_a_jump("time.step_nodes=1");
    for tolerance in ["0.08", "0.02", "0.01"] {
        let (n, film) = after_a_jump(&format!("time.tolerance={tolerance}"));
        println!("tolerance {tolerance}: {n} steps, film {film:.4e} m");
    }
    for nodes in ["0.25", "0.5", "2"] {
        let (n, film) = after_a_jump(&format!("time.step_nodes={nodes}"));
        println!("nodes {nodes}: {n} steps, film {film:.4e} m");
    }
    let (n, film) = after_a_jump("time.tolerance=0.04");
    println!("fixed: {n_fixed} steps, film {fixed:.4e} m; adaptive: {n} steps, film {film:.4e} m");
    assert!((film / fixed - 1.0).abs() < 0.04);
    assert!(2 * n < n_fixed, "{n} of {n_fixed}");
}

#[test]
fn adaptive_steps_are_deterministic_and_go_on_from_a_saved_state() {
    let sets = [&SWELL[..], &["time.tolerance=0.02", "time.passages=0.4"]].concat();
    let ((one, films), (_, again)) = (run(&sets), run(&sets));
    assert_eq!(films, again);
    let mut first = simulation(&sets);
    while first.passage_steps() < 5 {
        first.step().unwrap();
    }
    let mut second = simulation(&sets);
    second.restore(first.save()).unwrap();
    while !second.is_done() {
        second.step().unwrap();
    }
    assert_eq!(one.summary(), second.summary());
}

fn ladder(sets: &[&str], steps: usize) -> (Simulation, Result<(), asperity::sim::StepError>) {
    let mut sim = simulation(sets);
    for _ in 0..steps {
        if let Err(error) = sim.step() {
            return (sim, Err(error));
        }
    }
    (sim, Ok(()))
}

#[test]
fn every_rung_of_the_ladder_is_climbed_and_told() {
    // Enough iterations: no fallback at all.
    let (sim, end) = ladder(&[], 8);
    let stats = *sim.stats();
    assert!(end.is_ok() && sim.metrics().converged);
    assert_eq!((stats.retries, stats.halved, stats.safer), (0, 0, 0));
    // Fewer and fewer iterations climb rung by rung.
    let mut seen = [false; 4];
    for (most, tolerance) in [(6, 1e-3), (5, 1e-3), (4, 1e-3), (2, 1e-3), (1, 1e-9)] {
        let settings = [
            format!("numerics.max_iterations={most}"),
            format!("numerics.tolerance={tolerance:e}"),
        ];
        let (sim, end) = ladder(&settings.each_ref().map(String::as_str), 8);
        let stats = sim.stats();
        println!(
            "max_iterations {most}: {} retries, {} halved, {} safe, converged {}, {end:?}",
            stats.retries,
            stats.halved,
            stats.safer,
            sim.metrics().converged
        );
        seen[0] |= stats.retries > 0;
        seen[1] |= stats.halved > 0;
        seen[2] |= stats.safer > 0 && end.is_ok() && sim.metrics().converged;
        if let Err(error) = &end {
            // Where and how much.
            let text = error.to_string();
            assert!(
                text.contains("residual") && text.contains("worst at x ="),
                "{text}"
            );
        }
        seen[3] |= end.is_err() || !sim.metrics().converged;
        if stats.safer > 0 {
            assert!(stats.halved > 0 && stats.retries > stats.halved);
        }
    }
    assert_eq!(seen, [true; 4]);
}

fn summary_after(sets: &[&str]) -> Summary {
    run(sets).0.summary()
}

#[test]
fn a_passage_that_repeats_is_told_from_one_that_does_not() {
    let swell = |extra: &[&str]| {
        let sets = [&SWELL[..4], extra].concat();
        summary_after(&sets)
    };
    // Only body 2 is rough: its waves come back after W/U2, in time for an orbit.
    let orbit = swell(&["time.passages=2"]);
    println!(
        "orbit: {:?} {:?} s, drift {:?}",
        orbit.rhythm, orbit.period_s, orbit.period_drift
    );
    assert_eq!(orbit.rhythm, Some(Rhythm::Orbit));
    assert_eq!(orbit.periodic, Some(true));
    // U2 = 3 m/s, W = 0.25 mm.
    assert!((orbit.period_s.unwrap() / (2.5e-4 / 3.0) - 1.0).abs() < 1e-9);
    // Too short to have seen it twice.
    let young = swell(&["time.passages=0.05"]);
    assert_eq!((young.periodic, young.period_drift), (Some(false), None));
    // Both rough, wavelengths without a common multiple.
    let both = swell(&[
        "time.passages=3",
        "body_1.surface.kind=sinusoid",
        "body_1.surface.amplitude_m=1e-7",
        "body_1.surface.wavelength_x_m=3.1e-4",
    ]);
    println!("both: {:?}, drift {:?}", both.rhythm, both.period_drift);
    assert_eq!(both.rhythm, Some(Rhythm::Statistics));
    assert!(both.period_drift.is_some());
}

#[test]
fn a_turned_knob_breaks_the_orbit_until_it_has_settled() {
    let mut sim = simulation(&[&SWELL[..4], &["time.passages=8"]].concat());
    let repeats = |sim: &Simulation| sim.metrics().repeat.is_some_and(|r| r.repeats);
    let until = |sim: &mut Simulation, most: u64| {
        let first = sim.passage_steps();
        while !repeats(sim) {
            sim.step().unwrap();
            assert!(sim.passage_steps() < first + most, "never repeats");
        }
        sim.passage_steps() - first
    };
    until(&mut sim, 200);
    sim.set(asperity::sim::Knob::ForceN, 130.0).unwrap();
    sim.step().unwrap();
    assert!(!repeats(&sim));
    // The ramp itself lasts 0.6 a/U; the film of the old load then has to leave.
    let steps = until(&mut sim, 400);
    println!("repeats again after {steps} steps");
    assert!(steps > 10);
}
