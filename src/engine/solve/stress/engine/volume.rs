//! Life integrals over the stressed volume of both bodies, and the greatest stress in it.
//!
//! ```text
//! I = ∫ <s − u>^m dV,   s = effective stress/p_h, V in a³ (both halves of a mirror surface)
//! ln I = ln Σ_k w_k Σ_ij A_k <s_ijk − u>^m        each sum relative to its own greatest term
//! swept:  ∫ max_x <s − u>^m dy dz                 from the greatest s of every row along x
//! ```
//! Every depth is summed on its own grid: as many points as its waves need are enough, to 3e-6
//! (Hertz, m up to 13.5). The stresses of pressure and of traction are formed once; what acts on body 1, on
//! body 2 (opposite traction) and without traction are their sum, difference and first term, so a second
//! body costs no transform unless its Poisson's ratio differs. Depths run in parallel; the sum over depths is
//! taken in order, so the result is the same on any number of threads.
//!
//! Sources: Ioannides and Harris (1985) for the integral with a limit u; Zaretsky (1987) without. Ours: three loadings from two
//! stresses, by the linearity of elastic stress.

use std::sync::atomic::{AtomicUsize, Ordering};

use rayon::prelude::*;

use super::super::assemble::{Part, block_inputs};
use super::super::layer::{Layer, Waves};
use super::super::load::Spectrum;
use super::super::measure::excess;
use super::super::rows::{squares_of, turn_rows, unfold_rows, weighted_sum};
use super::super::slice_out::Peak;
use super::super::spec::{Loading, StressSpec, Symmetry};
use super::super::sums::{
    Integral, LayerResult, LayerResults, LayerSum, MAX_LAWS, StressLaw, VolumeSums,
};
use super::StressEngine;
use crate::math::lane_fft::{LaneFft, Lanes, pack_pair};
use crate::math::lanes::{LANES, V};
use crate::physics::cycles::BodyId;

/// Integrals of one surface under one law, both bodies.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct VolumeOut {
    /// Body 1, pressure alone.
    pub normal: Integral,
    /// Body 1, pressure and traction; equal to `normal` where no traction was loaded.
    pub full: Integral,
    /// Body 2, pressure and traction.
    pub mate: Integral,
}

impl VolumeOut {
    /// Under the first law of the sums.
    pub(in crate::solve::stress) fn of(sums: &VolumeSums) -> Self {
        let integral = |loading| sums.integral(loading, 0);
        Self {
            normal: integral(Loading::Normal(BodyId::One)),
            full: integral(Loading::Full(BodyId::One)),
            mate: integral(Loading::Full(BodyId::Two)),
        }
    }
}

/// One thread's buffers and results.
pub(in crate::solve::stress) struct Worker {
    /// Inputs of the y pass.
    along_y: Vec<Lanes>,
    other: Lanes,
    /// Of pressure and of traction.
    along_x: [[Lanes; 3]; 2],
    /// Five fields after the y pass, `[(field · row blocks + row block) · kx + i]`, sixteen rows each; of
    /// pressure and of traction.
    fields: [Lanes; 2],
    squares: Vec<V>,
    beyond: Vec<V>,
    results: LayerResults,
}

impl Worker {
    pub(in crate::solve::stress) fn new(
        symmetry: Symmetry,
        waves: &Waves,
        layers: &[Layer],
    ) -> Self {
        // Buffers trade places in the transforms: all have the longer of the two lengths.
        let longest = waves.n_x.max(waves.n_y);
        let (buffers, rows) = match symmetry {
            Symmetry::MirrorY => (3, waves.n_y / 2 + 1),
            Symmetry::General | Symmetry::Line => (5, waves.n_y),
        };
        let fields = 5 * rows.div_ceil(LANES) * waves.blocks * LANES;
        let all_rows = layers.iter().map(|layer| layer.inside_y).sum();
        Self {
            along_y: (0..buffers).map(|_| Lanes::new(longest)).collect(),
            other: Lanes::new(longest),
            along_x: [0, 1].map(|_| [0, 1, 2].map(|_| Lanes::new(longest))),
            fields: [Lanes::new(fields), Lanes::new(fields)],
            squares: vec![V::ZERO; waves.n_x],
            beyond: vec![V::ZERO; waves.n_x],
            results: LayerResults {
                row_tops: [0, 1, 2, 3].map(|_| vec![0.0; all_rows]),
                done: Vec::with_capacity(layers.len()),
            },
        }
    }

    pub(in crate::solve::stress) fn bytes(&self) -> usize {
        let buffers = self.along_y.iter().chain(self.along_x.iter().flatten());
        let lanes: usize = buffers.chain(&self.fields).map(|l| l.re.len()).sum();
        let tops: usize = self.results.row_tops.iter().map(Vec::len).sum();
        8 * LANES * (lanes + self.other.re.len() + self.squares.len()) + 4 * tops
    }
}

/// What every layer's sum needs.
struct LayerInput<'a> {
    spec: &'a StressSpec,
    waves: &'a Waves,
    layers: &'a [Layer],
    first_row: &'a [usize],
    plans: &'a [LaneFft],
    spectrum: &'a Spectrum,
    laws: &'a [StressLaw],
    computed: &'a [Loading],
}

impl StressEngine {
    /// Integrals `∫ s^m dV` of the surface loaded last, without and with its traction, in parallel
    /// on the current rayon pool.
    pub fn volume(&mut self, exponent: f64) -> VolumeOut {
        self.volume_under(&[StressLaw::power(exponent)], &BodyId::BOTH);
        VolumeOut::of(&self.sums)
    }

    /// Sums of the surface loaded last under one or two laws, for the bodies that are asked for, in
    /// parallel on the current rayon pool. Allocates nothing.
    ///
    /// # Panics
    /// Without a law, or with more than two; for an engine that was made for slices.
    pub fn volume_under(&mut self, laws: &[StressLaw], bodies: &[BodyId]) -> &VolumeSums {
        assert!((1..=MAX_LAWS).contains(&laws.len()), "one or two laws");
        assert!(!self.workers.is_empty(), "made for volumes");
        let (computed, count) = self.computed(bodies);
        let job = LayerInput {
            spec: &self.spec,
            waves: &self.waves,
            layers: &self.layers,
            first_row: &self.sums.first_row,
            plans: &self.plans,
            spectrum: &self.spectrum,
            laws,
            computed: &computed[..count],
        };
        let depths = self.layers.len();
        let next = AtomicUsize::new(0);
        self.workers
            .par_iter_mut()
            .with_max_len(1)
            .for_each(|worker| {
                worker.results.done.clear();
                loop {
                    // Shallow layers are the largest and come first.
                    let k = next.fetch_add(1, Ordering::Relaxed);
                    if k >= depths {
                        break;
                    }
                    let result = job.layer(worker, k);
                    worker.results.done.push((k, result));
                }
            });
        let results = self.workers.iter().map(|worker| &worker.results);
        self.sums.gather(&results, laws.len());
        for loading in Loading::ALL {
            if !computed[..count].contains(&loading) {
                let same = stands_for(loading, &computed[..count]);
                self.sums.copy(same, loading);
            }
        }
        &self.sums
    }

    /// Sums of the last call of [`Self::volume_under`].
    pub fn sums(&self) -> &VolumeSums {
        &self.sums
    }

    /// The loadings that differ, and how many: both bodies are alike without traction.
    fn computed(&self, bodies: &[BodyId]) -> ([Loading; 4], usize) {
        let (mut list, mut count) = (Loading::ALL, 0);
        let sheared = self.spectrum.sheared;
        for body in BodyId::BOTH {
            let own = self.spec.materials() == 2 && bodies.contains(&body);
            let first = body == BodyId::One && self.spec.materials() == 1;
            if own || first {
                list[count] = Loading::Normal(body);
                count += 1;
            }
            if sheared && bodies.contains(&body) {
                list[count] = Loading::Full(body);
                count += 1;
            }
        }
        (list, count)
    }
}

/// The computed loading that equals one that was left out.
fn stands_for(loading: Loading, computed: &[Loading]) -> Loading {
    let normal = Loading::Normal(loading.body());
    if computed.contains(&normal) {
        normal
    } else {
        computed[0]
    }
}

impl LayerInput<'_> {
    fn layer(&self, worker: &mut Worker, k: usize) -> LayerResult {
        let layer = &self.layers[k];
        let mut running = [[RunningSum::default(); MAX_LAWS]; 4];
        for material in 0..self.spec.materials() {
            let mine = |loading: &Loading| self.spec.material(loading.body()) == material;
            if !self.computed.iter().any(mine) {
                continue;
            }
            self.pass_along_y(worker, layer, Part::Normal, material);
            let sheared = self.spectrum.sheared;
            if sheared {
                self.pass_along_y(worker, layer, Part::AlongX, material);
            }
            for row_block in 0..layer.row_blocks() {
                self.pass_along_x(worker, layer, row_block, 0);
                if sheared {
                    self.pass_along_x(worker, layer, row_block, 1);
                }
                for loading in self.computed.iter().filter(|l| mine(l)) {
                    let sums = &mut running[loading.index()];
                    self.reduce(worker, k, row_block, *loading, sums);
                }
            }
        }
        running.map(|laws| {
            let mut out = [LayerSum::NONE; MAX_LAWS];
            for ((out, sums), law) in out.iter_mut().zip(&laws).zip(self.laws) {
                *out = sums.finish(self, layer, law.exponent);
            }
            out
        })
    }

    fn pass_along_y(&self, worker: &mut Worker, layer: &Layer, part: Part, material: usize) {
        let slot = usize::from(part != Part::Normal);
        let nu = [self.spec.nu, self.spec.nu_2][material];
        for block in 0..layer.blocks {
            let inputs = &mut worker.along_y;
            block_inputs(
                layer,
                block,
                self.waves,
                self.spectrum,
                (material, nu),
                part,
                inputs,
            );
            for (which, input) in worker.along_y.iter_mut().enumerate() {
                self.plans[layer.fft_y].inverse(input, &mut worker.other);
                let fields = &mut worker.fields[slot];
                match self.spec.symmetry {
                    Symmetry::MirrorY => unfold_rows(layer, block, which, input, fields),
                    Symmetry::General | Symmetry::Line => {
                        turn_rows(layer, block, which, input, fields);
                    }
                }
            }
        }
    }

    fn pass_along_x(&self, worker: &mut Worker, layer: &Layer, row_block: usize, slot: usize) {
        let plan = &self.plans[layer.fft_x];
        let fields = &worker.fields[slot];
        // Two real fields share a transform: d1 with d2, xy with xz; yz is alone.
        for (input, (u, v)) in
            worker.along_x[slot]
                .iter_mut()
                .zip([(0, Some(1)), (2, Some(3)), (4, None)])
        {
            let width = layer.blocks * LANES;
            let line = |field: usize| (field * layer.row_blocks() + row_block) * width;
            pack_pair(layer.n_x, width, (line(u), v.map(line)), fields, input);
            plan.inverse(input, &mut worker.other);
        }
    }

    fn reduce(
        &self,
        worker: &mut Worker,
        k: usize,
        row_block: usize,
        loading: Loading,
        sums: &mut [RunningSum; MAX_LAWS],
    ) {
        let layer = &self.layers[k];
        let mut weights = V::ZERO;
        for (l, w) in weights.0.iter_mut().enumerate() {
            *w = layer.row_weight(row_block * LANES + l, self.spec.symmetry);
        }
        let squares = &mut worker.squares[..layer.inside_x];
        let [normal, tangential] = &worker.along_x;
        let tangential = match loading {
            Loading::Normal(_) => None,
            Loading::Full(_) => Some((tangential, loading.traction_sign())),
        };
        let tops = squares_of(self.spec.measure, normal, tangential, weights, squares);
        let row = self.first_row[k] + row_block * LANES;
        let rows = (layer.inside_y - row_block * LANES).min(LANES);
        worker.results.row_tops[loading.index()][row..row + rows].copy_from_slice(&tops.0[..rows]);
        let top = tops.0.into_iter().fold(0.0, f32::max);
        for (law, sums) in self.laws.iter().zip(sums) {
            let half = (0.5 * law.exponent) as f32;
            if law.limit > 0.0 {
                let beyond = &mut worker.beyond[..layer.inside_x];
                let top = excess(squares, top, law.limit as f32, beyond);
                sums.add(half, row_block, top, beyond, weights);
            } else {
                sums.add(half, row_block, top, squares, weights);
            }
        }
    }
}

/// Running sum over blocks of rows, relative to the greatest square so far.
#[derive(Debug, Clone, Copy, Default)]
struct RunningSum {
    top: f32,
    sum: f64,
    /// Point of this layer's grid and row where the greatest is.
    at: (usize, usize),
}

impl RunningSum {
    fn add(&mut self, half_exponent: f32, row_block: usize, top: f32, squares: &[V], weights: V) {
        if top <= 0.0 {
            return;
        }
        let sum = weighted_sum(squares, top, half_exponent, weights);
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

    fn finish(&self, job: &LayerInput, layer: &Layer, exponent: f64) -> LayerSum {
        let ln = if self.top > 0.0 {
            (layer.weight * layer.area * self.sum).ln() + 0.5 * exponent * f64::from(self.top).ln()
        } else {
            f64::NEG_INFINITY
        };
        let row = layer.first_row + self.at.1 as isize;
        LayerSum {
            ln,
            peak: Peak {
                value: f64::from(self.top).sqrt(),
                x: job.spec.x_first + self.at.0 as f64 * job.waves.period_x / layer.n_x as f64,
                y: row as f64 * layer.row_step,
                z: layer.z,
            },
        }
    }
}
