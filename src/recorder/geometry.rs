//! Where things are, in millimetres: the unit of every picture in the recording.

use asperity_engine::math::number::MM;
use asperity_engine::scene::ContactKind;
use asperity_engine::sim::Frame;

/// Nodes and lengths of a run's frames; they do not change while it runs.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Geometry {
    pub(crate) kind: ContactKind,
    pub(crate) nx: usize,
    pub(crate) ny: usize,
    pub(crate) x_min: f64,
    pub(crate) dx: f64,
    pub(crate) y_min: f64,
    pub(crate) dy: f64,
    /// Hertz half-widths at the largest load to come: what is cut out around the contact holds it then too.
    pub(crate) a: f64,
    pub(crate) b: f64,
}

impl Geometry {
    /// Of a run with that first frame, whose half-widths grow to `size` of its own.
    pub(crate) fn of(frame: &Frame, size: f64) -> Self {
        Self {
            kind: frame.kind,
            nx: frame.nx,
            ny: frame.ny,
            x_min: frame.x_min_m * MM,
            dx: frame.dx_m * MM,
            y_min: frame.y_min_m * MM,
            dy: frame.dy_m * MM,
            a: size * frame.a_m * MM,
            b: size * frame.b_m * MM,
        }
    }

    /// Whether the fields of a frame have the sizes that were set up at the first one.
    pub(crate) fn holds(&self, frame: &Frame) -> bool {
        let nodes = self.nx * self.ny;
        let sized = |len: usize| len == nodes;
        self.nx == frame.nx
            && self.ny == frame.ny
            && nodes > 0
            && sized(frame.pressure_pa.len())
            && sized(frame.film_m.len())
            && sized(frame.roughness_1_m.len())
            && sized(frame.roughness_2_m.len())
            && sized(frame.traction_pa.len())
            && sized(frame.contact.len())
    }

    pub(crate) fn x(&self, i: usize) -> f64 {
        self.x_min + self.dx * i as f64
    }

    pub(crate) fn y(&self, j: usize) -> f64 {
        self.y_min + self.dy * j as f64
    }

    pub(crate) fn x_max(&self) -> f64 {
        self.x(self.nx.saturating_sub(1))
    }

    pub(crate) fn y_max(&self) -> f64 {
        self.y(self.ny.saturating_sub(1))
    }

    /// The row at y = 0.
    pub(crate) fn centre_row(&self) -> usize {
        self.ny / 2
    }
}
