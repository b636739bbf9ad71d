//! Smooth steady circular contacts against the whole computed tables, and the observed order in space.
//!
//! The reference values were computed by independent multigrid codes (`assets/reference/`). Each row is
//! solved on three grids; the two finest, extrapolated with the order of the scheme (2), must agree with
//! the row within the tolerance that its file gives. The finest grid alone must lie within the mesh rule
//! `(ΔX/H_c^{2/3})²` of the reference, beside that tolerance. Every grid is flushed; after it the film of a
//! finer grid moves by less than a tenth of the tolerance (checked on the two coarser ones by the order).
//!
//! The rows of M ≥ 1000 (257² and 513²) take minutes: `cargo test --release --test engine ehl_smooth:: -- --ignored
//! --nocapture`. Their numbers stand at the tests.

use crate::common::contact::{Case, Fluid, Row, Table, central, minimum};
use asperity_engine::physics::groups::PointContact;

/// Domain of the tables, in a.
const TABLE: (f64, f64, f64) = (-4.5, 1.5, 3.0);
/// Domain of the speed sweep, in a.
const SWEEP: (f64, f64, f64) = (-2.5, 1.5, 2.0);

/// Central and minimum film: what the reference says, on its finest grids or extrapolated.
struct Reference {
    central: f64,
    minimum: f64,
    /// Relative.
    tolerance: f64,
}

/// Central and minimum film of each grid, 65² first, in units of `film`.
fn films(case: &Case, nodes: usize, unit: f64) -> Vec<[f64; 2]> {
    let mut films = Vec::new();
    let (_, ladder) = case.steady_by_ladder(nodes, |march| {
        films.push([unit * central(march), unit * minimum(march)]);
    });
    println!("  {ladder:?}");
    assert_eq!(ladder.not_converged, 0, "every step converges");
    films
}

fn extrapolated(coarse: f64, fine: f64) -> f64 {
    fine + (fine - coarse) / 3.0
}

/// Solves one row, prints it and compares; the relative error of the central film and the observed order in space.
fn compare(name: &str, case: &Case, nodes: usize, unit: f64, reference: &Reference) -> (f64, f64) {
    let films = films(case, nodes, unit);
    let [.., coarsest, coarse, fine] = films[..] else {
        panic!("three grids");
    };
    let whole = [0, 1].map(|k| extrapolated(coarse[k], fine[k]));
    let order = ((coarse[0] - coarsest[0]) / (fine[0] - coarse[0]))
        .abs()
        .log2();
    let error = [
        whole[0] / reference.central - 1.0,
        whole[1] / reference.minimum - 1.0,
    ];
    let dx = (case.domain.1 - case.domain.0) / (nodes - 1) as f64;
    let rule = (dx / (reference.central / unit).powf(2.0 / 3.0)).powi(2);
    let single = fine[0] / reference.central - 1.0;
    println!(
        "{name}: central {:.4} {:.4} {:.4} -> {:.4} ({}, {:+.2} %), minimum {:.4} {:.4} {:.4} -> {:.4} ({}, \
         {:+.2} %), tolerance {:.1} %; {nodes}² alone {:+.2} %, mesh rule {:.2} %; order {order:.2}",
        coarsest[0],
        coarse[0],
        fine[0],
        whole[0],
        reference.central,
        100.0 * error[0],
        coarsest[1],
        coarse[1],
        fine[1],
        whole[1],
        reference.minimum,
        100.0 * error[1],
        100.0 * reference.tolerance,
        100.0 * single,
        100.0 * rule,
    );
    assert!(error[0].abs() < reference.tolerance, "{name}: central");
    assert!(error[1].abs() < reference.tolerance, "{name}: minimum");
    assert!(
        single.abs() < rule + reference.tolerance,
        "{name}: mesh rule"
    );
    (error[0], order)
}

fn is_long(row: &Row) -> bool {
    row.number("M") >= 1000.0
}

/// The observed order in space.
fn barus(row: Row) -> f64 {
    let (m, l) = (row.number("M"), row.number("L"));
    let case = Case::moes(m, l, Fluid::BarusIncompressible, TABLE);
    let reference = Reference {
        central: row.number("h_central_extrapolated"),
        minimum: row.number("h_min_extrapolated"),
        tolerance: row.number("tolerance_percent") / 100.0,
    };
    let nodes = if is_long(&row) { 513 } else { 257 };
    compare(
        &format!("Barus M {m} L {l}"),
        &case,
        nodes,
        case.film(1.0),
        &reference,
    )
    .1
}

/// Extrapolated minimum film over that on 512², from the file for Barus; 1 where it has no row of this M and L.
fn minimum_beyond_512(m: f64, l: f64) -> f64 {
    let table = rows("smooth_barus_incompressible.csv", |row| {
        row.number("M") == m && row.number("L") == l
    });
    let ratio = |row: Row| row.number("h_min_extrapolated") / row.number("h_min_512");
    table.rows().next().map_or(1.0, ratio)
}

/// The row under one form of the density law; the central film within `central` of the file's in place of its tolerance.
fn roelands(row: Row, fluid: Fluid, central: Option<f64>) {
    let (m, l) = (row.number("M"), row.number("L"));
    let case = Case::moes(m, l, fluid, TABLE);
    // The file holds single grids. The central film is extrapolated here; of the minimum there is only 512². What that
    // grid lacks is taken from the row of the same M and L in the file for Barus, which has both: 0.04 % at M = 20,
    // 0.4 % at 200, but 4.5 % at 1000.
    let reference = Reference {
        central: extrapolated(row.number("h_central_256"), row.number("h_central_512")),
        minimum: row.number("h_min_512") * minimum_beyond_512(m, l),
        tolerance: row.number("tolerance_percent") / 100.0,
    };
    let name = format!("{fluid:?} M {m} L {l}");
    let nodes = if is_long(&row) { 513 } else { 257 };
    let (found, _) = compare(&name, &case, nodes, case.film(1.0), &reference);
    if let Some(bound) = central {
        assert!(found.abs() < bound, "{name}: {found}");
    }
}

fn rows(name: &str, long: impl Fn(&Row) -> bool) -> Table {
    let mut table = Table::read(name);
    table.keep(long);
    table
}

#[test]
fn barus_incompressible_table_and_the_order_in_space() {
    let table = rows("smooth_barus_incompressible.csv", |row| !is_long(row));
    assert_eq!(table.rows().count(), 5);
    for row in table.rows() {
        let m = row.number("M");
        let order = barus(row);
        // Where the asymptotic range begins at 65²: M = 20.
        assert!(m != 20.0 || order >= 1.8, "{order}");
    }
}

#[test]
fn roelands_dowson_higginson_table() {
    let table = rows("smooth_roelands_dh.csv", |row| !is_long(row));
    assert_eq!(table.rows().count(), 3);
    for row in table.rows() {
        roelands(row, Fluid::RoelandsDowsonHigginson, None);
    }
}

/// With 1 + 0.6 p/(1 + 1.7 p) all central films lie 0.4 to 0.6 % below the file's. With the density law in its other
/// round numbers, (0.59 + 1.34 p)/(0.59 + p), they lie within 0.02 %: those are the file's, and that is all of the difference.
#[test]
fn the_other_form_of_the_density_law_gives_the_files_films() {
    let table = rows("smooth_roelands_dh.csv", |row| !is_long(row));
    assert_eq!(table.rows().count(), 3);
    for row in table.rows() {
        roelands(row, Fluid::RoelandsVennerLubrecht, Some(5e-4));
    }
}

/// Found on 257² and 513², extrapolated: Barus central 4.0620, 4.0804 → 4.0865 (4.087, −0.01 %), minimum 1.2714, 1.2220 →
/// 1.2056 (1.216, −0.9 %; tolerance 2 %); 511 or all of 512 steps from Hertz at the first try. Roelands central 3.1878,
/// 3.2022 → 3.2070 (3.226, −0.6 %), minimum 1.1466, 1.1222 → 1.1141 (1.108: the file's 1.0609 on 512², which is 4.3 % too
/// low in the row for Barus; +0.5 %; tolerance 3 %); the same.
#[test]
#[ignore = "minutes"]
fn tables_at_m_1000() {
    let table = rows("smooth_barus_incompressible.csv", is_long);
    for row in table.rows() {
        barus(row);
    }
    let table = rows("smooth_roelands_dh.csv", is_long);
    for row in table.rows() {
        roelands(row, Fluid::RoelandsDowsonHigginson, None);
    }
}

/// Found, central and minimum in Moes units by grid (65², 129², 257², 513²): 4.4005, 4.9808, 5.0768, 5.1072 and 1.4347,
/// 1.7576, 1.4012, 1.4054; the formula gives 4.8208. 512 steps: 511 at the first try, 1 from the last pressure
/// as guess, none halved, none by the safe settings.
#[test]
#[ignore = "minutes"]
fn m_2000_l_15_converges_from_hertz() {
    // No reference holds it: it must converge at every step, its grids approach each other, and the film lie
    // within 15 % of the formula (which lies 7 to 13 % below computed films, tests of `film_regression`).
    let case = Case::moes(2000.0, 15.0, Fluid::BarusIncompressible, TABLE);
    let films = films(&case, 513, case.film(1.0));
    let formula =
        asperity_engine::physics::film_regression::nijenbanning_central(1.0, 2000.0, 15.0);
    println!("M 2000 L 15: central, minimum by grid {films:.4?}; formula {formula:.4}");
    let [.., coarse, middle, fine] = films[..] else {
        panic!("three grids");
    };
    assert!((fine[0] - middle[0]).abs() < (middle[0] - coarse[0]).abs());
    assert!((fine[0] / formula - 1.0).abs() < 0.15, "{}", fine[0]);
}

/// Found at 513² and extrapolated with 257²: U = 10 m/s central 2084.3 → 2084.5 nm (2097, −0.6 %), minimum 1219.8 →
/// 1219.7 (1222, −0.2 %); U = 1 m/s 428.52 → 428.76 (431.4, −0.6 %), minimum 169.32 → 168.89 (169.1, −0.1 %).
/// Every step at the first try. Why all rows with Roelands and Dowson-Higginson lie 0.4 to 0.7 % low, all of
/// Barus incompressible within 0.04 %: `the_other_form_of_the_density_law_gives_the_files_films`.
/// U = 0.1 m/s 83.45 → 83.80 (84.4, −0.7 %), minimum 22.81 → 22.43 (22.3, +0.6 %), tolerance 3 %.
#[test]
#[ignore = "minutes"]
fn speed_sweep_of_the_base_case() {
    // At 0.01 m/s the reference has no minimum and says 15 %: its own 512² and 1024² give 11.7 and 15.3 nm.
    let table = rows("speed_sweep_mixed_base_case.csv", |row| {
        row.get("hmin_trusted").is_some()
    });
    for row in table.rows() {
        let speed = row.number("u_m_s");
        let point = PointContact {
            rx_m: 0.01905,
            ry_m: 0.01905,
            e_prime_pa: 219.78e9,
            viscosity_pa_s: 0.096,
            alpha_per_pa: 18.2e-9,
            entrainment_m_s: speed,
            force_n: 800.0,
        };
        let case = Case::of_point(&point, SWEEP);
        let a = point.hertz().a_m;
        let nm = a * a / point.rx_m * 1e9;
        let reference = Reference {
            central: row.number("hc_trusted"),
            minimum: row.number("hmin_trusted"),
            tolerance: row.number("tolerance_percent") / 100.0,
        };
        compare(&format!("U {speed} m/s, nm"), &case, 513, nm, &reference);
    }
}
