//! Line contacts: one row, logarithmic kernel, against closed forms and computed values.

use std::f64::consts::{PI, TAU};

use asperity::math::grid::{Grid, Symmetry};
use asperity::physics::fluid::{Density, Viscosity};
use asperity::solve::march::{Conditions, Flow, Guess, March, Shape};
use asperity::solve::newton::{NewtonReport, Tolerance, Verdict};
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

/// Fluids of the reference table.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Fluid {
    BarusIncompressible,
    /// η0 = 0.04 Pa s, α = 2.2e-8 1/Pa.
    RoelandsDowsonHigginson,
}

const TOLERANCE: Tolerance = Tolerance {
    pressure: 1e-4,
    film: 1e-4,
    mass: 1e-4,
    load: 1e-6,
    max_iterations: 20,
};

/// A line contact given by Moes' groups: λ = 3π²/(8M²), α p_h = L √(M/2π).
struct Case {
    medium: Medium,
    domain: (f64, f64),
}

impl Case {
    fn moes(m: f64, l: f64, fluid: Fluid, domain: (f64, f64)) -> Self {
        let alpha = 2.2e-8;
        let p_hertz = l * (m / TAU).sqrt() / alpha;
        let (viscosity, density) = match fluid {
            Fluid::BarusIncompressible => {
                (Viscosity::barus(alpha, p_hertz), Density::Incompressible)
            }
            Fluid::RoelandsDowsonHigginson => (
                Viscosity::roelands(0.04, alpha, p_hertz),
                Density::DowsonHigginson {
                    p_hertz_gpa: p_hertz * 1e-9,
                },
            ),
        };
        Self {
            medium: Medium {
                viscosity,
                density,
                lambda: 3.0 * PI * PI / (8.0 * m * m),
                sliding: 0.0,
            },
            domain,
        }
    }

    fn grid(&self, nodes: usize) -> Grid {
        Grid::new(nodes, self.domain.0, self.domain.1, 0.0, Symmetry::Line)
    }

    /// The steady smooth contact on `nodes`, through 65, 129 ...; `each` sees every grid's.
    fn steady(&self, nodes: usize, mut each: impl FnMut(&March)) -> March {
        let guess = 0.7 * self.medium.lambda.powf(0.67);
        let mut march = March::from_hertz(self.grid(65), &LINE, guess, 1.0, Flow::Film);
        loop {
            let length = (self.domain.1 - self.domain.0) / march.grid.dx;
            for _ in 0..length as usize {
                self.step(&mut march, 1.0);
            }
            each(&march);
            if march.grid.nx >= nodes {
                return march;
            }
            let finer = self.grid(2 * (march.grid.nx - 1) + 1);
            march = March::refined(&march, finer, &LINE, 1.0, Flow::Film);
        }
    }

    /// One committed step that must converge.
    fn step(&self, march: &mut March, nodes: f64) -> NewtonReport {
        let report = march.attempt(
            &conditions(&self.medium, TOLERANCE),
            nodes,
            Guess::Extrapolated,
        );
        assert_eq!(report.verdict, Verdict::Converged, "{report:?}");
        assert!(march.state.pressure.iter().all(|&p| p >= 0.0));
        assert!(march.state.film.iter().all(|&h| h > 0.0 && h.is_finite()));
        march.commit(nodes);
        report
    }
}

/// H at the origin, which is a node of the domains used here.
fn central(march: &March) -> f64 {
    let grid = &march.grid;
    let i = (-grid.x_min / grid.dx).round() as usize;
    assert!(grid.x(i).abs() < 1e-12, "the origin is a node");
    march.state.film[i]
}

/// Least H for |X| < 1.1, by a parabola through the lowest node.
fn minimum(march: &March) -> f64 {
    let (grid, h) = (&march.grid, &march.state.film);
    let i = (1..grid.nx - 1)
        .filter(|&i| grid.x(i).abs() < 1.1)
        .min_by(|&i, &k| h[i].total_cmp(&h[k]))
        .expect("the contact has nodes");
    let curvature = h[i - 1] - 2.0 * h[i] + h[i + 1];
    h[i] - (h[i - 1] - h[i + 1]).powi(2) / (8.0 * curvature)
}

/// File, `assets/reference/line.csv`: M, L, fluid, H_central, and W/b and ratio of each wave.
const REFERENCE: [(f64, f64, Fluid, f64, &[(f64, f64)]); 3] = [
    (
        20.0,
        10.0,
        Fluid::BarusIncompressible,
        0.10264,
        &[(0.5, 0.991), (1.0, 0.700), (2.0, 0.366)],
    ),
    (
        20.0,
        10.0,
        Fluid::RoelandsDowsonHigginson,
        0.08495,
        &[(1.0, 0.615)],
    ),
    (
        100.0,
        10.0,
        Fluid::BarusIncompressible,
        0.01591,
        &[(1.0, 0.2275)],
    ),
];

/// Mean over |X| ≤ `reach` of the film's first harmonic in time, over the amplitude of the waves.
fn ripple(case: &Case, smooth: &March, w: f64, reach: f64) -> (f64, u32, usize) {
    let nodes = smooth.grid.nx;
    let mut march = March::refined(smooth, case.grid(nodes), &LINE, 1.0, Flow::Film);
    march.state = smooth.state.clone();
    let dx = march.grid.dx;
    let amplitude = 0.1 * central(&march);
    let steps = (w / dx).round() as usize;
    let start = (5.0 / dx).ceil() as usize;
    let columns: Vec<usize> = (1..nodes - 1)
        .filter(|&i| march.grid.x(i).abs() <= reach + 1e-12)
        .collect();
    let mut sums = vec![[0.0; 2]; columns.len()];
    let mut newtons = 0;
    for step in 1..=start + steps {
        let t = step as f64 * dx;
        for (n, gap) in march.gap.iter_mut().enumerate() {
            let x = march.grid.x(n);
            *gap = march.macroscopic[n] - amplitude * t.min(1.0) * (TAU * (x - t) / w).cos();
        }
        newtons += case.step(&mut march, 1.0).iterations;
        if step > start {
            let (s, c) = (TAU * t / w).sin_cos();
            for (sum, &i) in sums.iter_mut().zip(&columns) {
                let h = march.state.film[i] * 2.0 / steps as f64;
                *sum = [sum[0] + h * c, sum[1] + h * s];
            }
        }
    }
    let mean: f64 = sums.iter().map(|s| s[0].hypot(s[1])).sum::<f64>() / sums.len() as f64;
    (mean / amplitude, newtons, start + steps)
}

#[test]
fn smooth_and_wavy_against_an_independent_code() {
    for (m, l, fluid, h_central, waves) in REFERENCE {
        let case = Case::moes(m, l, fluid, (-5.5, 2.5));
        let mut films = Vec::new();
        let clock = std::time::Instant::now();
        let march = case.steady(513, |march| films.push((central(march), minimum(march))));
        println!(
            "M {m} L {l} {fluid:?}: {films:.5?} reference {h_central} in {:?}",
            clock.elapsed()
        );
        for &(w, reference) in waves {
            let clock = std::time::Instant::now();
            let (ratio, newtons, steps) = ripple(&case, &march, w, 0.25);
            println!(
                "  W {w}: {ratio:.4} reference {reference}; {newtons} Newton in {steps} steps, {:?}",
                clock.elapsed()
            );
        }
    }
}
