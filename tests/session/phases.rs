//! At S = 0 the band of a life holds what it is at any phase between both bodies' waves.
#![expect(clippy::unwrap_used, reason = "tests")]

use std::sync::Arc;
use std::sync::atomic::AtomicBool;

use asperity_engine::plan::Plan;
use asperity_engine::scene::{Override, Scene};
use asperity_engine::sim::{Simulation, Summary};
use asperity_session::run::{Assumed, AssumedRange, Ending, Request, Session};

/// What a life needs not: many depths, other models' lives, maps of damage.
pub(crate) const BARE: [&str; 4] = [
    "record=none",
    "stress.depths=8",
    "life.spread=off",
    "life.damage_map=off",
];

pub(crate) fn scene(preset: &str, sets: &[&str]) -> Arc<Scene> {
    let sets: Vec<Override> = sets.iter().map(|text| text.parse().unwrap()).collect();
    Arc::new(Scene::load_with(preset, &sets).unwrap())
}

/// A run up its ladder, with its band.
pub(crate) fn run(scene: &Arc<Scene>, plan: &Plan) -> Summary {
    let request = Request {
        name: String::new(),
        scene: Arc::clone(scene),
        plan: plan.clone(),
        threads: 2,
        watchers: Vec::new(),
        ending: Ending::Passages,
    };
    let outcome = Session::start(request).unwrap().join().unwrap();
    outcome.summary.unwrap()
}

/// Its life on its own mesh alone, with one key more.
pub(crate) fn cold(preset: &str, sets: &[&str], key: &str) -> f64 {
    let own = scene(preset, &[sets, &["numerics.ladder=false", key]].concat());
    let mut sim = Simulation::new(&own, Plan::new(&own).unwrap(), 2).unwrap();
    while !sim.is_done() {
        sim.step().unwrap();
    }
    sim.summary().life_relative.unwrap()
}

fn over_phases(
    scene: &Arc<Scene>,
    plan: &Plan,
    summary: &mut Summary,
    stops: bool,
) -> Option<AssumedRange> {
    Assumed::Phase.vary(scene, plan, 2, summary, &AtomicBool::new(stops))
}

#[test]
fn the_band_of_rolling_holds_every_phase() {
    for (preset, more) in [
        ("fzg_pitch_point", &["grid.nodes=129"][..]),
        ("fzg_point_b", &["grid.nodes=129"]),
        (
            "demonstration",
            // Five waves: at S = 0 each is like the last.
            &[
                "grid.nodes=129",
                "body_1.surface.phase_deg=0",
                "time.passages=0.5",
            ],
        ),
    ] {
        let sets = [&BARE[..], &["motion.slide_roll=0"], more].concat();
        let own = scene(preset, &sets);
        let plan = Plan::new(&own).unwrap();
        let mut summary = run(&own, &plan);
        let before = [summary.life_relative_low, summary.life_relative_high].map(Option::unwrap);
        assert_eq!(Assumed::Phase.count(), 8);
        over_phases(&own, &plan, &mut summary, false).unwrap();
        let band = [summary.life_relative_low, summary.life_relative_high].map(Option::unwrap);
        let [low, high] = band;
        // Between those that the band was made of, and on another mesh.
        let between = [22.5, 112.5, 202.5, 292.5].into_iter();
        let key = |phase: f64| format!("body_1.surface.phase_deg={phase}");
        let lives: Vec<f64> = between
            .map(|phase| cold(preset, &sets, &key(phase)))
            .collect();
        println!(
            "{preset}: band {low:.3} to {high:.3}, without phases {before:.3?}; lives {lives:.3?}"
        );
        assert!(
            lives.iter().all(|life| (low..=high).contains(life)),
            "{preset}"
        );
        // And without them it would not.
        assert!(
            !lives
                .iter()
                .all(|life| (before[0]..=before[1]).contains(life)),
            "{preset}"
        );
    }
}

/// Where crests hardly shift while a run lasts, its life is that of how they stood; a run that comes through all ways has another, which
/// the band holds, whatever phase is asked for.
#[test]
fn the_band_of_slow_sliding_holds_the_life_of_a_long_run() {
    let sets = [&BARE[..], &["grid.nodes=65", "motion.slide_roll=0.02"]].concat();
    let preset = "demonstration_quick";
    let own = scene(preset, &sets);
    let plan = Plan::new(&own).unwrap();
    // 8 a at waves of .425 a.
    let meetings = plan.meetings(0.02, plan.length_a).unwrap();
    let waves = 0.02 * 8.0 * plan.hertz.a_m / 2e-4;
    assert!((meetings / waves - 1.0).abs() < 1e-9 && meetings < 1.0);
    let mut summary = run(&own, &plan);
    let band = |summary: &Summary| {
        let [low, high] =
            [summary.life_relative_low, summary.life_relative_high].map(Option::unwrap);
        low..=high
    };
    let before = band(&summary);
    over_phases(&own, &plan, &mut summary, false).unwrap();
    let long = cold(preset, &sets, "time.passages=12");
    let (life, after) = (summary.life_relative, band(&summary));
    println!("life {life:.3?}, band {before:.3?}, over phases {after:.3?}; 12 passages {long:.3}");
    assert!(after.contains(&long) && !before.contains(&long));
    assert!(!Assumed::Phase.moves(
        &own,
        &Plan::new(&scene(preset, &[&sets[..], &["time.passages=12"]].concat())).unwrap()
    ));
}

#[test]
fn a_phase_that_is_asked_for_and_surfaces_that_slide_have_no_other() {
    for sets in [
        &["motion.slide_roll=0", "body_1.surface.phase_deg=360"][..],
        &["motion.slide_roll=0.5", "body_1.surface.phase_deg=0"],
        &["motion.slide_roll=0", "body_1.surface.kind=smooth"],
    ] {
        let own = scene("demonstration_quick", sets);
        let mut summary = Summary::default();
        let plan = Plan::new(&own).unwrap();
        assert_eq!(
            over_phases(&own, &plan, &mut summary, false),
            None,
            "{sets:?}"
        );
        assert_eq!(summary, Summary::default());
    }
    // Who says stop gets the run's own band.
    let own = scene("fzg_pitch_point", &["grid.nodes=65"]);
    let mut summary = Summary {
        life_relative: Some(0.5),
        ..Summary::default()
    };
    let before = summary.clone();
    let plan = Plan::new(&own).unwrap();
    assert_eq!(over_phases(&own, &plan, &mut summary, true), None);
    assert_eq!(summary, before);
}
