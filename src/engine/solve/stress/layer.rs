//! Tables: the waves of the padded surface, and one layer per depth.
//!
//! Part of `stress/mod.rs`.

use std::f64::consts::TAU;

use super::spec::{StressSpec, Symmetry};
use super::window::{LOW, LowModes, low_modes};
use crate::math::lane_fft::LaneFft;
use crate::math::lane_fft::plan_of;
use crate::math::lanes::{LANES, V};
use crate::physics::invariants::Stress6;

/// Wave numbers and directions, `[block · modes_y + ky]`, sixteen kx per block.
pub(super) struct Waves {
    /// Nodes of the period.
    pub(super) n_x: usize,
    pub(super) n_y: usize,
    /// Period, a.
    pub(super) period_x: f64,
    pub(super) period_y: f64,
    /// Modes kept, below Nyquist.
    pub(super) modes_x: usize,
    pub(super) modes_y: usize,
    /// Blocks of sixteen kx.
    pub(super) blocks: usize,
    pub(super) k: Vec<V>,
    pub(super) nx: Vec<V>,
    pub(super) ny: Vec<V>,
    /// kx of each block.
    pub(super) kx: Vec<V>,
}

impl Waves {
    pub(super) fn new(n_x: usize, n_y: usize, period_x: f64, period_y: f64) -> Self {
        let (modes_x, modes_y) = (n_x / 2, n_y / 2);
        let blocks = modes_x.div_ceil(LANES);
        let count = blocks * modes_y;
        let mut waves = Self {
            n_x,
            n_y,
            period_x,
            period_y,
            modes_x,
            modes_y,
            blocks,
            k: vec![V::ZERO; count],
            nx: vec![V::ZERO; count],
            ny: vec![V::ZERO; count],
            kx: vec![V::ZERO; blocks],
        };
        for block in 0..blocks {
            for l in 0..LANES {
                let kx = TAU / period_x * (block * LANES + l) as f64;
                waves.kx[block].0[l] = kx as f32;
                for y in 0..modes_y {
                    let ky = TAU / period_y * y as f64;
                    let k = kx.hypot(ky);
                    let by_k = if k > 0.0 { 1.0 / k } else { 0.0 };
                    let i = block * modes_y + y;
                    waves.k[i].0[l] = k as f32;
                    waves.nx[i].0[l] = (kx * by_k) as f32;
                    waves.ny[i].0[l] = (ky * by_k) as f32;
                }
            }
        }
        waves
    }
}

/// Windowed responses of the sixteen modes of one ky row: `[σ]` of p and of q_x, in the order
/// xx − yy, yy − zz, zz, xy, xz, yz. For p, xz and yz are to be taken times i; for q, all but those. At −ky,
/// xy and yz turn their sign.
#[derive(Debug, Clone, Copy)]
pub(super) struct LowRow {
    pub(super) p: [V; 6],
    pub(super) x: [V; 6],
}

/// One depth.
pub(super) struct Layer {
    /// Depth, a.
    pub(super) z: f64,
    /// Its weight in an integral over z.
    pub(super) weight: f64,
    /// Nodes of this layer's own grid.
    pub(super) n_x: usize,
    pub(super) n_y: usize,
    pub(super) fft_x: usize,
    pub(super) fft_y: usize,
    /// Blocks of kx and rows of ky that are kept.
    pub(super) blocks: usize,
    pub(super) rows: usize,
    /// e^{−kz}, `[block · rows + ky]`; 0 beyond this grid's modes.
    pub(super) e: Vec<V>,
    /// Windowed responses, one row per ky, for each Poisson's ratio.
    pub(super) low: Vec<Vec<LowRow>>,
    /// Points of this grid that lie in the domain, along x.
    pub(super) inside_x: usize,
    /// Rows to sum: y index of the first (negative: below the axis) and how many.
    pub(super) first_row: isize,
    pub(super) inside_y: usize,
    /// Area per point, a².
    pub(super) area: f64,
    /// Distance of the rows, a.
    pub(super) row_step: f64,
}

impl Layer {
    pub(super) fn bytes(&self) -> usize {
        LANES * 4 * (self.e.len() + 12 * LOW * self.low.len())
    }

    /// Blocks of sixteen rows.
    pub(super) fn row_blocks(&self) -> usize {
        self.inside_y.div_ceil(LANES)
    }

    /// Part of the domain that row `r` stands for: 1, 2 (with its mirror image), or 0 outside.
    pub(super) fn row_weight(&self, r: usize, symmetry: Symmetry) -> f32 {
        match symmetry {
            _ if r >= self.inside_y => 0.0,
            Symmetry::MirrorY if r > 0 => 2.0,
            Symmetry::MirrorY | Symmetry::General | Symmetry::Line => 1.0,
        }
    }
}

/// All layers of a specification.
pub(super) fn layers(spec: &StressSpec, waves: &Waves, plans: &mut Vec<LaneFft>) -> Vec<Layer> {
    layers_at(spec, &spec.depths, &spec.weights, waves, plans)
}

/// Layers at `depths` with `weights`.
pub(super) fn layers_at(
    spec: &StressSpec,
    depths: &[f64],
    weights: &[f64],
    waves: &Waves,
    plans: &mut Vec<LaneFft>,
) -> Vec<Layer> {
    let tables = low_modes((waves.period_x, waves.period_y), spec.window, depths);
    let mut layers = Vec::with_capacity(depths.len());
    for (k, table) in tables.iter().enumerate() {
        let z = depths[k];
        let reach = (1.0 / spec.decay).ln() / z;
        let (n_x, kept_x) = grid(reach * waves.period_x / TAU, waves.n_x);
        let (n_y, rows) = grid(reach * waves.period_y / TAU, waves.n_y);
        let blocks = kept_x.div_ceil(LANES);
        let (hx, hy) = (waves.period_x / n_x as f64, waves.period_y / n_y as f64);
        let width = (spec.nx - 1) as f64 * spec.dx;
        let (first_row, inside_y) = rows_inside(spec, hy);
        layers.push(Layer {
            z,
            weight: weights[k],
            n_x,
            n_y,
            fft_x: plan_of(plans, n_x),
            fft_y: plan_of(plans, n_y),
            blocks,
            rows,
            e: decay_table(waves, z, n_x / 2, blocks, rows),
            low: [spec.nu, spec.nu_2][..spec.materials()]
                .iter()
                .map(|nu| low_rows(table, *nu))
                .collect(),
            inside_x: inside(width, hx) + 1,
            first_row,
            inside_y,
            area: hx * hy,
            row_step: hy,
        });
    }
    layers
}

/// Grid that holds the modes below `reach`, and how many of them (0..) are kept.
fn grid(reach: f64, longest: usize) -> (usize, usize) {
    let modes = (reach.ceil().min(longest as f64) as usize + 1).max(LOW);
    let n = LaneFft::good_length(2 * modes).min(longest);
    (n, modes.min(n / 2))
}

/// Whole steps in a length that count as inside: the edge itself is at zero pressure and left out.
fn inside(length: f64, step: f64) -> usize {
    ((length / step - 1e-9).ceil() as usize).saturating_sub(1)
}

fn rows_inside(spec: &StressSpec, hy: f64) -> (isize, usize) {
    match spec.symmetry {
        Symmetry::MirrorY => (0, inside((spec.ny - 1) as f64 * spec.dy, hy) + 1),
        Symmetry::General | Symmetry::Line => {
            let half = inside((spec.ny / 2) as f64 * spec.dy, hy);
            (-(half as isize), 2 * half + 1)
        }
    }
}

fn decay_table(waves: &Waves, z: f64, modes_x: usize, blocks: usize, rows: usize) -> Vec<V> {
    let mut e = vec![V::ZERO; blocks * rows];
    for block in 0..blocks {
        for y in 0..rows {
            for l in 0..LANES {
                if block * LANES + l < modes_x {
                    let k = f64::from(waves.k[block * waves.modes_y + y].0[l]);
                    e[block * rows + y].0[l] = (-k * z).exp() as f32;
                }
            }
        }
    }
    e
}

fn low_rows(table: &LowModes, nu: f64) -> Vec<LowRow> {
    let zero = [V::ZERO; 6];
    let row = LowRow { p: zero, x: zero };
    let mut rows = vec![row; LOW];
    for (my, row) in rows.iter_mut().enumerate() {
        for mx in 0..LOW {
            let h = table.at(mx, my);
            let states = [(&mut row.p, h.normal(nu)), (&mut row.x, h.tangential_x(nu))];
            for (slot, s) in states {
                for (v, number) in slot.iter_mut().zip(differences(s)) {
                    v.0[mx] = number as f32;
                }
            }
        }
    }
    rows
}

fn differences(s: Stress6) -> [f64; 6] {
    [s.xx - s.yy, s.yy - s.zz, s.zz, s.xy, s.xz, s.yz]
}
