//! Between rows and columns of a filter, and onto its output: `row ← real`, `row += weight . real`, `out = line . symbol`.

use realfft::num_complex::Complex;
use rustfft::FftNum;

use super::{GAP, ROWS};

/// The row of a real transform of length `lx`, periodic.
pub(super) fn copy_row<T: FftNum>(real: &[T], lx: usize, row: &mut [T]) {
    let n = row.len().min(lx);
    row[..n].copy_from_slice(&real[..n]);
    if row.len() > lx {
        row[lx] = real[0];
    }
}

dispatched! {
/// `row += weight . real`.
pub(super) fn accumulate<T: FftNum>(real: &[T], weight: &[T], row: &mut [T]) {
    let n = real.len().min(row.len());
    let (real, weight, row) = (&real[..n], &weight[..n], &mut row[..n]);
    for i in 0..n {
        row[i] = row[i] + real[i] * weight[i];
    }
}
}

dispatched! {
/// Rows `first..first + n_rows` of the columns, `stride` apart, as contiguous spectra: eight rows at a time,
/// because a column's values of neighbouring rows share a cache line.
pub(super) fn scatter<T: FftNum>(
    columns: &[Complex<T>],
    (n_kx, stride): (usize, usize),
    first: usize,
    n_rows: usize,
    spectra: &mut [Complex<T>],
) {
    if n_rows == ROWS {
        let apart = n_kx + GAP;
        let (spectra, _) = spectra.split_at_mut(ROWS * apart);
        for kx in 0..n_kx {
            let column: &[Complex<T>; ROWS] = columns[kx * stride + first..]
                .first_chunk()
                .expect("a column has all rows");
            for r in 0..ROWS {
                spectra[r * apart + kx] = column[r];
            }
        }
        return;
    }
    for kx in 0..n_kx {
        let column = &columns[kx * stride + first..][..n_rows];
        for (r, &v) in column.iter().enumerate() {
            spectra[r * (n_kx + GAP) + kx] = v;
        }
    }
}
}

dispatched! {
/// Columns `k0..k0+width` of the row spectra as contiguous lines of length `len`, [`GAP`] apart.
pub(super) fn gather<T: FftNum>(
    rows: &[Complex<T>],
    row_stride: usize,
    k0: usize,
    width: usize,
    ny: usize,
    len: usize,
    line: &mut [Complex<T>],
) {
    let stride = len + GAP;
    let n = ny.min(len);
    for j in 0..n {
        let row = &rows[j * row_stride + k0..][..width];
        for (c, &v) in row.iter().enumerate() {
            line[c * stride + j] = v;
        }
    }
    for c in 0..width {
        line[c * stride + n..c * stride + len].fill(Complex::new(T::zero(), T::zero()));
    }
}
}

dispatched! {
/// `out = line . symbol`.
pub(super) fn multiply<T: FftNum>(line: &[Complex<T>], symbol: &[T], out: &mut [Complex<T>]) {
    let n = out.len();
    let (line, symbol) = (&line[..n], &symbol[..n]);
    for k in 0..n {
        out[k] = Complex::new(line[k].re * symbol[k], line[k].im * symbol[k]);
    }
}
}
