//! Scalars of a step from its fields, traction included.

use serde::{Deserialize, Serialize};

use crate::math::grid::{Grid, Symmetry};
use crate::solve::traction::TractionLaw;

/// What one pass over the fields gives, dimensionless.
#[derive(Debug, Clone, Copy, Default, PartialEq, Serialize, Deserialize)]
pub(super) struct Measured {
    /// Greatest P.
    pub(super) p_max: f64,
    /// H at the origin.
    pub(super) h_central: f64,
    /// Least H inside the Hertz ellipse.
    pub(super) h_min: f64,
    /// Mean H within two thirds of the ellipse.
    pub(super) h_mean: f64,
    /// Contact area over the ellipse's; of a line the length in contact over its width.
    pub(super) contact_ratio: f64,
    /// Load on contacts over the load.
    pub(super) contact_load_ratio: f64,
    /// ∬Q/∬P.
    pub(super) friction: f64,
}

/// Fills the traction and measures. `a`, `b`: the Hertz half-widths of the present load.
pub(super) fn measure(
    grid: &Grid,
    law: &TractionLaw,
    p: &[f64],
    h: &[f64],
    (a, b): (f64, f64),
    traction: &mut [f64],
) -> Measured {
    let mut out = Measured {
        h_min: f64::INFINITY,
        ..Measured::default()
    };
    let (mut load, mut touching, mut drag, mut area, mut film, mut middle) =
        (0.0, 0.0, 0.0, 0.0, 0.0, 0.0);
    for j in 0..grid.ny {
        let (weight, y) = (grid.weight(j), grid.y(j) / b);
        for i in 0..grid.nx {
            let n = j * grid.nx + i;
            let q = law.traction(p[n], h[n]);
            traction[n] = q;
            load += p[n] * weight;
            drag += q * weight;
            out.p_max = out.p_max.max(p[n]);
            let r2 = (grid.x(i) / a).powi(2) + y * y;
            let inside = r2 <= 1.0;
            if law.is_contact(p[n], h[n]) {
                touching += p[n] * weight;
                if inside {
                    area += weight;
                }
            }
            if inside {
                out.h_min = out.h_min.min(h[n]);
            }
            if r2 <= 4.0 / 9.0 {
                film += h[n] * weight;
                middle += weight;
            }
        }
    }
    out.h_central = at_origin(grid, h);
    out.h_mean = film / middle.max(f64::MIN_POSITIVE);
    let whole = match grid.symmetry {
        Symmetry::Line => 2.0 * a,
        Symmetry::MirrorY | Symmetry::General => std::f64::consts::PI * a * b,
    };
    out.contact_ratio = area / whole;
    out.contact_load_ratio = touching / load.max(f64::MIN_POSITIVE);
    out.friction = drag / load.max(f64::MIN_POSITIVE);
    out
}

/// Value at x = 0, y = 0, linear between nodes.
pub(super) fn at_origin(grid: &Grid, field: &[f64]) -> f64 {
    let at = -grid.x_min / grid.dx;
    let i = (at.floor() as usize).min(grid.nx - 2);
    let t = at - i as f64;
    let row = grid.axis_row() * grid.nx;
    field[row + i] * (1.0 - t) + field[row + i + 1] * t
}
