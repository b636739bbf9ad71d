//! Transforms of a filter along y.

use std::sync::Arc;

use realfft::num_complex::Complex;
use rustfft::{Fft, FftNum, FftPlanner};

use super::Padding;
use crate::math::even_transform::EvenTransform;
use crate::math::grid::Symmetry;
use crate::math::quarter_wave::QuarterWave;
use crate::math::turned::Turned;

/// Transforms along y.
pub(super) enum ColumnFilter<T: FftNum> {
    /// Of whole columns.
    Whole {
        forward: Arc<dyn Fft<T>>,
        inverse: Arc<dyn Fft<T>>,
    },
    /// Of whole columns that may go on with the other sign.
    Turned(Turned<T>),
    /// Of columns that are even in y.
    Even(EvenTransform<T>),
    /// Of columns that are even in y and zero at its end, where they may go on with the other sign.
    QuarterWave(QuarterWave<T>),
}

impl<T: FftNum> ColumnFilter<T> {
    /// The transforms for length `ly`, the values of a column, the scratch.
    pub(super) fn plan(symmetry: Symmetry, padding: Padding, ly: usize) -> (Self, usize, usize) {
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
            Symmetry::General if padding == Padding::Pinned => {
                let turned = Turned::new(ly);
                let scratch = turned.scratch_len();
                (Self::Turned(turned), ly, scratch)
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

    /// Twice the frequency index of a column's value, 0 to `ly`.
    pub(super) fn twice_frequency(&self, place: usize, ly: usize) -> usize {
        match self {
            Self::Whole { .. } | Self::Even(_) => 2 * place.min(ly - place),
            Self::Turned(_) => Turned::<T>::twice_frequency(ly, place),
            Self::QuarterWave(_) => QuarterWave::<T>::twice_frequency(ly / 2, place),
        }
    }

    /// Of a column whose first `filled` values are not zero.
    pub(super) fn forward(
        &self,
        line: &mut [Complex<T>],
        filled: usize,
        work: &mut [Complex<T>],
        scratch: &mut [Complex<T>],
    ) {
        match self {
            Self::Whole { forward, .. } => forward.process_with_scratch(line, scratch),
            Self::Turned(turned) => turned.forward(line, scratch),
            Self::Even(even) => even.process(line, work, scratch),
            Self::QuarterWave(quarter) => quarter.forward(line, filled, scratch),
        }
    }

    /// Back to the rows `out` of a column; `line` is overwritten.
    pub(super) fn inverse(
        &self,
        line: &mut [Complex<T>],
        out: &mut [Complex<T>],
        work: &mut [Complex<T>],
        scratch: &mut [Complex<T>],
    ) {
        match self {
            Self::Whole { inverse, .. } => inverse.process_with_scratch(line, scratch),
            Self::Turned(turned) => turned.inverse(line, scratch),
            Self::Even(even) => even.process(line, work, scratch),
            Self::QuarterWave(quarter) => return quarter.inverse(line, out, scratch),
        }
        let n = out.len().min(line.len());
        out[..n].copy_from_slice(&line[..n]);
        // A periodic column's last row is its first. (Of a pinned one both are zero; nobody reads them.)
        if let Some(last) = out.get_mut(n) {
            *last = line[0];
        }
    }
}
