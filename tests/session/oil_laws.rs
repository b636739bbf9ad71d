//! The range of a life over laws of the oil, made on the first mesh, is that of runs on the run's own mesh.
#![expect(clippy::unwrap_used, reason = "tests")]

use std::sync::atomic::AtomicBool;

use super::phases::{BARE, cold, run, scene};
use asperity_engine::plan::Plan;
use asperity_session::run::Assumed;

/// What the ends may be off, as a factor: the first mesh has seven nodes a wave, and is off by 1.2 in the life itself, its band
/// being 1.7 either way.
const OFF: f64 = 1.5;

#[test]
fn the_first_mesh_knows_what_the_oil_does_to_the_life() {
    for (preset, sets, stress_pa) in [
        ("demonstration", &["grid.nodes=129"][..], 5e6),
        ("fzg_point_b", &["grid.nodes=257", "time.passages=1"], 5e6),
        ("twin_disc", &["grid.nodes=129"], 5e6),
    ] {
        let sets = [&BARE[..], sets].concat();
        let own = scene(preset, &sets);
        let plan = Plan::new(&own).unwrap();
        let oil = own.lubricant.as_ref().unwrap();
        assert_eq!(oil.eyring_stress_pa, stress_pa, "{preset}");
        let mut summary = run(&own, &plan);
        let stop = AtomicBool::new(false);
        Assumed::OilLaw
            .vary(&own, &plan, 2, &mut summary, &stop)
            .unwrap();
        let laws = [
            "lubricant.eyring_flow=secant".to_owned(),
            format!("lubricant.eyring_stress_pa={}", 0.5 * stress_pa),
            format!("lubricant.eyring_stress_pa={}", 2.0 * stress_pa),
        ];
        let lives = laws.map(|law| cold(preset, &sets, &law));
        let (low, high) = (
            summary.life_oil_low.unwrap(),
            summary.life_oil_high.unwrap(),
        );
        let least = lives.into_iter().fold(f64::INFINITY, f64::min);
        let most = lives.into_iter().fold(0.0, f64::max);
        println!("{preset}: {low:.4} to {high:.4}, on its own mesh {least:.4} to {most:.4}");
        for (end, own) in [(low, least), (high, most)] {
            assert!((end / own).ln().abs() < OFF.ln(), "{preset}: {end} {own}");
        }
    }
}

/// The life of the scene's own choice is the run's on its first mesh: made once more it is the same to the last bit, at S = 0
/// with its phases, too.
#[test]
fn the_own_life_of_a_range_is_that_of_the_run() {
    for (kind, preset, sets) in [
        (
            Assumed::OilLaw,
            "demonstration_quick",
            &["grid.nodes=129"][..],
        ),
        (Assumed::OilLaw, "twin_disc", &["grid.nodes=129"]),
        (Assumed::Phase, "fzg_pitch_point", &["grid.nodes=129"]),
    ] {
        let own = scene(preset, &[&BARE[..], sets].concat());
        let plan = Plan::new(&own).unwrap();
        let mut summary = run(&own, &plan);
        let stop = AtomicBool::new(false);
        assert!(summary.rungs.len() > 1, "{preset}");
        let mut made = summary.clone();
        made.rungs.clear();
        let range = kind.vary(&own, &plan, 2, &mut summary, &stop).unwrap();
        assert_eq!(
            kind.vary(&own, &plan, 2, &mut made, &stop),
            Some(range),
            "{preset}"
        );
    }
}

#[test]
fn a_life_that_hangs_on_no_law_has_no_range() {
    for sets in [
        &["motion.slide_roll=0"][..],
        &["lubricant.rheology=newtonian"],
        &["lubricant=none"],
        &["life=none"],
        // Runs on one mesh are not made four times as long.
        &["grid.nodes=65"],
    ] {
        let own = scene("demonstration_quick", sets);
        let plan = Plan::new(&own).unwrap();
        assert!(!Assumed::OilLaw.moves(&own, &plan), "{sets:?}");
    }
    let own = scene("demonstration_quick", &[]);
    assert!(Assumed::OilLaw.moves(&own, &Plan::new(&own).unwrap()));
}
