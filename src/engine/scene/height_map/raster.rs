//! Lists of points that are no maps: x y z, and x y z with more beside it.
//!
//! The first two columns are a raster where one of them counts the same values again and again while the other one
//! stands still and moves on by a step each time.

use super::Matrix;

/// Fewest places each way that make a raster and no accident.
const PLACES: usize = 3;
/// Deviation from equal steps, over the step: places are printed with few digits.
const UNEVEN: f64 = 0.05;

/// Whether the first two columns are the places of a raster.
pub(super) fn leads(matrix: &Matrix) -> bool {
    let column = |k: usize| {
        matrix
            .values
            .iter()
            .skip(k)
            .step_by(matrix.columns)
            .copied()
    };
    if matrix.columns < 3 {
        return false;
    }
    let [one, two] = [0, 1].map(|k| column(k).collect::<Vec<f64>>());
    is_raster(&one, &two) || is_raster(&two, &one)
}

/// Whether `fast` runs through its places at each place of `slow`, forward or there and back.
fn is_raster(fast: &[f64], slow: &[f64]) -> bool {
    let Some(run) = slow.iter().position(|z| *z != slow[0]) else {
        return false;
    };
    if run < PLACES || fast.len() < PLACES * run {
        return false;
    }
    let slow_step = slow[run] - slow[0];
    let fast_step = (fast[run - 1] - fast[0]) / (run - 1) as f64;
    if fast_step == 0.0 {
        return false;
    }
    let is_near = |value: f64, place: f64, step: f64| (value - place).abs() <= UNEVEN * step.abs();
    (0..fast.len()).all(|n| {
        let (at, row) = (n % run, n / run);
        let there = fast[0] + fast_step * at as f64;
        let back = fast[0] + fast_step * (run - 1 - at) as f64;
        let is_back = row % 2 == 1 && is_near(fast[n], back, fast_step);
        is_near(slow[n], slow[0] + slow_step * row as f64, slow_step)
            && (is_near(fast[n], there, fast_step) || is_back)
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    /// `nx` by `ny` points of a list with `columns` columns, by `place` of column and row.
    fn list(nx: usize, ny: usize, place: impl Fn(usize, usize) -> [f64; 2]) -> Matrix {
        let rows = (0..nx * ny).flat_map(|n| {
            let [one, two] = place(n % nx, n / nx);
            [one, two, (n * 7 % 11) as f64, 255.0]
        });
        Matrix {
            columns: 4,
            values: rows.collect(),
        }
    }

    #[test]
    fn rasters_of_any_order_lead_a_list() {
        let step = 0.4883;
        let at = |k: usize| (step * k as f64 * 1e3).round() / 1e3;
        assert!(leads(&list(32, 32, |i, j| [at(i), at(j)])), "x fast");
        assert!(leads(&list(32, 20, |i, j| [at(j), at(i)])), "y fast");
        assert!(leads(&list(5, 9, |i, j| [at(i), -at(j)])), "downward");
        let there_and_back = |i: usize, j: usize| if j.is_multiple_of(2) { i } else { 6 - i };
        assert!(leads(&list(7, 6, |i, j| [at(there_and_back(i, j)), at(j)])));
        // The last row is cut short.
        let mut cut = list(32, 32, |i, j| [at(i), at(j)]);
        cut.values.truncate(4 * (32 * 31 + 5));
        assert!(leads(&cut));
    }

    #[test]
    fn maps_are_no_lists() {
        let map = |z: &dyn Fn(usize, usize) -> f64| Matrix {
            columns: 16,
            values: (0..256).map(|n| z(n % 16, n / 16)).collect(),
        };
        assert!(!leads(&map(&|i, _| i as f64)), "ridges across");
        assert!(!leads(&map(&|_, j| j as f64)), "ridges along");
        assert!(!leads(&map(&|_, j| (j % 4) as f64)), "ridges along");
        assert!(!leads(&map(&|i, j| ((i * 7 + j * 3) % 11) as f64)));
        assert!(!leads(&map(&|i, j| (i * j) as f64)));
        assert!(!leads(&map(&|_, j| (j / 4) as f64)), "steps");
        assert!(!leads(&list(2, 2, |i, j| [i as f64, j as f64])), "too few");
        // As a list but for one place.
        let mut torn = list(8, 8, |i, j| [i as f64, j as f64]);
        torn.values[4 * 20] += 0.5;
        assert!(!leads(&torn));
        assert!(!leads(&Matrix {
            columns: 0,
            values: vec![]
        }));
    }
}
