//! Fields of the domain as waves of a padded one. Part of `heat.rs`.

use std::sync::Arc;

use realfft::{ComplexToReal, RealFftPlanner, RealToComplex};
use rustfft::num_complex::Complex;
use rustfft::{Fft, FftPlanner};

use crate::math::grid::{Grid, Symmetry};

/// Points of the padded domain over intervals of the domain: along x of a line, along both of a point.
const LINE: usize = 8;
const POINT: usize = 2;
/// Part of the padding along x over which a wake falls to nothing, and over which what diffuses upstream does.
const BEHIND: f64 = 0.75;
const BEFORE: f64 = 0.15;

/// Transforms between them.
pub(super) struct Plane {
    grid: Grid,
    /// Points of the padded domain.
    px: usize,
    py: usize,
    rows: Arc<dyn RealToComplex<f64>>,
    rows_back: Arc<dyn ComplexToReal<f64>>,
    columns: Arc<dyn Fft<f64>>,
    columns_back: Arc<dyn Fft<f64>>,
    row: Vec<f64>,
    column: Vec<Complex<f64>>,
    scratch: Vec<Complex<f64>>,
    values: Vec<f64>,
}

impl Plane {
    pub(super) fn new(grid: &Grid) -> Self {
        let (px, py) = match grid.symmetry {
            Symmetry::Line => (LINE * (grid.nx - 1), 1),
            Symmetry::MirrorY => (POINT * (grid.nx - 1), POINT * 2 * (grid.ny - 1)),
            Symmetry::General => (POINT * (grid.nx - 1), POINT * (grid.ny - 1)),
        };
        let (mut real, mut complex) = (RealFftPlanner::new(), FftPlanner::new());
        let (rows, rows_back) = (real.plan_fft_forward(px), real.plan_fft_inverse(px));
        let columns = complex.plan_fft_forward(py);
        let columns_back = complex.plan_fft_inverse(py);
        let lengths = [
            rows.get_scratch_len(),
            rows_back.get_scratch_len(),
            columns.get_inplace_scratch_len(),
            columns_back.get_inplace_scratch_len(),
        ];
        let longest = lengths.into_iter().max().unwrap_or(0);
        Self {
            grid: grid.clone(),
            row: vec![0.0; px],
            column: vec![Complex::default(); py],
            scratch: vec![Complex::default(); longest],
            values: vec![0.0; px * py],
            px,
            py,
            rows,
            rows_back,
            columns,
            columns_back,
        }
    }

    /// Waves along x that are kept.
    pub(super) fn waves_x(&self) -> usize {
        self.px / 2 + 1
    }

    /// How many waves there are.
    pub(super) fn len(&self) -> usize {
        self.waves_x() * self.py
    }

    /// Wavenumbers of wave `n`, in rad over the grid's unit of length.
    pub(super) fn wave(&self, n: usize) -> [f64; 2] {
        let (i, j) = (n % self.waves_x(), n / self.waves_x());
        let tau = std::f64::consts::TAU;
        let kx = tau * i as f64 / (self.px as f64 * self.grid.dx);
        if self.py == 1 {
            return [kx, 0.0];
        }
        let signed = if 2 * j > self.py {
            j as f64 - self.py as f64
        } else {
            j as f64
        };
        [kx, tau * signed / (self.py as f64 * self.grid.dy)]
    }

    fn rows_of_domain(&self) -> usize {
        match self.grid.symmetry {
            Symmetry::Line => 1,
            Symmetry::MirrorY => 2 * self.grid.ny - 1,
            Symmetry::General => self.grid.ny,
        }
    }

    /// Waves of a field of the domain, nothing beyond it.
    pub(super) fn forward(&mut self, field: &[f64], waves: &mut [Complex<f64>]) {
        let nx = self.grid.nx;
        waves.fill(Complex::default());
        for j in 0..self.rows_of_domain() {
            let stored = self.grid.stored_row(j);
            self.row.fill(0.0);
            self.row[..nx].copy_from_slice(&field[stored * nx..(stored + 1) * nx]);
            self.row_forward(j, waves);
        }
        self.along_columns(waves, true);
    }

    fn row_forward(&mut self, j: usize, waves: &mut [Complex<f64>]) {
        let n = self.waves_x();
        let to = &mut waves[j * n..(j + 1) * n];
        self.rows
            .process_with_scratch(&mut self.row, to, &mut self.scratch)
            .expect("buffers were made for this plan");
    }

    fn along_columns(&mut self, waves: &mut [Complex<f64>], forward: bool) {
        if self.py == 1 {
            return;
        }
        let n = self.waves_x();
        let plan = if forward {
            &self.columns
        } else {
            &self.columns_back
        };
        for i in 0..n {
            for (to, from) in self.column.iter_mut().zip(waves[i..].iter().step_by(n)) {
                *to = *from;
            }
            plan.process_with_scratch(&mut self.column, &mut self.scratch);
            for (from, to) in self.column.iter().zip(waves[i..].iter_mut().step_by(n)) {
                *to = *from;
            }
        }
    }

    /// Row `j` of the padded domain, after the columns have been brought back; `waves` is used up.
    fn row_back(&mut self, j: usize, waves: &mut [Complex<f64>]) {
        let n = self.waves_x();
        let from = &mut waves[j * n..(j + 1) * n];
        // Of a real field both are real.
        from[0].im = 0.0;
        from[n - 1].im = 0.0;
        self.rows_back
            .process_with_scratch(from, &mut self.row, &mut self.scratch)
            .expect("buffers were made for this plan");
        let scale = 1.0 / (self.px * self.py) as f64;
        self.row.iter_mut().for_each(|value| *value *= scale);
    }

    /// The field of the domain; `waves` is used up.
    pub(super) fn back(&mut self, waves: &mut [Complex<f64>], field: &mut [f64]) {
        let nx = self.grid.nx;
        self.along_columns(waves, false);
        for stored in 0..self.grid.ny {
            let j = match self.grid.symmetry {
                Symmetry::Line | Symmetry::General => stored,
                Symmetry::MirrorY => self.grid.ny - 1 + stored,
            };
            self.row_back(j, waves);
            field[stored * nx..(stored + 1) * nx].copy_from_slice(&self.row[..nx]);
        }
    }

    /// Takes away what lies in the padding, so that no wake comes round; `forward`: it goes along +x.
    pub(super) fn damp(&mut self, waves: &mut [Complex<f64>], forward: bool) {
        let (nx, ny) = (self.grid.nx, self.rows_of_domain());
        self.along_columns(waves, false);
        for j in 0..self.py {
            self.row_back(j, waves);
            let across = if self.py == 1 {
                1.0
            } else {
                window(j, ny, self.py, [0.5, 0.5])
            };
            let shares = if forward {
                [BEHIND, BEFORE]
            } else {
                [BEFORE, BEHIND]
            };
            let to = &mut self.values[j * self.px..(j + 1) * self.px];
            for (i, (to, from)) in to.iter_mut().zip(&self.row).enumerate() {
                *to = from * across * window(i, nx, self.px, shares);
            }
        }
        for j in 0..self.py {
            let from = &self.values[j * self.px..(j + 1) * self.px];
            self.row.copy_from_slice(from);
            self.row_forward(j, waves);
        }
        self.along_columns(waves, true);
    }
}

/// 1 on the first `inside` of `all` points of a ring, in the others cos² down to 0 over these shares of them behind and before.
fn window(i: usize, inside: usize, all: usize, shares: [f64; 2]) -> f64 {
    if i < inside {
        return 1.0;
    }
    let padding = (all - inside + 1) as f64;
    let fall = |away: f64, share: f64| {
        let part = away / (share * padding);
        if part < 1.0 {
            (std::f64::consts::FRAC_PI_2 * part).cos().powi(2)
        } else {
            0.0
        }
    };
    let (behind, before) = ((i + 1 - inside) as f64, (all - i) as f64);
    fall(behind, shares[0]).max(fall(before, shares[1]))
}
