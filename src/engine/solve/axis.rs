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

/// A place between the nodes.
#[derive(Clone, Copy)]
struct Place {
    /// The node before it.
    node: usize,
    /// Part of the way to the next.
    part: f64,
}

impl Place {
    fn read(self, row: &[f32]) -> f64 {
        let [before, after] = [self.node, self.node + 1].map(|node| f64::from(row[node]));
        before * (1.0 - self.part) + after * self.part
    }
}

impl Line<'_> {
    /// `None`: outside.
    fn place(&self, x: f64) -> Option<Place> {
        let nodes = self.pressure.len();
        let place = (x - self.x_first) / self.dx;
        if place < 0.0 || place > (nodes - 1) as f64 {
            return None;
        }
        let node = (place as usize).min(nodes.saturating_sub(2));
        let part = place - node as f64;
        Some(Place { node, part })
    }

    /// Outside there is none.
    pub(super) fn pressure_at(&self, x: f64) -> f64 {
        self.place(x).map_or(0.0, |place| place.read(self.pressure))
    }

    /// Shear at depth `k`; 0 outside, and where it is not known.
    pub(super) fn shear_at(&self, k: usize, x: f64) -> f64 {
        let field = self.tau_xz.unwrap_or_default();
        self.below(field, x).nth(k).unwrap_or(0.0)
    }

    /// A `field` below `x` by depth; 0 outside.
    pub(super) fn below(&self, field: &[f32], x: f64) -> impl Iterator<Item = f64> {
        let place = self.place(x);
        field
            .chunks_exact(self.pressure.len())
            .map(move |row| place.map_or(0.0, |place| place.read(row)))
    }
}
