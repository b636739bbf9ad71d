//! Fields of the domain as waves of a padded one. Part of `heat.rs`.
//!
//! Waves stand by columns: all of one wavenumber along x together. Of a mirrored field, which is even along y, half are kept.
//! Work is split in fixed blocks with buffers of their own, so that nothing depends on the number of threads.

use std::sync::Arc;

use rayon::prelude::*;
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
/// Rows and columns of one task.
const ROWS: usize = 8;
const COLUMNS: usize = 8;
/// Values between rows of the spectrum: rows a power of two apart would share cache sets.
const GAP: usize = 8;

/// Buffers of one block of rows.
struct RowWork {
    real: Vec<f64>,
    scratch: Vec<Complex<f64>>,
}

/// Buffers of one block of columns.
struct ColumnWork {
    line: Vec<Complex<f64>>,
    scratch: Vec<Complex<f64>>,
}

/// Transforms between them.
pub(super) struct Plane {
    grid: Grid,
    /// Points of the padded domain.
    px: usize,
    py: usize,
    /// Waves kept along x and along y.
    n_kx: usize,
    n_ky: usize,
    rows: Arc<dyn RealToComplex<f64>>,
    rows_back: Arc<dyn ComplexToReal<f64>>,
    columns: Arc<dyn Fft<f64>>,
    columns_back: Arc<dyn Fft<f64>>,
    /// Windows along x of a wake that goes along −x and along +x.
    along: [Vec<f64>; 2],
    /// Of every row of the padded domain that is kept.
    spectrum: Vec<Complex<f64>>,
    /// Columns on their way back.
    columns_out: Vec<Complex<f64>>,
    row_work: Vec<RowWork>,
    column_work: Vec<ColumnWork>,
}

impl Plane {
    pub(super) fn new(grid: &Grid) -> Self {
        let (px, py) = match grid.symmetry {
            Symmetry::Line => (LINE * (grid.nx - 1), 1),
            Symmetry::MirrorY => (POINT * (grid.nx - 1), POINT * 2 * (grid.ny - 1)),
            Symmetry::General => (POINT * (grid.nx - 1), POINT * (grid.ny - 1)),
        };
        let n_ky = match grid.symmetry {
            Symmetry::MirrorY => py / 2 + 1,
            Symmetry::Line | Symmetry::General => py,
        };
        let n_kx = px / 2 + 1;
        let (mut real, mut complex) = (RealFftPlanner::new(), FftPlanner::new());
        let (rows, rows_back) = (real.plan_fft_forward(px), real.plan_fft_inverse(px));
        let columns = complex.plan_fft_forward(py);
        let columns_back = complex.plan_fft_inverse(py);
        let zero = Complex::default();
        let along_rows = rows.get_scratch_len().max(rows_back.get_scratch_len());
        let along_columns =
            (columns.get_inplace_scratch_len()).max(columns_back.get_inplace_scratch_len());
        Self {
            grid: grid.clone(),
            along: [[BEFORE, BEHIND], [BEHIND, BEFORE]]
                .map(|shares| (0..px).map(|i| window(i, grid.nx, px, shares)).collect()),
            columns_out: vec![zero; n_kx * n_ky],
            spectrum: vec![zero; n_ky * (n_kx + GAP)],
            row_work: (0..n_ky.div_ceil(ROWS))
                .map(|_| RowWork {
                    real: vec![0.0; px],
                    scratch: vec![zero; along_rows],
                })
                .collect(),
            column_work: (0..n_kx.div_ceil(COLUMNS))
                .map(|_| ColumnWork {
                    line: vec![zero; py],
                    scratch: vec![zero; along_columns],
                })
                .collect(),
            px,
            py,
            n_kx,
            n_ky,
            rows,
            rows_back,
            columns,
            columns_back,
        }
    }

    /// How many waves there are.
    pub(super) fn len(&self) -> usize {
        self.n_kx * self.n_ky
    }

    /// Waves kept along x and along y.
    pub(super) fn shape(&self) -> [usize; 2] {
        [self.n_kx, self.n_ky]
    }

    /// Wavenumbers of wave `n`, in rad over the grid's unit of length.
    pub(super) fn wave(&self, n: usize) -> [f64; 2] {
        let (i, j) = (n / self.n_ky, n % self.n_ky);
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

    /// Waves of a field of the domain, nothing beyond it.
    pub(super) fn forward(&mut self, field: &[f64], waves: &mut [Complex<f64>]) {
        let (nx, n_kx) = (self.grid.nx, self.n_kx);
        let (rows, blocks) = (&self.rows, ROWS * (n_kx + GAP));
        (self.spectrum.par_chunks_mut(blocks))
            .zip(field.par_chunks(ROWS * nx))
            .zip(&mut self.row_work)
            .for_each(|((spectrum, field), work)| {
                let lines = spectrum.chunks_exact_mut(n_kx + GAP);
                for (line, from) in lines.zip(field.chunks_exact(nx)) {
                    work.real[..nx].copy_from_slice(from);
                    work.real[nx..].fill(0.0);
                    transform_row(rows, work, &mut line[..n_kx]);
                }
            });
        self.columns_forward(self.grid.ny, waves);
    }

    /// The waves of the spectrum's first `filled` rows, nothing beyond.
    fn columns_forward(&mut self, filled: usize, waves: &mut [Complex<f64>]) {
        let (n_kx, n_ky, py) = (self.n_kx, self.n_ky, self.py);
        let (spectrum, plan) = (&self.spectrum, &self.columns);
        let is_mirrored = self.grid.symmetry == Symmetry::MirrorY;
        (waves.par_chunks_mut(COLUMNS * n_ky))
            .zip(&mut self.column_work)
            .enumerate()
            .for_each(|(block, (waves, work))| {
                for (c, to) in waves.chunks_exact_mut(n_ky).enumerate() {
                    let i = block * COLUMNS + c;
                    if py == 1 {
                        to[0] = spectrum[i];
                        continue;
                    }
                    let line = &mut work.line;
                    line.fill(Complex::default());
                    for (j, value) in line[..filled].iter_mut().enumerate() {
                        *value = spectrum[j * (n_kx + GAP) + i];
                    }
                    if is_mirrored {
                        mirror(line);
                    }
                    plan.process_with_scratch(line, &mut work.scratch);
                    to.copy_from_slice(&line[..n_ky]);
                }
            });
    }

    /// Waves back along y, as columns of the first `wanted` rows.
    fn columns_back(&mut self, wanted: usize, waves: &[Complex<f64>]) {
        let (n_ky, py) = (self.n_ky, self.py);
        let plan = &self.columns_back;
        let is_mirrored = self.grid.symmetry == Symmetry::MirrorY;
        let scale = 1.0 / (self.px * py) as f64;
        (self.columns_out.par_chunks_mut(COLUMNS * n_ky))
            .zip(waves.par_chunks(COLUMNS * n_ky))
            .zip(&mut self.column_work)
            .for_each(|((out, waves), work)| {
                let line = &mut work.line;
                for (to, from) in out.chunks_exact_mut(n_ky).zip(waves.chunks_exact(n_ky)) {
                    line[..n_ky].copy_from_slice(from);
                    if is_mirrored {
                        mirror(line);
                    }
                    if py > 1 {
                        plan.process_with_scratch(line, &mut work.scratch);
                    }
                    for (to, from) in to[..wanted].iter_mut().zip(&*line) {
                        *to = from * scale;
                    }
                }
            });
    }

    /// The field of the domain.
    pub(super) fn back(&mut self, waves: &[Complex<f64>], field: &mut [f64]) {
        let (nx, n_kx, n_ky) = (self.grid.nx, self.n_kx, self.n_ky);
        self.columns_back(self.grid.ny, waves);
        let (columns, plan) = (&self.columns_out, &self.rows_back);
        (field.par_chunks_mut(ROWS * nx))
            .zip(self.spectrum.par_chunks_mut(ROWS * (n_kx + GAP)))
            .zip(&mut self.row_work)
            .enumerate()
            .for_each(|(block, ((field, spectrum), work))| {
                let rows = field.len() / nx;
                gather_rows(columns, n_ky, block * ROWS, rows, n_kx, spectrum);
                let lines = spectrum.chunks_exact_mut(n_kx + GAP);
                for (line, to) in lines.zip(field.chunks_exact_mut(nx)) {
                    row_back(plan, work, &mut line[..n_kx]);
                    to.copy_from_slice(&work.real[..nx]);
                }
            });
    }

    /// Takes away what lies in the padding, so that no wake comes round; `forward`: it goes along +x.
    pub(super) fn damp(&mut self, waves: &mut [Complex<f64>], forward: bool) {
        let (n_kx, n_ky) = (self.n_kx, self.n_ky);
        let (ny, py) = (self.grid.ny, self.py);
        let is_mirrored = self.grid.symmetry == Symmetry::MirrorY;
        self.columns_back(n_ky, waves);
        let columns = &self.columns_out;
        let (back, there) = (&self.rows_back, &self.rows);
        let along = &self.along[usize::from(forward)];
        (self.spectrum.par_chunks_mut(ROWS * (n_kx + GAP)))
            .zip(&mut self.row_work)
            .enumerate()
            .for_each(|(block, (spectrum, work))| {
                let rows = spectrum.len() / (n_kx + GAP);
                gather_rows(columns, n_ky, block * ROWS, rows, n_kx, spectrum);
                for (r, line) in spectrum.chunks_exact_mut(n_kx + GAP).enumerate() {
                    let j = block * ROWS + r;
                    row_back(back, work, &mut line[..n_kx]);
                    let across = match (py, is_mirrored) {
                        (1, _) => 1.0,
                        // Row j is as far from the axis as row −j.
                        (_, true) => window(j + ny - 1, 2 * ny - 1, py, [0.5, 0.5]),
                        (_, false) => window(j, ny, py, [0.5, 0.5]),
                    };
                    for (value, along) in work.real.iter_mut().zip(along) {
                        *value *= across * along;
                    }
                    transform_row(there, work, &mut line[..n_kx]);
                }
            });
        self.columns_forward(n_ky, waves);
    }
}

/// The other half of an even line, from its first.
fn mirror(line: &mut [Complex<f64>]) {
    let n = line.len();
    for j in 1..n.div_ceil(2) {
        line[n - j] = line[j];
    }
}

/// Rows `first..first + rows` of the columns, one after another.
fn gather_rows(
    columns: &[Complex<f64>],
    n_ky: usize,
    first: usize,
    rows: usize,
    n_kx: usize,
    spectrum: &mut [Complex<f64>],
) {
    for i in 0..n_kx {
        let column = &columns[i * n_ky + first..][..rows];
        for (r, value) in column.iter().enumerate() {
            spectrum[r * (n_kx + GAP) + i] = *value;
        }
    }
}

fn transform_row(plan: &Arc<dyn RealToComplex<f64>>, work: &mut RowWork, to: &mut [Complex<f64>]) {
    plan.process_with_scratch(&mut work.real, to, &mut work.scratch)
        .expect("buffers were made for this plan");
}

fn row_back(plan: &Arc<dyn ComplexToReal<f64>>, work: &mut RowWork, from: &mut [Complex<f64>]) {
    // Of a real field both are real.
    from[0].im = 0.0;
    from[from.len() - 1].im = 0.0;
    plan.process_with_scratch(from, &mut work.real, &mut work.scratch)
        .expect("buffers were made for this plan");
}

/// 1 on the first `inside` of `all` points of a ring, in the others cos² down to 0 over these shares of them behind and before.
fn window(i: usize, inside: usize, all: usize, shares: [f64; 2]) -> f64 {
    let i = i % all;
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
