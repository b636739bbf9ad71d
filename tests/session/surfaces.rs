//! Surfaces stand as the scene says: `z_i(x, y = 0, t) = A cos(2π (x − U_i t)/λ_x + φ)`, t from the passage's begin.
#![expect(clippy::unwrap_used, reason = "tests")]

use std::f64::consts::TAU;
use std::sync::Arc;

use asperity_engine::plan::Plan;
use asperity_engine::scene::{Scene, Surface};
use asperity_engine::sim::{Frame, Simulation};
use asperity_session::run::{Ending, Ladder, Request, Session};

use crate::phases::scene;

/// Greatest distance of a frame's heights on y = 0 from the scene's waves, over their amplitudes.
fn off(scene: &Scene, frame: &Frame) -> f64 {
    let (u, s) = (scene.motion.entrainment_m_s, scene.motion.slide_roll);
    let speeds = [u * (1.0 - s / 2.0), u * (1.0 + s / 2.0)];
    let heights = [&frame.roughness_1_m, &frame.roughness_2_m];
    let mut most = 0.0_f64;
    for ((surface, speed), heights) in scene.surfaces().iter().zip(speeds).zip(heights) {
        let Surface::Sinusoid {
            amplitude_m,
            wavelength_x_m,
            angle_deg,
            phase_deg,
            ..
        } = surface
        else {
            continue;
        };
        let row = frame.ny / 2;
        assert!((frame.y_min_m + frame.dy_m * row as f64).abs() < 1e-9 * frame.a_m);
        for (i, z) in heights[row * frame.nx..][..frame.nx].iter().enumerate() {
            let x = frame.x_min_m + frame.dx_m * i as f64 - speed * frame.time_s;
            let along = TAU * x * angle_deg.to_radians().cos() / wavelength_x_m;
            let says = amplitude_m * (along + phase_deg.to_radians()).cos();
            most = most.max((f64::from(*z) - says).abs() / amplitude_m);
        }
    }
    most
}

/// Heights need no stress and no life.
const BARE: [&str; 4] = [
    "record=none",
    "stress=none",
    "life=none",
    "numerics.error_estimate=none",
];

/// Presets and keys: sliding and rolling, both bodies and one, oblique, dry, line and point, steps of their own length,
/// meshes above each other.
const CASES: [(&str, &[&str]); 9] = [
    ("demonstration_quick", &["body_2.surface.phase_deg=40"]),
    ("demonstration_quick", &["motion.slide_roll=0"]),
    (
        "demonstration_quick",
        &["motion.slide_roll=-0.7", "body_2.surface.kind=smooth"],
    ),
    (
        "demonstration_quick",
        &["body_1.surface.angle_deg=30", "numerics.order=second"],
    ),
    (
        "demonstration_quick",
        &["motion.entrainment_m_s=-1", "body_1.surface.phase_deg=70"],
    ),
    // Three meshes.
    (
        "demonstration_quick",
        &["grid.nodes=257", "body_2.surface.phase_deg=90"],
    ),
    ("twin_disc", &["body_1.surface.phase_deg=90"]),
    (
        "twin_disc",
        &["lubricant=none", "body_2.surface.phase_deg=-30"],
    ),
    ("mtm_ball_on_disc", &["time.tolerance=0.01"]),
];

#[test]
fn surfaces_stand_where_the_scene_says() {
    let mut found = Vec::new();
    for (preset, sets) in CASES {
        let scene = scene(preset, &[sets, &BARE, &["time.passages=0.1"]].concat());
        let plan = Plan::new(&scene).unwrap();
        let meshes = Ladder::of(&scene, &plan).meshes().len();
        let request = Request {
            name: String::new(),
            scene: Arc::clone(&scene),
            plan,
            threads: 2,
            watchers: Vec::new(),
            ending: Ending::Passages,
        };
        let session = Session::start(request).unwrap();
        let frames = session.handle.latest();
        session.join().unwrap();
        let frame = frames.take().unwrap();
        assert!(frame.time_s > 0.0, "{preset} {sets:?}");
        let off = off(&scene, &frame);
        println!("{preset} {sets:?}, {meshes} meshes: {off:.1e} of the amplitude");
        if off > 1e-4 {
            found.push(format!("{preset} {sets:?}: {off:.1e}"));
        }
    }
    assert!(found.is_empty(), "{found:#?}");
}

/// A case of a sweep that starts from its neighbour's end, too.
#[test]
fn surfaces_of_a_warm_start_stand_there_too() {
    let at = |s: &str| {
        let slide_roll = format!("motion.slide_roll={s}");
        let sets = ["grid.nodes=65", "time.passages=0.3", &slide_roll];
        scene("demonstration_quick", &[&BARE[..], &sets].concat())
    };
    let run = |scene: &Scene, before: Option<&Simulation>| {
        let mut sim = Simulation::new(scene, Plan::new(scene).unwrap(), 2).unwrap();
        if let Some(before) = before {
            sim.follow(&before.save()).unwrap();
        }
        while !sim.is_done() {
            sim.step().unwrap();
        }
        sim
    };
    let mut before = run(&at("0.5"), None);
    for s in ["0", "1.1"] {
        let scene = at(s);
        before = run(&scene, Some(&before));
        let mut frame = Frame::default();
        before.fill(&mut frame);
        let off = off(&scene, &frame);
        assert!(off < 1e-4, "S = {s}: {off:.1e} of the amplitude");
    }
}
