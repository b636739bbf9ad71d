//! Dry Hertz contact from a uniform start.
//!
//! ```text
//! p = √(1 − r²)      K p + r²/2 = 1  inside r ≤ 1      (lengths in a, pressure in p_h, film in a²/R)
//! ```
//! Closed form: Hertz (1882); the pressure's relative L2 error and that of its maximum.

use std::f64::consts::PI;

use super::super::StudyError;
use super::series::{Against, Measured, Part, Series, Varied, timed};
use asperity_engine::math::grid::{Grid, Symmetry};
use asperity_engine::solve::march::{Conditions, Flow, Guess, March, Shape};
use asperity_engine::solve::newton::{Tolerance, Verdict};
use asperity_engine::solve::reynolds::Medium;

/// ∬p of Hertz.
pub(super) const LOAD: f64 = 2.0 * PI / 3.0;
/// Tolerance of the pressure in the series over nodes.
const TIGHT: f64 = 1e-8;
/// Nodes of the series over the tolerance, and the tolerance that it is measured against.
const ITERATED_NODES: f64 = 129.0;
const LIMIT: f64 = 1e-10;

struct Solved {
    march: March,
    iterations: u32,
    seconds: f64,
}

fn solve(nodes: f64, tolerance: f64) -> Result<Solved, String> {
    let conditions = Conditions {
        medium: &Medium::DRY,
        law: None,
        shift: &[],
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
    let grid = Grid::new(nodes as usize, -1.5, 1.5, 1.5, Symmetry::General);
    let mut march = March::from_hertz(grid, &Shape::CIRCLE, 0.0, 1.0, Flow::Dry);
    // From a uniform pressure over the whole domain: the dearest start.
    march.state.history.pressure_1.fill(0.0);
    let (report, seconds) = timed(|| march.attempt(&conditions, 1.0, Guess::Last));
    if report.verdict != Verdict::Converged {
        return Err(format!("{nodes}², tolerance {tolerance}: {report:?}"));
    }
    march.commit(1.0);
    Ok(Solved {
        march,
        iterations: report.linear_iterations,
        seconds,
    })
}

impl Solved {
    fn measured<const N: usize>(&self, values: [f64; N]) -> Measured<N> {
        Measured {
            values,
            seconds: self.seconds,
            work: u64::from(self.iterations),
        }
    }
}

fn exact(grid: &Grid, n: usize) -> f64 {
    let r2 = grid.x(n % grid.nx).powi(2) + grid.y(n / grid.nx).powi(2);
    (1.0 - r2).max(0.0).sqrt()
}

/// Errors over nodes, then over the tolerance.
pub(super) fn hertz(nodes: &[f64]) -> Result<Vec<Series>, StudyError> {
    let over_nodes = Part {
        name: "dry Hertz",
        quantities: ["pressure, L2", "maximum pressure"],
        against: Against::ClosedForm,
        work_unit: "directions",
    };
    let rest = format!("tolerance {TIGHT:e}");
    let mut series = over_nodes.over(Varied::Nodes, nodes, &rest, |nodes| {
        let solved = solve(nodes, TIGHT)?;
        let (grid, p) = (&solved.march.solver.grid, &solved.march.state.pressure);
        let off = grid.integrate(|n| (p[n] - exact(grid, n)).powi(2));
        let l2 = (off / grid.integrate(|n| exact(grid, n).powi(2))).sqrt();
        let maximum = p.iter().copied().fold(0.0, f64::max);
        Ok(solved.measured([l2, (maximum - 1.0).abs()]))
    })?;
    let over_tolerance = Part {
        name: "dry Hertz",
        quantities: ["pressure, iteration"],
        against: Against::TighterTolerance,
        work_unit: "directions",
    };
    let tolerances = [1e-2, 1e-3, 1e-4, 1e-6, 1e-8];
    let rest = format!("N {ITERATED_NODES}");
    let limit = solve(ITERATED_NODES, LIMIT);
    let more = over_tolerance.over(Varied::Tolerance, &tolerances, &rest, |tolerance| {
        let limit = limit.as_ref().map_err(Clone::clone)?;
        let solved = solve(ITERATED_NODES, tolerance)?;
        let (p, best) = (&solved.march.state.pressure, &limit.march.state.pressure);
        let grid = &solved.march.solver.grid;
        let off = grid.integrate(|n| (p[n] - best[n]).abs());
        Ok(solved.measured([off / LOAD]))
    })?;
    series.extend(more);
    Ok(series)
}
