//! The first scene shows what it claims: sliding costs its life, and goes on doing so.
#![expect(clippy::unwrap_used, reason = "tests")]

use asperity_study::Extent;
use asperity_study::story::{FALL, Told, shown, story, story_report};

fn told(extent: Extent) -> Vec<Told> {
    story(extent, Some("demonstration"), 2, &mut |_, _, _| {}).unwrap()
}

fn shows(told: &[Told]) {
    println!("{}", story_report(told).text);
    let [fall, rise] = shown(told).unwrap();
    assert!(fall >= FALL, "{fall}");
    assert!(rise <= 1.0, "{rise}");
    assert!(story_report(told).passes);
}

#[test]
fn life_falls_from_rolling_to_sliding_and_does_not_rise_again() {
    let told = told(Extent::Quick);
    shows(&told);
    // A scene that loses nothing, or gains it back, is none.
    let at = |s: f64| {
        told.iter()
            .position(|one| one.summary.life_relative.is_some() && one.slide_roll() == s)
            .unwrap()
    };
    let (rolling, half, full) = (at(0.0), at(0.5), at(1.0));
    let spoilt = |place: usize, life: f64| {
        let mut spoilt = told.clone();
        let summary = &mut spoilt[place].summary;
        (summary.life_relative, summary.life_relative_low) = (Some(life), Some(0.9 * life));
        !story_report(&spoilt).passes
    };
    let lived = |place: usize| told[place].summary.life_relative.unwrap();
    assert!(spoilt(rolling, 4.9 * lived(half)));
    assert!(spoilt(
        full,
        1.2 * told[half].summary.life_relative_high.unwrap()
    ));
}

#[test]
#[ignore = "minutes: up to 257 nodes"]
fn on_its_own_mesh_too() {
    shows(&told(Extent::Usual));
}
