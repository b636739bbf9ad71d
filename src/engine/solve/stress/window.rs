//! The longest waves: frequency responses of the point-force kernels cut off by a smooth window, so
//! that a periodic transform gives the stress of one contact alone and not of a lattice of them.
//!
//! ```text
//! T_h(kx, ky; z) = ∫∫ K_h(x, y; z) W(ρ) e^{−i(kx x + ky y)} dx dy,   ρ² = (x/Lx)² + (y/Ly)²
//! W(ρ) = ½ erfc((ρ − ½)/δ)
//! ```
//! K_h are the harmonics of a unit point force ([`point_radial`]), Lx × Ly the
//! period. W is 1 near the source and 0 at its nearest image; being a function of x/Lx and y/Ly it
//! also fits long ellipses. Its spectrum falls as e^{−(πδm)²} in the mode number m, so from m = 16 on
//! the kernel's own spectrum serves. The integral is taken in polar coordinates of the stretched plane:
//! Gauss-Legendre on panels that shrink towards the source, the trapezoidal rule in angle.
//!
//! Ours: a kernel times W has no images where W vanishes, and its spectrum is the kernel's smeared by W's; both follow
//! from the convolution theorem.

use std::collections::VecDeque;
use std::f64::consts::PI;
use std::sync::{Arc, Mutex, PoisonError};

use rayon::prelude::*;

use crate::math::fused::Fused as _;
use crate::math::quadrature::gauss_legendre;
use crate::physics::stress_exact::{Directions, Harmonics, point_radial};

/// Modes per direction that are tabulated.
pub(super) const LOW: usize = 16;

/// Tabulated numbers per mode: seven directions for each of f and g.
const KINDS: usize = 14;

/// Table of one depth: `[harmonic][ky][kx]`.
///
/// The spectrum is the number itself for even-even harmonics (1, nx²) and `nx ny`, and i times it for
/// the odd ones (`i nx`, `i ny`, `i nx² ny`, `i nx ny²`).
pub(super) struct LowModes {
    sums: Vec<ModeTable>,
}

/// Numbers of the modes, `[ky][kx]`.
type ModeTable = [f64; LOW * LOW];

impl LowModes {
    /// Harmonics of mode (mx, my), in the order of the component tables.
    pub(super) fn at(&self, mx: usize, my: usize) -> Harmonics {
        let number = |h: usize| self.sums[h][my * LOW + mx];
        let family = |o: usize| Directions {
            one: number(o),
            inx: number(o + 1),
            iny: number(o + 2),
            nx2: number(o + 3),
            nxny: number(o + 4),
            inx2ny: number(o + 5),
            inxny2: number(o + 6),
        };
        Harmonics {
            f: family(0),
            g: family(7),
        }
    }
}

/// A quadrature point of the quarter plane and its waves.
struct QuadraturePoint {
    x: f64,
    y: f64,
    /// Quarter-plane weight times four times the window.
    weight: f64,
    cos_x: [f64; LOW],
    sin_x: [f64; LOW],
    cos_y: [f64; LOW],
    sin_y: [f64; LOW],
}

/// What tables are of.
#[derive(Debug, Clone, PartialEq)]
struct Tabulated {
    period: (f64, f64),
    edge: f64,
    depths: Vec<f64>,
}

/// Most tables that are kept, a megabyte each at 32 depths.
const KEPT: usize = 4;

/// The last ones, the newest first. They hang on nothing but what they are of: a run asks for the same on each of its meshes, for
/// each law of its oil and after each turn of a knob, a sweep for each of its cases.
static LAST: Mutex<VecDeque<(Tabulated, Arc<[LowModes]>)>> = Mutex::new(VecDeque::new());

/// Tables of every depth, for the period `lx` × `ly`.
pub(super) fn low_modes(period: (f64, f64), edge: f64, depths: &[f64]) -> Arc<[LowModes]> {
    let depths = depths.to_vec();
    let asked = Tabulated {
        period,
        edge,
        depths,
    };
    let last = || LAST.lock().unwrap_or_else(PoisonError::into_inner);
    let found = last().iter().find(|(of, _)| *of == asked).cloned();
    // Made while nobody waits: a thread that makes one may be given another that asks for one.
    let (of, tables) = found.unwrap_or_else(|| {
        let tables = tabulate(&asked);
        (asked, tables)
    });
    let mut last = last();
    last.retain(|(other, _)| *other != of);
    last.push_front((of, Arc::clone(&tables)));
    last.truncate(KEPT);
    tables
}

fn tabulate(asked: &Tabulated) -> Arc<[LowModes]> {
    let depths = &asked.depths;
    let shallowest = depths.iter().copied().fold(f64::INFINITY, f64::min);
    let points = quadrature(asked.period, asked.edge, shallowest);
    depths
        .par_iter()
        .map(|&z| {
            let mut sums = vec![[0.0; LOW * LOW]; KINDS];
            accumulate(&points, z, &mut sums);
            LowModes { sums }
        })
        .collect()
}

/// Quadrature points that resolve a kernel of depth `z` at the source.
fn quadrature((lx, ly): (f64, f64), edge: f64, z: f64) -> Vec<QuadraturePoint> {
    let (nodes, weights) = gauss_legendre(8);
    let aspect = (lx / ly).max(ly / lx);
    let mut points = Vec::new();
    for (low, high) in panels(z / lx.max(ly), edge) {
        let angles = angles_at(high, aspect);
        for (node, weight) in nodes.iter().zip(&weights) {
            let rho = low + (high - low) * node;
            let ring = weight * (high - low) * rho * lx * ly * (PI / 2.0) / angles as f64;
            for i in 0..angles {
                let (sin, cos) = (PI / 2.0 * (i as f64 + 0.5) / angles as f64).sin_cos();
                points.push(point(
                    rho * cos,
                    rho * sin,
                    lx,
                    ly,
                    4.0 * ring * window(rho, edge),
                ));
            }
        }
    }
    points
}

/// Radial panels: one of the kernel's size at the source, then doubling, then even.
fn panels(kernel: f64, edge: f64) -> Vec<(f64, f64)> {
    let (end, widest) = (0.5 + 4.2 * edge, 0.06);
    let mut panels = vec![(0.0, kernel.min(widest))];
    let mut low = kernel.min(widest);
    while low < end {
        let high = (low + low.min(widest)).min(end);
        panels.push((low, high));
        low = high;
    }
    panels
}

/// Angles in a quarter turn that resolve the waves at radius rho and the ellipse's squeeze.
fn angles_at(rho: f64, aspect: f64) -> usize {
    let waves = 2.0 * PI * LOW as f64 * 2.0_f64.sqrt() * rho;
    let squeeze = 18.0 * aspect;
    ((waves + 16.0 + squeeze) / 4.0).ceil() as usize
}

fn point(u: f64, v: f64, lx: f64, ly: f64, weight: f64) -> QuadraturePoint {
    let mut p = QuadraturePoint {
        x: u * lx,
        y: v * ly,
        weight,
        cos_x: [0.0; LOW],
        sin_x: [0.0; LOW],
        cos_y: [0.0; LOW],
        sin_y: [0.0; LOW],
    };
    for m in 0..LOW {
        let turn = 2.0 * PI * m as f64;
        (p.sin_x[m], p.cos_x[m]) = (turn * u).sin_cos();
        (p.sin_y[m], p.cos_y[m]) = (turn * v).sin_cos();
    }
    p
}

/// The window at ρ: 1 at the source, ½ halfway to the nearest image.
fn window(rho: f64, edge: f64) -> f64 {
    0.5 * erfc((rho - 0.5) / edge)
}

/// Complementary error function: series below 2, continued fraction (Lentz) above; 1e-15.
fn erfc(x: f64) -> f64 {
    if x < 0.0 {
        return 2.0 - erfc(-x);
    }
    if x < 2.0 {
        let (mut term, mut sum) = (x, x);
        for n in 1..60 {
            term *= -x * x / f64::from(n);
            sum += term / f64::from(2 * n + 1);
        }
        return 1.0 - 2.0 / PI.sqrt() * sum;
    }
    let mut tail = 0.0;
    for n in (1..60).rev() {
        tail = 0.5 * f64::from(n) / (x + tail);
    }
    (-x * x).exp() / (PI.sqrt() * (x + tail))
}

/// Points whose waves stay at hand while their kernels are summed up.
const BATCH: usize = 16;
/// Rows of modes that are summed up beside each other.
const ROWS: usize = 4;

dispatched! {
/// Adds every point's kernel times its waves.
fn accumulate(points: &[QuadraturePoint], z: f64, sums: &mut [ModeTable]) {
    let mut kernels = [[0.0; BATCH]; KINDS];
    for batch in points.chunks(BATCH) {
        for (n, p) in batch.iter().enumerate() {
            let r = p.x.hypot(p.y);
            let (f, g) = point_radial(r, z);
            let families = [f, g].map(|radial| Directions::from_radial(radial, p.x / r, p.y / r));
            for (family, d) in families.iter().enumerate() {
                // ∫ e^{−ikx} of an odd kernel is −i times its sine integral: the sign goes here.
                let signed = [d.one, -d.inx, -d.iny, d.nx2, -d.nxny, -d.inx2ny, -d.inxny2];
                for (direction, kernel) in signed.iter().enumerate() {
                    kernels[7 * family + direction][n] = p.weight * kernel;
                }
            }
        }
        for (kind, sum) in sums.iter_mut().enumerate() {
            let kernels = &kernels[kind][..batch.len()];
            match kind % 7 {
                1 | 6 => add(sum, batch, kernels, |p| (&p.sin_x, &p.cos_y)),
                2 | 5 => add(sum, batch, kernels, |p| (&p.cos_x, &p.sin_y)),
                4 => add(sum, batch, kernels, |p| (&p.sin_x, &p.sin_y)),
                _ => add(sum, batch, kernels, |p| (&p.cos_x, &p.cos_y)),
            }
        }
    }
}
}

/// Waves of a point along x and along y.
type Waves<'a> = (&'a [f64; LOW], &'a [f64; LOW]);

/// Adds `kernels` times the waves of their points.
#[inline(always)]
fn add(
    sum: &mut ModeTable,
    batch: &[QuadraturePoint],
    kernels: &[f64],
    waves: impl Fn(&QuadraturePoint) -> Waves<'_>,
) {
    let (rows, _) = sum.as_chunks_mut::<LOW>();
    let (blocks, _) = rows.as_chunks_mut::<ROWS>();
    for (block, rows) in blocks.iter_mut().enumerate() {
        let mut own = *rows;
        for (p, kernel) in batch.iter().zip(kernels) {
            let (along_x, along_y) = waves(p);
            for (row, wave_y) in own.iter_mut().zip(&along_y[block * ROWS..]) {
                let weight = kernel * wave_y;
                for (own, wave_x) in row.iter_mut().zip(along_x) {
                    *own = wave_x.fused(weight, *own);
                }
            }
        }
        *rows = own;
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn erfc_has_its_known_values() {
        for (x, value) in [
            (0.0, 1.0),
            (0.5, 0.4795001221869535),
            (1.9, 0.007209570764742),
            (2.1, 0.002979466656333),
            (-1.0, 1.842700792949715),
        ] {
            assert!((erfc(x) - value).abs() < 1e-13, "{x}: {}", erfc(x));
        }
    }

    #[test]
    fn tables_are_kept_for_who_asks_for_the_same() {
        let of = |ly: f64, edge: f64, z: f64| low_modes((5.0, ly), edge, &[0.4, z]);
        let tables = of(7.0, 0.06, 1.0);
        let again = of(7.0, 0.06, 1.0);
        assert!(Arc::ptr_eq(&tables, &again));
        // Whatever differs makes them others, and those that are asked for anew are the same numbers.
        for other in [of(7.5, 0.06, 1.0), of(7.0, 0.07, 1.0), of(7.0, 0.06, 1.1)] {
            assert_ne!(tables[1].sums, other[1].sums);
        }
        for k in 1..=KEPT {
            of(7.0 + k as f64, 0.06, 1.0);
        }
        assert_eq!(tables[1].sums, of(7.0, 0.06, 1.0)[1].sums);
    }

    #[test]
    fn table_joins_the_kernels_own_spectrum() {
        // The windowed spectra at the table's rim equal e^{−kz} and its directions.
        let (lx, ly) = (6.0, 9.0);
        let mut worst: f64 = 0.0;
        for z in [3e-4, 0.1, 1.0, 3.0] {
            let table = &low_modes((lx, ly), 0.062, &[3e-4, z])[1];
            for (mx, my) in [(15, 0), (0, 15), (15, 3), (12, 10), (15, 15)] {
                let (kx, ky) = (2.0 * PI * mx as f64 / lx, 2.0 * PI * my as f64 / ly);
                let k = kx.hypot(ky);
                let (nx, ny, e) = (kx / k, ky / k, (-k * z).exp());
                let h = table.at(mx, my);
                for (family, size) in [(h.f, e), (h.g, k * z * e)] {
                    worst = worst
                        .max((family.one - size).abs())
                        .max((family.inx - size * nx).abs())
                        .max((family.iny - size * ny).abs())
                        .max((family.nx2 - size * nx * nx).abs())
                        .max((family.nxny - size * nx * ny).abs())
                        .max((family.inx2ny - size * nx * nx * ny).abs())
                        .max((family.inxny2 - size * nx * ny * ny).abs());
                }
            }
        }
        println!("windowed spectrum against the kernel's own at the rim: {worst:.1e}");
        assert!(worst < 2e-6);
    }
}
