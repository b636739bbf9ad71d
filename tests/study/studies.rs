//! The studies in their quick forms: orders, counters and bounds, never seconds.

use asperity_study::Extent;
use asperity_study::accuracy::{Accuracy, Against, Series, Varied, accuracy};
use asperity_study::stability::{MUST_CONVERGE, TrialEnd, stability, stability_report};

fn find<'a>(result: &'a Accuracy, quantity: &str, varied: Varied) -> &'a Series {
    let mut series = result.series.iter();
    let found = series.find(|series| (series.quantity, series.varied) == (quantity, varied));
    found.unwrap_or_else(|| panic!("{quantity} over {varied:?}"))
}

#[test]
fn accuracy_shows_the_orders_of_the_schemes() {
    let result = accuracy(Extent::Quick, None, 2, &mut |_, _, _| {}).expect("a study");
    let report = result.report().expect("drawn");
    println!("{}", report.text);
    assert!(report.passes);
    for series in &result.series {
        assert!(series.rows.iter().all(|row| row.work > 0), "{series:?}");
    }
    // Second order in the mean; the maximum of a field at nodes and the sampled edge of Hertz less.
    for (quantity, least) in [
        ("pressure, L2", 0.9),
        ("maximum pressure", 1.5),
        ("central film", 1.8),
        ("worst component, z > a/4", 1.8),
        ("life integral, m = 10", 1.7),
        ("mean central film", 1.6),
    ] {
        let series = find(&result, quantity, Varied::Nodes);
        let order = series.rows.last().and_then(|row| row.order);
        assert!(
            order.is_some_and(|order| order >= least),
            "{quantity}: {order:?}"
        );
    }
    for (quantity, most) in [
        ("pressure, L2", 2e-3),
        ("central film", 5e-3),
        ("worst component, z > a/4", 2e-3),
        ("maximum von Mises", 1e-4),
        ("life integral, m = 10", 5e-4),
    ] {
        let known = result
            .series
            .iter()
            .filter(|series| series.quantity == quantity && series.against != Against::Finest);
        let errors = known.flat_map(|series| &series.rows).map(|row| row.error);
        let error = errors.fold(f64::INFINITY, f64::min);
        assert!(error <= most, "{quantity}: {error}");
    }
    // A tighter tolerance leaves less and takes more.
    let rows = &find(&result, "pressure, iteration", Varied::Tolerance).rows;
    assert!(rows.len() >= 4);
    for pair in rows.windows(2) {
        assert!(pair[1].error < pair[0].error && pair[1].work >= pair[0].work);
    }
    assert_eq!(report.plots.len(), 2);
    for (name, text) in &report.plots {
        assert!(
            text.contains("</svg>") && text.contains("time, s"),
            "{name}"
        );
    }
}

#[test]
fn extreme_cases_converge_or_are_named() {
    check_extremes(&[]);
}

/// The same with warm oil, which thins by Roelands' law.
#[test]
fn extreme_cases_with_warm_oil_converge_or_are_named() {
    check_extremes(&["heat.viscosity_temperature_exponent=1.1".to_owned()]);
}

fn check_extremes(keys: &[String]) {
    let result = stability(Extent::Quick, None, keys, 2, &mut |_, _, _| {}).expect("a study");
    println!("{}", stability_report(&result).text);
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

/// The contact outgrows its domain: no solver can help, so this fails for good, and the refusal says how far one can go.
#[test]
fn a_case_that_cannot_work_ends_by_name() {
    let only = Some("load x 20 in the usual domain");
    let result = stability(Extent::Quick, only, &[], 1, &mut |_, _, _| {}).expect("a study");
    let [row] = &result.rows[..] else {
        panic!("{} rows", result.rows.len());
    };
    let TrialEnd::Refused(reason) = &row.trial.ending else {
        panic!("{:?}", row.trial.ending);
    };
    assert!(
        reason.contains("load.force_n = 3000 is out of range: at most"),
        "{reason}"
    );
    assert!(
        !result.passes(),
        "a set of one case that fails does not pass"
    );
}
