//! Runs that do not say how many passages they make, against long ones.
#![expect(clippy::unwrap_used, reason = "tests")]

use std::sync::Arc;

use asperity_engine::plan::Plan;
use asperity_engine::scene::{Event, Override, Scene};
use asperity_session::run::{End, Ending, Outcome, Request, Session};

fn scene(preset: &str, sets: &[&str], passages: Option<f64>) -> Scene {
    let usual = [
        "record=none",
        "numerics.error_estimate=none",
        "stress.depths=8",
        "life.spread=off",
    ];
    let sets: Vec<Override> = (usual.iter().chain(sets))
        .map(|set| set.parse().unwrap())
        .collect();
    let mut scene = Scene::load_with(preset, &sets).unwrap();
    scene.time.passages = passages;
    scene
}

fn run(scene: Scene) -> (Plan, Outcome) {
    let plan = Plan::new(&scene).unwrap();
    let request = Request {
        name: String::new(),
        scene: Arc::new(scene),
        plan: plan.clone(),
        threads: 2,
        watchers: Vec::new(),
        ending: Ending::Passages,
    };
    let outcome = Session::start(request).unwrap().join().unwrap();
    assert!(matches!(outcome.end, End::Done));
    (plan, outcome)
}

/// Points and lines, S = 0, one rough body, dry, unlike bodies, the count of the paper; with damage maps, which take longer to
/// fill, and without; waves so long that three of them are more than a period.
const CASES: [(&str, &[&str]); 11] = [
    ("demonstration", &["grid.nodes=65"]),
    ("demonstration", &["grid.nodes=65", "motion.slide_roll=0"]),
    (
        "demonstration",
        &[
            "grid.nodes=65",
            "motion.slide_roll=0",
            "body_1.surface.wavelength_x_m=3e-4",
            "body_2.surface.wavelength_x_m=3e-4",
        ],
    ),
    (
        "demonstration",
        &[
            "grid.nodes=65",
            "body_1.surface.kind=smooth",
            "life.damage_map=off",
        ],
    ),
    ("demonstration", &["grid.nodes=65", "lubricant=none"]),
    ("demonstration", &["grid.nodes=65", "life.cycles=global"]),
    (
        "demonstration",
        &["grid.nodes=65", "body_2.young_pa=1.1e11"],
    ),
    ("twin_disc", &["grid.nodes=65"]),
    (
        "ball_bearing_worn",
        &["grid.nodes=65", "life.damage_map=off"],
    ),
    ("fzg_pitch_point", &["grid.nodes=129"]),
    (
        "demonstration",
        &[
            "grid.nodes=65",
            "body_1.surface.wavelength_x_m=4e-4",
            "body_2.surface.wavelength_x_m=4e-4",
        ],
    ),
];

#[test]
fn a_life_that_has_settled_is_that_of_a_long_run() {
    let mut early = 0;
    for (preset, sets) in CASES {
        let (plan, short) = run(scene(preset, sets, None));
        let (_, long) = run(scene(preset, sets, Some(8.0)));
        let settled = short.settled;
        early += u32::from(settled);
        assert!(short.steps >= plan.steps_per_passage && short.steps <= plan.steps);
        assert_eq!(settled, short.steps < plan.steps, "{preset} {sets:?}");
        assert_eq!(short.steps_planned, Some(short.steps));
        let [one, all] = [short, long].map(|outcome| outcome.summary.unwrap());
        let lives = [
            one.life_relative,
            one.life_relative_low,
            one.life_relative_high,
        ];
        let [life, low, high] = lives.map(Option::unwrap);
        let of_all = all.life_relative.unwrap();
        let off = (life / of_all).ln().abs();
        println!(
            "{preset} {sets:?}: {} of {} steps, {life:.5} ({low:.5} to {high:.5}), 8 passages {of_all:.5}",
            one.steps, plan.steps
        );
        assert!((low..=high).contains(&of_all), "{preset} {sets:?}");
        assert!(off < 0.02 || !settled, "{preset} {sets:?}: {off}");
    }
    // Of waves of 6.8 nodes that slide the period does not close; of those that roll it does to .52 %, and .5 are asked.
    assert!(early >= 4, "{early}");
}

/// Where crossings end at the domain's edge, and their largest cycles make a mean once every point has crossed, one passage knows of
/// no small cycles: 2.1 % off.
#[test]
fn one_passage_counts_the_cycles_that_four_do() {
    let factors = [1.0, 4.0].map(|passages| {
        let sets = ["grid.nodes=129", "numerics.ladder=false"];
        let (_, outcome) = run(scene("demonstration", &sets, Some(passages)));
        outcome.summary.unwrap().cycle_factor.unwrap()
    });
    println!("cycle factors of one passage and of four: {factors:.4?}");
    assert!((factors[0] / factors[1] - 1.0).abs() < 0.01);
}

#[test]
fn what_passes_once_or_changes_is_run_to_its_end() {
    let planned = |scene: &Scene| Plan::new(scene).unwrap().until_settled;
    let usual = scene("demonstration", &[], None);
    assert!(planned(&usual));
    assert!(!planned(&scene("demonstration", &[], Some(2.0))));
    for set in [
        "life=none",
        "life.cycles=peaks",
        "wear.coefficient_1_per_pa=1e-18",
    ] {
        assert!(!planned(&scene("demonstration", &[set], None)), "{set}");
    }
    assert!(!planned(&scene("random_rollers", &[], None)));
    let mut with_event = usual;
    with_event.events.push(Event {
        at_s: 1e-3,
        set: std::collections::BTreeMap::new(),
        caption: String::new(),
    });
    assert!(!planned(&with_event));
}
