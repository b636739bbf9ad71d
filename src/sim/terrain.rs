//! Both rough surfaces where they now are, and the gap that they leave.
//!
//! ```text
//! z = A/2 Σ± cos(a± x + b± y + φ),  x measured from the body's own origin, which moves at U_i
//! cos(ax + by + φ) = cos(ax + φ) cos(by) − sin(ax + φ) sin(by):  one table per direction
//! ```
//! The product of two waves is the sum of two plane waves, so a surface costs four multiplications a
//! node whatever its lay. Heights in film units; gap = macroscopic − z1 − z2.

use crate::math::grid::Grid;
use crate::scene::Surface;

/// One plane wave of a surface.
#[derive(Debug, Clone, Copy)]
struct Plane {
    a: f64,
    b: f64,
}

/// One body's waves on the grid.
#[derive(Debug, Clone)]
struct Waves {
    planes: [Plane; 2],
    phase: f64,
    /// cos, sin over x and over y for each plane.
    along: [Vec<(f64, f64)>; 2],
    across: [Vec<(f64, f64)>; 2],
}

/// Both surfaces.
#[derive(Debug, Clone)]
pub(super) struct Terrain {
    waves: [Option<Waves>; 2],
    /// Heights of both bodies, film units, shape ny × nx.
    pub(super) heights: [Vec<f64>; 2],
}

impl Terrain {
    /// The surfaces of a scene on `grid` (lengths over `a_m`).
    pub(super) fn new(grid: &Grid, surfaces: [&Surface; 2], a_m: f64) -> Self {
        let waves = surfaces.map(|surface| Waves::new(grid, surface, a_m));
        let heights = [0, 1].map(|body| {
            let n = if waves[body as usize].is_some() {
                grid.len()
            } else {
                0
            };
            vec![0.0; n]
        });
        Self { waves, heights }
    }

    /// Wavenumbers along x of body `body`'s two plane waves, rad/a; 0: none, or it does not vary along x.
    pub(super) fn wavenumbers(&self, body: usize) -> [f64; 2] {
        let waves = self.waves[body].as_ref();
        waves.map_or([0.0; 2], |waves| waves.planes.map(|plane| plane.a))
    }

    /// Whether body `body` (0 or 1) has waves.
    pub(super) fn is_rough(&self, body: usize) -> bool {
        self.waves[body].is_some()
    }

    /// Moves body `body` to `travelled` (in a) with amplitude `amplitude` (film units).
    pub(super) fn place(&mut self, grid: &Grid, body: usize, travelled: f64, amplitude: f64) {
        if let Some(waves) = &mut self.waves[body] {
            waves.heights(grid, travelled, amplitude, &mut self.heights[body]);
        }
    }

    /// `gap = macroscopic − z1 − z2`.
    pub(super) fn gap_into(&self, macroscopic: &[f64], gap: &mut [f64]) {
        gap.copy_from_slice(macroscopic);
        for heights in &self.heights {
            for (g, &z) in gap.iter_mut().zip(heights) {
                *g -= z;
            }
        }
    }
}

impl Waves {
    fn new(grid: &Grid, surface: &Surface, a_m: f64) -> Option<Self> {
        use std::f64::consts::TAU;
        let Surface::Sinusoid {
            wavelength_x_m,
            wavelength_y_m,
            angle_deg,
            phase_deg,
            ..
        } = *surface
        else {
            return None;
        };
        let (kx, ky) = (TAU * a_m / wavelength_x_m, TAU * a_m / wavelength_y_m);
        let (sin, cos) = angle_deg.to_radians().sin_cos();
        let plane = |sign: f64| Plane {
            a: kx * cos - sign * ky * sin,
            b: kx * sin + sign * ky * cos,
        };
        let mut waves = Self {
            planes: [plane(1.0), plane(-1.0)],
            phase: phase_deg.to_radians(),
            along: [vec![(0.0, 0.0); grid.nx], vec![(0.0, 0.0); grid.nx]],
            across: [vec![(0.0, 0.0); grid.ny], vec![(0.0, 0.0); grid.ny]],
        };
        for (plane, across) in waves.planes.iter().zip(&mut waves.across) {
            for (j, value) in across.iter_mut().enumerate() {
                let (s, c) = (plane.b * grid.y(j)).sin_cos();
                *value = (c, s);
            }
        }
        Some(waves)
    }

    fn heights(&mut self, grid: &Grid, travelled: f64, amplitude: f64, out: &mut [f64]) {
        for (plane, along) in self.planes.iter().zip(&mut self.along) {
            for (i, value) in along.iter_mut().enumerate() {
                let (s, c) = (plane.a * (grid.x(i) - travelled) + self.phase).sin_cos();
                *value = (0.5 * amplitude * c, 0.5 * amplitude * s);
            }
        }
        for (j, row) in out.chunks_exact_mut(grid.nx).enumerate() {
            let ((c1, s1), (c2, s2)) = (self.across[0][j], self.across[1][j]);
            for ((z, &(a1, b1)), &(a2, b2)) in
                row.iter_mut().zip(&self.along[0]).zip(&self.along[1])
            {
                *z = a1 * c1 - b1 * s1 + a2 * c2 - b2 * s2;
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::math::grid::Symmetry;
    use crate::physics::waviness::Waviness;

    #[test]
    fn plane_waves_are_the_product() {
        let grid = Grid::new(17, -2.0, 1.5, 2.0, Symmetry::General);
        let surface = Surface::Sinusoid {
            amplitude_m: 1.0,
            wavelength_x_m: 0.7e-3,
            wavelength_y_m: 0.4e-3,
            angle_deg: 25.0,
            phase_deg: 40.0,
        };
        let mut terrain = Terrain::new(&grid, [&surface, &Surface::Smooth {}], 1e-3);
        terrain.place(&grid, 0, 0.3, 0.02);
        let wave = Waviness::new(0.7, 0.4, 25_f64.to_radians(), 40_f64.to_radians());
        for n in 0..grid.len() {
            let exact = 0.02 * wave.shape(grid.x(n % 17) - 0.3, grid.y(n / 17));
            assert!((terrain.heights[0][n] - exact).abs() < 1e-14);
        }
    }
}
