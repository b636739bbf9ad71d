//! Heat of a slow point contact that has left the padding round it, on a coarser and larger plane. Part of `heat.rs`.
//!
//! ```text
//! clearing     u_j ← w u_j near by,   (1 − w) u_j is added to the far modes, by the cell: none is lost
//! far modes    v_j ← e^{−(λ_j + μ)Δt} v_j,   cleared at the rim of their own plane
//! warmth       H ← Σ_j u_j + Σ_j v_j              the second smooth over several a where the contact is
//! ```
//! Ours: without it a rim 8 a away keeps 3 to 4 % of the greatest rise at a Péclet number of .1 (Carslaw and Jaeger 1959: a
//! point source at rest has 1/r); the rim here is 50 a away.

use rustfft::num_complex::Complex;

use super::plane::{Plane, Spread};
use super::symbols::{EXPONENTIALS, narrow};
use super::{Thermal, Waves};
use crate::math::grid::{Grid, Symmetry};

/// Intervals of the near plane that one here stands for.
const COARSE: usize = 8;

/// The far plane and what is computed on it.
pub(super) struct Far {
    plane: Plane,
    grid: Grid,
    near: Grid,
    /// Points of the near padded plane along x and, whole, along y.
    padded: [usize; 2],
    /// Of both bodies, one exponential after another: what is left of a mode after the step.
    decay: [Vec<Complex<f32>>; 2],
    /// Modes at the end of the step.
    pub(super) next: [Waves; 2],
    waves: Vec<Complex<f32>>,
    field: Vec<f64>,
    /// Where columns and rows of the near grid, and columns of its padded one, lie here: the point before, and the part of the
    /// way to the next one.
    columns: Vec<(usize, f64)>,
    rows: Vec<(usize, f64)>,
    padded_columns: Vec<(usize, f64)>,
    /// Warmth of both bodies on the near grid, K.
    pub(super) rise: [Vec<f64>; 2],
}

impl Far {
    /// Beyond `plane` of `near`; `None`: of a line, whose own padding is long enough.
    pub(super) fn new(near: &Grid, plane: &Plane) -> Option<Self> {
        let [px, py] = plane.padded();
        let (before, after) = ((px - near.nx).div_ceil(COARSE), px.div_ceil(COARSE));
        let half = py.div_ceil(2 * COARSE);
        let (dx, dy) = (near.dx * COARSE as f64, near.dy * COARSE as f64);
        let (ny, y_first) = match near.symmetry {
            Symmetry::Line => return None,
            Symmetry::MirrorY => (half + 1, 0.0),
            Symmetry::General => (3 * half + 1, near.y_first - half as f64 * dy),
        };
        let grid = Grid {
            nx: before + after + 1,
            ny,
            x_min: near.x_min - before as f64 * dx,
            dx,
            y_first,
            dy,
            symmetry: near.symmetry,
        };
        let plane = Plane::new(&grid, true);
        let zero = Complex::default();
        let all = plane.len() * EXPONENTIALS.len();
        Some(Self {
            decay: [vec![Complex::default(); all], vec![Complex::default(); all]],
            next: [
                Waves(vec![Complex::default(); all]),
                Waves(vec![Complex::default(); all]),
            ],
            waves: vec![zero; plane.len()],
            field: vec![0.0; grid.len()],
            columns: (0..near.nx)
                .map(|i| part_of((near.x(i) - grid.x_min) / grid.dx))
                .collect(),
            rows: (0..near.ny)
                .map(|j| part_of((near.y(j) - grid.y_first) / grid.dy))
                .collect(),
            padded_columns: vec![(0, 0.0); px],
            rise: [vec![0.0; near.len()], vec![0.0; near.len()]],
            near: near.clone(),
            padded: [px, py],
            plane,
            grid,
        })
    }

    /// No heat.
    pub(super) fn cold(&self) -> Waves {
        Waves(vec![Complex::default(); self.next[0].0.len()])
    }

    /// Tables for a step of that length.
    pub(super) fn make_tables(
        &mut self,
        spread: Spread,
        (length_m, dt_s): (f64, f64),
        (bodies, speeds_m_s): ([Thermal; 2], [f64; 2]),
        exponentials: &[[f64; 2]],
    ) {
        self.plane.clear_for(spread);
        let n = self.plane.len();
        for (decay, (body, v_m_s)) in self
            .decay
            .iter_mut()
            .zip(bodies.into_iter().zip(speeds_m_s))
        {
            for (decay, [rate, _]) in decay.chunks_exact_mut(n).zip(exponentials) {
                for (k, decay) in decay.iter_mut().enumerate() {
                    let [kx, ky] = self.plane.wave(k).map(|k| k / length_m);
                    let spreads = body.diffusivity * (kx * kx + ky * ky);
                    let mu = Complex::new(spreads + rate, kx * v_m_s) * dt_s;
                    *decay = narrow((-mu).exp());
                }
            }
        }
    }

    /// Clears the rim of a mode, and adds to it what a clearing near by has just taken away.
    pub(super) fn take(&mut self, near: &Plane, mode: usize, modes: &mut Waves, forward: bool) {
        let n = self.plane.len();
        let own = &mut modes.0[mode * n..][..n];
        self.plane.damp(own, forward);
        self.gather(near, forward);
        self.plane.forward(&self.field, &mut self.waves);
        for (own, more) in own.iter_mut().zip(&self.waves) {
            *own += more;
        }
    }

    /// What was taken away near by, by the cells of this grid.
    fn gather(&mut self, near: &Plane, forward: bool) {
        self.field.fill(0.0);
        let [px, py] = self.padded;
        let split = near.splits()[usize::from(forward)];
        for (i, column) in self.padded_columns.iter_mut().enumerate() {
            let i = if i < split {
                i as f64
            } else {
                i as f64 - px as f64
            };
            *column =
                part_of((i * self.near.dx + self.near.x_min - self.grid.x_min) / self.grid.dx);
        }
        let cell = (COARSE * COARSE) as f64;
        let is_mirrored = self.near.symmetry == Symmetry::MirrorY;
        // Row j of a field that is not mirrored goes round in the middle of its padding.
        let turn = usize::midpoint(self.near.ny, py);
        for (j, row) in near.removed().enumerate() {
            let y = match j {
                j if is_mirrored || j < turn => j as f64,
                j => j as f64 - py as f64,
            };
            let y = (y * self.near.dy + self.near.y_first - self.grid.y_first) / self.grid.dy;
            let (below, part) = part_of(y);
            let values = row.iter().zip(&self.padded_columns);
            for (&value, &(left, share)) in values.filter(|(value, _)| **value != 0.0) {
                for (row, down) in [(below, 1.0 - part), (below + 1, part)] {
                    // The mirrored half adds as much to the row on the axis.
                    let twice = if is_mirrored && row == 0 && j > 0 {
                        2.0
                    } else {
                        1.0
                    };
                    for (column, along) in [(left, 1.0 - share), (left + 1, share)] {
                        if row < self.grid.ny && column < self.grid.nx {
                            self.field[row * self.grid.nx + column] +=
                                f64::from(value) * twice * down * along / cell;
                        }
                    }
                }
            }
        }
    }

    /// Modes at the end of a step, and how warm they make the contact.
    pub(super) fn advance(&mut self, body: usize, modes: &Waves) {
        let n = self.plane.len();
        self.waves.fill(Complex::default());
        let next = self.next[body].0.chunks_exact_mut(n);
        let pairs = modes
            .0
            .chunks_exact(n)
            .zip(self.decay[body].chunks_exact(n));
        for (next, (modes, decay)) in next.zip(pairs) {
            // What fades before it could leave the near plane is not here.
            if modes.iter().all(|mode| *mode == Complex::default()) {
                next.fill(Complex::default());
            } else {
                fade(next, modes, decay, &mut self.waves);
            }
        }
        self.plane.back(&self.waves, &mut self.field);
        let (grid, near) = (&self.grid, &self.near);
        let lines = self.rise[body].chunks_exact_mut(near.nx);
        for (rises, &(below, part)) in lines.zip(&self.rows) {
            let [lower, upper] = [below, below + 1].map(|row| row.min(grid.ny - 1) * grid.nx);
            for (rise, &(left, share)) in rises.iter_mut().zip(&self.columns) {
                let right = (left + 1).min(grid.nx - 1);
                let at = |row: usize| {
                    self.field[row + left] * (1.0 - share) + self.field[row + right] * share
                };
                *rise = at(lower) * (1.0 - part) + at(upper) * part;
            }
        }
    }
}

/// The point before a place, and the part of the way to the next one.
fn part_of(place: f64) -> (usize, f64) {
    (place.floor() as usize, place - place.floor())
}

dispatched! {
/// A mode at the end of the step, added to the `sums` of all.
fn fade(
    next: &mut [Complex<f32>],
    modes: &[Complex<f32>],
    decay: &[Complex<f32>],
    sums: &mut [Complex<f32>],
) {
    let n = next.len();
    let (modes, decay, sums) = (&modes[..n], &decay[..n], &mut sums[..n]);
    for k in 0..n {
        let now = modes[k] * decay[k];
        next[k] = now;
        sums[k] += now;
    }
}
}
