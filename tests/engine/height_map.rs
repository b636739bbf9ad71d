//! Height maps through the public door: files, messages, round trip, plan, and a run that must equal the
//! same surface given as a formula.

#![allow(clippy::unwrap_used, reason = "tests")]

use std::f64::consts::TAU;
use std::path::Path;

use crate::common::maps::{Shape, csv, npy_f4, npy_f8};
use asperity_engine::plan::{Plan, Symmetry};
use asperity_engine::scene::{OrderAsked, Override, Scene, Surface};
use asperity_engine::sim::{Frame, Simulation, Stage};

const WAVE_M: f64 = 2e-4;

/// One wave a side along x, of `n` pixels; cos(2πx/W) about the middle of the map.
fn ridges(n: usize) -> Shape {
    Shape::new(n, 8, |i, _| {
        let x = i as f64 - 0.5 * (n - 1) as f64;
        1.5e-7 * (TAU * x / n as f64).cos()
    })
}

/// The default scene with body 1 smooth and a surface of `extra` on body 2, in `folder`.
fn scene_file(folder: &Path, surface: &str) -> String {
    let mut scene = Scene::load("demonstration_quick").unwrap();
    scene.body_1.surface = Surface::Smooth {};
    scene.body_2.surface = Surface::Smooth {};
    scene.grid.nodes = 65;
    scene.stress = None;
    scene.life = None;
    scene.record = None;
    let text = scene.to_toml();
    let (head, tail) = text.split_once("[body_2.surface]").unwrap();
    let (_, rest) = tail.split_once('\n').unwrap();
    // The emitted `kind = "smooth"` line goes.
    let rest = rest.split_once('\n').unwrap().1;
    let path = folder.join("scene.toml");
    std::fs::write(&path, format!("{head}[body_2.surface]\n{surface}\n{rest}")).unwrap();
    path.to_str().unwrap().to_owned()
}

fn map_table(file: &str, pixel_m: f64, more: &str) -> String {
    format!("kind = \"height_map\"\nfile = \"{file}\"\npixel_m = {pixel_m:e}\n{more}")
}

#[test]
fn every_format_gives_the_same_scene_and_it_round_trips() {
    let folder = tempfile::tempdir().unwrap();
    let shape = ridges(64);
    npy_f8(&folder.path().join("eight.npy"), &shape);
    npy_f4(&folder.path().join("four.npy"), &shape);
    csv(&folder.path().join("text.csv"), &shape, 1e6);
    let mut first: Option<Plan> = None;
    for (file, more) in [
        ("eight.npy", ""),
        ("four.npy", ""),
        ("text.csv", "unit_m = 1e-6"),
    ] {
        let table = map_table(file, WAVE_M / 64.0, more);
        let scene = Scene::load(&scene_file(folder.path(), &table)).unwrap();
        let surface = &scene.body_2.surface;
        // The pixels miss the crest by half a pixel.
        assert!((surface.amplitude_m() / 1.5e-7 - 1.0).abs() < 2e-3);
        assert!((surface.rq_m() / (1.5e-7 / 2.0_f64.sqrt()) - 1.0).abs() < 2e-3);
        assert!((surface.crests_per_m() * WAVE_M - 1.0).abs() < 1e-9);
        let again = Scene::from_toml(&scene.to_toml()).unwrap();
        assert_eq!(again, scene, "read back, from another folder");
        scene.validate().unwrap();
        let plan = Plan::new(&scene).unwrap();
        assert_eq!(plan.symmetry, Symmetry::MirrorY);
        let nodes = plan.waves[1].unwrap().nodes[0];
        assert!((nodes * plan.dx_m / WAVE_M - 1.0).abs() < 1e-9);
        if let Some(first) = &first {
            assert_eq!(first.steps, plan.steps);
        }
        first = Some(plan);
    }
    let knob: Override = "body_2.surface.amplitude_m=3e-7".parse().unwrap();
    let table = map_table("eight.npy", WAVE_M / 64.0, "");
    let louder = Scene::load_with(&scene_file(folder.path(), &table), &[knob]).unwrap();
    assert!((louder.body_2.surface.amplitude_m() - 3e-7).abs() < 1e-18);
}

#[test]
fn what_is_wrong_is_named() {
    let folder = tempfile::tempdir().unwrap();
    npy_f8(&folder.path().join("good.npy"), &ridges(64));
    std::fs::write(
        folder.path().join("nan.csv"),
        "1e-7,2e-7,3e-7,4e-7\n1e-7,2e-7,NaN,4e-7\n1e-7,2e-7,3e-7,4e-7\n0,0,0,0\n",
    )
    .unwrap();
    std::fs::write(
        folder.path().join("flat.csv"),
        "1e-7,1e-7,1e-7,1e-7\n".repeat(4),
    )
    .unwrap();
    let message = |table: &str| {
        Scene::load(&scene_file(folder.path(), table))
            .and_then(|scene| {
                Plan::new(&scene).map_err(|error| asperity_engine::scene::SceneError::Value {
                    key: error.to_string(),
                    value: String::new(),
                    allowed: String::new(),
                })
            })
            .err()
            .map_or_else(|| "accepted".to_owned(), |error| error.to_string())
    };
    let fine = WAVE_M / 64.0;
    assert_eq!(message(&map_table("good.npy", fine, "")), "accepted");
    for (table, parts) in [
        (
            map_table("nan.csv", fine, ""),
            &["body_2.surface.file", "row 2, column 3"][..],
        ),
        (map_table("flat.csv", fine, ""), &["flat", "heights differ"]),
        (
            map_table("none.npy", fine, ""),
            &["body_2.surface.file", "none.npy"],
        ),
        (
            map_table("scene.toml", fine, ""),
            &[".npy, .csv, .txt, .x3p or .sur"],
        ),
        (
            map_table("good.npy", -1.0, ""),
            &["body_2.surface.pixel_m", "1e-9 to 0.01 m"],
        ),
        (
            map_table("good.npy", fine, "edge = \"mirrored\""),
            &["surface.edge", "\"periodic\" or \"windowed\""],
        ),
        (
            map_table("good.npy", fine, "wavelength_x_m = 1e-4"),
            &["wavelength_x_m", "\"sinusoid\""],
        ),
        (
            map_table("good.npy", 1e-7, ""),
            &["body_2.surface.file", "4 nodes", "grid.nodes"],
        ),
        (
            map_table("good.npy", fine, "amplitude_m = 9e-5"),
            &["amplitude_m", "slope"],
        ),
        (
            "kind = \"height_map\"\npixel_m = 1e-6".to_owned(),
            &["body_2.surface.file is missing"],
        ),
        (
            "kind = \"height_map\"\nfile = \"good.npy\"".to_owned(),
            &["body_2.surface.pixel_m is missing"],
        ),
        (
            "kind = \"sinusoid\"\namplitude_m = 1e-7\nwavelength_x_m = 1e-4\npixel_m = 1e-6"
                .to_owned(),
            &["pixel_m", "\"height_map\""],
        ),
    ] {
        let text = message(&table);
        for part in parts {
            assert!(text.contains(part), "{part}: {text}");
        }
    }
}

/// Deterministic roughness: 40 waves of 8 to 30 pixels in golden directions and phases.
fn rough(n: usize) -> Shape {
    let golden = |k: usize| (0.618_033_988_749_895 * k as f64).fract();
    let waves: Vec<[f64; 3]> = (1..=40)
        .map(|k| {
            // Whole waves in the map, so that it repeats.
            let (count, angle) = (n as f64 / 30.0 + k as f64 * 0.2, TAU * golden(3 * k));
            [
                (count * angle.cos()).round(),
                (count * angle.sin()).round(),
                TAU * golden(7 * k),
            ]
        })
        .collect();
    Shape::new(n, n, |i, j| {
        let (x, y) = (i as f64 / n as f64, j as f64 / n as f64);
        let wave = |w: &[f64; 3]| (TAU * (w[0] * x + w[1] * y) + w[2]).cos();
        3e-8 * waves.iter().map(wave).sum::<f64>()
    })
}

#[test]
fn random_roughness_on_both_bodies_converges_and_is_counted() {
    let folder = tempfile::tempdir().unwrap();
    npy_f8(&folder.path().join("rough.npy"), &rough(128));
    let table = map_table("rough.npy", 1.5e-5, "amplitude_m = 2e-7");
    let mut scene = Scene::load(&scene_file(folder.path(), &table)).unwrap();
    scene.body_1.surface = scene.body_2.surface.clone();
    scene.motion.slide_roll = 0.5;
    let plan = Plan::new(&scene).unwrap();
    assert_eq!(plan.symmetry, Symmetry::General);
    let wave = plan.waves[0].unwrap();
    println!(
        "shortest significant wave {:.1} and {:.1} nodes, crests {:.0} /m, warnings {:?}",
        wave.nodes[0], wave.nodes[1], wave.crests_per_m, plan.warnings
    );
    // Rice: upcrossings of a Gaussian surface, √(m2/m0)/2π, here by differences of the heights.
    let shape = rough(128);
    let level = shape.heights_m.iter().sum::<f64>() / shape.heights_m.len() as f64;
    let (mut m0, mut m2) = (0.0, 0.0);
    for row in shape.heights_m.chunks_exact(128) {
        for i in 0..128 {
            m0 += (row[i] - level).powi(2);
            m2 += ((row[(i + 1) % 128] - row[i]) / 1.5e-5).powi(2);
        }
    }
    let rice = (m2 / m0).sqrt() / TAU;
    println!("crests by Rice's formula {rice:.0} /m");
    assert!((wave.crests_per_m / rice - 1.0).abs() < 0.15);
    let steps = films(&scene, 16);
    assert_eq!(steps.len(), 16);
    scene.lubricant = None;
    films(&scene, 4);
}

/// Frames of the first passage steps.
fn films(scene: &Scene, steps: u64) -> Vec<Vec<f32>> {
    let plan = Plan::new(scene).unwrap();
    let mut sim = Simulation::new(scene, plan, 1).unwrap();
    let mut frame = Frame::default();
    let mut films = Vec::new();
    while sim.passage_steps() < steps {
        sim.step().unwrap();
        if sim.stage() == Stage::Passage {
            sim.fill(&mut frame);
            assert!(frame.metrics.converged);
            films.push(frame.film_m.clone());
        }
    }
    films
}

#[test]
fn a_map_of_a_wave_runs_as_the_wave() {
    let folder = tempfile::tempdir().unwrap();
    let n = 128;
    npy_f8(&folder.path().join("wave.npy"), &ridges(n));
    let table = map_table("wave.npy", WAVE_M / n as f64, "amplitude_m = 1.5e-7");
    let mut mapped = Scene::load(&scene_file(folder.path(), &table)).unwrap();
    // The heights are compared, not where each iteration stops.
    mapped.numerics.tolerance = 1e-6;
    // A bound of high order's correction may flip at a node in one and not in the other: 1.5 nm, which leaves with the oil.
    mapped.numerics.order = OrderAsked::Second;
    let mut formula = mapped.clone();
    formula.body_2.surface = Surface::Sinusoid {
        amplitude_m: 1.5e-7,
        wavelength_x_m: WAVE_M,
        wavelength_y_m: f64::INFINITY,
        angle_deg: 0.0,
        phase_deg: 0.0,
    };
    let (one, two) = (films(&mapped, 3), films(&formula, 3));
    assert_eq!(one.len(), two.len());
    let mut worst = 0.0_f64;
    for (a, b) in one.iter().flatten().zip(two.iter().flatten()) {
        worst = worst.max(f64::from((a - b).abs()));
    }
    println!("greatest difference of film {worst:.2e} m");
    // The map's greatest height stands half a pixel off the crest: 3e-4 of the amplitude.
    assert!(worst < 1e-3 * 1.5e-7, "{worst}");
}
