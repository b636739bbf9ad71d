//! The studies in their quick forms: orders, counters and bounds, never seconds.

use asperity_study::Extent;
use asperity_study::accuracy::{Accuracy, Against, StudiedPart, Varied, accuracy, accuracy_table};
use asperity_study::accuracy::{life_plot, work_precision_plot};
use asperity_study::stability::{MUST_CONVERGE, TrialEnd, stability, stability_text};

fn order(result: &Accuracy, part: StudiedPart, quantity: &str, varied: Varied) -> f64 {
    let mut rows = result.rows.iter().filter(|row| {
        (row.part, row.quantity, row.varied) == (part, quantity, varied) && row.order.is_some()
    });
    let last = rows.next_back().expect("a series");
    last.order.expect("an order")
}

fn least_error(result: &Accuracy, part: StudiedPart, quantity: &str) -> f64 {
    let rows = result.rows.iter().filter(|row| {
        (row.part, row.quantity) == (part, quantity) && row.against != Against::Finest
    });
    rows.map(|row| row.error).fold(f64::INFINITY, f64::min)
}

#[test]
fn accuracy_shows_the_orders_of_the_schemes() {
    let result = accuracy(Extent::Quick, 2, &mut |_, _, _| {}).expect("a study");
    println!("{}", accuracy_table(&result).markdown());
    assert!(result.passes());
    for part in StudiedPart::ALL {
        assert!(
            result.rows.iter().any(|row| row.part == part && row.front),
            "{part:?} has a front"
        );
        assert!(
            result
                .rows
                .iter()
                .filter(|row| row.part == part)
                .all(|row| row.work > 0),
            "{part:?} counts its work"
        );
    }
    // Second order in the mean; the greatest of a field at nodes and the sampled edge of Hertz less.
    for (part, quantity, least) in [
        (StudiedPart::DryHertz, "pressure, L2", 0.9),
        (StudiedPart::DryHertz, "greatest pressure", 1.5),
        (StudiedPart::SmoothFilm, "central film", 1.8),
        (StudiedPart::Slice, "worst component, z > a/4", 1.8),
        (StudiedPart::LifeIntegral, "integral, m = 10", 1.7),
        (StudiedPart::RoughFilm, "mean central film", 1.6),
    ] {
        let order = order(&result, part, quantity, Varied::Nodes);
        println!("{}, {quantity}: order {order:.2}", part.name());
        assert!(order >= least, "{quantity}: {order}");
    }
    for (part, quantity, most) in [
        (StudiedPart::DryHertz, "pressure, L2", 2e-3),
        (StudiedPart::Deflection, "deflection, r < a/2", 1e-5),
        (StudiedPart::SmoothFilm, "central film", 5e-3),
        (StudiedPart::Slice, "worst component, z > a/4", 2e-3),
        (StudiedPart::Volume, "greatest von Mises", 1e-4),
        (StudiedPart::LifeIntegral, "integral, m = 10", 5e-4),
    ] {
        let error = least_error(&result, part, quantity);
        println!("{}, {quantity}: least error {error:.1e}", part.name());
        assert!(error <= most, "{quantity}: {error}");
    }
    // Single precision loses nothing that the mesh has not lost.
    let deflections: Vec<_> = result
        .rows
        .iter()
        .filter(|row| row.part == StudiedPart::Deflection)
        .collect();
    for pair in deflections.chunks(2) {
        assert!((pair[0].error - pair[1].error).abs() < 1e-6 + 0.1 * pair[1].error);
    }
    // A tighter tolerance leaves less and takes more.
    let tolerance: Vec<_> = result
        .rows
        .iter()
        .filter(|row| row.part == StudiedPart::DryHertz && row.varied == Varied::Tolerance)
        .collect();
    assert!(tolerance.len() >= 4);
    for pair in tolerance.windows(2) {
        assert!(pair[1].error < pair[0].error && pair[1].work >= pair[0].work);
    }
    for plot in [work_precision_plot(&result), life_plot(&result)] {
        let text = plot.expect("drawn");
        assert!(text.contains("</svg>") && text.contains("time, s"));
    }
}

#[test]
fn extreme_cases_converge_or_are_named() {
    let result = stability(Extent::Quick, None, 2, &mut |_, _, _| {}).expect("a study");
    println!("{}", stability_text(&result));
    assert!(result.rows.len() >= 20);
    assert_eq!(result.quiet(), 0);
    assert!(result.converged() as f64 >= MUST_CONVERGE * result.rows.len() as f64);
    assert!(result.drift.is_steady(), "{:?}", result.drift);
    for row in &result.rows {
        assert_eq!(row.trial.not_finite, 0, "{}", row.name);
        assert!(row.trial.steps > 0, "{}: {:?}", row.name, row.trial.ending);
        assert!(row.trial.p_min >= 0.0, "{}", row.name);
    }
}

/// A case that cannot work ends by name, and the nearest setting that works is found on the way back. (The contact
/// outgrows its domain: no solver can help, so this fails for good.)
#[test]
fn a_failure_names_the_nearest_setting_that_works() {
    let only = Some("load x 20 in the usual domain");
    let result = stability(Extent::Quick, only, 1, &mut |_, _, _| {}).expect("a study");
    let [row] = &result.rows[..] else {
        panic!("{} rows", result.rows.len());
    };
    let TrialEnd::Refused(reason) = &row.trial.ending else {
        panic!("{:?}", row.trial.ending);
    };
    let after = |text: &str, word: &str| -> f64 {
        let (_, rest) = text.split_once(word).expect(word);
        let end = rest.find([' ', ',']).unwrap_or(rest.len());
        rest[..end].parse().expect(rest)
    };
    let most = after(reason, "at most ");
    let remedy = row.remedy.as_deref().expect("a setting that works");
    println!("{remedy}; at most {most}");
    let works = after(remedy, "jump.load.force_n = ");
    // From 150 N to 3000 N; the search halves the way four times, in the logarithm.
    assert!(remedy.ends_with(" works"), "{remedy}");
    assert!(works > 150.0 && works <= most, "{remedy}");
    assert!(
        works * 20.0_f64.powf(2.0 / 16.0) > most,
        "{remedy}: the nearest"
    );
    assert!(
        !result.passes(),
        "a set of one case that fails does not pass"
    );
}
