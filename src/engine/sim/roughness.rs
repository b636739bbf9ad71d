//! Both rough surfaces where they now are, and the gap that they leave.
//!
//! ```text
//! z = A/2 Σ± cos(a± x + b± y + φ),  x measured from the body's own origin, which moves at U_i
//! cos(ax + by + φ) = cos(ax + φ) cos(by) − sin(ax + φ) sin(by):  one table per direction
//! ```
//! The product of two waves is the sum of two plane waves, so a surface costs four multiplications a
//! node whatever its lay. A height map is resampled to the grid's rows once, without the waves that the grid would take for
//! others; a step then takes four multiplications a node too. Heights in film units; gap = macroscopic − z1 − z2.

use std::sync::Arc;

use super::motion::BodyTravel;
use super::scaling::Heading;
use crate::math::grid::Grid;
use crate::physics::height_map::{HeightMap, MapEdge};
use crate::scene::Surface;

/// One plane wave of a surface.
#[derive(Debug, Clone, Copy)]
struct PlaneWave {
    a: f64,
    b: f64,
}

/// One body's waves on the grid.
#[derive(Debug, Clone)]
struct GriddedWaves {
    planes: [PlaneWave; 2],
    phase: f64,
    /// cos, sin over x and over y for each plane.
    along: [Vec<(f64, f64)>; 2],
    across: [Vec<(f64, f64)>; 2],
}

/// One body's height map on the grid.
#[derive(Debug, Clone)]
struct GriddedMap {
    map: Arc<HeightMap>,
    /// The map at the grid's rows, shape ny × pixels along x.
    rows: Vec<f32>,
    /// Pixel along x, in a; negative: mirrored.
    pixel: f64,
    /// Where the middle stands at the start, in a.
    start: f64,
    /// Four pixels and their weights for each column of the grid.
    along: Vec<([u32; 4], [f32; 4])>,
}

/// What a body carries.
#[derive(Debug, Clone)]
enum Relief {
    Waves(GriddedWaves),
    Map(GriddedMap),
}

/// Both surfaces.
#[derive(Debug, Clone)]
pub(super) struct Roughness {
    reliefs: [Option<Relief>; 2],
    /// Heights of both bodies, film units, shape ny × nx.
    pub(super) heights: [Vec<f64>; 2],
}

impl Roughness {
    /// The surfaces of a scene on `grid` (lengths over `a_m`), mirrored where the flow goes backward.
    pub(super) fn new(grid: &Grid, surfaces: [&Surface; 2], a_m: f64, heading: Heading) -> Self {
        let reliefs = surfaces.map(|surface| Relief::new(grid, surface, a_m, heading));
        let heights = [0, 1].map(|body| {
            let n = if reliefs[body as usize].is_some() {
                grid.len()
            } else {
                0
            };
            vec![0.0; n]
        });
        Self { reliefs, heights }
    }

    /// Wavenumbers along x of body `body`, rad/a: of its two plane waves, or of a map that repeats; 0: none, or
    /// it does not vary along x.
    pub(super) fn wavenumbers(&self, body: usize) -> [f64; 2] {
        match &self.reliefs[body] {
            Some(Relief::Waves(waves)) => waves.planes.map(|plane| plane.a),
            Some(Relief::Map(drawn)) => [drawn.wavenumber(), 0.0],
            None => [0.0; 2],
        }
    }

    /// Whether body `body` (0 or 1) has waves or a map.
    pub(super) fn is_rough(&self, body: usize) -> bool {
        self.reliefs[body].is_some()
    }

    /// Whether its heights are those of this grid's nodes; smooth bodies are on every grid.
    pub(super) fn is_on(&self, grid: &Grid) -> bool {
        let fits = |heights: &Vec<f64>| heights.is_empty() || heights.len() == grid.len();
        self.heights.iter().all(fits)
    }

    /// Moves body `body` to where its `travel` has brought it, with amplitude `amplitude` (film units).
    pub(super) fn place(&mut self, grid: &Grid, body: usize, travel: BodyTravel, amplitude: f64) {
        let out = &mut self.heights[body];
        match &mut self.reliefs[body] {
            Some(Relief::Waves(waves)) => waves.heights(grid, travel.travelled, amplitude, out),
            Some(Relief::Map(drawn)) => drawn.heights(grid, travel, amplitude, out),
            None => out.fill(0.0),
        }
    }

    /// Length after which the relief of body `body` repeats along x, in a; infinite: it is the same all along; `None`: it
    /// does not repeat, or there is none.
    pub(super) fn repeat(&self, body: usize) -> Option<f64> {
        let [one, two] = self.wavenumbers(body).map(f64::abs);
        let repeats = match self.reliefs[body].as_ref()? {
            Relief::Waves(_) => one == two,
            Relief::Map(drawn) => drawn.map.beyond() == MapEdge::Periodic,
        };
        // 2π/0 is a wave without end.
        repeats.then(|| std::f64::consts::TAU / one)
    }

    /// Makes room for the heights of a body that is smooth as long as nothing of it has flowed.
    pub(super) fn make_heights(&mut self, grid: &Grid, body: usize) {
        self.heights[body].resize(grid.len(), 0.0);
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

impl Relief {
    fn new(grid: &Grid, surface: &Surface, a_m: f64, heading: Heading) -> Option<Self> {
        match surface {
            Surface::Smooth {} => None,
            Surface::Sinusoid { .. } => {
                GriddedWaves::new(grid, surface, a_m, heading).map(Self::Waves)
            }
            Surface::Random(_) | Surface::HeightMap { .. } => {
                let (map, [side_x_m, side_y_m]) = surface.relief()?;
                // What is made has no waves below its cut-off, which the mesh carries.
                let carried = match surface {
                    Surface::HeightMap { .. } => {
                        let along = grid.dx * a_m / side_x_m;
                        // A line's grid has one row.
                        let across = if grid.ny > 1 {
                            grid.dy * a_m / side_y_m
                        } else {
                            0.0
                        };
                        map.carried_by([along, across])
                    }
                    Surface::Smooth {} | Surface::Sinusoid { .. } | Surface::Random(_) => None,
                };
                let map = carried.map_or_else(|| Arc::clone(map), Arc::new);
                let start = match surface {
                    Surface::HeightMap { start_x_m, .. } => *start_x_m,
                    Surface::Smooth {} | Surface::Sinusoid { .. } | Surface::Random(_) => None,
                };
                let start = start.map(|x_m| heading.sign() * x_m / a_m);
                // Columns that run the other way are a pixel of the opposite sign.
                let pixels = [heading.sign() * side_x_m / a_m, side_y_m / a_m];
                Some(Self::Map(GriddedMap::new(grid, map, pixels, start)))
            }
        }
    }
}

impl GriddedMap {
    /// Of the map's length, rad/a; 0: it comes once.
    fn wavenumber(&self) -> f64 {
        match self.map.beyond() {
            MapEdge::Periodic => std::f64::consts::TAU / (self.pixel.abs() * self.map.nx() as f64),
            MapEdge::Windowed => 0.0,
        }
    }

    fn new(
        grid: &Grid,
        map: Arc<HeightMap>,
        [pixel, pixel_y]: [f64; 2],
        start: Option<f64>,
    ) -> Self {
        let mut rows = vec![0.0; grid.ny * map.nx()];
        for (j, row) in rows.chunks_exact_mut(map.nx()).enumerate() {
            map.row_into(grid.y(j) / pixel_y, row);
        }
        let start = match map.beyond() {
            MapEdge::Periodic => 0.0,
            // Its downstream edge, and the reach of the interpolation, at the inlet.
            MapEdge::Windowed => {
                start.unwrap_or(grid.x_min - (0.5 * (map.nx() - 1) as f64 + 2.0) * pixel_y)
            }
        };
        Self {
            map,
            rows,
            pixel,
            start,
            along: vec![([0; 4], [0.0; 4]); grid.nx],
        }
    }

    fn heights(&mut self, grid: &Grid, travel: BodyTravel, amplitude: f64, out: &mut [f64]) {
        let distance = match self.map.beyond() {
            MapEdge::Periodic => Some(travel.travelled),
            MapEdge::Windowed => travel.in_passage,
        };
        let Some(distance) = distance else {
            out.fill(0.0);
            return;
        };
        let nx = self.map.nx();
        for (i, (pixels, weights)) in self.along.iter_mut().enumerate() {
            let (first, w) =
                HeightMap::stencil((grid.x(i) - distance - self.start) / self.pixel, nx);
            for k in 0..4 {
                let pixel = self.map.wrapped(first + k as i64, nx);
                pixels[k] = pixel.unwrap_or(0) as u32;
                weights[k] = if pixel.is_some() { w[k] as f32 } else { 0.0 };
            }
        }
        for (row, line) in out
            .chunks_exact_mut(grid.nx)
            .zip(self.rows.chunks_exact(nx))
        {
            for (z, (pixels, weights)) in row.iter_mut().zip(&self.along) {
                let mut sum = 0.0;
                for (&pixel, &w) in pixels.iter().zip(weights) {
                    sum += w * line[pixel as usize];
                }
                *z = amplitude * f64::from(sum);
            }
        }
    }
}

impl GriddedWaves {
    fn new(grid: &Grid, surface: &Surface, a_m: f64, heading: Heading) -> Option<Self> {
        use std::f64::consts::TAU;
        let (wavelength_x_m, wavelength_y_m, angle_deg, phase_deg) = match *surface {
            Surface::Sinusoid {
                wavelength_x_m,
                wavelength_y_m,
                angle_deg,
                phase_deg,
                ..
            } => (wavelength_x_m, wavelength_y_m, angle_deg, phase_deg),
            Surface::Smooth {} | Surface::Random(_) | Surface::HeightMap { .. } => return None,
        };
        let (kx, ky) = (TAU * a_m / wavelength_x_m, TAU * a_m / wavelength_y_m);
        // A right angle has no component of 6e-17.
        let exact = |v: f64| if v.abs() < 1e-15 { 0.0 } else { v };
        let (sin, cos) = angle_deg.to_radians().sin_cos();
        let (sin, cos) = (exact(sin), exact(cos));
        let plane = |sign: f64| PlaneWave {
            a: heading.sign() * (kx * cos - sign * ky * sin),
            b: kx * sin + sign * ky * cos,
        };
        let mut waves = Self {
            // In the mirror the two change places: summed in the same order, to the last bit.
            planes: [plane(heading.sign()), plane(-heading.sign())],
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
        let mut roughness = Roughness::new(
            &grid,
            [&surface, &Surface::Smooth {}],
            1e-3,
            Heading::Forward,
        );
        let travel = BodyTravel {
            travelled: 0.3,
            in_passage: None,
        };
        roughness.place(&grid, 0, travel, 0.02);
        let wave = Waviness::new(0.7, 0.4, 25_f64.to_radians(), 40_f64.to_radians());
        for n in 0..grid.len() {
            let exact = 0.02 * wave.shape(grid.x(n % 17) - 0.3, grid.y(n / 17));
            assert!((roughness.heights[0][n] - exact).abs() < 1e-14);
        }
    }
    /// A made surface is the same whatever the mesh: where three meshes have a node, they have the same height.
    #[test]
    fn a_made_surface_does_not_know_its_mesh() {
        let settings = [
            "kind=random",
            "rq_m=2e-7",
            "correlation_x_m=4e-5",
            "cutoff_short_m=3e-5",
        ]
        .map(|key| format!("body_1.surface.{key}").parse().expect("a setting"));
        let scene = crate::scene::Scene::load_with("demonstration", &settings).expect("it fits");
        let surfaces = [&scene.body_1.surface, &Surface::Smooth {}];
        let heights = [129, 257, 513].map(|n| {
            let grid = Grid::new(n, -2.0, 1.5, 2.0, Symmetry::General);
            let mut roughness = Roughness::new(&grid, surfaces, 0.47e-3, Heading::Forward);
            let travel = BodyTravel {
                travelled: 0.37,
                in_passage: None,
            };
            roughness.place(&grid, 0, travel, 1.0);
            let every = (n - 1) / 128;
            let common = (0..grid.len())
                .filter(|m| (m % n) % every == 0 && (m / n) % every == 0)
                .map(|m| roughness.heights[0][m]);
            common.collect::<Vec<f64>>()
        });
        let differ = |one: &[f64], other: &[f64]| {
            let apart = one.iter().zip(other).map(|(a, b)| (a - b).abs());
            apart.fold(0.0, f64::max)
        };
        let greatest = heights[0].iter().fold(0.0_f64, |a, z| a.max(z.abs()));
        assert!(heights[0].len() == 129 * 129 && greatest > 0.5);
        assert!(differ(&heights[0], &heights[1]) < 1e-6);
        assert!(differ(&heights[0], &heights[2]) < 1e-6);
    }

    /// A scan with that pixel, in mm.
    fn measured(map: HeightMap, pixel: f64) -> Surface {
        Surface::HeightMap {
            file: String::new(),
            pixel_m: Some(1e-3 * pixel),
            edge: crate::scene::MapEdge::Periodic,
            unit_m: None,
            level: None,
            outliers: crate::scene::MapOutliers::Keep,
            amplitude_m: None,
            crop_m: None,
            turn_deg: None,
            s_filter_m: None,
            l_filter_m: None,
            start_x_m: Some(-0.5e-3),
            digest: None,
            map: Some(Arc::new(map)),
        }
    }

    /// A wave of 1.35 nodes is none that a mesh has: what is left is the one of 20 nodes, wherever the body stands. Sampled at the
    /// nodes as it is, it would be one of 3.9 nodes that goes the other way.
    #[test]
    fn what_a_mesh_cannot_carry_is_no_other_wave() {
        use std::f64::consts::TAU;
        let grid = Grid::new(129, -2.0, 1.5, 2.0, Symmetry::General);
        // Two pixels to a node.
        let pixel = 0.5 * grid.dx;
        let n = 400;
        let wave = |x: f64, length: f64| (TAU * x / length).cos();
        let at = |i: usize, short: f64| {
            let x = i as f64 - 0.5 * (n - 1) as f64;
            wave(x, 40.0) + short * wave(x, 400.0 / 148.0)
        };
        let heights = |short: f64| {
            let heights: Vec<f64> = (0..n * 3).map(|m| 1e-7 * at(m % n, short)).collect();
            let map = HeightMap::new(n, &heights, MapEdge::Periodic).expect("it has heights");
            let peak = map.peak_m / 1e-7;
            let surface = measured(map, pixel);
            let bodies = [&surface, &Surface::Smooth {}];
            let mut roughness = Roughness::new(&grid, bodies, 1e-3, Heading::Forward);
            let travel = BodyTravel {
                travelled: 0.3 * grid.dx,
                in_passage: None,
            };
            roughness.place(&grid, 0, travel, peak);
            std::mem::take(&mut roughness.heights[0])
        };
        let (long, both) = (heights(0.0), heights(0.5));
        for m in 0..grid.len() {
            let exact = wave((grid.x(m % grid.nx) - 0.3 * grid.dx) / pixel, 40.0);
            assert!((long[m] - exact).abs() < 1e-3, "{} {exact}", long[m]);
            assert!((both[m] - long[m]).abs() < 1e-5, "{} {}", both[m], long[m]);
        }
    }

    #[test]
    fn a_map_moves_with_its_body() {
        let grid = Grid::new(33, -2.0, 1.5, 2.0, Symmetry::General);
        let n = 24;
        let heights: Vec<f64> = (0..n * n)
            .map(|m| {
                let (x, y) = (m % n, m / n);
                1e-7 * ((x * x + 3 * y) % 7) as f64
            })
            .collect();
        for (beyond, travelled) in [(MapEdge::Periodic, 0.4), (MapEdge::Windowed, 0.9)] {
            let map = HeightMap::new(n, &heights, beyond).expect("it has heights");
            // Wider than a node: this mesh carries what is there.
            let surface = measured(HeightMap::clone(&map), 0.2);
            let mut roughness = Roughness::new(
                &grid,
                [&Surface::Smooth {}, &surface],
                1e-3,
                Heading::Forward,
            );
            let travel = BodyTravel {
                travelled: 0.4,
                in_passage: Some(0.9),
            };
            let start = if beyond == MapEdge::Periodic {
                0.0
            } else {
                -0.5
            };
            roughness.place(&grid, 1, travel, 0.02);
            let mut rough = 0;
            for m in 0..grid.len() {
                let x = (grid.x(m % 33) - travelled - start) / 0.2;
                let exact = 0.02 * map.sample(x, grid.y(m / 33) / 0.2);
                assert!((roughness.heights[1][m] - exact).abs() < 1e-7);
                rough += usize::from(exact != 0.0);
            }
            assert!(rough > 50, "{rough}");
            // Before the passage a windowed map is not there yet.
            let before = BodyTravel {
                travelled: 0.4,
                in_passage: None,
            };
            roughness.place(&grid, 1, before, 0.02);
            let is_flat = roughness.heights[1].iter().all(|&z| z == 0.0);
            assert_eq!(is_flat, beyond == MapEdge::Windowed);
        }
    }
}
