//! Filters of 2-D fields by planned FFTs: `out = F^-1[ S F[in] ]`, or `out += sum_b w_b . F^-1[ S_b F[in] ]`.
//!
//! One real transform along x for every stored row, one complex transform along y for every
//! wavenumber kx, the symbols `S_b` (real and even in both wavenumbers), and back. Rows of zeros
//! pad the field to the transform lengths `lx`, `ly`: with `lx = 2 (nx-1)`, `ly = 2 (ny_full-1)` and
//! a field that is zero on the boundary this is the exact free-space convolution; with
//! `lx = nx-1`, `ly = ny_full-1` it is the periodic one.
//!
//! All buffers are made in [`Filter::new`]; work is split in fixed blocks, so that the result does
//! not depend on the number of threads.

mod moves;
#[cfg(test)]
mod tests;
mod weights;

use std::sync::Arc;

use rayon::prelude::*;
use realfft::num_complex::Complex;
use realfft::{ComplexToReal, RealFftPlanner, RealToComplex};
use rustfft::{Fft, FftNum, FftPlanner};

pub use weights::Weights;

use self::moves::{accumulate, copy_row, gather, multiply, scatter};
use super::even_transform::EvenTransform;
use super::grid::{Grid, Symmetry};
use super::kernel_symbol::{AlongY, even_kernel_symbol, odd_kernel_symbol};
use super::quarter_wave::QuarterWave;

/// Rows of one task: eight single-precision complex numbers of a column fill a cache line.
const ROWS: usize = 8;
const COLUMNS: usize = 8;
/// Values between the lines of a block: lines a power of two apart would share cache sets.
const GAP: usize = 8;

/// Padding of the transforms.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Padding {
    /// Twice the domain: free space.
    Doubled,
    /// The domain itself, periodic.
    Periodic,
    /// As [`Padding::Periodic`], but a mirrored field goes on with the other sign beyond the end in y, where it is
    /// zero: as good where the transform is an approximation, and faster.
    Pinned,
}

/// Parity of the symbols in kx.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Parity {
    /// Real and even: kernels that are even in x.
    Even,
    /// i times real and odd: kernels that are odd in x. The symbol given is its imaginary part at kx ≥ 0.
    OddInX,
}

/// Buffers of one block of rows.
struct RowWork<T> {
    real: Vec<T>,
    /// Of [`ROWS`] rows.
    spectra: Vec<Complex<T>>,
    scratch: Vec<Complex<T>>,
}

/// Buffers of one block of columns.
struct ColumnWork<T> {
    line: Vec<Complex<T>>,
    image: Vec<Complex<T>>,
    work: Vec<Complex<T>>,
    scratch: Vec<Complex<T>>,
}

/// Transforms along y.
enum Columns<T: FftNum> {
    /// Of whole columns.
    Whole {
        forward: Arc<dyn Fft<T>>,
        inverse: Arc<dyn Fft<T>>,
    },
    /// Of columns that are even in y.
    Even(EvenTransform<T>),
    /// Of columns that are even in y and zero at its end, where they may go on with the other sign.
    QuarterWave(QuarterWave<T>),
}

/// A planned filter with `n_symbols` symbols.
pub struct Filter<T: FftNum> {
    nx: usize,
    ny: usize,
    lx: usize,
    ly: usize,
    parity: Parity,
    n_symbols: usize,
    n_kx: usize,
    row_forward: Arc<dyn RealToComplex<T>>,
    row_inverse: Arc<dyn ComplexToReal<T>>,
    columns: Columns<T>,
    /// Values of a column: the transform length, or half of it and one where fields are mirrored.
    column_len: usize,
    /// `[symbol][kx][column_len]`, the normalisation of the transforms included.
    symbols: Vec<T>,
    /// `[row][kx]`
    rows_spectrum: Vec<Complex<T>>,
    /// `[kx][symbol][row]`
    columns_out: Vec<Complex<T>>,
    row_work: Vec<RowWork<T>>,
    column_work: Vec<ColumnWork<T>>,
}

impl<T: FftNum> Filter<T> {
    /// Plans transforms for `grid` and makes all buffers; the symbols start at zero.
    pub fn new(grid: &Grid, padding: Padding, n_symbols: usize) -> Self {
        let factor = match padding {
            Padding::Doubled => 2,
            Padding::Periodic | Padding::Pinned => 1,
        };
        // A line has one row and its transform along y is the identity.
        let (lx, ly) = (
            factor * (grid.nx - 1),
            (factor * (grid.ny_full() - 1)).max(1),
        );
        let n_kx = lx / 2 + 1;
        let mut real_planner = RealFftPlanner::<T>::new();
        let (columns, column_len, column_scratch) = Columns::plan(grid.symmetry, padding, ly);
        let row_forward = real_planner.plan_fft_forward(lx);
        let row_inverse = real_planner.plan_fft_inverse(lx);
        let zero = Complex::new(T::zero(), T::zero());
        let row_scratch = row_forward
            .get_scratch_len()
            .max(row_inverse.get_scratch_len());
        let row_work = (0..grid.ny.div_ceil(ROWS))
            .map(|_| RowWork {
                real: vec![T::zero(); lx],
                spectra: vec![zero; ROWS * n_kx],
                scratch: vec![zero; row_scratch],
            })
            .collect();
        let column_work = (0..n_kx.div_ceil(COLUMNS))
            .map(|_| ColumnWork {
                line: vec![zero; (column_len + GAP) * COLUMNS],
                image: vec![zero; column_len],
                work: vec![zero; column_len],
                scratch: vec![zero; column_scratch],
            })
            .collect();
        Self {
            nx: grid.nx,
            ny: grid.ny,
            lx,
            ly,
            parity: Parity::Even,
            n_symbols,
            n_kx,
            row_forward,
            row_inverse,
            columns,
            column_len,
            symbols: vec![T::zero(); n_symbols * n_kx * column_len],
            rows_spectrum: vec![zero; grid.ny * n_kx],
            columns_out: vec![zero; n_kx * n_symbols * grid.ny],
            row_work,
            column_work,
        }
    }

    /// The same filter for kernels that are odd in x.
    #[must_use]
    pub fn odd_in_x(mut self) -> Self {
        self.parity = Parity::OddInX;
        self
    }

    /// Transform length along x.
    pub fn lx(&self) -> usize {
        self.lx
    }

    /// Transform length along y.
    pub fn ly(&self) -> usize {
        self.ly
    }

    /// Sets symbol `b` to the transform of a kernel sampled at node offsets (i, j) along x and y.
    pub fn set_kernel(&mut self, b: usize, kernel: impl Fn(usize, usize) -> f64) {
        let along_y = match self.columns {
            Columns::Whole { .. } | Columns::Even(_) => AlongY::Whole,
            Columns::QuarterWave(_) => AlongY::Halfway,
        };
        let symbol = match self.parity {
            Parity::Even => even_kernel_symbol(self.lx, self.ly, along_y, kernel),
            Parity::OddInX => odd_kernel_symbol(self.lx, self.ly, along_y, kernel),
        };
        let n = along_y.len(self.ly);
        self.set_symbol(b, |kx, ky| symbol[kx / 2 * n + ky / 2]);
    }

    /// Sets symbol `b` from `f(2 kx, 2 ky)`, twice the wavenumber indices, 0 <= kx <= lx/2, 0 <= ky <= ly/2.
    pub fn set_symbol(&mut self, b: usize, f: impl Fn(usize, usize) -> f64) {
        let (ly, len) = (self.ly, self.column_len);
        let is_halfway = matches!(self.columns, Columns::QuarterWave(_));
        let twice = |place: usize| {
            if is_halfway {
                QuarterWave::<T>::twice_frequency(len, place)
            } else {
                2 * place.min(ly - place)
            }
        };
        let scale = 1.0 / (self.lx * ly) as f64;
        let start = b * self.n_kx * len;
        let table = &mut self.symbols[start..start + self.n_kx * len];
        for (kx, line) in table.chunks_exact_mut(len).enumerate() {
            for (ky, s) in line.iter_mut().enumerate() {
                *s = T::from_f64(f(2 * kx, twice(ky)) * scale).unwrap_or_else(T::zero);
            }
        }
    }

    /// `out = F^-1[S_0 F[input]]`.
    pub fn apply(&mut self, input: &[T], out: &mut [T]) {
        self.forward(input);
        self.columns(None);
        self.inverse(None, out);
    }

    /// `out += sum_b weights[b] . F^-1[S_b F[input]]`. What has no weight is not transformed back.
    pub fn add_weighted(&mut self, input: &[T], weights: &Weights<T>, out: &mut [T]) {
        self.forward(input);
        self.columns(Some(weights));
        self.inverse(Some(weights), out);
    }

    fn forward(&mut self, input: &[T]) {
        let (nx, lx, n_kx) = (self.nx, self.lx, self.n_kx);
        let plan = &self.row_forward;
        self.rows_spectrum
            .par_chunks_mut(ROWS * n_kx)
            .zip(input.par_chunks(ROWS * nx))
            .zip(self.row_work.par_iter_mut())
            .for_each(|((spectra, rows), work)| {
                for (spectrum, row) in spectra.chunks_exact_mut(n_kx).zip(rows.chunks_exact(nx)) {
                    let n = nx.min(lx);
                    work.real[..n].copy_from_slice(&row[..n]);
                    work.real[n..].fill(T::zero());
                    plan.process_with_scratch(&mut work.real, spectrum, &mut work.scratch)
                        .expect("buffer lengths were made for this plan");
                }
            });
    }

    fn columns(&mut self, weights: Option<&Weights<T>>) {
        let (ny, len, n_kx, n_symbols) = (self.ny, self.column_len, self.n_kx, self.n_symbols);
        let (plan, parity) = (&self.columns, self.parity);
        let (rows, symbols) = (&self.rows_spectrum, &self.symbols);
        let is_used = |b: usize| weights.is_none_or(|w| w.any[b]);
        self.columns_out
            .par_chunks_mut(COLUMNS * n_symbols * ny)
            .zip(self.column_work.par_iter_mut())
            .enumerate()
            .for_each(|(block, (out, work))| {
                let k0 = block * COLUMNS;
                let width = COLUMNS.min(n_kx - k0);
                let stride = len + GAP;
                gather(rows, n_kx, k0, width, ny, len, &mut work.line);
                for c in 0..width {
                    let line = &mut work.line[c * stride..c * stride + len];
                    plan.forward(line, ny, &mut work.work, &mut work.scratch);
                    for b in (0..n_symbols).filter(|&b| is_used(b)) {
                        let start = (b * n_kx + k0 + c) * len;
                        multiply(line, &symbols[start..start + len], &mut work.image);
                        if parity == Parity::OddInX {
                            for v in &mut work.image {
                                *v = Complex::new(-v.im, v.re);
                            }
                        }
                        let at = (c * n_symbols + b) * ny;
                        let out = &mut out[at..at + ny];
                        plan.inverse(&mut work.image, out, &mut work.work, &mut work.scratch);
                    }
                }
            });
    }

    fn inverse(&mut self, weights: Option<&Weights<T>>, out: &mut [T]) {
        let (nx, ny, lx, n_kx, n_symbols) = (self.nx, self.ny, self.lx, self.n_kx, self.n_symbols);
        let plan = &self.row_inverse;
        let columns = &self.columns_out;
        out.par_chunks_mut(ROWS * nx)
            .zip(self.row_work.par_iter_mut())
            .enumerate()
            .for_each(|(block, (rows, work))| {
                let (j0, n_rows) = (block * ROWS, rows.len() / nx);
                for b in 0..n_symbols {
                    let weight = |r: usize| weights.map(|w| w.row(j0 + r, b));
                    if (0..n_rows).all(|r| matches!(weight(r), Some(None))) {
                        continue;
                    }
                    let first = b * ny + j0;
                    scatter(
                        columns,
                        (n_kx, n_symbols * ny),
                        first,
                        n_rows,
                        &mut work.spectra,
                    );
                    for (r, row) in rows.chunks_exact_mut(nx).enumerate() {
                        let weight = weight(r);
                        if matches!(weight, Some(None)) {
                            continue;
                        }
                        let spectrum = &mut work.spectra[r * n_kx..(r + 1) * n_kx];
                        spectrum[0].im = T::zero();
                        spectrum[n_kx - 1].im = T::zero();
                        plan.process_with_scratch(spectrum, &mut work.real, &mut work.scratch)
                            .expect("buffer lengths were made for this plan");
                        match weight.flatten() {
                            Some(weight) => accumulate(&work.real, weight, row),
                            None => copy_row(&work.real, lx, row),
                        }
                    }
                }
            });
    }
}

impl<T: FftNum> Columns<T> {
    /// The transforms for length `ly`, the values of a column, the scratch.
    fn plan(symmetry: Symmetry, padding: Padding, ly: usize) -> (Self, usize, usize) {
        match symmetry {
            Symmetry::MirrorY if padding != Padding::Periodic => {
                let quarter = QuarterWave::new(ly / 2);
                let scratch = quarter.scratch_len();
                (Self::QuarterWave(quarter), ly / 2, scratch)
            }
            Symmetry::MirrorY => {
                let even = EvenTransform::new(ly / 2);
                let scratch = even.scratch_len();
                (Self::Even(even), ly / 2 + 1, scratch)
            }
            Symmetry::General | Symmetry::Line => {
                let mut planner = FftPlanner::<T>::new();
                let forward = planner.plan_fft_forward(ly);
                let inverse = planner.plan_fft_inverse(ly);
                let scratch = forward
                    .get_inplace_scratch_len()
                    .max(inverse.get_inplace_scratch_len());
                (Self::Whole { forward, inverse }, ly, scratch)
            }
        }
    }

    /// Of a column whose first `filled` values are not zero.
    fn forward(
        &self,
        line: &mut [Complex<T>],
        filled: usize,
        work: &mut [Complex<T>],
        scratch: &mut [Complex<T>],
    ) {
        match self {
            Self::Whole { forward, .. } => forward.process_with_scratch(line, scratch),
            Self::Even(even) => even.process(line, work, scratch),
            Self::QuarterWave(quarter) => quarter.forward(line, filled, scratch),
        }
    }

    /// Back to the rows `out` of a column; `line` is overwritten.
    fn inverse(
        &self,
        line: &mut [Complex<T>],
        out: &mut [Complex<T>],
        work: &mut [Complex<T>],
        scratch: &mut [Complex<T>],
    ) {
        match self {
            Self::Whole { inverse, .. } => inverse.process_with_scratch(line, scratch),
            Self::Even(even) => even.process(line, work, scratch),
            Self::QuarterWave(quarter) => return quarter.inverse(line, out, scratch),
        }
        let n = out.len().min(line.len());
        out[..n].copy_from_slice(&line[..n]);
        // A periodic column's last row is its first.
        if let Some(last) = out.get_mut(n) {
            *last = line[0];
        }
    }
}
