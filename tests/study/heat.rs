//! What the presets lose by heat, beside what was said before anything was run.
#![expect(clippy::unwrap_used, reason = "tests")]

use asperity_study::Extent;
use asperity_study::heat::{heat, heat_report};

/// A cam: friction falls by about what the closed forms say (15 and 17 %), the film by the inlet's factor to half a per cent, and the
/// further the more the oil thins.
#[test]
fn a_cam_loses_what_closed_forms_say() {
    let warmed = heat(Extent::Quick, Some("cam"), 2, &mut |_, _, _| {}).unwrap();
    let [cam] = &warmed[..] else {
        panic!("{warmed:?}")
    };
    println!("{}", heat_report(&warmed).text);
    let of = |k: usize| cam.warm[k].friction_coefficient / cam.cold.friction_coefficient;
    assert!((0.80..0.88).contains(&of(0)), "{}", of(0));
    assert!(
        of(2) < of(0) && of(0) < of(1),
        "{} {} {}",
        of(2),
        of(0),
        of(1)
    );
    let film = cam.warm[0].h_central_m / cam.cold.h_central_m;
    let said = cam.warm[0].inlet_heating_factor.unwrap();
    assert!((film / said - 1.0).abs() < 5e-3, "{film} {said}");
    assert!(heat_report(&warmed).passes);
    assert!(heat(Extent::Quick, Some("nothing"), 2, &mut |_, _, _| {}).is_err());
}
