//! Line contacts: one row, logarithmic kernel, against closed forms and computed values.

use std::f64::consts::{PI, TAU};

use asperity::math::grid::{Grid, Symmetry};
use asperity::physics::fluid::{Density, Viscosity};
use asperity::solve::march::{Conditions, Flow, Guess, March, Shape};
use asperity::solve::newton::{Tolerance, Verdict};
use asperity::solve::reynolds::Medium;

/// κ = 2 p_h R/(π E' b) with p_h = E' b/(4R).
const LINE: Shape = Shape {
    kappa: 1.0 / TAU,
    curvature_y: 0.0,
    b_over_a: 1.0,
    kappa_s: 0.0,
};

/// ∫ √(1 − X²) dX.
const LOAD: f64 = PI / 2.0;

fn conditions(medium: &Medium, tolerance: Tolerance) -> Conditions<'_> {
    Conditions {
        medium,
        law: None,
        load: LOAD,
        tolerance,
    }
}

#[test]
fn dry_hertz() {
    let dry = Medium {
        viscosity: Viscosity::barus(0.0, 1e9),
        density: Density::Incompressible,
        lambda: f64::INFINITY,
        sliding: 0.0,
    };
    let tolerance = Tolerance {
        pressure: 1e-8,
        film: f64::INFINITY,
        mass: f64::INFINITY,
        load: 1e-8,
        max_iterations: 40,
    };
    let mut errors = Vec::new();
    for nodes in [129, 257, 513] {
        let grid = Grid::new(nodes, -1.5, 1.5, 0.0, Symmetry::Line);
        let mut march = March::from_hertz(grid, &LINE, 0.0, 1.0, Flow::Dry);
        // Not from the answer: a parabola that carries the wrong load.
        let grid = &march.grid;
        for (n, p) in march.state.history.pressure_1.iter_mut().enumerate() {
            *p = (0.8 - grid.x(n).powi(2)).max(0.0);
        }
        march.state.history.h0[0] -= 0.3;
        let report = march.attempt(&conditions(&dry, tolerance), 1.0, Guess::Last);
        assert_eq!(report.verdict, Verdict::Converged, "{report:?}");
        let (p, grid) = (&march.state.pressure, &march.grid);
        let p_max = p.iter().copied().fold(0.0, f64::max);
        let moment = grid.integrate(|n| p[n] * grid.x(n).powi(2));
        // Hertz: the mean of x² over the pressure is b²/4.
        let half_width = (4.0 * moment / grid.integrate(|n| p[n])).sqrt();
        println!(
            "{nodes}: p_max {p_max:.6}, b {half_width:.6} (both 1 by Hertz), {} Newton, {} Krylov iterations",
            report.iterations, report.linear_iterations
        );
        let lowest = march
            .state
            .film
            .iter()
            .copied()
            .fold(f64::INFINITY, f64::min);
        assert!(lowest > -1e-7, "no penetration: {lowest}");
        errors.push((p_max - 1.0).abs().max((half_width - 1.0).abs()));
    }
    assert!(errors[0] < 1e-3 && errors[2] < 2e-4, "{errors:?}");
}
