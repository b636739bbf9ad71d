//! The flow along the sliding of Eyring oil where the pressure is steep: at the faces, with its derivatives.
//!
//! ```text
//! τ ← τ Φ(ε, r²),   ε = G/ΔX H̄ (P_b − P_a),   H̄ = (H_a⁺ + H_b⁺)/2,   r² = (r²_a + r²_b)/2
//! ∂τ ← Φ ∂τ + τ (∂Φ/∂ε ∂ε + ∂Φ/∂r² ∂r²)
//! ```
//! | symbol | meaning | shape |
//! |---|---|---|
//! | Φ | flow over that of a small slope (`physics/eyring.rs`) | faces |
//! | r² | 1/cosh²σ, ∂r²/∂P stored, ∂r²/∂H = −2 r² ∂ ln g/∂H | ny × nx |
//! | G | as in `physics/fluid.rs` | scalar |
//!
//! Test: `reynolds.rs` (the linearisation is the derivative).
//!
//! Part of `fluidity.rs`. Source of Φ: Conry, Wang and Cusano (1987), J. Tribol. 109, 648-654, as in `physics/eyring.rs`. Ours: the
//! derivatives.

use rayon::prelude::*;

use super::faces::Faces;
use crate::physics::eyring::steep;

/// r² of all nodes and how steep a slope of the pressure is.
#[derive(Default)]
pub(super) struct Steep {
    sech2: Vec<f64>,
    sech2_p: Vec<f64>,
    /// G/ΔX; `None`: the flow has no direction.
    gain: Option<f64>,
}

/// r² and its derivative by P, a run of nodes to be filled.
pub(super) struct Slid<'a> {
    pub(super) sech2: &'a mut [f64],
    pub(super) sech2_p: &'a mut [f64],
}

impl Steep {
    /// Room for `n` nodes, once.
    pub(super) fn make_room(&mut self, n: usize) {
        self.sech2.resize(n, 1.0);
        self.sech2_p.resize(n, 0.0);
    }

    /// Says how steep slopes are.
    pub(super) fn set(&mut self, gain: Option<f64>) {
        self.gain = gain;
    }

    /// The values in blocks of `block` nodes.
    pub(super) fn blocks(&mut self, block: usize) -> impl IndexedParallelIterator<Item = Slid<'_>> {
        self.sech2
            .par_chunks_mut(block)
            .zip(self.sech2_p.par_chunks_mut(block))
            .map(|(sech2, sech2_p)| Slid { sech2, sech2_p })
    }

    /// The nodes of `faces` faces along x from node `start` on; fields are P, H and ∂ ln g/∂H of all nodes.
    pub(super) fn rows<'a>(
        &'a self,
        (p, h, ln_g_h): (&'a [f64], &'a [f64], &'a [f64]),
        start: usize,
        faces: usize,
    ) -> Option<SteepRows<'a>> {
        let here = start..start + faces + 1;
        self.gain.map(|gain| SteepRows {
            gain,
            p: &p[here.clone()],
            h: &h[here.clone()],
            ln_g_h: &ln_g_h[here.clone()],
            sech2: &self.sech2[here.clone()],
            sech2_p: &self.sech2_p[here],
        })
    }
}

/// A run of nodes: one more than faces between them.
#[derive(Clone, Copy)]
pub(super) struct SteepRows<'a> {
    gain: f64,
    p: &'a [f64],
    h: &'a [f64],
    ln_g_h: &'a [f64],
    sech2: &'a [f64],
    sech2_p: &'a [f64],
}

impl SteepRows<'_> {
    /// Takes from the conductances what steep pressures do not let through.
    pub(super) fn lessen(&self, tau: &mut [f64]) {
        conductances(self.gain, self.p, self.h, self.sech2, tau);
    }

    /// The same with the derivatives.
    pub(super) fn lessen_faces(&self, faces: &mut Faces) {
        with_slopes(self, faces);
    }
}

/// Mean film of a face; a closed gap is none.
#[inline(always)]
fn film(h_a: f64, h_b: f64) -> f64 {
    0.5 * (h_a.max(0.0) + h_b.max(0.0))
}

dispatched! {
fn conductances(gain: f64, p: &[f64], h: &[f64], sech2: &[f64], tau: &mut [f64]) {
    let n = tau.len();
    let (p_a, h_a, sech2_a) = (&p[..n], &h[..n], &sech2[..n]);
    let (p_b, h_b, sech2_b) = (&p[1..=n], &h[1..=n], &sech2[1..=n]);
    for i in 0..n {
        let epsilon = gain * film(h_a[i], h_b[i]) * (p_b[i] - p_a[i]);
        tau[i] *= steep(epsilon, 0.5 * (sech2_a[i] + sech2_b[i])).0;
    }
}
}

dispatched! {
fn with_slopes(nodes: &SteepRows, faces: &mut Faces) {
    let n = nodes.p.len() - 1;
    let gain = nodes.gain;
    let (p_a, h_a, sech2_a) = (&nodes.p[..n], &nodes.h[..n], &nodes.sech2[..n]);
    let (p_b, h_b, sech2_b) = (&nodes.p[1..=n], &nodes.h[1..=n], &nodes.sech2[1..=n]);
    let (sech2_p_a, ln_g_h_a) = (&nodes.sech2_p[..n], &nodes.ln_g_h[..n]);
    let (sech2_p_b, ln_g_h_b) = (&nodes.sech2_p[1..=n], &nodes.ln_g_h[1..=n]);
    let tau = &mut faces.tau[..n];
    let (by_p_a, by_h_a) = (&mut faces.p_a[..n], &mut faces.h_a[..n]);
    let (by_p_b, by_h_b) = (&mut faces.p_b[..n], &mut faces.h_b[..n]);
    for i in 0..n {
        let film = film(h_a[i], h_b[i]);
        let rise = p_b[i] - p_a[i];
        let (phi, by_epsilon, by_sech2) =
            steep(gain * film * rise, 0.5 * (sech2_a[i] + sech2_b[i]));
        let slope_p = tau[i] * by_epsilon * gain * film;
        let slope_h = tau[i] * by_epsilon * gain * 0.5 * rise;
        let slope_sech2 = tau[i] * by_sech2 * 0.5;
        let open_a = if h_a[i] > 0.0 { slope_h } else { 0.0 };
        let open_b = if h_b[i] > 0.0 { slope_h } else { 0.0 };
        by_p_a[i] = phi * by_p_a[i] - slope_p + slope_sech2 * sech2_p_a[i];
        by_p_b[i] = phi * by_p_b[i] + slope_p + slope_sech2 * sech2_p_b[i];
        by_h_a[i] = phi * by_h_a[i] + open_a - 2.0 * slope_sech2 * sech2_a[i] * ln_g_h_a[i];
        by_h_b[i] = phi * by_h_b[i] + open_b - 2.0 * slope_sech2 * sech2_b[i] * ln_g_h_b[i];
        tau[i] *= phi;
    }
}
}
