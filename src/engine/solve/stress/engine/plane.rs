//! Stress in any plane x, y or z = const, on demand: all six components.
//!
//! ```text
//! σ(x, y, z) = Σ_k σ̂(k; z) e^{i(kx x + ky y)}
//! y = y0:  T(kx) = Σ_ky σ̂ e^{i ky y0},  then a transform along x        (x = x0 likewise, along y)
//! z = z0:  transforms along both, on the full grid
//! ```
//! The same responses as [`super::slice`] and [`super::volume`], mode by mode without vectors: some 10 to
//! 40 ms at 129², meant for a view that somebody turns and for tests, not for every frame. A depth that the
//! engine has no table for gets one (some 20 ms more).
//!
//! Part of `stress/mod.rs`.

use rustfft::FftPlanner;
use rustfft::num_complex::Complex;

use super::super::layer::{Layer, layers_at};
use super::super::load::Half;
use super::super::peak::measure_of;
use super::super::spec::Loading;
use super::super::window::LOW;
use super::StressEngine;
use crate::physics::invariants::Stress6;

type ComplexMode = Complex<f32>;

/// Which plane. Lengths in a.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Cut {
    /// x = const: y along the rows, one row a depth.
    X(f64),
    /// y = const: x along the rows, one row a depth.
    Y(f64),
    /// z = const: x along the rows, one row a y.
    Z(f64),
}

/// Stress in a plane, `[row · width + i]`, in p_h, tension positive.
#[derive(Debug, Clone, PartialEq)]
pub struct Plane {
    /// Points along a row.
    pub width: usize,
    /// Rows.
    pub rows: usize,
    /// First coordinate along a row, and the step, a.
    pub along: (f64, f64),
    /// σxx, σyy, σzz, σxy, σxz, σyz.
    pub components: [Vec<f32>; 6],
    /// Effective stress by the engine's measure.
    pub effective: Vec<f32>,
}

impl Plane {
    fn new(width: usize, rows: usize, along: (f64, f64)) -> Self {
        Self {
            width,
            rows,
            along,
            components: [0; 6].map(|_| vec![0.0; width * rows]),
            effective: vec![0.0; width * rows],
        }
    }

    /// The state at one point.
    pub fn state(&self, row: usize, i: usize) -> Stress6 {
        let at = row * self.width + i;
        Stress6::of(std::array::from_fn(|c| f64::from(self.components[c][at])))
    }
}

impl StressEngine {
    /// Stress of a body in a plane under the surface loaded last. Allocates.
    pub fn plane(&self, loading: Loading, cut: Cut) -> Plane {
        let mut plane = match cut {
            Cut::X(x) => self.cut_x(loading, x),
            Cut::Y(y) => self.cut_y(loading, y),
            Cut::Z(z) => self.cut_z(loading, z),
        };
        for at in 0..plane.effective.len() {
            let state = plane.state(at / plane.width, at % plane.width);
            plane.effective[at] = measure_of(self.spec.measure, state) as f32;
        }
        plane
    }

    fn cut_y(&self, loading: Loading, y0: f64) -> Plane {
        let (spec, waves) = (&self.spec, &self.waves);
        let mut plane = Plane::new(spec.nx, self.layers.len(), (spec.x_first, spec.dx));
        let fft = FftPlanner::new().plan_fft_inverse(waves.n_x);
        for (row, layer) in self.layers.iter().enumerate() {
            let mut lines = [0; 6].map(|_| vec![ComplexMode::default(); waves.n_x]);
            self.each_mode(layer, loading, |kx, ky, six| {
                let turn = ComplexMode::from_polar(1.0, (self.wave_y(ky) * y0) as f32);
                for (line, c) in lines.iter_mut().zip(six) {
                    line[kx] += c * turn * twice(kx);
                }
            });
            for (line, to) in lines.iter_mut().zip(&mut plane.components) {
                fft.process(line);
                for (to, c) in to[row * spec.nx..][..spec.nx].iter_mut().zip(line) {
                    *to = c.re;
                }
            }
        }
        plane
    }

    fn cut_x(&self, loading: Loading, x0: f64) -> Plane {
        let (spec, waves) = (&self.spec, &self.waves);
        let ny = spec.full_rows();
        let first = -((ny / 2) as f64) * spec.dy;
        let mut plane = Plane::new(ny, self.layers.len(), (first, spec.dy));
        let fft = FftPlanner::new().plan_fft_inverse(waves.n_y);
        let step = std::f64::consts::TAU / waves.period_x * (x0 - spec.x_first);
        for (row, layer) in self.layers.iter().enumerate() {
            let mut lines = [0; 6].map(|_| vec![ComplexMode::default(); waves.n_y]);
            self.each_mode(layer, loading, |kx, ky, six| {
                let turn = ComplexMode::from_polar(1.0, (step * kx as f64) as f32);
                for (line, c) in lines.iter_mut().zip(six) {
                    line[ky.rem_euclid(waves.n_y as isize) as usize] += c * turn * twice(kx);
                }
            });
            for (line, to) in lines.iter_mut().zip(&mut plane.components) {
                fft.process(line);
                for (i, to) in to[row * ny..][..ny].iter_mut().enumerate() {
                    *to = line[(i + waves.n_y - ny / 2) % waves.n_y].re;
                }
            }
        }
        plane
    }

    fn cut_z(&self, loading: Loading, z: f64) -> Plane {
        let known = self.layers.iter().position(|layer| layer.z == z);
        if let Some(k) = known {
            return self.layer_plane(&self.layers[k], loading);
        }
        // Its transforms are others: plans of a layer's own grid are not used.
        let made = layers_at(&self.spec, &[z], &[0.0], &self.waves, &mut Vec::new());
        self.layer_plane(&made[0], loading)
    }

    fn layer_plane(&self, layer: &Layer, loading: Loading) -> Plane {
        let (spec, waves) = (&self.spec, &self.waves);
        let ny = spec.full_rows();
        let mut plane = Plane::new(spec.nx, ny, (spec.x_first, spec.dx));
        let (n_x, n_y) = (waves.n_x, waves.n_y);
        let mut planner = FftPlanner::new();
        let (along_x, along_y) = (planner.plan_fft_inverse(n_x), planner.plan_fft_inverse(n_y));
        // One column per kx, as long as the period along y.
        let mut fields = [0; 6].map(|_| vec![ComplexMode::default(); waves.modes_x * n_y]);
        self.each_mode(layer, loading, |kx, ky, six| {
            let at = kx * n_y + ky.rem_euclid(n_y as isize) as usize;
            for (field, c) in fields.iter_mut().zip(six) {
                field[at] = c * twice(kx);
            }
        });
        for (field, to) in fields.iter_mut().zip(&mut plane.components) {
            along_y.process(field);
            let mut line = vec![ComplexMode::default(); n_x];
            for (j, row) in to.chunks_exact_mut(spec.nx).enumerate() {
                let y = (j + n_y - ny / 2) % n_y;
                line.fill(ComplexMode::default());
                for (kx, c) in line.iter_mut().enumerate().take(waves.modes_x) {
                    *c = field[kx * n_y + y];
                }
                along_x.process(&mut line);
                for (to, c) in row.iter_mut().zip(&line) {
                    *to = c.re;
                }
            }
        }
        plane
    }

    /// Wave number of row `ky` (negative: −|ky|), 1/a.
    fn wave_y(&self, ky: isize) -> f64 {
        std::f64::consts::TAU / self.waves.period_y * ky as f64
    }

    /// Calls `sink` with every kept mode kx ≥ 0 of a layer and its six components.
    fn each_mode(
        &self,
        layer: &Layer,
        loading: Loading,
        mut sink: impl FnMut(usize, isize, [ComplexMode; 6]),
    ) {
        let kept = layer.n_x / 2;
        for ky in 0..layer.rows {
            for kx in 0..kept.min(layer.blocks * crate::math::lanes::LANES) {
                sink(kx, ky as isize, self.mode(layer, loading, kx, ky, 1.0));
                if ky > 0 {
                    sink(kx, -(ky as isize), self.mode(layer, loading, kx, ky, -1.0));
                }
            }
        }
    }

    /// Components of one mode at `sign · ky`.
    fn mode(
        &self,
        layer: &Layer,
        loading: Loading,
        kx: usize,
        ky: usize,
        sign: f32,
    ) -> [ComplexMode; 6] {
        let lanes = crate::math::lanes::LANES;
        let (block, l) = (kx / lanes, kx % lanes);
        let i = block * self.waves.modes_y + ky;
        let [p, x] = self.loads(loading, i, l, sign);
        if block == 0 && ky < LOW {
            return low(
                layer,
                self.spec.material(loading.body()),
                (kx, ky),
                sign,
                [p, x],
            );
        }
        let nu2 = 2.0 * self.spec.poisson(loading.body()) as f32;
        let e = layer.e[block * layer.rows + ky].0[l];
        let kz = self.waves.k[i].0[l] * layer.z as f32;
        let (nx, ny) = (self.waves.nx[i].0[l], sign * self.waves.ny[i].0[l]);
        let q = ComplexMode::i() * x * nx;
        let d = p - q;
        let a = p * (1.0 - nu2) + q * nu2 - d * kz;
        [
            ComplexMode::i() * x * (2.0 * nx) - d * nu2 - a * (nx * nx),
            -d * nu2 - a * (ny * ny),
            -(p + d * kz),
            ComplexMode::i() * x * ny - a * (nx * ny),
            -x + ComplexMode::i() * d * (nx * kz),
            ComplexMode::i() * d * (ny * kz),
        ]
        .map(|c| c * e)
    }

    /// p̂ and q̂x on the body at one mode.
    fn loads(&self, loading: Loading, i: usize, l: usize, sign: f32) -> [ComplexMode; 2] {
        let minus = if sign < 0.0 {
            self.spectrum.minus.as_ref()
        } else {
            None
        };
        let half: &Half = minus.unwrap_or(&self.spectrum.plus);
        let at = |lanes: &crate::math::lane_fft::Lanes| {
            ComplexMode::new(lanes.re[i].0[l], lanes.im[i].0[l])
        };
        let traction = if self.spectrum.sheared {
            at(&half.x) * loading.traction_sign()
        } else {
            ComplexMode::default()
        };
        [at(&half.p), traction]
    }
}

/// Modes kx > 0 stand for −kx too.
fn twice(kx: usize) -> f32 {
    if kx == 0 { 1.0 } else { 2.0 }
}

/// A windowed mode.
fn low(
    layer: &Layer,
    material: usize,
    (kx, ky): (usize, usize),
    sign: f32,
    [p, x]: [ComplexMode; 2],
) -> [ComplexMode; 6] {
    let row = &layer.low[material][ky];
    let [t, u] = [&row.p, &row.x].map(|six| six.map(|v| v.0[kx]));
    let even = |c: usize| p * t[c] + ComplexMode::i() * x * u[c];
    let (d1, d2, zz) = (even(0), even(1), even(2));
    let yy = d2 + zz;
    [
        d1 + yy,
        yy,
        zz,
        p * (sign * t[3]) + ComplexMode::i() * x * (sign * u[3]),
        ComplexMode::i() * p * t[4] + x * u[4],
        ComplexMode::i() * p * (sign * t[5]) + x * (sign * u[5]),
    ]
}
