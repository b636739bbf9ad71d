//! The first life that is called settled after a turn of a knob, against a cold run of the same scene at those
//! settings: inside its band in at least 19 of 20. Every knob up and down, by several sizes, in a point contact and in
//! a line.
#![expect(clippy::unwrap_used, reason = "tests")]

use asperity_engine::plan::Plan;
use asperity_engine::scene::{Override, Scene, Surface};
use asperity_engine::sim::{CautionCode, Knob, LifeEstimate, Simulation, Stage, State};

fn scene(name: &str, sets: &[&str]) -> Scene {
    let sets: Vec<Override> = sets.iter().map(|text| text.parse().unwrap()).collect();
    Scene::load_with(name, &sets).unwrap()
}

/// Waves that 65 nodes carry, so that the band is no barn door.
fn point() -> Scene {
    scene(
        "demonstration_quick",
        &[
            "grid.nodes=65",
            "stress.depths=8",
            "body_1.surface.wavelength_x_m=4e-4",
            "body_2.surface.wavelength_x_m=4e-4",
            "body_2.surface.wavelength_y_m=4e-4",
        ],
    )
}

fn line() -> Scene {
    scene(
        "fzg_point_b",
        &[
            "grid.nodes=129",
            "stress.depths=8",
            "body_1.surface.amplitude_m=1e-7",
            "body_2.surface.amplitude_m=1e-7",
            "body_1.surface.wavelength_x_m=1.2e-4",
            "body_2.surface.wavelength_x_m=1.2e-4",
        ],
    )
}

fn put(scene: &mut Scene, knob: Knob, value: f64) {
    match knob {
        Knob::SlideRoll => scene.motion.slide_roll = value,
        Knob::ForceN => {
            (scene.load.force_n, scene.load.hertz_pressure_pa) = (Some(value), None);
        }
        Knob::ForceNPerM => {
            (scene.load.force_n_per_m, scene.load.hertz_pressure_pa) = (Some(value), None);
        }
        Knob::Amplitude1M => scene.body_1.surface.set_amplitude_m(value),
        Knob::Amplitude2M => scene.body_2.surface.set_amplitude_m(value),
        Knob::EntrainmentMS => scene.motion.entrainment_m_s = value,
    }
}

fn simulation(scene: &Scene) -> Simulation {
    Simulation::new(scene, Plan::new(scene).unwrap(), 1).unwrap()
}

/// Steps until the life has settled; `None`: not within 4000.
fn settle(sim: &mut Simulation) -> Option<LifeEstimate> {
    for _ in 0..4000 {
        sim.step().unwrap();
        let life = sim.metrics().life;
        if let Some(life) = life.filter(|life| sim.stage() == Stage::Passage && life.settled) {
            return Some(life);
        }
    }
    None
}

/// A run that settles, and goes on for as long again as two passages.
fn cold(scene: &Scene) -> LifeEstimate {
    let plan = Plan::new(scene).unwrap();
    let mut sim = Simulation::new(scene, plan.clone(), 1).unwrap();
    settle(&mut sim).unwrap();
    for _ in 0..2 * plan.steps_per_passage {
        sim.step().unwrap();
    }
    sim.metrics().life.unwrap()
}

/// In pure rolling lives hang on how crests stand to each other: lets them stand as they do in `sim`.
fn stand_as(there: &mut Scene, sim: &Simulation) {
    if there.motion.slide_roll != 0.0 {
        return;
    }
    let state = serde_json::to_value(sim.save()).unwrap();
    let travelled = |body: usize| state["motion"]["travelled"][body].as_f64().unwrap();
    let ahead_m = (travelled(1) - travelled(0)) * sim.summary().a_m;
    if let Surface::Sinusoid {
        wavelength_x_m,
        phase_deg,
        ..
    } = &mut there.body_2.surface
    {
        *phase_deg = (*phase_deg - 360.0 * ahead_m / *wavelength_x_m).rem_euclid(360.0);
    }
}

/// A turn and what came of it.
struct Turn {
    within: bool,
    row: String,
}

fn turn(base: &Scene, from: &State, knob: Knob, value: f64) -> Turn {
    let mut there = base.clone();
    put(&mut there, knob, value);
    let mut sim = simulation(base);
    sim.restore(from).unwrap();
    let before = sim.passage_steps();
    sim.set(knob, value).unwrap();
    let first = settle(&mut sim);
    let steps = sim.passage_steps() - before;
    stand_as(&mut there, &sim);
    let cold = cold(&there);
    let Some(first) = first else {
        return Turn {
            within: false,
            row: format!("{:<28} {value:>10.3e} never settles", knob.key()),
        };
    };
    let (low, high) = (first.life_relative_low, first.life_relative_high);
    // The cold run's own mean is known no better than its steps are solved.
    let within = (low..=high).contains(&cold.life_relative);
    Turn {
        within,
        row: format!(
            "{:<28} {value:>10.3e} {steps:>5} steps  first {:.4e}  band {low:.4e} to {high:.4e}  cold {:.4e}  {:+.1} %{}",
            knob.key(),
            first.life_relative,
            cold.life_relative,
            100.0 * (first.life_relative / cold.life_relative - 1.0),
            if within { "" } else { "  OUTSIDE" }
        ),
    }
}

fn turns(base: &Scene, load: Knob) -> Vec<(Knob, f64)> {
    let (force, u) = (base.force_n(), base.motion.entrainment_m_s);
    let [a1, a2] = base.surfaces().map(Surface::amplitude_m);
    let mut list = Vec::new();
    for s in [0.0, 0.25, 0.55, 1.0] {
        list.push((Knob::SlideRoll, s));
    }
    for factor in [0.5, 1.3] {
        list.push((Knob::Amplitude1M, factor * a1));
        list.push((Knob::Amplitude2M, factor * a2));
    }
    for factor in [0.5, 0.9, 1.5] {
        list.push((load, factor * force));
        list.push((Knob::EntrainmentMS, factor * u));
    }
    list
}

fn all(base: &Scene, load: Knob) -> (usize, usize) {
    let mut sim = simulation(base);
    settle(&mut sim).unwrap();
    let from = sim.save();
    let (mut within, mut made) = (0, 0);
    for (knob, value) in turns(base, load) {
        let turn = turn(base, &from, knob, value);
        println!("{}", turn.row);
        made += 1;
        within += usize::from(turn.within);
    }
    (within, made)
}

#[test]
fn the_first_settled_life_is_that_of_a_cold_run() {
    let one = all(&point(), Knob::ForceN);
    let other = all(&line(), Knob::ForceNPerM);
    let (within, made) = (one.0 + other.0, one.1 + other.1);
    println!("{within} of {made} inside the band");
    assert!(20 * within >= 19 * made, "{within} of {made}");
}

/// Points move on through a round that comes back, and what they meet there is what they meet where it is solved: the first
/// settled life and its cycles are those of three passages more.
#[test]
fn a_life_after_one_round_is_that_of_many() {
    for (name, sets, round) in [
        // These come back to 1.3 and .6 %, and .5 are asked.
        ("demonstration", &["grid.nodes=129"][..], false),
        (
            "demonstration",
            &["grid.nodes=129", "motion.slide_roll=-1.2", "lubricant=none"],
            true,
        ),
        (
            "demonstration",
            &[
                "grid.nodes=129",
                "motion.slide_roll=1",
                "body_2.young_pa=1.1e11",
            ],
            false,
        ),
        (
            "fzg_point_b",
            &["grid.nodes=257", "motion.slide_roll=0.5"],
            true,
        ),
        ("twin_disc", &["grid.nodes=129"], true),
        // Its steps do not fit the period.
        ("demonstration", &["grid.nodes=65"], false),
    ] {
        let scene = scene(name, &[sets, &["stress.depths=12"]].concat());
        let mut sim = simulation(&scene);
        let first = settle(&mut sim).unwrap();
        let (steps, repeat) = (sim.passage_steps(), sim.metrics().repeat.unwrap());
        let distance = sim.time_s() * scene.motion.entrainment_m_s.abs() / sim.summary().a_m;
        let (slower, rounds) = (
            distance * (1.0 - 0.5 * scene.motion.slide_roll.abs()),
            sim.time_s() / repeat.period_s,
        );
        for _ in 0..3 * Plan::new(&scene).unwrap().steps_per_passage {
            sim.step().unwrap();
        }
        let long = sim.metrics().life.unwrap();
        let off = |of: fn(&LifeEstimate) -> f64| of(&first) / of(&long) - 1.0;
        let (life, cycles) = (
            off(|life| life.life_relative),
            off(|life| life.cycle_factor),
        );
        println!(
            "{name} {sets:?}: settled after {steps} steps, {rounds:.3} periods (drift {:.2e}): {:.4e}, life {:+.2} %, cycles {:+.2} %",
            repeat.drift.unwrap_or(f64::NAN),
            first.life_relative,
            100.0 * life,
            100.0 * cycles
        );
        // From ahead of the contact to where a crossing ends.
        assert_eq!(slower < 2.2, round, "{name} {sets:?}");
        assert!(
            !round || life.abs() < 0.02 && cycles.abs() < 0.01,
            "{name} {sets:?}"
        );
    }
}

/// While a knob walks and until the contact is flushed nothing is settled and nothing repeats, and none of those steps
/// is left in the means when it is.
#[test]
fn no_step_of_a_ramp_is_in_a_mean() {
    let base = point();
    let mut sim = simulation(&base);
    settle(&mut sim).unwrap();
    let a_m = sim.summary().a_m;
    sim.set(Knob::ForceN, 0.6 * base.force_n()).unwrap();
    let (mut way, mut walked, mut samples) = (0.0, None, 0);
    loop {
        let before = sim.time_s();
        sim.step().unwrap();
        let m = sim.metrics();
        let step = (sim.time_s() - before) * m.entrainment_m_s / a_m;
        way += step;
        if m.load_n != m.load_target_n {
            walked = Some(way);
        }
        let since = way - walked.unwrap();
        let repeats = m.repeat.is_some_and(|repeat| repeat.repeats);
        if since < 4.0 - 1e-6 {
            assert!(
                !repeats && !m.life.is_some_and(|life| life.settled),
                "{since}"
            );
        }
        // Flushed, by a step that is of no set length: what the ramp left in the film is in no sample.
        let now = m.life.map_or(0, |life| life.phases);
        if (4.0 - 1e-6..4.15).contains(&(since - step)) {
            assert!(now <= 4 && samples > 20, "{since}: {now} after {samples}");
        } else if since <= 4.15 {
            samples = now;
        }
        if since > 4.1 {
            // Every step that is averaged carried the new load.
            let load = sim.summary().load_n;
            assert!(
                (load / m.load_target_n - 1.0).abs() < 1e-9,
                "{since} {load}"
            );
        }
        if m.life.is_some_and(|life| life.settled) {
            break;
        }
    }
    assert!(way - walked.unwrap() > 4.0);
}

/// The start-up of a smooth contact ends where it stays: the plan makes one step of it, and its life is the result.
#[test]
fn a_smooth_contact_is_settled_at_once() {
    let smooth = ["body_1.surface.kind=smooth", "body_2.surface.kind=smooth"];
    for name in ["demonstration_quick", "ball_bearing", "fzg_point_b"] {
        for count in ["life.cycles=damage", "life.cycles=global"] {
            let scene = scene(name, &[smooth[0], smooth[1], count, "grid.nodes=65"]);
            let mut sim = simulation(&scene);
            while !sim.is_done() {
                sim.step().unwrap();
            }
            let life = sim.metrics().life.unwrap();
            let codes: Vec<_> = sim.summary().cautions.iter().map(|c| c.code).collect();
            println!("{name}, {count}: {} steps, {life:?}", sim.passage_steps());
            assert!(life.settled && !codes.contains(&CautionCode::NotSettled));
        }
    }
}
