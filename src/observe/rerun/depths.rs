//! The solver's own depths as the rows of a picture.
//!
//! They crowd below the surface, where crests press and pits start, and stand ever further apart below. A picture has
//! one row for each, all equally high: nothing is interpolated away, and its depth axis is stretched as they are.

use std::sync::Arc;

use super::plot::AxisTick;
use crate::math::number::{UM, plain};
use crate::sim::StressSlice;

/// Metres to micrometres.
/// Ticks are at least so far apart, as a share of the picture's height: a label takes 17 points of 150.
const APART: f64 = 0.115;

/// The depths of a picture.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Depths {
    all: Arc<[f64]>,
    shown: usize,
}

impl Depths {
    /// Those down to `to_m`; `None` for fewer than two, or depths that do not increase.
    pub(super) fn down_to(all: &Arc<[f64]>, to_m: f64) -> Option<Self> {
        let increasing = all.windows(2).all(|pair| pair[0] < pair[1]);
        let shown = all.partition_point(|&depth| depth <= to_m);
        (increasing && shown >= 2).then(|| Self {
            all: Arc::clone(all),
            shown,
        })
    }

    /// How many are shown.
    pub(super) fn len(&self) -> usize {
        self.shown
    }

    /// Those that are shown, m.
    pub(super) fn shown_m(&self) -> &[f64] {
        &self.all[..self.shown]
    }

    /// Whether they are taken from these.
    pub(super) fn are_of(&self, all: &Arc<[f64]>) -> bool {
        self.all == *all
    }

    /// Whether a frame's slice has the depths that were set up.
    pub(super) fn hold(&self, slice: &StressSlice, nx: usize) -> bool {
        let n = nx * self.all.len();
        self.are_of(&slice.depths_m) && slice.effective_pa.len() == n && slice.tau_xz_pa.len() == n
    }

    /// Where a depth lies in a picture, as a share of its height: the middle of its row, between two in proportion,
    /// as the viewer interpolates; `None` outside.
    pub(super) fn share(&self, depth_m: f64) -> Option<f64> {
        let shown = self.shown_m();
        let (first, last) = (shown.first()?, shown.last()?);
        let row = if depth_m < *first {
            // The surface itself lies above the first row's middle, as far as the rows' edge.
            0.5 * depth_m / first - 0.5
        } else {
            let below = shown
                .partition_point(|&depth| depth < depth_m)
                .clamp(1, shown.len() - 1);
            let (z0, z1) = (shown[below - 1], shown[below]);
            (below - 1) as f64 + (depth_m - z0) / (z1 - z0)
        };
        let inside = depth_m >= 0.0 && depth_m <= *last;
        inside.then(|| (row + 0.5) / shown.len() as f64)
    }

    /// Ticks at 1, 2 and 5 times powers of ten, µm, in a picture of that height.
    pub(super) fn ticks(&self, height: f64) -> Vec<AxisTick> {
        let decades = (-2..6).flat_map(|k| [1.0, 2.0, 5.0].map(|step| step * 10_f64.powi(k)));
        let mut ticks = vec![(0.0, "0".to_owned())];
        let mut last = 0.0;
        for depth_um in decades {
            let Some(share) = self.share(depth_um / UM.per_si) else {
                continue;
            };
            if share >= last + APART {
                last = share;
                ticks.push((height * share, plain(depth_um)));
            }
        }
        ticks
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_depth_lies_in_the_middle_of_its_row() {
        let all: Arc<[f64]> = [1e-6, 3e-6, 7e-6, 15e-6].into();
        let depths = Depths::down_to(&all, 10e-6).expect("depths");
        assert_eq!((depths.len(), depths.shown_m()), (3, &all[..3]));
        let share = |depth_m| depths.share(depth_m).expect("inside");
        for (row, &depth) in depths.shown_m().iter().enumerate() {
            assert!((share(depth) - (row as f64 + 0.5) / 3.0).abs() < 1e-12);
        }
        assert!((share(5e-6) - 2.0 / 3.0).abs() < 1e-12);
        assert_eq!(share(0.0), 0.0);
        assert_eq!((depths.share(8e-6), depths.share(-1e-9)), (None, None));
        let ticks = depths.ticks(3.0);
        assert!(ticks.len() >= 3 && ticks.windows(2).all(|pair| pair[0].0 < pair[1].0));
    }

    #[test]
    fn depths_that_make_no_picture_are_refused() {
        let depths = |depths: &[f64]| Depths::down_to(&depths.into(), 1.0);
        assert_eq!(depths(&[]), None);
        assert_eq!(depths(&[1e-4]), None);
        assert_eq!(depths(&[1e-4, 1e-4]), None);
        assert_eq!(depths(&[2e-4, 1e-4]), None);
    }
}
