//! Smooth elliptical contacts, Ry/Rx from 0.2 to 20 with the entrainment along x, against the regression formulas.
//!
//! Barus' law, incompressible, Newtonian, as the formulas are; p_h = 0.7 GPa, so that M grows with the contact's
//! width (L = 11.9). The film is that of 129², extrapolated with 65² at second order; nm, and how far the formulas
//! (Nijenbanning-Venner-Moes, Hamrock-Dowson) lie from it:
//!
//! | Ry/Rx | M | h_c | NVM | HD | h_min | HD |
//! |---|---|---|---|---|---|---|
//! | 0.2 | 7.4 | 185.9 | −19.3 % | +27.3 % | 89.2 | −12.6 % |
//! | 0.5 | 21.7 | 268.7 | −15.2 % | −4.2 % | 136.9 | −12.5 % |
//! | 1 | 45.1 | 318.9 | −11.2 % | −11.8 % | 177.1 | −9.3 % |
//! | 3 | 122.7 | 358.4 | −7.3 % | −10.0 % | 237.1 | −3.5 % |
//! | 10 | 305.2 | 371.5 | −5.3 % | −7.8 % | 282.1 | −4.3 % |
//! | 20 | 486.7 | 374.2 | −4.7 % | −9.5 % | 284.2 | −4.5 % |
//!
//! *The formulas' own scatter.* For circular contacts the first lies 7 to 13 % below films computed and
//! extrapolated by two other codes (tests of `film_regression`), and the second, a fit to coarse grids of 1977, is
//! no better. Both were fitted for Ry ≥ Rx. Beyond that they extrapolate: at Ry/Rx = 0.2 they are 58 % apart, and
//! the computed film lies between them.
#![expect(clippy::unwrap_used, reason = "tests")]

use asperity_engine::physics::film_regression::{
    hamrock_dowson_central_m, hamrock_dowson_minimum_m, nijenbanning_central_m,
};
use asperity_engine::physics::groups::PointContact;
use asperity_engine::plan::Plan;
use asperity_engine::scene::{Override, Scene};
use asperity_engine::sim::{Frame, Simulation, Stage};

/// Central and minimum film, m, of 65² and 129².
fn films(ratio: f64, more: &[&str]) -> (PointContact, [[f64; 2]; 2]) {
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
    let all = sets.iter().map(String::as_str).chain(more.iter().copied());
    let sets: Vec<Override> = all.map(|s| s.parse().unwrap()).collect();
    let scene = Scene::load_with("demonstration_quick", &sets).unwrap();
    let mut sim = Simulation::new(&scene, Plan::new(&scene).unwrap(), 1).unwrap();
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
        let (point, [coarse, fine]) = films(ratio, &[]);
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
        // Fitted for Ry >= Rx: within their scatter there. Beyond, they disagree with each other by up to 60 %.
        let bounds = if ratio >= 1.0 {
            [0.13, 0.13, 0.13]
        } else {
            [0.2, 0.3, 0.13]
        };
        for (off, bound) in off.into_iter().zip(bounds) {
            assert!(off.abs() < bound, "Ry/Rx = {ratio}: {off}");
        }
        assert!(film[0] > last, "a wider contact carries the thicker film");
        last = film[0];
    }
}

#[test]
fn the_film_of_a_narrow_ellipse_is_not_cut_by_its_domain() {
    let films = |more: &[&str]| films(0.2, more).1;
    let [usual, wide] = [films(&[]), films(&["grid.y_half_a=4", "grid.x_min_a=-4"])];
    let changes = [0, 1].map(|k| (wide[1][k] / usual[1][k] - 1.0).abs());
    println!("sides at 4 b and the inlet at -4 a change h_c and h_min by {changes:.4?}");
    // The plan's own promise: 0.5 % for the inlet, 0.25 % for the sides; the mesh of the wider domain is coarser.
    assert!(changes.iter().all(|&change| change < 0.01), "{changes:?}");
}
