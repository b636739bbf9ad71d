//! Weights `w_b` of a filter's images, `out += sum_b w_b . F^-1[ S_b F[in] ]`, with a note of which rows have any.

use rayon::prelude::*;
use rustfft::FftNum;

use crate::math::grid::Grid;

/// Weights of the images of a filter, `[row][symbol][i]`, and which rows have any.
pub struct Weights<T> {
    nx: usize,
    values: Vec<T>,
    /// `[row][symbol]`
    used: Vec<bool>,
    /// Of each symbol, whether any row is used.
    pub(super) any: Vec<bool>,
}

impl<T: FftNum> Weights<T> {
    /// Weights of zero for `n_symbols` symbols.
    pub fn new(grid: &Grid, n_symbols: usize) -> Self {
        Self {
            nx: grid.nx,
            values: vec![T::zero(); n_symbols * grid.len()],
            used: vec![false; n_symbols * grid.ny],
            any: vec![false; n_symbols],
        }
    }

    /// Sets row after row: `set` fills a row's weights, one symbol after the other.
    pub fn set_rows(&mut self, set: impl Fn(usize, &mut [T]) + Sync) {
        let (nx, n_symbols) = (self.nx, self.any.len());
        self.values
            .par_chunks_mut(n_symbols * nx)
            .zip(self.used.par_chunks_mut(n_symbols))
            .enumerate()
            .with_min_len(8)
            .for_each(|(j, (values, used))| {
                set(j, values);
                for (used, values) in used.iter_mut().zip(values.chunks_exact(nx)) {
                    // Part by part, for the vector units: most rows of most symbols have none.
                    let mut parts = values.chunks(32);
                    *used = parts.any(|part| part.iter().fold(false, |any, v| any | !v.is_zero()));
                }
            });
        for (b, any) in self.any.iter_mut().enumerate() {
            *any = self
                .used
                .iter()
                .skip(b)
                .step_by(n_symbols)
                .any(|&used| used);
        }
    }

    /// Weights of row `j` for symbol `b`; `None`: it has none.
    pub(super) fn row(&self, j: usize, b: usize) -> Option<&[T]> {
        let at = j * self.any.len() + b;
        self.used[at].then(|| &self.values[at * self.nx..(at + 1) * self.nx])
    }
}
