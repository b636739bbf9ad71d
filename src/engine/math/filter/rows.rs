//! Transforms of a filter along x.

use std::sync::Arc;

use realfft::num_complex::Complex;
use realfft::{ComplexToReal, RealFftPlanner, RealToComplex};
use rustfft::FftNum;

use super::Padding;
use super::moves::copy_row;
use crate::math::halfway::Halfway;

/// Transforms of real rows.
pub(super) enum RowFilter<T: FftNum> {
    /// At the usual frequencies, for rows that repeat.
    Usual {
        length: usize,
        forward: Arc<dyn RealToComplex<T>>,
        inverse: Arc<dyn ComplexToReal<T>>,
    },
    /// At the frequencies half-way, for rows that may go on with the other sign.
    Halfway { length: usize, plan: Halfway<T> },
}

impl<T: FftNum> RowFilter<T> {
    /// The transforms for length `lx`.
    pub(super) fn plan(padding: Padding, lx: usize) -> Self {
        match padding {
            Padding::Periodic => {
                let mut planner = RealFftPlanner::<T>::new();
                Self::Usual {
                    length: lx,
                    forward: planner.plan_fft_forward(lx),
                    inverse: planner.plan_fft_inverse(lx),
                }
            }
            Padding::Doubled | Padding::Pinned => Self::Halfway {
                length: lx,
                plan: Halfway::new(lx),
            },
        }
    }

    /// Values of a spectrum.
    pub(super) fn spectrum_len(&self) -> usize {
        match self {
            Self::Usual { length, .. } => length / 2 + 1,
            Self::Halfway { plan, .. } => plan.spectrum_len(),
        }
    }

    /// Length of the scratch.
    pub(super) fn scratch_len(&self) -> usize {
        match self {
            Self::Usual {
                forward, inverse, ..
            } => forward.get_scratch_len().max(inverse.get_scratch_len()),
            Self::Halfway { plan, .. } => plan.scratch_len(),
        }
    }

    /// Twice the frequency index of a spectrum's value, 0 to the length, and whether the value is that of −f.
    pub(super) fn twice_frequency(&self, place: usize) -> (usize, bool) {
        match self {
            Self::Usual { .. } => (2 * place, false),
            Self::Halfway { length, .. } => {
                let twice = Halfway::<T>::twice_frequency(place);
                if twice <= *length {
                    (twice, false)
                } else {
                    (2 * length - twice, true)
                }
            }
        }
    }

    /// What a transform forth and back multiplies with.
    pub(super) fn gain(&self) -> f64 {
        match self {
            Self::Usual { length, .. } => *length as f64,
            Self::Halfway { length, .. } => *length as f64 / 2.0,
        }
    }

    /// The spectrum of a row of the grid; `real` has the transform's length.
    pub(super) fn forward(
        &self,
        row: &[T],
        spectrum: &mut [Complex<T>],
        real: &mut [T],
        scratch: &mut [Complex<T>],
    ) {
        match self {
            Self::Usual {
                length, forward, ..
            } => {
                let n = row.len().min(*length);
                real[..n].copy_from_slice(&row[..n]);
                real[n..*length].fill(T::zero());
                forward
                    .process_with_scratch(&mut real[..*length], spectrum, scratch)
                    .expect("buffer lengths were made for this plan");
            }
            Self::Halfway { plan, .. } => plan.forward(row, spectrum, scratch),
        }
    }

    /// The row of a spectrum, which is overwritten; `real` has the transform's length.
    pub(super) fn inverse(
        &self,
        spectrum: &mut [Complex<T>],
        row: &mut [T],
        real: &mut [T],
        scratch: &mut [Complex<T>],
    ) {
        match self {
            Self::Usual {
                length, inverse, ..
            } => {
                spectrum[0].im = T::zero();
                spectrum[spectrum.len() - 1].im = T::zero();
                inverse
                    .process_with_scratch(spectrum, &mut real[..*length], scratch)
                    .expect("buffer lengths were made for this plan");
                copy_row(&real[..*length], *length, row);
            }
            Self::Halfway { plan, .. } => plan.inverse(spectrum, row, scratch),
        }
    }
}
