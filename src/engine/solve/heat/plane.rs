//! Fields of the domain as waves of a padded one. Part of `heat.rs`.
//!
//! Waves stand by columns: all of one wavenumber along x together. Of a mirrored field, which is even along y, half are kept.
//! They are of single precision: 1e-7 of a temperature, where the sum of exponentials is good to 1e-3 of it.
//! Work is split in fixed blocks with buffers of their own, so that nothing depends on the number of threads.

use std::sync::Arc;

use rayon::prelude::*;
use realfft::{ComplexToReal, RealFftPlanner, RealToComplex};
use rustfft::num_complex::Complex;
use rustfft::{Fft, FftPlanner};

use crate::math::grid::{Grid, Symmetry};

/// Points of the padded domain over intervals of the domain, along x of a line, where heat is carried away, and where it spreads
/// as fast; along both of a point where it does, and the most where not.
const LINE: [usize; 2] = [8, 32];
const SLOW: usize = 4;
const FAST: usize = 2;
/// How many of the ways that heat spreads and is carried between two clearings it takes to be gone, the last of the latter empty,
/// and lengths κ/V upstream that are left alone.
const SPREADS: f64 = 2.0;
const CARRIED: f64 = 3.0;
const UPSTREAM: f64 = 4.0;
/// Rows and columns of one task.
const ROWS: usize = 8;
const COLUMNS: usize = 8;
/// Values between rows of the spectrum: rows a power of two apart would share cache sets.
const GAP: usize = 8;

/// Buffers of one block of rows.
struct RowWork {
    real: Vec<f32>,
    /// What the last clearing took of each row, where it is asked for.
    removed: Vec<f32>,
    scratch: Vec<Complex<f32>>,
}

/// Buffers of one block of columns.
struct ColumnWork {
    line: Vec<Complex<f32>>,
    scratch: Vec<Complex<f32>>,
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
    rows: Arc<dyn RealToComplex<f32>>,
    rows_back: Arc<dyn ComplexToReal<f32>>,
    columns: Arc<dyn Fft<f32>>,
    columns_back: Arc<dyn Fft<f32>>,
    /// Windows along x of a wake that goes along −x and along +x, and along y from the axis (mirrored) or the first row.
    along: [Vec<f32>; 2],
    across: Vec<f32>,
    splits: [usize; 2],
    /// Of every row of the padded domain that is kept.
    spectrum: Vec<Complex<f32>>,
    /// Columns on their way back.
    columns_out: Vec<Complex<f32>>,
    row_work: Vec<RowWork>,
    column_work: Vec<ColumnWork>,
}

/// How heat goes between two clearings of the padding, in the grid's unit of length.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Spread {
    /// As far as it spreads, and as far as it is carried.
    pub(super) spreads: f64,
    pub(super) carried: f64,
    /// κ/V: as far upstream as it gets.
    pub(super) upstream: f64,
}

impl Spread {
    /// Padding along x in which it falls to nothing, behind the domain and before it; no heat gets further upstream meanwhile than
    /// it spreads.
    pub(super) fn along(self) -> f64 {
        let upstream = self.upstream.min(self.spreads);
        2.0 * SPREADS * self.spreads + UPSTREAM * upstream + CARRIED * self.carried
    }
}

impl Plane {
    /// `spreads`: heat spreads as fast as it is carried away.
    pub(super) fn new(grid: &Grid, spreads: bool) -> Self {
        let point = if spreads { SLOW } else { FAST };
        let (px, py) = match grid.symmetry {
            Symmetry::Line => (LINE[usize::from(spreads)] * (grid.nx - 1), 1),
            Symmetry::MirrorY => (point * (grid.nx - 1), point * 2 * (grid.ny - 1)),
            Symmetry::General => (point * (grid.nx - 1), point * (grid.ny - 1)),
        };
        Self::of(grid, px, py)
    }

    /// Of a point contact, with no more padding than heat needs that goes so between two clearings.
    pub(super) fn cleared_of(grid: &Grid, heat: Spread) -> Self {
        let whole = Self::new(grid, false);
        if grid.symmetry == Symmetry::Line {
            return whole;
        }
        Self::reaching(&whole, heat.along(), 2.0 * SPREADS * heat.spreads)
    }

    /// With no more padding than what reaches so far along x and along y needs, in the grid's unit of length, and at most that of
    /// `whole`.
    pub(super) fn reaching(whole: &Self, along_x: f64, along_y: f64) -> Self {
        let grid = &whole.grid;
        let padded = |points: usize, reach: f64, most: usize| {
            let reached = reach.ceil().min(most as f64) as usize;
            good_length(points + reached).min(most)
        };
        let along_y = along_y / grid.dy;
        let py = match grid.symmetry {
            Symmetry::Line => 1,
            Symmetry::MirrorY => padded(2 * grid.ny - 1, along_y, whole.py),
            Symmetry::General => padded(grid.ny, along_y, whole.py),
        };
        Self::of(grid, padded(grid.nx, along_x / grid.dx, whole.px), py)
    }

    fn of(grid: &Grid, px: usize, py: usize) -> Self {
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
            along: [vec![1.0; px], vec![1.0; px]],
            across: vec![1.0; n_ky],
            splits: [px; 2],
            columns_out: vec![zero; n_kx * n_ky],
            spectrum: vec![zero; n_ky * (n_kx + GAP)],
            row_work: (0..n_ky.div_ceil(ROWS))
                .map(|_| RowWork {
                    real: vec![0.0; px],
                    removed: Vec::new(),
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

    /// Keeps what clearings take away from now on.
    pub(super) fn keep_removed(&mut self) {
        for work in &mut self.row_work {
            work.removed.resize(ROWS * self.px, 0.0);
        }
    }

    /// What the last clearing took away, row by row of the padded domain that is kept.
    pub(super) fn removed(&self) -> impl Iterator<Item = &[f32]> {
        let blocks = self.row_work.iter();
        let rows = blocks.flat_map(|work| work.removed.chunks_exact(self.px));
        rows.take(self.n_ky)
    }

    /// Points of the padded domain along x and along y.
    pub(super) fn padded(&self) -> [usize; 2] {
        [self.px, self.py]
    }

    /// Length of the padding along x.
    pub(super) fn padding(&self) -> f64 {
        (self.px - self.grid.nx) as f64 * self.grid.dx
    }

    /// The first point along x that stands before the domain, not behind it: of a wake along −x, and along +x.
    pub(super) fn splits(&self) -> [usize; 2] {
        self.splits
    }

    /// Clears the padding from now on so that nothing comes round of heat that goes so between two clearings.
    pub(super) fn clear_for(&mut self, heat: Spread) {
        let (grid, px, py) = (&self.grid, self.px, self.py);
        let (dx, dy) = (grid.dx, grid.dy);
        let padding = (px - grid.nx) as f64;
        let (spreads, carried) = (SPREADS * heat.spreads / dx, heat.carried / dx);
        let before = (spreads + UPSTREAM * heat.upstream / dx).min(0.5 * padding);
        // What little a clearing leaves next to its end is carried on until the next one: so far from the end nothing is left.
        let wake = padding - before;
        let ends = [
            [wake - carried, spreads + (CARRIED - 1.0) * carried],
            [before, spreads],
        ];
        // Behind the domain along +x there is as much room as the wake is long.
        self.splits = [before, wake].map(|end| (grid.nx + end as usize).min(px));
        self.along = [[ends[1], ends[0]], ends]
            .map(|ends| (0..px).map(|i| window(i, grid.nx, px, ends)).collect());
        if py > 1 {
            // Row j of a mirrored field is as far from the axis as row −j.
            let (first, inside) = match grid.symmetry {
                Symmetry::MirrorY => (grid.ny - 1, 2 * grid.ny - 1),
                Symmetry::Line | Symmetry::General => (0, grid.ny),
            };
            let ends = [[0.5 * (py - inside) as f64, SPREADS * heat.spreads / dy]; 2];
            let across = (0..self.n_ky).map(|j| window(j + first, inside, py, ends));
            self.across = across.collect();
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
    pub(super) fn forward(&mut self, field: &[f64], waves: &mut [Complex<f32>]) {
        let (nx, n_kx) = (self.grid.nx, self.n_kx);
        let (rows, blocks) = (&self.rows, ROWS * (n_kx + GAP));
        (self.spectrum.par_chunks_mut(blocks))
            .zip(field.par_chunks(ROWS * nx))
            .zip(&mut self.row_work)
            .for_each(|((spectrum, field), work)| {
                let lines = spectrum.chunks_exact_mut(n_kx + GAP);
                for (line, from) in lines.zip(field.chunks_exact(nx)) {
                    for (to, from) in work.real.iter_mut().zip(from) {
                        *to = *from as f32;
                    }
                    work.real[nx..].fill(0.0);
                    transform_row(rows, work, &mut line[..n_kx]);
                }
            });
        self.columns_forward(self.grid.ny, waves);
    }

    /// The waves of the spectrum's first `filled` rows, nothing beyond.
    fn columns_forward(&mut self, filled: usize, waves: &mut [Complex<f32>]) {
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
    fn columns_back(&mut self, wanted: usize, waves: &[Complex<f32>]) {
        let (n_ky, py) = (self.n_ky, self.py);
        let plan = &self.columns_back;
        let is_mirrored = self.grid.symmetry == Symmetry::MirrorY;
        let scale = 1.0 / (self.px * py) as f32;
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
    pub(super) fn back(&mut self, waves: &[Complex<f32>], field: &mut [f64]) {
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
                    for (to, from) in to.iter_mut().zip(&work.real) {
                        *to = f64::from(*from);
                    }
                }
            });
    }

    /// Takes away what lies in the padding, so that no wake comes round; `forward`: it goes along +x.
    pub(super) fn damp(&mut self, waves: &mut [Complex<f32>], forward: bool) {
        let (n_kx, n_ky) = (self.n_kx, self.n_ky);
        self.columns_back(n_ky, waves);
        let (columns, across) = (&self.columns_out, &self.across);
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
                    let across = across[j];
                    if let Some(removed) = work.removed.chunks_exact_mut(work.real.len()).nth(r) {
                        let values = work.real.iter().zip(along);
                        for (removed, (value, along)) in removed.iter_mut().zip(values) {
                            *removed = value * (1.0 - across * along);
                        }
                    }
                    for (value, along) in work.real.iter_mut().zip(along) {
                        *value *= across * along;
                    }
                    transform_row(there, work, &mut line[..n_kx]);
                }
            });
        self.columns_forward(n_ky, waves);
    }
}

/// The next even number without a factor above 3, which transforms like.
fn good_length(least: usize) -> usize {
    let is_good = |n: &usize| {
        let mut rest = n >> n.trailing_zeros();
        while rest.is_multiple_of(3) {
            rest /= 3;
        }
        n.is_multiple_of(2) && rest == 1
    };
    let least = least.max(2);
    (least..=2 * least).find(is_good).unwrap_or(least)
}

/// The other half of an even line, from its first.
fn mirror(line: &mut [Complex<f32>]) {
    let n = line.len();
    for j in 1..n.div_ceil(2) {
        line[n - j] = line[j];
    }
}

/// Rows `first..first + rows` of the columns, one after another.
fn gather_rows(
    columns: &[Complex<f32>],
    n_ky: usize,
    first: usize,
    rows: usize,
    n_kx: usize,
    spectrum: &mut [Complex<f32>],
) {
    for i in 0..n_kx {
        let column = &columns[i * n_ky + first..][..rows];
        for (r, value) in column.iter().enumerate() {
            spectrum[r * (n_kx + GAP) + i] = *value;
        }
    }
}

fn transform_row(plan: &Arc<dyn RealToComplex<f32>>, work: &mut RowWork, to: &mut [Complex<f32>]) {
    plan.process_with_scratch(&mut work.real, to, &mut work.scratch)
        .expect("buffers were made for this plan");
}

fn row_back(plan: &Arc<dyn ComplexToReal<f32>>, work: &mut RowWork, from: &mut [Complex<f32>]) {
    // Of a real field both are real.
    from[0].im = 0.0;
    from[from.len() - 1].im = 0.0;
    plan.process_with_scratch(from, &mut work.real, &mut work.scratch)
        .expect("buffers were made for this plan");
}

/// 1 on the first `inside` of `all` points of a ring and as far beyond, behind and before, as it need not fall; then cos² down to
/// 0: `ends` has of both how long they are and over how much of that it falls, in points.
fn window(i: usize, inside: usize, all: usize, ends: [[f64; 2]; 2]) -> f32 {
    let i = i % all;
    if i < inside {
        return 1.0;
    }
    let fall = |away: f64, [length, falls]: [f64; 2]| {
        let falls = falls.clamp(1.0, length.max(1.0));
        let part = ((away - length) / falls + 1.0).max(0.0);
        if part < 1.0 {
            (std::f64::consts::FRAC_PI_2 * part).cos().powi(2)
        } else {
            0.0
        }
    };
    let (behind, before) = ((i + 1 - inside) as f64, (all - i) as f64);
    fall(behind, ends[0]).max(fall(before, ends[1])) as f32
}
