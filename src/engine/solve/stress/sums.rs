//! What a volume integral leaves: the share of every depth, the greatest stress of every row along x.
//!
//! ```text
//! ln I = ln Σ_k e^{L_k}          L_k: ln of depth k's share, its weight included
//! ln S = ln Σ_kr w_kr M_kr^m     M_kr: greatest effective stress of row r at depth k (swept)
//! ```
//! The greatest is that of the samples of a layer's own grid, which leaves a swept share of Hertz up to 3 % low
//! (m = 11.5); against a reference of the same grid it cancels.
//!
//! Part of `stress/engine/volume.rs`.

use serde::{Deserialize, Serialize};

use super::layer::Layer;
use super::slice_out::Peak;
use super::spec::{Loading, StressSpec};
use crate::math::ln_sum::ln_sum;

/// Most laws that one pass integrates.
pub(super) const MAX_LAWS: usize = 2;

/// How effective stress enters an integral: `<s − limit>^exponent`, in p_h.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub struct StressLaw {
    /// m.
    pub exponent: f64,
    /// u, in p_h; 0: none.
    pub limit: f64,
}

impl StressLaw {
    /// `s^m`.
    pub fn power(exponent: f64) -> Self {
        Self {
            exponent,
            limit: 0.0,
        }
    }

    /// The law at a stress in p_h.
    pub fn of(self, stress: f32) -> f64 {
        (f64::from(stress) - self.limit)
            .max(0.0)
            .powf(self.exponent)
    }

    /// ln of the law at a squared stress.
    fn ln(self, square: f32) -> f64 {
        let beyond = f64::from(square).sqrt() - self.limit;
        if beyond > 0.0 {
            self.exponent * beyond.ln()
        } else {
            f64::NEG_INFINITY
        }
    }
}

/// Share of one layer.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct LayerSum {
    /// ln of the share.
    pub(super) ln: f64,
    /// Greatest effective stress (less the limit, where there is one) and its place.
    pub(super) peak: Peak,
}

impl LayerSum {
    pub(super) const NONE: Self = Self {
        ln: f64::NEG_INFINITY,
        peak: Peak {
            value: 0.0,
            x: 0.0,
            y: 0.0,
            z: 0.0,
        },
    };
}

/// Sums of one layer, `[loading][law]`.
pub(super) type LayerResult = [[LayerSum; MAX_LAWS]; 4];

/// What one thread found: greatest squares of every row by loading, and the layers that it did.
pub(super) struct LayerResults {
    pub(super) row_tops: [Vec<f32>; 4],
    pub(super) done: Vec<(usize, LayerResult)>,
}

/// Life integral of one loading.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Integral {
    /// ln ∫ s^m dV, s in p_h, V in a³; −∞ without stress.
    pub ln: f64,
    /// Greatest effective stress at the points and depths of the sum (not refined).
    pub peak: Peak,
}

/// Sums of one surface.
#[derive(Debug, Clone)]
pub struct VolumeSums {
    depths: usize,
    /// `[(law · 4 + loading) · depths + k]`.
    logs: Vec<f64>,
    peaks: [Peak; 4],
    /// Greatest square of every row, `[loading][row]`; rows of all depths one after the other.
    row_tops: [Vec<f32>; 4],
    /// ln of every row's weight in a swept integral.
    rows: Vec<f64>,
    /// First row of each depth.
    pub(super) first_row: Vec<usize>,
}

impl VolumeSums {
    pub(super) fn new(spec: &StressSpec, layers: &[Layer]) -> Self {
        let mut rows = Vec::new();
        let mut first_row = Vec::with_capacity(layers.len());
        for layer in layers {
            first_row.push(rows.len());
            rows.extend((0..layer.inside_y).map(|r| {
                let both_sides = f64::from(layer.row_weight(r, spec.symmetry));
                (layer.weight * layer.row_step * both_sides).ln()
            }));
        }
        let depths = layers.len();
        Self {
            depths,
            logs: vec![f64::NEG_INFINITY; MAX_LAWS * 4 * depths],
            peaks: [Peak::default(); 4],
            row_tops: [0, 1, 2, 3].map(|_| vec![0.0; rows.len()]),
            rows,
            first_row,
        }
    }

    /// Of a line contact: one row a depth.
    pub(super) fn of_line(weights: &[f64]) -> Self {
        let depths = weights.len();
        Self {
            depths,
            logs: vec![f64::NEG_INFINITY; MAX_LAWS * 4 * depths],
            peaks: [Peak::default(); 4],
            row_tops: [0, 1, 2, 3].map(|_| vec![0.0; depths]),
            rows: weights.iter().map(|weight| weight.ln()).collect(),
            first_row: (0..depths).collect(),
        }
    }

    /// Forgets the greatest stresses.
    pub(super) fn clear(&mut self) {
        self.peaks = [Peak::default(); 4];
    }

    /// Sets one depth of a line contact.
    pub(super) fn set(&mut self, loading: Loading, law: usize, k: usize, sum: LayerSum) {
        let at = loading.index();
        self.logs[(law * 4 + at) * self.depths + k] = sum.ln;
        self.row_tops[at][k] = (sum.peak.value * sum.peak.value) as f32;
        if sum.peak.value > self.peaks[at].value {
            self.peaks[at] = sum.peak;
        }
    }

    /// ln of the share of every depth, weight included, under the `law`-th law of the call.
    pub fn layers(&self, loading: Loading, law: usize) -> &[f64] {
        &self.logs[(law * 4 + loading.index()) * self.depths..][..self.depths]
    }

    /// Integral over all depths, and the greatest effective stress.
    pub fn integral(&self, loading: Loading, law: usize) -> Integral {
        Integral {
            ln: ln_sum(self.layers(loading, law).iter().map(|ln| (1.0, *ln))),
            peak: self.peaks[loading.index()],
        }
    }

    /// Greatest square of effective stress of every row along x, `[row]`, rows of all depths in one list.
    pub fn row_tops(&self, loading: Loading) -> &[f32] {
        &self.row_tops[loading.index()]
    }

    /// Swept integral `∫ max_x <s − u>^m dy dz`: ln of the share of every depth from the rows' greatest
    /// squares (of one surface, or of many).
    pub fn swept_into(&self, row_tops: &[f32], law: StressLaw, layers: &mut [f64]) {
        assert_eq!(row_tops.len(), self.rows.len(), "one square a row");
        let mut from = 0;
        for (k, layer) in layers.iter_mut().enumerate().take(self.depths) {
            let until = self
                .first_row
                .get(k + 1)
                .map_or(self.rows.len(), |row| *row);
            let rows = self.rows[from..until].iter().zip(&row_tops[from..until]);
            *layer = ln_sum(rows.map(|(row, top)| (1.0, row + law.ln(*top))));
            from = until;
        }
    }

    /// Collects what the threads did, in order of depth.
    pub(super) fn gather<'a>(
        &mut self,
        threads: &(impl Iterator<Item = &'a LayerResults> + Clone),
        laws: usize,
    ) {
        self.peaks = [Peak::default(); 4];
        for k in 0..self.depths {
            let mut all = threads
                .clone()
                .flat_map(|thread| thread.done.iter().map(move |done| (thread, done)));
            let Some((thread, (_, result))) = all.find(|(_, (depth, _))| *depth == k) else {
                continue;
            };
            let from = self.first_row[k];
            let until = self
                .first_row
                .get(k + 1)
                .map_or(self.rows.len(), |row| *row);
            for (loading, by_law) in result.iter().enumerate() {
                for (law, sum) in by_law.iter().enumerate().take(laws) {
                    self.logs[(law * 4 + loading) * self.depths + k] = sum.ln;
                }
                if by_law[0].peak.value > self.peaks[loading].value {
                    self.peaks[loading] = by_law[0].peak;
                }
                self.row_tops[loading][from..until]
                    .copy_from_slice(&thread.row_tops[loading][from..until]);
            }
        }
    }

    /// A loading that equals another.
    pub(super) fn copy(&mut self, from: Loading, to: Loading) {
        let (from, to) = (from.index(), to.index());
        for law in 0..MAX_LAWS {
            let start = |loading: usize| (law * 4 + loading) * self.depths;
            let source = start(from)..start(from) + self.depths;
            self.logs.copy_within(source, start(to));
        }
        self.peaks[to] = self.peaks[from];
        let (low, high) = self.row_tops.split_at_mut(from.max(to));
        if from < to {
            high[0].copy_from_slice(&low[from]);
        } else {
            low[to].copy_from_slice(&high[0]);
        }
    }

    /// Memory, bytes.
    pub(super) fn bytes(&self) -> usize {
        8 * self.logs.len() + (4 * 4 + 8) * self.rows.len()
    }
}
