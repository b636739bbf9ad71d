//! The domain: how far the inlet reaches, how fine the mesh is, and what both cost in accuracy.
//!
//! ```text
//! film       H_c = h_c Rx/a²                                            (h_c by regression)
//! mesh rule  relative error of the central film ≈ (ΔX/H_c^{2/3})²
//! inlet      relative error ≈ 0.055 [(H_c/0.497)(g(2.5)/g(X))]^{1.2}
//! Hertz gap  g(X) = [√(X² − 1) − (2 − X²) arccos(1/X)]/π                 (in a²/R, circular)
//! line       0.1 (ΔX/H_c^{2/3})²,  g(X) = [X √(X² − 1) − ln(X + √(X² − 1))]/2
//! ```
//!
//! The mesh rule and the two points of the inlet rule are measured: an inlet at X = −2.5 takes 0.8 %
//! off the film at M = 200, L = 10 (H_c 0.10) and 5.5 % at M = 20, L = 10 (H_c 0.497). The exponent joins the two;
//! the scaling with the gap is what starvation theory says (a film is starved by the ratio of itself to the
//! gap where the oil begins). Both serve to size the grid and to warn, not to correct results.

use crate::scene::{ContactKind, Grid};

/// Nodes and edges of the computed rectangle.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Domain {
    /// Nodes per side, 2^k + 1.
    pub nodes: usize,
    /// Inlet edge, in Hertz half-widths a along x.
    pub x_min_a: f64,
    /// Outlet edge, in a.
    pub x_max_a: f64,
    /// Half-width across, in Hertz half-widths b along y.
    pub y_half_b: f64,
}

/// Inlet edges to choose from, in a, with the half-width across, in b, that goes with each.
const SIZES: [(f64, f64); 5] = [
    (-2.5, 2.0),
    (-3.5, 2.5),
    (-4.5, 3.0),
    (-6.0, 4.0),
    (-8.0, 5.0),
];
/// Outlet edge, in a: the pressure spike and its constriction end before it.
const X_MAX_A: f64 = 1.5;
/// Error of the film by a short inlet that is accepted when the plan chooses.
const INLET_ERROR: f64 = 0.015;
/// A dry contact has no inlet; the margin is for pressure beyond the Hertz ellipse on rough surfaces.
const DRY_HALF: f64 = 1.5;

impl Domain {
    /// The domain that a scene's grid asks for, the edges that it leaves out chosen by the film `film`
    /// = h_c Rx/a² (`None`: dry).
    pub fn choose(kind: ContactKind, grid: &Grid, film: Option<f64>) -> Self {
        let (x_min_a, x_max_a, y_half_b) = match film {
            Some(film) => {
                let (x_min, y_half) = SIZES
                    .into_iter()
                    .find(|(x_min, _)| inlet_error(kind, film, *x_min) <= INLET_ERROR)
                    .unwrap_or(SIZES[SIZES.len() - 1]);
                (x_min, X_MAX_A, y_half)
            }
            None => (-DRY_HALF, DRY_HALF, DRY_HALF),
        };
        Self {
            nodes: grid.nodes,
            x_min_a: grid.x_min_a.unwrap_or(x_min_a),
            x_max_a: grid.x_max_a.unwrap_or(x_max_a),
            y_half_b: grid.y_half_a.unwrap_or(y_half_b),
        }
    }

    /// Node spacing along x, in a.
    pub fn dx_a(&self) -> f64 {
        (self.x_max_a - self.x_min_a) / (self.nodes - 1) as f64
    }

    /// Node spacing along y, in b.
    pub fn dy_b(&self) -> f64 {
        2.0 * self.y_half_b / (self.nodes - 1) as f64
    }
}

/// Relative error of the central film by the mesh, `film` = h_c Rx/a².
pub fn mesh_error(kind: ContactKind, film: f64, dx_a: f64) -> f64 {
    let rule = (dx_a / film.powf(2.0 / 3.0)).powi(2);
    match kind {
        ContactKind::Point => rule,
        ContactKind::Line => 0.1 * rule,
    }
}

/// Relative error of the film by an inlet that begins at `x_min_a` (below −1).
pub fn inlet_error(kind: ContactKind, film: f64, x_min_a: f64) -> f64 {
    let gap = |x: f64| match kind {
        ContactKind::Point => hertz_gap(x),
        ContactKind::Line => line_gap(x),
    };
    0.055 * (film / 0.497 * gap(2.5) / gap(-x_min_a)).powf(1.2)
}

/// Gap outside of a Hertz line contact at |X| = `x`, in b²/R (Johnson 1985, §4.2).
fn line_gap(x: f64) -> f64 {
    let root = (x * x - 1.0).max(0.0).sqrt();
    0.5 * (x * root - (x + root).ln())
}

/// Gap outside of a circular Hertz contact at |X| = `x`, in a²/R.
fn hertz_gap(x: f64) -> f64 {
    let square = x * x;
    ((square - 1.0).max(0.0).sqrt() - (2.0 - square) * (1.0 / x).min(1.0).acos())
        / std::f64::consts::PI
}

#[cfg(test)]
mod tests {
    use super::*;

    /// H_c of the tables' cases: Moes film × √(λ/6π), λ = (128π³/(3M⁴))^{1/3}.
    fn film(m: f64, moes: f64) -> f64 {
        let lambda = (128.0 * std::f64::consts::PI.powi(3) / (3.0 * m.powi(4))).cbrt();
        moes * (lambda / (6.0 * std::f64::consts::PI)).sqrt()
    }

    #[test]
    fn the_rules_reproduce_what_was_measured() {
        let (thick, thin) = (film(20.0, 4.804), film(200.0, 4.506));
        assert!((inlet_error(ContactKind::Point, thick, -2.5) / 0.055 - 1.0).abs() < 0.01);
        assert!((inlet_error(ContactKind::Point, thin, -2.5) / 0.008 - 1.0).abs() < 0.05);
        // M = 1000, L = 10 on 256² of [−4.5, 1.5]: 3.6956 against 4.087, 9.6 % low.
        let mesh = mesh_error(ContactKind::Point, film(1000.0, 4.087), 6.0 / 256.0);
        assert!((0.05..0.2).contains(&mesh), "{mesh}");
    }

    #[test]
    fn thick_films_get_a_longer_inlet() {
        let x_min = |film| Domain::choose(ContactKind::Point, &Grid::default(), film).x_min_a;
        assert_eq!(x_min(Some(film(569.0, 4.0))), -2.5);
        assert_eq!(x_min(Some(film(200.0, 4.5))), -2.5);
        assert_eq!(x_min(Some(film(50.0, 4.7))), -3.5);
        assert_eq!(x_min(Some(film(20.0, 4.8))), -4.5);
        assert_eq!(x_min(None), -DRY_HALF);
        let grid = Grid {
            x_min_a: Some(-3.0),
            ..Grid::default()
        };
        assert_eq!(
            Domain::choose(ContactKind::Point, &grid, Some(0.05)).x_min_a,
            -3.0
        );
    }

    #[test]
    fn spacing_counts_intervals() {
        let domain = Domain::choose(ContactKind::Point, &Grid::default(), Some(0.05));
        assert_eq!(domain.dx_a(), 4.0 / 128.0);
        assert_eq!(domain.dy_b(), 4.0 / 128.0);
    }

    #[test]
    fn the_gap_starts_at_the_edge_and_ends_as_a_parabola() {
        assert!(hertz_gap(1.0).abs() < 1e-12);
        let far = 1000.0;
        assert!((hertz_gap(far) / (0.5 * far * far) - 1.0).abs() < 2e-3);
    }
}
