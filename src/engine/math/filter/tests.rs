//! Filters against direct sums.

use super::*;
use crate::math::grid::Symmetry;

fn direct(grid: &Grid, p: &[f64], kernel: impl Fn(usize, usize) -> f64) -> Vec<f64> {
    let nyf = grid.ny_full();
    let full = |j: usize, i: usize| p[grid.stored_row(j) * grid.nx + i];
    let mut out = vec![0.0; grid.len()];
    for j in 0..nyf {
        for i in 0..grid.nx {
            let mut sum = 0.0;
            for jj in 0..nyf {
                for ii in 0..grid.nx {
                    sum += kernel(i.abs_diff(ii), j.abs_diff(jj)) * full(jj, ii);
                }
            }
            out[grid.stored_row(j) * grid.nx + i] = sum;
        }
    }
    out
}

#[test]
fn doubled_filter_is_the_direct_sum() {
    for symmetry in [Symmetry::General, Symmetry::MirrorY, Symmetry::Line] {
        let grid = Grid::new(9, -1.0, 1.0, 1.0, symmetry);
        let kernel = |i: usize, j: usize| 1.0 / (1.0 + i as f64 + 0.5 * (j * j) as f64);
        let mut p = vec![0.0; grid.len()];
        for j in grid.interior_rows() {
            for i in 1..grid.nx - 1 {
                p[j * grid.nx + i] = ((3 * i + 7 * j) % 5) as f64 - 1.3;
            }
        }
        let mut filter = Filter::<f64>::new(&grid, Padding::Doubled, 1);
        filter.set_kernel(0, &filter.transform_kernel(kernel));
        let mut out = vec![f64::NAN; grid.len()];
        filter.apply(&p, &mut out);
        let expected = direct(&grid, &p, kernel);
        for (a, b) in out.iter().zip(&expected) {
            assert!((a - b).abs() < 1e-12, "{symmetry:?}: {a} {b}");
        }
    }
}

#[test]
fn odd_filter_is_the_direct_sum() {
    for symmetry in [Symmetry::General, Symmetry::Line] {
        let grid = Grid::new(9, -1.0, 1.0, 1.0, symmetry);
        let kernel = |i: usize, j: usize| i as f64 / (1.0 + (i * i) as f64 + 0.3 * (j * j) as f64);
        let mut p = vec![0.0; grid.len()];
        for j in grid.interior_rows() {
            for i in 1..8 {
                p[j * 9 + i] = ((5 * i + 3 * j) % 7) as f64 - 2.1;
            }
        }
        let mut filter = Filter::<f64>::new(&grid, Padding::Doubled, 1).odd_in_x();
        filter.set_kernel(0, &filter.transform_kernel(kernel));
        let mut out = vec![f64::NAN; grid.len()];
        filter.apply(&p, &mut out);
        for (at, got) in out.iter().enumerate() {
            let (i, j) = (at % 9, at / 9);
            let mut sum = 0.0;
            for (n, &value) in p.iter().enumerate() {
                let (ii, jj) = (n % 9, n / 9);
                let sign = if i >= ii { 1.0 } else { -1.0 };
                sum += sign * kernel(i.abs_diff(ii), j.abs_diff(jj)) * value;
            }
            assert!((got - sum).abs() < 1e-12, "{symmetry:?}: {i} {j}");
        }
    }
}
