//! Periodic dry contact: the bisinusoidal surface against public codes and the limits of Johnson,
//! Greenwood and Higginson (1985), Int. J. Mech. Sci. 27, 383-396.

use std::f64::consts::{PI, SQRT_2, TAU};

use crate::common::contact::bisinusoidal_gap;
use asperity_engine::math::grid::{Grid, Symmetry};
use asperity_engine::solve::dry::{Dry, DryProblem};
use asperity_engine::solve::film::Elastic;
use asperity_engine::solve::newton::{Iterate, NewtonReport, Tolerance, Verdict};

struct Solved {
    p_max: f64,
    area: f64,
    p: Vec<f64>,
    report: NewtonReport,
}

/// Gap `−cos cos` over one wave of length 1 at mean pressure `mean` (in p*), pressures in p*.
fn solved(nodes: usize, mean: f64) -> Solved {
    let grid = Grid::new(nodes, 0.0, 1.0, 0.5, Symmetry::General);
    // K̂ = 2πκ/k and gap amplitude 1 at k = √2 2π: p* = k/(2πκ) = 1.
    let mut elastic = Elastic::periodic(&grid, SQRT_2);
    let mut dry = Dry::new(&grid, &elastic);
    let gap = bisinusoidal_gap(&grid);
    let (mut p, mut h, mut h0) = (vec![0.0; grid.len()], vec![0.0; grid.len()], 0.0);
    let report = dry.solve(
        &mut elastic,
        &DryProblem {
            grid: &grid,
            gap: &gap,
            load: mean,
            tolerance: Tolerance {
                pressure: 1e-8,
                film: f64::INFINITY,
                mass: f64::INFINITY,
                least_film: 0.0,
                load: 1e-8,
                max_iterations: 20,
            },
        },
        &mut Iterate {
            p: &mut p,
            h: &mut h,
            h0: &mut h0,
        },
    );
    assert_eq!(report.verdict, Verdict::Converged, "{report:?}");
    let p_max = p.iter().copied().fold(0.0, f64::max);
    let loaded = p.iter().filter(|&&p| p > 0.0).count();
    let area = loaded as f64 / ((nodes - 1) * (nodes - 1)) as f64;
    let deepest = h.iter().copied().fold(f64::INFINITY, f64::min);
    assert!(deepest > -1e-7, "{deepest}");
    println!(
        "{nodes}, p_mean {mean}: p_max {p_max:.5}, area {area:.5}, {} directions, {} searches",
        report.linear_iterations, report.iterations
    );
    Solved {
        p_max,
        area,
        p,
        report,
    }
}

#[test]
fn bisinusoidal_contact_is_that_of_three_codes() {
    // dry.csv: p_mean/p*, p_max/p*, area fraction at 512², on which three codes agree to the digits given.
    for (mean, p_max, area) in [
        (0.05, 0.70940, 0.11335),
        (0.2, 1.09553, 0.34644),
        (0.5, 1.47934, 0.70510),
    ] {
        let now = solved(513, mean);
        assert!((now.p_max - p_max).abs() <= 2e-5, "{} {p_max}", now.p_max);
        // One ring of nodes is 1e-3 of the area; single nodes on the edge are 4e-6 each.
        assert!((now.area - area).abs() <= 5e-5, "{} {area}", now.area);
        assert!(now.report.linear_iterations < 60, "{:?}", now.report);
    }
}

#[test]
fn johnson_greenwood_higginson_limits() {
    // p̄ → 0: area → π (3 p̄/(8π p*))^{2/3}, from above by terms of order p̄^{2/3}.
    let light = solved(513, 2e-3);
    let limit = PI * (3.0 * 2e-3 / (8.0 * PI)).powf(2.0 / 3.0);
    println!("light: {} {limit}", light.area);
    assert!((light.area / limit - 1.0).abs() < 0.03);
    // p̄ → p*: 1 − area → (3/2π)(1 − p̄/p*).
    let heavy = solved(513, 0.98);
    let limit = 1.5 / PI * 0.02;
    println!("heavy: {} {limit}", 1.0 - heavy.area);
    assert!(((1.0 - heavy.area) / limit - 1.0).abs() < 0.05);
    // Full contact is Westergaard's: p = p̄ + p* cos cos at every node.
    let nodes = 65;
    let full = solved(nodes, 1.5);
    let grid = Grid::new(nodes, 0.0, 1.0, 0.5, Symmetry::General);
    for j in 0..nodes - 1 {
        for i in 0..nodes - 1 {
            let exact = 1.5 + (TAU * grid.x(i)).cos() * (TAU * grid.y(j)).cos();
            assert!((full.p[j * nodes + i] - exact).abs() < 1e-7);
        }
    }
}
