//! The dry limit: Hertz by the same solver without a fluid.

mod contact;

use asperity::math::grid::{Grid, Symmetry};
use asperity::physics::fluid::{Density, Viscosity};
use asperity::solve::march::{Flow, Guess, March};
use asperity::solve::newton::{Tolerance, Verdict};
use asperity::solve::reynolds::Medium;
use contact::{CIRCLE, conditions};

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
    for symmetry in [Symmetry::MirrorY, Symmetry::General] {
        let grid = Grid::new(129, -1.5, 1.5, 1.5, symmetry);
        let mut march = March::from_hertz(grid, &CIRCLE, 0.0, 1.0, Flow::Dry);
        // Not from the answer: a paraboloid that carries the wrong load.
        let grid = &march.grid;
        for (n, p) in march.state.history.pressure_1.iter_mut().enumerate() {
            let r2 = grid.x(n % grid.nx).powi(2) + grid.y(n / grid.nx).powi(2);
            *p = (0.8 - r2).max(0.0);
        }
        march.state.history.h0[0] = -0.7;
        let report = march.attempt(&conditions(&dry, tolerance), 1.0, Guess::Last);
        assert_eq!(report.verdict, Verdict::Converged, "{report:?}");
        let (p, grid) = (&march.state.pressure, &march.grid);
        let p_max = p.iter().copied().fold(0.0, f64::max);
        let moment = grid.integrate(|n| {
            let (x, y) = (grid.x(n % grid.nx), grid.y(n / grid.nx));
            p[n] * (x * x + y * y)
        });
        // Hertz: the mean of r² over the pressure is 2a²/5.
        let radius = (2.5 * moment / grid.integrate(|n| p[n])).sqrt();
        let approach = -march.state.h0;
        println!(
            "{symmetry:?}: p_max {p_max:.6}, a {radius:.6}, approach {approach:.6} (all 1 by Hertz), \
             {} Newton, {} Krylov iterations",
            report.iterations, report.linear_iterations
        );
        for value in [p_max, radius, approach] {
            assert!((value - 1.0).abs() < 1e-3, "{value}");
        }
        let deepest = march
            .state
            .film
            .iter()
            .copied()
            .fold(f64::INFINITY, f64::min);
        assert!(deepest > -1e-7, "no penetration: {deepest}");
    }
}
