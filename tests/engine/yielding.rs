//! Steel that yields: dry contact against its limits and its own conditions of optimality.
//!
//! The bisinusoidal surface of Johnson, Greenwood and Higginson (1985), in p* = 1, with pressures bounded by P_H. A
//! pressure between its bounds that leaves no gap inside, none below zero outside and an overlap only at P_H is the
//! minimum of a convex problem, and there is one: these conditions are evaluated here anew, not taken from the solver.

use std::f64::consts::{PI, SQRT_2, TAU};

use crate::common::contact::{CIRCLE, DRY, LOAD, bisinusoidal_gap, by_newton, conditions};
use asperity_engine::math::grid::{Grid, Symmetry};
use asperity_engine::solve::dry::{Dry, DryProblem};
use asperity_engine::solve::film::Elastic;
use asperity_engine::solve::march::{Flow, Guess, March};
use asperity_engine::solve::newton::{Iterate, Newton, NewtonReport, Tolerance, Verdict};
use asperity_engine::solve::yielding::Yielding;

/// A periodic surface of length 1 that is pressed and let go; pressures in p*.
struct Block {
    grid: Grid,
    elastic: Elastic,
    gap: Vec<f64>,
    p: Vec<f64>,
    h: Vec<f64>,
    h0: f64,
}

impl Block {
    fn new(nodes: usize) -> Self {
        let grid = Grid::new(nodes, 0.0, 1.0, 0.5, Symmetry::General);
        Self {
            elastic: Elastic::periodic(&grid, SQRT_2),
            gap: bisinusoidal_gap(&grid),
            p: vec![0.0; grid.len()],
            h: vec![0.0; grid.len()],
            h0: 0.0,
            grid,
        }
    }

    /// Presses it with `mean`, from what was there; asserts the conditions.
    fn press(&mut self, mean: f64, hardness: f64) -> NewtonReport {
        let mut dry = Dry::new(&self.grid, &self.elastic);
        dry.yield_at(hardness);
        let report = dry.solve(
            &mut self.elastic,
            &DryProblem {
                grid: &self.grid,
                gap: &self.gap,
                load: mean,
                tolerance: Tolerance {
                    pressure: 1e-8,
                    film: f64::INFINITY,
                    mass: f64::INFINITY,
                    least_film: 0.0,
                    load: 1e-8,
                    max_iterations: 40,
                },
            },
            &mut Iterate {
                p: &mut self.p,
                h: &mut self.h,
                h0: &mut self.h0,
            },
        );
        assert_eq!(
            report.verdict,
            Verdict::Converged,
            "{mean} {hardness} {report:?}"
        );
        self.assert_optimal(mean, hardness);
        report
    }

    fn assert_optimal(&mut self, mean: f64, hardness: f64) {
        let mut u = vec![0.0; self.p.len()];
        self.elastic.deflect(&self.p, &mut u);
        let allowed = 1e-6 * self.elastic.k00;
        for (n, &p) in self.p.iter().enumerate() {
            if !self.is_inner(n) {
                continue;
            }
            let film = self.h0 + self.gap[n] + u[n];
            assert!((0.0..=hardness).contains(&p));
            assert!(p > 0.0 || film >= -allowed, "overlap outside: {film:e}");
            assert!(
                p >= hardness || p == 0.0 || film.abs() <= allowed,
                "{film:e}"
            );
            assert!(p < hardness || film <= allowed, "gap at P_H: {film:e}");
        }
        assert!((self.mean() / mean - 1.0).abs() < 1e-8, "{}", self.mean());
    }

    /// The last row and column are the first again.
    fn is_inner(&self, n: usize) -> bool {
        n % self.grid.nx < self.grid.nx - 1 && n / self.grid.nx < self.grid.ny - 1
    }

    fn share(&self, counts: impl Fn(usize) -> bool) -> f64 {
        let cells = (self.grid.nx - 1) * (self.grid.ny - 1);
        let counted = (0..self.p.len()).filter(|&n| self.is_inner(n) && counts(n));
        counted.count() as f64 / cells as f64
    }

    fn mean(&self) -> f64 {
        let cells = (self.grid.nx - 1) * (self.grid.ny - 1);
        let inner = (0..self.p.len()).filter(|&n| self.is_inner(n));
        inner.map(|n| self.p[n]).sum::<f64>() / cells as f64
    }

    /// What overlaps flows: the surface keeps it.
    fn flow(&mut self) -> f64 {
        let depth = |h: f64| (-h).max(0.0);
        let flowed = self.share(|_| true) * self.h.iter().copied().map(depth).sum::<f64>();
        for (gap, &h) in self.gap.iter_mut().zip(&self.h) {
            // Below a millionth of the amplitude it is what the tolerance leaves.
            *gap += if h < -1e-7 { -h } else { 0.0 };
        }
        flowed / self.p.len() as f64
    }
}

#[test]
fn dry_contact_yields_between_its_limits() {
    let nodes = 257;
    // Elastic where nothing reaches P_H: the same pressure to the last bit, with the same work.
    let (mut elastic, mut hard) = (Block::new(nodes), Block::new(nodes));
    let (one, two) = (elastic.press(0.2, f64::INFINITY), hard.press(0.2, 1e9));
    assert!(
        elastic
            .p
            .iter()
            .zip(&hard.p)
            .all(|(a, b)| (a - b).abs() < 1e-7)
    );
    assert!(two.linear_iterations <= one.linear_iterations + 5);
    println!("P_H  mean  area  area P_H/mean  share at P_H  directions  searches");
    let mut last_ratio = 0.0;
    for (mean, hardness) in [
        (0.05, 0.6),
        (0.05, 0.4),
        (0.05, 0.2),
        (0.05, 0.1),
        (0.05, 0.06),
        (0.01, 0.05),
        (0.01, 0.02),
    ] {
        let mut block = Block::new(nodes);
        let report = block.press(mean, hardness);
        let area = block.share(|n| block.p[n] > 0.0);
        let at_bound = block.share(|n| block.p[n] >= hardness);
        let ratio = area * hardness / mean;
        println!(
            "{hardness}  {mean}  {area:.5}  {ratio:.4}  {:.4}  {}  {}",
            at_bound / area,
            report.linear_iterations,
            report.iterations
        );
        // Never less area than load/P_H; all at P_H when that is far below p*.
        assert!(ratio >= 1.0 - 1e-9);
        last_ratio = ratio;
    }
    assert!(last_ratio < 1.03, "{last_ratio}");
    // A light touch is elastic as Johnson's (1985) however soft: p_max = ∛(3π² p̄ p*²/...) stays below P_H.
    let mut light = Block::new(513);
    light.press(2e-3, 0.5);
    let area = light.share(|n| light.p[n] > 0.0);
    let limit = PI * (3.0 * 2e-3 / (8.0 * PI)).powf(2.0 / 3.0);
    assert!((area / limit - 1.0).abs() < 0.03, "{area} {limit}");
}

#[test]
fn area_converges_with_the_grid() {
    let areas = [65, 129, 257, 513].map(|nodes| {
        let mut block = Block::new(nodes);
        block.press(0.05, 0.3);
        let area = block.share(|n| block.p[n] > 0.0);
        let held = block.share(|n| block.p[n] >= 0.3);
        println!("{nodes}: area {area:.5}, at P_H {held:.5}");
        area
    });
    let fine = areas[3];
    // A ring of nodes about the spot is 5/nodes of its area at 4 % of the wave's.
    for (area, nodes) in areas.iter().zip([65.0, 129.0, 257.0]) {
        assert!((area / fine - 1.0).abs() < 5.0 / nodes, "{area} {fine}");
    }
}

#[test]
fn unloading_leaves_the_shape_and_reloading_is_elastic() {
    let mut block = Block::new(129);
    block.press(0.05, 0.3);
    let (pressed, first) = (block.p.clone(), block.flow());
    assert!(first > 1e-4, "{first}");
    let shape = block.gap.clone();
    for mean in [0.03, 0.01, 0.03, 0.05] {
        block.press(mean, 0.3);
        let again = block.flow();
        println!("mean {mean}: flowed {again:e} after {first:e}");
        assert!(again < 1e-5 * first, "{again}");
    }
    assert_eq!(shape, block.gap);
    let off = block.p.iter().zip(&pressed).map(|(a, b)| (a - b).abs());
    assert!(off.fold(0.0, f64::max) < 1e-4);
    // Beyond the first load it flows on.
    block.press(0.06, 0.3);
    assert!(block.flow() > 0.01 * first);
}

/// Newton without flow and conjugate gradients on a rough contact of which a part is at its hardness: the same pressure,
/// and the same depth.
#[test]
fn conjugate_gradients_and_newton_yield_alike() {
    let asked = Tolerance {
        pressure: 1e-7,
        film: f64::INFINITY,
        mass: f64::INFINITY,
        least_film: 1e-5,
        load: 1e-6,
        max_iterations: 60,
    };
    for hardness in [1.2, 1.0, 0.8] {
        let grid = Grid::new(129, -1.5, 1.5, 1.5, Symmetry::MirrorY);
        let mut march = March::from_hertz(grid, &CIRCLE, 0.0, 1.0, Flow::Dry);
        let solver = &mut march.solver;
        for (n, gap) in solver.gap.iter_mut().enumerate() {
            let (x, y) = (solver.grid.x(n % 129), solver.grid.y(n / 129));
            *gap -= 0.04 * (TAU * x / 0.4).cos() * (TAU * y / 0.3).cos();
        }
        solver.yield_at(hardness);
        let report = march.attempt(&conditions(&DRY, asked), 1.0, Guess::Last);
        assert_eq!(report.verdict, Verdict::Converged, "{report:?}");
        march.commit(1.0);
        let grid = &march.solver.grid;
        let mut newton = Newton::new(grid, CIRCLE.kappa, 2.0 / 3.0 * grid.dx);
        newton.yield_at(hardness);
        // From Hertz, whose pressure knows neither roughness nor hardness.
        let (mut p, mut h) = (vec![0.0; grid.len()], vec![0.0; grid.len()]);
        let mut h0 = march.state.h0;
        for (n, p) in p.iter_mut().enumerate() {
            let r2 = grid.x(n % 129).powi(2) + grid.y(n / 129).powi(2);
            *p = (1.0 - r2).max(0.0).sqrt();
        }
        let report = by_newton(&march, &mut newton, None, asked, (&mut p, &mut h, &mut h0));
        assert_eq!(report.verdict, Verdict::Converged, "{report:?}");
        let of_newton = newton.yielding.as_ref().map(Yielding::depth);
        let (one, two) = (march.solver.yielded(), of_newton);
        let (one, two) = (one.expect("it yields"), two.expect("it yields"));
        let moved = grid.integrate(|n| (p[n] - march.state.pressure[n]).abs()) / LOAD;
        let flowed = grid.integrate(|n| one[n]);
        let off = grid.integrate(|n| (one[n] - two[n]).abs()) / flowed;
        let at_bound = grid.integrate(|n| f64::from(u8::from(p[n] >= hardness)));
        println!(
            "P_H {hardness}: {} Newtons, area at P_H {at_bound:.3}, pressure {moved:.1e} off, depth {off:.1e}",
            report.iterations
        );
        assert!(at_bound > 0.05 && moved < 1e-5 && off < 1e-4);
    }
}
