//! What a life is relative to once a load or a speed has been turned: the smooth contact of now, against runs that begin
//! there. Small grids; every test prints what it asserts.

#![allow(clippy::unwrap_used, reason = "tests")]

use asperity_engine::physics::fatigue::LifeLaw;
use asperity_engine::physics::hertz::ContactKind;
use asperity_engine::physics::life_models::LifeEquation;
use asperity_engine::plan::Plan;
use asperity_engine::scene::{Event, Override, Scene};
use asperity_engine::sim::{Frame, Simulation, Summary};

/// Waves that 65 nodes carry, of which both bodies have the same: the passage repeats.
const ROUGH: [&str; 11] = [
    "grid.nodes=65",
    "stress.depths=12",
    "life.damage_map=off",
    "body_1.surface.wavelength_x_m=4e-4",
    "body_2.surface.wavelength_x_m=4e-4",
    "body_2.surface.wavelength_y_m=4e-4",
    "body_1.surface.amplitude_m=3e-7",
    "body_2.surface.amplitude_m=3e-7",
    "body_1.surface.phase_deg=0",
    // By mesh a run that begins at five times the speed takes the other order.
    "numerics.order=second",
    "time.passages=6",
];
/// Depths enough for models that look at the worst of them: of 12, τ0^c of a turned load errs by 4 %.
const SMOOTH: [&str; 4] = [
    "grid.nodes=65",
    "stress.depths=48",
    "body_1.surface.kind=smooth",
    "body_2.surface.kind=smooth",
];

fn scene(name: &str, sets: &[&str]) -> Scene {
    let sets: Vec<Override> = sets.iter().map(|s| s.parse().unwrap()).collect();
    Scene::load_with(name, &sets).unwrap()
}

fn simulation(scene: &Scene) -> Simulation {
    Simulation::new(scene, Plan::new(scene).unwrap(), 1).unwrap()
}

/// The scene with knobs that its script turns as soon as the passage begins.
fn turned(mut scene: Scene, sets: &[(&str, f64)]) -> Scene {
    let set = sets.iter().map(|(key, value)| ((*key).to_owned(), *value));
    scene.events.push(Event {
        at_s: 0.0,
        set: set.collect(),
        caption: String::new(),
    });
    scene
}

/// The scene with its keys set: what a run that begins there has.
fn begun(mut scene: Scene, sets: &[(&str, f64)]) -> Scene {
    for (key, value) in sets {
        match *key {
            "load.force_n" => {
                (scene.load.force_n, scene.load.hertz_pressure_pa) = (Some(*value), None);
            }
            "load.force_n_per_m" => {
                (scene.load.force_n_per_m, scene.load.hertz_pressure_pa) = (Some(*value), None);
            }
            "motion.entrainment_m_s" => scene.motion.entrainment_m_s = *value,
            other => panic!("{other}"),
        }
    }
    scene
}

/// The whole run, the script's events played at the passage's first step.
fn run(scene: &Scene) -> Summary {
    let mut sim = simulation(scene);
    let mut events = scene.events.clone();
    while !sim.is_done() {
        sim.step().unwrap();
        if sim.passage_steps() > 0 {
            for (key, value) in events.drain(..).flat_map(|event| event.set) {
                let knob = asperity_engine::sim::Knob::from_key(&key).unwrap();
                sim.set(knob, value).unwrap();
            }
        }
    }
    sim.summary()
}

struct Pair {
    turned: Summary,
    cold: Summary,
}

fn compare(what: &str, own: &Scene, sets: &[(&str, f64)]) -> Pair {
    let pair = Pair {
        turned: run(&turned(own.clone(), sets)),
        cold: run(&begun(own.clone(), sets)),
    };
    for (name, summary) in [("turned", &pair.turned), ("cold", &pair.cold)] {
        println!(
            "{what}, {name}: i_ref {:.4e}, i_mean {:.4e}, peaks {:.4}, traction {:.4}, life {:.4e} ({:.2e} to {:.2e}), \
             load factor {:.4e}, lambda {:?}, p_h {:.4e}",
            summary.i_ref.unwrap(),
            summary.i_mean.unwrap(),
            summary.peak_factor.unwrap(),
            summary.traction_factor.unwrap(),
            summary.life_relative.unwrap(),
            summary.life_relative_low.unwrap(),
            summary.life_relative_high.unwrap(),
            summary.load_factor.unwrap(),
            summary.lambda_ratio,
            summary.p_hertz_pa,
        );
    }
    pair
}

/// How far two numbers are apart, relative to the second.
fn apart(one: Option<f64>, two: Option<f64>) -> f64 {
    (one.unwrap() / two.unwrap() - 1.0).abs()
}

impl Pair {
    fn agrees(&self, reference: f64, life: f64) {
        let (one, two) = (&self.turned, &self.cold);
        assert!(apart(one.peak_factor, two.peak_factor) < life, "peaks");
        assert!(apart(one.life_relative, two.life_relative) < life, "life");
        self.has_one_reference(reference);
    }

    fn has_one_reference(&self, reference: f64) {
        let (one, two) = (&self.turned, &self.cold);
        assert!(apart(one.i_ref, two.i_ref) < reference, "reference");
        let lambdas = one.lambda_ratio.zip(two.lambda_ratio);
        assert_eq!(one.lambda_ratio.is_some(), two.lambda_ratio.is_some());
        assert!(lambdas.is_none_or(|(one, two)| (one / two - 1.0).abs() < 1e-9));
        assert!(apart(Some(one.p_hertz_pa), Some(two.p_hertz_pa)) < 1e-9);
        assert!(apart(Some(one.a_m), Some(two.a_m)) < 1e-9);
        // A run that begins there is its own base.
        assert!(apart(two.load_factor, Some(1.0)) < 1e-12);
    }
}

#[test]
fn a_load_that_is_turned_up_gives_the_life_of_a_run_that_begins_there() {
    let own = scene("demonstration_quick", &ROUGH);
    let pair = compare("800 to 2376 N", &own, &[("load.force_n", 2376.0)]);
    pair.agrees(0.01, 0.02);
    // Life falls as the smooth contact's does: r^-(c + 3/e), the films' share aside.
    let ratio = (2376.0_f64 / 800.0).cbrt();
    let closed = asperity_engine::physics::estimate::load_factor(
        ContactKind::Point,
        ratio,
        (LifeEquation::Zaretsky, LifeLaw::default()),
    );
    println!("load factor by Hertz {closed:.4e}");
    assert!(apart(pair.turned.load_factor, Some(closed)) < 0.02);
}

#[test]
fn a_speed_that_is_turned_up_gives_the_life_of_a_run_that_begins_there() {
    let own = scene("demonstration_quick", &ROUGH);
    let speed = 5.0 * own.motion.entrainment_m_s;
    let pair = compare("five times U", &own, &[("motion.entrainment_m_s", speed)]);
    // By damage other points of the track are met by other crests: the lives agree within their bands, which are told.
    pair.has_one_reference(0.01);
    let (one, two) = (&pair.turned, &pair.cold);
    let band = one.life_relative_low.unwrap()..one.life_relative_high.unwrap();
    assert!(band.contains(&two.life_relative.unwrap()), "{band:?}");
    assert!(band.end < 1.4 * band.start, "{band:?}");
    // By the paper's count every phase of the period is met alike.
    assert!(apart(one.life_global, two.life_global) < 0.02, "paper");
}

#[test]
fn a_ride_ends_where_a_cold_run_there_begins() {
    // The last but one point of a ride along a tooth: a line, load and speed turned together.
    let sets = ["grid.nodes=129", "stress.depths=12", "time.passages=6"];
    let mut own = scene("fzg_point_a", &sets);
    for body in [&mut own.body_1, &mut own.body_2] {
        body.surface = asperity_engine::scene::Surface::Smooth {};
    }
    compare("smooth ride", &own, &along(&own)).agrees(0.01, 0.02);
}

/// The same with both flanks as rough as the scene has them, on its own grid. Which crests meet where the knobs have come
/// to rest is chance, and a closed orbit keeps it: the turned life lies among those of runs that begin there with another
/// phase, each with its numerical error. Four phases do not meet the extremes of what lies between them: 1 % is left for
/// that (they are up to 2 % apart).
#[test]
fn a_rough_ride_ends_where_a_cold_run_there_begins() {
    rough_rides(&["fzg_point_a", "cam_nose"]);
}

#[test]
#[ignore = "half a minute: two more points of the tooth of the test above"]
fn rough_rides_along_a_tooth() {
    rough_rides(&["fzg_point_b", "fzg_point_e"]);
}

fn rough_rides(names: &[&str]) {
    for &name in names {
        let own = scene(name, &["stress.depths=12", "time.passages=6"]);
        let pair = compare(name, &own, &along(&own));
        pair.has_one_reference(0.01);
        let band =
            |run: &Summary| [run.life_relative_low, run.life_relative_high].map(Option::unwrap);
        let [mut low, mut high] = band(&pair.cold);
        for phase in ["90", "180", "270"] {
            let phase = format!("body_1.surface.phase_deg={phase}");
            let own = scene(name, &["stress.depths=12", "time.passages=6", &phase]);
            let cold = run(&begun(own.clone(), &along(&own)));
            let [least, most] = band(&cold);
            println!(
                "{name}, cold, {phase}: life {:.4e} ({least:.2e} to {most:.2e})",
                cold.life_relative.unwrap()
            );
            (low, high) = (low.min(least), high.max(most));
        }
        let [least, most] = band(&pair.turned);
        assert!(
            least <= 1.01 * high && 0.99 * low <= most,
            "{name}: {least} to {most} against {low} to {high}"
        );
        assert!(high < 1.5 * low, "{name}: a band that says something");
    }
}

/// Load and speed of the next point of a ride.
fn along(own: &Scene) -> [(&'static str, f64); 2] {
    [
        ("load.force_n_per_m", 1.7 * own.force_n()),
        ("motion.entrainment_m_s", 1.2 * own.motion.entrainment_m_s),
    ]
}

#[test]
fn models_and_calibrated_cycles_follow_the_load() {
    for model in [
        "zaretsky",
        "lundberg_palmgren",
        "ioannides_harris",
        "dang_van",
        "findley",
    ] {
        let kind = format!("life.model={model}");
        let limit = if model == "ioannides_harris" {
            3e8
        } else {
            0.0
        };
        let limit = format!("life.limit_pa={limit}");
        let mut sets = SMOOTH.to_vec();
        sets.extend([
            "motion.slide_roll=0",
            "time.passages=6",
            "life.calibration_cycles=1e8",
            "life.calibration_pressure_pa=2e9",
            &kind,
            &limit,
        ]);
        let own = scene("demonstration_quick", &sets);
        let pair = compare(model, &own, &[("load.force_n", 1600.0)]);
        let (one, two) = (&pair.turned, &pair.cold);
        let cycles = [one.life_cycles, two.life_cycles];
        println!("  cycles {cycles:.4?}");
        // A smooth contact is its own reference at any load.
        assert!(apart(one.life_relative, Some(1.0)) < 0.01, "{model}");
        assert!(apart(cycles[0], cycles[1]) < 0.02, "{model}");
        // Cycles fall by what the load costs.
        let base = run(&own).life_cycles;
        let factor = Some(cycles[0].unwrap() / base.unwrap());
        // The calibration goes by the model's power law, the load factor by its integrals. A critical plane takes the one
        // worst depth of 48, which lie where the scene's load has them: 0.3 % of stress, to the power of c.
        let room = if matches!(model, "dang_van" | "findley") {
            0.04
        } else {
            0.02
        };
        assert!(apart(one.load_factor, factor) < room, "{model}: {factor:?}");
    }
}

#[test]
fn going_on_from_a_state_in_the_middle_is_the_same_bit_for_bit() {
    let own = scene("demonstration_quick", &["grid.nodes=65", "stress.depths=8"]);
    let mut sim = simulation(&own);
    while sim.passage_steps() < 5 {
        sim.step().unwrap();
    }
    sim.set(asperity_engine::sim::Knob::ForceN, 1000.0).unwrap();
    // The smooth contact climbs no further grid here; it is done after 64 steps of its own.
    for _ in 0..30 {
        sim.step().unwrap();
    }
    let text = serde_json::to_vec(&sim.save()).unwrap();
    let mut again = simulation(&own);
    again
        .restore(&serde_json::from_slice(&text).unwrap())
        .unwrap();
    again.count_from(*sim.stats()).unwrap();
    let (mut one, mut two) = (Frame::default(), Frame::default());
    for _ in 0..60 {
        sim.step().unwrap();
        again.step().unwrap();
        sim.fill(&mut one);
        again.fill(&mut two);
        assert!(one == two, "step {}", one.step);
    }
    assert!(sim.stats() == again.stats());
}
