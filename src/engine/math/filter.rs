//! Filters of 2-D fields by planned FFTs: `out = F^-1[ S F[in] ]`, or `out += sum_b w_b . F^-1[ S_b F[in] ]`.
//!
//! One real transform along x for every stored row, one complex transform along y for every
//! wavenumber kx, the symbols `S_b` (real and even in both wavenumbers), and back. With
//! `lx = 2 (nx-1)`, `ly = 2 (ny_full-1)` and a field that is zero on the boundary this is the exact
//! free-space convolution, whether the padded field repeats or goes on with the other sign: the second,
//! at frequencies half-way between the usual ones, costs less. With `lx = nx-1`, `ly = ny_full-1` it is
//! the periodic one, or that of a field pinned at its ends.
//!
//! All buffers are made in [`Filter::new`]; work is split in fixed blocks, so that the result does
//! not depend on the number of threads.

mod columns;
mod moves;
mod rows;
#[cfg(test)]
mod tests;
mod weights;

use rayon::prelude::*;
use realfft::num_complex::Complex;
use rustfft::FftNum;
use rustfft::num_traits::Zero;

pub use weights::Weights;

use self::columns::ColumnFilter;
use self::moves::{accumulate, gather, multiply, scatter};
use self::rows::RowFilter;
use super::grid::Grid;
use super::kernel_symbol::{At, even_kernel_symbol, odd_kernel_symbol};

/// Rows of one task: eight single-precision complex numbers of a column fill a cache line.
const ROWS: usize = 8;
const COLUMNS: usize = 8;
/// Values between lines: lines a power of two apart would share cache sets.
const GAP: usize = 8;

/// Padding of the transforms.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Padding {
    /// Twice the domain: free space.
    Doubled,
    /// The domain itself, periodic.
    Periodic,
    /// As [`Padding::Periodic`], but a field goes on with the other sign beyond its ends, where it is zero: better
    /// where the transform is an approximation (a preconditioner), and faster.
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

/// The transform of a kernel at a filter's frequencies.
pub struct KernelTransform {
    /// `[kx][ky]`
    values: Vec<f64>,
    n_ky: usize,
}

/// Buffers of one block of rows.
struct RowWork<T> {
    real: Vec<T>,
    row: Vec<T>,
    /// Of [`ROWS`] rows, [`GAP`] apart.
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

/// A planned filter with `n_symbols` symbols.
pub struct Filter<T: FftNum> {
    nx: usize,
    ny: usize,
    lx: usize,
    ly: usize,
    parity: Parity,
    n_symbols: usize,
    n_kx: usize,
    rows: RowFilter<T>,
    columns: ColumnFilter<T>,
    /// Values of a column's transform: its length, or half of it (and one, if they repeat) where fields are mirrored.
    column_len: usize,
    /// `[symbol][kx][column_len]`, the normalisation of the transforms included.
    symbols: Vec<T>,
    /// `[row][kx]`, the rows [`GAP`] apart.
    rows_spectrum: Vec<Complex<T>>,
    /// `[kx][symbol][row]`
    columns_out: Vec<Complex<T>>,
    row_work: Vec<RowWork<T>>,
    column_work: Vec<ColumnWork<T>>,
    transforms: u64,
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
        let rows = RowFilter::plan(padding, lx);
        let n_kx = rows.spectrum_len();
        let (columns, column_len, column_scratch) = ColumnFilter::plan(grid.symmetry, padding, ly);
        let zero = Complex::new(T::zero(), T::zero());
        let row_scratch = rows.scratch_len();
        let row_work = (0..grid.ny.div_ceil(ROWS))
            .map(|_| RowWork {
                real: vec![T::zero(); lx],
                row: vec![T::zero(); grid.nx],
                spectra: vec![zero; ROWS * (n_kx + GAP)],
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
            rows,
            columns,
            column_len,
            symbols: vec![T::zero(); n_symbols * n_kx * column_len],
            rows_spectrum: vec![zero; grid.ny * (n_kx + GAP)],
            columns_out: vec![zero; n_kx * n_symbols * grid.ny],
            row_work,
            column_work,
            transforms: 0,
        }
    }

    /// Two-dimensional transforms made so far: one for the input of a call, one for each symbol that has a weight.
    pub fn transforms(&self) -> u64 {
        self.transforms
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

    /// The transform of a kernel sampled at node offsets (i, j) along x and y, at the frequencies that this filter has.
    pub fn transform_kernel(&self, kernel: impl Fn(usize, usize) -> f64) -> KernelTransform {
        let along_x = match self.rows {
            RowFilter::Usual { .. } => At::Whole,
            RowFilter::Halfway { .. } => At::Halfway,
        };
        let along_y = match self.columns {
            ColumnFilter::Whole { .. } | ColumnFilter::Even(_) => At::Whole,
            ColumnFilter::QuarterWave(_) | ColumnFilter::Turned(_) => At::Halfway,
        };
        let (lengths, at) = ((self.lx, self.ly), (along_x, along_y));
        let values = match self.parity {
            Parity::Even => even_kernel_symbol(lengths, at, kernel),
            Parity::OddInX => odd_kernel_symbol(lengths, at, kernel),
        };
        KernelTransform {
            values,
            n_ky: along_y.len(self.ly),
        }
    }

    /// Sets symbol `b` to the transform of a kernel, made by this filter or one of the same grid, padding and parity.
    pub fn set_kernel(&mut self, b: usize, kernel: &KernelTransform) {
        self.set_symbol(b, |kx, ky| kernel.values[kx / 2 * kernel.n_ky + ky / 2]);
    }

    /// Sets symbol `b` from `f(2 kx, 2 ky)`, twice the wavenumber indices, 0 <= kx <= lx/2, 0 <= ky <= ly/2.
    pub fn set_symbol(&mut self, b: usize, f: impl Fn(usize, usize) -> f64) {
        let (ly, len) = (self.ly, self.column_len);
        let columns = &self.columns;
        let scale = 1.0 / (self.rows.gain() * ly as f64);
        let start = b * self.n_kx * len;
        let table = &mut self.symbols[start..start + self.n_kx * len];
        for (place, line) in table.chunks_exact_mut(len).enumerate() {
            let (kx, is_negative) = self.rows.twice_frequency(place);
            let scale = match self.parity {
                Parity::OddInX if is_negative => -scale,
                Parity::OddInX | Parity::Even => scale,
            };
            for (place, s) in line.iter_mut().enumerate() {
                *s = T::from_f64(f(kx, columns.twice_frequency(place, ly)) * scale)
                    .unwrap_or_else(T::zero);
            }
        }
    }

    /// `out = F^-1[S_0 F[input]]`.
    pub fn apply(&mut self, input: &[T], out: &mut [T]) {
        self.forward(input);
        self.columns(None);
        self.inverse(None, out);
        self.transforms += 2;
    }

    /// `out += sum_b weights[b] . F^-1[S_b F[input]]`. What has no weight is not transformed back.
    pub fn add_weighted(&mut self, input: &[T], weights: &Weights<T>, out: &mut [T]) {
        self.forward(input);
        self.columns(Some(weights));
        self.inverse(Some(weights), out);
        self.transforms += 1 + weights.any.iter().filter(|used| **used).count() as u64;
    }

    fn forward(&mut self, input: &[T]) {
        let (nx, n_kx, stride) = (self.nx, self.n_kx, self.n_kx + GAP);
        let plan = &self.rows;
        self.rows_spectrum
            .par_chunks_mut(ROWS * stride)
            .zip(input.par_chunks(ROWS * nx))
            .zip(self.row_work.par_iter_mut())
            .for_each(|((spectra, rows), work)| {
                for (spectrum, row) in spectra.chunks_exact_mut(stride).zip(rows.chunks_exact(nx)) {
                    let spectrum = &mut spectrum[..n_kx];
                    if row.iter().all(Zero::is_zero) {
                        spectrum.fill(Complex::new(T::zero(), T::zero()));
                        continue;
                    }
                    plan.forward(row, spectrum, &mut work.real, &mut work.scratch);
                }
            });
    }

    /// Of a line, whose transform along y is the identity.
    fn one_row(&mut self, weights: Option<&Weights<T>>) {
        let is_used = |b: usize| weights.is_none_or(|w| w.any[b]);
        let (n_kx, n_symbols) = (self.n_kx, self.n_symbols);
        for b in (0..n_symbols).filter(|&b| is_used(b)) {
            let symbol = &self.symbols[b * n_kx..][..n_kx];
            let out = self.columns_out[b..].iter_mut().step_by(n_symbols);
            for ((out, v), s) in out.zip(&self.rows_spectrum).zip(symbol) {
                let v = Complex::new(v.re * *s, v.im * *s);
                *out = match self.parity {
                    Parity::Even => v,
                    Parity::OddInX => Complex::new(-v.im, v.re),
                };
            }
        }
    }

    fn columns(&mut self, weights: Option<&Weights<T>>) {
        if self.ly == 1 {
            self.one_row(weights);
            return;
        }
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
                gather(rows, n_kx + GAP, k0, width, ny, len, &mut work.line);
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
        let (nx, ny, n_kx, n_symbols) = (self.nx, self.ny, self.n_kx, self.n_symbols);
        let plan = &self.rows;
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
                        let spectrum = &mut work.spectra[r * (n_kx + GAP)..][..n_kx];
                        let (real, scratch) = (&mut work.real, &mut work.scratch);
                        let Some(weight) = weight.flatten() else {
                            plan.inverse(spectrum, row, real, scratch);
                            continue;
                        };
                        plan.inverse(spectrum, &mut work.row, real, scratch);
                        accumulate(&work.row, weight, row);
                    }
                }
            });
    }
}
