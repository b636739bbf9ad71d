//! Flash temperatures of whole runs against the integrals of moving sources, and that heat changes nothing else.
#![expect(clippy::unwrap_used, reason = "tests")]

use crate::whole::{goes_on_bit_for_bit, run, scene, small_demonstration as demonstration};
use asperity_engine::sim::Summary;

const DRY_LINE: &str = r#"
[contact]
kind = "line"
rx_m = 0.01
[body_1]
young_pa = 2.0e11
[body_2]
young_pa = 2.0e11
[motion]
entrainment_m_s = 1.0
slide_roll = 0.5
[load]
hertz_pressure_pa = 1.5e9
[grid]
nodes = 257
[numerics]
error_estimate = "none"
[heat]
bulk_k = 300.0
"#;

/// Both bodies of a dry smooth line share q0 = μ p_h |U2 − U1| of an elliptic band at equal temperatures: share of body 1, greatest
/// and mean rise in q0 b/k by quadrature of the integrals, at three pairs of Péclet numbers, on three meshes, with the flow
/// either way. Blok's formula is that of fast bodies.
#[test]
fn a_dry_line_is_as_warm_as_its_integrals() {
    let kappa = 46.0 / (7850.0 * 470.0);
    for (pe, share, max, mean) in [
        ([10.0, 5.0], 0.58528, 0.22673, 0.16308),
        ([100.0, 25.0], 0.66664, 0.08229, 0.05708),
        ([25.0, 100.0], 0.33336, 0.08229, 0.05708),
    ] {
        for nodes in [65, 129, 257] {
            let half_width = scene(DRY_LINE, &[]).hertz().a_m;
            let speeds = pe.map(|pe: f64| pe * kappa / half_width);
            let u = 0.5 * (speeds[0] + speeds[1]);
            for way in [1.0, -1.0] {
                let sets = [
                    format!("motion.entrainment_m_s={}", way * u),
                    format!("motion.slide_roll={}", (speeds[1] - speeds[0]) / u),
                    format!("grid.nodes={nodes}"),
                ];
                let found = run(&scene(DRY_LINE, &sets));
                let q0 = 0.1 * 1.5e9 * (speeds[1] - speeds[0]).abs();
                let unit = q0 * half_width / 46.0;
                let numbers = [
                    found.heat_share_1.unwrap() / share,
                    found.flash_temperature_max_k.unwrap() / (max * unit),
                    found.flash_temperature_mean_k.unwrap() / (mean * unit),
                    found.flash_temperature_blok_k.unwrap() / (max * unit),
                ];
                println!("Pe {pe:?}, {nodes} nodes: share, max, mean, Blok {numbers:.4?}");
                assert!((numbers[0] - 1.0).abs() < 1e-3);
                assert!((numbers[1] - 1.0).abs() < 2e-3 && (numbers[2] - 1.0).abs() < 5e-3);
                assert!((numbers[3] - 1.0).abs() < 0.011);
                let warmest = found.contact_temperature_max_k.unwrap();
                assert_eq!(warmest, 300.0 + found.flash_temperature_max_k.unwrap());
            }
        }
    }
}

/// Rolling makes no heat; less friction makes less in proportion.
#[test]
fn heat_is_in_proportion_to_what_is_made() {
    let rise = |sets: &[String]| run(&scene(DRY_LINE, sets)).flash_temperature_max_k.unwrap();
    let small = "grid.nodes=65".to_owned();
    assert_eq!(
        rise(&[small.clone(), "motion.slide_roll=0".to_owned()]),
        0.0
    );
    let whole = rise(std::slice::from_ref(&small));
    let tenth = rise(&[small, "friction.boundary=0.01".to_owned()]);
    assert!((tenth / whole - 0.1).abs() < 1e-9);
}

/// Every other number of a run with [heat] is that of the run without it: nothing goes back into film and friction.
#[test]
fn heat_changes_nothing_else() {
    let warm = run(&demonstration(&["heat.bulk_k=353"]));
    let plain = run(&demonstration(&[]));
    assert!(warm.flash_temperature_max_k.unwrap() > 1.0);
    let as_plain = Summary {
        flash_temperature_max_k: None,
        flash_temperature_mean_k: None,
        contact_temperature_max_k: None,
        heat_share_1: None,
        flash_temperature_blok_k: None,
        inlet_heating_factor: None,
        cautions: plain.cautions.clone(),
        ..warm
    };
    assert_eq!(as_plain, plain);
}

/// A run with heat that is saved and taken up again ends as the uninterrupted one.
#[test]
fn a_warm_run_goes_on_bit_for_bit() {
    goes_on_bit_for_bit(&demonstration(&["heat.bulk_k=353"]), &[30, 100, 171]);
}
