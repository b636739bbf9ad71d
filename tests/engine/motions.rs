//! All motions and all lays: reversal, exchange of the bodies, bodies that stand, ridges turned.

#![allow(clippy::unwrap_used, reason = "tests")]

use asperity_engine::plan::{Plan, TimeDependence};
use asperity_engine::scene::{Override, Scene, presets};
use asperity_engine::sim::{Frame, Knob, Simulation, Stage, Summary};

fn scene(name: &str, sets: &[&str]) -> Scene {
    let sets: Vec<Override> = sets.iter().map(|s| s.parse().unwrap()).collect();
    Scene::load_with(name, &sets).unwrap()
}

/// The frames of the first `steps` steps of the passage, and the summary.
fn run(scene: &Scene, steps: u64) -> (Vec<Frame>, Summary) {
    let plan = Plan::new(scene).unwrap();
    let mut sim = Simulation::new(scene, plan, 1).unwrap();
    let mut frames = Vec::new();
    while sim.passage_steps() < steps {
        sim.step().unwrap();
        if sim.stage() == Stage::Passage {
            let mut frame = Frame::default();
            sim.fill(&mut frame);
            frames.push(frame);
        }
    }
    let summary = sim.summary();
    (frames, summary)
}

/// Rows reversed.
fn mirrored(nx: usize, field: &[f32], sign: f32) -> Vec<u32> {
    let mut out: Vec<f32> = field.iter().map(|v| sign * v).collect();
    out.chunks_exact_mut(nx).for_each(<[f32]>::reverse);
    bits(&out)
}

fn bits(field: &[f32]) -> Vec<u32> {
    // 0 and −0 are one number.
    field.iter().map(|v| (v + 0.0).to_bits()).collect()
}

#[test]
fn reversing_the_flow_is_a_mirror_image() {
    let common = ["grid.nodes=65", "stress.depths=8", "motion.slide_roll=0.7"];
    let with = |more: &[&str]| scene("demonstration_quick", &[&common, more].concat());
    let forward = with(&[
        "body_1.surface.phase_deg=40",
        "body_2.surface.angle_deg=25",
        "body_2.surface.phase_deg=-15",
    ]);
    // z(−x, y): angle and phase change their sign.
    let backward = with(&[
        "motion.entrainment_m_s=-0.2",
        "body_1.surface.phase_deg=-40",
        "body_2.surface.angle_deg=-25",
        "body_2.surface.phase_deg=15",
    ]);
    assert_eq!(forward.motion.entrainment_m_s, 0.2);
    let ((one, sum_one), (two, sum_two)) = (run(&forward, 24), run(&backward, 24));
    assert_eq!(one.len(), two.len());
    for (a, b) in one.iter().zip(&two) {
        let nx = a.nx;
        assert_eq!((a.nx, a.ny), (b.nx, b.ny));
        let x_max = a.x_min_m + (nx - 1) as f64 * a.dx_m;
        assert!((b.x_min_m + x_max).abs() < 1e-15);
        for (forth, back, sign) in [
            (&a.pressure_pa, &b.pressure_pa, 1.0),
            (&a.film_m, &b.film_m, 1.0),
            (&a.roughness_1_m, &b.roughness_1_m, 1.0),
            (&a.roughness_2_m, &b.roughness_2_m, 1.0),
            (&a.traction_pa, &b.traction_pa, -1.0),
        ] {
            assert!(forth.iter().any(|v| *v != 0.0));
            assert!(mirrored(nx, forth, sign) == bits(back));
        }
        let (forth, back) = (a.slice.as_ref().unwrap(), b.slice.as_ref().unwrap());
        assert!(mirrored(nx, &forth.effective_pa, 1.0) == bits(&back.effective_pa));
        assert!(mirrored(nx, &forth.tau_xz_pa, -1.0) == bits(&back.tau_xz_pa));
        let (m, n) = (&a.metrics, &b.metrics);
        assert!(m.converged && n.converged);
        assert_eq!(m.entrainment_m_s, -n.entrainment_m_s);
        assert_eq!(m.sigma_eff_max_x_m, n.sigma_eff_max_x_m.map(|x| -x));
        assert_eq!((m.n_body_1, m.n_body_2), (n.n_body_1, n.n_body_2));
        let point = |frame: &Frame| frame.material_point.unwrap();
        assert_eq!(point(a).x_m, -point(b).x_m);
        assert_eq!(point(a).tau_xz_pa, -point(b).tau_xz_pa);
    }
    assert_eq!(sum_one.life_relative, sum_two.life_relative);
    assert_eq!(sum_one.n_counted_body_1, sum_two.n_counted_body_1);
    assert_eq!(sum_one.p_max_pa, sum_two.p_max_pa);
    // It is a mirror image of something that is not its own.
    let nx = one[0].nx;
    assert!(mirrored(nx, &one[0].film_m, 1.0) != bits(&one[0].film_m));
}

/// Largest difference of two fields over the largest value.
fn distance(a: &[f32], b: &[f32]) -> f64 {
    assert_eq!(a.len(), b.len());
    let largest = a.iter().fold(0.0_f32, |m, v| m.max(v.abs()));
    let apart = a
        .iter()
        .zip(b)
        .fold(0.0_f32, |m, (x, y)| m.max((x - y).abs()));
    f64::from(apart) / f64::from(largest)
}

#[test]
fn exchanging_the_bodies_changes_the_sign_of_sliding_and_nothing_else() {
    let as_is = scene("demonstration_quick", &["grid.nodes=65", "life=none"]);
    let mut exchanged = as_is.clone();
    std::mem::swap(&mut exchanged.body_1, &mut exchanged.body_2);
    exchanged.motion.slide_roll *= -1.0;
    let ((one, first), (two, second)) = (run(&as_is, 16), run(&exchanged, 16));
    let mut worst = 0.0_f64;
    for (a, b) in one.iter().zip(&two) {
        worst = worst.max(distance(&a.pressure_pa, &b.pressure_pa));
        worst = worst.max(distance(&a.film_m, &b.film_m));
        let reversed: Vec<f32> = b.traction_pa.iter().map(|q| -q).collect();
        worst = worst.max(distance(&a.traction_pa, &reversed));
        assert_eq!(a.metrics.n_body_1, b.metrics.n_body_2);
    }
    println!("exchange of bodies: {worst:.1e}");
    // The gap is summed in another order; the steps stop at the same iteration.
    assert!(worst < 1e-4, "{worst}");
    assert_eq!(first.n_body_1, second.n_body_2);
    assert!((first.friction_coefficient / second.friction_coefficient - 1.0).abs() < 1e-5);
}

#[test]
fn zero_entrainment_is_refused_by_name() {
    for value in ["0", "0.0", "-0.0", "1e-7", "-1e-9"] {
        let set: Override = format!("motion.entrainment_m_s={value}").parse().unwrap();
        let text = Scene::load_with("demonstration_quick", &[set])
            .unwrap_err()
            .to_string();
        assert!(text.contains("motion.entrainment_m_s"), "{text}");
        assert!(
            text.contains("1e-6 to 200 m/s, or -200 to -1e-6 m/s; never 0"),
            "{text}"
        );
    }
    let scene = scene(
        "demonstration_quick",
        &["grid.nodes=65", "life=none", "stress=none"],
    );
    let mut sim = Simulation::new(&scene, Plan::new(&scene).unwrap(), 1).unwrap();
    for (value, part) in [
        (0.0, "never 0"),
        (f64::NAN, "never 0"),
        (-1.0, "sign"),
        (300.0, "200 m/s"),
    ] {
        let text = sim.set(Knob::EntrainmentMS, value).unwrap_err().to_string();
        assert!(
            text.contains("motion.entrainment_m_s") && text.contains(part),
            "{text}"
        );
    }
    sim.set(Knob::EntrainmentMS, 0.5).unwrap();
}

#[test]
fn a_body_that_stands_converges_and_has_no_count() {
    for preset in presets::all() {
        for (s, stands) in [("2", 1), ("-2", 2)] {
            let set = format!("motion.slide_roll={s}");
            let coarse = ["grid.nodes=65", &set, "life=none", "stress.depths=8"];
            let sets: Vec<Override> = coarse.iter().map(|s| s.parse().unwrap()).collect();
            let mut scene = Scene::load_with(preset.name, &sets).unwrap();
            if Plan::new(&scene).is_err() {
                scene.grid.nodes = 129;
            }
            let (frames, summary) = run(&scene, 12);
            let converged = frames.iter().filter(|f| f.metrics.converged).count();
            println!(
                "{} at {}² S = {s}: {converged} of {} converged, n {:?} {:?}, counted {:?} {:?}",
                preset.name,
                scene.grid.nodes,
                frames.len(),
                summary.n_body_1,
                summary.n_body_2,
                summary.n_counted_body_1,
                summary.n_counted_body_2,
            );
            assert_eq!(converged, frames.len(), "{} S = {s}", preset.name);
            let n = [summary.n_body_1, summary.n_body_2];
            let counted = [summary.n_counted_body_1, summary.n_counted_body_2];
            // A loading cycle of a body that stands never ends: no number, not infinity.
            assert_eq!(n[stands - 1], None);
            assert_eq!(counted[stands - 1], None);
            assert!(n[2 - stands].unwrap() >= 1.0);
            for frame in &frames {
                assert!(frame.film_m.iter().all(|h| h.is_finite() && *h >= 0.0));
                assert!(frame.pressure_pa.iter().all(|p| p.is_finite() && *p >= 0.0));
            }
        }
    }
}

#[test]
fn ridges_turned_by_a_right_angle_are_longitudinal() {
    let common = [
        "grid.nodes=65",
        "life=none",
        "stress=none",
        "body_1.surface.phase_deg=0",
        "body_2.surface.kind=smooth",
    ];
    let with = |more: &[&str]| scene("demonstration_quick", &[&common, more].concat());
    let turned = with(&[
        "body_1.surface.wavelength_x_m=3e-4",
        "body_1.surface.wavelength_y_m=inf",
        "body_1.surface.angle_deg=90",
    ]);
    let longitudinal = with(&[
        "body_1.surface.wavelength_x_m=inf",
        "body_1.surface.wavelength_y_m=3e-4",
    ]);
    for scene in [&turned, &longitudinal] {
        let plan = Plan::new(scene).unwrap();
        assert!(matches!(
            plan.time_dependence,
            TimeDependence::Steady { .. }
        ));
    }
    let ((one, _), (two, _)) = (run(&turned, 2), run(&longitudinal, 2));
    for (a, b) in one.iter().zip(&two) {
        assert!(a.metrics.converged && b.metrics.converged);
        assert!(a.roughness_1_m.iter().any(|z| *z != 0.0));
        assert!(distance(&a.roughness_1_m, &b.roughness_1_m) < 1e-6);
        assert!(distance(&a.pressure_pa, &b.pressure_pa) < 1e-4);
        assert!(distance(&a.film_m, &b.film_m) < 1e-4);
    }
}

#[test]
fn oblique_ridges_slide_and_converge() {
    for s in ["0.5", "-1"] {
        let scene = scene(
            "demonstration_quick",
            &[
                "grid.nodes=65",
                "life=none",
                "stress=none",
                "body_1.surface.wavelength_x_m=3e-4",
                "body_1.surface.wavelength_y_m=inf",
                "body_1.surface.angle_deg=30",
                &format!("motion.slide_roll={s}"),
            ],
        );
        let (frames, summary) = run(&scene, 32);
        assert!(frames.iter().all(|frame| frame.metrics.converged));
        println!(
            "oblique, S = {s}: n {:?} {:?}",
            summary.n_body_1, summary.n_body_2
        );
        // Crests along x are W/cos 30° apart; body 2 meets those of body 1.
        let u_2 = 1.0 + 0.5 * scene.motion.slide_roll;
        let crests = 30_f64.to_radians().cos() / 3e-4;
        let n = 1.0 + crests * 2.0 * scene.hertz().a_m * scene.motion.slide_roll.abs() / u_2;
        assert!((summary.n_body_2.unwrap() / n - 1.0).abs() < 1e-9);
        // The fields have no mirror in y.
        let frame = &frames[0];
        let flipped: Vec<f32> = frame
            .film_m
            .chunks_exact(frame.nx)
            .rev()
            .flatten()
            .copied()
            .collect();
        assert!(distance(&frame.film_m, &flipped) > 1e-3);
    }
}

/// The traction law of a step is that of the knobs as the step has moved them, not as they were before: what traction
/// does to the pressure of unlike bodies is there in the first step that slides.
#[test]
fn traction_bends_the_film_in_the_step_that_shears_it() {
    let sets = [
        "grid.nodes=65",
        "lubricant=none",
        "motion.slide_roll=0",
        "body_2.surface.kind=smooth",
        "record=none",
    ];
    let scene = scene("ball_on_glass", &sets);
    let mut sim = Simulation::new(&scene, Plan::new(&scene).unwrap(), 1).unwrap();
    while sim.passage_steps() < 1 {
        sim.step().unwrap();
    }
    let pressure = |sim: &Simulation| {
        let mut frame = Frame::default();
        sim.fill(&mut frame);
        frame.pressure_pa
    };
    let moved = |one: &[f32], two: &[f32]| {
        let pairs = one.iter().zip(two);
        let moved: f32 = pairs.map(|(a, b)| (a - b).abs()).sum();
        moved / one.iter().sum::<f32>()
    };
    let rolling = pressure(&sim);
    sim.set(Knob::SlideRoll, 0.5).unwrap();
    sim.step().unwrap();
    let first = pressure(&sim);
    sim.step().unwrap();
    let second = pressure(&sim);
    let (turned, after) = (moved(&rolling, &first), moved(&first, &second));
    println!(
        "pressure moved by {turned:.2e} in the first step that slides, by {after:.2e} in the second"
    );
    // Dry friction is all there with the first slip.
    assert!(turned > 1e-3 && after < 1e-5);
}
