//! Depths as the rows of a picture.
//!
//! The solver's own crowd below the surface, where crests press and pits start, and stand ever further apart below. A
//! picture of [`Depths`] has one row for each, all equally high: nothing is interpolated away, and its depth axis is
//! stretched as they are. One of [`LogDepths`] has rows evenly over the logarithm of the depth, interpolated between
//! those, for a line contact, whose stress is looked at from the crests' micrometre to the half-width's millimetre.

use std::sync::Arc;

use super::plot::AxisTick;
use asperity_engine::math::number::{UM, plain};
use asperity_engine::sim::StressSlice;

/// Ticks are at least so far apart, as a share of the picture's height: a label takes 17 points of 150.
const APART: f64 = 0.115;

/// The depths of a picture.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct Depths {
    all: Arc<[f64]>,
    shown: usize,
}

impl Depths {
    /// Those down to `to_m`; `None` for fewer than two, or depths that do not increase.
    pub(crate) fn down_to(all: &Arc<[f64]>, to_m: f64) -> Option<Self> {
        let increasing = all.windows(2).all(|pair| pair[0] < pair[1]);
        let shown = all.partition_point(|&depth| depth <= to_m);
        (increasing && shown >= 2).then(|| Self {
            all: Arc::clone(all),
            shown,
        })
    }

    /// How many are shown.
    pub(crate) fn len(&self) -> usize {
        self.shown
    }

    /// Those that are shown, m.
    pub(crate) fn shown_m(&self) -> &[f64] {
        &self.all[..self.shown]
    }

    /// Whether they are taken from these.
    pub(crate) fn are_of(&self, all: &Arc<[f64]>) -> bool {
        self.all == *all
    }

    /// Whether a frame's slice has the depths that were set up.
    pub(crate) fn hold(&self, slice: &StressSlice, nx: usize) -> bool {
        let n = nx * self.all.len();
        self.are_of(&slice.depths_m) && slice.effective_pa.len() == n && slice.tau_xz_pa.len() == n
    }

    /// Where a depth lies in a picture, as a share of its height: the middle of its row, between two in proportion,
    /// as the viewer interpolates; `None` outside.
    pub(crate) fn share(&self, depth_m: f64) -> Option<f64> {
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

    /// Ticks in a picture of that height, the surface at its top.
    pub(crate) fn ticks(&self, height: f64) -> Vec<AxisTick> {
        let mut ticks = vec![(0.0, "0".to_owned())];
        ticks.extend(ticks_over(height, 0.0, |depth_m| self.share(depth_m)));
        ticks
    }
}

/// Ticks at 1, 2 and 5 times powers of ten, µm, in a picture of that height, below a share of it.
fn ticks_over(height: f64, from: f64, share: impl Fn(f64) -> Option<f64>) -> Vec<AxisTick> {
    let decades = (-2..6).flat_map(|k| [1.0, 2.0, 5.0].map(|step| step * 10_f64.powi(k)));
    let (mut ticks, mut last) = (Vec::new(), from);
    for depth_um in decades {
        let Some(share) = share(depth_um / UM.per_si) else {
            continue;
        };
        if share >= last + APART {
            last = share;
            ticks.push((height * share, plain(depth_um)));
        }
    }
    ticks
}

/// Rows evenly over the logarithm of the depth, to the last depth from a thousandth of it, or from the first that was
/// computed where that is deeper: what is nearer to the surface is like the surface.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct LogDepths {
    all: Arc<[f64]>,
    ends_m: [f64; 2],
    /// Of each row: the depth above it, and its part of the way to the next, in the logarithm.
    rows: Vec<(usize, f32)>,
}

impl LogDepths {
    /// So many rows; `None` for fewer than two depths below the surface, or depths that do not increase.
    pub(crate) fn over(all: &Arc<[f64]>, rows: usize) -> Option<Self> {
        let increasing = all.windows(2).all(|pair| pair[0] < pair[1]);
        let first = all.partition_point(|&depth| depth <= 0.0);
        let below = all
            .get(first..)
            .filter(|below| increasing && below.len() >= 2)?;
        let last_m = below[below.len() - 1];
        let ends_m = [below[0].max(1e-3 * last_m), last_m];
        let span = (ends_m[1] / ends_m[0]).ln();
        let row = |row: usize| {
            let depth_m = ends_m[0] * (span * (row as f64 + 0.5) / rows as f64).exp();
            let next = below
                .partition_point(|&z| z <= depth_m)
                .clamp(1, below.len() - 1);
            let (z0, z1) = (below[next - 1], below[next]);
            let part = (depth_m / z0).ln() / (z1 / z0).ln();
            (first + next - 1, part as f32)
        };
        Some(Self {
            all: Arc::clone(all),
            ends_m,
            rows: (0..rows).map(row).collect(),
        })
    }

    /// Whether a frame's slice has the depths that were set up.
    pub(crate) fn hold(&self, slice: &StressSlice, nx: usize) -> bool {
        slice.depths_m == self.all && slice.effective_pa.len() == nx * self.all.len()
    }

    /// Where a depth lies in a picture, as a share of its height; `None` outside.
    pub(crate) fn share(&self, depth_m: f64) -> Option<f64> {
        let [first, last] = self.ends_m;
        let inside = (first..=last).contains(&depth_m);
        inside.then(|| (depth_m / first).ln() / (last / first).ln())
    }

    /// Ticks in a picture of that height. At its top there is the first depth and no surface: it is infinitely far up.
    pub(crate) fn ticks(&self, height: f64) -> Vec<AxisTick> {
        ticks_over(height, -APART, |depth_m| self.share(depth_m))
    }

    /// Values of every row, of every so-many-th column, from those of all depths.
    pub(crate) fn resample(&self, field: &[f32], nx: usize, every: usize) -> Vec<f32> {
        let mut rows = Vec::new();
        for &(above, part) in &self.rows {
            let (upper, lower) = field[above * nx..(above + 2) * nx].split_at(nx);
            let between = upper.iter().zip(lower).step_by(every);
            rows.extend(between.map(|(upper, lower)| upper + (lower - upper) * part));
        }
        rows
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
    fn rows_lie_evenly_over_the_logarithm() {
        // From 1 to 16 µm: with four rows each spans a factor of two, and its middle is √2 above its upper edge.
        let all: Arc<[f64]> = [0.0, 1e-6, 2e-6, 4e-6, 8e-6, 16e-6].into();
        let depths = LogDepths::over(&all, 4).expect("depths");
        let share = |depth_m| depths.share(depth_m);
        assert_eq!(
            (share(0.0), share(0.9e-6), share(17e-6)),
            (None, None, None)
        );
        for (depth_m, expected) in [(1e-6, 0.0), (2e-6, 0.25), (4e-6, 0.5), (16e-6, 1.0)] {
            assert!((share(depth_m).expect("inside") - expected).abs() < 1e-12);
        }
        // A field that is the depth's logarithm comes out as the middles of the rows, whatever the column.
        let field: Vec<f32> = (0..6)
            .flat_map(|row| [row as f32 - 1.0, 10.0, row as f32 - 1.0])
            .collect();
        let rows = depths.resample(&field, 3, 2);
        let expected = [0.5, 0.5, 1.5, 1.5, 2.5, 2.5, 3.5, 3.5];
        assert!(
            rows.iter()
                .zip(expected)
                .all(|(got, want)| (got - want).abs() < 1e-5),
            "{rows:?}"
        );
        assert_eq!(rows.len(), 8);
        let ticks: Vec<String> = depths
            .ticks(1.0)
            .into_iter()
            .map(|(_, text)| text)
            .collect();
        assert_eq!(ticks, ["1", "2", "5", "10"]);
        assert_eq!(LogDepths::over(&[0.0, 1e-6].into(), 4), None);
        assert_eq!(LogDepths::over(&[1e-6, 1e-6].into(), 4), None);
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
