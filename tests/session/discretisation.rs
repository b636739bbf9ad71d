//! The estimate of the discretisation error (`run::Companion`) against true errors, ten scenes.
//!
//! Base 65², companion 33², truth 257² on the same rectangle over the same passage. The whole set takes
//! minutes: `cargo test --release --test session discretisation:: -- --ignored --nocapture` prints the table. A part of
//! it, against 129², runs always.
#![expect(clippy::unwrap_used, reason = "tests")]

use std::sync::Arc;

use asperity_engine::plan::Plan;
use asperity_engine::scene::{Override, Scene};
use asperity_engine::sim::Summary;
use asperity_session::run::{Companion, End, Ending, Outcome, Request, Session};

/// Name, preset, settings.
type Case = (&'static str, &'static str, &'static [&'static str]);

const SMOOTH: [&str; 3] = [
    "body_1.surface.kind=smooth",
    "body_2.surface.kind=smooth",
    "motion.slide_roll=0",
];
const TRANSVERSE: [&str; 4] = [
    "body_1.surface.kind=smooth",
    "body_2.surface.wavelength_x_m=3.5e-4",
    "body_2.surface.wavelength_y_m=inf",
    "body_2.surface.amplitude_m=1e-7",
];

const CASES: [(Case, &[&str]); 10] = [
    (
        (
            "thick, smooth",
            "demonstration_quick",
            &["load.force_n=20", "motion.entrainment_m_s=4"],
        ),
        &SMOOTH,
    ),
    (("smooth", "mtm_ball_on_disc", &[]), &SMOOTH),
    (
        (
            "thin, smooth",
            "demonstration_quick",
            &["motion.entrainment_m_s=3"],
        ),
        &SMOOTH,
    ),
    (("ellipse, smooth", "ball_bearing", &[]), &SMOOTH),
    (
        (
            "waves, rolling",
            "demonstration_quick",
            &["motion.slide_roll=0", "motion.entrainment_m_s=5"],
        ),
        &TRANSVERSE,
    ),
    (
        (
            "waves, sliding",
            "demonstration_quick",
            &["motion.slide_roll=1", "motion.entrainment_m_s=5"],
        ),
        &TRANSVERSE,
    ),
    (
        (
            "both rough, mixed",
            "demonstration_quick",
            &[
                "body_1.surface.wavelength_x_m=4e-4",
                "body_2.surface.wavelength_x_m=4e-4",
                "body_2.surface.wavelength_y_m=4e-4",
            ],
        ),
        &[],
    ),
    (
        ("dry, rough", "demonstration_quick", &["lubricant=none"]),
        &[
            "body_1.surface.wavelength_x_m=4e-4",
            "body_2.surface.kind=smooth",
        ],
    ),
    (
        (
            "isotropic",
            "demonstration_quick",
            &["motion.entrainment_m_s=4"],
        ),
        &[
            "body_1.surface.kind=smooth",
            "body_2.surface.wavelength_x_m=4e-4",
            "body_2.surface.wavelength_y_m=4e-4",
        ],
    ),
    (("steel on glass", "ball_on_glass", &[]), &SMOOTH),
];

fn scene(case: &Case, more: &[&str], nodes: usize) -> Scene {
    let base = Scene::load(case.1).unwrap();
    // No estimate looks at other models' lives and maps of damage.
    let bare = [
        "record=none",
        "stress.depths=12",
        "time.passages=0.5",
        "life.spread=off",
        "life.damage_map=off",
    ];
    let mut sets: Vec<Override> = (bare.iter())
        .chain(more)
        .chain(case.2)
        .map(|s| s.parse().unwrap())
        .collect();
    if base.life.is_none() {
        sets.push("life.survival=0.5".parse().unwrap());
    }
    sets.push("grid.nodes=65".parse().unwrap());
    // The rectangle of 65², whatever the nodes.
    let mut scene = Scene::load_with(case.1, &sets).unwrap();
    let domain = Plan::new(&scene).unwrap().domain;
    scene.grid.nodes = nodes;
    scene.grid.x_min_a = Some(domain.x_min_a);
    scene.grid.x_max_a = Some(domain.x_max_a);
    scene.grid.y_half_a = Some(domain.y_half_b);
    scene
}

fn run(scene: &Scene) -> Summary {
    let session = Session::start(Request {
        name: String::new(),
        scene: Arc::new(scene.clone()),
        plan: Plan::new(scene).unwrap(),
        threads: 2,
        watchers: Vec::new(),
        ending: Ending::Passages,
    });
    let outcome: Outcome = session.unwrap().join().unwrap();
    assert!(matches!(outcome.end, End::Done), "{:?}", outcome.end);
    outcome.summary.unwrap()
}

/// Prints a row for each quantity; true where every true error lies within its estimate.
fn compare(case: &Case, more: &[&str], truth: usize) -> bool {
    let base = scene(case, more, 65);
    let mut summary = run(&base);
    Companion::start(&base, &Plan::new(&base).unwrap(), 2)
        .unwrap()
        .compare(&mut summary)
        .unwrap();
    let exact = run(&scene(case, more, truth));
    let ln = |life: Option<f64>| life.map_or(0.0, f64::ln);
    let rows = [
        (
            "h_central",
            summary.h_central_m,
            exact.h_central_m,
            summary.error_h_central_m,
            1.0,
        ),
        (
            "h_min",
            summary.h_min_m,
            exact.h_min_m,
            summary.error_h_min_m,
            1.0,
        ),
        (
            "p_max",
            summary.p_max_pa,
            exact.p_max_pa,
            summary.error_p_max_pa,
            1.0,
        ),
        (
            "touching",
            summary.contact_ratio,
            exact.contact_ratio,
            summary.error_contact_ratio,
            0.0,
        ),
        (
            "load on it",
            summary.contact_load_ratio,
            exact.contact_load_ratio,
            summary.error_contact_load_ratio,
            0.0,
        ),
        (
            "friction",
            summary.friction_coefficient,
            exact.friction_coefficient,
            summary.error_friction_coefficient,
            0.0,
        ),
        (
            "ln life",
            ln(summary.life_relative),
            ln(exact.life_relative),
            summary.error_ln_life,
            0.0,
        ),
    ];
    let mut bracketed = true;
    for (name, value, exact, estimate, relative) in rows {
        let scale = if relative > 0.0 {
            exact.abs().max(1e-10)
        } else {
            1.0
        };
        let (error, estimate) = ((value - exact).abs() / scale, estimate.unwrap() / scale);
        // What the tolerance of the time steps lets through is no error of the mesh.
        let holds = error <= estimate + 1e-3;
        println!(
            "{:<18} {name:<10} true error {error:.4}, estimate {estimate:.4}, {}",
            case.0,
            if holds { "holds" } else { "FAILS" }
        );
        bracketed &= holds;
    }
    bracketed
}

#[test]
fn the_estimate_brackets_the_error_of_small_scenes() {
    for (case, more) in [&CASES[1], &CASES[5], &CASES[7]] {
        assert!(compare(case, more, 129), "{}", case.0);
    }
}

#[test]
#[ignore = "minutes: the whole set against 257²"]
fn the_estimate_brackets_the_true_error_on_ten_scenes() {
    let n = CASES
        .iter()
        .filter(|(case, more)| compare(case, more, 257))
        .count();
    println!("{n} of 10 scenes bracketed in all four");
    assert_eq!(n, CASES.len());
}
