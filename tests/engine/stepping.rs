//! Time steps: adaptive length, the ladder of fallbacks, and whether a passage repeats.
#![expect(clippy::unwrap_used, reason = "tests")]

use std::sync::OnceLock;

use asperity_engine::plan::Plan;
use asperity_engine::scene::{Override, Scene};
use asperity_engine::sim::{Rhythm, Simulation, State, Summary};

const SMALL: [&str; 7] = [
    "grid.nodes=65",
    "life=none",
    "stress=none",
    "record=none",
    "body_1.surface.kind=smooth",
    "body_2.surface.amplitude_m=3e-7",
    "numerics.order=second",
];

fn simulation(sets: &[&str]) -> Simulation {
    let sets: Vec<Override> = SMALL
        .iter()
        .chain(sets)
        .map(|s| s.parse().unwrap())
        .collect();
    let scene = Scene::load_with("demonstration_quick", &sets).unwrap();
    Simulation::new(&scene, Plan::new(&scene).unwrap(), 1).unwrap()
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
    sim.restore(start).unwrap();
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
    // Proportional: over a factor of 16 in tolerance the ratio stays within a factor of 3, and near 1.
    let ratios = rows.iter().map(|row| row.1);
    let (least, most) = ratios.fold((f64::MAX, 0.0_f64), |(a, b), r| (a.min(r), b.max(r)));
    assert!(most / least < 3.0 && (0.3..2.0).contains(&most), "{rows:?}");
}

#[test]
fn steps_lengthen_when_the_waves_are_gone() {
    let mut sim = simulation(&[
        "load.force_n=20",
        "motion.entrainment_m_s=4",
        // M = 5 wants a wider domain than 65 nodes resolve these waves on.
        "grid.x_min_a=-8",
        "grid.x_max_a=1.9",
        "grid.y_half_a=5",
        "motion.slide_roll=1.5",
        "body_2.surface.wavelength_x_m=1.2e-4",
        "body_2.surface.amplitude_m=4e-7",
        "time.tolerance=0.02",
    ]);
    let a = sim.summary().a_m;
    let crossing_s = 4.0 * a / 4.0;
    let steps_until = |sim: &mut Simulation, t_s: f64| {
        let first = sim.passage_steps();
        while sim.time_s() < t_s {
            sim.step().unwrap();
        }
        sim.passage_steps() - first
    };
    let rough = steps_until(&mut sim, 0.6 * crossing_s);
    sim.set(asperity_engine::sim::Knob::Amplitude2M, 0.0)
        .unwrap();
    let fading = steps_until(&mut sim, 1.2 * crossing_s);
    let smooth = steps_until(&mut sim, 1.8 * crossing_s);
    println!("steps in 0.6 passages: waves {rough}, fading {fading}, smooth {smooth}");
    // A fixed step that meets the same tolerance everywhere is that of the waves.
    assert!(2 * smooth <= rough, "{rough} {smooth}");
    assert!(rough + fading + smooth < 3 * rough);
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
    second.restore(&first.save()).unwrap();
    second.count_from(*first.stats()).unwrap();
    while !second.is_done() {
        second.step().unwrap();
    }
    assert_eq!(one.summary(), second.summary());
}

fn ladder(
    sets: &[&str],
    steps: usize,
) -> (Simulation, Result<(), asperity_engine::sim::StepError>) {
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
    for (most, tolerance) in [
        (6, 1e-3),
        (5, 1e-3),
        (4, 1e-3),
        (2, 1e-3),
        (1, 1e-3),
        (1, 1e-9),
    ] {
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
    sim.set(asperity_engine::sim::Knob::ForceN, 130.0).unwrap();
    sim.step().unwrap();
    assert!(!repeats(&sim));
    // The ramp itself lasts 0.6 a/U; the film of the old load then has to leave.
    let steps = until(&mut sim, 400);
    println!("repeats again after {steps} steps");
    assert!(steps > 10);
}
