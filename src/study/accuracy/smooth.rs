//! Smooth steady film of a circular contact against the computed table.
//!
//! M = 20, L = 10, Barus, incompressible, edges −4.5 a, 1.5 a, ±3 a: central film 4.804, minimum film 2.961 in Moes
//! units, to 0.5 % (`assets/reference/smooth_barus_incompressible.csv`). Started from Hertz on 65² (33² on itself),
//! flushed, refined, flushed again, as a run does.

use std::f64::consts::PI;

use super::super::StudyError;
use super::hertz::LOAD;
use super::series::{Against, Measured, Part, Series, Varied, timed};
use asperity_engine::math::grid::{Grid, Symmetry, refined_nodes};
use asperity_engine::physics::fluid::{Density, Viscosity};
use asperity_engine::solve::march::{Conditions, Flow, Guess, March, Shape};
use asperity_engine::solve::newton::{Tolerance, Verdict};
use asperity_engine::solve::reynolds::Medium;

const M: f64 = 20.0;
const L: f64 = 10.0;
const CENTRAL: f64 = 4.804;
const LEAST: f64 = 2.961;
const DOMAIN: (f64, f64, f64) = (-4.5, 1.5, 3.0);
/// Tolerance of the series over nodes.
const TIGHT: f64 = 1e-4;
/// Nodes of the series over the tolerance.
const ITERATED_NODES: usize = 65;

/// Central and minimum film in Moes units, and the work.
struct SmoothFilm {
    central: f64,
    least: f64,
    newton: u64,
}

/// Film over nodes against the table, over the tolerance against the tightest.
pub(super) fn smooth(nodes: &[f64]) -> Result<Vec<Series>, StudyError> {
    let over_nodes = Part {
        name: "smooth film",
        quantities: ["central film", "minimum film"],
        against: Against::Table,
        work_unit: "Newton",
    };
    let rest = format!("tolerance {TIGHT:e}");
    let mut series = over_nodes.over(Varied::Nodes, nodes, &rest, |nodes| {
        let (film, seconds) = timed(|| solve(nodes as usize, TIGHT));
        let film = film?;
        let errors = [film.central / CENTRAL - 1.0, film.least / LEAST - 1.0];
        Ok(Measured {
            values: errors.map(f64::abs),
            seconds,
            work: film.newton,
        })
    })?;
    let over_tolerance = Part {
        name: "smooth film",
        quantities: ["central film, iteration"],
        against: Against::Finest,
        work_unit: "Newton",
    };
    let tolerances = [1e-1, 1e-2, 1e-3, 1e-4, 1e-6];
    let rest = format!("N {ITERATED_NODES}");
    series.extend(
        over_tolerance.over(Varied::Tolerance, &tolerances, &rest, |tolerance| {
            let (film, seconds) = timed(|| solve(ITERATED_NODES, tolerance));
            let film = film?;
            Ok(Measured {
                values: [film.central],
                seconds,
                work: film.newton,
            })
        })?,
    );
    Ok(series)
}

fn solve(nodes: usize, tolerance: f64) -> Result<SmoothFilm, String> {
    let lambda = (128.0 * PI.powi(3) / (3.0 * M.powi(4))).cbrt();
    let alpha_p = L / PI * (1.5 * M).cbrt();
    let viscosity = Viscosity::Barus { alpha_p };
    let medium = Medium::newtonian(viscosity, Density::Incompressible, lambda);
    let conditions = Conditions {
        medium: &medium,
        law: None,
        shift: &[],
        load: LOAD,
        tolerance: Tolerance {
            pressure: tolerance,
            film: tolerance,
            mass: tolerance,
            least_film: 0.0,
            load: 1e-5,
            max_iterations: 20,
        },
    };
    let (x_min, x_max, y_half) = DOMAIN;
    let grid = |nodes| Grid::new(nodes, x_min, x_max, y_half, Symmetry::MirrorY);
    let guess = 1.2 * lambda.powf(0.67);
    let mut march = March::from_hertz(grid(nodes.min(65)), &Shape::CIRCLE, guess, 1.0, Flow::Film);
    let mut newton = 0;
    loop {
        for _ in 0..((x_max - x_min) / march.solver.grid.dx) as usize {
            let report = march.attempt(&conditions, 1.0, Guess::Extrapolated);
            if report.verdict != Verdict::Converged {
                return Err(format!("{nodes}², tolerance {tolerance}: {report:?}"));
            }
            newton += u64::from(report.iterations);
            march.commit(1.0);
        }
        if march.solver.grid.nx >= nodes {
            break;
        }
        let finer = grid(refined_nodes(march.solver.grid.nx));
        march = March::refined(&march, finer, &Shape::CIRCLE, 1.0, Flow::Film);
    }
    let unit = (6.0 * PI / lambda).sqrt();
    let (grid, film) = (&march.solver.grid, &march.state.film);
    let centre = grid.axis_row() * grid.nx + (-grid.x_min / grid.dx).round() as usize;
    let inside = (0..grid.len()).filter(|n| {
        let (x, y) = (grid.x(n % grid.nx), grid.y(n / grid.nx));
        x * x + y * y < 1.1
    });
    let least = inside.map(|n| film[n]).fold(f64::INFINITY, f64::min);
    Ok(SmoothFilm {
        central: unit * film[centre],
        least: unit * least,
        newton,
    })
}
