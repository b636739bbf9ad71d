//! Where the plan leaves the film out: on both sides of one layer of oil molecules the results are the same.
//!
//! The default scene's waves at p_h = 1 GPa. Speeds on both sides of the switch differ by 2 %, so what the results
//! differ by is the switch's doing.
#![expect(clippy::unwrap_used, reason = "tests")]

use asperity_engine::plan::{MOLECULE_M, Plan, Valleys, Warning};
use asperity_engine::scene::{Override, Scene};
use asperity_engine::sim::{Knob, Simulation, Stage, Summary};

const COMMON: [&str; 10] = [
    "load.force_n=none",
    "load.hertz_pressure_pa=1e9",
    "grid.nodes=33",
    "record=none",
    "numerics.error_estimate=none",
    "time.passages=1",
    "body_2.surface.wavelength_x_m=3e-4",
    "body_1.surface.amplitude_m=3e-7",
    "body_2.surface.amplitude_m=3e-7",
    "body_1.surface.phase_deg=0",
];

fn scene(speed_m_s: f64, more: &[&str]) -> Scene {
    let speed = format!("motion.entrainment_m_s={speed_m_s:e}");
    let sets = COMMON.iter().chain(more).copied().chain([speed.as_str()]);
    let sets: Vec<Override> = sets.map(|text| text.parse().unwrap()).collect();
    Scene::load_with("demonstration_quick", &sets).unwrap()
}

fn film_m(speed_m_s: f64, more: &[&str]) -> f64 {
    let plan = Plan::new(&scene(speed_m_s, more)).unwrap();
    plan.film.unwrap().central_m
}

/// Speed at which the film by formula is one layer.
fn switch_m_s(more: &[&str]) -> f64 {
    let (mut low, mut high) = (1e-7_f64, 1e-2_f64);
    for _ in 0..60 {
        let middle = (low * high).sqrt();
        if film_m(middle, more) < MOLECULE_M {
            low = middle;
        } else {
            high = middle;
        }
    }
    low
}

/// The summary of a run, and its greatest pressure over the passage.
fn run(speed_m_s: f64, more: &[&str]) -> (Plan, Summary, f64) {
    let scene = scene(speed_m_s, more);
    let plan = Plan::new(&scene).unwrap();
    let mut sim = Simulation::new(&scene, plan.clone(), 1).unwrap();
    let mut most = 0.0_f64;
    while !sim.is_done() {
        sim.step().unwrap();
        assert!(sim.metrics().converged, "{speed_m_s} {more:?}");
        if sim.stage() == Stage::Passage {
            most = most.max(sim.metrics().p_max_pa);
        }
    }
    (plan, sim.summary(), most)
}

#[test]
fn nothing_jumps_where_the_film_is_given_up() {
    // Greatest pressure within 3 %, life within 10 %, which holds for the open ones of the table at `MOLECULE_M`. Life
    // goes as p^-10: 1 % of pressure is as much as 10 % of life.
    for more in [
        &[
            "body_1.surface.wavelength_x_m=3e-4",
            "body_2.surface.wavelength_y_m=3e-4",
        ][..],
        &[
            "body_1.surface.kind=smooth",
            "body_2.surface.wavelength_y_m=3e-4",
        ][..],
    ] {
        let switch = switch_m_s(more);
        let (above, wet, p_wet) = run(1.01 * switch, more);
        let (below, dry, p_dry) = run(0.99 * switch, more);
        assert!(above.has_flow() && !below.has_flow());
        let stage = |plan: &Plan| {
            let left_out = plan.left_out.iter();
            left_out
                .map(|item| item.stage)
                .any(|stage| stage == "film and flow")
        };
        assert!(!stage(&above) && stage(&below));
        let text = below.to_string();
        assert!(
            text.contains("less than one layer of molecules (0.4 nm): solved dry"),
            "{text}"
        );
        // Life itself and not a factor of it: the body that governs may change, and with it the unit of its cycles.
        let (life_wet, life_dry) = (wet.life_relative.unwrap(), dry.life_relative.unwrap());
        println!(
            "{more:?} at {switch:.3e} m/s: pressure {:+.1} %, life {:+.1} %",
            100.0 * (p_dry / p_wet - 1.0),
            100.0 * (life_dry / life_wet - 1.0)
        );
        assert!((p_dry / p_wet - 1.0).abs() < 0.03);
        assert!((life_dry / life_wet).ln().abs() < 0.1);
    }
}

#[test]
fn a_speed_turned_down_and_up_again_crosses_the_switch() {
    let scene = scene(1e-2, &["body_1.surface.wavelength_x_m=3e-4"]);
    let plan = Plan::new(&scene).unwrap();
    // Three waves of body 1 and five of body 2 pass while oil moves by four: S = 0.5.
    let period = (4.0 * 3e-4 / plan.dx_m).round() as usize;
    let mut sim = Simulation::new(&scene, plan, 1).unwrap();
    let mut seen = Vec::new();
    for speed_m_s in [1e-2, 1e-6, 1e-2] {
        sim.set(Knob::EntrainmentMS, speed_m_s).unwrap();
        let begun = sim.passage_steps();
        let mut frictions = Vec::new();
        while sim.passage_steps() < begun + 20 + period as u64 {
            sim.step().unwrap();
            assert!(sim.metrics().converged, "{speed_m_s}");
            frictions.push(sim.metrics().friction_coefficient);
        }
        // Of one step it depends on where the crests are; the first ones are of the start-up, and of the speed that walks.
        let last = &frictions[frictions.len() - period..];
        let mean = last.iter().sum::<f64>() / period as f64;
        let least = last.iter().copied().fold(f64::INFINITY, f64::min);
        println!("{speed_m_s} m/s: friction {mean}, least {least}");
        seen.push([mean, least]);
    }
    let [before, slow, after] = seen[..] else {
        unreachable!("three speeds")
    };
    // Dry: all of the load is on contacts, and friction is the boundary's.
    assert!((slow[0] / scene.friction.boundary - 1.0).abs() < 1e-6);
    assert!(before[1] < 0.99 * scene.friction.boundary);
    let back = after[0] / before[0];
    assert!((back - 1.0).abs() < 0.01, "{back}");
}

#[test]
fn oil_that_is_shut_in_keeps_its_flow() {
    let product = "body_1.surface.wavelength_y_m=2e-4";
    let plan = |more: &[&str]| Plan::new(&scene(1e-6, more)).unwrap();
    let shut = plan(&[product]);
    assert!(shut.has_flow());
    assert!(shut.warnings.iter().any(|warning| matches!(
        warning,
        Warning::NoFilm {
            valleys: Valleys::Closed,
            ..
        }
    )));
    let line = [
        "contact.kind=line",
        "contact.ry_m=none",
        "body_2.surface.wavelength_y_m=inf",
    ];
    assert!(plan(&line).has_flow());
    let one = [&line[..], &["body_1.surface.kind=smooth"][..]].concat();
    assert!(!plan(&one).has_flow());
    assert!(!plan(&["body_1.surface.angle_deg=30"]).has_flow());
}
