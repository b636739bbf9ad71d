//! Smooth elliptical contacts, Ry/Rx from 0.2 to 20 with the entrainment along x, against the regression formulas.
//!
//! Barus' law, incompressible, Newtonian, as the formulas are; p_h = 0.7 GPa, so that M grows with the contact's
//! width. The film is that of 129², extrapolated with 65² at second order.
//!
//! *The formulas' own scatter.* Nijenbanning, Venner and Moes lie 7 to 13 % below computed films of circular
//! contacts (tests of `film_regression`). Hamrock and Dowson, a fit to coarse grids, give films of circular
//! contacts that differ from computed ones by −13 to +5 % (central) and up to 90 % (minimum, M = 1000); both
//! were fitted for Ry ≥ Rx and extrapolate below.
#![expect(clippy::unwrap_used, reason = "tests")]

use asperity::physics::film_regression::{
    hamrock_dowson_central_m, hamrock_dowson_minimum_m, nijenbanning_central_m,
};
use asperity::physics::groups::OperatingPoint;
use asperity::plan::Plan;
use asperity::scene::{Override, Scene};
use asperity::sim::{Frame, Simulation, Stage};

/// Central and minimum film, m, of 65² and 129².
fn films(ratio: f64) -> (OperatingPoint, [[f64; 2]; 2]) {
    let sets = [
        "contact.rx_m=0.01".to_owned(),
        format!("contact.ry_m={}", 0.01 * ratio),
        "load.force_n=none".to_owned(),
        "load.hertz_pressure_pa=7e8".to_owned(),
        "lubricant.viscosity_pa_s=0.04".to_owned(),
        "lubricant.pressure_viscosity_per_pa=2.2e-8".to_owned(),
        "lubricant.viscosity_law=barus".to_owned(),
        "lubricant.density_law=incompressible".to_owned(),
        "lubricant.rheology=newtonian".to_owned(),
        "motion.entrainment_m_s=1".to_owned(),
        "motion.slide_roll=0".to_owned(),
        "body_1.surface.kind=smooth".to_owned(),
        "body_2.surface.kind=smooth".to_owned(),
        "grid.nodes=129".to_owned(),
        "life=none".to_owned(),
        "stress=none".to_owned(),
    ];
    let sets: Vec<Override> = sets.iter().map(|s| s.parse().unwrap()).collect();
    let scene = Scene::load_with("demonstration", &sets).unwrap();
    let mut sim = Simulation::new(&scene, Plan::new(&scene).unwrap(), 2).unwrap();
    let mut frame = Frame::default();
    let mut films = [[0.0; 2]; 2];
    loop {
        sim.step().unwrap();
        let metrics = sim.metrics();
        assert!(metrics.converged, "Ry/Rx = {ratio}");
        let found = [metrics.h_central_m, metrics.h_min_m];
        sim.fill(&mut frame);
        films[usize::from(frame.nx > 65)] = found;
        if sim.stage() == Stage::Passage {
            return (scene.operating_point().unwrap(), films);
        }
    }
}

#[test]
fn films_of_ellipses_meet_the_formulas_within_their_scatter() {
    println!(
        "Ry/Rx |   M    L  | h_c 65² 129² extrapolated, nm | NVM         | HD          | h_min, nm               | HD"
    );
    let mut last = 0.0;
    for ratio in [0.2, 0.5, 1.0, 3.0, 10.0, 20.0] {
        let (point, [coarse, fine]) = films(ratio);
        let film = [0, 1].map(|k| fine[k] + (fine[k] - coarse[k]) / 3.0);
        let formulas = [
            nijenbanning_central_m(&point),
            hamrock_dowson_central_m(&point),
            hamrock_dowson_minimum_m(&point),
        ];
        let off = [
            formulas[0] / film[0] - 1.0,
            formulas[1] / film[0] - 1.0,
            formulas[2] / film[1] - 1.0,
        ];
        let groups = point.groups();
        let nm = |h: f64| 1e9 * h;
        println!(
            "{ratio:5} | {:5.1} {:4.1} | {:6.1} {:6.1} {:6.1} | {:6.1} {:+5.1} % | {:6.1} {:+5.1} % | {:6.1} {:6.1} \
             {:6.1} | {:6.1} {:+5.1} %",
            groups.m,
            groups.l,
            nm(coarse[0]),
            nm(fine[0]),
            nm(film[0]),
            nm(formulas[0]),
            100.0 * off[0],
            nm(formulas[1]),
            100.0 * off[1],
            nm(coarse[1]),
            nm(fine[1]),
            nm(film[1]),
            nm(formulas[2]),
            100.0 * off[2],
        );
        assert!(off[0].abs() < 0.15, "Nijenbanning, {ratio}: {off:?}");
        assert!(off[1].abs() < 0.15, "Hamrock-Dowson, {ratio}: {off:?}");
        assert!(film[0] > last, "a wider contact carries the thicker film");
        last = film[0];
    }
}
