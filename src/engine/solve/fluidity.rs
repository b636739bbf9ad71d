//! Fluidity of the nodes: what sheared oil grants the pressure's flow, along the sliding and across it.
//!
//! ```text
//! secant         g = (1/η̄) ζ/asinh ζ                                  along and across
//! along, across  g_x = cosh σ/η̄,   g_y = sinh σ/(σ η̄),   σ = min(asinh ζ, ℓP)
//! steep          τ ← τ Φ(ε, r²) at faces along x,   ε = G H (P_b − P_a)/ΔX,   r² = 1/cosh²σ    means of both nodes
//! ζ = Z η̄/H,     ∂ ln g/∂P = f' ∂σ/∂P − ∂ ln η̄/∂P,   ∂ ln g/∂H = f' ∂σ/∂H
//! ```
//! | symbol | meaning | shape |
//! |---|---|---|
//! | g | 1/η̄*, of which the faces take the logarithmic mean | ny × nx |
//! | Φ | what is left of the flow where the pressure is steep (`physics/eyring.rs`) | faces |
//! | Z, ζ, σ, ℓ, G | as in `physics/fluid.rs` | |
//!
//! Both bodies move along x, so x is the direction of the sliding everywhere and the flow has no cross terms. Sliding at
//! an angle φ to x would make of g a tensor, g_x cos²φ + g_y sin²φ on ∂P/∂x and (g_x − g_y) sin φ cos φ on ∂P/∂y in the
//! flow along x: the corners of the nine-point star, of which the stencil (`jacobian.rs`) has five.
//!
//! Where ℓP is the less the film shears at the limiting stress and the derivative is that branch's; the kink between the
//! two is one that Newton's iteration passes as it does that of P ≥ 0. Without sliding and of Newtonian oil both
//! fluidities are 1/η̄, and one is kept. Tests: `reynolds.rs` (the linearisation is the derivative), `tests/engine/eyring.rs`.
//!
//! Sources: Eyring (1936); Conry, Wang and Cusano (1987) and Ehret, Dowson and Taylor (1998), as in `physics/eyring.rs`. Ours:
//! the derivatives.

use rayon::prelude::*;

use super::faces::{Nodes, Slopes};
use super::medium::Medium;
use super::steep::{Slid, Steep, SteepRows};
use crate::math::elementary::exp;
use crate::math::grid::{Grid, Symmetry};
use crate::physics::eyring;
use crate::physics::fluid::{ShearedFlow, Viscosity};

/// g of all nodes in one direction, its logarithm and the logarithm's derivatives by P and H.
struct Fluidities {
    g: Vec<f64>,
    ln_g: Vec<f64>,
    ln_g_p: Vec<f64>,
    ln_g_h: Vec<f64>,
}

impl Fluidities {
    fn new(n: usize) -> Self {
        let zero = vec![0.0; n];
        Self {
            g: zero.clone(),
            ln_g: zero.clone(),
            ln_g_p: zero.clone(),
            ln_g_h: zero,
        }
    }

    /// The values in blocks of `block` nodes.
    fn blocks(&mut self, block: usize) -> impl IndexedParallelIterator<Item = FluidityRun<'_>> {
        self.g
            .par_chunks_mut(block)
            .zip(self.ln_g.par_chunks_mut(block))
            .zip(self.ln_g_p.par_chunks_mut(block))
            .zip(self.ln_g_h.par_chunks_mut(block))
            .map(|(((g, ln_g), ln_g_p), ln_g_h)| FluidityRun {
                g,
                ln_g,
                ln_g_p,
                ln_g_h,
            })
    }
}

/// A run of nodes of [`Fluidities`].
struct FluidityRun<'a> {
    g: &'a mut [f64],
    ln_g: &'a mut [f64],
    ln_g_p: &'a mut [f64],
    ln_g_h: &'a mut [f64],
}

/// How much thinner warm oil is, node by node: ln η̄ → ln η̄ (1 + c/scale) + c (`physics/thinning.rs`).
#[derive(Debug, Default)]
pub(super) struct Warm {
    /// c; empty: the oil is as cold as its bulk.
    thinner: Vec<f64>,
    /// 1/scale.
    per_scale: f64,
}

/// A run of nodes of it.
#[derive(Clone, Copy)]
struct WarmRun<'a> {
    thinner: &'a [f64],
    per_scale: f64,
}

impl Warm {
    /// From now on; none: the oil is cold.
    pub(super) fn set(&mut self, thinner: Option<(&[f64], f64)>) {
        let (field, per_scale) = thinner.unwrap_or_default();
        self.thinner.clear();
        self.thinner.extend_from_slice(field);
        self.per_scale = per_scale;
    }

    fn run(&self, start: usize, n: usize) -> WarmRun<'_> {
        WarmRun {
            thinner: self.thinner.get(start..start + n).unwrap_or(&[]),
            per_scale: self.per_scale,
        }
    }
}

/// Direction of a pressure flow.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum FlowDirection {
    /// Between neighbours along x.
    Along,
    /// Between neighbours along y.
    Across,
}

/// Fluidities of the current iterate.
pub(super) struct Fluidity {
    /// Along x; of oil that flows alike in both directions both.
    along: Fluidities,
    /// Along y, where it differs; no room before it is asked for.
    across: Option<Fluidities>,
    /// Whether `across` is meant.
    is_directed: bool,
    /// What the flow along the sliding needs where the pressure is steep; no room before it is asked for.
    steep: Steep,
    /// How warm the oil is.
    pub(super) warm: Warm,
}

impl Fluidity {
    /// Room for `n` nodes.
    pub(super) fn new(n: usize) -> Self {
        Self {
            along: Fluidities::new(n),
            across: None,
            is_directed: false,
            steep: Steep::default(),
            warm: Warm::default(),
        }
    }

    /// Fluidities at P and H, in blocks of `block` nodes.
    pub(super) fn evaluate(
        &mut self,
        grid: &Grid,
        medium: &Medium,
        p: &[f64],
        h: &[f64],
        block: usize,
    ) {
        let directed = match medium.sheared {
            ShearedFlow::AlongAcross { limit, steepness } => Some((limit, steepness)),
            ShearedFlow::Secant => None,
        };
        let slides = medium.sliding > 0.0;
        let two = directed.is_some() && grid.symmetry != Symmetry::Line;
        // Made with the first evaluation, sliding or not: a knob that starts the sliding finds it.
        if two && self.across.is_none() {
            self.across = Some(Fluidities::new(grid.len()));
        }
        if directed.is_some() {
            self.steep.make_room(grid.len());
        }
        self.is_directed = two && slides;
        self.steep
            .set(directed.filter(|_| slides).map(|d| d.1 / grid.dx));
        let warm = &self.warm;
        let states = p.par_chunks(block).zip(h.par_chunks(block)).enumerate();
        let states = states.map(|(b, (p, h))| (p, h, warm.run(b * block, p.len())));
        let along = self.along.blocks(block).zip(states);
        match (directed.filter(|_| slides), &mut self.across) {
            (None, _) => {
                along.for_each(|(along, (p, h, warm))| one_values(medium, p, h, warm, along));
            }
            (Some((limit, _)), Some(across)) if two => {
                let directions = along
                    .zip(self.steep.blocks(block))
                    .zip(across.blocks(block));
                directions.for_each(|(((along, (p, h, warm)), slid), across)| {
                    directed_values(medium, limit, p, h, warm, along, slid, across);
                });
            }
            (Some((limit, _)), _) => {
                let rows = along.zip(self.steep.blocks(block));
                rows.for_each(|((along, (p, h, warm)), slid)| {
                    along_values(medium, limit, p, h, warm, along, slid);
                });
            }
        }
    }

    fn of(&self, direction: FlowDirection) -> &Fluidities {
        match (direction, &self.across) {
            (FlowDirection::Across, Some(across)) if self.is_directed => across,
            (FlowDirection::Across | FlowDirection::Along, _) => &self.along,
        }
    }

    /// What faces need of the nodes in `range`; `q` is ρ̄H³ of all nodes.
    pub(super) fn nodes<'a>(
        &'a self,
        direction: FlowDirection,
        q: &'a [f64],
        range: std::ops::Range<usize>,
    ) -> Nodes<'a> {
        let Fluidities { g, ln_g, .. } = self.of(direction);
        Nodes {
            q: &q[range.clone()],
            g: &g[range.clone()],
            ln_g: &ln_g[range],
        }
    }

    /// What is left of the flow through the faces between the nodes from `start` on, along the sliding, where the pressure
    /// is steep: `None` where its direction does not matter.
    pub(super) fn steep<'a>(
        &'a self,
        (p, h): (&'a [f64], &'a [f64]),
        start: usize,
        faces: usize,
    ) -> Option<SteepRows<'a>> {
        let ln_g_h = &self.along.ln_g_h;
        self.steep.rows((p, h, ln_g_h), start, faces)
    }

    /// What their derivatives need; `q_p` and `q_h` are those of ρ̄H³ of all nodes.
    pub(super) fn slopes<'a>(
        &'a self,
        direction: FlowDirection,
        (q_p, q_h): (&'a [f64], &'a [f64]),
        range: std::ops::Range<usize>,
    ) -> Slopes<'a> {
        let Fluidities { ln_g_p, ln_g_h, .. } = self.of(direction);
        Slopes {
            q_p: &q_p[range.clone()],
            q_h: &q_h[range.clone()],
            ln_g_p: &ln_g_p[range.clone()],
            ln_g_h: &ln_g_h[range],
        }
    }
}

/// `ln η̄` and its slope of a run of nodes; one loop a law, so that the law is no branch inside of it.
#[inline(always)]
fn viscosities(law: Viscosity, p: &[f64], warm: WarmRun, ln_eta: &mut [f64], slope: &mut [f64]) {
    let n = p.len();
    let (ln_eta, slope) = (&mut ln_eta[..n], &mut slope[..n]);
    if let law @ Viscosity::Barus { .. } = law {
        for i in 0..n {
            (ln_eta[i], slope[i]) = law.ln_eta(p[i]);
        }
    } else {
        for i in 0..n {
            (ln_eta[i], slope[i]) = law.ln_eta(p[i]);
        }
    }
    if !warm.thinner.is_empty() {
        let thinner = &warm.thinner[..n];
        for i in 0..n {
            let left = 1.0 + thinner[i] * warm.per_scale;
            ln_eta[i] = ln_eta[i] * left + thinner[i];
            slope[i] *= left;
        }
    }
}

dispatched! {
/// One fluidity for both directions: the secant of Eyring's law, or Newtonian.
fn one_values(medium: &Medium, p: &[f64], h: &[f64], warm: WarmRun, out: FluidityRun) {
    let n = p.len();
    let (h, g, ln_g) = (&h[..n], &mut out.g[..n], &mut out.ln_g[..n]);
    let (ln_g_p, ln_g_h) = (&mut out.ln_g_p[..n], &mut out.ln_g_h[..n]);
    viscosities(medium.viscosity, p, warm, ln_g, ln_g_p);
    if medium.sliding > 0.0 {
        for i in 0..n {
            let (ln_eta, slope) = (ln_g[i], ln_g_p[i]);
            // A closed gap conducts nothing, whatever its viscosity.
            let open = if h[i] > 0.0 { h[i] } else { 1.0 };
            let (factor, by_zeta) = eyring::ln_secant(medium.sliding / open * exp(ln_eta));
            ln_g[i] = factor - ln_eta;
            ln_g_p[i] = slope * (by_zeta - 1.0);
            ln_g_h[i] = if h[i] > 0.0 { -by_zeta / open } else { 0.0 };
            g[i] = exp(ln_g[i]);
        }
    } else {
        for i in 0..n {
            ln_g[i] = -ln_g[i];
            ln_g_p[i] = -ln_g_p[i];
            ln_g_h[i] = 0.0;
            g[i] = exp(ln_g[i]);
        }
    }
}
}

/// e^σ, 1/η̄, and of σ the derivatives by P and H.
#[inline(always)]
fn shear(
    (sliding, limit): (f64, f64),
    (ln_eta, slope): (f64, f64),
    p: f64,
    h: f64,
) -> (f64, f64, f64, f64) {
    let fluidity = exp(-ln_eta);
    // A closed gap conducts nothing, whatever its viscosity.
    let open = if h > 0.0 { h } else { 1.0 };
    let zeta = sliding / (open * fluidity);
    // e^asinh ζ = ζ + √(1 + ζ²), whose root is ζ to rounding beyond 1e8.
    let cut = zeta.min(1e8);
    let root = (1.0 + cut * cut).sqrt();
    let free = zeta + if zeta < 1e8 { root } else { zeta };
    let most = exp(limit * p.max(0.0));
    if free < most {
        let by_ln_zeta = cut / root;
        let by_h = if h > 0.0 { -by_ln_zeta / open } else { 0.0 };
        (free, fluidity, by_ln_zeta * slope, by_h)
    } else {
        (most, fluidity, limit, 0.0)
    }
}

dispatched! {
/// The fluidity along the sliding alone: of a line.
fn along_values(
    medium: &Medium,
    limit: f64,
    p: &[f64],
    h: &[f64],
    warm: WarmRun,
    out: FluidityRun,
    slid: Slid,
) {
    let n = p.len();
    let (h, g, ln_g) = (&h[..n], &mut out.g[..n], &mut out.ln_g[..n]);
    let (ln_g_p, ln_g_h) = (&mut out.ln_g_p[..n], &mut out.ln_g_h[..n]);
    let (sech2, sech2_p) = (&mut slid.sech2[..n], &mut slid.sech2_p[..n]);
    viscosities(medium.viscosity, p, warm, ln_g, ln_g_p);
    for i in 0..n {
        let (ln_eta, slope) = (ln_g[i], ln_g_p[i]);
        let (grown, thin, by_p, by_h) = shear((medium.sliding, limit), (ln_eta, slope), p[i], h[i]);
        let (factor, ln_factor, by_sigma) = eyring::along(grown);
        g[i] = factor * thin;
        ln_g[i] = ln_factor - ln_eta;
        ln_g_p[i] = by_sigma * by_p - slope;
        ln_g_h[i] = by_sigma * by_h;
        sech2[i] = 1.0 / (factor * factor);
        sech2_p[i] = -2.0 * sech2[i] * by_sigma * by_p;
    }
}
}

dispatched! {
/// Both fluidities.
fn directed_values(
    medium: &Medium,
    limit: f64,
    p: &[f64],
    h: &[f64],
    warm: WarmRun,
    along: FluidityRun,
    slid: Slid,
    across: FluidityRun,
) {
    let n = p.len();
    let (h, x, y) = (&h[..n], along, across);
    let (x_g, x_ln, y_g, y_ln) = (&mut x.g[..n], &mut x.ln_g[..n], &mut y.g[..n], &mut y.ln_g[..n]);
    let (x_p, x_h, y_p, y_h) = (&mut x.ln_g_p[..n], &mut x.ln_g_h[..n], &mut y.ln_g_p[..n], &mut y.ln_g_h[..n]);
    let (sech2, sech2_p) = (&mut slid.sech2[..n], &mut slid.sech2_p[..n]);
    viscosities(medium.viscosity, p, warm, x_ln, x_p);
    for i in 0..n {
        let (ln_eta, slope) = (x_ln[i], x_p[i]);
        let (grown, thin, by_p, by_h) = shear((medium.sliding, limit), (ln_eta, slope), p[i], h[i]);
        let (x_factor, x_ln_factor, x_slope) = eyring::along(grown);
        let (y_factor, y_ln_factor, y_slope) = eyring::across(grown);
        x_g[i] = x_factor * thin;
        x_ln[i] = x_ln_factor - ln_eta;
        x_p[i] = x_slope * by_p - slope;
        x_h[i] = x_slope * by_h;
        sech2[i] = 1.0 / (x_factor * x_factor);
        sech2_p[i] = -2.0 * sech2[i] * x_slope * by_p;
        y_g[i] = y_factor * thin;
        y_ln[i] = y_ln_factor - ln_eta;
        y_p[i] = y_slope * by_p - slope;
        y_h[i] = y_slope * by_h;
    }
}
}
