//! Crests of a scene's surfaces, and the highest that a point of each body meets, by S.

use std::fmt::Write as _;

use asperity_engine::math::number::{length, sig};
use asperity_engine::physics::crest::Crests;
use asperity_engine::scene::Scene;

/// Slide-to-roll ratios beside the scene's own.
const SLIDING: [f64; 6] = [0.0, 0.1, 0.25, 0.5, 1.0, 1.5];

/// Counts of both bodies, and a table by S.
pub(super) fn tell(text: &mut String, scene: &Scene) {
    let of = scene.surfaces().map(|surface| {
        let (nx, heights_m, [pixel_m, _]) = surface.relief_heights_m()?;
        Crests::new(nx, &heights_m, pixel_m)
    });
    for (body, crests) in (1..).zip(&of) {
        let Some(crests) = crests else { continue };
        let _ = writeln!(
            text,
            "Crests of body {body} along x, a mm: {} maxima (by the spectrum {}, Longuet-Higgins 1957), {} upcrossings of the mean \
             ({}, Rice 1944)",
            per_mm(crests.maxima_per_m()),
            per_mm(crests.maxima_expected_per_m()),
            per_mm(crests.upcrossings_per_m()),
            per_mm(crests.upcrossings_expected_per_m()),
        );
    }
    for (body, mate) in [(1, 2), (2, 1)] {
        if let Some(crests) = &of[mate - 1] {
            highest(text, scene, body, crests);
        }
    }
}

fn per_mm(per_m: f64) -> String {
    sig(1e-3 * per_m, 3)
}

/// What a point of `body` meets of its mate's crests in a passage.
fn highest(text: &mut String, scene: &Scene, body: usize, crests: &Crests) {
    let around_m = crests.length_m();
    let mut sliding = SLIDING.to_vec();
    let own = scene.motion.slide_roll;
    if !sliding.contains(&own) {
        sliding.push(own);
        sliding.sort_by(f64::total_cmp);
    }
    let _ = writeln!(
        text,
        "\nThe highest that a point of body {body} meets of body {}, in Sq of {}; by extreme values: Vanmarcke 1975\n\
         {:>6} {:>12} {:>8} {:>16} {:>18}",
        3 - body,
        length(crests.rms_m()),
        "S",
        "passing by",
        "mean",
        "80 % of points",
        "by extreme values",
    );
    for slide_roll in sliding {
        // S = (U2 − U1)/U: U1 = 1 − S/2, U2 = 1 + S/2 in U.
        let speed = 1.0 + if body == 1 { -0.5 } else { 0.5 } * slide_roll;
        let passing_m = slide_roll.abs() / speed.abs() * 2.0 * scene.hertz().a_m;
        if !passing_m.is_finite() {
            continue;
        }
        let (found, sq_m) = (crests.highest(passing_m), crests.rms_m());
        let [mean, low, high, expected] = [
            found.mean_m,
            found.low_m,
            found.high_m,
            crests.highest_expected_m(passing_m),
        ]
        .map(|height_m| format!("{:.2}", height_m / sq_m).replace("-0.00", "0.00"));
        let mark = if slide_roll == own { "*" } else { " " };
        let _ = writeln!(
            text,
            "{slide_roll:>6}{mark}{:>12} {mean:>8} {:>16} {expected:>18}",
            length(passing_m),
            format!("{low} to {high}"),
        );
    }
    let _ = writeln!(
        text,
        "       (the surface comes again after {}: no crest is new beyond)",
        length(around_m)
    );
}
