//! λ, regime, least film and cautions as a reader meets them: the plan's λ is the run's, no thin film is called full, and
//! what the summary warns of is what the last frame warns of.

#![allow(clippy::unwrap_used, reason = "tests")]

use asperity_engine::plan::Plan;
use asperity_engine::scene::{Override, Scene, Surface, presets};
use asperity_engine::sim::{CautionCode, Frame, LubricationRegime, Simulation};

/// A preset on a small grid, without what costs time; waves long enough for it, which λ does not depend on.
fn small(name: &str) -> Scene {
    let mut scene = Scene::load(name).unwrap();
    (scene.stress, scene.life, scene.record) = (None, None, None);
    scene.grid.nodes = 65;
    let a_m = scene.hertz().a_m;
    for body in [&mut scene.body_1, &mut scene.body_2] {
        if let Surface::Sinusoid {
            wavelength_x_m,
            wavelength_y_m,
            ..
        } = &mut body.surface
        {
            *wavelength_x_m = wavelength_x_m.max(a_m);
            *wavelength_y_m = wavelength_y_m.max(a_m);
        }
    }
    scene
}

/// The first frame of the passage and its simulation.
fn first(scene: &Scene) -> (Plan, Simulation, Frame) {
    let plan = Plan::new(scene).unwrap();
    let mut sim = Simulation::new(scene, plan.clone(), 1).unwrap();
    while sim.passage_steps() < 1 {
        sim.step().unwrap();
    }
    let mut frame = Frame::default();
    sim.fill(&mut frame);
    (plan, sim, frame)
}

#[test]
fn the_plans_lambda_is_the_screens_in_every_preset_and_no_thin_film_is_full() {
    for preset in presets::all() {
        let (plan, sim, frame) = first(&small(preset.name));
        let m = &frame.metrics;
        let planned = plan.film.and_then(|film| film.lambda_ratio);
        println!(
            "{:<20} plan {planned:.3?}, run {:.3?}, film over roughness {:.3?}, load on contacts {:.3}: {}",
            preset.name,
            m.lambda_ratio,
            m.film_to_roughness,
            m.contact_load_ratio,
            m.regime.name()
        );
        match (planned, m.lambda_ratio) {
            (Some(plan), Some(run)) => assert!((run / plan - 1.0).abs() < 1e-12),
            pair => assert_eq!(pair, (None, None)),
        }
        let thin = m.lambda_ratio.is_some_and(|lambda| lambda < 1.2);
        assert!(!(thin && m.regime == LubricationRegime::FullFilm));
        assert_eq!(sim.summary().lambda_ratio, m.lambda_ratio);
        assert_eq!(sim.summary().regime, m.regime);
    }
}

#[test]
fn the_least_film_is_that_of_all_nodes_under_pressure() {
    // Under a light load crests meet outside of the Hertz ellipse, where the film is thinnest.
    let mut scene = small("demonstration_quick");
    (scene.load.force_n, scene.load.hertz_pressure_pa) = (Some(10.0), None);
    for body in [&mut scene.body_1, &mut scene.body_2] {
        body.surface = Surface::Sinusoid {
            amplitude_m: 3e-7,
            wavelength_x_m: f64::INFINITY,
            wavelength_y_m: 3.3e-4,
            angle_deg: 0.0,
            phase_deg: 180.0,
        };
    }
    let (_, _, frame) = first(&scene);
    let radius = |i: usize| {
        let x = frame.x_min_m + (i % frame.nx) as f64 * frame.dx_m;
        let y = frame.y_min_m + (i / frame.nx) as f64 * frame.dy_m;
        (x / frame.a_m).hypot(y / frame.b_m)
    };
    let films = frame.film_m.iter().zip(&frame.pressure_pa).enumerate();
    let pressed = films.filter(|(_, (_, p))| **p > 0.0);
    let (at, least) = pressed
        .map(|(i, (h, _))| (radius(i), f64::from(*h)))
        .min_by(|one, two| one.1.total_cmp(&two.1))
        .unwrap();
    println!(
        "least film {:.2} nm at {at:.3} of the ellipse; said {:.2} nm",
        least * 1e9,
        frame.metrics.h_min_m * 1e9
    );
    assert!(at > 1.0, "the case shows nothing");
    assert!((frame.metrics.h_min_m / least - 1.0).abs() < 1e-6);
}

#[test]
fn the_summary_warns_of_what_the_frame_warns_of() {
    let sets = [
        "grid.nodes=65",
        "stress.depths=8",
        "motion.slide_roll=2",
        "load.force_n=9000",
        "body_1.surface.wavelength_x_m=4e-4",
        "body_2.surface.wavelength_x_m=4e-4",
        "body_2.surface.wavelength_y_m=4e-4",
    ];
    let sets: Vec<Override> = sets.iter().map(|s| s.parse().unwrap()).collect();
    let scene = Scene::load_with("demonstration_quick", &sets).unwrap();
    let (_, mut sim, mut frame) = first(&scene);
    while sim.passage_steps() < 20 {
        sim.step().unwrap();
    }
    sim.fill(&mut frame);
    let (summary, cautions) = (sim.summary(), frame.cautions());
    for caution in &cautions {
        println!("{:?}: {}", caution.code, caution.text);
    }
    assert_eq!(summary.cautions, cautions);
    let has = |code| cautions.iter().any(|caution| caution.code == code);
    for code in [
        CautionCode::BeyondYield,
        CautionCode::MeshFilm,
        CautionCode::StandingBody,
        CautionCode::NotSettled,
    ] {
        assert!(has(code), "{code:?}");
    }
    // As a script reads them.
    let json = serde_json::to_value(&summary).unwrap();
    assert_eq!(json["cautions"][0]["code"], "beyond_yield");
    assert!(
        json["cautions"][0]["text"]
            .as_str()
            .unwrap()
            .contains("GPa")
    );
    assert!(summary.p_max_greatest_pa >= summary.p_max_pa);
    assert!(summary.h_min_least_m <= summary.h_min_m);
    // A standing body, no film, no life are said where they hold.
    let dry = small("demonstration_quick");
    let dry = Scene {
        lubricant: None,
        ..dry
    };
    let (_, sim, frame) = first(&dry);
    let codes: Vec<_> = frame.cautions().iter().map(|one| one.code).collect();
    assert_eq!(
        codes,
        [
            CautionCode::Dry,
            CautionCode::NoLife,
            CautionCode::ElasticOnly
        ]
    );
    assert_eq!(sim.summary().regime, LubricationRegime::Dry);
}
