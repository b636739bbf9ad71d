//! Points that an instrument could not measure, filled from those about them.
//!
//! ```text
//! z = Σ z_k/d_k / Σ 1/d_k
//! ```
//! over the nearest measured point on each side along the row and along the column, d_k its distance in pixels: along a
//! gap in one direction alone it is the straight line. A point whose whole row and column are missing is filled in a
//! second turn, from the points that were filled in the first. Ours: the least that leaves no step; in O(pixels).

use super::{Matrix, Refusal, refusal};

/// Greatest share of missing points: beyond it the fill is a map of its own.
const GREATEST_SHARE: f64 = 0.1;

/// Fills the points that are no numbers; how many there were.
pub(super) fn fill(matrix: &mut Matrix) -> Result<usize, Refusal> {
    let all = matrix.values.len();
    let missing = matrix.values.iter().filter(|z| z.is_nan()).count();
    if missing as f64 > GREATEST_SHARE * all as f64 {
        return Err(refusal(
            format!("{missing} of {all} points are missing"),
            format!("at most {} % missing points", 100.0 * GREATEST_SHARE),
        ));
    }
    // Some row and some column have a measured point, so the second turn leaves none.
    for _ in 0..2 {
        turn(matrix);
    }
    Ok(missing)
}

/// Sums over the neighbours of a missing point.
#[derive(Clone, Copy, Default)]
struct Sums {
    weight: f64,
    height: f64,
}

/// One turn: each missing point that sees a number.
fn turn(matrix: &mut Matrix) {
    let (nx, z) = (matrix.columns, &mut matrix.values);
    let missing: Vec<usize> = (0..z.len()).filter(|&n| z[n].is_nan()).collect();
    if missing.is_empty() {
        return;
    }
    let mut sums = vec![Sums::default(); missing.len()];
    // Before it in the row and above in the column, then the other two.
    let mut ahead = sums.iter_mut();
    sweep(nx, z, 0..z.len(), &mut ahead);
    let mut back = sums.iter_mut().rev();
    sweep(nx, z, (0..z.len()).rev(), &mut back);
    for (n, sums) in missing.into_iter().zip(sums) {
        if sums.weight > 0.0 {
            z[n] = sums.height / sums.weight;
        }
    }
}

/// Goes through the pixels in that order and adds to each missing one the last measured of its row and of its column.
fn sweep<'a>(
    nx: usize,
    z: &[f64],
    order: impl Iterator<Item = usize>,
    sums: &mut impl Iterator<Item = &'a mut Sums>,
) {
    let mut in_row: Option<usize> = None;
    let mut in_column: Vec<Option<usize>> = vec![None; nx];
    for n in order {
        let (i, j) = (n % nx, n / nx);
        if in_row.is_some_and(|m| m / nx != j) {
            in_row = None;
        }
        if !z[n].is_nan() {
            (in_row, in_column[i]) = (Some(n), Some(n));
            continue;
        }
        let Some(sums) = sums.next() else { return };
        let along = in_row.map(|m| (m, n.abs_diff(m)));
        let across = in_column[i].map(|m| (m, n.abs_diff(m) / nx));
        for (m, distance) in [along, across].into_iter().flatten() {
            sums.weight += 1.0 / distance as f64;
            sums.height += z[m] / distance as f64;
        }
    }
}

#[cfg(test)]
mod tests {
    #![expect(clippy::unwrap_used, reason = "tests")]

    use super::*;

    fn plane(nx: usize, ny: usize) -> Matrix {
        Matrix {
            columns: nx,
            values: (0..nx * ny)
                .map(|n| 3.0 + 2.0 * (n % nx) as f64 - 5.0 * (n / nx) as f64)
                .collect(),
        }
    }

    #[test]
    fn inside_a_plane_the_plane_comes_back() {
        let whole = plane(20, 16);
        let mut torn = whole.clone();
        for (i, j) in [(4, 4), (5, 4), (9, 8), (9, 9), (9, 10), (15, 3)] {
            torn.values[20 * j + i] = f64::NAN;
        }
        assert_eq!(fill(&mut torn).map_err(|r| r.found), Ok(6));
        // Both straight lines pass through the plane, so any mean of them does; by weights 1/d each pair is one line.
        for (one, two) in torn.values.iter().zip(&whole.values) {
            assert!((one - two).abs() < 1e-12, "{one} {two}");
        }
    }

    #[test]
    fn corners_and_crossings_are_filled_and_counted() {
        let mut corner = plane(20, 16);
        corner.values[0] = f64::NAN;
        assert_eq!(fill(&mut corner).map_err(|r| r.found), Ok(1));
        // By hand: 5 to the right, -2 below, each one pixel away.
        assert_eq!(corner.values[0], 1.5);
        let mut cross = plane(40, 30);
        for n in 0..40 * 30 {
            if n % 40 == 7 || n / 40 == 11 {
                cross.values[n] = f64::NAN;
            }
        }
        assert_eq!(fill(&mut cross).map_err(|r| r.found), Ok(69));
        assert!(cross.values.iter().all(|z| z.is_finite()));
        assert!((cross.values[40 * 11 + 7] - (3.0 + 14.0 - 55.0)).abs() < 1e-12);
    }

    #[test]
    fn too_many_are_refused() {
        let mut torn = plane(10, 10);
        torn.values[..11].fill(f64::NAN);
        let refused = fill(&mut torn).err().unwrap();
        assert_eq!(refused.found, "11 of 100 points are missing");
        assert!(refused.allowed.contains("10 %"), "{}", refused.allowed);
    }
}
