//! At S = 0 the band of a life holds what it is at any phase between both bodies' waves.
#![expect(clippy::unwrap_used, reason = "tests")]

use std::sync::Arc;
use std::sync::atomic::AtomicBool;

use asperity_engine::plan::Plan;
use asperity_engine::scene::{Override, Scene};
use asperity_engine::sim::{Simulation, Summary};
use asperity_session::run::{Assumed, AssumedRange, Ending, Request, Session};

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
    let rolling = ["motion.slide_roll=0", "record=none"];
    for (preset, more) in [
        ("fzg_pitch_point", &["grid.nodes=257"][..]),
        ("fzg_point_b", &["grid.nodes=257"]),
        (
            "demonstration",
            &[
                "grid.nodes=129",
                "body_1.surface.phase_deg=0",
                "stress.depths=16",
            ],
        ),
    ] {
        let sets = [&rolling[..], more].concat();
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
