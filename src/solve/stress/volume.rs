//! Life integral over the stressed volume, and the greatest stress in it.
//!
//! ```text
//! I = ∫ s^m dV,   s = effective stress/p_h, V in a³ (both halves of a mirror surface)
//! ln I = ln Σ_k w_k Σ_ij A_k s_ijk^m        each sum relative to its own greatest term
//! ```
//! Every depth is summed on its own grid: as many points as its waves need are enough, to 3e-6
//! (Hertz, m up to 13.5). Depths run in parallel; the sum over depths is taken in order, so the result is
//! the same on any number of threads.

use std::sync::atomic::{AtomicUsize, Ordering};

use rayon::prelude::*;

use super::assemble::{Loads, block_inputs};
use super::engine::{StressEngine, StressSpec, Symmetry};
use super::fft::{LaneFft, Lanes, pack_pair};
use super::lanes::{LANES, TILE, V, transpose_tile};
use super::layer::{Layer, Waves};
use super::load::{Sheared, Spectrum};
use super::measure::{power_sum, squared};
use super::peak::Peak;
use crate::scene::StressMeasure;

/// Life integral of one loading.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Integral {
    /// ln ∫ s^m dV, s in p_h, V in a³; −∞ without stress.
    pub ln: f64,
    /// Greatest effective stress at the points and depths of the sum (not refined).
    pub peak: Peak,
}

/// Integrals of one surface.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct VolumeOut {
    /// Pressure alone.
    pub normal: Integral,
    /// Pressure and traction; equal to `normal` where no traction was loaded.
    pub full: Integral,
}

/// Sum of one layer under one loading.
#[derive(Debug, Clone, Copy)]
struct LayerSum {
    /// ln of the layer's share of the integral.
    ln: f64,
    /// Greatest square, and where.
    top: f32,
    x: f64,
    y: f64,
}

/// One thread's buffers and results.
pub(super) struct Worker {
    /// Inputs of the y pass.
    along_y: Vec<Lanes>,
    other: Lanes,
    along_x: [Lanes; 3],
    /// Five fields after the y pass, `[(field · row blocks + row block) · kx + i]`, sixteen rows each.
    fields: Lanes,
    squares: Vec<V>,
    done: Vec<(usize, LayerSum)>,
}

impl Worker {
    pub(super) fn new(symmetry: Symmetry, waves: &Waves, tasks: usize) -> Self {
        // Buffers trade places in the transforms: all have the longer of the two lengths.
        let longest = waves.n_x.max(waves.n_y);
        let (buffers, rows) = match symmetry {
            Symmetry::MirrorY => (3, waves.n_y / 2 + 1),
            Symmetry::General => (5, waves.n_y),
        };
        let fields = 5 * rows.div_ceil(LANES) * waves.blocks * LANES;
        Self {
            along_y: (0..buffers).map(|_| Lanes::new(longest)).collect(),
            other: Lanes::new(longest),
            along_x: [0, 1, 2].map(|_| Lanes::new(longest)),
            fields: Lanes::new(fields),
            squares: vec![V::ZERO; waves.n_x],
            done: Vec::with_capacity(tasks),
        }
    }

    pub(super) fn bytes(&self) -> usize {
        let buffers = self.along_y.iter().chain(&self.along_x);
        let lanes: usize = buffers.map(|l| l.re.len()).sum();
        8 * LANES * (lanes + self.other.re.len() + self.fields.re.len())
    }
}

/// What every layer's sum needs.
struct Job<'a> {
    spec: &'a StressSpec,
    waves: &'a Waves,
    layers: &'a [Layer],
    plans: &'a [LaneFft],
    spectrum: &'a Spectrum,
    half_exponent: f32,
}

impl StressEngine {
    /// Integrals `∫ s^m dV` of the surface loaded last, without and with its traction, in parallel
    /// on the current rayon pool.
    pub fn volume(&mut self, exponent: f64) -> VolumeOut {
        let job = Job {
            spec: &self.spec,
            waves: &self.waves,
            layers: &self.layers,
            plans: &self.plans,
            spectrum: &self.spectrum,
            half_exponent: (0.5 * exponent) as f32,
        };
        let depths = self.layers.len();
        let loadings = match self.spectrum.sheared {
            Sheared::No => 1,
            Sheared::Yes => 2,
        };
        let next = AtomicUsize::new(0);
        self.workers
            .par_iter_mut()
            .with_max_len(1)
            .for_each(|worker| {
                worker.done.clear();
                loop {
                    // Shallow layers are the largest and come first.
                    let task = next.fetch_add(1, Ordering::Relaxed);
                    if task >= loadings * depths {
                        break;
                    }
                    let loads = if task.is_multiple_of(loadings) {
                        Loads::Normal
                    } else {
                        Loads::Both
                    };
                    let sum = job.layer_sum(worker, &job.layers[task / loadings], loads);
                    worker.done.push((task, sum));
                }
            });
        let normal = self.gather(0, loadings);
        let full = if loadings == 2 {
            self.gather(1, 2)
        } else {
            normal
        };
        VolumeOut { normal, full }
    }

    /// Adds the layers of one loading in order of depth.
    fn gather(&self, loading: usize, loadings: usize) -> Integral {
        let find = |task: usize| {
            let mut all = self.workers.iter().flat_map(|w| &w.done);
            all.find(|(t, _)| *t == task).map(|(_, sum)| *sum)
        };
        let sums =
            || (0..self.layers.len()).filter_map(|k| Some((k, find(k * loadings + loading)?)));
        let top_ln = sums().fold(f64::NEG_INFINITY, |top, (_, s)| top.max(s.ln));
        let mut peak = Peak::default();
        let mut sum = 0.0;
        for (k, s) in sums() {
            let value = f64::from(s.top).sqrt();
            if value > peak.value {
                peak = Peak {
                    value,
                    x: self.spec.x_first + s.x,
                    y: s.y,
                    z: self.layers[k].z,
                };
            }
            if s.ln > f64::NEG_INFINITY {
                sum += (s.ln - top_ln).exp();
            }
        }
        Integral {
            ln: if sum > 0.0 {
                top_ln + sum.ln()
            } else {
                f64::NEG_INFINITY
            },
            peak,
        }
    }
}

impl Job<'_> {
    fn layer_sum(&self, worker: &mut Worker, layer: &Layer, loads: Loads) -> LayerSum {
        for block in 0..layer.blocks {
            let inputs = &mut worker.along_y;
            block_inputs(
                layer,
                block,
                self.waves,
                self.spectrum,
                self.spec.nu,
                loads,
                inputs,
            );
            for (which, input) in worker.along_y.iter_mut().enumerate() {
                self.plans[layer.fft_y].inverse(input, &mut worker.other);
                let fields = &mut worker.fields;
                match self.spec.symmetry {
                    Symmetry::MirrorY => unfold_rows(layer, block, which, input, fields),
                    Symmetry::General => turn_rows(layer, block, which, input, fields),
                }
            }
        }
        let mut sums = RowSums::default();
        for row_block in 0..layer.row_blocks() {
            self.rows_sum(worker, layer, row_block, &mut sums);
        }
        sums.finish(self, layer)
    }

    fn rows_sum(&self, worker: &mut Worker, layer: &Layer, row_block: usize, sums: &mut RowSums) {
        let plan = &self.plans[layer.fft_x];
        let Worker {
            along_x,
            other,
            fields,
            squares,
            ..
        } = worker;
        // Two real fields share a transform: d1 with d2, xy with xz; yz is alone.
        for (input, (u, v)) in along_x
            .iter_mut()
            .zip([(0, Some(1)), (2, Some(3)), (4, None)])
        {
            let width = layer.blocks * LANES;
            let line = |field: usize| (field * layer.row_blocks() + row_block) * width;
            pack_pair(layer.n_x, width, (line(u), v.map(line)), fields, input);
            plan.inverse(input, other);
        }
        let squares = &mut squares[..layer.inside_x];
        let mut weights = V::ZERO;
        for (l, w) in weights.0.iter_mut().enumerate() {
            *w = layer.row_weight(row_block * LANES + l, self.spec.symmetry);
        }
        let (top, sum) = reduce(
            self.spec.measure,
            along_x,
            squares,
            weights,
            self.half_exponent,
        );
        sums.add(self.half_exponent, row_block, top, sum, squares);
    }
}

/// Running sum over blocks of rows, relative to the greatest square so far.
#[derive(Default)]
struct RowSums {
    top: f32,
    sum: f64,
    /// Point of this layer's grid and row where the greatest is.
    at: (usize, usize),
}

impl RowSums {
    fn add(&mut self, half_exponent: f32, row_block: usize, top: f32, sum: f64, squares: &[V]) {
        if top <= 0.0 {
            return;
        }
        let ratio = |a: f32, b: f32| f64::from(a / b).powf(f64::from(half_exponent));
        if top <= self.top {
            self.sum += sum * ratio(top, self.top);
            return;
        }
        self.sum = self.sum * ratio(self.top, top) + sum;
        self.top = top;
        let found = squares
            .iter()
            .enumerate()
            .find_map(|(i, v)| Some((i, v.0.iter().position(|s| *s == top)?)));
        if let Some((i, lane)) = found {
            self.at = (i, row_block * LANES + lane);
        }
    }

    fn finish(&self, job: &Job, layer: &Layer) -> LayerSum {
        let exponent = 2.0 * f64::from(job.half_exponent);
        let ln = if self.top > 0.0 {
            (layer.weight * layer.area * self.sum).ln() + 0.5 * exponent * f64::from(self.top).ln()
        } else {
            f64::NEG_INFINITY
        };
        let row = layer.first_row + self.at.1 as isize;
        LayerSum {
            ln,
            top: self.top,
            x: self.at.0 as f64 * job.waves.period_x / layer.n_x as f64,
            y: row as f64 * job.waves.period_y / layer.n_y as f64,
        }
    }
}

/// Index of a layer's row (may be below the axis) in its period.
#[inline(always)]
fn wrapped(layer: &Layer, row: usize) -> usize {
    (layer.first_row + row as isize).rem_euclid(layer.n_y as isize) as usize
}

#[inline(always)]
fn store(fields: &mut [V], layer: &Layer, block: usize, slot: usize, tile: &mut [f32; TILE]) {
    transpose_tile(tile);
    let o = slot * layer.blocks * LANES + block * LANES;
    for (v, row) in fields[o..o + LANES]
        .iter_mut()
        .zip(tile.chunks_exact(LANES))
    {
        v.0.copy_from_slice(row);
    }
}

dispatched! {
/// Even and odd field of buffer `which` at y ≥ 0 apart, rows into the lanes.
fn unfold_rows(layer: &Layer, block: usize, which: usize, z: &Lanes, fields: &mut Lanes) {
    let n = layer.n_y;
    // Buffers hold d1 + xy, d2 + yz, xz; fields are d1, d2, xy, xz, yz.
    let (even_field, odd_field) = [(0, Some(2)), (1, Some(4)), (3, None)][which];
    let blocks = layer.row_blocks();
    for row_block in 0..blocks {
        for (from, to) in [(&z.re, &mut fields.re), (&z.im, &mut fields.im)] {
            let (mut even, mut odd) = ([0.0; TILE], [0.0; TILE]);
            for l in 0..LANES {
                let y = (row_block * LANES + l) % n;
                let o = l * LANES;
                even[o..o + LANES].copy_from_slice(&from[y].0);
                odd[o..o + LANES].copy_from_slice(&from[(n - y) % n].0);
            }
            for i in 0..TILE {
                let (a, b) = (even[i], odd[i]);
                even[i] = 0.5 * (a + b);
                odd[i] = 0.5 * (a - b);
            }
            store(to, layer, block, even_field * blocks + row_block, &mut even);
            if let Some(field) = odd_field {
                store(to, layer, block, field * blocks + row_block, &mut odd);
            }
        }
    }
}
}

dispatched! {
/// Field `which`, rows into the lanes.
fn turn_rows(layer: &Layer, block: usize, which: usize, z: &Lanes, fields: &mut Lanes) {
    let blocks = layer.row_blocks();
    for row_block in 0..blocks {
        for (from, to) in [(&z.re, &mut fields.re), (&z.im, &mut fields.im)] {
            let mut rows = [0.0; TILE];
            for (l, row) in rows.chunks_exact_mut(LANES).enumerate() {
                row.copy_from_slice(&from[wrapped(layer, row_block * LANES + l)].0);
            }
            store(to, layer, block, which * blocks + row_block, &mut rows);
        }
    }
}
}

dispatched! {
/// Squares of the measure, their greatest, and `Σ weight (square/greatest)^half_exponent`.
fn reduce(
    measure: StressMeasure,
    fields: &[Lanes; 3],
    squares: &mut [V],
    weights: V,
    half_exponent: f32,
) -> (f32, f64) {
    let [a, b, c] = fields;
    let inside = weights.0.map(|w| if w > 0.0 { 1.0 } else { 0.0 });
    let mut top = [0.0_f32; LANES];
    for (i, square) in squares.iter_mut().enumerate() {
        squared(measure, [a.re[i], a.im[i], b.re[i], b.im[i], c.re[i]], &inside, square, &mut top);
    }
    let top = top.into_iter().fold(0.0, f32::max);
    if top <= 0.0 {
        return (0.0, 0.0);
    }
    let lanes = power_sum(squares, top, half_exponent);
    let sum = lanes.0.iter().zip(weights.0).map(|(s, w)| f64::from(*s) * f64::from(w)).sum();
    (top, sum)
}
}
