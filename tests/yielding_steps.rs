//! Steel that yields under oil and on the move: bounds in every step of the stiff set, shakedown of what comes back.
#![expect(clippy::unwrap_used, reason = "tests")]

use asperity::plan::Plan;
use asperity::scene::{Override, Scene};
use asperity::sim::{Frame, Simulation, Stage};

/// Hardness of steel of 60 HRC, Pa.
const H_PA: f64 = 6.84e9;

fn simulation(preset: &str, sets: &[String]) -> Simulation {
    let sets: Vec<Override> = sets.iter().map(|s| s.parse().unwrap()).collect();
    let scene = Scene::load_with(preset, &sets).unwrap();
    Simulation::new(&scene, Plan::new(&scene).unwrap(), 2).unwrap()
}

/// The stiff set of `tests/ladder.rs`.
fn stiff(p_hertz_pa: f64, speed_m_s: f64, slide_roll: f64, hardness: Option<f64>) -> Vec<String> {
    let mut sets = vec![
        "load.force_n=none".to_owned(),
        format!("load.hertz_pressure_pa={p_hertz_pa:e}"),
        "lubricant.viscosity_law=barus".to_owned(),
        "lubricant.pressure_viscosity_per_pa=2.2e-8".to_owned(),
        format!("motion.entrainment_m_s={speed_m_s:e}"),
        format!("motion.slide_roll={slide_roll}"),
        "grid.nodes=65".to_owned(),
        "life=none".to_owned(),
        "stress=none".to_owned(),
    ];
    let smooth = ["body_1.surface.kind=smooth", "body_2.surface.kind=smooth"];
    let all = sets.iter().map(String::as_str).chain(smooth);
    let all: Vec<Override> = all.map(|s| s.parse().unwrap()).collect();
    let plan = Plan::new(&Scene::load_with("demonstration", &all).unwrap()).unwrap();
    let (wx, wy) = (8.0 * plan.dx_m, 8.0 * plan.dy_m);
    sets.extend([
        format!("body_1.surface.wavelength_x_m={wx:e}"),
        format!("body_2.surface.wavelength_x_m={wx:e}"),
        format!("body_2.surface.wavelength_y_m={wy:e}"),
        "body_1.surface.amplitude_m=1.5e-6".to_owned(),
        "body_2.surface.amplitude_m=1.5e-6".to_owned(),
    ]);
    for body in [1, 2] {
        let given = hardness.map_or("none".to_owned(), |pa| format!("{pa:e}"));
        sets.push(format!("body_{body}.hardness_pa={given}"));
    }
    sets
}

#[derive(Debug, Default)]
struct Outcome {
    steps: u32,
    newton: u64,
    linear: u64,
    retries: u64,
    halved: u64,
    safer: u64,
    p_max_pa: f64,
    load: f64,
    mass: f64,
    not_converged: u32,
    yielded_m3: f64,
}

/// Runs the start-up and `steps` steps; every step is looked at from the development on.
fn run(sets: &[String], steps: u64) -> Outcome {
    let mut sim = simulation("demonstration", sets);
    let (mut frame, mut outcome) = (Frame::default(), Outcome::default());
    while sim.passage_steps() < steps {
        sim.step().unwrap();
        sim.fill(&mut frame);
        let m = sim.metrics();
        outcome.steps += 1;
        outcome.not_converged += u32::from(!m.converged);
        outcome.load = outcome.load.max(m.load_error);
        outcome.mass = outcome.mass.max(m.mass_error);
        let rough = m.amplitude_1_m > 0.0;
        if rough {
            outcome.p_max_pa = outcome.p_max_pa.max(m.p_max_pa);
        }
        let yielded = m.yielded_m3.unwrap_or_default();
        outcome.yielded_m3 = yielded[0] + yielded[1];
        assert!(
            frame
                .pressure_pa
                .iter()
                .chain(&frame.film_m)
                .all(|v| v.is_finite())
        );
    }
    let stats = sim.stats();
    outcome.newton = stats.newton_iterations;
    outcome.linear = stats.linear_iterations;
    (outcome.retries, outcome.halved, outcome.safer) = (stats.retries, stats.halved, stats.safer);
    outcome
}

#[test]
fn the_stiff_set_stays_at_the_hardness() {
    for (speed, slide_roll) in [
        (0.1, 2.0),
        (0.1, -2.0),
        (0.1, 0.5),
        (1e-3, 2.0),
        (1e-4, -2.0),
    ] {
        let elastic = run(&stiff(4.3e9, speed, slide_roll, None), 20);
        let yields = run(&stiff(4.3e9, speed, slide_roll, Some(H_PA)), 20);
        println!("{speed} {slide_roll}\n  {elastic:?}\n  {yields:?}");
        assert!(yields.p_max_pa <= H_PA * (1.0 + 1e-9));
        assert!(yields.load <= 1e-5 && yields.mass <= 1e-4 && yields.not_converged == 0);
        assert!(yields.yielded_m3 > 0.0 && elastic.p_max_pa > H_PA);
        assert!(yields.newton <= elastic.newton, "{speed} {slide_roll}");
    }
}

#[test]
fn infinite_hardness_is_none() {
    let sets = |value: &str| -> Vec<String> {
        let mut sets: Vec<String> = [
            "grid.nodes=65",
            "time.passages=0.3",
            "life=none",
            "stress=none",
        ]
        .map(str::to_owned)
        .to_vec();
        sets.push(format!("body_1.hardness_pa={value}"));
        sets
    };
    let [mut absent, mut infinite, mut hard] =
        ["none", "inf", "9e11"].map(|value| simulation("demonstration", &sets(value)));
    let mut frames = [Frame::default(), Frame::default(), Frame::default()];
    while !absent.is_done() {
        for (sim, frame) in [&mut absent, &mut infinite, &mut hard]
            .into_iter()
            .zip(&mut frames)
        {
            sim.step().unwrap();
            sim.fill(frame);
        }
        let [one, two, three] = &frames;
        assert_eq!(one.pressure_pa, two.pressure_pa);
        assert_eq!(
            (&one.pressure_pa, &one.film_m),
            (&three.pressure_pa, &three.film_m)
        );
    }
    assert_eq!(absent.stats(), infinite.stats());
    assert_eq!(absent.stats(), hard.stats());
    assert_eq!(absent.summary().yielded_body_1_m3, None);
    assert_eq!(hard.summary().yielded_body_1_m3, Some(0.0));
}

/// A rough body of hardened steel on a harder smooth one: every crest comes back after a round of the ring.
fn rough_on_hard(line: bool) -> Vec<String> {
    let mut sets: Vec<String> = [
        "grid.nodes=65",
        "life=none",
        "stress=none",
        "motion.slide_roll=0",
        "body_1.surface.kind=smooth",
        "body_2.surface.amplitude_m=1e-6",
        "body_2.hardness_pa=3e9",
        "time.passages=6",
    ]
    .map(str::to_owned)
    .to_vec();
    if line {
        sets.extend(
            [
                "contact.kind=line",
                "contact.ry_m=none",
                "load.force_n=none",
                "load.force_n_per_m=2e5",
                "body_2.surface.wavelength_y_m=inf",
            ]
            .map(str::to_owned),
        );
    }
    sets
}

#[test]
fn the_second_round_flows_no_further() {
    for line in [false, true] {
        let mut sim = simulation("demonstration", &rough_on_hard(line));
        let mut rounds = Vec::new();
        while !sim.is_done() {
            sim.step().unwrap();
            if sim.stage() == Stage::Passage {
                let m = sim.metrics();
                let passages = sim.progress();
                rounds.push((passages, m.yielded_m3.unwrap()[1], m.p_max_pa));
            }
        }
        let summary = sim.summary();
        let every = rounds.len() / 12;
        for (at, yielded, p) in rounds.iter().step_by(every) {
            println!("{at:.3} {yielded:.4e} m³ {:.3} GPa", p * 1e-9);
        }
        println!(
            "{:?} {:?}",
            summary.yielded_last_share, summary.yielded_body_1_m3
        );
        assert_eq!(summary.yielded_body_1_m3, Some(0.0));
        assert!(summary.yielded_body_2_m3.unwrap() > 0.0);
        assert!(summary.yielded_last_share.unwrap() < 0.01);
    }
}
