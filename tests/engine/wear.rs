//! Wear against closed forms, ageing against its own tolerance, and what is refused.
#![expect(clippy::unwrap_used, reason = "tests")]

use crate::whole::{goes_on_bit_for_bit, run, scene, small_demonstration};
use asperity_engine::plan::Plan;
use asperity_engine::scene::{Override, Scene};
use asperity_engine::sim::{Frame, Simulation, Summary};

const DRY_LINE: &str = r#"
[contact]
kind = "line"
rx_m = 7.6666667e-3
[body_1]
young_pa = 2.093e11
[body_2]
young_pa = 2.093e11
[motion]
entrainment_m_s = 1.0
slide_roll = 0.5
[load]
hertz_pressure_pa = 1.5e9
[grid]
nodes = 257
[numerics]
error_estimate = "none"
[wear]
coefficient_1_per_pa = 1e-18
coefficient_2_per_pa = 1e-18
"#;

/// Dry and smooth: k (|Δu|/U_i) (π/2) p_h a of a loading cycle on each body, of a line (exact whatever the mesh, as the load is
/// carried exactly) and on the centre line of a point (by the mesh of its pressure), for either body the faster one, and with
/// the flow turned round. Not sliding, it does not wear.
#[test]
fn smooth_bodies_lose_what_archard_says() {
    let point = DRY_LINE.replace("\"line\"", "\"point\"").replace(
        "rx_m = 7.6666667e-3",
        "rx_m = 7.6666667e-3\nry_m = 7.6666667e-3",
    );
    for (base, room) in [(DRY_LINE, 1e-9), (&point[..], 2e-3)] {
        for (u, s) in [(1.0, 0.5), (1.0, -0.5), (-1.0, 0.5), (1.0, 1.5), (1.0, 0.0)] {
            let sets = [
                format!("motion.entrainment_m_s={u}"),
                format!("motion.slide_roll={s}"),
                "grid.nodes=129".to_owned(),
            ];
            let scene = scene(base, &sets);
            let found = run(&scene);
            assert_eq!(found.cycles, Some(1.0));
            let hertz = scene.hertz();
            let load = std::f64::consts::FRAC_PI_2 * hertz.p_max_pa * hertz.a_m;
            let depths = [found.wear_depth_1_m, found.wear_depth_2_m];
            for (depth, speed) in depths.into_iter().zip([1.0 - 0.5 * s, 1.0 + 0.5 * s]) {
                let theirs = 1e-18 * f64::abs(s) / f64::abs(speed) * load;
                let off = (depth.unwrap() - theirs).abs();
                assert!(off <= room * theirs, "{u} {s}: {depth:?}, not {theirs:e}");
            }
        }
    }
}

/// A smooth oil film wears where it is thinner than `wear.thin_film_m`: k (|Δu|/U_i) ∫ p s dx of each body, where s grows from 0
/// at that thickness to 1 at that of a contact, added up here from pressure and film in SI as a frame has them; as thick as the
/// film's thickest part it wears next to everywhere, below its thinnest nowhere.
#[test]
fn thin_films_wear_by_their_share() {
    let mut depths = Vec::new();
    for thin_film_m in [0.0, 2e-8, 2e-7, 4e-7] {
        let sets = [
            "body_1.surface=none".to_owned(),
            "body_2.surface=none".to_owned(),
            "motion.slide_roll=0.5".to_owned(),
            "numerics.ladder=false".to_owned(),
            "numerics.error_estimate=none".to_owned(),
            "wear.coefficient_1_per_pa=1e-18".to_owned(),
            "wear.coefficient_2_per_pa=2e-18".to_owned(),
            format!("wear.thin_film_m={thin_film_m:e}"),
        ];
        let sets: Vec<Override> = sets.iter().map(|set| set.parse().unwrap()).collect();
        let scene = Scene::load_with("fzg_point_b", &sets).unwrap();
        let found = run(&scene);
        let mut sim = Simulation::new(&scene, Plan::new(&scene).unwrap(), 1).unwrap();
        while sim.passage_steps() < 2 {
            sim.step().unwrap();
        }
        let mut frame = Frame::default();
        sim.fill(&mut frame);
        let touch_m = scene.friction.contact_film_m;
        let shares = frame.pressure_pa.iter().zip(&frame.film_m).take(frame.nx);
        let rubs: f64 = shares
            .map(|(&p, &h)| {
                let share = if thin_film_m > touch_m {
                    (thin_film_m - f64::from(h)) / (thin_film_m - touch_m)
                } else {
                    0.0
                };
                f64::from(p) * share.clamp(0.0, 1.0) * frame.dx_m
            })
            .sum();
        println!("films below {thin_film_m:e} m: {:?}", found.wear_depth_1_m);
        let both = [
            (found.wear_depth_1_m, 1e-18, 0.75),
            (found.wear_depth_2_m, 2e-18, 1.25),
        ];
        for (depth, k, speed) in both {
            let theirs = k * 0.5 / speed * rubs;
            assert!(
                (depth.unwrap() - theirs).abs() <= 1e-3 * theirs,
                "{depth:?}, not {theirs:e}"
            );
        }
        depths.push(found.wear_depth_1_m.unwrap());
    }
    assert_eq!(depths[..2], [0.0; 2]);
    assert!(depths[2] > 0.0 && depths[3] > depths[2]);
}

/// A crest of body 1 in full contact (E* 115 GPa, λ 50 µm, b 0.2 mm, k 1e-18/Pa, S .5) loses 1.92684e-6 of its height a passage:
/// half of it after 359 732 (`assets/reference`: computed by hand). Of 20 nm, whose pressure is 145 MPa, all but the outermost
/// half per cent of the half-width is in full contact. On both meshes the error at .02 is that of the jumps: it goes with them.
#[test]
fn a_crest_is_halved_after_as_many_cycles_as_the_closed_form_says() {
    let wave = [
        "body_1.surface.kind=sinusoid",
        "body_1.surface.amplitude_m=2e-8",
        "body_1.surface.wavelength_x_m=5e-5",
        "wear.coefficient_2_per_pa=0",
        "age.cycles=359732",
    ];
    let mut last = f64::INFINITY;
    for (nodes, tolerance, room) in [(257, 0.02, 0.02), (513, 0.02, 0.02), (513, 0.002, 0.001)] {
        let own = [
            format!("grid.nodes={nodes}"),
            format!("age.tolerance={tolerance}"),
        ];
        let sets = [&wave.map(str::to_owned)[..], &own].concat();
        let found = run(&scene(DRY_LINE, &sets));
        let (first, aged) = (found.ages[0], found.ages.last().unwrap());
        let left = aged.rq_1_m / first.rq_1_m;
        println!(
            "{nodes} nodes, tolerance {tolerance}: {} points, {left:.4} of the crest left, worn {:.2} and {:?} nm",
            found.ages.len(),
            1e9 * aged.wear_depth_1_m,
            found.wear_depth_2_m
        );
        assert!((left / 0.5 - 1.0).abs() < room, "{left}");
        if tolerance < 0.02 {
            assert!((left - 0.5).abs() < last);
        }
        last = (left - 0.5).abs();
        assert_eq!(found.wear_depth_2_m, None);
        assert!((found.cycles.unwrap() / 359_732.0 - 1.0).abs() < 1e-9);
    }
}

/// A smooth, frictionless contact at rest to itself fails where the calibration point says: its damage grows with the
/// cycles, and reaches 1 where the relative life would be 1.
#[test]
fn a_smooth_contact_pits_when_its_calibration_point_says() {
    for (p_cal, cycles) in [(1.5e9, 1e7), (1.2e9, 3e8)] {
        let sets = [
            "motion.slide_roll=0".to_owned(),
            "grid.nodes=257".to_owned(),
            "stress.depths=32".to_owned(),
            format!("life.calibration_cycles={cycles}"),
            format!("life.calibration_pressure_pa={p_cal}"),
            "age.cycles=2e6".to_owned(),
        ];
        let found = run(&scene(DRY_LINE, &sets));
        let theirs = found.life_cycles.unwrap() / found.life_relative.unwrap();
        for pits in [found.pits_body_1.unwrap(), found.pits_body_2.unwrap()] {
            let first = pits.unworn_first_cycles.unwrap();
            println!(
                "{cycles:e} cycles at {:.1} GPa: pits after {first:.5e}, the smooth contact lives {theirs:.5e}; damage {:.4}",
                1e-9 * p_cal,
                pits.damage_max
            );
            assert!((first / theirs - 1.0).abs() < 0.01);
            assert!((pits.damage_max / (2e6 / theirs) - 1.0).abs() < 0.01);
            assert_eq!(pits.first_cycles.is_some(), theirs < 2e6);
        }
        let area = if theirs < 2e6 { 1.0 } else { 0.0 };
        assert_eq!([found.pitted_area_1, found.pitted_area_2], [Some(area); 2]);
    }
}

/// Where the smooth contact of the calibration point lives for ever no damage is absolute: there is no pitted area, not one of 0.
#[test]
fn without_a_life_of_the_smooth_contact_no_pits_are_told() {
    let sets = [
        "motion.slide_roll=0",
        "grid.nodes=129",
        "stress.depths=16",
        "life.model=ioannides_harris",
        "life.limit_pa=3e9",
        "life.calibration_cycles=1e7",
        "life.calibration_pressure_pa=1.5e9",
        "age.cycles=2e6",
    ];
    let found = run(&scene(DRY_LINE, &sets.map(str::to_owned)));
    assert_eq!((found.cycles, found.ages.len()), (Some(2e6), 2));
    assert_eq!((found.pitted_area_1, found.pits_body_2), (None, None));
    assert!(found.ages.iter().all(|age| age.pitted_area_1.is_none()));
}

/// Rolling on a crest that always meets the same place: it fails (σ_smooth/σ_max)^c times sooner than the smooth contact, with
/// σ_max of the summary. The points that count cycles one by one have the same damage.
#[test]
fn a_crest_that_stays_pits_as_its_stress_says() {
    let wave = [
        "body_1.surface.kind=sinusoid",
        "body_1.surface.amplitude_m=1e-7",
        "body_1.surface.wavelength_x_m=5e-5",
        "motion.slide_roll=0",
        "grid.nodes=513",
        "stress.depths=32",
        "life.calibration_cycles=1e7",
        "life.calibration_pressure_pa=1.5e9",
        "time.passages=4",
    ];
    let stay = scene(DRY_LINE, &wave.map(str::to_owned));
    let plain = run(&stay);
    let aged = run(&scene(
        DRY_LINE,
        &[&wave.map(str::to_owned)[..], &["age.cycles=1e3".to_owned()]].concat(),
    ));
    let c = 31.0 / 3.0;
    let smooth = aged.life_cycles.unwrap() / aged.life_relative.unwrap();
    let sigma = plain.sigma_eff_max_pa.unwrap() / stay.hertz().p_max_pa;
    // Von Mises in plane strain under a Hertz line.
    let by_stress = smooth * (0.5575 / sigma).powf(c);
    let pits = aged.pits_body_1.unwrap();
    let first = pits.unworn_first_cycles.unwrap();
    let by_points = smooth / plain.pit_body_1.unwrap().damage;
    println!(
        "first pit after {first:.4e}; by the greatest stress {by_stress:.4e}, by points that count {by_points:.4e}"
    );
    assert!((first / by_stress).ln().abs() < 0.02, "{first} {by_stress}");
    assert!((first / by_points).ln().abs() < 0.1, "{first} {by_points}");
}

const AGED: [&str; 3] = [
    "wear.coefficient_1_per_pa=1e-18",
    "wear.coefficient_2_per_pa=2e-18",
    "age.cycles=3e6",
];

fn demonstration(sets: &[&str]) -> Scene {
    small_demonstration(&[&AGED[..], sets].concat())
}

/// Mixed lubrication with both bodies rough: depths at two tolerances are within some hundredths of those at a finer one, which
/// takes more points. Blocks have four passages: they are no whole number of periods, and the depths after blocks of two are known to
/// three hundredths only.
#[test]
fn ageing_converges_with_its_tolerance() {
    let runs = [0.08, 0.02, 0.005].map(|tolerance| {
        let asked = format!("age.tolerance={tolerance}");
        let found = run(&demonstration(&[&asked, "time.passages=4"]));
        let depths = [found.wear_depth_1_m, found.wear_depth_2_m].map(Option::unwrap);
        println!(
            "tolerance {tolerance}: {} points, {:.1} and {:.1} nm, Rq {:.2} and {:.2} nm, life {:.4} from {:.4}",
            found.ages.len(),
            1e9 * depths[0],
            1e9 * depths[1],
            1e9 * found.ages.last().unwrap().rq_1_m,
            1e9 * found.ages.last().unwrap().rq_2_m,
            found.life_relative.unwrap(),
            found.ages[0].life_relative.unwrap()
        );
        // The film of a formula stays, the roughness that it is held against does not.
        for age in &found.ages {
            let rougher = found.rq_1_m.hypot(found.rq_2_m) / age.rq_1_m.hypot(age.rq_2_m);
            let lambda = age.lambda_ratio.unwrap() / found.lambda_ratio.unwrap();
            assert!((lambda / rougher - 1.0).abs() < 1e-12, "{lambda} {rougher}");
        }
        (found.ages.len(), depths)
    });
    let apart = |one: [f64; 2], two: [f64; 2]| {
        let off = [0, 1].map(|body: usize| (one[body] / two[body] - 1.0).abs());
        off[0].max(off[1])
    };
    let [coarse, middle, fine] = runs;
    assert!(coarse.0 <= middle.0 && middle.0 < fine.0);
    let (far, near) = (apart(coarse.1, fine.1), apart(middle.1, fine.1));
    println!("against the finest: {far:.4}, {near:.4}");
    assert!(near < 0.025 && far < 0.05, "{far} {near}");
}

/// An aged run that is saved and taken up again, between and within its blocks, ends as the uninterrupted one.
#[test]
fn an_aged_run_goes_on_bit_for_bit() {
    let sets = [
        "age.tolerance=0.08",
        "life.calibration_cycles=1e8",
        "life.calibration_pressure_pa=1.5e9",
    ];
    goes_on_bit_for_bit(&demonstration(&sets), &[300, 555, 700]);
}

/// Without [age] nothing is taken off: every number of a run with [wear] is that of the run without it.
#[test]
fn wear_that_is_not_aged_changes_nothing() {
    let worn = run(&demonstration(&["age=none"]));
    let scene = demonstration(&["age=none", "wear=none"]);
    let plain = run(&scene);
    assert!(worn.wear_depth_1_m.unwrap() > 0.0 && plain.wear_depth_1_m.is_none());
    let as_plain = Summary {
        cycles: None,
        wear_depth_1_m: None,
        wear_depth_2_m: None,
        cautions: plain.cautions.clone(),
        ..worn
    };
    assert_eq!(as_plain, plain);
}

#[test]
fn what_cannot_be_followed_is_refused() {
    let refused = |sets: &[&str]| {
        let sets: Vec<Override> = sets.iter().map(|s| s.parse().unwrap()).collect();
        let error = Scene::load_with("demonstration_quick", &sets).unwrap_err();
        error.to_string()
    };
    let wear = "wear.coefficient_1_per_pa=1e-18";
    let cases: [(&[&str], &str); 5] = [
        (&[wear, "motion.slide_roll=2"], "stands"),
        (&["age.cycles=1e6"], "[wear]"),
        (&[wear, "age.cycles=0"], "age.cycles"),
        (
            &["wear.coefficient_1_per_pa=1"],
            "wear.coefficient_1_per_pa",
        ),
        (
            &[
                wear,
                "body_1.surface.wavelength_y_m=1e-4",
                "body_1.surface.angle_deg=30",
            ],
            "obliquely",
        ),
    ];
    for (sets, word) in cases {
        let told = refused(sets);
        assert!(told.contains(word), "{sets:?}: {told}");
    }
}
