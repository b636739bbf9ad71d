//! Scalars of a step from its fields, traction included.

use rayon::prelude::*;
use serde::{Deserialize, Serialize};

use super::Metrics;
use super::scaling::Scaling;
use crate::math::grid::Grid;
use crate::solve::traction::TractionLaw;

/// What one pass over the fields gives, dimensionless.
#[derive(Debug, Clone, Copy, Default, PartialEq, Serialize, Deserialize)]
#[serde(default)]
pub(super) struct Measured {
    /// Greatest P.
    pub(super) p_max: f64,
    /// H at the origin; 0 where the bodies touch, as of every film: what they overlap by, within the solver's tolerance or
    /// beyond it, is told as overlap.
    pub(super) h_central: f64,
    /// Least H under pressure.
    pub(super) h_min: f64,
    /// Mean H within two thirds of the ellipse.
    pub(super) h_mean: f64,
    /// Contact area over the ellipse's; of a line the length in contact over its width.
    pub(super) contact_ratio: f64,
    /// Load on contacts over the load.
    pub(super) contact_load_ratio: f64,
    /// ∬Q/∬P.
    pub(super) friction: f64,
    /// Greatest |Q|.
    pub(super) traction_max: f64,
    /// ∬XP/∬P.
    pub(super) load_centre: f64,
}

impl Measured {
    /// The same in SI.
    pub(super) fn publish(&self, scaling: &Scaling, m: &mut Metrics) {
        m.p_max_pa = scaling.pa_from_p(self.p_max);
        m.h_central_m = scaling.m_from_h(self.h_central);
        m.h_min_m = scaling.m_from_h(self.h_min);
        m.h_mean_m = scaling.m_from_h(self.h_mean);
        m.contact_ratio = self.contact_ratio;
        m.contact_load_ratio = self.contact_load_ratio;
        m.friction_coefficient = self.friction.abs();
        m.traction_max_pa = scaling.pa_from_p(self.traction_max);
        m.load_centre_x_m = scaling.place_m(self.load_centre);
    }
}

/// Fields of a step and the law of its traction.
pub(super) struct Fields<'a> {
    /// Grid.
    pub(super) grid: &'a Grid,
    /// Traction law.
    pub(super) law: &'a TractionLaw,
    /// P.
    pub(super) p: &'a [f64],
    /// H.
    pub(super) h: &'a [f64],
    /// By how much ln η̄ of warm oil is shifted; empty: it is cold.
    pub(super) shift: &'a [f64],
    /// Hertz half-widths of the present load.
    pub(super) ellipse: (f64, f64),
}

/// Sums of one row, and of all of them.
#[derive(Debug, Clone, Copy, Default)]
pub(super) struct RowSums {
    p_max: f64,
    traction_max: f64,
    h_min: f64,
    load: f64,
    moment: f64,
    drag: f64,
    touching: f64,
    /// Nodes within the ellipse, and those of them in contact.
    inside: f64,
    contact: f64,
    film: f64,
    /// Nodes within two thirds of the ellipse.
    middle: f64,
}

/// Fills the traction and measures; `rows` is scratch for one value a row.
pub(super) fn measure(fields: &Fields, traction: &mut [f64], rows: &mut [RowSums]) -> Measured {
    let grid = fields.grid;
    let ((a, b), nx) = (fields.ellipse, grid.nx);
    let tasks = traction.par_chunks_mut(nx).zip(rows.par_iter_mut());
    tasks.enumerate().with_min_len(8).for_each(|(j, (q, row))| {
        let (p, h) = (
            &fields.p[j * nx..(j + 1) * nx],
            &fields.h[j * nx..(j + 1) * nx],
        );
        let shift = fields.shift.get(j * nx..(j + 1) * nx).unwrap_or(&[]);
        fields.law.traction_row(grid.dx, p, h, shift, q);
        *row = sum_row(grid, fields.law, (a, grid.y(j) / b), p, h, q);
    });
    let mut total = RowSums {
        h_min: f64::INFINITY,
        ..RowSums::default()
    };
    for (j, row) in rows[..grid.ny].iter().enumerate() {
        total.add(row, grid.weight(j));
    }
    let load = total.load.max(f64::MIN_POSITIVE);
    Measured {
        p_max: total.p_max,
        h_central: at_origin(grid, fields.h).max(0.0),
        h_min: total.h_min.max(0.0),
        h_mean: (total.film / total.middle.max(f64::MIN_POSITIVE)).max(0.0),
        contact_ratio: total.contact / total.inside.max(f64::MIN_POSITIVE),
        contact_load_ratio: total.touching / load,
        friction: total.drag / load,
        traction_max: total.traction_max,
        load_centre: total.moment / load,
    }
}

impl RowSums {
    fn add(&mut self, row: &Self, weight: f64) {
        self.p_max = self.p_max.max(row.p_max);
        self.traction_max = self.traction_max.max(row.traction_max);
        self.h_min = self.h_min.min(row.h_min);
        self.load += weight * row.load;
        self.moment += weight * row.moment;
        self.drag += weight * row.drag;
        self.touching += weight * row.touching;
        self.inside += weight * row.inside;
        self.contact += weight * row.contact;
        self.film += weight * row.film;
        self.middle += weight * row.middle;
    }
}

fn sum_row(
    grid: &Grid,
    law: &TractionLaw,
    (a, y): (f64, f64),
    p: &[f64],
    h: &[f64],
    q: &[f64],
) -> RowSums {
    let mut sums = RowSums {
        h_min: f64::INFINITY,
        ..RowSums::default()
    };
    for i in 0..grid.nx {
        sums.load += p[i];
        sums.moment += p[i] * grid.x(i);
        sums.drag += q[i];
        sums.p_max = sums.p_max.max(p[i]);
        sums.traction_max = sums.traction_max.max(q[i].abs());
        if p[i] > 0.0 {
            sums.h_min = sums.h_min.min(h[i]);
        }
        let touches = law.is_contact(p[i], h[i]);
        if touches {
            sums.touching += p[i];
        }
        let r2 = (grid.x(i) / a).powi(2) + y * y;
        if r2 <= 1.0 {
            sums.inside += 1.0;
            sums.contact += f64::from(u8::from(touches));
            if r2 <= 4.0 / 9.0 {
                sums.film += h[i];
                sums.middle += 1.0;
            }
        }
    }
    sums
}

/// Value at x = 0, y = 0, linear between nodes.
pub(super) fn at_origin(grid: &Grid, field: &[f64]) -> f64 {
    let at = -grid.x_min / grid.dx;
    let i = (at.floor() as usize).min(grid.nx - 2);
    let t = at - i as f64;
    let row = grid.axis_row() * grid.nx;
    field[row + i] * (1.0 - t) + field[row + i + 1] * t
}
