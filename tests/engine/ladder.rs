//! The stiff set: every step converges, nothing is NaN, and what cannot converge is named, wet or dry.
//!
//! Both bodies rough, A = 1.5 µm, 8 nodes a wave: the film is a fraction of a nanometre to some nanometres, and
//! nearly all of the load is on contacts. p_h = 4 GPa with Barus' law and αp_h = 88; U down to 1e-4 m/s; S = ±2,
//! where one body stands.
//!
//! p_h = 4 GPa on 65², start-up included; every step converged:
//!
//! | U, m/s | S | steps | Newtons a step | tried again | halved | on the safe side | mass error | overlap, nm | contact |
//! |---|---|---|---|---|---|---|---|---|---|
//! | 0.1 | 2 | 136 | 5.5 | 0 | 0 | 0 | 6.9e-5 | 0 | 0.37 |
//! | 0.1 | −2 | 136 | 5.6 | 0 | 0 | 0 | 2.9e-5 | 0 | 0.30 |
//! | 1e-3 | 2 | 136 | 13.5 | 29 | 0 | 0 | 7.4e-5 | 0 | 0.77 |
//! | 1e-4 | 2 | 136 | 18.4 | 49 | 7 | 0 | 8.0e-5 | 0.033 | 0.81 |
//! | 1e-4 | −2 | 136 | 26.0 | 86 | 29 | 0 | 5.2e-5 | 0.036 | 0.69 |
//!
//! With tangents in place of secants, and pivots of either sign (`solve/reynolds/closing.rs`), the last three took 36.8,
//! 58.9 and 67.3 Newtons a step, and on 129² both runs ended by name while the roughness came up. There, at 1e-4 m/s,
//! every step converges now (six to eight minutes):
//!
//! | p_h, GPa | S | steps | Newtons a step | tried again | halved | mass error | overlap, nm | contact |
//! |---|---|---|---|---|---|---|---|---|
//! | 1.73 | −2 | 296 | 141.5 | 1513 | 126 | 9.9e-5 | 0.044 | 0.27 |
//! | 1.73 | 2 | 296 | 123.2 | 1333 | 129 | 1.0e-4 | 0.045 | 0.27 |
//! | 4 | −2 | 296 | 87.9 | 864 | 116 | 1.0e-4 | 0.042 | 0.31 |
//! | 4 | 2 | 296 | 94.7 | 944 | 114 | 9.9e-5 | 0.044 | 0.42 |
#![expect(clippy::unwrap_used, reason = "tests")]

use crate::common::stiff::{Stiff, sets};
use asperity_engine::plan::Plan;
use asperity_engine::scene::{Override, Scene};
use asperity_engine::sim::{Frame, Knob, SimError, Simulation, Stage, StepError};

/// How it went.
#[derive(Debug, Default)]
struct Outcome {
    steps: u32,
    named: u32,
    worst_mass: f64,
    worst_load: f64,
    newton: u32,
    retries: u64,
    halved: u64,
    safer: u64,
    contact: f64,
    stalled: Option<String>,
    passage_steps: u64,
    /// Deepest overlap of the surfaces, nm.
    overlap_nm: f64,
}

/// Runs the start-up and `steps` steps; judges every one.
fn run(stiff: Stiff, steps: u64, more: &[&str]) -> Outcome {
    let sets = sets(stiff);
    let all = sets.iter().map(String::as_str).chain(more.iter().copied());
    let sets: Vec<Override> = all.map(|s| s.parse().unwrap()).collect();
    let scene = Scene::load_with("demonstration_quick", &sets).unwrap();
    let tolerance = scene.numerics.tolerance;
    let mut sim = Simulation::new(&scene, Plan::new(&scene).unwrap(), 1).unwrap();
    let mut frame = Frame::default();
    let mut outcome = Outcome::default();
    while sim.passage_steps() < steps {
        if let Err(error) = sim.step() {
            // Not kept, and told: where, when, how much.
            let StepError::Stalled { unsolved, .. } = &error else {
                panic!("{stiff:?}: {error}");
            };
            assert!(unsolved.residual.is_finite());
            outcome.stalled = Some(error.to_string());
            break;
        }
        sim.fill(&mut frame);
        let fields = [&frame.pressure_pa, &frame.film_m, &frame.traction_pa];
        assert!(
            fields
                .iter()
                .all(|field| field.iter().all(|v| v.is_finite()))
        );
        assert!(frame.pressure_pa.iter().all(|p| *p >= 0.0));
        let lowest = frame.film_m.iter().copied().fold(f32::INFINITY, f32::min);
        outcome.overlap_nm = outcome.overlap_nm.max(-1e9 * f64::from(lowest));
        let metrics = sim.metrics();
        outcome.steps += 1;
        outcome.named += u32::from(!metrics.converged);
        outcome.newton += metrics.newton_iterations;
        outcome.worst_mass = outcome.worst_mass.max(metrics.mass_error);
        outcome.worst_load = outcome.worst_load.max(metrics.load_error);
        if metrics.converged {
            // What is called converged is so.
            assert!(metrics.residual <= tolerance, "{metrics:?}");
            assert!(
                metrics.load_error <= 1e-4 && metrics.mass_error <= 1e-3,
                "{metrics:?}"
            );
        }
        if sim.stage() == Stage::Passage {
            outcome.contact = metrics.contact_ratio;
        }
    }
    outcome.passage_steps = sim.passage_steps();
    let stats = sim.stats();
    outcome.retries = stats.retries;
    outcome.halved = stats.halved;
    outcome.safer = stats.safer;
    outcome
}

/// Deepest overlap that the film's tolerance leaves, nm: a fifteen-thousandth of the waves' amplitude.
const OVERLAP_NM: f64 = 0.1;

fn table(cases: &[Stiff], steps: u64) {
    println!(
        "p_h GPa U m/s S nodes² | steps, not converged but named, Newtons a step, tried again, halved, on the safe \
         side | worst mass and load error | overlap nm | contact | stalled"
    );
    for stiff in cases {
        let found = run(*stiff, steps, &[]);
        println!(
            "{} {:e} {} {} | {} {} {:.1} {} {} {} | {:.1e} {:.1e} | {:.3} | {:.2} | {}",
            stiff.p_hertz_pa * 1e-9,
            stiff.speed_m_s,
            stiff.slide_roll,
            stiff.nodes,
            found.steps,
            found.named,
            f64::from(found.newton) / f64::from(found.steps.max(1)),
            found.retries,
            found.halved,
            found.safer,
            found.worst_mass,
            found.worst_load,
            found.overlap_nm,
            found.contact,
            found.stalled.as_deref().unwrap_or("no"),
        );
        assert!(found.overlap_nm < OVERLAP_NM, "{stiff:?}: {found:?}");
        // Every case converges today: one that stalls, or leaves a step by name, is worse than that.
        assert_eq!(found.stalled, None, "{stiff:?}");
        assert_eq!(found.named, 0, "{stiff:?}: {found:?}");
        assert_eq!(found.passage_steps, steps, "{stiff:?}: {found:?}");
        assert!(found.contact > 0.2, "{stiff:?}: it is a mixed contact");
    }
}

#[test]
fn steps_of_the_stiff_set_converge() {
    let stiff = |speed_m_s, slide_roll| Stiff {
        p_hertz_pa: 4e9,
        speed_m_s,
        slide_roll,
        nodes: 65,
    };
    table(
        &[
            stiff(0.1, 2.0),
            stiff(0.1, -2.0),
            stiff(1e-3, 2.0),
            stiff(1e-4, 2.0),
            stiff(1e-4, -2.0),
        ],
        8,
    );
}

#[test]
#[ignore = "minutes"]
fn the_stiff_set_on_129() {
    let mut cases = Vec::new();
    for p_hertz_pa in [1.73e9, 4e9] {
        for slide_roll in [-2.0, 2.0] {
            cases.push(Stiff {
                p_hertz_pa,
                speed_m_s: 1e-4,
                slide_roll,
                nodes: 129,
            });
        }
    }
    table(&cases, 8);
}

/// What cannot converge, to 1e-9 with two Newton iterations a part, is named or ends the run; it never passes. (To the
/// usual 1e-3 two are enough on 65²: all 136 steps converge in parts.)
#[test]
fn steps_that_cannot_converge_are_named() {
    let stiff = Stiff {
        p_hertz_pa: 4e9,
        speed_m_s: 1e-3,
        slide_roll: 2.0,
        nodes: 33,
    };
    let found = run(
        stiff,
        8,
        &["numerics.max_iterations=2", "numerics.tolerance=1e-9"],
    );
    println!("two iterations a step: {found:?}");
    assert!(found.named > 0 || found.stalled.is_some(), "{found:?}");
}

/// Dry steps that are called converged are so, by their gaps too, in the contacts that did not settle before: bodies as
/// unlike as they can be, with as much friction as there is. No dry scene is known that does not converge now; that gaps
/// are told where a solution is cut short is asserted in `tests/engine/hertz_dry.rs`.
#[test]
fn dry_steps_of_unlike_bodies_converge_with_any_friction() {
    let dry = |more: &[&str]| {
        let sets = [
            "lubricant=none",
            "grid.nodes=65",
            "life=none",
            "stress=none",
            "motion.slide_roll=1",
            "body_1.surface.wavelength_x_m=6e-4",
            "body_2.surface.wavelength_x_m=6e-4",
            "body_2.surface.wavelength_y_m=6e-4",
            "body_1.young_pa=2e10",
            "body_1.poisson=0.1",
        ];
        let sets = sets.iter().chain(more);
        let sets: Vec<Override> = sets.map(|s| s.parse().unwrap()).collect();
        let scene = Scene::load_with("demonstration_quick", &sets).unwrap();
        let mut sim = Simulation::new(&scene, Plan::new(&scene).unwrap(), 1).unwrap();
        while sim.passage_steps() < 2 {
            sim.step().unwrap();
            let metrics = sim.metrics();
            assert_eq!(metrics.asked, [1e-6; 2], "of dry steps");
            let [residual, gap] = metrics.asked;
            println!(
                "{more:?}: {:.1e}, {:.1e}",
                metrics.residual, metrics.film_error
            );
            assert!(metrics.converged, "{metrics:?}");
            assert!(metrics.residual <= residual && metrics.film_error <= gap);
        }
    };
    dry(&["friction.boundary=0.5"]);
    dry(&["friction.boundary=1"]);
    dry(&["friction.boundary=1", "body_1.young_pa=1e9"]);
    dry(&[
        "friction.boundary=1",
        "body_1.young_pa=1e9",
        "body_1.poisson=0",
    ]);
}

/// A load turned up by hand is taken as far as its contact stays within the domain, and refused beyond with the
/// greatest that is taken.
#[test]
fn a_load_is_taken_up_to_the_edge_of_the_domain() {
    let sets = [
        "grid.nodes=65",
        "stress=none",
        "life=none",
        "body_1.surface.amplitude_m=3e-7",
        "body_2.surface.amplitude_m=3e-7",
    ];
    let sets: Vec<Override> = sets.iter().map(|s| s.parse().unwrap()).collect();
    let scene = Scene::load_with("demonstration_quick", &sets).unwrap();
    let plan = Plan::new(&scene).unwrap();
    let most = plan.maximum_force_n();
    let mut sim = Simulation::new(&scene, plan, 1).unwrap();
    let Err(SimError::Knob { value, allowed, .. }) = sim.set(Knob::ForceN, 1.001 * most) else {
        panic!("refused");
    };
    assert!(
        value > most && allowed.contains(&format!("at most {most:.4e}")),
        "{allowed}"
    );
    sim.set(Knob::ForceN, most).unwrap();
    // The ramp takes 4 a/U.
    while sim.passage_steps() < 80 {
        sim.step().unwrap();
        assert!(sim.metrics().converged, "{:?}", sim.metrics());
    }
    assert_eq!(sim.metrics().load_n, most);
}
