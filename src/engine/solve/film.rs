//! Film thickness and elastic deflection.
//!
//! ```text
//! H_ij = H0 + X²/2 + c_y Y²/2 − δ_ij(T) + Σ_kl K_(i−k)(j−l) P_kl
//! K    = κ ∬ dX'dY'/√(X'²+Y'²) over one cell,   κ = 2 p_h Rx/(π E' a)
//! line   K = −2κ ∫ ln(|X'|/ℓ) dX' over one cell
//! ```
//! | symbol | meaning | shape |
//! |---|---|---|
//! | H, P | film h Rx/a², pressure p/p_h | ny × nx |
//! | δ | height of both rough surfaces, Rx/a² | ny × nx |
//! | K | influence of a uniformly loaded cell (Love 1929, surface value) | even in both offsets |
//! | c_y | Rx/Ry; 0 for a line | scalar |
//! | ℓ | length of the domain: K > 0 everywhere; another ℓ only shifts H0 | scalar |
//!
//! Order of the spacing: 2, because a cell of uniform pressure smooths: its symbol is `K̂ (1 − |k|²d²/24)`. With
//! [`Order::High`] the kernel is that of the sharpened pressure `P − (δx² + δy²)P/24`, whose symbol lacks that factor (order
//! 3); since the sharpening is a stencil it is laid into K once and costs nothing. The transform length 2(N−1) is exact because P = 0 on the boundary.
//! A line is the limit of strips of infinite length: ∫ dY'/r = const − 2 ln|X'|, with p and κ as they are.
//! Source: Love (1929), Phil. Trans. R. Soc. A 228, 377-420, for the cell; Johnson, Contact Mechanics (1985), §2.5, for the strip.
//! Test: the dry Hertz contacts (`tests/engine/hertz_dry.rs`, `tests/engine/line.rs`).

use crate::math::filter::{Filter, Padding};
use crate::math::grid::{Grid, Symmetry};
use crate::math::kernel_symbol::{REPEATING, even_kernel_symbol};
use crate::scene::Order;

/// What lies on the outer boundary of the grid.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Edge {
    /// Free space: P = 0 on the boundary.
    Free,
    /// The last row and column are the first again.
    Periodic,
}

/// Deflection by filters in double precision (residuals) and single precision (search directions).
pub struct Elastic {
    double: Filter<f64>,
    single: Filter<f32>,
    symbol: Vec<f64>,
    edge: Edge,
    /// Deflection of a node under its own unit pressure.
    pub k00: f64,
}

/// `∬ dx dy/r` over a cell `dx` x `dy` seen from a point at distance (x, y) of its centre.
pub fn cell_potential(x: f64, y: f64, dx: f64, dy: f64) -> f64 {
    let corner = |u: f64, v: f64| {
        let term = |s: f64, t: f64| {
            if s == 0.0 {
                0.0
            } else {
                s * (t / s.abs()).asinh()
            }
        };
        term(u, v) + term(v, u)
    };
    let (xp, xm, yp, ym) = (x + dx / 2.0, x - dx / 2.0, y + dy / 2.0, y - dy / 2.0);
    corner(xp, yp) + corner(xm, ym) - corner(xp, ym) - corner(xm, yp)
}

/// `−2 ∫ ln(|x'|/length) dx'` over a strip of width `dx` seen from distance `x` of its middle.
pub fn strip_potential(x: f64, dx: f64, length: f64) -> f64 {
    let edge = |u: f64| {
        if u == 0.0 {
            0.0
        } else {
            u * ((u.abs() / length).ln() - 1.0)
        }
    };
    2.0 * (edge(x - 0.5 * dx) - edge(x + 0.5 * dx))
}

impl Elastic {
    /// Second order: see [`Elastic::of_order`].
    pub fn new(grid: &Grid, kappa: f64) -> Self {
        Self::of_order(grid, kappa, Order::Second)
    }

    /// Plans the transforms and makes the symbol for stiffness `kappa`.
    pub fn of_order(grid: &Grid, kappa: f64, order: Order) -> Self {
        let mut double = Filter::new(grid, Padding::Doubled, 1);
        let mut single = Filter::new(grid, Padding::Doubled, 1);
        let (dx, dy) = (grid.dx, grid.dy);
        let length = dx * (grid.nx - 1) as f64;
        let cell = |i: usize, j: usize| {
            let x = i as f64 * dx;
            kappa
                * match grid.symmetry {
                    Symmetry::Line => strip_potential(x, dx, length),
                    Symmetry::MirrorY | Symmetry::General => {
                        cell_potential(x, j as f64 * dy, dx, dy)
                    }
                }
        };
        let influence = |i: usize, j: usize| match order {
            Order::Second => cell(i, j),
            Order::High => sharpened(grid.symmetry, cell, i, j),
        };
        let rows = double.ly() / 2 + 1;
        let table: Vec<f64> = (0..grid.nx * rows)
            .map(|n| influence(n / rows, n % rows))
            .collect();
        let kernel = |i: usize, j: usize| table[i * rows + j];
        let transform = double.transform_kernel(kernel);
        double.set_kernel(0, &transform);
        single.set_kernel(0, &transform);
        let symbol = even_kernel_symbol((double.lx(), double.ly()), REPEATING, kernel);
        Self {
            double,
            single,
            symbol,
            edge: Edge::Free,
            k00: influence(0, 0),
        }
    }

    /// The deflection of a surface that repeats: `K̂ = 2πκ/k`, the mean left to H0 (Westergaard 1939).
    pub fn periodic(grid: &Grid, kappa: f64) -> Self {
        use std::f64::consts::TAU;
        let mut double = Filter::new(grid, Padding::Periodic, 1);
        let mut single = Filter::new(grid, Padding::Periodic, 1);
        let (lx, ly) = (double.lx(), double.ly());
        let (side_x, side_y) = (lx as f64 * grid.dx, ly as f64 * grid.dy);
        let nky = ly / 2 + 1;
        let symbol: Vec<f64> = (0..(lx / 2 + 1) * nky)
            .map(|n| {
                let k = TAU * ((n / nky) as f64 / side_x).hypot((n % nky) as f64 / side_y);
                if k > 0.0 { TAU * kappa / k } else { 0.0 }
            })
            .collect();
        double.set_symbol(0, |kx, ky| symbol[kx / 2 * nky + ky / 2]);
        single.set_symbol(0, |kx, ky| symbol[kx / 2 * nky + ky / 2]);
        Self {
            double,
            single,
            symbol,
            edge: Edge::Periodic,
            k00: kappa * cell_potential(0.0, 0.0, grid.dx, grid.dy),
        }
    }

    /// What lies on the outer boundary.
    pub fn edge(&self) -> Edge {
        self.edge
    }

    /// The symbol of K at twice the wavenumber indices of the domain without padding.
    pub fn symbol_on_domain(&self, kx: usize, ky: usize) -> f64 {
        match self.edge {
            Edge::Free => self.symbol(kx, ky),
            Edge::Periodic => self.symbol(kx / 2, ky / 2),
        }
    }

    /// The symbol of K on the padded grid at wavenumber indices (kx, ky).
    pub fn symbol(&self, kx: usize, ky: usize) -> f64 {
        self.symbol[kx * (self.double.ly() / 2 + 1) + ky]
    }

    /// Transforms made so far.
    pub fn transforms(&self) -> u64 {
        self.double.transforms() + self.single.transforms()
    }

    /// `out = K p`.
    pub fn deflect(&mut self, p: &[f64], out: &mut [f64]) {
        self.double.apply(p, out);
    }

    /// `out = K p` in single precision.
    pub fn deflect_single(&mut self, p: &[f32], out: &mut [f32]) {
        self.single.apply(p, out);
    }
}

/// The influence of `P − (δx² + δy²)P/24`, from that of a cell.
fn sharpened(symmetry: Symmetry, cell: impl Fn(usize, usize) -> f64, i: usize, j: usize) -> f64 {
    let here = cell(i, j);
    let along = cell(i + 1, j) + cell(i.abs_diff(1), j) - 2.0 * here;
    let across = match symmetry {
        Symmetry::Line => 0.0,
        Symmetry::MirrorY | Symmetry::General => {
            cell(i, j + 1) + cell(i, j.abs_diff(1)) - 2.0 * here
        }
    };
    here - (along + across) / 24.0
}

/// The macroscopic gap `X²/2 + c_y Y²/2`.
pub fn macroscopic_gap(grid: &Grid, curvature_y: f64, out: &mut [f64]) {
    for (j, row) in out.chunks_exact_mut(grid.nx).enumerate() {
        let y = grid.y(j);
        for (i, g) in row.iter_mut().enumerate() {
            let x = grid.x(i);
            *g = 0.5 * x * x + 0.5 * curvature_y * y * y;
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn cell_potential_of_a_square_seen_from_its_centre() {
        // 4 d ln(1 + √2) for a square of side d (Love 1929).
        let exact = 4.0 * (1.0 + 2.0_f64.sqrt()).ln();
        assert!((cell_potential(0.0, 0.0, 1.0, 1.0) - exact).abs() < 1e-14);
        // Far away: area over distance.
        assert!((cell_potential(30.0, 40.0, 1.0, 1.0) * 50.0 - 1.0).abs() < 1e-4);
    }

    #[test]
    fn the_sharpened_kernel_is_of_higher_order() {
        // Under exp(−r²/2w²) the middle sinks by ∬ p/r = 2π w √(π/2).
        let width = 0.3_f64;
        let exact = std::f64::consts::TAU * width * std::f64::consts::FRAC_PI_2.sqrt();
        let error = |nodes: usize, order: Order| {
            let grid = Grid::new(nodes, -2.0, 2.0, 2.0, Symmetry::General);
            let at = |n: usize| grid.x(n % nodes).powi(2) + grid.y(n / nodes).powi(2);
            let p: Vec<f64> = (0..grid.len())
                .map(|n| (-at(n) / (2.0 * width * width)).exp())
                .collect();
            let mut u = vec![0.0; grid.len()];
            Elastic::of_order(&grid, 1.0, order).deflect(&p, &mut u);
            (u[grid.len() / 2] / exact - 1.0).abs()
        };
        let of = |order| [33, 65, 129].map(|nodes| error(nodes, order));
        let (second, high) = (of(Order::Second), of(Order::High));
        println!("second {second:?}, high {high:?}");
        // At 33 nodes, five a half-width, the order is not yet the one of fine meshes.
        assert!(second[0] / second[1] > 3.0 && (3.5..4.5).contains(&(second[1] / second[2])));
        assert!(high[0] < 0.3 * second[0] && high[0] / high[1] > 7.0 && high[1] / high[2] > 7.0);
    }

    #[test]
    fn a_strip_is_a_long_cell_up_to_a_constant() {
        // A cell 2e5 long: the difference of its potential at two distances is that of a strip.
        let long = |x: f64| cell_potential(x, 0.0, 0.1, 2e5);
        let strip = |x: f64| strip_potential(x, 0.1, 7.0);
        for x in [0.1, 1.0, 6.9] {
            let (got, expected) = (strip(x) - strip(0.0), long(x) - long(0.0));
            assert!((got - expected).abs() < 1e-9, "{x}: {got} {expected}");
            assert!(strip(x) > 0.0);
        }
    }

    #[test]
    fn a_hertzian_line_presses_a_parabola_flat() {
        // p_h = E' b/(4 R): κ = 1/(2π); u + X²/2 is constant for |X| < 1.
        let grid = Grid::new(513, -2.0, 2.0, 0.0, Symmetry::Line);
        let mut elastic = Elastic::new(&grid, 1.0 / std::f64::consts::TAU);
        let mut gap = vec![0.0; grid.len()];
        macroscopic_gap(&grid, 0.0, &mut gap);
        let p: Vec<f64> = (0..513)
            .map(|i| (1.0 - grid.x(i).powi(2)).max(0.0).sqrt())
            .collect();
        let mut u = vec![0.0; grid.len()];
        elastic.deflect(&p, &mut u);
        let film = |i: usize| u[i] + gap[i];
        for i in 0..513 {
            let x = grid.x(i);
            if x.abs() < 0.9 {
                assert!((film(i) - film(256)).abs() < 2e-4, "{x}");
            }
        }
        // Outside: [|X| √(X² − 1) − ln(|X| + √(X² − 1))]/2 (Johnson 1985, §4.2).
        let outside = 0.5 * (2.0 * 3.0_f64.sqrt() - (2.0 + 3.0_f64.sqrt()).ln());
        assert!((film(512) - film(256) - outside).abs() < 1e-3 * outside);
    }
}
