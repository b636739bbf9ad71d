//! A rectangular grid of nodes, stored row by row (index `j * nx + i`, `i` along x).
//!
//! ```text
//! x_i = x_min + i dx          i = 0 .. nx-1
//! y_j = y_first + j dy        j = 0 .. ny-1
//! ```
//! With [`Symmetry::MirrorY`] only the half `y >= 0` is stored: row 0 lies on the axis y = 0 and the
//! row below it is the mirror image of row 1. With [`Symmetry::Line`] nothing depends on y: one row is
//! stored, which is its own neighbour above and below, and sums are per unit length along y (`dy = 1`).

/// How fields depend on y.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub enum Symmetry {
    /// Fields are even in y: half of the rows is stored.
    MirrorY,
    /// All rows are stored.
    General,
    /// Fields are the same at every y: one row is stored.
    Line,
}

/// Nodes per side of the grid with half the spacing over the same domain.
pub fn refined_nodes(nodes: usize) -> usize {
    2 * (nodes - 1) + 1
}

/// Sizes, spacing and symmetry of a grid. The outer boundary always lies on nodes.
#[derive(Debug, Clone, PartialEq)]
pub struct Grid {
    /// Nodes along x.
    pub nx: usize,
    /// Rows stored.
    pub ny: usize,
    /// First node along x.
    pub x_min: f64,
    /// Spacing along x.
    pub dx: f64,
    /// First stored row.
    pub y_first: f64,
    /// Spacing along y.
    pub dy: f64,
    /// Symmetry.
    pub symmetry: Symmetry,
}

impl Grid {
    /// A grid of `nodes` x `nodes` over `[x_min, x_max] x [-y_half, y_half]` (`nodes` odd); of a line
    /// `nodes` x 1, whatever `y_half`.
    pub fn new(nodes: usize, x_min: f64, x_max: f64, y_half: f64, symmetry: Symmetry) -> Self {
        let cells = (nodes - 1) as f64;
        let (ny, y_first) = match symmetry {
            Symmetry::MirrorY => (nodes.div_ceil(2), 0.0),
            Symmetry::General => (nodes, -y_half),
            Symmetry::Line => (1, 0.0),
        };
        let dy = match symmetry {
            Symmetry::MirrorY | Symmetry::General => 2.0 * y_half / cells,
            Symmetry::Line => 1.0,
        };
        Self {
            nx: nodes,
            ny,
            x_min,
            dx: (x_max - x_min) / cells,
            y_first,
            dy,
            symmetry,
        }
    }

    /// Nodes stored.
    pub fn len(&self) -> usize {
        self.nx * self.ny
    }

    /// Whether nothing is stored.
    pub fn is_empty(&self) -> bool {
        self.len() == 0
    }

    /// Rows of the full domain.
    pub fn ny_full(&self) -> usize {
        match self.symmetry {
            Symmetry::MirrorY => 2 * self.ny - 1,
            Symmetry::General | Symmetry::Line => self.ny,
        }
    }

    /// x of column `i`.
    pub fn x(&self, i: usize) -> f64 {
        self.x_min + i as f64 * self.dx
    }

    /// y of stored row `j`.
    pub fn y(&self, j: usize) -> f64 {
        self.y_first + j as f64 * self.dy
    }

    /// Area that a node of row `j` stands for in sums over the full domain.
    pub fn weight(&self, j: usize) -> f64 {
        let area = self.dx * self.dy;
        if self.symmetry == Symmetry::MirrorY && j > 0 {
            2.0 * area
        } else {
            area
        }
    }

    /// Rows that are unknown (the others lie on the boundary): `first..last`.
    pub fn interior_rows(&self) -> std::ops::Range<usize> {
        match self.symmetry {
            Symmetry::MirrorY => 0..self.ny - 1,
            Symmetry::General => 1..self.ny - 1,
            Symmetry::Line => 0..1,
        }
    }

    /// The row below `j` (towards -y), mirrored on the axis; of a line the row itself.
    pub fn row_below(&self, j: usize) -> usize {
        match self.symmetry {
            Symmetry::Line => j,
            Symmetry::MirrorY | Symmetry::General => {
                if j == 0 {
                    1
                } else {
                    j - 1
                }
            }
        }
    }

    /// The row above `j` (towards +y); of a line the row itself.
    pub fn row_above(&self, j: usize) -> usize {
        match self.symmetry {
            Symmetry::Line => j,
            Symmetry::MirrorY | Symmetry::General => j + 1,
        }
    }

    /// Weights 1/dx², 1/dy² of the flow to the neighbours along x and y; of a line there is none along y.
    pub fn flow_weights(&self) -> (f64, f64) {
        let along_y = match self.symmetry {
            Symmetry::Line => 0.0,
            Symmetry::MirrorY | Symmetry::General => 1.0 / (self.dy * self.dy),
        };
        (1.0 / (self.dx * self.dx), along_y)
    }

    /// The stored row on the axis y = 0.
    pub fn axis_row(&self) -> usize {
        match self.symmetry {
            Symmetry::MirrorY | Symmetry::Line => 0,
            Symmetry::General => self.ny / 2,
        }
    }

    /// The stored row that holds row `j_full` of the full domain.
    pub fn stored_row(&self, j_full: usize) -> usize {
        match self.symmetry {
            Symmetry::MirrorY => j_full.abs_diff(self.ny - 1),
            Symmetry::General | Symmetry::Line => j_full,
        }
    }

    /// Sum over the full domain of `f(index)` times the node's area: by rows, in fixed order.
    pub fn integrate(&self, f: impl Fn(usize) -> f64) -> f64 {
        let mut total = 0.0;
        for j in 0..self.ny {
            let row = (j * self.nx..(j + 1) * self.nx).map(&f).sum::<f64>();
            total += row * self.weight(j);
        }
        total
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn mirror_and_general_agree() {
        let general = Grid::new(9, -2.0, 2.0, 2.0, Symmetry::General);
        let mirror = Grid::new(9, -2.0, 2.0, 2.0, Symmetry::MirrorY);
        assert_eq!(mirror.ny, 5);
        assert_eq!(mirror.ny_full(), 9);
        let g = general.integrate(|n| {
            let (x, y) = (general.x(n % 9), general.y(n / 9));
            1.0 + x + y * y
        });
        let m = mirror.integrate(|n| {
            let (x, y) = (mirror.x(n % 9), mirror.y(n / 9));
            1.0 + x + y * y
        });
        assert!((g - m).abs() < 1e-12, "{g} {m}");
        for j in 0..9 {
            assert!((mirror.y(mirror.stored_row(j)) - general.y(j).abs()).abs() < 1e-15);
        }
    }
}
