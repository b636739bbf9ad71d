//! Dry Hertz contact from a uniform start, and its deflection in both precisions.
//!
//! ```text
//! p = √(1 − r²)      K p + r²/2 = 1  inside r ≤ 1      (lengths in a, pressure in p_h, film in a²/R)
//! ```
//! Closed form: Hertz (1882); the pressure's relative L2 error and that of its greatest value, and the worst error of
//! the deflection inside r ≤ 1/2, over its value at the centre.

use std::f64::consts::PI;

use super::row::{AccuracyRow, Against, StudiedPart, Timed, Varied, timed};
use asperity_engine::math::grid::{Grid, Symmetry};
use asperity_engine::solve::film::Elastic;
use asperity_engine::solve::march::{Conditions, Flow, Guess, March, Shape};
use asperity_engine::solve::newton::{NewtonReport, Tolerance, Verdict};
use asperity_engine::solve::reynolds::Medium;

/// ∬p of Hertz.
pub(super) const LOAD: f64 = 2.0 * PI / 3.0;
/// Tolerance of the pressure in the series over nodes.
const TIGHT: f64 = 1e-8;

struct Solved {
    march: March,
    report: NewtonReport,
    time: Timed,
}

fn solve(nodes: usize, tolerance: f64) -> Result<Solved, String> {
    let conditions = Conditions {
        medium: &Medium::DRY,
        law: None,
        load: LOAD,
        tolerance: Tolerance {
            pressure: tolerance,
            film: f64::INFINITY,
            mass: f64::INFINITY,
            least_film: 0.0,
            load: 1e-8,
            max_iterations: 40,
        },
    };
    let grid = Grid::new(nodes, -1.5, 1.5, 1.5, Symmetry::General);
    let mut march = March::from_hertz(grid, &Shape::CIRCLE, 0.0, 1.0, Flow::Dry);
    // From a uniform pressure over the whole domain: the dearest start.
    march.state.history.pressure_1.fill(0.0);
    let (report, time) = timed(|| march.attempt(&conditions, 1.0, Guess::Last));
    if report.verdict != Verdict::Converged {
        return Err(format!("{nodes}², tolerance {tolerance}: {report:?}"));
    }
    march.commit(1.0);
    Ok(Solved {
        march,
        report,
        time,
    })
}

fn exact(grid: &Grid, n: usize) -> f64 {
    let r2 = grid.x(n % grid.nx).powi(2) + grid.y(n / grid.nx).powi(2);
    (1.0 - r2).max(0.0).sqrt()
}

/// Errors over nodes, then over the tolerance against a far tighter one.
pub(super) fn hertz(sizes: &[usize], tolerances: &[f64]) -> Result<Vec<AccuracyRow>, String> {
    let mut rows = Vec::new();
    let row = |solved: &Solved, quantity, varied, setting, fixed: String, error| AccuracyRow {
        part: StudiedPart::DryHertz,
        quantity,
        varied,
        setting,
        fixed,
        value: None,
        error,
        against: Against::ClosedForm,
        order: None,
        seconds: solved.time.seconds,
        runs: solved.time.runs,
        threads: rayon::current_num_threads(),
        work: u64::from(solved.report.linear_iterations),
        work_unit: "directions",
        bytes: None,
        front: false,
    };
    let all: Vec<Solved> = sizes
        .iter()
        .map(|&nodes| solve(nodes, TIGHT))
        .collect::<Result<_, _>>()?;
    for quantity in ["pressure, L2", "greatest pressure"] {
        for solved in &all {
            let (grid, p) = (&solved.march.solver.grid, &solved.march.state.pressure);
            let error = if quantity == "pressure, L2" {
                let off = grid.integrate(|n| (p[n] - exact(grid, n)).powi(2));
                (off / grid.integrate(|n| exact(grid, n).powi(2))).sqrt()
            } else {
                (p.iter().copied().fold(0.0, f64::max) - 1.0).abs()
            };
            let fixed = format!("tolerance {TIGHT:e}");
            let setting = grid.nx as f64;
            rows.push(row(solved, quantity, Varied::Nodes, setting, fixed, error));
        }
    }
    let nodes = sizes[sizes.len().min(3) - 1];
    let limit = solve(nodes, 1e-10)?;
    for &tolerance in tolerances {
        let solved = solve(nodes, tolerance)?;
        let (p, best) = (&solved.march.state.pressure, &limit.march.state.pressure);
        let error = solved
            .march
            .solver
            .grid
            .integrate(|n| (p[n] - best[n]).abs())
            / LOAD;
        let fixed = format!("N {nodes}");
        let mut row = row(
            &solved,
            "pressure, iteration",
            Varied::Tolerance,
            tolerance,
            fixed,
            error,
        );
        row.against = Against::Finest;
        rows.push(row);
    }
    Ok(rows)
}

/// One transform pair in double and in single precision.
pub(super) fn deflection(sizes: &[usize]) -> Vec<AccuracyRow> {
    let mut rows = Vec::new();
    for &nodes in sizes {
        let grid = Grid::new(nodes, -1.5, 1.5, 1.5, Symmetry::General);
        let mut elastic = Elastic::new(&grid, Shape::CIRCLE.kappa);
        let p: Vec<f64> = (0..grid.len()).map(|n| exact(&grid, n)).collect();
        let mut u = vec![0.0; grid.len()];
        let ((), double) = timed(|| elastic.deflect(&p, &mut u));
        let single_p: Vec<f32> = p.iter().map(|&p| p as f32).collect();
        let mut single_u = vec![0.0_f32; grid.len()];
        let ((), single) = timed(|| elastic.deflect_single(&single_p, &mut single_u));
        let widened: Vec<f64> = single_u.iter().map(|&u| f64::from(u)).collect();
        for (bits, field, time) in [(32.0, &widened, single), (64.0, &u, double)] {
            rows.push(AccuracyRow {
                part: StudiedPart::Deflection,
                quantity: "deflection, r < a/2",
                varied: Varied::Precision,
                setting: bits,
                fixed: format!("N {nodes}"),
                value: None,
                error: worst_deflection(&grid, field),
                against: Against::ClosedForm,
                order: None,
                seconds: time.seconds,
                runs: time.runs,
                threads: rayon::current_num_threads(),
                work: 1,
                work_unit: "transform pairs",
                bytes: None,
                front: false,
            });
        }
    }
    rows
}

/// Worst |K p + r²/2 − 1| inside r ≤ 1/2.
fn worst_deflection(grid: &Grid, u: &[f64]) -> f64 {
    let mut worst: f64 = 0.0;
    for (n, u) in u.iter().enumerate() {
        let r2 = grid.x(n % grid.nx).powi(2) + grid.y(n / grid.nx).powi(2);
        if r2 <= 0.25 {
            worst = worst.max((u + 0.5 * r2 - 1.0).abs());
        }
    }
    worst
}
