//! The line y = 0 along rolling, and what lies below it, read between the nodes (linear).
//!
//! Ours: y = 0 is a row of nodes or half-way between two, so that linear reading is of the second order of the mesh.

/// The line y = 0 at one instant.
#[derive(Debug, Clone, Copy)]
pub struct Line<'a> {
    /// Coordinate of the first node, a.
    pub x_first: f64,
    /// Node spacing, a.
    pub dx: f64,
    /// Pressure at the nodes, p_h.
    pub pressure: &'a [f32],
    /// Signed orthogonal shear below the nodes, `[k·nx + i]`; `None`: not known.
    pub tau_xz: Option<&'a [f32]>,
    /// Effective stress, likewise.
    pub effective: Option<&'a [f32]>,
}

impl Line<'_> {
    /// Linear interpolation in one row of nodes; 0 outside.
    fn at(&self, row: &[f32], x: f64) -> f64 {
        let place = (x - self.x_first) / self.dx;
        if place < 0.0 || place > (row.len() - 1) as f64 {
            return 0.0;
        }
        let i = (place as usize).min(row.len().saturating_sub(2));
        let part = place - i as f64;
        f64::from(row[i]) * (1.0 - part) + f64::from(row[i + 1]) * part
    }

    pub(super) fn pressure_at(&self, x: f64) -> f64 {
        self.at(self.pressure, x)
    }

    pub(super) fn shear_at(&self, k: usize, x: f64) -> f64 {
        self.below(self.tau_xz, k, x)
    }

    pub(super) fn effective_at(&self, k: usize, x: f64) -> f64 {
        self.below(self.effective, k, x)
    }

    fn below(&self, field: Option<&[f32]>, k: usize, x: f64) -> f64 {
        let nx = self.pressure.len();
        field
            .and_then(|field| field.get(k * nx..(k + 1) * nx))
            .map_or(0.0, |row| self.at(row, x))
    }
}
