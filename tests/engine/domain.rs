//! What truncating the domain costs: the measurement behind the plan's rule for inlet and width, and what the plan says of
//! contacts that hardly deform against the truth.
//!
//! Smooth circular contacts at one spacing, dx = 6/64, so that only the edges differ; the reference
//! has its inlet at −9 a and its sides at ±5 a. Printed by
//! `cargo test --release --test engine domain:: -- --ignored --nocapture`.

#![expect(clippy::unwrap_used, reason = "tests")]

use crate::common::contact::{CIRCLE, Case, Fluid, LOAD, TOLERANCE, central, minimum};
use asperity_engine::math::grid::{Grid, Symmetry};
use asperity_engine::plan::Plan;
use asperity_engine::scene::{Override, Scene};
use asperity_engine::sim::Simulation;
use asperity_engine::solve::march::{Conditions, Flow, Guess, March};

const DX: f64 = 6.0 / 64.0;

/// Central and minimum film of a smooth contact with the inlet and half-width given, in nodes.
fn films(case: &Case, inlet: usize, half: usize) -> (f64, f64) {
    let outlet = 16;
    let grid = Grid {
        nx: inlet + outlet + 1,
        ny: half + 1,
        x_min: -(inlet as f64) * DX,
        dx: DX,
        y_first: 0.0,
        dy: DX,
        symmetry: Symmetry::MirrorY,
    };
    let steps = grid.nx;
    let guess = 1.2 * case.lambda.powf(0.67);
    let mut march = March::from_hertz(grid, &CIRCLE, guess, 1.0, Flow::Film);
    let conditions = Conditions {
        medium: &case.medium,
        law: None,
        shift: &[],
        load: LOAD,
        tolerance: TOLERANCE,
    };
    for _ in 0..steps {
        let _ = march.attempt(&conditions, 1.0, Guess::Extrapolated);
        march.commit(1.0);
    }
    (central(&march), minimum(&march))
}

#[test]
#[ignore = "a measurement of minutes, whose results stand in src/engine/plan/truncation.rs"]
fn errors_of_truncation() {
    for l in [2.0, 5.0, 10.0, 20.0] {
        for m in [5.0, 10.0, 20.0, 50.0, 100.0, 200.0] {
            let case = Case::moes(m, l, Fluid::BarusIncompressible, (-4.5, 1.5, 3.0));
            let far = films(&case, 96, 53);
            print!("M {m} L {l} H_c {:.4} h_min {:.4} inlet", far.0, far.1);
            for inlet in [20, 22, 24, 27, 32, 37, 43, 48, 64] {
                let near = films(&case, inlet, 53);
                let x = inlet as f64 * DX;
                print!(
                    " {x:.2}:{:.5}/{:.5}",
                    near.0 / far.0 - 1.0,
                    near.1 / far.1 - 1.0
                );
            }
            print!(" half");
            for half in [16, 18, 22, 27, 32, 43] {
                let near = films(&case, 96, half);
                let y = half as f64 * DX;
                print!(
                    " {y:.2}:{:.5}/{:.5}",
                    near.0 / far.0 - 1.0,
                    near.1 / far.1 - 1.0
                );
            }
            println!();
        }
    }
}

/// E' of steel on steel, Pa, and 2Ū of the scenes below.
const E_PRIME_PA: f64 = 2e11 / 0.91;
const DOUBLE_SPEED: f64 = 1e-11;
const RADIUS_M: f64 = 0.01;

/// A smooth circular contact, or a line, of Moes' M and L in an incompressible Barus oil.
fn scene(is_line: bool, (m, l): (f64, f64), more: &[String]) -> Scene {
    let load = if is_line {
        let force = m * DOUBLE_SPEED.sqrt() * E_PRIME_PA * RADIUS_M;
        ["contact.kind=line", "contact.ry_m=none"]
            .map(str::to_owned)
            .into_iter()
            .chain([format!("load.force_n_per_m={force}")])
            .collect()
    } else {
        let force = m * DOUBLE_SPEED.powf(0.75) * E_PRIME_PA * RADIUS_M.powi(2);
        vec![
            format!("contact.ry_m={RADIUS_M}"),
            format!("load.force_n={force}"),
        ]
    };
    let viscosity = 0.5 * DOUBLE_SPEED * E_PRIME_PA * RADIUS_M;
    let alpha = l / (E_PRIME_PA * DOUBLE_SPEED.powf(0.25));
    let common = [
        "numerics.order=second",
        "body_1.surface=none",
        "body_2.surface=none",
        "body_1.surface.kind=smooth",
        "body_2.surface.kind=smooth",
        "life=none",
        "stress=none",
        "record=none",
        "load.force_n=none",
        "lubricant.viscosity_law=barus",
        "lubricant.density_law=incompressible",
        "lubricant.rheology=newtonian",
        "motion.slide_roll=0",
        "motion.entrainment_m_s=1",
        "numerics.tolerance=1e-4",
    ];
    let sets: Vec<Override> = common
        .map(str::to_owned)
        .into_iter()
        .chain(load)
        .chain([
            format!("contact.rx_m={RADIUS_M}"),
            format!("lubricant.viscosity_pa_s={viscosity}"),
            format!("lubricant.pressure_viscosity_per_pa={alpha}"),
        ])
        .chain(more.iter().cloned())
        .map(|set| set.parse().unwrap())
        .collect();
    Scene::load_with("demonstration_quick", &sets).unwrap()
}

/// Central film over that by formula, and what the plan says the film loses by edges and mesh.
fn solved(scene: &Scene) -> (f64, f64) {
    let plan = Plan::new(scene).unwrap();
    let film = plan.film.unwrap();
    let truncation = film.truncation();
    let said = plan.domain.edge_error(&truncation) + truncation.mesh_error(plan.domain.dx_a());
    let mut sim = Simulation::new(scene, plan, 1).unwrap();
    while !sim.is_done() {
        sim.step().unwrap();
    }
    assert!(sim.metrics().converged);
    (sim.metrics().h_central_m / film.central_m, said)
}

/// Against rigid bodies in an oil of one viscosity: Reynolds' equation with P ≥ 0 between paraboloids, W = 12 ηU Rx √(2 Rx/h)
/// Rx 0.3507 (circle; on a stretched grid that reaches to 3000 √(2 Rx h)), so 35.4/M² in Moes units, and W = 4.893 ηU Rx/h
/// (line; Martin's 4.9), so 2.4465/M. The regressions say 41.3/M² and 3/M.
#[test]
fn contacts_that_hardly_deform_have_the_film_of_rigid_bodies() {
    for (is_line, m, exact) in [(false, 0.5, 35.4 / 41.3), (true, 0.3, 2.4465 / 3.0)] {
        for nodes in [33, 65, 129] {
            let scene = scene(is_line, (m, 0.5), &[format!("grid.nodes={nodes}")]);
            let (film, said) = solved(&scene);
            let error = film / exact - 1.0;
            println!("line {is_line} M {m}, {nodes} nodes: {error:.4} off, {said:.4} said");
            assert!(error.abs() < said + 0.01, "{error} {said}");
        }
    }
}

/// Between rigid and elastic, against a domain four times as long and wide, and the regression.
#[test]
fn contacts_that_hardly_deform_starve_no_more_than_the_plan_says() {
    for (is_line, m, l) in [
        (false, 2.0, 1.0),
        (false, 5.0, 10.0),
        (true, 1.0, 5.0),
        (true, 4.0, 10.0),
    ] {
        let own = Plan::new(&scene(is_line, (m, l), &[])).unwrap().domain;
        let mut wide = vec![
            "grid.nodes=257".to_owned(),
            format!("grid.x_min_a={}", 4.0 * own.x_min_a),
            format!("grid.x_max_a={}", 4.0 * own.x_max_a),
        ];
        if !is_line {
            wide.push(format!("grid.y_half_a={}", 4.0 * own.y_half_b));
        }
        let (truth, truth_said) = solved(&scene(is_line, (m, l), &wide));
        assert!((0.7..1.3).contains(&truth), "the regression: {truth}");
        for nodes in [33, 65, 129] {
            let scene = scene(is_line, (m, l), &[format!("grid.nodes={nodes}")]);
            let (film, said) = solved(&scene);
            let error = film / truth - 1.0;
            println!(
                "line {is_line} M {m} L {l}, {nodes} nodes: {error:.4} off, {said:.4} and {truth_said:.4} said"
            );
            assert!(error.abs() < said + truth_said + 0.01, "{error} {said}");
        }
    }
}
