//! The workspace of a simulation may be thrown away between any two steps: every field of every frame, the summary and
//! the work that is counted are the same as of the run that kept it.
//!
//! Seen to fail with a warm start planted in the solver (the last attempt's pressure as the first guess of the next one in
//! place of the state's): all four tests end at the second step.
#![expect(clippy::unwrap_used, reason = "tests")]

use crate::common::keeper::bits;
use crate::restart_matrix::{cases, lengthen, scene_smooth};
use asperity_engine::plan::Plan;
use asperity_engine::scene::{ContactKind, Override, Scene, presets};
use asperity_engine::sim::{Frame, Knob, Simulation};

/// A preset on few nodes, its waves as long as those resolve.
pub(crate) fn small(preset: &str, sets: &[&str]) -> Scene {
    let all = ["grid.nodes=33", "record=none"];
    let sets: Vec<Override> = (all.iter().chain(sets))
        .map(|s| s.parse().unwrap())
        .collect();
    let mut scene = Scene::load_with(preset, &sets).unwrap();
    if let Some(stress) = &mut scene.stress {
        stress.depths = 8;
    }
    for surface in [&mut scene.body_1.surface, &mut scene.body_2.surface] {
        lengthen(
            surface,
            8.0 * Plan::new(&scene_smooth(preset)).unwrap().dx_m,
        );
    }
    scene
}

/// Runs `scene` with its workspace and without, as far as that many steps of the passage, the load turned to `load` of
/// itself at the second of them; gives the frames that were compared.
fn compared(name: &str, scene: &Scene, steps: u64, load: f64) -> usize {
    let made = || Simulation::new(scene, Plan::new(scene).unwrap(), 1).unwrap();
    let (mut kept, mut renewed) = (made(), made());
    let (mut one, mut two) = (Frame::default(), Frame::default());
    let mut count = 0;
    let mut turned = load == 1.0;
    while kept.passage_steps() < steps {
        if !turned && kept.passage_steps() == 2 {
            turned = true;
            let knob = match scene.kind() {
                ContactKind::Point => Knob::ForceN,
                ContactKind::Line => Knob::ForceNPerM,
            };
            for sim in [&mut kept, &mut renewed] {
                sim.set(knob, load * scene.force_n()).unwrap();
            }
        }
        for is_after in [false, true] {
            if is_after {
                kept.step().unwrap();
                renewed.step().unwrap();
            } else {
                let (state, stats) = (renewed.save(), *renewed.stats());
                renewed = made();
                renewed.restore(&state).unwrap();
                renewed.count_from(stats).unwrap();
            }
            kept.fill(&mut one);
            renewed.fill(&mut two);
            let same = bits(&one) == bits(&two);
            assert!(same, "{name}, frame {count}, after the step: {is_after}");
            count += 1;
        }
    }
    assert_eq!(kept.summary(), renewed.summary(), "{name}");
    assert_eq!(kept.stats(), renewed.stats(), "{name}");
    count
}

#[test]
fn presets_are_the_same_without_their_workspace() {
    for preset in presets::all() {
        let count = compared(preset.name, &small(preset.name, &[]), 6, 1.0);
        println!("{}: {count} frames", preset.name);
        assert!(count >= 12);
    }
}

#[test]
fn every_kind_of_contact_is_the_same_without_its_workspace() {
    let kinds: [(&str, &str, &[&str]); 8] = [
        ("unlike", "demonstration_quick", &["body_2.young_pa=7e10"]),
        (
            "unlike and dry",
            "demonstration_quick",
            &["body_2.young_pa=7e10", "lubricant=none"],
        ),
        (
            "yielding",
            "demonstration_quick",
            &["body_1.hardness_pa=1e9", "body_2.hardness_pa=1e9"],
        ),
        ("dry", "demonstration_quick", &["lubricant=none"]),
        (
            "mass-conserving",
            "demonstration_quick",
            &["lubricant.cavitation=jfo"],
        ),
        ("line", "fzg_point_b", &["life.spread=models"]),
        (
            "adaptive",
            "demonstration_quick",
            &["time.tolerance=0.03", "life.cycles=peaks"],
        ),
        (
            "unmirrored",
            "demonstration_quick",
            &["body_2.surface.angle_deg=20"],
        ),
    ];
    for (name, preset, sets) in kinds {
        let count = compared(name, &small(preset, sets), 8, 1.0);
        println!("{name}: {count} frames");
    }
}

/// Of the matrix of restarts what the kinds above lack: height maps, an ellipse, lines of every flow.
#[test]
fn height_maps_and_lines_are_the_same_without_the_workspace() {
    let folder = tempfile::tempdir().unwrap();
    let names = [
        "ellipse, jfo, unlike, height map, adaptive, no event",
        "circle, dry, like, height map, fixed, no event",
        "line, reynolds, unlike, height map, fixed, no event",
        "line, jfo, like, sinusoid, adaptive, no event",
        "line, dry, unlike, sinusoid, fixed, no event",
    ];
    let all = cases(folder.path());
    let chosen: Vec<_> = all
        .iter()
        .filter(|case| names.contains(&&*case.name))
        .collect();
    assert_eq!(chosen.len(), names.len());
    for case in chosen {
        let count = compared(&case.name, &case.scene, 8, 1.0);
        println!("{}: {count} frames", case.name);
    }
}

/// Three grids of the start-up, and the smooth contact beside the run whose load is turned.
#[test]
fn grids_and_references_are_the_same_without_the_workspace() {
    let sets: Vec<Override> = ["grid.nodes=129", "stress.depths=8", "record=none"]
        .map(|s| s.parse().unwrap())
        .to_vec();
    let climbs = Scene::load_with("demonstration_quick", &sets).unwrap();
    println!("climbing: {} frames", compared("climbing", &climbs, 2, 1.0));
    let turned = small("demonstration_quick", &[]);
    println!("turned: {} frames", compared("turned", &turned, 70, 0.8));
}
